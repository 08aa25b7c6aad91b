#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""VerletList and NeighborSearch over many steps: exact pairs, few rebuilds, no growth of memory; nearest neighbors."""
import gc
import pathlib
import resource
import unittest

import numpy as np

import dch
from scenes import Scene, sorted_rows


def fresh(positions, cell, pbc, cutoff):
    return sorted_rows(*dch.neighbour_list("ijSdD", positions=positions, cell=cell, pbc=pbc, cutoff=cutoff))


class Followed(unittest.TestCase):
    def assert_same(self, found, expected, what):
        for name, a, b in zip("ijS", found, expected):
            self.assertEqual(a.shape, b.shape, what)
            self.assertTrue((a == b).all(), f"{what}: {name} differs")
        for a, b in zip(found[3:], expected[3:]):
            self.assertLessEqual(np.abs(a - b).max(initial=0), 1e-12, what)

    def test_pairs_are_exact_at_every_step(self):
        """Atoms move, are wrapped and unwrapped, and cells change, in boxes of any shape."""
        rebuilds = steps = 0
        for seed in range(2000, 2030):
            scene = Scene(seed)
            random, skin = scene.random, 0.3 * scene.cutoff
            verlet = dch.VerletList(scene.cutoff, skin)
            positions, cell = scene.positions, scene.cell
            for step in range(12):
                verlet.update(positions, cell, scene.pbc)
                expected = fresh(positions, cell, scene.pbc, scene.cutoff)
                self.assert_same(sorted_rows(*verlet.pairs("ijSdD")), expected, f"{scene}, step {step}")
                jumps = random.integers(-1, 2, positions.shape) * scene.pbc
                if step % 4 == 3:
                    strain = np.eye(3) + random.uniform(-1e-3, 1e-3, (3, 3))
                    positions, cell = positions @ strain, cell @ strain
                positions = positions + random.uniform(-0.04, 0.04, positions.shape) * skin + jumps @ cell
            rebuilds, steps = rebuilds + verlet.rebuilds, steps + 12
        self.assertLess(rebuilds, steps / 2)

    def test_wrapping_makes_no_rebuild(self):
        random = np.random.default_rng(1)
        cell = np.array([[6.0, 0, 0], [2, 5, 0], [-1, 1, 7]])
        for cutoff in (1.5, 5.9):  # within half the cell, and beyond
            positions = random.random((200, 3)) @ cell
            verlet = dch.VerletList(cutoff, 0.4)
            self.assertTrue(verlet.update(positions, cell))
            for _ in range(5):
                positions = positions + random.uniform(-0.02, 0.02, positions.shape)
                wrapped = positions - np.floor(positions @ np.linalg.inv(cell)) @ cell
                self.assertFalse(verlet.update(wrapped, cell))
                self.assert_same(sorted_rows(*verlet.pairs("ijSdD")), fresh(wrapped, cell, True, cutoff), "wrapped")
            self.assertEqual(verlet.rebuilds, 1)

    def test_any_number_of_threads_gives_the_same_arrays(self):
        """Each leaves a gap where listed pairs are beyond the cutoff; some have no row, or no pair at all."""
        random = np.random.default_rng(3)
        for atoms, cutoff in ((0, 1), (1, 7), (3, 1), (400, 1.2), (400, 1e-3)):
            positions = random.random((atoms, 3)) * 6
            for itself in (False, True):
                found = []
                for threads in (1, 2, 5):
                    verlet = dch.VerletList(cutoff, 0.7, threads=threads)
                    verlet.update(positions, [6, 6, 6])
                    found.append(verlet.pairs("ijdDS", self_interaction=itself))
                    self.assertTrue(all(array.flags.owndata and array.flags.c_contiguous for array in found[-1]))
                for others in found[1:]:
                    for a, b in zip(found[0], others):
                        np.testing.assert_array_equal(a, b)

    def test_half_pairs_radii_and_the_skin(self):
        positions = np.array([[0.0, 0, 0], [1, 0, 0], [2.2, 0, 0]])
        verlet = dch.VerletList([0.5, 0.5, 0.5], 0.3, half=True)
        verlet.update(positions)
        self.assertEqual(verlet.pairs("j").tolist(), [1])
        self.assertEqual(verlet.pairs("j", with_skin=True).tolist(), [1, 2])
        self.assertEqual(verlet.pairs("j", self_interaction=True).tolist(), [0, 1, 1, 2])
        self.assertEqual(len(verlet), 3)
        self.assertEqual(repr(verlet), "VerletList(cutoff=<3 radii>, skin=0.3: 3 particles, 2 pairs listed, 1 rebuilds)")

    def test_other_atoms_make_a_new_list(self):
        verlet = dch.VerletList(1.5, 0.5)
        for atoms in (5, 5, 7, 0, 1):
            verlet.update(np.arange(3 * atoms).reshape(-1, 3))
            self.assertEqual(len(verlet.pairs("i")), 0)
        self.assertGreaterEqual(verlet.rebuilds, 3)

    def test_after_an_error_there_are_no_pairs(self):
        verlet = dch.VerletList(1.5, 0.5)
        with self.assertRaisesRegex(dch.InvalidParameter, "no positions yet"):
            verlet.pairs()
        positions = np.zeros((3, 3))
        verlet.update(positions)
        positions[1] = np.nan
        with self.assertRaises(dch.InvalidPosition):
            verlet.update(positions)
        with self.assertRaisesRegex(dch.InvalidParameter, "call update"):
            verlet.pairs()
        self.assertTrue(verlet.update(np.zeros((3, 3))))

    def test_what_is_refused(self):
        for cutoff, skin in ((0, 1), (-1, 1), (1, -1), (1, np.nan), ([0, 0], 1), ({("H", "H"): 1}, 1)):
            with self.assertRaises(dch.InvalidParameter):
                dch.VerletList(cutoff, skin)
        with self.assertRaisesRegex(dch.InvalidParameter, "radii given for 3"):
            dch.VerletList([1, 1], 0).update(np.zeros((3, 3)))


