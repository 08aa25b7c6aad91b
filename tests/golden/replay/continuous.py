# SPDX-License-Identifier: MIT
"""dchmd replay --continuous against all pairs with NumPy: contacts that no frame shows, those that come and go, where the
box changes or flips, where atoms come and go, on real trajectories; its files; and what cannot be followed.

    continuous.py DCH FOLDER_OF_TRAJECTORIES DOCS
"""

import json
import os
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

import h5py
import numpy

from contact_oracle import read_dump
from dch_command import Checks, check_keys, expect_failure, run, run_example
from drawings import drawing_faults

CARDS = ["Between frames", "How close hidden contacts come", "How long hidden contacts last"]
OUTPUTS = ["--out", "lists.h5", "--report", "report.json", "--plot", "page.html"]


def nearest(d, box):
    return d - box * numpy.rint(d / box)


def contacts_between(before, after, then, now, cutoff):
    """{(i, j): (enters, leaves, closest, shown before, shown after)} by indices, of pairs that do not last, in boxes with
    edges `then` and `now`: images that are near in the middle, for ways short enough that no others matter."""
    fractions = before / then
    image = now * fractions + nearest(after - now * fractions, now)
    found = {}
    for i in range(len(before) - 1):
        d0, d1 = before[i + 1:] - before[i], image[i + 1:] - image[i]
        shift = -numpy.rint((d0 + d1) / (then + now))
        d0, d1 = d0 + shift * then, d1 + shift * now
        w = d1 - d0
        a, b, c = (w * w).sum(axis=1), (d0 * w).sum(axis=1), (d0 * d0).sum(axis=1)
        with numpy.errstate(divide="ignore", invalid="ignore"):
            turn = numpy.where(a > 0, numpy.clip(-b / a, 0, 1), 0)
            closest = numpy.sqrt((((d0 + turn[:, None] * w) ** 2).sum(axis=1)))
            root = numpy.sqrt(numpy.maximum(0, b * b - a * (c - cutoff**2)))
            enters, leaves = numpy.clip((-b - root) / a, 0, 1), numpy.clip((-b + root) / a, 0, 1)
        first, last = numpy.sqrt(c) <= cutoff, numpy.sqrt((d1 * d1).sum(axis=1)) <= cutoff
        for k in numpy.nonzero((closest < cutoff) & ~(first & last))[0]:
            found[i, i + 1 + int(k)] = (0 if first[k] else enters[k], 1 if last[k] else leaves[k], closest[k], first[k], last[k])
    return found


def write_dump(path, frames):
    """@param frames [(ids, positions, bounds)], with lines of the box and the words after BOX BOUNDS in front"""
    with open(path, "w") as file:
        for step, (ids, points, bounds) in enumerate(frames):
            file.write(f"ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF ATOMS\n{len(ids)}\nITEM: BOX BOUNDS {bounds}ITEM: ATOMS id x y z\n")
            file.writelines(f"{atom} {x!r} {y!r} {z!r}\n" for atom, (x, y, z) in zip(ids, points.tolist()))


def cube(edge, low=0.0, periodic="pp pp pp"):
    return f"{periodic}\n" + 3 * f"{low!r} {low + edge!r}\n"


def follow(checks, command, folder, path, *options, verify="all", status=0):
    checked = [] if verify is None else ["--verify", verify]
    result = run(command, "replay", path, "--continuous", *checked, *OUTPUTS, *options, cwd=folder)
    checks.that(result.returncode == status, f"{path} {options}: status {result.returncode}: {result.stderr}")
    with open(os.path.join(folder, "report.json")) as file:
        report = json.load(file)
    checks.that(report["mismatches"] == 0, f"{path} {options}: {report['mismatches']} mismatches: {result.stderr}")
    return report, result.stdout


def rows_of(folder, interval):
    """Contacts of an interval in the HDF5 file: {(i, j): (enters, leaves, closest, hidden)} by ids."""
    with h5py.File(os.path.join(folder, "lists.h5")) as file:
        between = file["between"]
        rows = between["interval"][:] == interval
        columns = [between[name][:][rows].tolist() for name in ("i", "j", "enters", "leaves", "closest", "hidden")]
    return {(i, j): tuple(rest) for i, j, *rest in zip(*columns)}


