#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Implicit solvent with the drop-in in the cases of upstream's TestGBSAOBCForce and TestCustomGBForce.

Which test stands for which of upstream's cases is said in docs/openmm.md. Forces that no list of ours is for have to be
OpenMM's, untouched by what stands before its kernels.
"""

import math
import unittest

import numpy as np
import openmm

import openmm_dch
from drop_in_case import COULOMB, CUBE, DropInCase, energy_of, system_of
from openmm_systems import PLATFORMS, context_of, energy_and_forces, relative_error

SKEWED = np.array([[1, 0, 0], [0.1, 1, 0], [-0.1, -0.15, 1]])
GBSAOBC, CUSTOM = openmm.GBSAOBCForce, openmm.CustomGBForce


def solvent_of(particles, method=GBSAOBC.NoCutoff, cutoff=3.0):
    """Of particles by charge, radius and scale."""
    force = GBSAOBC()
    for particle in particles:
        force.addParticle(*particle)
    force.setNonbondedMethod(method)
    force.setCutoffDistance(cutoff)
    return force


def charges_of(particles, method=openmm.NonbondedForce.NoCutoff, cutoff=3.0):
    force = openmm.NonbondedForce()
    for charge, _, _ in particles:
        force.addParticle(charge, 1, 0)
    force.setNonbondedMethod(method)
    force.setCutoffDistance(cutoff)
    return force


def energy_of_one(charge, radius, solute=1.0, solvent=78.3, surface=2.25936):
    born = radius - 0.009
    field = -0.5 * COULOMB * (1 / solute - 1 / solvent) * charge**2 / born
    return field + 4 * math.pi * surface * (radius + 0.14) ** 2 * (radius / born) ** 6


class GBSAOBCCases(DropInCase):
    def test_one_particle(self):
        for method, computed_by in ((GBSAOBC.NoCutoff, "OpenMM"), (GBSAOBC.CutoffNonPeriodic, "DCH")):
            force = solvent_of([(0.5, 0.15, 1)], method)
            for platform, context in self.contexts(system_of(force), computed_by):
                with self.subTest(method=method, platform=platform):
                    context.setPositions([[0, 0, 0]])
                    for charge, radius in ((0.5, 0.15), (0.4, 0.25)):
                        force.setParticleParameters(0, charge, radius, 1)
                        force.updateParametersInContext(context)
                        self.assertAlmostEqual(energy_of(context), energy_of_one(charge, radius), delta=1e-4)
                    force.setParticleParameters(0, 0.5, 0.15, 1)

    def test_settings_of_all(self):
        for method, computed_by in ((GBSAOBC.NoCutoff, "OpenMM"), (GBSAOBC.CutoffNonPeriodic, "DCH")):
            force = solvent_of([(0.5, 0.15, 1)], method)
            force.setSoluteDielectric(2.1)
            force.setSolventDielectric(35)
            force.setSurfaceAreaEnergy(0.75)
            for platform, context in self.contexts(system_of(force), computed_by):
                with self.subTest(method=method, platform=platform):
                    context.setPositions([[0, 0, 0]])
                    self.assertAlmostEqual(energy_of(context), energy_of_one(0.5, 0.15, 2.1, 35, 0.75), delta=1e-4)

    def test_cutoffs_and_images(self):
        particles, side = [(-1, 0.15, 1), (1, 0.15, 1)], 10
        found = {platform: [] for platform in PLATFORMS}
        for away in (0, side):
            for method, of_charges in ((GBSAOBC.CutoffNonPeriodic, openmm.NonbondedForce.CutoffNonPeriodic),
                                       (GBSAOBC.CutoffPeriodic, openmm.NonbondedForce.CutoffPeriodic)):
                system = system_of(solvent_of(particles, method), charges_of(particles, of_charges), box=side * CUBE)
                for platform, context in self.contexts(system):
                    found[platform].append(energy_and_forces(context, [[0, 0, 0], [2 + away, 0, 0]])[1])
        for platform, (first, periodic, far, image) in found.items():
            with self.subTest(platform=platform):
                self.assertGreater(np.max(np.abs(first)), 1)
                self.assertLess(relative_error(first, image), 1e-5)
                # Charges have another energy at the cutoff with a box than without, not other forces.
                self.assertLess(relative_error(first, periodic), 1e-5)
                np.testing.assert_array_equal(far, np.zeros((2, 3)))

    def test_many_particles(self):
        """Against OpenMM's Reference platform, for which upstream takes 125 to 1,000."""
        rng = np.random.default_rng(2)
        for per_side, box in ((5, CUBE), (7, CUBE), (10, CUBE), (10, SKEWED)):
            particles = [(2 * (i % 2) - 1, 0.15, 1) for i in range(per_side**3)]
            grid = np.stack(np.meshgrid(*[np.arange(per_side)] * 3), axis=-1).reshape(-1, 3)
            positions = 1.1 * grid + 0.5 * rng.random(grid.shape)
            for method in (GBSAOBC.NoCutoff, GBSAOBC.CutoffNonPeriodic, GBSAOBC.CutoffPeriodic):
                if box is SKEWED and method != GBSAOBC.CutoffPeriodic:
                    continue
                system = system_of(solvent_of(particles, method), charges_of(particles, method),
                                   box=max(1.1 * (per_side + 1), 6.6) * box)
                expected = energy_and_forces(self.native(system), positions)
                for platform in PLATFORMS:
                    context = context_of(system, platform)
                    direct = [s["direct"] for s in openmm_dch.status(context)]
                    self.assertEqual(direct, ["OpenMM" if method == GBSAOBC.NoCutoff else "DCH", "DCH"])
                    with self.subTest(particles=len(particles), method=method, platform=platform, skewed=box is SKEWED):
                        energy, forces = energy_and_forces(context, positions)
                        self.assertAlmostEqual(energy / expected[0], 1, delta=1e-5)
                        self.assertLess(relative_error(expected[1], forces), 2e-4 if method == GBSAOBC.NoCutoff else 1e-5)
                        if method == GBSAOBC.NoCutoff and platform == "CPU":
                            self.expect_slope(context, positions, 0.03, 2e-2)


