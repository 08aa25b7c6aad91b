# SPDX-License-Identifier: MIT
"""How well runs at constant energy keep it, with our forces and with those of the hosts."""

import os
import statistics

from ..record import Measurement, Result
from ..running import Missing
from .openmm import python_of_build

NAME = "drift"
TITLE = "Energy drift"
HOSTS = ("LAMMPS", "OpenMM")
CHECKED = ("Means of the drifts were compared with those of the host's own forces: at most two standard deviations apart at full "
           "size. LAMMPS's lists were compared with native ones during the runs, OpenMM's forces before them.")
# At small sizes runs are so short that means scatter; they only show that the programs end well.
DEVIATIONS = {"tiny": 1000, "quick": 1000, "full": 2}


def run(suite):
    result = Result(seed=1, checked=CHECKED)
    for host in (lammps, openmm):
        try:
            result.measurements += host(suite)
        except Missing as error:
            result.left_out.append(str(error).splitlines()[-1])
    if not result.measurements:
        raise Missing("; ".join(result.left_out))
    return result


def measurements_of(scene, unit, native, drifts, names):
    """The drifts, seed by seed, and how far their means are from that of the native force."""
    deviation = statistics.stdev(drifts[native])
    for key, name in names.items():
        yield Measurement(scene, name, unit, drifts[key])
        if key != native:
            apart = abs(statistics.fmean(drifts[key]) - statistics.fmean(drifts[native])) / deviation
            yield Measurement(scene, f"{name}, from {names[native]}", f"standard deviations of {names[native]}", [apart])


def lammps(suite):
    suite.program("lammps_pair_style", "dch.lmp")
    chains, steps, settle, seeds, verify = suite.pick(tiny=(10, 200, 200, 2, 1), quick=(20, 2000, 1000, 3, 10),
                                                      full=(80, 50000, 2000, 5, 1000))
    words = ["/usr/bin/python3", suite.script("lammps", "drift"), "--build", suite.build,
             "--to", os.path.join(suite.build, "benchmarks", "drift", suite.size), "--chains", chains, "--steps", steps,
             "--settle", settle, "--seeds", seeds, "--verify", verify, "--deviations", DEVIATIONS[suite.size]]
    names = {"stock": "stock", "double": "suffix dch, double", "mixed": "suffix dch, mixed"}
    return list(measurements_of("LAMMPS, Kremer-Grest melt", "epsilon/atom/step", "stock", suite.run_for_json(words), names))


def openmm(suite):
    cells, picoseconds, settle, seeds = suite.pick(tiny=(4, 0.4, 100, 2), quick=(6, 2, 500, 3), full=(10, 20, 3000, 5))
    words = ["/usr/bin/python3", suite.script("openmm", "drift"), "--cells", cells, "--picoseconds", picoseconds,
             "--settle", settle, "--seeds", seeds, "--deviations", DEVIATIONS[suite.size]]
    drifts = suite.run_for_json(words, environment=python_of_build(suite))
    names = {"native": "NonbondedForce", "dch": "DCHNonbondedForce"}
    return list(measurements_of("OpenMM, argon", "kJ/mol/atom/ps", "native", drifts, names))
