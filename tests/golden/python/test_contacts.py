#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Chains, contacts, their maps and files of cooler, levels of the hierarchy, and frames of trajectories."""
import copy
import importlib
import pathlib
import pickle
import tempfile
import threading
import unittest

import numpy as np

import dch

DATA = pathlib.Path(__file__).resolve().parents[2] / "data"
CELL = np.array([[9.0, 0, 0], [2, 8, 0], [-1, 1, 10]])


def chains_and_positions(seed, chains=6, beads=25):
    random = np.random.default_rng(seed)
    walk = random.normal(size=(chains, beads, 3)).cumsum(axis=1) + random.random((chains, 1, 3)) @ CELL
    bonds = np.array([[c * beads + k, c * beads + k + 1] for c in range(chains) for k in range(beads - 1)])
    return dch.Chains.from_bonds(chains * beads, bonds), walk.reshape(-1, 3)


def nearest(d, periodic):
    """By all images of the cell around that which rounding names."""
    if not periodic:
        return d
    d = d - np.rint(d @ np.linalg.inv(CELL)) @ CELL
    images = d[..., None, :] + np.array([[a, b, c] for a in (-1, 0, 1) for b in (-1, 0, 1) for c in (-1, 0, 1)]) @ CELL
    best = (images**2).sum(axis=-1).argmin(axis=-1)
    return np.take_along_axis(images, best[..., None, None], axis=-2)[..., 0, :]


def all_contacts(positions, radii, gap, chain, place, skip, within, between, periodic):
    i, j = np.triu_indices(len(positions), 1)
    same = chain[i] == chain[j]
    wanted = np.where(same, within & (np.abs(place[i] - place[j]) > skip), between)
    d = np.linalg.norm(nearest(positions[j] - positions[i], periodic), axis=1) - radii[i] - radii[j]
    near = wanted & (d <= gap)
    return i[near], j[near], d[near]


class OfChains(unittest.TestCase):
    def test_kinds_of_input(self):
        made = dch.Chains(6, [[2, 1, 0], [3, 4, 5]], closed=[False, True])
        self.assertEqual([chain.tolist() for chain in made], [[2, 1, 0], [3, 4, 5]])
        self.assertEqual(made[-1].tolist(), [3, 4, 5])
        self.assertEqual(repr(made), "Chains(2 chains, 6 of 6 particles)")
        self.assertEqual([c.tolist() for c in dch.Chains.from_molecules([7, 0, 7, 3])], [[3], [0, 2]])
        self.assertEqual(len(dch.Chains(3)), 0)
        for other in (copy.copy(made), pickle.loads(pickle.dumps(made))):
            np.testing.assert_array_equal(other.bonds, made.bonds)
            self.assertEqual(other.closed.tolist(), [False, True])

    def test_what_is_refused(self):
        for call in (lambda: dch.Chains(3, [[0, 3]]), lambda: dch.Chains(3, [[0, 0]]), lambda: dch.Chains(3, [[0, 1]], closed=True),
                     lambda: dch.Chains(3, [[0.5]]), lambda: dch.Chains(3, [[-1]]), lambda: dch.Chains(-1), lambda: dch.Chains(3, [[]]),
                     lambda: dch.Chains(3, [[0, 1]], closed=[True, False]), lambda: dch.Chains.from_bonds(4, [[0, 1], [0, 2], [0, 3]]),
                     lambda: dch.Chains.from_molecules([-1]), lambda: dch.ContactFinder(None, 1),
                     lambda: dch.ContactFinder(dch.Chains(3), np.nan), lambda: dch.ContactFinder(dch.Chains(3), 1, [1, 1]),
                     lambda: dch.ContactFinder(dch.Chains(3), 1, -1), lambda: dch.ContactFinder(dch.Chains(3), 1, skip_bonds=-1),
                     lambda: dch.ContactMap(dch.Chains(3), 0), lambda: dch.contacts(dch.Chains(3), np.zeros((2, 3)), gap=1),
                     lambda: dch.contacts(dch.Chains(3, [[0, 1, 2]]), np.full((3, 3), np.nan), gap=1),
                     lambda: dch.contacts(dch.Chains(2, [[0, 1]]), np.zeros((2, 3)), [1, 1, 1], gap=1)):
            self.assertRaises(dch.InvalidParameter, call)
        self.assertRaises(IndexError, dch.Chains(3, [[0]]).__getitem__, 1)

    def test_unwrapped_chains_are_whole(self):
        chains, positions = chains_and_positions(3)
        wrapped = positions - np.floor(positions @ np.linalg.inv(CELL)) @ CELL
        whole = chains.unwrap(wrapped, CELL)
        for beads in chains:
            moved = whole[beads] - positions[beads]
            np.testing.assert_allclose(moved, np.broadcast_to(moved[0], moved.shape), atol=1e-12)
        with self.assertRaisesRegex(dch.InvalidParameter, "bond"):
            dch.Chains(2, [[0, 1]]).unwrap([[0, 0, 0], [4.5, 0, 0]], [9, 9, 9])


