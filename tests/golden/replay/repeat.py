# SPDX-License-Identifier: MIT
"""The same replay five times, while other programs keep the processors busy: the same report, but for times and memory,
and the same lists. The report counts builds and repairs: of the gas either is about as much work as the other. The same
contacts five times, on one to three threads: the same events and the same choices of what searched for them.

    repeat.py DCH FOLDER_OF_TRAJECTORIES
"""

import json
import os
import random
import sys
import tempfile

import h5py

from dch_command import Checks, run, write_chain

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "support"))
from busy_processors import load  # noqa: E402

REPEATS = 5
REAL_ONES = (("polymer.lammpstrj", "10"), ("water.trr", "0.4"), ("cell_shapes.trr", "0.05"))
TIMED = ("_ms", "_ns", "seconds", "speed", "per_second")


def without_times(value):
    if isinstance(value, dict):
        return {k: without_times(v) for k, v in value.items() if not any(word in k for word in TIMED)}
    return [without_times(v) for v in value] if isinstance(value, list) else value


def write_gas(path):
    """Atoms that stay for a frame or fly up to some cutoffs far: repairs are put off, done or replaced by builds."""
    number, atoms, edge = random.Random(3), 6000, 12
    positions = [[number.uniform(0, edge) for _ in range(3)] for _ in range(atoms)]
    with open(path, "w") as file:
        for frame in range(24):
            file.write(f"ITEM: TIMESTEP\n{frame}\nITEM: NUMBER OF ATOMS\n{atoms}\nITEM: BOX BOUNDS pp pp pp\n"
                       + f"0 {edge}\n" * 3 + "ITEM: ATOMS id xu yu zu\n")
            file.writelines("%d %.4f %.4f %.4f\n" % (k + 1, *p) for k, p in enumerate(positions))
            step = (0.01, 0.3, 0.7, 2)[frame % 4]
            positions = [[x + number.uniform(-step, step) for x in p] for p in positions]


def contents(path):
    found = {}
    with h5py.File(path, "r") as file:
        file.visititems(lambda name, item: found.update({name: item[()].tobytes()})
                        if isinstance(item, h5py.Dataset) else None)
    return found


def outcome(command, path, cutoff, folder):
    lists, report = os.path.join(folder, "lists.h5"), os.path.join(folder, "report.json")
    result = run(command, "replay", path, "--cutoff", cutoff, "--out", lists, "--report", report)
    if result.returncode != 0:
        raise SystemExit(result.stderr)
    return without_times(json.load(open(report))), contents(lists)


def outcome_of_contacts(command, path, threads, folder):
    found, report = os.path.join(folder, "contacts.h5"), os.path.join(folder, "report.json")
    result = run(command, "contacts", path, "--gap", "0.9", "--radius", "0.5", "--threads", threads, "--out", found,
                 "--report", report)
    if result.returncode != 0:
        raise SystemExit(result.stderr)
    return {**without_times(json.load(open(report))), "threads": 0}, contents(found)


def check_contacts(checks, command, folder):
    path = os.path.join(folder, "chain.lammpstrj")
    for folded in (True, False):
        write_chain(path, folded)
        first = None
        for repeat in range(REPEATS):
            with load(repeat):
                report, found = outcome_of_contacts(command, path, 1 + repeat % 3, folder)
            # Columns of times are those of this run.
            found = {name: values for name, values in found.items() if not any(word in name for word in TIMED)}
            first = first or (report, found)
            checks.that(report == first[0] and found == first[1], f"contacts, folded: {folded}, run {repeat}: others")
            checks.that((report["choice"]["frames_dch"] > 0) == folded and len(found) > 8, f"choice {report['choice']}")


def main(command, data):
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        gas = os.path.join(folder, "gas.lammpstrj")
        write_gas(gas)
        for path, cutoff in ((gas, "1"), *((os.path.join(data, name), cutoff) for name, cutoff in REAL_ONES)):
            name, first = os.path.basename(path), None
            for repeat in range(REPEATS):
                with load(repeat):
                    report, lists = outcome(command, path, cutoff, folder)
                first = first or (report, lists)
                different = [key for key in report if report[key] != first[0][key]]
                checks.that(report == first[0], f"{name}, run {repeat}: other values of {different}")
                checks.that(lists == first[1] and lists, f"{name}, run {repeat}: other lists")
        check_contacts(checks, command, folder)
    checks.finish()


if __name__ == "__main__":
    main(*sys.argv[1:])
