#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The drop-in in Python: enable(), disable(), status(), the environment variable, and scripts that do not change."""

import copy
import os
import subprocess
import sys
import unittest

import numpy as np
import openmm
from openmm import app, unit

import openmm_dch
from openmm_systems import PLATFORMS, context_of, energy_and_forces, positions_from_checkpoint, relative_error, water_box

# Of forces, relative, and of energies, in kJ/mol an atom.
TOLERANCE = {"Reference": 1e-9, "CPU": 5e-6}
ENERGY_TOLERANCE = {"Reference": 1e-8, "CPU": 1e-4}


def pme_water(method=app.PME, **options):
    system, positions, topology = water_box()
    topology.setPeriodicBoxVectors(np.eye(3) * 1.8642 * unit.nanometer)
    system = app.ForceField("tip3p.xml").createSystem(
        topology, nonbondedMethod=method, nonbondedCutoff=0.7 * unit.nanometer, rigidWater=True, **options)
    force, = (f for f in system.getForces() if isinstance(f, openmm.NonbondedForce))
    force.setPMEParameters(3.5, 24, 25, 24)  # the same on both platforms
    force.setLJPMEParameters(3.6, 21, 20, 18)
    return system, positions, topology


def run_script(text, **environment):
    """Runs it in a Python of its own, as a user would who knows of the package's folder; what it wrote."""
    site = os.path.dirname(os.path.dirname(os.path.abspath(openmm_dch.__file__)))
    first = f"import site; site.addsitedir({site!r})\n"
    done = subprocess.run([sys.executable, "-c", first + text], capture_output=True, text=True, check=False,
                          env={**os.environ, "PYTHONPATH": os.path.dirname(os.path.abspath(__file__)), **environment})
    return done.stdout, done.stderr


class DropInTest(unittest.TestCase):
    def setUp(self):
        openmm_dch.enable()

    def tearDown(self):
        openmm_dch.disable()

    def test_water_of_a_force_field(self):
        reciprocal = {"Reference": "OpenMM", "CPU": "DCH"}
        for method in (app.PME, app.LJPME, app.CutoffPeriodic):
            is_lattice_sum = method is not app.CutoffPeriodic
            system, positions, _ = pme_water(method) if is_lattice_sum else water_box()
            untouched = openmm.XmlSerializer.serialize(system)
            openmm_dch.disable()
            expected = energy_and_forces(context_of(system, "Reference"), positions)
            openmm_dch.enable()
            for platform in PLATFORMS:
                with self.subTest(platform=platform, method=str(method)):
                    context = context_of(system, platform)
                    index = [isinstance(f, openmm.NonbondedForce) for f in system.getForces()].index(True)
                    self.assertEqual(openmm_dch.status(context), [
                        {"force": index, "name": "NonbondedForce", "direct": "DCH",
                         "reciprocal": reciprocal[platform] if is_lattice_sum else "", "reason": ""}])
                    energy, forces = energy_and_forces(context, positions)
                    self.assertAlmostEqual(energy, expected[0], delta=ENERGY_TOLERANCE[platform] * len(positions))
                    self.assertLess(relative_error(expected[1], forces), TOLERANCE[platform])
            self.assertEqual(openmm.XmlSerializer.serialize(system), untouched)

    def test_in_double(self):
        self.assertRaisesRegex(ValueError, "precision is 'single'.*double.*mixed", openmm_dch.enable, "single")
        system, positions, _ = pme_water()
        dispersion, _, _ = pme_water(app.LJPME)
        ours, _, _ = water_box()
        openmm_dch.replaceNonbonded(ours)
        for each in (system, dispersion, ours):
            expected = energy_and_forces(context_of(each, "Reference"), positions)
            errors = []
            for precision in ("double", "mixed"):
                openmm_dch.enable(precision)
                errors.append(relative_error(expected[1], energy_and_forces(context_of(each, "CPU"), positions)[1]))
            self.assertLess(errors[0], 1e-10)
            self.assertGreater(errors[1], 1e-8)

    def test_forces_of_our_own_are_named_too(self):
        system, _, _ = water_box()
        openmm_dch.replaceNonbonded(system)
        status, = openmm_dch.status(context_of(system, "CPU"))
        self.assertEqual((status["direct"], status["name"]), ("DCH", "DCHNonbondedForce"))

    def test_simulations(self):
        system, positions, topology = pme_water(constraints=app.HBonds)
        barostat = openmm.MonteCarloBarostat(1, 300, 5)
        barostat.setRandomNumberSeed(4)
        system.addForce(barostat)
        integrator = openmm.LangevinMiddleIntegrator(300, 1, 0.002)
        integrator.setRandomNumberSeed(5)
        simulation = app.Simulation(topology, system, integrator, openmm.Platform.getPlatformByName("CPU"))
        simulation.context.setPositions(positions)
        simulation.minimizeEnergy(maxIterations=300)
        simulation.context.setVelocitiesToTemperature(300, 6)
        simulation.step(30)
        state = simulation.context.getState(getEnergy=True, getForces=True, getPositions=True)
        openmm_dch.disable()
        native = context_of(copy.deepcopy(system), "Reference")
        openmm_dch.enable()
        native.setState(state)
        energy, forces = energy_and_forces(native)
        self.assertAlmostEqual(state.getPotentialEnergy()._value, energy,
                               delta=ENERGY_TOLERANCE["CPU"] * len(positions))
        self.assertLess(relative_error(forces, state.getForces(asNumpy=True)._value), TOLERANCE["CPU"])

    def test_checkpoints(self):
        system, positions, _ = pme_water()
        integrator = openmm.VerletIntegrator(0.0005)
        context = context_of(system, "CPU", integrator)
        context.setPositions(positions)
        first, second = positions_from_checkpoint(context, integrator)
        np.testing.assert_allclose(second, first, atol=1e-5)

    def test_several_contexts(self):
        system, positions, _ = pme_water()
        contexts = [context_of(system, "CPU") for _ in range(2)]
        moved = positions + 0.002 * np.random.default_rng(1).normal(size=positions.shape)
        first = energy_and_forces(contexts[0], positions)[0]
        second = energy_and_forces(contexts[1], moved)[0]
        self.assertNotEqual(first, second)
        self.assertAlmostEqual(energy_and_forces(contexts[0], moved)[0] / second, 1, delta=1e-6)
        del contexts[0]
        self.assertEqual(openmm_dch.status(contexts[0])[0]["direct"], "DCH")


    def test_parameters_that_are_refused_are_refused_again(self):
        """OpenMM itself lets NaN pass."""
        system, positions, _ = pme_water()
        force, = (f for f in system.getForces() if isinstance(f, openmm.NonbondedForce))
        parameters = force.getParticleParameters(3)
        nan, alike = float("nan"), parameters[2]  # of all other oxygens
        cases = [("charge of particle 3", (nan, 0.3, 1)), ("sigma of particle 3", (0, nan, alike)),
                 ("epsilon of particle 3", (0, 0.3, nan)), ("sigma of particle 3", (0, -1, 1))]
        out_of_range = ("epsilon is inf", (0, 1, 1e300))  # of pairs, which are made beforehand on one platform alone
        for platform in PLATFORMS:
            context = context_of(system, platform)
            energy = energy_and_forces(context, positions)[0]
            for message, bad in cases + [out_of_range] * (platform == "CPU"):
                force.setParticleParameters(3, *bad)
                force.updateParametersInContext(context)
                for _ in range(2):
                    self.assertRaisesRegex(openmm.OpenMMException, message, energy_and_forces, context)
                force.setParticleParameters(3, *parameters)
                force.updateParametersInContext(context)
                self.assertEqual(energy_and_forces(context)[0], energy)


