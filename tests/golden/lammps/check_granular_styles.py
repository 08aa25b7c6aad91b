#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Granular pair styles with the suffix dch, in a real LAMMPS: grains go where those of the plain styles go.

Collisions double what rounding has left of two equal runs, in some dozens of steps: after a few hundred, numbers that
begin equal to 1e-16 agree to 1e-10 or so. A history that is lost or taken for that of another contact shows in the
third digit.
"""

import re
import unittest

from lammps_run import thermo_tables
from script_tests import host, main, run

STYLES = ("gran/hooke", "gran/hooke/history", "gran/hertz/history")
NUMBERS = "2000.0 NULL 50.0 NULL 0.5 1"

# A loose heap that falls onto a floor and rolls down it, in skins so thin that lists are made every few dozen steps.
HEAP = """
units lj
atom_style sphere{dynamic}
newton {newton}
boundary p p f
comm_modify vel yes
lattice sc 1.0 origin 0.5 0.5 0.5
region box block 0 8 0 6 0 9
create_box 2 box
region heap block INF INF INF INF 0 7
create_atoms 1 region heap
displace_atoms all random 0.03 0.03 0.03 4711
set type 1 type/fraction 2 0.4 881
variable size atom {sizes}
set group all diameter v_size
set group all density 1.2
velocity all create 3.0 4711 loop geom
{style}
neighbor 0.06 bin
neigh_modify delay 0 every 1 check yes
timestep 0.001
fix move all nve/sphere
fix down all gravity 5.0 chute 26.0
fix floor all wall/gran hooke/history 2000.0 NULL 50.0 NULL 0.5 1 zplane 0.0 NULL
thermo_style custom step atoms ke press pxx pzz pxz
thermo 50
thermo_modify format float %.15g lost warn
"""
POLYDISPERSE, MONODISPERSE = "0.8+0.25*random(0,1,4711)", "1.0"
WHERE = "id type xu yu zu vx vy vz omegax omegay omegaz"
LEAST = 1e-3  # in terms of which numbers differ that are 0 but for rounding
WAYS = {"suffix": "suffix dch\n", "dch on": "dch on\n", "both": "dch on\nsuffix dch\n"}


# Small grains above a bed of large ones that never move: LAMMPS's largest cutoff leaves out pairs of the bed.
BED = """
units lj
atom_style sphere 1
newton off
boundary p p f
comm_modify vel yes
lattice sc 1.2 origin 0.5 0.5 0.5
region box block 0 6 0 6 0 9
create_box 2 box
region bed block INF INF INF INF 0 2.9
region above block INF INF INF INF 3.1 8
create_atoms 1 region bed
create_atoms 2 region above
set type 1 diameter 1.15
set type 2 diameter 0.6
set group all density 1.0
group bed type 1
group small type 2
velocity small create 1.0 4711 loop geom
pair_style gran/hooke/history 2000.0 NULL 50.0 NULL 0.5 0
pair_coeff * *
neighbor {skin} bin
neigh_modify delay 0 every 1 check yes
timestep 0.0005
fix down all gravity 1.0 vector 0 0 -1
fix rest bed freeze
fix move small nve/sphere
thermo_style custom step atoms ke press
thermo 100
thermo_modify format float %.15g
"""


def heap(style="gran/hooke/history", numbers=NUMBERS, newton="off", sizes=POLYDISPERSE, dynamic=""):
    return HEAP.format(style=f"pair_style {style} {numbers}\npair_coeff * *", newton=newton, sizes=sizes, dynamic=dynamic)


def rows_of(path):
    lines = path.read_text().split("ITEM: ATOMS")[1].splitlines()[1:]
    return [[float(word) for word in line.split()] for line in lines]


class GranularStyles(unittest.TestCase):
    """Where grains are, how they move and turn, and what the thermo output says."""

    def outcome(self, script, ranks=1, way="", variables=()):
        dump = host.work / "dump.grains"
        text = f"include ${{load}}\n{way}{script}write_dump all custom {dump} {WHERE} modify sort id format float %.17g\n"
        output = run(text + ("dch explain\n" if way else ""), ranks=ranks, variables=variables)
        return output, thermo_tables(output), rows_of(dump)

    def expect_equal(self, first, second, tolerance):
        for tables in zip(first[1], second[1]):
            self.assertEqual(*map(len, tables))
            for columns in zip(*tables):
                for name in columns[0]:
                    scale = max(LEAST, *(abs(line[name]) for line in tables[0]))
                    self.assertLessEqual(abs(columns[0][name] - columns[1][name]), tolerance * scale, (name, columns))
        self.assertEqual(len(first[1]), len(second[1]))
        self.assertEqual(len(first[2]), len(second[2]))
        for column in range(len(first[2][0])):
            scale = max(LEAST, *(abs(row[column]) for row in first[2]))
            worst = max(abs(a[column] - b[column]) for a, b in zip(first[2], second[2]))
            self.assertLessEqual(worst, tolerance * scale, WHERE.split()[column])

    def compare(self, script, ranks=1, ways=WAYS, style="gran/hooke/history", tolerance=1e-8, builds=4):
        """The outcome of stock LAMMPS, which those of all ways to the style equal."""
        plain = self.outcome(script, ranks)
        made = [int(n) for n in re.findall(r"Neighbor list builds = (\d+)", plain[0])]
        self.assertGreaterEqual(sum(made), builds)
        for way in ways:
            ours = self.outcome(script, ranks, WAYS[way])
            self.expect_equal(plain, ours, tolerance)
            self.assertIn(f"pair {style}/dch: SIMD kernel of pairs that touch", ours[0])
        return plain

    def test_heaps(self):
        for style in STYLES:
            for newton, ranks in (("on", 1), ("off", 1), ("on", 2), ("off", 2)):
                with self.subTest(style=style, newton=newton, ranks=ranks):
                    self.compare(heap(style, newton=newton) + "run 300\n", ranks, ("suffix", "dch on") if ranks == 1 else ("both",), style)
        for style, newton in zip(STYLES[1:], ("off", "on")):
            self.compare(heap(style, newton=newton) + "run 300\n", 4, ("both",), style)
        self.compare(heap(sizes=MONODISPERSE) + "run 300\n", 2, ("both",))

    def test_arguments(self):
        for numbers in ("2000.0 500.0 50.0 10.0 0.2 1", "2000.0 NULL 300.0 NULL 0.01 0", "2000.0 NULL 50.0 NULL 0.0 1"):
            for style in STYLES:
                self.compare(heap(style, numbers) + "run 150\n", 1, ("suffix",), style, builds=2)

    def test_limited_damping(self):
        """Where the plain style knows it, as those of later versions do."""
        for style in ("gran/hooke/history", "gran/hertz/history"):
            script = heap(style, "2000.0 NULL 400.0 NULL 0.5 1 limit_damping") + "run 150\n"
            code, output = host.run_text(script)
            if code == 0:
                self.compare(script, 1, ("suffix",), style, builds=2)
            else:
                self.assertIn("Illegal pair_style command", output)
                code, output = host.run_text("include ${load}\nsuffix dch\n" + script)
                self.assertNotEqual(code, 0)
                self.assertIn("Illegal pair_style command", output)

    def test_frozen_grains_and_sorted_atoms(self):
        frozen = "region low block INF INF INF INF INF 1.2\ngroup low region low\nvelocity low set 0 0 0\nset group low diameter 0.85\nset group low density 1.2\nfix rest low freeze\natom_modify sort 20 0\n"
        for newton, ranks in (("on", 2), ("off", 1), ("off", 4)):
            self.compare(heap(newton=newton) + frozen + "run 300\n", ranks, ("suffix", "dch on"))
        apart = "neigh_modify exclude group low low\n"
        self.compare(heap("gran/hertz/history") + frozen + apart + "run 300\n", 2, ("both",), "gran/hertz/history")

    def test_grains_that_come_and_go(self):
        script = heap() + """run 100
