#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What arguments of the pair functions may be, and what is refused: shapes, types, kinds of cells, memory, threads."""
import doctest
import os
import threading
import unittest
from unittest import mock

import numpy as np

import dch
import dch._pairs
import dch._queries
import dch.ase
import dch.mdanalysis
from scenes import sorted_rows

SQUARE = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]])


def pairs_of(positions, **options):
    return list(zip(*(a.tolist() for a in dch.neighbour_list("ij", positions=positions, cutoff=1.1, **options))))


class Input(unittest.TestCase):
    def test_arrays_of_any_layout_are_read(self):
        expected = pairs_of(SQUARE)
        self.assertEqual(len(expected), 8)
        wide = np.zeros((4, 6))
        wide[:, ::2] = SQUARE
        for positions in (SQUARE.astype(np.float32), SQUARE.astype(int), SQUARE.astype(">f8"), np.asfortranarray(SQUARE),
                          wide[:, ::2], np.concatenate((SQUARE, SQUARE))[:4][::-1][::-1], SQUARE.tolist()):
            self.assertEqual(pairs_of(positions), expected)
        frozen = SQUARE.copy()
        frozen.flags.writeable = False
        self.assertEqual(pairs_of(frozen), expected)

    def test_an_array_of_doubles_is_not_copied(self):
        self.assertIs(dch._arguments.points(SQUARE), SQUARE)

    def test_no_atom_and_one_atom(self):
        for empty in ([], np.zeros((0, 3))):
            i, d, S = dch.neighbour_list("idS", positions=empty, cutoff=1, cell=[1, 1, 1])
            self.assertEqual((i.shape, d.shape, S.shape), ((0,), (0,), (0, 3)))
            self.assertEqual((i.dtype, d.dtype, S.dtype), (np.int64, np.float64, np.int64))
        self.assertEqual(len(dch.neighbour_list("i", positions=[[1, 2, 3]], cutoff=1.5, cell=[1, 1, 1])), 18)
        self.assertEqual(len(dch.neighbour_list("i", positions=[[1, 2, 3]], cutoff=5)), 0)
        self.assertEqual(len(dch.neighbour_list("i", positions=SQUARE, cutoff=0)), 0)

    def test_quantities_come_in_the_order_asked_for_and_twice(self):
        d, i, again = dch.neighbour_list("did", positions=SQUARE, cutoff=1.1)
        self.assertEqual(d.tolist(), again.tolist())
        self.assertFalse(np.shares_memory(d, again))
        self.assertEqual(i.tolist(), [0, 0, 1, 1, 2, 2, 3, 3])

    def test_vectors_along_open_axes_have_no_meaning(self):
        chain, pbc = [[0.5, 70, -3]], [False, True, False]
        for open_vector in ([0, 0, 0], [0, 1, 0], [5, 1, 2]):
            cell = np.array([open_vector, [0, 2, 0], open_vector], float)
            S = dch.neighbour_list("S", positions=chain, cell=cell, pbc=pbc, cutoff=2.5)
            self.assertEqual(sorted(S.tolist()), [[0, -1, 0], [0, 1, 0]])

    def test_a_dict_of_cutoffs(self):
        numbers = [1, 8, 1, 8]
        i, j = dch.neighbour_list("ij", positions=SQUARE, numbers=numbers, cutoff={("H", 8): 1.1, ("O", "O"): 0.5})
        self.assertEqual(list(zip(i.tolist(), j.tolist())), [(0, 1), (1, 0), (2, 3), (3, 2)])
        self.assertEqual(len(dch.neighbour_list("i", positions=SQUARE, numbers=numbers, cutoff={("C", "N"): 9})), 0)


