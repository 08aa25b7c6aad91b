# SPDX-License-Identifier: MIT
"""Neighbor pairs of OpenMM's Contexts, and reporters of contacts of chains and of bonds that go through each other.

    i, j, D = dch.openmm.ContextPairs(context, 0.6 * unit.nanometer).pairs("ijD")
    simulation.reporters.append(dch.openmm.CrossingReporter("crossings.csv", 100))
    simulation.reporters.append(dch.openmm.ContactReporter("contacts.csv", 1000, gap=0.3))
"""
from __future__ import annotations

import warnings
from typing import Any, TextIO

from openmm import unit

from ._arguments import count, index_pairs, length
from ._chains import Chains
from ._contacts import ContactFinder, ContactMap, Contacts
from ._core import InvalidParameter
from ._crossings import Crossings, CrossingStep
from ._pairs import VerletList

__all__ = ["ContactReporter", "ContextPairs", "CrossingReporter"]

COLUMNS = ("Step", "Time (ps)", "p1", "p2", "q1", "q2", "Sign", "X (nm)", "Y (nm)", "Z (nm)")


def in_nanometers(value: Any) -> Any:
    return value.value_in_unit(unit.nanometer) if unit.is_quantity(value) else value


def bonds_of(topology: Any) -> list[list[int]]:
    bonds = [[bond[0].index, bond[1].index] for bond in topology.bonds()]
    if not bonds:
        raise InvalidParameter("the topology of the simulation has no bonds; give the reporter those of the chains")
    return bonds


def positions_and_cell(system: Any, state: Any) -> tuple[Any, Any]:
    """In nm; None for the cell unless a force of the System is periodic."""
    cell = None
    if system.usesPeriodicBoundaryConditions():
        cell = state.getPeriodicBoxVectors(asNumpy=True).value_in_unit(unit.nanometer)
    return state.getPositions(asNumpy=True).value_in_unit(unit.nanometer), cell


class ContextPairs:
    """Pairs of particles of a Context within a cutoff, at its positions and in its box of the moment.

    For potentials that are computed outside of OpenMM, and for analysis. Pairs are found with a skin and kept, as by
    VerletList: none is ever missing. The box is periodic if a force of the System uses periodic boundary conditions; the
    cutoff may be larger than the box, and all images are listed. One thread at a time may use an object.

    Parameters
    ----------
    context
        An openmm.Context that has positions.
    cutoff
        A length in nm unless it has a unit; or an array of radii, or a matrix of cutoffs with types, as VerletList has them.
    skin
        As VerletList has it; for analysis of frames far from each other 0 is best. A length in nm unless it has a unit.
    half, types, exclusions, threads
        As VerletList has them.

    Raises InvalidParameter as VerletList does; InvalidPosition for positions that are not finite.
    """

    def __init__(self, context: Any, cutoff: Any, skin: Any = 0.1, *, half: bool = False, types: Any = None,
                 exclusions: Any = None, threads: int | None = None) -> None:
        self._context = context
        self._pairs = VerletList(in_nanometers(cutoff), in_nanometers(skin), half=half, types=types, exclusions=exclusions,
                                 threads=threads)

    def pairs(self, quantities: str = "ijDS") -> Any:
        """Arrays as dch.neighbor_list() returns them, lengths in nm; D = r_j - r_i + S . cell with positions as
        context.getState(getPositions=True) has them, and the cell in reduced form as OpenMM keeps it."""
        state = self._context.getState(getPositions=True)
        self._pairs.update(*positions_and_cell(self._context.getSystem(), state))
        return self._pairs.pairs(quantities)

    @property
    def rebuilds(self) -> int:
        """How often pairs were searched for anew."""
        return self._pairs.rebuilds

    def __repr__(self) -> str:
        return f"ContextPairs({self._pairs!r})"


