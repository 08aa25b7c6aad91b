# SPDX-License-Identifier: MIT
"""The runs of each subcommand that the sweeps beside this file disturb: their inputs, outputs and what is whole."""

import gzip
import json
import os
import shutil
import subprocess

OLD = b"the file that was there before\n"
ATOMS = 12


def write_inputs(command, data, folder):
    """Small files of each kind that the command reads."""
    rows = "".join(f"{k + 1} {1 + k // 6} 1 {k % 6} {2 * (k // 6)} {{z}}\n" for k in range(ATOMS))
    frames = "".join(f"ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF ATOMS\n{ATOMS}\nITEM: BOX BOUNDS pp pp pp\n0 20\n0 20\n0 20\n"
                     f"ITEM: ATOMS id mol type x y z\n" + rows.format(z=0.5 * step) for step in range(2))
    with open(os.path.join(folder, "in.dump"), "w") as file:
        file.write(frames)
    with gzip.open(os.path.join(folder, "in.dump.gz"), "wt") as file:
        file.write(frames)
    with open(os.path.join(folder, "in.chains"), "w") as file:
        file.write("1-6\n7-12\n")
    shutil.copy(os.path.join(data, "cell_shapes.xtc"), os.path.join(folder, "in.xtc"))
    subprocess.run([command, "convert", os.path.join(folder, "in.dump"), os.path.join(folder, "in.h5"), "--quiet"], check=True)


def content(path):
    """What a whole file of its kind holds, apart from times; an exception if it is not whole."""
    if path.endswith(".h5"):
        import h5py

        found = {}
        with h5py.File(path) as file:
            file.visititems(lambda name, item: found.update({name: item[()].tobytes() if hasattr(item, "shape") else None}))
        return found
    with open(path, "rb") as file:
        text = file.read()
    if path.endswith(".json"):
        return sorted(json.loads(text))
    if path.endswith(".html"):
        return text.startswith(b"<!DOCTYPE html>") and text.endswith(b"</html>\n")
    return text


class Subcommand:
    """A run of the command, with arguments whose names of files are replaced by those in a folder."""

    def __init__(self, name, arguments, outputs=()):
        self.name = name
        self.arguments = arguments
        self.outputs = list(outputs)

    def in_folder(self, folder):
        return [os.path.join(folder, word) if word.startswith(("in.", "out.")) else word for word in self.arguments]


SUBCOMMANDS = [
    Subcommand("info of a packed dump", ["info", "in.dump.gz"]),
    Subcommand("info of an XTC file", ["info", "in.xtc"]),
    Subcommand("info of an H5MD file", ["info", "in.h5"]),
    Subcommand("replay", ["replay", "in.dump", "--cutoff", "3", "--verify", "all", "--exclude", "1-3", "--topology", "in.chains",
                          "--out", "out.h5", "--report", "out.json", "--plot", "out.html", "--view", "out.view.html"],
               ["out.h5", "out.json", "out.html", "out.view.html"]),
    Subcommand("replay between frames", ["replay", "in.dump", "--cutoff", "3", "--continuous", "--verify", "all", "--out", "out.h5",
                                         "--report", "out.json", "--plot", "out.html"],
               ["out.h5", "out.json", "out.html"]),
    Subcommand("contacts", ["contacts", "in.dump", "--gap", "2.5", "--topology", "in.chains", "--out", "out.h5",
                            "--report", "out.json", "--plot", "out.html"],
               ["out.h5", "out.json", "out.html"]),
    Subcommand("crossings", ["crossings", "in.dump", "--topology", "in.chains", "--thickness", "0.5", "--out", "out.h5",
                             "--report", "out.json", "--plot", "out.html"],
               ["out.h5", "out.json", "out.html"]),
    Subcommand("query", ["query", "in.dump", "--nearest", "3", "--clusters", "2.5", "--out", "out.h5", "--report", "out.json",
                         "--plot", "out.html"],
               ["out.h5", "out.json", "out.html"]),
    Subcommand("hardspheres", ["hardspheres", "--spheres", "32", "--fraction", "0.2", "--time", "0.2", "--every", "0.1", "--out",
                               "out.h5", "--restart", "out.txt", "--report", "out.json"], ["out.h5", "out.txt", "out.json"]),
    Subcommand("convert to H5MD", ["convert", "in.dump", "out.h5"], ["out.h5"]),
    Subcommand("convert to a dump", ["convert", "in.dump", "out.dump"], ["out.dump"]),
    Subcommand("generate", ["generate", "melt", "--chains", "20", "--beads", "60", "out.data"], ["out.data"]),
]
