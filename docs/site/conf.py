# SPDX-License-Identifier: MIT
"""The site that scripts/docs makes. Its folder of sources is the root of the tree, so that pages are where they lie."""
import importlib.machinery
import importlib.util
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "python"), str(ROOT / "docs" / "site")]


def load_stub(name, path):
    """The stub of a compiled module in its place: what Python's own modules import of it, without a build."""
    loader = importlib.machinery.SourceFileLoader(name, str(path))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(name, loader))
    module.version = release
    sys.modules[name] = module
    loader.exec_module(module)


project = "dch"
author = "The authors of dch"
release = re.search(r"project\(dch VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"))[1]
sys.dont_write_bytecode = True
load_stub("dch._core", ROOT / "python" / "dch" / "_core.pyi")
load_stub("dch._trajectory", ROOT / "python" / "dch" / "_trajectory.pyi")

root_doc = "docs/site/index"
include_patterns = ["**.md"]
exclude_patterns = ["build*", "out", ".git"]
extensions = ["breathe", "myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon", "site_extension"]

html_theme = "sphinx_rtd_theme"
html_title = f"dch {release}"
html_extra_path = ["index.html"]
html_copy_source = False
html_show_copyright = False
highlight_language = "none"

myst_heading_anchors = 6
breathe_projects = {"dch": str(ROOT / "build" / "docs" / "xml")}
breathe_default_project = "dch"
autodoc_member_order = "bysource"
