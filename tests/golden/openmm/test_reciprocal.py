#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""enable_reciprocal(): PME and LJPME of OpenMM's own NonbondedForce on meshes of ours."""

import unittest

import numpy as np
import openmm
from openmm import app, unit

import openmm_dch
from openmm_systems import context_of, energy_and_forces, positions_from_checkpoint, relative_error, water_box

PAIRS, WAVES = 1, 2  # of force groups
METHODS = (app.PME, app.LJPME)


def water(method, charge=0):
    """With the sum in reciprocal space in a force group of its own, on grids that all platforms have."""
    _, positions, topology = water_box()
    topology.setPeriodicBoxVectors(np.array([[1.9, 0, 0], [0.3, 1.95, 0], [-0.4, 0.5, 1.9]]) * unit.nanometer)
    system = app.ForceField("tip3p.xml").createSystem(
        topology, nonbondedMethod=method, nonbondedCutoff=0.7 * unit.nanometer, rigidWater=True)
    force = nonbonded(system)
    force.setPMEParameters(3.5, 24, 25, 24)
    force.setLJPMEParameters(3.6, 21, 20, 18)
    force.setReciprocalSpaceForceGroup(1)
    _, sigma, epsilon = force.getParticleParameters(0)
    force.setParticleParameters(0, -0.834 + charge, sigma, epsilon)
    return system, positions


def nonbonded(system):
    return next(f for f in system.getForces() if isinstance(f, openmm.NonbondedForce))


def who(context):
    status, = openmm_dch.status(context)
    return status["direct"], status["reciprocal"]


SYSTEM, POSITIONS = water(app.PME)
BEFORE = context_of(SYSTEM, "CPU")  # OpenMM's platform has no kernel of ours for it yet
ENERGY_BEFORE, FORCES_BEFORE = energy_and_forces(BEFORE, POSITIONS, WAVES)
HAS_PLUGIN = openmm.Platform.getPlatformByName("CPU").supportsKernels(["CalcPmeReciprocalForce"])  # as Debian 13's OpenMM


@unittest.skipUnless(HAS_PLUGIN, "OpenMM has no plugin for PME here; ReciprocalTest runs")
class PluginOfOpenMMTest(unittest.TestCase):
    def test_it_stays_where_there_is_one(self):
        self.assertIs(openmm_dch.enable_reciprocal(), False)
        context = context_of(SYSTEM, "CPU")
        energy, forces = energy_and_forces(context, POSITIONS, WAVES)
        self.assertEqual(who(context), ("OpenMM", "OpenMM"))
        # It is in single precision, and its threads add what they come to first.
        self.assertAlmostEqual(energy, ENERGY_BEFORE, delta=1e-6 * abs(ENERGY_BEFORE))
        self.assertLess(relative_error(FORCES_BEFORE, forces), 5e-6)


