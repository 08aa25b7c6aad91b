# SPDX-License-Identifier: MIT
"""Steps of OpenMM with its own nonbonded force and with ours."""

import glob
import os

from ..record import Measurement, Plot, Result, Table
from ..running import Missing

NAME = "openmm"
TITLE = "Steps of OpenMM"
HOSTS = ("OpenMM",)


def python_of_build(suite):
    """Environment for a script that needs the plugin."""
    package = os.path.join(suite.build, "openmm_plugin", "python")
    if not glob.glob(os.path.join(glob.escape(package), "openmm_dch", "_force*.so")):
        raise Missing("the OpenMM plugin is not in the build: configure with DCH_BUILD_OPENMM=ON and build its targets "
                      "OpenMMDCHReference, OpenMMDCHCPU and dch_openmm_python")
    return {"PYTHONPATH": package, "PYTHONDONTWRITEBYTECODE": "1"}


def run(suite):
    words = ["/usr/bin/python3", suite.script("openmm", "step_times"),
             "--scenes", suite.pick(tiny="lj", quick="lj,water,droplet", full="lj,water,droplet"),
             "--threads", suite.pick(tiny="1", quick="1", full="1,2"),
             "--steps", suite.pick(tiny=2, quick=20, full=100), "--scale", suite.pick(tiny=0.1, quick=0.5, full=1),
             "--repetitions", suite.pick(tiny=2, quick=5, full=5)]
    scenes = suite.run_for_json(words, environment=python_of_build(suite), pinned=suite.size != "full")
    result = Result(seed=1, checked="Energies and forces of both were compared: within 1e-4, forces of their root mean square.")
    for scene in scenes:
        name = f"{scene['scene']}, {scene['atoms']} atoms, {scene['threads']} thread(s)"
        native, ours, rest = (scene[key + "_each_ms"] for key in ("native", "dch", "rest"))
        result.measurements.append(Measurement(name, "without the force", "ms/step", rest))
        result.measurements.append(Measurement(name, "NonbondedForce", "ms/step", native))
        result.measurements.append(Measurement(name, "DCHNonbondedForce", "ms/step", ours, "NonbondedForce", native))
    result.tables.append(Table("Forces of both compared", ["scene", "atoms", "difference of forces, relative"],
                               [[s["scene"], s["atoms"], s["force_error"]] for s in scenes]))
    result.plots.append(Plot("Steps with DCHNonbondedForce over those with NonbondedForce", "time over native", "",
                             {"DCHNonbondedForce": [[m.scene, m.facts()["ratio"]["median"]] for m in result.measurements
                                                    if m.baseline]}, kind="dots"))
    add_contacts(suite, result)
    return result


def add_contacts(suite, result):
    """Steps of a melt with NecklaceContactForce, over those with the same repulsion by CustomNonbondedForce."""
    words = ["/usr/bin/python3", suite.script("openmm", "contact_times"),
             "--beads-per-side", suite.pick(tiny=8, quick=20, full=32), "--threads", suite.pick(tiny="1", quick="1", full="1,2"),
             "--steps", suite.pick(tiny=2, quick=20, full=100), "--repetitions", suite.pick(tiny=2, quick=5, full=5)]
    for one in suite.run_for_json(words, environment=python_of_build(suite), pinned=suite.size != "full"):
        scene = f"contacts of chains, {one['beads']} beads in chains of {one['chain']}, {one['threads']} thread(s)"
        result.measurements += [Measurement(scene, "without the force", "ms/step", one["rest"]),
                                Measurement(scene, "CustomNonbondedForce", "ms/step", one["custom"]),
                                Measurement(scene, "NecklaceContactForce", "ms/step", one["necklace"], "CustomNonbondedForce",
                                            one["custom"])]
