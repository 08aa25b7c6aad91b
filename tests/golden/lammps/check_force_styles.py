#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Force styles with the suffix dch, in a real LAMMPS: what check_forces.py does not see."""

from lammps_run import largest_relative_difference, thermo_tables
from script_tests import MELT, ComparedWithStock, error_of, host, main, run

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

# Of each style its name, arguments and coefficients of three pairs of types; "" for a pair that is mixed.
STYLES = (
    ("lj/cut/coul/cut", "2.2 2.7", "1.0 1.0", "0.7 0.9", ""),
    ("lj/cut/coul/long", "2.2 2.7", "1.0 1.0", "0.7 0.9", ""),
    ("lj/cut/coul/dsf", "0.5 2.2 2.7", "1.0 1.0", "0.7 0.9", ""),
    ("lj/charmm/coul/long", "1.6 2.2 2.7", "1.0 1.0 0.5 0.9", "0.7 0.9", ""),
    ("lj/charmm/coul/charmm", "1.6 2.2 1.8 2.7", "1.0 1.0", "0.7 0.9 0.6 0.8", ""),
    ("lj/charmmfsw/coul/long", "1.6 2.2 2.7", "1.0 1.0 0.5 0.9", "0.7 0.9", ""),
    ("lj/expand", "2.2", "1.0 0.9 0.1", "0.7 0.8 0.2", "0.8 0.85 0.15"),
    ("buck", "2.4", "4000 0.15 1.0", "3500 0.155 0.7", "3000 0.15 0.8"),
    ("buck/coul/long", "2.2 2.7", "4000 0.15 1.0", "3500 0.155 0.7", "3000 0.15 0.8"),
    ("morse", "2.4", "1.0 5.0 1.1", "0.7 6.0 1.0", "0.9 5.5 1.05"),
    ("soft", "2.4", "20.0", "15.0", ""),
    ("yukawa", "1.2 2.6", "10.0", "7.0", ""),
    ("colloid", "2.4", "144 0.9 0.0 0.0", "60 0.8 0.5 0.5", "90 0.85 0.0 0.5"),
)


def salt_with(style, arguments, first, second, both):
    """SALT with another style."""
    script = SALT.replace("pair_style lj/cut/coul/long 2.2 2.7\n", f"pair_style {style} {arguments}\npair_modify table 0\n")
    lines = f"pair_coeff 1 1 {first}\npair_coeff 2 2 {second}\n" + (f"pair_coeff 1 2 {both}\n" if both else "")
    script = script.replace("pair_coeff * * 1.0 1.0\n", lines)
    return script if style.endswith("long") else script.replace("kspace_style pppm 1e-4\n", "")


