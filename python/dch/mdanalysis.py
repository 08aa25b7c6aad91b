# SPDX-License-Identifier: MIT
"""capped_distance and self_capped_distance, called as those of MDAnalysis.lib.distances, and an analysis of contacts of chains.

Positions are arrays of (n, 3), or anything with positions, as an AtomGroup. A box is [lx, ly, lz, alpha, beta, gamma]
with angles in degrees, or None. Each pair counts once, in its nearest image. Distances are those of double precision;
MDAnalysis rounds positions and boxes to single precision, so pairs at the cutoff may differ. There is one method, hence
no argument `method`.
"""
from __future__ import annotations

from typing import Any

import numpy as np

from MDAnalysis.analysis.base import AnalysisBase

from . import _arguments as arguments
from . import _core
from ._chains import Chains
from ._contacts import ContactFinder, ContactMap
from ._core import InvalidParameter

__all__ = ["ContactAnalysis", "capped_distance", "self_capped_distance"]


def cell_of(box: Any) -> Any:
    """Vectors of the cell as rows; None for open space."""
    if box is None:
        return None
    numbers = arguments.numbers(box, "box")
    if numbers.shape != (6,):
        raise InvalidParameter(f"box has the shape {numbers.shape}; give [lx, ly, lz, alpha, beta, gamma], or None")
    if not numbers[:3].any():
        return None
    a, b, c = numbers[:3]
    if (numbers[3:] == 90).all():
        return np.diag(numbers[:3])
    cos_alpha, cos_beta, cos_gamma = np.cos(np.radians(numbers[3:]))
    sin_gamma = np.sqrt(max(1 - cos_gamma**2, 0))
    if sin_gamma == 0:
        raise InvalidParameter(f"box is {numbers.tolist()}; the angle gamma must be between 0 and 180 degrees")
    y = (cos_alpha - cos_beta * cos_gamma) / sin_gamma
    z = np.sqrt(max(1 - cos_beta**2 - y**2, 0))
    return np.array([[a, 0, 0], [b * cos_gamma, b * sin_gamma, 0], [c * cos_beta, c * y, c * z]])


def nearest_images(i: Any, j: Any, d: Any) -> tuple[Any, Any, Any]:
    """Of pairs with several images the nearest one."""
    order = np.lexsort((d, j, i))
    i, j, d = i[order], j[order], d[order]
    is_first = np.ones(len(i), bool)
    is_first[1:] = (i[1:] != i[:-1]) | (j[1:] != j[:-1])
    is_first &= i != j
    return i[is_first], j[is_first], d[is_first]


def find(points: Any, request: Any, max_cutoff: float, min_cutoff: float | None, box: Any,
         threads: int | None) -> tuple[Any, Any]:
    """Pairs i < j in (min_cutoff, max_cutoff], and their distances."""
    cell = cell_of(box)
    vectors, periodic = arguments.box(cell, None)
    i, j, d = _core.find_pairs("ijd", points, vectors, periodic, request, False, arguments.threads(threads), False, None)
    if cell is not None and 2 * max_cutoff * np.linalg.norm(np.linalg.inv(cell), axis=0).max() >= 1:
        i, j, d = nearest_images(i, j, d)
    if min_cutoff is not None:
        is_far = d > min_cutoff
        i, j, d = i[is_far], j[is_far], d[is_far]
    return np.column_stack((i, j)), d


def positions_of(group: Any, name: str) -> Any:
    positions = arguments.numbers(getattr(group, "positions", group), name)
    return arguments.points(positions.reshape(1, 3) if positions.shape == (3,) else positions, name)


def capped_distance(reference: Any, configuration: Any, max_cutoff: float, min_cutoff: float | None = None,
                    box: Any = None, *, return_distances: bool = True, threads: int | None = None) -> Any:
    """Pairs (k, 2) of a position of the reference and one of the configuration whose distance is in (min_cutoff,
    max_cutoff], sorted, and their distances (k,).

    >>> pairs, distances = capped_distance([[0, 0, 0]], [[1, 0, 0], [4, 0, 0], [9.5, 0, 0]], 2, box=[10, 10, 10, 90, 90, 90])
    >>> pairs.tolist(), distances.tolist()
    ([[0, 0], [0, 2]], [1.0, 0.5])
    """
    first, second = positions_of(reference, "reference"), positions_of(configuration, "configuration")
    cutoff = arguments.length(max_cutoff, "max_cutoff")
    if cutoff == 0 or not len(first) or not len(second):
        pairs, distances = np.zeros((0, 2), np.int64), np.zeros(0)
    else:
        types = np.repeat(np.array([0, 1], np.int32), (len(first), len(second)))
        request = _core.Request(np.array([[0, cutoff], [cutoff, 0]]), types, None, True)
        pairs, distances = find(np.concatenate((first, second)), request, cutoff, min_cutoff, box, threads)
        pairs[:, 1] -= len(first)
        order = np.lexsort((pairs[:, 1], pairs[:, 0]))
        pairs, distances = pairs[order], distances[order]
    return (pairs, distances) if return_distances else pairs


