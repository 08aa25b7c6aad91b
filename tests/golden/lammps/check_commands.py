#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""The command `dch` and the ways to load it, in a real LAMMPS."""

import argparse
import re
import sys
import unittest

from lammps_run import Host, largest_relative_difference, thermo_tables

MELT = """
units lj
atom_style atomic
lattice fcc 0.8442
region box block 0 6 0 6 0 6
create_box 1 box
create_atoms 1 box
mass 1 1.0
velocity all create 1.44 87287 loop geom
pair_style lj/cut 2.5
pair_coeff 1 1 1.0 1.0
neighbor 0.3 bin
neigh_modify delay 0 every 5 check no
fix 1 all nve
thermo 20
thermo_modify format float %.15g
"""

SALT = """
units lj
atom_style charge
lattice sc 0.7
region box block 0 8 0 8 0 8
create_box 2 box
create_atoms 1 box
set type 1 type/subset 2 256 7841
set type 1 charge 0.9
set type 2 charge -0.9
mass * 1.0
displace_atoms all random 0.06 0.06 0.06 4711
velocity all create 1.2 87287 loop geom
pair_style lj/cut/coul/long 2.2 2.7
pair_coeff * * 1.0 1.0
kspace_style pppm 1e-4
neighbor 0.3 bin
neigh_modify delay 0 every 5 check no
fix 1 all nve
thermo 20
thermo_modify format float %.15g
"""

host = None


def run(text, **options):
    code, output = host.run_text(text, **options)
    if code != 0:
        raise AssertionError(f"exit code {code}\n{output}")
    return output


class Loading(unittest.TestCase):
    def test_include_in_stock_lammps_leaves_lists_alone(self):
        stock = run(MELT + "run 20\n")
        loaded = run("include ${load}\n" + MELT + "run 20\n")
        self.assertEqual(thermo_tables(stock), thermo_tables(loaded))

    def test_include_twice_and_in_the_launcher_does_no_harm(self):
        script = "include ${load}\ninclude ${load}\n" + MELT + "dch on\nrun 20\ndch stats\n"
        for executable in (host.lmp, host.lmp_dch):
            self.assertIn("half, newton on: DCH", run(script, executable=executable))

    def test_launcher_needs_no_include_and_agrees_with_stock(self):
        loaded = run("include ${load}\n" + MELT + "dch on\nrun 20\n")
        launched = run(MELT + "dch on\nrun 20\n", executable=host.lmp_dch)
        self.assertEqual(thermo_tables(loaded), thermo_tables(launched))

    def test_as_a_plugin(self):
        code, output = host.run_text("suffix dch\n" + MELT + "dch on\nrun 20\ndch stats\nclear\n" + MELT + "run 20\n",
                                     executable=[host.tools / "plugin_host", host.loader.parent / "libdch_lammps.so"])
        self.assertEqual(code, 0, output)
        self.assertIn("entered command dch\nentered pair lj/cut/dch\n", output)
        self.assertIn("pair lj/cut/dch, cluster pairs: DCH", output)
        stock = thermo_tables(run(MELT + "run 20\n"))
        for table in thermo_tables(output):
            self.assertLess(largest_relative_difference(stock[0][-1], table[-1]), 1e-9)

    def test_without_the_include_the_command_is_unknown(self):
        code, output = host.run_text("dch on\n")
        self.assertNotEqual(code, 0)
        self.assertIn("Unknown command: dch", output)

    def test_missing_library_is_named(self):
        loader = host.work / "broken.lmp"
        loader.write_text(host.loader.read_text().replace("libdch_lammps.so", "libdch_absent.so"))
        code, output = host.run_text("include ${load}\n", variables={"load": loader})
        self.assertNotEqual(code, 0)
        self.assertIn("libdch_absent.so: cannot open shared object file", output)


