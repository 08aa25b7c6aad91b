# SPDX-License-Identifier: MIT
"""Necklaces: how searches grow, cages along a motion, and contacts against SciPy's trees and a cell list."""

import math
import os

from ..record import Measurement, Plot, Result, Table
from ..running import Missing

NAME = "necklace"
TITLE = "Necklaces: contacts of chains"
HOSTS = ("LAMMPS", "SciPy")
MELT_CHAIN = 100  # beads of a chain of the trajectory chain32k
MISSING_STATUS = 2  # of the scripts in benchmarks/necklace
LAWS = {"grid 2D": ("n lg n", lambda n: n * math.log2(n)), "grid 3D": ("n^(4/3)", lambda n: n ** (4 / 3))}
CHECKED = ("Contacts of all structures and of SciPy's trees were compared before anything was timed, cages that were kept up "
           "with those built anew at every step, and the cages of both hierarchies with each other; grids have to be without "
           "contact.")


def run(suite):
    program = [suite.program("benchmarks", "necklace", "dch_bench_necklace"), "--processor", suite.processor]
    result = Result(seed=1, checked=CHECKED)
    growth = suite.run_for_json([*program, "growth", "--most", suite.pick(tiny=256, quick=16384, full=262144)])["table"]
    radii = radii_of(suite, program)
    result.plots += [growth_plot(growth, shape) for shape in LAWS] + [radii_plot(radii)]
    result.tables += [growth_table(growth), radii_table(radii)]
    add_contacts(suite, result)
    add_motion(suite, result)
    add_diagram(suite, program, result)
    return result


def radii_of(suite, program):
    """Rows of shapes, and of a real melt if LAMMPS has made one; its beads are those of a chain."""
    words = [*program, "radii", "--most", suite.pick(tiny=128, quick=4096, full=4096)]
    if suite.has_trajectory("chain32k.h5"):
        words += ["--trajectory", os.path.join(suite.trajectories, "chain32k.h5"), "--chain-beads", MELT_CHAIN]
    melt = {"shape": f"melt, chains of {MELT_CHAIN}", "beads": MELT_CHAIN}
    return [{**row, **melt} if row["shape"] == "trajectory" else row for row in suite.run_for_json(words)["table"]]


def growth_plot(table, shape):
    """Visited pairs, and the law with the constant that fits them best, in logarithms."""
    name, law = LAWS[shape]
    points = [[row["beads"], row["visited"]] for row in table if row["shape"] == shape]
    constant = math.exp(sum(math.log(visited / law(n)) for n, visited in points) / len(points))
    fitted = [[n, constant * law(n)] for n, _ in points]
    return Plot(f"Visited pairs of the {shape} necklace", "beads n", "pairs of cages compared",
                {"visited pairs": points, f"{constant:.2f} {name}": fitted}, logarithmic_x=True)


def radii_plot(table):
    shapes = {"sqrt(floor(lg n))": [[row["beads"], row["sqrt_floor_lg_n"]] for row in table if row["shape"] == "tight set"]}
    for row in table:
        shapes.setdefault(row["shape"], []).append([row["beads"], row["root"]])
    return Plot("Layered over wrapped radius", "beads n", "layered over wrapped radius of the root", shapes,
                logarithmic=False, logarithmic_x=True)


def growth_table(table):
    largest = {row["shape"]: row for row in table}  # rows of a shape grow
    return Table("Pairs of cages that a search compares", ["shape", "beads", "visited", "law", "visited / law", "contacts"],
                 [[row[key] for key in ("shape", "beads", "visited", "law", "to_law", "contacts")] for row in largest.values()],
                 "Leaves of one bead; the largest chain of each shape.")


def radii_table(table):
    largest = {row["shape"]: row for row in table}
    return Table("Layered cages over wrapped ones, the least that enclose the beads",
                 ["shape", "beads", "root", "mean", "largest", "sqrt(floor(lg n))"],
                 [[row[key] for key in ("shape", "beads", "root", "mean", "largest", "sqrt_floor_lg_n")]
                  for row in largest.values()],
                 "The melt is a Kremer-Grest melt from LAMMPS; its root is the mean over the roots of its chains.")


def add_contacts(suite, result):
    """An update and a query of each structure, over the faster of SciPy's trees and the cell list."""
    words = [suite.script("necklace", "scipy_trees"), "--build", suite.build, "--processor", suite.processor,
             "--beads", suite.pick(tiny=500, quick=10000, full=100000), "--rounds", suite.pick(tiny=2, quick=3, full=5),
             "--repetitions", suite.pick(tiny=2, quick=5, full=5)]
    for scene in suite.run_for_json(words, missing_status=MISSING_STATUS):
        question = "any contact?" if scene["question"] == "any" else f"all {scene['contacts']} contacts"
        name, faster = f"{scene['scene']}, {scene['beads']} beads, {question}", scene["faster"]
        for contender, times in scene["update_and_query_ms"].items():
            against = {} if contender == faster else {"baseline": faster,
                                                      "baseline_values": scene["update_and_query_ms"][faster]}
            result.measurements.append(Measurement(name, contender, "ms", times, **against))


def add_motion(suite, result):
    """Updates of one bead-spring chain in LAMMPS's Langevin dynamics, over building; the program runs once a repetition."""
    beads, settle, steps = suite.pick(tiny=(200, 20, 20), quick=(2000, 500, 200), full=(10000, 2000, 1000))
    folder = os.path.join(suite.build, "benchmarks", "necklace", "langevin")
    words = [suite.script("necklace", "langevin"), "--build", suite.build, "--to", folder, "--processor", suite.processor,
             "--beads", beads, "--settle", settle, "--steps", steps]
    runs = [suite.run_for_json(words, missing_status=MISSING_STATUS)["table"]
            for _ in range(suite.pick(tiny=2, quick=5, full=5))]
    for k, first in enumerate(runs[0]):
        name = f"leaves of {first['leaf_beads']:.0f}, {first['verification']}"
        scene = f"Langevin chain of {beads} beads, {name}"
        build = [run[k]["build_ns_per_bead"] for run in runs]
        update = [run[k]["repair_ns_per_bead"] for run in runs]
        result.measurements += [Measurement(scene, "build", "ns/bead", build),
                                Measurement(scene, "update", "ns/bead", update, "build", build)]
    columns = {"leaf_beads": "beads of a leaf", "verification": "verification", "tests_per_bead": "tests / bead",
               "most_tests_per_bead": "most", "escapes_per_update": "escapes / step",
               "share_of_cages_changed": "share of cages with another basis"}
    result.tables.append(Table(f"Verification of cages, {steps} steps of 0.012", list(columns.values()),
                               [[row[key] for key in columns] for row in runs[0]]))


def add_diagram(suite, program, result):
    """Repair of the power diagram after steps of several lengths, over building it."""
    try:
        table = suite.run_for_json([*program, "diagram", "--beads", suite.pick(tiny=500, quick=2000, full=10000),
                                    "--rounds", suite.pick(tiny=2, quick=3, full=3)], missing_status=MISSING_STATUS)["table"]
    except Missing:
        result.left_out.append("power diagram: the build has no CGAL")
        return
    columns = {"shape": "shape", "beads": "beads", "step": "step", "edges_per_bead": "edges / bead",
               "share_removed": "share of balls taken out", "build_us_per_bead": "build, us / bead",
               "repair_to_build": "repair / build"}
    result.tables.append(Table("The power diagram under motion", list(columns.values()),
                               [[row[key] for key in columns] for row in table],
                               "Edges of the diagram that was repaired and of one built anew are the same."))
