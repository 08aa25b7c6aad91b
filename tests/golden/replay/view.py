# SPDX-License-Identifier: MIT
"""The page of dchmd replay --view holds what the report and the lists of the same run hold, its edges join just the nodes that
are near enough, and what is too much for a page is refused.

    view.py DCH FOLDER_OF_TRAJECTORIES
"""

import itertools
import json
import os
import shutil
import sys
import tempfile

import h5py
import numpy as np

from dch_command import Checks, expect_failure, run
from view_reader import read_view

RUNS = [("water.trr", "0.4", ["--policy", "rebuild"]), ("polymer.lammpstrj", "5", ["--policy", "rebuild", "--frames", "::6"]),
        ("polymer.lammpstrj", "4", ["--exclude", "1-3", "--frames", ":3", "--policy", "rebuild", "--threads", "2"]),
        ("triclinic-namd.dcd", "4", ["--policy", "rebuild", "--frames", ":2"]), ("cell_shapes.xtc", "0.05", ["--engine", "grid"]),
        ("nopbc.dcd", "5", ["--policy", "rebuild"])]


def distances(frame, a, b):
    """Of the nearest images of atoms a and b, arrays of the same shape."""
    places = np.array(frame.places)
    step = places[b] - places[a]
    periods, duals = np.array(frame.facts["periods"]).reshape(-1, 3), np.array(frame.facts["duals"]).reshape(-1, 3)
    step = step - np.round(step @ duals.T) @ periods
    images = [np.array(shift) @ periods for shift in itertools.product((-1, 0, 1), repeat=len(periods))]
    return np.min([np.linalg.norm(step + image, axis=-1) for image in images], axis=0)


def check_frame(checks, frame, what):
    facts = frame.facts
    checks.that(frame.is_whole, f"{what}: numbers are left over")
    checks.that(len(frame.contacts) == facts["contacts"], f"{what}: contacts")
    checks.that([len(edges) for edges in frame.edges[1:]] == [level["edges"] for level in facts["levels"][1:]], f"{what}: edges")
    slack = 4 * max(high - low for low, high in zip(facts["low"], facts["high"])) / 65535
    for i, level in enumerate(facts["levels"]):
        nodes, parents = np.array(frame.nodes[i]), np.array(frame.parents[i])
        if i + 1 < len(facts["levels"]):
            apart = distances(frame, nodes[parents >= 0], np.array(frame.nodes[i + 1])[parents[parents >= 0]])
            checks.that((apart <= level["radius"] + slack).all(), f"{what}: parents of level {i} are far away")
        if i == 0 or len(nodes) > 500:
            continue
        a, b = np.triu_indices(len(nodes), 1)
        apart = distances(frame, nodes[a], nodes[b])
        has = np.zeros((len(nodes), len(nodes)), bool)
        for k, j in frame.edges[i]:
            has[k, j] = True
        near = apart <= level["threshold"]
        sure = abs(apart - level["threshold"]) > slack
        checks.that((has[a, b] == near)[sure].all(), f"{what}: edges of level {i} are not those within {level['threshold']}")


