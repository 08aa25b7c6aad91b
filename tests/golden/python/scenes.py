# SPDX-License-Identifier: MIT
"""Random scenes in which nothing is chosen by hand, small enough for ASE."""
import numpy as np

MAX_PAIRS = 10000


class Scene:
    """Atoms in a cell of any shape, periodic along any of its vectors, with a cutoff of up to four of its heights."""

    def __init__(self, seed):
        self.seed = seed
        random = self.random = np.random.default_rng(seed)
        self.pbc = random.random(3) < 0.7
        self.cell = self.random_cell()
        heights = 1 / np.linalg.norm(np.linalg.inv(self.cell), axis=0)
        self.cutoff = heights.min() * random.uniform(0.05, 4)
        # As many atoms as give ASE, whose work grows with the images of a cell, a moderate number of pairs.
        density = 4.2 * self.cutoff**3 / abs(np.linalg.det(self.cell))
        atoms = int(np.clip(np.sqrt(MAX_PAIRS / density) * random.random(), 1, 60))
        self.positions = self.random_positions(atoms)
        self.numbers = random.choice([1, 6, 8], atoms)

    def random_cell(self):
        random = self.random
        cell = np.diag(random.uniform(2, 8, 3))
        if random.random() < 0.7:
            cell = cell + random.uniform(-2, 2, (3, 3))
        if random.random() < 0.4:  # skewed: a lattice vector more of another
            a, b = random.permutation(3)[:2]
            cell[a] += random.integers(-2, 3) * cell[b]
        if random.random() < 0.1:
            cell[0] *= -1  # left-handed
        return cell if abs(np.linalg.det(cell)) > 4 else self.random_cell()

    def random_positions(self, atoms):
        random = self.random
        fractional = random.random((atoms, 3))
        if random.random() < 0.6:  # outside the cell
            fractional += random.integers(-2, 3, (atoms, 3)) * (random.random((atoms, 1)) < 0.4)
        if random.random() < 0.1 and atoms > 1:
            fractional[1] = fractional[0]
        return fractional @ self.cell

    def __repr__(self):
        return f"scene {self.seed}: {len(self.positions)} atoms, cutoff {self.cutoff:.3f}, pbc {self.pbc.tolist()}"


def sorted_rows(i, j, shifts, *others):
    """In an order that does not depend on how pairs were found."""
    order = np.lexsort((shifts[:, 2], shifts[:, 1], shifts[:, 0], j, i))
    return tuple(array[order] for array in (i, j, shifts, *others))
