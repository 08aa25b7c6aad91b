# SPDX-License-Identifier: MIT
"""Programs of Google Benchmark: their repetitions, by the name of what they measure."""

import collections

from . import running


def repetitions(suite, words, repetitions, min_time, chosen="."):
    """The repetitions of each benchmark by its name, and (name, reason) of each that refused to run.

    `chosen` is a regular expression of names.
    """
    report = suite.run_for_json([*words, "--benchmark_out_format=json", f"--benchmark_filter={chosen}",
                                 f"--benchmark_repetitions={repetitions}", f"--benchmark_min_time={min_time}"],
                                flag="--benchmark_out=")
    by_name, refused = collections.defaultdict(list), []
    for one in report["benchmarks"]:
        if one.get("error_occurred"):
            refused.append((one["run_name"], one["error_message"]))
        elif one["run_type"] == "iteration":
            by_name[one["run_name"]].append(one)
    return by_name, refused


def answered(by_name, refused):
    """`by_name` of a program that refuses to run for a wrong answer alone."""
    if refused:
        raise running.Failed("; ".join(f"{name}: {reason}" for name, reason in sorted(set(refused))))
    return by_name


def times(runs):
    return [one["cpu_time"] for one in runs]
