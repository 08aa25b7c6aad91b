#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""fix necklace/crossing in a real LAMMPS, against all pairs of bonds in exact arithmetic.

The short test has each case on one number of processes. With DCH_TEST_LONG set all cases are on all. More than 300 lines:
all classes share the scripts that they vary."""

import os
import re
import unittest
from pathlib import Path

from crossing_oracle import crossings, read_bonds, read_frames, read_rows
from lammps_run import thermo_tables
from script_tests import host, main, run

# Random walks that hardly repel each other: they go through each other all the time. The forces do not depend on
# the number of processes but for rounding, and there is no thermostat, so short runs are the same on any number.
SOFT = """
include ${load}
units lj
atom_style bond
newton ${newton}
special_bonds lj 1 1 1
read_data ${data} extra/bond/per/atom 2 extra/special/per/atom 20
mass * 1.0
pair_style soft 1.0
pair_coeff * * 1.0
bond_style harmonic
bond_coeff * 200.0 0.97
neighbor 0.4 bin
neigh_modify delay 0 every 1 check yes
comm_modify cutoff 5.0
velocity all create 1.0 87287 loop geom
"""
MOVE = "fix move all nve\n"
WATCH = """
timestep 0.01
fix cross ${group} necklace/crossing ${arguments}
thermo 10
thermo_style custom step press f_cross f_cross[1] f_cross[2] f_cross[3] f_cross[4] f_cross[5] f_cross[6]
dump atoms all custom 10 atoms id x y z ix iy iz
dump_modify atoms sort id format float %.17g
dump events all local 10 events f_cross[1] f_cross[2] f_cross[3] f_cross[4] f_cross[5] f_cross[6] f_cross[7] f_cross[8] f_cross[9]
dump_modify events format float %.17g
"""
VARIABLES = {"newton": "on", "group": "all", "arguments": "10 action count"}

# Two rings of twelve atoms, the second in a plane across the first one's, which drifts through it and out again.
RINGS = """
include ${load}
units lj
atom_style bond
newton on
boundary p p p
region box block -12 12 -12 12 -12 12
create_box 1 box bond/types 1 extra/bond/per/atom 2 extra/special/per/atom 12
mass 1 1.0
variable number loop 12
label next
variable x equal 1.9*cos(2*PI*v_number/12)
variable y equal 1.9*sin(2*PI*v_number/12)
create_atoms 1 single $x $y 0.013 units box
next number
jump SELF next
variable number loop 12
label again
variable x equal 1.9*cos(2*PI*v_number/12)-4.3+0.017
variable z equal 1.9*sin(2*PI*v_number/12)+0.031
create_atoms 1 single $x 0.23 $z units box
next number
jump SELF again
variable bead loop 12
label bond
variable other equal v_bead%12+1
if "${bead} < 12" then "create_bonds single/bond 1 ${bead} ${other} special no"
variable first equal v_bead+12
variable second equal v_other+12
if "${bead} < 12" then "create_bonds single/bond 1 ${first} ${second} special no"
next bead
jump SELF bond
create_bonds single/bond 1 1 12 special no
create_bonds single/bond 1 13 24 special yes
pair_style zero 5.0
pair_coeff * *
bond_style zero
bond_coeff *
comm_modify cutoff 6.0
timestep 0.01
group second id > 12
fix move second move linear 1.0 0 0
"""


IS_LONG = "DCH_TEST_LONG" in os.environ


def some(*cases):
    """All cases in the long test, the last one in the short test."""
    return cases if IS_LONG else cases[-1:]


class Crossings(unittest.TestCase):
    straight = None  # what a run of 60 steps on one process says, its events and their rows

    def events_of_dump(self):
        return {step: rows for step, rows in read_rows(host.work / "events")}

    def compare(self, only=lambda bond: True, least=20, signs=True, bonds=None):
        """Events of the dump against the oracle; returns the rows, in order."""
        frames, events = read_frames(host.work / "atoms"), self.events_of_dump()
        bonds = sorted(filter(only, bonds or read_bonds(Path(host.variables["data"]))))
        total, all_rows = 0, []
        for old, new in zip(frames, frames[1:]):
            wanted = crossings(old, new, bonds)
            rows = sorted(events[new.step])
            self.assertEqual(sorted(pair for pair in wanted for _ in wanted[pair]),
                             [tuple(int(x) for x in row[:4]) for row in rows], new.step)
            flat = [event for pair in sorted(wanted) for event in wanted[pair]]
            for (step, sign), row in zip(flat, rows):
                self.assertAlmostEqual(step, row[4], delta=1e-6)
                if signs:
                    self.assertEqual(sign * SIGN_OF_VOLUME, row[5])
            total += len(rows)
            all_rows += rows
        self.assertGreaterEqual(total, least)
        return all_rows

    def soft(self, script=MOVE, ranks=1, steps=60, **variables):
        return run(SOFT + script + WATCH + f"run {steps}\n", ranks=ranks, variables={**VARIABLES, **variables})

    def straight_run(self):
        """With warnings. Made once; every run of LAMMPS takes a while to begin."""
        if Crossings.straight is None:
            output = self.soft(arguments="10")
            Crossings.straight = output, self.events_of_dump(), self.compare()
        return Crossings.straight

    def test_soft_chains_on_one_two_and_four_processes(self):
        tables, found = [], []
        for ranks in (1, 2, 4):
            if ranks == 1:
                output, _, rows = self.straight_run()
            else:
                output, rows = self.soft(ranks=ranks), self.compare()
                self.assertNotIn("WARNING: Fix necklace/crossing", output)
            tables.append([[line[column] for column in line if column.startswith("f_")] for line in thermo_tables(output)[0]])
            found.append(rows)
            self.assertEqual(len(found[-1]), tables[-1][-1][0])
            self.assertEqual(tables[-1][-1][0], tables[-1][-1][2])
        # The same counts, of pairs and of those that the filter rejects too.
        self.assertEqual(tables[0], tables[1])
        self.assertEqual(tables[0], tables[2])
        total, rejected = tables[0][-1][5:]
        self.assertGreater(rejected, 0.95 * total)
        for rows in found[1:]:
            self.assertEqual([row[:4] + row[5:6] for row in found[0]], [row[:4] + row[5:6] for row in rows])

    def test_warnings(self):
        output, _, rows = self.straight_run()
        lines = [line for line in output.splitlines() if "Fix necklace/crossing" in line]
        first = [line for line in lines if "went through bond" in line]
        self.assertEqual(1, len(first), output)
        self.assertRegex(first[0], r"bond \d+-\d+ went through bond \d+-\d+ at step [\d.]+ \(checked at step \d+\)")
        self.assertEqual(1, sum(f"{len(rows)} crossings of bonds from step 0 to 60, 0 undetermined" in line for line in lines))

    def test_bonds_of_a_group_with_newton_off_and_sorted_atoms(self):
        self.soft(MOVE + "group part id <= 260\natom_modify sort 7 1.0\n", ranks=2, group="part", newton="off")
        self.compare(only=lambda bond: bond[1] <= 260, least=5)

    def test_other_intervals(self):
        """Checks every step find what the oracle finds in frames of every step. One process needs no ghosts."""
        script = SOFT.replace("comm_modify cutoff 5.0\n", "") + MOVE + WATCH.replace("all custom 10", "all custom 1").replace("all local 10", "all local 1")
        run(script + "run 30\n", variables={**VARIABLES, "arguments": "1 action count"})
        self.compare(least=5)

    def test_a_melt_of_hard_chains_has_none(self):
        """The same chains, pushed apart until FENE and WCA hold them."""
        push = """
