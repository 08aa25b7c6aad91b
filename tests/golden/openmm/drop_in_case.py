# SPDX-License-Identifier: MIT
"""What tests of the drop-in share."""

import unittest

import numpy as np
import openmm

import openmm_dch
from openmm_systems import PLATFORMS, context_of, energy_and_forces, relative_error

CUBE = np.eye(3)
COULOMB = 138.93545764  # of CODATA's constants of 2018 [kJ nm/mol/e^2]

# Of energies, relative or in kJ/mol; of forces, of their root mean square.
NEAR = {"Reference": 1e-9, "CPU": 1e-5}
FORCES = {"Reference": 1e-9, "CPU": 5e-6}


def lennard_jones(r, sigma, epsilon):
    x = (sigma / r) ** 6
    return 4 * epsilon * (x * x - x)


def force_of(particles, method=openmm.NonbondedForce.NoCutoff, cutoff=1.0):
    """Of particles by charge, sigma and epsilon."""
    force = openmm.NonbondedForce()
    for particle in particles:
        force.addParticle(*particle)
    force.setNonbondedMethod(method)
    force.setCutoffDistance(cutoff)
    return force


def system_of(*forces, box=None):
    """Particles of mass 1, as many as the forces have."""
    system = openmm.System()
    for _ in range(forces[0].getNumParticles()):
        system.addParticle(1)
    for force in forces:
        system.addForce(force)
    if box is not None:
        system.setDefaultPeriodicBoxVectors(*box)
    return system


def energy_of(context, groups=-1):
    return context.getState(getEnergy=True, groups=groups).getPotentialEnergy()._value


class DropInCase(unittest.TestCase):
    """With the drop-in enabled."""

    def setUp(self):
        openmm_dch.enable()

    def tearDown(self):
        openmm_dch.disable()

    def native(self, system, platform="Reference"):
        openmm_dch.disable()
        try:
            return context_of(system, platform)
        finally:
            openmm_dch.enable()

    def contexts(self, system, computed_by="DCH"):
        """A Context on each platform with the platform's name, all of its forces by the one named."""
        made = [(platform, context_of(system, platform)) for platform in PLATFORMS]
        for _, context in made:
            self.assertEqual([s["direct"] for s in openmm_dch.status(context)], [computed_by] * system.getNumForces())
        return made

    def near(self, expected, found, platform, factor=1):
        self.assertAlmostEqual(found, expected, delta=factor * NEAR[platform] * max(1, abs(expected)))

    def expect(self, expected, found, platform):
        """Energies and forces. The latter may be differences of large numbers."""
        self.near(expected[0], found[0], platform)
        self.assertLess(relative_error(expected[1], found[1]), FORCES[platform])

    def expect_slope(self, context, positions, step, tolerance):
        """The energy falls by the norm of the forces times the step along them, to the tolerance of the fall."""
        forces = energy_and_forces(context, positions)[1]
        norm = np.linalg.norm(forces)
        way = 0.5 * step / norm * forces
        before, after = (energy_and_forces(context, positions + sign * way)[0] for sign in (-1, 1))
        self.assertAlmostEqual((before - after) / (norm * step), 1, delta=tolerance)
