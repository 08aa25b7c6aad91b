# SPDX-License-Identifier: MIT
"""Closest pairs that are kept up, beside trees that are built anew, and at every time of moving points."""

import collections

from ..record import Measurement, Result, Table
from ..running import Failed, Missing

NAME = "closest"
TITLE = "Closest pairs, kept up"
HOSTS = ("nanoflann",)
BASELINES = ("rebuilt_nanoflann", "rebuilt_hierarchy")  # the first that is there
BASELINES_OF_TREES = ("rebuilt_tree",)
WHAT = {"kept_exchange": "{} removed and inserted elsewhere", "kept_update": "update of which {} points moved",
        "kept_shake": "update, all points moved by up to {}e-4", "exchange_alone": "{} removed and inserted, no question",
        "update_alone": "update, all points moved by up to {}e-4, no question", "rebuilt_hierarchy": "hierarchy and tree built anew",
        "rebuilt_nanoflann": "nanoflann's tree built anew, nearest of all", "rebuilt_tree": "tree of points alone",
        "search_of_tree": "search of that tree alone",
        "kept_tree_exchange": "the tree kept up, {} removed and inserted elsewhere",
        "kept_tree_shake": "the tree kept up, all points moved by up to {}e-4"}


def run(suite):
    points = suite.pick(tiny="2000", quick="100000", full="100000*")
    repetitions = [f"--benchmark_repetitions={suite.pick(tiny=2, quick=5, full=9)}",
                   f"--benchmark_min_time={suite.pick(tiny=0.001, quick=0.05, full=0.5)}"]
    runs = measured(suite, "dch_bench_closest", [f"--benchmark_filter=/{points}($|/)", *repetitions])
    result = Result(seed=1, checked="After each run the pair was compared with that of a tree built anew, and with all pairs of "
                    "a hundred of the moving points.")
    times = {name: [one["cpu_time"] for one in of_name] for name, of_name in runs.items()}
    for name, values in times.items():
        kind, count, *number = name.split("/")
        baselines = BASELINES_OF_TREES if kind.startswith("kept_tree") else BASELINES
        against = next((f"{b}/{count}" for b in baselines if f"{b}/{count}" in times), "")
        has_baseline = against and against != name and len(times[against]) == len(values)
        result.measurements.append(Measurement(f"{count} uniform points", what(kind, number), "us", values,
                                               what(against.split("/")[0], []) if has_baseline else "",
                                               times[against] if has_baseline else []))
    result.tables.append(Table("Questions of kept closest pairs", ["points", "what", "points that asked, a step"],
                               [[name.split("/")[1], what(name.split("/")[0], name.split("/")[2:]), of_name[0]["asked"]]
                                for name, of_name in runs.items() if "asked" in of_name[0]]))
    try:
        add_kinetic(suite, repetitions, result)
    except Missing as error:
        result.left_out.append(str(error).splitlines()[-1])
    return result


def measured(suite, program, options):
    """Runs by name of benchmark. A wrong answer is an error of the run."""
    report = suite.run_for_json([suite.program("benchmarks", "closest", program), "--benchmark_out_format=json", *options],
                                flag="--benchmark_out=")
    runs = collections.defaultdict(list)
    for one in report["benchmarks"]:
        if one["run_type"] == "iteration":
            if one.get("error_occurred"):
                raise Failed(f"{one['run_name']}: {one['error_message']}")
            runs[one["run_name"]].append(one)
    return runs


def what(kind, number):
    return WHAT[kind].format(*number)


def add_kinetic(suite, repetitions, result):
    points = suite.pick(tiny="500", quick="5000", full="50*")
    runs = measured(suite, "dch_bench_kinetic_closest", [f"--benchmark_filter=/{points}$", *repetitions])
    columns = ["edges_a_point", "certificates_a_point", "most_certificates_of_a_point", "lost_a_change", "edge_events_a_change",
               "made_an_event"]
    rows = []
    for name, of_name in runs.items():
        count = name.split("/")[1]
        result.measurements.append(Measurement(f"{count} points in flight", "until another pair is the closest one", "us",
                                               [one["cpu_time"] for one in of_name]))
        rows.append([count, *(of_name[0][column] for column in columns)])
    result.tables.append(Table("Certificates of a kinetic tournament",
                               ["points", "edges a point", "certificates a point", "most of a point", "lost for each change",
                                "edges that come or go for each change", "made by an event"], rows))