variable push equal ramp(1,60)
fix push all adapt 1 pair soft a * * v_push
fix bath all langevin 1.0 1.0 0.5 904297
fix move all nve/limit 0.05
pair_style soft 1.12246
pair_coeff * * 0.0
bond_style fene
bond_coeff * 30.0 1.5 1.0 1.0
special_bonds fene
run 300
unfix push
pair_style lj/cut 1.12246
pair_modify shift yes
pair_coeff * * 1.0 1.0 1.12246
run 200
unfix move
unfix bath
fix move all nve
"""
        push = push.replace("pair_style soft 1.12246\npair_coeff * * 0.0\n", "")
        output = run(SOFT.replace("soft 1.0", "soft 1.12246").replace("pair_coeff * * 1.0", "pair_coeff * * 0.0") + push +
                     WATCH.replace("timestep 0.01", "timestep 0.006") + "run 200\n",
                     ranks=2, variables={**VARIABLES, "arguments": "10 action stop"})
        last = thermo_tables(output)[-1][-1]
        self.assertEqual([0, 0, 0], [last["f_cross"], last["f_cross[3]"], last["f_cross[4]"]])
        self.assertGreater(last["f_cross[5]"], 1000)
        self.compare(least=0)

    def test_a_box_that_changes(self):
        """By fix npt; and sheared by fix deform, whose box flips back, on one process and on two."""
        npt = "fix press all npt temp 1.0 1.0 1.0 iso 0.3 3.0 2.0\n"
        shear = "change_box all triclinic\nfix shape all deform 1 xy erate 1.2 xz erate -0.5 remap x flip yes\n" + MOVE
        for script, ranks in (*some((npt, 1), (npt, 2)), (shear, 1), (shear, 2)):
            steps = 60 if script is npt else 100
            self.soft(script, ranks, steps)
            self.compare()
            frames = read_frames(host.work / "atoms")
            cells = [frame.cell for frame in frames]
            self.assertNotEqual(cells[0][0][0 if script is npt else 1], cells[-1][0][0 if script is npt else 1])
            if script is shear:
                self.assertTrue(any(b[0][1] < a[0][1] for a, b in zip(cells, cells[1:])), "no flip")

    def test_a_restart_goes_on_within_the_interval(self):
        """At step 25, that is half way between two checks, on one process, and on two after it."""
        script = SOFT + MOVE + WATCH
        _, wanted, straight = self.straight_run()
        run(script + "run 25\nwrite_restart half.restart\n", ranks=2, variables=VARIABLES)
        before = self.events_of_dump()
        again = SOFT.replace("read_data ${data} extra/bond/per/atom 2 extra/special/per/atom 20", "read_restart half.restart")
        again = "\n".join(line for line in again.splitlines() if not line.startswith(("velocity", "atom_style", "units")))
        for ranks in (1, 2):
            output = run(again + "\n" + MOVE + WATCH + "run 35\n", ranks=ranks, variables=VARIABLES)
            after = self.events_of_dump()
            for step in (30, 40, 50, 60):
                rows = [[row[:4] + row[5:6] for row in sorted(table[step])] for table in (wanted, after)]
                self.assertEqual(*rows, step)
            # The totals go on, too.
            self.assertEqual(len(straight), thermo_tables(output)[0][-1]["f_cross"])
            self.assertEqual(sum(len(rows) for step, rows in before.items()), thermo_tables(output)[0][0]["f_cross"])

    def test_rings_that_are_drawn_through_each_other(self):
        """The sum of signs is the linking number: linked, linked the other way round, and not at the end."""
        for ranks in some(1, 2):
            run(RINGS + WATCH + "run 900\n", ranks=ranks, variables=VARIABLES)
            bonds = [(k + 12 * ring, k + 1 + 12 * ring) for ring in (0, 1) for k in range(1, 12)] + [(1, 12), (13, 24)]
            rows = self.compare(least=4, signs=False, bonds=bonds)
            sums = [sum(row[5] for row in rows if row[4] <= step) for step in (300, 500, 900)]
            self.assertEqual([1, -1, 0], [sums[0] * sums[0], sums[0] * sums[1], sums[2]], rows)
            self.assertTrue(all(row[5] in (-1, 1) for row in rows))


@unittest.skipUnless(IS_LONG, "minutes")
class LongRuns(unittest.TestCase):
    def test_rare_checks_find_nearly_as_much(self):
        """Soft chains checked every step, every five and every ten. What crosses there and back in between goes unseen."""
        fixes = "".join(f"fix every{n} all necklace/crossing {n} action count\n" for n in (1, 5, 10))
        output = run(SOFT + MOVE + fixes + "timestep 0.01\nthermo_style custom step f_every1 f_every5 f_every10\nrun 1000\n",
                     variables=VARIABLES)
        line = thermo_tables(output)[0][-1]
        self.assertGreater(line["f_every1"], 200)
        self.assertGreaterEqual(line["f_every5"], 0.95 * line["f_every1"])
        self.assertGreaterEqual(line["f_every10"], 0.85 * line["f_every1"])
        self.assertGreaterEqual(line["f_every1"], line["f_every10"])

    def test_the_melt_of_the_benchmark_has_none(self):
        """320 chains of 100, the data of LAMMPS's benchmark of chains."""
        data = Path(host.variables["examples"]) / "COUPLE" / "multiple" / "data.chain"
        output = run(f"""
include ${{load}}
units lj
atom_style bond
special_bonds fene
read_data {data}
neighbor 0.4 bin
neigh_modify every 1 delay 1
bond_style fene
bond_coeff 1 30.0 1.5 1.0 1.0
pair_style lj/cut 1.12
pair_modify shift yes
pair_coeff 1 1 1.0 1.0 1.12
fix move all nve
fix bath all langevin 1.0 1.0 10.0 904297
fix cross all necklace/crossing 10 action stop
timestep 0.012
thermo_style custom step temp f_cross f_cross[4] f_cross[5]
run 5000
""")
        line = thermo_tables(output)[0][-1]
        self.assertEqual([0, 0], [line["f_cross"], line["f_cross[4]"]])
        self.assertGreater(line["f_cross[5]"], 1000000)


