#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The class DCHNonbondedForce in Python: units, copies, errors."""

import copy
import pickle
import unittest

import numpy as np
import openmm
from openmm import unit

import openmm_dch
from openmm_dch import DCHNonbondedForce
from openmm_systems import PLATFORMS, context_of, energy_and_forces, lennard_jones_fluid, water_box


def small_force():
    force = DCHNonbondedForce()
    force.setNonbondedMethod(DCHNonbondedForce.CutoffPeriodic)
    force.setCutoffDistance(9 * unit.angstrom)
    force.addParticle(0.5, 0.3, 1)
    force.addParticle(-0.5 * unit.elementary_charge, 3.5 * unit.angstrom, 0.25 * unit.kilocalorie_per_mole)
    force.addException(0, 1, 0.125, 0.3, 0.5)
    force.addGlobalParameter("scale", 0.5)
    force.addParticleParameterOffset("scale", 1, 0.1, 0.2, 0.3)
    force.addExceptionParameterOffset("scale", 0, 0.4, 0.5, 0.6)
    force.setForceGroup(3)
    force.setName("mine")
    return force


class ForceTest(unittest.TestCase):
    def assert_same(self, a, b):
        self.assertEqual(openmm.XmlSerializer.serialize(a), openmm.XmlSerializer.serialize(b))

    def test_units_in_and_out(self):
        force = small_force()
        self.assertAlmostEqual(force.getCutoffDistance().value_in_unit(unit.nanometer), 0.9)
        charge, sigma, epsilon = force.getParticleParameters(1)
        self.assertEqual(charge, -0.5 * unit.elementary_charge)
        self.assertAlmostEqual(sigma.value_in_unit(unit.nanometer), 0.35)
        self.assertAlmostEqual(epsilon.value_in_unit(unit.kilojoule_per_mole), 1.046)
        i, j, product, sigma, epsilon = force.getExceptionParameters(0)
        self.assertEqual((i, j, product), (0, 1, 0.125 * unit.elementary_charge**2))
        name, index, charge, sigma, epsilon = force.getParticleParameterOffset(0)
        self.assertEqual((name, index, sigma), ("scale", 1, 0.2 * unit.nanometer))
        name, index, product, sigma, epsilon = force.getExceptionParameterOffset(0)
        self.assertEqual((name, index, epsilon), ("scale", 0, 0.6 * unit.kilojoule_per_mole))
        self.assertRaises(TypeError, force.addParticle, "one", 2, 3)

    def test_exceptions_take_quantities_and_names(self):
        force = small_force()
        force.addException(1, 0, 0.2 * unit.elementary_charge**2, 2.5 * unit.angstrom, 1 * unit.kilocalorie_per_mole,
                           replace=True)
        _, _, product, sigma, epsilon = force.getExceptionParameters(0)
        self.assertEqual((product, sigma), (0.2 * unit.elementary_charge**2, 0.25 * unit.nanometer))
        self.assertAlmostEqual(epsilon.value_in_unit(unit.kilojoule_per_mole), 4.184)

    def test_wrong_units_are_refused(self):
        force = small_force()
        charge, length, energy = unit.elementary_charge, unit.nanometer, unit.kilojoule_per_mole
        for call in (lambda: force.addParticle(1 * charge, 1 * energy, 0.3 * length),
                     lambda: force.setParticleParameters(0, 1 * length, 0.3, 1),
                     lambda: force.addException(0, 1, 1 * charge, 0.3, 1, True),
                     lambda: force.setExceptionParameters(0, 0, 1, 1, 1, 0.3 * length),
                     lambda: force.setCutoffDistance(1 * unit.degree),
                     lambda: force.setSwitchingDistance(1 * unit.picosecond),
                     lambda: force.setReactionFieldDielectric(78 * length),
                     lambda: force.createExceptionsFromBonds([(0, 1)], 0.5 * charge, 0.5)):
            with self.assertRaisesRegex(TypeError, "not compatible"):
                call()
        self.assertEqual(force.getNumParticles(), 2)

    def test_integers_of_numpy(self):
        force = small_force()
        zero, one = np.int32(0), np.int64(1)
        self.assertEqual(force.getParticleParameters(one)[0], -0.5 * unit.elementary_charge)
        self.assertEqual(force.addException(zero, one, 0, 1, 0, True), 0)
        fresh = DCHNonbondedForce()
        for _ in range(2):
            fresh.addParticle(0, 1, 0)
        fresh.createExceptionsFromBonds(np.array([[0, 1]]), 1, 1)
        self.assertEqual(fresh.getNumExceptions(), 1)
        force.setNonbondedMethod(np.int64(0))
        self.assertEqual(force.getNonbondedMethod(), force.NoCutoff)
        self.assertRaises(TypeError, force.getParticleParameters, 1.0)
        self.assertRaises(OverflowError, force.getParticleParameters, 2**40)

    def test_version(self):
        self.assertRegex(openmm_dch.__version__, r"^\d+\.\d+\.\d+$")

    def test_copies(self):
        force = small_force()
        for other in (copy.copy(force), copy.deepcopy(force), pickle.loads(pickle.dumps(force))):
            self.assertIsInstance(other, DCHNonbondedForce)
            self.assertEqual(other.getNumParticles(), 2)
            self.assert_same(force, other)
            other.setParticleParameters(0, 0, 1, 0)
        self.assertEqual(force.getParticleParameters(0)[1], 0.3 * unit.nanometer)

    def test_part_of_a_system(self):
        system = openmm.System()
        force = small_force()
        system.addForce(force)
        self.assertIsInstance(force, openmm.Force)
        self.assertTrue(DCHNonbondedForce.isinstance(system.getForce(0)))
        self.assertEqual(DCHNonbondedForce.cast(system.getForce(0)).getNumParticles(), 2)
        system.addForce(openmm.HarmonicBondForce())
        self.assertFalse(DCHNonbondedForce.isinstance(system.getForce(1)))
        with self.assertRaisesRegex(openmm.OpenMMException, "HarmonicBondForce is no DCHNonbondedForce"):
            DCHNonbondedForce.cast(system.getForce(1))
        self.assertTrue(system.usesPeriodicBoundaryConditions())
        for other in (copy.deepcopy(system), pickle.loads(pickle.dumps(system)),
                      openmm.XmlSerializer.deserialize(openmm.XmlSerializer.serialize(system))):
            self.assert_same(system, other)
            self.assert_same(force, DCHNonbondedForce.cast(other.getForce(0)))

    def test_exceptions_from_bonds(self):
        force = DCHNonbondedForce()
        for _ in range(5):
            force.addParticle(1, 0.3, 1)
        force.createExceptionsFromBonds([(0, 1), [1, 2], (2, 3), np.array([3, 4])], 0.5, 0.25)
        self.assertEqual(force.getNumExceptions(), 9)
        self.assertRaises(TypeError, force.createExceptionsFromBonds, [(0, 1, 2)], 1, 1)
        self.assertRaises(TypeError, force.createExceptionsFromBonds, 5, 1, 1)

    def test_errors(self):
        force = small_force()
        with self.assertRaisesRegex(openmm.OpenMMException, "no particle 7"):
            force.getParticleParameters(7)
        with self.assertRaisesRegex(openmm.OpenMMException, "4 is no nonbonded method"):
            force.setNonbondedMethod(4)
        system = openmm.System()
        for _ in range(2):
            system.addParticle(1)
        force.setCutoffDistance(1.25)
        system.addForce(force)
        for platform in PLATFORMS:
            with self.assertRaisesRegex(openmm.OpenMMException, "1.25 nm exceeds half of the periodic box"):
                context_of(system, platform)


