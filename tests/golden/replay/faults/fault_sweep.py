# SPDX-License-Identifier: MIT
"""Each call of the system that a subcommand makes for its files fails in turn, in each way that fits it; of those by
which it talks to its child processes, every ninth.

    fault_sweep.py DCH LIBRARY FOLDER_OF_TRAJECTORIES [EVERY]

With EVERY only the first call of each kind and every so manieth of the others fail.
Afterwards an error is a documented status with a message that names a file, an output is whole or as it was before, and
nothing else is left. What is interrupted, or moves fewer bytes than asked for, is no error at all.
"""

import collections
import errno
import os
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from dch_command import Checks  # noqa: E402
from failing_calls import Bench  # noqa: E402
from subcommands import SUBCOMMANDS, write_inputs  # noqa: E402

FULL_DISK = [errno.ENOSPC, errno.EIO, errno.EDQUOT]
BROKEN = [errno.EIO]
ERRORS = {
    "open": [errno.EACCES, errno.EMFILE, errno.EIO], "create": [errno.EACCES, errno.ENOSPC, errno.EROFS],
    "read": BROKEN, "pread": BROKEN, "write": FULL_DISK, "pwrite": FULL_DISK, "send": [errno.EPIPE],
    "fsync": FULL_DISK, "close": FULL_DISK, "rename": FULL_DISK, "ftruncate": FULL_DISK, "fchmod": [errno.EPERM, errno.EIO],
    "fchown": [errno.EPERM], "socketpair": [errno.EMFILE], "memfd_create": [errno.ENFILE],
    "fork": [errno.EAGAIN],
}
INTERRUPTIBLE = {"open", "create", "read", "pread", "write", "pwrite", "send", "fsync", "ftruncate", "close"}
MOVING = {"read", "pread", "write", "pwrite", "send"}
LEAST_FAULTS = 800
FIRST_TALKS, EVERY_TALK = 20, 9


def faults_of(call, position):
    """(fault, whether the run has to succeed nevertheless); the error changes from call to call."""
    errors = ERRORS[call.function]
    yield errors[position % len(errors)], False
    if call.function in INTERRUPTIBLE and not inside_hdf5(call):
        yield errno.EINTR, True
    if call.function in MOVING:
        yield "short", True


def disturbed(calls, every):
    """Calls that have to do with files, and some of the many by which processes talk, which are all alike."""
    talks = [call for call in calls if call.name == "socket" and call.function in MOVING]
    left_out = {call for number, call in enumerate(talks) if number >= FIRST_TALKS and number % EVERY_TALK}
    kept = [call for call in calls if call not in left_out]
    first = {call.function: call for call in reversed(kept)}
    return [call for number, call in enumerate(kept) if number % every == 0 or first[call.function] is call]


def inside_hdf5(call):
    """HDF5 takes an interrupted open() or close() for a failure; reads and writes it repeats."""
    return ".h5" in call.name and call.function in ("open", "create", "close", "ftruncate")


def may_go_unnoticed(call, error):
    """What no output depends on: closing what was read, giving a file to its old owner, and what only serves to sync a
    folder that may not be read."""
    if call.function == "close":
        return not call.name.endswith(".partial")
    if call.function == "create" and inside_hdf5(call):
        return True  # it tries twice
    return call.function == "fchown" or (call.function == "open" and call.name == "work" and error == errno.EACCES)


def check_run(checks, bench, subcommand, reference, plan):
    call, fault, succeeds, with_old = plan
    bench.prepare(subcommand, with_old)
    outcome = bench.run(subcommand, f"{call.process} {call.number} {fault}")
    if outcome.struck is None:
        return None
    what = f"{subcommand.name}: {errno.errorcode.get(fault, fault)} at {outcome.struck}"
    states, extra = bench.states(subcommand, reference)
    checks.that(extra == [], f"{what}: left {extra}")
    if succeeds or (outcome.status == 0 and may_go_unnoticed(outcome.struck, fault)):
        checks.that(outcome.status == 0, f"{what}: status {outcome.status}: {outcome.stderr}")
        checks.that(set(states.values()) <= {"whole"}, f"{what}: {states}")
        return outcome.struck.function
    names = [word for word in subcommand.arguments if word.startswith(("in.", "out."))]
    checks.that(outcome.status == 3, f"{what}: status {outcome.status}: {outcome.stderr}")
    checks.that(outcome.stderr.startswith("dchmd: ") and any(name in outcome.stderr for name in names),
                f"{what}: the message is {outcome.stderr!r}")
    before = "old" if with_old else "absent"
    checks.that(set(states.values()) <= {before, "whole"}, f"{what}: {states}")
    # Once the file has its name, its folder is all that can fail
    if len(states) == 1 and outcome.struck.name != "work":
        checks.that(list(states.values()) == [before], f"{what}: replaced in spite of the error")
    return outcome.struck.function


def sweep(checks, command, library, inputs, subcommand, every):
    """The functions that were made to fail, one for each fault."""
    bench = Bench(command, library, inputs)
    reference, calls = bench.reference(subcommand)
    struck = []
    for position, call in enumerate(disturbed(calls, every)):
        for fault, succeeds in faults_of(call, position):
            struck.append(check_run(checks, bench, subcommand, reference, (call, fault, succeeds, position % 2 == 0)))
    bench.close()
    done = [function for function in struck if function]
    # The two processes of a run take turns as they like, so that now and then a call is not there
    checks.that(len(done) >= 0.9 * len(struck), f"{subcommand.name}: {len(done)} of {len(struck)} faults took place")
    print(f"{subcommand.name}: {len(calls)} calls, {len(done)} faults", flush=True)
    return done


def main(command, library, data, every="1"):
    checks = Checks()
    with tempfile.TemporaryDirectory() as inputs, ThreadPoolExecutor(max_workers=os.cpu_count()) as pool:
        write_inputs(command, data, inputs)
        tasks = [pool.submit(sweep, checks, command, library, inputs, subcommand, int(every)) for subcommand in SUBCOMMANDS]
        done = collections.Counter(function for task in tasks for function in task.result())
    print(f"{done.total()} faults:", ", ".join(f"{count} {function}" for function, count in sorted(done.items())))
    least = LEAST_FAULTS // int(every)
    checks.that(done.total() >= least, f"{done.total()} faults, fewer than {least}")
    # HDF5 cuts a file off only where it has taken more room than it needed
    never = set(ERRORS) - set(done) - {"ftruncate"}
    checks.that(not never, f"functions never made to fail: {never}")
    checks.finish()


if __name__ == "__main__":
    main(*sys.argv[1:])
