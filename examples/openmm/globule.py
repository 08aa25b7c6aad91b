#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A bead-spring chain collapses into a globule: its radius of gyration and its contacts with itself over time.

Bonds are harmonic (HarmonicBondForce), beads attract each other (DCHNonbondedForce), and a NecklaceContactForce keeps
them from running through each other and counts where the chain touches itself.

usage: globule.py [--beads 200] [--steps 160000] [--rows 20] [--platform CPU] [--seed 1]
"""

import argparse

import numpy as np
import openmm
from openmm import unit

import openmm_dch

RADIUS, BOND, MASS = 0.25, 0.45, 100  # nm, nm, dalton
EPSILON = 6.0  # kJ/mol: attraction, 2.4 times the thermal energy
TEMPERATURE = 300


def make_chain(beads):
    """A System, and positions on a wide helix: a stretched chain that touches itself nowhere."""
    system = openmm.System()
    bonds, attraction = openmm.HarmonicBondForce(), openmm_dch.DCHNonbondedForce()
    contacts = openmm_dch.NecklaceContactForce()
    attraction.setNonbondedMethod(attraction.CutoffNonPeriodic)
    attraction.setCutoffDistance(1.2)
    attraction.setUseSwitchingFunction(True)
    attraction.setSwitchingDistance(1.0)
    for k in range(beads):
        system.addParticle(MASS)
        # Its minimum lies a little inside the contact distance, so that beads that stick together touch.
        attraction.addParticle(0, 0.95 * 2 * RADIUS / 2 ** (1 / 6), EPSILON)
        if k > 0:
            bonds.addBond(k - 1, k, BOND, 10000)
            attraction.addException(k - 1, k, 0, 1, 0)
    contacts.addChain(range(beads), [RADIUS] * beads)
    contacts.setEnergyFunction(contacts.Harmonic)
    contacts.setStrength(1000)
    for force in (bonds, attraction, contacts):
        system.addForce(force)
    angle = 0.4 * np.arange(beads)
    rise = np.sqrt(BOND**2 - (2 * np.sin(0.2)) ** 2)
    return system, contacts, np.stack([np.cos(angle), np.sin(angle), rise * np.arange(beads)], axis=-1)


def radius_of_gyration(positions):
    return np.sqrt(np.mean(np.sum((positions - np.mean(positions, axis=0)) ** 2, axis=1)))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--beads", type=int, default=200)
    parser.add_argument("--steps", type=int, default=160000)
    parser.add_argument("--rows", type=int, default=20, help="of the table")
    parser.add_argument("--platform", default="CPU")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()

    system, contacts, positions = make_chain(options.beads)
    integrator = openmm.LangevinMiddleIntegrator(TEMPERATURE, 0.5, 0.01)
    integrator.setRandomNumberSeed(options.seed)
    # So few beads leave nothing for a second thread.
    properties = {"Threads": "1"} if options.platform == "CPU" else {}
    context = openmm.Context(system, integrator, openmm.Platform.getPlatformByName(options.platform), properties)
    context.setPositions(positions)
    context.setVelocitiesToTemperature(TEMPERATURE, options.seed)

    print(f"{options.beads} beads of radius {RADIUS} nm at {TEMPERATURE} K")
    print(f"{'time [ps]':>9} {'R_g [nm]':>9} {'contacts':>9} {'deepest overlap [nm]':>21}")
    for row in range(options.rows + 1):
        if row > 0:
            integrator.step(max(1, options.steps // options.rows))
        state = context.getState(getPositions=True)
        found = contacts.getContacts(context)
        overlap = max((-gap.value_in_unit(unit.nanometer) for _, _, gap in found), default=0)
        print(f"{state.getTime().value_in_unit(unit.picosecond):9.1f} "
              f"{radius_of_gyration(state.getPositions(asNumpy=True)._value):9.3f} {len(found):9} {overlap:21.4f}")


if __name__ == "__main__":
    main()
