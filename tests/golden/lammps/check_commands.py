#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""The command `dch` in a real LAMMPS.

More than 300 lines: CTest runs the classes one by one, and all share the scripts that they vary."""

import re
import unittest

from lammps_run import largest_relative_difference, thermo_tables
from script_tests import MELT, host, main, run


class OrderOfAtoms(unittest.TestCase):
    """`dch order`: what it puts in which order, and that nothing else changes."""

    MELT = MELT.replace("neigh_modify delay 0 every 5 check no", "neigh_modify delay 0 every 1 check yes\n"
                        "atom_modify sort 10 0\ncompute p all pe/atom")
    ORDERED = "atoms in memory         in the order of the structure"

    @staticmethod
    def last_frame(script, ranks=1):
        """IDs in the order of memory, the last line of thermo output, (vx, energy) by atom, and all output."""
        dump = host.work / "dump.order"
        code, output = host.run_text(f"include ${{load}}\n{script}dump 1 all custom 60 {dump} id vx c_p\n"
                                     "thermo_modify norm no\nrun 60\ndch stats\n", ranks=ranks)
        if code != 0:
            raise AssertionError(output)
        rows = [line.split() for line in dump.read_text().split("ITEM: ATOMS id vx c_p\n")[-1].splitlines()]
        return ([row[0] for row in rows], thermo_tables(output)[-1][-1],
                {row[0]: list(map(float, row[1:])) for row in rows}, output)

    def test_same_trajectory(self):
        skewed = self.MELT.replace("block 0 6 0 6 0 6", "prism 0 6 0 6 0 6 1.5 -1 0.5")
        unchecked = self.MELT.replace("every 1 check yes", "every 5 check no")
        for script, ranks in ((self.MELT, 1), (self.MELT, 2), (skewed, 1), (skewed, 2), (unchecked, 1)):
            stock_order, stock_thermo, stock_values, _ = self.last_frame(script, ranks)
            for words in ("dch on\ndch verify yes\n", "suffix dch\ndch off\n"):
                with self.subTest(words=words, ranks=ranks):
                    order, thermo, values, output = self.last_frame(words + script, ranks)
                    self.assertIn(self.ORDERED, output)
                    self.assertNotEqual(stock_order, order)
                    self.assertEqual(sorted(stock_order), sorted(order))
                    self.assertLess(largest_relative_difference(stock_thermo, thermo), 1e-9)
                    for atom, wanted in stock_values.items():
                        for first, second in zip(wanted, values[atom]):
                            self.assertLess(abs(first - second), 1e-5)

    def test_no_is_the_order_of_stock(self):
        stock = self.last_frame(self.MELT)
        ours = self.last_frame(self.MELT + "dch on\ndch order no\n")
        self.assertEqual(stock[0], ours[0])
        self.assertIn("in LAMMPS's order: 'dch order no' was given", ours[3])

    def test_few_neighbors_leave_the_order_of_stock(self):
        few = "dch expiry half\n" + self.MELT.replace("lj/cut 2.5", "lj/cut 1.2")  # builds at the steps of stock
        for ranks in (1, 2):
            stock = self.last_frame(few, ranks)
            alone = self.last_frame("dch styles no\ndch on\ndch verify yes\n" + few, ranks)
            told = self.last_frame("dch styles no\ndch on\ndch order yes\n" + few, ranks)
            self.assertEqual(stock[0], alone[0])
            self.assertIn("neighbors are few, and rows are put in the order of atoms ('dch order yes')", alone[3])
            self.assertLess(largest_relative_difference(stock[1], alone[1]), 1e-9)
            self.assertNotEqual(stock[0], told[0])
            self.assertIn(self.ORDERED, told[3])

    def test_random_numbers_by_atom(self):
        thermostat = self.MELT + "fix 2 all langevin 1.0 1.0 1.0 4711\n"
        stock = self.last_frame(thermostat)
        alone = self.last_frame(thermostat + "dch on\n")
        told = self.last_frame(thermostat + "dch on\ndch order yes\n")
        self.assertEqual(stock[0], alone[0])
        self.assertIn("fix langevin may draw random numbers in the order of atoms ('dch order yes')", alone[3])
        self.assertLess(largest_relative_difference(stock[1], alone[1]), 1e-9)
        self.assertNotEqual(stock[0], told[0])
        self.assertIn(self.ORDERED, told[3])

    def test_bonded_atoms_stay_where_they_are(self):
        script = "include ${here}/in.chain\n"
        for words in ("auto", "yes"):
            output = run(f"include ${{load}}\ndch order {words}\n" + script, variables={"lists": "dch", "steps": 20})
            self.assertEqual("atoms have bonds" in output, words == "auto")
            self.assertEqual(self.ORDERED in output, words == "yes")

    def test_sorting_that_is_off_stays_off(self):
        output = self.last_frame(self.MELT.replace("sort 10 0", "sort 0 0") + "dch on\n")[3]
        self.assertIn("in LAMMPS's order: 'atom_modify sort' is off", output)

    def test_contacts_of_grains_follow_their_atoms(self):
        lines = {}
        for words in ("no", "yes"):
            output = run(f"include ${{load}}\ndch order {words}\natom_modify sort 40 0\ninclude ${{here}}/in.granular\n",
                         variables={"lists": "dch", "steps": 200})
            self.assertEqual(self.ORDERED in output, words == "yes")
            lines[words] = thermo_tables(output)[-1][-1]
        self.assertLess(largest_relative_difference(lines["no"], lines["yes"]), 1e-9)

    def test_minimization(self):
        script = self.MELT + "minimize 1e-8 1e-8 30 100\n"
        stock = thermo_tables(run(script))[-1][-1]
        ours = thermo_tables(run("include ${load}\ndch on\ndch verify yes\n" + script))[-1][-1]
        self.assertLess(largest_relative_difference(stock, ours), 1e-7)


class Errors(unittest.TestCase):
    def test_words_that_mean_nothing(self):
        for words, remedy in (("", "give 'dch on', 'dch on engine dch|grid|auto', 'dch off'"),
                              ("threads none", "the number of threads is 'none'"),
                              ("precision half", "does not know 'half'"),
                              ("of", "unknown keyword 'of'"),
                              ("off now", "'now' after 'dch off' has no meaning"),
                              ("explain all", "'all' after 'dch explain' has no meaning"),
                              ("on c", "'dch on c' lacks its value, which has no effect any more"),
                              ("on fast", "unknown option 'fast'"),
                              ("on engine tree", "'dch on engine' does not know 'tree'; give 'dch on engine dch'"),
                              ("verify", "give 'dch verify yes'"),
                              ("verify maybe", "does not know 'maybe'"),
                              ("verify every 0", "the interval is '0' but has to be a whole number from 1 up")):
            with self.subTest(words=words):
                code, output = host.run_text(f"include ${{load}}\ndch {words}\n")
                self.assertNotEqual(code, 0)
                self.assertIn("ERROR: Illegal dch command: ", output)
                self.assertIn(remedy, output)

    def test_template_molecules_are_refused(self):
        molecule = host.work / "dimer.mol"
        molecule.write_text("# dimer\n\n2 atoms\n1 bonds\n\nCoords\n\n1 0 0 0\n2 1 0 0\n\nTypes\n\n1 1\n2 1\n\n"
                            "Bonds\n\n1 1 1 2\n\nSpecial Bond Counts\n\n1 1 0 0\n2 1 0 0\n\n"
                            "Special Bonds\n\n1 2\n2 1\n")
        code, output = host.run_text(f"""
