#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The examples of docs/openmm.md, each with the System, Context or Simulation that it takes for granted.

usage: test_manual.py PAGE
"""
import os
import pathlib
import re
import sys
import tempfile
import unittest

import numpy
import openmm
from openmm import app, unit

import dch.openmm
import openmm_dch

BLOCKS = re.findall(r"^```python\n(.*?)^```", pathlib.Path(sys.argv[1]).read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL)
BEADS = 230


def example(word):
    """The parts of the one example with this word in it: what stands before and behind a line of dots, if there is one."""
    block, = (block for block in BLOCKS if word in block)
    return block.split("\n...\n")


def beads():
    """A rod of 200 beads and a ring of 30, bonded, in a wide box."""
    topology = app.Topology()
    system, force, bonds = openmm.System(), openmm.NonbondedForce(), openmm.HarmonicBondForce()
    system.setDefaultPeriodicBoxVectors(*(120 * numpy.eye(3)))
    force.setNonbondedMethod(force.CutoffPeriodic)
    force.setCutoffDistance(1)
    atoms, chain = [], topology.addChain()
    for _ in range(BEADS):
        system.addParticle(50)
        force.addParticle(0, 0.3, 0.5)
        atoms.append(topology.addAtom("B", None, topology.addResidue("B", chain)))
    for a, b in [(k, k + 1) for k in range(199)] + [(200 + k, 200 + (k + 1) % 30) for k in range(30)]:
        bonds.addBond(a, b, 0.5, 1000)
        topology.addBond(atoms[a], atoms[b])
    system.addForce(force)
    system.addForce(bonds)
    angle = 2 * numpy.pi * numpy.arange(30) / 30
    ring = numpy.stack([50 + 2.4 * numpy.cos(angle), 10 + 2.4 * numpy.sin(angle), numpy.full(30, 0.1)], axis=1)
    return system, topology, numpy.concatenate([[[0.5 * k, 10, 0.0] for k in range(200)], ring])


def context_of(system, positions):
    context = openmm.Context(system, openmm.VerletIntegrator(0.001), openmm.Platform.getPlatformByName("CPU"))
    context.setPositions(positions)
    return context


class ManualTest(unittest.TestCase):
    def test_each_example_is_here(self):
        words = ("openmm_dch.enable", "replaceNonbonded", "NecklaceContactForce", "ContextPairs", "CrossingReporter", "ContactReporter")
        self.assertEqual([[word for word in words if word in block] for block in BLOCKS], [[word] for word in words])

    def test_the_drop_in(self):
        system, _, positions = beads()
        self.addCleanup(openmm_dch.disable)
        for part in example("openmm_dch.enable"):
            exec(part, {})
        self.assertEqual(openmm_dch.status(context_of(system, positions))[0]["direct"], "DCH")

    def test_a_force_that_is_replaced(self):
        system, _, positions = beads()
        for part in example("replaceNonbonded"):
            exec(part, {"system": system})
        self.assertFalse([force for force in system.getForces() if isinstance(force, openmm.NonbondedForce)])
        self.assertEqual(system.getNumForces(), 2)
        context = context_of(system, positions)
        context.getIntegrator().step(1)

    def test_contacts_of_chains(self):
        system, _, positions = beads()
        before, behind = example("NecklaceContactForce")
        names = {"openmm_dch": openmm_dch, "numpy": numpy, "unit": unit, "system": system, "ring": range(200, 230)}
        exec(before, names)
        names["context"] = context_of(system, positions)
        exec(behind, names)
        self.assertLess(names["i"], names["j"])  # the ring lies across the rod

    def test_pairs_of_a_context(self):
        system, _, positions = beads()
        names = {"unit": unit, "context": context_of(system, positions)}
        for part in example("ContextPairs"):
            exec(part, names)
            names["context"].getIntegrator().step(2)
        self.assertEqual(len(names["i"]), len(names["S"]))
        self.assertGreater(len(names["i"]), 0)

    def run_reporter(self, name, *files):
        system, topology, positions = beads()
        simulation = app.Simulation(topology, system, openmm.VerletIntegrator(0.001), openmm.Platform.getPlatformByName("CPU"))
        simulation.context.setPositions(positions)
        program, = example(name)
        self.assertEqual(program.count("100000"), 1)
        with tempfile.TemporaryDirectory() as folder:
            here = os.getcwd()
            self.addCleanup(os.chdir, here)
            os.chdir(folder)
            exec(program.replace("100000", "20").replace("1000,", "10,"), {"unit": unit, "simulation": simulation, "dch": dch})
            for file in files:
                self.assertGreater(pathlib.Path(file).stat().st_size, 0)
            os.chdir(here)

    def test_a_reporter_of_crossings(self):
        self.run_reporter("CrossingReporter", "crossings.csv")

    def test_a_reporter_of_contacts(self):
        self.run_reporter("ContactReporter", "contacts.csv", "contacts.cool")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
