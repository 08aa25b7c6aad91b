#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Checks the site that scripts/docs has made.

usage: check_site.py ROOT; exit status 1 if a page of ROOT or a public name is not on it, if a link or its anchor leads nowhere,
or if a page takes anything from a network.
"""
import ast
import html.parser
import pathlib
import re
import sys
import urllib.parse

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "style"))
import check_links

GUIDES = ("index", "lammps", "openmm", "python", "cpp", "replay", "theory", "measured", "project", "api/python", "api/cpp")
# At the start of a line: no declaration ahead of a definition, and nothing of a namespace for the library's own use.
DECLARED = re.compile(r"^(?:class|struct|enum class) (\w+)(?: final)?(?: : [^;]*)? \{", re.MULTILINE)
OWN_USE = re.compile(r"^namespace (?:dch::)?detail \{.*?^\}  // namespace (?:dch::)?detail", re.MULTILINE | re.DOTALL)
TAKEN = {"img": "src", "script": "src", "link": "href", "iframe": "src", "source": "src", "object": "data"}


class Page(html.parser.HTMLParser):
    """What a page has to link to, what it links to, and what it takes."""

    def __init__(self, path):
        super().__init__()
        self.ids, self.links, self.taken = set(), set(), set()
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.ids |= {values[key] for key in ("id", "name") if values.get(key)}
        if tag == "a" and values.get("href"):
            self.links.add(values["href"])
        if values.get(TAKEN.get(tag)):
            self.taken.add(values[TAKEN[tag]])


def dead_links(site, pages):
    for path, page in pages.items():
        for link in sorted(page.links | page.taken):
            parts = urllib.parse.urlsplit(link)
            if parts.scheme or parts.netloc:
                if link in page.taken:
                    yield f"{path.relative_to(site)}: {link} is taken from a network"
                continue
            target = (path.parent / urllib.parse.unquote(parts.path)).resolve() if parts.path else path
            fragment = urllib.parse.unquote(parts.fragment)
            if not target.is_file():
                yield f"{path.relative_to(site)}: {link} does not exist"
            elif fragment and target in pages and fragment not in pages[target].ids:
                yield f"{path.relative_to(site)}: {link} has no such anchor"


def missing_pages(root, site):
    wanted = [site / f"docs/site/{name}.html" for name in GUIDES]
    wanted += [site / pathlib.Path(page).relative_to(root).with_suffix(".html") for page in check_links.markdown_files(str(root))]
    yield from (f"{page.relative_to(site)} is missing" for page in wanted if not page.is_file())


def python_names(root):
    """What __all__ of dch and of its adapters lists; a module whose name begins with _ is for nobody's script."""
    for path in sorted((root / "python" / "dch").glob("*.py")):
        if path.stem.startswith("_") and path.stem != "__init__":
            continue
        module = "dch" if path.stem == "__init__" else f"dch.{path.stem}"
        for node in ast.parse(path.read_text(encoding="utf-8")).body:
            if isinstance(node, ast.Assign) and node.targets[0].id == "__all__":
                yield from (f"{module}.{name}" for name in ast.literal_eval(node.value) if name != "__version__")


def missing_names(root, pages, site):
    ids = set().union(*(page.ids for path, page in pages.items() if (site / "docs" / "site" / "api") in path.parents))
    for header in sorted(root.glob("*/include/dch/**/*.hpp")):
        for name in DECLARED.findall(OWN_USE.sub("", header.read_text(encoding="utf-8"))):
            if not any(f"{len(name)}{name}" in there for there in ids):
                yield f"{header.relative_to(root)}: {name} is not on the site"
    yield from (f"{name} is not on the site" for name in python_names(root) if name not in ids)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    root = pathlib.Path(sys.argv[1]).resolve()
    site = root / "build" / "docs" / "html"
    pages = {path: Page(path) for path in sorted(site.rglob("*.html"))}
    faults = [*missing_pages(root, site), *missing_names(root, pages, site), *dead_links(site, pages)]
    links = sum(len(page.links) for page in pages.values())
    print(f"{len(pages)} pages, {links} links, {len(faults)} faults", *faults, sep="\n  ")
    return 1 if faults or not pages else 0


if __name__ == "__main__":
    sys.exit(main())