class ScriptTest(unittest.TestCase):
    SCRIPT = ("import openmm, sys\n"
              "from openmm_systems import context_of, water_box\n"
              "system, positions, _ = water_box()\n"
              "force = [f for f in system.getForces() if isinstance(f, openmm.NonbondedForce)][0]\n"
              "contexts = []\n"
              "force.setUseSwitchingFunction(True)\n"
              "force.setSwitchingDistance(0.5)\n"
              "for method in (force.CutoffPeriodic, force.LJPME, force.LJPME):\n"
              "    force.setNonbondedMethod(method)\n"
              "    contexts.append(context_of(system, 'CPU'))\n"
              "loaded = 'openmm_dch' in sys.modules\n"
              "import openmm_dch\n"
              "print(loaded, *[openmm_dch.status(c)[0]['direct'] for c in contexts])\n")

    def test_the_environment_variable_needs_no_import(self):
        looks_first = "import importlib.util\nassert importlib.util.find_spec('openmm')\n"
        for script in (self.SCRIPT, looks_first + self.SCRIPT):
            out, err = run_script(script, OPENMM_DCH="1")
            self.assertEqual(out, "True DCH OpenMM OpenMM\n", err)
            self.assertEqual(err, "openmm_dch: a NonbondedForce keeps OpenMM's own kernel: a switching function with "
                                  "the method LJPME is not covered\n")

    def test_where_there_is_no_openmm_the_variable_does_no_harm(self):
        out, err = run_script("import sys\n"
                              "sys.path[:] = [p for p in sys.path if 'dist-packages' not in p]\n"
                              "try:\n"
                              "    import openmm\n"
                              "except ModuleNotFoundError as error:\n"
                              "    print(error.name)\n", OPENMM_DCH="1")
        self.assertEqual((out, err), ("openmm\n", ""))

    def test_without_it_nothing_changes(self):
        for value in ("", "0"):
            self.assertEqual(run_script(self.SCRIPT, OPENMM_DCH=value), ("False OpenMM OpenMM OpenMM\n", ""))

    def test_enabling_after_a_context_warns(self):
        out, err = run_script("import openmm_dch\n" + self.SCRIPT +
                              "for _ in range(2):\n"
                              "    openmm_dch.enable()\n"
                              "    openmm_dch.disable()\n"
                              "    context_of(system, 'CPU')\n"
                              "print(openmm_dch.status(contexts[0])[0]['reason'])\n")
        self.assertEqual(out.splitlines()[1], "the drop-in was not enabled when the Context was made", err)
        self.assertEqual(err.count("UserWarning"), 1, err)
        self.assertIn("reinitialize", err)

    def test_a_program_without_the_cpu_platform_is_told(self):
        out, err = run_script("import openmm_dch\nopenmm_dch.enable()", OPENMM_PLUGIN_DIR=os.path.dirname(__file__))
        self.assertEqual(out, "")
        self.assertIn("OPENMM_PLUGIN_DIR", err)

    def test_plugins_that_were_loaded_before_openmms_own_are_told(self):
        own = openmm.Platform.getDefaultPluginsDirectory()
        out, err = run_script(f"import openmm, openmm_dch\nopenmm.Platform.loadPluginsFromDirectory({own!r})\n"
                              "openmm_dch.enable()", OPENMM_PLUGIN_DIR=os.path.dirname(__file__))
        self.assertEqual(out, "")
        self.assertIn("the platform CPU has no kernels of openmm_dch; load OpenMM's own plugins first", err)


if __name__ == "__main__":
    unittest.main()
