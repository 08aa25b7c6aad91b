# SPDX-License-Identifier: MIT
"""Chains of beads."""
from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _arguments as arguments
from . import _core
from ._core import InvalidParameter

Floats = npt.NDArray[np.float64]
Ints = npt.NDArray[np.int32]
MOST_PARTICLES = 2**31 - 1


class Chains:
    """Chains of beads, open or closed: which particles they have, in which order. A particle stands in one chain, or in none.

    Parameters
    ----------
    particles
        How many there are, in chains or not.
    chains
        The beads of each chain, as indices of particles, in order along it.
    closed
        Whether chains are rings; a flag for all, or one for each.

    Chains.from_bonds() and Chains.from_molecules() make them of what files have. InvalidParameter for particles that do not
    exist or stand twice, for a branch, and for a ring of fewer than three beads.

    >>> chains = Chains(7, [[0, 1, 2], [6, 5, 4, 3]], closed=[False, True])
    >>> len(chains), chains[1].tolist(), chains.closed.tolist()
    (2, [6, 5, 4, 3], [False, True])
    >>> chains.bonds.tolist()
    [[0, 1], [1, 2], [6, 5], [5, 4], [4, 3], [3, 6]]
    >>> Chains.from_bonds(4, [[2, 1], [2, 3]])
    Chains(1 chain, 3 of 4 particles)
    """

    def __init__(self, particles: int, chains: Sequence[Any] = (), closed: Any = False) -> None:
        beads = [arguments.indices(chain, f"chains[{k}]") for k, chain in enumerate(chains)]
        flags = np.asarray(closed)
        if flags.shape not in [(), (len(beads),)] or flags.dtype.kind != "b" and flags.size:
            raise InvalidParameter(f"closed is {closed!r}; give True, False, or one of them for each of the {len(beads)} chains")
        first = np.cumsum([0, *(len(chain) for chain in beads)]).tolist()
        every = np.concatenate([np.zeros(0, np.int32), *beads])
        self._chains = _core.Chains(arguments.count(particles, "particles", 0, MOST_PARTICLES), every, first,
                                    np.broadcast_to(flags.astype(bool), len(beads)).tolist())

    @classmethod
    def _of(cls, chains: _core.Chains) -> Chains:
        made = cls.__new__(cls)
        made._chains = chains
        return made

    @classmethod
    def from_bonds(cls, particles: int, bonds: Any) -> Chains:
        """Of bonds (m, 2): a chain starts at its end of smaller index, a ring at its smallest index; chains come in the order
        of their first beads. Particles without a bond are in none."""
        return cls._of(_core.Chains.from_bonds(arguments.count(particles, "particles", 0, MOST_PARTICLES),
                                               arguments.index_pairs(bonds, "bonds")))

    @classmethod
    def from_molecules(cls, molecules: Any) -> Chains:
        """One open chain for each number of a molecule, its beads in order of index; 0 is none."""
        return cls._of(_core.Chains.from_molecules(arguments.indices(molecules, "molecules")))

    def __len__(self) -> int:
        """The number of chains."""
        return self._chains.count()

    def __getitem__(self, chain: int) -> Ints:
        """The beads of a chain, in order along it."""
        if not -len(self) <= chain < len(self):
            raise IndexError(f"there are {len(self)} chains, and none of the number {chain}")
        return self._chains.beads(chain % len(self))

    def __iter__(self) -> Iterator[Ints]:
        return (self._chains.beads(chain) for chain in range(len(self)))

    @property
    def particles(self) -> int:
        """How many there are, in chains or not."""
        return self._chains.particles()

    @property
    def closed(self) -> npt.NDArray[np.bool_]:
        """Of each chain, whether it is a ring."""
        return np.array([self._chains.closed(chain) for chain in range(len(self))], bool)

    @property
    def bonds(self) -> Ints:
        """(m, 2), chain by chain and directed along each; the closing bond of a ring last."""
        return self._chains.bonds()

    def unwrap(self, positions: Any, cell: Any = None, pbc: Any = None) -> Floats:
        """Positions at which chains are whole: the first bead of each stays, each further one is the image nearest to the one
        before. InvalidParameter for a bond of half the smallest height of the cell or more, which does not tell to which."""
        vectors, periodic = arguments.box(cell, pbc)
        return self._chains.unwrap(arguments.points(positions), vectors, periodic)

    def __getstate__(self) -> dict[str, Any]:
        return {"particles": self.particles, "chains": list(self), "closed": self.closed}

    def __setstate__(self, made_with: dict[str, Any]) -> None:
        Chains.__init__(self, **made_with)

    def __repr__(self) -> str:
        beads = sum(len(chain) for chain in self)
        return f"Chains({len(self)} chain{'' if len(self) == 1 else 's'}, {beads} of {self.particles} particles)"
