#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Lists by types and without excluded pairs, against every pair by numpy in a cell of lengths, and against each other."""
import itertools
import unittest

import numpy as np

import dch
from scenes import Scene, sorted_rows

CUTOFFS = np.array([[2.0, 1.2, 0.0], [1.2, 0.0, 1.7], [0.0, 1.7, 0.9]])


def rows_of(first, j):
    return [j[a:b].tolist() for a, b in zip(first, first[1:])]


class Oracle:
    """Particles in a rectangular cell whose pairs are looked at one by one, in numpy."""

    def __init__(self, seed, atoms=120):
        random = self.random = np.random.default_rng(seed)
        self.cell = random.uniform(4.5, 7, 3)
        self.positions = random.random((atoms, 3)) * self.cell
        self.types = random.integers(0, 3, atoms)
        self.exclusions = np.array([[a, a + 1] for a in range(atoms - 1)] + [[a + 2, a] for a in range(atoms - 2)])

    def pairs(self, images=1):
        """Sorted (i, j, S) of half lists: i < j, or i = j and S > 0."""
        n, limit = len(self.positions), CUTOFFS[self.types[:, None], self.types]
        is_wanted = limit > 0
        is_wanted[tuple(self.exclusions.T)] = is_wanted[tuple(self.exclusions.T[::-1])] = False
        out = []
        for shift in itertools.product(range(-images, images + 1), repeat=3):
            d = self.positions[None] - self.positions[:, None] + np.array(shift) * self.cell
            is_pair = is_wanted & (np.linalg.norm(d, axis=2) <= limit)
            is_pair &= np.triu(np.ones((n, n), bool), 0 if shift > (0, 0, 0) else 1)
            out += [(int(i), int(j), *shift) for i, j in np.argwhere(is_pair)]
        return sorted(out)

    def options(self):
        return dict(types=self.types, exclusions=self.exclusions)


class Selected(unittest.TestCase):
    def test_searches_and_verlet_lists_find_what_numpy_finds(self):
        for seed in range(3100, 3110):
            oracle = Oracle(seed)
            expected = oracle.pairs()
            self.assertGreater(len(expected), 100)
            search = dch.NeighborSearch(CUTOFFS, **oracle.options())
            search.update(oracle.positions, oracle.cell)
            first, j = search.csr()
            found = sorted((i, k) for i, row in enumerate(rows_of(first, j)) for k in row)
            self.assertEqual(found, [(i, k) for i, k, *_ in expected], seed)
            verlet = dch.VerletList(CUTOFFS, 0.2, half=True, **oracle.options())
            verlet.update(oracle.positions, oracle.cell)
            self.assertEqual(sorted(zip(*(a.tolist() for a in verlet.pairs("ij")))), found)

    def test_small_cells_leave_out_all_images_of_an_excluded_pair(self):
        oracle = Oracle(3150, atoms=25)
        oracle.cell = np.array([1.1, 1.5, 1.3])
        expected = oracle.pairs(images=5)
        self.assertTrue(any(i == j for i, j, *_ in expected))
        verlet = dch.VerletList(CUTOFFS, 0.2, half=True, **oracle.options())
        verlet.update(oracle.positions, oracle.cell)
        i, j, S = verlet.pairs("ijS")
        self.assertEqual(sorted(zip(i.tolist(), j.tolist(), *S.T.tolist())), expected)

    def test_rows_in_any_order_have_the_same_pairs(self):
        oracle = Oracle(3160, atoms=1500)
        oracle.cell = np.array([14.0, 15, 13])
        oracle.positions = oracle.random.random((1500, 3)) * oracle.cell
        search = dch.NeighborSearch(CUTOFFS, **oracle.options())
        search.update(oracle.positions, oracle.cell)
        for full in (False, True):
            expected = rows_of(*search.csr(full))
            particle, first, j = search.unsorted(full)
            self.assertEqual(len(j), first[-1])
            found = [[] for _ in expected]
            for k, row in zip(particle.tolist(), rows_of(first, j)):
                for neighbor in row:
                    found[k if full else min(k, neighbor)].append(neighbor if full else max(k, neighbor))
            self.assertEqual([sorted(row) for row in found], expected)
            oracle_rows = dch.all_pairs(oracle.positions, CUTOFFS, oracle.cell, full=full, **oracle.options())
            self.assertEqual(rows_of(*oracle_rows), expected)

    def test_exclusions_hold_while_atoms_move(self):
        for seed in range(3170, 3180):
            scene = Scene(seed)
            atoms, random = len(scene.positions), scene.random
            excluded = random.integers(0, atoms, (2 * atoms, 2))
            excluded = excluded[excluded[:, 0] != excluded[:, 1]]
            verlet = dch.VerletList(scene.cutoff, 0.3 * scene.cutoff, exclusions=excluded)
            positions = scene.positions
            for _ in range(5):
                verlet.update(positions, scene.cell, scene.pbc)
                i, j, S = dch.neighbour_list("ijS", positions=positions, cell=scene.cell, pbc=scene.pbc, cutoff=scene.cutoff)
                is_left = np.ones((atoms, atoms), bool)
                is_left[tuple(excluded.T)] = is_left[tuple(excluded.T[::-1])] = False
                expected = sorted_rows(*(a[is_left[i, j]] for a in (i, j, S)))
                for a, b in zip(sorted_rows(*verlet.pairs("ijS")), expected):
                    np.testing.assert_array_equal(a, b, f"{scene}")
                positions = positions + random.uniform(-0.04, 0.04, positions.shape) * scene.cutoff

    def test_the_arrays_given_may_change_afterwards(self):
        cutoffs, types, exclusions = CUTOFFS.copy(), np.array([0, 0, 1], np.int32), np.array([[0, 1]], np.int32)
        search = dch.NeighborSearch(cutoffs, types=types, exclusions=exclusions)
        cutoffs[:], types[:], exclusions[:] = 0, 2, 2
        search.update([[0, 0, 0], [1, 0, 0], [0, 1, 0]])
        self.assertEqual(rows_of(*search.csr()), [[2], [], []])


class Refused(unittest.TestCase):
    def refused(self, text, cutoff=CUTOFFS, **options):
        for make in (dch.NeighborSearch, lambda *a, **o: dch.VerletList(*a, 0.1, **o)):
            with self.assertRaisesRegex(dch.InvalidParameter, text):
                make(cutoff, **options).update(np.zeros((3, 3)))

    def test_types_and_matrices(self):
        self.refused("give types beside|types beside a matrix")
        self.refused("row and a column for each type", 1.5, types=[0, 0, 0])
        self.refused("row and a column for each type", CUTOFFS[:2], types=[0, 0, 0])
        self.refused(r"types\[1\] is 3; give rows of the matrix of cutoffs, from 0 to 2", types=[0, 3, 0])
        self.refused(r"types\[2\] is -1", types=[0, 1, -1])
        self.refused("give a whole number for each", types=[0.5, 1, 1])
        self.refused("symmetric", [[1, 2], [3, 1]], types=[0, 1, 0])
        self.refused("2 particle types given for 3 particles", types=[0, 1])
        self.refused("cutoff", np.zeros((2, 2)), types=[0, 1, 0])

    def test_exclusions(self):
        self.refused(r"exclusions has the shape \(2,\)", 1.0, exclusions=[0, 1])
        self.refused("exclusions has the index -1", 1.0, exclusions=[[0, -1]])
        self.refused(r"\(0, 3\) names particle 3, but indices run from 0 to 2", 1.0, exclusions=[[0, 3]])
        self.refused("names one particle twice", 1.0, exclusions=[[1, 1]])


if __name__ == "__main__":
    unittest.main()
