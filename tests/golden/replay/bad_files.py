# SPDX-License-Identifier: MIT
"""Broken files end in exit status 3, a message that names the file and the place, and no output.

    bad_files.py DCH FOLDER_OF_TRAJECTORIES
"""

import glob
import gzip
import json
import os
import subprocess
import sys
import tempfile

import h5py
import numpy
from dch_command import Checks, expect_failure, run

OUTPUTS = ["--out", "lists.h5", "--report", "report.json", "--plot", "report.html"]

# What each broken dump's message has to name beyond the file.
BAD_DUMPS = {
    "atom-duplicated-id.lammpstrj": ["frame 0", "line 11", "2"],
    "atom-item-name.lammpstrj": ["frame 0", "line 9", "DUMMY"],
    "atom-no-item.lammpstrj": ["frame 0", "line 9", "DUMMY"],
    "atom-not-enough-lines.lammpstrj": ["frame 0", "2", "3 atoms"],
    "atom-too-many-fields.lammpstrj": ["frame 0", "line 10", "5"],
    "box-item-name.lammpstrj": ["frame 0", "line 5", "DUMMY"],
    "box-not-item.lammpstrj": ["frame 0", "line 5", "DUMMY"],
    "box-not-numbers.lammpstrj": ["frame 0", "line 6", "DUMMY"],
    "box-wrong-size.lammpstrj": ["frame 0", "line 6", "3 numbers"],
    "items-after-atoms.lammpstrj": ["frame 1"],
    "timestep-item-name.lammpstrj": ["frame 0", "line 1", "DUMMY"],
    "timestep-no-item.lammpstrj": ["frame 0", "line 1", "DUMMY"],
}


def dump(atoms, box="0 10\n0 10\n0 10\n", columns="id x y z", step=0):
    return (f"ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF ATOMS\n{len(atoms)}\nITEM: BOX BOUNDS pp pp pp\n{box}"
            f"ITEM: ATOMS {columns}\n" + "".join(line + "\n" for line in atoms))


GOOD = dump(["1 1 1 1", "2 2 2 2"])

# A good frame, then one that cannot be: name -> (content, what the message has to name).
BAD_SECOND_FRAMES = {
    "nan": (GOOD + dump(["1 1 nan 1", "2 2 2 2"]), ["frame 1", "nan"]),
    "infinite": (GOOD + dump(["1 1 1 1", "2 2 inf 2"]), ["frame 1", "inf"]),
    "not-a-number": (GOOD + dump(["1 1 1 1", "2 2 x 2"]), ["frame 1", "x"]),
    "zero-box": (GOOD + dump(["1 1 1 1", "2 2 2 2"], "0 10\n5 5\n0 10\n"), ["frame 1"]),
    "negative-box": (GOOD + dump(["1 1 1 1", "2 2 2 2"], "0 10\n0 10\n10 0\n"), ["frame 1"]),
    "flat-box": (GOOD + dump(["1 1 1 1", "2 2 2 2"], "0 1e-100\n0 1\n0 1e100\n"), ["frame 1", "1e+100 long", "1e+12"]),
    "tiny-edge": (dump(["1 0 0 0", "2 0 0 0"], "0 10\n0 10\n0 1e-90\n"), ["frame 0", "10 long", "1e-90 high"]),
    "other-number-without-ids": (dump(["1 1 1", "2 2 2"], columns="x y z") + dump(["1 1 1"], columns="x y z"),
                                 ["frame 1", "1", "2"]),
    "no-coordinates": (dump(["1 5"], columns="id type"), ["frame 0"]),
}


def check_replay_and_info(checks, command, path, parts):
    name = os.path.basename(path)
    expect_failure(checks, command, ["replay", path, "--cutoff", "0.01", *OUTPUTS], 3, [name, *parts])
    expect_failure(checks, command, ["info", path], 3, [name, *parts])
    print("broken:", name, flush=True)


def check_bad_dumps(checks, command, data):
    found = sorted(map(os.path.basename, glob.glob(os.path.join(data, "bad", "*"))))
    checks.that(found == sorted(BAD_DUMPS), f"broken dumps listed here and in {data}/bad differ: {found}")
    for name in found:
        check_replay_and_info(checks, command, os.path.join(data, "bad", name), BAD_DUMPS.get(name, []))


