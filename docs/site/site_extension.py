# SPDX-License-Identifier: MIT
"""What the site needs beyond Sphinx's own extensions.

- The directive `public-headers FOLDER`: all that the headers in a folder declare, a section for each header.
- Links to folders lead to the page of the folder, its README.md or its headers; a folder without one is named only.
"""
import collections
import os
import pathlib
import xml.etree.ElementTree as ET

from docutils import nodes
from docutils.statemachine import StringList
from sphinx import addnodes
from sphinx.util.docutils import SphinxDirective

ROOT = pathlib.Path(__file__).resolve().parents[2]
XML = ROOT / "build" / "docs" / "xml"
# Of namespaces and, of files, what is in none.
MEMBERS = {"namespace": ("enum", "typedef", "variable", "function"), "file": ("define",)}


def entries_of(definition):
    """(place, directive, name) of a class, or of what a namespace or a file holds."""
    kind, scope = definition.get("kind"), definition.findtext("compoundname")
    if kind in ("class", "struct"):
        yield definition.find("location"), kind, scope
        return
    members = [member for member in definition.iter("memberdef") if member.get("kind") in MEMBERS.get(kind, ())]
    times = collections.Counter(member.findtext("name") for member in members)
    for member in members:
        name = member.findtext("name")
        overload = member.findtext("argsstring") if times[name] > 1 else ""
        yield member.find("location"), member.get("kind"), f"{scope}::{name}{overload}" if kind == "namespace" else name


def declarations():
    """Header -> (line, directive, name) of what is declared in it, but for members of classes."""
    found, classes = collections.defaultdict(list), set()
    for compound in ET.parse(XML / "index.xml").getroot().findall("compound"):
        definition = ET.parse(XML / f"{compound.get('refid')}.xml").getroot().find("compounddef")
        for place, kind, name in entries_of(definition):
            found[place.get("file")].append((int(place.get("line")), kind, name))
            if kind in ("class", "struct"):
                classes.add(name)
    return {header: sorted(entry for entry in entries if entry[2].rpartition("::")[0] not in classes)
            for header, entries in found.items()}


class PublicHeaders(SphinxDirective):
    required_arguments = 1

    def run(self):
        headers = sorted((ROOT / self.arguments[0]).glob("*.hpp"))
        if not headers:
            raise self.error(f"there is no header in {self.arguments[0]}")
        if not hasattr(self.env, "dch_declarations"):
            self.env.dch_declarations = declarations()
        parent = nodes.section()
        for header in headers:
            self.env.note_dependency(str(header))
            entries = self.env.dch_declarations.get(str(header.relative_to(ROOT)))
            if not entries and "namespace dch::detail {" in header.read_text(encoding="utf-8"):
                continue  # users name nothing of it
            if not entries:
                raise self.error(f"Doxygen knows of nothing in {header}")
            lines = [f"## {str(header).split('/include/')[1]}", ""]
            for _, kind, name in entries:
                lines += [f"```{{doxygen{kind}}} {name}", *([":members:", ":undoc-members:"] if kind in ("class", "struct") else []),
                          "```", ""]
            self.state.nested_parse(StringList(lines, source=str(header)), 0, parent, match_titles=True)
        return parent.children


def page_of(folder):
    """README.md of a folder, else the page of its public headers, else nothing."""
    if (folder / "README.md").exists():
        return folder / "README.md"
    directive = f"{{public-headers}} {folder.relative_to(ROOT)}"
    pages = sorted((ROOT / "docs" / "site" / "api").glob("*.md"))
    return next((page for page in pages if directive in page.read_text(encoding="utf-8")), None)


def follow_links(app, doctree):
    """Links as GitHub has them: to folders, and from a part of README.md that a page includes."""
    env = app.env
    here = pathlib.Path(env.doc2path(env.docname)).parent
    for link in list(doctree.findall(addnodes.pending_xref)):
        path, _, anchor = link["reftarget"].partition("#")
        if link["reftype"] != "myst" or not path:
            continue
        target = (here / path if (here / path).exists() else ROOT / path).resolve()
        if not target.exists():
            continue  # Sphinx warns
        if target.is_dir():
            target = page_of(target)
        if target is None:
            link.replace_self(link.children)
        elif target.suffix == ".md":
            link["reftarget"] = os.path.relpath(target, here) + (f"#{anchor}" if anchor else "")
        else:
            link.replace_self(addnodes.download_reference("", "", *link.children, refdoc=env.docname,
                                                          reftarget=os.path.relpath(target, here)))


def setup(app):
    app.add_directive("public-headers", PublicHeaders)
    app.connect("doctree-read", follow_links, priority=400)  # before files to download are collected
    return {"parallel_read_safe": True}