def compare(checks, what, folder, report, intervals, cutoff):
    """@param intervals [(ids, positions before and after, edges before and after)] of the atoms in both frames"""
    between = report["between"]
    checks.that(between["intervals"] == len(intervals) == between["followed"], f"{what}: {between['intervals']} intervals")
    hidden = come = go = 0
    for number, (ids, before, after, then, now) in enumerate(intervals):
        expected = contacts_between(before, after, then, now, cutoff)
        found = rows_of(folder, number)
        wanted = {(ids[i], ids[j]): row for (i, j), row in expected.items()}
        if not checks.that(found.keys() == wanted.keys(), f"{what}, interval {number}: {found.keys() ^ wanted.keys()}"):
            continue
        for pair, (enters, leaves, closest, first, last) in wanted.items():
            row = found[pair]
            checks.that(numpy.allclose(row[:3], (enters, leaves, closest), 1e-7, 1e-7) and row[3] == (not first and not last),
                        f"{what}, interval {number}, {pair}: {row}, not {wanted[pair]}")
        counts = [sum(not first and not last for *_, first, last in wanted.values()),
                  sum(bool(last) for *_, last in wanted.values()), sum(bool(row[3]) for row in wanted.values())]
        told = [between["per_interval"][key][number] for key in ("hidden", "come", "go")]
        checks.that(told == counts, f"{what}, interval {number}: {told}, not {counts}")
        hidden, come, go = hidden + counts[0], come + counts[1], go + counts[2]
    checks.that((between["hidden"], between["come"], between["go"]) == (hidden, come, go), f"{what}: sums")
    checks.that(between["events"] == 2 * hidden + come + go, f"{what}: events")
    checks.that(sum(between["distance_histogram"]) == sum(between["duration_histogram"]) == hidden, f"{what}: histograms")
    print(f"{what}: {len(intervals)} intervals, {hidden} hidden, {come} come, {go} go", flush=True)
    return hidden


def random_frames(seed, atoms, frames, step, edge):
    """Positions that are wrapped into a cube of which each frame has an edge of its own."""
    generator = numpy.random.default_rng(seed)
    fractions = generator.uniform(0, 1, (atoms, 3))
    for number in range(frames):
        size = edge(number)
        yield numpy.array([size] * 3), (fractions % 1) * size
        fractions = fractions + generator.normal(0, step, fractions.shape) / size


def check_random(checks, command, docs, folder):
    path = os.path.join(folder, "run.lammpstrj")
    for name, edge in (("a box that stays", lambda number: 10.0), ("a box that changes", lambda number: 10 + 0.3 * numpy.sin(number))):
        frames = list(random_frames(7, 200, 6, 0.4, edge))
        ids = 3 * numpy.arange(200) + 7
        write_dump(path, [(ids, points, cube(box[0])) for box, points in frames])
        for options in ([], ["--engine", "grid", "--skin", "0.4"], ["--engine", "allpairs"], ["--threads", "3", "--engine", "auto", "--full"]):
            report, table = follow(checks, command, folder, path, "--cutoff", "0.8", *options)
            hidden = compare(checks, f"{name} {options}", folder, report,
                             [(ids, a, b, then, now) for (then, a), (now, b) in zip(frames, frames[1:])], 0.8)
            checks.that(hidden > 20, f"{name}: {hidden} hidden contacts")
            checks.that(report["verify"]["intervals"] == [0, 1, 2, 3, 4], f"verified {report['verify']['intervals']}")
        selected, _ = follow(checks, command, folder, path, "--cutoff", "0.8", "--frames", "1::2", verify="sample")
        compare(checks, f"{name}, each second frame", folder, selected,
                [(ids, frames[k][1], frames[k + 2][1], frames[k][0], frames[k + 2][0]) for k in (1, 3)], 0.8)
        checks.that(selected["between"]["per_interval"]["next_frame"] == [3, 5], "numbers of frames")
    report, table = follow(checks, command, folder, path, "--cutoff", "0.8")
    check_keys(checks, report, docs, {"always", "dch", "continuous"})
    closest = report["between"]["closest"]
    for word in (f"{report['between']['hidden']} contacts that no frame shows", "closest hidden",
                 f"the ids {closest['i']} and {closest['j']} between frames {closest['frame']} and {closest['next_frame']}",
                 "hidden contacts of 5 intervals", "ms an interval"):
        checks.that(word in table, f"the table lacks {word!r}: {table}")
    page = open(os.path.join(folder, "page.html")).read()
    for card in CARDS:
        checks.that(f"<h2>{card}" in page, f"the page lacks the card {card}")
    faults = drawing_faults(ElementTree.fromstring(page.split("\n", 1)[1]))
    checks.that(not faults, f"the page: {faults}")
    plain = run(command, "replay", path, "--cutoff", "0.8", "--report", "plain.json", "--out", "plain.h5", cwd=folder)
    with open(os.path.join(folder, "plain.json")) as file:
        checks.that("between" not in json.load(file) and "between frames" not in plain.stdout, "nothing was asked for")
    with h5py.File(os.path.join(folder, "plain.h5")) as file:
        checks.that("between" not in file, "nor written")


