# SPDX-License-Identifier: MIT
"""dchmd contacts against all pairs: contacts, events, contact map and P(s), from each kind of topology.

    contacts.py DCH FOLDER_OF_TRAJECTORIES DOCS
"""

import json
import os
import random
import re
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

import h5py
import numpy

from contact_oracle import Contacts, chains_by_molecule, lay_chains, read_dump
from dch_command import Checks, check_keys, expect_failure, run, run_example, write_chain
from drawings import drawing_faults

CARDS = ["Contact map", "P(s)", "Contacts of a frame", "Duration of contacts"]


def timed(events):
    """Sorted, with times to six digits: those of a TRR file are in single precision, and a dump holds them in another unit."""
    return sorted((*event[:4], round(event[4], 6), round(event[5], 6), *event[6:]) for event in events)


def compare(checks, what, expected, path, report):
    """The file and the report hold what the oracle found."""
    checks.that(expected.nearest_to_reach > 1e-9, f"{what}: rounding decides: {expected.nearest_to_reach}")
    with h5py.File(path) as file:
        checks.that(file["chains/ids"][:].tolist() == expected.ids.tolist(), f"{what}: order of the beads")
        checks.that(file["chains/first"][:].tolist() == expected.first.tolist(), f"{what}: chains")
        checks.that(file["chains/ring"][:].tolist() == [int(ring) for ring in expected.ring], f"{what}: rings")
        within, between = expected.per_frame()
        checks.that(file["frames/within"][:].tolist() == within, f"{what}: contacts within chains")
        checks.that(file["frames/between"][:].tolist() == between, f"{what}: contacts between chains")
        steps = [frame["step"] for frame in expected.frames]
        checks.that(file["frames/step"][:].tolist() == steps, f"{what}: steps")
        columns = ("i", "j", "first", "frames", "begin", "last", "begun_before", "not_ended")
        events = timed(zip(*(file["events/" + name][:].tolist() for name in columns)))
        wanted = timed(expected.events())
        checks.that(events == wanted, f"{what}: {len(events)} events, {len(wanted)} expected")
        contacts, pairs = expected.binned(file["map/first_place"][:])
        checks.that(numpy.array_equal(file["map/contacts"][:], contacts), f"{what}: contacts of the map")
        checks.that(numpy.array_equal(file["map/pairs"][:], pairs), f"{what}: pairs of the map")
        contacts, pairs = expected.separation()
        checks.that(file["separation/contacts"][:].tolist() == contacts.tolist(), f"{what}: contacts by separation")
        checks.that(file["separation/pairs"][:].tolist() == pairs.tolist(), f"{what}: pairs by separation")
        with numpy.errstate(invalid="ignore", divide="ignore"):
            probability = contacts / (pairs * len(steps))
        checks.that(numpy.allclose(file["separation/probability"][:], probability, 1e-12, 0, equal_nan=True),
                    f"{what}: P(s)")
    checks.that(report["events"]["number"] == len(wanted), f"{what}: number of events")
    complete = [event for event in wanted if event[6:] == (0, 0)]
    checks.that(report["events"]["complete"] == len(complete), f"{what}: complete events")
    mean = sum(event[5] - event[4] for event in complete) / len(complete) if complete else None
    checks.that(mean is None or abs(report["events"]["mean_duration"] - mean) <= 1e-5 * mean, f"{what}: duration {mean}")
    print(f"{what}: {sum(within)} contacts within and {sum(between)} between chains, {len(wanted)} events, "
          f"{len(complete)} complete", flush=True)


def follow(checks, command, folder, path, *options):
    """Runs the command; its report and the path of its data."""
    data, report = os.path.join(folder, "contacts.h5"), os.path.join(folder, "report.json")
    result = run(command, "contacts", path, "--out", data, "--report", report, *options)
    checks.that(result.returncode == 0 and result.stderr == "", f"contacts {path} {options}: {result.stderr}")
    with open(report) as file:
        return data, json.load(file)


def write_chains(path, chains):
    """Ranges where ids follow each other, comments, rings."""
    with open(path, "w") as file:
        for ids, ring in chains:
            in_a_row = ids == list(range(ids[0], ids[0] + len(ids)))
            words = [f"{ids[0]}-{ids[-1]}"] if in_a_row else map(str, ids)
            file.write(("ring " if ring else "") + " ".join(words) + " # a chain\n")


def converted(command, folder, path):
    """The frames of a trajectory, by way of a dump."""
    dump = os.path.join(folder, "converted.lammpstrj")
    result = run(command, "convert", path, dump)
    if result.returncode != 0:
        raise SystemExit(f"dchmd convert {path}: {result.stderr}")
    return read_dump(dump)


