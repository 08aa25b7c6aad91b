#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Random scripts on one to four processes: the same thermo output as stock LAMMPS, the same errors, and every build
verified. A script that is wrong is written to the folder of the test, with the number that makes it.
"""

import argparse
import random
import re
import sys
from collections import Counter

from batches import Runner, error_in
from lammps_run import Host, thermo_tables
from random_pairs import SW, TABLES
from random_scripts import Script

TOLERANCE = 1e-7
HOTTEST = 1e3  # beyond this temperature atoms overlap, and rounding grows without bounds
MODES = {"lists": ("off", ""), "lists, verified": ("off", "dch verify yes\n"), "forces": ("dch", ""),
         "forces and lists, verified": ("dch", "dch verify yes\n")}


def difference(native, ours):
    """The largest difference in any column of any line, in terms of the largest number of that column in its table;
    numbers that both have as not a number are equal."""
    worst, where = 0.0, ""
    for table, other in zip(native, ours):
        if len(table) != len(other):
            return float("inf"), f"{len(table)} lines, ours {len(other)}"
        for column in table[0] if table else ():
            scale = max((abs(line[column]) for line in table if abs(line[column]) < 1e300), default=0) or 1.0
            for a, b in zip(table, other):
                x, y = a[column], b[column]
                if x == y or x != x and y != y:
                    continue
                d = abs(x - y) / scale
                if not d <= worst:
                    worst, where = (d if d == d else float("inf")), f"{column} at step {a['Step']:g}: {x} for {y}"
    return worst, where


def wrong(stock, output):
    native, ours = thermo_tables(stock), thermo_tables(output)
    if len(native) != len(ours):
        return f"{len(native)} runs, ours {len(ours)}"
    worst, where = difference(native, ours)
    return f"thermo output differs by {worst:.3g}, {where}" if worst > TOLERANCE else ""


def cause(output):
    """An error without numbers and the place in LAMMPS's sources: each process may be the first to say it of its atoms."""
    error = re.search(r"^ERROR.*", output, re.MULTILINE)
    return re.sub(r" \(src.*| on proc \d+|\d", "", error[0]).strip() if error else "no message"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    Host.add_arguments(parser)
    parser.add_argument("--scripts", type=int, default=1000)
    parser.add_argument("--first", type=int, default=1, help="number of the first script")
    parser.add_argument("--processes", type=int, nargs="+", default=(1, 2, 3, 4))
    parser.add_argument("--show", action="store_true", help="print the script of --first, and end")
    arguments = parser.parse_args()
    if arguments.show:
        print(Script(arguments.first).text("dch", "dch on\n"))
        return
    host = Host(arguments)
    (host.work / "random.sw").write_text(SW)
    (host.work / "random.table").write_text(TABLES)
    runner = Runner(host, runs_a_process=20)
    counts, messages = Counter(), []
    scripts = {seed: Script(seed) for seed in range(arguments.first, arguments.first + arguments.scripts)}
    if host.has_long_ids:  # of the partners that these fixes make anew LAMMPS copies half then: pairs are no longer mutual
        scripts = {seed: script for seed, script in scripts.items() if not re.search("bond/(break|create) ", script.text("off"))}
    for ranks in arguments.processes:
        mine = {seed: script for seed, script in scripts.items() if script.ranks == ranks}
        stock, refused = runner.run({seed: script.text("off") for seed, script in mine.items()}, ranks, "")
        runs = {}
        for seed, script in mine.items():
            for mode in random.Random(seed).sample(sorted(MODES), 2):
                suffix, before = MODES[mode]
                runs[seed, mode] = script.text(suffix, f"dch precision double\n{before}dch on\n") + "dch stats\n"
        done, failed = runner.run(runs, ranks, "include ${load}\n")
        for seed, mode in runs:
            message = output = ""
            if seed in refused and "neighbor bins" in refused[seed]:
                counts["hot"] += 1  # lists of ours need no bins
            elif seed in refused:
                counts["refused"] += 1
                output = failed.get((seed, mode), done.get((seed, mode)))
                if (seed, mode) in done:
                    message = f"stock LAMMPS ends with {cause(refused[seed])}, ours goes on"
                elif cause(output) != cause(refused[seed]):
                    message = f"stock LAMMPS ends with {cause(refused[seed])}, ours with {cause(output)}"
            elif any(not line["Temp"] < HOTTEST for table in thermo_tables(stock[seed]) for line in table):
                counts["hot"] += 1
            elif (seed, mode) in failed:
                output = failed[seed, mode]
                message = error_in(output)
            else:
                output = done[seed, mode]
                message = wrong(stock[seed], output)
            counts["runs"] += 1
            for builds, pairs in re.findall(r"verified +(\d+) builds, (\d+) pairs, all equal", output):
                counts["builds"] += int(builds)
                counts["pairs"] += int(pairs)
            if message:
                messages.append(f"script {seed}, {ranks} processes, {mode}: {message}")
                (host.work / f"in.random.{seed}").write_text(runs[seed, mode])
                (host.work / f"out.random.{seed}").write_text(output)
    for message in messages:
        print(message)
    print(f"{len(scripts)} scripts, {counts['runs']} runs in {runner.processes} processes, {counts['refused']} of them of "
          f"scripts that LAMMPS refuses, {counts['hot']} of atoms that fly apart, "
          f"{counts['builds']} builds and {counts['pairs']} pairs verified, {len(messages)} wrong")
    sys.exit(1 if messages else 0)


if __name__ == "__main__":
    main()
