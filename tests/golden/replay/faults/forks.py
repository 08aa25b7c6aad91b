# SPDX-License-Identifier: MIT
"""Every child process starts before the threads do: it inherits the locks that threads hold, and nobody who gives them
back. Such a child hangs once in a hundred runs, so the order is looked at and not the hanging.

    forks.py DCH LIBRARY FOLDER_OF_TRAJECTORIES
"""

import os
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from dch_command import Checks  # noqa: E402
from failing_calls import Bench  # noqa: E402
from subcommands import Subcommand, write_inputs  # noqa: E402

RUNS = [
    Subcommand("replay", ["replay", "in.h5", "--cutoff", "3", "--threads", "3", "--out", "out.h5"], ["out.h5"]),
    Subcommand("contacts", ["contacts", "in.h5", "--gap", "2.5", "--topology", "in.chains", "--threads", "3",
                            "--out", "out.h5"], ["out.h5"]),
    Subcommand("query", ["query", "in.h5", "--threads", "3", "--out", "out.h5"], ["out.h5"]),
]
CHILDREN = 3  # the reader of the first pass, that of the second, and the writer


def main(command, library, data):
    checks = Checks()
    with tempfile.TemporaryDirectory() as inputs:
        write_inputs(command, data, inputs)
        for run in RUNS:
            bench = Bench(command, library, inputs)
            forks = [call.name for call in bench.reference(run)[1] if call.function == "fork"]
            checks.that(forks == ["child"] * CHILDREN, f"{run.name}: {forks}")
            bench.close()
    checks.finish()


if __name__ == "__main__":
    main(*sys.argv[1:])
