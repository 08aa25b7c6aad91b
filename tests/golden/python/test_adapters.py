#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""dch.ase beside ASE's own neighbor lists and in a calculator; dch.mdanalysis beside MDAnalysis (single precision)."""
import unittest
import warnings

import numpy as np
from ase import Atoms
from ase.build import bulk
from ase.calculators.emt import EMT
from ase.neighborlist import NeighborList as AseNeighborList

import dch.ase
import dch.mdanalysis
from scenes import Scene

with warnings.catch_warnings():
    warnings.simplefilter("ignore")
    from MDAnalysis import Universe
    from MDAnalysis.lib import distances


def pairs_of(nl, atoms, both):
    """Each pair as (i, j, S), and as (j, i, -S) where half of them are listed."""
    pairs = []
    for i in range(len(atoms)):
        for j, offset in zip(*nl.get_neighbors(i)):
            pairs.append((i, int(j), *offset.tolist()))
            if not both:
                pairs.append((int(j), i, *(-offset).tolist()))
    return sorted(pairs)


class Ase(unittest.TestCase):
    def test_neighbors_are_those_of_ase(self):
        alone = AseNeighborList([1], self_interaction=True)
        alone.update(Atoms("H"))
        uncounted = 1 - alone.nneighbors  # later versions of ASE do not count an atom as its own neighbor
        for seed in range(3000, 3012):
            scene = Scene(seed)
            both, with_self = seed % 2 == 0, seed % 4 == 1
            atoms = Atoms(scene.numbers, scene.positions, cell=scene.cell, pbc=scene.pbc)
            radii = scene.random.uniform(0.1, 0.3, len(atoms)) * min(scene.cutoff, 4)
            ours, theirs = (kind(radii, skin=0.1, self_interaction=with_self, bothways=both)
                            for kind in (dch.ase.NeighborList, AseNeighborList))
            for kind in (ours, theirs):
                self.assertTrue(kind.update(atoms))
                self.assertFalse(kind.update(atoms))
            self.assertEqual(pairs_of(ours, atoms, both), pairs_of(theirs, atoms, both), scene)
            self.assertEqual((ours.nneighbors, ours.npbcneighbors, ours.nupdates),
                             (theirs.nneighbors + with_self * uncounted * len(atoms), theirs.npbcneighbors, theirs.nupdates),
                             scene)
            self.assertEqual((ours.get_connectivity_matrix() != theirs.get_connectivity_matrix()).sum()
                             if both else 0, 0, scene)

    def test_offsets_follow_atoms_that_are_wrapped(self):
        atoms = Atoms("H2", [[0.1, 0, 0], [4.9, 0, 0]], cell=[5, 5, 5], pbc=True)
        nl = dch.ase.NeighborList([0.2, 0.2], skin=0.2, self_interaction=False)
        nl.update(atoms)
        self.assertEqual(nl.get_neighbors(0)[1].tolist(), [[-1, 0, 0]])
        atoms.positions[1, 0] -= 5
        self.assertFalse(nl.update(atoms))
        self.assertEqual(nl.get_neighbors(0)[1].tolist(), [[0, 0, 0]])
        self.assertEqual(nl.nupdates, 1)
        nl.nl.build(atoms.pbc, atoms.cell, atoms.positions)
        self.assertEqual(nl.get_neighbors(0)[1].tolist(), [[0, 0, 0]])

    def test_a_calculator_runs_on_it(self):
        calculator = EMT()
        atoms = bulk("Cu", cubic=True) * (2, 2, 2)
        atoms.rattle(0.1, seed=1)
        atoms.calc = calculator
        expected = atoms.get_potential_energy()
        own = calculator.nl.nl
        ours = dch.ase.NeighborList(own.cutoffs, skin=0, self_interaction=False, bothways=own.bothways)
        atoms.positions[0, 0] += 1e-13  # so that it computes anew
        calculator.nl = ours
        self.assertAlmostEqual(atoms.get_potential_energy(), expected, delta=1e-8)
        self.assertGreater(ours.nupdates, 0)

    def test_no_atoms_and_no_update(self):
        nl = dch.ase.NeighborList([])
        with self.assertRaisesRegex(RuntimeError, "Must call update"):
            nl.get_neighbors(0)
        self.assertTrue(nl.update(Atoms()))
        self.assertEqual(nl.nneighbors, 0)
        with self.assertRaisesRegex(ValueError, "radii"):
            nl.update(Atoms("H"))


