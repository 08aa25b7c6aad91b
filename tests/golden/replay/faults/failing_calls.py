# SPDX-License-Identifier: MIT
"""Runs the command with the library that makes calls of the system fail (failing_calls.cpp)."""

import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections import namedtuple

from subcommands import OLD, content

LOG_BYTES = 1 << 20
LINE = re.compile(r"(\d+) (\d+) (\w+) (\S+)( !)?")  # a child that was killed may leave half a line
Call = namedtuple("Call", "process number function name")
Outcome = namedtuple("Outcome", "status stderr calls struck")


class Bench:
    """A folder with the inputs, in which a subcommand is run again and again."""

    def __init__(self, command, library, inputs):
        self.command, self.library, self.inputs = command, library, inputs
        self.folder = tempfile.mkdtemp()
        self.work = os.path.join(self.folder, "work")
        self.log = os.path.join(self.folder, "log")

    def prepare(self, subcommand, with_old):
        """The inputs, and old outputs if they are asked for, and nothing else."""
        shutil.rmtree(self.work, ignore_errors=True)
        shutil.copytree(self.inputs, self.work)
        for name in subcommand.outputs if with_old else ():
            with open(os.path.join(self.work, name), "wb") as file:
                file.write(OLD)

    def run(self, subcommand, fault=None, before=""):
        """`before` is a line of a shell that comes first, in the same process: $$ is the number the command will have."""
        variables = {"DCH_CALLS_FOLDER": self.work, "DCH_CALLS_LOG": self.log}
        if fault is not None:
            variables["DCH_CALLS_FAULT"] = fault
        result = self.execute(subcommand, LOG_BYTES, variables, before)
        calls, struck = [], None
        with open(self.log, "rb") as file:
            lines = file.read()[8:].replace(b"\0", b"").decode().splitlines()
        for line in filter(None, map(LINE.fullmatch, lines)):
            calls.append(Call(int(line[1]), int(line[2]), line[3], line[4]))
            struck = calls[-1] if line[5] else struck
        return Outcome(result.returncode, result.stderr, calls, struck)

    def execute(self, subcommand, log_bytes, variables, before=""):
        """The command beside the library, with an empty log."""
        with open(self.log, "wb") as file:
            file.truncate(log_bytes)
        # The shell itself is not to be disturbed
        settings = ["env", f"LD_PRELOAD={self.library}", *(f"{key}={value}" for key, value in variables.items())]
        arguments = [*settings, self.command, *subcommand.in_folder(self.work)]
        if before:
            arguments = ["sh", "-c", before + '\nexec "$@"', "sh", *arguments]
        try:
            return subprocess.run(arguments, capture_output=True, text=True, timeout=60, cwd=self.folder)
        except subprocess.TimeoutExpired:
            return subprocess.CompletedProcess(arguments, "no end in 60 s", "", "")

    def states(self, subcommand, reference):
        """Each output's state: absent, old, whole or broken; and the names of files that should not be there."""
        found = {}
        for name in subcommand.outputs:
            path = os.path.join(self.work, name)
            if not os.path.exists(path):
                found[name] = "absent"
                continue
            with open(path, "rb") as file:
                is_old = file.read(len(OLD) + 1) == OLD
            found[name] = "old" if is_old else "whole" if is_whole(path, reference[name]) else "broken"
        extra = sorted(set(os.listdir(self.work)) - set(os.listdir(self.inputs)) - set(subcommand.outputs))
        return found, extra

    def reference(self, subcommand):
        """What the outputs hold after a run that nothing disturbs, and its calls."""
        self.prepare(subcommand, False)
        outcome = self.run(subcommand)
        if outcome.status != 0:
            raise SystemExit(f"{subcommand.name}: {outcome.stderr}")
        return {name: content(os.path.join(self.work, name)) for name in subcommand.outputs}, outcome.calls

    def close(self):
        shutil.rmtree(self.folder)


def is_whole(path, reference):
    try:
        return content(path) == reference
    except Exception as error:  # whatever h5py and json find broken
        print(f"{path}: {error}", file=sys.stderr)
        return False
