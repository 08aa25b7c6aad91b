# SPDX-License-Identifier: MIT
"""An engine that loses one pair and invents one in frame 2: --verify finds both, names them and ends in status 1.

    mismatch.py DCH_WITH_FAULTY_CELL_SEARCH FOLDER_OF_TRAJECTORIES DOCS
"""

import os
import sys
import tempfile

from dch_command import Checks, check_keys, replay, run


def main(command, data, docs):
    checks = Checks()
    water = os.path.join(data, "water.trr")
    result, report = replay(command, water, "--cutoff", "0.4", "--engine", "cell", "--frames", "0:20", "--verify", "all")
    print(result.stderr)
    checks.that(result.returncode == 1, f"status {result.returncode}")
    checks.that("mismatches      2" in result.stdout, "the table tells the number")
    checks.that(result.stderr.count("frame 2: pair of atoms 1 and ") == 2, "both messages name frame and pair")
    checks.that("is missing from the list" in result.stderr and "in the list but beyond" in result.stderr, "what is wrong")
    checks.that("at distance 0." in result.stderr and "(nm)" in result.stderr, "distance and unit")
    check_keys(checks, report, docs, {"always", "mismatch"})
    checks.that(report["mismatches"] == 2, "the report tells the number")
    missing, extra = report["verify"]["first_mismatches"]
    checks.that((missing["frame"], missing["what"], extra["what"]) == (2, "missing", "extra"), f"{missing}, {extra}")
    checks.that(missing["distance"] <= 0.4 < extra["distance"], "distances of both")

    result, _ = replay(command, water, "--cutoff", "0.4", "--engine", "cell", "--frames", "0:9", "--verify", "sample")
    checks.that(result.returncode == 1, "a sample of all frames and atoms finds them too")
    result, _ = replay(command, water, "--cutoff", "0.4", "--engine", "cell", "--frames", "0:20", "--verify", "none")
    checks.that(result.returncode == 0 and "not looked for" in result.stdout, "nothing is claimed unasked")
    with tempfile.TemporaryDirectory() as folder:
        run(command, "replay", water, "--cutoff", "0.4", "--engine", "cell", "--frames", "0:20", "--verify", "all",
            "--plot", "report.html", "--out", "lists.h5", cwd=folder)
        checks.that(sorted(os.listdir(folder)) == ["lists.h5", "report.html"], f"files {os.listdir(folder)}")
        checks.that("2 mismatches" in open(os.path.join(folder, "report.html")).read(), "the page tells the number")
    checks.finish()


if __name__ == "__main__":
    main(*sys.argv[1:])
