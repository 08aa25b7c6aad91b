#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The example globule.py: the chain collapses, and touches itself more and more.

usage: test_globule.py EXAMPLE
"""

import subprocess
import sys


def main():
    command = [sys.executable, sys.argv[1], "--beads", "60", "--steps", "20000", "--rows", "4"]
    output = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    print(output)
    rows = [[float(word) for word in line.split()] for line in output.splitlines()[2:]]
    assert len(rows) == 5, rows
    first, last = rows[0], rows[-1]
    assert last[0] == 200, last
    assert first[2] == 0 and first[3] == 0, "the helix touches itself"
    assert last[1] < 0.5 * first[1], "the radius of gyration has not halved"
    assert last[2] > 60, "a globule has more contacts than beads"
    assert 0 < last[3] < 0.25, "beads touch, and do not run through each other"


if __name__ == "__main__":
    main()
