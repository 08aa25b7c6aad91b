#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""compute dch/work: each atom's number against all pairs of atoms, and what LAMMPS's balance makes of the numbers."""

import itertools
import math
import re
import unittest

from lammps_run import largest_relative_difference, thermo_tables
from script_tests import host, main
from script_tests import run as run_script

REACH = 2.8  # cutoff and skin of the slab
# A slab of liquid in vapor.
SLAB = """
units lj
newton ${newton}
atom_style atomic
boundary ${boundary}
processors * 1 1
region box block 0 30 0 9 0 9
create_box 1 box
lattice fcc 0.8
region slab block 0.1 6.5 0.1 8.5 0.1 8.5 units box
create_atoms 1 region slab
lattice fcc 0.12
region vapor block 8.5 28 0.1 8.5 0.1 8.5 units box
create_atoms 1 region vapor
mass 1 1.0
velocity all create 0.8 87287 loop geom
pair_style lj/cut ${cutoff}
pair_coeff 1 1 1.0 1.0
neighbor 0.3 bin
neigh_modify delay 0 every 5 check no
fix 1 all nve
compute w all dch/work
compute place all property/atom proc
variable w atom c_w
compute sum all reduce sum c_w
thermo 5
thermo_style custom step temp pe press c_sum
thermo_modify format float %.15g norm no
"""
SILICON = """
units metal
newton ${newton}
atom_style atomic
boundary ${boundary}
lattice diamond 5.43
region box block 0 3 0 3 0 3
create_box 1 box
create_atoms 1 box
displace_atoms all random 0.1 0.1 0.1 2741
mass 1 28.0
pair_style sw
pair_coeff * * Si.sw Si
compute w all dch/work
compute sum all reduce sum c_w
thermo_style custom step pe c_sum
thermo_modify format float %.15g norm no
"""
DUMP = "dump 1 all custom 20 atoms id x y z c_w\ndump_modify 1 sort id format float %.17g\n"
WRITE = "write_dump all custom {} id x y z c_w modify sort id format float %.17g\n"
PLACES = "dump 2 all custom 1 places id x y z c_w c_place\ndump_modify 2 sort id format float %.17g\nrun 0\n"
SETTINGS = {"newton": "on", "boundary": "p p p", "cutoff": "2.5"}
LISTS = ("dch on\ndch styles no", "dch on engine grid\ndch styles no", "dch off")


def read_dump(name):
    """The last frame: box edges, and by ID the other columns."""
    lines = (host.work / name).read_text().split("ITEM: TIMESTEP\n")[-1].splitlines()
    edges = [float(high) - float(low) for low, high in (line.split() for line in lines[4:7])]
    rows = (list(map(float, line.split())) for line in lines[8:])
    return edges, {int(row[0]): row[1:] for row in rows}


def works(name):
    return {atom: row[3] for atom, row in read_dump(name)[1].items()}


def count_neighbors(edges, atoms, reach):
    """By ID: neighbors straight away, and those through a face of the periodic box."""
    straight, through = dict.fromkeys(atoms, 0), dict.fromkeys(atoms, 0)
    for (i, a), (j, b) in itertools.combinations(atoms.items(), 2):
        across = [d - edge * round(d / edge) for d, edge in zip((p - q for p, q in zip(a[:3], b[:3])), edges)]
        if sum(d * d for d in across) <= reach * reach:
            counts = straight if math.dist(a[:3], b[:3]) <= reach else through
            counts[i] += 1
            counts[j] += 1
    return straight, through


def run(script, before="suffix dch", ranks=1, **changes):
    return run_script(f"include ${{load}}\n{before}\n{script}", ranks=ranks, variables={**SETTINGS, **changes})


def pairs_in_stats(output):
    return int(re.findall(r"pairs at the last build (\d+)", output)[-1])


def imbalance(work_of, places):
    """The most of any process over the mean."""
    loads = {}
    for atom, place in places.items():
        loads[place] = loads.get(place, 0) + work_of(atom)
    return max(loads.values()) * len(loads) / sum(loads.values())


