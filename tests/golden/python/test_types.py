#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Types: mypy finds nothing in the package, nor stubtest in what the stub says of the compiled half."""
import importlib.util
import pathlib
import subprocess
import tempfile
import unittest

CONFIGURATION = """[mypy]
strict = True
[mypy-ase.*,openmm.*,MDAnalysis.*,h5py.*]
ignore_missing_imports = True
"""
# Of no interest to who writes types: the class of classes, which pybind11 has of its own.
ALLOWED = "".join(rf"dch\._core\.{name}" "\n" for name in ("Chains", "ContactQuery", "Contacts", "CrossingSteps", "Levels", "Map", "Request",
                                                            "Search", "VerletPairs"))


class Types(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.addCleanup(self.scratch.cleanup)

    def path(self, name, text):
        path = pathlib.Path(self.scratch.name, name)
        path.write_text(text)
        return path

    def run_in_scratch(self, *command):
        done = subprocess.run(command, cwd=self.scratch.name, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.assertEqual(done.returncode, 0, done.stdout)

    def test_the_package(self):
        self.run_in_scratch("/usr/bin/mypy", "--config-file", self.path("mypy.ini", CONFIGURATION), "--cache-dir", "cache",
                            "-p", "dch")

    def test_the_stub(self):
        self.run_in_scratch("/usr/bin/stubtest", "dch._core", "--mypy-config-file", self.path("mypy.ini", CONFIGURATION),
                            "--allowlist", self.path("allowed", ALLOWED))

    def test_the_stub_of_trajectories(self):
        if importlib.util.find_spec("dch._trajectory") is None:
            self.skipTest("not built")
        self.run_in_scratch("/usr/bin/stubtest", "dch._trajectory", "--mypy-config-file", self.path("mypy.ini", CONFIGURATION),
                            "--allowlist", self.path("allowed", "dch\\._trajectory\\.Reader\n"))

    def test_a_program_that_uses_it(self):
        program = "import dch\n\nverlet = dch.VerletList(2.5, 0.3)\nrebuilt: bool = verlet.update([[0, 0, 0]])\n"
        self.run_in_scratch("/usr/bin/mypy", "--strict", self.path("right.py", program))
        with self.assertRaisesRegex(AssertionError, "Incompatible types in assignment"):
            self.run_in_scratch("/usr/bin/mypy", "--strict", self.path("wrong.py", program.replace("bool", "str")))


if __name__ == "__main__":
    unittest.main()
