#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""What configuring and installing the adapter do where a user is likely to go wrong."""

import subprocess
import unittest
from pathlib import Path

from script_tests import MELT, host, main

CMAKE = Path(__file__).resolve().parents[3] / "lammps_pair_style" / "cmake"


def call(*words, **options):
    return subprocess.run(list(map(str, words)), check=False, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, **options)


class Prefix(unittest.TestCase):
    def test_a_relative_prefix(self):
        """The include file names the library by its full path, so LAMMPS may run in any folder."""
        done = call("cmake", "--install", host.loader.parents[1], "--component", "lammps-dch", "--prefix", "relative",
                    cwd=host.work)
        self.assertEqual(done.returncode, 0, done.stdout)
        loaders = list((host.work / "relative").rglob("dch.lmp"))
        self.assertEqual(len(loaders), 1, done.stdout)
        code, output = host.run_text("include ${load}\n" + MELT + "dch on\nrun 0\ndch stats\n", variables={"load": loaders[0]})
        self.assertEqual(code, 0, output)
        self.assertIn("half, newton on: DCH", output)
        libraries = list((host.work / "relative").rglob("libdch_lammps.so"))
        self.assertIn(f"string {libraries[0]}\n", loaders[0].read_text())


class Sizes(unittest.TestCase):
    """A library with 64-bit atom IDs is refused when the adapter is configured, and its headers when it is compiled."""

    def check(self, library):
        script = host.work / "sizes.cmake"
        script.write_text(f"include({CMAKE}/LammpsSizes.cmake)\ndch_check_lammps_sizes({library})\n")
        return call("cmake", "-P", script)

    def test_the_library_of_these_tests(self):
        library = next(Path("/usr/lib").rglob("liblammps.so.0"))
        done = self.check(library)
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertIn("_ZN9LAMMPS_NS4Atom7map_oneEi", call("nm", "-D", library).stdout)

    def test_long_ids(self):
        source = host.work / "long_ids.cpp"
        source.write_text("namespace LAMMPS_NS { struct Atom { int map_one(long, int); };\n"
                          "int Atom::map_one(long a, int) { return int(a); } }\n")
        library = host.work / "long_ids.so"
        self.assertEqual(call("c++", "-shared", "-fPIC", source, "-o", library).returncode, 0)
        done = self.check(library)
        self.assertNotEqual(done.returncode, 0)
        said = " ".join(done.stdout.split())  # CMake breaks lines where they end
        self.assertIn("is built with LAMMPS_BIGBIG", said)
        self.assertIn("LAMMPS_SIZES=smallbig", said)


if __name__ == "__main__":
    main(__doc__)