class OfContacts(unittest.TestCase):
    def test_contacts_are_those_of_all_pairs(self):
        for seed, periodic, gap, per_bead, threads in ((1, True, 0.3, True, 1), (2, False, 1.0, False, 2), (3, True, -0.1, True, 2)):
            chains, positions = chains_and_positions(seed)
            radii = np.random.default_rng(seed).uniform(0.2, 0.6, len(positions)) if per_bead else np.full(len(positions), 0.4)
            chain, place = np.divmod(np.arange(len(positions)), 25)
            for skip, within, between in ((1, True, True), (3, True, False), (0, False, True)):
                finder = dch.ContactFinder(chains, gap, radii if per_bead else 0.4, skip_bonds=skip, within=within, between=between,
                                           threads=threads)
                for step in range(3):
                    moved = positions + 0.2 * step
                    moved[step] += 0.3
                    found = finder.find(moved, CELL if periodic else None)
                    i, j, d = all_contacts(moved, radii, gap, chain, place, skip, within, between, periodic)
                    self.assertGreater(len(i), 3)
                    np.testing.assert_array_equal(found.i, i)
                    np.testing.assert_array_equal(found.j, j)
                    np.testing.assert_allclose(found.gap, d, atol=1e-11)
                    apart = np.linalg.norm(found.on_j - found.on_i, axis=1)
                    np.testing.assert_allclose(apart, np.abs(d), atol=1e-11)
                self.assertIn(finder.found_by, ("wrapped", "dch"))
                other = pickle.loads(pickle.dumps(finder)).find(moved, CELL if periodic else None)
                np.testing.assert_array_equal(other.gap, found.gap)

    def test_maps(self):
        chains, positions = chains_and_positions(4)
        counted = np.zeros((150, 150), int)
        whole, coarse = dch.ContactMap(chains), dch.ContactMap(chains, max_bins=30)
        for step in range(4):
            found = dch.contacts(chains, positions * (1 + 0.1 * step), gap=0.5, radius=0.4)
            counted[found.i, found.j] += 1
            counted[found.j, found.i] += 1
            whole.add(found)
            coarse.add(found)
        self.assertEqual((len(whole), len(coarse), whole.frames), (150, 30, 4))
        np.testing.assert_array_equal(whole.contacts, counted)
        both = np.add.reduceat(np.add.reduceat(counted, coarse.first[:-1], axis=0), coarse.first[:-1], axis=1)
        both[np.diag_indices(30)] //= 2
        np.testing.assert_array_equal(coarse.contacts, both)
        with np.errstate(invalid="ignore"):
            np.testing.assert_array_equal(coarse.frequency, coarse.contacts / np.where(coarse.pairs, 4.0 * coarse.pairs, np.nan))
        with self.assertRaises(dch.InvalidParameter):
            whole.add(dch.Contacts(np.array([0]), np.array([150]), None, None, None))

    def test_two_threads_at_once(self):
        """One of them is told, whichever comes while the other one searches."""
        chains = dch.Chains(20000, [range(20000)])
        positions = np.random.default_rng(6).normal(size=(20000, 3)).cumsum(axis=0)
        finder, hierarchy = dch.ContactFinder(chains, 3.0), dch.Hierarchy(1.0)
        for call in (lambda: finder.find(positions), lambda: hierarchy.update(positions)):
            told = []

            def work():
                for _ in range(20):
                    try:
                        call()
                    except RuntimeError as error:
                        told.append(str(error))

            threads = [threading.Thread(target=work) for _ in range(2)]
            for thread in threads:
                thread.start()
            for thread in threads:
                thread.join()
            self.assertTrue(told)
            self.assertIn("one thread at a time", told[0])


