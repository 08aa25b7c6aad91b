#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""`dch expiry`: lists that are kept lack no pair, and runs on them are those of stock LAMMPS."""

import re
import unittest

from lammps_run import largest_relative_difference, thermo_tables
from script_tests import MELT, host, main, run

CHECKED = MELT.replace("neigh_modify delay 0 every 5 check no", "neigh_modify delay 0 every 1 check yes")
SKEWED = CHECKED.replace("block 0 6 0 6 0 6", "prism 0 6 0 6 0 6 1.5 -1 0.5")
TWO_TYPES = CHECKED.replace("create_box 1", "create_box 2").replace("mass 1", "mass *") \
    .replace("pair_coeff 1 1 1.0 1.0", "set type 1 type/fraction 2 0.2 4711\npair_coeff 1 1 1 1 2.5\n"
             "pair_coeff 1 2 1 1 1.7\npair_coeff 2 2 1.0 1.0 1.5")
# So few atoms that all of them are asked about, until a pair is missing.
GAS = CHECKED.replace("fcc 0.8442", "sc 0.04").replace("block 0 6 0 6 0 6", "block 0 3 0 3 0 3") \
    .replace("create 1.44", "create 10").replace("neighbor 0.3", "neighbor 0.8")
# More than the nearest image of an atom is within the cutoff: ghosts are points on one process too.
SMALL = GAS.replace("block 0 3 0 3 0 3", "block 0 2 0 2 0 2").replace("sc 0.04", "sc 0.1")
# Two atoms fly at each other from 3.325, or 3.358, with speeds of 3 and 1; they are within their cutoff after 42, or 43,
# steps. The faster one's process has the other one as a ghost if it is at 13.3 or below when lists are built.
TWO_ATOMS = """
units lj
atom_style atomic
region box block 0 20 0 10 0 10
create_box 1 box
create_atoms 1 single {first} 5 5
create_atoms 1 single {second} 5 5
mass 1 1.0
group fast id 1
group slow id 2
velocity fast set 3 0 0
velocity slow set -1 0 0
pair_style lj/cut 2.5
pair_coeff 1 1 1.0 1.0
neighbor 0.8 bin
neigh_modify delay 0 every 1 check yes
fix 1 all nve
"""
# Grains of many sizes that fly about and seldom touch.
GRAINS = """
units lj
atom_style sphere
newton on
lattice sc 0.15
region box block 0 3 0 3 0 3
comm_modify vel yes
create_box 1 box
create_atoms 1 box
variable d atom 0.6+random(0,0.9,4711)
set atom * diameter v_d density 1.0
velocity all create 3.0 87287 loop geom
pair_style gran/hooke 2000.0 NULL 50.0 NULL 0.5 0
pair_coeff * *
neighbor 0.8 bin
neigh_modify delay 0 every 1 check yes
fix 1 all nve/sphere
timestep 0.002
"""
# The two atoms as grains, and a larger one that has LAMMPS send ghosts from farther off.
TWO_GRAINS = TWO_ATOMS.replace("atomic", "sphere\nnewton on\ncomm_modify vel yes").replace("mass 1 1.0", "create_atoms 1 single 4.5 1 1\n"
                               "set atom 1*2 diameter 2.5 density 1\nset atom 3 diameter 4.4 density 1") \
    .replace("pair_style lj/cut 2.5\npair_coeff 1 1 1.0 1.0", "pair_style gran/hooke 200.0 NULL 50.0 NULL 0.5 0\npair_coeff * *") \
    .replace("all nve", "all nve/sphere")
EXACT = "expiry +exact: about ([0-9.e+-]+) builds saved"


def builds(output):
    return int(re.findall(r"Neighbor list builds = (\d+)", output)[-1])


