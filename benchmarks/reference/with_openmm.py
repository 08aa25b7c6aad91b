# SPDX-License-Identifier: MIT
"""OpenMM: its own NonbondedForce and our DCHNonbondedForce, on the platforms Reference and CPU."""

import numpy as np

import all_pairs
import program

UNITS = "nm and kJ/mol, as given"


def nonbonded(openmm, scene):
    force = openmm.NonbondedForce()
    for what in zip(scene.of_atoms("charge"), scene.of_atoms("sigma"), scene.of_atoms("epsilon")):
        force.addParticle(*map(float, what))
    for first in range(0, len(scene.positions), scene.atoms_per_molecule):
        for a in range(first, first + scene.atoms_per_molecule):
            for b in range(first, a):
                force.addException(b, a, 0, 1, 0)
    force.setNonbondedMethod(force.CutoffPeriodic)
    force.setCutoffDistance(float(scene.cutoff))
    force.setReactionFieldDielectric(float(scene.dielectric) or 1.0)
    force.setUseDispersionCorrection(False)
    return force


def compute(scene, platform, ours):
    try:
        import openmm
    except ImportError as error:
        raise program.Missing("openmm is missing; install the Debian package python3-simtk") from error
    force = nonbonded(openmm, scene)
    if ours:
        try:
            import openmm_dch
        except ImportError as error:
            raise program.Missing("openmm_dch is missing; put openmm_plugin/python of the build on PYTHONPATH") from error
        force = openmm_dch.DCHNonbondedForce.fromNonbonded(force)
    system = openmm.System()
    system.setDefaultPeriodicBoxVectors(*scene.vectors)
    for mass in scene.of_atoms("mass"):
        system.addParticle(float(mass))
    system.addForce(force)
    context = openmm.Context(system, openmm.VerletIntegrator(0.001), openmm.Platform.getPlatformByName(platform),
                             {"Threads": "1"} if platform == "CPU" else {})
    context.setPositions(scene.positions)
    state = context.getState(getEnergy=True, getForces=True)
    return all_pairs.Answer(np.array(state.getForces(asNumpy=True)._value), state.getPotentialEnergy()._value)


def programs():
    def on(platform, ours):
        return lambda scene: compute(scene, platform, ours)

    return [program.Program("OpenMM Reference, NonbondedForce", on("Reference", False), UNITS, all_pairs.CODATA_2018,
                            program.DOUBLE),
            program.Program("OpenMM CPU, NonbondedForce", on("CPU", False), UNITS, all_pairs.CODATA_2018, program.SINGLE),
            program.Program("OpenMM Reference, DCHNonbondedForce", on("Reference", True), UNITS, all_pairs.CODATA_2018,
                            program.DOUBLE),
            program.Program("OpenMM CPU, DCHNonbondedForce", on("CPU", True), UNITS, all_pairs.CODATA_2018, program.MIXED)]