def check_bad_second_frames(checks, command, folder):
    for name, (content, parts) in BAD_SECOND_FRAMES.items():
        path = os.path.join(folder, name + ".lammpstrj")
        with open(path, "w") as file:
            file.write(content)
        check_replay_and_info(checks, command, path, parts)


def check_tiny_box(checks, command, folder):
    """A good file, however small its box is beside 1: the time goes by the atoms, and the lists are those of all pairs."""
    path, report, hashes = os.path.join(folder, "tiny.lammpstrj"), os.path.join(folder, "tiny.json"), set()
    with open(path, "w") as file:
        file.write(dump(["1 0 0 0", "2 1e-81 0 0", "3 0 0 1e-81"], "0 1e-80\n" * 3).replace("pp pp pp", "pp pp ff"))
    for engine in ("cell", "allpairs"):
        result = run(command, "replay", path, "--cutoff", "4.5e-81", "--engine", engine, "--report", report, timeout=60)
        checks.that(result.returncode == 0, f"a tiny box, engine {engine}: {result.stderr}")
        with open(report, encoding="utf-8") as file:
            content = json.load(file)
        checks.that(content["pairs_per_frame"] == [3], f"a tiny box, engine {engine}: pairs {content['pairs_per_frame']}")
        hashes.add(content["list_hash"])
    checks.that(len(hashes) == 1, f"a tiny box: lists differ: {hashes}")


def write_all_kinds(command, data, folder):
    """One small file of each kind; those that the command cannot write are copied from the data."""
    dumps = os.path.join(data, "nacl.lammpstrj")
    with open(dumps, "rb") as source, gzip.open(os.path.join(folder, "nacl.lammpstrj.gz"), "wb") as target:
        target.write(source.read())
    result = run(command, "convert", dumps, os.path.join(folder, "nacl.h5md"))
    if result.returncode != 0:
        raise SystemExit(f"dchmd convert: {result.stderr}")
    with open(os.path.join(folder, "three.gro"), "w") as file:
        file.write("three atoms\n3\n" + "".join(f"    1SOL     OW{i:5d}{i:8.3f}{i:8.3f}{i:8.3f}\n" for i in (1, 2, 3)) +
                   "   5.00000   5.00000   5.00000\n")
    kinds = [dumps] + [os.path.join(data, name) for name in ("water.trr", "cell_shapes.xtc", "withpbc.dcd")]
    return kinds + [os.path.join(folder, name) for name in ("nacl.lammpstrj.gz", "nacl.h5md", "three.gro")]


def check_truncations(checks, command, data, folder):
    for path in write_all_kinds(command, data, folder):
        content = open(path, "rb").read()
        result = run(command, "info", path)
        checks.that(result.returncode == 0, f"{path} is good: {result.stderr}")
        ending = os.path.basename(path).split(".", 1)[1]
        for fraction in (0.003, 0.1, 0.55, 0.93):
            size = int(fraction * len(content)) + 1  # not at the end of a frame
            cut = os.path.join(folder, f"cut-to-{size}.{ending}")
            with open(cut, "wb") as file:
                file.write(content[:size])
            check_replay_and_info(checks, command, cut, [])


def check_not_trajectories(checks, command, folder):
    missing = os.path.join(folder, "missing.xtc")
    check_replay_and_info(checks, command, missing, ["No such file"])
    for ending in ("lammpstrj", "lammpstrj.gz", "dcd", "xtc", "trr", "gro", "h5"):
        for name, content in (("empty", b""), ("noise", bytes((37 * k * k + k) % 251 for k in range(4000)))):
            path = os.path.join(folder, f"{name}.{ending}")
            with open(path, "wb") as file:
                file.write(content)
            check_replay_and_info(checks, command, path, [])
    os.mkdir(os.path.join(folder, "folder.dcd"))
    check_replay_and_info(checks, command, os.path.join(folder, "folder.dcd"), [])
    path = os.path.join(folder, "coordinates.xyz")
    open(path, "w").close()
    check_replay_and_info(checks, command, path, [".lammpstrj", ".xtc", ".dcd"])


