#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Builds libdch_core.a, libdch_forces.a and libdch_necklace.a in this folder by CMake. The traditional make calls this: make lib-dch args="for CMake"."""

import os
import shutil
import subprocess
import sys

FOLDER = os.path.dirname(os.path.abspath(__file__))
BUILD = os.path.join(FOLDER, "build")


def main():
    subprocess.check_call(["cmake", "-S", FOLDER, "-B", BUILD, "-DCMAKE_BUILD_TYPE=Release", *sys.argv[1:]])
    subprocess.check_call(["cmake", "--build", BUILD, "--parallel", str(os.cpu_count() or 1)])
    for name in ("core", "forces", "necklace"):
        shutil.copy(os.path.join(BUILD, name, f"libdch_{name}.a"), FOLDER)


if __name__ == "__main__":
    main()
