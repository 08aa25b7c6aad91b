#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Fixes of ours that move atoms, in a real LAMMPS."""

import unittest

from script_tests import MELT, host, main, run

TWO_TYPES = MELT.replace("create_box 1", "create_box 2").replace(
    "mass 1 1.0", "set type 1 type/fraction 2 0.5 881\nmass 1 1.0\nmass 2 1.7").replace("pair_coeff 1 1", "pair_coeff * *")
MOVE = "fix 1 all nve\n"


def atoms_after(script, ranks=1, numbers="x y z vx vy vz"):
    """Numbers of each atom in the last frame, as they are printed in full, and all output."""
    dump = host.work / "dump.motion"
    code, output = host.run_text(f"{script}write_dump all custom {dump} id {numbers} modify sort id format float %.17g\n",
                                 ranks=ranks)
    if code != 0:
        raise AssertionError(output)
    return dump.read_text().split("ITEM: ATOMS")[-1].splitlines()[1:], output


class NVE(unittest.TestCase):
    """nve/dch has the bits of nve."""

    def compare(self, script, ranks=1):
        stock, _ = atoms_after(script, ranks)
        for ours in (script.replace("nve\n", "nve/dch\n"), script.replace("fix 1", "suffix dch\nfix 1")):
            found, output = atoms_after("include ${load}\n" + ours + "info fixes\n", ranks)
            self.assertRegex(output, r"style = *nve/dch")
            self.assertEqual(stock, found)
        return stock

    def test_one_type_on_any_number_of_processes(self):
        for ranks in (1, 2, 4):
            self.compare(MELT + "run 40\n", ranks)

    def test_types_of_two_masses(self):
        one, two = self.compare(MELT + "run 20\n"), self.compare(TWO_TYPES + "run 20\n")
        self.assertNotEqual(one, two)

    def test_groups(self):
        still = "region lower block INF INF INF INF INF 5\ngroup lower region lower\ngroup odd type 2\n"
        for group in ("lower", "odd"):
            self.compare(TWO_TYPES.replace(MOVE, still + f"fix 1 {group} nve\n") + "run 20\n")

    def test_the_group_that_stands_first_in_memory(self):
        script = TWO_TYPES.replace("neigh_modify", "group odd type 2\natom_modify first odd\nneigh_modify")
        self.compare(script.replace(MOVE, "fix 1 odd nve\n") + "run 20\n", 2)

    def test_masses_by_atom(self):
        script = MELT.replace("atom_style atomic", "atom_style sphere").replace(
            "mass 1 1.0", "variable m atom 1+0.001*id\nset type 1 diameter 0\nset type 1 mass v_m")
        self.compare(script + "run 20\n")

    def test_respa(self):
        self.compare(MELT + "run_style respa 2 2 pair 1\nrun 20\n")

    def test_steps_that_change(self):
        self.compare(MELT + "run 10\ntimestep 0.002\nrun 5 pre no\nrun 5\n"
                     "fix 2 all dt/reset 1 NULL 0.01 0.003 units box\nrun 20\n")

    def test_units_with_a_factor(self):
        script = MELT.replace("units lj", "units real").replace("fcc 0.8442", "fcc 5.26").replace(
            "create 1.44", "create 120").replace("lj/cut 2.5", "lj/cut 8.5").replace("1.0 1.0", "0.238 3.405")
        self.compare(script.replace("mass 1 1.0", "mass 1 39.95").replace("0.3 bin", "1.0 bin") + "run 20\n")


if __name__ == "__main__":
    main(__doc__)
