#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""NonbondedForce by the drop-in in the cases of upstream's TestEwald.

Which test stands for which of upstream's cases is said in docs/openmm.md.
"""

import itertools
import math
import unittest

import numpy as np
import openmm

from drop_in_case import COULOMB, CUBE, DropInCase, force_of, lennard_jones, system_of
from openmm_systems import energy_and_forces, relative_error


class EwaldCases(DropInCase):
    @staticmethod
    def salt(exceptions):
        """Ions of both signs, far from any lattice."""
        rng = np.random.default_rng(8)
        per_side, cutoff = 8, 1.2
        side = 0.31 * per_side
        grid = np.stack(np.meshgrid(*[np.arange(per_side)] * 3), axis=-1).reshape(-1, 3)
        positions = 0.31 * grid + rng.uniform(-0.08, 0.08, grid.shape)
        force = force_of([((-1) ** int(sum(k)), 1, 0) for k in grid], openmm.NonbondedForce.Ewald, cutoff)
        force.setEwaldErrorTolerance(1e-5)
        if exceptions:
            for i in range(len(grid) - 1):
                if np.linalg.norm(positions[i] - positions[i + 1]) < cutoff / 2:
                    force.addException(i, i + 1, 0.5 * (i % 2), 1, 0)
        return system_of(force, box=side * CUBE), force, positions

    def test_salt_without_order(self):
        for exceptions in (False, True):
            system, force, positions = self.salt(exceptions)
            energies = []
            for method in (force.Ewald, force.PME):
                force.setNonbondedMethod(method)
                expected = energy_and_forces(self.native(system), positions)
                energies.append(expected[0])
                for platform, context in self.contexts(system):
                    with self.subTest(exceptions=exceptions, method=method, platform=platform):
                        energy, forces = energy_and_forces(context, positions)
                        self.assertAlmostEqual(energy / expected[0], 1, delta=1e-5)
                        self.assertLess(relative_error(expected[1], forces), 1e-4)
                        self.expect_slope(context, positions, 5e-3, 1e-2)
            self.assertAlmostEqual(energies[0] / energies[1], 1, delta=1e-3)

    def test_ions_in_a_skewed_box(self):
        """By the sum over waves itself."""
        box = np.array([[2.5, 0, 0], [0.5, 3, 0], [0.7, 0.9, 3.5]])
        charges = np.array([-1] * 4 + [1] * 4)
        kinds = {-1: (0.44, 0.42), 1: (0.33, 0.012)}
        force = force_of([(q, *kinds[q]) for q in charges.tolist()], openmm.NonbondedForce.PME)
        force.setUseDispersionCorrection(False)
        force.setPMEParameters(3.45, 72, 84, 96)
        rng = np.random.default_rng(9)
        positions = rng.random((8, 3)) @ box
        while self.closest(positions, box) < 0.3:
            positions = rng.random((8, 3)) @ box
        expected = self.by_images_and_waves(positions, charges, [kinds[q] for q in charges.tolist()], box, 3.45)
        for platform, context in self.contexts(system_of(force, box=box)):
            with self.subTest(platform=platform):
                energy, forces = energy_and_forces(context, positions)
                self.assertAlmostEqual(energy, expected[0], delta=1e-4 * abs(expected[0]))
                self.assertLess(relative_error(expected[1], forces), 1e-4)

    @staticmethod
    def images(box, reach=2):
        return np.array(list(itertools.product(range(-reach, reach + 1), repeat=3))) @ box

    def closest(self, positions, box):
        apart = positions[:, None] - positions[None, :]
        r = np.linalg.norm(apart[:, :, None] + self.images(box), axis=-1)
        return np.min(r[r > 1e-9])

    def by_images_and_waves(self, positions, charges, kinds, box, alpha):
        """Energy and forces: charges within the cutoff of 1 nm by the complementary error function, the rest by waves."""
        energy, forces = 0.0, np.zeros((8, 3))
        for i, j in itertools.combinations(range(8), 2):
            for d in positions[j] - positions[i] + self.images(box):
                r = np.linalg.norm(d)
                if r >= 1:
                    continue
                qq = COULOMB * charges[i] * charges[j]
                sigma, epsilon = (kinds[i][0] + kinds[j][0]) / 2, math.sqrt(kinds[i][1] * kinds[j][1])
                energy += qq * math.erfc(alpha * r) / r + lennard_jones(r, sigma, epsilon)
                slope = (lennard_jones(r + 1e-5, sigma, epsilon) - lennard_jones(r - 1e-5, sigma, epsilon)) / 2e-5
                gauss = 2 * alpha / math.sqrt(math.pi) * math.exp(-(alpha * r) ** 2)
                push = qq * (math.erfc(alpha * r) / r + gauss) / r - slope
                forces[j] += push * d / r
                forces[i] -= push * d / r
        steps = np.array([k for k in itertools.product(range(-16, 17), range(-19, 20), range(-22, 23)) if any(k)])
        waves = 2 * math.pi * steps @ np.linalg.inv(box).T
        k2 = np.sum(waves**2, axis=1)
        weights = 4 * math.pi / np.linalg.det(box) * np.exp(-k2 / (4 * alpha**2)) / k2
        phases = np.exp(1j * waves @ positions.T)
        total = phases @ charges
        energy += COULOMB * (0.5 * np.sum(weights * np.abs(total) ** 2) - alpha / math.sqrt(math.pi) * np.sum(charges**2))
        fields = (weights[:, None] * np.imag(phases * np.conj(total)[:, None])).T @ waves
        return energy, forces + COULOMB * charges[:, None] * fields

    def test_a_molecule_through_a_skewed_box(self):
        """In reciprocal space; it is longer than the box."""
        box = np.array([[3.2, 0, 0], [-1.1, 3.1, 0], [-1.1, -1.5, 2.7]])
        positions = 10 * np.random.default_rng(10).random((400, 3)) - 2
        force = force_of([(1 - 2 * (i % 2), 1, 0) for i in range(400)], openmm.NonbondedForce.PME)
        system = system_of(force, box=box)
        for i, bond in enumerate(np.linalg.norm(np.diff(positions, axis=0), axis=1)):
            system.addConstraint(i, i + 1, bond)
        force.setReciprocalSpaceForceGroup(1)
        force.setPMEParameters(2.63, 27, 25, 24)
        expected = energy_and_forces(self.native(system), positions, groups=2)
        for platform, context in self.contexts(system):
            with self.subTest(platform=platform):
                self.expect(expected, energy_and_forces(context, positions, groups=2), platform)

    def test_errors_follow_the_tolerance(self):
        side = 5.0
        rng = np.random.default_rng(11)
        positions = side * rng.random((51, 3))
        for method in (openmm.NonbondedForce.Ewald, openmm.NonbondedForce.PME):
            force = force_of([(q, 1, 0) for q in np.linspace(-1, 1, 51)], method)
            system = system_of(force, box=side * CUBE)
            for cutoff in (1.0, 1.44, 2.07, 2.49):
                force.setCutoffDistance(cutoff)
                best = {}
                for tolerance in (5e-5, 1e-4, 2e-4, 4e-4, 8e-4):
                    force.setEwaldErrorTolerance(tolerance)
                    for platform, context in self.contexts(system):
                        with self.subTest(method=method, cutoff=cutoff, tolerance=tolerance, platform=platform):
                            forces = energy_and_forces(context, positions)[1]
                            self.assertLess(relative_error(best.setdefault(platform, forces), forces), 2 * tolerance)
                            if method == force.PME:
                                self.expect_parameters(force, context, side)

    def expect_parameters(self, force, context, side):
        tolerance = force.getEwaldErrorTolerance()
        alpha, *sizes = force.getPMEParametersInContext(context)
        expected = math.sqrt(-math.log(2 * tolerance)) / force.getCutoffDistance()._value
        self.assertAlmostEqual(alpha, expected, delta=1e-5)
        least = max(6, math.ceil(2 * alpha * side / (3 * tolerance**0.2)))
        for size in sizes:
            self.assertIn(size, range(least, least + 10))

    def test_parameters_of_pme_by_number(self):
        side = 4.7
        positions = side * np.random.default_rng(12).random((51, 3))
        force = force_of([(q, 1, 0) for q in np.linspace(-1, 1, 51)], openmm.NonbondedForce.PME)
        system = system_of(force, box=side * CUBE)

        def energies():
            return [energy_and_forces(context, positions)[0] for _, context in self.contexts(system)]

        force.setEwaldErrorTolerance(1e-3)
        coarse, chosen = energies(), [force.getPMEParametersInContext(c) for _, c in self.contexts(system)]
        force.setEwaldErrorTolerance(1e-4)
        fine = energies()
        for k, parameters in enumerate(chosen):
            force.setPMEParameters(*parameters)
            self.assertAlmostEqual(energies()[k] / coarse[k], 1, delta=1e-6)
            self.assertGreater(abs(fine[k] / coarse[k] - 1), 1e-5)

    def test_a_net_charge_counts_as_in_openmm(self):
        """Versions differ in whether a background takes it away."""
        for method in (openmm.NonbondedForce.Ewald, openmm.NonbondedForce.PME, openmm.NonbondedForce.LJPME):
            force = force_of([(1, 0.3, 1)] * 2, method, 0.7)
            system = system_of(force, box=2 * CUBE)
            force.addGlobalParameter("a", 0.1)
            force.addParticleParameterOffset("a", 0, 1, 0.1, 0.1)
            force.setEwaldErrorTolerance(1e-5)
            contexts, native = self.contexts(system), self.native(system)
            for charge in (1, 2):
                force.setParticleParameters(0, charge, 0.3, 1)
                expected = 0
                for platform, context in [("", native)] + contexts:
                    with self.subTest(method=method, charge=charge, platform=platform):
                        force.updateParametersInContext(context)
                        energy = energy_and_forces(context, [[0, 0, 0], [0.3, 0.4, 0]])[0]
                        expected = expected or energy
                        self.assertAlmostEqual(energy, expected, delta=1e-4 * abs(expected))


if __name__ == "__main__":
    unittest.main()
