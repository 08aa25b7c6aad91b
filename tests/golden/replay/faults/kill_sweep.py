# SPDX-License-Identifier: MIT
"""kill -9 at each call that changes a file, half of the bytes of that call written.

    kill_sweep.py DCH LIBRARY FOLDER_OF_TRAJECTORIES [EVERY]

With EVERY only at the first call of each kind and at every so manieth of the others.
Afterwards each output is whole or as it was before, and the next run succeeds, though it has the number of the process
that was killed and finds its unfinished file.
"""

import os
import re
import signal
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from dch_command import Checks  # noqa: E402
from failing_calls import Bench  # noqa: E402
from subcommands import SUBCOMMANDS, write_inputs  # noqa: E402

CHANGING = {"create", "write", "pwrite", "ftruncate", "fchmod", "fchown", "fsync", "close", "rename"}
UNFINISHED = re.compile(r"\.out\.(view\.)?\w+\.\d+\.0\.partial")
PROCESS = re.compile(r"\d{2,}")  # its number, in such a name
LEAST_KILLS = 100


def check_kill(checks, bench, subcommand, reference, call, with_old):
    bench.prepare(subcommand, with_old)
    outcome = bench.run(subcommand, f"{call.process} {call.number} kill")
    what = f"{subcommand.name}: killed at {outcome.struck or call}"
    # A child that writes is not the command: its end is an error like others
    expected = -signal.SIGKILL if call.process == 0 else 3
    checks.that(outcome.struck is not None and outcome.status == expected, f"{what}: status {outcome.status}: {outcome.stderr}")
    states, left = bench.states(subcommand, reference)
    checks.that(set(states.values()) <= {"old" if with_old else "absent", "whole"}, f"{what}: {states}")
    checks.that(all(UNFINISHED.fullmatch(name) for name in left), f"{what}: left {left}")
    checks.that(call.process == 0 or left == [], f"{what}: left {left}")
    check_next(checks, bench, subcommand, reference, left, what)


def check_next(checks, bench, subcommand, reference, unfinished, what):
    """The next run, with the number of the one that was killed: what that left behind stands in its way."""
    planted = [os.path.join(bench.work, PROCESS.sub("$$", name)) for name in unfinished]
    outcome = bench.run(subcommand, before="".join(f'echo planted > "{path}"\n' for path in planted) or ":")
    checks.that(outcome.status == 0, f"{what}: the next run: status {outcome.status}: {outcome.stderr}")
    states, left = bench.states(subcommand, reference)
    checks.that(set(states.values()) == {"whole"}, f"{what}: the next run: {states}")
    checks.that(len(left) == 2 * len(planted), f"{what}: the next run: left {left}")


def sweep(checks, command, library, inputs, subcommand, every):
    """Number of kills."""
    bench = Bench(command, library, inputs)
    reference, calls = bench.reference(subcommand)
    changing = [call for call in calls if call.function in CHANGING and (call.name.startswith(".") or call.name in subcommand.outputs
                                                                         or (call.function, call.name) == ("fsync", "work"))]
    first = {call.function: call for call in reversed(changing)}
    struck = [call for number, call in enumerate(changing) if number % every == 0 or first[call.function] is call]
    for position, call in enumerate(struck):
        check_kill(checks, bench, subcommand, reference, call, position % 2 == 0)
    bench.close()
    print(f"{subcommand.name}: {len(struck)} kills", flush=True)
    return len(struck)


def main(command, library, data, every="1"):
    checks = Checks()
    with tempfile.TemporaryDirectory() as inputs, ThreadPoolExecutor(max_workers=os.cpu_count()) as pool:
        write_inputs(command, data, inputs)
        tasks = [pool.submit(sweep, checks, command, library, inputs, subcommand, int(every)) for subcommand in SUBCOMMANDS if subcommand.outputs]
        done = sum(task.result() for task in tasks)
    print(f"{done} kills")
    least = LEAST_KILLS // int(every)
    checks.that(done >= least, f"{done} kills, fewer than {least}")
    checks.finish()


if __name__ == "__main__":
    main(*sys.argv[1:])
