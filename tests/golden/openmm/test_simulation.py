#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""DCHNonbondedForce in simulations: reporters, checkpoints, minimisation, thermostats, barostats, skewed boxes."""

import copy
import io
import os
import tempfile
import unittest

import numpy as np
import openmm
from openmm import app, unit

import openmm_dch
from openmm_dch import DCHNonbondedForce
from openmm_systems import (PLATFORMS, all_pairs_lennard_jones, context_of, energy_and_forces, lennard_jones_fluid,
                            positions_from_checkpoint, relative_error, water_box)

TOLERANCE = {"Reference": 1e-9, "CPU": 1e-5}


class SimulationTest(unittest.TestCase):
    def test_simulation_with_reporters(self):
        system, positions, topology = water_box()
        openmm_dch.replaceNonbonded(system)
        for platform in PLATFORMS:
            with self.subTest(platform), tempfile.TemporaryDirectory() as folder:
                integrator = openmm.LangevinMiddleIntegrator(300, 1, 0.002)
                integrator.setRandomNumberSeed(5)
                simulation = app.Simulation(topology, system, integrator, openmm.Platform.getPlatformByName(platform))
                simulation.context.setPositions(positions)
                # Of 100 iterations or fewer OpenMM 8.1 at times takes none back with it, with its own force too.
                simulation.minimizeEnergy(maxIterations=300)
                simulation.context.setVelocitiesToTemperature(300, 6)
                log, pdb = io.StringIO(), os.path.join(folder, "water.pdb")
                simulation.reporters.append(
                    app.StateDataReporter(log, 20, step=True, potentialEnergy=True, temperature=True, volume=True))
                simulation.reporters.append(app.PDBReporter(pdb, 20))
                simulation.step(40)
                lines = log.getvalue().splitlines()
                self.assertEqual(len(lines), 3)
                temperature = float(lines[-1].split(",")[2])
                self.assertTrue(150 < temperature < 450, temperature)
                with open(pdb, encoding="utf-8") as file:
                    self.assertEqual(file.read().count("ENDMDL"), 2)

    def test_checkpoints(self):
        system, positions = lennard_jones_fluid(6, 2.2)
        openmm_dch.replaceNonbonded(system)
        for platform, tolerance in (("Reference", 1e-9), ("CPU", 1e-5)):
            with self.subTest(platform):
                integrator = openmm.VerletIntegrator(0.002)
                context = context_of(system, platform, integrator)
                context.setPositions(positions)
                first, second = positions_from_checkpoint(context, integrator)
                np.testing.assert_allclose(second, first, atol=tolerance)

    def test_two_contexts_at_once(self):
        small, of_small = lennard_jones_fluid(5, 1.9, seed=3)
        large, of_large = lennard_jones_fluid(7, 2.7, cutoff=1.1, seed=4)
        for system in (small, large):
            system.getForce(0).setUseDispersionCorrection(False)
            openmm_dch.replaceNonbonded(system)
        for platform in PLATFORMS:
            with self.subTest(platform):
                contexts = context_of(small, platform), context_of(large, platform)
                rng = np.random.default_rng(9)
                for _ in range(3):
                    for context, positions, edge, cutoff in ((contexts[0], of_small, 1.9, 0.85),
                                                             (contexts[1], of_large, 2.7, 1.1)):
                        positions += 0.01 * rng.normal(size=positions.shape)
                        energy, forces = energy_and_forces(context, positions)
                        expected = all_pairs_lennard_jones(positions, np.eye(3) * edge, cutoff)
                        self.assertLess(relative_error(expected[1], forces), TOLERANCE[platform])
                        self.assertAlmostEqual(energy / expected[0], 1, delta=TOLERANCE[platform])

    def test_minimisation(self):
        system, positions = lennard_jones_fluid(6, 2.1)
        openmm_dch.replaceNonbonded(system)
        for platform in PLATFORMS:
            with self.subTest(platform):
                context = context_of(system, platform)
                before, forces = energy_and_forces(context, positions)
                openmm.LocalEnergyMinimizer.minimize(context, 1.0)
                after, forces_after = energy_and_forces(context)
                self.assertLess(after, before - 10)
                self.assertLess(np.sqrt(np.mean(forces_after**2)), 2)

    def test_update_parameters(self):
        system, positions = lennard_jones_fluid(5, 2)
        system.getForce(0).setUseDispersionCorrection(False)
        force, = openmm_dch.replaceNonbonded(system)
        for platform in PLATFORMS:
            with self.subTest(platform):
                for i in range(force.getNumParticles()):
                    force.setParticleParameters(i, 0, 0.34, 0.996)
                context = context_of(system, platform)
                energy_and_forces(context, positions)
                for i in range(force.getNumParticles()):
                    force.setParticleParameters(i, 0, 0.3, 0.5)
                force.updateParametersInContext(context)
                energy, _ = energy_and_forces(context)
                expected, _ = all_pairs_lennard_jones(positions, np.eye(3) * 2, 0.85, 0.3, 0.5)
                self.assertAlmostEqual(energy / expected, 1, delta=TOLERANCE[platform])