class ReplaceTest(unittest.TestCase):
    def test_water_gives_the_energy_of_the_native_force(self):
        system, positions, _ = water_box()
        expected = energy_and_forces(context_of(system, "Reference"), positions)
        native = [f for f in system.getForces() if isinstance(f, openmm.NonbondedForce)][0]
        native.setForceGroup(2)
        native.setName("water")
        count = system.getNumForces()
        replaced, = openmm_dch.replaceNonbonded(system)
        self.assertEqual(system.getNumForces(), count)
        self.assertFalse(any(isinstance(f, openmm.NonbondedForce) for f in system.getForces()))
        self.assertEqual((replaced.getForceGroup(), replaced.getName()), (2, "water"))
        for platform, tolerance in (("Reference", 1e-7), ("CPU", 1e-5)):
            energy, forces = energy_and_forces(context_of(system, platform), positions)
            self.assertLess(abs(energy - expected[0]), tolerance * abs(expected[0]))
            self.assertLess(np.sqrt(np.sum((forces - expected[1]) ** 2) / np.sum(expected[1] ** 2)), tolerance)

    def test_lattice_sums_stay(self):
        system, _ = lennard_jones_fluid(3, 2)
        native = system.getForce(0)
        for method, name in ((native.Ewald, "Ewald"), (native.PME, "PME"), (native.LJPME, "LJPME")):
            native.setNonbondedMethod(method)
            with self.assertRaisesRegex(openmm.OpenMMException, f"{name} is not available; keep the NonbondedForce"):
                openmm_dch.replaceNonbonded(system)
            self.assertIsInstance(system.getForce(0), openmm.NonbondedForce)

    def test_a_system_without_nonbonded_forces(self):
        with self.assertRaisesRegex(openmm.OpenMMException, "no NonbondedForce"):
            openmm_dch.replaceNonbonded(openmm.System())


if __name__ == "__main__":
    unittest.main()
