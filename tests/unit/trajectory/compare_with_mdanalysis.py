#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Compares the frames of a trajectory, as MDAnalysis reads them, with those in a raw file.

usage: compare_with_mdanalysis.py TRAJECTORY RAW

RAW holds doubles: for each frame the number of atoms, the box's origin and three edges (0 for no box), and three
coordinates for each atom, in the trajectory's unit. Exit status 0 if all agree to the seven digits that MDAnalysis
keeps, and to the last bit of them in XTC and TRR files.
"""
import sys
import warnings

warnings.simplefilter("ignore")

import MDAnalysis  # noqa: E402
import numpy  # noqa: E402
from MDAnalysis.coordinates.DCD import DCDReader  # noqa: E402
from MDAnalysis.coordinates.H5MD import H5MDReader  # noqa: E402
from MDAnalysis.coordinates.LAMMPS import DumpReader  # noqa: E402
from MDAnalysis.coordinates.TRR import TRRReader  # noqa: E402
from MDAnalysis.coordinates.XTC import XTCReader  # noqa: E402


def read_raw(path):
    """Yields (origin, edges, positions) of each frame."""
    numbers = numpy.fromfile(path)
    at = 0
    while at < len(numbers):
        atoms = int(numbers[at])
        vectors = numbers[at + 1:at + 13 + 3 * atoms].reshape(4 + atoms, 3)
        yield vectors[0], vectors[1:4], vectors[4:]
        at += 13 + 3 * atoms


def open_trajectory(path, atoms):
    """The reader and the number of its units in one of the file's."""
    if path.endswith(".xtc"):
        return XTCReader(path, convert_units=False), 1
    if path.endswith(".trr"):
        return TRRReader(path, convert_units=False), 1
    if path.endswith(".dcd"):
        return DCDReader(path, convert_units=False), 1
    if path.endswith(".lammpstrj"):
        return DumpReader(path, n_atoms=atoms), 1
    if path.endswith(".h5md"):  # as a user would open it
        universe = MDAnalysis.Universe(path)
        unit = universe.trajectory._file["particles/trajectory/position/value"].attrs["unit"]
        return universe.trajectory, {"nm": 10, "Angstrom": 1}[unit]
    return H5MDReader(path, convert_units=False), 1


def check_box(frame, edges, found, factor):
    if not edges.any():
        assert found.dimensions is None or not found.dimensions[:3].any(), f"frame {frame}: a box {found.dimensions}"
        return
    assert found.dimensions is not None, f"frame {frame}: no box"
    expected = MDAnalysis.lib.mdamath.triclinic_box(*(factor * edges))
    numpy.testing.assert_allclose(found.dimensions, expected, rtol=1e-5, atol=1e-5, err_msg=f"box of frame {frame}")


def main():
    trajectory, raw = sys.argv[1:]
    frames = list(read_raw(raw))
    reader, factor = open_trajectory(trajectory, len(frames[0][2]))
    assert len(reader) == len(frames), f"{len(reader)} frames, expected {len(frames)}"
    for k, (origin, edges, positions) in enumerate(frames):
        found = reader[k]
        if trajectory.endswith(".lammpstrj"):  # MDAnalysis puts the origin of a dump's box at zero
            found.positions += origin
        if trajectory.endswith((".xtc", ".trr")):
            numpy.testing.assert_array_equal(found.positions, positions, err_msg=f"positions of frame {k}")
        numpy.testing.assert_allclose(found.positions, factor * positions, rtol=1e-6, atol=2e-6,
                                      err_msg=f"positions of frame {k}")
        if edges.any() or not trajectory.endswith(".trr"):  # MDAnalysis keeps the box of the frame before
            check_box(k, edges, found, factor)


main()