include ${{load}}
units lj
molecule dimer {molecule}
atom_style template dimer
region box block 0 10 0 10 0 10
create_box 1 box bond/types 1 extra/bond/per/atom 1 extra/special/per/atom 1
create_atoms 0 single 2 2 2 mol dimer 777
mass 1 1.0
pair_style lj/cut 2.5
pair_coeff 1 1 1.0 1.0
bond_style harmonic
bond_coeff 1 100 1
dch on
run 0
""")
        self.assertNotEqual(code, 0)
        self.assertIn("do not know the bonds of atom_style template", output)


class Settings(unittest.TestCase):
    def test_on_and_off_between_runs(self):
        stock = run(MELT + "run 20\n" * 5)
        output = run("include ${load}\n" + MELT + """
run 20
dch on
dch verify yes
run 20
dch stats
dch off
run 20
dch stats
dch on c 1.3
run 20
dch stats
run 20
""")
        self.assertEqual(output.count("DCH neighbor lists: on, verified at every build"), 2)
        self.assertEqual(output.count("DCH neighbor lists: off, verified at every build"), 1)
        self.assertEqual(output.count("verified                5 builds"), 2)
        self.assertEqual(output.count("'dch on c' has no effect any more"), 1)
        for native, ours in zip(thermo_tables(stock), thermo_tables(output)):
            self.assertLess(largest_relative_difference(native[-1], ours[-1]), 1e-9)

    def test_on_and_off_without_a_new_setup(self):
        stock = run(MELT + "run 20\n" + "run 20 pre no\n" * 4)
        output = run("include ${load}\n" + MELT + """
