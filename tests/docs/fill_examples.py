#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Puts the C++ examples of pages into a program: a line `EXAMPLE page.md k` becomes the k-th block of docs/page.md.

usage: fill_examples.py TEMPLATE DOCS PROGRAM; exit status 1 if there is a block in one of these pages that the program lacks.
"""
import pathlib
import re
import sys
import textwrap

EXAMPLE = re.compile(r"^( *)EXAMPLE (\S+\.md) (\d+)\n", re.MULTILINE)
BLOCK = re.compile(r"^```cpp\n(.*?)^```", re.MULTILINE | re.DOTALL)
INCLUDE = re.compile(r"^#include .*\n", re.MULTILINE)


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    template, docs, program = map(pathlib.Path, sys.argv[1:])
    text = template.read_text(encoding="utf-8")
    used = [(name, k) for _, name, k in EXAMPLE.findall(text)]
    blocks = {(name, str(k)): block for name, _ in used
              for k, block in enumerate(BLOCK.findall((docs / name).read_text(encoding="utf-8")), start=1)}
    if sorted(used) != sorted(blocks):
        sys.exit(f"{template.name} has {sorted(used)}, the pages {sorted(blocks)}")
    includes = [line for block in blocks.values() for line in INCLUDE.findall(block)]
    body = EXAMPLE.sub(lambda example: textwrap.indent(INCLUDE.sub("", blocks[example[2], example[3]]), example[1]), text)
    program.write_text("".join(dict.fromkeys(includes)) + body, encoding="utf-8")


if __name__ == "__main__":
    main()