class Oracle(unittest.TestCase):
    """All pairs at every step, in double precision, against lists and forces."""

    def look(self, script, what="both", steps=60, ranks=1, fault="none"):
        path = host.work / "in.oracle"
        styles = "dch styles no\n" if what != "forces" else ""  # else there are no lists to look at
        path.write_text(styles + script + "thermo 0\nrun 0\n")
        code, output = host.run(ranks, [host.tools / "expiry_oracle", fault, what, steps, path])
        return code, output if code else output[output.rfind("DCH neighbor lists"):]  # without that of each step

    def check(self, script, saves=True, **options):
        code, output = self.look(script, **options)
        self.assertEqual(code, 0, output)
        self.assertRegex(output, r"oracle: .* 0 missing")
        saved = re.search(EXACT, output)
        self.assertTrue(saved, output)
        if saves:
            self.assertGreater(float(saved[1]), 0.3, output)
        return output

    def test_lists_of_each_engine(self):
        for engine in ("dch", "grid", "auto"):
            self.check(f"dch on engine {engine}\n" + CHECKED, steps=40)

    def test_force_styles(self):
        self.check("dch on\nsuffix dch\n" + CHECKED, what="forces", steps=40)
        self.check("suffix dch\ndch off\n" + GAS, what="forces")

    def test_types_and_skewed_boxes(self):
        for script in (TWO_TYPES, SKEWED):
            self.check("dch on\n" + script, steps=40)

    def test_pairs_that_come_near(self):
        for engine in ("dch", "grid"):
            output = self.check(f"dch on engine {engine}\n" + GAS, steps=200)
            self.assertRegex(output, r"given up .*\d for a missing pair")

    def test_ghosts_in_open_space(self):
        for script, ranks in ((SMALL, 1), (GAS, 2), (CHECKED, 2), (GAS, 4)):
            output = self.check("dch on\n" + script, ranks=ranks)
            self.assertIn("owned atoms and ghosts in open space", output)
        self.check("dch on\ncomm_modify cutoff 4\n" + GAS, ranks=2, steps=200)

    def test_a_pair_that_no_process_sees(self):
        output = self.check("dch on\n" + TWO_ATOMS.format(first=9.99, second=13.315), ranks=2, saves=False)
        self.assertIn("1 for an atom near the last ghosts", output)
        seen = self.check("dch on\n" + TWO_ATOMS.format(first=9.99, second=13.315))
        self.assertIn("1 for a missing pair", seen)

    def test_another_image_than_the_listed_one(self):
        """In a box 6.7 wide atoms are listed that are 3.29 apart; their images, 3.41 apart, come near each other."""
        script = TWO_ATOMS.replace("block 0 20", "block 0 6.7").replace("set 3 0 0", "set -0.45 0 0") \
            .replace("set -1 0 0", "set 0.5 0 0").format(first=1, second=4.29)
        for newton in ("on", "off"):
            output = self.check(f"newton {newton}\ndch on\n" + script, steps=220, saves=False)
            self.assertIn("for what cannot be told", output)

    def test_ghosts_are_where_their_atoms_are(self):
        output = self.check("dch on\n" + TWO_ATOMS.format(first=9.4, second=12.758), ranks=2)
        self.assertIn("1 for a missing pair", output)

    def test_ghosts_whose_pairs_others_take(self):
        """The faster atom's process has the other one as a ghost, and no pair with it: the ghost is of a lower rank, or an
        image across the lower face of the box."""
        back = TWO_ATOMS.replace("set 3 0 0", "set -3 0 0").replace("set -1 0 0", "set 1 0 0")
        for first, second in ((10.6, 7.242), (0.6, 17.242)):
            output = self.check("dch on\n" + back.format(first=first, second=second), ranks=2)
            self.assertIn("1 for a missing pair", output)

    def test_ghosts_that_are_too_far_for_their_types(self):
        """Of two atoms of a type with a small cutoff, beside a pair of another that has LAMMPS send ghosts from farther off."""
        script = TWO_ATOMS.replace("create_box 1", "create_box 2").replace("mass 1", "create_atoms 2 single 2 1 1\n"
                                                                           "create_atoms 2 single 2 8 8\nmass *") \
            .replace("pair_coeff 1 1 1.0 1.0", "pair_coeff * * 1.0 1.0 2.5\npair_coeff 2 2 1 1 4.4")
        back = script.replace("set 3 0 0", "set -3 0 0").replace("set -1 0 0", "set 1 0 0")
        for text, first, second in ((script, 9.4, 12.76), (back, 10.66, 7.3), (back, 0.66, 17.3)):
            for ranks in (1, 2):
                output = self.check("dch on\n" + text.format(first=first, second=second), ranks=ranks)
                self.assertIn("1 for a missing pair", output)

    def test_grains(self):
        for ranks in (1, 2, 4):
            output = self.check("dch on\ndch verify yes\n" + GRAINS, what="lists", ranks=ranks, steps=400)
            self.assertIn("all equal", output)

    def test_grains_whose_pairs_others_take(self):
        """The faster grain's process has the other one as a ghost, and no pair with it."""
        back = TWO_GRAINS.replace("set 3 0 0", "set -3 0 0").replace("set -1 0 0", "set 1 0 0")
        for first, second in ((10.6, 7.242), (0.6, 17.242)):
            output = self.check("dch on\n" + back.format(first=first, second=second), what="lists", ranks=2)
            self.assertIn("1 for a missing pair", output)

    def test_a_blind_search_is_found_out(self):
        for what, ranks in (("lists", 1), ("forces", 1), ("lists", 2)):
            code, output = self.look("dch on\n" + GAS, what, steps=200, ranks=ranks, fault="blind")
            self.assertEqual(code, 3 if what == "lists" else 4, output[-2000:])
            if what == "lists":
                self.assertNotRegex(output, r"oracle: .* 0 missing")


