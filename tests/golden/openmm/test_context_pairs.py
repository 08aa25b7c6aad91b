#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""dch.openmm.ContextPairs along simulations, against all pairs and all images in numpy."""

import itertools
import unittest

import numpy as np
import openmm
from openmm import unit

import dch
from dch.openmm import ContextPairs

COUNT = 120


def fluid(box, cutoff=0.6):
    """Argon, hot, in a box of three vectors or in open space; its Context and integrator."""
    system, force = openmm.System(), openmm.NonbondedForce()
    edge = np.eye(3) * 2.0 if box is None else np.array(box)
    for _ in range(COUNT):
        system.addParticle(40)
        force.addParticle(0, 0.2, 0.5)
    force.setNonbondedMethod(force.CutoffNonPeriodic if box is None else force.CutoffPeriodic)
    force.setCutoffDistance(cutoff)
    system.setDefaultPeriodicBoxVectors(*edge)
    system.addForce(force)
    integrator = openmm.VerletIntegrator(0.002)
    context = openmm.Context(system, integrator, openmm.Platform.getPlatformByName("Reference"))
    grid = np.array(list(itertools.product(range(5), range(5), range(5))))[:COUNT]
    context.setPositions((grid + 0.3 * np.random.default_rng(1).random(grid.shape)) / 5 @ edge)
    context.setVelocitiesToTemperature(600, 2)
    return context, integrator


def state_of(context):
    state = context.getState(getPositions=True)
    cell = state.getPeriodicBoxVectors(asNumpy=True).value_in_unit(unit.nanometer)
    return state.getPositions(asNumpy=True).value_in_unit(unit.nanometer), np.array(cell)


def all_pairs(positions, cell, cutoff):
    """(i, j, S) of all pairs and images within the cutoff; the cell may be None."""
    found = set()
    images = [(0, 0, 0)] if cell is None else itertools.product(range(-2, 3), repeat=3)
    for shift in images:
        moved = positions if cell is None else positions + np.array(shift) @ cell
        apart = np.linalg.norm(moved[None, :, :] - positions[:, None, :], axis=2)
        for i, j in zip(*np.nonzero(apart <= cutoff)):
            if i != j or shift != (0, 0, 0):
                found.add((int(i), int(j), *shift))
    return found


class ContextPairsTest(unittest.TestCase):
    BOXES = {"open": None, "cube": np.eye(3) * 2, "skewed": [[2.1, 0, 0], [0.7, 2.0, 0], [-0.6, 0.5, 1.9]]}

    def test_every_step(self):
        for name, box in self.BOXES.items():
            for cutoff in (0.5, 1.3):  # the latter more than half the box
                with self.subTest(box=name, cutoff=cutoff):
                    context, integrator = fluid(box)
                    pairs = ContextPairs(context, cutoff * unit.nanometer, 1.0 * unit.angstrom)
                    for _ in range(10):
                        i, j, D, S = pairs.pairs()
                        positions, cell = state_of(context)
                        self.assertEqual(set(zip(i.tolist(), j.tolist(), *S.T.tolist())),
                                         all_pairs(positions, None if box is None else cell, cutoff))
                        np.testing.assert_allclose(D, positions[j] - positions[i] + S @ cell, atol=1e-12)
                        integrator.step(4)
                    self.assertGreater(pairs.rebuilds, 1)
                    self.assertLess(pairs.rebuilds, 10)

    def test_a_box_that_changes(self):
        context, _ = fluid(self.BOXES["skewed"])
        pairs = ContextPairs(context, 0.5)
        for scale in (1, 1.003, 0.98, 1.2):
            positions, _ = state_of(context)
            context.setPeriodicBoxVectors(*(np.array(self.BOXES["skewed"]) * scale))
            context.setPositions(positions * 1.001)
            i, j, S = pairs.pairs("ijS")
            self.assertEqual(set(zip(i.tolist(), j.tolist(), *S.T.tolist())), all_pairs(*state_of(context), 0.5))

    def test_half_and_excluded(self):
        context, _ = fluid(self.BOXES["cube"])
        i, j = ContextPairs(context, 0.5, half=True, exclusions=[[0, 1]]).pairs("ij")
        every = {(a, b) for a, b, *_ in all_pairs(*state_of(context), 0.5)}
        self.assertIn((0, 1), every)
        self.assertEqual(sorted((min(p), max(p)) for p in zip(i.tolist(), j.tolist())),
                         sorted(p for p in every if p[0] < p[1] and p != (0, 1)))

    def test_bad_input(self):
        context, _ = fluid(None)
        self.assertRaisesRegex(dch.InvalidParameter, "cutoff", ContextPairs, context, -1)
        self.assertRaisesRegex(dch.InvalidParameter, "skin", ContextPairs, context, 1, -1 * unit.nanometer)
        self.assertRaises(TypeError, ContextPairs, context, 1 * unit.kelvin)
        pairs = ContextPairs(context, 0.5)
        self.assertRaisesRegex(dch.InvalidParameter, "'x'", pairs.pairs, "ijx")
        positions, _ = state_of(context)
        positions[3, 1] = float("nan")
        context.setPositions(positions)
        self.assertRaises(dch.InvalidPosition, pairs.pairs)
        self.assertIn("0.5", repr(pairs))


if __name__ == "__main__":
    unittest.main()
