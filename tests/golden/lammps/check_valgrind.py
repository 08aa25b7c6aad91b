#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Lists and force styles under valgrind's memcheck: no error whose stacks hold a frame of the adapter or the library.

Errors of LAMMPS, MPI and Python alone are not counted, by that rule; nothing is suppressed. Valgrind has no AVX-512, so
the narrower instruction sets are run, each by force, and `dch stats` has to say that it was. Before that a program with
one memory error of each kind has to be found out, with the same options and the same reader of the reports.
"""

import re
import shutil
import subprocess
import unittest
import xml.etree.ElementTree as ElementTree

from script_tests import MELT, host, main

VALGRIND = shutil.which("valgrind")
OPTIONS = ["--tool=memcheck", "--leak-check=full", "--show-leak-kinds=definite", "--errors-for-leak-kinds=definite",
           "--track-origins=yes", "--num-callers=60", "--error-limit=no", "--child-silent-after-fork=yes", "--xml=yes"]
LIBRARY, LAUNCHER = "libdch_lammps.so", "lmp-dch"

SMALL = MELT.replace("0 6 0 6 0 6", "0 4 0 4 0 4").replace("thermo 20", "thermo 5")
# All neighbors of a lattice are bonded.
NETWORK = SMALL.replace("atom_style atomic", "atom_style full\nspecial_bonds lj/coul 0.0 0.0 0.0") \
    .replace("fcc 0.8442", "sc 0.7").replace("0 4 0 4 0 4", "0 6 0 6 0 6") \
    .replace("create_box 1 box", "create_box 2 box bond/types 1 extra/bond/per/atom 6 extra/special/per/atom 60") \
    .replace("mass 1", "mass *").replace("pair_coeff 1 1", "pair_coeff * *") \
    .replace("neighbor 0.3", "set type 1 type/subset 2 108 7841\nset type 1 charge 0.9\nset type 2 charge -0.9\n"
             "bond_style harmonic\nbond_coeff 1 50.0 1.1\nneighbor 0.3") + \
    "group some id 1:60\ncreate_bonds many some some 1 0.9 1.15\n"
SILICON = """
units metal
atom_style atomic
lattice diamond 5.431
region box block 0 3 0 3 0 3
create_box 1 box
create_atoms 1 box
mass 1 28.06
velocity all create 1200.0 87287
pair_style sw
pair_coeff * * Si.sw Si
neighbor 1.0 bin
neigh_modify delay 0 every 2 check no
fix 1 all nve
"""
GRAINS = """
units lj
atom_style sphere
comm_modify vel yes
newton off
lattice sc 1.0
region box block 0 5 0 5 0 5
create_box 1 box
create_atoms 1 box
set atom * diameter 1.05 density 1.0
velocity all create 0.5 4711
pair_style gran/hooke/history 2000.0 NULL 50.0 NULL 0.5 0
pair_coeff * *
neighbor 0.3 bin
neigh_modify delay 0 every 2 check no
timestep 0.001
fix 1 all nve/sphere
"""


def with_charges(script, name):
    """The script with another pair style from here on."""
    return script + f"pair_style none\npair_style {name}\npair_coeff * * 1.0 1.0\n"


# Name: script, with `dch on` or `suffix dch` in front of it.
LISTS = {
    "half": SMALL + "run 10\n",
    "half, newton off": "newton off\n" + SMALL + "run 10\n",
    "full": SILICON + "run 4\n",
    "history": GRAINS + "run 6\n",
    "special bonds": NETWORK + "special_bonds lj 0.0 0.3 1.0\nrun 10\n",
    "levels of r-RESPA": SMALL + "run_style respa 3 2 2 inner 1 1.5 1.7 middle 2 1.9 2.1 outer 3\nrun 5\n"
                         "run_style respa 2 2 inner 1 1.5 2.0 outer 2\nrun 5\nrun_style verlet\nrun 5\n",
    "skin auto": "dch skin auto\n" + SMALL.replace("every 5 check no", "every 1 check yes") + "run 40\ndch skin fixed\n",
    "threads": "dch threads 2\n" + SMALL + "run 5\ndch threads 1\n",
}
BY_ATOM = "compute pa all pe/atom pair\ncompute sum all reduce sum c_pa\nthermo_style custom step temp epair press c_sum\n"
FORCES = {
    "clusters": SMALL + "run 10\ndch precision mixed\nrun 5\ndch precision double\n" + BY_ATOM + "run 5\n",
    "one by one": SMALL.replace("lj/cut 2.5", "lj/cut 1.3") + "run 10\n",
    "charges cut": with_charges(NETWORK, "lj/cut/coul/cut 2.0 2.5") + "special_bonds lj 0.0 0.3 1.0\nrun 10\n",
    "charges long": with_charges(NETWORK, "lj/cut/coul/long 2.0 2.5") + "kspace_style pppm 1e-3\nspecial_bonds lj/coul 0.0 0.0 0.5\n"
                    "run 5\ndch precision mixed\nrun 5\ndch precision double\n",
    "fene": NETWORK.replace("bond_style harmonic\nbond_coeff 1 50.0 1.1", "bond_style fene\nbond_coeff 1 30.0 1.5 1.0 1.0")
            .replace("lj/cut 2.5", "lj/cut 1.12246") + "special_bonds fene\nrun 10\n",
}


def all_of(scripts, begin):
    """One script of several, each verified at every build, since valgrind takes long to start."""
    return "".join(f"clear\ndch precision double\nsuffix off\n{begin}\ndch verify yes\n{script}dch stats\n"
                   for script in scripts.values())


def errors_of(report, ours, launcher=None):
    """The errors of one report, as text, of which a stack holds a frame of the object `ours`, or whose first frame but
    valgrind's own is in the launcher, which is below everything else."""
    found = []
    for error in ElementTree.parse(report).getroot().iter("error"):
        frames = [[frame.findtext("obj", "?").rsplit("/", 1)[-1] for frame in stack] for stack in error.iter("stack")]
        innermost = [next((name for name in stack if not name.startswith("vgpreload_")), "?") for stack in frames]
        if any(ours in stack for stack in frames) or launcher in innermost:
            what = error.findtext("what") or error.findtext("xwhat/text")
            lines = [f"{error.findtext('kind')}: {what}"]
            for stack in error.iter("stack"):
                lines += [f"    {frame.findtext('fn', '?')} ({frame.findtext('obj', '?').rsplit('/', 1)[-1]})"
                          for frame in stack] + ["  --"]
            found.append("\n".join(lines))
    return found