def check_pipes(checks, command, data, folder):
    """Pipes with nothing in them are empty files. Where none can be read, nobody waits for somebody to write into it."""
    for name in ("pipe.lammpstrj", "pipe.xtc"):
        path = os.path.join(folder, name)
        os.mkfifo(path)
        writer = subprocess.Popen([sys.executable, "-c", "import sys; open(sys.argv[1], 'wb').close()", path])
        expect_failure(checks, command, ["info", path], 3, [name, "empty"])
        writer.wait(timeout=60)
    path = os.path.join(folder, "pipe.h5")
    os.mkfifo(path)
    expect_failure(checks, command, ["info", path], 2, ["pipe.h5", "cannot be read from a pipe", "save it to a file"])
    bonds = os.path.join(folder, "pipe.bonds")
    os.mkfifo(bonds)
    trajectory = os.path.join(data, "nopbc.dcd")
    expect_failure(checks, command, ["contacts", trajectory, "--gap", "1", "--topology", bonds], 3,
                   ["pipe.bonds", "not a regular file"])


def check_files_that_lead_outside(checks, command, folder):
    """HDF5 files whose numbers are in other files: none of their bytes may come out."""
    secret, good = os.path.join(folder, "secret.bin"), os.path.join(folder, "good.h5")
    with open(secret, "wb") as file:
        file.write(b"S" * 4096)
    with h5py.File(good, "w") as file:
        file["particles/p/position/value"] = numpy.ones((2, 4, 3))

    def storage(file):
        file.create_dataset("particles/p/position/value", (2, 4, 3), "f8", external=[(secret, 0, h5py.h5f.UNLIMITED)])

    def virtual(file):
        layout = h5py.VirtualLayout((2, 4, 3), "f8")
        layout[...] = h5py.VirtualSource(good, "particles/p/position/value", (2, 4, 3))
        file.create_virtual_dataset("particles/p/position/value", layout)

    def link(file):
        file["particles/p/position"] = h5py.ExternalLink(good, "particles/p/position")

    def link_to_pipe(file):
        file["particles"] = h5py.ExternalLink(os.path.join(folder, "pipe.h5"), "particles")

    for make, parts in ((storage, ["external storage"]), (virtual, ["virtual dataset"]), (link, ["another file"]),
                        (link_to_pipe, ["another file"])):
        path = os.path.join(folder, make.__name__ + ".h5")
        with h5py.File(path, "w") as file:
            make(file)
        check_replay_and_info(checks, command, path, parts)
        expect_failure(checks, command, ["convert", path, os.path.join(folder, "copy.lammpstrj")], 3, parts)
        checks.that(not os.path.exists(os.path.join(folder, "copy.lammpstrj")), "nothing is copied")


def check_compressed_h5md(checks, command, folder):
    """What h5py packs is read by the process without rights."""
    path = os.path.join(folder, "packed.h5")
    with h5py.File(path, "w") as file:
        positions = numpy.arange(24.0).reshape(2, 4, 3)
        file.create_dataset("particles/p/position/value", data=positions, chunks=(1, 4, 3), compression="gzip", shuffle=True,
                            fletcher32=True)
    result = run(command, "info", path)
    checks.that(result.returncode == 0, f"packed H5MD file: {result.stderr}")


def check_expansion(checks, command, folder):
    """A small file that would grow to a large frame."""
    path = os.path.join(folder, "bomb.lammpstrj.gz")
    head = dump(["1 1 1"], columns="x y z").replace("OF ATOMS\n1\n", "OF ATOMS\n2000000000\n")
    with gzip.open(path, "wb") as file:
        file.write(head.encode())
        for _ in range(200):
            file.write(b"1 2 3\n" * 10000)
    for arguments in (["info", path], ["replay", path, "--cutoff", "1"], ["convert", path, os.path.join(folder, "bomb.h5")],
                      ["contacts", path, "--gap", "1"]):
        expect_failure(checks, command, [*arguments, "--max-expanded", "2M"], 3,
                       ["bomb.lammpstrj.gz", "frame 0", "2097152 bytes", "--max-expanded"])
    for word in ("2", "x", "-1G", "2000T", "1.5G"):
        expect_failure(checks, command, ["info", path, "--max-expanded", word], 2, ["--max-expanded", word])


