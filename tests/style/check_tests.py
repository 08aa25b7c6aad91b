#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks that each test that docs/reliability.md names is one.

usage: check_tests.py ROOT; exit status 1 if a name is that of no test.
"""

import fnmatch
import pathlib
import re
import sys

CASE = re.compile(r"^TEST(?:_[FP])?\(\s*(\w+),\s*(\w+)\)", re.MULTILINE)
INSTANCE = re.compile(r"INSTANTIATE_TEST_SUITE_P\(\s*(\w+),\s*(\w+)")
REGISTERED = re.compile(r"(\bNAME|\bdch_add_\w+\()\s*(?:\$\{DCH_TEST_PREFIX\})?([\w.]+)")
PREFIXES = {"dch_add_lammps_test(": "golden.lammps.", "dch_add_openmm_script(": "golden.openmm."}
IN_LOOPS = ["fuzz.*", "valgrind.fuzz_*", "golden_replay.*_sweep"]  # of CMake
QUOTED = re.compile(r"`([^`\s]+)`")
SCRIPTS = ("golden.", "golden_replay.", "mutation.", "fuzz.", "valgrind.")


def tests_of(root):
    """Suite.Name of those in C++, with the instance before it too; what CMake registers by name."""
    cases, instances, registered = set(), {}, set()
    for path in (root / "tests").rglob("*.cpp"):
        text = path.read_text(encoding="utf-8")
        cases |= {f"{suite}.{name}" for suite, name in CASE.findall(text)}
        for instance, suite in INSTANCE.findall(text):
            instances.setdefault(suite, []).append(instance)
    for path in (root / "tests").rglob("CMakeLists.txt"):
        registered |= {PREFIXES.get(how, "") + name for how, name in REGISTERED.findall(path.read_text(encoding="utf-8"))}
    for case in list(cases):
        cases |= {f"{instance}/{case}" for instance in instances.get(case.split(".")[0], [])}
    return cases, registered


def unknown(names, cases, registered):
    suite = ""
    for name in names:
        if name.startswith(SCRIPTS):
            if name not in registered and not any(fnmatch.fnmatch(name, pattern) for pattern in IN_LOOPS):
                yield name
        elif re.fullmatch(r"\.\w+|(\w+/)?[A-Z]\w*\.[\w*]+(/\w+)?", name):
            full = suite + name if name.startswith(".") else name
            suite = full.split(".")[0]
            if not fnmatch.filter(cases, re.sub(r"(\.[\w*]+)/\w+$", r"\1", full)):
                yield full


def main():
    if len(sys.argv) != 2:
        print(__doc__.splitlines()[2], file=sys.stderr)
        return 2
    root = pathlib.Path(sys.argv[1])
    cases, registered = tests_of(root)
    names = QUOTED.findall((root / "docs" / "reliability.md").read_text(encoding="utf-8"))
    missing = list(unknown(names, cases, registered))
    for name in missing:
        print(f"docs/reliability.md: no test is called {name}", file=sys.stderr)
    print(f"{len(names)} names, {len(missing)} of no test")
    return 1 if missing or not cases else 0


if __name__ == "__main__":
    sys.exit(main())