run 20
dch on
dch verify yes
run 20 pre no
dch off
run 20 pre no
dch on
run 20 pre no
dch off
run 20 pre no
""")
        for native, ours in zip(thermo_tables(stock), thermo_tables(output)):
            self.assertLess(largest_relative_difference(native[-1], ours[-1]), 1e-9)

    def test_off_takes_effect_without_a_new_setup(self):
        output = run("include ${load}\n" + MELT + """
dch on
run 20
dch stats
dch off
run 20 pre no
dch stats
dch on
run 20 pre no
dch stats
""")
        self.assertEqual(output.count("builds in the last run  5"), 2)
        self.assertIn("builds in the last run  9", output)

    def test_a_tuned_skin_loses_no_pair(self):
        script = MELT.replace("every 5 check no", "every 2 check yes").replace("neighbor 0.3", "neighbor 0.6")
        for extra in ("", "fix 2 all deform 1 x scale 1.2\n"):
            output = run("include ${load}\ndch on\ndch skin auto\ndch verify yes\n" + script + extra +
                         "run 600\ndch stats\n")
            self.assertIn("all equal", output)
            self.assertRegex(output, r"skin +0\.\d+, ")
            self.assertIn("Dangerous builds = 0", output)
            fixed = thermo_tables(run(script.replace("neighbor 0.6", "neighbor 1.0") + extra + "run 40\n"))
            tuned = thermo_tables(run("include ${load}\ndch on\ndch skin auto\n" + script + extra + "run 40\n"))
            self.assertLess(largest_relative_difference(fixed[0][-1], tuned[0][-1]), 1e-8)

    def test_a_skin_that_may_not_change(self):
        output = run("include ${load}\ndch on\ndch skin auto\n" + MELT + "run 10\ndch stats\n")
        self.assertIn("the skin stays as it is: lists are rebuilt without a check", output)
        self.assertNotRegex(output, r"skin +0\.\d+, ")

    def test_threads_change_nothing(self):
        for styles in ("dch on\n", "suffix dch\n"):
            # So many that forces are computed in several tasks.
            script = styles + "dch threads {}\n" + MELT + "replicate 2 2 1\nrun 40\n"
            tables = [thermo_tables(run("include ${load}\n" + script.format(n))) for n in (1, 3)]
            self.assertEqual(tables[0], tables[1])

    def test_threads_change_between_runs(self):
        output = run("include ${load}\n" + MELT + "dch on\ndch verify yes\nrun 10\ndch threads 2\nrun 10\n"
                     "dch threads 1\nrun 10\ndch stats\n")
        self.assertIn("all equal", output)

    def test_verify_at_every_nth_build(self):
        output = run("include ${load}\n" + MELT + "dch on\ndch verify every 3\nrun 40\ndch stats\n")
        self.assertIn("verified at every 3th build", output)
        self.assertIn("builds in the last run  9", output)
        self.assertIn("verified                3 builds", output)

    def test_clear_restores_stock_lists(self):
        stock = run(MELT + "run 20\n")
        output = run("include ${load}\n" + MELT + "dch on\nrun 20\nclear\n" + MELT + "run 20\ndch stats\nclear\n" +
                     MELT + "dch on\nrun 20\ndch stats\n")
        tables = thermo_tables(output)
        self.assertEqual(tables[1], thermo_tables(stock)[0])
        self.assertEqual(output.count("DCH neighbor lists: off"), 1)
        self.assertEqual(output.count("half, newton on: DCH"), 1)

    def test_stats_before_any_run(self):
        output = run("include ${load}\ndch stats\n")
        self.assertIn("DCH neighbor lists: off", output)
        self.assertIn("they are assigned when a run begins", output)

    def test_minimization_and_changing_cutoffs(self):
        output = run("include ${load}\n" + MELT + """