def custom_of(count, values, energies, parameters=(), method=CUSTOM.NoCutoff, cutoff=2.0):
    """A CustomGBForce of values (name, expression, type) and terms of the energy (expression, type)."""
    force = CUSTOM()
    for name in parameters:
        force.addPerParticleParameter(name)
    for value in values:
        force.addComputedValue(*value)
    for energy in energies:
        force.addEnergyTerm(*energy)
    for _ in range(count):
        force.addParticle([0.0] * len(parameters))
    force.setNonbondedMethod(method)
    force.setCutoffDistance(cutoff)
    return force


# The integral over what another particle takes of the solvent, and the Born radius by it.
INTEGRAL = ("I", "step(far-a)*0.5*(1/near-1/far+(r-s*s/r)*(1/(far*far)-1/(near*near))/4+log(near/far)/(2*r)+inside);"
                 "inside=2*(1/a-1/near)*step(s-r-a); near=max(a, abs(r-s)); far=r+s; s=scale2*(radius2-0.009);"
                 "a=radius1-0.009", CUSTOM.ParticlePairNoExclusions)
RADIUS = "1/(1/a-tanh(u-0.8*u^2+4.85*u^3)/radius); u=a*%s; a=radius-0.009"
OWN_ENERGY = ("28.3919551*(radius/B)^6*(radius+0.14)^2-69.4677425*(1/inner-1/outer)*charge^2/B", CUSTOM.SingleParticle)
PAIR_ENERGY = ("138.935485*(1/inner-1/outer)*charge1*charge2*(%s-1/f); f=sqrt(r^2+B1*B2*exp(-r^2/(4*B1*B2)))",
               CUSTOM.ParticlePairNoExclusions)


def molecules(count=70, side=10.0):
    """Particles (charge, radius, scale) of dipoles, and places where no two molecules overlap by chance alone."""
    rng = np.random.default_rng(1)
    particles = [p for m in range(count) for p in ((1, 0.2, 0.5 + 0.3 * (m % 2)), (-1, 0.1, 0.5 + 0.3 * (m % 2)))]
    positions = np.repeat(side * rng.random((count, 3)), 2, axis=0)
    positions[1::2] += [1, 0, 0]
    return particles, positions


