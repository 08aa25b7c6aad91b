# SPDX-License-Identifier: MIT
"""Potentials of far charges by expansions: time over that of the direct sum, against the error and its bound."""

import statistics

from .. import google_benchmark
from ..record import Measurement, Plot, Result, Table

NAME = "far_sums"
TITLE = "Sums over far charges"
HOSTS = ()


def run(suite):
    by_name = google_benchmark.answered(*google_benchmark.repetitions(
        suite, [suite.program("benchmarks", "far_sums", "dch_bench_far_sums")],
        suite.pick(tiny=2, quick=3, full=5), suite.pick(tiny=0.001, quick=0.05, full=0.5),
        suite.pick(tiny="/2000(/[1-2])?$", quick="/(2000|20000)(/|$)", full=".")))
    result = Result(seed=1, checked="Potentials of 200 charges were compared with the plain sum: no error is above its bound, "
                    "and no bound above the tolerance; else the program says so.")
    # The program times direct sums at some of the points, and says what all of them would take: a loop as it is written,
    # and one that compilers vectorize, which is the baseline.
    direct = {name.split("/")[1]: statistics.median(1e3 * one["all_points"] for one in runs)
              for name, runs in by_name.items() if name.startswith("direct<vectorized_potential>/")}
    rows, series = [], {}
    for name, runs in by_name.items():
        if not name.startswith("far/"):
            continue
        _, count, digits = name.split("/")
        values = google_benchmark.times(runs)
        result.measurements.append(Measurement(f"{int(count):,} charges", f"tolerance 1e-{digits}", runs[0]["time_unit"],
                                               values, "direct sum", [direct[count]] * len(values)))
        one, ratio = runs[0], statistics.median(values) / direct[count]
        rows.append([int(count), f"1e-{digits}", one["order"], one["bound"], one["error"], one["far_pairs"], one["near_pairs"],
                     statistics.median(values), ratio])
        if one["near_pairs"] < float(count):  # else all pairs were summed directly
            for what in ("error", "bound"):
                series.setdefault(f"{int(count):,}, {what}", []).append([one[what], ratio])
    result.tables.append(Table("Expansions beside the vectorized direct sum",
                               ["charges", "tolerance", "order", "bound", "error", "far pairs/charge", "near pairs/charge",
                                "ms", "over the direct sum"], rows,
                               "Errors are over the sum of absolute charges over distances."))
    if series:
        result.plots.append(Plot("Time over that of the direct sum against the error", "error", "time over that of the direct sum",
                                 series, logarithmic_x=True))
    return result