def check_atoms_that_change(checks, command, folder):
    """Atoms that come and go; bonds that are left out."""
    path = os.path.join(folder, "run.lammpstrj")
    generator = numpy.random.default_rng(11)
    frames = list(random_frames(12, 150, 4, 0.4, lambda number: 8.0))
    kept = [numpy.sort(generator.choice(150, 140, False)) for _ in frames]
    write_dump(path, [(rows + 1, points[rows], cube(8.0)) for rows, (_, points) in zip(kept, frames)])
    report, table = follow(checks, command, folder, path, "--cutoff", "0.9")
    intervals, unmatched = [], 0
    for k in range(3):
        both = numpy.intersect1d(kept[k], kept[k + 1])
        unmatched += len(kept[k]) + len(kept[k + 1]) - 2 * len(both)
        intervals.append((both + 1, frames[k][1][both], frames[k + 1][1][both], frames[k][0], frames[k + 1][0]))
    compare(checks, "atoms that come and go", folder, report, intervals, 0.9)
    checks.that(report["between"]["unmatched_atoms"] == unmatched, f"{report['between']['unmatched_atoms']} unmatched")
    checks.that("in one frame alone" in table, table)
    write_dump(path, [(numpy.arange(1, 151), points, cube(8.0)) for _, points in frames])
    follow(checks, command, folder, path, "--cutoff", "0.9")
    pair = next(pair for pair, row in rows_of(folder, 0).items() if row[3])
    with open(os.path.join(folder, "in.bonds"), "w") as file:
        file.write(f"{pair[0]} {pair[1]}\n")
    follow(checks, command, folder, path, "--cutoff", "0.9", "--exclude", "bonded", "--topology", os.path.join(folder, "in.bonds"))
    checks.that(all(pair not in rows_of(folder, k) for k in range(3)), "a bonded pair is left out")


def check_what_cannot_be_followed(checks, command, folder):
    """Half a box, boxes that jump, and a tilted one that flips."""
    path = os.path.join(folder, "run.lammpstrj")
    ids = [1, 2]
    a, b = numpy.array([[3.0, 5, 5], [5, 5.6, 5]]), numpy.array([[7.0, 5, 5], [5, 5.6, 5]])
    far = numpy.array([[3.0, 5, 5], [0, 5.6, 5]])
    write_dump(path, [(ids, a, cube(10.0)), (ids, b, cube(10.0)), (ids, far, cube(10.0)), (ids, a, cube(12.0)),
                      (ids, b, "pp pp ff\n" + 3 * "0 12\n")])
    report, table = follow(checks, command, folder, path, "--cutoff", "1")
    between = report["between"]
    checks.that(between["per_interval"]["hidden"] == [1, 0, 0, 0] and between["followed"] == 2, f"{between}")
    checks.that(between["per_interval"]["undetermined_atoms"] == [0, 1, 0, 0], f"{between['per_interval']}")
    reasons = between["per_interval"]["undetermined"]
    checks.that(reasons[0] is None and "changes by" in reasons[2] and "orthorhombic ppf" in reasons[3], f"{reasons}")
    for word in ("2 of 4 intervals (the first after frame 2: the box changes by", "1 atom that moved half a box or more"):
        checks.that(word in table, f"the table lacks {word!r}: {table}")
    with h5py.File(os.path.join(folder, "lists.h5")) as file:
        checks.that(file["between/followed"][:].tolist() == [1, 1, 0, 0], "which were followed")
        checks.that(file["between/frames"][:].tolist() == [[0, 1], [1, 2], [2, 3], [3, 4]], "their frames")
    tilted = ["xy xz yz pp pp pp\n0 14.99 4.99\n0 10 0\n0 10 0\n", "xy xz yz pp pp pp\n-4.98 10 -4.98\n0 10 0\n0 10 0\n"]
    write_dump(path, [(ids, a, tilted[0]), (ids, b, tilted[1])])
    report, _ = follow(checks, command, folder, path, "--cutoff", "1")
    checks.that(report["between"]["hidden"] == 1 and report["between"]["followed"] == 1, "a flip is no change")