def self_capped_distance(reference: Any, max_cutoff: float, min_cutoff: float | None = None, box: Any = None, *,
                         return_distances: bool = True, threads: int | None = None) -> Any:
    """Pairs i < j (k, 2) of positions whose distance is in (min_cutoff, max_cutoff], and their distances (k,).

    >>> self_capped_distance([[0, 0, 0], [1, 0, 0], [4, 0, 0]], 3, min_cutoff=1.5, return_distances=False).tolist()
    [[1, 2]]
    """
    points = positions_of(reference, "reference")
    cutoff = arguments.length(max_cutoff, "max_cutoff")
    if cutoff == 0 or not len(points):
        pairs, distances = np.zeros((0, 2), np.int64), np.zeros(0)
    else:
        request = _core.Request(np.array([[cutoff]]), None, None, True)
        pairs, distances = find(points, request, cutoff, min_cutoff, box, threads)
    return (pairs, distances) if return_distances else pairs


class ContactAnalysis(AnalysisBase):  # type: ignore[misc]
    """Contacts of chains with themselves and each other, over the frames of any file that MDAnalysis reads.

    Parameters
    ----------
    group
        An AtomGroup: its atoms are the beads, in chains by the bonds among them, or by `chains`.
    gap, radius, skip_bonds, within, between, threads
        As dch.ContactFinder has them; a radius for each atom of the group. Lengths in Angstrom, as all of MDAnalysis.
    chains
        dch.Chains over as many particles as the group has atoms; None for those of its bonds.
    max_bins
        Of the map, as dch.ContactMap has them.

    run() fills results.counts, the number of contacts of each frame, and results.map, a dch.ContactMap; results.last are the
    contacts of the last frame, a dch.Contacts, whose i and j are places in the group.

    InvalidParameter if the group has no bonds and no chains are given, and as dch.Chains and dch.ContactFinder.
    """

    def __init__(self, group: Any, gap: float, radius: Any = 0, *, chains: Chains | None = None, skip_bonds: int = 1, within: bool = True,
                 between: bool = True, max_bins: int = 512, threads: int | None = None, **options: Any) -> None:
        super().__init__(group.universe.trajectory, **options)
        self._group = group
        self._chains = chains_of(group) if chains is None else chains
        if self._chains.particles != len(group):
            raise InvalidParameter(f"chains has {self._chains.particles} particles for a group of {len(group)} atoms; give as many")
        pairs: dict[str, Any] = {"skip_bonds": skip_bonds, "within": within, "between": between}
        self._finder = ContactFinder(self._chains, gap, radius, threads=threads, **pairs)
        self._map_options: dict[str, Any] = {"max_bins": max_bins, **pairs}
        ContactMap(self._chains, **self._map_options)  # which refuses what does not fit

    def _prepare(self) -> None:
        self.results.counts = np.zeros(self.n_frames, np.int64)
        self.results.map = ContactMap(self._chains, **self._map_options)
        self.results.last = None

    def _single_frame(self) -> None:
        found = self._finder.find(arguments.points(self._group.positions), cell_of(self._ts.dimensions))
        self.results.counts[self._frame_index] = len(found.i)
        self.results.map.add(found)
        self.results.last = found


def chains_of(group: Any) -> Chains:
    """By the bonds both of whose atoms are in the group."""
    indices = group.indices
    place = np.full(len(group.universe.atoms), -1)
    place[indices] = np.arange(len(indices))
    bonds = place[group.universe.bonds.indices] if hasattr(group.universe, "bonds") else np.zeros((0, 2), int)
    bonds = bonds[(bonds >= 0).all(axis=1)]
    if len(bonds) == 0:
        raise InvalidParameter("the group has no bonds; give chains, such as dch.Chains.from_molecules(group.resids)")
    return Chains.from_bonds(len(indices), bonds)
