#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The radial distribution function of a Lennard-Jones fluid, from the pairs of a Context as numpy arrays.

A potential that is computed outside of OpenMM, a machine-learned one for example, takes the same arrays. Of this
project it needs the Python module dch alone.

usage: context_pairs.py [--atoms-per-side 10] [--steps 2000] [--cutoff 0.9]
"""

import argparse

import dch.openmm
import numpy as np
import openmm
from openmm import unit

SIGMA, EPSILON, MASS = 0.34, 0.996, 39.948  # argon
DENSITY = 0.8442  # atoms per sigma^3


def fluid(per_side):
    edge = per_side * SIGMA / DENSITY ** (1 / 3)
    system, force = openmm.System(), openmm.NonbondedForce()
    system.setDefaultPeriodicBoxVectors(*(np.eye(3) * edge))
    for _ in range(per_side**3):
        system.addParticle(MASS)
        force.addParticle(0, SIGMA, EPSILON)
    force.setNonbondedMethod(force.CutoffPeriodic)
    force.setCutoffDistance(2.5 * SIGMA)
    system.addForce(force)
    grid = np.stack(np.meshgrid(*[np.arange(per_side)] * 3), axis=-1).reshape(-1, 3)
    return system, grid * edge / per_side


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--atoms-per-side", type=int, default=10)
    parser.add_argument("--steps", type=int, default=2000)
    parser.add_argument("--cutoff", type=float, default=0.9, help="of the pairs, nm")
    options = parser.parse_args()

    system, positions = fluid(options.atoms_per_side)
    integrator = openmm.LangevinMiddleIntegrator(94, 1, 0.004)
    integrator.setRandomNumberSeed(1)
    context = openmm.Context(system, integrator, openmm.Platform.getPlatformByName("CPU"))
    context.setPositions(positions)
    context.setVelocitiesToTemperature(94, 1)
    integrator.step(options.steps // 2)

    pairs = dch.openmm.ContextPairs(context, options.cutoff * unit.nanometer)
    edges = np.linspace(0, options.cutoff, 31)
    counts, samples = np.zeros(30), 10
    for _ in range(samples):
        integrator.step(options.steps // (2 * samples))
        i, j, vectors = pairs.pairs("ijD")  # each pair in both directions, from i to j
        distances = np.linalg.norm(vectors, axis=1)
        counts += np.histogram(distances, edges)[0]
    volume = context.getState().getPeriodicBoxVolume().value_in_unit(unit.nanometer**3)
    atoms = system.getNumParticles()
    shells = 4 / 3 * np.pi * (edges[1:] ** 3 - edges[:-1] ** 3)
    distribution = counts / (samples * atoms * shells * atoms / volume)
    print(f"{len(i)} pairs at last, {len(i) / atoms:.1f} neighbors of each atom")
    print(f"{'r [nm]':>8} {'g(r)':>7}")
    for r, g in zip(0.5 * (edges[1:] + edges[:-1]), distribution):
        print(f"{r:8.3f} {g:7.3f}  " + "#" * round(20 * g))


if __name__ == "__main__":
    main()
