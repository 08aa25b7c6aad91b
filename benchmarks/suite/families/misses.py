# SPDX-License-Identifier: MIT
"""Pairs that OpenMM's own lists miss in skewed boxes and near faces."""

from ..record import Result, Table
from .openmm import python_of_build

NAME = "misses"
TITLE = "Pairs that native lists miss"
HOSTS = ("OpenMM",)


def run(suite):
    words = ["/usr/bin/python3", suite.script("openmm", "native_misses"),
             "--per-side", suite.pick(tiny=6, quick=8, full=14), "--seeds", suite.pick(tiny=1, quick=2, full=10)]
    report = suite.run_for_json(words, environment=python_of_build(suite))
    rows = [[r["cell"], r["length"], "z = -1e-17" if r["outside"] else "none", r["seed"], r["platform"], r["particles"],
             r["pairs"], r["missed"], r["native_force_error"], r["dch_force_error"]] for r in report["rows"]]
    return Result(
        seed=1, checked="Forces of DCHNonbondedForce agree with those of all pairs in every row; else the script fails.",
        tables=[Table(f"OpenMM {report['openmm']}, cutoff {report['cutoff']}",
                      ["box", "edge", "layer outside", "seed", "platform", "particles", "pairs", "missed by the native list",
                       "error of native forces", "error of DCH forces"], rows,
                      "Pairs are counted by OpenMM, with a CustomNonbondedForce of energy 1; expected are all pairs with all "
                      "images, in double. A missed pair shows in forces by as much as it acts.")])
