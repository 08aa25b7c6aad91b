# SPDX-License-Identifier: MIT
"""One module for each family of benchmarks, with

NAME, TITLE   of its record and of its part of the report
HOSTS         programs whose versions matter, keys of machine.HOSTS
run(suite)    runs its programs and returns a record.Result; raises running.Failed for a wrong answer,
              running.Missing for what is not there
"""

from . import (closest, drift, engine, error, far_sums, forces, hard, kinetic, lammps, misses, necklace, openmm, peers,
               reference)

ALL = (engine, peers, forces, lammps, openmm, necklace, kinetic, closest, far_sums, error, drift, misses, reference, hard)
