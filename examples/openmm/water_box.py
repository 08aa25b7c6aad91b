#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Water (TIP3P) with a reaction field at 300 K and 1 bar; ends with a table of how often oxygens are how far apart.

The System is made by OpenMM's own tools and turned over in one line.

usage: water_box.py [--molecules-per-side 8] [--steps 2000] [--platform CPU]
"""

import argparse

import numpy as np
import openmm
from openmm import app, unit

import openmm_dch

SPACING = 0.3107  # nm between molecules of water


def make_water(per_side):
    """Topology and positions of molecules in any orientation on a lattice."""
    topology, positions = app.Topology(), []
    chain = topology.addChain()
    rng = np.random.default_rng(1)
    for k in range(per_side**3):
        residue = topology.addResidue("HOH", chain)
        oxygen = topology.addAtom("O", app.element.oxygen, residue)
        for name in ("H1", "H2"):
            topology.addBond(oxygen, topology.addAtom(name, app.element.hydrogen, residue))
        turn, _ = np.linalg.qr(rng.normal(size=(3, 3)))
        molecule = np.array([[0, 0, 0], [0.09572, 0, 0], [-0.0239987, 0.0926627, 0]]) @ turn
        positions.extend(SPACING * np.array([k % per_side, k // per_side % per_side, k // per_side**2]) + molecule)
    topology.setPeriodicBoxVectors(np.eye(3) * SPACING * per_side * unit.nanometer)
    return topology, np.array(positions)


def pair_correlation(oxygens, edge, width=0.025, farthest=0.7):
    """g(r) of oxygens in a cubic box, by all pairs."""
    apart = oxygens[:, None, :] - oxygens[None, :, :]
    apart -= edge * np.round(apart / edge)
    r = np.sqrt(np.sum(apart**2, axis=-1))[np.triu_indices(len(oxygens), 1)]
    edges = np.arange(0.2, farthest + width / 2, width)
    counts, _ = np.histogram(r, edges)
    shells = 4 / 3 * np.pi * (edges[1:] ** 3 - edges[:-1] ** 3)
    ideal = shells * len(oxygens) * (len(oxygens) - 1) / 2 / edge**3
    return 0.5 * (edges[1:] + edges[:-1]), counts / ideal


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--molecules-per-side", type=int, default=8)
    parser.add_argument("--steps", type=int, default=2000)
    parser.add_argument("--platform", default="CPU")
    options = parser.parse_args()

    topology, positions = make_water(options.molecules_per_side)
    system = app.ForceField("tip3p.xml").createSystem(
        topology, nonbondedMethod=app.CutoffPeriodic, nonbondedCutoff=0.9 * unit.nanometer, rigidWater=True)
    openmm_dch.replaceNonbonded(system)
    system.addForce(openmm.MonteCarloBarostat(1 * unit.bar, 300 * unit.kelvin))

    integrator = openmm.LangevinMiddleIntegrator(300, 1, 0.002)
    simulation = app.Simulation(topology, system, integrator, openmm.Platform.getPlatformByName(options.platform))
    simulation.context.setPositions(positions)
    simulation.minimizeEnergy(maxIterations=50)
    simulation.context.setVelocitiesToTemperature(300, 1)
    correlation, samples = 0, 10
    for _ in range(samples):
        simulation.step(max(1, options.steps // samples))
        state = simulation.context.getState(getPositions=True, getEnergy=True)
        edge = state.getPeriodicBoxVectors()[0][0].value_in_unit(unit.nanometer)
        oxygens = np.array(state.getPositions(asNumpy=True).value_in_unit(unit.nanometer))[::3]
        distances, g = pair_correlation(oxygens, edge)
        correlation = correlation + g / samples

    grams = 18.015 / 6.02214e23 * len(oxygens)
    print(f"{len(oxygens)} molecules, box {edge:.3f} nm, {grams / (edge * 1e-7) ** 3:.3f} g/cm^3 at the end")
    print("r [nm]   g(r)")
    for r, g in zip(distances, correlation):
        print(f"{r:6.4f} {g:6.2f}  " + "#" * int(20 * g))


if __name__ == "__main__":
    main()
