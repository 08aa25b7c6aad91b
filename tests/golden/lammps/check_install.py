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
    """Whether a LAMMPS has atom IDs of 64 bits, which its library tells when the adapter is configured."""

    def sizes_of(self, library):
        script = host.work / "sizes.cmake"
        script.write_text(f"include({CMAKE}/LammpsSizes.cmake)\ndch_find_lammps_sizes(sizes {library})\n"
                          "message(NOTICE ${sizes})\n")
        done = call("cmake", "-P", script)
        self.assertEqual(done.returncode, 0, done.stdout)
        return done.stdout.strip()

    def test_the_library_of_these_tests(self):
        library = next(Path("/usr/lib").rglob("liblammps.so.0"))
        self.assertEqual(self.sizes_of(library), "LAMMPS_SMALLBIG")
        self.assertIn("_ZN9LAMMPS_NS4Atom7map_oneEi", call("nm", "-D", library).stdout)

    def test_long_ids(self):
        source = host.work / "long_ids.cpp"
        source.write_text("namespace LAMMPS_NS { struct Atom { int map_one(long, int); };\n"
                          "int Atom::map_one(long a, int) { return int(a); } }\n")
        library = host.work / "long_ids.so"
        self.assertEqual(call("c++", "-shared", "-fPIC", source, "-o", library).returncode, 0)
        self.assertEqual(self.sizes_of(library), "LAMMPS_BIGBIG")


if __name__ == "__main__":
    main(__doc__)
