# SPDX-License-Identifier: MIT
"""Cluster pairs and Lennard-Jones forces, in single and double precision, by instruction set."""

from .. import google_benchmark, machine
from ..record import Measurement, Plot, Result, Table

NAME = "forces"
TITLE = "Cluster pairs and forces"
HOSTS = ()
SETS = tuple(machine.INSTRUCTION_SETS)  # as the program numbers them


def run(suite):
    by_name, refused = google_benchmark.repetitions(
        suite, [suite.program("benchmarks", "forces", "dch_bench_forces")],
        suite.pick(tiny=2, quick=5, full=9), suite.pick(tiny=0.001, quick=0.02, full=0.5),
        suite.pick(tiny="^forces_(mixed|full)/20/0", quick="/20/", full="."))
    result = Result(seed=1, checked="Forces were compared with those of a cell list, pair by pair in long double: in single "
                    "precision within 2e-6 of their root mean square, in double within 1e-14.")
    times = {name: google_benchmark.times(runs) for name, runs in by_name.items()}
    for name, values in times.items():
        double = name.replace("_mixed", "_full")
        baseline = double if double != name and len(times.get(double, ())) == len(values) else ""
        result.measurements.append(Measurement(scene_of(name), f"{name.split('/')[0]}, {set_of(name)}",
                                               by_name[name][0]["time_unit"], values,
                                               baseline and f"{double.split('/')[0]}, {set_of(double)}",
                                               times.get(baseline, [])))
    result.tables.append(error_table(by_name))
    result.plots.append(error_plot(by_name))
    result.left_out += sorted({f"{set_of(name)}: {reason}" for name, reason in refused})
    return result


def cells_of(name):
    return int(name.split("/")[1])


def set_of(name):
    return SETS[int(name.split("/")[2])]


def scene_of(name):
    return f"melt, {4 * cells_of(name)**3} atoms"


def error_plot(by_name):
    """Speed against error of each precision and instruction set."""
    series = {}
    for name, runs in by_name.items():
        if "error" in runs[0]:
            series.setdefault(f"{name.split('/')[0]}, {set_of(name)}", []).append([runs[0]["time/useful"], runs[0]["error"]])
    return Plot("Error of forces against their time", "ns/useful pair", "relative root mean square", series)


def error_table(by_name):
    rows = []
    for name, runs in by_name.items():
        first = runs[0]
        if "time/useful" in first:
            rows.append([scene_of(name), name.split("/")[0], set_of(name), first["time/useful"],
                         first.get("error"), first.get("slots/useful")])
    return Table("Forces: time of a pair within the cutoff, and error",
                 ["scene", "kernel", "instruction set", "ns/useful pair", "error", "slots/useful"], rows,
                 "The error is the root mean square of differences over that of forces; pairs at the very cutoff, where the "
                 "force jumps, count as no error.")
