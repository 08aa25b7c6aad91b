# SPDX-License-Identifier: MIT
"""Systems that the Python tests share, and energies by all pairs."""

import numpy as np
import openmm
from openmm import app, unit

PLATFORMS = ("Reference", "CPU")


def lennard_jones_fluid(per_side, edge, box=None, cutoff=0.85, force=None, seed=1):
    """Argon on a jittered lattice in a cube, or in the box given by three vectors; energies in kJ/mol."""
    vectors = np.eye(3) * edge if box is None else np.array(box)
    grid = np.stack(np.meshgrid(*[np.arange(per_side)] * 3, indexing="ij"), axis=-1).reshape(-1, 3)
    fractions = (grid + 0.2 * np.random.default_rng(seed).random(grid.shape)) / per_side
    system = openmm.System()
    system.setDefaultPeriodicBoxVectors(*vectors)
    force = openmm.NonbondedForce() if force is None else force
    for _ in fractions:
        system.addParticle(39.9)
        force.addParticle(0, 0.34, 0.996)
    force.setNonbondedMethod(force.CutoffPeriodic)
    force.setCutoffDistance(cutoff)
    system.addForce(force)
    return system, fractions @ vectors


def water_box(per_side=6, cutoff=0.8):
    """Rigid TIP3P water on a lattice, with a reaction field."""
    topology = app.Topology()
    chain = topology.addChain()
    positions = []
    rng = np.random.default_rng(7)
    spacing = 0.3107  # 0.997 g/cm^3
    for k in range(per_side**3):
        residue = topology.addResidue("HOH", chain)
        oxygen = topology.addAtom("O", app.element.oxygen, residue)
        hydrogens = [topology.addAtom(name, app.element.hydrogen, residue) for name in ("H1", "H2")]
        for hydrogen in hydrogens:
            topology.addBond(oxygen, hydrogen)
        at = spacing * np.array([k % per_side, k // per_side % per_side, k // per_side**2])
        turn, _ = np.linalg.qr(rng.normal(size=(3, 3)))
        molecule = np.array([[0, 0, 0], [0.09572, 0, 0], [-0.0239987, 0.0926627, 0]]) @ turn
        positions.extend(at + molecule)
    edge = spacing * per_side
    topology.setPeriodicBoxVectors(np.eye(3) * edge * unit.nanometer)
    system = app.ForceField("tip3p.xml").createSystem(
        topology, nonbondedMethod=app.CutoffPeriodic, nonbondedCutoff=cutoff * unit.nanometer, rigidWater=True)
    return system, np.array(positions), topology


def context_of(system, platform, integrator=None, threads=2):
    integrator = integrator or openmm.VerletIntegrator(0.001)
    properties = {"Threads": str(threads)} if platform == "CPU" else {}
    return openmm.Context(system, integrator, openmm.Platform.getPlatformByName(platform), properties)


def energy_and_forces(context, positions=None, groups=-1):
    if positions is not None:
        context.setPositions(positions)
    state = context.getState(getEnergy=True, getForces=True, groups=groups)
    forces = state.getForces(asNumpy=True).value_in_unit(unit.kilojoule_per_mole / unit.nanometer)
    return state.getPotentialEnergy().value_in_unit(unit.kilojoule_per_mole), np.array(forces)


def positions_from_checkpoint(context, integrator):
    """Positions 30 steps after a checkpoint was made, and 30 steps after it was loaded."""
    context.setVelocitiesToTemperature(100, 3)
    integrator.step(20)
    checkpoint = context.createCheckpoint()
    found = []
    for _ in range(2):
        integrator.step(30)
        found.append(context.getState(getPositions=True).getPositions(asNumpy=True)._value)
        context.loadCheckpoint(checkpoint)
    return found


def all_pairs_lennard_jones(positions, vectors, cutoff, sigma=0.34, epsilon=0.996):
    """Energy and forces by all pairs and all their images within the cutoff, in double."""
    energy, forces = 0.0, np.zeros_like(positions)
    apart = positions[None, :, :] - positions[:, None, :]
    for axis in (2, 1, 0):
        apart -= np.round(apart[..., axis] / vectors[axis][axis])[..., None] * vectors[axis]
    for image in np.stack(np.meshgrid(*[[-1, 0, 1]] * 3), axis=-1).reshape(-1, 3):
        d = apart + image @ vectors
        r2 = np.einsum("ijk,ijk->ij", d, d)
        np.fill_diagonal(r2, np.inf)
        s6 = np.where(r2 < cutoff**2, (sigma**2 / r2) ** 3, 0)
        energy += 2 * epsilon * np.sum(s6 * s6 - s6)
        forces -= np.einsum("ij,ijk->ik", 24 * epsilon * (2 * s6 * s6 - s6) / r2, d)
    return energy, forces


def relative_error(expected, found):
    return np.sqrt(np.sum((found - expected) ** 2) / np.sum(expected**2))