class Memory(unittest.TestCase):
    def test_updates_do_not_make_it_grow(self):
        random = np.random.default_rng(2)
        positions = random.random((300, 3)) * 7
        verlet, search = dch.VerletList(1.2, 0.1), dch.NeighborSearch(1.2)

        def steps(count):
            moved = positions
            for _ in range(count):
                moved = positions + random.uniform(-0.05, 0.05, positions.shape)
                verlet.update(moved, [7, 7, 7])
                search.update(moved, [7, 7, 7])
                verlet.pairs(), search.csr(), dch.neighbour_list("ijdDS", positions=moved, cell=[7, 7, 7], cutoff=1.2)
                for wrong in ([7, 7, 0], [1, 1, 1]):
                    try:
                        search.update(moved, wrong)
                    except dch.InvalidParameter:
                        pass
            gc.collect()
            pages = int(pathlib.Path("/proc/self/statm").read_text().split()[1])  # resident now, not at most
            return pages * resource.getpagesize()

        before = steps(1000)
        self.assertLess(steps(9000) - before, 30 * 9000)

    def test_arrays_outlive_what_made_them(self):
        search = dch.NeighborSearch(1.5)
        search.update(np.arange(300).reshape(-1, 3) / 5)
        first, j = search.csr()
        expected = first.tolist(), j.tolist()
        self.assertIsNotNone(first.base)  # somebody else's memory
        search.update(np.zeros((5, 3)))
        search.csr()
        del search
        gc.collect()
        self.assertEqual((first.tolist(), j.tolist()), expected)


