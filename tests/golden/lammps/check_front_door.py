#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""`dch on` and nothing else at the top of a script: which styles it takes, that the script goes on as in stock LAMMPS
under the names that it uses, and how it says no."""

import unittest

from lammps_run import largest_relative_difference, thermo_tables
from script_tests import MELT, host, main, run

LOADED = "include ${load}\n"
LATEST = MELT.replace("every 5 check no", "every 1 check yes")
SORTED = LATEST + "atom_modify sort 10 0\n"
TAKEN = "; taken by 'dch on' in place of {} ('dch styles no')"
EXPLAINED = "run 20\ndch explain\n"


def line_of(output, beginning):
    """What the last `dch explain` says of a list or style."""
    lines = [line for line in output.splitlines() if line.startswith(f"  {beginning}: ")]
    if not lines:
        raise AssertionError(f"no line '{beginning}' in\n{output}")
    return lines[-1].split(": ", 1)[1]


class FrontDoor(unittest.TestCase):
    def same(self, first, second, tolerance=1e-9):
        tables = [thermo_tables(output) for output in (first, second)]
        self.assertEqual(len(tables[0]), len(tables[1]))
        for columns in zip(*(table[-1] for table in tables)):
            self.assertLess(largest_relative_difference(*columns), tolerance)

    def test_styles_are_taken_and_named(self):
        stock = run(LATEST + "run 20\n")
        for ranks in (1, 2):
            output = run(LOADED + "dch on\n" + LATEST + EXPLAINED, ranks=ranks)
            self.assertIn("DCH takes pair lj/cut/dch in place of the plain style", output)
            self.assertIn("DCH takes nve/dch in place of the plain style", output)
            self.assertRegex(line_of(output, "pair lj/cut/dch"), "^cluster pairs, in double precision")
            self.assertTrue(line_of(output, "pair lj/cut/dch").endswith(TAKEN.format("lj/cut")))
            self.assertTrue(line_of(output, "fix 1, nve/dch").endswith(TAKEN.format("nve")))
            self.same(stock, output)

    def test_bonds_and_angles(self):
        variables = {"steps": 20, "lists": "stock"}
        stock = run("include ${here}/in.chain\n", variables=variables)
        output = run(LOADED + "dch on\ndch verify yes\ninclude ${here}/in.chain\ndch explain\ndch stats\n",
                     variables=variables)
        self.assertRegex(line_of(output, "bond fene/dch"), "^SIMD kernel .*; taken by 'dch on' in place of fene")
        self.assertRegex(line_of(output, "pair lj/cut/dch"), "^pairs one by one")
        self.assertIn("all equal", output)
        self.same(stock, output)

    def test_package_opt_where_there_is_no_style_of_ours(self):
        script = LATEST.replace("lj/cut 2.5", "ufm 2.5").replace("pair_coeff 1 1 1.0 1.0", "pair_coeff 1 1 100.0 1.0")
        output = run(LOADED + "dch on\n" + script + EXPLAINED)
        self.assertEqual(line_of(output, "pair ufm/opt"), "native" + TAKEN.format("ufm").replace(";", ","))
        self.assertEqual(line_of(output, "list 1, pair ufm, half, newton on"), "DCH")
        self.same(run(script + "run 20\n"), output)
        output = run(LOADED + script + "dch on\n" + EXPLAINED)
        self.assertIn("give 'suffix opt' before it for ufm/opt", line_of(output, "pair ufm"))

    def test_names_stay_those_of_the_script(self):
        """Computes and fixes find styles by them, and a stock LAMMPS reads the restart file."""
        file = host.work / "taken.restart"
        parts = "compute p all pair lj/cut\nthermo_style custom step c_p pe press\nthermo_modify format float %.15g\n"
        stock = run(LATEST + parts + "run 20\nrun 20\n")
        output = run(LOADED + "dch on\n" + LATEST + parts + f"run 20\nwrite_restart {file}\nrun 20\n")
        self.same(stock, output)
        script = f"read_restart {file}\nneigh_modify delay 0 every 1 check yes\nfix 1 all nve\n" + parts
        self.same(stock, run(script + "run 0\nrun 20\n"))
        again = run(LOADED + "dch on\n" + script + "run 0\nrun 20\ndch explain\n")
        self.assertIn("cluster pairs", line_of(again, "pair lj/cut/dch"))
        self.same(stock, again)

    def test_hybrid(self):
        variables = {"steps": 20, "lists": "stock"}
        output = run(LOADED + "dch on\ninclude ${here}/in.hybrid\ndch explain\n", variables=variables)
        self.assertIn("cluster pairs", line_of(output, "pair lj/cut/dch"))
        self.same(run("include ${here}/in.hybrid\n", variables=variables), output)

    def test_ways_to_say_no(self):
        stock = run(LATEST + "run 20\n")
        for words, script in (("dch styles no\ndch on\n", LATEST), ("dch on\ndch styles no\n", LATEST),
                              ("dch on\n", LATEST.replace("lj/cut", "lj/cut/stock").replace("all nve", "all nve/stock"))):
            output = run(LOADED + words + script + EXPLAINED)
            self.assertNotIn("DCH takes", output)
            self.assertIn(": DCH\n", output)
            self.same(stock, output)
        output = run(LOADED + LATEST + "dch on\n" + EXPLAINED)
        self.assertEqual(line_of(output, "pair lj/cut"),
                         "native, as it was made before 'dch on'; give that before it for lj/cut/dch")
        output = run(LOADED + "dch on\nsuffix opt\n" + LATEST + EXPLAINED)  # the script's own suffix comes first
        self.assertIn("native", line_of(output, "pair lj/cut/opt"))
        for wrong in ("dch styles\n", "dch styles mine\n"):
            code, output = host.run_text(LOADED + wrong)
            self.assertNotEqual(code, 0)
            self.assertIn("give 'dch styles auto' or 'dch styles no'", output)

    def test_taken_styles_leave_forces_to_the_plain_one(self):
        script = LOADED + "dch on\n" + LATEST + "run 10\n"
        for words, reason in (("dch off\n", "'dch off' was given; give 'dch on'"),
                              ("dch styles no\n", "'dch styles no' was given; give 'dch styles auto'"),
                              ("dch on engine grid\n", "the engine grid makes no cluster pairs")):
            output = run(script + words + "run 10\ndch explain\n")
            self.assertIn("plain style on a neighbor list, " + reason, line_of(output, "pair lj/cut/dch"))
            self.same(run(LATEST + "run 10\nrun 10\n"), output)

    def test_launcher(self):
        output = run(LATEST + EXPLAINED, executable=[host.lmp_dch, "--dch", "mixed,threads=2"])
        self.assertRegex(line_of(output, "pair lj/cut/dch"), "^cluster pairs, in mixed precision")
        self.assertIn("2 of each process", line_of(output, "threads"))
        output = run(LATEST + EXPLAINED, executable=[host.lmp_dch, "--dch", "off,mixed"])
        self.assertIn("all lists: native", output)


class Order(unittest.TestCase):
    """`dch order auto` on one process: what comes after a run finds atoms in LAMMPS's order."""

    def check(self, script, words="dch on\n", ranks=1):
        stock = thermo_tables(run(script, ranks=ranks))
        ours = thermo_tables(run(LOADED + words + script, ranks=ranks))
        for first, second in zip(stock, ours):
            for lines in zip(first, second):
                self.assertLess(largest_relative_difference(*lines), 1e-8)

    def test_random_numbers_after_a_plain_run(self):
        bath = "run 63\nfix 2 all langevin 1.0 1.0 1.0 4711\nrun 30\n"
        skewed = SORTED.replace("block 0 6 0 6 0 6", "prism 0 6 0 6 0 6 1.5 -1 0.5")
        for script in (SORTED, SORTED.replace("sort 10", "sort 1000"), SORTED.replace("sort 10", "sort 25"), skewed):
            for words in ("dch on\n", "dch styles no\ndch on\n", "dch on\ndch expiry half\n"):
                with self.subTest(script=script, words=words):
                    self.assertIn("in the order of the structure", run(LOADED + words + script + "run 63\ndch stats\n"))
                    self.check(script + bath, words)

    def test_deleted_atoms(self):
        self.check(SORTED + "run 63\ndelete_atoms overlap 0.98 all all\nrun 1\n")

    def test_ids_after_deletion(self):
        """LAMMPS numbers what is left in the order of memory."""
        pushed = "group low id <= 100\nvelocity low set 1.0 0.0 0.0\nrun 3\n"
        for what in ("region part", "group part"):
            script = SORTED + "region part block 0 2 EDGE EDGE EDGE EDGE\ngroup part region part\nrun 63\n"
            self.check(script + f"delete_atoms {what}\n{pushed}")

    def test_sorting_is_turned_off(self):
        self.check(SORTED + "run 63\natom_modify sort 0 0\nrun 5\n")

    def test_random_numbers_after_new_atoms(self):
        new = "create_atoms 1 single 0.25 0.25 0.25\nfix 3 all nve/limit 0.01\nunfix 1\n"
        for words in ("dch on\n", "dch styles no\ndch on\n"):
            self.check(SORTED + f"run 63\n{new}fix 2 all langevin 1.0 1.0 1.0 4711\nrun 30\n", words)

    def test_grains_keep_theirs(self):
        output = run(LOADED + "atom_modify sort 40 0\ninclude ${here}/in.granular\n",
                     variables={"lists": "dch", "steps": 200})
        self.assertIn("lists are of grains, where the order costs time ('dch order yes')", output)


if __name__ == "__main__":
    main(__doc__)