class ForceStyles(ComparedWithStock):
    """Other ways to set a style, to change it, to read it back."""

    def test_named_without_the_suffix(self):
        output = run("include ${load}\n" + MELT.replace("lj/cut", "lj/cut/dch") + "run 20\ndch stats\n")
        self.assertIn("pair lj/cut/dch, cluster pairs: DCH", output)
        self.assertIn("DCH neighbor lists: off", output)

    def test_with_lists_for_another_style(self):
        script = MELT.replace("pair_style lj/cut 2.5", "pair_style hybrid/overlay lj/cut 2.5 born 2.0")
        script = script.replace("pair_coeff 1 1 1.0 1.0", "pair_coeff 1 1 lj/cut 1.0 1.0\npair_coeff 1 1 born 0.1 0.2 1.1 0.1 0.01")
        self.compare(script + "run 20\n")
        output = run("include ${load}\nsuffix dch\ndch on\n" + script + "run 20\ndch stats\n")
        self.assertIn("pair lj/cut/dch, cluster pairs: DCH", output)
        self.assertIn("pair born, half, newton on: DCH", output)

    def test_sub_styles_whose_cutoffs_differ_by_type(self):
        """From 2022 on, hybrid asks for a list with each sub-style's largest cutoff for all types."""
        script = MELT.replace("create_box 1", "create_box 2").replace("mass 1", "set type 1 type/fraction 2 0.5 881\nmass *")
        script = script.replace("pair_style lj/cut 2.5", "pair_style hybrid/overlay lj/cut 2.5 born 1.3")
        script = script.replace("pair_coeff 1 1 1.0 1.0", "pair_coeff * * lj/cut 1.0 1.0 1.4\n"
                                "pair_coeff 1 1 lj/cut 1.0 1.0 2.5\npair_coeff * * born 0.1 0.2 1.1 0.1 0.01")
        script += "compute near all rdf 50 1 1 cutoff 2.0\ncomm_modify cutoff 3.0\nfix 2 all ave/time 1 1 20 c_near[*] mode vector\n"
        script += "variable sum equal sum(f_2[2])\nthermo_style custom step temp epair press v_sum\nrun 20\n"
        plain = thermo_tables(run(script))
        for switch in ("dch on\ndch verify yes\n", "suffix dch\n", "suffix dch\ndch on\ndch verify yes\n"):
            ours = thermo_tables(run("include ${load}\n" + switch + script))
            for columns in zip(plain[0], ours[0]):
                self.assertLess(largest_relative_difference(*columns), 1e-9)

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

    def test_every_style_goes_through_restarts_and_data_files(self):
        for style, *words in STYLES:
            again = "pair_modify table 0\n" + ("kspace_style pppm 1e-4\n" if style.endswith("long") else "")
            script = salt_with(style, *words) + f"""
run 10
write_restart {host.work}/salt.restart
write_data {host.work}/salt.data pair ij
clear
dch precision double
read_restart {host.work}/salt.restart
{again}
fix 1 all nve
thermo_modify format float %.15g
run 10
"""
            from_data = f"""
clear
dch precision double
units lj
atom_style charge
pair_style {style} {words[0]}
read_data {host.work}/salt.data
{again}
thermo_modify format float %.15g
run 0
"""
            # The first writes no coefficients to data files, the second only the first of two types.
            has_data = style not in ("lj/cut/coul/dsf", "colloid")
            with self.subTest(style):
                self.assertEqual(len(self.compare(script + (from_data if has_data else ""))), 3 if has_data else 2)

    def test_every_style_refuses_what_the_plain_one_does(self):
        for style, *words in STYLES:
            with self.subTest(style):
                for wrong in (salt_with(style, "", *words[1:]), salt_with(style, words[0], "1.0 1.0 1.0 1.0 1.0 1.0 1.0", *words[2:])):
                    self.assertEqual(*(error_of(wrong + "run 0\n", before) for before in ("", "suffix dch\n")))

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

    def test_computes_that_ask_for_each_pair(self):
        """lmp_tally has one, as LAMMPS's package TALLY."""
        each = "compute each all each/pair\nthermo_style custom step temp epair press c_each c_each[*]\nrun 20\n"
        few = MELT.replace("lj/cut 2.5", "lj/cut 1.2")
        damped = salt_with("lj/cut/coul/dsf", *STYLES[2][1:])  # whose charges have an energy of their own
        for name, script in (("cluster pairs", MELT), ("pairs one by one", few), ("charges", damped)):
            for newton, ranks in (("on", 1), ("on", 2), ("off", 2)):
                with self.subTest(name, newton=newton, ranks=ranks):
                    tables = []
                    for suffix in ("", "suffix dch\n"):
                        output = run(f"newton {newton}\n{suffix}{script}{each}" + ("dch explain\n" if suffix else ""),
                                     ranks=ranks, executable=host.tools / "lmp_tally")
                        tables.append(thermo_tables(output)[-1])
                    self.assertIn("of 21 times 2 pair by pair, for computes that ask for each pair", output)
                    for plain, ours in zip(*tables):
                        shear = ("c_each[4]", "c_each[5]", "c_each[6]")  # which a lattice has none of
                        for name in shear:
                            self.assertLess(abs(plain.pop(name) - ours.pop(name)), 1e-9 * abs(plain["c_each[1]"]))
                        self.assertLess(largest_relative_difference(plain, ours), 1e-9)
                        self.assertLess(abs(ours["c_each"] - ours["E_pair"]), 1e-9 * abs(ours["E_pair"]))

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


if __name__ == "__main__":
    main(__doc__)
