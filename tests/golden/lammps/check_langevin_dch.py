#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""fix langevin/dch in a real LAMMPS: every bit of fix langevin."""

import unittest

from check_langevin import GAS, SEED, atoms_after
from lammps_run import thermo_tables
from script_tests import MELT, host, main, run


class Bits(unittest.TestCase):
    """fix langevin/dch has every bit of fix langevin, on as many processes."""

    TWO = MELT.replace("create_box 1", "create_box 2").replace(
        "mass 1 1.0", "set type 1 type/fraction 2 0.5 881\nmass 1 1.0\nmass 2 1.7").replace("coeff 1 1", "coeff * *")
    NUMBERS = "x y z vx vy vz fx fy fz"

    def compare(self, bath, before="", after="run 30\n", ranks=(1, 2), start=TWO, note="SIMD kernel"):
        """The word LANGEVIN is the style. `dch explain` says who has computed."""
        for count in ranks:
            script = start + before + f"fix 2 {bath}\n" + after
            output = run("include ${load}\n" + script.replace("LANGEVIN", "langevin/dch") + "dch explain\n", ranks=count,
                         variables={"size": 4})
            self.assertRegex(output, f"fix 2, langevin/dch: {note}")
            stock = atoms_after(script.replace("LANGEVIN", "langevin"), count, numbers=self.NUMBERS)
            self.assertTrue(stock == atoms_after(script.replace("LANGEVIN", "langevin/dch"), count, numbers=self.NUMBERS),
                            (bath, count))
            self.assertFalse(stock == atoms_after(script.replace("LANGEVIN", "langevin/dch").replace("4711", "4712"), count,
                                                  numbers=self.NUMBERS))

    def test_temperatures(self):
        self.compare("all LANGEVIN 1.0 1.0 0.5 4711", ranks=(1, 2, 4))
        self.compare("all LANGEVIN 0.5 2.5 0.5 4711", after="run 20\nrun 13\nrun 7 pre no\n")
        self.compare("all LANGEVIN v_t 1.0 0.5 4711", before="variable t equal 1+step/64\n")
        self.compare("all LANGEVIN v_t 1.0 0.5 4711", before="variable t atom 0.5+x/10\n")

    def test_groups_scale_and_zero(self):
        for words in ("type 2", "id 1:800:3", "id 5"):
            self.compare("some LANGEVIN 1.0 1.0 0.5 4711", before=f"group some {words}\n")
        self.compare("all LANGEVIN 1.0 1.0 0.5 4711 scale 2 3.5 zero yes tally no omega no", ranks=(1, 4))
        self.compare("some LANGEVIN 1.0 1.0 0.5 4711 zero yes", before="group some id 1:800:3\n")

    def test_two_at_once_and_a_time_step_that_changes(self):
        self.compare("light LANGEVIN 1.0 1.0 0.5 4711", before="group light type 1\ngroup heavy type 2\n"
                     "fix 3 heavy langevin 1.0 1.0 0.3 88\nfix 4 all dt/reset 5 0.001 0.004 0.02 units box\n")

    def test_masses_by_atom(self):
        """Of grains: drag and noise by the mass of each."""
        start = GAS.replace("atom_style atomic", "atom_style sphere").replace("mass 1 1.0\nmass 2 1.7\n", "") + (
            "set type 1 diameter 0.9\nset type 2 density 2.5\nfix 1 all nve/sphere\n")
        for words in ("", " scale 2 0.7 zero yes"):
            self.compare(f"all LANGEVIN 1.0 1.0 0.5 4711{words}", start=start)
        self.compare("all LANGEVIN 1.0 1.0 0.5 4711 omega yes", start=start, note="plain style, as kernels do not know omega yes")

    def test_bias(self):
        """Atoms at rest along an axis take no noise there."""
        for compute in ("temp/partial 1 1 0", "temp/com", "temp/profile 1 1 1 z 4"):
            for words in ("", " zero yes"):
                self.compare(f"all LANGEVIN 1.0 1.0 0.5 4711{words}", before=f"compute t all {compute}\n",
                             after="fix_modify 2 temp t\nrun 20\n")
        self.compare("all LANGEVIN 1.0 1.0 0.5 4711", before="compute t all temp\n", after="fix_modify 2 temp t\nrun 20\n")

    def test_a_bias_that_changes(self):
        """Without a setup the compute that is named last goes on, as a bias even if it takes none away; the first one waits for a setup."""
        computes = "compute a all temp/profile 1 1 1 z 4\ncompute b all temp/partial 0 1 1\ncompute c all temp\n"
        for later in ("b\nuncompute a", "c"):
            self.compare("all LANGEVIN 1.0 1.0 0.5 4711", before=computes,
                         after=f"fix_modify 2 temp a\nrun 10\nfix_modify 2 temp {later}\nrun 10 pre no\nrun 5\n")
        self.compare("all LANGEVIN 1.0 1.0 0.5 4711", before=computes,
                     after="run 10\nfix_modify 2 temp a\nrun 10 pre no\nrun 5\n")

    def test_what_the_plain_style_computes(self):
        self.compare("all LANGEVIN 1.0 1.0 0.5 4711 tally yes", note="plain style, as kernels do not know tally yes",
                     after="thermo_style custom step temp pe etotal f_2\nrun 20\n")
        gjf = self.TWO.replace("fix 1 all nve\n", "")
        for kind in ("vhalf", "vfull"):
            self.compare(f"all LANGEVIN 1.0 1.0 0.5 4711 gjf {kind}", start=gjf, after="fix 1 all nve\nrun 30\n",
                         note=f"plain style, as kernels do not know gjf {kind}")
        self.compare("all LANGEVIN 1.0 1.0 0.5 4711", after="run_style respa 2 2 bond 1 pair 2\nrun 20\n",
                     note="plain style, as kernels do not know r-RESPA")

    def test_energy_that_the_bath_takes(self):
        tables = []
        for style in ("langevin", "langevin/dch"):
            script = f"fix 2 all {style} 1.0 1.0 0.5 4711 tally yes\n"
            script += "thermo_style custom step temp pe etotal ecouple econserve f_2\nthermo 5\nrun 20\n"
            tables.append(thermo_tables(run("include ${load}\n" + self.TWO + script)))
        self.assertEqual(*tables)
        self.assertNotEqual(tables[0][0][-1]["f_2"], 0)

    def test_numbers_begin_again_with_r_respa(self):
        output = run("include ${load}\n" + self.TWO + "fix 2 all langevin/dch 1.0 1.0 0.5 4711\nrun 5\n"
                     "run_style respa 2 2 bond 1 pair 2\nrun 5\n")
        self.assertIn("WARNING: Fix langevin/dch 2: random numbers begin again with 'run_style respa'", output)

    def test_numbers_go_on_behind_a_minimization_under_r_respa(self):
        self.compare("all LANGEVIN 1.0 1.0 0.5 4711",
                     after="run 10\nrun_style respa 2 2 bond 1 pair 2\nminimize 0 0 1 1\nrun_style verlet\nrun 10\n")

    def test_the_suffix_and_dch_on_take_it(self):
        script = MELT.replace("fix 1", "suffix dch\nfix 1") + f"fix 2 all langevin 1.0 1.0 1.0 {SEED}\nrun 20\n"
        output = run("include ${load}\n" + script + "info fixes\n")
        self.assertRegex(output, r"style = *nve/dch")
        self.assertRegex(output, r"style = *langevin/dch")
        self.assertEqual(atoms_after(script.replace("suffix dch\n", "")), atoms_after(script))
        for words, taken in (("", "DCH takes langevin/dch in place of the plain style"), ("dch styles no\n", "")):
            output = run("include ${load}\n" + words + "dch on\n" + script.replace("suffix dch\n", ""))
            self.assertEqual("DCH takes langevin/dch" in output, bool(taken))
            self.assertIn(taken, output)

    def test_refused(self):
        """What the plain style refuses, with its messages, and variables that end as no temperature."""
        for words, message in (("1.0 1.0 0.5", "Illegal fix langevin"), ("1.0 1.0 -0.5 4711", "period must be > 0.0"),
                               ("1.0 1.0 0.5 900000001", "Invalid seed"), ("1.0 1.0 0.5 4711 zero", "Illegal fix langevin"),
                               ("1.0 1.0 0.5 4711 scale 7 1.0", "Illegal fix langevin"),
                               ("v_none 1.0 0.5 4711", "Variable name .*for fix langevin does not exist"),
                               ("v_t 1.0 0.5 4711", "variable 't' is -1.* but has to be a temperature of 0 or more"),
                               ("v_a 1.0 0.5 4711", "variable 'a' is -1.* but has to be a temperature of 0 or more")):
            code, output = host.run_text("include ${load}\nvariable t equal -1\nvariable a atom -1\n" + self.TWO +
                                         f"fix 2 all langevin/dch {words}\nrun 0\n")
            self.assertNotEqual(code, 0)
            self.assertRegex(output, message)
        code, output = host.run_text("include ${load}\n" + self.TWO + "compute t all temp/com\n"
                                     "fix 2 all langevin/dch 1.0 1.0 0.5 4711\nfix_modify 2 temp t\nrun 1\nuncompute t\nrun 1\n")
        self.assertNotEqual(code, 0)
        self.assertIn("there is no compute 't' any more; give 'fix_modify' again", output)


if __name__ == "__main__":
    main(__doc__)
