#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""colloid/dch in a real LAMMPS: particles and spheres of three sizes, how their numbers are given, and what stops a run."""

import re
import unittest

from lammps_run import thermo_tables
from script_tests import TALLIES, error_of, forces_of, host, main, run

# Type 1 is the solvent; types 2 and 3 are spheres, of diameters 3 and 2. Diameters are mixed unless pair_coeff says them.
BOX = """
units lj
atom_style atomic
lattice sc 0.5
region box block 0 14 0 12 0 12
create_box 3 box
region room block 1 13 1 11 1 11
create_atoms 1 region room
lattice sc 0.016 origin 0.5 0.5 0.5
create_atoms 2 box
set type 2 type/fraction 3 0.4 4711
group spheres type 2 3
group solvent type 1
mass 1 1.0
mass 2 27.0
mass 3 8.0
velocity all create 1.0 87287 loop geom
"""
COEFFICIENTS = """
pair_style colloid 6.0
pair_coeff 1 1 144.0 1.0 0.0 0.0 2.5
pair_coeff 1 2 75.4 1.0 0.0 3.0 4.0
pair_coeff 1 3 65.0 0.95 0.0 2.0 3.5
pair_coeff 2 2 39.5 1.0 3.0 3.0 6.0
pair_coeff 2 3 39.5 1.0 2.0 3.0 5.5
pair_coeff 3 3 39.5 0.9 2.0 2.0 5.0
"""
END = """
neighbor 0.3 bin
neigh_modify delay 0 every 5 check no
fix 1 all nve/limit 0.05
timestep 0.002
thermo_style custom step temp epair press pxx pyy pzz pxy pxz pyz
thermo 20
thermo_modify format float %.15g
"""
SOLUTION = BOX + COEFFICIENTS + "delete_atoms overlap 2.2 solvent spheres\n" + END
# Cutoffs of types with themselves from 1.5 to 30: structures for each size, and pairs one by one.
SIZES = """
units lj
atom_style atomic
lattice sc 0.4
region box block 0 40 0 40 0 40 units box
create_box 2 box
create_atoms 1 box
region hole sphere 20 20 20 9 units box
delete_atoms region hole
create_atoms 2 single 20 20 20 units box
mass 1 1.0
mass 2 1000.0
velocity all create 1.0 87287 loop geom
pair_style colloid 20.0
pair_coeff 1 1 144.0 1.0 0.0 0.0 2.5
pair_coeff 1 2 75.4 1.0 0.0 16.0 12.0
pair_coeff 2 2 39.5 1.0 16.0 16.0 19.0
""" + END.replace("bin", "${search}")
# So many neighbors at cutoffs so alike that there are cluster pairs.
PACKED = """
units lj
atom_style atomic
lattice sc 0.7
region box block 0 8 0 8 0 8
create_box 3 box
create_atoms 1 box
set type 1 type/fraction 2 0.4 4711
set type 1 type/fraction 3 0.3 4712
mass * 1.0
displace_atoms all random 0.06 0.06 0.06 4711
velocity all create 1.2 87287 loop geom
pair_style colloid 2.4
pair_coeff 1 1 144.0 0.9 0.0 0.0
pair_coeff 1 2 90.0 0.85 0.0 0.4
pair_coeff 1 3 90.0 0.8 0.0 0.5 2.3
pair_coeff 2 2 60.0 0.8 0.4 0.4
pair_coeff 2 3 60.0 0.75 0.4 0.5
pair_coeff 3 3 50.0 0.8 0.5 0.5
""" + END
CLUSTERS = "pair colloid/dch, cluster pairs: DCH"
WAYS = [(newton, ranks) for newton in ("on", "off") for ranks in (1, 2, 4)]


def difference(plain, ours):
    """Largest one of a line of output: of pressures, of which lattices have no shear, relative to the largest, else of itself."""
    pressure = max((abs(value) for name, value in plain.items() if name.startswith("P")), default=0)
    return max(abs(plain[name] - ours[name]) / ((pressure if name.startswith("P") else abs(plain[name])) or 1) for name in plain)


