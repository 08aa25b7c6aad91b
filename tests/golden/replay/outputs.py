# SPDX-License-Identifier: MIT
"""What the command writes: report.json against its documentation, report.html, lists.h5, conversions, tables.

    outputs.py DCH FOLDER_OF_TRAJECTORIES DOCS
"""

import json
import os
import re
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

from dch_command import Checks, check_keys, info, replay, run, run_example
from drawings import drawing_faults

SVG_CARDS = ["Pairs", "Cost of a frame", "Repairs", "Neighbors of an atom", "Levels"]


def check_report(checks, command, data, docs):
    polymer = os.path.join(data, "polymer.lammpstrj")
    result, report = replay(command, polymer, "--cutoff", "10", "--frames", "::4", "--verify", "all", "--exclude", "1-3")
    checks.that(result.returncode == 0, f"replay: {result.stderr}")
    check_keys(checks, report, docs, {"always", "dch"})
    checks.that(report["frames"] == 11 and report["frames_read"] == 42, "frames selected and read")
    checks.that(report["per_frame"]["frame"] == list(range(0, 42, 4)), "numbers of the frames")
    lengths = {len(values) for values in report["per_frame"].values()} | {len(report["pairs_per_frame"])}
    checks.that(lengths == {11}, f"lists of one entry a frame: {lengths}")
    checks.that(report["atoms"] == 1714 and report["unit"] and report["exclude"]["pairs"] > 0, "atoms, unit, exclusions")
    checks.that(report["refreshes"] + report["repairs"] + report["rebuilds"] == report["list_rebuilds"] == 11,
                "one refresh, repair or build a list")
    checks.that(report["level_sizes"][0]["nodes"] == 1714 and len(report["level_sizes"]) == report["levels"], "levels")
    atoms = sum(report["degree_histogram"])
    neighbors = sum(k * count for k, count in enumerate(report["degree_histogram"]))
    checks.that(atoms == 11 * 1714 and neighbors == 2 * sum(report["pairs_per_frame"]), "degree histogram")
    checks.that(report["verify"]["structure_checks"] == 11, "hierarchies checked")
    result, report = replay(command, polymer, "--cutoff", "10", "--frames", "3", "--engine", "cell")
    check_keys(checks, report, docs, {"always"})
    checks.that(report["verify"]["mode"] == "none" and report["per_frame"]["frame"] == [3], "one frame")
    result, report = replay(command, polymer, "--cutoff", "10", "--frames", "3", "--engine", "grid")
    check_keys(checks, report, docs, {"always", "grid"})
    result, report = replay(command, polymer, "--cutoff", "10", "--frames", "3", "--engine", "auto", "--threads", "2")
    check_keys(checks, report, docs, {"always", "auto", report["choice"].split(":")[0]})
    checks.that(re.fullmatch(r"(grid|dch): [0-9.]+ points a cell, spread [0-9.]+", report["choice"]) is not None,
                f"the choice: {report['choice']}")
    checks.that(report["choice"] in result.stdout, "the choice is in the table")


def check_sample(checks, command, data):
    result, report = replay(command, os.path.join(data, "polymer.lammpstrj"), "--cutoff", "10", "--verify", "sample")
    verify = report["verify"]
    checks.that(len(verify["frames"]) == 10 and verify["frames"][0] == 0 and verify["frames"][-1] == 41,
                f"frames sampled: {verify['frames']}")
    checks.that(verify["rows"] == 10000, f"rows sampled: {verify['rows']}")
    checks.that(str(verify["seed"]) in result.stdout, "the seed is printed")