class CustomGBCases(DropInCase):
    def expect_native(self, system):
        """Contexts of OpenMM's own kernels, since no form of ours is recognised."""
        made = self.contexts(system, "OpenMM")
        for _, context in made:
            for status in openmm_dch.status(context):
                self.assertIn("other than those that openmm.app writes", status["reason"])
        return made

    def test_the_model_of_onufriev_bashford_case_by_expressions(self):
        particles, positions = molecules()
        box, cutoff = 10 * CUBE, 2.0
        for method, box in ((GBSAOBC.NoCutoff, 10 * CUBE), (GBSAOBC.CutoffNonPeriodic, 10 * CUBE),
                            (GBSAOBC.CutoffPeriodic, 10 * CUBE), (GBSAOBC.CutoffPeriodic, 10 * SKEWED)):
            force = solvent_of(particles, method, cutoff)
            shift = "0" if method == GBSAOBC.NoCutoff else str(1 / cutoff)
            custom = custom_of(len(particles), [INTEGRAL, ("B", RADIUS % "I", CUSTOM.SingleParticle)],
                               [OWN_ENERGY, (PAIR_ENERGY[0] % shift, PAIR_ENERGY[1])], ("charge", "radius", "scale"), method, cutoff)
            custom.addGlobalParameter("inner", 1)
            custom.addGlobalParameter("outer", 78.3)
            for m in range(0, len(particles), 2):
                custom.addExclusion(m, m + 1)  # which do not count
            for i, particle in enumerate(particles):
                custom.setParticleParameters(i, particle)
            (_, reference), (_, on_cpu) = self.expect_native(system_of(custom, box=box))
            contexts = self.contexts(system_of(force, box=box), "OpenMM" if method == GBSAOBC.NoCutoff else "DCH")
            for round_ in range(2):
                for context in (reference, on_cpu):
                    custom.updateParametersInContext(context)
                expected = energy_and_forces(reference, positions)
                if box[1][0] == 0:  # else that platform of OpenMM's has other energies
                    self.assertAlmostEqual(energy_and_forces(on_cpu, positions)[0] / expected[0], 1, delta=1e-5)
                for platform, context in contexts:
                    with self.subTest(method=method, skewed=bool(box[1][0]), platform=platform, round=round_):
                        force.updateParametersInContext(context)
                        energy, forces = energy_and_forces(context, positions)
                        self.assertAlmostEqual(energy / expected[0], 1, delta=1e-5)
                        self.assertLess(relative_error(expected[1], forces), 1e-5)
                for i in range(0, len(particles), 4):
                    for each in ((1.1, 0.3, 0.6), (-1.1, 0.2, 0.4)):
                        force.setParticleParameters(i, *each)
                        custom.setParticleParameters(i, each)
                        i += 1

    def test_a_membrane(self):
        particles, positions = molecules()
        membrane = ("M", "(1/radius+2*log(2)/thickness)/(1+exp(7.2*(abs(z)+radius-thickness/2)))", CUSTOM.SingleParticle)
        force = custom_of(len(particles), [INTEGRAL, membrane, ("B", RADIUS % "max(I, M)", CUSTOM.SingleParticle)],
                          [OWN_ENERGY, (PAIR_ENERGY[0] % "0", PAIR_ENERGY[1])], ("charge", "radius", "scale"))
        for name, value in (("inner", 1), ("outer", 78.3), ("thickness", 3)):
            force.addGlobalParameter(name, value)
        for i, particle in enumerate(particles):
            force.setParticleParameters(i, particle)
        for platform, context in self.expect_native(system_of(force, box=10 * CUBE)):
            with self.subTest(platform=platform):
                self.expect_slope(context, positions, 1e-2, 1e-3)

    def test_a_table(self):
        """Of a sine from 1 to 6; 0 beyond."""
        force = custom_of(2, [("a", "0", CUSTOM.ParticlePair)], [("1+table(r)", CUSTOM.ParticlePair)])
        values = np.sin(0.25 * np.arange(21))
        table = openmm.Continuous1DFunction(values, 1, 6)
        force.addTabulatedFunction("table", table)
        for platform, context in self.expect_native(system_of(force)):
            with self.subTest(platform=platform):
                for x in 7 / 30 * np.arange(1, 30):
                    inside = 1 <= x <= 6
                    energy, forces = energy_and_forces(context, [[0, 0, 0], [x, 0, 0]])
                    self.assertAlmostEqual(energy, 1 + inside * math.sin(x - 1), delta=0.02)
                    np.testing.assert_allclose(forces[:, 0], inside * math.cos(x - 1) * np.array([1, -1]), atol=0.1)
                for scale in (1, 0.5):
                    table.setFunctionParameters(scale * values, 1, 6)
                    force.updateParametersInContext(context)
                    for x in 1 + 0.25 * np.arange(1, 20):
                        context.setPositions([[0, 0, 0], [x, 0, 0]])
                        self.assertAlmostEqual(energy_of(context), 1 + scale * math.sin(x - 1), delta=1e-4)
                table.setFunctionParameters(values, 1, 6)
                force.updateParametersInContext(context)

    def test_values_of_values(self):
        """a = 2 r, b = 2 r + 1, c = 6 r + 2: an energy of 62.2 r + 21 for each of two particles."""
        force = custom_of(2, [("a", "2*r", CUSTOM.ParticlePair), ("b", "a+1", CUSTOM.SingleParticle),
                              ("c", "2*b+a", CUSTOM.SingleParticle)], [("0.1*a+b+10*c", CUSTOM.SingleParticle)])
        for platform, context in self.expect_native(system_of(force)):
            for r in range(1, 5):
                with self.subTest(platform=platform, r=r):
                    energy, forces = energy_and_forces(context, [[0, 0, 0], [r, 0, 0]])
                    self.near(2 * (62.2 * r + 21), energy, "CPU")
                    np.testing.assert_allclose(forces, [[124.4, 0, 0], [-124.4, 0, 0]], rtol=1e-5)

    def test_values_of_places(self):
        force = custom_of(2, [("a", "r", CUSTOM.ParticlePair), ("b", "a+x*y", CUSTOM.SingleParticle)],
                          [("b*z", CUSTOM.SingleParticle), ("b1+b2", CUSTOM.ParticlePair)])
        rng = np.random.default_rng(1)
        for platform, context in self.expect_native(system_of(force)):
            for trial in range(5):
                with self.subTest(platform=platform, trial=trial):
                    positions = rng.random((2, 3))
                    r = np.linalg.norm(positions[1] - positions[0])
                    x, y, z = positions.T
                    self.near(np.sum((r + x * y) * (1 + z)), energy_and_forces(context, positions)[0], "CPU")
                    self.expect_slope(context, positions, 1e-3, 1e-3)

    def test_exclusions(self):
        """Of values, of energies, of both or none; r is 1."""
        for value_type, pair_type, energy, slope in (
                (CUSTOM.ParticlePair, CUSTOM.ParticlePair, 0, 0), (CUSTOM.ParticlePair, CUSTOM.ParticlePairNoExclusions, 1, 1),
                (CUSTOM.ParticlePairNoExclusions, CUSTOM.ParticlePair, 2, 2),
                (CUSTOM.ParticlePairNoExclusions, CUSTOM.ParticlePairNoExclusions, 5, 7)):
            force = custom_of(2, [("a", "r", value_type)], [("a", CUSTOM.SingleParticle), ("r*(1+a1+a2)", pair_type)])
            force.addExclusion(0, 1)
            for platform, context in self.expect_native(system_of(force)):
                with self.subTest(platform=platform, energy=energy):
                    found = energy_and_forces(context, [[0, 0, 0], [1, 0, 0]])
                    self.near(energy, found[0], "CPU")
                    np.testing.assert_allclose(found[1], [[slope, 0, 0], [-slope, 0, 0]], atol=1e-4)

    def test_an_unknown_variable(self):
        system = system_of(custom_of(1, [("a", "r+unknown", CUSTOM.ParticlePair)], []))
        for platform in PLATFORMS:
            with self.assertRaisesRegex(openmm.OpenMMException, "unknown"):
                context_of(system, platform)

    def test_derivatives_by_parameters(self):
        values = {"A": 0.8, "B": 2.1, "C": 3.2, "D": 1.3}
        force = custom_of(40, [("a", "0.5*(A-r)^2", CUSTOM.ParticlePair), ("b", "B+a", CUSTOM.SingleParticle)],
                          [("C*(r+a1+a2+b1+b2)^0.8", CUSTOM.ParticlePair), ("b*(D-B)", CUSTOM.SingleParticle)],
                          method=CUSTOM.CutoffPeriodic, cutoff=1.0)
        for name, value in values.items():
            force.addGlobalParameter(name, value)
        for name in reversed(values):
            force.addEnergyParameterDerivative(name)
        positions = 2 * np.random.default_rng(1).random((40, 3))
        for platform, context in self.expect_native(system_of(force, box=2 * CUBE)):
            context.setPositions(positions)
            found = context.getState(getParameterDerivatives=True).getEnergyParameterDerivatives()
            for name, value in values.items():
                with self.subTest(platform=platform, parameter=name):
                    energies = []
                    for step in (-1e-3, 1e-3):
                        context.setParameter(name, value + step)
                        energies.append(energy_of(context))
                    context.setParameter(name, value)
                    slope = (energies[1] - energies[0]) / 2e-3
                    self.assertAlmostEqual(found[name] / slope, 1, delta=5e-3)


if __name__ == "__main__":
    unittest.main()
