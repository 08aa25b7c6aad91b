#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""compute necklace/contact in a real LAMMPS, against all pairs of beads."""

import math
import unittest

import numpy

from lammps_run import thermo_tables
from script_tests import host, main, run

# The generator's walks overlap, so there are contacts enough. Molecules of the melt are chains in order of ID.
MELT = """
include ${load}
units lj
newton on ${newton}
atom_style bond
special_bonds fene
read_data ${data} extra/atom/types 1 extra/bond/per/atom 2 extra/special/per/atom 20
mass * 1.0
set atom 1*600 type 2
pair_style soft 1.12246
pair_coeff * * 20.0
bond_style harmonic
bond_coeff * 200.0 0.97
comm_modify cutoff 3.0
velocity all create 1.0 87287 loop geom
fix move all nve/limit 0.05
fix bath all langevin 1.0 1.0 0.5 904297
compute touch ${group} necklace/contact ${arguments}
thermo 20
thermo_style custom step c_touch c_touch[1][1] c_touch[1][2] c_touch[1][3] c_touch[1][4]
dump atoms all custom 20 atoms id mol type x y z c_touch proc
dump_modify atoms sort id format float %.17g
dump pairs all local 20 pairs c_touch[1] c_touch[2] c_touch[3]
dump_modify pairs format float %.17g
"""
BEADS = 60  # of each chain

RING = """
include ${load}
units lj
atom_style bond
region box block -4 4 -4 4 -4 4
create_box 1 box bond/types 1 extra/bond/per/atom 2 extra/special/per/atom 12
mass 1 1.0
variable number loop 12
label next
variable x equal 1.9*cos(2*PI*v_number/12)
variable y equal 1.9*sin(2*PI*v_number/12)
create_atoms 1 single $x $y 0 units box
next number
jump SELF next
variable bead loop 12
label bond
variable other equal v_bead%12+1
create_bonds single/bond 1 ${bead} ${other} special no
next bead
jump SELF bond
create_bonds single/bond 1 1 1
"""


def read_frames(path):
    """Frames of a dump: (step, box lengths, rows); of a tilted box its lengths are those of the box around it."""
    frames, lines = [], path.read_text().splitlines()
    at = 0
    while at < len(lines):
        step, rows = int(lines[at + 1]), int(lines[at + 3])
        bounds = [list(map(float, line.split()[:2])) for line in lines[at + 5:at + 8]]
        table = numpy.array([list(map(float, line.split())) for line in lines[at + 9:at + 9 + rows]])
        frames.append((step, numpy.array([high - low for low, high in bounds]), table))
        at += 9 + rows
    return frames


def all_contacts(atoms, edge, radius, gap, skip, within=True, between=True):
    """{(ID, ID): gap of the surfaces} of beads of the melt's chains; atoms: rows id mol type x y z ..."""
    found = {}
    for i in range(len(atoms) - 1):
        d = atoms[i + 1:, 3:6] - atoms[i, 3:6]
        d -= edge * numpy.rint(d / edge)
        gaps = numpy.sqrt((d * d).sum(axis=1)) - radius[i] - radius[i + 1:]
        for k in numpy.flatnonzero(gaps <= gap):
            j = i + 1 + k
            same = atoms[i, 1] == atoms[j, 1]
            if same and (not within or atoms[j, 0] - atoms[i, 0] <= skip) or (not same and not between):
                continue
            found[int(atoms[i, 0]), int(atoms[j, 0])] = gaps[k]
    return found


def most_received(atoms, edge, radius, gap):
    """The most beads that a process may get: those of others that come within reach of the box of its own beads."""
    process, most = atoms[:, 7], 0
    for me in set(process):
        mine = process == me
        low, high = atoms[mine, 3:6].min(axis=0), atoms[mine, 3:6].max(axis=0)
        reach = (radius + radius[mine].max() + gap)[:, None] + 1e-6
        beyond = numpy.mod(atoms[:, 3:6] - low + reach, edge)
        most = max(most, numpy.count_nonzero((beyond <= high - low + 2 * reach).all(axis=1) & ~mine))
    return most