def check_polymer(checks, command, data, docs, folder):
    """A real dump of many atoms; radii by type. In its molecules ids do not follow the bonds, so chains are laid through
    their beads, open ones and rings, and without --topology the command has to say so."""
    path, topology = os.path.join(data, "polymer.lammpstrj"), os.path.join(folder, "laid.chains")
    frames = read_dump(path)[::4]
    radii = {1: 1.3, 2: 2.5, 3: 1.4}
    types = dict(zip(frames[0]["id"].astype(int), frames[0]["type"].astype(int)))
    chains = lay_chains(frames, [ids for ids, _ in chains_by_molecule(frames[0])], 28)
    write_chains(topology, chains)
    checks.that(len({ring for _, ring in chains}) == 2, "open chains and rings")
    expected = Contacts(frames, chains, lambda atom: radii[types[atom]], 0.4321712345)
    file, report = follow(checks, command, folder, path, "--gap", "0.4321712345", "--radius", "1=1.3,2=2.5,3=1.4",
                          "--topology", topology, "--frames", "::4")
    compare(checks, "polymer", expected, file, report)
    check_keys(checks, report, docs, {"always"}, "contacts")
    checks.that(report["chains"]["beads"] == 1714 and report["map_bins"] <= 512, f"chains {report['chains']}")
    checks.that(report["structure"]["updates"] == report["choice"]["frames_wrapped"] - 1, "the hierarchy is kept up")
    selected = Contacts(frames[2:8:2], chains, lambda atom: 2.5, 1.2345678901, 3, "between")
    file, report = follow(checks, command, folder, path, "--gap", "1.2345678901", "--radius", "2.5", "--pairs", "between",
                          "--skip-bonds", "3", "--frames", "8:32:8", "--bins", "9", "--topology", topology)
    compare(checks, "polymer, between", selected, file, report)
    expect_failure(checks, command, ["contacts", path, "--gap", "1", "--out", "contacts.h5"], 3,
                   [path, "frame 0", "the ids 41 and 42", "half the smallest box height", "molecules of", "--molecules"])


def check_plain_commands(checks, command, data, folder):
    """Without a topology: the one molecule of the dump that is a chain, and all atoms of a file without molecules."""
    path = os.path.join(data, "polymer.lammpstrj")
    expected = Contacts(read_dump(path), [(list(range(1, 41)), False)], lambda atom: 0, 5.0123456789)
    file, report = follow(checks, command, folder, path, "--gap", "5.0123456789", "--molecules", "1")
    compare(checks, "polymer, molecule 1", expected, file, report)
    checks.that(report["chains"]["number"] == 1 and report["chains"]["beads"] == 40, f"chains {report['chains']}")
    for name, length, gap in (("nopbc.dcd", 401, 4.3210987654), ("withpbc.dcd", 4, 0.5123456789)):
        path = os.path.join(data, name)
        frames = converted(command, folder, path)[:8]
        atoms = len(frames[0]["id"])
        chains = [(list(range(first, first + length)), False) for first in range(1, atoms + 1, length)]
        expected = Contacts(frames, chains, lambda atom: 0, gap)
        file, report = follow(checks, command, folder, path, "--gap", str(gap), "--chain-length", str(length), "--frames", ":8")
        compare(checks, f"{name}, chains of {length}", expected, file, report)
    for name in ("water.trr", "nacl.lammpstrj", "triclinic-namd.dcd"):
        expect_failure(checks, command, ["contacts", os.path.join(data, name), "--gap", "0.1"], 2,
                       [name, "no molecule column", "--topology", "--chain-length"])


def check_long_chain(checks, command, data, folder):
    """A real molecule without a box as one chain, and as a ring with beads in reverse."""
    path, topology = os.path.join(data, "nopbc.dcd"), os.path.join(folder, "one.chains")
    frames = converted(command, folder, path)
    for ids, ring, skip, bins, gap, threads in ((list(range(1, 402)), False, 4, 512, 4.3210987654, 1),
                                                (list(range(400, 1, -1)), True, 2, 50, 3.2109876543, 3)):
        chains = [(ids, ring)] + ([([401], False)] if ring else [])
        write_chains(topology, chains)
        expected = Contacts(frames, chains, lambda atom: 0, gap, skip, "within")
        file, report = follow(checks, command, folder, path, "--gap", str(gap), "--skip-bonds", str(skip), "--pairs",
                              "within", "--bins", str(bins), "--topology", topology, "--threads", str(threads))
        compare(checks, f"a molecule, ring: {ring}", expected, file, report)
        checks.that(report["threads"] == threads, f"threads: {report['threads']}")


