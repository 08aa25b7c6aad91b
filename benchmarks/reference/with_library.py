# SPDX-License-Identifier: MIT
"""The library itself, by the program dch_reference_forces."""

import dataclasses
import json
import os
import tempfile

import numpy as np

import all_pairs
import program

UNITS = "those of the configuration"


class Library:
    """Runs the program once for each scene; it gives all answers at once."""

    def __init__(self, build):
        self.path = os.path.join(build, "benchmarks", "reference", "dch_reference_forces")
        self.answers = {}

    def answer(self, scene, name):
        if scene.name not in self.answers:
            self.answers[scene.name] = self.compute(scene)
        return self.answers[scene.name][name]

    def compute(self, scene):
        if not os.path.exists(self.path):
            raise program.Missing("dch_reference_forces is not in the build (DCH_BUILD_BENCHMARKS)")
        request = {"positions": scene.positions.tolist(), "vectors": scene.vectors.tolist(), "cutoff": scene.cutoff,
                   "kind": scene.kind.tolist(), "kinds": [dataclasses.asdict(kind) for kind in scene.kinds],
                   "atoms_per_molecule": scene.atoms_per_molecule}
        if scene.charged:
            request.update(field=scene.field(), constant=all_pairs.CODATA_2018)
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, "scene.json"), "w", encoding="utf-8") as file:
                json.dump(request, file)
            program.run([self.path, "scene.json", "answers.json"], folder)
            with open(os.path.join(folder, "answers.json"), encoding="utf-8") as file:
                return {a["name"]: all_pairs.Answer(np.array(a["forces"]), a["energy"]) for a in json.load(file)}


def programs(build):
    library = Library(os.path.abspath(build))
    return [program.Program(f"dch, {name}", lambda scene, name=name: library.answer(scene, name), UNITS,
                            all_pairs.CODATA_2018, precision)
            for name, precision in (("neighbor list, plain loop", program.DOUBLE), ("cluster pairs, double", program.DOUBLE),
                                    ("cluster pairs, mixed", program.MIXED))]
