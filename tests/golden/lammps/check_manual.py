#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""The examples of docs/lammps, and the include lines of docs/install.md: each block of a page in order, commands as scripts over
chains of two types with bonds and angles, or over grains, command lines as they are but for fewer steps."""

import re
import shlex
import shutil
import unittest
from pathlib import Path

from lammps_run import thermo_tables
from script_tests import host, main

DOCS = Path(__file__).resolve().parents[3] / "docs"
EXAMPLES = DOCS.parent / "examples" / "lammps"
# Pages of another kind: what builds the adapter is run by compat.packages and compat.in_tree, the others have tests of their own.
OTHERS = {"design.md", "explain.md", "install.md", "measured.md", "examples.md", "new_style.md", "python.md", "scaling.md"}
PROGRAMS = ("lmp", "lmp-dch", "mpirun")

CHAINS = """
units lj
atom_style angle
special_bonds fene
read_data chains.data
group polymer type 1
variable t equal 1.0
pair_style lj/cut 1.12
pair_coeff * * 1.0 1.0
bond_style fene
bond_coeff 1 30.0 1.5 1.0 1.0
angle_style harmonic
angle_coeff 1 1.0 180
neigh_modify delay 0 every 1 check yes
fix move all nve
"""
ALLOY = """
units metal
lattice fcc 3.6
region box block 0 4 0 4 0 4
create_box 2 box
create_atoms 1 box
set type 1 type/ratio 2 0.5 4711
mass * 60.0
velocity all create 300 87287
fix move all nve
"""
GRAINS = """
units lj
atom_style sphere
lattice sc 1.0
region box block 0 6 0 6 0 6
create_box 1 box
create_atoms 1 box
set group all diameter 1.0
velocity all create 1.0 4711
neigh_modify delay 0 every 1 check yes
fix move all nve/sphere
"""
RUN = "thermo 1\nrun 4\n"
SYSTEMS = {"pair_style gran/": GRAINS, "pair_style eam": ALLOY}  # others are chains


def system_for(block):
    return next((system for style, system in SYSTEMS.items() if style in block), CHAINS)


def write_chains(path, types=2, has_angles=True, chains=36, beads=12):
    """Straight ones side by side, of one type after the other."""
    atoms, bonds, angles = [], [], []
    for chain in range(chains):
        for bead in range(beads):
            number = chain * beads + bead + 1
            atoms.append(f"{number} {chain + 1} {chain % types + 1} {0.97 * bead} {1.1 * (chain % 6)} {1.1 * (chain // 6)}")
            if bead > 0:
                bonds.append(f"{len(bonds) + 1} 1 {number - 1} {number}")
            if bead > 1 and has_angles:
                angles.append(f"{len(angles) + 1} 1 {number - 2} {number - 1} {number}")
    sections = {"Masses": [f"{k + 1} 1" for k in range(types)], "Atoms": atoms, "Bonds": bonds, "Angles": angles}
    path.write_text(f"chains\n\n{len(atoms)} atoms\n{len(bonds)} bonds\n{len(angles)} angles\n{types} atom types\n1 bond types\n"
                    f"{int(has_angles)} angle types\n0 {0.97 * beads + 0.5} xlo xhi\n0 6.6 ylo yhi\n0 6.6 zlo zhi\n"
                    + "".join(f"\n{name}\n\n" + "\n".join(lines) + "\n" for name, lines in sections.items() if lines))


def examples(page):
    """The indented blocks of a page but for those that say a syntax."""
    text = re.sub(r"^```.*?^```", "", page.read_text(encoding="utf-8"), flags=re.DOTALL | re.MULTILINE)
    text = re.sub(r"^## Syntax\n.*?(?=^## )", "", text, flags=re.DOTALL | re.MULTILINE)
    return [re.sub("^    ", "", block, flags=re.MULTILINE) for block in re.findall(r"(?:^    \S.*\n)+", text, re.MULTILINE)]


class Manual(unittest.TestCase):
    def test_new_style(self):
        """What the page shows of a style stands in its sources."""
        sources = "".join(path.read_text(encoding="utf-8") for folder in ("forces/src/simd", "lammps_pair_style/src/styles")
                          for path in sorted((DOCS.parent / folder).rglob("*.h*")))
        sources += (DOCS.parent / "tests/golden/lammps/CMakeLists.txt").read_text(encoding="utf-8")
        shown = examples(DOCS / "lammps" / "new_style.md")
        self.assertGreater(len(shown), 3)
        for block in shown:
            self.assertIn(re.sub(r"\s+", " ", block).strip(), re.sub(r"\s+", " ", sources))

    def check(self, code, output, what):
        self.assertEqual(code, 0, f"{what}\n{output}")
        self.assertGreater(len(thermo_tables(output)[-1]), 1, f"{what}\n{output}")

    def run_commands(self, block, plain):
        """In a stock LAMMPS if it is included there, as a plugin if that is loaded, else in the launcher."""
        program = [host.lmp if "\ninclude " in "\n" + block else host.lmp_dch]
        if block.startswith("plugin load"):
            program, block = [host.tools / "plugin_host", host.loader.parent / "libdch_lammps.so"], block.partition("\n")[2]
        block = re.sub(r"^include \S+", "include ${load}", block, flags=re.MULTILINE)
        write_chains(host.work / "chains.data")
        self.check(*host.run_text(system_for(block) + block + RUN, executable=program), plain)

    def write_scripts(self):
        """Those that command lines name, with the systems that they read."""
        for name in ("in.melt", "in.crossing"):
            (host.work / name).write_text(f"include {host.loader}\n" + (EXAMPLES / name).read_text())
        for name in ("in.chain", "in.colloid", "in.granular"):
            shutil.copy(EXAMPLES / name, host.work)
        peptide = host.variables["examples"] / "peptide"
        shutil.copy(peptide / "data.peptide", host.work)
        script, shortened = re.subn(r"^run\s+300$", "run 4", (peptide / "in.peptide").read_text(), flags=re.MULTILINE)
        self.assertEqual(shortened, 1)
        (host.work / "in.peptide").write_text(script.replace("multi\n", "one\n"))  # a table for thermo_tables
        for name in ("data.chain", "chain.data"):
            write_chains(host.work / name, types=1, has_angles=False)

    def run_line(self, line):
        words = shlex.split(line, comments=True)
        while words[0] == "mpirun":
            ranks, words = words[2], words[3:]
            words = [host.mpirun, "--allow-run-as-root", "--oversubscribe", "-np", ranks, *words]
        programs = {"lmp": host.lmp, "lmp-dch": host.lmp_dch, "/usr/local/share/dch/lammps/dch.lmp": host.loader}
        words = [str(programs.get(word, word)) for word in words]
        if "steps" in words:
            words[words.index("steps") + 1] = "4"
        more = [] if "in.crossing" in words else ["-var", "steps", "4"]
        if "in.melt" in words:
            more += ["-var", "cells", "6"]
        self.write_scripts()
        self.check(*host.run(1, [*words, *more]), line)


def add_page(page, blocks):
    def test(self):
        for block in blocks:
            if block.split()[0] in PROGRAMS:
                for line in block.splitlines():
                    self.run_line(line)
            else:
                self.run_commands(block, f"{page.name}:\n{block}")
    setattr(Manual, f"test_{page.stem}", test)


PAGES = {page: examples(page) for page in sorted((DOCS / "lammps").glob("*.md")) if page.name not in OTHERS}
PAGES[DOCS / "install.md"] = [block for block in examples(DOCS / "install.md") if block.startswith("include ")]
for path, found in PAGES.items():
    assert found, f"{path} has no example"
    add_page(path, found)

if __name__ == "__main__":
    main(__doc__)
