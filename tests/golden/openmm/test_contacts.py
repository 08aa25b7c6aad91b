#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The class NecklaceContactForce in Python: units, copies, simulations, errors."""

import copy
import io
import pickle
import unittest

import numpy as np
import openmm
from openmm import app, unit

import openmm_dch  # noqa: F401  registers the kernels
from openmm_dch import NecklaceContactForce
from openmm_systems import PLATFORMS, context_of, energy_and_forces, positions_from_checkpoint

BOND, RADIUS, BOX = 0.3, 0.16, 2.5


def small_force():
    force = NecklaceContactForce()
    force.setEnergyFunction(NecklaceContactForce.SoftCosine)
    force.setStrength(2 * unit.kilocalorie_per_mole)
    force.setExcludedBonds(2)
    force.setActsBetweenChains(False)
    force.setUsesPeriodicBoundaryConditions(True)
    force.addChain([0, 1, 2], [1 * unit.angstrom, 0.2, 0.3])
    force.addChain(np.array([5, 3, 4]), np.array([1, 2, 3]) * unit.angstrom, closed=True)
    force.setForceGroup(3)
    force.setName("mine")
    return force


def bead_chains(chains=3, beads=30, box=None, seed=2, strength=2.0):
    """Random walks in a System with bonds (force group 0) and contacts (force group 1)."""
    rng = np.random.default_rng(seed)
    system = openmm.System()
    bonds, force = openmm.HarmonicBondForce(), NecklaceContactForce()
    positions = []
    for chain in range(chains):
        first = chain * beads
        steps = rng.normal(size=(beads, 3))
        steps *= BOND / np.linalg.norm(steps, axis=1)[:, None]
        positions.extend(np.cumsum(steps, axis=0) + rng.random(3))
        for k in range(beads):
            system.addParticle(50)
            if k > 0:
                bonds.addBond(first + k - 1, first + k, BOND, 5000)
        force.addChain(range(first, first + beads), [RADIUS] * beads)
    force.setStrength(strength)
    force.setForceGroup(1)
    if box is not None:
        system.setDefaultPeriodicBoxVectors(*(np.eye(3) * box))
        force.setUsesPeriodicBoundaryConditions(True)
        bonds.setUsesPeriodicBoundaryConditions(True)
    system.addForce(bonds)
    system.addForce(force)
    return system, np.array(positions), force


