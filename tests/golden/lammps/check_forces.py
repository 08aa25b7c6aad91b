#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""One script with a plain pair style and with `suffix dch`: same energies, pressures and forces, atom by atom."""

import argparse
import math
import sys

from lammps_run import SCRIPTS, Host, thermo_tables
from table_files import write_tables

PRESSURES = ("Press", "Pxx", "Pyy", "Pzz", "Pxy", "Pxz", "Pyz")
STEPS = 40  # with lists every 5; the second of three frames is compared, the last one says how large forces are
# By how much differences may grow in half of the steps, trajectories being chaotic, and how large they may become.
LATER_GROWTH, LATER_LARGEST = 1e5, 1e-2


def require(condition, message, output=""):
    if not condition:
        sys.exit(f"FAILED: {message}\n{output}")


def read_frames(path):
    """The frames of a text dump: columns by name, each a list over atoms sorted by ID."""
    frames = []
    with open(path, encoding="ascii") as lines:
        for line in lines:
            if line.startswith("ITEM: NUMBER OF ATOMS"):
                atoms = int(next(lines))
            elif line.startswith("ITEM: ATOMS"):
                names = line.split()[2:]
                rows = [list(map(float, next(lines).split())) for _ in range(atoms)]
                frames.append(dict(zip(names, zip(*rows))))
    return frames


def difference_of_atoms(first, second, typical):
    """Largest difference over the columns, relative to the root mean square of a kind in the frame or a typical one.

    In a perfect lattice, where runs begin, forces are 0 because pairs cancel.
    """
    worst = 0.0
    for kind in ({"fx", "fy", "fz"}, {"c_pa"}, {f"c_sa[{k}]" for k in range(1, 7)}):
        columns = [name for name in first if name in kind]
        if not columns:
            continue
        scale = max(math.sqrt(sum(value * value for name in columns for value in frame[name]) /
                              (len(columns) * len(frame["fx"]))) for frame in (first, typical))
        for name in columns:
            largest = max(abs(a - b) for a, b in zip(first[name], second[name]))
            worst = max(worst, largest / scale if scale > 0 else largest)
    return worst


def difference_of_sums(first, second):
    """Energies relative to themselves, pressures to the largest of them."""
    pressure = max(abs(first[name]) for name in PRESSURES)
    worst = 0.0
    for name, value in first.items():
        if name == "Step":
            continue
        scale = pressure if name in PRESSURES else max(abs(value), abs(second[name]))
        if scale > 0:
            worst = max(worst, abs(value - second[name]) / scale)
    return worst


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    Host.add_arguments(parser)
    parser.add_argument("--case", required=True)
    parser.add_argument("--ranks", type=int, required=True)
    parser.add_argument("--tolerance", type=float, default=1e-10, help="for what differs at the first step")
    parser.add_argument("--expect", action="append", default=[], help="line that the output has to contain")
    parser.add_argument("--tables", action="store_true", help="the case reads pair.table")
    parser.add_argument("--var", nargs=2, action="append", default=[])
    arguments = parser.parse_args()
    host = Host(arguments)
    if arguments.tables:
        write_tables(host.work / "pair.table")
    case = SCRIPTS / f"in.{arguments.case}"
    tables, frames = [], []
    for lists, load in (("stock", "/dev/null"), ("suffix", host.loader)):
        dump = host.work / f"dump.{lists}"
        variables = {"lists": lists, "load": load, "forces": "yes", "dump": dump, "steps": STEPS, **dict(arguments.var)}
        code, output = host.run(arguments.ranks, [host.lmp, "-in", case], variables)
        require(code == 0, f"the {lists} run ended with {code}", output)
        tables.append(thermo_tables(output)[-1])
        frames.append(read_frames(dump))
    for line in arguments.expect:
        require(line in output, f"no line '{line}' in the output", output)
    require(len(frames[0]) == len(frames[1]) >= 3 and len(tables[0]) == len(tables[1]) == len(frames[0]),
            f"{len(frames[0])} and {len(frames[1])} frames, at least 3 are needed", output)
    found = []
    later = min(LATER_GROWTH * arguments.tolerance, LATER_LARGEST)
    for k, allowed in ((0, arguments.tolerance), (1, later)):
        sums = difference_of_sums(tables[0][k], tables[1][k])
        atoms = difference_of_atoms(frames[0][k], frames[1][k], frames[0][-1])
        require(sums <= allowed, f"energies or pressures of frame {k} differ by {sums:.3g}", output)
        require(atoms <= allowed, f"forces of frame {k} differ by {atoms:.3g}", output)
        found += [sums, atoms]
    require(any(abs(value) > 0 for value in frames[0][1]["fx"]), "there are no forces: the case tests nothing")
    print("differences at step 0: sums {:.2g}, atoms {:.2g}; after some steps {:.2g}, {:.2g}".format(*found))


if __name__ == "__main__":
    main()
