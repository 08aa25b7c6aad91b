#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What OpenMM refuses is refused with the drop-in too, in the same words at first; and what neither may pass in silence."""

import unittest

import numpy as np
import openmm
from openmm.app.internal import customgbforces

from drop_in_case import DropInCase, system_of
from openmm_systems import PLATFORMS, context_of, energy_and_forces

POSITIONS = np.array([[0, 0, 0], [0.9, 0, 0], [0, 0.8, 0], [0, 0, 1.1], [1, 1, 1.0]])
BOX = 2.5 * np.eye(3)
METHODS = ("NoCutoff", "CutoffNonPeriodic", "CutoffPeriodic", "Ewald", "PME", "LJPME")
PERIODIC = METHODS[2:]


def charges(method="CutoffPeriodic"):
    force = openmm.NonbondedForce()
    for i in range(len(POSITIONS)):
        force.addParticle(0.1 * (i - 2), 0.3, 0.5)
    force.setNonbondedMethod(getattr(force, method))
    force.setCutoffDistance(0.9)
    force.addGlobalParameter("p", 0)
    force.addException(0, 1, 0, 1, 0)
    force.addException(0, 2, 0.1, 0.3, 0.2)
    force.addException(0, 3, 0, 1, 0)
    force.addExceptionParameterOffset("p", 2, 0.1, 0, 0)
    return force


def solvent(method="CutoffPeriodic"):
    force = openmm.GBSAOBCForce()
    for _ in POSITIONS:
        force.addParticle(0.2, 0.15, 0.8)
    force.setNonbondedMethod(getattr(force, method))
    force.setCutoffDistance(0.9)
    return force


def custom(method="CutoffPeriodic"):
    force = customgbforces.GBSAOBC2Force(cutoff=0.9)
    for _ in POSITIONS:
        force.addParticle([0.2, 0.15, 0.8])
    force.finalize()
    force.setNonbondedMethod(getattr(force, method))
    force.setCutoffDistance(0.9)
    return force


def more_particles(force):
    parameters = force.getParticleParameters(0)
    if isinstance(force, openmm.CustomGBForce):
        openmm.CustomGBForce.addParticle(force, list(parameters))
    else:
        force.addParticle(*parameters)