group some id 5:300:7
delete_atoms group some compress no
create_atoms 2 single 2.2 2.3 7.9
set group all density 1.2
run 100
group more id 11:300:13
delete_atoms group more compress no
timestep 0.0007
run 100
"""
        for ranks in (1, 2):
            self.compare(script, ranks, ("suffix", "dch on"))

    def test_poured_grains(self):
        pour = ("region spout block 1 7 1 5 7.6 8.9\n"
                "fix pour all pour 60 1 4711 region spout diam range 0.7 1.0 dens 1.2 1.2 vol 0.3 20\n")
        script = heap().replace("fix down all gravity 5.0 chute 26.0", "fix down all gravity 5.0 vector 0 0 -1")
        for ranks in (1, 2):
            plain = self.compare(script + pour + "run 400\n", ranks, ("suffix", "dch on"))
            counts = [line["Atoms"] for line in plain[1][-1]]
            self.assertGreater(counts[-1], counts[0])

    def test_grains_that_grow(self):
        grow = "variable wide equal 0.95+0.0002*step\nfix grow all adapt 1 atom diameter v_wide\n"
        self.compare(heap(sizes="0.95", dynamic=" 1") + "run 0\n" + grow + "run 300\n", 2, ("suffix",))

    def test_pairs_beyond_the_largest_cutoff(self):
        """Of frozen grains, which LAMMPS leaves out of it, and of grains that have grown since the run began."""
        grow = "variable wide equal 0.6+0.0002*step\nfix grow small adapt 1 atom diameter v_wide\n"
        for script, ranks in ((BED.format(skin=0.1), 1), (BED.format(skin=0.1), 2), (BED.format(skin=0.3) + grow, 1)):
            plain = self.outcome(script + "run 400\n", ranks)
            for styles in ("no", "auto"):
                ours = self.outcome(script + "run 400\ndch stats\n", ranks, f"dch styles {styles}\ndch verify yes\ndch on\n")
                self.expect_equal(plain, ours, 1e-8)
                self.assertRegex(ours[0], r"verified +[1-9]")

    def test_restarts(self):
        """Of either kind of name, with the history; files of `dch on` are stock LAMMPS's. The style's line is given
        again, as the plain style leaves open behind a restart file whether damping is limited; `run 0` makes a list, as
        write_restart saves contacts with ghosts by numbers that these may no longer have."""
        file = host.work / "grains.restart"
        rest = HEAP[HEAP.index("neighbor 0.06"):]
        for style in STYLES[1:]:
            for ranks in (1, 2):
                write = heap(style) + f"run 150\nrun 0\nwrite_restart {file}\n"
                line = f"pair_style {style} {NUMBERS}\n"
                read = f"comm_modify vel yes\nread_restart {file}\n{line}{rest}run 150\n"
                self.outcome(write, ranks)
                plain = self.outcome(read, ranks)
                lost = self.outcome(read.replace(line, f"pair_style none\n{line}pair_coeff * *\n"), ranks)
                self.assertRaises(AssertionError, self.expect_equal, plain, lost, 1e-4)
                for writes, reads in (("suffix", "suffix"), ("dch on", "dch on"), ("", "dch on"), ("dch on", "")):
                    self.outcome(write, ranks, WAYS.get(writes, ""))
                    ours = self.outcome(read, ranks, WAYS.get(reads, ""))
                    self.expect_equal(plain, ours, 1e-8)
                    if reads:
                        self.assertIn(f"pair {style}/dch: SIMD kernel", ours[0])

    def test_hybrid(self):
        pairs = f"""pair_style hybrid gran/hooke/history {NUMBERS} gran/hertz/history 3000.0 NULL 40.0 NULL 0.3 1
