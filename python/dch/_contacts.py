# SPDX-License-Identifier: MIT
"""Which beads of chains are in contact, and how often."""
from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from . import _arguments as arguments
from . import _core
from ._chains import MOST_PARTICLES, Chains, Floats, Ints
from ._core import InvalidParameter, version


class Contacts(NamedTuple):
    """Pairs of beads whose surfaces are near each other, a row each, in ascending order of i and j."""

    i: Ints  #: (k,) particles
    j: Ints  #: (k,) particles, i < j
    gap: Floats  #: (k,) between the surfaces, below 0 if they overlap [length]
    on_i: Floats  #: (k, 3) the point of bead i that is nearest to bead j
    on_j: Floats  #: (k, 3) that of the image of bead j that is nearest to bead i


def query(gap: Any, skip_bonds: Any, within: Any, between: Any) -> _core.ContactQuery:
    distance = arguments.numbers(gap, "gap")
    if distance.ndim != 0 or not np.isfinite(distance):
        raise InvalidParameter(f"gap is {gap!r}; give a finite number")
    return _core.ContactQuery(float(distance), arguments.count(skip_bonds, "skip_bonds", 0, MOST_PARTICLES), bool(within), bool(between))


def of_chains(chains: Any) -> _core.Chains:
    if not isinstance(chains, Chains):
        raise InvalidParameter(f"chains is {chains!r}; give a dch.Chains")
    return chains._chains


class ContactFinder:
    """Finds contacts of chains with themselves and each other, frame after frame, by the structure that suits the chains: a
    hierarchy that is tied to them or, where they are packed, one over space. Contacts are the same.

    Parameters
    ----------
    chains
        dch.Chains
    gap
        Two beads are in contact if their surfaces are at most this far apart [length].
    radius
        Of all beads, or an array of one for each particle; 0 makes the gap the distance of centers.
    skip_bonds
        Pairs of a chain with so many bonds between them, or fewer, are left out.
    within, between
        Whether to find contacts of chains with themselves, and with each other.
    threads
        As for neighbor_list(). Results do not depend on it.

    One thread at a time may use an object; another one gets a RuntimeError. Copies and what comes out of a pickle have the
    parameters alone.

    >>> finder = ContactFinder(Chains(4, [[0, 1, 2, 3]]), gap=0.1, radius=0.5)
    >>> found = finder.find([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
    >>> found.i.tolist(), found.j.tolist(), found.gap.tolist()
    ([0], [3], [0.0])
    """

    def __init__(self, chains: Chains, gap: float, radius: Any = 0, *, skip_bonds: int = 1, within: bool = True,
                 between: bool = True, threads: int | None = None) -> None:
        radii = arguments.numbers(radius, "radius")
        if radii.ndim > 1 or radii.ndim == 1 and len(radii) != of_chains(chains).particles():
            raise InvalidParameter(f"radius has the shape {radii.shape}; give a number, or one for each of the "
                                   f"{chains.particles} particles")
        self._finder = _core.Contacts(of_chains(chains), radii, query(gap, skip_bonds, within, between), arguments.threads(threads))
        self._made_with = {"chains": chains, "gap": gap, "radius": arguments.kept(radius), "skip_bonds": skip_bonds,
                           "within": within, "between": between, "threads": threads}

    def __getstate__(self) -> dict[str, Any]:
        return self._made_with

    def __setstate__(self, made_with: dict[str, Any]) -> None:
        ContactFinder.__init__(self, **made_with)

    def find(self, positions: Any, cell: Any = None, pbc: Any = None) -> Contacts:
        """All contacts at positions (n, 3), in a cell as VerletList.update() has it. InvalidParameter if there are more or
        fewer positions than particles; CutoffTooLarge if a bead might touch two images of another one."""
        vectors, periodic = arguments.box(cell, pbc)
        return Contacts(*self._finder.find(arguments.points(positions), vectors, periodic))

    @property
    def found_by(self) -> str:
        """Whose turn it is next: "wrapped", the hierarchy tied to the chains, or "dch"."""
        return self._finder.choice()[0]

    def __repr__(self) -> str:
        return f"ContactFinder({self._made_with['chains']!r}, gap={self._made_with['gap']})"


def contacts(chains: Chains, positions: Any, cell: Any = None, pbc: Any = None, *, gap: float, radius: Any = 0,
             skip_bonds: int = 1, within: bool = True, between: bool = True, threads: int | None = None) -> Contacts:
    """The contacts of chains in one frame, as ContactFinder has them.

    >>> found = contacts(Chains(4, [[0, 1], [2, 3]]), [[0, 0, 0], [1, 0, 0], [0, 0, 1], [1, 0, 5]], gap=1.0)
    >>> found.i.tolist(), found.j.tolist(), found.gap.tolist()
    ([0], [2], [1.0])
    """
    finder = ContactFinder(chains, gap, radius, skip_bonds=skip_bonds, within=within, between=between, threads=threads)
    return finder.find(positions, cell, pbc)


