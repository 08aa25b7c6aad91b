# SPDX-License-Identifier: GPL-2.0-or-later
"""Where a member of LAMMPS's classes that the adapter relies on has become something else, the compiler names it.

    check_relied_on.py COMPILER SOURCE FLAG ...

SOURCE: lammps_pair_style/src/neighbor/relied_on.cpp. Compiles it with LAMMPS's headers as they are, then with copies of them in
which each of those members is a char and Neighbor cannot be copied.
"""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

HEADERS = {"Neighbor": "neighbor.h", "Atom": "atom.h", "NeighList": "neigh_list.h"}


def relied_on(source):
    """Pairs of class and member."""
    text = source.read_text(encoding="utf-8")
    members = [("Neighbor", member) for member in re.findall(r"^  DCH_OF_NEIGHBOR\((\w+),", text, re.MULTILINE)]
    return members + re.findall(r"^DCH_RELIES_ON\((\w+), \w+, (\w+),", text, re.MULTILINE)


def change(header, name, members):
    text = header.read_text(encoding="utf-8")
    for member in members:
        text = re.sub(rf"\b{member}\b", f"former_{member}", text)
    changed = "".join(f"  char {member};\n" for member in members)
    if name == "Neighbor":
        changed += "  Neighbor(const Neighbor &) = delete;\n"
    text, count = re.subn(rf"(class {name} : protected Pointers \{{\s*public:\n)", rf"\1{changed}", text)
    assert count == 1, header
    header.unlink()
    header.write_text(text, encoding="utf-8")


def compile_source(compiler, source, flags):
    return subprocess.run([compiler, "-std=c++17", "-fsyntax-only", "-w", *flags, source], capture_output=True, text=True, check=False)


def main(compiler, source, *flags):
    members = relied_on(pathlib.Path(source))
    assert len(members) > 40, members
    plain = compile_source(compiler, source, flags)
    if plain.returncode != 0:
        raise SystemExit(f"with LAMMPS's headers as they are:\n{plain.stderr}")
    lammps = next(flag[2:] for flag in flags if flag.startswith("-I") and pathlib.Path(flag[2:], "neighbor.h").exists())
    with tempfile.TemporaryDirectory() as scratch:
        copy = pathlib.Path(scratch, "lammps")
        shutil.copytree(lammps, copy)
        for name, header in HEADERS.items():
            change(copy / header, name, [member for owner, member in members if owner == name])
        output = compile_source(compiler, source, [f"-I{copy}" if flag == f"-I{lammps}" else flag for flag in flags]).stderr
    silent = [f"{owner}::{member}" for owner, member in members if f"LAMMPS's {owner}::{member} is no longer of type" not in output]
    if "no longer copyable" not in output:
        silent.append("the copy of Neighbor")
    if silent:
        raise SystemExit(f"changed, but not named: {silent}\n{output[:4000]}")
    print(f"{len(members)} changed members, all named")


main(*sys.argv[1:])
