#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The headpiece of villin in water, 8,867 atoms with particle mesh Ewald, at 300 K and 1 bar; ends with the time of a step.

Nothing but the line with enable() is peculiar to openmm_dch; with --native it is left out.

usage: protein_in_water.py [--steps 1000] [--precision mixed|double] [--native] [--platform CPU]
"""

import argparse
import os
import time

import openmm
from openmm import app, unit

import openmm_dch


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--steps", type=int, default=1000)
    parser.add_argument("--precision", default="mixed", choices=("mixed", "double"))
    parser.add_argument("--native", action="store_true", help="OpenMM's own kernels")
    parser.add_argument("--platform", default="CPU")
    options = parser.parse_args()

    if not options.native:
        openmm_dch.enable(options.precision)
    file = app.PDBFile(os.path.join(os.path.dirname(app.__file__), "data", "test.pdb"))
    system = app.ForceField("amber14-all.xml", "amber14/tip3p.xml").createSystem(
        file.topology, nonbondedMethod=app.PME, nonbondedCutoff=1 * unit.nanometer, constraints=app.HBonds)
    system.addForce(openmm.MonteCarloBarostat(1 * unit.bar, 300 * unit.kelvin))
    integrator = openmm.LangevinMiddleIntegrator(300 * unit.kelvin, 1 / unit.picosecond, 2 * unit.femtosecond)
    integrator.setRandomNumberSeed(1)
    simulation = app.Simulation(file.topology, system, integrator, openmm.Platform.getPlatformByName(options.platform))
    simulation.context.setPositions(file.positions)
    for force in openmm_dch.status(simulation.context):
        print(f"{force['name']}: pairs by {force['direct']}, reciprocal space by {force['reciprocal']} {force['reason']}")
    simulation.minimizeEnergy(maxIterations=20)
    simulation.context.setVelocitiesToTemperature(300 * unit.kelvin, 1)
    print(f"{'step':>6} {'energy [kJ/mol]':>16} {'density [g/ml]':>15}")
    mass = sum((system.getParticleMass(i) for i in range(system.getNumParticles())), 0 * unit.dalton)
    begin = time.perf_counter()
    for _ in range(5):
        simulation.step(options.steps // 5)
        state = simulation.context.getState(getEnergy=True)
        density = mass / unit.AVOGADRO_CONSTANT_NA / state.getPeriodicBoxVolume()
        print(f"{simulation.currentStep:6} {state.getPotentialEnergy()._value:16.1f} "
              f"{density.value_in_unit(unit.gram / unit.milliliter):15.4f}")
    print(f"{1e3 * (time.perf_counter() - begin) / (options.steps // 5 * 5):.1f} ms a step")


if __name__ == "__main__":
    main()