dch on
dch verify yes
minimize 0 0 30 100
pair_coeff 1 1 1.0 1.0 1.8
run 20
neighbor 0.6 bin
run 20
dch stats
""")
        self.assertIn("radius 2.4,", output)


class Engines(unittest.TestCase):
    """`dch on engine`: what is taken, that `dch stats` says so, and that no change of engine changes the pairs."""

    # A melt whose box widens around it: its density is even at first, and no longer so later.
    WIDENING = MELT.replace("every 5 check no", "every 1 check yes") + \
        "fix 2 all deform 1 x scale 2.5 y scale 2.5 z scale 2.5 remap none\n"

    def run_on(self, text, ranks):
        code, output = host.run_text(text, ranks=ranks)
        self.assertEqual(code, 0, output)
        return output

    def check_same(self, stock, output, tolerance):
        native, ours = thermo_tables(stock), thermo_tables(output)
        self.assertEqual(len(native), len(ours), output)
        for first, second in zip(native, ours):
            self.assertLess(largest_relative_difference(first[-1], second[-1]), tolerance, output)

    def test_change_between_runs(self):
        for ranks in (1, 2):
            stock = self.run_on(MELT + "run 20\n" * 5, ranks)
            output = self.run_on("include ${load}\n" + MELT + "dch verify yes\n" +
                                 "".join(f"dch on{engine}\nrun 20\ndch stats\n"
                                         for engine in (" engine grid", "", " engine auto", " engine grid")) +
                                 "dch on\nrun 20 pre no\ndch stats\n", ranks)
            self.check_same(stock, output, 1e-9)
            self.assertEqual(output.count("verified                5 builds"), 4, output)
            engines = re.findall(r"^  engine +(\S+)", output, re.MULTILINE)
            unnamed = "dch" if ranks == 1 else "auto,"
            self.assertEqual(engines, ["grid", unnamed, "auto,", "grid", "grid"])  # no new setup, no new engine

    def test_auto_changes_in_the_middle_of_a_run(self):
        script = self.WIDENING + "{}run 1\n{stats}run 99 pre no\n{stats}"
        for ranks in (1, 2):
            stock = self.run_on(script.format("", stats=""), ranks)
            for verify in ("yes", "no"):
                output = self.run_on("include ${load}\n" + script.format(f"dch on engine auto\ndch verify {verify}\n",
                                                                        stats="dch stats\n"), ranks)
                self.check_same(stock, output, 1e-6)
                early, late = re.findall(r"^  engine +auto, (.*)", output, re.MULTILINE)
                self.assertIn("grid: ", early)
                self.assertNotIn("distances of the hierarchy", early)
                self.assertIn("distances of the hierarchy", late)  # which has thus been in use since

    def test_auto_takes_the_hierarchy_for_cluster_pairs(self):
        for ranks in (1, 2):
            stock = self.run_on(MELT + "run 20\n" * 2, ranks)
            output = self.run_on("include ${load}\ndch verify yes\nsuffix dch\n" + MELT +
                                 "dch on engine auto\nrun 20\nrun 20\ndch stats\n", ranks)
            self.check_same(stock, output, 1e-9)
            self.assertIn("pair lj/cut/dch, cluster pairs: DCH", output)
            self.assertRegex(output, "engine +auto, .*dch: cluster pairs are asked for")

    def test_a_grid_is_refused_for_cluster_pairs(self):
        with_style = "suffix dch\n" + MELT + "dch on engine grid\nrun 20\n"
        later = MELT + "dch on engine grid\nrun 20\nsuffix dch\n" \
            "pair_style none\npair_style lj/cut 2.5\npair_coeff 1 1 1.0 1.0\nrun 20\n"
        for script, ranks in ((with_style, 1), (with_style, 2), (later, 1)):
            code, output = host.run_text("include ${load}\n" + script, ranks=ranks)
            self.assertNotEqual(code, 0, output)
            self.assertIn("the engine 'grid' makes no cluster pairs", output)
            self.assertIn("give 'dch on engine auto'", output)
        off = run("include ${load}\n" + with_style.replace("run 20", "dch off\nrun 20\ndch stats"))
        self.assertRegex(off, r"engine +dch\n")


class WithoutBins(unittest.TestCase):
    DROP_AND_FAR_ATOM = """
units lj
boundary s s s
atom_style atomic
atom_modify sort 0 0.0
lattice fcc 0.8442
region box block 0 7e5 0 7e5 0 7e5
create_box 1 box
region drop block 0 6 0 6 0 6
create_atoms 1 region drop
create_atoms 1 single 1e6 1e6 1e6 units box
mass 1 1.0
pair_style lj/cut 2.5
pair_coeff 1 1 1.0 1.0
neigh_modify delay 0 every 5 check no
fix 1 all nve
"""

    def test_an_atom_far_away_stops_stock_lists_only(self):
        code, output = host.run_text(self.DROP_AND_FAR_ATOM + "run 20\n")
        self.assertNotEqual(code, 0)
        self.assertIn("Too many neighbor bins", output)
        output = run("include ${load}\n" + self.DROP_AND_FAR_ATOM + "dch on\nrun 20\ndch stats\n")
        self.assertIn("builds in the last run  5", output)


    DROPLET = """
