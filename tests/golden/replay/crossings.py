# SPDX-License-Identifier: MIT
"""dchmd crossings against the roots of all pairs' cubics in all images: events by frame, bonds, time and place, in
boxes of every kind; undetermined bonds, contacts, exit statuses.

    crossings.py DCH FOLDER_OF_TRAJECTORIES DOCS
"""

import json
import os
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

import h5py
import numpy

from crossing_roots import BOXES, CHAIN, all_crossings, bonds_of_chains, random_chains, wrapped
from dch_command import Checks, check_keys, expect_failure, run
from drawings import drawing_faults
from query import write_dump

OUTPUTS = ["--out", "crossings.h5", "--report", "report.json", "--plot", "page.html"]

def written(frames, cell, folder, bounds):
    """Wrapped into the cell, as a host gives them; the positions read back from the text are those of the test."""
    path = os.path.join(folder, "run.lammpstrj")
    ids = list(range(1, len(frames[0]) + 1))
    write_dump(path, [(ids, wrapped(points, cell)) for points in frames], bounds)
    return path


def ask(checks, command, folder, path, *options, status=0):
    result = run(command, "crossings", path, *OUTPUTS, "--chain-length", CHAIN, *options, cwd=folder)
    checks.that(result.returncode == status and result.stderr == "", f"crossings {path} {options}: {result.stderr}")
    with open(os.path.join(folder, "report.json")) as file:
        return json.load(file), result.stdout


def check_boxes(checks, command, docs, folder):
    for seed, (name, (bounds, cell)) in enumerate(BOXES.items()):
        frames = random_chains(seed, 6, 4, 0.3)
        path = written(frames, cell, folder, bounds)
        expected = all_crossings(frames, cell, bonds_of_chains(len(frames[0])))
        report, table = ask(checks, command, folder, path, "--fail", "--threads", seed + 1, status=1)
        checks.that(len(expected) >= 1, f"{name}: only {len(expected)} crossings to find")
        found = [(e["frame"], tuple(k - 1 for k in e["bond_p"]), tuple(k - 1 for k in e["bond_q"]), e["time"], e["on_p"],
                  e["on_q"], e["sign"]) for e in report["events"]]
        checks.that([e[:3] for e in found] == [e[:3] for e in expected], f"{name}: {found} for {expected}")
        checks.that(numpy.allclose([e[3:] for e in found], [e[3:] for e in expected], 0, 1e-4), f"{name}: times, places, signs")
        checks.that(report["crossings"]["number"] == len(expected) == sum(report["per_frame"]["crossings"]), f"{name}: number")
        checks.that(report["undetermined"] == {"number": 0, "first": None}, f"{name}: {report['undetermined']}")
        checks.that(f"crossings         {len(expected)}" in table or str(len(expected)) in table, f"the table: {table}")
        check_keys(checks, report, docs, {"always", "crossings", "determined"}, "crossings")
        with h5py.File(os.path.join(folder, "crossings.h5")) as file:
            checks.that(file["crossings/frame"][:].tolist() == [e[0] for e in expected], f"{name}: frames of the file")
            checks.that(file["crossings/bond_q"][:].tolist() == [[k + 1 for k in e[2]] for e in expected], f"{name}: bonds")
            checks.that(file["crossings/place"].shape == (len(expected), 3), f"{name}: places")
        page = open(os.path.join(folder, "page.html")).read()
        faults = drawing_faults(ElementTree.fromstring(page.split("\n", 1)[1]))
        checks.that(not faults and "<h2>Crossings" in page, f"the page: {faults}")


def check_undetermined(checks, command, docs, folder):
    """A bead that jumps by half the box; contacts within a thickness."""
    bounds, cell = BOXES["periodic"]
    frames = random_chains(7, 2, 2, 0.01)
    path = written(frames, cell, folder, bounds)
    report, _ = ask(checks, command, folder, path, "--fail", "--thickness", "0.3")
    checks.that(report["contacts"] > 0 and report["crossings"]["number"] == 0, f"contacts: {report['contacts']}")
    frames[1][4] += [4.2, 2.2, 0]  # to the nearest image, of a height of 9
    path = written(frames, cell, folder, bounds)
    report, table = ask(checks, command, folder, path, "--fail", status=1)
    first = report["undetermined"]["first"]
    checks.that(report["undetermined"]["number"] == 2 and first["frame"] == 1 and first["bond"] == [4, 5],
                f"undetermined: {report['undetermined']}")
    checks.that("the bond of the atoms 4 and 5" in table, f"the table: {table}")
    check_keys(checks, report, docs, {"always", "undetermined"}, "crossings")
    ask(checks, command, folder, path)  # without --fail


def check_usage(checks, command, data):
    path = os.path.join(data, "polymer.lammpstrj")
    for options, parts in ((["--thickness", "-1"], ["--thickness -1"]), (["--threads", "0"], ["--threads '0'"]),
                           (["--chain-length", "7", "--frames", "42:"], [path, "frame 42"])):
        expect_failure(checks, command, ["crossings", path, *OUTPUTS, *options], 2, parts)


def main(command, data, docs):
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        check_boxes(checks, command, docs, folder)
        check_undetermined(checks, command, docs, folder)
    check_usage(checks, command, data)
    checks.finish()


if __name__ == "__main__":
    main(*sys.argv[1:])
