# SPDX-License-Identifier: MIT
"""The table of scenes: the hierarchy against grids with the same kernels, and instruction sets against each other."""

import os
import statistics

from .. import machine
from ..record import Measurement, Plot, Result, Table

NAME = "engine"
TITLE = "Lists of the hierarchy and of grids"
HOSTS = ()
UNIT = "ns/particle"
CELL_LIST = "cell list"
QUICK = "melt4k,melt32k,chain32k,droplet+gas,clusters,swollen,shear,glass,hotgas,sizes1:10,cutoffs3"
ALL = ("melt4k,melt32k,melt256k,melt1m,chain32k,droplet+gas,droplet,clusters,swollen,shear,glass,hotgas,sizes1:10,sizes1:50,"
       "colloids1:50,sizes1..20,cutoffs3")
SCALED = "shear,glass,hotgas,droplet+gas,clusters,swollen,sizes1:10"  # made in any size
CHECKED = ("All lists were compared with each other at every configuration, by number of pairs and a hash over pairs, and at "
           "the first and the last with the library's cell list or all pairs, which share no code with hierarchies and grids; a "
           "wrong list ends the program.")


def run(suite):
    result = Result(checked=CHECKED, seed=1)
    words = table_command(suite)
    scenes = suite.pick(tiny="melt32k,clusters", quick=QUICK, full=ALL).split(",")
    if suite.size != "tiny":
        if suite.needs_trajectory("water30k"):
            result.left_out.append("water30k: make_trajectories water30k makes its configurations")
        else:
            scenes.append("water30k")
    scale = suite.pick(tiny=0.1, quick=0.5, full=1)  # of scenes that are made; trajectories are as they are
    report = suite.run_for_json([*words, "--scenes", ",".join(scenes), "--scale", scale])
    if suite.size == "quick":
        result.left_out.append("sizes1:50: a box that the largest fit into holds half a million particles; at full size only")
    for scene in report["scenes"]:
        result.measurements += measurements_of(scene)
        if "list_hash" in scene:
            result.list_hash[scene["scene"]] = scene["list_hash"]
    result.tables.append(scenes_table(report["scenes"]))
    result.tables.append(choices_table(report["scenes"]))
    result.plots.append(ratios_plot(result.measurements))
    result.plots += growth(suite, words, report["scenes"])
    result.measurements += instruction_sets(suite, words, result)
    result.measurements += threads(suite, words, result)
    result.tables.append(maintenance(suite))
    return result


def table_command(suite):
    words = [suite.program("benchmarks", "engine", "dch_bench_table"), "--processor", suite.processor,
             "--repetitions", suite.pick(tiny=2, quick=5, full=5), "--lists", suite.pick(tiny=2, quick=20, full=100)]
    return words if suite.size == "tiny" else words + ["--trajectories", suite.trajectories]


def measurements_of(scene):
    """Each contender against the fastest grid of the scene; the library's cell list where no other grid can be had."""
    grids = [m for m in scene["measurements"] if "updates" not in m and "choice" not in m]
    best = min(grids, key=lambda m: m["median"], default=None)
    for m in scene["measurements"]:
        against = {} if best is None or m is best else {"baseline": best["contender"],
                                                         "baseline_values": best["ns_per_particle"]}
        yield Measurement(scene["scene"], m["contender"], UNIT, m["ns_per_particle"], **against)


def scenes_table(scenes):
    rows = []
    for scene in scenes:
        for m in scene["measurements"]:
            updates = m.get("updates")
            what = f"{updates['refreshes']}, {updates['repairs']}, {updates['builds']}" if updates else ""
            update, whole = statistics.median(m["update_ns_per_particle"]), m["median"]
            keeps = updates or m["contender"] == CELL_LIST
            rows.append([scene["scene"], scene["particles"], scene["pairs_per_particle"], m["contender"], m["first"],
                         update if keeps else None, whole - update if keeps else whole, m["bytes_per_particle"], what,
                         scene["origin"]])
    return Table("Building, repair, lists, pairs and memory",
                 ["scene", "particles", "pairs/particle", "contender", "first: build and list, ns/particle",
                  "repair or build, ns/particle", "list, ns/particle", "bytes/particle", "refreshed, repaired, built",
                  "configurations"], rows,
                 "Of 'dch, built anew' the sixth column is the build. Grids are built with the list, and where particles have radii "
                 "most of the structure is brought up to date with the list. Bytes are beyond the lists. A "
                 "refresh takes new positions alone, where the structure still holds.")


def choices_table(scenes):
    """The engine that chooses: against the fastest grid, and its choice against the two that it chooses from."""
    rows = []
    for scene in scenes:
        by_name = {m["contender"]: m for m in scene["measurements"]}
        grids = [m for m in scene["measurements"] if "updates" not in m and "choice" not in m]
        if not {"auto", "dch", "grid"} <= by_name.keys():
            continue
        chooser, dch, grid = by_name["auto"], by_name["dch"], by_name["grid"]
        fastest = min(grids, key=lambda m: m["median"])
        taken, other = (grid, dch) if chooser["choice"].startswith("grid") else (dch, grid)
        rows.append([scene["scene"], scene["particles"], ratio(chooser, fastest), fastest["contender"],
                     max(ratio(chooser, dch), ratio(chooser, grid)), max(1, ratio(taken, other)), chooser["choice"]])
    return Table("The choice of engine by counted work",
                 ["scene", "particles", "auto / fastest grid", "fastest grid", "auto / better engine", "choice / better engine",
                  "chosen at last"], rows,
                 "'auto' chooses between 'dch' and 'grid'. The last ratio is that of the engine that it took at last, running "
                 "alone from the start, to the better of the two: 1 where the choice is right. Medians over the repetitions.")


