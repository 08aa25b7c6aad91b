# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs many scripts in few processes of LAMMPS, for golden tests of many short runs."""

import re
import sys


class Runner:
    """Many runs in one process; where one ends it, the rest go on in another."""

    def __init__(self, host, runs_a_process=100):
        self.host = host
        self.runs_a_process = runs_a_process
        self.processes = 0

    def run(self, runs, ranks, load):
        """runs: {key: script}. Returns {key: output}, and {key: output} of those that ended with an error."""
        done, failed = {}, {}
        left = list(runs.items())
        while left:
            batch = left[:self.runs_a_process]
            text = "".join(f'clear\nprint "=== {k}"\n{script}' for k, (_, script) in enumerate(batch))
            code, output = self.host.run_text(load + text + 'clear\nprint "=== end"\n', ranks=ranks)
            self.processes += 1
            parts = re.split(r"^=== .*\n", output, flags=re.MULTILINE)[1:]
            if not parts:
                sys.exit(f"FAILED: no run began\n{output}")
            keys = [key for key, _ in batch[:len(parts)]]
            ended = parts[:-1] if code != 0 else parts
            done.update(zip(keys, ended))
            if code != 0:
                failed[keys[-1]] = parts[-1]
            left = left[len(keys):]
        return done, failed


def error_in(output):
    error = re.search(r"^ERROR.*", output, re.MULTILINE)
    return error[0] if error else output[-600:]
