# SPDX-License-Identifier: MIT
"""Systems that are timed: each function makes a System, its positions [nm], a temperature [K] and a step [ps]."""

import os

import numpy as np
import openmm
from openmm import app, unit
from openmm.app.internal import customgbforces


def lattice(per_side, edge, seed=1):
    grid = np.stack(np.meshgrid(*[np.arange(per_side)] * 3), axis=-1).reshape(-1, 3)
    return (grid + 0.2 * np.random.default_rng(seed).random(grid.shape)) * edge / per_side


def argon(positions, edge, method):
    system, force = openmm.System(), openmm.NonbondedForce()
    if edge:
        system.setDefaultPeriodicBoxVectors(*(np.eye(3) * edge))
    for _ in positions:
        system.addParticle(39.948)
        force.addParticle(0, 0.34, 0.996)
    force.setNonbondedMethod(method)
    force.setCutoffDistance(0.85)
    system.addForce(force)
    return system


def lj(scale):
    """Argon at a reduced density of 0.8442: 32,768 atoms, cutoff 2.5 sigma."""
    per_side = round(32 * scale ** (1 / 3))
    edge = per_side * 0.34 / 0.8442 ** (1 / 3)
    positions = lattice(per_side, edge)
    return argon(positions, edge, openmm.NonbondedForce.CutoffPeriodic), positions, 100, 0.004


def droplet(scale):
    """The inner ball of that without a box: about 20,000 atoms in vacuum."""
    per_side = round(34 * scale ** (1 / 3))
    edge = per_side * 0.34 / 0.8442 ** (1 / 3)
    positions = lattice(per_side, edge)
    inside = np.sum((positions - edge / 2) ** 2, axis=1) < (0.5 * edge) ** 2
    positions = positions[inside]
    return argon(positions, 0, openmm.NonbondedForce.CutoffNonPeriodic), positions, 60, 0.004


def vacuum(scale):
    """About 5,000 charged atoms without a cutoff."""
    per_side = round(17 * scale ** (1 / 3))
    positions = lattice(per_side, per_side * 0.36)
    system = argon(positions, 0, openmm.NonbondedForce.NoCutoff)
    force = system.getForce(0)
    for k in range(system.getNumParticles()):
        force.setParticleParameters(k, 0.3 * (-1) ** k, 0.34, 0.996)
    return system, positions, 60, 0.004


def box_of_water(per_side, method, cutoff):
    """Rigid TIP3P molecules, per_side^3 of them, on a lattice."""
    spacing = 0.3107
    topology, positions = app.Topology(), []
    chain, rng = topology.addChain(), np.random.default_rng(1)
    for k in range(per_side**3):
        residue = topology.addResidue("HOH", chain)
        oxygen = topology.addAtom("O", app.element.oxygen, residue)
        for name in ("H1", "H2"):
            topology.addBond(oxygen, topology.addAtom(name, app.element.hydrogen, residue))
        turn, _ = np.linalg.qr(rng.normal(size=(3, 3)))
        molecule = np.array([[0, 0, 0], [0.09572, 0, 0], [-0.0239987, 0.0926627, 0]]) @ turn
        positions.extend(spacing * np.array([k % per_side, k // per_side % per_side, k // per_side**2]) + molecule)
    topology.setPeriodicBoxVectors(np.eye(3) * spacing * per_side * unit.nanometer)
    system = app.ForceField("tip3p.xml").createSystem(
        topology, nonbondedMethod=method, nonbondedCutoff=cutoff * unit.nanometer, rigidWater=True)
    return system, np.array(positions), 300, 0.001


def water(scale):
    """10,648 molecules (31,944 atoms) with a reaction field, cutoff 0.9 nm."""
    return box_of_water(round(22 * scale ** (1 / 3)), app.CutoffPeriodic, 0.9)


def pme(scale):
    """8,000 molecules (24,000 atoms) with particle mesh Ewald, cutoff 1.0 nm."""
    return box_of_water(round(20 * scale ** (1 / 3)), app.PME, 1.0)


def protein(_):
    """8,867 atoms of a protein in water, in a file that comes with OpenMM, with particle mesh Ewald, cutoff 1.0 nm. They
    are as many at any scale."""
    file = app.PDBFile(os.path.join(os.path.dirname(app.__file__), "data", "test.pdb"))
    system = app.ForceField("amber14-all.xml", "amber14/tip3p.xml").createSystem(
        file.topology, nonbondedMethod=app.PME, nonbondedCutoff=1.0 * unit.nanometer, constraints=app.HBonds)
    return system, np.array(file.positions.value_in_unit(unit.nanometer)), 300, 0.001


def ljpme(scale):
    """The same with the dispersion by a mesh too."""
    return box_of_water(round(20 * scale ** (1 / 3)), app.LJPME, 1.0)


def ewald(scale):
    """1,000 molecules (3,000 atoms) with Ewald's sum over waves, cutoff 0.9 nm."""
    return box_of_water(round(10 * scale ** (1 / 3)), app.Ewald, 0.9)


def packed_atoms(per_side):
    """Atoms as dense as in a protein, about 100 in a cubic nanometer, that bonds keep near a lattice. Their charges,
    radii and screening are those of carbon, hydrogen, nitrogen and oxygen."""
    edge = per_side * 0.215
    system, positions, bonds = openmm.System(), lattice(per_side, edge), openmm.HarmonicBondForce()
    for k in range(per_side**3):
        system.addParticle(12)
        for axis, step in enumerate((per_side**2, per_side, 1)):
            if k // step % per_side + 1 < per_side:
                length = float(np.linalg.norm(positions[k + step] - positions[k]))
                bonds.addBond(k, k + step, length, 20000 * (1 + axis))
    system.addForce(bonds)
    atoms = [((0.3, 0.17, 0.72), (0.1, 0.12, 0.85), (-0.2, 0.155, 0.79), (-0.2, 0.15, 0.85))[k % 4]
             for k in np.random.default_rng(3).permutation(len(positions))]
    return system, positions, atoms


def gbsa(scale):
    """10,648 packed atoms in implicit solvent by GBSAOBCForce, cutoff 1.6 nm."""
    system, positions, atoms = packed_atoms(round(22 * scale ** (1 / 3)))
    force = openmm.GBSAOBCForce()
    for atom in atoms:
        force.addParticle(*atom)
    force.setNonbondedMethod(force.CutoffNonPeriodic)
    force.setCutoffDistance(1.6)
    system.addForce(force)
    return system, positions, 300, 0.001


def custom_gb(scale, form, *more):
    system, positions, atoms = packed_atoms(round(22 * scale ** (1 / 3)))
    force = form(SA="ACE", cutoff=1.6)
    for atom in atoms:
        force.addParticle([*atom, *more])
    force.finalize()
    force.setNonbondedMethod(force.CutoffNonPeriodic)
    force.setCutoffDistance(1.6)
    system.addForce(force)
    return system, positions, 300, 0.001


def obc2(scale):
    """The same by the CustomGBForce that openmm.app writes for OBC2."""
    return custom_gb(scale, customgbforces.GBSAOBC2Force)


def gbn2(scale):
    """The same for GBn2."""
    return custom_gb(scale, customgbforces.GBSAGBn2Force, 0.75, 0.5, 0.2)


SCENES = {"lj": lj, "water": water, "droplet": droplet, "vacuum": vacuum, "pme": pme, "protein": protein, "ljpme": ljpme,
          "ewald": ewald, "gbsa": gbsa, "obc2": obc2, "gbn2": gbn2}
