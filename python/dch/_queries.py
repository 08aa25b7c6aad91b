# SPDX-License-Identifier: MIT
"""Compressed rows without copies, the oracle, and nearest neighbors."""
from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from . import _arguments as arguments
from . import _core
from ._core import InvalidParameter

Rows = tuple[npt.NDArray[np.int64], npt.NDArray[np.int32]]


def reach(cutoff: Any) -> float:
    value = arguments.length(cutoff, "cutoff")
    if value == 0:
        raise InvalidParameter(f"cutoff is {cutoff!r}; give a number > 0")
    return value


class NeighborSearch:
    """Neighbor lists as compressed rows, in the memory in which the library made them.

    Each pair has its nearest image alone, so the cutoff is at most half the smallest height of the cell; neighbor_list
    has no such limit. The search keeps a structure from update to update. One thread at a time may use an object;
    another one gets a RuntimeError.

    >>> search = NeighborSearch(cutoff=1.5)
    >>> search.update([[0, 0, 0], [1, 0, 0], [4.5, 0, 0]], cell=[5, 5, 5])
    >>> first, j = search.csr(full=True)
    >>> [j[first[i]:first[i + 1]].tolist() for i in range(3)]
    [[1, 2], [0, 2], [0, 1]]
    >>> search
    NeighborSearch(cutoff=1.5: 3 particles)
    """

    def __init__(self, cutoff: float, *, threads: int | None = None) -> None:
        self._cutoff = reach(cutoff)
        self._search = _core.Search(self._cutoff, arguments.threads(threads))

    def update(self, positions: Any, cell: Any = None, pbc: Any = None) -> None:
        """Takes positions (n, 3), the cell and pbc as VerletList.update() does, however far they have moved.
        CutoffTooLarge if the cutoff exceeds half the smallest height."""
        vectors, periodic = arguments.box(cell, pbc)
        self._search.update(arguments.points(positions), vectors, periodic)

    def csr(self, full: bool = False) -> Rows:
        """first (n + 1,) int64 and j int32: the neighbors of i are j[first[i]:first[i + 1]], ascending. Each pair in the
        row of its smaller index; full: in both. The arrays are new at each call and live as long as someone has them."""
        return self._search.csr(bool(full))

    def __len__(self) -> int:
        """The number of atoms."""
        return self._search.particles

    def __repr__(self) -> str:
        return f"NeighborSearch(cutoff={self._cutoff}: {len(self)} particles)"


def all_pairs(positions: Any, cutoff: float, cell: Any = None, pbc: Any = None, full: bool = False) -> Rows:
    """What NeighborSearch.csr() returns, by looking at every pair in plain code: the oracle of the library, O(n^2).

    >>> first, j = all_pairs([[0, 0, 0], [1, 0, 0], [4.5, 0, 0]], 0.7, cell=[5, 5, 5])
    >>> first.tolist(), j.tolist()
    ([0, 1, 1, 1], [2])
    """
    vectors, periodic = arguments.box(cell, pbc)
    return _core.all_pairs(arguments.points(positions), vectors, periodic, reach(cutoff), bool(full))


def nearest(points: Any, k: int, cell: Any = None, pbc: Any = None, queries: Any = None, *, epsilon: float = 0,
            threads: int | None = None) -> tuple[npt.NDArray[np.int32], npt.NDArray[np.float64]]:
    """The k nearest points of each point, itself left out, or of each query, nearest first.

    Distances are those of nearest images; each point counts once. Of points equally near, the one with the smaller
    index comes first.

    Parameters
    ----------
    points
        (n, 3)
    k
        1 to 1048576
    cell, pbc
        As VerletList.update() has them.
    queries
        (m, 3), or None for the points themselves.
    epsilon
        If > 0, the j-th distance may be up to 1 + epsilon times that of the j-th nearest point, for less work. Only for
        queries.

    Returns
    -------
    index (m, k) int32 and distance (m, k) float64; -1 and infinity where there are fewer than k points.

    >>> index, distance = nearest([[0, 0, 0], [1, 0, 0], [4.5, 0, 0]], 2, cell=[5, 5, 5])
    >>> index.tolist(), distance.tolist()
    ([[2, 1], [0, 2], [0, 1]], [[0.5, 1.0], [1.0, 1.5], [0.5, 1.5]])
    """
    vectors, periodic = arguments.box(cell, pbc)
    asked = None if queries is None else arguments.points(queries, "queries")
    many = arguments.count(k, "k", 1, 2**20)
    return _core.nearest(arguments.points(points), vectors, periodic, asked, many,
                         arguments.length(epsilon, "epsilon"), arguments.threads(threads))