class Refused(unittest.TestCase):
    def refused(self, text, error=dch.InvalidParameter, **changed):
        arguments = dict(quantities="ij", positions=SQUARE, cutoff=1.1, cell=[3, 3, 3], pbc=True) | changed
        with self.assertRaisesRegex(error, text):
            dch.neighbour_list(**arguments)

    def test_errors_are_value_errors(self):
        for error in (dch.InvalidParameter, dch.InvalidBox, dch.InvalidPosition, dch.CutoffTooLarge):
            self.assertTrue(issubclass(error, ValueError))
            self.assertTrue(issubclass(error, dch.InvalidParameter))

    def test_positions(self):
        self.refused(r"shape \(4, 2\); give one of \(n, 3\)", positions=SQUARE[:, :2])
        self.refused(r"shape \(3,\)", positions=[1, 2, 3])
        self.refused("complex128; give real", positions=SQUARE * 1j)
        self.refused("object; give real", positions=SQUARE.astype(object))
        self.refused("<U", positions=[["a", "b", "c"]])
        self.refused("rows of equal length", positions=[[1, 2, 3], [1, 2]])
        self.refused("there are no positions", positions=None)
        for bad in (np.nan, np.inf, 1e101):
            broken = SQUARE.copy()
            broken[2, 1] = bad
            self.refused(r"position 2 = .* is not finite or beyond", dch.InvalidPosition, positions=broken)
        self.refused("wrap the coordinates", dch.InvalidPosition, positions=SQUARE + [1e12, 0, 0])

    def test_cells(self):
        self.refused(r"shape \(2, 2\); give three vectors", cell=np.eye(2))
        self.refused("linearly dependent", dch.InvalidBox, cell=[[1, 0, 0], [2, 0, 0], [0, 0, 1]])
        self.refused("0 long", dch.InvalidBox, cell=[[1, 0, 0], [0, 0, 0], [0, 0, 1]])
        self.refused("linearly dependent", dch.InvalidBox, cell=[[1, 0, 0], [2, 0, 0], [0, 0, 1]],
                     pbc=[True, True, False])
        self.refused("must be finite", cell=[1, 2, np.nan])
        self.refused("there is no cell", cell=None)
        self.refused("give True, False, or three", pbc=[True, False])
        self.refused("give True, False, or three", pbc="xyz")

    def test_cutoffs(self):
        for bad in (-1, np.nan, np.inf, "long", None, 1j):
            self.refused("cutoff", cutoff=bad)
        self.refused(r"shape \(3,\) for 4 atoms", cutoff=[1, 1, 1])
        self.refused(r"cutoff\[2\] is nan", cutoff=[1, 1, np.nan, 1])
        self.refused(r"cutoff\[0\] is -1", cutoff=[-1, 1, 1, 1])
        self.refused("no atomic numbers", cutoff={("H", "H"): 1})
        kinds = dict(numbers=[1, 1, 8, 8])
        self.refused("no element", cutoff={("H", "Xx"): 1}, **kinds)
        self.refused("pairs of elements", cutoff={"H": 1}, **kinds)
        self.refused(r"cutoff\[\('H', 'O'\)\] is -2", cutoff={("H", "O"): -2}, **kinds)
        self.refused("number for each of the 4 atoms", cutoff={("H", "O"): 2}, numbers=[1])
        self.refused("list radius|radius", cutoff=1e-40)

    def test_letters_and_threads(self):
        self.refused("'x' is none of i, j, d, D and S", quantities="ijx")
        self.refused("give a text", quantities="")
        self.refused("give a text", quantities=5)
        for bad in (0, -1, 5000, 1.5, "two"):
            self.refused("threads is", threads=bad)
        for bad in ("none", "0", "-3", ""):
            with mock.patch.dict(os.environ, DCH_NUM_THREADS=bad):
                self.refused("DCH_NUM_THREADS is")
        self.refused("give either", atoms=object())

    def test_more_pairs_than_memory(self):
        """Before anything is listed: images of one atom, and atoms on one spot."""
        with self.assertRaisesRegex(MemoryError, "images of particles.*smaller cutoff"):
            dch.neighbour_list("ijS", positions=[[0, 0, 0]], cell=[1, 1, 1], cutoff=1e4)
        with self.assertRaisesRegex(MemoryError, "about 1e\\+12 pairs|pairs are expected"):
            dch.neighbour_list("ijS", positions=np.zeros((1000000, 3)), cutoff=1)
        with self.assertRaisesRegex(MemoryError, "neighbors take .*smaller k"):
            dch.nearest(np.zeros((10000000, 3)), 2**20)
        search = dch.NeighborSearch(1)
        search.update(np.zeros((1000000, 3)))
        with self.assertRaisesRegex(MemoryError, "pairs take .* bytes.*smaller cutoff"):
            search.csr()


