#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Systems that openmm.app makes of force fields and files that come with OpenMM, with the drop-in: minimised, run by a
Langevin integrator, at constant pressure, with rigid bonds to hydrogen and without; and, with --long, with more steps and
the drift of the energy at constant energy beside that with OpenMM's own kernels.

usage: test_app.py [--long] [--cases amber14_tip3p,obc2] [--seeds 5]
"""

import argparse
import functools
import os
import statistics
import sys
import unittest

import numpy as np
import openmm
from openmm import app, unit

import openmm_dch
from openmm_systems import context_of, energy_and_forces, relative_error

TEMPERATURE = 300
OPTIONS = argparse.Namespace(long=False, cases=None, seeds=5)


@functools.lru_cache(maxsize=None)
def file(name):
    return app.PDBFile(os.path.join(os.path.dirname(app.__file__), "data", name + ".pdb"))


def topology_of(name, is_alone=False):
    """Topology and positions in a file, or of the protein alone in it."""
    modeller = app.Modeller(file(name).topology, file(name).positions)
    if is_alone:
        modeller.delete([r for r in modeller.topology.residues() if r.name in ("HOH", "Cl")])
    return modeller


class Case:
    """A System of openmm.app.

    @param force_field  files of OpenMM
    """

    def __init__(self, name, force_field, is_alone=False, has_sites=False, method=app.PME):
        self.name, self.force_field, self.is_alone = name, force_field, is_alone
        self.has_sites, self.method = has_sites, method
        self.is_implicit = is_alone and method is app.CutoffNonPeriodic

    def system(self, constraints):
        """And positions [nm]."""
        modeller, force_field = topology_of(self.name, self.is_alone), app.ForceField(*self.force_field)
        if self.has_sites:
            modeller.addExtraParticles(force_field)
        system = force_field.createSystem(modeller.topology, nonbondedMethod=self.method, constraints=constraints,
                                          nonbondedCutoff=(1.6 if self.is_implicit else 0.9) * unit.nanometer)
        return system, np.array(modeller.positions.value_in_unit(unit.nanometer))


AMBER = "amber14-all.xml"
CASES = {
    "amber14_tip3p": Case("test", (AMBER, "amber14/tip3p.xml")),
    "amber14_tip4pew": Case("test", (AMBER, "amber14/tip4pew.xml"), has_sites=True),
    "obc2": Case("test", (AMBER, "implicit/obc2.xml"), is_alone=True, method=app.CutoffNonPeriodic),
    "gbn2": Case("test", (AMBER, "implicit/gbn2.xml"), is_alone=True, method=app.CutoffNonPeriodic),
    "charmm36": Case("test", ("charmm36.xml", "charmm36/water.xml"), is_alone=True),
    "tip3p": Case("tip3p", ("tip3p.xml",)),
    "tip4pew": Case("tip4pew", ("tip4pew.xml",)),
    "tip5p": Case("tip5p", ("tip5p.xml",)),
    "spce": Case("spce", ("spce.xml",)),
    "tip3p_ljpme": Case("tip3p", ("tip3p.xml",), method=app.LJPME),
}
# Takes minutes to be made.
LONG_CASES = {"charmm36_water": Case("test", ("charmm36.xml", "charmm36/water.xml")),
              "lipids": Case("DLPC", (AMBER, "amber14/tip3p.xml"))}


def cases():
    known = {**CASES, **LONG_CASES} if OPTIONS.long else CASES
    return {name: known[name] for name in (OPTIONS.cases.split(",") if OPTIONS.cases else known)}


def steps(few, many):
    return many if OPTIONS.long else few


def make(system, integrator, is_dch=True, threads=2):
    """A Context on the CPU platform."""
    if is_dch:
        openmm_dch.enable()
    context = context_of(system, "CPU", integrator, threads)
    openmm_dch.disable()
    return context


def langevin(step, friction=1, seed=1):
    integrator = openmm.LangevinMiddleIntegrator(TEMPERATURE, friction, step)
    integrator.setRandomNumberSeed(seed)
    return integrator


def kinetic_temperature(context):
    system = context.getSystem()
    movable = sum(system.getParticleMass(i)._value > 0 for i in range(system.getNumParticles()))
    freedom = 3 * movable - system.getNumConstraints() - 3
    energy = context.getState(getEnergy=True).getKineticEnergy()
    return (2 * energy / (freedom * unit.MOLAR_GAS_CONSTANT_R)).value_in_unit(unit.kelvin)


class AppTest(unittest.TestCase):
    def same_as_native(self, context, system):
        """Energy and forces at the present positions with those of OpenMM's own kernels, whose pairs are in single
        precision too."""
        state = context.getState(getPositions=True, getEnergy=True, getForces=True)
        native = make(system, openmm.VerletIntegrator(0.001), False)
        native.setPeriodicBoxVectors(*state.getPeriodicBoxVectors())
        expected = energy_and_forces(native, state.getPositions(asNumpy=True))
        self.assertTrue(np.isfinite(expected[1]).all())
        self.assertAlmostEqual(state.getPotentialEnergy()._value, expected[0], delta=2e-5 * abs(expected[0]) + 0.1)
        self.assertLess(relative_error(expected[1], state.getForces(asNumpy=True)._value), 2e-4)

    def run_case(self, case, constraints, step):
        system, positions = case.system(constraints)
        # Many steps of whatever length are six relaxation times: what was minimised takes half of the first heat.
        context = make(system, langevin(step, 0.002 / step))
        computed = openmm_dch.status(context)
        self.assertTrue(computed)
        self.assertEqual({s["direct"] for s in computed}, {"DCH"}, computed)
        before, _ = energy_and_forces(context, positions)
        openmm.LocalEnergyMinimizer.minimize(context, 10, steps(20, 200))
        self.assertLess(energy_and_forces(context)[0], before)
        context.setVelocitiesToTemperature(TEMPERATURE, 2)
        context.getIntegrator().step(steps(20, 3000))
        self.same_as_native(context, system)
        if OPTIONS.long:
            # Flexible water is 13 K below after these steps with OpenMM's own kernels too, and single steps differ by 5.
            self.assertAlmostEqual(kinetic_temperature(context), TEMPERATURE, delta=40)
        if not case.is_implicit:
            self.under_pressure(context, system, step)

    def under_pressure(self, context, system, step):
        state = context.getState(getPositions=True, getVelocities=True)
        barostat = openmm.MonteCarloBarostat(1, TEMPERATURE, steps(2, 25))
        barostat.setRandomNumberSeed(3)
        system.addForce(barostat)
        context = make(system, langevin(step))
        context.setState(state)
        volume = state.getPeriodicBoxVolume()
        context.getIntegrator().step(steps(20, 3000))
        ratio = context.getState().getPeriodicBoxVolume() / volume
        self.assertNotEqual(ratio, 1)
        self.assertTrue(0.7 < ratio < 1.3, ratio)
        self.same_as_native(context, system)

    def test_rigid_bonds_to_hydrogen(self):
        for name, case in cases().items():
            with self.subTest(name):
                self.run_case(case, app.HBonds, 0.002)

    def test_no_rigid_bonds(self):
        for name, case in cases().items():
            with self.subTest(name):
                self.run_case(case, None, 0.0005)


class Drift:
    """At constant energy, by seeds: slopes of lines through total energies by least squares [kJ/mol/ps/atom]."""

    STEP = 0.001
    EVERY = 10  # steps between two energies
    PICOSECONDS = 0.5
    SETTLE = 300  # steps
    DRIFTING = ("amber14_tip3p", "obc2", "gbn2")

    def __init__(self, name):
        self.system, positions = CASES[name].system(app.HBonds)
        self.samples = round(self.PICOSECONDS / self.STEP / self.EVERY) + 1
        context = make(self.system, langevin(self.STEP), threads=1)
        context.setPositions(positions)
        openmm.LocalEnergyMinimizer.minimize(context, 10, 200)
        self.minimum = context.getState(getPositions=True).getPositions(asNumpy=True)

    def of(self, state, is_dch):
        integrator = openmm.VerletIntegrator(self.STEP)
        integrator.setConstraintTolerance(1e-8)
        context = make(self.system, integrator, is_dch, threads=1)
        context.setState(state)
        energies = []
        for _ in range(self.samples):
            now = context.getState(getEnergy=True)
            energies.append(now.getPotentialEnergy()._value + now.getKineticEnergy()._value)
            integrator.step(self.EVERY)
        times = self.STEP * self.EVERY * np.arange(len(energies))
        return float(np.polyfit(times, energies, 1)[0]) / self.system.getNumParticles()

    def by_seeds(self, seeds):
        """Of OpenMM's own kernels and of DCH."""
        found = {False: [], True: []}
        for seed in range(1, seeds + 1):
            context = make(self.system, langevin(self.STEP, 5, seed), threads=1)
            context.setPositions(self.minimum)
            context.setVelocitiesToTemperature(TEMPERATURE, seed)
            context.getIntegrator().step(self.SETTLE)
            state = context.getState(getPositions=True, getVelocities=True)
            for is_dch, drifts in found.items():
                drifts.append(self.of(state, is_dch))
            print(f"seed {seed}: native {found[False][-1]:10.3e}, dch {found[True][-1]:10.3e} kJ/mol an atom and ps",
                  flush=True)
        return found[False], found[True]


class DriftTest(unittest.TestCase):
    def test_drift_of_the_energy(self):
        if not OPTIONS.long:
            self.skipTest("takes minutes; asked for by --long")
        for name in Drift.DRIFTING:
            if name not in cases():
                continue
            with self.subTest(name):
                native, dch = Drift(name).by_seeds(OPTIONS.seeds)
                deviation = statistics.stdev(native)
                apart = statistics.fmean(dch) - statistics.fmean(native)
                print(f"{name}: native {statistics.fmean(native):.3e} +- {deviation:.1e}, dch {statistics.fmean(dch):.3e} "
                      f"+- {statistics.stdev(dch):.1e}; means {abs(apart) / deviation:.2f} deviations apart", flush=True)
                self.assertLess(abs(apart), 2 * deviation)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--long", action="store_true")
    parser.add_argument("--cases", help="some of " + ",".join({**CASES, **LONG_CASES}))
    parser.add_argument("--seeds", type=int, default=OPTIONS.seeds)
    OPTIONS, others = parser.parse_known_args()
    unittest.main(argv=sys.argv[:1] + others)
