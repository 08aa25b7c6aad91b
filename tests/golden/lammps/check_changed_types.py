#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Types of atoms that change between builds of lists: by fix atom/swap, which asks for energies at once, and by a script."""

import unittest

from lammps_run import largest_relative_difference, thermo_tables
from script_tests import MELT, ComparedWithStock, main, run

# The same cutoff for all: else fix atom/swap builds lists before it asks.
TWO = MELT.replace("create_box 1 box", "create_box 2 box").replace("mass 1", "mass *").replace(
    "pair_coeff 1 1 1.0 1.0", "set type 1 type/fraction 2 0.3 4711\n"
    "pair_coeff 1 1 1.0 1.0\npair_coeff 1 2 0.8 0.95\npair_coeff 2 2 0.6 0.9")
FEW = TWO.replace("lj/cut 2.5", "lj/cut 1.3")
BONDED = TWO.replace("atom_style atomic", "atom_style bond").replace(
    "create_box 2 box", "create_box 2 box bond/types 1 extra/bond/per/atom 12 extra/special/per/atom 200") + """
bond_style harmonic
bond_coeff 1 50.0 1.1
group some id 1:100
create_bonds many some some 1 0.9 1.2
special_bonds lj 0.3 0.5 1.0
"""
SWAPS = "fix 2 all atom/swap 10 20 4711 1.5 ke no types 1 2\n"
THERMO = "thermo_style custom step temp epair etotal press f_2[1] f_2[2]\nthermo_modify format float %.15g\n"
# No atom has an image, since LAMMPS tells ghosts their types no sooner than at the next build.
OPEN = TWO.replace("units lj", "units lj\nboundary s s s")
CHANGE = "run 0\nset group all type/fraction 2 0.6 99\nrun 30 pre no\n"


class ChangedTypes(ComparedWithStock):
    def test_swaps(self):
        for name, script in (("cluster pairs", TWO), ("one by one", FEW), ("weights", BONDED)):
            for newton, ranks in (("on", 1), ("on", 2), ("off", 2)):
                with self.subTest(name, newton=newton, ranks=ranks):
                    tables = self.compare(f"newton {newton}\n" + script + SWAPS + THERMO + "run 40\n", ranks=ranks)
                    last = tables[0][-1]
                    self.assertLess(0, last["f_2[2]"])
                    self.assertLess(last["f_2[2]"], last["f_2[1]"])

    def test_types_that_become_others(self):
        script = TWO + "fix 2 all atom/swap 5 20 4711 1.5 ke no semi-grand yes types 1 2 mu 0 0.5\n" + THERMO + "run 20\n"
        self.compare(script)

    def test_swaps_between_cutoffs(self):
        script = TWO.replace("0.8 0.95", "0.8 0.95 1.8").replace("0.6 0.9", "0.6 0.9 1.5") + SWAPS + THERMO + "run 20\n"
        for ranks in (1, 2):
            self.compare(script, ranks=ranks)

    def test_types_that_a_script_changes(self):
        for name, script in (("cluster pairs", OPEN), ("one by one", OPEN.replace("lj/cut 2.5", "lj/cut 1.3"))):
            for ranks in (1, 2):
                with self.subTest(name, ranks=ranks):
                    self.compare(script + CHANGE, ranks=ranks)

    def test_swaps_that_exclusions_go_by(self):
        """Of types between which pairs are excluded, with the same cutoff."""
        for ranks in (1, 2):
            self.compare(TWO + "neigh_modify exclude type 1 2\n" + SWAPS + THERMO + "run 40\n", ranks=ranks)


class ListsLiveNoLonger(unittest.TestCase):
    """Than those of stock LAMMPS: two atoms are in no list, for what they are when it is built; as others they come within
    the cutoff once one has moved half the skin."""

    FLIGHT = """
units lj
atom_style molecular
boundary f f f
region box block 0 20 0 10 0 10
create_box 2 box
create_atoms {type} single 5 5 5
create_atoms {type} single {second} 5 5
mass * 1.0
group fast id 1
velocity fast set {speed} 0 0
{pairs}
neighbor {skin} bin
neigh_modify delay 0 every 1 check yes
fix 1 all nve
thermo 1
thermo_modify format float %.15g
{change}
"""
    LJ = "pair_style lj/cut 1.5\npair_coeff * * 1.0 1.0\n"

    def compare(self, pairs, change, kind=1, second=7.0013, speed=1, skin=1.0):
        script = self.FLIGHT.format(pairs=pairs, change=change, type=kind, second=second, speed=speed, skin=skin)
        settings = ("", "include ${load}\ndch styles no\ndch on\n", "include ${load}\ndch on\n", "include ${load}\nsuffix dch\n")
        native, *ours = (thermo_tables(run(before + script))[-1] for before in settings)
        self.assertNotEqual(native[-1]["E_pair"], 0)  # they have met
        for found in ours:
            for lines in zip(native, found, strict=True):
                self.assertLess(largest_relative_difference(*lines), 1e-9)

    def test_cutoffs(self):
        self.compare("pair_style lj/cut 2.5\npair_coeff * * 1.0 1.0 1.2\npair_coeff 2 2 1.0 1.0 2.5\n",
                     "run 0\nset group all type 2\nrun 50 pre no\n", second=8, speed=3, skin=0.8)

    def test_types_excluded(self):
        self.compare(self.LJ + "neigh_modify exclude type 2 2\n", "run 0\nset group all type 1\nrun 200 pre no\n", kind=2)

    def test_styles(self):
        pairs = "pair_style hybrid lj/cut 1.5 morse 1.5\npair_coeff 1 * lj/cut 1.0 1.0\npair_coeff 2 2 morse 1.0 5.0 1.0\n"
        self.compare(pairs, "run 0\nset group all type 1\nrun 200 pre no\n", kind=2)

    def test_groups(self):
        self.compare(self.LJ + "group a id 1 2\nneigh_modify exclude group a a\n", "run 0\ngroup a clear\nrun 200 pre no\n")

    def test_molecules(self):
        self.compare(self.LJ + "set group all mol 1\nneigh_modify exclude molecule/intra all\n",
                     "run 0\nset atom 1 mol 2\nrun 200 pre no\n")


if __name__ == "__main__":
    main(__doc__)
