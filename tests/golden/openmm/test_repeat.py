#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The same forces and contacts five times, while other programs keep the processors busy: the same bits each time."""

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


def packed_chain(per_side=9, spacing=0.3):
    """A chain row by row and layer by layer through a lattice, in a System of its own with a contact force."""
    grid = []
    for z in range(per_side):
        for k in range(per_side):
            y = k if z % 2 == 0 else per_side - 1 - k
            grid.extend((n if (y + z) % 2 == 0 else per_side - 1 - n, y, z) for n in range(per_side))
    system, force = openmm.System(), openmm_dch.NecklaceContactForce()
    for _ in grid:
        system.addParticle(50)
    force.addChain(range(len(grid)), [0.16] * len(grid))
    force.setEnergyFunction(force.SoftCosine)
    system.addForce(force)
    return system, np.array(grid) * spacing, force


def outcome_of_contacts(platform, threads):
    """Energies, forces, contacts and what they were searched with: first along the chain, then over space."""
    system, positions, force = packed_chain()
    properties = {"Threads": str(threads)} if platform == "CPU" else {}
    context = openmm.Context(system, openmm.VerletIntegrator(0.001), openmm.Platform.getPlatformByName(platform),
                             properties)
    rng = np.random.default_rng(3)
    found = hashlib.sha256()
    for step in range(8):
        positions = positions + rng.uniform(-1, 1, positions.shape) * (0.01, 0.05)[step % 2]
        energy, forces = energy_and_forces(context, positions)
        found.update(np.float64(energy).tobytes() + forces.tobytes())
        found.update(repr([(i, j, gap._value) for i, j, gap in force.getContacts(context, 0.05)]).encode())
        found.update(force.getSearchInContext(context).encode())
    assert force.getSearchInContext(context).startswith("dch: "), force.getSearchInContext(context)
    return found.hexdigest()


class RepeatTest(unittest.TestCase):
    def check(self, platform, threads, outcome=outcome):
        found = set()
        for repeat in range(REPEATS):
            with load(repeat):
                found.add(outcome(platform, threads[repeat % len(threads)]))
        self.assertEqual(len(found), 1, found)

    def test_cpu_with_one_and_two_threads(self):
        self.check("CPU", (1, 2))

    def test_reference(self):
        self.check("Reference", (1,))

    def test_contacts(self):
        self.check("CPU", (1, 2, 3), outcome_of_contacts)
        self.check("Reference", (1,), outcome_of_contacts)


if __name__ == "__main__":
    unittest.main()
