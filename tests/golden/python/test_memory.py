#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""MemoryError before memory is taken: in processes that may have a little more than they have now (ulimit -v)."""
import subprocess
import sys
import unittest

SCENES = """
import resource
import numpy as np
import dch

ROOM = 500 << 20

def limit():
    pages = int(open("/proc/self/statm").read().split()[0])
    resource.setrlimit(resource.RLIMIT_AS, (pages * resource.getpagesize() + ROOM,) * 2)

spot = np.zeros((100000, 3))
spread = np.random.default_rng(1).random((100000, 3)) * 60
rope = dch.Chains(100000, [range(100000)])
"""


def message(setup, call):
    """Of the MemoryError that the call raises when there is little memory."""
    code = f"{SCENES}\n{setup}\nlimit()\ntry:\n    {call}\nexcept MemoryError as error:\n    print(error)\n"
    done = subprocess.run([sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    assert done.returncode == 0, done.stdout
    return done.stdout


class Refused(unittest.TestCase):
    """Each names about how many bytes are wanted, how many are free, and the remedy."""

    def check(self, what, remedy, setup, call):
        found = message(setup, call)
        self.assertRegex(found, rf"^about [\d.e+]+ {what} take [\d.e+]+ bytes, and [\d.e+]+ are free; .*{remedy}")
        free = float(found.split(", and ")[1].split()[0])
        self.assertTrue(1e8 < free < 600e6, found)

    def test_a_hierarchy(self):
        self.check("points", "fewer points", "many = np.zeros((4000000, 3)); hierarchy = dch.Hierarchy(1)", "hierarchy.update(many)")
        self.check("edges", "smaller radius", "hierarchy = dch.Hierarchy(1); hierarchy.update(spot)", "hierarchy.level(0)")
        self.check("edges", "smaller radius", "hierarchy = dch.Hierarchy(25, threads=2); hierarchy.update(spread)", "hierarchy.level(0)")

    def test_edges_that_a_sample_does_not_see(self):
        setup = "spread[50:30050] = 0; hierarchy = dch.Hierarchy(1); hierarchy.update(spread)"
        self.check("edges", "smaller radius", setup.replace("spread[50:30050]", "spread[12501:24999]"), "hierarchy.level(0)")

    def test_contacts(self):
        self.check("contacts", "smaller gap", "", "dch.contacts(rope, spot, gap=1)")
        self.check("contacts", "smaller gap", "", "dch.contacts(rope, spot, gap=0)")
        self.check("contacts", "smaller radii", "", "dch.contacts(rope, spread, [60] * 3, gap=-1, radius=10)")
        self.check("contacts", "smaller radii", "", "dch.contacts(rope, spread, gap=2, radius=np.linspace(5, 15, 100000))")
        self.check("beads", "fewer chains", "rope = dch.Chains(4000000, [range(4000000)])", "dch.ContactFinder(rope, gap=1)")

    def test_a_contact_map(self):
        self.check("entries", "fewer bins", "", "dch.ContactMap(rope, max_bins=2**14)")
        self.check("entries", "fewer bins", "m = dch.ContactMap(rope, max_bins=9000)", "m.contacts")
        many = "found = np.arange(10000000, dtype=np.int32) % 100000; m = dch.ContactMap(rope)"
        self.check("contacts", "smaller gap", many, "m.add(dch.Contacts(found, found[::-1], None, None, None))")

    def test_lists(self):
        self.check("pairs", "smaller cutoff", "search = dch.NeighborSearch(1); search.update(spot)", "search.csr()")
        self.assertRegex(message("verlet = dch.VerletList(1, 0.1)", "verlet.update(spot)"), "pairs are expected.*smaller")


class Allowed(unittest.TestCase):
    """What fits is found, with the same little memory."""

    def test_all_of_them(self):
        calls = ("hierarchy = dch.Hierarchy(1.5); hierarchy.update(spread); print(len(hierarchy.level(0).edges) > 100000); "
                 "found = dch.contacts(rope, spread, gap=0.5, radius=0.5); print(len(found.i) > 100000); "
                 "m = dch.ContactMap(rope); m.add(found); print(m.contacts.sum() >= len(found.i))")
        self.assertEqual(message("", calls), "True\nTrue\nTrue\n")


if __name__ == "__main__":
    unittest.main()
