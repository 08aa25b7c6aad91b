#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Compares the LAMMPS logs of one script run with its native neighbor lists and with DCH lists.

Prints the last lines of both thermo tables, neighbors per atom, Neigh times and the largest relative differences.
Exit code: 0; 1 if the energies of the first line differ by more than --tolerance; 2 usage; 3 a log that cannot be used.
"""

import argparse
import math
import re
import sys
from dataclasses import dataclass


class LogError(Exception):
    """A log file that cannot be used; the message says why."""


@dataclass
class Run:
    """The last run of a log."""

    columns: list
    rows: list  # thermo lines, as numbers
    text: list  # the same, as printed
    loop_seconds: float
    neigh_seconds: float
    neighbors_per_atom: float
    builds: int


def read_log(path):
    try:
        with open(path, encoding="utf-8", errors="replace") as log:
            text = log.read()
    except OSError as error:
        raise LogError(f"{path}: {error.strerror}") from error
    columns, rows, lines = last_thermo_table(text.splitlines())
    if not rows:
        raise LogError(f"{path}: no thermo output; is this the log of a LAMMPS run?")
    return Run(columns, rows, lines,
               loop_seconds=last_number(path, text, r"^Loop time of (\S+)", "'Loop time of'; did the run end?"),
               neigh_seconds=last_number(path, text, r"^Neigh +\| *\S+ *\| *(\S+)", "'Neigh |'"),
               neighbors_per_atom=last_number(path, text, r"^Ave neighs/atom = (\S+)", "'Ave neighs/atom'"),
               builds=int(last_number(path, text, r"^Neighbor list builds = (\d+)", "'Neighbor list builds'")))


def last_number(path, text, pattern, what):
    found = re.findall(pattern, text, re.MULTILINE)
    if not found:
        raise LogError(f"{path}: no line with {what}")
    return float(found[-1])


def last_thermo_table(lines):
    columns, rows, printed, reading = [], [], [], False
    for line in lines:
        words = line.split()
        if words[:1] == ["Step"]:
            columns, rows, printed, reading = words, [], [], True
        elif line.startswith("Loop time"):
            reading = False
        elif reading and len(words) == len(columns):
            try:
                rows.append([float(word) for word in words])
                printed.append(line.rstrip())
            except ValueError:
                pass  # a warning between the lines of the table
    return columns, rows, printed


def largest_difference(columns, native, dch):
    """(relative difference, column): of two thermo lines, relative to the larger magnitude."""
    worst = (0.0, "")
    for column, a, b in zip(columns, native, dch):
        scale = max(abs(a), abs(b))
        difference = abs(a - b) / scale if scale != 0 else 0.0
        if math.isnan(difference):
            return (difference, column)
        if difference > worst[0]:
            worst = (difference, column)
    return worst


def check_same_output(native, dch):
    if native.columns != dch.columns:
        raise LogError(f"the thermo columns differ: {' '.join(native.columns)} and {' '.join(dch.columns)}")
    if [row[0] for row in native.rows] != [row[0] for row in dch.rows]:
        raise LogError("the thermo tables have different steps; run the same script twice")


def print_comparison(native, dch):
    print("Last thermo lines")
    print("          " + " ".join(native.columns))
    print("  native  " + native.text[-1].strip())
    print("  DCH     " + dch.text[-1].strip())
    print(f"\n{'':24}{'native':>12}{'DCH':>12}{'DCH/native':>12}")
    for name, a, b in (("Neighbors per atom", native.neighbors_per_atom, dch.neighbors_per_atom),
                       ("Neighbor list builds", native.builds, dch.builds),
                       ("Neigh time, s", native.neigh_seconds, dch.neigh_seconds),
                       ("Loop time, s", native.loop_seconds, dch.loop_seconds)):
        ratio = f"{b / a:12.3f}" if a > 0 else f"{'-':>12}"
        print(f"{name:24}{a:12.6g}{b:12.6g}{ratio}")
    print("\nLargest relative difference")
    for name, a, b in (("first", native.rows[0], dch.rows[0]), ("last", native.rows[-1], dch.rows[-1])):
        difference, column = largest_difference(native.columns, a, b)
        where = f" ({column})" if column else ""
        print(f"  {name} line, step {a[0]:g}: {difference:.3g}{where}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("native", help="log of the run with native lists")
    parser.add_argument("dch", help="log of the run with DCH lists")
    parser.add_argument("--tolerance", type=float, default=1e-12,
                        help="largest relative difference allowed in the first thermo line (default %(default)g)")
    arguments = parser.parse_args()
    try:
        native, dch = read_log(arguments.native), read_log(arguments.dch)
        check_same_output(native, dch)
    except LogError as error:
        print(f"compare_runs.py: {error}", file=sys.stderr)
        return 3
    print_comparison(native, dch)
    difference, column = largest_difference(native.columns, native.rows[0], dch.rows[0])
    if not difference <= arguments.tolerance:
        print(f"compare_runs.py: {column} of the first line differs by {difference:.3g}, more than "
              f"{arguments.tolerance:g}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
