# SPDX-License-Identifier: MIT
"""Imports openmm_dch as soon as a program has imported openmm; openmm_dch.pth runs this where OPENMM_DCH is 1."""

import importlib.abc
import importlib.util
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
    def find_spec(self, name, path, target=None):
        if name != "openmm":
            return None
        sys.meta_path.remove(self)
        spec = importlib.util.find_spec(name)
        if spec is not None:
            spec.loader = _Loader(spec.loader)
        return spec


sys.meta_path.insert(0, _Finder())
