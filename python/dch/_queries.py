# SPDX-License-Identifier: MIT
"""Compressed rows without copies, the oracle, and nearest neighbors."""
from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from . import _arguments as arguments
from . import _core
from ._core import InvalidParameter
from ._pairs import described, request_of_particles

Rows = tuple[npt.NDArray[np.int64], npt.NDArray[np.int32]]
UnsortedRows = tuple[npt.NDArray[np.int32], npt.NDArray[np.int64], npt.NDArray[np.int32]]


def request(cutoff: Any, types: Any, exclusions: Any) -> _core.Request:
    """By a number, or by a matrix with types."""
    if types is None and np.ndim(cutoff) != 0:
        raise InvalidParameter(f"cutoff has the shape {np.shape(cutoff)}; give a number > 0, or types beside a matrix")
    return request_of_particles(cutoff, types, exclusions, half=True)


class NeighborSearch:
    """Neighbor lists as compressed rows, in the memory in which the library made them.

    Each pair has its nearest image alone, so the cutoff is at most half the smallest height of the cell; neighbor_list
    has no such limit. The search keeps a structure from update to update. One thread at a time may use an object;
    another one gets a RuntimeError. Copies and what comes out of a pickle have the parameters alone.

    Parameters
    ----------
    cutoff
        A number; with types a symmetric matrix, where 0 leaves pairs out.
    types
        A row of the matrix of cutoffs for each atom.
    exclusions
        (m, 2) pairs of atoms that are left out, such as those joined by bonds.
    threads
        As neighbor_list has them.

    >>> search = NeighborSearch(cutoff=1.5)
    >>> search.update([[0, 0, 0], [1, 0, 0], [4.5, 0, 0]], cell=[5, 5, 5])
    >>> first, j = search.csr(full=True)
    >>> [j[first[i]:first[i + 1]].tolist() for i in range(3)]
    [[1, 2], [0, 2], [0, 1]]
    >>> search
    NeighborSearch(cutoff=1.5: 3 particles)

    Two types, of which the second has no pairs with itself, and a bond that makes no pair:

    >>> search = NeighborSearch([[1.0, 1.5], [1.5, 0]], types=[0, 1, 1], exclusions=[[0, 1]])
    >>> search.update([[0, 0, 0], [0.9, 0, 0], [0, 1.4, 0]])
    >>> [array.tolist() for array in search.csr()]
    [[0, 1, 1, 1], [2]]
    """

    def __init__(self, cutoff: Any, *, types: Any = None, exclusions: Any = None, threads: int | None = None) -> None:
        self._search = _core.Search(request(cutoff, types, exclusions), arguments.threads(threads))
        self._made_with = {"cutoff": arguments.kept(cutoff), "types": arguments.kept(types),
                           "exclusions": arguments.kept(exclusions), "threads": threads}
        self._cutoff = described(cutoff if np.ndim(cutoff) else float(cutoff))

    def __getstate__(self) -> dict[str, Any]:
        return self._made_with

    def __setstate__(self, made_with: dict[str, Any]) -> None:
        NeighborSearch.__init__(self, **made_with)

    def update(self, positions: Any, cell: Any = None, pbc: Any = None) -> None:
        """Takes positions (n, 3), the cell and pbc as VerletList.update() does, however far they have moved.
        CutoffTooLarge if the cutoff exceeds half the smallest height."""
        if not self._search.update_as_given(positions, cell, pbc):
            vectors, periodic = arguments.box(cell, pbc)
            self._search.update(arguments.points(positions), vectors, periodic)

    def csr(self, full: bool = False) -> Rows:
        """first (n + 1,) int64 and j int32: the neighbors of i are j[first[i]:first[i + 1]], ascending. Each pair in the
        row of its smaller index; full: in both. The arrays are new at each call and live as long as someone has them."""
        return self._search.csr(bool(full))

    def unsorted(self, full: bool = False) -> UnsortedRows:
        """particle (n,) int32, first and j: row k is that of particle[k], and rows and neighbors stand as they lie in space;
        each pair of a half list in the row of either. Faster to make than csr(), the same at each call."""
        return self._search.unsorted(bool(full))

    def __len__(self) -> int:
        """The number of atoms."""
        return self._search.particles

    def __repr__(self) -> str:
        return f"NeighborSearch(cutoff={self._cutoff}: {len(self)} particles)"


def all_pairs(positions: Any, cutoff: Any, cell: Any = None, pbc: Any = None, full: bool = False, *, types: Any = None,
              exclusions: Any = None) -> Rows:
    """What NeighborSearch.csr() returns, by looking at every pair in plain code: the oracle of the library, O(n^2).

    >>> first, j = all_pairs([[0, 0, 0], [1, 0, 0], [4.5, 0, 0]], 0.7, cell=[5, 5, 5])
    >>> first.tolist(), j.tolist()
    ([0, 1, 1, 1], [2])
    """
    vectors, periodic = arguments.box(cell, pbc)
    return _core.all_pairs(arguments.points(positions), vectors, periodic,
                           request(cutoff, types, exclusions), bool(full))


def nearest(points: Any, k: int, cell: Any = None, pbc: Any = None, queries: Any = None, *, epsilon: float = 0,
            threads: int | None = None, dtype: Any = np.float64,
            out: Any = None) -> tuple[npt.NDArray[np.int32], npt.NDArray[Any]]:
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
    dtype
        float32 or float64, of the distances.
    out
        Two arrays of the types and the shape of the results, which are written to and returned; a pair of C-contiguous ones.

    Returns
    -------
    index (m, k) int32 and distance (m, k); -1 and infinity where there are fewer than k points.

    >>> index, distance = nearest([[0, 0, 0], [1, 0, 0], [4.5, 0, 0]], 2, cell=[5, 5, 5])
    >>> index.tolist(), distance.tolist()
    ([[2, 1], [0, 2], [0, 1]], [[0.5, 1.0], [1.0, 1.5], [0.5, 1.5]])
    """
    vectors, periodic = arguments.box(cell, pbc)
    asked = None if queries is None else arguments.points(queries, "queries")
    many = arguments.count(k, "k", 1, 2**20)
    kind = np.float32 if arguments.is_single(dtype) else np.float64
    places = arguments.points(points)
    if out is not None:
        arguments.check_pair(out, (len(places if asked is None else asked), many), kind, places, *(() if asked is None else (asked,)))
    index, distance = _core.nearest(places, vectors, periodic, asked, many, arguments.length(epsilon, "epsilon"),
                                    arguments.threads(threads))
    if out is None:
        return index, distance.astype(kind, copy=False)
    out[0][...], out[1][...] = index, distance
    return out[0], out[1]
