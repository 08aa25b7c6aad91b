#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""The scripts of examples/lammps on small systems, stock and with DCH lists, and the tool that compares their logs."""

import argparse
import re
import subprocess
import sys
import unittest
from pathlib import Path

from lammps_run import Host

EXAMPLES = Path(__file__).resolve().parents[3] / "examples" / "lammps"

host = None


def run_example(script, log, ranks=1, executable=None, **variables):
    """Runs an example with its own log; returns what it printed."""
    code, output = host.run(ranks, [executable or host.lmp, "-in", EXAMPLES / script], variables, log=log)
    if code != 0:
        raise AssertionError(f"{script} ended with {code}\n{output}")
    return output


def compare(first, second, *options):
    command = [sys.executable, EXAMPLES / "compare_runs.py", host.work / first, host.work / second, *options]
    return subprocess.run(command, check=False, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


class Scripts(unittest.TestCase):
    def compare_lists(self, script, ranks=1, **variables):
        run_example(script, "stock.log", ranks, **variables)
        output = run_example(script, "dch.log", ranks, load=host.loader, lists="dch", verify="every 5", **variables)
        self.assertRegex(output, r"verified +\d+ builds, \d+ pairs, all equal")
        done = compare("stock.log", "dch.log")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        # The last lists of the two may be of different steps.
        ratio, = re.findall(r"Neighbors per atom .* (\S+)", done.stdout)
        self.assertAlmostEqual(float(ratio), 1, delta=0.02)
        self.assertIn("Largest relative difference", done.stdout)

    def test_colloid(self):
        self.compare_lists("in.colloid", steps=40)

    def test_granular(self):
        for ranks in (1, 2):
            self.compare_lists("in.granular", ranks, steps=400, cells=3)

    def test_cluster(self):
        self.compare_lists("in.cluster", steps=200, radius=6, far=30)

    def test_shear(self):
        self.compare_lists("in.shear", steps=300, cells=6)

    def test_melt(self):
        for ranks in (1, 2):
            self.compare_lists("in.melt", ranks, cells=8)

    def test_melt_with_the_launcher(self):
        output = run_example("in.melt", "launcher.log", executable=host.lmp_dch, cells=6, steps=20, lists="dch")
        self.assertIn("pair lj/cut/dch, cluster pairs: DCH", output)

    def test_chain(self):
        data = host.work / "chain.data"
        run_example("in.chain.equilibrate", "equilibrate.log", walks=host.variables["data"], data=data, settle=200)
        for ranks in (1, 2):
            self.compare_lists("in.chain", ranks, data=data)
        output = run_example("in.chain", "philox.log", load=host.loader, lists="dch", verify="every 5", data=data,
                             bath="langevin/philox")
        self.assertRegex(output, r"verified +\d+ builds, \d+ pairs, all equal")


class Python(unittest.TestCase):
    """melt.py runs by its first line: the module lammps belongs to Debian's Python."""

    def run_melt(self, *arguments):
        return subprocess.run([EXAMPLES / "melt.py", *map(str, arguments)], env=host.environment, check=False, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)

    def test_energies_and_lists_are_the_same(self):
        if host.has_long_ids:
            self.skipTest("LAMMPS's gather_atoms(), which the example calls, is only for short IDs")
        library = host.loader.parent / "libdch_lammps.so"
        done = self.run_melt(library, "--cells", 6, "--steps", 50, "--screen")
        self.assertEqual(done.returncode, 0, done.stdout)
        for line in ("pair lj/cut/dch, cluster pairs: DCH", "pair lj/cut, half, newton on: DCH"):
            self.assertIn(line, done.stdout)
        self.assertRegex(done.stdout, r"pairs ([1-9]\d+) \1: the same")
        self.assertEqual(len(re.findall(r"largest relative difference", done.stdout)), 2)
        done = self.run_melt(library, "--cells", 6, "--steps", 5, "--tolerance", -1)
        self.assertEqual(done.returncode, 1, done.stdout)

    def test_the_program_of_the_manual(self):
        manual = (EXAMPLES.parents[1] / "docs" / "lammps" / "python.md").read_text(encoding="utf-8")
        blocks = re.findall(r"```python\n(.*?)```", manual, re.DOTALL)
        self.assertEqual(len(blocks), 2)
        program = "".join(blocks) + "lmp.command('dch stats')\nprint(sum(count for _, count, _ in neighbors), 'pairs read')\n"
        for said, meant in (("/usr/local/lib", str(host.loader.parent)), ("in.melt", str(EXAMPLES / "in.melt")),
                            ("lammps()", "lammps(cmdargs=['-log', 'none', '-var', 'cells', '6'])")):
            self.assertEqual(program.count(said), 1)
            program = program.replace(said, meant)
        done = subprocess.run(["/usr/bin/python3", "-c", program], env=host.environment, check=False, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertIn("pair lj/cut, half, newton on: DCH", done.stdout)
        read = re.search(r"(\d+) pairs read", done.stdout)[1]
        self.assertIn(f"pairs at the last build {read} (", done.stdout)

    def test_a_library_that_cannot_be_used(self):
        for library in (host.work / "absent.so", "libz.so.1"):
            done = self.run_melt(library)
            self.assertEqual(done.returncode, 2, done.stdout)
            self.assertIn(f"{library} cannot be loaded, or is another library", done.stdout)


class CompareRuns(unittest.TestCase):
    TABLE = "Step Temp E_pair\n0 1.44 {energy}\n100 0.7 -5.7\nLoop time of 2.5 on 1 procs\n"
    TIMES = "Neigh   | 0.5 | 0.5 | 0.5 |  0.0 | 20.0\nAve neighs/atom = 37.6\nNeighbor list builds = 5\n"

    def write_log(self, name, energy="-6.77", table=None, times=None):
        text = (table or self.TABLE).format(energy=energy) + (self.TIMES if times is None else times)
        (host.work / name).write_text(text)

    def check(self, exit_code, *messages):
        done = compare("native.log", "other.log")
        self.assertEqual(done.returncode, exit_code, done.stdout + done.stderr)
        for message in messages:
            self.assertIn(message, done.stdout + done.stderr)

    def setUp(self):
        self.write_log("native.log")

    def test_equal_logs(self):
        self.write_log("other.log")
        self.check(0, "100 0.7 -5.7", "Neigh time, s", "first line, step 0: 0\n")

    def test_energies_that_differ_are_a_mismatch(self):
        self.write_log("other.log", energy="-6.7700001")
        self.check(1, "E_pair of the first line differs by 1.48e-08, more than 1e-12")

    def test_energies_that_are_no_numbers_are_a_mismatch(self):
        self.write_log("other.log", energy="nan")
        self.check(1, "E_pair of the first line differs by nan")

    def test_logs_that_cannot_be_used(self):
        for options, message in (({"table": "nothing\n"}, "other.log: no thermo output"),
                                 ({"times": "Neighbor list builds = 5\n"}, "no line with 'Neigh |'"),
                                 ({"table": self.TABLE.replace("Temp", "Press")}, "the thermo columns differ"),
                                 ({"table": self.TABLE.replace("100 ", "200 ")}, "have different steps")):
            with self.subTest(message=message):
                self.write_log("other.log", **options)
                self.check(3, message)

    def test_no_file(self):
        (host.work / "other.log").unlink(missing_ok=True)
        self.check(3, "other.log: No such file or directory")


def main():
    global host
    parser = argparse.ArgumentParser(description=__doc__)
    Host.add_arguments(parser)
    arguments, rest = parser.parse_known_args()
    host = Host(arguments)
    unittest.main(argv=[sys.argv[0]] + rest, verbosity=2)


if __name__ == "__main__":
    main()