def check_bad_topologies(checks, command, data, folder):
    trajectory = os.path.join(data, "nacl.lammpstrj")
    for name, content, parts in (("word.bonds", "1 2\n1 x\n", ["line 2"]), ("unknown.bonds", "1 99999\n", ["line 1", "99999"]),
                                 ("self.bonds", "# none\n3 3\n", ["line 2", "itself"]), ("kind.psf", "", [".bonds"])):
        path = os.path.join(folder, name)
        with open(path, "w") as file:
            file.write(content)
        arguments = ["replay", trajectory, "--cutoff", "3", "--exclude", "bonded", "--topology", path, *OUTPUTS]
        expect_failure(checks, command, arguments, 3, [name, *parts])
        print("broken:", name, flush=True)


def check_bad_chains(checks, command, data, folder):
    """Chains that do not fit the trajectory; dchmd contacts names the place and the remedy."""
    trajectory = os.path.join(data, "polymer.lammpstrj")
    for name, content, parts in (("twice.chains", "1-27\n28-40 3\n", ["line 2", "id 3", "chain of line 1"]),
                                 ("unknown.chains", "1-27\n5000 5001\n", ["line 2", "no atom with the id 5000"]),
                                 ("short.chains", "ring 1 2\n", ["line 1", "three atoms"]),
                                 ("empty.chains", "", ["is empty"]), ("empty.bonds", "", ["is empty"]),
                                 ("none.chains", "# none\n", ["no bonds and no chains", "--topology"]),
                                 ("branch.bonds", "1 2\n2 3\n2 4\n", ["id 2", "three bonds"]),
                                 ("twice.bonds", "1 2\n2 1\n", ["ids 1 and 2", "twice"]),
                                 ("empty.data", "", ["is empty"]), ("kind.psf", "", [".chains"])):
        path = os.path.join(folder, name)
        with open(path, "w") as file:
            file.write(content)
        arguments = ["contacts", trajectory, "--gap", "1", "--topology", path, *OUTPUTS]
        expect_failure(checks, command, arguments, 3, [name, *parts])
    missing = os.path.join(folder, "missing.chains")
    arguments = ["contacts", trajectory, "--gap", "1", "--topology", missing, *OUTPUTS]
    expect_failure(checks, command, arguments, 3, ["missing.chains", "No such file"])


def check_frames_that_do_not_fit(checks, command, folder):
    """Good frames, then one in which a chain cannot be followed."""
    good = dump(["1 1 1 1", "2 2 2 2", "3 3 3 3", "4 9 9 9"])
    ring = "ring 1 2 3\n"
    for name, content, chains, status, parts in (
            ("empty", "", "1 2 3\n", 3, ["empty"]),
            ("gone", good + dump(["1 1 1 1", "2 2 2 2", "4 9 9 9"]), "1 2 3\n", 3, ["frame 1", "3 atoms", "the id 3"]),
            ("torn", good + dump(["1 1 1 1", "2 2 2 2", "3 7 7 7", "4 9 9 9"]), "4 1 2 3\n", 3,
             ["frame 1", "the ids 2 and 3 is 8.66", "box height, 5"]),
            ("wound", good + dump(["1 1 1 1", "2 4 1 1", "3 8 1 1", "4 9 9 9"]), ring, 3,
             ["frame 1", "the ids 3 and 1 winds around"]),
            ("back", dump(["1 1 1 1", "2 2 2 2"], step=5) + GOOD, "1 2\n", 2, ["frame 1", "time step, 0", "before, 5"])):
        path, topology = os.path.join(folder, name + ".lammpstrj"), os.path.join(folder, name + ".chains")
        for file_name, text in ((path, content), (topology, chains)):
            with open(file_name, "w") as file:
                file.write(text)
        arguments = ["contacts", path, "--gap", "1", "--topology", topology, *OUTPUTS]
        print(expect_failure(checks, command, arguments, status, [name + ".lammpstrj", *parts]).strip(), flush=True)


def main(command, data):
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        check_bad_dumps(checks, command, data)
        check_bad_second_frames(checks, command, folder)
        check_tiny_box(checks, command, folder)
        check_truncations(checks, command, data, folder)
        check_not_trajectories(checks, command, folder)
        check_pipes(checks, command, data, folder)
        check_files_that_lead_outside(checks, command, folder)
        check_compressed_h5md(checks, command, folder)
        check_expansion(checks, command, folder)
        check_bad_topologies(checks, command, data, folder)
        check_bad_chains(checks, command, data, folder)
        check_frames_that_do_not_fit(checks, command, folder)
    checks.finish()


if __name__ == "__main__":
    main(*sys.argv[1:])
