#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Copies and pickles: objects with their parameters, results and errors as they are."""
import copy
import multiprocessing
import pickle
import unittest

import numpy as np

import dch
import dch.ase

RANDOM = np.random.default_rng(5)
CELL = [6, 6, 6]
POSITIONS = RANDOM.random((120, 3)) * 6
TYPES = np.arange(120) % 2
BONDS = np.array([[k, k + 1] for k in range(119)])
MATRIX = np.array([[1.5, 1.2], [1.2, 0]])


def objects():
    """Each with how it is asked."""
    yield dch.VerletList(1.5, 0.2, half=True, exclusions=BONDS, threads=2), lambda v: v.pairs("ijS")
    yield dch.VerletList(MATRIX, 0.2, types=TYPES), lambda v: v.pairs("ijS")
    yield dch.VerletList(np.full(120, 0.7), 0.2), lambda v: v.pairs("ijS")
    yield dch.NeighborSearch(1.5, threads=2), lambda s: s.csr()
    yield dch.NeighborSearch(MATRIX, types=TYPES, exclusions=BONDS), lambda s: s.csr()


def pairs_of(verlet):
    verlet.update(POSITIONS, CELL)
    return verlet.pairs("ij")


def refused(_):
    return dch.VerletList(-1, 0)


class Pickles(unittest.TestCase):
    def assert_same(self, a, b):
        for x, y in zip(a, b, strict=True):
            np.testing.assert_array_equal(x, y)

    def test_parameters_alone(self):
        for made, asked in objects():
            made.update(POSITIONS, CELL)
            for other in (pickle.loads(pickle.dumps(made)), copy.copy(made), copy.deepcopy(made)):
                self.assertEqual(len(other), 0)
                self.assertRaises(dch.InvalidParameter, asked, other)
                other.update(POSITIONS, CELL)
                self.assert_same(asked(made), asked(other))

    def test_arrays_that_change_afterwards_do_not_matter(self):
        types, matrix = TYPES.copy(), MATRIX.copy()
        made = dch.NeighborSearch(matrix, types=types)
        types[:], matrix[:] = 0, 0.1
        other = pickle.loads(pickle.dumps(made))
        for search in (made, other):
            search.update(POSITIONS, CELL)
        self.assert_same(made.csr(), other.csr())

    def test_bonds_that_cross(self):
        made = dch.Crossings(120, BONDS, thickness=0.1)
        made.bonds = BONDS[:100]
        other = pickle.loads(pickle.dumps(made))
        np.testing.assert_array_equal(other.bonds, made.bonds)
        self.assertRaises(dch.InvalidParameter, other.step, POSITIONS, CELL)
        for each in (made, other):
            each.start(POSITIONS, CELL)
        moved = POSITIONS + RANDOM.uniform(-0.5, 0.5, POSITIONS.shape)
        found = made.step(moved, CELL)
        self.assertGreater(len(found.crossings.time), 0)
        for a in (other.step(moved, CELL), pickle.loads(pickle.dumps(found))):
            self.assert_same(found.crossings, a.crossings)
            self.assert_same(found.contacts, a.contacts)

    def test_lists_of_ase(self):
        made = dch.ase.PrimitiveNeighborList([0.7] * 120, 0.1)
        made.update(True, 6 * np.eye(3), POSITIONS)
        other = copy.deepcopy(made)
        other.update(True, 6 * np.eye(3), POSITIONS)
        self.assert_same(made.get_neighbors(7), other.get_neighbors(7))

    def test_other_processes(self):
        verlet = dch.VerletList(1.5, 0.2)
        with multiprocessing.get_context("spawn").Pool(1) as pool:
            self.assert_same(pairs_of(verlet), pool.apply(pairs_of, [verlet]))
            with self.assertRaisesRegex(dch.InvalidParameter, "cutoff is -1"):
                pool.apply(refused, [None])


if __name__ == "__main__":
    unittest.main()
