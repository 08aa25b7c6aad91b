# SPDX-License-Identifier: MIT
"""Allocations of each subcommand and of its child processes fail in turn: one of them, or it and all that follow.

    allocation_sweep.py DCH LIBRARY FOLDER_OF_TRAJECTORIES [EVERY]

Afterwards an error is a documented status with a message, an output is whole or as it was before, and nothing else is
left. All allocations are counted, in the order in which they come; the first ones of each process fail, and then every
m-th, so that each process has about MOST of them; with EVERY, so many times fewer.
"""

import collections
import os
import struct
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from dch_command import Checks  # noqa: E402
from failing_calls import Bench, Outcome  # noqa: E402
from subcommands import SUBCOMMANDS, write_inputs  # noqa: E402

PROCESSES = 16  # as the library has it
FIRST, MOST = 20, 100
LEAST_FAULTS = 500


class MemoryBench(Bench):
    def run(self, subcommand, fault=None, before=""):
        """`calls` are the numbers of allocations of each process, and `struck` those of refusals."""
        variables = {"DCH_MEMORY_LOG": self.log}
        if fault is not None:
            variables["DCH_MEMORY_FAULT"] = fault
        result = self.execute(subcommand, 16 * PROCESSES, variables, before)
        with open(self.log, "rb") as file:
            tallies = list(struct.iter_unpack("qq", file.read()))
        return Outcome(result.returncode, result.stderr, [made for made, _ in tallies], [refused for _, refused in tallies])


def selection(count, every):
    """Deterministic: the first ones, and a few of all others."""
    first = FIRST // every
    step = max(1, every * -(-(count - first) // (MOST - FIRST)))
    return [*range(min(first, count)), *range(first, count, step)]


def check_run(checks, bench, subcommand, reference, plan):
    """Whether an allocation was refused."""
    process, number, how, with_old = plan
    bench.prepare(subcommand, with_old)
    outcome = bench.run(subcommand, f"{process} {number} {how}")
    if not any(outcome.struck):
        return False
    what = f"{subcommand.name}: process {process}, allocation {number}, {how}"
    states, extra = bench.states(subcommand, reference)
    checks.that(extra == [], f"{what}: left {extra}")
    before = "old" if with_old else "absent"
    if outcome.status == 0:  # it did without
        checks.that(set(states.values()) <= {"whole"} and outcome.stderr == "", f"{what}: {states}, {outcome.stderr!r}")
    else:
        checks.that(outcome.status in (2, 3), f"{what}: status {outcome.status}: {outcome.stderr!r}")
        is_told = outcome.stderr.startswith("dchmd: ") and outcome.stderr.endswith("\n") and len(outcome.stderr) > 30
        checks.that(is_told, f"{what}: the message is {outcome.stderr!r}")
        checks.that(outcome.status != 2 or "not enough memory" in outcome.stderr, f"{what}: the message is {outcome.stderr!r}")
        checks.that(set(states.values()) <= {before, "whole"}, f"{what}: {states}")
    return True


def sweep(checks, command, library, inputs, subcommand, every):
    """Number of runs in which an allocation was refused."""
    bench = MemoryBench(command, library, inputs)
    reference, counts = bench.reference(subcommand)
    done = collections.Counter()
    for process, count in enumerate(counts):
        for position, number in enumerate(selection(count, every)):
            how = ("once", "always")[position % 2]
            done[how] += check_run(checks, bench, subcommand, reference, (process, number, how, position % 4 < 2))
    bench.close()
    print(f"{subcommand.name}: {[count for count in counts if count]} allocations, {dict(done)}", flush=True)
    return done.total()


def main(command, library, data, every="1"):
    checks = Checks()
    with tempfile.TemporaryDirectory() as inputs, ThreadPoolExecutor(max_workers=os.cpu_count()) as pool:
        write_inputs(command, data, inputs)
        tasks = [pool.submit(sweep, checks, command, library, inputs, subcommand, int(every)) for subcommand in SUBCOMMANDS]
        done = sum(task.result() for task in tasks)
    print(f"{done} faults")
    least = LEAST_FAULTS // int(every)
    checks.that(done >= least, f"{done} faults, fewer than {least}")
    checks.finish()


if __name__ == "__main__":
    main(*sys.argv[1:])