class RefusalTest(DropInCase):
    def expect_same(self, make, act=lambda force, context: None, what=""):
        """Of a Context of a force and act(force, context), OpenMM's kernels do complain, and the drop-in says all of it."""
        for platform in PLATFORMS:
            said = []
            for context_by in (self.native, context_of):
                force = make()
                with self.subTest(platform=platform, what=what, by=context_by.__name__):
                    with self.assertRaises(openmm.OpenMMException) as caught:
                        context = context_by(system_of(force, box=BOX), platform)
                        context.setPositions(POSITIONS)
                        act(force, context)
                    said.append(str(caught.exception).rstrip("."))
            with self.subTest(platform=platform, what=what):
                self.assertTrue(said[-1].startswith(said[0]), said)

    def test_when_a_context_is_made(self):
        def changed(change, method="CutoffPeriodic"):
            def make():
                force = charges(method)
                change(force)
                return force
            return make

        def switch(at):
            def change(force):
                force.setUseSwitchingFunction(True)
                force.setSwitchingDistance(at)
            return change

        for what, change in (
                ("sigma", lambda f: f.setParticleParameters(1, 0, -0.1, 1)),
                ("epsilon", lambda f: f.setParticleParameters(1, 0, 0.1, -1)),
                ("sigma of exception", lambda f: f.setExceptionParameters(0, 0, 1, 0, -1, 0)),
                ("epsilon of exception", lambda f: f.setExceptionParameters(0, 0, 1, 0, 1, -1)),
                ("exception of 9", lambda f: f.setExceptionParameters(0, 0, 9, 0, 1, 0)),
                ("exception of -1", lambda f: f.setExceptionParameters(0, -1, 2, 0, 1, 0)),
                ("two exceptions", lambda f: f.setExceptionParameters(0, 0, 2, 0, 1, 0)),
                ("offset of particle", lambda f: f.addParticleParameterOffset("p", 9, 1, 0, 0)),
                ("offset of exception", lambda f: f.addExceptionParameterOffset("p", 9, 1, 0, 0)),
                ("switch before 0", switch(-0.1)), ("switch at the cutoff", switch(0.9)), ("switch beyond", switch(1))):
            self.expect_same(changed(change), what=what)
        for method in PERIODIC:
            self.expect_same(changed(lambda f: f.setCutoffDistance(1.26), method), what=method)

    def test_when_a_context_with_a_solvent_is_made(self):
        for make in (solvent, custom):
            def too_far():
                force = make()
                force.setCutoffDistance(1.26)
                return force
            self.expect_same(too_far, what=make.__name__)

        def no_radius():
            force = solvent()
            force.setParticleParameters(1, 0.2, -0.1, 0.8)
            return force
        self.expect_same(no_radius, what="radius")

    def test_a_particle_too_many(self):
        for force in (charges(), solvent(), custom()):
            system = system_of(force, box=BOX)
            system.addParticle(1)
            for platform in PLATFORMS:
                said = []
                for context_by in (self.native, context_of):
                    with self.assertRaisesRegex(openmm.OpenMMException, "exactly as many particles as") as caught:
                        context_by(system, platform)
                    said.append(str(caught.exception))
                self.assertEqual(said[0], said[1])

    def test_a_skewed_box_with_ewald(self):
        force = charges("Ewald")
        for platform in PLATFORMS:
            said = []
            for make in (self.native, context_of):
                with self.assertRaises(openmm.OpenMMException) as caught:
                    make(system_of(openmm.XmlSerializer.clone(force), box=BOX + [[0, 0, 0], [0.2, 0, 0], [0, 0, 0]]), platform)
                said.append(str(caught.exception))
            self.assertEqual(said[0], said[1])

    def test_when_parameters_are_updated(self):
        def update(change):
            def act(force, context):
                change(force)
                force.updateParametersInContext(context)
            return act

        changes = (more_particles, lambda f: f.addException(1, 2, 0.1, 1, 0),
                   lambda f: f.setExceptionParameters(0, 0, 1, 0.1, 1, 0), lambda f: f.setExceptionParameters(1, 0, 2, 0, 1, 0))
        for method in METHODS:
            for number, change in enumerate(changes):
                self.expect_same(lambda: charges(method), update(change), (method, number))
        for make in (solvent, custom):
            for method in METHODS[:3]:
                self.expect_same(lambda: make(method), update(more_particles), (make.__name__, method))

    def test_an_update_that_is_refused_changes_nothing(self):
        for platform in PLATFORMS:
            force = charges()
            context = context_of(system_of(force, box=BOX), platform)
            before = energy_and_forces(context, POSITIONS)
            force.setParticleParameters(1, 3, 0.3, 1)
            force.addParticleParameterOffset("p", 9, 1, 0, 0)
            with self.assertRaisesRegex(openmm.OpenMMException, "Illegal particle index for a particle parameter offset: 9"):
                force.updateParametersInContext(context)
            force.setParticleParameterOffset(0, "p", 1, 1, 0, 0)
            force.addExceptionParameterOffset("p", 3, 1, 0, 0)
            with self.assertRaisesRegex(openmm.OpenMMException,
                                        "Illegal exception index for an exception parameter offset: 3"):
                force.updateParametersInContext(context)
            after = energy_and_forces(context, POSITIONS)
            self.assertEqual(before[0], after[0])
            np.testing.assert_array_equal(before[1], after[1])

    def test_a_box_that_shrinks(self):
        def shrink(_, context):
            context.setPeriodicBoxVectors(*(0.7 * BOX))
            energy_and_forces(context)

        for method in PERIODIC:
            self.expect_same(lambda: charges(method), shrink, method)
        for make in (solvent, custom):  # where OpenMM's own kernels may end the program
            for platform in PLATFORMS:
                context = context_of(system_of(make(), box=BOX), platform)
                context.setPositions(POSITIONS)
                with self.subTest(force=make.__name__, platform=platform):
                    with self.assertRaisesRegex(openmm.OpenMMException, "has decreased to less than twice the nonbonded"):
                        shrink(None, context)

    def test_parameters_of_a_mesh_that_is_not_there(self):
        for method in METHODS:
            for platform in PLATFORMS:
                force = charges(method)
                context = context_of(system_of(force, box=BOX), platform)
                with self.subTest(method=method, platform=platform):
                    if method not in ("PME", "LJPME"):
                        with self.assertRaisesRegex(openmm.OpenMMException, "This Context is not using PME or LJPME"):
                            force.getPMEParametersInContext(context)
                    if method != "LJPME":
                        with self.assertRaisesRegex(openmm.OpenMMException, "This Context is not using LJPME"):
                            force.getLJPMEParametersInContext(context)

    def test_parameters_of_a_mesh_that_have_no_value(self):
        """By OpenMM the splitting alone says whether all is chosen; without a grid its kernels end the program."""
        for method, name in (("PME", "setPMEParameters"), ("LJPME", "setLJPMEParameters")):
            for bad in ((3, 0, 0, 0), (-1, 20, 20, 20), (3, -4, 20, 20), (3, 20, 20, 2)):
                force = charges(method)
                getattr(force, name)(*bad)
                for platform in PLATFORMS:
                    with self.subTest(method=method, platform=platform, parameters=bad):
                        with self.assertRaisesRegex(openmm.OpenMMException, "of a mesh is|points along a vector was asked for"):
                            energy_and_forces(context_of(system_of(openmm.XmlSerializer.clone(force), box=BOX), platform), POSITIONS)

    def test_positions_that_are_not_finite(self):
        for make, methods in ((charges, METHODS), (solvent, ("CutoffNonPeriodic", "CutoffPeriodic")),
                              (custom, ("CutoffNonPeriodic", "CutoffPeriodic"))):
            for method in methods:
                for platform in PLATFORMS:
                    context = context_of(system_of(make(method), box=BOX), platform)
                    for bad in (np.nan, np.inf):
                        positions = POSITIONS.copy()
                        positions[2, 1] = bad
                        with self.subTest(force=make.__name__, method=method, platform=platform, position=bad):
                            with self.assertRaises(openmm.OpenMMException):
                                energy_and_forces(context, positions)
                    self.assertTrue(np.isfinite(energy_and_forces(context, POSITIONS)[0]))


if __name__ == "__main__":
    unittest.main()
