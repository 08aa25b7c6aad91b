#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""dch.Crossings against the roots of all pairs' cubics; bonds that come and go, what is undetermined, what is refused."""
import os
import threading
import unittest

import numpy as np

import dch
from crossing_roots import BOXES, at, all_crossings, bonds_of_chains, random_chains, wrapped

P, Q = [[-1.0, 0, 0], [1, 0, 0]], [[0.0, -1, 1], [0, 1, 1]]
APART, BELOW = P + Q, P + [[0.0, -1, -3], [0, 1, -3]]
BONDS = [[0, 1], [2, 3]]


def rows(step):
    """Events as all_crossings() has them."""
    found = step.crossings
    return [(step.frame, tuple(p), tuple(q), time, *along, sign)
            for p, q, time, along, sign in zip(found.p, found.q, found.time, found.along, found.sign)]


def started(*arguments, **keywords):
    crossings = dch.Crossings(*arguments, **keywords)
    crossings.start(APART)
    return crossings


class Events(unittest.TestCase):
    def follow(self, frames, cell, bonds, threads):
        """Wrapped frames. Places have to be on the first bond at that time, as an image."""
        found = []
        crossings = dch.Crossings(len(frames[0]), bonds, threads=threads)
        inside = [wrapped(frame, cell) for frame in frames]
        crossings.start(inside[0], cell if len(cell) else None)
        for frame in inside[1:]:
            step = crossings.step(frame, cell if len(cell) else None)
            self.assertEqual((len(step.undetermined.bonds), step.started), (0, 0))
            for (number, p, _, time, u, _, _), place in zip(rows(step), step.crossings.place):
                ends = at([frames[number - 1][list(p)], frames[number][list(p)]], time)
                off = place - ((1 - u) * ends[0] + u * ends[1])
                shift = np.rint(off @ np.linalg.inv(cell)) @ cell if len(cell) else 0
                np.testing.assert_allclose(off, shift, atol=1e-5)
            found += rows(step)
        return found

    def test_random_chains_in_boxes(self):
        for seed, (name, (_, cell)) in enumerate(BOXES.items()):
            frames = random_chains(seed, 6, 4, 0.3)
            bonds = bonds_of_chains(len(frames[0]))
            expected = all_crossings(frames, cell, bonds)
            self.assertGreater(len(expected), 0)
            found = self.follow(frames, cell, bonds, 1)
            self.assertEqual([event[:3] for event in found], [event[:3] for event in expected], name)
            np.testing.assert_allclose([event[3:] for event in found], [event[3:] for event in expected], atol=1e-4)
            self.assertEqual(self.follow(frames, cell, bonds, 3), found)

    def test_contacts_and_starting_anew(self):
        crossings = started(4, BONDS, thickness=0.5)
        step = crossings.step(P + [[0.0, -1, 0.4], [0, 1, 0.4]])
        self.assertEqual((len(step.crossings.time), step.contacts.p.tolist(), step.contacts.q.tolist()), (0, [[0, 1]], [[2, 3]]))
        self.assertAlmostEqual(step.contacts.distance[0], 0.5, places=5)
        self.assertAlmostEqual(step.contacts.time[0], 0.5 / 0.6, places=5)
        crossings.start(BELOW)  # a gap: nothing is said of it
        self.assertEqual(crossings.step(BELOW).frame, 1)
        self.assertEqual(crossings.step(APART).crossings.sign.tolist(), [-1])

    def test_bonds_that_are_made_and_broken(self):
        crossings = started(4, [[0, 1]])
        crossings.bonds = BONDS
        step = crossings.step(BELOW)
        self.assertEqual((len(step.crossings.time), step.started), (0, 1))
        step = crossings.step(APART)
        self.assertEqual((len(step.crossings.time), step.started, crossings.bonds.tolist()), (1, 0, BONDS))
        crossings.bonds = []
        self.assertEqual(len(crossings.step(BELOW).crossings.time), 0)

    def test_branched_molecules_have_no_sign(self):
        star = [[4, 0], [0, 1], [0, 5], [2, 3]]
        more = [[-2.0, 0, 1], [-2, 0, -1]]
        crossings = dch.Crossings(6, star)
        crossings.start(APART + more)
        found = crossings.step(BELOW + more).crossings
        self.assertEqual((found.p.tolist(), found.q.tolist(), found.sign.tolist()), ([[2, 3]], [[0, 1]], [0]))

    def test_undetermined(self):
        """Of the first bond a particle moves half the box, the second is as long."""
        crossings = dch.Crossings(6, [[0, 1], [2, 3], [4, 5]])
        before = np.array([[1.0, 1, 1], [2, 1, 1], [3, 3, 3], [4, 3, 3], [5, 6, 6], [6, 6, 6]])
        after = before + [[0, 0, 0], [0, 4.9, 1.4], [0, 0, 0], [0, 0, 0], [-2.2, -2.2, 0], [2.2, 2.2, 0]]
        crossings.start(before, [10, 10, 10])
        step = crossings.step(after, [10, 10, 10])
        self.assertEqual(step.undetermined.bonds.tolist(), [[0, 1], [4, 5]])
        self.assertEqual(step.undetermined.too_long.tolist(), [False, True])


