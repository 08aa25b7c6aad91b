#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""What the reference counts now, in its smaller scenes, is what docs/kinetic.md and its picture say, and `events` draws it.

    test_events.py PROGRAM
"""

import json
import math
import os
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

HERE = os.path.dirname(os.path.abspath(__file__))
DOCS = os.path.join(HERE, "..", "..", "docs")
TITLE = "{http://www.w3.org/2000/svg}title"
SMALL = "reference_counts/(25|50)$|reference_seeds/(25/.*|50/(0|4)/.*)$"


def titles(drawing):
    """Of all marks: series, place and count."""
    return {title.text for title in xml.etree.ElementTree.fromstring(drawing).iter(TITLE)}


def draw(path):
    return subprocess.run([os.path.join(HERE, "events"), path], capture_output=True, text=True, check=False)


class Events(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.path = os.path.join(cls.folder.name, "counts.json")
        subprocess.run([cls.program, f"--benchmark_filter={SMALL}", "--benchmark_min_time=0.001",
                        f"--benchmark_out={cls.path}", "--benchmark_out_format=json"], stdout=subprocess.DEVNULL, check=True)
        with open(cls.path, encoding="utf-8") as file:
            cls.counts = json.load(file)["benchmarks"]

    def test_the_picture_of_the_docs_shows_these_counts(self):
        now = titles(draw(self.path).stdout)
        self.assertGreater(len(now), 20)
        with open(os.path.join(DOCS, "images", "kinetic-events.svg"), encoding="utf-8") as file:
            self.assertLessEqual(now, titles(file.read()), "draw it anew, as `events` says")

    def test_the_table_of_the_docs_has_these_counts(self):
        with open(os.path.join(DOCS, "kinetic.md"), encoding="utf-8") as file:
            lines = file.read().splitlines()
        rows = [row for row in self.counts if row["name"].startswith("reference_counts/")]
        self.assertEqual(len(rows), 2)
        for row in rows:
            certificates = f"{row['certificates_a_point']:.0f}"
            self.assertIn(f"| {row['name'].split('/')[1]} | {row['events']:,.0f} | {row['external']:,.0f} | "
                          f"{row['over_n2_levels']:.3f} | {certificates} | {row['made_an_event']:.1f} |", lines)

    def test_no_count_is_above_the_bound(self):
        """Each pair that passes each distance of the levels twice, which linear motion allows."""
        for row in self.counts:
            points = int(row["name"].split("/")[1])
            self.assertLessEqual(row["events"], points * (points - 1) * (2 * row["levels"] + 1), row["name"])

    def test_levels_grow_as_lg_alpha(self):
        """Lemma 5.3.1(6), with level 0 at 2.5 R_0."""
        for row in self.counts:
            self.assertLessEqual(row["levels"], math.ceil(row["lg_alpha"] + math.log2(2.5)) + 2, row["name"])

    def test_a_file_without_counts_is_refused(self):
        path = os.path.join(self.folder.name, "empty.json")
        with open(path, "w", encoding="utf-8") as file:
            json.dump({"benchmarks": [{"name": "equal_spheres/500"}]}, file)
        done = draw(path)
        self.assertEqual(done.returncode, 1)
        self.assertIn("holds no counts", done.stderr)


if __name__ == "__main__":
    Events.program = sys.argv.pop(1)
    unittest.main()
