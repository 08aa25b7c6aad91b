#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""`dch verify` with force styles on cluster pairs and on pairs one by one: silent where they are right, and it finds
each mistake that lmp_faulty_clusters plants into the third search, which is at step 10, or 5 if bonds were made before
the run."""

import math
import re
import unittest

from lammps_run import largest_relative_difference, thermo_tables
from script_tests import MELT, host, main, run

VERIFIED = "suffix dch\ndch verify yes\n"
CUTOFFS = {"clusters": "2.5", "one by one": "1.3"}

# A lattice of atoms, all neighbors bonded.
NETWORK = MELT.replace("atom_style atomic", "atom_style bond\nspecial_bonds lj 0.0 1.0 1.0").replace("fcc 0.8442", "sc 0.7") \
    .replace("box block 0 6 0 6 0 6", "box block 0 8 0 8 0 8") \
    .replace("create_box 1 box", "create_box 1 box bond/types 1 extra/bond/per/atom 6 extra/special/per/atom 40") \
    .replace("pair_style lj/cut 2.5", "pair_style lj/cut ${cutoff}\nbond_style harmonic\nbond_coeff 1 50.0 1.1") \
    .replace("neighbor 0.3 bin", "neighbor 0.3 bin\ngroup some id 1:300\ncreate_bonds many some some 1 0.9 1.15\n"
             "special_bonds lj ${weights}")

# The style of silicon asks for a full list.
SILICON = """
units metal
atom_style atomic
lattice diamond 5.43
region box block 0 4 0 4 0 4
create_box 1 box
create_atoms 1 box
mass 1 28.0
displace_atoms all random 0.02 0.02 0.02 4711
pair_style hybrid/overlay lj/cut CUTOFF sw
pair_coeff * * sw Si.sw Si
pair_coeff 1 1 lj/cut 0.001 1.0
neighbor 0.5 bin
neigh_modify delay 0 every 5 check no
fix 1 all nve
"""

TWO_TYPES = MELT.replace("create_box 1", "create_box 2").replace("mass 1", "mass *") \
    .replace("pair_coeff 1 1 1.0 1.0", "set type 1 type/fraction 2 0.3 4711\npair_coeff * * 1.0 1.0")


def with_cutoff(script, cutoff):
    return script.replace("lj/cut 2.5", f"lj/cut {cutoff}")


class Silent(unittest.TestCase):
    def check(self, script, pairs=None, builds=5, **options):
        """Every build is compared, and so many pairs."""
        output = run("include ${load}\n" + VERIFIED + script + "run 20\ndch stats\n", **options)
        found = re.search(r"verified +(\d+) builds, (\d+) pairs, all equal", output)
        self.assertIsNotNone(found, output)
        self.assertEqual(int(found[1]), builds)
        self.assertGreater(int(found[2]), 0)
        if pairs is not None:
            self.assertEqual(int(found[2]), pairs)
        return output

    def compare_with_plain(self, output, script, **options):
        """The same energies as without `dch verify`. Sums may be in another order: what a hierarchy does is by its times."""
        plain = run("include ${load}\nsuffix dch\n" + script + "run 20\ndch stats\n", **options)
        self.assertIn("no build of the last run; see 'dch verify'", plain)
        self.assertLess(largest_relative_difference(thermo_tables(plain)[0][-1], thermo_tables(output)[0][-1]), 1e-11)

    def native_pairs(self, script):
        """Pairs of the native half list with newton on, summed over the builds of 20 steps, by `dch on` and its checks."""
        output = run("include ${load}\ndch styles no\ndch on\ndch verify yes\n" + script + "run 20\ndch stats\n")
        return int(re.search(r"verified +\d+ builds, (\d+) pairs, all equal", output)[1])

    def test_melt(self):
        for cutoff in CUTOFFS.values():
            script = with_cutoff(MELT, cutoff)
            pairs = self.native_pairs(script)
            for ranks in (1, 2):
                with self.subTest(cutoff=cutoff, ranks=ranks):
                    self.compare_with_plain(self.check(script, pairs=pairs, ranks=ranks), script, ranks=ranks)

    def test_newton_off(self):
        for cutoff in CUTOFFS.values():
            for newton, ranks in (("off", 1), ("off", 2), ("off on", 2)):
                with self.subTest(cutoff=cutoff, newton=newton, ranks=ranks):
                    self.check(f"newton {newton}\n" + with_cutoff(MELT, cutoff), ranks=ranks)

    def test_exclusions(self):
        for cutoff in CUTOFFS.values():
            for ranks in (1, 2):
                with self.subTest(cutoff=cutoff, ranks=ranks):
                    self.check(with_cutoff(TWO_TYPES, cutoff) + "neigh_modify exclude type 1 2\n", ranks=ranks)

    def test_bonds(self):
        for cutoff in CUTOFFS.values():
            for weights in ("0.0 1.0 1.0", "0.0 0.3 0.7"):
                for ranks in (1, 2):
                    with self.subTest(cutoff=cutoff, weights=weights, ranks=ranks):
                        self.check(NETWORK, ranks=ranks, variables={"cutoff": cutoff, "weights": weights})

    def test_cutoffs_by_type(self):
        script = TWO_TYPES.replace("neighbor 0.3", "pair_coeff 1 2 1.0 1.0 1.6\npair_coeff 2 2 1.0 1.0 1.2\nneighbor 0.3")
        for ranks in (1, 2, 4):
            for newton in ("on", "off"):
                with self.subTest(ranks=ranks, newton=newton):
                    self.check(f"newton {newton}\n" + script, ranks=ranks)

    def test_ghosts_too_far_for_their_types(self):
        """Of few atoms with a large cutoff some processes have none; on one process LAMMPS's own lists say what is right."""
        script = TWO_TYPES.replace("type/fraction 2 0.3", "type/fraction 2 0.005").replace("lj/cut 2.5", "lj/cut 1.2") \
            .replace("neighbor 0.3", "pair_coeff 1 2 1.0 1.0 2.0\npair_coeff 2 2 1.0 1.0 3.3\nneighbor 0.3")
        for lists in ("", "dch on\n"):
            for newton, ranks in (("on", 1), ("on", 2), ("on", 4), ("off", 2)):
                with self.subTest(lists=lists, newton=newton, ranks=ranks):
                    output = self.check(f"newton {newton}\n{lists}" + script, ranks=ranks)
                    if ranks > 1:
                        self.assertRegex(output, "points .* those too far for their types")

    def test_bonds_of_weight_zero_alone(self):
        """Those of pairs one by one are asked about pair by pair, and no exclusions are made for them."""
        script = NETWORK.replace("special_bonds lj ${weights}", "special_bonds lj/coul 0.0 1.0 1.0")
        for cutoff in (*CUTOFFS.values(), "1.2"):
            for ranks in (1, 2, 4):
                with self.subTest(cutoff=cutoff, ranks=ranks):
                    self.check(script, ranks=ranks, variables={"cutoff": cutoff})

    def test_types_of_pairs_one_by_one(self):
        """Points are not atoms of the same number there; types and forces are of the atoms that are meant."""
        script = with_cutoff(TWO_TYPES, "1.2") + "pair_coeff 1 2 0.5 0.9 1.1\npair_coeff 2 2 0.2 1.1 1.2\n"
        for ranks in (1, 2, 4):
            stock = run("include ${load}\n" + script + "run 20\n", ranks=ranks)
            ours = self.check(script, ranks=ranks)
            self.assertLess(largest_relative_difference(thermo_tables(stock)[0][-1], thermo_tables(ours)[0][-1]), 1e-9)

    def test_hybrid(self):
        """The lists that are compared with are parts of one that LAMMPS makes for them alone, or of others'."""
        script = TWO_TYPES.replace("pair_style lj/cut 2.5", "pair_style hybrid lj/cut 2.5 born 2.0")
        script = script.replace("pair_coeff * * 1.0 1.0",
                                "pair_coeff 1 1 lj/cut 1.0 1.0\npair_coeff 1 2 lj/cut 1.0 1.0\npair_coeff 2 2 born 0.1 0.2 1.1 0.1 0.01")
        for lists in ("", "dch on\n"):
            for ranks in (1, 2):
                with self.subTest(lists=lists, ranks=ranks):
                    self.compare_with_plain(self.check(lists + script, ranks=ranks), lists + script, ranks=ranks)

    def test_a_list_that_lammps_copies_from_the_one_to_compare_with(self):
        script = MELT.replace("pair_style lj/cut 2.5", "pair_style hybrid/overlay lj/cut 2.5 born 2.0")
        script = script.replace("pair_coeff 1 1 1.0 1.0", "pair_coeff 1 1 lj/cut 1.0 1.0\npair_coeff 1 1 born 0.1 0.2 1.1 0.1 0.01")
        computed = "compute rdf all rdf 10\nthermo_style custom step temp epair c_rdf[5][2]\n"
        for lists in ("", "dch on\n"):
            for every in ("yes", "every 3"):
                with self.subTest(lists=lists, every=every):
                    plain = run("include ${load}\nsuffix dch\n" + lists + script + computed + "run 20\n")
                    output = run(f"include ${{load}}\nsuffix dch\ndch verify {every}\n" + lists + script + computed +
                                 "run 20\ndch stats\n")
                    self.assertLess(largest_relative_difference(thermo_tables(plain)[0][-1], thermo_tables(output)[0][-1]),
                                    1e-12)
                    self.assertRegex(output, rf"verified +{5 if every == 'yes' else 2} builds, \d+ pairs, all equal")

    def test_beside_a_full_list(self):
        """Then all ghosts are points, and pairs that other processes take are left out of what is found."""
        for cutoff in ("5.0", "3.0"):
            script = SILICON.replace("CUTOFF", cutoff)
            for ranks in (1, 2, 4):
                with self.subTest(cutoff=cutoff, ranks=ranks):
                    output = self.check("dch on\n" + script, ranks=ranks)
                    if ranks > 1:
                        self.assertRegex(output, r"points +owned atoms and ghosts in open space\n")

    def test_ghosts_of_others_are_no_points(self):
        for cutoff in CUTOFFS.values():
            for ranks in (2, 4):
                output = self.check("dch on\n" + with_cutoff(MELT, cutoff), ranks=ranks)
                self.assertIn("but for ghosts whose pairs others take", output)

    def test_triclinic_and_narrow_boxes(self):
        tilted = MELT.replace("box block 0 6 0 6 0 6", "box prism 0 6 0 6 0 6 2 -1 1.5")
        narrow = MELT.replace("0 6 0 6 0 6", "0 3 0 3 0 8")  # of some atoms two images are near
        for script in (tilted, narrow):
            for ranks in (1, 2):
                for newton in ("on", "off"):
                    with self.subTest(script=script, ranks=ranks, newton=newton):
                        self.check(f"newton {newton}\n" + script, ranks=ranks)

    def test_processes_of_many_shapes(self):
        """Ghosts come over several processes, and of several images of a box, with shifts of either sign."""
        narrow = MELT.replace("0 6 0 6 0 6", "0 2 0 2 0 8")
        tiled = MELT.replace("fix 1 all nve", "comm_style tiled\nbalance 1.0 rcb\nfix 1 all nve")
        types = TWO_TYPES.replace("neighbor 0.3", "pair_coeff 1 2 1.0 1.0 1.6\npair_coeff 2 2 1.0 1.0 1.2\nneighbor 0.3")
        for script, layouts in ((narrow, ("1 1 2", "2 2 1", "2 1 2")), (tiled, ("1 1 2", "2 1 2")),
                                (types, ("2 2 1",)), (MELT, ("4 1 1", "1 2 2"))):
            for layout in layouts:
                for cutoff in CUTOFFS.values():
                    ranks = math.prod(map(int, layout.split()))
                    with self.subTest(script=script, layout=layout, cutoff=cutoff):
                        self.check(f"processors {layout}\n" + with_cutoff(script, cutoff), ranks=ranks)
                        self.check(f"dch on\ndch styles no\nsuffix off\nprocessors {layout}\n" + with_cutoff(script, cutoff), ranks=ranks)

    def test_processes_without_atoms(self):
        """And with ghosts: all atoms are in a corner, of which ghosts are on the other side."""
        script = TWO_TYPES.replace("box block 0 6 0 6 0 6", "box block 0 6 0 6 0 12").replace(
            "create_atoms 1 box", "region corner block 0 6 0 6 0 3\ncreate_atoms 1 region corner")
        script = script.replace("neighbor 0.3", "pair_coeff 1 2 1.0 1.0 1.1\npair_coeff 2 2 1.0 1.0 1.2\nneighbor 0.3")
        self.assertIn("region corner", script)
        for cutoff in CUTOFFS.values():
            for newton in ("on", "off", "off on"):
                with self.subTest(cutoff=cutoff, newton=newton):
                    self.check(f"newton {newton}\nprocessors 1 1 4\n" + with_cutoff(script, cutoff), ranks=4)

    def test_ghosts_of_collections_on_one_side(self):
        script = TWO_TYPES.replace("neighbor 0.3 bin", "pair_coeff 1 2 1.0 1.0 1.9\npair_coeff 2 2 1.0 1.0 1.4\nneighbor 0.3 multi\n"
                                   "comm_modify mode multi reduce/multi")
        self.assertIn("reduce/multi", script)
        for ranks in (1, 2, 4):
            with self.subTest(ranks=ranks):
                self.check(script, ranks=ranks)

    def test_open_space(self):
        self.check(MELT.replace("units lj", "units lj\nboundary s s s"))

    def test_a_tuned_skin(self):
        script = MELT.replace("every 5 check no", "every 1 check yes").replace("neighbor 0.3", "neighbor 0.6")
        output = run("include ${load}\ndch skin auto\n" + VERIFIED + script + "run 300\ndch stats\n")
        self.assertRegex(output, r"skin +0\.\d+, ")
        self.assertRegex(output, r"verified +\d+ builds, \d+ pairs, all equal")

    def test_every_second_build_and_no_longer(self):
        output = run("include ${load}\nsuffix dch\ndch verify every 2\n" + MELT +
                     "run 20\ndch stats\ndch verify no\nrun 20\ndch stats\n")
        self.assertRegex(output, r"verified +3 builds, \d+ pairs, all equal")
        self.assertEqual(output.count("no build of the last run; see 'dch verify'"), 1)

    def test_a_list_that_nobody_reads_needs_no_bins(self):
        """Where bins are too many, verified builds alone stop."""
        script = MELT.replace("units lj", "units lj\nboundary s s s\natom_modify map yes sort 0 0.0") \
            .replace("box block 0 6 0 6 0 6", "box block 0 7e5 0 7e5 0 7e5\nregion drop block 0 6 0 6 0 6") \
            .replace("create_atoms 1 box", "create_atoms 1 region drop\ncreate_atoms 1 single 1e6 1e6 1e6 units box")
        run("include ${load}\nsuffix dch\n" + script + "run 20\n")
        code, output = host.run_text("include ${load}\n" + VERIFIED + script + "run 20\n")
        self.assertNotEqual(code, 0)
        self.assertIn("Too many neighbor bins", output)


