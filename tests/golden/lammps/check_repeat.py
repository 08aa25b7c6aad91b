#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""The same script five times, while other programs keep the processors more or less busy: the same bits each time."""

import hashlib
import os
import re
import sys
import unittest

from lammps_run import thermo_tables
from script_tests import host, main

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "support"))
from busy_processors import load  # noqa: E402

REPEATS = 5
# Fast atoms, so that the structure often has to be repaired or built anew.
SCRIPT = """
units lj
atom_style atomic
atom_modify sort 20 0
lattice {lattice}
region box prism 0 {cells} 0 {cells} 0 {cells} {tilt} 0 0
create_box 1 box
create_atoms 1 box
mass 1 1.0
velocity all create {temperature} 87287 loop geom
pair_style lj/cut 2.5
pair_coeff 1 1 1.0 1.0
neighbor {skin} bin
neigh_modify delay 0 every 1 check yes
fix 1 all nve
{fix}
thermo 20
thermo_modify format float %.17g
dump 1 all custom {steps} {dump} id x y z vx vy vz fx fy fz
dump_modify 1 sort id format float %.17g
run {steps}
dch stats
"""
SCENES = {
    "gas": {"lattice": "sc 0.1", "cells": 14, "tilt": 4, "temperature": 10, "skin": 1.5, "steps": 120, "fix": ""},
    "melt": {"lattice": "fcc 0.8442", "cells": 7, "tilt": 2, "temperature": 20, "skin": 1.0, "steps": 60, "fix": ""},
    # `auto` changes from the grid to the hierarchy.
    "widening": {"lattice": "fcc 0.8442", "cells": 6, "tilt": 0, "temperature": 1.44, "skin": 0.3, "steps": 100,
                 "fix": "fix 2 all deform 1 x scale 2.5 y scale 2.5 z scale 2.5 remap none"},
}


def outcome(scene, words, ranks, threads):
    """A hash of the last frame and all thermo output, how often structures were built and repaired, and the engine."""
    dump = host.work / "dump.repeat"
    text = f"include ${{load}}\n{words}dch threads {threads}\n" + SCRIPT.format(dump=dump, **SCENES[scene])
    code, output = host.run_text(text, ranks=ranks)
    if code != 0:
        raise AssertionError(output)
    state = dump.read_text() + repr(thermo_tables(output))
    work = re.search(r"built (\d+) times, repaired (\d+) times, neither (\d+) times", output)
    engine = re.search(r"^  engine +(.*)", output, re.MULTILINE)[1]
    return hashlib.sha256(state.encode()).hexdigest(), tuple(map(int, work.groups())), engine


class Repeats(unittest.TestCase):
    def check(self, scene, words, ranks, threads=(1,)):
        found = {}
        for repeat in range(REPEATS):
            with load(repeat):
                result = outcome(scene, words, ranks, threads[repeat % len(threads)])
            found.setdefault(result, []).append(repeat)
        self.assertEqual(len(found), 1, f"{scene}, {words!r}, {ranks} processes: {found}")
        (_, (builds, repairs, _), engine), = found
        self.assertGreater(builds + repairs, 2, "nothing was decided")
        return engine

    def test_force_styles_on_one_process_with_one_and_two_threads(self):
        for scene in ("gas", "melt"):
            self.check(scene, "dch on\nsuffix dch\n", 1, threads=(1, 2))

    def test_lists_on_one_process(self):
        self.check("gas", "dch styles no\ndch on\n", 1)
        self.check("melt", "dch styles no\ndch on engine grid\n", 1, threads=(1, 2))

    def test_choice_of_the_engine(self):
        for ranks, threads in ((1, (1, 2)), (2, (1,))):
            engine = self.check("widening", "dch styles no\ndch on engine auto\n", ranks, threads)
            self.assertIn("distances of the hierarchy", engine)  # which is in use after the grid

    def test_two_processes(self):
        self.check("melt", "dch on\nsuffix dch\n", 2)


if __name__ == "__main__":
    os.environ["OMPI_MCA_mpi_yield_when_idle"] = "1"  # one that waits leaves the processor to the others
    main(__doc__)