def check_run(checks, command, data, folder, name, cutoff, options):
    page, report, lists = (os.path.join(folder, file) for file in ("view.html", "report.json", "lists.h5"))
    result = run(command, "replay", os.path.join(data, name), "--cutoff", cutoff, "--view", page, "--report", report, "--out", lists,
                 *options)
    what = f"{name}, {cutoff}"
    if not checks.that(result.returncode == 0 and page in result.stdout, f"{what}: {result.stderr}"):
        return
    with open(report) as file:
        report = json.load(file)
    about, frames, content = read_view(page)
    checks.that(content.taken == [] and len(content.scripts) == 3, f"{what}: {content.taken}, {len(content.scripts)} scripts")
    checks.that(about["source"] == name and about["cutoff"] == float(cutoff), f"{what}: {about}")
    for key in ("frame", "step"):
        checks.that([frame.facts[key] for frame in frames] == report["per_frame"][key], f"{what}: {key} of the frames")
    checks.that([len(frame.contacts) for frame in frames] == report["pairs_per_frame"], f"{what}: contacts are not the pairs")
    if "rebuild" in options:
        sizes = [level["nodes"] for level in report["level_sizes"]]
        checks.that([len(nodes) for nodes in frames[-1].nodes] == sizes, f"{what}: nodes, not {sizes}")
    with h5py.File(lists) as file:
        for k, frame in enumerate(frames):
            first, j = file["first"][k], file["j"]
            rows = np.repeat(np.arange(len(first) - 1), np.diff(first))
            pairs = list(zip(rows.tolist(), j[first[0]:first[-1]].tolist()))
            checks.that(frame.contacts == pairs, f"{what}: contacts of frame {k} are not those of lists.h5")
    for frame in frames[:: max(1, len(frames) // 4)]:
        check_frame(checks, frame, f"{what}, frame {frame.facts['frame']}")
    print(f"{what}: {len(frames)} frames, {len(frames[0].contacts)} contacts, nodes", [len(nodes) for nodes in frames[0].nodes],
          "edges", [len(edges) for edges in frames[0].edges], flush=True)


def check_skin(checks, command, data, folder):
    """Contacts are those within the cutoff, whatever the list holds beyond."""
    page, water = os.path.join(folder, "view.html"), os.path.join(data, "water.trr")
    counts = []
    for options in ([], ["--skin", "0.2", "--full"], ["--engine", "allpairs"]):
        run(command, "replay", water, "--cutoff", "0.3", "--view", page, "--frames", ":20", "--quiet", *options)
        counts.append([frame.contacts for frame in read_view(page)[1]])
    checks.that(counts[0] == counts[1] == counts[2] and len(counts[0]) == 20, "contacts depend on skin, kind or engine")


def check_names(checks, command, data, folder):
    """A file name cannot end a script."""
    path, page = os.path.join(folder, "a<!--<script>&'\".dcd"), os.path.join(folder, "view.html")
    shutil.copy(os.path.join(data, "nopbc.dcd"), path)
    result = run(command, "replay", path, "--cutoff", "5", "--view", page)
    checks.that(result.returncode == 0, f"a name with <: {result.stderr}")
    about, frames, content = read_view(page)
    checks.that(about["source"] == os.path.basename(path) and len(frames) > 0 and len(content.scripts) == 3, "a name with <")


def check_refusals(checks, command, data, folder):
    dense = os.path.join(folder, "dense.lammpstrj")
    with open(dense, "w") as file:
        file.write("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2100\nITEM: BOX BOUNDS ff ff ff\n0 9\n0 9\n0 9\nITEM: ATOMS id x y z\n")
        file.writelines(f"{k} {0.001 * k} 1 1\n" for k in range(1, 2101))
    expect_failure(checks, command, ["replay", dense, "--cutoff", "4", "--view", "view.html"], 2,
                   ["view.html: frame 0", "2,203,950 contacts", "2,000,000", "smaller cutoff"])
    water = os.path.join(data, "water.trr")
    for options, status, parts in ((["--view", ""], 2, ["--view: the name of the file is empty"]),
                                   (["--view", "-"], 2, ["--view -", "standard output"]),
                                   (["--view", "same", "--plot", "same"], 2, ["--plot and --view", "same file"]),
                                   (["--view", "no/view.html"], 3, ["no/view.html"]),
                                   (["--view", "/dev/null"], 3, ["/dev/null", "device"])):
        expect_failure(checks, command, ["replay", water, "--cutoff", "0.4", *options], status, parts)
    expect_failure(checks, command, ["replay", water, "--cutoff", "0.4", "--view", "view.html"], 3, ["view.html"],
                   largest_file=1000)


def main(command, data):
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        for name, cutoff, options in RUNS:
            check_run(checks, command, data, folder, name, cutoff, options)
        check_skin(checks, command, data, folder)
        check_names(checks, command, data, folder)
        check_refusals(checks, command, data, folder)
    checks.finish()


if __name__ == "__main__":
    main(*sys.argv[1:])
