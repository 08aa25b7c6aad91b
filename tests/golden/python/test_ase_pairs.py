#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Pairs, shifts and displacements of dch.neighbor_list against those of ASE in random scenes.

usage: test_ase_pairs.py FIRST LAST  (numbers of scenes; expected values are made by the installed ASE as it runs)
"""
import sys

import numpy as np
from ase import Atoms
from ase.neighborlist import neighbor_list as ase_neighbor_list

import dch
from scenes import Scene, sorted_rows


def cutoffs_of(scene):
    """A number, radii, or a dict of pairs of elements."""
    kind = scene.seed % 4
    if kind == 2:
        return scene.random.uniform(0, scene.cutoff / 2, len(scene.positions))
    if kind == 3:
        return {("H", "O"): scene.cutoff, (6, 6): 0.7 * scene.cutoff, ("C", 1): 0.4 * scene.cutoff}
    return scene.cutoff


def check(scene):
    atoms = Atoms(scene.numbers, scene.positions, cell=scene.cell, pbc=scene.pbc)
    cutoff, with_self = cutoffs_of(scene), scene.seed % 3 == 0
    i, j, d, D, S = dch.neighbor_list("ijdDS", atoms, cutoff, with_self)
    assert (np.diff(i) >= 0).all(), f"{scene}: not sorted by i"
    expected = sorted_rows(*ase_neighbor_list("ijSdD", atoms, cutoff, with_self))
    found = sorted_rows(i, j, S, d, D)
    for name, ours, theirs in zip("ijS", found, expected):
        assert ours.dtype == theirs.dtype and ours.shape == theirs.shape and (ours == theirs).all(), \
            f"{scene}: {name} differs: {len(ours)} pairs, and {len(theirs)} of ASE"
    for name, ours, theirs in zip("dD", found[3:], expected[3:]):
        assert np.abs(ours - theirs).max(initial=0) <= 1e-12, f"{scene}: {name} differs"
    assert (S[:, ~scene.pbc] == 0).all(), f"{scene}: a shift along an open axis"
    half = dch.neighbor_list("ijS", atoms, cutoff, half=True)
    both = sorted_rows(*(np.concatenate(pair) for pair in zip(half, (half[1], half[0], -half[2]))))
    full = sorted_rows(*(dch.neighbour_list("ijS", atoms, cutoff)))
    assert all((a == b).all() for a, b in zip(both, full)), f"{scene}: a half list is not half"
    return len(i)


def main():
    first, last = int(sys.argv[1]), int(sys.argv[2])
    pairs = [check(Scene(seed)) for seed in range(first, last)]
    print(f"{len(pairs)} scenes, {sum(pairs)} pairs")
    assert sum(pairs) > 100 * len(pairs), "the scenes have hardly any pairs"


if __name__ == "__main__":
    main()