class Mdanalysis(unittest.TestCase):
    """Positions and boxes that single precision holds, and cutoffs no pair is near."""

    BOXES = ([16, 17, 18, 90, 90, 90], [16, 17, 18, 70, 80, 75], None)

    def setUp(self):
        random = np.random.default_rng(9)
        self.first = (random.random((300, 3)) * 16).astype(np.float32)
        self.second = (random.random((100, 3)) * 16).astype(np.float32)

    def assert_same(self, found, expected):
        order = np.lexsort((expected[0][:, 1], expected[0][:, 0]))
        mine = np.lexsort((found[0][:, 1], found[0][:, 0]))
        np.testing.assert_array_equal(found[0][mine], expected[0][order])
        np.testing.assert_allclose(found[1][mine], expected[1][order], atol=2e-5)
        self.assertEqual(found[0].dtype, expected[0].dtype)

    def test_capped_distance(self):
        for box in self.BOXES:
            for limits in ((3.0123, None), (4.0321, 2.0456)):
                expected = distances.capped_distance(self.first, self.second, *limits, box=box)
                self.assertGreater(len(expected[0]), 100)
                self.assert_same(dch.mdanalysis.capped_distance(self.first, self.second, *limits, box=box), expected)

    def test_self_capped_distance(self):
        for box in self.BOXES:
            for limits in ((3.0123, None), (4.0321, 2.0456)):
                expected = distances.self_capped_distance(self.first, *limits, box=box)
                expected = np.sort(expected[0], axis=1), expected[1]
                self.assert_same(dch.mdanalysis.self_capped_distance(self.first, *limits, box=box), expected)

    def test_the_nearest_image_counts_beyond_half_the_box(self):
        box = [16, 17, 18, 90, 90, 90]
        expected = distances.self_capped_distance(self.first[:60], 14.0123, box=box, method="bruteforce")
        found = dch.mdanalysis.self_capped_distance(self.first[:60], 14.0123, box=box)
        self.assert_same(found, expected)

    def test_contacts_of_chains(self):
        random = np.random.default_rng(10)
        frames = (random.normal(size=(4, 4, 15, 3)).cumsum(axis=2) * 2).reshape(4, 60, 3).astype(np.float32)
        bonds = [(k, k + 1) for k in range(59) if k % 15 != 14]
        universe = Universe.empty(70, trajectory=True)
        universe.add_TopologyAttr("bonds", [(a + 10, b + 10) for a, b in bonds])  # the first ten atoms are in no chain
        universe.load_new(np.concatenate([np.zeros((4, 10, 3), np.float32), frames], axis=1), order="fac",
                          dimensions=np.tile([40.0, 41, 42, 90, 90, 90], (4, 1)))
        group, chains = universe.atoms[10:], dch.Chains.from_bonds(60, bonds)
        for analysis in (dch.mdanalysis.ContactAnalysis(group, 1.0, 1.2), dch.mdanalysis.ContactAnalysis(group, 1.0, 1.2, chains=chains)):
            analysis.run()
            expected = [dch.contacts(chains, frame, [40, 41, 42], gap=1.0, radius=1.2) for frame in frames]
            self.assertEqual(analysis.results.counts.tolist(), [len(found.i) for found in expected])
            self.assertGreater(min(analysis.results.counts), 0)
            self.assertEqual(analysis.results.map.frames, 4)
            self.assertEqual(np.triu(analysis.results.map.contacts).sum(), sum(analysis.results.counts))
            np.testing.assert_array_equal(analysis.results.last.j, expected[-1].j)
            self.assertEqual(analysis.run(stop=2).results.map.frames, 2)
        for wrong, options in ((universe.atoms[:10], {}), (group, {"chains": dch.Chains(3)}), (group, {"max_bins": 0})):
            with self.assertRaises(dch.InvalidParameter):
                dch.mdanalysis.ContactAnalysis(wrong, 1.0, **options)

    def test_input(self):
        one = dch.mdanalysis.capped_distance([0, 0, 0], [[1, 0, 0]], 2, return_distances=False)
        self.assertEqual(one.tolist(), [[0, 0]])
        self.assertEqual(dch.mdanalysis.self_capped_distance(np.zeros((0, 3)), 2)[0].shape, (0, 2))
        self.assertEqual(dch.mdanalysis.capped_distance([[0, 0, 0]], np.zeros((0, 3)), 2)[0].shape, (0, 2))
        self.assertEqual(len(dch.mdanalysis.self_capped_distance([[0, 0, 0], [1, 0, 0]], 2, box=[0] * 6)[0]), 1)
        for box, text in (([1, 2, 3], "lx, ly, lz"), ([1, 1, 1, 90, 90, 0], "gamma"), ([1, 1, 0, 90, 90, 90], "long")):
            with self.assertRaisesRegex(dch.InvalidParameter, text):
                dch.mdanalysis.self_capped_distance(np.zeros((2, 3)), 0.4, box=box)
        with self.assertRaisesRegex(dch.InvalidParameter, "max_cutoff is nan"):
            dch.mdanalysis.self_capped_distance(np.zeros((2, 3)), np.nan)


if __name__ == "__main__":
    unittest.main()