class Bonds(unittest.TestCase):
    """Bonds and atoms that come, go and jump."""

    def last(self, script, ranks=1, **variables):
        output = run(script, ranks=ranks, variables={**VARIABLES, **variables})
        return thermo_tables(output)[-1][-1], output

    def test_a_bond_that_is_made_starts_anew(self):
        """Atoms 2 and 15 come together between two checks, and a bond then: its path swept much before it was one."""
        line, output = self.last(RINGS + WATCH + "run 5\ncreate_bonds single/bond 1 2 20\nrun 5\nrun 10\n")
        first = thermo_tables(output)[1][-1]
        self.assertEqual([0, 0], [first["f_cross"], first["f_cross[4]"]])
        self.assertEqual(0, line["f_cross[4]"])

    def test_a_jump_is_undetermined(self):
        """Three bonds have an atom among the two that jump by more than half the box."""
        script = RINGS + "group far id 2 3\n" + WATCH
        for ranks in some(1, 2):
            line, output = self.last(script + "run 10\ndisplace_atoms far move 0 0 12.5\nrun 10\n", ranks,
                                     arguments="10 action warn")
            self.assertEqual(3, line["f_cross[4]"], output)
            self.assertIn("undetermined at step 20", output)
            self.assertIn("0 crossings of bonds from step 10 to 20, 3 undetermined", output)

    def test_bonds_that_are_off_are_left_out(self):
        """A bond of type 0 has broken. Without those of one ring none goes through the other."""
        script = RINGS + "delete_bonds second bond 1\n" + WATCH
        line, _ = self.last(script + "run 800\n")
        self.assertEqual(0, line["f_cross"])
        line, _ = self.last(RINGS + WATCH + "run 100\ngroup cut id 13 24\ndelete_bonds cut bond 1 remove\nrun 700\n")
        self.assertGreater(line["f_cross"], 0)

    def test_branched_chains_have_no_signs(self):
        """A third bond of an atom of each ring: crossings of its bonds are found, and have no sign."""
        script = RINGS.replace("special yes\n", "special yes\ncreate_bonds single/bond 1 14 19\n")
        run(script + WATCH + "run 800\n", variables=VARIABLES)
        rows = [row for _, table in read_rows(host.work / "events") for row in table]
        branched = [row for row in rows if {14, 19} & set(row[:4])]
        self.assertTrue(all(row[5] == 0 for row in branched))
        self.assertTrue(any(row[5] != 0 for row in rows if row not in branched))

    def test_thick_bonds_touch(self):
        both = "fix thick all necklace/crossing 10 action count thickness 0.4\n" + WATCH.replace(
            "f_cross[6]\n", "f_cross[6] f_thick f_thick[3]\n", 1)
        line, _ = self.last(RINGS + both + "run 800\n")
        self.assertEqual(line["f_cross"], line["f_thick"])
        self.assertGreater(line["f_thick[3]"], line["f_cross[3]"])

    def test_lost_atoms(self):
        """Bonds whose partner is gone are undetermined, and nothing else is said of them."""
        script = RINGS.replace("boundary p p p", "boundary f f f").replace("-12 12 -12 12 -12 12", "-7 7 -7 7 -7 7")
        line, output = self.last(script.replace("label bond", "thermo_modify lost ignore lost/bond ignore\nlabel bond") + WATCH +
                                 "thermo_modify lost ignore lost/bond ignore\nrun 1200\n")
        self.assertGreater(line["f_cross[4]"], 0, output)


