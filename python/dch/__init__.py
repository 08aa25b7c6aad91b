# SPDX-License-Identifier: MIT
"""Neighbor lists for molecular dynamics, and bonds that go through each other, as numpy arrays.

    neighbor_list     all pairs within a cutoff, called as ASE's function of that name
    neighbour_list    the same, called as matscipy's
    VerletList        pairs of atoms that move, found anew only when some might be missing
    NeighborSearch    lists of one image each as compressed rows, without copies
    nearest           the k nearest atoms of each
    all_pairs         the oracle: every pair looked at
    Crossings         bonds of chains that go through each other from frame to frame

dch.ase has neighbor lists for ASE's calculators, dch.mdanalysis has capped_distance and self_capped_distance, dch.openmm
has the pairs of a Context and a reporter of crossings.
Lengths are in the caller's unit. Errors of arguments are InvalidParameter, a ValueError.
"""
from ._core import CutoffTooLarge, InvalidBox, InvalidParameter, InvalidPosition
from ._core import version as __version__
from ._crossings import BondContacts, BondCrossings, Crossings, CrossingStep, UndeterminedBonds
from ._pairs import VerletList, neighbor_list, neighbour_list
from ._queries import NeighborSearch, all_pairs, nearest

__all__ = ["BondContacts", "BondCrossings", "CrossingStep", "Crossings", "CutoffTooLarge", "InvalidBox", "InvalidParameter",
           "InvalidPosition", "NeighborSearch", "UndeterminedBonds", "VerletList", "__version__", "all_pairs", "nearest",
           "neighbor_list", "neighbour_list"]
