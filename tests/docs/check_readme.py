#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Checks what a reader sees of README.md first, and that pictures of the pages are as the scripts beside them draw them.

usage: check_readme.py ROOT; exit status 1 unless lines to install, few lines of Python, one picture and one table of times stand
before the first section, where lines to install are from docs/install.md and times from docs/results.md.
"""
import pathlib
import re
import subprocess
import sys
import tempfile

SCENES = {"melt of 32,000 atoms": "melt32k", "water, 30,903 atoms": "water30k", "clumps of atoms": "clusters", "thin hot gas": "hotgas"}


def blocks(text, language):
    return re.findall(rf"^```{language}\n(.*?)^```", text, re.MULTILINE | re.DOTALL)


def cells(line):
    return tuple(cell.strip() for cell in line.strip().strip("|").split("|"))


def measured(results, processor):
    """Pairs of rows that stand side by side for a processor: (scene, other program) -> (its time, ours, ratio)."""
    section = results.split(f"\n### {processor}\n")[1].split("\n### ")[0]
    rows = [cells(line) for line in section.splitlines() if line.startswith("| ")]
    return {(row[0], row[8]): (other[3], row[3], row[6]) for other, row in zip(rows, rows[1:])
            if len(row) == 9 and row[1].startswith("dch beside ") and other[:2] == (row[0], row[8]) and row[2] == "ns/particle"}


def faults_of_the_first_screen(first, install, results):
    commands = [line.split("#")[0].strip() for block in blocks(first, "sh") for line in block.splitlines()]
    run = [line.strip() for block in blocks(install, "sh") for line in block.splitlines()]
    if not commands:
        yield "no line to install"
    yield from (f"docs/install.md has no line {command!r}" for command in commands if command not in run)
    programs = blocks(first, "python")
    if [sum(line.strip() != "" for line in program.splitlines()) for program in programs] != [5]:
        yield "not five lines of Python"
    if len(re.findall(r"^!\[", first, re.MULTILINE)) != 1:
        yield "not one picture"
    rows = [cells(line) for line in first.splitlines() if line.startswith("| ")][1:]
    if len(rows) < 3:
        yield "no table of times"
    if "AMD EPYC with AVX2" not in first or "nanoseconds an atom" not in first:
        yield "the table names no processor or unit"
    times = measured(results, "AMD EPYC, Zen 3 (avx2)")
    for scene, program, *figures in rows:
        if times.get((SCENES[scene], program)) != tuple(figures):
            yield f"docs/results.md has {times.get((SCENES[scene], program))} of {scene}, {program}, not {figures}"


def stale_pictures(images):
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.executable, "-B", images / "draw_theory.py", folder], check=True)
        for drawn in sorted(pathlib.Path(folder).iterdir()):
            if (images / drawn.name).read_bytes() != drawn.read_bytes():
                yield f"docs/images/{drawn.name} is not as draw_theory.py draws it"


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    root = pathlib.Path(sys.argv[1])
    first = (root / "README.md").read_text(encoding="utf-8").split("\n## ")[0]
    install = (root / "docs" / "install.md").read_text(encoding="utf-8")
    results = (root / "docs" / "results.md").read_text(encoding="utf-8")
    faults = [*faults_of_the_first_screen(first, install, results), *stale_pictures(root / "docs" / "images")]
    print(f"{len(faults)} faults", *faults, sep="\n  ")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
