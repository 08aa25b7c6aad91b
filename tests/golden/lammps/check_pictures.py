#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""The pictures of docs/lammps are as docs/images/draw_systems.py draws them from runs of the scripts now."""

import subprocess
import sys
import unittest
from pathlib import Path

from script_tests import host, main

IMAGES = Path(__file__).resolve().parents[3] / "docs" / "images"
DRAWN_BY = "29 Sep 2021"  # another version of LAMMPS may round otherwise


class Pictures(unittest.TestCase):
    def test_drawn_anew(self):
        if DRAWN_BY not in subprocess.run([host.lmp, "-h"], check=True, stdout=subprocess.PIPE, text=True).stdout:
            self.skipTest(f"no LAMMPS of {DRAWN_BY}")
        folder = host.work / "drawn"
        folder.mkdir(exist_ok=True)
        dchmd = host.loader.parent.parent / "replay" / "dchmd"
        subprocess.run([sys.executable, "-B", IMAGES / "draw_systems.py", host.lmp, dchmd, host.variables["examples"] / "peptide",
                        folder], check=True, env=host.environment)
        kept = sorted(path.name for path in IMAGES.glob("system-*.svg"))
        self.assertEqual(sorted(path.name for path in folder.iterdir()), kept)
        self.assertEqual(len(kept), 4)
        for name in kept:
            self.assertEqual((folder / name).read_text(), (IMAGES / name).read_text(), f"docs/images/{name} is not as it is drawn now")


if __name__ == "__main__":
    main(__doc__)
