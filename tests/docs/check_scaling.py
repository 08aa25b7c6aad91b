# SPDX-License-Identifier: MIT
"""The tables of docs/lammps/scaling.md are those that benchmarks/lammps/scaling makes of what was measured.

    check_scaling.py PROJECT
"""
import pathlib
import subprocess
import sys
import tempfile

project = pathlib.Path(sys.argv[1])
page = project / "docs" / "lammps" / "scaling.md"
with tempfile.TemporaryDirectory() as scratch:
    copy = pathlib.Path(scratch, "scaling.md")
    copy.write_text(page.read_text(encoding="utf-8").replace("| 2 |", "| 3 |"), encoding="utf-8")
    subprocess.run([sys.executable, project / "benchmarks" / "lammps" / "scaling", "--from", page.with_suffix(".json"), "--page", copy],
                   check=True)
    if copy.read_text(encoding="utf-8") != page.read_text(encoding="utf-8"):
        sys.exit(f"the tables of {page} are not those that its script makes of {page.with_suffix('.json')}")
print("the same tables")
