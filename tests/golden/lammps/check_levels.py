#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""r-RESPA that splits the forces of pairs into levels, in a real LAMMPS: at every build the lists of all levels are
LAMMPS's, and runs are those of stock, with plain styles and with those of the suffix."""

import re
import unittest

from lammps_run import largest_relative_difference, thermo_tables
from script_tests import MELT, host, main

INNER = "respa 2 2 inner 1 1.5 2.0 outer 2"
# The middle level begins beyond the nearest neighbors, the skin taken off.
MIDDLE = "respa 3 2 2 inner 1 1.5 1.7 middle 2 1.9 2.1 outer 3"
NAMES = {INNER: "with an inner level", MIDDLE: "with inner and middle levels"}
OURS = {"lists": "dch styles no\n", "styles": "", "suffix": "suffix dch\n"}

TWO_TYPES = MELT.replace("create_box 1", "create_box 2").replace("mass 1", "mass *") \
    .replace("pair_coeff 1 1 1.0 1.0", "set type 1 type/fraction 2 0.3 4711\npair_coeff * * 1.0 1.0")
# A lattice of atoms of which many are bonded.
NETWORK = MELT.replace("atom_style atomic", "atom_style molecular\nspecial_bonds lj 0.0 1.0 1.0") \
    .replace("fcc 0.8442", "sc 0.7").replace("box block 0 6 0 6 0 6", "box block 0 8 0 8 0 8") \
    .replace("create_box 1 box", "create_box 1 box bond/types 1 extra/bond/per/atom 6 extra/special/per/atom 40") \
    .replace("pair_style lj/cut 2.5", "pair_style lj/cut 2.5\nbond_style harmonic\nbond_coeff 1 50.0 1.1") \
    .replace("neighbor 0.3 bin", "neighbor 0.3 bin\ngroup some id 1:300\ncreate_bonds many some some 1 0.9 1.15\n"
             "special_bonds lj {weights}\nset group some mol 1")
BONDED = "respa 4 2 2 2 bond 1 inner 2 1.5 1.7 middle 3 1.9 2.1 outer 4"


def overlay(second):
    """Two styles, each with levels: the second one for some pairs of types, or for all."""
    return TWO_TYPES.replace("pair_style lj/cut 2.5", "pair_style hybrid/overlay lj/cut 2.5 lj/cut 2.4") \
        .replace("pair_coeff * * 1.0 1.0", f"pair_coeff * * lj/cut 1 1.0 1.0\npair_coeff {second} lj/cut 2 0.1 1.0")


class Levels(unittest.TestCase):
    def check(self, script, style, ranks=1, builds=5, name=None, ours=("lists", "styles"), before="", rest=""):
        """A run of 20 steps: the same numbers as stock, and every list of every build is LAMMPS's."""
        script += f"run_style {style}\nrun 20\n{rest}"
        code, output = host.run_text(script, ranks=ranks)
        self.assertEqual(code, 0, output)
        stock = thermo_tables(output)
        for way in ours:
            with self.subTest(style=style, ranks=ranks, way=way, before=before):
                code, output = host.run_text(f"include ${{load}}\ndch on\n{before}dch verify yes\n{OURS[way]}{script}dch stats\n",
                                             ranks=ranks)
                self.assertEqual(code, 0, output)
                self.assertRegex(output, rf"list \d, [^:]*, {name or NAMES[style]}: DCH\n")
                self.assertRegex(output, rf"verified +{builds} builds, [1-9]\d* pairs, all equal")
                tables = thermo_tables(output)
                self.assertEqual(len(stock), len(tables))
                for native, own in zip(stock, tables):
                    self.assertEqual(len(native), len(own))
                    for first, second in zip(native, own):
                        self.assertLess(largest_relative_difference(first, second), 1e-9)
        return output


