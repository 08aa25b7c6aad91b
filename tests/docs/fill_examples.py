#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Puts the C++ examples of pages and headers into a program: a line `EXAMPLE page.md k` becomes the k-th block of docs/page.md,
`EXAMPLE lists/name.hpp k` that of the public header <dch/lists/name.hpp>.

usage: fill_examples.py TEMPLATE ROOT PROGRAM; exit status 1 if the program lacks a block of one of these pages or, where it has
any of a header, of any header. Blocks of headers are what is indented in their comments and has a semicolon; formulas have none.
"""
import pathlib
import re
import sys
import textwrap

EXAMPLE = re.compile(r"^( *)EXAMPLE (\S+) (\d+)\n", re.MULTILINE)
BLOCK = re.compile(r"^```cpp\n(.*?)^```", re.MULTILINE | re.DOTALL)
OF_HEADER = re.compile(r"(?:^ *///     .*\n)+", re.MULTILINE)
INCLUDE = re.compile(r"^#include .*\n", re.MULTILINE)


def blocks_of_page(page):
    return BLOCK.findall(page.read_text(encoding="utf-8"))


def blocks_of_header(header):
    found = (re.sub(r"^ *///     ", "", block, flags=re.MULTILINE) for block in OF_HEADER.findall(header.read_text(encoding="utf-8")))
    return [block for block in found if ";" in block]


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    template, root, program = map(pathlib.Path, sys.argv[1:])
    text = template.read_text(encoding="utf-8")
    used = [(name, k) for _, name, k in EXAMPLE.findall(text)]
    found = {name: blocks_of_page(root / "docs" / name) for name, _ in used if name.endswith(".md")}
    if any(name.endswith(".hpp") for name, _ in used):
        found |= {str(header).split("/include/dch/")[1]: blocks_of_header(header) for header in root.glob("*/include/dch/**/*.hpp")}
    blocks = {(name, str(k)): block for name, several in found.items() for k, block in enumerate(several, start=1)}
    if sorted(used) != sorted(blocks):
        sys.exit(f"{template.name} has {sorted(used)}, the pages and headers {sorted(blocks)}")
    includes = [line for block in blocks.values() for line in INCLUDE.findall(block)]
    body = EXAMPLE.sub(lambda example: textwrap.indent(INCLUDE.sub("", blocks[example[2], example[3]]), example[1]), text)
    program.write_text("".join(dict.fromkeys(includes)) + body, encoding="utf-8")


if __name__ == "__main__":
    main()
