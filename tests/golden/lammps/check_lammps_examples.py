#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""LAMMPS's own examples with DCH lists, every list compared with the native one at every rebuild of 100 steps.

Each script of the package lammps-examples runs in a copy of its folder, on 1 and 2 processes, with `dch on` and `dch
verify yes` in front and its runs cut to 100 steps. Fails if any list differs, if a script fails that runs without DCH
lists, or if too few could be compared. --table writes what docs/lammps/examples.md shows.
"""

import argparse
import re
import shutil
import subprocess
import sys
from pathlib import Path

from lammps_run import Host

STEPS = 100
ENOUGH = 40  # scripts with equal lists on 1 and 2 processes
TURN_ON = ["dch styles no", "dch on", "dch verify yes"]  # lists are compared
WORD = r"(\S+)"

# Drive several replicas or another program, or only read what others have written.
NOT_SIMULATIONS = {"COUPLE", "PACKAGES", "SPIN", "message", "neb", "plugins", "prd", "tad", "hyper", "mliap", "python"}


def whole_lines(text):
    """The commands of a script, with continued lines joined."""
    return re.sub(r"&[ \t]*\n", " ", text).splitlines()


def shorten(line):
    line = re.sub(rf"^(\s*run\s+){WORD}(.*)$", lambda m: m[1] + (m[2] if m[2].isdigit() and int(m[2]) < STEPS else str(STEPS))
                  + ("" if "upto" in m[3] else m[3]), line)
    return re.sub(rf"^(\s*minimize\s+\S+\s+\S+\s+){WORD}\s+{WORD}", rf"\g<1>{STEPS} {10 * STEPS}", line)


def edited(text, with_dch):
    """The script with short runs and, if wanted, our commands."""
    lines = ["include ${dch_load}"] + TURN_ON if with_dch else []
    for line in whole_lines(text):
        lines.append(shorten(line))
        if with_dch and re.match(r"\s*(run|minimize)\s", line):
            lines.append("dch stats")
        if with_dch and re.match(r"\s*clear\b", line):
            lines += TURN_ON
    return "\n".join(lines) + "\n"


class Outcome:
    """What one run has shown."""

    def __init__(self, code, output):
        self.output = output
        verified = re.findall(r"verified +(\d+) builds, (\d+) pairs, all equal", output)
        self.builds = sum(int(builds) for builds, _ in verified)
        self.pairs = sum(int(pairs) for _, pairs in verified)
        self.differs = "dch verify: at step" in output
        self.failed = code != 0
        notes = re.findall(r"^  list \d+, (.*?): (DCH|native, .*)$", output, re.MULTILINE)
        self.ours = sorted({name for name, whose in notes if whose == "DCH"})
        self.native = sorted({f"{name}: {whose[8:]}" for name, whose in notes if whose != "DCH"})

    def error(self):
        found = re.findall(r"^ERROR.*?: (.*)$|^ERROR: (.*)$", self.output, re.MULTILINE)
        return (found[0][0] or found[0][1]).split(" (src/")[0] if found else "no message"


def run(host, script, ranks, with_dch, seconds):
    folder = host.work / script.parent.name
    if not folder.exists():
        shutil.copytree(script.parent, folder)
    name = folder / f"{script.name}.{'dch' if with_dch else 'stock'}"
    name.write_text(edited(script.read_text(encoding="utf-8", errors="replace"), with_dch))
    words = [host.lmp, "-in", name.name, "-log", "none", "-var", "dch_load", str(host.loader)]
    if ranks > 1:
        words = [host.mpirun, "--allow-run-as-root", "--oversubscribe", "-np", str(ranks)] + words
    try:
        done = subprocess.run(words, cwd=folder, env=host.environment, timeout=seconds, check=False,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    except subprocess.TimeoutExpired as expired:
        return Outcome(0, (expired.stdout or b"").decode(errors="replace"))
    return Outcome(done.returncode, done.stdout.decode(errors="replace"))


class Row:
    """A line of the table."""

    def __init__(self, host, script, seconds):
        self.name = f"{script.parent.name}/{script.name}"
        self.outcomes = [run(host, script, ranks, True, seconds) for ranks in (1, 2)]
        self.faults = []
        self.remark = ""
        for ranks, outcome in enumerate(self.outcomes, 1):
            if outcome.differs:
                self.faults.append(f"{self.name}, {ranks} processes: lists differ")
            elif outcome.failed:
                stock = run(host, script, ranks, False, seconds)
                if stock.failed:
                    self.remark = f"stock LAMMPS stops as well: {stock.error()}"
                else:
                    self.faults.append(f"{self.name}, {ranks} processes: {outcome.error()}")
        self.is_equal = not self.faults and all(o.pairs > 0 for o in self.outcomes)

    def text(self):
        first, second = self.outcomes
        if self.is_equal:
            whose = "; ".join(first.ours)
            rest = f"; native: {'; '.join(first.native)}" if first.native else ""
            return f"| {self.name} | {first.builds} | {first.pairs} | {second.builds} | {second.pairs} | {whose}{rest} |"
        why = self.remark or "; ".join(first.native) or "no pairwise list is built within the time"
        return f"| {self.name} | | | | | {'**FAILED**' if self.faults else why} |"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    Host.add_arguments(parser)
    parser.add_argument("--table", type=Path, help="file to write the table to")
    parser.add_argument("--only", help="regular expression for names of scripts")
    parser.add_argument("--seconds", type=float, default=200, help="for one run (default 200); what is done by then counts")
    arguments = parser.parse_args()
    host = Host(arguments)
    rows = []
    for script in sorted(arguments.examples.glob("*/in.*")):
        name = f"{script.parent.name}/{script.name}"
        if script.parent.name in NOT_SIMULATIONS or (arguments.only and not re.search(arguments.only, name)):
            continue
        rows.append(Row(host, script, arguments.seconds))
        print(rows[-1].text(), flush=True)
    faults = [fault for row in rows for fault in row.faults]
    equal = sum(row.is_equal for row in rows)
    print(f"{equal} scripts with equal lists on 1 and 2 processes, {len(rows)} looked at, {len(faults)} faults")
    if arguments.table:
        rows.sort(key=lambda row: not row.is_equal)
        arguments.table.write_text("\n".join(row.text() for row in rows) + "\n")
    if faults or (equal < ENOUGH and not arguments.only):
        sys.exit("FAILED: " + "; ".join(faults or [f"only {equal} scripts could be compared"]))


if __name__ == "__main__":
    main()
