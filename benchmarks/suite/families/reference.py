# SPDX-License-Identifier: MIT
"""Energies and forces of the same configurations by LAMMPS, OpenMM, GROMACS and ours."""

import os

from ..record import Result, Table

NAME = "reference"
TITLE = "Energies and forces beside other programs"
HOSTS = ("LAMMPS", "OpenMM", "GROMACS")
MISSING_STATUS = 2  # of the script


def run(suite):
    words = ["/usr/bin/python3", suite.script("reference", "compare"), "--build", suite.build,
             "--cells", suite.pick(tiny=5, quick=8, full=10), "--tiles", suite.pick(tiny=1, quick=2, full=2)]
    package = os.path.join(suite.build, "openmm_plugin", "python")  # the script says what lacks if it is not there
    report = suite.run_for_json(words, environment={"PYTHONPATH": package, "PYTHONDONTWRITEBYTECODE": "1"},
                                missing_status=MISSING_STATUS)
    return Result(seed=1, left_out=report["left_out"], checked="All rows are within what they are allowed; else the script fails.",
                  tables=[differences(report), programs(report), conventions(report), scenes(report)])


def differences(report):
    rows = [[r["scene"], r["program"], r["rms"], r["largest"], r["energy"],
             " / ".join(f"{r['allowed'][what]:.0e}" for what in ("rms", "largest", "energy")), r["passed"], r["why"]]
            for r in report["rows"]]
    return Table("Differences to all pairs in double precision",
                 ["scene", "program", "forces, rms", "force, largest", "energy", "allowed", "passed", "why"], rows,
                 "Each program is compared with a sum over all pairs, with all images, that takes that program's Coulomb "
                 "constant and its convention for excluded pairs. Differences of forces are over the root mean square of "
                 "forces, those of energies over the energy. All programs are given the same coordinates, whole multiples of "
                 "2^-16 nm, which single precision holds exactly; the cutoff lies in a gap between the distances of pairs, "
                 "for forces jump there.")


def programs(report):
    usual = report["codata_2018"]
    return Table("Units and constants",
                 ["program", "computes in", "Coulomb constant, kJ nm/mol/e^2", "to CODATA 2018, less 1",
                  "reaction field between excluded atoms"],
                 [[p["program"], p["units"], f"{p['constant']:.9f}", p["constant"] / usual - 1, p["field_between_bonded"]]
                  for p in report["programs"]],
                 "Configurations are in nm, kJ/mol, elementary charges and atomic mass units.")


def conventions(report):
    return Table("What other constants and conventions alone change",
                 ["scene", "what", "forces, rms", "force, largest", "energy"],
                 [[c["scene"], c["what"], c["rms"], c["largest"], c["energy"]] for c in report["conventions"]],
                 "By sums over all pairs; without them, programs could not agree better than this.")


def scenes(report):
    return Table("Configurations",
                 ["scene", "atoms", "pairs within the cutoff", "cutoff, nm", "nearest pair to it, nm",
                  "dielectric constant of the reaction field", "energy, kJ/mol a molecule", "rms force, kJ/mol/nm"],
                 [[s["scene"], s["atoms"], s["pairs"], f"{s['cutoff']:.6f}", s["margin"], s["dielectric"] or None,
                   s["energy_per_molecule"], s["rms_force"]] for s in report["scenes"]])