class OfCoolers(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.path = str(pathlib.Path(scratch.name, "map.cool"))

    def test_cooler_reads_what_is_written(self):
        import cooler

        for seed, max_bins, size in ((5, 150, 1), (6, 40, 1000)):
            chains, positions = chains_and_positions(seed)
            contact_map = dch.ContactMap(chains, max_bins=max_bins)
            contact_map.add(dch.contacts(chains, positions, gap=0.8, radius=0.4))
            contact_map.write_cool(self.path, names=[f"c{k}" for k in range(6)], bead=size)
            read = cooler.Cooler(self.path)
            np.testing.assert_array_equal(read.matrix(balance=False)[:], contact_map.contacts)
            self.assertEqual(dict(read.chromsizes), {f"c{k}": 25 * size for k in range(6)})
            self.assertEqual(read.info["metadata"], {"frames": 1})
            bins = read.bins()[:]
            np.testing.assert_array_equal((bins["end"] - bins["start"]).to_numpy(), size * np.diff(contact_map.first))
            first = contact_map.first * size - 25 * size
            inside = (first[:-1] >= 0) & (first[1:] <= 25 * size)
            np.testing.assert_array_equal(read.matrix(balance=False).fetch("c1"), contact_map.contacts[np.ix_(inside, inside)])

    def test_what_is_refused(self):
        chains, _ = chains_and_positions(5)
        with self.assertRaisesRegex(dch.InvalidParameter, "6 chains are more than the 3 bins"):
            dch.ContactMap(chains, max_bins=3).write_cool(self.path)
        with self.assertRaisesRegex(dch.InvalidParameter, "names has 1 different names for 6 chains"):
            dch.ContactMap(chains).write_cool(self.path, names=["a"] * 6)
        dch.ContactMap(dch.Chains(3)).write_cool(self.path)  # an empty one


class OfHierarchies(unittest.TestCase):
    def test_levels_are_what_they_are_said_to_be(self):
        random = np.random.default_rng(7)
        hierarchy = dch.Hierarchy(2.0, threads=2)
        for cell in (None, CELL):
            points = random.random((300, 3)) @ CELL
            for _ in range(3):
                hierarchy.update(points, cell)
                above = None
                for k in range(hierarchy.levels):
                    level = hierarchy.level(k)
                    if above is not None:
                        np.testing.assert_array_equal(np.unique(above.parents[above.parents >= 0]), level.nodes)
                        d = np.linalg.norm(nearest(points[above.parents] - points[above.nodes], cell is not None), axis=1)
                        self.assertLessEqual(d[above.parents >= 0].max(), above.covering_radius * (1 + 1e-12))
                    if k == 0:
                        i, j, d = dch.neighbour_list("ijd", positions=points, cell=cell, cutoff=2.0, half=True)
                        np.testing.assert_array_equal(level.nodes, np.arange(300))
                        self.assertEqual(sorted(map(tuple, level.edges)), sorted(zip(i, j)))
                    above = level
                self.assertTrue((above.parents == -1).all())
                points = points + random.normal(0, 0.1, points.shape)
        self.assertEqual(len(hierarchy), 300)
        self.assertEqual(len(pickle.loads(pickle.dumps(hierarchy))), 0)
        hierarchy.update(points[:5])
        self.assertEqual(repr(hierarchy), "Hierarchy(radius=2.0: 5 points)")
        hierarchy.update([])
        self.assertEqual(len(hierarchy), 0)

    def test_what_is_refused(self):
        hierarchy = dch.Hierarchy(1.0)
        with self.assertRaisesRegex(dch.InvalidParameter, "no positions yet"):
            hierarchy.level(0)
        hierarchy.update([[0, 0, 0]])
        for call in (lambda: dch.Hierarchy(0), lambda: dch.Hierarchy(np.nan), lambda: hierarchy.level(99), lambda: hierarchy.level(-1),
                     lambda: hierarchy.update([[0, 0, 0]], [1, 1, 1])):
            self.assertRaises(dch.InvalidParameter, call)


class OfTrajectories(unittest.TestCase):
    def setUp(self):
        self.trajectory = importlib.import_module("dch.trajectory")

    def test_frames_are_those_of_mdanalysis(self):
        import MDAnalysis

        scratch = self.enterContext(tempfile.TemporaryDirectory())
        for name, unit in (("water.trr", 10), ("triclinic-namd.dcd", 1), ("nopbc.dcd", 1)):
            path = pathlib.Path(scratch, name)  # MDAnalysis writes beside it
            path.write_bytes((DATA / name).read_bytes())
            with self.trajectory.Trajectory(path) as frames:
                positions = [unit * frame.positions for frame in frames]
            theirs = MDAnalysis.coordinates.core.reader(str(path))
            self.assertEqual(len(positions), len(theirs))
            for ours, frame in zip(positions, theirs):
                np.testing.assert_allclose(ours, frame.positions, rtol=1e-5, atol=1e-4)

    def test_what_a_frame_has(self):
        frames = self.trajectory.Trajectory(str(DATA / "polymer.lammpstrj"))
        self.assertIn("LAMMPS dump, lengths in the dump's unit", repr(frames))
        frame = next(frames)
        self.assertEqual((frame.step, len(frame.ids), frame.pbc), (0, 1714, (True, True, True)))
        self.assertEqual(frame.positions.shape, (1714, 3))
        self.assertEqual(frame.images.shape, (1714, 3))
        self.assertEqual(frame.ids[:3].tolist(), [1, 2, 3])
        self.assertAlmostEqual(frame.cell[0, 0], 109.047 - 50.9533)
        chains = dch.Chains.from_molecules(frame.molecules)
        self.assertGreater(len(dch.contacts(chains, frame.positions, frame.cell, frame.pbc, gap=3).i), 0)
        frames.close()
        self.assertEqual(list(frames), [])
        without = next(self.trajectory.Trajectory(DATA / "nopbc.dcd"))
        self.assertEqual((without.pbc, without.cell.any()), ((False, False, False), False))

    def test_what_is_refused(self):
        with self.assertRaisesRegex(self.trajectory.FileError, "cannot be opened"):
            self.trajectory.Trajectory("absent.xtc")
        with self.assertRaisesRegex(dch.InvalidParameter, "format is 'nonsense'; give one of"):
            self.trajectory.Trajectory("a.xtc", format="nonsense")
        with tempfile.NamedTemporaryFile(suffix=".dcd") as broken:
            broken.write((DATA / "nopbc.dcd").read_bytes()[:3000])
            broken.flush()
            with self.assertRaises(self.trajectory.FileError):
                list(self.trajectory.Trajectory(broken.name))


if __name__ == "__main__":
    unittest.main()
