#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Argon at 94 K: equilibration by Langevin dynamics, then a table of a run at constant energy.

usage: lj_fluid.py [--atoms-per-side 10] [--steps 2000] [--platform CPU]
"""

import argparse

import numpy as np
import openmm
from openmm import unit

import openmm_dch

SIGMA, EPSILON, MASS = 0.3405, 0.9961, 39.948  # nm, kJ/mol, dalton
DENSITY = 0.8  # atoms per sigma^3


def make_system(per_side):
    edge = per_side * SIGMA / DENSITY ** (1 / 3)
    system = openmm.System()
    system.setDefaultPeriodicBoxVectors(*(np.eye(3) * edge))
    force = openmm_dch.DCHNonbondedForce()
    force.setNonbondedMethod(force.CutoffPeriodic)
    force.setCutoffDistance(2.5 * SIGMA)
    force.setUseSwitchingFunction(True)
    force.setSwitchingDistance(2.2 * SIGMA)
    for _ in range(per_side**3):
        system.addParticle(MASS)
        force.addParticle(0, SIGMA, EPSILON)
    system.addForce(force)
    grid = np.stack(np.meshgrid(*[np.arange(per_side)] * 3), axis=-1).reshape(-1, 3)
    return system, grid * edge / per_side


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--atoms-per-side", type=int, default=10)
    parser.add_argument("--steps", type=int, default=2000)
    parser.add_argument("--platform", default="CPU")
    options = parser.parse_args()

    system, positions = make_system(options.atoms_per_side)
    atoms = system.getNumParticles()
    platform = openmm.Platform.getPlatformByName(options.platform)
    integrators = openmm.CompoundIntegrator()
    integrators.addIntegrator(openmm.LangevinMiddleIntegrator(94, 5, 0.004))
    integrators.addIntegrator(openmm.VerletIntegrator(0.004))
    context = openmm.Context(system, integrators, platform)
    context.setPositions(positions)
    context.setVelocitiesToTemperature(94, 1)
    integrators.step(options.steps)
    integrators.setCurrentIntegrator(1)

    print(f"{atoms} atoms, cutoff {2.5 * SIGMA:.3f} nm, after {options.steps} steps at 94 K")
    print(f"{'time [ps]':>9} {'potential':>10} {'kinetic':>10} {'total [kJ/mol/atom]':>20} {'T [K]':>7}")
    for _ in range(11):
        state = context.getState(getEnergy=True)
        potential, kinetic = (e.value_in_unit(unit.kilojoule_per_mole) / atoms
                              for e in (state.getPotentialEnergy(), state.getKineticEnergy()))
        time = state.getTime().value_in_unit(unit.picosecond)
        print(f"{time:9.2f} {potential:10.4f} {kinetic:10.4f} {potential + kinetic:20.5f} {kinetic / 0.01247:7.1f}")
        integrators.step(max(1, options.steps // 10))


if __name__ == "__main__":
    main()
