#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""benchmarks/lammps/drift on a melt so small that its figures mean little, and what it does with runs that cannot be
counted."""

import re
import shutil
import subprocess
import unittest
from pathlib import Path

from script_tests import host, main

SCRIPT = Path(__file__).resolve().parents[3] / "benchmarks" / "lammps" / "drift"
SIZE = ["--chains", "10", "--beads", "50", "--steps", "1000", "--seeds", "2", "--verify", "10"]


class Drift(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = host.work / "drift"
        shutil.rmtree(cls.folder, ignore_errors=True)
        cls.first = cls.drift()

    @classmethod
    def drift(cls, *more):
        """Short runs keep close to each other, so the few seeds do not spoil the comparison."""
        command = [SCRIPT, "--build", host.loader.parent.parent, "--lmp", host.lmp, "--to", cls.folder, *SIZE, *more]
        return subprocess.run(list(map(str, command)), check=False, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)

    def test_runs_and_compares(self):
        done = self.first
        self.assertEqual(done.returncode, 0, done.stdout)
        for variant in ("double", "mixed"):
            for seed in (1, 2):
                self.assertRegex(done.stdout, rf"{variant}, seed {seed}: -?\d\S* a step, \d+ builds of lists; [1-9]\d* builds, "
                                 r"[1-9]\d* pairs compared")
        table = re.findall(r"^(stock|double|mixed) +(\S+) +(\S+) +(\S+) +(\S+)$", done.stdout, re.MULTILINE)
        self.assertEqual([row[0] for row in table], ["stock", "double", "mixed"])
        for _, mean, deviation, difference, allowed in table:
            self.assertLess(abs(float(mean)), 1e-4)
            self.assertGreater(float(deviation), 0)
            self.assertLessEqual(abs(float(difference)), float(allowed))

    def test_what_is_there_is_not_run_again(self):
        log = self.folder / "mixed.2"
        before = log.stat().st_mtime_ns
        self.assertEqual(self.drift().stdout, self.first.stdout)
        self.assertEqual(log.stat().st_mtime_ns, before)

    def test_means_too_far_apart(self):
        done = self.drift("--deviations", "0")
        self.assertEqual(done.returncode, 1, done.stdout)

    def test_runs_that_cannot_be_counted(self):
        log = self.folder / "double.1"
        whole = log.read_text()
        lines = whole.splitlines(keepends=True)
        last = next(k for k, line in enumerate(lines) if line.startswith("Loop time")) - 1
        fewer = lines[last].replace(" 500 ", " 499 ", 1)
        self.assertNotEqual(fewer, lines[last])
        try:
            for text, message in (("".join(lines[:last] + lines[last + 1:]), "are not one each 50 of 1000 steps"),
                                  ("".join(lines[:last] + [fewer] + lines[last + 1:]), "not all of 500 atoms"),
                                  (re.sub(r"verified .*", "", whole), "does not say that pairs were compared")):
                with self.subTest(message=message):
                    log.write_text(text)
                    done = self.drift()
                    self.assertEqual(done.returncode, 1, done.stdout)
                    self.assertIn("drift: double, seed 1: ", done.stdout)
                    self.assertIn(message, done.stdout)
        finally:
            log.write_text(whole)

    def test_a_run_that_fails(self):
        log = self.folder / "stock.1"
        kept = log.rename(self.folder / "kept")
        try:
            done = self.drift("--lmp", "false")
            self.assertEqual(done.returncode, 1, done.stdout)
            self.assertIn("ended with 1; see", done.stdout)
            self.assertFalse(log.exists())
        finally:
            kept.rename(log)

    def test_wrong_calls(self):
        for words, message in ((["triple"], "no variant 'triple'; there are stock, double, mixed"),
                               (["--seeds", "1"], "a standard deviation needs at least 2"),
                               (["--steps", "0"], "have to be at least 1"),
                               (["--steps", "130"], "a multiple of it")):
            with self.subTest(words=words):
                done = self.drift(*words)
                self.assertEqual(done.returncode, 2, done.stdout)
                self.assertIn(message, done.stdout)


if __name__ == "__main__":
    main(__doc__)
