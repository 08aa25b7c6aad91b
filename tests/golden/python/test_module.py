#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The module as a whole: its version, its stub, and the examples of the user guide.

usage: test_module.py VERSION GUIDE
"""
import ast
import pathlib
import re
import sys
import unittest

import dch
from dch import _core

VERSION, GUIDE = sys.argv[1], pathlib.Path(sys.argv[2])


def public(names):
    return {name for name in names if not name.startswith("_")}


class Module(unittest.TestCase):
    def test_the_version_is_that_of_the_project(self):
        self.assertEqual(dch.__version__, VERSION)

    def test_the_stub_names_what_there_is(self):
        stub = ast.parse(pathlib.Path(_core.__file__).with_name("_core.pyi").read_text())
        declared = {}
        for node in stub.body:
            if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
                declared[node.name] = node
            elif isinstance(node, ast.AnnAssign):
                declared[node.target.id] = node
        self.assertEqual(public(declared), public(dir(_core)))
        for name, node in declared.items():
            if isinstance(node, ast.ClassDef) and "Invalid" not in name and "Large" not in name:
                methods = public(n.name for n in node.body if isinstance(n, ast.FunctionDef))
                self.assertEqual(methods, public(dir(getattr(_core, name))), name)
            elif isinstance(node, ast.FunctionDef):
                arguments = [argument.arg for argument in node.args.args]
                described = re.search(r"\((.*)\)", getattr(_core, name).__doc__)[1]
                self.assertEqual(arguments, re.findall(r"(\w+): ", described), name)
        self.assertTrue(pathlib.Path(_core.__file__).with_name("py.typed").exists())

    def test_what_is_public_has_a_docstring(self):
        for name in public(dch.__all__):
            self.assertTrue(getattr(dch, name).__doc__, name)

    def test_examples_of_the_guide_run(self):
        blocks = re.findall(r"```python\n(.*?)```", GUIDE.read_text(), re.DOTALL)
        self.assertGreater(len(blocks), 3)
        names = {}
        for block in blocks:
            exec(compile(block, str(GUIDE), "exec"), names)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