class Queries(unittest.TestCase):
    def test_rows_are_those_of_the_oracle(self):
        random = np.random.default_rng(7)
        cell = np.array([[6.0, 0, 0], [2, 5, 0], [-1, 1, 7]])
        search = dch.NeighborSearch(2)
        for pbc in (True, False, [True, False, True]):
            positions = random.random((150, 3)) @ cell
            search.update(positions, cell, pbc)
            for full in (False, True):
                for a, b in zip(search.csr(full), dch.all_pairs(positions, 2, cell, pbc, full)):
                    np.testing.assert_array_equal(a, b)
        self.assertEqual(repr(search), "NeighborSearch(cutoff=2.0: 150 particles)")

    def test_what_is_read_in_place_and_what_is_converted_give_the_same_rows(self):
        """One search over cells that come and go, in forms that are read as they are and in others."""
        random = np.random.default_rng(11)
        cell = np.array([[7.0, 0, 0], [2, 6, 0], [-1, 1, 8]])
        search = dch.NeighborSearch(2)
        forms = (np.asarray, np.asfortranarray, np.ndarray.tolist, lambda a: a.astype(">f8"), lambda a: np.repeat(a, 2, axis=0)[::2])
        for step, (of_points, of_cell) in enumerate((a, b) for a in forms for b in forms):
            cell[step % 3] *= (1, 1.01, 0.98)[step % 3]  # in place, at times the same again
            points = random.random((100, 3)) @ cell
            for pbc in (None, True, False, np.True_, [True, False, True]):
                search.update(of_points(points), of_cell(cell), pbc)
                for a, b in zip(search.csr(), dch.all_pairs(points, 2, cell, pbc)):
                    np.testing.assert_array_equal(a, b)
        lengths = np.array([6.0, 7, 8])
        for of_cell in (lengths, np.diag(lengths), np.diag(lengths).astype(np.float32)):
            search.update(points, of_cell)
            for a, b in zip(search.csr(), dch.all_pairs(points, 2, lengths)):
                np.testing.assert_array_equal(a, b)
        for wrong in ((points, cell * np.nan), (points, np.zeros((3, 3))), (points, cell[:2]), (points.T, cell), (points * 1j, cell),
                      (points, None, True), (points, cell, "yes"), (points * np.inf, cell)):
            with self.assertRaises(dch.InvalidParameter):
                search.update(*wrong)
        search.update(points, cell)
        np.testing.assert_array_equal(search.csr()[1], dch.all_pairs(points, 2, cell)[1])

    def test_nearest_neighbors(self):
        random = np.random.default_rng(8)
        points, queries, side = random.random((200, 3)) * 6, random.random((20, 3)) * 9, 6

        def expected(of, k, skip):
            d = points[None] - of[:, None]
            d = np.linalg.norm(d - side * np.rint(d / side), axis=2)
            order = np.argsort(d, axis=1, kind="stable")[:, skip:k + skip]
            return order, np.take_along_axis(d, order, axis=1)

        for found, (index, distance) in ((dch.nearest(points, 5, [side] * 3), expected(points, 5, 1)),
                                         (dch.nearest(points, 3, [side] * 3, queries=queries, threads=2),
                                          expected(queries, 3, 0))):
            np.testing.assert_array_equal(found[0], index)
            np.testing.assert_allclose(found[1], distance, rtol=1e-12)
        index, distance = dch.nearest([[0, 0, 0], [1, 0, 0]], 3)
        self.assertEqual((index.tolist(), distance.tolist()),
                         ([[1, -1, -1], [0, -1, -1]], [[1, np.inf, np.inf], [1, np.inf, np.inf]]))
        self.assertEqual(dch.nearest([], 3)[0].shape, (0, 3))
        self.assertEqual(dch.nearest(np.zeros((4, 3)), 2)[1].tolist(), [[0, 0]] * 4)

    def test_what_is_refused(self):
        with self.assertRaisesRegex(dch.CutoffTooLarge, "half the smallest height"):
            dch.NeighborSearch(2).update(np.zeros((2, 3)), [3, 3, 3])
        for call in (lambda: dch.NeighborSearch(0), lambda: dch.NeighborSearch(np.nan), lambda: dch.NeighborSearch(1).csr(),
                     lambda: dch.nearest([], 0), lambda: dch.nearest([], 1.5), lambda: dch.nearest([], 1, epsilon=-1),
                     lambda: dch.nearest([[0, 0, 0]], 1, queries=[[0, 0]]), lambda: dch.all_pairs([[0, 0, 0]], -1)):
            with self.assertRaises(dch.InvalidParameter):
                call()


if __name__ == "__main__":
    unittest.main()