def check_water(checks, command, data, folder):
    """Many short real chains, H-O-H, in a box, and events timed by the frames' times."""
    path, topology = os.path.join(data, "water.trr"), os.path.join(folder, "water.bonds")
    frames = converted(command, folder, path)
    with open(topology, "w") as file:
        file.writelines(f"{oxygen} {oxygen + 1}\n{oxygen + 2} {oxygen}\n" for oxygen in range(1, 298, 3))
    chains = [([oxygen + 1, oxygen, oxygen + 2], False) for oxygen in range(1, 298, 3)]
    for bins in ("512", "20"):
        expected = Contacts(frames, chains, lambda atom: 0.03, 0.1401234567, 0)
        file, report = follow(checks, command, folder, path, "--gap", "0.1401234567", "--radius", "0.03", "--skip-bonds", "0",
                              "--topology", topology, "--bins", bins)
        compare(checks, f"water, {bins} bins", expected, file, report)
        checks.that(report["time"] == "time" and report["map_bins"] <= int(bins), "times of frames")


def write_melt_dump(path, frames, box):
    with open(path, "w") as file:
        for step, atoms in frames:
            file.write(f"ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF ATOMS\n{len(atoms)}\nITEM: BOX BOUNDS pp pp pp\n"
                       + f"0 {box!r}\n" * 3 + "ITEM: ATOMS id mol x y z\n")
            file.writelines(f"{atom} {(atom + 24) // 25 if atom <= 300 else 0} {x!r} {y!r} {z!r}\n"
                            for atom, (x, y, z) in atoms)


def make_melt(command, folder):
    """A LAMMPS data file of 12 chains of 25 beads, and a dump of them that shakes, with solvent that comes and goes."""
    melt, path = os.path.join(folder, "melt.data"), os.path.join(folder, "melt.lammpstrj")
    result = run(command, "generate", "melt", "--chains", "12", "--beads", "25", "--density", "0.4", melt)
    if result.returncode != 0:
        raise SystemExit(f"dchmd generate: {result.stderr}")
    text = open(melt).read()
    low, high = map(float, re.search(r"(\S+) (\S+) xlo xhi", text).groups())
    beads = [line.split() for line in text.split("Atoms # bond")[1].split("Bonds")[0].strip().splitlines()]
    number = random.Random(3)
    place = {int(words[0]): [float(word) for word in words[3:6]] for words in beads}
    frames = []
    for step in range(0, 1500, 100):
        place = {atom: [x + number.uniform(-0.05, 0.05) for x in xyz] for atom, xyz in place.items()}
        solvent = [(1000 + k, [number.uniform(low, high) for _ in range(3)]) for k in range(number.randrange(8))]
        frames.append((step, number.sample(list(place.items()), len(place)) + solvent))
    write_melt_dump(path, frames, high - low)
    return melt, path


def check_melt(checks, command, melt, path, folder):
    """Bonds of a LAMMPS data file, and the column of molecules: the same chains."""
    chains = [(list(range(25 * k + 1, 25 * k + 26)), False) for k in range(12)]
    expected = Contacts(read_dump(path), chains, lambda atom: 0.25, 0.5)
    for topology in (["--topology", melt], []):
        file, report = follow(checks, command, folder, path, "--gap", "0.5", "--radius", "0.25", *topology)
        compare(checks, f"melt {topology}", expected, file, report)
        checks.that(report["atoms"] > report["fewest_atoms"] >= 300 == report["chains"]["beads"], "solvent comes and goes")


def check_choice(checks, command, docs, folder):
    """A folded chain is searched over space after its first frame, a stretched one along the chain; the report says so."""
    path = os.path.join(folder, "chain.lammpstrj")
    for folded, by in ((True, ["wrapped"] + 7 * ["dch"]), (False, 8 * ["wrapped"])):
        write_chain(path, folded)
        frames = read_dump(path)
        expected = Contacts(frames, [(list(range(1, 513)), False)], lambda atom: 0.5, 0.9123456789)
        for threads in ("1", "3"):
            file, report = follow(checks, command, folder, path, "--gap", "0.9123456789", "--radius", "0.5", "--threads", threads)
            compare(checks, f"{'folded' if folded else 'stretched'} chain, {threads} threads", expected, file, report)
            choice = report["choice"]
            checks.that(report["per_frame"]["by"] == by, f"found by {report['per_frame']['by']}")
            checks.that((choice["frames_wrapped"], choice["frames_dch"]) == (by.count("wrapped"), by.count("dch")),
                        f"frames of {choice}")
            checks.that(choice["structure"] == by[-1] and (choice["visited_per_bead"] > 1.8) == folded, f"choice {choice}")
            checks.that(report["structure"]["updates"] == by.count("wrapped") - 1, f"updates of {report['structure']}")
        check_keys(checks, report, docs, {"always"}, "contacts")
        row = f"found by        wrapped hierarchy in {by.count('wrapped')} frame"
        why = "above 1.80: the DCH" if folded else "below 1.40: the wrapped hierarchy"
        table = run(command, "contacts", path, "--gap", "0.9123456789", "--radius", "0.5").stdout
        checks.that(row in table and why in table, f"the table lacks {row!r} or {why!r}: {table}")


