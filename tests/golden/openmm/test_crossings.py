#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The reporters of dch.openmm in simulations of soft chains, which go through each other: crossings against the roots of all
pairs' cubics, contacts against those of the frames."""

import io
import os
import tempfile
import unittest
import warnings

import numpy as np
import openmm
from openmm import app, unit

import dch
from crossing_roots import CHAIN, all_crossings, at, bonds_of_chains, random_chains
from dch.openmm import ContactReporter, CrossingReporter

EVERY, BOX = 10, 6.0


class Recorder:
    """Keeps all frames, as they are."""

    def __init__(self):
        self.frames = []

    def describeNextReport(self, simulation):
        return EVERY - simulation.currentStep % EVERY, True, False, False, False, False

    def report(self, _simulation, state):
        self.frames.append(state.getPositions(asNumpy=True).value_in_unit(unit.nanometer))


def soft_chains(is_periodic):
    """A Simulation of six chains of twelve beads that repel each other softly."""
    positions = random_chains(3, 6, 1, 0)[0]
    system, topology = openmm.System(), app.Topology()
    system.setDefaultPeriodicBoxVectors(*np.eye(3) * BOX)
    bonds = openmm.HarmonicBondForce()
    soft = openmm.CustomNonbondedForce("5 * (1 + cos(3.14159265 * r))")
    soft.setNonbondedMethod(soft.CutoffPeriodic if is_periodic else soft.CutoffNonPeriodic)
    soft.setCutoffDistance(1)
    bonds.setUsesPeriodicBoundaryConditions(is_periodic)
    chain, atoms = topology.addChain(), []
    for _ in positions:
        system.addParticle(20)
        soft.addParticle([])
        atoms.append(topology.addAtom("C", app.element.carbon, topology.addResidue("BEAD", chain)))
    for a, b in bonds_of_chains(len(positions)):
        bonds.addBond(a, b, 0.9, 500)
        topology.addBond(atoms[a], atoms[b])
    system.addForce(bonds)
    system.addForce(soft)
    integrator = openmm.LangevinMiddleIntegrator(300, 1, 0.01)
    integrator.setRandomNumberSeed(1)
    simulation = app.Simulation(topology, system, integrator, openmm.Platform.getPlatformByName("Reference"))
    simulation.context.setPositions(positions)
    simulation.context.setVelocitiesToTemperature(300, 2)
    return simulation


def begin(simulation, reporter):
    reporter.report(simulation, simulation.context.getState(getPositions=True))


class Reports(unittest.TestCase):
    def run_and_compare(self, is_periodic, bonds):
        simulation, recorder, out = soft_chains(is_periodic), Recorder(), io.StringIO()
        reporter = CrossingReporter(out, EVERY, bonds)
        simulation.reporters += [app.StateDataReporter(io.StringIO(), 7, step=True), recorder, reporter]
        for to_begin_with in (recorder, reporter):
            begin(simulation, to_begin_with)
        simulation.step(300)
        cell = np.eye(3) * BOX if is_periodic else np.empty((0, 3))
        pairs = bonds_of_chains(len(recorder.frames[0]))
        expected = all_crossings(recorder.frames, cell, pairs)
        self.assertGreaterEqual(len(expected), 8)
        self.assertEqual((reporter.crossings, reporter.undetermined, len(recorder.frames)), (len(expected), 0, 31))
        header, *lines = out.getvalue().splitlines()
        self.assertEqual(header, '#"Step","Time (ps)","p1","p2","q1","q2","Sign","X (nm)","Y (nm)","Z (nm)"')
        self.assertEqual(len(lines), len(expected))
        for line, (frame, p, q, time, u, _, sign) in zip(lines, expected):
            step, picoseconds, p1, p2, q1, q2, written_sign, *place = map(float, line.split(","))
            self.assertEqual(((p1, p2), (q1, q2), written_sign), (p, q, sign))
            self.assertAlmostEqual(step, EVERY * (frame - 1 + time), delta=2e-3)
            self.assertAlmostEqual(picoseconds, 0.01 * EVERY * (frame - 1 + time), delta=2e-5)
            ends = at([recorder.frames[frame - 1][list(p)], recorder.frames[frame][list(p)]], time)
            np.testing.assert_allclose(place, (1 - u) * ends[0] + u * ends[1], atol=1e-4)

    def test_soft_chains_in_a_periodic_box(self):
        """Beads are not wrapped, so places are those of the oracle. Bonds are those of the topology."""
        self.run_and_compare(True, None)

    def test_soft_chains_in_open_space(self):
        """OpenMM has a box then too, which means nothing."""
        self.run_and_compare(False, np.array(bonds_of_chains(6 * CHAIN)))

    def test_files_units_and_contacts(self):
        simulation = soft_chains(True)
        with tempfile.TemporaryDirectory() as folder:
            name = os.path.join(folder, "crossings.csv")
            thin, thick = CrossingReporter(None, EVERY), CrossingReporter(name, EVERY, thickness=2 * unit.angstrom)
            simulation.reporters += [thin, thick]
            simulation.step(100)
            self.assertEqual(thin.crossings, thick.crossings)
            self.assertGreater(thick.contacts, thin.contacts)
            self.assertEqual(thick.found.frame, 9)
            with open(name) as file:
                self.assertEqual(len(file.readlines()), 1 + thick.crossings)

    def test_a_state_that_is_loaded_begins_anew(self):
        simulation = soft_chains(True)
        reporter = CrossingReporter(None, EVERY)
        simulation.reporters.append(reporter)
        simulation.step(20)
        simulation.currentStep = 0
        simulation.context.setPositions(np.roll(random_chains(3, 6, 1, 0)[0], CHAIN, axis=0))  # chains change their places
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            simulation.step(10)
        self.assertIsNone(reporter.found)
        simulation.step(10)
        self.assertEqual(reporter.found.frame, 1)


