#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The entry point by which ASE 4 finds neighbor lists: what is installed says so, and what it names is what ASE wants.

usage: test_ase_plugin.py PYPROJECT

Versions of ASE that have no such plugins get none; a stand-in for the class that they lack shows what later ones get.
"""
import configparser
import importlib
import importlib.metadata
import importlib.util
import pathlib
import re
import sys
import types
import unittest
from unittest import mock

import numpy as np
from ase import Atoms
from ase.neighborlist import neighbor_list as ase_neighbor_list

import dch
from scenes import Scene, sorted_rows

PYPROJECT = pathlib.Path(sys.argv[1])
ASE_PLUGINS = "ase._4.plugins.neighborlist"


class NeighborListPlugin:
    """As the class of that name in ASE: the implementation is named, and imported when it is wanted."""

    def __init__(self, name, *, long_name, citation, implementation):
        self.name, self.long_name, self.citation, self.implementation = name, long_name, citation, implementation


def ase_has_plugins():
    try:
        return importlib.util.find_spec(ASE_PLUGINS) is not None
    except ImportError:
        return False


def entry_points():
    """Of the module under test alone: another dch may be installed."""
    path = [str(pathlib.Path(dch.__file__).parents[1])]
    return [point for found in importlib.metadata.distributions(name="dch", path=path) for point in found.entry_points]


class Installed(unittest.TestCase):
    def test_metadata_are_those_of_the_module(self):
        found = importlib.metadata.metadata("dch")
        self.assertEqual((found["Name"], found["Version"]), ("dch", dch.__version__))
        self.assertEqual(importlib.metadata.requires("dch")[0], "numpy")

    def test_metadata_are_those_of_the_wheel(self):
        text = PYPROJECT.read_text()
        point, module = re.search(r'^\[project\.entry-points\."ase\.plugins"\]\n(\w+) = "([\w.]+)"$', text, re.MULTILINE).groups()
        self.assertEqual([(entry.group, entry.name, entry.value) for entry in entry_points()], [("ase.plugins", point, module)])
        found = importlib.metadata.metadata("dch")
        for field, key in (("Summary", "description"), ("Requires-Python", "requires-python")):
            self.assertEqual(found[field], re.search(f'^{key} = "(.*)"$', text, re.MULTILINE)[1])

    def test_the_file_can_be_read(self):
        files = [path for path in pathlib.Path(dch.__file__).parents[1].glob("dch-*.dist-info/entry_points.txt")]
        self.assertEqual(len(files), 1)
        parser = configparser.ConfigParser()
        parser.read(files[0])
        self.assertEqual(parser.sections(), ["ase.plugins"])


class Plugin(unittest.TestCase):
    def setUp(self):
        self.module = entry_points()[0].load()
        self.addCleanup(importlib.reload, self.module)

    def loaded(self):
        """The module of the entry point, anew, as ASE loads it."""
        return importlib.reload(self.module)

    def test_who_has_no_plugins_gets_none(self):
        with mock.patch.dict(sys.modules, {ASE_PLUGINS: None}):  # cannot be imported
            self.assertEqual(self.loaded().__ase_plugins__, set())

    def plugin(self):
        """The one that ASE gets, of its own class if it has it."""
        if ase_has_plugins():
            plugins = self.loaded().__ase_plugins__
        else:
            names = ASE_PLUGINS.split(".")
            modules = {".".join(names[:k]): types.ModuleType(".".join(names[:k])) for k in range(2, len(names) + 1)}
            modules[ASE_PLUGINS].NeighborListPlugin = NeighborListPlugin
            with mock.patch.dict(sys.modules, modules):
                plugins = self.loaded().__ase_plugins__
        self.assertEqual(len(plugins), 1)
        return next(iter(plugins))

    def test_pairs_are_those_of_ase(self):
        plugin = self.plugin()
        self.assertEqual(plugin.name, "dch")
        find = plugin.implementation
        if isinstance(find, str):
            module, name = find.rsplit(".", 1)
            find = getattr(importlib.import_module(module), name)
        for seed in range(5000, 5012):
            scene = Scene(seed)
            atoms = Atoms(scene.numbers, scene.positions, cell=scene.cell, pbc=scene.pbc)
            for with_self in (False, True):
                found = sorted_rows(*find("ijSD", atoms=atoms, cutoff=scene.cutoff, self_interaction=with_self))
                expected = sorted_rows(*ase_neighbor_list("ijSD", atoms, scene.cutoff, with_self))
                for ours, theirs in zip(found, expected):
                    np.testing.assert_allclose(ours, theirs, rtol=0, atol=1e-12, err_msg=str(scene))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