class Work(unittest.TestCase):
    def check_rows(self, script, reach, work_of, **changes):
        """Rows of lists, ours and LAMMPS's own."""
        for before in LISTS:
            output = run(script + DUMP + "run 0\n", before=before, **changes)
            edges, atoms = read_dump("atoms")
            straight, through = count_neighbors(edges, atoms, reach)
            self.assertGreater(max(straight.values()), 2 * min(straight.values()))
            wanted = {atom: work_of(straight[atom], through[atom]) for atom in atoms}
            self.assertEqual(wanted, works("atoms"), before)
            self.assertAlmostEqual(sum(wanted.values()), thermo_tables(output)[0][0]["c_sum"], delta=1e-6)

    def test_rows_of_half_lists(self):
        self.check_rows(SLAB, REACH, lambda straight, through: 1 + straight / 2, boundary="f f f")

    def test_rows_of_half_lists_with_newton_off(self):
        """A pair through a face is in both rows."""
        self.check_rows(SLAB, REACH, lambda straight, through: 1 + straight / 2 + through, newton="off")

    def test_rows_of_full_lists(self):
        self.check_rows(SILICON, 2.0951 * 1.80 + 2.0, lambda straight, through: 1 + straight, boundary="s s s")

    def test_rows_with_newton_on_through_faces(self):
        """A pair with a ghost is in one of the two rows."""
        for before in LISTS:
            run(SLAB + DUMP + "run 0\n", before)
            edges, atoms = read_dump("atoms")
            straight, through = count_neighbors(edges, atoms, REACH)
            for atom, work in works("atoms").items():
                over = work - 1 - straight[atom] / 2
                self.assertTrue(0 <= over <= through[atom], (atom, over))
            self.assertEqual(len(atoms) + (sum(straight.values()) + sum(through.values())) / 2, sum(works("atoms").values()))

    def test_cluster_pairs_and_pairs_one_by_one(self):
        """They hold the pairs of lists, and as many as dch stats says, at builds in a run and in minimizations too."""
        for cutoff, name in (("2.5", "clusters"), ("1.0", "one by one")):
            for ranks, newton, end in ((1, "on", "run 20"), (1, "on", "minimize 0 0 5 20"), (2, "on", "run 20"),
                                       (2, "off", "run 20")):
                output = run(SLAB + DUMP + end + "\ndch stats\n", ranks=ranks,
                             cutoff=cutoff, newton=newton)
                self.assertIn("cluster pairs: DCH", output)
                edges, atoms = read_dump("atoms")
                total = thermo_tables(output)[0][-1]["c_sum"]
                self.assertAlmostEqual(len(atoms) + pairs_in_stats(output), total, delta=1e-6 * total, msg=name)
                if end != "run 20":
                    continue
                self.assertAlmostEqual(total, sum(works("atoms").values()), delta=1e-6 * total)
                self.assertGreaterEqual(min(works("atoms").values()), 1)
                straight, through = count_neighbors(edges, atoms, float(cutoff) + 0.3)
                neighbors = {atom: straight[atom] + through[atom] for atom in atoms}
                self.assertGreaterEqual(total, len(atoms) + sum(neighbors.values()) / 2)
                self.check_by_neighbors(works("atoms"), neighbors)

    def check_by_neighbors(self, work, neighbors):
        """More for atoms of the liquid."""
        middle = max(neighbors.values()) / 2
        many, few = ([work[atom] for atom in work if (neighbors[atom] > middle) == wanted] for wanted in (True, False))
        self.assertGreater(sum(many) / len(many), 1.8 * sum(few) / len(few))

    def test_parts_of_a_list_count_once(self):
        """pair_style hybrid: forces go through two parts of a list, not through the whole."""
        script = SLAB.replace("pair_style lj/cut ${cutoff}", "pair_style hybrid lj/cut ${cutoff} morse ${cutoff}")
        script = script.replace("create_box 1", "create_box 2").replace("mass 1", "mass *").replace(
            "pair_coeff 1 1 1.0 1.0", "set group all type/fraction 2 0.5 7391\npair_coeff 1 1 lj/cut 1.0 1.0\n"
            "pair_coeff 1 2 lj/cut 1.0 1.0\npair_coeff 2 2 morse 1.0 5.0 1.1")
        self.check_rows(script, REACH, lambda straight, through: 1 + straight / 2, boundary="f f f")

    def test_numbers_go_with_their_atoms(self):
        """To other processes, where atoms are deleted, and past ones that are new, which have 1."""
        steps = ("run 20\n" + "balance 1.0 shift x 20 1.001 weight var w\n" + WRITE.format("after") +
                 "balance 1.0 x uniform\n" + WRITE.format("back") +
                 "group some id 5 6 7 300\ndelete_atoms group some compress no\nbalance 1.0 shift x 20 1.001\n" + WRITE.format("fewer") +
                 "create_atoms 1 single 7.5 4 4 units box\nbalance 1.0 x uniform\n" + WRITE.format("more"))
        for ranks, before in ((2, "suffix dch"), (4, "suffix dch"), (2, "dch on\ndch styles no")):
            output = run(SLAB + DUMP + steps, ranks=ranks, before=before)
            first, last = re.search(r"initial/final imbalance factor += (\S+) (\S+)", output).groups()
            self.assertLess(float(last), 0.8 * float(first))  # atoms have gone to other processes
            wanted = works("atoms")
            self.assertGreater(len(set(wanted.values())), 20)
            self.assertEqual(wanted, works("after"))
            self.assertEqual(wanted, works("back"))
            rest = {atom: work for atom, work in wanted.items() if atom not in (5, 6, 7, 300)}
            self.assertEqual(rest, works("fewer"))
            added = works("more").keys() - rest.keys()
            self.assertEqual(1, len(added))
            self.assertEqual({**rest, added.pop(): 1.0}, works("more"))

    def loads_after(self, script, ranks, before):
        """Imbalance of the work that is counted, and of neighbors that are found here."""
        output = run(script + PLACES, ranks=ranks, before=before)
        edges, atoms = read_dump("places")
        straight, through = count_neighbors(edges, atoms, REACH)
        places = {atom: row[4] for atom, row in atoms.items()}
        return (imbalance(lambda atom: atoms[atom][3], places),
                imbalance(lambda atom: 1 + (straight[atom] + through[atom]) / 2, places), output)

    def test_balance(self):
        for ranks, before in ((2, "suffix dch"), (4, "suffix dch"), (2, "dch on\ndch styles no"), (2, "dch off")):
            stock = thermo_tables(run(SLAB + "run 20\nrun 20\n", ranks=ranks, before="dch off"))
            found = {}
            for weight in ("", " weight var w"):
                script = SLAB + f"run 20\nbalance 1.0 shift x 20 1.001{weight}\nrun 20\n"
                found[weight] = self.loads_after(script, ranks, before)
                self.compare(stock, thermo_tables(found[weight][2])[:2])
            for plain, weighted in zip(found[""][:2], found[" weight var w"][:2]):
                self.assertGreater(plain, 1.4)
                self.assertLess(weighted, 1.2)

    def test_fix_balance(self):
        """Lists are built, and atoms sent, while the fix asks for the numbers again and again."""
        for ranks, before in ((2, "suffix dch"), (4, "suffix dch"), (4, "dch on\ndch styles no")):
            stock = thermo_tables(run(SLAB + "run 40\n", ranks=ranks, before="dch off"))
            found = {}
            for weight in ("", " weight var w"):
                script = SLAB + f"fix b all balance 10 1.0 shift x 20 1.001{weight}\nrun 40\nunfix b\n"
                found[weight] = self.loads_after(script, ranks, before)
                self.compare(stock, thermo_tables(found[weight][2])[:1])
            for plain, weighted in zip(found[""][:2], found[" weight var w"][:2]):
                self.assertGreater(plain, 1.3)
                self.assertLess(weighted, 1.2)

    def compare(self, first, second):
        """All but the work, which ghosts decide too."""
        self.assertEqual([len(table) for table in first], [len(table) for table in second])
        for a, b in zip(itertools.chain(*first), itertools.chain(*second)):
            a, b = ({key: value for key, value in line.items() if key != "c_sum"} for line in (a, b))
            self.assertLess(largest_relative_difference(a, b), 1e-9)

    def test_before_the_first_run(self):
        """Each atom has 1, so atoms are shared out by number."""
        for before in ("suffix dch", "dch off"):
            said = []
            for weight in ("", " weight var w"):
                output = run(SLAB + f"balance 1.0 shift x 20 1.001{weight}\n" + WRITE.format("first"), ranks=2,
                             before=before)
                said.append(re.search(r"initial/final imbalance factor += (.*)", output)[1])
                self.assertEqual({1.0}, set(works("first").values()))
            self.assertEqual(*said)

    def test_runs_are_as_without(self):
        """On one process too, where ghosts and the order of atoms hang on which computes and fixes there are."""
        with_work = re.sub("^compute place .*\n", "", SLAB, flags=re.MULTILINE)
        bare = re.sub(r"^compute (w|sum) .*\n|^variable w .*\n", "", with_work, flags=re.MULTILINE).replace(" c_sum", "")
        for ranks in (1, 2):
            first, second = (run(text + "run 40\ndch stats\n", ranks=ranks) for text in (bare, with_work))
            self.compare(thermo_tables(first), thermo_tables(second))
            kept = [re.findall(r"^  (?:atoms in memory|ghosts) .*", output, re.MULTILINE) for output in (first, second)]
            self.assertEqual(*kept)
            self.assertEqual(2, len(kept[0]))
            self.assertEqual(ranks == 1, kept[0][1].endswith("none, as nothing reads them"))

    def test_weight_neigh_of_lammps_has_no_list_of_cluster_pairs(self):
        """As the page says: LAMMPS warns, and goes by the number of atoms."""
        output = run(SLAB + "run 0\nbalance 1.0 shift x 20 1.001 weight neigh 1.0\n", ranks=2)
        self.assertRegex(output, "WARNING: Balance weight neigh skipped b/c no (suitable )?list found")
        plain = run(SLAB + "run 0\nbalance 1.0 shift x 20 1.001\n", ranks=2)
        self.assertEqual(*(re.search(r"initial/final imbalance factor += (.*)", text)[1] for text in (output, plain)))

    def test_compute_comes_and_goes(self):
        script = SLAB + ("run 5\nthermo_style one\nuncompute sum\ncompute other all dch/work\nuncompute w\nvariable w atom c_other\n"
                         "balance 1.0 shift x 20 1.001 weight var w\nrun 5\n" + WRITE.replace("c_w", "c_other").format("other"))
        run(script, ranks=2)
        self.assertGreater(max(works("other").values()), 20)

    def test_bad_lines_are_named(self):
        for line, message in (("compute x all dch/work 3", "Compute dch/work takes no arguments"),
                              ("group few id 1\ncompute x few dch/work", "Compute dch/work: the group has to be all")):
            code, output = host.run_text("include ${load}\n" + SLAB + line + "\n", variables=SETTINGS)
            self.assertNotEqual(0, code)
            self.assertIn(message, output)


if __name__ == "__main__":
    main(__doc__)
