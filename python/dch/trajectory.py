# SPDX-License-Identifier: MIT
"""Frames of trajectory files, as `dchmd` reads them: dumps of LAMMPS, XTC, TRR and GRO of GROMACS, DCD, H5MD.

    for frame in dch.trajectory.Trajectory("run.xtc"):
        i, j, D = dch.neighbour_list("ijD", positions=frame.positions, cell=frame.cell, pbc=frame.pbc, cutoff=1.0)

In the Debian package, and in builds with DCH_BUILD_REPLAY; a wheel has not the libraries that it needs (HDF5, zlib).
"""
from __future__ import annotations

import os
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ._core import InvalidParameter

try:
    from . import _trajectory
    from ._trajectory import FileError
except ImportError as error:
    raise ImportError("this build of dch has no reader of trajectories; build it with DCH_BUILD_REPLAY, or install the Debian "
                      "package python3-dch") from error

__all__ = ["FileError", "Frame", "Trajectory", "formats"]


class Frame(NamedTuple):
    """Atoms in ascending order of their ids; lengths in the unit of the file."""

    step: int  #: the number that the file has for it, or how many frames stand before it
    time: float | None  #: in ps, or in the unit of the file where that is not known
    positions: npt.NDArray[np.float64]  #: (n, 3), as in the file, not wrapped
    cell: npt.NDArray[np.float64]  #: (3, 3), vectors as rows; zeros without a cell
    pbc: tuple[bool, bool, bool]  #: along which of them it is periodic
    ids: npt.NDArray[np.int64]  #: (n,)
    types: npt.NDArray[np.int32] | None  #: (n,) of the file
    molecules: npt.NDArray[np.int32] | None  #: (n,) of the file
    images: npt.NDArray[np.int32] | None  #: (n, 3) of the cell, that LAMMPS counted


class Trajectory:
    """The frames of a file, one after the other; each loop over it begins where the last one ended.

    Parameters
    ----------
    path
        The format is known by the ending of its name.
    format
        One of formats(), for another name; None for that of the name.

    FileError, a ValueError, for a file that cannot be read or is broken, when the frame is read in which it is. One thread
    at a time may use an object; another one gets a RuntimeError. It closes the file at its end, and by close() or `with`.
    """

    def __init__(self, path: str | os.PathLike[str], format: str | None = None) -> None:
        if format is not None and format not in _trajectory.formats():
            raise InvalidParameter(f"format is {format!r}; give one of {', '.join(_trajectory.formats())}, or None")
        self._path = os.fspath(path)
        self._reader = _trajectory.Reader(self._path, format or "")

    @property
    def format(self) -> str:
        """What the file is, such as "GROMACS XTC"."""
        return self._reader.format()

    @property
    def length_unit(self) -> str:
        """"nm", "Angstrom", or what is known of it."""
        return self._reader.length_unit()

    def __iter__(self) -> Iterator[Frame]:
        return self

    def __next__(self) -> Frame:
        numbers = self._reader.read()
        if numbers is None:
            raise StopIteration
        return Frame(*numbers)

    def close(self) -> None:
        """There are no further frames then."""
        self._reader.close()

    def __enter__(self) -> Trajectory:
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()

    def __repr__(self) -> str:
        return f"Trajectory({self._path!r}: {self.format}, lengths in {self.length_unit})"


def formats() -> list[str]:
    """The endings of names by which files are known."""
    return _trajectory.formats()