class Table:
    """A file of rows of numbers under the names of their columns; closed with this if it was opened by name."""

    def __init__(self, file: str | TextIO | None, columns: tuple[str, ...]) -> None:
        self._owned: TextIO | None = None
        if isinstance(file, str):
            file = self._owned = open(file, "w")
        self._file = file
        if self._file is not None:
            print("#" + ",".join(f'"{name}"' for name in columns), file=self._file, flush=True)

    def __del__(self) -> None:
        owned: TextIO | None = getattr(self, "_owned", None)  # not there where the file could not be opened
        if owned is not None:
            owned.close()

    def write(self, rows: Any) -> None:
        if self._file is not None:
            for row in rows:
                print(*row, sep=",", file=self._file)
            self._file.flush()


class CrossingReporter:
    """Writes down the bonds that go through each other between reports, a line each, and counts them.

    Particles go along straight lines from one report to the next, so report as often as every few steps of a polymer model:
    crossings there and back within an interval cancel. The first report is where it begins; so is one whose step is not
    after the last one's, as when a state has been loaded.

    Parameters
    ----------
    file
        Name of the file to write to, a file, or None for none. Lines have the step and the time of the crossing, the
        particles of both bonds, the sign (dch.BondCrossings) and the place.
    reportInterval
        Steps between reports, at least 1.
    bonds
        (m, 2) indices of particles; None for those of the simulation's topology.
    thickness
        Bonds whose axes come within it are contacts; a length in nm unless it has a unit.
    threads
        As for dch.neighbor_list().

    If the System uses periodic boundary conditions, particles go to the nearest images of where they were. A warning tells
    of the first bond that is undetermined: of which a particle moved half the smallest height of the box or more between
    reports, or that is as long. InvalidParameter as for dch.Crossings; if bonds is None and the topology has none, at the
    first report.
    """

    def __init__(self, file: str | TextIO | None, reportInterval: int, bonds: Any = None, thickness: Any = 0, *,
                 threads: int | None = None) -> None:
        self._interval = count(reportInterval, "reportInterval", 1, 2**31 - 1)
        self._thickness, self._threads = length(in_nanometers(thickness), "thickness"), threads
        self._bonds = None if bonds is None else index_pairs(bonds, "bonds")
        if self._bonds is not None:  # all that may be wrong with them but for particles that the System lacks
            self._follow(int(self._bonds.max(initial=-1)) + 1, self._bonds)
        self._following: Crossings | None = None
        self._last: tuple[int, float] | None = None  # step, and time [ps]
        #: Totals over all reports.
        self.crossings = self.contacts = self.undetermined = 0
        #: What the last report found, a dch.CrossingStep; None where it began.
        self.found: CrossingStep | None = None
        self._table = Table(file, COLUMNS)

    def describeNextReport(self, simulation: Any) -> tuple[int, bool, bool, bool, bool, bool]:
        """Steps until the next report, and that it needs positions, not wrapped."""
        return self._interval - simulation.currentStep % self._interval, True, False, False, False, False

    def report(self, simulation: Any, state: Any) -> None:
        """Called by the Simulation. Call it with a state of the positions that the first steps begin with, if these are to
        count: reporter.report(simulation, simulation.context.getState(getPositions=True))."""
        positions, cell = positions_and_cell(simulation.system, state)
        now = simulation.currentStep, state.getTime().value_in_unit(unit.picosecond)
        last, self._last, self.found = self._last, None, None  # after an error the next report begins anew
        if self._following is None:
            self._following = self._follow(len(positions), bonds_of(simulation.topology) if self._bonds is None else self._bonds)
        if last is None or now[0] <= last[0]:
            self._following.start(positions, cell)
        else:
            self._take(self._following.step(positions, cell), last, now)
        self._last = now

    def _follow(self, particles: int, bonds: Any) -> Crossings:
        return Crossings(particles, bonds, self._thickness, threads=self._threads)

    def _take(self, found: CrossingStep, last: tuple[int, float], now: tuple[int, float]) -> None:
        self.found = found
        if self.undetermined == 0 and len(found.undetermined.bonds) > 0:
            self._warn(found, now[0])
        self.crossings += len(found.crossings.time)
        self.contacts += len(found.contacts.time)
        self.undetermined += len(found.undetermined.bonds)
        if len(found.crossings.time) > 0:
            self._table.write(self._rows(found, last, now))

    @staticmethod
    def _warn(found: CrossingStep, step: int) -> None:
        (a, b), too_long = found.undetermined.bonds[0], found.undetermined.too_long[0]
        why = "is as long as half the smallest height of the box" if too_long else "has moved half the box"
        warnings.warn(f"CrossingReporter: whether bonds crossed is undetermined for {len(found.undetermined.bonds)} bonds at step "
                      f"{step}: the bond of the particles {a} and {b} {why}, or more; report more often, or take a larger box",
                      RuntimeWarning, stacklevel=3)

    @staticmethod
    def _rows(found: CrossingStep, last: tuple[int, float], now: tuple[int, float]) -> Any:
        for p, q, time, _, place, sign in zip(*found.crossings):
            step, picoseconds = (a + time * (b - a) for a, b in zip(last, now))
            yield f"{step:.3f}", f"{picoseconds:.9g}", *p, *q, sign, *(f"{x:.9g}" for x in place)


