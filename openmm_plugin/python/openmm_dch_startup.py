# SPDX-License-Identifier: MIT
"""Imports openmm_dch as soon as a program has imported openmm; openmm_dch.pth runs this where OPENMM_DCH is 1."""

import importlib
import importlib.abc
import sys


class _Loader(importlib.abc.Loader):
    """Loads openmm as it would be loaded, then openmm_dch."""

    def __init__(self, loader):
        self._loader = loader

    def create_module(self, spec):
        return self._loader.create_module(spec)

    def exec_module(self, module):
        module.__loader__ = module.__spec__.loader = self._loader
        self._loader.exec_module(module)
        importlib.import_module("openmm_dch")


class _Finder(importlib.abc.MetaPathFinder):
    """Finds openmm as the other finders do, each time anew: programs may look for it before they import it."""

    def find_spec(self, name, path, target=None):
        if name != "openmm":
            return None
        found = (finder.find_spec(name, path, target) for finder in sys.meta_path if finder is not self)
        spec = next((s for s in found if s is not None), None)
        if spec is not None and spec.loader is not None:  # a folder without __init__.py has none
            spec.loader = _Loader(spec.loader)
        return spec


sys.meta_path.insert(0, _Finder())