class Lists(Levels):
    def test_melt(self):
        for style in NAMES:
            for newton in ("on", "off"):
                for ranks in (1, 2, 4):
                    self.check(f"newton {newton}\n" + MELT, style, ranks, ours=OURS if ranks == 2 else ("lists", "styles"))

    def test_bonds(self):
        """Pairs with weights are marked in the lists of all levels; those with weight 0 are in none."""
        for weights, newton, processes in (("0.0 0.3 0.7", "on", (1, 2, 4)), ("0.0 0.3 0.7", "off", (1, 2, 4)),
                                           ("0.0 0.3 0.7", "off on", (2,)), ("0.0 1.0 1.0", "on", (1, 2))):
            for ranks in processes:
                self.check(f"newton {newton}\n" + NETWORK.format(weights=weights), BONDED, ranks, name=NAMES[MIDDLE])

    def test_exclusions(self):
        for exclude in ("type 1 2", "group few few"):
            for ranks in (1, 2):
                self.check(TWO_TYPES + f"group few id 1:300\nneigh_modify exclude {exclude}\n", MIDDLE, ranks)
        for ranks in (1, 2):
            self.check(NETWORK.format(weights="0.2 0.3 0.7") + "neigh_modify exclude molecule/intra some\n", BONDED, ranks,
                       name=NAMES[MIDDLE])

    def test_the_group_that_stands_first_in_memory(self):
        script = TWO_TYPES.replace("neigh_modify", "group odd type 2\natom_modify first odd\nneigh_modify include odd\nneigh_modify")
        for ranks in (1, 2):
            self.check(script.replace("fix 1 all", "fix 1 odd"), MIDDLE, ranks)

    def test_several_styles(self):
        """Lists of all types, of which each style has its own, and parts that LAMMPS makes from ours."""
        for style, second, newton in ((INNER, "* *", "on"), (MIDDLE, "* *", "off"), (INNER, "1 1", "off"), (MIDDLE, "1 1", "on")):
            for ranks in (1, 2):
                self.check(f"newton {newton}\n" + overlay(second), style, ranks)
        parts = overlay("1 1").replace("pair_style hybrid/overlay", "pair_style hybrid")
        self.check(parts, MIDDLE, 2)

    def test_cutoffs_by_type(self):
        script = TWO_TYPES.replace("neighbor 0.3", "pair_coeff 1 2 1.0 1.0 2.3\npair_coeff 2 2 1.0 1.0 2.15\nneighbor 0.3")
        for ranks in (1, 2):
            self.check(script, MIDDLE, ranks)

    def test_boxes(self):
        tilted = MELT.replace("box block 0 6 0 6 0 6", "box prism 0 6 0 6 0 6 2 -1 1.5")
        narrow = MELT.replace("0 6 0 6 0 6", "0 3 0 3 0 8")  # of some atoms two images are near
        free = MELT.replace("units lj", "units lj\nboundary s s s")
        slow = MELT.replace("neighbor 0.3 bin", "neighbor 0.3 nsq")
        for script in (tilted, narrow, free, slow):
            for newton, ranks in (("on", 1), ("off", 1), ("on", 2)):
                self.check(f"newton {newton}\n" + script, MIDDLE, ranks, ours=("lists",))

    def test_two_dimensions(self):
        flat = MELT.replace("units lj", "units lj\ndimension 2").replace("fcc 0.8442", "sq2 0.8442") \
            .replace("0 6 0 6 0 6", "0 12 0 12 -0.5 0.5") + "fix 2 all enforce2d\n"
        for ranks in (1, 2):
            self.check(flat, MIDDLE, ranks)

    def test_a_skin_wider_than_the_middle_level_begins(self):
        """Then it has no bound inside."""
        self.check(MELT.replace("neighbor 0.3", "neighbor 1.6"), MIDDLE, 1)

    def test_pairs_at_the_bounds(self):
        """In a crystal many pairs are at a bound to within rounding, which side has them decides."""
        crystal = MELT.replace("fcc 0.8442", "sc 0.7513148009015778").replace("0 6 0 6 0 6", "0 8 0 8 0 8") \
            .replace("velocity all create 1.44", "velocity all create 0.01")
        for style in ("respa 2 2 inner 1 1.5 1.9 outer 2", "respa 3 2 2 inner 1 1.4 1.6 middle 2 1.7 1.9 outer 3"):
            for ranks in (1, 2, 4):
                self.check(crystal, style, ranks, name=NAMES[MIDDLE if "middle" in style else INNER], ours=("lists",))

    def test_few_neighbors(self):
        """Short rows stand in the order of atoms."""
        self.check(MELT.replace("lj/cut 2.5", "lj/cut 1.3"), "respa 2 2 inner 1 1.1 1.2 outer 2", 1, name=NAMES[INNER])

    def test_settings(self):
        for before in ("dch on engine grid\n", "dch on engine auto\n", "dch threads 2\n", "dch order yes\n"):
            for ranks in (1, 2):
                self.check(MELT, MIDDLE, ranks, before=before, ours=("lists",))

    def test_a_tuned_skin(self):
        script = MELT.replace("every 5 check no", "every 1 check yes").replace("neighbor 0.3", "neighbor 0.6")
        code, output = host.run_text(f"include ${{load}}\ndch on\ndch styles no\ndch skin auto\ndch verify yes\n{script}"
                                     f"run_style {MIDDLE}\nrun 200\ndch stats\n")
        self.assertEqual(code, 0, output)
        self.assertRegex(output, r"skin +0\.\d+, ")
        self.assertRegex(output, r"verified +\d+ builds, \d+ pairs, all equal")

    def test_long_range_charges(self):
        solvated = ("units real\natom_style full\npair_style lj/charmm/coul/long 8.0 10.0 10.0\npair_modify table 0\n"
                    "bond_style harmonic\nangle_style charmm\ndihedral_style charmm\nimproper_style harmonic\n"
                    "kspace_style pppm 0.0001\nread_data ${examples}/peptide/data.peptide\ndihedral_style zero\ndihedral_coeff *\nneighbor 2.0 bin\n"
                    "neigh_modify delay 0 every 5 check no\ntimestep 1.0\nvelocity all create 275.0 4711 loop geom\n"
                    "fix 1 all nve\nthermo 20\nthermo_modify format float %.15g\n")
        style = "respa 4 2 2 2 bond 1 inner 2 4.0 5.0 middle 3 6.5 7.5 outer 4"
        for ranks, way in ((1, "styles"), (2, "lists")):
            self.check(solvated, style, ranks, name=NAMES[MIDDLE], ours=(way,))


