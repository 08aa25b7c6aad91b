#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What arrays of pairs are: of float32 or float64, new ones or given ones."""
import itertools
import unittest

import numpy as np

import dch
from scenes import Scene

TYPES = {"i": np.int64, "j": np.int64, "d": np.float64, "D": np.float64, "S": np.int64}


def given(letters, rows, real=np.float64):
    """Arrays that hold nothing but -7."""
    return tuple(np.full((rows, 3) if letter in "DS" else rows, -7, real if letter in "dD" else TYPES[letter])
                 for letter in letters)


class Outputs(unittest.TestCase):
    def assert_same(self, found, expected):
        for one, other in zip(found, expected, strict=True):
            self.assertEqual(one.dtype, other.dtype)
            np.testing.assert_array_equal(one, other)

    def assert_given(self, found, out, expected):
        """What is found are the beginnings of out, which is as before behind them."""
        self.assert_same(found, expected)
        for one, array in zip(found, out, strict=True):
            self.assertIs(one.base, array)
            self.assertEqual(one.ctypes.data, array.ctypes.data)
            self.assertTrue((array[len(one):] == -7).all())

    def test_float32_is_float64_rounded(self):
        for seed in range(4200, 4230):
            scene = Scene(seed)
            options = dict(positions=scene.positions, cell=scene.cell, pbc=scene.pbc, cutoff=scene.cutoff)
            for half, threads in ((False, 1), (True, 3)):
                i, D, d, j = dch.neighbour_list("iDdj", half=half, threads=threads, **options)
                rounded = dch.neighbour_list("iDdj", half=half, threads=threads, dtype=np.float32, **options)
                self.assert_same(rounded, (i, D.astype(np.float32), d.astype(np.float32), j))
                self.assert_same(dch.neighbour_list("iDdj", half=half, threads=threads, dtype="float64", **options), (i, D, d, j))

    def test_float32_of_ase_s_call_of_verlet_lists_and_of_nearest_atoms(self):
        scene = Scene(4300)
        atoms = type("Atoms", (), dict(positions=scene.positions, cell=scene.cell, pbc=scene.pbc, numbers=scene.numbers))
        self.assert_same(dch.neighbor_list("dS", atoms, 3.0, True, dtype="f4"),
                         [a if a.dtype == int else a.astype(np.float32) for a in dch.neighbor_list("dS", atoms, 3.0, True)])
        verlet = dch.VerletList(3.0, 0.4)
        verlet.update(scene.positions, scene.cell, scene.pbc)
        self.assert_same([verlet.pairs("D", dtype=np.float32)], [verlet.pairs("D").astype(np.float32)])
        index, distance = dch.nearest(scene.positions, 3)
        self.assert_same(dch.nearest(scene.positions, 3, dtype=np.float32), (index, distance.astype(np.float32)))

    def test_given_arrays_are_filled_from_their_beginning(self):
        for seed, real, spare in itertools.product(range(4400, 4410), (np.float64, np.float32), (0, 5)):
            scene = Scene(seed)
            options = dict(positions=scene.positions, cell=scene.cell, pbc=scene.pbc, cutoff=scene.cutoff, dtype=real)
            expected = dch.neighbour_list("SdjDi", **options)
            out = given("SdjDi", len(expected[0]) + spare, real)
            self.assert_given(dch.neighbour_list("SdjDi", out=out, threads=2, **options), out, expected)

    def test_given_arrays_of_a_verlet_list_have_rows_for_the_skin(self):
        random = np.random.default_rng(4500)
        positions = random.random((400, 3)) * 8
        verlet = dch.VerletList(1.5, 0.5)
        verlet.update(positions, [8, 8, 8])
        listed = len(verlet.pairs("i", with_skin=True))
        for step in range(3):
            expected = verlet.pairs("ijdDS")
            self.assertLess(len(expected[0]), listed)
            out = given("ijdDS", listed)
            found = verlet.pairs("ijdDS", out=out)
            self.assert_same(found, expected)
            self.assertTrue(all(one.base is array for one, array in zip(found, out)))
            verlet.update(positions + 0.05 * step, [8, 8, 8])
        with self.assertRaisesRegex(dch.InvalidParameter, f"has {listed - 1} rows for {listed} pairs; give at least as many"):
            verlet.pairs("ijdDS", out=given("ijdDS", listed - 1))

    def test_given_arrays_of_nearest_atoms(self):
        random = np.random.default_rng(4600)
        points, queries = random.random((50, 3)) * 4, random.random((7, 3)) * 4
        for real, asked in itertools.product((np.float64, np.float32), (None, queries)):
            index, distance = dch.nearest(points, 3, [4, 4, 4], queries=asked, dtype=real)
            out = np.full(index.shape, -7, np.int32), np.full(index.shape, -7, real)
            found = dch.nearest(points, 3, [4, 4, 4], queries=asked, dtype=real, out=out)
            self.assert_same(found, (index, distance))
            self.assertTrue(all(one is array for one, array in zip(found, out, strict=True)))

    def test_one_letter_takes_and_gives_one_array(self):
        out = np.full(10, -7.0)
        found = dch.neighbour_list("d", positions=[[0, 0, 0], [1, 0, 0]], cutoff=2, out=out)
        self.assert_given([found], [out], [np.array([1.0, 1.0])])

    def test_nothing_is_found(self):
        for positions, cutoff in (([], 1), ([[0, 0, 0]], 1), ([[0, 0, 0], [1, 0, 0]], 0)):
            for real, rows in itertools.product((np.float32, np.float64), (0, 2)):
                expected = given("dDS", 0, real)
                self.assert_same(dch.neighbour_list("dDS", positions=positions, cutoff=cutoff, dtype=real), expected)
                out = given("dDS", rows, real)
                self.assert_given(dch.neighbour_list("dDS", positions=positions, cutoff=cutoff, dtype=real, out=out), out, expected)


