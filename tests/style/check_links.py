#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks that each relative link in the project's Markdown files leads to a file that exists.

usage: check_links.py ROOT; exit status 1 if a link leads nowhere.
"""

import os
import re
import sys

LINK = re.compile(r"\]\(([^)\s]+)\)")
SKIPPED_FOLDERS = re.compile(r"^(\.git|build.*|out)$")


def markdown_files(root):
    for folder, folders, files in os.walk(root):
        folders[:] = sorted(f for f in folders if not SKIPPED_FOLDERS.match(f))
        for name in sorted(files):
            if name.endswith(".md"):
                yield os.path.join(folder, name)


def broken_links(path):
    with open(path, encoding="utf-8") as file:
        for number, line in enumerate(file, start=1):
            for target in LINK.findall(line):
                if re.match(r"[a-z]+:|#", target):
                    continue
                if not os.path.exists(os.path.join(os.path.dirname(path), target.split("#")[0])):
                    yield number, target


def main():
    if len(sys.argv) != 2:
        print(__doc__.splitlines()[2], file=sys.stderr)
        return 2
    root = sys.argv[1]
    files = list(markdown_files(root))
    found = [(path, number, target) for path in files for number, target in broken_links(path)]
    for path, number, target in found:
        print(f"{os.path.relpath(path, root)}:{number}: {target} does not exist", file=sys.stderr)
    print(f"{len(files)} files, {len(found)} broken links")
    return 1 if found or not files else 0


if __name__ == "__main__":
    sys.exit(main())