def check_page(checks, command, data, folder):
    page = os.path.join(folder, "report.html")
    for engine, cards in (("dch", SVG_CARDS), ("cell", [SVG_CARDS[0], SVG_CARDS[1], SVG_CARDS[3]])):
        for name, cutoff in (("water.trr", "0.4"), ("triclinic-namd.dcd", "5"), ("cell_shapes.xtc", "0.05")):
            result = run(command, "replay", os.path.join(data, name), "--cutoff", cutoff, "--engine", engine,
                         "--plot", page)
            checks.that(result.returncode == 0, f"{name}: {result.stderr}")
            text = open(page).read()
            root = ElementTree.fromstring(text.split("\n", 1)[1])  # raises unless all elements are closed
            checks.that([h2.text for h2 in root.iter("h2")] == cards, f"{name}, {engine}: cards of the page")
            checks.that(len(list(root.iter("svg"))) == len(cards), f"{name}, {engine}: drawings of the page")
            faults = drawing_faults(root)
            checks.that(not faults, f"{name}, {engine}: {faults}")
            for svg in root.iter("svg"):
                checks.that(len(list(svg)) > 5, f"{name}, {engine}: an empty drawing")
            outside = re.findall(r"http|src=|href=|@import|url\(", text)
            checks.that(not outside, f"{name}: the page refers to {outside}")
            checks.that(name in root.find(".//h1").text, f"{name}: the page's title")


def check_lists(checks, command, data, docs, folder):
    """lists.h5 holds the pairs of the report, and the example of cli.md reads it."""
    import h5py

    for name, cutoff, skin in (("water.trr", "0.35", "0.08"), ("detect_best_pos_repr.lammpstrj", "9", "0"),
                               ("cell_shapes.trr", "0.04", "0")):
        kinds = {}
        for kind in ("half", "full"):
            result, report = replay(command, os.path.join(data, name), "--cutoff", cutoff, "--skin", skin, "--" + kind,
                                    "--out", os.path.join(folder, "lists.h5"))
            checks.that(result.returncode == 0, f"{name}: {result.stderr}")
            with h5py.File(os.path.join(folder, "lists.h5")) as file:
                checks.that(file.attrs["kind"] == kind and file.attrs["unit"] == report["unit"] and
                            file.attrs["cutoff"] == float(cutoff) and file.attrs["skin"] == float(skin),
                            f"{name}: attributes {dict(file.attrs)}")
                checks.that(file["frame"][:].tolist() == report["per_frame"]["frame"], f"{name}: frames")
                checks.that(file["step"][:].tolist() == report["per_frame"]["step"], f"{name}: steps")
                kinds[kind] = pairs_of(file)
            expected = [count * (2 if kind == "full" else 1) for count in report["pairs_per_frame"]]
            checks.that([len(frame) for frame in kinds[kind]] == expected, f"{name}: pairs of {kind} lists")
        doubled = [sorted(frame + [(b, a) for a, b in frame]) for frame in kinds["half"]]
        checks.that(doubled == [sorted(frame) for frame in kinds["full"]], f"{name}: half and full lists differ")
    run(command, "replay", os.path.join(data, "water.trr"), "--cutoff", "0.4", "--out", os.path.join(folder, "lists.h5"))
    shown = run_example(checks, docs, folder, "lists.h5", "has the neighbors")
    checks.that("has the neighbors [" in shown, f"the example: {shown}")


def pairs_of(file):
    """Pairs of ids of each frame of a file of lists."""
    frames = []
    for first, ids in zip(file["first"][:], file["ids"][:]):
        entries = file["j"][first[0]:first[-1]]
        frames.append([(int(ids[i]), int(ids[j])) for i in range(len(first) - 1)
                       for j in entries[first[i] - first[0]:first[i + 1] - first[0]]])
    return frames


