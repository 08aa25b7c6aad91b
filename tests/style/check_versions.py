#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks that the version of the project stands everywhere it is written down, and CITATION.cff against the Citation File
Format 1.2.0, as far as it uses it.

usage: check_versions.py ROOT; exit status 1 if not.
"""
import pathlib
import re
import sys

import yaml

VERSIONS = {"CITATION.cff": r"^version: (\S+)$", "packaging/changelog": r"^dch \((\S+)-\d+\)",
            "packaging/spack/package.py": r'^    version\("(\S+)"\)$', "packaging/conda/recipe.yaml": r"^  version: (\d\S+)$",
            "replay/man/dchmd.1": r'^\.TH DCHMD 1 "" "dch (\S+)"', "docs/install.md": r"The version is (\d\S*\d)\."}
REQUIRED = {"cff-version": str, "message": str, "title": str, "authors": list}
FIELDS = {**REQUIRED, "type": str, "version": str, "license": str, "keywords": list, "references": list}
REFERENCE = {"type": str, "title": str, "authors": list}
PERSON = {"family-names", "given-names"}


def first(root, path, pattern):
    found = re.search(pattern, (root / path).read_text(encoding="utf-8"), re.MULTILINE)
    return found[1] if found else "nothing"


def wrong_versions(root):
    wanted = first(root, "CMakeLists.txt", r"^project\(dch VERSION (\S+)")
    for path, pattern in VERSIONS.items():
        if first(root, path, pattern) != wanted:
            yield f"{path} has version {first(root, path, pattern)}, CMakeLists.txt {wanted}"


def wrong_fields(entry, fields, required):
    for name, value in entry.items():
        if not isinstance(value, fields.get(name, ())):
            yield f"{name}: {value!r} is no field, or of another kind"
    for name in required - entry.keys():
        yield f"lacks {name}"
    for author in entry.get("authors", []):
        if not (set(author) == {"name"} or set(author) == PERSON):
            yield f"author {author}"


def wrong_citation(root):
    citation = yaml.safe_load((root / "CITATION.cff").read_text(encoding="utf-8"))
    yield from wrong_fields(citation, FIELDS, REQUIRED.keys())
    if citation.get("cff-version") != "1.2.0" or citation.get("type") != "software":
        yield "cff-version is not 1.2.0, or type not software"
    for reference in citation.get("references", []):
        yield from wrong_fields(reference, REFERENCE, REFERENCE.keys())


def main():
    if len(sys.argv) != 2:
        print(__doc__.splitlines()[3], file=sys.stderr)
        return 2
    root = pathlib.Path(sys.argv[1])
    found = [*wrong_versions(root), *(f"CITATION.cff: {wrong}" for wrong in wrong_citation(root))]
    print("\n".join(found) or f"{len(VERSIONS)} files agree about the version")
    return 1 if found else 0


sys.exit(main())
