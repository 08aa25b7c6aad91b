#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks that no test program prints the bytes of a parameter where it has no words for it.

usage: check_parameters.py PROGRAM...; exit status 1 if one does.
"""

import subprocess
import sys


def bytes_shown(program):
    """The lines of its list of tests that show bytes."""
    listed = subprocess.run([program, "--gtest_list_tests"], capture_output=True, check=True)
    return [line for line in listed.stdout.decode("utf-8", "replace").splitlines() if "-byte object <" in line]


def main():
    programs = sys.argv[1:]
    if not programs:
        print(__doc__.splitlines()[2], file=sys.stderr)
        return 2
    found = {program: lines for program in programs if (lines := bytes_shown(program))}
    for program, lines in found.items():
        print(f"{program}: {len(lines)} parameters are bytes, as{lines[0][:100]}", file=sys.stderr)
    print(f"{len(programs)} programs, {len(found)} of them show bytes")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