def check_real(checks, command, data, docs, folder):
    """All real trajectories with two frames or more, verified; one against NumPy."""
    for name, cutoff, options in (("nacl.lammpstrj", "4", ["--verify", "all"]), ("cell_shapes.xtc", "0.3", ["--verify", "all"]),
                                  ("water.trr", "0.3", ["--frames", ":8", "--verify", "all"]),
                                  ("detect_best_pos_repr.lammpstrj", "3", []), ("polymer.lammpstrj", "5", ["--frames", ":3"]),
                                  ("triclinic-namd.dcd", "4", ["--frames", ":2"]), ("withpbc.dcd", "4", ["--frames", ":2"])):
        path = os.path.join(data, name)
        if json.loads(run(command, "info", "--json", path).stdout)["frames"] < 2:
            continue
        report, _ = follow(checks, command, folder, path, "--cutoff", cutoff, *options, verify=None if "--verify" in options else "sample")
        between = report["between"]
        print(f"{name}: {between['hidden']} hidden, {between['come']} come, {between['go']} go, {between['followed']} of "
              f"{between['intervals']} followed, {between['undetermined_atoms']} atoms undetermined", flush=True)
        pairs = report["pairs_per_frame"]
        for k, (come, go) in enumerate(zip(between["per_interval"]["come"], between["per_interval"]["go"])):
            if between["per_interval"]["undetermined"][k] is None and between["per_interval"]["undetermined_atoms"][k] == 0:
                checks.that(pairs[k + 1] - pairs[k] == come - go, f"{name}, interval {k}: {come} come and {go} go")
    frames = read_dump(os.path.join(data, "polymer.lammpstrj"))[:3]
    points = [numpy.array([frame["x"], frame["y"], frame["z"]]).T for frame in frames]
    report, _ = follow(checks, command, folder, os.path.join(data, "polymer.lammpstrj"), "--cutoff", "4", "--frames", ":3", verify="none")
    ids = frames[0]["id"].astype(int).tolist()
    compare(checks, "polymer", folder, report,
            [(ids, points[k], points[k + 1], numpy.array(frames[k]["box"]), numpy.array(frames[k + 1]["box"])) for k in (0, 1)], 4)
    shown = run_example(checks, docs, folder, "lists.h5", "between frames")
    checks.that(len(shown.splitlines()) == report["between"]["hidden"] > 0, f"the example: {shown}")


def check_usage(checks, command, data, folder):
    path = os.path.join(data, "polymer.lammpstrj")
    expect_failure(checks, command, ["replay", path, "--cutoff", "5", "--continuous", "--frames", "3"], 2,
                   [path, "--continuous", "1 frame", "--frames"])
    bad = os.path.join(folder, "bad.lammpstrj")
    write_dump(bad, [([1, 2], numpy.zeros((2, 3)), cube(10.0)), ([1, 2], numpy.array([[1, 1, 1], [1, numpy.nan, 1]]), cube(10.0))])
    expect_failure(checks, command, ["replay", bad, "--cutoff", "1", "--continuous", "--report", "r.json"], 3, [bad, "not finite"])
    expect_failure(checks, command, ["replay", path, "--cutoff", "1e6", "--continuous"], 2, ["half the smallest box height"])


def main(command, data, docs):
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        check_random(checks, command, docs, folder)
        check_atoms_that_change(checks, command, folder)
        check_what_cannot_be_followed(checks, command, folder)
        check_real(checks, command, data, docs, folder)
        check_usage(checks, command, data, folder)
    checks.finish()


if __name__ == "__main__":
    main(*sys.argv[1:])
