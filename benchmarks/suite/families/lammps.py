# SPDX-License-Identifier: MIT
"""Whole runs of LAMMPS with its own lists and with ours."""

import os

from ..record import Measurement, Plot, Result

NAME = "lammps"
TITLE = "Runs of LAMMPS"
HOSTS = ("LAMMPS",)
STOCK = "stock"


def run(suite):
    suite.program("lammps_pair_style", "dch.lmp")
    result = Result(checked="Energies at step 0 were compared with those of stock LAMMPS in every run.")
    cases = suite.pick(tiny=["lj"], quick=["lj", "chain"],
                       full=["lj", "lj20", "chain", "eam", "peptide", "colloid", "colloid50", "colloids50", "granular"])
    if "chain" in cases and not suite.has_trajectory("chain32k.data"):
        cases.remove("chain")
        result.left_out.append("chain: make_trajectories chain32k makes its data file")
    words = ["/usr/bin/python3", suite.script("lammps", "loops"), *cases, "--build", suite.build,
             "--processor", suite.processor, "--rounds", suite.pick(tiny=1, quick=5, full=5),
             "--chain", os.path.join(suite.trajectories, "chain32k.data")]
    if suite.size == "tiny":
        words += ["--set", "cells", "5", "--set", "steps", "10"]
    if suite.size == "quick":
        words += ["--set", "steps", "60", "--variants", "dch lists;suffix dch, double;suffix dch, mixed"]
    for case, variants in suite.run_for_json(words).items():
        for variant, seconds in variants.items():
            for section in ("loop", "Neigh", "Pair", "Modify"):
                baseline = variants[STOCK][section]
                against = {} if variant == STOCK or min(baseline) == 0 else {"baseline": STOCK,
                                                                             "baseline_values": baseline}
                result.measurements.append(Measurement(f"{case}, {section}", variant, "s", seconds[section], **against))
    series = {}
    for m in result.measurements:
        if m.baseline:
            series.setdefault(m.name, []).append([m.scene, m.facts()["ratio"]["median"]])
    result.plots.append(Plot("Runs with our lists and forces over stock LAMMPS", "time over stock", "", series, kind="dots"))
    return result