class Refusals(unittest.TestCase):
    positions = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0.0]])

    def refuse(self, message, quantities="ijdD", **options):
        with self.assertRaisesRegex(dch.InvalidParameter, message):
            dch.neighbour_list(quantities, positions=self.positions, cutoff=1.2, **options)

    def test_types(self):
        for dtype in (np.float16, int, complex, object, "S3"):
            self.refuse("dtype is .*; give float32 or float64", dtype=dtype)
        self.refuse("dtype is 'nonsense', which is no type of numbers", dtype="nonsense")
        with self.assertRaisesRegex(dch.InvalidParameter, "dtype is int64"):
            dch.nearest(self.positions, 1, dtype=np.int64)

    def test_too_few_rows(self):
        self.refuse(r"out\[0\], that of i, has 3 rows for 4 pairs; give at least as many", out=given("ijdD", 3))
        out = given("ijdD", 4)
        self.refuse(r"out\[2\], that of d, has 0 rows for 4 pairs", out=(out[0], out[1], np.zeros(0), out[3]))

    def test_other_arrays(self):
        i, j, d, D = given("ijdD", 4)
        for wrong in (None, (i, j, d), (i, j, d, D, D), 3, i):
            if wrong is not None:
                self.refuse("out has . arrays for the quantities 'ijdD'; give an array for each letter", out=wrong)
        self.refuse("out has 2 arrays for the quantities 'ii'", quantities="ii", out=(i, j))
        self.refuse("out for i has .*int32; give an array of int64", out=(i.astype(np.int32), j, d, D))
        self.refuse("out for d has .*float32; give an array of float64", out=(i, j, d.astype(np.float32), D))
        self.refuse("out for d has .*float64; give an array of float32", out=(i, j, d, D), dtype=np.float32)
        self.refuse(r"out for D has the shape \(4, 2\)", out=(i, j, d, np.zeros((4, 2))))
        self.refuse(r"out for d has the shape \(4, 1\)", out=(i, j, np.zeros((4, 1)), D))
        self.refuse(r"out for d has \[0, 0, 0, 0\]", out=(i, j, [0, 0, 0, 0], D))
        self.refuse("out for D has .*>f8", out=(i, j, d, D.astype(">f8")))

    def test_arrays_that_cannot_be_written_to(self):
        i, j, d, D = given("ijdD", 4)
        d.flags.writeable = False
        self.refuse("out for d is read-only or not contiguous", out=(i, j, d, D))
        d = np.zeros(8)[::2]
        self.refuse("out for d is read-only or not contiguous", out=(i, j, d, D))
        bytes_ = np.zeros(8 * 4 + 1, np.uint8)[1:]
        self.refuse("out for d is read-only or not contiguous", out=(i, j, bytes_.view(np.float64), D))

    def test_arrays_of_nearest_atoms(self):
        index, distance = np.zeros((3, 1), np.int32), np.zeros((3, 1))
        frozen = distance.copy()
        frozen.flags.writeable = False
        for out, message in ((index, "out is ndarray; give two arrays"), ((index,), "out is tuple"),
                             ((index[:2], distance), r"out for index has the shape \(2, 1\).*int32 with the shape \(3, 1\)"),
                             ((index.astype(int), distance), "out for index has .*int64"),
                             ((index, distance.astype(np.float32)), "out for distance has .*float32"),
                             ((index, frozen), "out for distance is read-only"),
                             ((index, self.positions[:, :1]), "out for distance is read-only or not contiguous"),
                             ((distance.reshape(-1).view(np.int32)[:3].reshape(3, 1), distance), "out for distance shares memory")):
            with self.assertRaisesRegex(dch.InvalidParameter, message):
                dch.nearest(self.positions, 1, out=out)

    def test_arrays_that_share_memory(self):
        i, j, d, D = given("ijdD", 4)
        self.refuse("out for j shares memory", out=(i, i, d, D))
        self.refuse("out for D shares memory", out=(i, j, D.reshape(-1)[8:], D))
        self.refuse("out for D shares memory", quantities="D", out=self.positions)


if __name__ == "__main__":
    unittest.main()
