#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Writes an XTC file of frames of all kinds with MDAnalysis, which can do what libgromacs cannot: ranges of up to 2^31
steps, and atoms too far apart for small steps.

usage: write_xtc.py FILE ATOMS
"""
import sys
import warnings

warnings.simplefilter("ignore")

import numpy  # noqa: E402
from MDAnalysis.lib.formats.libmdaxdr import XTCFile  # noqa: E402


PRECISION = 1e6  # MDAnalysis does not let it change within a file


def frames(atoms):
    """Yields the positions of each frame."""
    random = numpy.random.default_rng(20261123)
    for half in (1, 10, 100, 500, 536, 900, 1000):
        yield random.uniform(-half, half, (atoms, 3))
    for spread in (1e-6, 1e-4, 0.001, 0.03, 1):
        first = random.uniform(0, 0.05, (atoms // 3 + 1, 1, 3))
        yield (first + random.uniform(-spread, spread, (atoms // 3 + 1, 3, 3))).reshape(-1, 3)[:atoms]
    for slope in (0.0, 1e-6, 0.001, 2.0):
        yield numpy.arange(atoms)[:, None] * [slope, 0, -slope]


def main(path, atoms):
    with XTCFile(path, "w") as file:
        for k, positions in enumerate(frames(atoms)):
            box = numpy.array([[9, 0, 0], [k, 9, 0], [1, -k, 9]], dtype=numpy.float32)
            file.write(positions.astype(numpy.float32), box, k, 0.5 * k, PRECISION)


main(sys.argv[1], int(sys.argv[2]))
