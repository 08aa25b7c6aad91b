# SPDX-License-Identifier: MIT
"""dchmd hardspheres: spheres of its frames stay apart and in number, pressures are those of Carnahan and Starling and of
mixtures, restart files go on to the last bit, growth ends where it should, and what does not fit is refused.

    hardspheres.py DCH DOCS
"""

import json
import math
import os
import sys
import tempfile

import h5py
import numpy

from dch_command import Checks, check_keys, expect_failure, run


def collide(checks, command, folder, *options):
    """Runs the command; its report and its table."""
    result = run(command, "hardspheres", *options, "--report", "report.json", cwd=folder)
    checks.that(result.returncode == 0 and result.stderr == "", f"hardspheres {options}: {result.stderr}")
    with open(os.path.join(folder, "report.json")) as file:
        return json.load(file), result.stdout


def state_of(folder, name):
    with open(os.path.join(folder, name)) as file:
        return json.load(file)


def least_gap(positions, radii, edge):
    d = positions[:, None] - positions[None, :]
    d -= edge * numpy.rint(d / edge)
    gaps = numpy.sqrt((d**2).sum(axis=2)) / (radii[:, None] + radii[None, :]) - 1
    return gaps[numpy.triu_indices(len(radii), 1)].min()


def check_frames(checks, command, docs, folder):
    report, table = collide(checks, command, folder, "--spheres", 256, "--fraction", 0.4, "--sizes", "1:3,1.5:1", "--time", 2,
                            "--every", 0.25, "--out", "run.h5", "--restart", "state.json")
    check_keys(checks, report, docs, {"always"}, "hardspheres")
    state = state_of(folder, "state.json")
    radii = numpy.array(state["radii"])
    checks.that(sorted(set(radii)) == [0.5, 0.75] and (radii == 0.75).sum() == 64, "a quarter are large")
    checks.that(numpy.allclose(state["masses"], 8 * radii**3), "masses are cubes of diameters")
    with h5py.File(os.path.join(folder, "run.h5")) as file:
        element = next(iter(file["particles"].values()))
        frames, times = element["position/value"][:], element["position/time"][:]
        species = element["species"][:] if isinstance(element["species"], h5py.Dataset) else element["species/value"][0]
    checks.that(numpy.allclose(times, 0.25 * numpy.arange(9)) and report["frames"] == 9, f"frames at {times}")
    checks.that(((species == 2) == (radii == 0.75)).all(), "types by diameter")
    gaps = [least_gap(frame, radii, state["box_edge"]) for frame in frames]
    checks.that(min(gaps) > -1e-6, f"spheres of a frame overlap: {min(gaps)}")
    checks.that(least_gap(numpy.array(state["positions"]), radii, state["box_edge"]) > -1e-12, "spheres at the end overlap")
    momentum = (numpy.array(state["masses"])[:, None] * numpy.array(state["velocities"])).sum(axis=0)
    checks.that(abs(momentum).max() < 1e-10, f"momentum {momentum}")
    checks.that(abs(report["energy_drift"]) < 1e-12 and report["least_gap"] > -1e-12, f"{report['energy_drift']}")
    checks.that(sum(report["blocks"]["collisions"]) == report["collisions"] and report["end"] == 2, "blocks")
    fraction = (math.pi / 6 * (2 * radii) ** 3).sum() / state["box_edge"] ** 3
    checks.that(abs(fraction / 0.4 - 1) < 1e-12 and abs(report["fraction"] / 0.4 - 1) < 1e-12, f"fraction {fraction}")
    for part in ("256 of diameters 1 to 1.5", "BMCSL", "us a collision", "run.h5", "state.json"):
        checks.that(part in table, f"the table lacks {part!r}: {table}")


def check_pressures(checks, command, folder):
    for options, formula in ((["--spheres", 864, "--fraction", 0.3], (1 + 0.3 + 0.09 - 0.027) / 0.7**3),
                             (["--spheres", 864, "--fraction", 0.45, "--start", "random"],
                              (1 + 0.45 + 0.45**2 - 0.45**3) / 0.55**3)):
        report, _ = collide(checks, command, folder, *options, "--collisions", 300000)
        checks.that(abs(report["expected_pressure"] / formula - 1) < 1e-12, f"{options}: {report['expected_pressure']}")
        checks.that(abs(report["pressure"] / formula - 1) < 0.015, f"{options}: {report['pressure']} is not {formula}")
        checks.that(report["collisions"] == 300000, f"{options}: {report['collisions']} collisions")
    report, _ = collide(checks, command, folder, "--spheres", 500, "--fraction", 0.35, "--sizes", "1:0.9,3:0.1",
                        "--collisions", 200000)
    checks.that(abs(report["pressure"] / report["expected_pressure"] - 1) < 0.05, f"mixture: {report['pressure']}")


