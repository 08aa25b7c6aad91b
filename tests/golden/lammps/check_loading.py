#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""The ways to load the package into a real LAMMPS: the loader's script, the launcher, LAMMPS as a library."""

import unittest

from lammps_run import largest_relative_difference, thermo_tables
from script_tests import MELT, host, main, run


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

    def test_launcher_takes_settings_before_the_script(self):
        script = run(MELT + "dch on\ndch verify yes\nrun 20\n", executable=host.lmp_dch)
        code, output = host.run_text(MELT + "run 20\ndch stats\n", executable=[host.lmp_dch, "-dch", "on,styles=no,verify=yes"])
        self.assertEqual(code, 0, output)
        self.assertIn("half, newton on: DCH", output)
        self.assertIn("DCH neighbor lists: on, verified at every build", output)
        self.assertEqual(thermo_tables(script), thermo_tables(output))

    def test_launcher_refuses_settings_that_dch_does_not_have(self):
        for words, message in ((["-dch", "on,speed=9"], "dch speed"), (["-dch"], "-dch lacks its settings")):
            code, output = host.run_text(MELT + "run 0\n", executable=[host.lmp_dch, *words])
            self.assertNotEqual(code, 0)
            self.assertIn(message, output)

    def test_as_a_plugin(self):
        code, output = host.run_text("suffix dch\n" + MELT + "dch on\nrun 20\ndch stats\nclear\n" + MELT + "run 20\n",
                                     executable=[host.tools / "plugin_host", host.loader.parent / "libdch_lammps.so"])
        self.assertEqual(code, 0, output)
        self.assertRegex(output, r"entered command dch\n(entered pair .*\n)*entered pair lj/cut/dch\n")
        self.assertIn("entered compute necklace/contact\n", output)
        self.assertIn("entered compute dch/work\n", output)
        self.assertIn("entered fix necklace/crossing\n", output)
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


if __name__ == "__main__":
    main(__doc__)