class SameAsStock(unittest.TestCase):
    THERMO = "thermo 1\nthermo_modify norm no\n"

    def check_same(self, script, words="dch on\n", ranks=1, steps=60, tolerance=1e-9, fewer=True):
        lines = self.THERMO + f"run {steps}\n"
        code, stock = host.run_text(script + lines, ranks=ranks)
        self.assertEqual(code, 0, stock)
        code, ours = host.run_text("include ${load}\n" + words + script + lines + "dch stats\n", ranks=ranks)
        self.assertEqual(code, 0, ours)
        for native, kept in zip(thermo_tables(stock)[-1], thermo_tables(ours)[-1]):
            self.assertLess(largest_relative_difference(native, kept), tolerance, kept)
        if fewer:
            self.assertLess(builds(ours), builds(stock), ours)
        elif fewer is not None:
            self.assertEqual(builds(ours), builds(stock), ours)
        return ours

    def test_energies_at_every_step(self):
        for words, ranks in (("dch on\n", 1), ("dch on\nsuffix dch\n", 1), ("dch on\n", 2)):
            self.assertRegex(self.check_same(CHECKED, words, ranks), EXACT)
        self.check_same(CHECKED, "dch on\ndch expiry half\n", fewer=False)

    def test_delay(self):
        script = CHECKED.replace("delay 0", "delay 3")
        self.assertIn("Dangerous builds = 0", self.check_same(script))
        # The first look is LAMMPS's own, which by then misses pairs that cluster pairs hold.
        self.check_same(CHECKED.replace("delay 0", "delay 30"), "dch styles no\ndch on\n", fewer=False)

    def test_random_numbers_go_to_the_same_atoms(self):
        """Energies, and for longer than they stay the same to rounding the order of atoms in memory."""
        script = CHECKED.replace("atom_style atomic", "atom_style atomic\natom_modify sort 70 0") + \
            "fix 2 all langevin 1.0 1.0 1.0 4711\n"
        self.assertRegex(self.check_same(script), EXACT)
        orders = []
        for words in ("", "dch on\n"):
            dump = host.work / "dump.order"
            output = run(f"include ${{load}}\n{words}{script}dump 1 all custom 1 {dump} id\nrun 220\ndch stats\n")
            frames = dump.read_text().split("ITEM: ATOMS id\n")[1:]
            orders.append([frame.split("ITEM")[0] for frame in frames])
        self.assertTrue(orders[0] == orders[1])  # assertEqual takes minutes to say how texts differ
        self.assertGreater(len(set(orders[0])), 3)
        self.assertRegex(output, EXACT)

    def test_random_numbers_of_several_processes(self):
        script = CHECKED + "fix 2 all langevin 1.0 1.0 1.0 4711\n"
        ours = self.check_same(script, ranks=2, fewer=False)
        self.assertIn("half the skin: fix langevin may draw random numbers in the order of atoms", ours)
        code, told = host.run_text("include ${load}\ndch on\ndch expiry exact\n" + script + "run 60\ndch stats\n",
                                   ranks=2)
        self.assertEqual(code, 0, told)
        self.assertRegex(told, EXACT)

    def test_atoms_that_leave_for_good(self):
        script = GAS.replace("atom_style atomic", "atom_style atomic\nboundary f p p") \
            .replace("fix 1", "thermo_modify lost ignore\nfix 1")
        for ranks in (1, 2):
            ours = self.check_same(script.replace("block 0 3", "block -1 4"), ranks=ranks, steps=40, fewer=None)
            self.assertRegex(ours, EXACT)

    def test_minimization(self):
        script = CHECKED + "minimize 1e-8 1e-8 30 100\n"
        stock = thermo_tables(run(script))[-1][-1]
        ours = thermo_tables(run("include ${load}\ndch on\n" + script))[-1][-1]
        self.assertLess(largest_relative_difference(stock, ours), 1e-7)


