# SPDX-License-Identifier: MIT
"""Neighbor lists for molecular dynamics, and bonds that go through each other, as numpy arrays.

    neighbor_list     all pairs within a cutoff, called as ASE's function of that name
    neighbour_list    the same, called as matscipy's
    VerletList        pairs of atoms that move, found anew only when some might be missing
    NeighborSearch    lists of one image each as compressed rows, without copies
    nearest           the k nearest atoms of each
    all_pairs         the oracle: every pair looked at
    Hierarchy         the hierarchy itself: levels, parents and edges
    Crossings         bonds of chains that go through each other from frame to frame
    Chains            chains of beads; contacts() and ContactFinder find which beads touch, ContactMap how often

dch.ase has neighbor lists for ASE's calculators, dch.mdanalysis has capped_distance, self_capped_distance and an analysis of
contacts, dch.openmm has the pairs of a Context and reporters of crossings and contacts, dch.trajectory reads files.
Lengths are in the caller's unit. Errors of arguments are InvalidParameter, a ValueError.
"""
from ._chains import Chains
from ._contacts import ContactFinder, ContactMap, Contacts, contacts
from ._core import CutoffTooLarge, InvalidBox, InvalidParameter, InvalidPosition
from ._core import version as __version__
from ._crossings import BondContacts, BondCrossings, Crossings, CrossingStep, UndeterminedBonds
from ._hierarchy import Hierarchy, Level
from ._pairs import VerletList, neighbor_list, neighbour_list
from ._queries import NeighborSearch, all_pairs, nearest

__all__ = ["BondContacts", "BondCrossings", "Chains", "ContactFinder", "ContactMap", "Contacts", "CrossingStep", "Crossings",
           "CutoffTooLarge", "Hierarchy", "InvalidBox", "InvalidParameter", "InvalidPosition", "Level", "NeighborSearch",
           "UndeterminedBonds", "VerletList", "__version__", "all_pairs", "contacts", "nearest", "neighbor_list", "neighbour_list"]