class Errors(unittest.TestCase):
    def test_words_that_mean_nothing(self):
        for words, remedy in (("", "give 'dch on', 'dch off', 'dch stats', 'dch verify"),
                              ("threads none", "the number of threads is 'none'"),
                              ("precision half", "does not know 'half'"),
                              ("of", "unknown keyword 'of'"),
                              ("off now", "'now' after 'dch off' has no meaning"),
                              ("on c", "for example 'dch on c 1.2'"),
                              ("on c 1.01", "c is '1.01' but has to be a number from 1.05"),
                              ("on fast", "unknown option 'fast'"),
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
        self.assertIn("c 1.3,", output)
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
            tables = [thermo_tables(run(f"include ${{load}}\n{styles}dch threads {n}\n" + MELT + "run 40\n"))
                      for n in (1, 3)]
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


class ForceStyles(unittest.TestCase):
    """What check_forces.py does not see: other ways to set a style, to change it, to read it back."""

    def compare(self, script, **options):
        plain = thermo_tables(run("include ${load}\n" + script, **options))
        ours = thermo_tables(run("include ${load}\nsuffix dch\n" + script, **options))
        self.assertEqual(len(plain), len(ours))
        for first, second in zip(plain, ours):
            for columns in zip(first, second):
                self.assertLess(largest_relative_difference(*columns), 1e-9)
        return plain

    def test_named_without_the_suffix(self):
        output = run("include ${load}\n" + MELT.replace("lj/cut", "lj/cut/dch") + "run 20\ndch stats\n")
        self.assertIn("pair lj/cut/dch, cluster pairs: DCH", output)
        self.assertIn("DCH neighbor lists: off", output)

    def test_with_lists_for_another_style(self):
        script = MELT.replace("pair_style lj/cut 2.5", "pair_style hybrid/overlay lj/cut 2.5 morse 2.0")
        script = script.replace("pair_coeff 1 1 1.0 1.0", "pair_coeff 1 1 lj/cut 1.0 1.0\npair_coeff 1 1 morse 0.1 5 1.1")
        self.compare(script + "run 20\n")
        output = run("include ${load}\nsuffix dch\ndch on\ndch verify yes\n" + script + "run 20\ndch stats\n")
        self.assertIn("pair lj/cut/dch, cluster pairs: DCH", output)
        self.assertIn("pair morse, half, newton on: DCH", output)
        self.assertIn("all equal", output)

    def test_tail_corrections_and_compute_pair(self):
        script = MELT.replace("neighbor 0.3", "pair_modify tail yes\nneighbor 0.3")
        script += "compute lj all pair lj/cut${end}\nthermo_style custom step temp epair etail press c_lj\nrun 20\n"
        plain = thermo_tables(run("include ${load}\n" + script, variables={"end": ""}))
        ours = thermo_tables(run("include ${load}\nsuffix dch\n" + script, variables={"end": "/dch"}))
        self.assertLess(largest_relative_difference(plain[0][-1], ours[0][-1]), 1e-9)
        self.assertNotEqual(ours[0][-1]["E_tail"], 0)

    def test_restart_and_data_file(self):
        script = MELT.replace("1.0 1.0\n", "1.1 0.9 2.3\npair_modify shift yes\n") + f"""
run 20
write_restart {host.work}/melt.restart
write_data {host.work}/melt.data pair ij
clear
dch precision double
read_restart {host.work}/melt.restart
fix 1 all nve
neighbor 0.3 bin
run 0
clear
dch precision double
units lj
pair_style lj/cut 2.5
pair_modify shift yes
read_data {host.work}/melt.data
neighbor 0.3 bin
run 0
"""
        tables = self.compare(script)
        self.assertEqual(len(tables), 3)
        self.assertLess(abs(tables[2][0]["E_pair"] - tables[1][0]["E_pair"]), 1e-6)

    def test_fene_bonds(self):
        script = f"""
units lj
atom_style bond
special_bonds fene
region box block 0 9 0 9 0 9
create_box 1 box bond/types 2 extra/bond/per/atom 2 extra/special/per/atom 4
create_atoms 1 single 4 4 4
create_atoms 1 single ${{second}} 4 4
create_atoms 1 single ${{second}} 5 4
mass 1 1.0
pair_style lj/cut 1.12246
pair_coeff 1 1 1.0 1.0
bond_style fene
bond_coeff 1 30.0 1.5 1.0 1.0
bond_coeff 2 25.0 1.6 1.0 1.1
create_bonds single/bond 1 1 2 special no
create_bonds single/bond 2 2 3
neighbor 0.4 bin
fix 1 all nve
thermo 100
thermo_modify format float %.15g
run 100
write_restart {host.work}/fene.restart
clear
dch precision double
read_restart {host.work}/fene.restart
fix 1 all nve
thermo 100
thermo_modify format float %.15g
run 100
"""
        self.compare(script, variables={"second": "4.98"})
        output = run("include ${load}\nsuffix dch\n" + script, variables={"second": "5.43"})
        self.assertGreater(output.count("FENE bond too long: "), 1)
        code, output = host.run_text("include ${load}\nsuffix dch\n" + script, variables={"second": "7.1"})
        self.assertNotEqual(code, 0)
        self.assertIn("Bad FENE bond", output)

    def test_charges_restart_and_change(self):
        script = SALT + f"""
pair_modify table 0
run 20
set type 1 charge 0.7
set type 2 charge -0.7
run 20
write_restart {host.work}/salt.restart
clear
dch precision double
read_restart {host.work}/salt.restart
kspace_style pppm 1e-4
fix 1 all nve
run 10
"""
        self.assertEqual(len(self.compare(script)), 3)

    def test_charges_without_tables(self):
        plain = thermo_tables(run("include ${load}\n" + SALT + "run 0\n"))
        exact = thermo_tables(run("include ${load}\n" + SALT + "pair_modify table 0\nrun 0\n"))
        ours = thermo_tables(run("include ${load}\nsuffix dch\n" + SALT + "run 0\n"))
        difference = largest_relative_difference
        self.assertLess(difference(exact[0][0], ours[0][0]), 1e-10)
        self.assertGreater(difference(plain[0][0], ours[0][0]), 1e-10)
        self.assertLess(difference(plain[0][0], ours[0][0]), 1e-4)

    def test_charges_need_a_long_range_solver_and_atoms_with_charges(self):
        for script, message in ((SALT.replace("kspace_style pppm 1e-4\n", ""), "requires a KSpace style"),
                                (MELT.replace("lj/cut 2.5", "lj/cut/coul/cut 2.5"), "requires atom attribute q")):
            code, output = host.run_text("include ${load}\nsuffix dch\n" + script + "run 0\n")
            self.assertNotEqual(code, 0)
            self.assertIn(message, output)

    def test_coefficients_that_change_in_a_run(self):
        self.compare(MELT + "variable e equal ramp(1.0,1.5)\nfix 2 all adapt 5 pair lj/cut epsilon 1 1 v_e\nrun 20\n"
                     "unfix 2\npair_coeff 1 1 0.7 1.0 2.2\nrun 10\nrun 10 pre no\n")

    def test_minimization(self):
        self.compare(MELT + "displace_atoms all random 0.1 0.1 0.1 4711\nminimize 0 1e-3 20 200\n")

    def test_a_cluster_in_open_space(self):
        self.compare(MELT.replace("units lj", "units lj\nboundary s s s") + "run 40\n")

    def test_atoms_that_come_and_go(self):
        self.compare(MELT + "run 10\ngroup some id 1:100:7\ndelete_atoms group some compress no\nrun 10\n"
                     "create_atoms 1 single 0.4 0.4 0.4\nrun 0\n")

    def test_wrong_arguments_are_the_plain_styles_errors(self):
        code, output = host.run_text("include ${load}\nsuffix dch\n" + MELT.replace("lj/cut 2.5", "lj/cut"))
        self.assertNotEqual(code, 0)
        self.assertIn("Illegal pair_style command", output)

    def test_single_precision_cannot_hold_si_units(self):
        script = """
include ${load}
units si
atom_style atomic
region box block 0 4e-9 0 4e-9 0 4e-9
create_box 1 box
create_atoms 1 random 2000 4711 box
mass 1 6.6e-26
pair_style lj/cut/dch 1.1e-9
pair_coeff 1 1 1.65e-21 3.4e-10
neighbor 1e-10 bin
dch precision mixed
run 0
"""
        code, output = host.run_text(script)
        self.assertNotEqual(code, 0)
        self.assertIn("the range of single precision; use other units", output)


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


def main():
    global host
    parser = argparse.ArgumentParser(description=__doc__)
    Host.add_arguments(parser)
    arguments, rest = parser.parse_known_args()
    host = Host(arguments)
    unittest.main(argv=[sys.argv[0]] + rest, verbosity=2)


if __name__ == "__main__":
    main()
