# SPDX-License-Identifier: MIT
"""Neighbor lists for ASE's calculators, with the interface of ase.neighborlist.NeighborList.

    nl = dch.ase.NeighborList([2.3, 1.7])
    nl.update(atoms)
    indices, offsets = nl.get_neighbors(0)
    neighbors = atoms.positions[indices] + offsets @ atoms.cell
"""
from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from ._core import InvalidParameter
from ._pairs import VerletList

__all__ = ["NeighborList", "PrimitiveNeighborList"]

Row = tuple[npt.NDArray[np.int64], npt.NDArray[np.int64]]


class PrimitiveNeighborList:
    """As ase.neighborlist.PrimitiveNeighborList: neighbors are atoms whose spheres, widened by the skin, overlap.

    Other than ASE's it is not made anew when coordinates were wrapped into the cell, or when the cell has changed by
    less than the skin allows (offsets are those of the present coordinates); bothways lists an atom as its own
    neighbor once; half lists are sorted in any case: no neighbor is before the atom; and nneighbors counts atoms that
    are their own neighbors, as ASE has done before 3.24.

    Parameters
    ----------
    cutoffs
        Radii, one for each atom.
    skin
        How far atoms may move before the list is made anew.
    self_interaction
        Whether an atom is its own neighbor.
    bothways
        Each pair at both atoms, not at the first one alone.

    >>> nl = PrimitiveNeighborList([0.6, 0.6, 0.6], skin=0.1, self_interaction=False)
    >>> nl.update([True, True, True], 5 * np.eye(3), np.array([[0, 0, 0], [1, 0, 0], [4.5, 0, 0]]))
    True
    >>> indices, offsets = nl.get_neighbors(0)
    >>> indices.tolist(), offsets.tolist()
    ([1, 2], [[0, 0, 0], [-1, 0, 0]])
    """

    def __init__(self, cutoffs: Any, skin: float = 0.3, sorted: bool = False, self_interaction: bool = True,
                 bothways: bool = False, *, threads: int | None = None) -> None:
        self._radii = np.array(cutoffs, float)
        self.cutoffs = self._radii + skin  # as ASE's have it
        self.skin = skin
        self.sorted = sorted
        self.self_interaction = self_interaction
        self.bothways = bothways
        self.nupdates = 0
        self._threads = threads
        self._list = self._new_list()
        self._rows: tuple[Any, ...] | None = None

    def update(self, pbc: Any, cell: Any, coordinates: Any) -> bool:
        """Makes sure the list is up to date; says whether it was made anew."""
        self._rows = None
        if self._list is None:
            if len(coordinates):
                raise InvalidParameter(f"there are {len(coordinates)} atoms and no radii; give one for each")
            is_new = self.nupdates == 0
        else:
            is_new = self._list.update(coordinates, np.asarray(cell), pbc)
        self.nupdates += int(is_new)
        return is_new

    def build(self, pbc: Any, cell: Any, coordinates: Any) -> None:
        """Makes the list anew."""
        self._list = self._new_list()
        self.update(pbc, cell, coordinates)

    def _new_list(self) -> VerletList | None:
        if not len(self._radii):
            return None
        return VerletList(self._radii, 2 * self.skin, half=not self.bothways, threads=self._threads)

    def get_neighbors(self, a: int) -> Row:
        """Indices and offsets of the neighbors of atom a: they stand at positions[indices] + offsets @ cell."""
        first, neighbors, offsets = self._present_rows()
        return neighbors[first[a]:first[a + 1]], offsets[first[a]:first[a + 1]]

    @property
    def nneighbors(self) -> int:
        """Number of pairs."""
        return self._count(self._present_rows()[2] * 0 == 0)

    @property
    def npbcneighbors(self) -> int:
        """Number of pairs across a face of the cell."""
        return self._count(self._present_rows()[2] != 0)

    def _count(self, wanted: Any) -> int:
        return int(wanted.any(axis=1).sum()) // (2 if self.bothways else 1)

    def _present_rows(self) -> tuple[Any, ...]:
        if self.nupdates == 0:
            raise RuntimeError("Must call update(atoms) on your neighborlist first!")
        if self._rows is None:
            if self._list is None:
                self._rows = np.zeros(1, int), np.zeros(0, int), np.zeros((0, 3), int)
            else:
                i, j, shifts = self._list.pairs("ijS", with_skin=True, self_interaction=self.self_interaction)
                self._rows = np.searchsorted(i, np.arange(len(self.cutoffs) + 1)), j, shifts
        return self._rows


class NeighborList:
    """As ase.neighborlist.NeighborList, by the PrimitiveNeighborList of this module."""

    def __init__(self, cutoffs: Any, skin: float = 0.3, sorted: bool = False, self_interaction: bool = True,
                 bothways: bool = False, *, threads: int | None = None) -> None:
        self.nl = PrimitiveNeighborList(cutoffs, skin, sorted, self_interaction, bothways, threads=threads)

    def update(self, atoms: Any) -> bool:
        """Makes sure the list is up to date; says whether it was made anew."""
        return self.nl.update(atoms.pbc, atoms.cell, atoms.positions)

    def get_neighbors(self, a: int) -> Row:
        """See PrimitiveNeighborList.get_neighbors()."""
        return self.nl.get_neighbors(a)

    def get_connectivity_matrix(self, sparse: bool = True) -> Any:
        """See ase.neighborlist.get_connectivity_matrix."""
        from ase.neighborlist import get_connectivity_matrix

        make_matrix: Any = get_connectivity_matrix  # whose types some versions of ASE do not tell
        return make_matrix(self.nl, sparse)

    @property
    def nupdates(self) -> int:
        """How often the list was made anew."""
        return self.nl.nupdates

    @property
    def nneighbors(self) -> int:
        """Number of pairs."""
        return self.nl.nneighbors

    @property
    def npbcneighbors(self) -> int:
        """Number of pairs across a face of the cell."""
        return self.nl.npbcneighbors
