#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""eam/dch, eam/alloy/dch and eam/fs/dch in a real LAMMPS: forces, energies and stresses are those of the plain styles."""

import os
import unittest

from lammps_run import thermo_tables
from script_tests import TALLIES, error_of, forces_of, host, main, run

CRYSTAL = """
units metal
atom_style atomic
lattice fcc {lattice}
region box block 0 {cells} 0 6 0 5
create_box {types} box
create_atoms 1 box
{kinds}
{style}
displace_atoms all random 0.05 0.05 0.05 4711
velocity all create 900.0 87287 loop geom
neighbor 1.0 bin
neigh_modify delay 0 every 5 check no
fix 1 all nve
timestep 0.002
thermo_style custom step temp epair press pxx pyy pzz pxy pxz pyz
thermo 5
thermo_modify format float %.15g
"""
TWO_KINDS = "set type 1 type/fraction 2 0.4 4711"
THREE_KINDS = TWO_KINDS + "\nset type 1 type/fraction 3 0.3 4712"
SINGLE = """
compute local all pair/local eng force
compute ends all reduce sum c_local[1] c_local[2] INPUTS_LOCAL
compute most all reduce max c_local[1] c_local[2] INPUTS_LOCAL
thermo_style custom step epair c_ends[*] c_most[*]
thermo_modify format float %.15g
"""
WAYS = [(newton, ranks) for newton in ("on", "off") for ranks in (1, 2, 4)]
KERNELS = "SIMD kernels of rows of pairs, in double precision, on one thread"


def potential(name):
    return os.path.join(host.environment["LAMMPS_POTENTIALS"], name)


def crystal(style, types=1, kinds="", lattice=3.615, cells=7):
    return CRYSTAL.format(style=style, types=types, kinds=kinds, lattice=lattice, cells=cells)


def copper():
    return crystal(f"pair_style eam\npair_coeff * * {potential('Cu_u3.eam')}")


def two_files():
    """Files of different lengths, of which the plain style makes one table each; an atom of each type has its own."""
    lines = [f"pair_coeff {k} {k} {potential(name)}" for k, name in ((1, "Cu_u6.eam"), (2, "Ni_u3.eam"))]
    return crystal("pair_style eam\n" + "\n".join(lines) + "\nmass 1 63.5\n", 2, TWO_KINDS)


def one_file_for_two_types():
    return crystal(f"pair_style eam\npair_coeff * * {potential('Cu_u3.eam')}", 2, TWO_KINDS)


def alloy():
    return crystal(f"pair_style eam/alloy\npair_coeff * * {potential('CuNi.eam.alloy')} Ni Cu Ni", 3, THREE_KINDS, 3.57)


def finnis_sinclair():
    return crystal(f"pair_style eam/fs\npair_coeff * * {potential('AlFe_mm.eam.fs')} Al Fe", 2, TWO_KINDS, 4.0)


def densities_that_depend_on_both():
    """In the file above, as in most, iron has the density from aluminum that aluminum has from iron."""
    return crystal(f"pair_style eam/fs\npair_coeff * * {potential('NiAlH_jea.eam.fs')} Al Ni", 2, TWO_KINDS, 3.6)


SCENES = {"eam": (copper, two_files, one_file_for_two_types), "eam/alloy": (alloy,), "eam/fs": (finnis_sinclair, densities_that_depend_on_both)}


