#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Atom IDs that differ in nothing but bits beyond 32: lists, forces and necklaces are those of the same atoms with short IDs."""

import itertools
import re
import unittest

from lammps_run import largest_relative_difference, thermo_tables
from script_tests import error_of, host, main, run

# The generator's walks overlap.
CHAINS = """
units lj
atom_style bond
newton on {newton}
special_bonds lj {weights}
read_data {data} extra/bond/per/atom 2 extra/special/per/atom 20
mass * 1.0
velocity all create 1.0 87287 loop geom
pair_style soft 1.6
pair_coeff * * 1.0
bond_style harmonic
bond_coeff * 200.0 0.97
neighbor 0.4 bin
neigh_modify delay 0 every 1 check yes
comm_modify cutoff 3.5
fix move all nve
timestep 0.01
thermo 20
thermo_style custom step pe press pxy
thermo_modify format float %.15g
"""
WATCHED = """
compute touch all necklace/contact 0.05 radius 0.45
fix cross all necklace/crossing 10 action count
thermo_style custom step pe press c_touch f_cross f_cross[*]
"""


def same_low_bits(short):
    """IDs with the same low 32 bits. Most are 2^40 or more, by which points have no names that a hierarchy could keep."""
    return (int(short) << 32) + 7


def below_2_40(short):
    """IDs beyond 32 bits by which points have names."""
    return (1 << 39) + 300_000_000 * int(short)


def renumbered(number):
    """The data file of chains with IDs made by number(short)."""
    section, lines = "", []
    for line in host.variables["data"].read_text().splitlines():
        words = line.split()
        if words and words[0] in ("Masses", "Atoms", "Bonds", "Velocities"):
            section = words[0]
        elif words and section == "Atoms":
            line = " ".join([str(number(words[0]))] + words[1:])
        elif words and section == "Bonds":
            line = " ".join(words[:2] + [str(number(k)) for k in words[2:]])
        lines.append(line)
    data = host.work / f"{number.__name__}.data"
    data.write_text("\n".join(lines) + "\n")
    return data


class LongIds(unittest.TestCase):
    def script(self, number, newton="on", weights="0.0 0.3 1.0"):
        return CHAINS.format(data=renumbered(number), newton=newton, weights=weights)

    def assert_same(self, first, second):
        first, second = thermo_tables(first), thermo_tables(second)
        self.assertEqual(len(first), len(second))
        for tables in zip(first, second):
            for rows in zip(*tables):
                self.assertLess(largest_relative_difference(*rows), 1e-9)

    def test_lists_and_forces(self):
        runs = ((1, "on", "0.0 0.3 1.0"), (1, "on", "0.0 1.0 1.0"), (2, "on", "0.0 1.0 1.0"), (2, "off", "0.0 0.3 1.0"),
                (4, "on", "0.0 0.3 1.0"))
        for number, (ranks, newton, weights) in itertools.product((same_low_bits, below_2_40), runs):
            with self.subTest(number=number.__name__, ranks=ranks, newton=newton, weights=weights):
                script = self.script(number, newton, weights) + "run 40\n"
                stock = run(script, ranks=ranks)
                self.assertEqual(len(thermo_tables(stock)[0]), 3, stock)
                for before in ("dch styles no\ndch on\n", "dch on\n"):
                    output = run("include ${load}\ndch verify yes\n" + before + script + "dch stats\n", ranks=ranks)
                    self.assertIn("all equal", output)
                    self.assert_same(stock, output)

    def test_necklaces(self):
        """Crossings begin where a restart has left them, through image flags and partners of each atom."""
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                outputs = []
                for number in (int, same_low_bits):
                    script = "include ${load}\n" + self.script(number, "off") + WATCHED
                    kept = host.work / f"{number.__name__}.restart"
                    first = run(script + f"run 40\nwrite_restart {kept}\n", ranks=ranks)
                    again = re.sub(r"read_data.*\n", f"read_restart {kept}\n", script)
                    outputs.append((first, run(again + "run 40\n", ranks=ranks)))
                for short, long in zip(*outputs):
                    self.assert_same(short, long)
                last = thermo_tables(outputs[1][1])[0][-1]
                self.assertGreater(last["c_touch"], 0)
                self.assertGreater(last["f_cross[1]"], 0, "no bonds have crossed")

    def test_random_numbers_by_id(self):
        script = self.script(same_low_bits)
        bath = "fix bath all langevin/philox 1.0 1.0 0.5 904297\n"
        self.assertRegex(error_of(script + bath + "run 1\n"),
                         r"^Atom ID \d{10,} is beyond 2147483647, up to which .* draw random numbers by ID")
        drawn = "include ${load}\n" + self.script(int) + bath + "run 20\n"
        self.assertEqual(len(thermo_tables(run(drawn))[0]), 2)

    def test_dissipative_pairs(self):
        pair = "comm_modify vel yes\npair_style dpd/philox 1.0 2.0 34387\npair_coeff * * 25.0 4.5\nrun 1\n"
        self.assertIn("is beyond 2147483647", error_of(self.script(same_low_bits) + pair))


if __name__ == "__main__":
    main(__doc__)
