# SPDX-License-Identifier: MIT
"""The hierarchy of discrete centers itself."""
from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from . import _arguments as arguments
from . import _core
from ._core import InvalidParameter

Ints = npt.NDArray[np.int32]


class Level(NamedTuple):
    """The nodes of a level, which are points, and how they hang together."""

    nodes: Ints  #: (m,) ids of points, ascending; level 0 has all of them
    parents: Ints  #: (m,) of each the point above it, itself if it stands in the next level too; -1 for a root
    edges: Ints  #: (k, 2) pairs of nodes within the threshold of each other, the smaller id first
    covering_radius: float  #: each node of the next level holds those that have it for a parent within this [length]
    edge_threshold: float  #: [length]


class Hierarchy:
    """A hierarchy of discrete centers over points: each level is a part of the one below, whose points are farther from each
    other than its covering radius, which doubles from level to level; and each point below is within that of its parent.

    Parameters
    ----------
    radius
        The edge threshold of level 0: the radius of the neighbor list that its edges are.
    threads
        As for neighbor_list().

    One thread at a time may use an object; another one gets a RuntimeError. Copies and what comes out of a pickle have the
    parameters alone: call update().

    >>> hierarchy = Hierarchy(radius=1.5)
    >>> hierarchy.update([[0, 0, 0], [1, 0, 0], [2, 0, 0], [9, 0, 0]])
    >>> hierarchy.level(0).edges.tolist()
    [[0, 1], [1, 2]]
    >>> leaves = hierarchy.level(1)
    >>> leaves.nodes.tolist(), hierarchy.level(0).parents.tolist()
    ([0, 3], [0, 0, 0, 3])
    """

    def __init__(self, radius: float, *, threads: int | None = None) -> None:
        self._radius = arguments.length(radius, "radius")
        if self._radius == 0:
            raise InvalidParameter("radius is 0; give a number > 0")
        self._made_with = {"radius": radius, "threads": threads}
        self._levels = _core.Levels(self._radius, arguments.threads(threads))

    def __getstate__(self) -> dict[str, Any]:
        return self._made_with

    def __setstate__(self, made_with: dict[str, Any]) -> None:
        Hierarchy.__init__(self, **made_with)

    def update(self, positions: Any, cell: Any = None, pbc: Any = None) -> None:
        """Takes positions (n, 3), the cell and pbc as VerletList.update() does, however far points have moved. CutoffTooLarge
        if the radius exceeds half the smallest height."""
        vectors, periodic = arguments.box(cell, pbc)
        self._levels.update(arguments.points(positions), vectors, periodic)

    @property
    def levels(self) -> int:
        """How many there are; 0 without a point."""
        return self._levels.levels()

    def level(self, number: int) -> Level:
        """Level 0 has all points, the last one the roots."""
        return Level(*self._levels.level(arguments.count(number, "number", 0, 2**31 - 1)))

    def __len__(self) -> int:
        """The number of points."""
        return self._levels.particles

    def __repr__(self) -> str:
        return f"Hierarchy(radius={self._radius}: {len(self)} points)"