def ratio(a, b):
    return statistics.median(x / y for x, y in zip(a["ns_per_particle"], b["ns_per_particle"]))


def ratios_plot(measurements):
    """Time over that of the fastest grid, for each scene."""
    series = {}
    for m in measurements:
        if m.baseline and CELL_LIST not in (m.name, m.baseline):
            series.setdefault(m.name, []).append([m.scene, m.facts()["ratio"]["median"]])
    return Plot("Repair or build, and list, over the fastest grid", "time over that of the fastest grid", "", series,
                kind="dots")


def growth(suite, words, scenes):
    """Time and memory for one particle against their number: the melts, and scenes that can be made in any size."""
    time, memory = {}, {}
    for scene in scenes:
        if scene["scene"].startswith("melt"):
            add_growth(scene, "melt", time, memory)
        elif scene["scene"] in SCALED.split(","):
            add_growth(scene, scene["scene"], time, memory)
    for scale in suite.pick(tiny=(), quick=(2,), full=(0.5, 4, 16)):
        report = suite.run_for_json([*words, "--scenes", SCALED, "--only", "dch", "--scale", scale])
        for scene in report["scenes"]:
            add_growth(scene, scene["scene"], time, memory)
    for points in [*time.values(), *memory.values()]:
        points.sort()
    return [Plot("Growth with the number of particles", "particles", f"repair and list of dch, {UNIT}", time,
                 logarithmic_x=True, logarithmic=False, from_zero=True),
            Plot("Memory beyond the list", "particles", "bytes/particle", memory, logarithmic_x=True, logarithmic=False,
                 from_zero=True)]


def add_growth(scene, name, time, memory):
    for m in scene["measurements"]:
        if m["contender"] == "dch":
            time.setdefault(name, []).append([scene["particles"], m["median"]])
            memory.setdefault(name, []).append([scene["particles"], m["bytes_per_particle"]])


def maintenance(suite):
    """Repairs and builds after the same displacements, and the one of them that counted work chooses."""
    words = [suite.program("benchmarks", "engine", "dch_bench_maintenance"), "--processor", suite.processor,
             "--scenes", suite.pick(tiny="clusters", quick="melt4k,hotgas,droplet+gas,clusters",
                                    full="melt4k,melt32k,hotgas,droplet+gas,clusters,shear,swollen"),
             "--steps", suite.pick(tiny="0.1,3", quick="0.03,0.1,0.3,1", full="0.01,0.03,0.1,0.2,0.3,0.5,1,3"),
             "--scale", suite.pick(tiny=0.1, quick=0.5, full=1), "--updates", suite.pick(tiny=2, quick=6, full=6),
             "--repetitions", suite.pick(tiny=1, quick=2, full=3)]
    columns = {"scene": "scene", "particles": "particles", "step": "step, list radii", "orphans": "orphans/particle",
               "exchange": "exchange of one, ns", "repair": "repair, ns/particle", "build": "build, ns/particle",
               "automatic": "automatic, ns/particle", "repairs": "repairs/update", "builds": "builds/update",
               "loss": "chosen over the better, less 1"}
    rows = suite.run_for_json(words)["table"]
    return Table("Repair or build", list(columns.values()), [[row[key] for key in columns] for row in rows],
                 "The same displacements are repaired and built anew; the automatic policy chooses by counted work. Orphans are "
                 "nodes that got another parent. The last column compares the time of the way that was chosen with that of the "
                 "better one, where every update had to choose.")


def only_ours(suite, words, environment):
    scale = suite.pick(tiny=0.1, quick=1, full=1)
    report = suite.run_for_json([*words, "--scenes", "melt32k", "--only", "dch", "--scale", scale], environment=environment)
    return next(m for m in report["scenes"][0]["measurements"] if m["contender"] == "dch")["ns_per_particle"]


def instruction_sets(suite, words, result):
    """The melt with each set that this processor has; others are left out."""
    sets = machine.instruction_sets()
    result.left_out += [f"{name}: not supported by this processor" for name in machine.INSTRUCTION_SETS if name not in sets]
    baseline = None
    for name in sets:
        values = only_ours(suite, words, {"DCH_FORCE_ISA": name})
        against = {"baseline": f"dch, {sets[0]}", "baseline_values": baseline} if baseline else {}
        baseline = baseline or values
        yield Measurement("melt32k", f"dch, {name}", UNIT, values, **against)


def threads(suite, words, result):
    """Lists on two threads, by wall clock, both runs with the same clock."""
    if len(os.sched_getaffinity(0)) < 2:
        result.left_out.append("two threads: this program may use one processor alone")
        return
    if suite.size != "tiny" and machine.is_busy(machine.processors_in_use()):
        result.left_out.append("two threads: they are measured by wall clock, and others use the machine")
        return
    report = suite.run_for_json([*words, "--scenes", "melt32k", "--threads", "2", "--scale", suite.pick(tiny=0.1, quick=1, full=1)], pinned=False)
    by_name = {m["contender"]: m["ns_per_particle"] for m in report["scenes"][0]["measurements"]}
    for name, values in by_name.items():
        if "thread" in name:
            yield Measurement("melt32k, wall clock", name, UNIT, values, "dch", by_name["dch"])
