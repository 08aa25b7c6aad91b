# SPDX-License-Identifier: MIT
"""Replays one trajectory at three cutoffs: no mismatch with all pairs, and the same lists from another
engine; and with a skin, half and full lists.

    replay_data.py DCH TRAJECTORY
"""

import os
import sys

from dch_command import Checks, info, replay, three_cutoffs

# The engine beside dch at each of the cutoffs. Equal hashes carry the verification of dch's lists over to it.
OTHERS = ("cell", "allpairs", "cell")

# All pairs of each frame of a larger file would take minutes; of some frames they are formed at two cutoffs.
LARGE = 1_000_000  # bytes
SAMPLED = 10  # frames of `--verify sample`


def check_clean(checks, what, result, report):
    checks.that(result.returncode == 0, f"{what}: status {result.returncode}: {result.stderr}")
    checks.that(result.stderr == "", f"{what}: standard error: {result.stderr}")
    return checks.that(report is not None and report["mismatches"] == 0, f"{what}: mismatches")


def check_engines(checks, command, path, cutoff, other, facts, how_many):
    reports = []
    for engine, verify in (("dch", how_many), ("grid", "none"), ("auto", "none"), (other, "none")):
        what = f"{path} --cutoff {cutoff!r} --engine {engine} --verify {verify}"
        result, report = replay(command, path, "--cutoff", repr(cutoff), "--engine", engine, "--verify", verify)
        if not check_clean(checks, what, result, report):
            return
        checks.that(report["frames"] == facts["frames"] and len(report["pairs_per_frame"]) == facts["frames"],
                    f"{what}: {report['frames']} frames of {facts['frames']}")
        verified = len(report["verify"]["frames"])
        wanted = {"all": facts["frames"], "sample": min(SAMPLED, facts["frames"]), "none": 0}
        checks.that(verified == wanted[verify], f"{what}: {verified} frames verified")
        reports.append(report)
        print(f"{what}: pairs {report['pairs']}, mismatches {report['mismatches']}", flush=True)
    for engine, report in zip(("grid", "auto", other), reports[1:]):
        for key in ("pairs_per_frame", "list_hash", "degree_histogram"):
            checks.that(report[key] == reports[0][key],
                        f"{path} --cutoff {cutoff!r}: {key} of {engine} differs from that of dch")


def check_skin_and_full(checks, command, path, cutoff):
    """The same stale list for every engine; full lists hold the pairs of half ones."""
    options = ["--cutoff", repr(cutoff), "--skin", repr(0.15 * cutoff)]
    reports = []
    for extra in (["--verify", "sample"], ["--verify", "sample", "--full", "--policy", "repair"], ["--engine", "cell"]):
        what = f"{path} {' '.join(options + extra)}"
        result, report = replay(command, path, *options, *extra)
        if check_clean(checks, what, result, report):
            reports.append(report)
            print(f"{what}: pairs {report['pairs']}, {report['list_rebuilds']} lists", flush=True)
    for report in reports[1:]:
        for key in ("pairs_per_frame", "list_rebuilds", "degree_histogram"):
            checks.that(report[key] == reports[0][key], f"{path} with a skin: {key} differs")


def main(command, path):
    checks = Checks()
    facts = info(command, path)
    cutoffs = three_cutoffs(facts["smallest_box_height"])
    for cutoff, other in zip(cutoffs, OTHERS):
        is_large = os.path.getsize(path) > LARGE
        how_many = "sample" if is_large and other == "cell" else "all"
        check_engines(checks, command, path, cutoff, "cell" if is_large else other, facts, how_many)
    check_skin_and_full(checks, command, path, cutoffs[1])
    checks.finish()


if __name__ == "__main__":
    main(*sys.argv[1:])
