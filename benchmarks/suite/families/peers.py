# SPDX-License-Identifier: MIT
"""Lists of other programs on the configurations of the table of scenes, ours taking turns with them."""

from ..record import Measurement, Plot, Result
from ..running import Missing

NAME = "peers"
TITLE = "Lists of other programs"
HOSTS = ("LAMMPS", "GROMACS", "OpenMM", "SciPy", "nanoflann")
MISSING_STATUS = 2  # of the scripts in benchmarks/engine/peers
UNIT = "ns/particle"


# In-process peers are programs of the build, the others scripts.
PROGRAMS = {"openmm": "dch_bench_openmm", "gromacs_search": "dch_bench_gromacs_search", "nanoflann": "dch_bench_nanoflann"}
CHECKED = ("Lists were compared before anything was timed: those of nanoflann and SciPy have the same pairs; OpenMM's and "
           "AnalysisNeighborhood's too, but for rounding to float at the very radius (1 in 100,000); LAMMPS prints as many pairs "
           "at step 0, and in process its lists are compared pair by pair. The pair search of mdrun shows its list to nobody.")


def plans(suite):
    """Peer, scene and arguments of each comparison."""
    if suite.size == "tiny":
        return [("scipy", "melt32k", ["--scale", "0.1"]), ("lammps", "clusters", ["--scale", "0.1", "--search", "multi"])]
    melts = suite.pick(quick=["melt32k"], full=["melt32k", "melt256k", "melt1m"])
    found = [("lammps", melt, []) for melt in melts]
    found += [("lammps_in_process", "melt32k", [])]
    found += [("lammps", "melt4k", ["--search", "nsq", "--steps", "50"]),
              ("lammps", "chain32k", ["--binsize", "1.52"]), ("lammps", "sizes1:10", ["--search", "multi"]),
              ("lammps", "hotgas", []), ("lammps", "droplet+gas", [])]
    if suite.size == "full":
        found += [("lammps", "melt32k", ["--search", "multi"]), ("lammps", "chain32k", []), ("lammps", "sizes1:10", []),
                  ("lammps", "clusters", []), ("lammps_in_process", "chain32k", []),
                  ("lammps", "sizes1:50", ["--search", "multi"]), ("lammps", "swollen", []), ("lammps", "glass", [])]
    found += [("gromacs", "water30k", [])]
    for peer in ("openmm", "gromacs_search"):
        found += [(peer, scene, []) for scene in [*melts, *suite.pick(quick=[], full=["water30k"])]]
    trees = suite.pick(quick=["melt32k", "clusters"],
                       full=["melt32k", "melt256k", "chain32k", "water30k", "droplet+gas", "clusters", "swollen", "hotgas"])
    return found + [(peer, scene, []) for peer in ("nanoflann", "scipy") for scene in trees]


def compare(suite, peer, scene, extra):
    """What the peer's program has written."""
    words = [*([] if peer == "gromacs" else [scene]), *extra, "--trajectories", suite.trajectories,
             "--repetitions", suite.pick(tiny=2, quick=5, full=5), "--processor", suite.processor,
             "--lists", suite.pick(tiny=2, quick=20, full=100 if peer in ("lammps", "gromacs", "scipy") else 20)]
    if peer in ("lammps", "lammps_in_process", "gromacs") and suite.size == "quick" and "--steps" not in extra:
        words += ["--steps", 50]
    if peer in PROGRAMS:
        if suite.needs_trajectory(scene):
            raise Missing(f"make_trajectories {scene} makes its configurations")
        return suite.run_for_json([suite.program("benchmarks", "engine", PROGRAMS[peer]), *words])
    if peer == "lammps_in_process":
        words += ["--build", suite.build]
    else:
        words += ["--beside", suite.program("benchmarks", "engine", "dch_bench_table")]
    return suite.run_for_json([suite.script("engine", "peers", peer), *words], pinned=False, missing_status=MISSING_STATUS)


def run(suite):
    result = Result(checked=CHECKED)
    ratios = {}
    for peer, scene, extra in plans(suite):
        try:
            report = compare(suite, peer, scene, extra)
        except Missing as error:
            result.left_out.append(f"{peer} on {scene}: {str(error).splitlines()[-1]}")
            continue
        theirs = Measurement(report["scene"], report["peer"], UNIT, report["theirs"])
        ours = Measurement(report["scene"], f"dch beside {report['peer']}", UNIT, report["ours"], report["peer"],
                           report["theirs"])
        result.measurements += [theirs, ours]
        if "more" in report:
            result.measurements.append(Measurement(report["scene"], f"{report['more']['name']}, beside {report['peer']}", UNIT,
                                                   report["more"]["ns"], report["peer"], report["theirs"]))
        ratios.setdefault(report["peer"].split(", bins")[0], []).append([report["scene"], ours.facts()["ratio"]["median"]])
    if not result.measurements:
        raise Missing("; ".join(result.left_out))
    result.plots.append(Plot("Repair and list of dch over the list of others", "time of dch over theirs", "", ratios,
                             kind="dots"))
    return result