def check_restart(checks, command, folder):
    collide(checks, command, folder, "--spheres", 300, "--fraction", 0.4, "--sizes", "1,2", "--collisions", 3000, "--restart",
            "one.json")
    collide(checks, command, folder, "--from", "one.json", "--collisions", 5000, "--restart", "plain.json")
    collide(checks, command, folder, "--from", "one.json", "--collisions", 5000, "--restart", "watched.json", "--every", 0.01,
            "--out", "watched.lammpstrj")
    with open(os.path.join(folder, "plain.json")) as plain, open(os.path.join(folder, "watched.json")) as watched:
        checks.that(plain.read() == watched.read(), "frames change the run")
    checks.that(state_of(folder, "plain.json")["time"] > state_of(folder, "one.json")["time"] > 0, "time goes on")


def check_growth(checks, command, docs, folder):
    report, table = collide(checks, command, folder, "--spheres", 108, "--fraction", 0.3, "--jam", 1e5, "--growth", 0.5,
                            "--restart", "jammed.json")
    check_keys(checks, report, docs, {"always", "jam"}, "hardspheres")
    jam = report["jam"]
    checks.that(jam["is_jammed"] and jam["pressure"] > 1e5 and 0.58 < jam["fraction"] < 0.7405, f"jam {jam}")
    checks.that("jammed" in table and report["pressure"] is None, f"table {table}")
    state = state_of(folder, "jammed.json")
    gap = least_gap(numpy.array(state["positions"]), numpy.array(state["radii"]), state["box_edge"])
    checks.that(-1e-12 < gap < 1e-3, f"gap of jammed spheres {gap}")
    report, _ = collide(checks, command, folder, "--from", "jammed.json", "--collisions", 1000)
    checks.that(report["pressure"] > 1e4, f"jammed spheres go on: {report['pressure']}")


def check_few(checks, command, folder):
    """Spheres of which none collide: a run takes as long as it is told, growth ends, and no collision is waited for."""
    one = state_of(folder, "one.json")
    parts = ("radii", "masses", "positions", "velocities")
    for name, state in (("none.json", {part: [] for part in parts}), ("single.json", {part: one[part][:1] for part in parts}),
                        ("alike.json", {"velocities": [[1, 0, 0]] * len(one["radii"])})):
        with open(os.path.join(folder, name), "w") as file:
            json.dump({**one, **state}, file)
        report, _ = collide(checks, command, folder, "--from", name, "--time", 1)
        checks.that(report["collisions"] == 0 and report["pressure"] in (None, 1), f"{name}: {report}")
        expect_failure(checks, command, ["hardspheres", "--from", os.path.join(folder, name), "--collisions", "5"], 2,
                       ["--collisions 5", "never collide", "--time"])
    with open(os.path.join(folder, "late.json"), "w") as file:
        json.dump({**one, "time": 1e20}, file)
    expect_failure(checks, command, ["hardspheres", "--from", os.path.join(folder, "late.json"), "--collisions", "5", "--every",
                                     "0.1", "--out", "run.h5"], 2, ["--every 0.1", "rounding"])
    with open(os.path.join(folder, "passing.json"), "w") as file:
        json.dump({**one, "box_edge": 4, "radii": [0.5, 0.25], "masses": [], "positions": [[1, 1, 1], [3, 2, 0.5]],
                   "velocities": [[1, 0, 0], [-1, 0, 0]]}, file)
    expect_failure(checks, command, ["hardspheres", "--from", os.path.join(folder, "passing.json"), "--collisions", "5"], 2,
                   ["nothing collides", "--time"])
    with open(os.path.join(folder, "fast.json"), "w") as file:
        json.dump({**one, "velocities": [[1e40, 0, 0], *one["velocities"][1:]]}, file)
    for length in (["--time", "1"], ["--jam", "10"]):
        expect_failure(checks, command, ["hardspheres", "--from", os.path.join(folder, "fast.json"), *length], 2,
                       ["edges of the box", "slower spheres"])
    report, _ = collide(checks, command, folder, "--from", "none.json", "--jam", 10)
    checks.that(report["spheres"] == 0 and not report["jam"]["is_jammed"], f"nothing grows: {report}")


