#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""table/dch in a real LAMMPS: what its files and settings may be, what the plain style computes, and what stops a run."""

import itertools

from lammps_run import largest_relative_difference, thermo_tables
from script_tests import MELT, ComparedWithStock, error_of, forces_of, host, main, run
from table_files import lennard_jones, section, write_tables

TABLE = MELT.replace("pair_style lj/cut 2.5", "pair_style table linear 1500").replace("pair_coeff 1 1 1.0 1.0", "pair_coeff 1 1 pair.table A")
TWO = TABLE.replace("create_box 1", "create_box 2").replace("mass 1", "set type 1 type/fraction 2 0.5 881\nmass *")
TWO = TWO.replace("pair_coeff 1 1 pair.table A", "pair_coeff * * pair.table A\npair_coeff 2 2 pair.table B 2.2\npair_coeff 1 2 pair.table C")
CLUSTERS = "pair table/dch, cluster pairs: DCH"


def splines(script):
    return script.replace("linear 1500", "spline 400")


class Table(ComparedWithStock):
    @classmethod
    def setUpClass(cls):
        write_tables(host.work / "pair.table")

    def ours(self, script, **options):
        """Compares, and returns what `dch stats` and `dch explain` say."""
        self.compare(script + "run 20\n", **options)
        return run("include ${load}\nsuffix dch\n" + script + "run 20\ndch stats\ndch explain\n", **options)

    def test_each_way_to_give_distances(self):
        for keyword, way in itertools.product(("A", "B", "C", "A 2.2", "C 1.3"), ("linear 1500", "spline 1500", "spline 60")):
            with self.subTest(keyword, way=way):
                script = TABLE.replace("pair.table A", f"pair.table {keyword}").replace("linear 1500", way)
                self.assertIn(CLUSTERS, self.ours(script))

    def test_types_with_tables_of_their_own(self):
        for ranks in (1, 2):
            self.assertIn(CLUSTERS, self.ours(TWO, ranks=ranks))
        self.assertIn(CLUSTERS, self.ours(TWO + "pair_coeff 1 1 pair.table B\npair_coeff 1 2 pair.table A 2.1\n"))
        for ranks in (1, 2, 4):
            self.assertIn(CLUSTERS, self.ours(splines(TWO), ranks=ranks))

    def test_forces_of_splines(self):
        """Of atoms off their lattice, by themselves, to 1e-12 of the largest one in double precision."""
        moved = "displace_atoms all random 0.1 0.1 0.1 4711\n"
        for script, ranks in itertools.product((splines(TABLE), splines(TWO), TABLE.replace("linear 1500", "spline 20000")), (1, 2, 4)):
            plain = [row[:3] for row in forces_of(script + moved, ranks=ranks)]
            largest = max(abs(f) for row in plain for f in row)
            for precision, limit in (("double", 1e-12), ("mixed", 1e-5)):
                ours = forces_of(script + moved, f"suffix dch\ndch precision {precision}\n", ranks)
                off = max(abs(a - b) for row, other in zip(plain, ours, strict=True) for a, b in zip(row, other))
                self.assertLess(off, limit * largest)

    def test_what_is_written_of_splines(self):
        """By pair_write, as the plain style writes it."""
        said = []
        for before in ("", "include ${load}\nsuffix dch\n"):
            file = host.work / f"written{len(said)}.table"
            file.unlink(missing_ok=True)
            run(before + splines(TABLE) + f"pair_write 1 1 300 rsq 0.6 2.4 {file} W\n")
            said.append([line for line in file.read_text().splitlines() if not line.startswith("#")])
        self.assertGreater(len(said[0]), 300)
        self.assertEqual(*said)

    def test_mixed_precision(self):
        for script in (TWO, splines(TWO)):
            plain = thermo_tables(run(script + "run 20\n"))
            ours = thermo_tables(run("include ${load}\nsuffix dch\ndch precision mixed\n" + script + "run 20\n"))
            for columns in zip(plain[0], ours[0]):
                self.assertLess(largest_relative_difference(*columns), 1e-5)

    def test_no_energy_is_shifted(self):
        self.ours(TABLE.replace("neighbor 0.3", "pair_modify shift yes\nneighbor 0.3"))

    def test_beside_another_style(self):
        script = TABLE.replace("pair_style table linear 1500", "pair_style hybrid/overlay table linear 1500 born 2.0")
        script = script.replace("1 1 pair.table A", "1 1 table pair.table A\npair_coeff 1 1 born 0.1 0.2 1.1 0.1 0.01")
        self.assertIn(CLUSTERS, self.ours(script))
        self.assertIn(CLUSTERS, self.ours(splines(script)))

    def test_two_in_one_hybrid(self):
        def hybrid(way):
            script = TWO.replace("pair_style table linear 1500", f"pair_style hybrid table linear 1500 table {way} 300")
            script = script.replace("* * pair", "* * table 1 pair").replace("2 2 pair", "2 2 table 1 pair")
            return script.replace("1 2 pair", "1 2 table 2 pair")

        for ranks in (1, 2):
            output = self.ours(hybrid("spline"), ranks=ranks)
            self.assertIn(CLUSTERS, output)
            self.assertNotIn("without cluster pairs", output)
        output = self.ours(hybrid("lookup"))
        self.assertIn(CLUSTERS, output)
        self.assertIn("pair table/dch without cluster pairs: native, pair_style table lookup", output)

    def test_other_ways_to_read_a_table_are_the_plain_styles(self):
        for words in ("lookup 1500", "bitmap 12"):
            with self.subTest(words):
                output = self.ours(TABLE.replace("linear 1500", words))
                kind = words.split()[0]
                self.assertIn(f"plain style on a neighbor list, pair_style table {kind}; give 'pair_style table linear N' or "
                              "'pair_style table spline N'", output)

    def test_tables_for_a_solver_are_the_plain_styles(self):
        for way in ("linear 1500", "spline 400"):
            output = self.ours(TABLE.replace("linear 1500", way + " ewald pppm"))
            self.assertIn("plain style on a neighbor list, tables for a long-range solver; give", output)

    def test_dch_on_takes_it(self):
        output = run("include ${load}\ndch on\n" + TABLE + "run 20\ndch stats\n")
        self.assertIn(CLUSTERS, output)
        plain = run(TABLE + "run 20\n")
        for columns in zip(*(thermo_tables(text)[0] for text in (plain, output))):
            self.assertLess(largest_relative_difference(*columns), 1e-9)

    def test_bonded_partners_by_weight(self):
        script = TABLE.replace("units lj", "units lj").replace("atom_style atomic", "atom_style bond")
        script = script.replace("create_box 1 box", "create_box 1 box bond/types 1 extra/bond/per/atom 12 extra/special/per/atom 200")
        script += "bond_style harmonic\nbond_coeff 1 50.0 1.1\ngroup some id 1:100\ncreate_bonds many some some 1 0.9 1.2\nspecial_bonds lj 0.3 0.5 1.0\n"
        for newton in ("on", "off"):
            for ranks in (1, 2):
                with self.subTest(newton, ranks=ranks):
                    self.assertIn(CLUSTERS, self.ours(f"newton {newton}\n" + script, ranks=ranks))
                    self.assertIn(CLUSTERS, self.ours(f"newton {newton}\n" + splines(script), ranks=ranks))

    def test_settings_again(self):
        self.compare(TABLE + "run 10\npair_style table linear 700\npair_coeff 1 1 pair.table B\nrun 10\n"
                     "pair_style table spline 700\npair_coeff 1 1 pair.table B\nrun 10\npair_coeff 1 1 pair.table A\nrun 10\n")

    def test_restart_files_hold_settings_alone(self):
        script = TABLE + f"""
run 10
write_restart {host.work}/table.restart
clear
dch precision double
read_restart {host.work}/table.restart
fix 1 all nve
thermo_modify format float %.15g
"""
        for one in (script, splines(script)):
            self.assertEqual(len(self.compare(one + "pair_coeff 1 1 pair.table A\nrun 10\n")), 2)
        for more in ("run 10\n", "pair_style table linear 1500\nrun 10\n"):
            self.assertEqual(*(error_of(script + more, before) for before in ("", "suffix dch\n")))

    def test_errors_are_the_plain_styles(self):
        forgotten = TABLE + "run 0\npair_style table linear 100\nrun 0\n"
        wrong = [TABLE.replace(*words) + "run 0\n" for words in
                 (("table A", "table X"), ("pair.table A", "none.table A"), ("table A", "table A 2.6"), ("table A", "table A 2.0 1"),
                  ("linear 1500", "linear"), ("linear 1500", "linear 1500 wald"), ("linear 1500", "cubic 1500"), ("linear 1500", "spline 1"))]
        for script in [forgotten, *wrong]:
            self.assertEqual(*(error_of(script, before) for before in ("", "suffix dch\n")))

    def test_atoms_too_close_stop_the_run(self):
        """At first; after some steps; where pairs are computed one by one; by the table of one pair of types."""
        (host.work / "narrow.table").write_text(section("N", lennard_jones(1.0, 1.0), 0.95, 2.5, 300))
        narrow = TABLE.replace("pair.table A", "narrow.table N")
        near = TABLE + "create_atoms 1 single 0.1 0.1 0.2\n"
        scripts = {"at once": near, "at one place": TABLE + "create_atoms 1 single 0.0 0.0 0.0\n", "later": narrow,
                   "few": near.replace("table A", "table A 1.1"),
                   "of two types": TWO.replace("pair.table C", "narrow.table N"),
                   "of splines": splines(near), "of splines, later": splines(narrow)}
        for name, script in scripts.items():
            for before in ("", "dch precision mixed\n", "newton off\n"):
                for ranks in (1, 2):
                    with self.subTest(name, before=before, ranks=ranks):
                        said = [error_of(script + "run 300\n", before + suffix, ranks) for suffix in ("", "suffix dch\n")]
                        for text in said:
                            self.assertIn("Pair distance < table inner cutoff", text)

    def test_other_forces_that_are_no_numbers_are_not_blamed_on_it(self):
        script = TABLE + "variable nan equal sqrt(-1.0)\nfix 2 all addforce v_nan 0 0\n"
        code, output = host.run_text("include ${load}\nsuffix dch\n" + script + "run 2\n")
        self.assertNotIn("inner cutoff", output)

    def test_computes_that_ask_for_each_pair(self):
        script = TWO + "compute each all each/pair\nthermo_style custom step temp epair press c_each c_each[*]\nrun 20\n"
        plain, ours = (thermo_tables(run(suffix + script, executable=host.tools / "lmp_tally"))[-1] for suffix in ("", "suffix dch\n"))
        for columns in zip(plain, ours):
            for name in ("c_each[4]", "c_each[5]", "c_each[6]"):  # which a lattice has none of
                self.assertLess(abs(columns[0].pop(name) - columns[1].pop(name)), 1e-9 * abs(columns[0]["c_each[1]"]))
            self.assertLess(largest_relative_difference(*columns), 1e-9)


if __name__ == "__main__":
    main(__doc__)
