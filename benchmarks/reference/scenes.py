# SPDX-License-Identifier: MIT
"""Configurations that every program is given: nm, kJ/mol, elementary charges, atomic mass units.

All coordinates are whole multiples of 2^-16 nm. Programs in single precision and files with 16 decimals hold these
exactly, so that nobody computes another configuration than the others.
"""

import dataclasses

import numpy as np

import all_pairs

GRAIN = 2.0**-16  # nm


@dataclasses.dataclass
class Kind:
    """A kind of atom; pairs of kinds mix by the rules of Lorentz and Berthelot."""
    name: str
    sigma: float
    epsilon: float
    charge: float
    mass: float


@dataclasses.dataclass
class Scene:
    """Atoms in a periodic box, molecule by molecule; the atoms of a molecule do not act on each other."""
    name: str
    positions: np.ndarray    # (atoms, 3)
    vectors: np.ndarray      # rows are the cell vectors, lower triangular
    cutoff: float            # of Lennard-Jones pairs and charges
    margin: float            # no pair is nearer to the cutoff than this, where forces jump
    kinds: list
    kind: np.ndarray         # (atoms,), into kinds
    atoms_per_molecule: int
    dielectric: float        # of the reaction field; 0: there are no charges

    @property
    def charged(self):
        return self.dielectric > 0

    def of_atoms(self, what):
        return np.array([getattr(kind, what) for kind in self.kinds])[self.kind]

    def field(self):
        """krf and crf of the energy q q (1/r + krf r^2 - crf) in a reaction field [1/nm^3, 1/nm]."""
        krf = (self.dielectric - 1) / (2 * self.dielectric + 1) / self.cutoff**3
        return krf, 1 / self.cutoff + krf * self.cutoff**2


def to_grain(values):
    return np.round(values / GRAIN) * GRAIN


def wrapped(positions, vectors):
    """Into the cell of lower triangular vectors; on the grain before and after."""
    for axis in (2, 1, 0):
        positions = positions - np.floor(positions[:, axis] / vectors[axis][axis])[:, None] * vectors[axis]
    return positions


def cutoff_in_a_gap(positions, vectors, near, width):
    """The middle of the widest gap between distances of pairs from `near` to `near` + `width`, and half the gap."""
    _, _, apart = all_pairs.pairs_within(positions, vectors, near + width)
    distances = np.sort(np.sqrt(np.sum(apart**2, axis=1)))
    distances = distances[distances > near]
    gaps = np.diff(distances)
    widest = int(np.argmax(gaps))
    return distances[widest] + gaps[widest] / 2, gaps[widest] / 2


def fluid(name, cells, tilts, seed):
    """Argon at a reduced density of 0.8442, near the sites of a face-centered cubic lattice, or of that sheared."""
    sigma, rng = 0.34, np.random.default_rng(seed)
    edge = float(to_grain(cells * (4 / 0.8442) ** (1 / 3) * sigma))
    xy, xz, yz = (float(to_grain(tilt * edge)) for tilt in tilts)
    vectors = np.array([[edge, 0, 0], [xy, edge, 0], [xz, yz, edge]])
    corners = np.stack(np.meshgrid(*[np.arange(cells)] * 3, indexing="ij"), axis=-1).reshape(-1, 1, 3)
    sites = (corners + np.array([[0, 0, 0], [0.5, 0.5, 0], [0.5, 0, 0.5], [0, 0.5, 0.5]])).reshape(-1, 3) / cells
    positions = sites @ vectors + rng.uniform(-0.1, 0.1, sites.shape) * sigma
    positions = wrapped(to_grain(positions), vectors)
    cutoff, margin = cutoff_in_a_gap(positions, vectors, 2.5 * sigma, 0.001)
    return Scene(name, positions, vectors, cutoff, margin, [Kind("AR", sigma, 0.996, 0, 39.948)],
                 np.zeros(len(positions), int), 1, 0)


