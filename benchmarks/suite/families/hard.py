# SPDX-License-Identifier: MIT
"""Hard cases for numerical stability: what is expected, and what came out."""

from ..record import Result, Table

NAME = "hard"
TITLE = "Hard cases"
HOSTS = ()


def run(suite):
    words = [suite.program("benchmarks", "hard", "dch_hard_cases"),
             "--repairs", suite.pick(tiny=1000, quick=100000, full=100000),
             "--most-beads", suite.pick(tiny=512, quick=65536, full=65536)]
    rows = suite.run_for_json(words)
    return Result(
        checked=f"All {len(rows)} cases came out as expected; else the program fails. Lists were compared with all pairs in "
                "long double, by code that shares nothing with the library.",
        tables=[Table("Hard cases", ["", "case", "expected", "came out", "passed"],
                      [[r["area"], r["case"], r["expected"], r["found"], r["passed"]] for r in rows],
                      "A pair at the radius to rounding is one that double precision may put on either side.")])