class Refused(unittest.TestCase):
    def refuse(self, message, call, error=dch.InvalidParameter):
        with self.assertRaisesRegex(error, message):
            call()

    def test_bonds_and_numbers(self):
        for bonds, message in (([[0, 4]], "outside 0..4"), ([[0, -1]], "index -1"), ([[0, 2**31]], "index 2147483648"),
                               ([[1, 1]], "with itself"), ([[0, 1], [1, 0]], "given twice"), ([0, 1, 2], r"shape \(3,\)"),
                               ([[0, 1, 2]], r"shape \(1, 3\)"), ([[0.0, 1.5]], "float64"), ([["a", "b"]], "whole numbers")):
            self.refuse(message, lambda wrong=bonds: dch.Crossings(4, wrong))
            crossings = started(4, BONDS)
            with self.assertRaises(dch.InvalidParameter):
                crossings.bonds = bonds
            self.assertEqual(len(crossings.step(BELOW).crossings.time), 1)  # they are as they were
        for particles in (-1, 1.5, None, 2**31):
            self.refuse("particles", lambda wrong=particles: dch.Crossings(wrong, []))
        for thickness in (-1, np.nan, np.inf, "thick"):
            self.refuse("thickness", lambda wrong=thickness: dch.Crossings(4, BONDS, wrong))
        self.refuse("threads", lambda: dch.Crossings(4, BONDS, threads=0))

    def test_frames(self):
        """After an error there is nothing to step from."""
        self.refuse("call start", lambda: dch.Crossings(4, BONDS).step(APART))
        other = np.array(APART)
        other[2, 1] = np.nan
        for positions, cell, message in ((APART[:3], None, "3 positions for 4 particles"), (other, None, "finite|nan"),
                                         (APART, [9, 9, 9], "periodic vectors have to stay"), (np.zeros((4, 2)), None, "shape"),
                                         (APART, np.zeros((3, 3)), "")):
            crossings = started(4, BONDS)
            self.refuse(message, lambda: crossings.step(positions, cell))
            crossings.start(APART)
            self.assertEqual(crossings.step(BELOW).frame, 1)
        self.refuse("5 positions", lambda: dch.Crossings(4, BONDS).start(APART + [[0, 0, 0]]))

    def test_a_second_thread(self):
        frames = random_chains(1, 400, 2, 0.3)
        crossings = dch.Crossings(len(frames[0]), bonds_of_chains(len(frames[0])))
        refused = []

        def call_until_refused(call):
            for _ in range(10000):
                if refused:
                    return
                try:
                    call(frames[1])
                except RuntimeError as error:
                    refused.append(str(error))

        crossings.start(frames[0])
        thread = threading.Thread(target=call_until_refused, args=[crossings.start])
        thread.start()
        call_until_refused(crossings.step)
        thread.join()
        self.assertTrue(refused, "10,000 calls from each of two threads, and none at the same time")
        self.assertRegex(refused[0], "another thread is using this Crossings")

    def test_a_forked_process_has_threads_of_its_own(self):
        crossings = started(4, BONDS, threads=2)
        child = os.fork()
        if child == 0:
            os._exit(len(crossings.step(BELOW).crossings.time))
        self.assertEqual(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), 1)


if __name__ == "__main__":
    unittest.main()