class NecklaceContact(unittest.TestCase):
    def compare(self, arguments, ranks=1, newton="on", group="all", only=lambda atoms: atoms, run_line="run 40", **rules):
        variables = {"arguments": arguments, "newton": newton, "group": group}
        output = run(MELT + run_line + "\n", ranks=ranks, variables=variables)
        thermo = thermo_tables(output)[0]
        frames, pairs = read_frames(host.work / "atoms"), read_frames(host.work / "pairs")
        self.assertEqual([0, 20, 40], [frame[0] for frame in frames])
        by_type = rules.pop("by_type")
        # The melt is packed, but not one chain alone: after the first search, which measures, contacts are searched
        # for over space.
        packed = rules.get("between", True)
        if packed or ranks == 1:
            self.check_search(thermo, packed)
        for line, (step, edge, atoms), (_, _, rows) in zip(thermo, frames, pairs):
            members = only(atoms)
            radius = numpy.array([by_type[int(kind)] for kind in members[:, 2]])
            wanted = all_contacts(members, edge, radius, **rules)
            self.assertGreater(len(wanted), 100)
            self.assertEqual(len(wanted), line["c_touch"], step)
            received = line["c_touch[1][3]"]
            self.assertEqual(ranks > 1, received > 0)
            self.assertLessEqual(received, most_received(members, edge, radius, rules["gap"]))
            # A position of each of these, the ends of bonds between processes, and in the first search what makes chains.
            self.assertLess(line["c_touch[1][4]"], ranks * (60 * received + 500 + 30 * len(members) * (step == 0)) + 1)
            got = {(int(i), int(j)): gap for i, j, gap in rows}
            self.assertEqual(len(rows), len(got))
            self.assertEqual(wanted.keys(), got.keys())
            for pair, gap in wanted.items():
                self.assertAlmostEqual(gap, got[pair], delta=1e-12)
            counts = numpy.zeros(len(atoms) + 1)
            for pair in wanted:
                counts[list(pair)] += 1
            self.assertEqual(list(counts[1:]), list(atoms[:, 6]))
        return frames

    def check_search(self, thermo, packed):
        self.assertEqual([0, 1, 1] if packed else [0, 0, 0], [line["c_touch[1][1]"] for line in thermo])
        self.assertEqual(packed, thermo[0]["c_touch[1][2]"] > 1.8)
        self.assertEqual(1, len({line["c_touch[1][2]"] for line in thermo}) if packed else 1)

    def test_all_chains(self):
        for ranks in (1, 2, 4):
            self.compare("0.1 radius 0.5", ranks, by_type={1: 0.5, 2: 0.5}, gap=0.1, skip=1)

    def test_radii_by_type_and_more_bonds_left_out(self):
        for ranks in (2, 4):
            self.compare("0.05 skip 3 radius 0.3 0.6", ranks, "off", by_type={1: 0.3, 2: 0.6}, gap=0.05, skip=3)

    def test_pairs_within_chains_and_between_them(self):
        same = {"by_type": {1: 0.5, 2: 0.5}, "gap": 0.2, "skip": 1}
        for ranks in (1, 2, 4):
            self.compare("0.2 pairs within radius 0.5", ranks, between=False, **same)
            self.compare("0.2 radius 0.5 pairs between", ranks, within=False, **same)
            self.compare("0.2 radius 0.5 pairs within skip 5", ranks, **{**same, "skip": 5, "between": False})

    def test_chains_of_a_group(self):
        """A chain that the group cuts is two chains, and atoms without a bond in the group are no beads."""
        script = MELT.replace("compute touch", "group half id <= 630\ncompute touch")
        for ranks in (1, 4):
            output = run(script + "run 20\n", ranks=ranks,
                         variables={"arguments": "0.1 radius 0.5", "newton": "on", "group": "half"})
            for line, (_, edge, atoms) in zip(thermo_tables(output)[0], read_frames(host.work / "atoms")):
                wanted = all_contacts(atoms[:630], edge, numpy.full(630, 0.5), gap=0.1, skip=1)
                self.assertEqual(len(wanted), line["c_touch"])
                self.assertEqual(0, atoms[630:, 6].sum())

    def test_processes_without_a_bead(self):
        """One short chain on four processes: those far from it get and find nothing."""
        script = MELT.replace("compute touch", "group half id <= 5\ncompute touch")
        lines = [thermo_tables(run(script + "run 20\n", ranks=ranks,
                                   variables={"arguments": "1.0 radius 0.5", "newton": "on", "group": "half"}))[0]
                 for ranks in (1, 4)]
        self.assertEqual([line["c_touch"] for line in lines[0]], [line["c_touch"] for line in lines[1]])
        self.assertGreater(lines[0][0]["c_touch"], 0)

    def test_a_tilted_box(self):
        """The same contacts on any number of processes, in the same order, with the same digits."""
        script = MELT.replace("mass *", "change_box all triclinic\nchange_box all xy final 3.0 yz final -2.0 remap units box\nmass *")
        found = []
        for ranks in (1, 2, 4):
            output = run(script + "run 0\n", ranks=ranks,
                         variables={"arguments": "0.3 radius 0.3 0.5", "newton": "on", "group": "all"})
            rows = read_frames(host.work / "pairs")[0][2]
            found.append((thermo_tables(output)[0][0]["c_touch"], sorted(map(tuple, rows))))
        self.assertGreater(found[0][0], 1000)
        self.assertEqual(found[0], found[1])
        self.assertEqual(found[0], found[2])

    def test_a_box_that_changes_and_bonds_that_go(self):
        """Bond 30-31 is cut between two runs: its beads are in contact then, as ends of two chains."""
        cut = ("undump atoms\nundump pairs\ngroup cut id 30 31\nrun 0\nvariable before equal c_touch\nprint \"before ${before}\"\n"
               "delete_bonds cut bond 1 remove\nrun 0\nvariable after equal c_touch\nprint \"after ${after}\"\n")
        script = MELT.replace("fix bath", "fix shape all deform 1 x scale 1.1 y scale 0.95 remap x\nfix bath")
        for ranks in (1, 4):
            output = run(script + "run 40\n" + cut, ranks=ranks,
                         variables={"arguments": "0.5 radius 0.5", "newton": "on", "group": "all"})
            frames = read_frames(host.work / "atoms")
            for line, (_, edge, atoms) in zip(thermo_tables(output)[0], frames[:3]):
                wanted = all_contacts(atoms, edge, numpy.full(len(atoms), 0.5), gap=0.5, skip=1)
                self.assertEqual(len(wanted), line["c_touch"])
            words = dict(line.split() for line in output.splitlines() if line.startswith(("before ", "after ")))
            self.assertEqual(float(words["before"]) + 1, float(words["after"]))

    def test_a_ring(self):
        """The bond that closes it is a bond: beads of a regular polygon touch none but their neighbors."""
        side = 2 * 1.9 * math.sin(math.pi / 12)
        for gap, contacts in ((0.0, 0), (2 * 1.9 * math.sin(math.pi / 6) - side + 1e-9, 12)):
            script = RING.replace("create_bonds single/bond 1 1 1\n", "")
            script += f"compute touch all necklace/contact {gap!r} radius {side / 2!r}\n"
            script += f"compute far all necklace/contact 3.0 skip 3 radius {side / 2!r}\n"  # all but near ones
            script += "pair_style zero 3.0\npair_coeff * *\nbond_style zero\nbond_coeff *\n"
            script += "thermo 1\nthermo_style custom step c_touch c_touch[1][1] c_far\nrun 2\n"
            for ranks in (1, 2, 4):
                self.check_ring(contacts, thermo_tables(run("processors * * 1\n" + script, ranks=ranks))[0])

    def check_ring(self, contacts, lines):
        self.assertEqual([12 * (12 - 1 - 2 * 3) // 2] * 3, [line["c_far"] for line in lines])  # the shorter way around
        self.assertEqual([contacts] * 3, [line["c_touch"] for line in lines])
        self.assertEqual([0] * 3, [line["c_touch[1][1]"] for line in lines])  # little to search for

    def test_a_bond_of_half_the_box_is_refused_whatever_searches(self):
        """In the first search, which is made along the chains, and in the second, which is made over space."""
        for before in ("", "run 2\n"):
            script = MELT.replace("compute touch", "group far id 1:30\ncompute touch") + "thermo 1\n" + before
            script += "undump atoms\nundump pairs\ndisplace_atoms far move 5 5 5\nrun 0\n"
            for ranks in (1, 2, 4):
                code, output = host.run_text(script, ranks=ranks,
                                             variables={"arguments": "0.1 radius 0.5", "newton": "on", "group": "all"})
                self.assertNotEqual(0, code)
                self.assertIn("bond 29-30 is ", output)
                self.assertIn("which is not below half the smallest box height", output)

    def test_a_ring_around_the_box_is_refused(self):
        """On several processes the sums of its bonds on each of them tell."""
        lines = RING.replace("1.9*cos(2*PI*v_number/12)", "-4+8*(v_number-0.5)/12").replace("1.9*sin(2*PI*v_number/12)", "0")
        script = lines.replace("create_bonds single/bond 1 1 1\n", "")
        script += ("pair_style zero 3.0\npair_coeff * *\nbond_style zero\nbond_coeff *\n"
                   "compute touch all necklace/contact 0.1 radius 0.3\nthermo_style custom step c_touch\nrun 0\n")
        for ranks in (1, 2, 4):
            code, output = host.run_text("processors * 1 1\n" + script, ranks=ranks)
            self.assertNotEqual(0, code)
            self.assertIn("winds around the periodic box", output)

    def test_bad_arguments_are_named(self):
        for arguments, message in (
                ("", "the gap is missing"),
                ("near", "the gap is 'near' but has to be a distance of 0 or more"),
                ("-1 radius 0.5", "the gap is '-1' but has to be"),
                ("0.1", "this atom style has no radii; give 'radius R'"),
                ("0.1 radius", "'radius' lacks its value"),
                ("0.1 radius 0", "a radius is '0' but has to be a number above 0"),
                ("0.1 radius 0.5 0.5 0.5", "3 radii for 2 atom types"),
                ("0.1 radius 0.5 skip 1.5", "skip is '1.5' but has to be a whole number"),
                ("0.1 radius 0.5 pairs none", "pairs is 'none' but has to be all, within or between"),
                ("0.1 colour red", "unknown keyword 'colour'; there are radius, skip and pairs")):
            code, output = host.run_text(MELT, variables={"arguments": arguments, "newton": "on", "group": "all"})
            self.assertNotEqual(0, code, arguments)
            self.assertIn("Compute necklace/contact: " + message, output)

    def test_what_is_no_chain_is_refused(self):
        script = MELT.replace("compute touch", "create_bonds single/bond 1 1 3\ncompute touch")
        for text, message in ((script, "three or more bonds"), (MELT, "exceeds half the smallest box height")):
            arguments = "0.1 radius 0.5" if text is script else "0.1 radius 20"
            code, output = host.run_text(text + "run 0\n",
                                         variables={"arguments": arguments, "newton": "on", "group": "all"})
            self.assertNotEqual(0, code)
            self.assertIn(message, output)

    def test_atoms_without_bonds_are_refused(self):
        code, output = host.run_text("include ${load}\nunits lj\natom_style atomic\nregion box block 0 4 0 4 0 4\n"
                                     "create_box 1 box\ncompute touch all necklace/contact 0.1 radius 0.5\n")
        self.assertNotEqual(0, code)
        self.assertIn("the atom style has no bonds of its own", output)


if __name__ == "__main__":
    main(__doc__)