class Embedded(unittest.TestCase):
    def compare(self, script, before="suffix dch\n", tolerance=1e-10, **options):
        """Thermodynamic output of both, that of stock LAMMPS returned, with the other's whole output."""
        plain = thermo_tables(run(script, **options))
        return plain, self.expect_same(plain, script, before, tolerance, **options)

    def expect_same(self, plain, script, before, tolerance=1e-10, **options):
        ours = run("include ${load}\n" + before + script + "dch explain\n", **options)
        tables = plain, thermo_tables(ours)
        self.assertEqual(*map(len, tables))
        for pair in zip(*tables):
            self.assertEqual(*map(len, pair))
            for first, second in zip(*pair):
                pressure = max((abs(value) for name, value in first.items() if name.startswith("P")), default=0)
                for name, value in first.items():
                    scale = pressure if name.startswith("P") else max(abs(value), 1e-3)
                    self.assertLessEqual(abs(value - second[name]), tolerance * scale, (name, first, second))
        return ours

    def test_forces_energies_and_stresses_by_atom(self):
        for style, scenes in SCENES.items():
            for scene in scenes:
                for newton, ranks in WAYS:
                    with self.subTest(style, scene=scene.__name__, newton=newton, ranks=ranks):
                        plain, ours = (forces_of(f"newton {newton}\n" + scene(), suffix, ranks) for suffix in ("", "suffix dch\n"))
                        self.assertEqual(len(plain), len(ours))
                        for columns in ((0, 1, 2), (3,), range(4, 10)):
                            largest = max(abs(row[k]) for row in plain for k in columns)
                            off = max(abs(a[k] - b[k]) for a, b in zip(plain, ours) for k in columns)
                            self.assertGreater(largest, 0)
                            self.assertLess(off, 1e-12 * largest)

    def test_runs(self):
        for style, scenes in SCENES.items():
            for scene in scenes:
                for newton, ranks in (("on", 1), ("off", 2), ("on", 4)):
                    script = f"newton {newton}\n" + scene() + "run 15\n"
                    plain = thermo_tables(run(script, ranks=ranks))
                    for before in ("suffix dch\n", "dch on\n"):
                        with self.subTest(style, scene=scene.__name__, newton=newton, ranks=ranks, before=before):
                            output = self.expect_same(plain, script, before, ranks=ranks)
                            self.assertIn(f"pair {style}/dch: {KERNELS}", output)
                            self.assertEqual("DCH takes pair " + style + "/dch in place of the plain style" in output, before == "dch on\n")

    def test_energies_alone(self):
        """Which steps want that do not want pressures."""
        for newton, ranks in WAYS:
            with self.subTest(newton=newton, ranks=ranks):
                self.compare(f"newton {newton}\n" + alloy() + "thermo_style custom step temp epair\nthermo_modify format float %.15g\nrun 10\n", ranks=ranks)

    def test_tallies_at_every_step(self):
        for newton, ranks in WAYS:
            self.compare(f"newton {newton}\n" + alloy() + TALLIES + "run 10\n", ranks=ranks)

    def test_computes_that_ask_for_each_pair(self):
        """lmp_tally has one, as LAMMPS's package TALLY."""
        for newton, ranks in WAYS[:2] + WAYS[3:5]:
            script = f"newton {newton}\n" + alloy() + "compute each all each/pair\nthermo_style custom step temp epair press c_each c_each[*]\n"
            self.compare(script + "thermo_modify format float %.15g\nrun 10\n", ranks=ranks, executable=host.tools / "lmp_tally")

    def test_numbers_of_a_pair_of_atoms(self):
        """compute pair/local asks single(). Rows of other lists have their pairs the other way around, where the energy of
        embedding is shared out among others: its sum is the same, and forces are those of the same rows."""
        for style, scenes in SCENES.items():
            for scene in scenes:
                for ranks in (1, 2):
                    with self.subTest(style, scene=scene.__name__, ranks=ranks):
                        script = "newton on\n" + scene() + SINGLE + "run 0\n"
                        self.compare(script, "suffix dch\ndch off\n", ranks=ranks)

    def test_densities_beyond_the_table(self):
        self.compare(crystal(f"pair_style eam\npair_coeff * * {potential('Cu_u3.eam')}", lattice=2.2, cells=10) + "run 0\n")

    def test_few_atoms(self):
        """A dimer, an atom alone, and processes without atoms."""
        script = copper().replace("create_atoms 1 box", "create_atoms 1 single 0.5 0.5 0.5\ncreate_atoms 1 single 0.9 0.9 0.5\n"
                                  "create_atoms 1 single 5 4 3")
        for ranks in (1, 4):
            self.compare(script + "run 10\n", ranks=ranks)

    def test_scaled_potentials(self):
        """fix adapt scales by the plain style's array."""
        script = copper() + "variable scale equal 1.0+0.01*step\nfix 2 all adapt 1 pair eam scale * * v_scale\nrun 10\n"
        _, output = self.compare(script)
        self.assertRegex(output, r"; of 11 times 10 by the plain style, as the potential was scaled")

    def test_beside_another_style(self):
        overlay = crystal(f"pair_style hybrid/overlay eam/alloy lj/cut 4.0\npair_coeff * * eam/alloy {potential('CuNi.eam.alloy')} Ni Cu Ni\n"
                          "pair_coeff 1 2 lj/cut 0.01 2.5", 3, THREE_KINDS)
        beside = crystal(f"pair_style hybrid eam/alloy lj/cut 4.0\npair_coeff * * eam/alloy {potential('CuNi.eam.alloy')} Ni Cu NULL\n"
                         "pair_coeff * 3 lj/cut 0.1 2.3\nmass 3 40.0", 3, THREE_KINDS)
        for script in (overlay, beside):
            for newton, ranks in WAYS:
                with self.subTest(newton=newton, ranks=ranks):
                    _, output = self.compare(f"newton {newton}\n" + script + "run 10\n", ranks=ranks)
                    self.assertIn(f"pair eam/alloy/dch: {KERNELS}", output)

    def test_lists_hold_the_pairs_of_native_ones(self):
        for newton, ranks in WAYS:
            output = run(f"newton {newton}\ninclude ${{load}}\ndch verify yes\ndch on\n" + copper() + "run 10\ndch stats\n", ranks=ranks)
            self.assertRegex(output, r"verified +[1-9]\d* builds, \d+ pairs, all equal")

    def test_restart(self):
        """Files hold no functions, as those of the plain style do not: coefficients are given again."""
        file = host.work / "copper.restart"
        again = f"pair_style eam\npair_coeff * * {potential('Cu_u3.eam')}\n"
        end = copper()[copper().index("neighbor 1.0"):]
        script = copper() + f"run 10\nwrite_restart {file}\nclear\nread_restart {file}\n{again}{end}run 10\n"
        self.assertEqual(len(self.compare(script)[0]), 2)

    def test_units_that_the_plain_style_changes(self):
        script = copper().replace("units metal", "units real").replace("timestep 0.002", "timestep 1.0")
        _, output = self.compare(script + "run 10\n")
        self.assertIn("pair eam/dch: plain style, as the units of the potential are those of 'units metal'", output)
        self.compare(script + SINGLE + "run 0\n")

    def test_coefficients_that_change(self):
        self.compare(copper() + f"run 5\npair_coeff * * {potential('Cu_u6.eam')}\nrun 5\n")
        self.compare(alloy() + f"run 5\npair_coeff * * {potential('CuNi.eam.alloy')} Cu Cu Ni\nrun 5\n", ranks=2)

    def test_mixed_precision_is_double(self):
        self.compare(copper() + "run 10\n", "suffix dch\ndch precision mixed\n")

    def test_taken_and_given_back(self):
        output = run("include ${load}\ndch on\n" + copper() + "run 5\ndch styles no\nrun 5\ndch explain\n")
        self.assertIn("pair eam/dch: plain style, as 'dch styles no' was given; give 'dch styles auto'", output)

    def test_errors_are_the_plain_styles(self):
        for words in (("pair_style eam\n", "pair_style eam 3.0\n"), ("Cu_u3.eam", "none.eam"), ("pair_coeff * *", "pair_coeff *"),
                      ("Cu_u3.eam", "CuNi.eam.alloy")):
            said = {error_of(copper().replace(*words) + "run 1\n", before) for before in ("", "suffix dch\n", "dch on\n")}
            self.assertEqual(len(said), 1, said)


if __name__ == "__main__":
    main(__doc__)
