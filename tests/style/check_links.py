#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks that each relative link in the project's Markdown files leads to a file that exists, and to a heading in it.

usage: check_links.py ROOT; exit status 1 if a link leads nowhere.
"""

import functools
import os
import re
import sys

LINK = re.compile(r"\]\(([^)\s]+)\)")
CODE = re.compile(r"^```.*?^```", re.MULTILINE | re.DOTALL)
HEADING = re.compile(r"^#+ (.*)$", re.MULTILINE)
SKIPPED_FOLDERS = re.compile(r"^(\.git|build.*|out)$")


def markdown_files(root):
    for folder, folders, files in os.walk(root):
        folders[:] = sorted(f for f in folders if not SKIPPED_FOLDERS.match(f))
        for name in sorted(files):
            if name.endswith(".md"):
                yield os.path.join(folder, name)


@functools.cache
def anchors(path):
    """Of the headings of a page, as GitHub makes them."""
    with open(path, encoding="utf-8") as file:
        headings = HEADING.findall(CODE.sub("", file.read()))
    found = set()
    for heading in headings:
        text = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", heading).strip().lower()
        anchor = re.sub(r"[^\w\- ]", "", text).replace(" ", "-")
        found.add(anchor if anchor not in found else next(name for k in range(1, 1000) if (name := f"{anchor}-{k}") not in found))
    return found


def broken_links(path):
    with open(path, encoding="utf-8") as file:
        for number, line in enumerate(file, start=1):
            for target in LINK.findall(line):
                if re.match(r"[a-z]+:", target):
                    continue
                name, _, anchor = target.partition("#")
                there = os.path.join(os.path.dirname(path), name) if name else path
                if not os.path.exists(there):
                    yield number, f"{target} does not exist"
                elif anchor and there.endswith(".md") and anchor not in anchors(os.path.normpath(there)):
                    yield number, f"{target} is no heading of that page"


def main():
    if len(sys.argv) != 2:
        print(__doc__.splitlines()[2], file=sys.stderr)
        return 2
    root = sys.argv[1]
    files = list(markdown_files(root))
    found = [(path, number, target) for path in files for number, target in broken_links(path)]
    for path, number, target in found:
        print(f"{os.path.relpath(path, root)}:{number}: {target}", file=sys.stderr)
    print(f"{len(files)} files, {len(found)} broken links")
    return 1 if found or not files else 0


if __name__ == "__main__":
    sys.exit(main())