def all_pairs(positions, beads, box, strength, function=NecklaceContactForce.WCA):
    """Energy, forces and the pairs in contact of chains with so many beads each, in double."""
    apart = positions[None, :, :] - positions[:, None, :]
    if box is not None:
        apart -= box * np.round(apart / box)
    r = np.sqrt(np.einsum("ijk,ijk->ij", apart, apart))
    along = np.arange(len(positions))
    bonded = (np.abs(along[:, None] - along[None, :]) <= 1) & (along[:, None] // beads == along[None, :] // beads)
    touching = (r < 2 * RADIUS) & ~bonded
    r, d = np.where(touching, r, 1), 2 * RADIUS
    if function == NecklaceContactForce.WCA:
        q6 = (d / r) ** 6
        energy, force = strength * (q6 - 1) ** 2, 12 * strength * (q6 * q6 - q6) / r
    elif function == NecklaceContactForce.Harmonic:
        energy, force = strength / 2 * (d - r) ** 2, strength * (d - r)
    else:
        energy, force = strength * (1 + np.cos(np.pi * r / d)), strength * np.pi / d * np.sin(np.pi * r / d)
    force = np.where(touching, force / r, 0)
    pairs = [(i, j) for i, j in zip(*np.nonzero(touching)) if i < j]
    return np.sum(np.where(touching, energy, 0)) / 2, -np.einsum("ij,ijk->ik", force, apart), pairs


class ForceTest(unittest.TestCase):
    def assert_same(self, a, b):
        self.assertEqual(openmm.XmlSerializer.serialize(a), openmm.XmlSerializer.serialize(b))

    def test_units_in_and_out(self):
        force = small_force()
        self.assertEqual(force.getStrength().unit, unit.kilojoule_per_mole)
        self.assertAlmostEqual(force.getStrength()._value, 8.368)
        force.setEnergyFunction(force.Harmonic)
        force.setStrength(3 * unit.kilojoule_per_mole / unit.angstrom**2)
        self.assertEqual(force.getStrength().unit, unit.kilojoule_per_mole / unit.nanometer**2)
        self.assertAlmostEqual(force.getStrength()._value, 300)
        self.assertEqual((force.getNumChains(), force.getNumBeads()), (2, 6))
        for index, chain, expected, closed in ((0, [0, 1, 2], [0.1, 0.2, 0.3], False),
                                               (1, [5, 3, 4], [0.1, 0.2, 0.3], True)):
            particles, radii, is_closed = force.getChainParameters(index)
            self.assertEqual((particles, is_closed), (chain, closed))
            np.testing.assert_allclose(radii.value_in_unit(unit.nanometer), expected, rtol=1e-15)
        force.setChainParameters(0, (1, 2), radii=(0.5, 0.25))
        self.assertEqual(force.getChainParameters(0)[0], [1, 2])
        for bad in ((5, [1]), ([0], 1), (["a"], [1]), ([0], ["a"]), ([0.5], [1]), ([2**40], [1])):
            self.assertRaises((TypeError, ValueError, OverflowError), force.addChain, *bad)
        self.assertEqual(force.getNumChains(), 2)

    def test_wrong_units_are_refused(self):
        force = small_force()
        for call in (lambda: force.addChain([6, 7], np.array([1, 2]) * unit.degree),
                     lambda: force.addChain([6, 7], [1 * unit.degree, 1]),
                     lambda: force.setStrength(1 * unit.nanometer)):
            self.assertRaises(TypeError, call)
        self.assertEqual(force.getNumChains(), 2)
        force.setEnergyFunction(np.int64(force.Harmonic))
        force.setStrength(3 * unit.kilojoule_per_mole / unit.angstrom**2)
        self.assertAlmostEqual(force.getStrength()._value, 300)

    def test_copies(self):
        force = small_force()
        for other in (copy.copy(force), copy.deepcopy(force), pickle.loads(pickle.dumps(force))):
            self.assertIsInstance(other, NecklaceContactForce)
            self.assert_same(force, other)
            other.setChainParameters(0, [0], [1])
        self.assertEqual(force.getChainParameters(0)[0], [0, 1, 2])

    def test_part_of_a_system(self):
        system = openmm.System()
        force = small_force()
        system.addForce(force)
        self.assertIsInstance(force, openmm.Force)
        self.assertTrue(NecklaceContactForce.isinstance(system.getForce(0)))
        self.assertEqual(NecklaceContactForce.cast(system.getForce(0)).getNumChains(), 2)
        system.addForce(openmm.HarmonicBondForce())
        self.assertFalse(NecklaceContactForce.isinstance(system.getForce(1)))
        with self.assertRaisesRegex(openmm.OpenMMException, "HarmonicBondForce is no NecklaceContactForce"):
            NecklaceContactForce.cast(system.getForce(1))
        self.assertTrue(system.usesPeriodicBoundaryConditions())
        for other in (copy.deepcopy(system), pickle.loads(pickle.dumps(system)),
                      openmm.XmlSerializer.deserialize(openmm.XmlSerializer.serialize(system))):
            self.assert_same(system, other)
            self.assert_same(force, NecklaceContactForce.cast(other.getForce(0)))

    def test_errors(self):
        force = small_force()
        with self.assertRaisesRegex(openmm.OpenMMException, "no chain 7"):
            force.getChainParameters(7)
        with self.assertRaisesRegex(openmm.OpenMMException, "4 is no energy function"):
            force.setEnergyFunction(4)
        with self.assertRaisesRegex(openmm.OpenMMException, "2 particles has 3 radii"):
            force.addChain([0, 1], [1, 2, 3])
        system = openmm.System()
        for _ in range(6):
            system.addParticle(1)
        force.addChain([2], [0.1])
        system.addForce(force)
        for platform in PLATFORMS:
            with self.assertRaisesRegex(openmm.OpenMMException, "chains 0 and 2 share particle 2"):
                context_of(system, platform)


class SimulationTest(unittest.TestCase):
    def check(self, context, force, chain_beads, box, strength, function=NecklaceContactForce.WCA):
        """Compares the present energy, forces and contacts with all pairs."""
        state = context.getState(getPositions=True, getEnergy=True, getForces=True, groups={1})
        positions = np.array(state.getPositions(asNumpy=True)._value)
        energy, forces, pairs = all_pairs(positions, chain_beads, box, strength, function)
        scale = max(1, np.max(np.abs(forces)))
        self.assertAlmostEqual(state.getPotentialEnergy()._value / max(1, energy), energy / max(1, energy), delta=1e-9)
        np.testing.assert_allclose(state.getForces(asNumpy=True)._value, forces, atol=1e-9 * scale)
        contacts = force.getContacts(context)
        self.assertEqual([(i, j) for i, j, _ in contacts], pairs)
        for i, j, gap in contacts:
            apart = positions[j] - positions[i]
            apart -= 0 if box is None else box * np.round(apart / box)
            self.assertAlmostEqual(gap.value_in_unit(unit.nanometer), np.linalg.norm(apart) - 2 * RADIUS, delta=1e-10)
        return len(pairs)

    def test_minimisation_and_dynamics(self):
        for box in (None, BOX):
            for platform in PLATFORMS:
                with self.subTest(platform=platform, box=box):
                    system, positions, force = bead_chains(box=box)
                    integrator = openmm.LangevinMiddleIntegrator(300, 5, 0.005)
                    integrator.setRandomNumberSeed(3)
                    context = context_of(system, platform, integrator)
                    before, _ = energy_and_forces(context, positions)
                    self.check(context, force, 30, box, 2)
                    openmm.LocalEnergyMinimizer.minimize(context, 1)
                    after, _ = energy_and_forces(context)
                    self.assertLess(after, 0.1 * before)
                    touched = 0
                    for _ in range(5):
                        integrator.step(40)
                        touched += self.check(context, force, 30, box, 2)
                    self.assertGreater(touched, 0)

    def test_simulation_with_reporter(self):
        system, positions, _ = bead_chains()
        topology = app.Topology()
        for _ in range(3):
            chain = topology.addChain()
            for _ in range(30):
                topology.addAtom("C", app.element.carbon, topology.addResidue("BEA", chain))
        for platform in PLATFORMS:
            with self.subTest(platform):
                integrator = openmm.LangevinMiddleIntegrator(300, 5, 0.005)
                integrator.setRandomNumberSeed(4)
                simulation = app.Simulation(topology, system, integrator, openmm.Platform.getPlatformByName(platform))
                simulation.context.setPositions(positions)
                simulation.minimizeEnergy(maxIterations=100)
                simulation.context.setVelocitiesToTemperature(300, 6)
                log = io.StringIO()
                simulation.reporters.append(app.StateDataReporter(log, 50, step=True, temperature=True))
                simulation.step(200)
                lines = log.getvalue().splitlines()
                self.assertEqual(len(lines), 5)
                self.assertTrue(150 < float(lines[-1].split(",")[1]) < 500, lines)

    def test_two_contexts_and_updated_parameters(self):
        for platform in PLATFORMS:
            with self.subTest(platform):
                system, positions, force = bead_chains()
                other, of_other, its_force = bead_chains(chains=2, beads=45, box=BOX, seed=5, strength=1.5)
                contexts = context_of(system, platform), context_of(other, platform)
                rng = np.random.default_rng(9)
                for _ in range(3):
                    for context, at, contacts, beads, box, strength in (
                            (contexts[0], positions, force, 30, None, 2), (contexts[1], of_other, its_force, 45, BOX, 1.5)):
                        at += 0.01 * rng.normal(size=at.shape)
                        context.setPositions(at)
                        self.check(context, contacts, beads, box, strength)
                force.setStrength(3)
                force.updateParametersInContext(contexts[0])
                self.check(contexts[0], force, 30, None, 3)
                self.check(contexts[1], its_force, 45, BOX, 1.5)

    def test_energy_functions(self):
        for function in (NecklaceContactForce.WCA, NecklaceContactForce.Harmonic, NecklaceContactForce.SoftCosine):
            for platform in PLATFORMS:
                system, positions, force = bead_chains(seed=7)
                force.setEnergyFunction(function)
                context = context_of(system, platform)
                context.setPositions(positions)
                self.assertGreater(self.check(context, force, 30, None, 2, function), 10)

    def test_checkpoints(self):
        system, positions, _ = bead_chains(box=BOX)
        for platform in PLATFORMS:
            with self.subTest(platform):
                integrator = openmm.VerletIntegrator(0.002)
                context = context_of(system, platform, integrator)
                context.setPositions(positions)
                openmm.LocalEnergyMinimizer.minimize(context, 10)
                first, second = positions_from_checkpoint(context, integrator)
                np.testing.assert_allclose(second, first, atol=1e-6)


if __name__ == "__main__":
    unittest.main()