pair_coeff 1 1 gran/hooke/history
pair_coeff * 2 gran/hertz/history"""
        for newton, ranks in (("off", 1), ("on", 2)):
            script = HEAP.format(style=pairs, newton=newton, sizes=POLYDISPERSE, dynamic="")
            for way in ("suffix dch\n", "dch on\n"):
                plain, ours = self.outcome(script + "run 300\n", ranks), self.outcome(script + "run 300\n", ranks, way)
                self.expect_equal(plain, ours, 1e-8)
                for style in STYLES[1:]:
                    self.assertIn(f"pair {style}/dch: SIMD kernel", ours[0])

    def test_rigid_bodies(self):
        """The masses of bodies count: the plain style computes."""
        bodies = "group first id 1 2\ngroup second id 20 21 22\ngroup free subtract all first second\nunfix move\n"
        bodies += "fix move free nve/sphere\nfix bodies all rigid group 2 first second\nneigh_modify exclude group first first exclude group second second\n"
        for ranks in (1, 2):
            script = heap() + bodies + "run 200\n"
            plain, ours = self.outcome(script, ranks), self.outcome(script, ranks, "suffix dch\n")
            self.expect_equal(plain, ours, 1e-10)
            self.assertIn("pair gran/hooke/history/dch: plain style, as masses of bodies count (fix rigid)", ours[0])

    def test_stress_by_atom_and_single_contacts(self):
        # single() reads velocities of ghosts, which are those of half a step before: lists of others show other numbers.
        shown = """compute each all stress/atom NULL pair