class TheCheckItself(unittest.TestCase):
    KINDS = {"read": "InvalidRead", "write": "InvalidWrite", "uninitialised": "UninitCondition",
             "leak": "Leak_DefinitelyLost", "freed": "InvalidRead"}

    def report_of(self, kind):
        report = host.work / f"self.{kind}.xml"
        done = subprocess.run([VALGRIND, *OPTIONS, f"--xml-file={report}", host.tools / "memory_errors", kind], check=False)
        self.assertEqual(done.returncode, 0)
        return report

    def test_a_program_without_errors(self):
        self.assertEqual(errors_of(self.report_of("none"), "memory_errors"), [])

    def test_each_kind_is_found_where_it_is_ours(self):
        for kind, name in self.KINDS.items():
            with self.subTest(kind=kind):
                report = self.report_of(kind)
                found = errors_of(report, "memory_errors")
                self.assertEqual(len(found), 1, found)
                self.assertTrue(found[0].startswith(name + ": "), found)
                self.assertIn("main (memory_errors)", found[0])
                self.assertEqual(len(errors_of(report, "?", launcher="memory_errors")), 1)
                self.assertEqual(errors_of(report, LIBRARY, LAUNCHER), [])

    def test_a_report_that_was_cut_off_is_no_report(self):
        whole = self.report_of("none").read_text()
        cut = host.work / "cut.xml"
        cut.write_text(whole[:len(whole) // 2])
        with self.assertRaises(ElementTree.ParseError):
            errors_of(cut, "memory_errors")

    def test_the_launcher_runs_the_library_by_the_name_that_is_looked_for(self):
        done = subprocess.run(["ldd", host.lmp_dch], check=True, stdout=subprocess.PIPE, text=True)
        self.assertIn(str(host.lmp_dch.parent / LIBRARY), done.stdout)


class NoErrors(unittest.TestCase):
    def check(self, what, script, verified, set_name="avx2", ranks=1):
        """Runs a script in the launcher. Its report stays in the folder of the test."""
        name = f"{what}.{set_name}.{ranks}"
        for old in host.work.glob(f"{name}.*.xml"):
            old.unlink()
        path = host.work / f"in.{name}"
        path.write_text(script)
        host.environment["DCH_FORCE_ISA"] = set_name
        code, output = host.run(ranks, [VALGRIND, *OPTIONS, f"--xml-file={host.work}/{name}.%p.xml", host.lmp_dch, "-in",
                                        path], timeout=3600)
        self.assertEqual(code, 0, output)
        self.assertEqual(len(re.findall(r"verified +\d+ builds, [1-9]\d* pairs, all equal", output)), verified, output)
        self.assertEqual(set(re.findall(r"instructions +(\S+)", output)), {set_name})
        reports = list(host.work.glob(f"{name}.*.xml"))
        self.assertEqual(len(reports), ranks)
        for report in reports:
            found = errors_of(report, LIBRARY, LAUNCHER)
            self.assertEqual(len(found), 0, "\n".join(found[:10]))

    def check_sets(self, what, script, verified):
        for name in ("avx2", "sse4.2", "portable"):
            with self.subTest(instructions=name):
                self.check(what, script, verified, name)

    def test_lists(self):
        self.check_sets("lists", all_of(LISTS, "dch styles no\ndch on"), len(LISTS))

    def test_forces(self):
        self.check_sets("forces", all_of(FORCES, "suffix dch"), len(FORCES))

    def test_lists_of_two_processes(self):
        self.check("lists", all_of(LISTS, "dch styles no\ndch on"), len(LISTS), ranks=2)

    def test_forces_of_two_processes(self):
        self.check("forces", all_of(FORCES, "suffix dch"), len(FORCES), ranks=2)

    def test_avx512_is_refused_where_valgrind_has_none(self):
        """So that nobody takes a run by force for one of these instructions."""
        (host.work / "in.valgrind").write_text(SMALL + "dch on\nrun 0\n")
        host.environment["DCH_FORCE_ISA"] = "avx512"
        code, output = host.run(1, [VALGRIND, *OPTIONS, f"--xml-file={host.work}/refused.xml", host.lmp_dch, "-in",
                                    host.work / "in.valgrind"])
        self.assertNotEqual(code, 0)
        self.assertIn("DCH_FORCE_ISA is 'avx512', which this processor or build does not support", output)


if __name__ == "__main__":
    if not VALGRIND:
        raise SystemExit("valgrind is missing; install the Debian package valgrind")
    main(__doc__)