class Runs(Levels):
    def test_is_explained(self):
        for style, name in NAMES.items():
            code, output = host.run_text(f"include ${{load}}\nsuffix dch\n{MELT}dch on\nrun_style {style}\nrun 20\ndch explain\n")
            self.assertEqual(code, 0, output)
            self.assertRegex(output, f"list 1, pair lj/cut/dch, half, newton on, {name}: DCH\n")
            self.assertIn("pair lj/cut/dch: plain style on a neighbor list, as r-RESPA splits the forces of pairs into levels; "
                          "give all pair forces one level ('run_style respa ... pair N')\n", output)
            self.assertRegex(output, "fix 1, nve/dch: .*plain style")

    def test_levels_that_come_and_go(self):
        rest = f"run_style verlet\nrun 20\nrun_style {INNER}\nrun 20\ndch off\nrun 10\ndch on\nrun_style {MIDDLE}\nrun 20\n"
        stock_rest = rest.replace("dch off\n", "").replace("dch on\n", "")
        for ranks in (1, 2):
            start = f"{MELT}run_style {MIDDLE}\nrun 20\n"
            code, output = host.run_text(start + stock_rest, ranks=ranks)
            self.assertEqual(code, 0, output)
            stock = thermo_tables(output)
            for way, words in OURS.items():
                with self.subTest(way=way, ranks=ranks):
                    code, output = host.run_text(f"include ${{load}}\n{words}dch on\ndch verify yes\n{start}{rest}", ranks=ranks)
                    self.assertEqual(code, 0, output)
                    for native, own in zip(stock, thermo_tables(output)):
                        self.assertLess(largest_relative_difference(native[-1], own[-1]), 1e-9)

    def test_one_level_takes_cluster_pairs(self):
        for script, style in ((MELT, "respa 2 2 pair 2"), (overlay("1 1"), "respa 2 2 pair 1"), (overlay("* *"), "respa 2 2 hybrid 1 2")):
            for ranks in (1, 2):
                stock = thermo_tables(host.run_text(f"{script}run_style {style}\nrun 20\n", ranks=ranks)[1])
                code, output = host.run_text(f"include ${{load}}\ndch on\ndch verify yes\n{script}run_style {style}\nrun 20\n"
                                             "dch stats\n", ranks=ranks)
                self.assertEqual(code, 0, output)
                self.assertIn("pair lj/cut/dch, cluster pairs: DCH", output)
                self.assertLess(largest_relative_difference(stock[0][-1], thermo_tables(output)[0][-1]), 1e-9)

    def test_stresses_by_atom(self):
        atoms = "compute e all pe/atom\ncompute s all stress/atom NULL virial\ncompute all all reduce sum c_e c_s[1] c_s[2]\n" \
                "thermo_style custom step epair press c_all[1] c_all[2] c_all[3]\nthermo_modify format float %.15g\n"
        for newton in ("on", "off"):
            for ranks in (1, 2):
                self.check(f"newton {newton}\n{MELT}{atoms}", MIDDLE, ranks)

    def test_minimization(self):
        script = f"{MELT}run_style {MIDDLE}\nrun 20\nminimize 0.0 1e-6 20 100\nrun 20\n"
        stock = thermo_tables(host.run_text(script)[1])
        for words in OURS.values():
            code, output = host.run_text(f"include ${{load}}\ndch on\ndch verify yes\n{words}{script}")
            self.assertEqual(code, 0, output)
            for native, own in zip(stock, thermo_tables(output)):
                self.assertLess(largest_relative_difference(native[-1], own[-1]), 1e-7)

    def cause(self, words, script, ranks=1):
        code, output = host.run_text(words + script, ranks=ranks)
        self.assertNotEqual(code, 0, output)
        return re.search(r"^ERROR.*", output, re.MULTILINE)[0]

    def test_what_stock_refuses(self):
        """Cutoffs beyond that of pairs or in the wrong order, levels without an outer one, styles and lists without."""
        several = MELT.replace("neighbor 0.3 bin", "neighbor 0.3 multi")
        other = MELT.replace("pair_style lj/cut 2.5", "pair_style morse 2.5").replace("1.0 1.0\nneighbor", "1.0 5.0 1.1\nneighbor")
        for script, style in ((MELT, "respa 2 2 inner 1 2.4 2.7 outer 2"), (MELT, "respa 2 2 inner 1 2.0 1.5 outer 2"),
                              (MELT, "respa 2 2 inner 1 1.5 2.0"), (MELT, "respa 2 2 middle 1 1.5 2.0 outer 2"),
                              (MELT, "respa 3 2 2 inner 1 1.2 1.9 middle 2 1.8 2.0 outer 3"),
                              (several, MIDDLE), (other, INNER)):
            script += f"run_style {style}\nrun 20\n"
            stock = self.cause("", script)
            for words in OURS.values():
                self.assertEqual(self.cause("include ${load}\ndch on\n" + words, script), stock)


if __name__ == "__main__":
    main(__doc__)
