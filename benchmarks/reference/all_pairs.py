# SPDX-License-Identifier: MIT
"""What is right: all pairs with all their images, in double precision, without any list."""

import dataclasses
import math

import numpy as np

ELEMENTARY_CHARGE, AVOGADRO, EPSILON_0 = 1.602176634e-19, 6.02214076e23, 8.8541878128e-12  # CODATA 2018, SI
CODATA_2018 = 1e6 * ELEMENTARY_CHARGE**2 * AVOGADRO / (4 * math.pi * EPSILON_0)  # kJ nm/mol/e^2
ROWS = 256  # atoms against all others at a time


@dataclasses.dataclass
class Answer:
    forces: np.ndarray  # (atoms, 3) [kJ/mol/nm]
    energy: float       # [kJ/mol]


def pairs_within(positions, vectors, cutoff):
    """i, j > i and the displacement from i to j of all pairs and images within the cutoff."""
    images = np.zeros((1, 3))  # rounding finds the nearest image if the axes are orthogonal
    if np.any(vectors != np.diag(np.diag(vectors))):
        images = np.stack(np.meshgrid(*[[-1, 0, 1]] * 3), axis=-1).reshape(-1, 3) @ vectors
    found = []
    for first in range(0, len(positions), ROWS):
        apart = positions[None, first:, :] - positions[first:first + ROWS, None, :]
        for axis in (2, 1, 0):
            apart = apart - np.round(apart[..., axis, None] / vectors[axis][axis]) * vectors[axis]
        later = np.arange(apart.shape[1])[None, :] > np.arange(apart.shape[0])[:, None]
        for image in images:
            d = [apart[..., axis] + image[axis] for axis in range(3)]
            i, j = np.nonzero((d[0] * d[0] + d[1] * d[1] + d[2] * d[2] < cutoff**2) & later)
            found.append((first + i, first + j, np.stack([along[i, j] for along in d], axis=1)))
    return tuple(np.concatenate(parts) for parts in zip(*found))


def pairs_of(scene):
    return pairs_within(scene.positions, scene.vectors, scene.cutoff)


def answer(scene, pairs, constant, field_between_bonded=False):
    """Forces and energy. `constant` is that of Coulomb's law [kJ nm/mol/e^2].

    With `field_between_bonded` atoms of one molecule, and each atom with itself, take part in the reaction field, though
    not in 1/r nor in Lennard-Jones: GROMACS counts so.
    """
    i, j, d = pairs
    r2 = np.sum(d * d, axis=1)
    molecule = np.arange(len(scene.positions)) // scene.atoms_per_molecule
    apart = molecule[i] != molecule[j]
    sigma, epsilon = scene.of_atoms("sigma"), np.sqrt(scene.of_atoms("epsilon"))
    s6 = (0.25 * (sigma[i] + sigma[j]) ** 2 / r2) ** 3
    scale = 4 * epsilon[i] * epsilon[j] * apart
    energy = math.fsum(scale * (s6 * s6 - s6))
    force_over_r = 6 * scale * (2 * s6 * s6 - s6) / r2
    if scene.charged:
        charge = scene.of_atoms("charge")
        krf, crf = scene.field()
        qq = constant * charge[i] * charge[j]
        in_field = qq if field_between_bonded else qq * apart
        energy += math.fsum(qq * apart / np.sqrt(r2)) + math.fsum(in_field * (krf * r2 - crf))
        force_over_r = force_over_r + qq * apart / r2**1.5 - 2 * krf * in_field
        if field_between_bonded:
            energy -= 0.5 * constant * crf * math.fsum(charge**2)
    atoms, on_j = len(scene.positions), force_over_r[:, None] * d
    forces = np.stack([np.bincount(j, on_j[:, axis], atoms) - np.bincount(i, on_j[:, axis], atoms) for axis in range(3)],
                      axis=1)
    return Answer(forces, energy)