class WhatIsInForce(unittest.TestCase):
    def check_reason(self, script, reason, words="dch on\n", steps=3):
        self.assertIn("half the skin: " + reason, run("include ${load}\n" + words + script + f"run {steps}\ndch stats\n"))

    def test_reasons_for_half_the_skin(self):
        for script, reason in (
                (MELT, "lists are rebuilt without a check (neigh_modify check no)"),
                (CHECKED.replace("every 1", "every 2"), "not every step is looked at (neigh_modify every 2)"),
                (CHECKED.replace("neighbor 0.3", "neighbor 0"), "the skin is 0"),
                (CHECKED + "fix 2 all deform 1 x scale 1.1\n", "the box changes"),
                (CHECKED + "run_style respa 2 2\n", "run_style respa does not look at lists at each step"),
                (CHECKED + "compute c all coord/atom cutoff 1.5\n", "compute coord/atom, full: not ours"),
                ("dch expiry half\n" + CHECKED, "'dch expiry half' was given")):
            self.check_reason(script, reason)

    def test_changes_between_runs(self):
        output = run("include ${load}\ndch on\n" + CHECKED + "run 30\ndch off\nrun 10 pre no\ndch stats\ndch on\n"
                     "run 30\ndch stats\ndch expiry half\nrun 30\ndch stats\n")
        self.assertIn("half the skin: 'dch off' was given", output)
        self.assertRegex(output, EXACT)
        self.assertIn("half the skin: 'dch expiry half' was given", output)
        stock = thermo_tables(run(CHECKED + "run 30\nrun 10 pre no\nrun 30\nrun 30\n"))
        for native, ours in zip(stock, thermo_tables(output)):
            self.assertLess(largest_relative_difference(native[-1], ours[-1]), 1e-7)

    def test_with_a_tuned_skin(self):
        output = run("include ${load}\ndch on\ndch skin auto\ndch verify yes\n" +
                     CHECKED.replace("neighbor 0.3", "neighbor 0.6") + "run 200\ndch stats\n")
        self.assertRegex(output, EXACT)
        self.assertIn("all equal", output)


if __name__ == "__main__":
    main(__doc__)
