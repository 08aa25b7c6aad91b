# SPDX-License-Identifier: GPL-2.0-or-later
"""What tests of short scripts have in common: a melt to begin with, and LAMMPS to run it."""

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
# Beside pressures, sums over atoms and the largest of what is added up by atom.
TALLIES = """
compute pe all pe/atom
compute st all stress/atom NULL
compute se all reduce sum c_pe
compute ss all reduce sum c_st[1] c_st[2] c_st[4]
compute far all reduce max c_pe c_st[3]
thermo_style custom step temp epair press pxx pyy pzz pxy pxz pyz c_se c_ss[*] c_far[*]
thermo_modify format float %.15g
"""

host = Host.__new__(Host)  # main() fills it in, once the command line is known


def run(text, **options):
    code, output = host.run_text(text, **options)
    if code != 0:
        raise AssertionError(f"exit code {code}\n{output}")
    return output


def error_of(script, before="", ranks=1):
    """What a run stops with, without the process and the place in the source."""
    code, output = host.run_text("include ${load}\n" + before + script, ranks=ranks)
    if code == 0:
        raise AssertionError(f"no error\n{output}")
    said = [line for line in output.splitlines() if "ERROR" in line][0]
    return re.sub(r"^ERROR on proc \d+: | \(.*", "", said)


def forces_of(script, before="", ranks=1):
    """Of a script that has not run yet: by atom, with energies and stresses."""
    dump = host.work / "forces.dump"
    run("include ${load}\n" + before + script + "compute pe all pe/atom\ncompute st all stress/atom NULL virial\n"
        f"dump 1 all custom 1 {dump} fx fy fz c_pe c_st[*]\ndump_modify 1 sort id format float %.17g\nrun 0\n", ranks=ranks)
    rows = dump.read_text().split("ITEM: ATOMS")[1].splitlines()[1:]
    return [list(map(float, row.split())) for row in rows]


class ComparedWithStock(unittest.TestCase):
    """Scripts whose thermo output is the same with the suffix and without."""

    def compare(self, script, **options):
        plain = thermo_tables(run("include ${load}\n" + script, **options))
        ours = thermo_tables(run("include ${load}\nsuffix dch\n" + script, **options))
        self.assertEqual(len(plain), len(ours))
        for first, second in zip(plain, ours):
            for columns in zip(first, second):
                self.assertLess(largest_relative_difference(*columns), 1e-9)
        return plain


def main(description):
    parser = argparse.ArgumentParser(description=description)
    Host.add_arguments(parser)
    arguments, rest = parser.parse_known_args()
    host.__init__(arguments)
    unittest.main(argv=[sys.argv[0]] + rest, verbosity=2)
