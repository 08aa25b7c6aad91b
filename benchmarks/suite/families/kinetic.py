# SPDX-License-Identifier: MIT
"""Events of moving points: collisions of hard spheres, points that pass each other, and what the reference counts."""

import statistics

from .. import google_benchmark
from ..record import Measurement, Result, Table

NAME = "kinetic"
TITLE = "Events of points whose motion is known"
HOSTS = ()
SCENES = {"equal_spheres": "spheres of one size", "unlike_spheres": "spheres of two sizes", "passing_points": "points that pass"}
COUNTED = {"events": "events", "external": "of pairs of points", "over_n2_levels": "events / (n^2 levels)",
           "certificates_a_point": "certificates/point", "made_an_event": "certificates made/event"}


def run(suite):
    by_name = google_benchmark.answered(*google_benchmark.repetitions(
        suite, [suite.program("benchmarks", "kinetic", "dch_bench_kinetic")],
        suite.pick(tiny=2, quick=5, full=9), suite.pick(tiny=0.001, quick=0.1, full=0.5),
        suite.pick(tiny="/(500|25)$", quick="/(500|10648|25|50|100)$|19683/10$", full=".")))
    result = Result(seed=1, checked="Spheres keep their energy within 1e-10 and do not overlap, edges are no longer than their "
                    "distance, and the reference is valid; else the program says so.")
    for name, runs in by_name.items():
        scene, *size = name.split("/")
        if scene in SCENES:
            what = f"{int(size[0]):,} {SCENES[scene]}" + (f", 1:{size[1]}" if len(size) > 1 else "")
            result.measurements.append(Measurement(what, "an event", runs[0]["time_unit"], google_benchmark.times(runs)))
    result.tables.append(Table(
        "Events of the kinetic hierarchy, the reference", ["points", *COUNTED.values(), "ms"],
        [[int(name.split("/")[1]), *(runs[0][key] for key in COUNTED), statistics.median(google_benchmark.times(runs))]
         for name, runs in by_name.items() if name.startswith("reference_counts/")],
        "Points of a cube fly through it until they are past each other."))
    return result