@unittest.skipIf(HAS_PLUGIN, "OpenMM has a plugin for PME here; PluginOfOpenMMTest runs")
class ReciprocalTest(unittest.TestCase):
    def setUp(self):
        self.assertTrue(openmm_dch.enable_reciprocal())

    def tearDown(self):
        openmm_dch.disable()

    def compare(self, context, system, positions, tolerance=5e-6):
        """The sum in reciprocal space with that of the Reference platform, which is in double. In single precision
        energies have few digits beside that of the charges with themselves."""
        expected = energy_and_forces(context_of(system, "Reference"), positions, WAVES)
        energy, forces = energy_and_forces(context, positions, WAVES)
        self.assertAlmostEqual(energy, expected[0], delta=0.4 * tolerance * abs(expected[0]) + 1e-5 * len(positions))
        self.assertLess(relative_error(expected[1], forces), tolerance)

    def test_contexts_that_were_made_before_keep_what_they_have(self):
        self.assertEqual(who(BEFORE), ("OpenMM", "OpenMM"))
        energy, forces = energy_and_forces(BEFORE, POSITIONS, WAVES)
        self.assertEqual(energy, ENERGY_BEFORE)
        np.testing.assert_array_equal(forces, FORCES_BEFORE)

    def test_disable_ends_it(self):
        for enable in (openmm_dch.enable, openmm_dch.enable_reciprocal):
            enable()
            openmm_dch.disable()
            context = context_of(SYSTEM, "CPU")
            energy, forces = energy_and_forces(context, POSITIONS, WAVES)
            self.assertEqual(who(context), ("OpenMM", "OpenMM"))
            self.assertAlmostEqual(energy, ENERGY_BEFORE, delta=1e-9 * abs(ENERGY_BEFORE))
            self.assertLess(relative_error(FORCES_BEFORE, forces), 1e-9)

    def test_forces_and_energies(self):
        for method in METHODS:
            for charge in (0, 3):
                with self.subTest(method=str(method), charge=charge):
                    system, positions = water(method, charge)
                    context = context_of(system, "CPU")
                    self.compare(context, system, positions)
                    each = [energy_and_forces(context, groups=groups) for groups in (PAIRS, WAVES, PAIRS | WAVES)]
                    self.assertAlmostEqual(each[0][0] + each[1][0], each[2][0], delta=1e-6 * abs(each[2][0]))
                    self.assertLess(relative_error(each[2][1], each[0][1] + each[1][1]), 1e-6)
                    self.assertEqual(who(context), ("OpenMM", "DCH"))
                    self.assertEqual(who(context_of(system, "Reference")), ("OpenMM", "OpenMM"))

    def test_parameters_of_the_mesh(self):
        system, positions = water(app.LJPME)
        force = nonbonded(system)
        force.setPMEParameters(3.5, 22, 25, 24)
        context = context_of(system, "CPU")
        context.setPositions(positions)
        energy_and_forces(context)
        alpha, *grid = force.getPMEParametersInContext(context)
        self.assertEqual((alpha, grid), (3.5, [24, 25, 24]))  # 22 = 2 11
        alpha, *grid = force.getLJPMEParametersInContext(context)
        self.assertEqual((alpha, grid), (3.6, [21, 20, 18]))

    def test_any_number_of_threads(self):
        for method in METHODS:
            system, positions = water(method)
            found = [energy_and_forces(context_of(system, "CPU", threads=threads), positions, WAVES)
                     for threads in (1, 2, 3)]
            for energy, forces in found[1:]:
                self.assertEqual(energy, found[0][0])
                np.testing.assert_array_equal(forces, found[0][1])

    def test_parameters_that_change(self):
        for method in METHODS:
            system, positions = water(method)
            context = context_of(system, "CPU")
            context.setPositions(positions)
            energy_and_forces(context)
            force = nonbonded(system)
            for k in range(0, 30, 3):
                force.setParticleParameters(k, -0.5 + 0.01 * k, 0.3, 0.8)
            force.updateParametersInContext(context)
            self.compare(context, system, positions)

    def test_a_box_that_changes(self):
        system, positions = water(app.PME)
        context = context_of(system, "CPU")
        self.compare(context, system, positions)
        box = 1.01 * np.array([v.value_in_unit(unit.nanometer) for v in system.getDefaultPeriodicBoxVectors()])
        context.setPeriodicBoxVectors(*box)
        system.setDefaultPeriodicBoxVectors(*box)
        self.compare(context, system, 1.01 * positions)

    def test_several_contexts(self):
        system, positions = water(app.PME)
        moved = positions + 0.002 * np.random.default_rng(1).normal(size=positions.shape)
        contexts = [context_of(system, "CPU") for _ in range(2)]
        self.compare(contexts[0], system, positions)
        self.compare(contexts[1], system, moved)
        self.compare(contexts[0], system, moved)
        del contexts[0]
        self.assertEqual(who(contexts[0]), ("OpenMM", "DCH"))

    def test_checkpoints(self):
        system, positions = water(app.PME)
        integrator = openmm.VerletIntegrator(0.0005)
        context = context_of(system, "CPU", integrator)
        context.setPositions(positions)
        openmm.LocalEnergyMinimizer.minimize(context, 10, 100)
        first, second = positions_from_checkpoint(context, integrator)
        np.testing.assert_allclose(second, first, atol=1e-4)

    def test_double_precision(self):
        for method in METHODS:
            system, positions = water(method)
            openmm_dch.enable("double")  # which leaves a switch with LJPME to OpenMM
            nonbonded(system).setUseSwitchingFunction(method is app.LJPME)
            nonbonded(system).setSwitchingDistance(0.6)
            context = context_of(system, "CPU")
            openmm_dch.disable()
            nonbonded(system).setUseSwitchingFunction(False)
            self.compare(context, system, positions, 1e-6)  # of charges in single precision, by OpenMM
            self.assertEqual(who(context)[1], "OpenMM")

    def test_beside_the_drop_in(self):
        system, positions = water(app.LJPME)
        openmm_dch.disable()
        openmm_dch.enable()
        self.assertEqual(who(context_of(system, "CPU")), ("DCH", "DCH"))
        force = nonbonded(system)
        force.setUseSwitchingFunction(True)  # which the drop-in leaves to OpenMM
        force.setSwitchingDistance(0.6)
        context = context_of(system, "CPU")
        energy_and_forces(context, positions)
        self.assertEqual(who(context), ("OpenMM", "DCH"))
        self.assertIn("switching function", openmm_dch.status(context)[0]["reason"])

    def test_a_mesh_of_fewer_than_five_points_is_refused(self):
        system, positions = water(app.PME)
        nonbonded(system).setPMEParameters(3.5, 4, 24, 24)
        with self.assertRaisesRegex(openmm.OpenMMException, "openmm_dch: .*4"):
            energy_and_forces(context_of(system, "CPU"), positions)


if __name__ == "__main__":
    unittest.main()
