#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The headpiece of villin, a protein of 582 atoms, in implicit solvent (GBn2) at 300 K; ends with its size and energy.

Nothing but the line with enable() is peculiar to openmm_dch.

usage: implicit_solvent.py [--steps 2000] [--cutoff 1.6] [--platform CPU]
"""

import argparse
import os

import numpy as np
import openmm
from openmm import app, unit

import openmm_dch


def protein():
    """Topology and positions of the protein in a file that comes with OpenMM, without its water and ions."""
    folder = os.path.join(os.path.dirname(app.__file__), "data")
    file = app.PDBFile(os.path.join(folder, "test.pdb"))
    modeller = app.Modeller(file.topology, file.positions)
    modeller.delete([r for r in modeller.topology.residues() if r.name in ("HOH", "Cl", "Na")])
    return modeller.topology, modeller.positions


def radius_of_gyration(positions):
    return float(np.sqrt(np.mean(np.sum((positions - np.mean(positions, axis=0)) ** 2, axis=1))))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--steps", type=int, default=2000)
    parser.add_argument("--cutoff", type=float, default=1.6, help="nm")
    parser.add_argument("--platform", default="CPU")
    options = parser.parse_args()

    openmm_dch.enable()
    topology, positions = protein()
    system = app.ForceField("amber14-all.xml", "implicit/gbn2.xml").createSystem(
        topology, nonbondedMethod=app.CutoffNonPeriodic, nonbondedCutoff=options.cutoff * unit.nanometer,
        constraints=app.HBonds)
    integrator = openmm.LangevinMiddleIntegrator(300 * unit.kelvin, 1 / unit.picosecond, 2 * unit.femtosecond)
    integrator.setRandomNumberSeed(1)
    simulation = app.Simulation(topology, system, integrator, openmm.Platform.getPlatformByName(options.platform))
    simulation.context.setPositions(positions)
    for force in openmm_dch.status(simulation.context):
        print(f"{force['name']:18} computed by {force['direct']} {force['reason']}")
    simulation.minimizeEnergy(maxIterations=50)
    simulation.context.setVelocitiesToTemperature(300 * unit.kelvin, 1)
    print(f"{'step':>6} {'energy [kJ/mol]':>16} {'radius of gyration [nm]':>24}")
    for _ in range(5):
        simulation.step(options.steps // 5)
        state = simulation.context.getState(getEnergy=True, getPositions=True)
        print(f"{simulation.currentStep:6} {state.getPotentialEnergy()._value:16.1f} "
              f"{radius_of_gyration(state.getPositions(asNumpy=True)._value):24.3f}")


if __name__ == "__main__":
    main()
