# SPDX-License-Identifier: MIT
"""Replays one trajectory at three cutoffs: no mismatch with all pairs, and the same lists from all engines.

    replay_data.py DCH TRAJECTORY
"""

import sys

from dch_command import Checks, info, replay, three_cutoffs

MOST_ATOMS_VERIFIED_TWICE = 5000  # with more, equal hashes carry the verification of dch's lists over to the others


def check_clean(checks, what, result, report):
    checks.that(result.returncode == 0, f"{what}: status {result.returncode}: {result.stderr}")
    checks.that(result.stderr == "", f"{what}: standard error: {result.stderr}")
    return checks.that(report is not None and report["mismatches"] == 0, f"{what}: mismatches")


def check_engines(checks, command, path, cutoff, facts):
    reports = {}
    for engine in ("dch", "cell", "allpairs"):
        small = facts["atoms"] <= MOST_ATOMS_VERIFIED_TWICE
        verify = "all" if engine == "dch" or small else "none"
        what = f"{path} --cutoff {cutoff!r} --engine {engine} --verify {verify}"
        result, report = replay(command, path, "--cutoff", repr(cutoff), "--engine", engine, "--verify", verify)
        if not check_clean(checks, what, result, report):
            return
        checks.that(report["frames"] == facts["frames"] and len(report["pairs_per_frame"]) == facts["frames"],
                    f"{what}: {report['frames']} frames of {facts['frames']}")
        checks.that(len(report["verify"]["frames"]) == (facts["frames"] if verify == "all" else 0),
                    f"{what}: frames verified")
        reports[engine] = report
        print(f"{what}: pairs {report['pairs']}, mismatches {report['mismatches']}", flush=True)
    for engine in ("cell", "allpairs"):
        for key in ("pairs_per_frame", "list_hash", "degree_histogram"):
            checks.that(reports[engine][key] == reports["dch"][key],
                        f"{path} --cutoff {cutoff!r}: {key} of {engine} differs from that of dch")


def check_skin_and_full(checks, command, path, cutoff, facts):
    """The same stale list for every engine; full lists hold the pairs of half ones."""
    options = ["--cutoff", repr(cutoff), "--skin", repr(0.15 * cutoff)]
    reports = []
    how = "all" if facts["atoms"] <= MOST_ATOMS_VERIFIED_TWICE else "sample"
    for extra in (["--verify", how], ["--verify", how, "--full", "--policy", "repair"],
                  ["--engine", "cell", "--verify", "sample"]):
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
    for cutoff in cutoffs:
        check_engines(checks, command, path, cutoff, facts)
    check_skin_and_full(checks, command, path, cutoffs[1], facts)
    checks.finish()


if __name__ == "__main__":
    main(*sys.argv[1:])