class Threads(unittest.TestCase):
    def test_any_number_of_threads_gives_the_same_arrays(self):
        positions = np.random.default_rng(3).random((500, 3)) * 9
        for cutoff in (1.5, 6):
            expected = dch.neighbour_list("ijdDS", positions=positions, cell=[9, 8, 7], cutoff=cutoff)
            with mock.patch.dict(os.environ, DCH_NUM_THREADS="2"):
                by_environment = dch.neighbour_list("ijdDS", positions=positions, cell=[9, 8, 7], cutoff=cutoff)
            three = dch.neighbour_list("ijdDS", positions=positions, cell=[9, 8, 7], cutoff=cutoff, threads=3)
            for a, b, c in zip(expected, by_environment, three):
                np.testing.assert_array_equal(a, b)
                np.testing.assert_array_equal(a, c)

    def test_the_interpreter_goes_on_meanwhile(self):
        """Another thread runs while pairs are found, and an object that is in use refuses it."""
        positions = np.random.default_rng(4).random((60000, 3)) * 20
        search = dch.NeighborSearch(3)
        search.update(positions[:10])
        refused, steps, done = [], [], threading.Event()

        def other():
            while not done.is_set():
                steps.append(1)
                try:
                    search.csr()
                except RuntimeError as error:
                    refused.append(str(error))
                    return

        for _ in range(50):  # until the other one was there at the right moment
            thread = threading.Thread(target=other)
            done.clear()
            thread.start()
            try:
                search.update(positions)
            except RuntimeError as error:
                refused.append(str(error))
            done.set()
            thread.join()
            if refused:
                break
        self.assertTrue(refused and steps)
        self.assertRegex(refused[0], "another thread is using this NeighborSearch")

    def test_a_forked_process_has_threads_of_its_own(self):
        positions = np.random.default_rng(5).random((500, 3)) * 9
        verlet = dch.VerletList(1.0, 0.1, threads=2)
        verlet.update(positions)
        expected = len(verlet.pairs("i"))
        child = os.fork()
        if child == 0:
            verlet.update(positions + 1)
            os._exit(0 if len(verlet.pairs("i")) == expected else 1)
        self.assertEqual(os.waitpid(child, 0)[1], 0)


class Documents(unittest.TestCase):
    def test_examples_in_docstrings_run(self):
        for module in (dch._chains, dch._contacts, dch._crossings, dch._hierarchy, dch._pairs, dch._queries, dch.ase, dch.mdanalysis):
            result = doctest.testmod(module)
            self.assertEqual(result.failed, 0, module)
            self.assertGreater(result.attempted, 1)

    def test_images_of_both_conventions_are_the_same(self):
        random = np.random.default_rng(6)
        positions, cell = random.random((30, 3)) * 4, np.diag([4.0, 4, 4])
        atoms = mock.Mock(positions=positions, cell=cell, pbc=[True] * 3)
        first = sorted_rows(*dch.neighbor_list("ijS", atoms, 3))
        second = sorted_rows(*dch.neighbour_list("ijS", positions=positions, cell=cell, cutoff=3))
        for a, b in zip(first, second):
            np.testing.assert_array_equal(a, b)


if __name__ == "__main__":
    unittest.main()
