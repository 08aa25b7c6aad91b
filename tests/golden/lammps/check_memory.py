#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Peak of LAMMPS's resident memory with DCH lists and with styles on cluster pairs, over that of stock LAMMPS."""

import os
import subprocess
import unittest
from pathlib import Path

from script_tests import host, main

MELT = Path(__file__).resolve().parents[3] / "examples" / "lammps" / "in.melt"
CELLS = 51  # of four atoms each way: 530,604
MOST = 1.4


def peak(words):
    """Kilobytes, with two builds of lists after that at setup, and atoms put in order at the first of them."""
    command = [host.lmp, "-log", "none", "-in", MELT, "-var", "cells", CELLS, "-var", "steps", 40, "-var", "every", 20,
               *words]
    with subprocess.Popen(list(map(str, command)), cwd=host.work, env=host.environment, stdin=subprocess.DEVNULL,
                          stdout=subprocess.DEVNULL) as process:
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        raise AssertionError(f"exit code {process.returncode}: {command}")
    return usage.ru_maxrss


class Peak(unittest.TestCase):
    def test_over_stock(self):
        stock = peak([])
        loaded = ["-var", "load", host.loader, "-var", "lists", "dch"]
        for name, words in (("lists", ["-var", "styles", "no"]), ("double", []), ("mixed", ["-var", "precision", "mixed"])):
            ratio = peak(loaded + words) / stock
            print(f"{name}: {ratio:.2f}", flush=True)
            with self.subTest(name):
                self.assertLess(ratio, MOST)


if __name__ == "__main__":
    main(__doc__)