class Contacts(unittest.TestCase):
    def test_contacts_are_those_of_the_frames(self):
        for is_periodic, bonds, gap in ((True, None, 5 * unit.angstrom), (False, np.array(bonds_of_chains(6 * CHAIN)), 0.5)):
            simulation, recorder, out = soft_chains(is_periodic), Recorder(), io.StringIO()
            reporter = ContactReporter(out, EVERY, gap, radius=0.1, bonds=bonds, skip_bonds=2)
            simulation.reporters += [recorder, reporter]
            simulation.step(100)
            chains = dch.Chains.from_bonds(6 * CHAIN, bonds_of_chains(6 * CHAIN))
            before, lines = set(), []
            for k, frame in enumerate(recorder.frames, start=1):
                found = dch.contacts(chains, frame, np.eye(3) * BOX if is_periodic else None, gap=0.5, radius=0.1, skip_bonds=2)
                now = set(zip(found.i.tolist(), found.j.tolist()))
                lines.append(f"{k * EVERY},{0.01 * k * EVERY:.9g},{len(now)},{len(now - before)},{len(before - now)}")
                before = now
            self.assertGreater(len(before), 0)
            self.assertEqual(out.getvalue().splitlines(), ['#"Step","Time (ps)","Contacts","Began","Ended"', *lines])
            self.assertEqual((reporter.map.frames, len(reporter.found.i)), (10, len(before)))

    def test_what_is_refused(self):
        for options in ({"gap": np.nan}, {"gap": 1, "bonds": [[0, 0.5]]}, {"gap": 1, "skip_bonds": -1}, {"gap": 1, "max_bins": 0}):
            with self.assertRaises(dch.InvalidParameter):
                ContactReporter(None, EVERY, **options)
        simulation = soft_chains(True)
        simulation.topology = app.Topology()
        with self.assertRaisesRegex(dch.InvalidParameter, "give the reporter those of the chains"):
            begin(simulation, ContactReporter(None, EVERY, 0.5))


class Refused(unittest.TestCase):
    def test_a_jump_is_undetermined(self):
        simulation = soft_chains(True)
        reporter = CrossingReporter(None, 1)
        begin(simulation, reporter)
        positions = simulation.context.getState(getPositions=True).getPositions(asNumpy=True)._value.copy()
        simulation.reporters.append(reporter)
        for _ in range(2):
            positions[5] += [0, 2.9, 0.9]
            simulation.context.setPositions(positions)
            simulation.context.setVelocities(0 * positions)
            with warnings.catch_warnings(record=True) as warned:
                warnings.simplefilter("always")
                simulation.step(1)
            if reporter.undetermined == 2:
                self.assertRegex(str(warned[0].message), "2 bonds at step 1: the bond of the particles 4 and 5 has moved half")
        self.assertEqual(warned, [])  # once is enough
        self.assertGreaterEqual(reporter.undetermined, 4)

    def test_arguments(self):
        for arguments, message in (((0,), "reportInterval is 0"), ((1.5,), "reportInterval is 1.5"), ((1, [[0, 0]]), "with itself"),
                                   ((1, [[0, 1], [1, 0]]), "given twice"), ((1, [[0, 0.5]]), "whole numbers"),
                                   ((1, None, -1 * unit.nanometer), "thickness is -1")):
            with self.assertRaisesRegex(dch.InvalidParameter, message):
                CrossingReporter(None, *arguments)
        simulation = soft_chains(True)
        with self.assertRaisesRegex(dch.InvalidParameter, "outside 0..72"):
            begin(simulation, CrossingReporter(None, 1, [[0, 72]]))
        simulation.topology = app.Topology()
        with self.assertRaisesRegex(dch.InvalidParameter, "no bonds"):
            begin(simulation, CrossingReporter(None, 1))


if __name__ == "__main__":
    unittest.main()
