#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Particles at the same place with the drop-in, where OpenMM's own kernels give NaN."""

import itertools
import math
import unittest

import numpy as np
import openmm

import openmm_dch
from drop_in_case import CUBE, DropInCase, force_of, system_of
from openmm_systems import energy_and_forces, relative_error

METHODS = ("NoCutoff", "CutoffNonPeriodic", "CutoffPeriodic", "Ewald", "PME", "LJPME")
NOTHING, CHARGE, OIL, WATER = (0, 0.3, 0), (0.4, 1, 0), (0, 0.35, 0.6), (-0.8, 0.3, 0.6)
KINDS = {"few": (NOTHING, CHARGE, OIL, WATER), "many": (NOTHING, CHARGE, OIL, WATER, (0.1, 0.2, 0.3), (0.2, 0.31, 0.4))}


class CoincidentTest(DropInCase):
    def scene(self, method, kinds, seed=1):
        """400 particles of these kinds, none too near another one."""
        rng = np.random.default_rng(seed)
        grid = np.stack(np.meshgrid(*[np.arange(7)] * 3), axis=-1).reshape(-1, 3)
        positions = 0.35 * grid + 0.05 * rng.random(grid.shape)
        force = force_of([kinds[k % len(kinds)] for k in range(len(grid))], getattr(openmm.NonbondedForce, method), 0.9)
        force.setUseDispersionCorrection(False)
        force.setPMEParameters(3.5, 24, 24, 24)
        force.setLJPMEParameters(3.5, 24, 24, 24)
        return force, positions, len(kinds)

    def expect_near(self, near, found):
        """As where the two are 1e-7 nm apart."""
        self.assertTrue(np.isfinite(found[0]))
        self.assertAlmostEqual(found[0], near[0], delta=1e-4 * max(1, abs(near[0])))
        self.assertLess(relative_error(near[1], found[1]), 1e-4)

    def test_particles_without_parameters_in_common_count_nothing_for_each_other(self):
        """One without any, or one with a charge alone and one without."""
        for method, (name, kinds), precision in itertools.product(METHODS, KINDS.items(), ("mixed", "double")):
            openmm_dch.enable(precision)
            force, positions, count = self.scene(method, kinds)
            contexts = self.contexts(system_of(force, box=2.45 * CUBE))
            exact = dict(contexts)["Reference"]
            for first, second in ((0, 3), (0, 1), (0, count), (1, 2)):
                apart = positions.copy()
                apart[second] = apart[first]
                near = energy_and_forces(exact, apart + 1e-7 * (np.arange(len(apart)) == second)[:, None])
                for platform, context in contexts:
                    with self.subTest(method=method, kinds=name, precision=precision, pair=(first, second), platform=platform):
                        self.expect_near(near, energy_and_forces(context, apart))
                        after = energy_and_forces(context, positions)
                        self.expect(energy_and_forces(exact, positions), after, platform)

    def test_particles_that_nearly_coincide_have_the_forces_of_double(self):
        for method, (name, kinds) in itertools.product(METHODS, KINDS.items()):
            force, positions, _ = self.scene(method, kinds)
            positions[3] = positions[7 if name == "few" else 9] + [1e-5, 0, 0]
            (_, reference), (_, cpu) = self.contexts(system_of(force, box=2.45 * CUBE))
            expected, found = energy_and_forces(reference, positions), energy_and_forces(cpu, positions)
            with self.subTest(method=method, kinds=name):
                self.assertTrue(np.all(np.isfinite(expected[1])))
                self.assertAlmostEqual(found[0] / expected[0], 1, delta=1e-6)
                others = np.delete(np.arange(len(positions)), [3, 7 if name == "few" else 9])
                self.assertLess(relative_error(expected[1][others], found[1][others]), 1e-5)
                self.assertLess(relative_error(expected[1], found[1]), 1e-6)

    def test_particles_with_parameters_have_no_value(self):
        """As in OpenMM; nobody else's forces suffer."""
        for method in METHODS:
            force, positions, _ = self.scene(method, KINDS["few"])
            positions[3] = positions[7]
            for platform, context in self.contexts(system_of(force, box=2.45 * CUBE)):
                with self.subTest(method=method, platform=platform):
                    energy, forces = energy_and_forces(context, positions)
                    self.assertFalse(math.isfinite(energy))
                    bad = np.flatnonzero(~np.all(np.isfinite(forces), axis=1))
                    self.assertEqual(list(bad), [3, 7])


if __name__ == "__main__":
    unittest.main()
