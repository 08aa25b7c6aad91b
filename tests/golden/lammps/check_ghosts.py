#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs without ghosts: where nothing reads them none are made, and all others have them."""

import re
import unittest

from lammps_run import thermo_tables
from script_tests import MELT, ComparedWithStock, main, run

CHECKED = MELT.replace("every 5 check no", "every 1 check yes")
SKEWED = CHECKED.replace("block 0 6 0 6 0 6", "prism 0 6 0 6 0 6 1.5 -1 0.5")
LOADED = "include ${load}\nsuffix dch\n"
LIST = "a neighbor list is in use"
NONE = "ghosts                  none, as nothing reads them"
# Atoms of other shapes and charges, which the forces of this melt do not have.
BONDS = CHECKED.replace("atom_style atomic", "atom_style bond")
CHARGES = CHECKED.replace("atom_style atomic", "atom_style charge").replace(
    "lj/cut 2.5", "lj/cut/coul/long 2.5\npair_modify table 0\nkspace_style pppm 1e-4\nset type 1 charge 0.1\nset type 1 type/fraction 1 0.5 77")


def numbers_of_ghosts(output):
    """Of each run."""
    return [int(n) for n in re.findall(r"^Nghost: +(\d+)[.0-9]* ave", output, re.MULTILINE)]


class WithoutGhosts(ComparedWithStock):

    def test_none_are_made(self):
        for script in (CHECKED, SKEWED, MELT, CHECKED.replace("2.5", "1.3")):
            output = run(LOADED + script + "run 60\ndch stats\n")
            self.assertEqual(numbers_of_ghosts(output), [0], output)
            self.assertIn(NONE, output)
            self.compare(script + "run 60\n")

    def test_forces_are_the_same_to_the_last_bit(self):
        script = LOADED + CHECKED + "fix 2 all langevin/philox 1.4 1.4 1.0 4711\n"
        without = run(script + "run 60\n")
        beside = run(script + "fix 3 all store/force\nrun 60\n")
        self.assertEqual(numbers_of_ghosts(without), [0])
        self.assertGreater(numbers_of_ghosts(beside)[0], 0)
        self.assertEqual(thermo_tables(without), thermo_tables(beside))

    def test_of_a_system_that_fills_its_arrays(self):
        """LAMMPS has room for 16,384 atoms or a multiple; without ghosts nothing else makes room for one more."""
        script = CHECKED.replace("block 0 6 0 6 0 6", "block 0 16 0 16 0 16")
        output = run(LOADED + script + "run 25\ndch stats\n")
        self.assertIn("16384 atoms", output)
        self.assertEqual(numbers_of_ghosts(output), [0])
        self.assertIn("atoms in memory         in the order of the structure", output)
        self.compare(script + "run 25\n")

    def test_none_are_made_of_types_with_regions_of_their_own(self):
        types = MELT.replace("create_box 1 box", "create_box 2 box").replace("mass 1 1.0", "mass * 1.0")
        types = types.replace("pair_coeff 1 1", "set type 1 type/fraction 2 0.1 9\npair_coeff * *")
        types = re.sub(r"(pair_coeff .*)", r"\1\npair_coeff 2 2 1 1 2.1", types)
        for style in ("multi", "multi/old"):
            script = re.sub(r"neighbor (\S+) bin", rf"neighbor \1 {style}\ncomm_modify mode {style}", types)
            self.assertIn(style, script)
            output = run(LOADED + script + "run 60\ndch stats\n")
            self.assertEqual(numbers_of_ghosts(output), [0], output)
            self.assertIn(NONE, output)
            # Ghosts for what comes later: native lists of these styles stop stock LAMMPS where a compute asks for another.
            later = "run 20\nfix 2 all store/force\nrun 20\n"
            self.assertGreater(numbers_of_ghosts(run(LOADED + script + later))[1], 0)
            self.compare(script + later)


class WithGhosts(ComparedWithStock):
    """Whatever may read ghosts has them, and what it says is what it says in stock LAMMPS."""

    def check(self, script, reason, ranks=1):
        output = run(LOADED + script + "dch stats\n", ranks=ranks)
        self.assertIn(f"ghosts                  made: {reason}", output)
        self.assertGreater(numbers_of_ghosts(output)[-1], 0)
        self.compare(script, ranks=ranks)

    def test_those_who_read_them(self):
        rdf = "compute 2 all rdf 20\nfix 2 all ave/time 10 1 10 c_2[*] mode vector\n"
        sums = "thermo_style custom step pe press c_3\n"
        nearby = "compute 2 all centro/atom fcc\ncompute 3 all reduce sum c_2\n" + sums
        pairs = "compute 2 all pair/local dist\ncompute 3 all reduce sum c_2 INPUTS_LOCAL\n"
        for lines, reason in (
            (rdf, LIST), (nearby, LIST), (pairs + sums, LIST), ("compute 2 all ke/atom\n", "compute ke/atom"),
            ("fix 2 all store/force\n", "fix store/force"),
            ("fix 2 all deform 1 x erate 0.01 remap v\n", "the box changes"),
            ("fix 2 all press/berendsen iso 0 0 1\n", "the box changes")):
            self.check(CHECKED + lines + "run 40\n", reason)

    def test_bonds_and_lattice_sums(self):
        self.check(BONDS.replace("create_box 1 box", "create_box 1 box bond/types 1 extra/bond/per/atom 2") + "run 40\n",
                   "atoms may have bonds")
        self.check(CHARGES + "run 40\n", "kspace_style")

    def test_other_ways_to_run(self):
        self.check(CHECKED + "run 40\n", "other processes have a part of the atoms", ranks=2)
        self.check(CHECKED + "run_style respa 2 2 pair 2\nrun 20\n", "not a run with run_style verlet")
        self.check(CHECKED + "minimize 0 0 5 50\n", "not a run with run_style verlet")
        self.check(CHECKED + "comm_modify cutoff 4\nrun 20\n", "comm_modify cutoff")
        self.check(CHECKED + "change_box all boundary p p s\nrun 20\n", "the box changes")
        small = CHECKED.replace("block 0 6 0 6 0 6", "block 0 3 0 3 0 3")
        self.check(small + "run 40\n", "the box is not more than twice as wide as the cutoff")

    def test_a_run_after_one_without(self):
        later = "compute 2 all coord/atom cutoff 1.5\ncompute 3 all reduce sum c_2\n" \
            "thermo_style custom step pe press c_3\nrun 20\n"
        output = run(LOADED + CHECKED + "run 20\nrun 20 pre no\n" + later)
        self.assertEqual(numbers_of_ghosts(output)[:2], [0, 0])
        self.assertGreater(numbers_of_ghosts(output)[2], 0)
        self.compare(CHECKED + "run 20\nrun 20 pre no\n" + later)

    def test_a_command_after_a_run_without(self):
        """Pairs through faces are among those of which an atom is deleted."""
        script = CHECKED + "run 40\ndelete_atoms overlap 0.95 all all\nrun 20\n"
        self.assertIn("Deleted ", run(LOADED + script))
        self.compare(script)


if __name__ == "__main__":
    main(__doc__)