class Faults(unittest.TestCase):
    MESSAGE = (r"dch verify: at step (5|10) the native list and the cluster pairs \(pair lj/cut/dch, half, newton on\) are not "
               r"the same: {count} pairs differ, the first: pair of atoms \d+ and \d+ at distance {distance}, special bits "
               r"{bits}: in the {where} list only. Give 'suffix off' before the pair style")

    def run_faulty(self, kind, script, ranks=1, variables=()):
        path = host.work / "in.faulty"
        path.write_text(VERIFIED + script + "run 20\n")
        return host.run(ranks, [host.tools / "lmp_faulty_clusters", kind, "-in", path], dict(variables))

    def expect(self, kind, script, ranks=1, count=r"\d+", where="native", distance=r"[012]\.\d+", bits="0", variables=()):
        with self.subTest(kind=kind, ranks=ranks, variables=variables):
            code, output = self.run_faulty(kind, script, ranks, variables)
            self.assertNotEqual(code, 0, output)
            self.assertRegex(output, self.MESSAGE.format(count=count, where=where, distance=distance, bits=bits))

    def test_no_fault(self):
        for cutoff in CUTOFFS.values():
            code, output = self.run_faulty("none", with_cutoff(MELT, cutoff))
            self.assertEqual(code, 0, output)

    def test_missing_and_repeated_pairs(self):
        for cutoff in CUTOFFS.values():
            for ranks in (1, 2):
                self.expect("drop", with_cutoff(MELT, cutoff), ranks, count="[12]")
                self.expect("repeat", with_cutoff(MELT, cutoff), ranks, count="[12]", where="DCH")

    def test_wrong_images(self):
        for cutoff in CUTOFFS.values():
            self.expect("image", with_cutoff(MELT, cutoff))

    def test_pairs_that_are_excluded(self):
        for cutoff in CUTOFFS.values():
            for ranks in (1, 2):
                self.expect("exclusions", with_cutoff(TWO_TYPES, cutoff) + "neigh_modify exclude type 1 2\n", ranks,
                            where="DCH")

    def test_bonded_pairs_without_weight(self):
        for cutoff in CUTOFFS.values():
            for ranks in (1, 2):
                self.expect("bonds", NETWORK, ranks, where="DCH", variables={"cutoff": cutoff, "weights": "0.0 1.0 1.0"})

    def test_a_bonded_pair_with_another_weight(self):
        for ranks in (1, 2):
            self.expect("weights", NETWORK, ranks, count="[24]", where="(native|DCH)", bits="[123]",
                        variables={"cutoff": "2.5", "weights": "0.2 0.3 0.7"})


if __name__ == "__main__":
    main(__doc__)
