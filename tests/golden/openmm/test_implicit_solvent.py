#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Implicit solvent by the drop-in: GBSAOBCForce and the CustomGBForces of openmm.app, against all pairs and OpenMM.

With DCH_BORN_SCENES=84 in the environment there are 1,008 random scenes (6 models, with a box and without, 84 seeds).
"""

import os
import unittest
import unittest.mock

import numpy as np
import openmm
from openmm import unit
from openmm.app.internal import customgbforces

import born_oracle
import openmm_dch
from drop_in_case import DropInCase
from openmm_systems import PLATFORMS, context_of, energy_and_forces, relative_error

MODELS = ("GBSAOBC",) + tuple(born_oracle.FORMS)
FORCES = {"Reference": 1e-10, "CPU": 5e-6}   # of their root mean square
ENERGY = {"Reference": 1e-11, "CPU": 1e-6}   # of the sum of the absolute energies of particles by themselves
SCENES = int(os.environ.get("DCH_BORN_SCENES", "3"))


def scale_of(scene):
    """What energies are small differences of [kJ/mol]."""
    return max(1.0, float(np.sum(139 * scene["charge"]**2 / scene["radius"])))


class ImplicitSolventTest(DropInCase):
    def ours(self, system, platform):
        context = context_of(system, platform)
        self.assertEqual([s["direct"] for s in openmm_dch.status(context)], ["DCH"] * system.getNumForces())
        return context

    def expect(self, scene, expected, found, platform, factor=1):
        self.assertTrue(np.isfinite(found[0]) and np.all(np.isfinite(found[1])))
        self.assertLess(abs(found[0] - expected[0]) / scale_of(scene), factor * ENERGY[platform])
        self.assertLess(relative_error(expected[1], found[1]), factor * FORCES[platform])

    def test_random_scenes_equal_all_pairs(self):
        for form in MODELS:
            for periodic in (False, True):
                for seed in range(SCENES):
                    scene = born_oracle.random_scene(form, seed, periodic)
                    system = born_oracle.make_system(scene, born_oracle.make_force(scene))
                    expected = born_oracle.energy_and_forces(scene)
                    for platform in PLATFORMS:
                        with self.subTest(form=form, periodic=periodic, seed=seed, platform=platform):
                            found = energy_and_forces(self.ours(system, platform), scene["positions"])
                            self.expect(scene, expected, found, platform)

    def test_native_agrees(self):
        for form in MODELS:
            scene = born_oracle.random_scene(form, 5, False, 150)
            system = born_oracle.make_system(scene, born_oracle.make_force(scene))
            expected = energy_and_forces(self.native(system), scene["positions"])
            for platform in PLATFORMS:
                with self.subTest(form=form, platform=platform):
                    found = energy_and_forces(self.ours(system, platform), scene["positions"])
                    self.expect(scene, expected, found, platform, 1 if platform == "CPU" else 10)

    def test_updates(self):
        for form in MODELS:
            scene = born_oracle.random_scene(form, 11, True, 40)
            tables = []  # openmm.app keeps none to change
            with unittest.mock.patch.object(customgbforces, "Discrete2DFunction",
                                            lambda *words: tables.append(openmm.Discrete2DFunction(*words)) or tables[-1]):
                force = born_oracle.make_force(scene)
            self.assertEqual(len(tables), 2 if form in ("GBn", "GBn2") else 0)
            system = born_oracle.make_system(scene, force)
            contexts = {platform: self.ours(system, platform) for platform in PLATFORMS}
            for round_ in range(2):
                scene["charge"] = scene["charge"][::-1] * 0.9
                for i, q in enumerate(scene["charge"]):
                    flat = [p._value if unit.is_quantity(p) else p for p in force.getParticleParameters(i)]
                    flat[0] = q
                    force.setParticleParameters(i, *([flat] if form != "GBSAOBC" else flat))
                if tables:
                    width, height, values = tables[1].getFunctionParameters()
                    tables[1].setFunctionParameters(width, height, [0.5 * value for value in values])
                    scene["neck_height"] = 0.5 * scene["neck_height"]
                expected = born_oracle.energy_and_forces(scene)
                for platform, context in contexts.items():
                    with self.subTest(form=form, platform=platform, round=round_):
                        force.updateParametersInContext(context)
                        self.expect(scene, expected, energy_and_forces(context, scene["positions"]), platform)

    def test_radii_without_a_value(self):
        """OpenMM gives NaN for a radius that is not over the offset: such a force stays with it, such an update is
        refused."""
        scene = born_oracle.random_scene("GBSAOBC", 3, False, 20)
        force = born_oracle.make_force(scene)
        system = born_oracle.make_system(scene, force)
        contexts = [self.ours(system, platform) for platform in PLATFORMS]
        charge, _, screen = force.getParticleParameters(4)
        force.setParticleParameters(4, charge, 0, screen)
        for context in contexts:
            with self.assertRaisesRegex(openmm.OpenMMException, "particle 4 has no Born radius"):
                force.updateParametersInContext(context)
        force.setParticleParameters(4, charge, 0.005, screen)  # OpenMM itself refuses 0 here
        for platform in PLATFORMS:
            status, = openmm_dch.status(context_of(system, platform))
            self.assertEqual(status["direct"], "OpenMM")
            self.assertIn("particle 4", status["reason"])
        force.setParticleParameters(4, charge, 0.15, 0)  # nothing is wrong with one that does not screen
        scene["radius"][4], scene["screen"][4] = 0.15, 0
        expected = born_oracle.energy_and_forces(scene)
        for platform, context in zip(PLATFORMS, contexts):
            force.updateParametersInContext(context)
            self.expect(scene, expected, energy_and_forces(context, scene["positions"]), platform)

    def test_particles_at_the_same_place(self):
        """They count as at their limit, and do not push each other."""
        for form in MODELS:
            scene = born_oracle.random_scene(form, 21, False, 12)
            system = born_oracle.make_system(scene, born_oracle.make_force(scene))
            near = scene["positions"].copy()
            near[5] = near[4] + [1e-5, 0, 0]
            scene["positions"] = near
            expected = born_oracle.energy_and_forces(scene)[0]
            for platform in PLATFORMS:
                with self.subTest(form=form, platform=platform):
                    same = near.copy()
                    same[5] = same[4]
                    energy, forces = energy_and_forces(self.ours(system, platform), same)
                    self.assertTrue(np.all(np.isfinite(forces)))
                    self.assertLess(abs(energy - expected) / scale_of(scene), 1e-3)

    def test_particles_far_from_all(self):
        for form in MODELS:
            scene = born_oracle.random_scene(form, 31, False, 12)
            scene["positions"][3] += [50, 0, 0]
            scene["positions"][7] -= [0, 1000, 0]
            system = born_oracle.make_system(scene, born_oracle.make_force(scene))
            expected = born_oracle.energy_and_forces(scene)
            for platform in PLATFORMS:
                with self.subTest(form=form, platform=platform):
                    found = energy_and_forces(self.ours(system, platform), scene["positions"])
                    self.expect(scene, expected, found, platform, 1 if platform == "CPU" else 100)
                    self.assertEqual(np.count_nonzero(found[1][[3, 7]]), 0)

    def test_motion_and_box(self):
        """Lists follow particles and box, in small steps and in jumps."""
        for form in ("GBSAOBC", "GBn2"):
            for platform in PLATFORMS:
                scene = born_oracle.random_scene(form, 41, True, 30)
                context = self.ours(born_oracle.make_system(scene, born_oracle.make_force(scene)), platform)
                rng = np.random.default_rng(1)
                for step in range(8):
                    with self.subTest(form=form, platform=platform, step=step):
                        grown = 1.01 if step % 2 else 1.0
                        scene["box"] = scene["box"] * grown
                        scene["positions"] = scene["positions"] * grown + rng.normal(size=(30, 3)) * 0.002
                        scene["positions"] += scene["box"].sum(axis=0) * (3 if step == 5 else 0)
                        context.setPeriodicBoxVectors(*scene["box"])
                        found = energy_and_forces(context, scene["positions"])
                        self.expect(scene, born_oracle.energy_and_forces(scene), found, platform, 10)

    def test_groups_threads_and_contexts(self):
        """Several forces and Contexts side by side, in force groups; the same bits on any number of threads."""
        scene = born_oracle.random_scene("OBC2", 51, False, 400)
        first, second = born_oracle.make_force(scene), born_oracle.make_force({**scene, "form": "HCT"})
        second.setForceGroup(3)
        system = born_oracle.make_system(scene, first, second)
        platform = openmm.Platform.getPlatformByName("CPU")
        found = []
        for threads in ("1", "2", "3"):
            context = openmm.Context(system, openmm.VerletIntegrator(0.001), platform, {"Threads": threads})
            context.setPositions(scene["positions"])
            states = [context.getState(getEnergy=True, getForces=True, groups=g) for g in (1, 1 << 3, -1)]
            energies = [s.getPotentialEnergy()._value for s in states]
            forces = [s.getForces(asNumpy=True)._value for s in states]
            self.assertAlmostEqual(energies[0] + energies[1], energies[2], delta=1e-9 * abs(energies[2]))
            np.testing.assert_allclose(forces[0] + forces[1], forces[2], atol=1e-9 * np.max(np.abs(forces[2])))
            found.append((energies, forces[2].tobytes()))
        self.assertEqual(found[0], found[1])
        self.assertEqual(found[0], found[2])

    def test_what_is_not_covered_is_openmms(self):
        scene = born_oracle.random_scene("OBC2", 61, False, 10)

        def reason_of(force):
            status, = openmm_dch.status(context_of(born_oracle.make_system(scene, force), "Reference"))
            self.assertEqual(status["direct"], "DCH" if status["reason"] == "" else "OpenMM")
            return status["reason"]

        def changed(change):
            force = born_oracle.make_force(scene)
            change(force)
            return reason_of(force)

        def replace_last_term(old, new):
            def change(force):
                last = force.getNumEnergyTerms() - 1
                expression, kind = force.getEnergyTermParameters(last)
                force.setEnergyTermParameters(last, expression.replace(old, new), kind)
            return change

        self.assertEqual(changed(lambda f: None), "")
        other = "other than those that openmm.app writes"
        self.assertIn("NoCutoff", changed(lambda f: f.setNonbondedMethod(f.NoCutoff)))
        self.assertIn(other, changed(lambda f: f.addGlobalParameter("scale", 1)))
        self.assertIn(other, changed(lambda f: f.addEnergyTerm("charge", f.SingleParticle)))
        self.assertIn(other, changed(replace_last_term("B1*B2*exp", "B2*B1*exp")))
        self.assertIn(other, changed(replace_last_term("kappa=", "kappa=1")))
        expression = born_oracle.make_force(scene).getComputedValueParameters(1)[1]
        self.assertIn(other, changed(lambda f: f.setComputedValueParameters(
            1, "B", expression.replace("4.85", "4.86"), f.SingleParticle)))
        force = born_oracle.make_force({**scene, "form": "GBSAOBC", "surface_energy": 1})
        force.setNonbondedMethod(force.NoCutoff)
        self.assertIn("NoCutoff", reason_of(force))

    def test_dynamics_conserve_energy_as_openmm_does(self):
        scene = born_oracle.random_scene("GBn", 71, False, 60)
        system = born_oracle.make_system(scene, born_oracle.make_force(scene))
        for i in range(60):
            bond = openmm.CustomExternalForce("500*((x-x0)^2+(y-y0)^2+(z-z0)^2)") if i == 0 else bond
            if i == 0:
                for name in ("x0", "y0", "z0"):
                    bond.addPerParticleParameter(name)
            bond.addParticle(i, scene["positions"][i])
        system.addForce(bond)
        positions = []
        for make in (self.native, lambda s, p: context_of(s, p)):
            context = make(system, "CPU")
            context.setPositions(scene["positions"])
            context.getIntegrator().step(50)
            positions.append(context.getState(getPositions=True).getPositions(asNumpy=True)._value)
        self.assertLess(np.max(np.abs(positions[0] - positions[1])), 1e-4)


if __name__ == "__main__":
    unittest.main()