class Actions(unittest.TestCase):
    def test_stop(self):
        found = set()
        for ranks in (1, 2):
            code, output = host.run_text(SOFT + MOVE + WATCH + "run 60\n", ranks=ranks,
                                         variables={**VARIABLES, "arguments": "10 action stop"})
            self.assertNotEqual(0, code)
            found.add(re.search(r"ERROR: Fix necklace/crossing cross: (bond .* step \d+\))", output).group(1))
        self.assertEqual(1, len(found), found)

    def test_ghosts_have_to_reach_far_enough(self):
        script = SOFT.replace("comm_modify cutoff 5.0\n", "") + MOVE + WATCH + "run 10\n"
        code, output = host.run_text(script, ranks=2, variables=VARIABLES)
        self.assertNotEqual(0, code)
        self.assertRegex(output, r"ghost atoms are sent within 1\.\d+, but two bonds of length [\d.]+, the skin 0\.4 need "
                                 r"[\d.]+, and twice what atoms move between checks; use 'comm_modify cutoff [\d.]+' or more")

    def test_bad_arguments_are_named(self):
        for arguments, message in (
                *some(("", "the number of steps between checks is missing"),
                      ("2.5", "'2.5' steps between checks"),
                      ("often", "'often' steps between checks"),
                      ("0", "'0' steps between checks; has to be a whole number of 1 or more")),
                *some(("10 action", "'action' lacks its value"),
                      ("10 thickness -1", "thickness is '-1' but has to be a distance of 0 or more"),
                      ("10 action run", "action is 'run' but has to be warn, stop or count")),
                ("10 colour red", "unknown keyword 'colour'; there are action and thickness")):
            code, output = host.run_text(SOFT + WATCH, variables={**VARIABLES, "arguments": arguments})
            self.assertNotEqual(0, code, arguments)
            self.assertIn("Fix necklace/crossing cross: " + message, output)

    def test_atoms_without_bonds_are_refused(self):
        code, output = host.run_text("include ${load}\nunits lj\natom_style atomic\nregion box block 0 4 0 4 0 4\n"
                                     "create_box 1 box\nfix cross all necklace/crossing 10\n")
        self.assertNotEqual(0, code)
        self.assertIn("the atom style has no bonds of its own", output)

    def test_two_dimensions_are_refused(self):
        code, output = host.run_text("include ${load}\nunits lj\ndimension 2\natom_style bond\n"
                                     "region box block 0 4 0 4 -0.5 0.5\ncreate_box 1 box bond/types 1\n"
                                     "fix cross all necklace/crossing 10\n")
        self.assertNotEqual(0, code)
        self.assertIn("in two dimensions chains cannot go around each other", output)

    def test_ids_cannot_change_under_it(self):
        code, output = host.run_text(RINGS + WATCH + "run 10\nreset_atom_ids\n", variables=VARIABLES)
        self.assertNotEqual(0, code)
        self.assertRegex(output, "Cannot use reset_atom.* a fix .*stor(es|ing) atom IDs")

    def test_ways_to_send_ghosts_that_leave_some_out(self):
        for command, message in some(("neighbor 0.4 multi\ncomm_modify mode multi", "use 'comm_modify mode single'"),
                                     ("atom_modify first part\ncomm_modify group part", "use 'comm_modify group all'")):
            script = "group part id <= 260\n" + command + "\n"
            code, output = host.run_text(SOFT.replace("comm_modify cutoff 5.0\n", script) + WATCH + "run 0\n", ranks=2,
                                         variables=VARIABLES)
            self.assertNotEqual(0, code)
            self.assertIn(message, output)


# How signs go with the volume det(u, v, d) of two bonds and what is between their beginnings: a crossing changes its sign.
SIGN_OF_VOLUME = -1

if __name__ == "__main__":
    main(__doc__)