def check_usage(checks, command):
    begin = ["--spheres", "64", "--fraction", "0.4"]
    for options, parts in (([], ["--spheres and --fraction are required", "--from"]), (begin, ["--time, --collisions or --jam"]),
                           ([*begin, "--time", "1", "--collisions", "5"], ["--time and --collisions"]),
                           (["--spheres", "0", "--fraction", "0.4", "--time", "1"], ["--spheres '0'", "from 1"]),
                           (["--spheres", "64", "--fraction", "0", "--time", "1"], ["--fraction 0", "above 0"]),
                           (["--spheres", "64", "--fraction", "nan", "--time", "1"], ["--fraction 'nan'"]),
                           (["--spheres", "64", "--fraction", "1.2", "--time", "1"], ["--fraction 1.2", "at most 1"]),
                           (["--spheres", "64", "--fraction", "0.75", "--time", "1"], ["--fraction 0.75", "0.7405"]),
                           (["--spheres", "100", "--fraction", "0.73", "--growth", "5", "--time", "1"],
                            ["--fraction 0.73", "jammed at 0.", "slower growth"]),
                           (["--spheres", "2", "--fraction", "0.4", "--time", "1"], ["half the smallest height", "more of"]),
                           ([*begin, "--time", "1", "--sizes", "1,x"], ["--sizes 'x'"]),
                           ([*begin, "--time", "1", "--sizes", "1:0"], ["--sizes 0", "share"]),
                           ([*begin, "--time", "1", "--sizes", "-1"], ["--sizes -1", "above 0"]),
                           ([*begin, "--time", "1", "--start", "bcc"], ["--start 'bcc'", "lattice, random"]),
                           ([*begin, "--time", "1", "--restitution", "1.5"], ["--restitution 1.5", "at most 1"]),
                           ([*begin, "--time", "1", "--restitution", "0"], ["--restitution 0", "above 0"]),
                           ([*begin, "--collisions", "1000000", "--restitution", "0.1"],
                            ["collided 20 times", "restitution of 0.1", "nearer to 1"]),
                           ([*begin, "--time", "1", "--out", "run.h5"], ["--out and --every go together"]),
                           ([*begin, "--time", "1", "--every", "0.1"], ["--out and --every go together"]),
                           ([*begin, "--time", "1", "--every", "1e-300", "--out", "run.h5"], ["--every 1e-300", "frames"]),
                           ([*begin, "--time", "-1"], ["--time -1", "above 0"]),
                           ([*begin, "--jam", "1"], ["--jam 1", "above 1"]),
                           ([*begin, "--time", "1", "--report", "x", "--restart", "x"], ["--restart and --report", "same file"]),
                           (["--from", "x", "--spheres", "3", "--time", "1"], ["leave --spheres"])):
        expect_failure(checks, command, ["hardspheres", *options], 2, parts)


def check_bad_files(checks, command, folder):
    path = os.path.join(folder, "bad.json")
    good = state_of(folder, "one.json")
    overlapping = {**good, "radii": [2 * r for r in good["radii"]]}
    for text, part in (("", "bad.json"), ("{", "no restart file"), ("[1, 2]", "no restart file"),
                       ("{\"kind\": \"other\", \"schema\": 1}", "\"kind\": \"dchmd hardspheres\""),
                       (json.dumps({**good, "radii": good["radii"][1:]}), "299 radii for 300 positions"),
                       (json.dumps({**good, "masses": good["masses"][1:]}), "299 masses for 300 spheres"),
                       (json.dumps({**good, "box_edge": -1}), "bad.json"), (json.dumps({**good, "positions": [[1, 2]] * 300}), "bad.json"),
                       (json.dumps(overlapping), "overlap")):
        with open(path, "w") as file:
            file.write(text)
        expect_failure(checks, command, ["hardspheres", "--from", path, "--time", "1"], 3, [path, part])
    expect_failure(checks, command, ["hardspheres", "--from", os.path.join(folder, "none"), "--time", "1"], 3, ["none"])


def main(command, docs):
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        check_frames(checks, command, docs, folder)
        check_pressures(checks, command, folder)
        check_restart(checks, command, folder)
        check_growth(checks, command, docs, folder)
        check_few(checks, command, folder)
        check_bad_files(checks, command, folder)
    check_usage(checks, command)
    checks.finish()


if __name__ == "__main__":
    main(*sys.argv[1:])