compute of all reduce sumsq c_each[1] c_each[4]
compute local all pair/local force p1 p4 p7
compute sums all reduce sumsq c_local[1] c_local[2] c_local[3] c_local[4] INPUTS_LOCAL
thermo_style custom step press pxy c_of[1] c_of[2] c_sums[1] c_sums[2] c_sums[3] c_sums[4]
"""
        for style in STYLES:
            for newton, ranks in (("on", 1), ("off", 2)):
                plain = self.compare(heap(style, newton=newton) + shown + "run 100\n", ranks, ("suffix",), style, builds=1)
                self.assertNotEqual(plain[1][-1][-1]["c_sums[2]"], 0)

    def test_first_forces(self):
        """Before any step, and of grains at rest on a lattice, where sums of squares are 0."""
        rest = heap(sizes="1.02").replace("displace_atoms", "#").replace("velocity", "#")
        for style in STYLES:
            script = rest.replace("gran/hooke/history 2", f"{style} 2", 1)
            self.compare(script + "run 0\nrun 1\nrun 20\n", 1, ("suffix", "dch on"), style, tolerance=1e-11, builds=0)

    def test_refusals(self):
        for bad, words in ((heap().replace("comm_modify vel yes", ""), "requires ghost atoms store velocity"),
                           (heap(numbers="2000.0 NULL 50.0 NULL -1 1"), "Illegal pair_style command"),
                           (heap(numbers="2000.0 NULL 50.0 NULL"), "Illegal pair_style command")):
            for way in ("suffix dch\n", "dch on\n"):
                code, output = host.run_text("include ${load}\n" + way + bad + "run 10\n")
                self.assertNotEqual(code, 0)
                self.assertIn(words, output)

    def test_taken_and_given_back(self):
        output = run("include ${load}\ndch on\n" + heap() + "run 20\ndch explain\ndch styles no\nrun 20\ndch explain\n")
        self.assertIn("DCH takes pair gran/hooke/history/dch in place of the plain style", output)
        self.assertIn("SIMD kernel of pairs that touch, in double precision, on one thread; taken by 'dch on'", output)
        self.assertIn("plain style, as 'dch styles no' was given; give 'dch styles auto'", output)


if __name__ == "__main__":
    main(__doc__)