class Colloid(unittest.TestCase):
    def compare(self, script, more="", **options):
        """Tables of the plain style, and the output of ours, whose script goes on with `more`."""
        plain = run("include ${load}\n" + script, **options)
        ours = run("include ${load}\nsuffix dch\n" + script + more, **options)
        tables = [thermo_tables(output) for output in (plain, ours)]
        for tables_of_run in zip(*tables, strict=True):
            for lines in zip(*tables_of_run, strict=True):
                self.assertLess(difference(*lines), 1e-9)
        return tables[0], ours

    def ours(self, script, **options):
        """Compares, and returns what `dch stats` and `dch explain` say."""
        return self.compare(script + "run 20\n", "dch stats\ndch explain\n", **options)[1]

    def expect_same_by_atom(self, script, before="", ranks=1):
        plain, ours = (forces_of(before + script, suffix, ranks) for suffix in ("", "suffix dch\n"))
        self.assertEqual(len(plain), len(ours))
        for columns in ((0, 1, 2), (3,), range(4, 10)):
            largest = max(abs(row[k]) for row in plain for k in columns)
            off = max(abs(a[k] - b[k]) for a, b in zip(plain, ours) for k in columns)
            self.assertGreater(largest, 0)
            self.assertLess(off, 1e-12 * largest)

    def test_forces_energies_and_stresses_by_atom(self):
        for newton, ranks in WAYS:
            with self.subTest(newton=newton, ranks=ranks):
                for script in (SOLUTION, SIZES.replace("${search}", "multi"), PACKED):
                    self.expect_same_by_atom(script, f"newton {newton}\n", ranks)

    def test_sums_and_runs(self):
        for newton, ranks in WAYS:
            with self.subTest(newton=newton, ranks=ranks):
                for script, way in ((SOLUTION, "pairs one by one"), (PACKED, "cluster pairs")):
                    output = self.ours(f"newton {newton}\n" + script, ranks=ranks)
                    self.assertIn(CLUSTERS, output)
                    self.assertRegex(output, f"pair colloid/dch: {way}, in double precision")
                    self.compare(f"newton {newton}\n" + script + TALLIES + "run 20\n", ranks=ranks)

    def test_size_classes(self):
        for search, more in (("bin", ""), ("multi", ""), ("multi", "comm_modify mode multi\n"),
                             ("multi", "neigh_modify collection/type 2 1 2\n"), ("multi", "neigh_modify collection/interval 2 3.0 19.5\n")):
            for ranks in (1, 2):
                with self.subTest(search, more=more, ranks=ranks):
                    script = SIZES.replace("${search}", search) + more
                    output = self.ours(script, ranks=ranks)
                    self.assertRegex(output, "pair colloid/dch: pairs one by one, in double precision, as there are size classes")

    def test_whole_rows_hold_the_pairs_of_native_lists(self):
        for newton, ranks in WAYS:
            with self.subTest(newton=newton, ranks=ranks):
                output = run(f"newton {newton}\ninclude ${{load}}\nsuffix dch\ndch verify yes\n" + SIZES.replace("${search}", "multi")
                             + "run 20\ndch stats\n", ranks=ranks)
                self.assertRegex(output, r"verified +5 builds, \d+ pairs, all equal")

    def test_shifted_energies_and_mixed_numbers(self):
        """Of mixed diameters only the geometric mean is 0 where one of both is."""
        mixed = SOLUTION.replace("pair_coeff 1 2 75.4 1.0 0.0 3.0 4.0\n", "").replace("pair_coeff 2 3 39.5 1.0 2.0 3.0 5.5\n", "")
        for script in (SOLUTION, mixed):
            for words in ("shift yes", "mix geometric", "mix arithmetic shift yes", "shift no"):
                with self.subTest(words):
                    self.assertIn(CLUSTERS, self.ours(script.replace("neighbor 0.3", f"pair_modify {words}\nneighbor 0.3")))

    def test_mixed_precision(self):
        for script in (SOLUTION, SIZES.replace("${search}", "multi"), PACKED):
            plain = thermo_tables(run(script + "run 20\n"))
            ours = thermo_tables(run("include ${load}\nsuffix dch\ndch precision mixed\n" + script + "run 20\n"))
            names = ("E_pair", "Press")
            for columns in zip(plain[0], ours[0]):
                for name in names:
                    self.assertLess(abs(columns[0][name] - columns[1][name]), 1e-5 * abs(columns[0][name]))

    def test_restart(self):
        script = SOLUTION.replace("neighbor 0.3", "pair_modify shift yes\nneighbor 0.3") + f"""
run 10
write_restart {host.work}/colloid.restart
clear
dch precision double
read_restart {host.work}/colloid.restart
fix 1 all nve/limit 0.05
thermo_modify format float %.15g
run 10
"""
        self.assertEqual(len(self.compare(script)[0]), 2)

    def test_restart_files_are_those_of_the_plain_style(self):
        """Written by either and read by the other."""
        read = f"read_restart {host.work}/other.restart\n" + END + "run 10\n"
        tables = []
        for writer, reader in (("", ""), ("suffix dch\n", ""), ("", "suffix dch\n"), ("suffix dch\n", "suffix dch\n")):
            run(f"include ${{load}}\n{writer}" + SOLUTION + f"run 0\nwrite_restart {host.work}/other.restart\n")
            tables.append(thermo_tables(run(f"include ${{load}}\n{reader}{read}"))[0])
        for table in tables[1:]:
            for columns in zip(tables[0], table):
                self.assertLess(difference(*columns), 1e-9)

    def test_beside_another_style(self):
        script = SOLUTION.replace("pair_style colloid 6.0", "pair_style hybrid/overlay colloid 6.0 born 2.0")
        script = re.sub(r"pair_coeff (\d \d)", r"pair_coeff \1 colloid", script)
        script = script.replace("delete_atoms", "pair_coeff 1 1 born 0.1 0.2 1.1 0.1 0.01\ndelete_atoms")
        for ranks in (1, 2):
            self.assertIn(CLUSTERS, self.ours(script, ranks=ranks))
        split = re.sub(r"pair_coeff 1 1 colloid.*", "pair_coeff 1 1 lj/cut 1.0 1.0 2.5",
                       script.replace("hybrid/overlay colloid 6.0 born 2.0", "hybrid colloid 6.0 lj/cut 2.5").replace(
                           "pair_coeff 1 1 born 0.1 0.2 1.1 0.1 0.01\n", ""))
        self.assertIn(CLUSTERS, self.ours(split))

    def test_dch_on_takes_it(self):
        plain = thermo_tables(run(SIZES.replace("${search}", "multi") + "run 20\n"))[0]
        output = run("include ${load}\ndch on\n" + SIZES.replace("${search}", "multi") + "run 20\ndch stats\n")
        self.assertIn(CLUSTERS, output)
        for columns in zip(plain, thermo_tables(output)[0]):
            self.assertLess(difference(*columns), 1e-9)

    def test_what_the_plain_style_computes_is_explained(self):
        output = self.ours(SOLUTION + "group few id <> 1 100\natom_modify first few\nneigh_modify include few\n")
        self.assertIn("plain style on a neighbor list, neigh_modify include; give 'neigh_modify include all'", output)

    def test_numbers_of_a_pair_of_atoms(self):
        """compute pair/local and compute group/group ask single()."""
        script = SOLUTION + "compute all all pair/local dist eng force\ncompute most all reduce max c_all[1] c_all[2] c_all[3] INPUTS_LOCAL\n"
        script += "compute both solvent group/group spheres\nthermo_style custom step epair c_most[*] c_both c_both[*]\nthermo_modify format float %.15g\n"
        self.compare(script + "run 0\n")

    def test_coefficients_that_change_in_a_run(self):
        self.compare(SOLUTION + "run 10\npair_coeff 1 1 120.0 1.0 0.0 0.0 2.4\npair_coeff 2 3 30.0 1.0 2.0 2.0 5.0\nrun 10\n")

    def test_overlapping_spheres_stop_the_run(self):
        """At once, in a register of its own and among others; where pairs go one by one; on several processes."""
        within = "create_atoms 1 single 0.6 0.5 0.5\n"
        few = SIZES.replace("${search}", "multi")
        near = "set type 2 type 2\ncreate_atoms 3 single {} 0.5 0.5\n"
        scripts = {"small/large": [SOLUTION + within, few + "create_atoms 1 single 20 20 26 units box\n", SOLUTION + "create_atoms 1 single 0.5 0.5 0.5\n"],
                   "large/large": [SOLUTION + near.format(1.0), SOLUTION + near.format(0.5),
                                   few + "create_atoms 2 single 20 20 27 units box\n"]}
        for kind, all_scripts in scripts.items():
            for k, script in enumerate(all_scripts):
                for before, ranks in (("", 1), ("newton off\n", 2), ("dch precision mixed\n", 2), ("newton on\n", 4)):
                    with self.subTest(kind, script=k, before=before, ranks=ranks):
                        said = [error_of(script + "run 0\n", before + suffix, ranks) for suffix in ("", "suffix dch\n")]
                        for text in said:
                            self.assertRegex(text, "Overlapping small/large|" + kind)
                        if kind == "small/large":
                            self.assertEqual(*said)

    def test_spheres_that_come_to_overlap_stop_the_run(self):
        """A sphere is pushed through the solvent, and through another sphere."""
        script = SIZES.replace("${search}", "multi").replace("fix 1 all nve/limit 0.05", "fix 1 solvent nve/limit 0.05")
        script = script.replace("create_atoms 2", "group solvent type 1\ncreate_atoms 2")
        pushed = script + "group spheres type 2\nfix 2 spheres move linear 0 0 100\nneigh_modify every 1 check yes\nrun 200\n"
        with_two = pushed.replace("create_atoms 2", "delete_atoms group solvent\ncreate_atoms 2 single 20 20 37 units box\ngroup rest type 2\n"
                                  "create_atoms 2").replace("fix 2 spheres", "group pushed subtract spheres rest\nfix 2 pushed")
        for text, kind in ((pushed, "small/large"), (with_two, "large/large")):
            said = [error_of(text, suffix) for suffix in ("", "suffix dch\n")]
            self.assertEqual(said, [f"Overlapping {kind} in pair colloid"] * 2)

    def test_other_forces_that_are_no_numbers_are_not_blamed_on_it(self):
        code, output = host.run_text("include ${load}\nsuffix dch\n" + SOLUTION + "variable nan equal sqrt(-1.0)\n"
                                     "fix 2 all addforce v_nan 0 0\nrun 2\n")
        self.assertNotIn("Overlapping", output)

    def test_errors_are_the_plain_styles(self):
        wrong = [SOLUTION.replace(*words) + "run 0\n" for words in
                 (("colloid 6.0", "colloid"), ("0.0 0.0 2.5", "0.0"), ("2.0 2.0 5.0", "-2.0 2.0 5.0"))]
        for script in wrong:
            self.assertEqual(*(error_of(script, before) for before in ("", "suffix dch\n")))

    def test_computes_that_ask_for_each_pair(self):
        script = SOLUTION + "compute each all each/pair\nthermo_style custom step temp epair press c_each c_each[*]\nrun 20\n"
        plain, ours = (thermo_tables(run(suffix + script, executable=host.tools / "lmp_tally"))[-1] for suffix in ("", "suffix dch\n"))
        for columns in zip(plain, ours):
            self.assertLess(difference(*columns), 1e-9)


if __name__ == "__main__":
    main(__doc__)
