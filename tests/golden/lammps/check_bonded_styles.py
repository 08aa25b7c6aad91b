#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Bond and angle styles with the suffix dch, in a real LAMMPS."""

from script_tests import ComparedWithStock, host, main, run


def bonded(style, coefficients):
    """Atoms near the points of a lattice with bonds of two types to the next ones."""
    return f"""
units lj
atom_style bond
lattice sc 1.0
region box block 0 6 0 6 0 6
create_box 1 box bond/types 2 extra/bond/per/atom 6 extra/special/per/atom 60
create_atoms 1 box
mass 1 1.0
pair_style lj/cut 1.3
pair_coeff 1 1 1.0 0.8
displace_atoms all random 0.05 0.05 0.05 4711
bond_style {style}
bond_coeff 1 {coefficients[0]}
bond_coeff 2 {coefficients[1]}
group odd id 1:300:2
group even subtract all odd
create_bonds many odd odd 1 0.8 1.2
create_bonds many odd even 2 0.8 1.2
neighbor 0.4 bin
"""


def angled(style, coefficients):
    """The same atoms with angles of two types at the corners of the lattice, straight ones among them."""
    angles = "\n".join(
        f"create_bonds single/angle {1 + k % 2} {k} {k + 1} {k + (2 if k % 5 == 1 and k % 6 < 5 else 7)}"
        for k in range(1, 205) if k % 6)
    return f"""
units lj
atom_style angle
lattice sc 1.0
region box block 0 6 0 6 0 6
create_box 1 box angle/types 2 extra/angle/per/atom 6 extra/special/per/atom 60
create_atoms 1 box
mass 1 1.0
pair_style lj/cut 1.3
pair_coeff 1 1 1.0 0.8
special_bonds lj 1 1 1
displace_atoms all random 0.05 0.05 0.05 4711
angle_style {style}
angle_coeff 1 {coefficients[0]}
angle_coeff 2 {coefficients[1]}
neighbor 0.4 bin
comm_modify cutoff 2.6
run 0
{angles}
"""


def forces_of(script, ranks):
    """Components of all forces, by ID, at a step that wants no energy; atoms stand still."""
    dump = host.work / "dump.forces"
    run(f"include ${{load}}\n{script}dump 1 all custom 1 {dump} id fx fy fz\ndump_modify 1 sort id format float %.17g\nrun 2\n",
        ranks=ranks)
    rows = dump.read_text().split("ITEM: ATOMS")[2].split("ITEM")[0].splitlines()[1:]
    return [float(word) for row in rows for word in row.split()[1:]]


class BondedStyles(ComparedWithStock):
    """Forces, virials, coefficients that change, restarts."""

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
        # A barostat wants the virial at every step, the energy at few; the second time with a bond that is too long.
        barostat = script.replace("fix 1 all nve", "fix 1 all nve\nfix 2 all press/berendsen iso 0.1 0.1 10.0")
        for second in ("4.98", "5.43"):
            self.compare(barostat, variables={"second": second})
        output = run("include ${load}\nsuffix dch\n" + script, variables={"second": "5.43"})
        self.assertGreater(output.count("FENE bond too long: "), 1)
        code, output = host.run_text("include ${load}\nsuffix dch\n" + script, variables={"second": "7.1"})
        self.assertNotEqual(code, 0)
        self.assertIn("Bad FENE bond", output)

    def test_harmonic_bonds(self):
        restart = host.work / "harmonic.restart"
        script = bonded("harmonic", ("30.0 1.0", "25.0 1.1"))
        rest = "fix 1 all nve\nfix 2 all press/berendsen iso 0.1 0.1 10.0\nthermo 30\nthermo_modify format float %.15g\nrun 60\n"
        again = f"write_restart {restart}\nclear\ndch precision double\nread_restart {restart}\n" + rest
        change = "bond_coeff 1 20.0 1.05\nrun 30\n"
        for newton in ("on", "off"):
            tables = self.compare(f"newton {newton}\n" + script + rest + again + change)
            self.assertEqual(len(tables), 3)
        output = run("include ${load}\nsuffix dch\n" + script + "run 0\ninfo styles bond\n")
        self.assertIn("harmonic/dch", output)

    def test_forces_of_bonds(self):
        for style, coefficients in (("harmonic", ("30.0 1.0", "25.0 1.1")), ("fene", ("30.0 1.5 1.0 1.0", "25.0 1.6 1.0 1.1"))):
            for ranks in (1, 2):
                stock, ours = (forces_of(words + bonded(style, coefficients), ranks) for words in ("", "suffix dch\n"))
                largest = max(map(abs, stock))
                self.assertGreater(largest, 1)
                self.assertTrue(stock != ours)
                self.assertLess(max(abs(a - b) for a, b in zip(stock, ours)), 1e-13 * largest)

    def test_angles(self):
        restart = host.work / "angles.restart"
        rest = "fix 1 all nve\nfix 2 all press/berendsen iso 0.1 0.1 10.0\nthermo 30\nthermo_modify format float %.15g\nrun 60\n"
        for style, coefficients, changed in (("harmonic", ("8.0 110", "5.0 95"), "6.0 120"), ("cosine", ("2.0", "1.5"), "2.5")):
            script = angled(style, coefficients)
            again = f"write_restart {restart}\nclear\ndch precision double\nread_restart {restart}\n" + rest
            for newton in ("on", "off"):
                tables = self.compare(f"newton {newton}\n" + script + rest + again + f"angle_coeff 1 {changed}\nrun 30\n")
                self.assertEqual(len(tables), 4)
            output = run("include ${load}\nsuffix dch\n" + script + "run 0\ninfo styles angle\n")
            self.assertIn(style + "/dch", output)

    def test_forces_of_angles(self):
        for style, coefficients in (("harmonic", ("8.0 110", "5.0 95")), ("cosine", ("2.0", "1.5"))):
            for ranks in (1, 2):
                stock, ours = (forces_of(words + angled(style, coefficients), ranks) for words in ("", "suffix dch\n"))
                largest = max(map(abs, stock))
                self.assertGreater(largest, 1)
                self.assertTrue(stock != ours)
                # The plain style divides an arc cosine, which loses digits at straight angles, by a sine near 0.
                self.assertLess(max(abs(a - b) for a, b in zip(stock, ours)), 1e-12 * largest)

    def test_stress_of_angles_by_atom(self):
        """Virials by atom, also of centroids, are the plain style's."""
        for style, coefficients in (("harmonic", ("8.0 110", "5.0 95")), ("cosine", ("2.0", "1.5"))):
            script = angled(style, coefficients) + """
compute each all stress/atom NULL angle
compute centroid all centroid/stress/atom NULL angle
compute sums all reduce sumsq c_each[1] c_each[4] c_centroid[2] c_centroid[9]
thermo_style custom step c_sums[1] c_sums[2] c_sums[3] c_sums[4]
thermo 10
thermo_modify format float %.15g
fix 1 all nve
run 20
"""
            plain = self.compare(script)
            self.assertGreater(plain[-1][-1]["c_sums[1]"], 0)


if __name__ == "__main__":
    main(__doc__)
