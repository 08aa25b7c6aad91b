#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""LAMMPS's references of force styles with DCH lists, and with the suffix, on 1, 2 and 4 processes.

The references (`unittest/force-styles/tests` of LAMMPS's source: energies and forces of pair styles, lattice sums, bonds,
angles, dihedrals, impropers, and motion by fixes) are settings of small systems with the forces that LAMMPS's developers
have written down. Each runs in the installed LAMMPS as it is, with `dch on` and the plain styles, and with `suffix dch`.
Forces before and after four steps have to be those of the same LAMMPS without dch, on as many processes, and on one
process those of the reference where stock LAMMPS has them. What stock LAMMPS refuses is counted, not compared.
Exit status: 0, or 1 if any differ. Needs the source of the LAMMPS that is installed ('apt-get source lammps').
"""

import argparse
import math
import os
import re
import subprocess
import sys
import tempfile
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

MODES = {"stock": "", "lists": "include {load}\ndch styles no\ndch on\n", "suffix": "include {load}\nsuffix dch\n"}
OF_FIXES = """pair_style lj/cut 8.0
pair_coeff 1 1 0.02 2.5
pair_coeff 2 2 0.005 1.0
pair_coeff 2 4 0.005 0.5
pair_coeff 3 3 0.02 3.2
pair_coeff 4 4 0.015 3.1
pair_coeff 5 5 0.015 3.1
group solute molecule 1:2
group solvent molecule 3:5
timestep 0.25
"""
# Of sums in another order; of charges by LAMMPS's tables, which ours compute; of what LAMMPS's developers have written down.
TOLERANCE, BY_TABLES, OF_REFERENCE = 1e-9, 1e-7, 1e-7


def read_reference(path):
    """Settings by name; of more than one line where they go on below, with a larger indent."""
    found, name = {}, None
    for line in path.read_text().splitlines():
        if match := re.fullmatch(r"(\w+): *(?:! *)?(.*)", line):
            name, value = match.groups()
            found[name] = "" if re.fullmatch(r'\|.*|""|', value) else value.strip('"')
        elif name and line != "...":
            found[name] += line.strip() + "\n"
    return found


def script_of(path, folder):
    """What sets the system up, up to the first forces, and the commands for four steps more."""
    reference = read_reference(path)
    kind = path.name.split("-")[0]
    lines = ["variable newton_pair index on", "variable newton_bond index on", f"variable input_dir index {folder}",
             reference.get("pre_commands", ""), f"include {folder}/{reference['input_file']}"]
    if kind == "fix":
        lines.append(OF_FIXES)
    for style in ("pair", "bond", "angle", "dihedral", "improper"):
        if f"{style}_style" in reference:
            lines.append(f"{style}_style {reference[style + '_style']}")
            lines += [f"{style}_coeff {words}" for words in reference.get(f"{style}_coeff", "").splitlines()]
    if "pair_style" in reference:
        lines.append("pair_modify table 0\npair_modify table/disp 0")
    lines.append(reference.get("post_commands", ""))
    text = "\n".join(lines)
    names = set(re.findall(r"^\s*variable\s+(\w+)", text + "\n" + (folder / reference["input_file"]).read_text(), re.MULTILINE))
    begin = "".join(f"variable {name} delete\n" for name in sorted(names))
    motion = "" if kind == "fix" else "fix 1 all nve\n"
    return begin + text, motion, reference


def rows_of(dump):
    rows = [line.split() for line in dump.read_text().split("ITEM: ATOMS")[-1].splitlines()[1:]]
    return {int(row[0]): tuple(map(float, row[1:])) for row in rows}


def difference(first, second, columns):
    """Largest one of these columns, over the largest of their numbers."""
    if first.keys() != second.keys():
        return math.inf
    largest = max((abs(row[k]) for row in first.values() for k in columns), default=0) or 1.0
    worst = 0.0
    for atom, row in first.items():
        for k in columns:
            a, b = row[k], second[atom][k]
            if a != b and not (a != a and b != b):
                off = abs(a - b) / largest
                worst = max(worst, off if off == off else math.inf)
    return worst


def commands(arguments, path, mode, work):
    """Of a system in one mode: forces before and after four steps go into files of the folder."""
    text, motion, _ = script_of(path, arguments.tests)
    columns = "id x y z vx vy vz fx fy fz modify sort id format float %.17g"
    return f'clear\nprint "=== {mode}"\n' + MODES[mode].format(load=arguments.load) + text + (
        f"\nrun 0 post no\nwrite_dump all custom {work}/{mode}.first {columns}\n{motion}thermo 2\nrun 4 post no\n"
        f"write_dump all custom {work}/{mode}.last {columns}\n" + ("dch explain\n" if mode != "stock" else "suffix off\n"))


def run(arguments, path, modes, ranks):
    """By mode forces before and after four steps by atom, and what was printed; no forces of a run that has ended early."""
    with tempfile.TemporaryDirectory(prefix="dch-reference-") as work:
        work = Path(work)
        (work / "in.reference").write_text("".join(commands(arguments, path, mode, work) for mode in modes))
        words = ["lmp", "-log", "none", "-nocite", "-in", "in.reference"]
        if ranks > 1:
            words = ["mpirun", "--allow-run-as-root", "--oversubscribe", "--bind-to", "none", "-np", str(ranks)] + words
        environment = dict(os.environ, OMP_NUM_THREADS="1", LAMMPS_POTENTIALS=str(arguments.potentials), PYTHONPATH=str(arguments.tests),
                           OMPI_MCA_orte_tmpdir_base=str(work), OMPI_MCA_mpi_yield_when_idle="1")
        try:
            done = subprocess.run(words, cwd=work, env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                  stderr=subprocess.STDOUT, text=True, errors="replace", check=False, timeout=arguments.timeout)
            said = done.stdout
        except subprocess.TimeoutExpired:
            said = f"=== {modes[-1]}\nno end within {arguments.timeout} s"
        found = {}
        for mode in modes:
            dumps = [work / f"{mode}.{when}" for when in ("first", "last")]
            part = re.search(rf"^=== {mode}\n(.*?)(?=^=== |\Z)", said, re.MULTILINE | re.DOTALL)
            found[mode] = (tuple(map(rows_of, dumps)) if dumps[1].exists() else None, part[1] if part else said[-300:])
        return found


def reference_forces(path):
    """Before and after four steps, where the reference has them."""
    found = read_reference(path)
    if "init_forces" not in found:
        return None
    blocks = []
    for name in ("init_forces", "run_forces"):
        rows = [line.split() for line in found[name].splitlines() if line]
        blocks.append({int(row[0]): tuple(map(float, row[1:4])) for row in rows})
    return blocks


def compare(arguments, path, ranks):
    """Counts, and what is wrong, of one reference on so many processes."""
    counts, wrong = Counter(), []
    found = run(arguments, path, list(MODES), ranks)
    stock = found["stock"][0]
    if stock is None:
        return Counter(refused=1), []
    for mode in ("lists", "suffix"):
        ours, said = found[mode]
        if ours is None:  # maybe as the one before has ended LAMMPS
            ours, said = run(arguments, path, [mode], ranks)[mode]
        label = f"{path.stem}, {ranks} processes, {mode}"
        if ours is None:
            error = re.search(r"^ERROR.*", said, re.MULTILINE)
            wrong.append(f"{label}: {error[0] if error else said[-300:]}")
            continue
        counts[mode] += 1
        is_ours = re.search(r"^ *(pair|bond|angle) \S+/dch: (?!plain)", said, re.MULTILINE)
        counts["ours" if is_ours else "plain"] += mode == "suffix"
        off = max(difference(a, b, columns) for a, b in zip(stock, ours) for columns in ((0, 1, 2), (3, 4, 5), (6, 7, 8)))
        if not off <= (BY_TABLES if re.search(r"table 1\d", path.read_text()) else TOLERANCE):
            wrong.append(f"{label}: differs from stock LAMMPS by {off:.2g}")
        expected = reference_forces(path) if ranks == 1 else None
        if expected is None:
            continue
        forces = [{atom: row[6:] for atom, row in rows.items()} for rows in ours]
        plain = [{atom: row[6:] for atom, row in rows.items()} for rows in stock]
        if max(difference(a, b, (0, 1, 2)) for a, b in zip(expected, plain)) <= OF_REFERENCE:
            counts[f"{mode}, as written down"] += 1
            off = max(difference(a, b, (0, 1, 2)) for a, b in zip(expected, forces))
            if not off <= OF_REFERENCE:
                wrong.append(f"{label}: differs from the reference by {off:.2g}")
    return counts, wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("source", type=Path, help="folder of LAMMPS's source")
    parser.add_argument("--build", type=Path, default=Path("build/release"), help="folder of the build (default: %(default)s)")
    parser.add_argument("--potentials", type=Path, default=Path("/usr/share/lammps/potentials"))
    parser.add_argument("--processes", type=int, nargs="+", default=(1, 2, 4))
    parser.add_argument("--only", default="", help="a pattern that names of references have to match")
    parser.add_argument("--timeout", type=int, default=120, help="seconds of a run (default: %(default)s)")
    arguments = parser.parse_args()
    arguments.tests = (arguments.source / "unittest" / "force-styles" / "tests").resolve()
    arguments.load = (arguments.build / "lammps_pair_style" / "dch.lmp").resolve()
    for needed in (arguments.tests, arguments.load, arguments.potentials):
        if not needed.exists():
            sys.exit(f"compare.py: {needed} does not exist; give the folder of LAMMPS's source, and build the LAMMPS adapter")
    paths = [path for path in sorted(arguments.tests.glob("*.yaml")) if re.search(arguments.only, path.name)]
    if not paths:
        sys.exit(f"compare.py: no reference in {arguments.tests} has a name that matches '{arguments.only}'")
    all_wrong = []
    for ranks in arguments.processes:
        counts = Counter()
        with ThreadPoolExecutor(os.cpu_count()) as pool:
            for found, wrong in pool.map(lambda path: compare(arguments, path, ranks), paths):
                counts += found
                for line in wrong:
                    print(line, flush=True)
                all_wrong += wrong
        if counts["lists"] + counts["suffix"] == 0:
            all_wrong.append(f"{ranks} processes: nothing was compared")
            print(all_wrong[-1])
        print(f"{ranks} processes: {len(paths)} references, {counts['refused']} that stock LAMMPS refuses; {counts['lists']} with "
              f"lists, {counts['suffix']} with the suffix, {counts['ours']} of them on styles of ours; as written down "
              f"{counts['lists, as written down']} and {counts['suffix, as written down']}", flush=True)
    print(f"{len(all_wrong)} wrong")
    sys.exit(1 if all_wrong else 0)


if __name__ == "__main__":
    main()
