#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""What LAMMPS keeps of bonds and what is there need not agree: the same pairs and energies as in stock LAMMPS.

Atoms with the highest IDs are deleted and stay partners of others, in their lists of partners and in LAMMPS's map of
IDs. And in a skewed box LAMMPS takes the nearest image of a partner for a stranger, if it is more than half an edge away
along an axis.
"""

import unittest

from lammps_run import largest_relative_difference, thermo_tables
from script_tests import main, run

BONDS = """
units lj
{before}
atom_style bond
lattice {lattice} origin 0.25 0.25 0.25
region box {box}
create_box 1 box bond/types 1 extra/bond/per/atom 12 extra/special/per/atom 60
create_atoms 1 box
displace_atoms all random 0.1 0.1 0.1 4711
mass 1 1.0
bond_style harmonic
bond_coeff 1 10.0 1.2
pair_style lj/cut {cutoff}
pair_coeff 1 1 1.0 1.0
special_bonds lj 0.0 0.0 0.0
create_bonds many all all 1 0.1 {longest}
special_bonds lj {weights}
velocity all create 1.0 87287 loop geom
neighbor {skin} bin
timestep 0.002
fix 1 all nve
thermo 4
thermo_style custom step pe press pxy atoms
thermo_modify format float %.15g norm no
"""
DELETED = BONDS + """
group last id >= 200
group some id 3:200:5
run 3
delete_atoms group last bond yes
run 4
delete_atoms group some bond yes
run 8
"""
ALL_WEIGHTS = ("0.0 0.0 0.0", "0.0 1.0 1.0", "0.3 0.6 1.0")


class BondedPartners(unittest.TestCase):
    def check(self, script, ranks, atoms):
        stock = thermo_tables(run(script, ranks=ranks))
        self.assertEqual([table[-1]["Atoms"] for table in stock], atoms)
        for suffix in ("off", "dch"):
            styles = "" if suffix == "dch" else "dch styles no\n"
            output = run(f"include ${{load}}\ndch verify yes\ndch on\n{styles}suffix {suffix}\n{script}dch stats\n",
                         ranks=ranks)
            self.assertIn("all equal", output)
            for native, ours in zip(stock, thermo_tables(output)):
                self.assertLess(largest_relative_difference(native[-1], ours[-1]), 1e-9)

    def test_partners_that_were_deleted(self):
        for weights in ALL_WEIGHTS:
            for ranks in (1, 2):
                for cutoff in (1.5, 2.5):  # pairs one by one, and cluster pairs
                    with self.subTest(weights=weights, ranks=ranks, cutoff=cutoff):
                        self.check(DELETED.format(weights=weights, cutoff=cutoff, lattice="sc 0.5", skin=0.3, longest=1.2,
                                                  box="block 0 7 0 6 0 6", before=""), ranks, [252, 199, 159])

    def test_nearest_images_that_are_strangers(self):
        for weights in ALL_WEIGHTS:
            for faces in ("s p p", "p p p"):
                with self.subTest(weights=weights, faces=faces):
                    script = BONDS.format(weights=weights, cutoff=2.45, lattice="fcc 0.3", skin=0.14, longest=1.6,
                                          box="prism 0 3 0 6 0 2 0.179 -0.791 -0.637", before=f"boundary {faces}")
                    self.check(script + "run 3\n", 1, [144])


if __name__ == "__main__":
    main(__doc__)