class ContactReporter:
    """Writes down how many contacts chains have, a line each report, and counts them in a map.

    Parameters
    ----------
    file
        Name of the file to write to, a file, or None for none. Lines have the step, the time, how many contacts there are,
        and how many of these began and how many ended since the last report.
    reportInterval
        Steps between reports, at least 1.
    gap, radius
        As dch.ContactFinder has them; lengths in nm unless they have a unit.
    bonds
        (m, 2) indices of particles; None for those of the simulation's topology. Chains are what they make.
    skip_bonds, within, between, threads
        As dch.ContactFinder has them.
    max_bins
        Of the map, as dch.ContactMap has them.

    If the System uses periodic boundary conditions, contacts are those of nearest images. InvalidParameter as for dch.Chains
    and dch.ContactFinder; if bonds is None and the topology has none, at the first report.
    """

    def __init__(self, file: str | TextIO | None, reportInterval: int, gap: Any, radius: Any = 0, bonds: Any = None, *,
                 skip_bonds: int = 1, within: bool = True, between: bool = True, max_bins: int = 512,
                 threads: int | None = None) -> None:
        self._interval = count(reportInterval, "reportInterval", 1, 2**31 - 1)
        self._bonds = None if bonds is None else index_pairs(bonds, "bonds")
        self._gap, self._radius, self._threads = in_nanometers(gap), in_nanometers(radius), threads
        self._pairs: dict[str, Any] = {"skip_bonds": skip_bonds, "within": within, "between": between}
        self._max_bins = max_bins
        empty = Chains(0)
        ContactMap(empty, max_bins)  # which refuse what does not fit
        ContactFinder(empty, self._gap, threads=threads, **self._pairs)
        self._finder: ContactFinder | None = None
        self._last: set[tuple[int, int]] = set()
        #: How often beads were in contact, a dch.ContactMap; None before the first report.
        self.map: ContactMap | None = None
        #: What the last report found, a dch.Contacts; None before the first.
        self.found: Contacts | None = None
        self._table = Table(file, ("Step", "Time (ps)", "Contacts", "Began", "Ended"))

    def describeNextReport(self, simulation: Any) -> tuple[int, bool, bool, bool, bool, bool]:
        """Steps until the next report, and that it needs positions, not wrapped."""
        return self._interval - simulation.currentStep % self._interval, True, False, False, False, False

    def report(self, simulation: Any, state: Any) -> None:
        """Called by the Simulation."""
        positions, cell = positions_and_cell(simulation.system, state)
        if self._finder is None or self.map is None:
            chains = Chains.from_bonds(len(positions), bonds_of(simulation.topology) if self._bonds is None else self._bonds)
            self._finder = ContactFinder(chains, self._gap, self._radius, threads=self._threads, **self._pairs)
            self.map = ContactMap(chains, self._max_bins, **self._pairs)
        self.found = self._finder.find(positions, cell)
        self.map.add(self.found)
        now = set(zip(self.found.i.tolist(), self.found.j.tolist()))
        time = state.getTime().value_in_unit(unit.picosecond)
        self._table.write([(simulation.currentStep, f"{time:.9g}", len(now), len(now - self._last), len(self._last - now))])
        self._last = now