class ContactMap:
    """How often beads were in contact over frames: a symmetric matrix over beads in order along their chains, or over bins of
    them. At most as many chains as bins: each is cut into bins of its own. Else a bin has several whole chains.

    Parameters
    ----------
    chains
        dch.Chains
    max_bins
        1 to 16384. Memory is 4 times its square.
    skip_bonds, within, between
        With which the contacts are found: which pairs of beads there are.

    >>> chains = Chains(4, [[0, 1, 2, 3]])
    >>> contact_map = ContactMap(chains)
    >>> for y in (1, 2):
    ...     contact_map.add(contacts(chains, [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, y, 0]], gap=1.0))
    >>> contact_map.contacts[0].tolist(), contact_map.frequency[0].tolist()
    ([0, 0, 0, 1], [nan, nan, 0.0, 0.5])
    >>> contact_map
    ContactMap(Chains(1 chain, 4 of 4 particles): 4 bins, 2 frames)
    """

    def __init__(self, chains: Chains, max_bins: int = 512, *, skip_bonds: int = 1, within: bool = True, between: bool = True) -> None:
        self._map = _core.Map(of_chains(chains), query(0, skip_bonds, within, between), arguments.count(max_bins, "max_bins", 1, 2**14))
        self._chains = chains

    def add(self, found: Contacts) -> None:
        """Counts the contacts of one more frame. InvalidParameter for a particle that is no bead."""
        self._map.add(arguments.indices(found.i, "contacts.i"), arguments.indices(found.j, "contacts.j"))

    @property
    def frames(self) -> int:
        """How many were added."""
        return self._map.frames()

    @property
    def first(self) -> Ints:
        """(bins + 1,): bin k has the beads first[k] to first[k + 1] - 1, counted along the chains one after the other."""
        return self._map.first()

    @property
    def contacts(self) -> npt.NDArray[np.int64]:
        """(bins, bins): contacts over all frames, each pair of beads once in a frame."""
        return self._map.contacts()

    @property
    def pairs(self) -> npt.NDArray[np.int64]:
        """(bins, bins): pairs of beads that were looked at in one frame."""
        return self._map.pairs()

    @property
    def frequency(self) -> Floats:
        """(bins, bins): contacts / (frames pairs), NaN where there is no pair."""
        return self._map.frequency()

    def __len__(self) -> int:
        """The number of bins."""
        return len(self._map.first()) - 1

    def __repr__(self) -> str:
        return f"ContactMap({self._chains!r}: {len(self)} bins, {self.frames} frames)"

    def write_cool(self, path: str | os.PathLike[str], names: Sequence[str] | None = None, bead: int = 1) -> None:
        """Writes contacts as a file of cooler (version 3 of its format), which programs for maps of chromosomes read. Chains
        stand for chromosomes; a bead is `bead` base pairs long.

        names are those of the chains, chain1, chain2 and so on if None. Needs h5py. InvalidParameter where bins hold
        several chains: take more of them.
        """
        import h5py

        length = np.array([len(chain) for chain in self._chains], np.int64)
        named = [f"chain{k + 1}" for k in range(len(length))] if names is None else list(names)
        if len(named) != len(length) or len(set(named)) != len(named):
            raise InvalidParameter(f"names has {len(set(named))} different names for {len(length)} chains; give one for each")
        begin = np.cumsum([0, *length])
        first = self.first.astype(np.int64)
        if not np.isin(begin, first).all():
            raise InvalidParameter(f"{len(length)} chains are more than the {len(self)} bins; make the map with max_bins of "
                                   f"{len(length)} or more")
        size = arguments.count(bead, "bead", 1, 2**31 - 1)
        chain = np.searchsorted(begin, first[:-1], side="right") - 1
        row, column = np.nonzero(np.triu(self.contacts))
        count = self.contacts[row, column]
        whole = len(length) == 0 or np.ptp(np.diff(first)) == 0
        with h5py.File(path, "w") as file:
            file.attrs.update({"format": "HDF5::Cooler", "format-version": 3, "bin-type": "fixed" if whole else "variable",
                               "bin-size": int(first[1] - first[0]) * size if whole and len(self) else "null",
                               "storage-mode": "symmetric-upper", "nchroms": len(length), "nbins": len(self), "nnz": len(count),
                               "generated-by": f"dch-{version}", "metadata": f'{{"frames": {self.frames}}}'})
            chromosomes = file.create_group("chroms")
            chromosomes["name"] = np.array([name.encode() for name in named], dtype=f"S{max(map(len, named), default=1)}")
            chromosomes["length"] = (size * length).astype(np.int32)
            bins = file.create_group("bins")
            bins["chrom"] = chain.astype(np.int32)
            bins["start"] = (size * (first[:-1] - begin[chain])).astype(np.int32)
            bins["end"] = (size * (first[1:] - begin[chain])).astype(np.int32)
            pixels = file.create_group("pixels")
            pixels["bin1_id"], pixels["bin2_id"], pixels["count"] = row.astype(np.int64), column.astype(np.int64), count
            indexes = file.create_group("indexes")
            indexes["chrom_offset"] = np.searchsorted(chain, np.arange(len(length) + 1)).astype(np.int64)
            indexes["bin1_offset"] = np.searchsorted(row, np.arange(len(self) + 1)).astype(np.int64)
