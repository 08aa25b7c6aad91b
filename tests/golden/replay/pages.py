#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Runs the command lines of docs/cli.md, one after the other in one folder, and reads the topologies of docs/formats.md.

usage: pages.py DCHMD ROOT
"""
import gzip
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

from dch_command import Checks, run, write_chain

# Said on the page, and how much less of it is run here; each is said there.
LESS = [("--spheres 10976", "--spheres 200"), ("--time 20 --every 0.5", "--time 2 --every 0.5"), ("--spheres 20000", "--spheres 2000"),
        ("--collisions 1000000", "--collisions 2000"), ("--spheres 1000 ", "--spheres 100 "), ("--jam 1e6 --growth 0.01", "--jam 1e3 --growth 0.05"),
        ("--continuous", "--continuous --frames :4"), ("--time 20", "--time 1"), ("--chains 320", "--chains 5")]
SUMMARY = re.compile(r"FILE|IN OUT|\.\.\.")  # what stands for other words
LEFT = {"report.html", "view.html", "crossings.html", "query.h5", "query.html", "run.h5", "state.json", "jammed.json", "contacts.h5",
        "contacts.html", "melt.data"}


def blocks(page):
    return [re.sub("^    ", "", block, flags=re.MULTILINE)
            for block in re.findall(r"(?:^    \S.*\n)+", re.sub(r"^```.*?^```", "", page, flags=re.DOTALL | re.MULTILINE), re.MULTILINE)]


def prepare(folder, command, root):
    """What the lines take for granted: a trajectory of a chain and its bonds, others under other names, and a host to reach."""
    os.symlink(root / "tests", folder / "tests")
    write_chain(folder / "run.lammpstrj", folded=True)
    bonds = "".join(f"{k} 1 {k} {k + 1}\n" for k in range(1, 512))
    for name in ("run.data", "melt.data"):
        (folder / name).write_text(f"a chain\n\n512 atoms\n511 bonds\n\nBonds\n\n{bonds}")
    with gzip.open(folder / "run.lammpstrj.gz", "wb") as packed:
        packed.write((folder / "run.lammpstrj").read_bytes())
    shutil.copy(root / "tests" / "data" / "triclinic-namd.dcd", folder / "run.dcd")
    programs = folder / "programs"
    programs.mkdir()
    os.symlink(command, programs / "dchmd")
    (programs / "ssh").write_text('#!/bin/sh\nshift\nexec "$@"\n')
    (programs / "ssh").chmod(0o755)
    return {**os.environ, "PATH": f"{programs}:{os.environ['PATH']}", "LC_ALL": "C.UTF-8"}


def check_lines(checks, command, root, folder):
    environment = prepare(folder, command, root)
    lines = [line for block in blocks((root / "docs" / "cli.md").read_text(encoding="utf-8")) for line in block.splitlines()
             if re.match(r"dchmd \w+ |zcat ", line) and not SUMMARY.search(line)]
    for said, less in LESS:
        checks.that(any(said in line for line in lines), f"cli.md does not say {said!r}")
        lines = [line.replace(said, less) for line in lines]
    for line in lines:
        done = subprocess.run(["bash", "-o", "pipefail", "-c", line], cwd=folder, env=environment, capture_output=True, text=True)
        checks.that(done.returncode == 0 and done.stdout != "", f"{line}: status {done.returncode}: {done.stderr}")
    checks.that(len(lines) >= 14, f"only {len(lines)} lines of cli.md were run")
    checks.that(all((folder / name).stat().st_size > 0 for name in LEFT if (folder / name).exists()), "empty files")
    checks.that(LEFT <= set(os.listdir(folder)), f"lines of cli.md leave no {LEFT - set(os.listdir(folder))}")


def check_topologies(checks, command, root, folder):
    texts = [block for block in blocks((root / "docs" / "formats.md").read_text(encoding="utf-8"))
             if re.match(r"# a molecule|1-100 ", block)]
    checks.that(len(texts) == 2, f"formats.md has {len(texts)} topologies")
    for text, name, excluded in zip(texts, ("few.bonds", "few.chains"), (2, 99 + 4 + 51)):
        (folder / name).write_text(text)
        done = run(command, "replay", root / "tests" / "data" / "polymer.lammpstrj", "--cutoff", 4, "--frames", ":1", "--topology",
                   folder / name, "--exclude", "bonded")
        checks.that(done.returncode == 0 and f"({excluded} bonds from " in done.stdout, f"{name}: {done.stdout}{done.stderr}")


def main():
    command, root = os.path.abspath(sys.argv[1]), pathlib.Path(sys.argv[2]).resolve()
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        check_lines(checks, command, root, pathlib.Path(folder))
        check_topologies(checks, command, root, pathlib.Path(folder))
    checks.finish()


if __name__ == "__main__":
    main()
