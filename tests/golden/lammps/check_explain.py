#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""`dch explain` in a real LAMMPS: what it says of lists and styles, and that it is what has happened."""

import re
import unittest
from pathlib import Path

from lammps_run import largest_relative_difference, thermo_tables
from script_tests import MELT, host, main

ROOT = Path(__file__).resolve().parents[3]
LATEST = MELT.replace("every 5 check no", "every 1 check yes")


def explained(script, ranks=1, variables=()):
    """Lines of `dch explain` behind the script: what stands before the first colon, and what behind it."""
    code, output = host.run_text(f"include ${{load}}\n{script}\ndch explain\n", ranks=ranks, variables=variables)
    if code != 0:
        raise AssertionError(f"exit code {code}\n{output}")
    text = output[output.index("DCH choices:"):]
    lines = [line.strip().split(": ", 1) for line in text.splitlines() if line.startswith("  ")]
    return dict(lines), output


class Explain(unittest.TestCase):
    def expect(self, found, **wanted):
        for beginning, text in wanted.items():
            self.assertIn(text, found[beginning])

    def test_before_any_run(self):
        for words in ("", "dch on\n", "suffix dch\n" + MELT):
            _, output = explained(words)
            self.assertIn("no build of a DCH list yet", output)

    def test_lists_alone(self):
        for ranks in (1, 2):
            found, output = explained(LATEST + "dch on\nrun 20\n", ranks)
            self.assertIn(f"DCH choices: lists on, {ranks} process", output)
            self.assertEqual(found["list 1, pair lj/cut, half, newton on"], "DCH")
            self.assertIn("give that before it for lj/cut/dch", found["pair lj/cut"])
            self.assertIn("give that before it for nve/dch", found["fix 1, nve"])
            where = r"^dch.* on one process$" if ranks == 1 else r"^auto.* on several processes; it has taken grid: .* points a cell"
            self.assertRegex(found["engine"], where)
            self.assertEqual(found["expiry of lists"], "when a pair is missing")
            self.assertIn("0.3 of the script, as no 'dch skin auto' was given", found["skin"])
            self.assertNotIn("DCH_ORDER", output)

    def test_cluster_pairs_and_pairs_one_by_one(self):
        for precision in ("double", "mixed"):
            found, _ = explained(f"suffix dch\ndch precision {precision}\n" + LATEST + "run 20\n")
            self.assertRegex(found["pair lj/cut/dch"],
                             rf"^cluster pairs, in {precision} precision, as there are \d\d.* pairs an atom, more than 9$")
        few = LATEST.replace("lj/cut 2.5", "lj/cut 1.2")
        found, _ = explained("suffix dch\n" + few + "run 20\n")
        self.assertRegex(found["pair lj/cut/dch"], r"^pairs one by one, in double precision, as there are [\d.]+ pairs an atom")

    def test_energies_by_atom_and_sums_with_newton_off_take_the_kernel(self):
        script = "suffix dch\n" + LATEST + "compute e all pe/atom\nthermo_style custom step c_s\nthermo 10\n"
        found, _ = explained(script.replace("thermo_style", "compute s all reduce sum c_e\nthermo_style") + "run 40\n")
        self.assertRegex(found["pair lj/cut/dch"], r"^cluster pairs, in double precision, .*, more than 9$")
        off = "newton off\nsuffix dch\n" + LATEST + "run 40\n"
        found, _ = explained(off, 2)
        self.assertRegex(found["pair lj/cut/dch"], r"^cluster pairs, in double precision, .*, more than 9$")

    def test_settings_with_their_remedies(self):
        found, _ = explained("suffix dch\n" + LATEST + "group few id <> 1 100\natom_modify first few\n"
                             "neigh_modify include few\nrun 10\n")
        self.assertIn("neigh_modify include; give 'neigh_modify include all'", found["pair lj/cut/dch"])
        found, _ = explained("atom_modify id no\n" + LATEST + "dch on\nrun 10\n")
        self.assertIn("native, atoms have no IDs (atom_modify id no); give 'atom_modify id yes'",
                      found["list 1, pair lj/cut, half, newton on"])
        found, _ = explained(LATEST + "dch on\ndch skin auto\ndch threads 2\ndch expiry half\ndch order no\nrun 10\n")
        self.assertRegex(found["skin"], r"^0\.3, still being looked for, as 'dch skin auto' was given$")
        self.assertIn("2 of each process", found["threads"])
        self.assertEqual(found["expiry of lists"], "at half the skin, as 'dch expiry half' was given")
        self.assertEqual(found["order of atoms"], "LAMMPS's, as 'dch order no' was given")
        found, _ = explained(MELT + "dch on\ndch skin auto\nrun 10\n")
        self.assertIn("as lists are rebuilt without a check (neigh_modify check no)", found["skin"])

    def test_engines(self):
        found, _ = explained(LATEST + "dch on engine grid\nrun 10\n")
        self.assertEqual(found["engine"], "grid, as 'dch on' takes it for lists")
        for ranks in (1, 2):
            found, _ = explained(LATEST + "dch on engine auto\nrun 10\n", ranks)
            self.assertRegex(found["engine"], r"^auto, as 'dch on' takes it for lists; it has taken (grid|dch): .* points a cell")
        found, _ = explained("suffix dch\n" + LATEST + "run 10\n")
        self.assertIn("cluster pairs are asked for without 'dch on'", found["engine"])

    def test_chain(self):
        script = "include ${here}/in.chain\n"
        for ranks in (1, 2):
            found, _ = explained(script, ranks, {"lists": "suffix", "steps": 20})
            self.assertRegex(found["pair lj/cut/dch"], "^pairs one by one, in double precision")
            self.assertEqual(found["bond fene/dch"],
                             "SIMD kernel 18 times, plain style 3 times, at steps that want energies, or virials by atom")
            self.assertIn("atoms have bonds", found["order of atoms"])
        found, _ = explained("newton off\n" + script.replace("include", "variable newton index off\ninclude"), 1,
                             {"lists": "suffix", "steps": 20})
        self.assertIn("newton is off for bonds; give 'newton on'", found["bond fene/dch"])

    def test_molecules(self):
        found, _ = explained("include ${here}/in.peptide\n", 1, {"lists": "suffix", "steps": 10})
        self.assertRegex(found["pair lj/charmm/coul/long/dch"], "^cluster pairs, in double precision")
        self.assertRegex(found["bond harmonic/dch"], "^SIMD kernel 8 times")
        for style in ("angle charmm", "dihedral charmm", "improper harmonic", "kspace pppm", "fix 1, nvt", "fix 2, shake"):
            self.assertIn("native, there is no ", found[style])

    def test_a_style_that_opt_has(self):
        found, _ = explained("suffix dch\n" + LATEST.replace("lj/cut", "ufm") + "run 10\n")
        self.assertIn("there is no ufm/dch; give 'suffix opt' before it for ufm/opt", found["pair ufm"])

    def test_hybrid(self):
        for ranks in (1, 2):
            found, _ = explained("include ${here}/in.hybrid\n", ranks, {"lists": "suffix", "steps": 20})
            self.assertRegex(found["pair lj/cut/dch"], "^cluster pairs, in double precision")
            self.assertRegex(found["pair morse/dch"], "^cluster pairs, in double precision")
        found, _ = explained("include ${here}/in.hybrid\n", 1, {"lists": "dch", "steps": 20})
        self.assertEqual(found["list 1, pair lj/cut"], "native, a part of list 3")
        self.assertEqual(found["list 3, parent of skip lists, half, newton on"], "DCH")

    def test_many_bodies_and_grains(self):
        found, _ = explained("include ${here}/in.sw\n", 1, {"lists": "dch", "steps": 10})
        self.assertEqual(found["list 1, pair sw, full"], "DCH")
        self.assertEqual(found["pair sw"], "native, there is no sw/dch")
        found, _ = explained("include ${here}/in.granular\n", 2, {"lists": "dch", "steps": 20})
        self.assertEqual(found["list 1, pair gran/hooke/history, half, newton off"], "DCH")
        self.assertRegex(found["size classes"], r"^a structure for each, as the largest grain is \d+ times the smallest$")
        self.assertEqual(found["fix 1, nve/sphere"], "native, there is no nve/sphere/dch")

    def test_thermostats(self):
        found, _ = explained(LATEST + "fix 2 all langevin 1.0 1.0 1.0 4711\ndch on\nrun 10\n")
        self.assertEqual(found["fix 2, langevin"],
                         "native, as it was made before 'dch on'; give that before it for langevin/dch")
        self.assertIn("fix langevin may draw random numbers", found["order of atoms"])
        found, _ = explained("dch on\n" + LATEST + "fix 2 all langevin 1.0 1.0 1.0 4711\nrun 10\n")
        self.assertEqual(found["fix 2, langevin/dch"], "SIMD kernel, the random numbers of fix langevin; taken by 'dch on' in "
                         "place of langevin ('dch styles no')")
        self.assertIn("fix langevin may draw random numbers", found["order of atoms"])
        found, _ = explained("dch on\n" + LATEST + "fix 2 all langevin/philox 1.0 1.0 1.0 4711\nrun 10\n")
        self.assertEqual(found["fix 2, langevin/philox"], "SIMD kernel, random numbers by seed, atom ID and step")
        self.assertIn("that of the structure", found["order of atoms"])

    def test_the_page_shows_what_is_printed(self):
        page = (ROOT / "docs" / "lammps" / "explain.md").read_text()
        script, shown = re.findall(r"^```[a-z]*\n(.*?)^```$", page, re.MULTILINE | re.DOTALL)[:2]
        code, output = host.run_text("include ${load}\n" + script)
        self.assertEqual(code, 0, output)
        self.assertIn(shown, output)