def check_convert(checks, command, data, folder):
    """A trajectory converted and converted back gives the same lists."""
    for name, cutoff in (("polymer.lammpstrj", "8"), ("triclinic-namd.dcd", "5"), ("nopbc.dcd", "5"), ("water.trr", "0.4")):
        source = os.path.join(data, name)
        _, original = replay(command, source, "--cutoff", cutoff, "--frames", "0:8:2")
        for target in ("out.h5", "out.lammpstrj"):
            path = os.path.join(folder, target)
            result = run(command, "convert", source, path, "--frames", "0:8:2")
            checks.that(result.returncode == 0, f"convert {name} {target}: {result.stderr}")
            facts = info(command, path)
            checks.that(facts["frames"] == original["frames"] and facts["atoms"] == original["atoms"],
                        f"convert {name} {target}: {facts}")
            _, report = replay(command, path, "--cutoff", cutoff, "--verify", "sample")
            same = report is not None and report["pairs_per_frame"] == original["pairs_per_frame"]
            checks.that(same, f"convert {name} {target}: pairs differ")
            print(f"{name} -> {target}: the same {original['pairs']}", flush=True)


def check_generate(checks, command, folder):
    paths = [os.path.join(folder, name) for name in ("a.data", "b.data", "c.data")]
    for path, seed in zip(paths, ("5", "5", "6")):
        result = run(command, "generate", "melt", "--chains", "20", "--beads", "30", "--density", "0.8", "--seed", seed, path)
        checks.that(result.returncode == 0, f"generate: {result.stderr}")
    contents = [open(path).read() for path in paths]
    checks.that(contents[0] == contents[1] != contents[2], "the seed decides")
    checks.that("600 atoms" in contents[0] and "580 bonds" in contents[0], "atoms and bonds of the melt")


def check_excluded_bonds(checks, command, folder):
    """Of a straight chain of five atoms, 1 apart, 1-2, 1-3 and 1-4 neighbors go away, from each kind of topology."""
    path = os.path.join(folder, "chain.lammpstrj")
    with open(path, "w") as file:
        file.write("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n5\nITEM: BOX BOUNDS ff ff ff\n0 9\n0 9\n0 9\n"
                   "ITEM: ATOMS id mol x y z\n" + "".join(f"{k} 1 {k} 0 0\n" for k in (1, 2, 3, 4, 5)))
    topologies = {"pairs.bonds": "1 2\n3 2\n3 4\n4 5\n", "one.chains": "1 2 3 4 5\n"}
    for name, content in topologies.items():
        with open(os.path.join(folder, name), "w") as file:
            file.write(content)
    for what, pairs in (("bonded", 6), ("1-2", 6), ("1-3", 3), ("1-4", 1)):
        for topology in [[]] + [["--topology", os.path.join(folder, name)] for name in topologies]:
            _, report = replay(command, path, "--cutoff", "4.5", "--exclude", what, "--verify", "all", *topology)
            checks.that(report is not None and report["pairs_per_frame"] == [pairs] and report["mismatches"] == 0,
                        f"--exclude {what} {topology}: {report and report['pairs_per_frame']}")


def check_quiet_and_table(checks, command, data):
    water = os.path.join(data, "water.trr")
    result = run(command, "replay", water, "--cutoff", "0.4", "--quiet", "--verify", "all")
    checks.that((result.returncode, result.stdout, result.stderr) == (0, "", ""), f"--quiet: {result}")
    result = run(command, "replay", water, "--cutoff", "0.4", "--verify", "all")
    for row in ("unit of length  nm", "frames          100", "atoms           297", "box             orthorhombic ppp",
                "pairs a frame   min", "repair", "promotions", "demotions", "levels", "ms a frame      read",
                "mismatches      0"):
        checks.that(row in result.stdout, f"the table lacks {row!r}: {result.stdout}")


def main(command, data, docs):
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        check_report(checks, command, data, docs)
        check_sample(checks, command, data)
        check_page(checks, command, data, folder)
        check_lists(checks, command, data, docs, folder)
        check_convert(checks, command, data, folder)
        check_generate(checks, command, folder)
        check_excluded_bonds(checks, command, folder)
        check_quiet_and_table(checks, command, data)
        left = [name for name in os.listdir(folder) if "partial" in name or "tmp" in name]
        checks.that(left == [], f"left behind: {left}")
    checks.finish()


if __name__ == "__main__":
    main(*sys.argv[1:])
