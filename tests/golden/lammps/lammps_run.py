# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs LAMMPS executables for the golden tests and reads what they print."""

import os
import re
import subprocess
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
SCRIPTS = HERE / "scripts"


class Host:
    """The LAMMPS installation and the build under test, from the command line of a test."""

    @staticmethod
    def add_arguments(parser):
        parser.add_argument("--lmp", required=True, help="stock LAMMPS executable")
        parser.add_argument("--mpirun", required=True)
        parser.add_argument("--build", required=True, type=Path, help="folder with dch.lmp and lmp-dch")
        parser.add_argument("--tools", required=True, type=Path, help="folder with this folder's executables")
        parser.add_argument("--examples", required=True, type=Path, help="LAMMPS's examples")
        parser.add_argument("--potentials", required=True, type=Path, help="LAMMPS's potential files")
        parser.add_argument("--melt", required=True, type=Path, help="data file made by make_melt_data")
        parser.add_argument("--work", required=True, type=Path, help="folder to write to")

    def __init__(self, arguments):
        self.lmp = arguments.lmp
        self.mpirun = arguments.mpirun
        self.loader = arguments.build / "dch.lmp"
        self.lmp_dch = arguments.build / "lmp-dch"
        self.tools = arguments.tools
        self.work = arguments.work
        for needed in (arguments.examples, arguments.potentials, self.loader, self.lmp_dch, arguments.melt):
            if not needed.exists():
                raise SystemExit(f"{needed} does not exist; install lammps-examples and build the LAMMPS adapter")
        self.work.mkdir(parents=True, exist_ok=True)
        self.variables = {"here": SCRIPTS, "examples": arguments.examples, "data": arguments.melt}
        self.environment = dict(os.environ, LAMMPS_POTENTIALS=str(arguments.potentials), OMP_NUM_THREADS="1")

        told = subprocess.run([self.lmp, "-h"], stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False).stdout
        self.year = int(re.search(r"Simulator - \d+ \w+ (\d{4})", told)[1])
        self.has_long_ids = re.search(r"sizeof\(tagint\): +64-bit", told) is not None

    def in_words_of_version(self, text):
        """A script in which INPUTS_LOCAL and UNTRIMMED stand for what later versions want: that `compute reduce` is told of
        values of pairs, and that lists of `pair_style hybrid` keep the cutoffs of types."""
        is_later = self.year > 2022
        return text.replace("INPUTS_LOCAL", "inputs local" if is_later else "").replace(
            "UNTRIMMED", "pair_modify neigh/trim no" if is_later else "")

    def run(self, ranks, command, variables=(), log="none", timeout=280):
        """Runs command (a list) on `ranks` processes with LAMMPS variables; returns exit code and all output.

        A run that has not ended after `timeout` seconds is ended, and its output says so.
        """
        words = [str(word) for word in command]
        if ranks > 1:
            words = [self.mpirun, "--allow-run-as-root", "--oversubscribe", "-np", str(ranks)] + words
        words += ["-log", log]
        for name, value in {**self.variables, **dict(variables)}.items():
            words += ["-var", name, str(value)]
        # Processes that run alone share one folder of Open MPI's, which each of them removes at its end.
        with tempfile.TemporaryDirectory(prefix="dch-mpi-") as sessions:
            environment = {**self.environment, "OMPI_MCA_orte_tmpdir_base": sessions}
            run = subprocess.Popen(words, cwd=self.work, env=environment, stdout=subprocess.PIPE,
                                   stderr=subprocess.STDOUT, text=True)
            try:
                output = run.communicate(timeout=timeout)[0]
                return run.returncode, output
            except subprocess.TimeoutExpired:
                run.terminate()  # mpirun then ends its processes
                return 1, run.communicate()[0] + f"\nERROR: no end within {timeout} s\n"

    def run_text(self, text, ranks=1, executable=None, variables=()):
        """Runs the lines as a script, by default in stock LAMMPS with the loader's path in `load`.

        executable: another one, or a list of it and its first arguments.
        """
        script = self.work / "in.text"
        script.write_text(self.in_words_of_version(text))
        words = executable if isinstance(executable, list) else [executable or self.lmp]
        return self.run(ranks, words + ["-in", script], {"load": self.loader, **dict(variables)})


def thermo_tables(output):
    """Every thermo table of the output: a list of {column: value} for each of its lines."""
    tables = []
    columns = None
    for line in output.splitlines():
        words = line.split()
        if words and words[0] == "Step":
            columns = words
            tables.append([])
        elif columns and len(words) == len(columns) and is_number(words[0]):
            tables[-1].append(dict(zip(columns, map(float, words))))
        elif line.startswith("Loop time"):
            columns = None
    return tables


def is_number(word):
    try:
        float(word)
    except ValueError:
        return False
    return True


def largest_relative_difference(first, second):
    """Over the columns of two thermo lines; differences relative to the larger magnitude."""
    assert first.keys() == second.keys(), (first, second)
    worst = 0.0
    for column, a in first.items():
        b = second[column]
        scale = max(abs(a), abs(b))
        if scale > 0:
            worst = max(worst, abs(a - b) / scale)
    return worst