class OneLevel(unittest.TestCase):
    def test_all_pair_forces_in_one_level_of_respa(self):
        """Those of several are in check_levels.py."""
        found, _ = explained(f"suffix dch\n{MELT}dch on\nrun_style respa 2 2 pair 2\nrun 20\n")
        self.assertRegex(found["pair lj/cut/dch"], "^cluster pairs")
        self.assertIn("plain style", found["fix 1, nve/dch"])
        self.assertIn("run_style respa does not look at lists at each step",
                      explained(f"suffix dch\n{LATEST}run_style respa 2 2 pair 2\nrun 20\n")[0]["expiry of lists"])


class Sizes(unittest.TestCase):
    """Cutoffs that differ much by type: classes of sizes serve force styles too, by counts of pairs."""

    MIX = LATEST.replace("create_box 1", "create_box 2").replace("mass 1 1.0", "mass * 1.0\nset type 1 type/fraction 2 {share} 8467") \
        .replace("pair_coeff 1 1 1.0 1.0\n", "pair_coeff 1 1 1.0 1.0 1.122462048309373\npair_coeff 1 2 1.0 1.0 2.0\n"
                 "pair_coeff 2 2 1.0 1.0 3.3\n")

    def test_choice_is_counted(self):
        for share, precision, by_size in ((0.05, "double", True), (0.05, "mixed", True), (0.95, "double", False),
                                          (0.95, "mixed", False)):
            for ranks in (1, 2):
                script = f"suffix dch\ndch precision {precision}\n" + self.MIX.format(share=share) + "dch on\nrun 20\n"
                found, output = explained(script, ranks)
                pairs = re.search(r"cluster pairs without them hold ([\d.]+) times the pairs of lists", found["size classes"])
                self.assertIsNotNone(pairs, output)
                self.assertEqual(found["size classes"].startswith("a structure for each"), by_size)
                self.assertEqual("size classes, of which none makes cluster pairs" in found["pair lj/cut/dch"], by_size)

    def test_without_the_suffix_sizes_alone_decide(self):
        found, _ = explained(self.MIX.format(share=0.95) + "dch on\nrun 20\n")
        self.assertRegex(found["size classes"], "^a structure for each, as the largest cutoff with the skin is 2.5")

    def test_stats_says_so(self):
        code, output = host.run_text("include ${load}\nsuffix dch\n" + self.MIX.format(share=0.05) + "run 20\ndch stats\n")
        self.assertEqual(code, 0, output)
        self.assertIn("size classes            a structure for each: the largest cutoff", output)

    def test_fewer_pairs_than_cluster_pairs(self):
        """What the kernel looks at: cluster pairs hold the largest cutoff's pairs, size classes those of each type."""
        counts = {}
        for share in (0.05, 0.95):
            code, output = host.run_text("include ${load}\nsuffix dch\n" + self.MIX.format(share=share) + "run 0\ndch stats\n")
            self.assertEqual(code, 0, output)
            counts[share] = int(re.search(r"pairs at the last build (\d+)", output).group(1))
        self.assertLess(5 * counts[0.05], counts[0.95])

    def test_same_as_stock(self):
        for share in (0.05, 0.95):
            for ranks in (1, 2):
                for extra in ("", "newton off\n"):
                    rest = extra + self.MIX.format(share=share) + "run 60\n"
                    tables = []
                    for words in ("", "suffix dch\ndch verify yes\n"):
                        code, output = host.run_text("include ${load}\n" + words + rest, ranks=ranks)
                        self.assertEqual(code, 0, output)
                        tables.append(thermo_tables(output)[-1][-1])
                    self.assertLess(largest_relative_difference(*tables), 1e-9)


if __name__ == "__main__":
    main(__doc__)