SPCE = [Kind("OW", 0.316557, 0.650194, -0.8476, 15.9994), Kind("HW", 0.1, 0, 0.4238, 1.008)]  # sigma of H acts on nothing
TILE_SIDE = 6                  # molecules along the edge of the box that is relaxed
SPACING = float(to_grain(0.3107))  # of molecules at 0.997 g/cm^3


def turned(vectors, axes):
    """Each set of vectors turned about its axis, by the angle that is the length of the axis."""
    angle = np.linalg.norm(axes, axis=1)[:, None, None]
    axis = (axes[:, None, :] / np.maximum(angle, 1e-300))
    along = np.sum(vectors * axis, axis=2, keepdims=True) * axis
    return vectors * np.cos(angle) + np.cross(axis, vectors) * np.sin(angle) + along * (1 - np.cos(angle))


def bounded(steps, most):
    """Each row as it is, or `most` long if it is longer."""
    return steps * np.minimum(1, most / np.maximum(np.linalg.norm(steps, axis=1), 1e-300))[:, None]


def relaxed_water(seed, iterations):
    """Centers and arms of rigid molecules in a small box: from any orientation downhill, until hydrogen bonds hold."""
    rng = np.random.default_rng(seed)
    half = np.radians(109.47 / 2)
    molecule = 0.1 * np.array([[0, 0, 0], [np.sin(half), np.cos(half), 0], [-np.sin(half), np.cos(half), 0]])
    corners = np.stack(np.meshgrid(*[np.arange(TILE_SIDE)] * 3, indexing="ij"), axis=-1).reshape(-1, 3)
    centers = SPACING * corners + 0.02 * rng.uniform(-1, 1, corners.shape)
    arms = turned(np.broadcast_to(molecule, (len(centers), 3, 3)), 3 * rng.normal(size=centers.shape))
    for _ in range(iterations):
        scene = water_scene("", centers, arms, TILE_SIDE, 0.9, 0)
        forces = all_pairs.answer(scene, all_pairs.pairs_of(scene), all_pairs.CODATA_2018).forces.reshape(-1, 3, 3)
        centers = centers + bounded(1e-5 * forces.sum(axis=1), 0.005)
        arms = turned(arms, bounded(2e-3 * np.cross(arms, forces).sum(axis=1), 0.15))
    return centers, arms


def water_scene(name, centers, arms, side, cutoff, margin):
    vectors = np.eye(3) * side * SPACING
    positions = wrapped(to_grain((centers[:, None, :] + arms).reshape(-1, 3)), vectors)
    return Scene(name, positions, vectors, cutoff, margin, SPCE, np.tile([0, 1, 1], len(centers)), 3, 78.3)


def water(name, tiles, seed):
    """SPC/E water in a reaction field: a relaxed box of 216 molecules, repeated and shaken so that no two are alike."""
    centers, arms = relaxed_water(seed, 60)
    rng = np.random.default_rng(seed + 1)
    corners = np.stack(np.meshgrid(*[np.arange(tiles)] * 3, indexing="ij"), axis=-1).reshape(-1, 1, 3)
    centers = (corners * TILE_SIDE * SPACING + centers).reshape(-1, 3)
    arms = turned(np.tile(arms, (tiles**3, 1, 1)), 0.02 * rng.normal(size=centers.shape))
    centers = centers + 0.002 * rng.normal(size=centers.shape)
    scene = water_scene(name, centers, arms, tiles * TILE_SIDE, 0.9, 0)
    cutoff, margin = cutoff_in_a_gap(scene.positions, scene.vectors, 0.9, 0.001)
    return dataclasses.replace(scene, cutoff=cutoff, margin=margin)


def all_scenes(cells, tiles):
    """Argon in a cube and in a tilted cell, `cells` cubic cells of four along an edge; water, `tiles` boxes of 216."""
    return [fluid("argon", cells, (0, 0, 0), 1), fluid("argon, triclinic", cells, (0.2, -0.1, 0.15), 2),
            water("water", tiles, 3)]