units lj
atom_style atomic
atom_modify sort 0 0.0
lattice fcc 0.8442
variable half equal 10*v_wide
region box block -${half} ${half} -${half} ${half} -${half} ${half}
create_box 1 box
region drop sphere 0 0 0 7
create_atoms 1 region drop
mass 1 1.0
velocity all create 0.7 4711
pair_style lj/cut 2.5
pair_coeff 1 1 1.0 1.0
neigh_modify delay 0 every 5 check no
fix 1 all nve
"""

    def test_a_wide_box_takes_no_memory(self):
        memory = []
        for wide in (1, 100):
            output = run("include ${load}\n" + self.DROPLET + "dch on\nrun 20\ndch stats\n", variables={"wide": wide})
            memory.append(float(re.search(r"^ +memory +(\S+) Mbytes$", output, re.MULTILINE).group(1)))
        self.assertGreater(memory[0], 0.5)
        self.assertLess(memory[1], 1.5 * memory[0])
        code, output = host.run_text(self.DROPLET + "run 20\n", variables={"wide": 100})
        self.assertNotEqual(code, 0)
        self.assertIn("Too many neighbor bins", output)


class SearchStyles(unittest.TestCase):
    """Bins and stencils that are hidden from LAMMPS must not be missed by it, so without `dch verify`."""

    TWO_TYPES = MELT.replace("create_box 1", "create_box 2").replace("mass 1", "mass *") \
        .replace("pair_coeff 1 1 1.0 1.0", "set type 1 type/fraction 2 0.2 4711\npair_coeff 1 1 1 0.8 1.0\n"
                 "pair_coeff 1 2 1 0.9 1.7\npair_coeff 2 2 1.0 1.0 2.5")

    def test_same_energies(self):
        for style in ("bin", "nsq", "multi", "multi/old"):
            script = self.TWO_TYPES.replace("neighbor 0.3 bin", f"neighbor 0.3 {style}") + "run 40\n"
            stock, ours = (thermo_tables(run("include ${load}\n" + on + script)) for on in ("", "dch on\n"))
            self.assertLess(largest_relative_difference(stock[0][-1], ours[0][-1]), 1e-9)


class NativeLists(unittest.TestCase):
    def check_reason(self, script, reason):
        self.assertIn(reason, run("include ${load}\n" + script + "dch stats\n"))

    def test_atoms_without_ids(self):
        script = MELT.replace("atom_style atomic", "atom_style atomic\natom_modify id no")
        self.check_reason(script + "dch on\nrun 20\n", "native, atoms have no IDs (atom_modify id no)")

    def test_lists_of_computes_are_built_on_demand(self):
        self.check_reason(MELT + "compute cn all coord/atom cutoff 1.5\ncompute most all reduce max c_cn\n"
                          "thermo_style custom step temp c_most\ndch on\ndch verify yes\nrun 20\n",
                          "compute coord/atom, full: native, built on demand only")


class Faults(unittest.TestCase):
    """A search that makes one mistake at its third list, which is at step 10."""

    def run_faulty(self, kind, ranks):
        script = host.work / "in.faulty"
        script.write_text(MELT + "dch on\ndch verify yes\nrun 20\n")
        return host.run(ranks, [host.tools / "lmp_faulty", kind, "-in", script])

    def test_a_good_search_passes(self):
        code, output = self.run_faulty("none", 1)
        self.assertEqual(code, 0, output)

    def test_a_missing_pair_is_found(self):
        for ranks in (1, 2):
            code, output = self.run_faulty("drop", ranks)
            self.assertNotEqual(code, 0, output)
            self.assertRegex(output, r"dch verify: at step 10 .*pair lj/cut, half, newton on.*: [12] pairs differ, "
                             r"the first: pair of atoms \d+ and \d+ at distance [12]\.\d+, special bits 0: "
                             r"in the native list")

    def test_a_repeated_pair_is_found(self):
        code, output = self.run_faulty("repeat", 1)
        self.assertNotEqual(code, 0, output)
        self.assertRegex(output, r"dch verify: at step 10 .* 2 pairs differ, .*list only")


if __name__ == "__main__":
    main(__doc__)
