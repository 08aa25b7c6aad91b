#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Plants faults in a copy of the tree, and expects scripts/docs or check_site.py to complain of each.

usage: plant_faults.py FOLDER, in the root of the tree; exit status 1 if a fault goes unseen.
"""
import pathlib
import shutil
import subprocess
import sys

ROOT = pathlib.Path.cwd()


def replaced(name, old, new):
    def plant(tree):
        path = tree / name
        text = path.read_text(encoding="utf-8")
        if old not in text:
            sys.exit(f"plant_faults: {name} has no {old!r}")
        path.write_text(text.replace(old, new, 1), encoding="utf-8")

    return plant


ADAPTER = "```{eval-rst}\n.. automodule:: dch.ase\n   :members:\n   :show-inheritance:\n```\n"

# For each site that is made: what is planted, and what the complaint has to say. Doxygen, Sphinx and the check stop one another.
SITES = (
    {
        "a parameter that is not there": (replaced("lib/include/dch/lists/all_pairs.hpp", "/// ", "/// @param speed of points\n/// "),
                                          "speed"),
    },
    {
        "a page that is in no list": (replaced("docs/site/replay.md", "/docs/formats\n", ""),
                                      "formats.md: WARNING: document isn't included in any toctree"),
        "a link to no page": (replaced("docs/install.md", "(python.md)", "(pythons.md)"), "not found: pythons.md"),
        "a link to no heading": (replaced("docs/python.md", "(#bonds-that-cross)", "(#bonds-that-do)"), "not found: #bonds-that-do"),
        "a picture that is not there": (replaced("docs/architecture.md", "data-flow.svg", "data-flaw.svg"), "data-flaw.svg"),
    },
    {
        "headers that are on no page": (replaced("docs/site/api/core.md", "```{public-headers} lib/include/dch/engines\n```\n", ""),
                                        "PairSearch is not on the site"),
        "an adapter that is on no page": (replaced("docs/site/api/python.md", ADAPTER, ""), "dch.ase.NeighborList is not on the site"),
    },
)


def copy_tree(tree):
    shutil.rmtree(tree, ignore_errors=True)
    listed = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], check=True,
                            capture_output=True).stdout.decode()
    for name in filter(None, listed.split("\0")):
        if (ROOT / name).is_file():
            (tree / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / name, tree / name)


def complaint(tree):
    """What is said of a tree, empty if all is in order."""
    for command in ([tree / "scripts" / "docs"], [sys.executable, "-B", tree / "tests" / "docs" / "check_site.py", tree]):
        done = subprocess.run(command, check=False, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        if done.returncode != 0:
            return done.stdout
    return ""


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    unseen = 0
    tree = pathlib.Path(sys.argv[1]) / "tree"
    for faults in SITES:
        copy_tree(tree)
        for plant, _ in faults.values():
            plant(tree)
        said = complaint(tree)
        for fault, (_, expected) in faults.items():
            print(f"{fault}: {'seen' if expected in said else 'not seen in'}", flush=True)
            if expected not in said:
                unseen += 1
                print(said)
    return 1 if unseen else 0


if __name__ == "__main__":
    sys.exit(main())
