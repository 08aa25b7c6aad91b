# SPDX-License-Identifier: MIT
"""Speed against error: skins, rebuild rules and precision; and what choices inside the library cost."""

import statistics

from ..record import Measurement, Plot, Result, Table

NAME = "error"
TITLE = "Speed against error"
HOSTS = ()
UNIT = "ns/atom/step"


def run(suite):
    words = [suite.program("benchmarks", "error", "dch_bench_error"), "--processor", suite.processor,
             "--cells", suite.pick(tiny=5, quick=8, full=20), "--steps", suite.pick(tiny=40, quick=300, full=2000),
             "--melt-steps", suite.pick(tiny=100, quick=300, full=1000),
             "--skins", suite.pick(tiny="0.2,0.4", quick="0.1,0.3,0.6", full="0.1,0.2,0.3,0.4,0.5,0.6,0.7,0.8"),
             "--rules", suite.pick(tiny="certified,every:20", quick="certified,every:10,every:20,openmm",
                                   full="certified,every:5,every:10,every:20,every:40,openmm"),
             "--check-every", suite.pick(tiny=2, quick=5, full=5),
             "--configurations", suite.pick(tiny=2, quick=10, full=40),
             "--repetitions", suite.pick(tiny=2, quick=5, full=5)]
    report = suite.run_for_json(words)
    result = Result(seed=report["seed"], list_hash={"first configuration": report["list_hash"]},
                    checked="Pairs within the cutoff were compared with those of a cell list every "
                            f"{report['check_every']} steps, before anything was timed: the certified rule missed none.")
    for trial in report["trials"]:
        certified = next(t for t in report["trials"] if t["rule"] == "certified" and t["skin"] == trial["skin"]
                         and t["precision"] == "double")
        against = {} if trial is certified else {"baseline": "certified, double",
                                                 "baseline_values": certified["ns_per_atom_and_step"]}
        result.measurements.append(Measurement(f"skin {trial['skin']}", f"{trial['rule']}, {trial['precision']}", UNIT,
                                               trial["ns_per_atom_and_step"], **against))
    result.tables.append(error_table(report))
    result.plots += plots(report["trials"])
    add_switches(report, result)
    return result


def time_of(trial):
    return statistics.median(trial["ns_per_atom_and_step"])


def error_table(report):
    rows = [[t["rule"], t["skin"], t["precision"], time_of(t), t["rebuilds"], t["pairs"], t["missed"], t["missed_by_list"],
             t["force_error"], t["largest_force_error"], t["energy_drift"], t["energy_noise"]] for t in report["trials"]]
    return Table(
        f"Errors over {report['steps']} steps of {report['time_step']}, {report['atoms']} atoms",
        ["rule", "skin", "forces", UNIT, "rebuilds", "pairs looked at", "missed", "missed by an exact list", "force error",
         "largest", "energy drift", "energy noise"], rows,
        "Missed: pairs within the cutoff that are not in the cluster pairs, from which forces come; an exact list of the pairs "
        "within cutoff and skin, made at the same steps, misses more. Force errors are relative to the root mean square of "
        "forces; drift is the slope of the total energy [epsilon/atom/tau], noise the deviation from that line "
        "[epsilon/atom].")


def plots(trials):
    def by_rule(y):
        series = {}
        for t in trials:
            series.setdefault(f"{t['rule']}, {t['precision']}", []).append([time_of(t), y(t)])
        return series
    return [
        Plot("Pairs missed by an exact list, of all within the cutoff", f"time, {UNIT}", "share missed",
             by_rule(lambda t: t["missed_by_list"] / t["pairs"])),
        Plot("Error of forces", f"time, {UNIT}", "relative root mean square", by_rule(lambda t: t["force_error"])),
        Plot("Energy drift", f"time, {UNIT}", "|slope|, epsilon/atom/tau", by_rule(lambda t: abs(t["energy_drift"]))),
    ]


def add_switches(report, result):
    switches = report["switches"]
    if not switches:
        return
    first = switches[0]
    for cost in switches:
        against = {} if cost is first else {"baseline": first["what"], "baseline_values": first["ns_per_atom"]}
        result.measurements.append(Measurement("structures", cost["what"], "ns/atom", cost["ns_per_atom"], **against))
    result.tables.append(Table(
        f"What structures cost, skin {report['switches_skin']}",
        ["structure", "ns/atom", "first list, ns/atom", "bytes/atom", "edges/atom", "levels", "pairs listed/atom", "margin"],
        [[c["what"], statistics.median(c["ns_per_atom"]), c["first"], c["bytes"], c["edges"], c["levels"], c["listed"],
          c["margin"]] for c in switches],
        "The list of every structure was compared with that of a cell list. A superset takes the word of 16-bit integers and "
        "lists pairs up to the margin farther apart; exact lists decide in double what integers leave open."))
