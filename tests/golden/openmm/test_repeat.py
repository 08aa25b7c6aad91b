#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The same simulation five times, while other programs keep the processors busy: the same bits each time."""

import hashlib
import os
import sys
import unittest

import numpy as np
import openmm

import openmm_dch
from openmm_systems import energy_and_forces, lennard_jones_fluid

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "support"))
from busy_processors import load  # noqa: E402

REPEATS = 5


def outcome(platform, threads):
    """A hash of energies and forces along a path that the test itself walks, so that only the force is compared."""
    system, positions = lennard_jones_fluid(12, 4.5, box=[[4.5, 0, 0], [1, 4.5, 0], [0.5, -1, 4.5]])
    openmm_dch.replaceNonbonded(system)
    properties = {"Threads": str(threads)} if platform == "CPU" else {}
    context = openmm.Context(system, openmm.VerletIntegrator(0.001), openmm.Platform.getPlatformByName(platform),
                             properties)
    rng = np.random.default_rng(3)
    found = hashlib.sha256()
    for step in range(12):
        positions = positions + rng.uniform(-1, 1, positions.shape) * (0.02, 0.1, 0.3, 1.0)[step % 4]
        energy, forces = energy_and_forces(context, positions)
        found.update(np.float64(energy).tobytes() + forces.tobytes())
    return found.hexdigest()


class RepeatTest(unittest.TestCase):
    def check(self, platform, threads):
        found = set()
        for repeat in range(REPEATS):
            with load(repeat):
                found.add(outcome(platform, threads[repeat % len(threads)]))
        self.assertEqual(len(found), 1, found)

    def test_cpu_with_one_and_two_threads(self):
        self.check("CPU", (1, 2))

    def test_reference(self):
        self.check("Reference", (1,))


if __name__ == "__main__":
    unittest.main()
