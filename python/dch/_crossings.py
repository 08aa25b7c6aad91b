# SPDX-License-Identifier: MIT
"""Bonds that go through each other from frame to frame."""
from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from . import _arguments as arguments
from . import _core

Floats = npt.NDArray[np.float64]
Ints = npt.NDArray[np.int32]


class BondCrossings(NamedTuple):
    """Pairs of bonds that went through each other in a step, a row each; a pair may do so up to three times."""

    p: Ints  #: (k, 2) particles of the first bond, in the direction of its chain
    q: Ints  #: (k, 2) particles of the second bond
    time: Floats  #: (k,) in the step, from 0 to 1
    along: Floats  #: (k, 2) where on each bond, 0 at its first particle, 1 at its second
    place: Floats  #: (k, 3) on that image of the first bond whose first particle was where the last frame has it [length]
    sign: Ints  #: (k,) +1 or -1, by which it changes the linking number of two rings; 0 in branched molecules


class BondContacts(NamedTuple):
    """Pairs of bonds that came within the thickness of each other in a step, or touched, without going through."""

    p: Ints  #: (k, 2) particles of the first bond
    q: Ints  #: (k, 2) particles of the second bond
    time: Floats  #: (k,) when they first did, from 0 to 1
    distance: Floats  #: (k,) of their axes then [length]


class UndeterminedBonds(NamedTuple):
    """Bonds of which a step says nothing: no pair with one of these is in the other two."""

    bonds: Ints  #: (k, 2) particles
    too_long: npt.NDArray[np.bool_]  #: (k,) half the smallest height of the cell or more; else a particle moved so far


class CrossingStep(NamedTuple):
    """What happened from one frame to the next."""

    frame: int  #: number of the frame that the step leads to; that of start() is 0
    crossings: BondCrossings
    contacts: BondContacts
    undetermined: UndeterminedBonds
    started: int  #: bonds that were made since the last frame, which are left out as well


class Crossings:
    """Finds the bonds that go through each other from frame to frame.

    Particles go along straight lines from one frame to the next, to the nearest images of where they were. For these
    lines and the numbers as given the answer is exact. Bonds that share a particle are not compared.

    Parameters
    ----------
    particles
        How many there are.
    bonds
        (m, 2) indices of particles, of chains, rings or branched molecules. Those of a chain are directed along it.
    thickness
        Bonds whose axes come within it are contacts; 0 for those alone that touch [length].
    threads
        As for neighbor_list().

    One thread at a time may use an object; another one gets a RuntimeError. Copies and what comes out of a pickle have the
    parameters and bonds alone: call start(). InvalidParameter for bonds of particles that do
    not exist, of a particle with itself, or given twice, and for a thickness that is negative.

    >>> crossings = Crossings(4, [[0, 1], [2, 3]])
    >>> crossings.start([[-1, 0, 0], [1, 0, 0], [0, -1, 1], [0, 1, 1]])
    >>> step = crossings.step([[-1, 0, 0], [1, 0, 0], [0, -1, -3], [0, 1, -3]])
    >>> step.frame, step.crossings.p.tolist(), step.crossings.q.tolist()
    (1, [[0, 1]], [[2, 3]])
    >>> step.crossings.time.tolist(), step.crossings.place.tolist(), step.crossings.sign.tolist()
    ([0.25], [[0.0, 0.0, 0.0]], [1])
    """

    def __init__(self, particles: int, bonds: Any, thickness: float = 0, *, threads: int | None = None) -> None:
        self._steps = _core.CrossingSteps(arguments.count(particles, "particles", 0, 2**31 - 1), arguments.index_pairs(bonds, "bonds"),
                                          arguments.length(thickness, "thickness"), arguments.threads(threads))
        self._made_with = {"particles": particles, "thickness": thickness, "threads": threads}
        self._frame = 0

    def __getstate__(self) -> dict[str, Any]:
        return {**self._made_with, "bonds": self.bonds}

    def __setstate__(self, made_with: dict[str, Any]) -> None:
        Crossings.__init__(self, **made_with)

    def start(self, positions: Any, cell: Any = None, pbc: Any = None) -> None:
        """Takes the first frame, or one after a gap: positions (n, 3), the cell and pbc as VerletList.update() does.
        InvalidParameter if there are more or fewer positions than particles."""
        vectors, periodic = arguments.box(cell, pbc)
        self._steps.start(arguments.points(positions), vectors, periodic)
        self._frame = 0

    def step(self, positions: Any, cell: Any = None, pbc: Any = None) -> CrossingStep:
        """What happened since the last frame, by pairs of bonds and time. InvalidParameter before start(), for more or fewer
        positions, and for a cell that is periodic along other vectors than before; call start() after an error."""
        vectors, periodic = arguments.box(cell, pbc)
        crossings, contacts, (bonds, too_long), started = self._steps.step(arguments.points(positions), vectors, periodic)
        self._frame += 1
        return CrossingStep(self._frame, BondCrossings(*crossings), BondContacts(*contacts),
                            UndeterminedBonds(bonds, too_long.view(np.bool_)), started)

    @property
    def bonds(self) -> Ints:
        """All bonds (m, 2), those of chains first, chain by chain and directed along it. Set it when bonds are made or
        broken: those that are new start with the next frame. InvalidParameter as above; then they are as they were."""
        return self._steps.bonds()

    @bonds.setter
    def bonds(self, bonds: Any) -> None:
        self._steps.set_bonds(arguments.index_pairs(bonds, "bonds"))