class BoxTest(unittest.TestCase):
    def test_monte_carlo_barostats(self):
        barostats = (openmm.MonteCarloBarostat(300, 90, 2), openmm.MonteCarloAnisotropicBarostat((300, 300, 300), 90))
        for barostat in barostats:
            for platform in PLATFORMS:
                with self.subTest(platform=platform, barostat=barostat.getName()):
                    system, positions = lennard_jones_fluid(6, 2.2)
                    system.getForce(0).setUseDispersionCorrection(False)
                    openmm_dch.replaceNonbonded(system)
                    barostat.setRandomNumberSeed(2)
                    barostat.setFrequency(2)
                    system.addForce(copy.deepcopy(barostat))
                    integrator = openmm.LangevinMiddleIntegrator(90, 1, 0.002)
                    integrator.setRandomNumberSeed(1)
                    context = context_of(system, platform, integrator)
                    context.setPositions(positions)
                    openmm.LocalEnergyMinimizer.minimize(context, 10)
                    volumes = set()
                    for _ in range(5):
                        integrator.step(20)
                        state = context.getState(getPositions=True, getEnergy=True, getForces=True)
                        vectors = np.array(state.getPeriodicBoxVectors(asNumpy=True)._value)
                        volumes.add(round(np.linalg.det(vectors), 9))
                        expected = all_pairs_lennard_jones(
                            np.array(state.getPositions(asNumpy=True)._value), vectors, 0.85)
                        self.assertAlmostEqual(state.getPotentialEnergy()._value / expected[0], 1,
                                               delta=TOLERANCE[platform])
                        self.assertLess(relative_error(expected[1], state.getForces(asNumpy=True)._value),
                                        TOLERANCE[platform])
                    self.assertGreater(len(volumes), 3)

    def test_skewed_boxes(self):
        dodecahedron = 2.6 * np.array([[1, 0, 0], [0, 1, 0], [0.5, 0.5, np.sqrt(0.5)]])
        octahedron = 2.4 * np.array([[1, 0, 0], [1 / 3, np.sqrt(8 / 9), 0], [-1 / 3, np.sqrt(2 / 9), np.sqrt(2 / 3)]])
        for box in (dodecahedron, octahedron):
            system, positions = lennard_jones_fluid(6, 0, box, cutoff=0.9)
            system.getForce(0).setUseDispersionCorrection(False)
            openmm_dch.replaceNonbonded(system)
            for platform in PLATFORMS:
                with self.subTest(platform):
                    integrator = openmm.VerletIntegrator(0.002)
                    context = context_of(system, platform, integrator)
                    context.setPositions(positions)
                    context.setVelocitiesToTemperature(100, 1)
                    for _ in range(2):
                        integrator.step(40)
                        state = context.getState(getPositions=True, getForces=True)
                        expected = all_pairs_lennard_jones(np.array(state.getPositions(asNumpy=True)._value), box, 0.9)
                        self.assertLess(relative_error(expected[1], state.getForces(asNumpy=True)._value),
                                        TOLERANCE[platform])

    def test_particles_that_wandered_through_many_boxes(self):
        # Their positions have few digits left: those of a million boxes are 5e-10 nm apart.
        skewed = 2.6 * np.array([[1, 0, 0], [0.3, 1, 0], [-0.35, 0.4, 1]])
        for box in (2.6 * np.eye(3), skewed):
            system, at_home = lennard_jones_fluid(6, 0, box, cutoff=0.9)
            system.getForce(0).setUseDispersionCorrection(False)
            openmm_dch.replaceNonbonded(system)
            for platform in PLATFORMS:
                for periods in (1e3, 1e6):
                    with self.subTest(platform=platform, periods=periods):
                        rng = np.random.default_rng(5)
                        positions = at_home + np.round(periods * rng.uniform(-1, 1, at_home.shape)) @ box
                        context = context_of(system, platform)
                        for _ in range(3):
                            energy, forces = energy_and_forces(context, positions)
                            expected = all_pairs_lennard_jones(positions, box, 0.9)
                            tolerance = max(TOLERANCE[platform], 1e-12 * periods)
                            self.assertLess(relative_error(expected[1], forces), tolerance)
                            self.assertAlmostEqual(energy / expected[0], 1, delta=tolerance)
                            positions += 0.01 * rng.normal(size=positions.shape)


if __name__ == "__main__":
    unittest.main()
