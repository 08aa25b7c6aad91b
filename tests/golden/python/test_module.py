#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The module as a whole: its version, its stub, and the examples of pages.

usage: test_module.py VERSION PAGE [PAGE ...]
"""
import ast
import importlib.util
import pathlib
import re
import sys
import unittest

import dch
from dch import _core

DATA = pathlib.Path(__file__).resolve().parents[2] / "data"
VERSION, PAGES = sys.argv[1], [pathlib.Path(name) for name in sys.argv[2:]]


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

    def test_examples_of_the_pages_run(self):
        for page in PAGES:
            blocks = re.findall(r"^```python\n(.*?)^```", page.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE)
            self.assertGreater(len(blocks), 1, page)
            names = {}
            for block in blocks:
                if "import openmm_dch" in block:
                    continue  # of the plugin, which has tests of its own
                if "dch.trajectory" in block and importlib.util.find_spec("dch._trajectory") is None:
                    continue  # not built
                block = block.replace("run.xtc", str(DATA / "cell_shapes.xtc"))
                exec(compile(block, str(page), "exec"), names)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