def check_torn_chain(checks, command, folder):
    """A bond of half the box is refused with the ids of its atoms in the frame that has it, though the search over space,
    whose turn it is, would not need the bond."""
    path = os.path.join(folder, "torn.lammpstrj")
    write_chain(path, True, frames=3)
    lines = open(path).read().splitlines()
    second = lines.index("1") + 8
    for k in range(second + 200, second + 512):
        atom, molecule, x, y, z = lines[k].split()
        lines[k] = f"{atom} {molecule} {float(x) + 5} {float(y) + 5} {z}"
    with open(path, "w") as file:
        file.write("\n".join(lines) + "\n")
    expect_failure(checks, command, ["contacts", path, "--gap", "0.5", "--radius", "0.5"], 3,
                   [path, "frame 1", "the ids 200 and 201", "half the smallest box height"])


def check_page(checks, command, path, folder):
    page = os.path.join(folder, "contacts.html")
    for options, cards in (([], CARDS), (["--pairs", "between"], [CARDS[0], *CARDS[2:]]),
                           (["--frames", "0"], CARDS[:3]), (["--gap", "0"], CARDS[:3])):
        for option in ("--plot", "--html"):
            result = run(command, "contacts", path, *([] if "--gap" in options else ["--gap", "1"]), option, page, *options)
        checks.that(result.returncode == 0, f"{options}: {result.stderr}")
        text = open(page).read()
        root = ElementTree.fromstring(text.split("\n", 1)[1])  # raises unless all elements are closed
        checks.that([h2.text for h2 in root.iter("h2")] == cards, f"{options}: cards of the page")
        checks.that([len(list(svg)) > 5 for svg in root.iter("svg")] == [True] * len(cards), f"{options}: drawings")
        faults = drawing_faults(root)
        checks.that(not faults, f"{options}: {faults}")
        checks.that(not re.findall(r"http|src=|href=|@import|url\(|<script", text), f"{options}: the page needs others")
        checks.that(not re.search(r"\bnan\b|\binf\b", text), f"{options}: numbers that are none")
        checks.that("melt.lammpstrj" in root.find(".//h1").text, f"{options}: the page's title")
        checks.that(len(text) < 1e6, f"{options}: a page of {len(text)} bytes")


def check_summary(checks, command, path, docs, folder):
    result = run(command, "contacts", path, "--gap", "1", "--out", os.path.join(folder, "contacts.h5"))
    for row in ("chains          12 chains of 25 beads, 300 in all (from molecules of", "frames          15",
                "radii           0 (distances are those of the centers)", "events          ", "P(s)            ",
                "contacts        surfaces at most 1 ", "more than 1 bond between", "data            "):
        checks.that(row in result.stdout, f"the table lacks {row!r}: {result.stdout}")
    print(result.stdout)
    quiet = run(command, "contacts", path, "--gap", "1", "--quiet")
    checks.that((quiet.returncode, quiet.stdout, quiet.stderr) == (0, "", ""), f"--quiet: {quiet}")
    shown = run_example(checks, docs, folder, "contacts.h5", "longest contact")
    checks.that("longest contact" in shown, f"the example: {shown}")


def main(command, data, docs):
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        check_polymer(checks, command, data, docs, folder)
        check_plain_commands(checks, command, data, folder)
        check_long_chain(checks, command, data, folder)
        check_water(checks, command, data, folder)
        melt, path = make_melt(command, folder)
        check_melt(checks, command, melt, path, folder)
        check_choice(checks, command, docs, folder)
        check_torn_chain(checks, command, folder)
        check_page(checks, command, path, folder)
        check_summary(checks, command, path, docs, folder)
        left = [name for name in os.listdir(folder) if "partial" in name or "tmp" in name]
        checks.that(left == [], f"left behind: {left}")
    checks.finish()


if __name__ == "__main__":
    main(*sys.argv[1:])
