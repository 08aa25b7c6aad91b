# SPDX-License-Identifier: MIT
"""Tests of what benchmarks/run does besides running programs: figures, records, reports. Run by CTest."""

import os
import sys
import tempfile
import unittest
import xml.etree.ElementTree

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))

from suite import families, html_report, machine, markdown_report, plot, ratios, record, words  # noqa: E402  (the path comes first)
from suite.machine import ROOT  # noqa: E402
from suite.running import Failed, Missing, Suite  # noqa: E402

SVG = "{http://www.w3.org/2000/svg}"


def suite(folder):
    return Suite(folder, folder, "tiny", min(os.sched_getaffinity(0)))


class ExampleFamily:
    NAME, TITLE = "example", "An <example>"


def example(folder):
    facts = {"machine": {"cpu": "C", "processors": 1, "instruction_set": "avx2", "system": "S", "load_before": 0.0},
             "build": {"compiler": "g++", "type": "Release", "flags": "-O3"},
             "source": {"commit": "0123456789abcdef", "changed": False}, "hosts": {"LAMMPS": "1"}}
    result = record.Result(
        measurements=[record.Measurement("s", "slow|er", "ns", [2.0, 6.0, 3.0], "base", [1.0, 2.0, 3.0])],
        tables=[record.Table("T", ["a", "b"], [[1, 0.5], ["x < y", None]])],
        plots=[record.Plot("P", "x", "y", {"one & two": [[1.0, 0.0], [2.0, 1e-3]]})], seed=1)
    return record.as_record(ExampleFamily, result, suite(folder), facts)


def sized(one, size):
    return {**one, "size": size}


class Figures(unittest.TestCase):
    def test_ratio_is_that_of_the_same_repetition(self):
        facts = record.Measurement("s", "n", "ns", [2.0, 6.0, 3.0], "base", [1.0, 2.0, 3.0]).facts()
        self.assertEqual((facts["median"], facts["low"], facts["high"], facts["repetitions"]), (3.0, 2.0, 6.0, 3))
        self.assertEqual((facts["ratio"]["median"], facts["ratio"]["low"], facts["ratio"]["high"]), (2.0, 1.0, 3.0))

    def test_other_numbers_of_repetitions_are_refused(self):
        with self.assertRaises(ValueError):
            record.Measurement("s", "n", "ns", [1.0, 2.0], "base", [1.0]).facts()
        with self.assertRaises(ValueError):
            record.Measurement("s", "n", "ns", []).facts()

    def test_numbers(self):
        for value, text in ((0.0, "0"), (7, "7"), (1.234, "1.23"), (12.34, "12.3"), (1234.5, "1234"), (1.5e-9, "1.5e-09"),
                            (None, "-"), ("x", "x")):
            self.assertEqual(words.number(value), text)


class Processors(unittest.TestCase):
    def test_name_has_the_generation_that_a_hypervisor_leaves_out(self):
        def named(name, family, model):
            return machine.cpu(f"vendor_id\t: AuthenticAMD\ncpu family\t: {family}\nmodel\t\t: {model}\nmodel name\t: {name}\n")

        for family, model, generation in ((23, 49, "Zen 1 or 2"), (25, 1, "Zen 3"), (25, 17, "Zen 4"), (25, 33, "Zen 3"),
                                          (25, 160, "Zen 4"), (26, 2, "Zen 5"), (27, 1, "family 27")):
            self.assertEqual(named("AMD EPYC", family, model), f"AMD EPYC, {generation}")
        self.assertEqual(named("AMD EPYC 7763 64-Core Processor", 25, 1), "AMD EPYC 7763 64-Core Processor")


class Programs(unittest.TestCase):
    def test_status_tells_wrong_from_missing(self):
        with tempfile.TemporaryDirectory() as folder:
            one = suite(folder)
            self.assertEqual(one.run(["sh", "-c", "echo well"]), "well\n")
            with self.assertRaisesRegex(Failed, "status 1"):
                one.run(["sh", "-c", "exit 1"], missing_status=2)
            with self.assertRaises(Missing):
                one.run(["sh", "-c", "exit 2"], missing_status=2)
            with self.assertRaisesRegex(Missing, "no_program is not in the build"):
                one.program("no_program")
            self.assertNotIn(folder, " ".join(one.commands))

    def test_programs_stay_on_one_processor(self):
        with tempfile.TemporaryDirectory() as folder:
            found = suite(folder).run(["/usr/bin/python3", "-c", "import os; print(len(os.sched_getaffinity(0)))"])
            self.assertEqual(found.strip(), "1")


class Reports(unittest.TestCase):
    def test_page_and_markdown_hold_the_record(self):
        with tempfile.TemporaryDirectory() as folder:
            record.write(folder, example(folder))
            records = record.read_all(folder, ["nothing", "example"])
            self.assertEqual([r["family"] for r in records], ["example"])
            for text, escaped in ((html_report.page(records), "An &lt;example&gt;"),
                                  (markdown_report.page({"c-avx2": records}, "plots")[0], "slow\\|er")):
                for expected in (escaped, "0123456789ab", "2.00 .. 6.00", "LAMMPS 1", "An &lt;example&gt; (tiny)"
                                 if escaped.startswith("An") else "An <example> (tiny)", records[0]["date"]):
                    self.assertIn(expected, text)

    def test_a_busy_machine_is_named(self):
        with tempfile.TemporaryDirectory() as folder:
            one = example(folder)
            self.assertNotIn("Others used", words.warning([one]))
            self.assertNotIn("Not here", words.warning([one]))
            self.assertIn("not been run: A, B.", words.warning([one], ["A", "B"]))
            one["machine"]["load_before"] = 3.0
            self.assertIn("Others used", words.warning([one]))

    def test_pages_are_well_formed(self):
        with tempfile.TemporaryDirectory() as folder:
            text = html_report.page([example(folder)])
        tree = xml.etree.ElementTree.fromstring(text.removeprefix("<!DOCTYPE html>"))
        targets = [a.get("href") for a in tree.iter("a")]
        names = {f"#{element.get('id')}" for element in tree.iter() if element.get("id")}
        self.assertIn("#example", targets)
        self.assertLessEqual(set(targets), names)

    def test_markdown_shows_the_plots_that_it_writes_and_no_older_ones(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "results.md")
            os.makedirs(os.path.join(folder, "results-plots"))
            with open(os.path.join(folder, "results-plots", "old.svg"), "w", encoding="utf-8"):
                pass
            markdown_report.write(path, {"c-avx2": [example(folder)]})
            self.assertEqual(os.listdir(os.path.join(folder, "results-plots")), ["c-avx2-example-1.svg"])
            with open(path, encoding="utf-8") as file:
                self.assertIn("![P](results-plots/c-avx2-example-1.svg)", file.read())


class Plots(unittest.TestCase):
    def marks(self, drawing):
        tree = xml.etree.ElementTree.fromstring(drawing)
        return [(float(c.get("cx")), float(c.get("cy"))) for c in tree.iter(SVG + "circle") if c.get("r") == "3.5"]

    def test_zero_is_at_the_bottom(self):
        with tempfile.TemporaryDirectory() as folder:
            points = self.marks(plot.svg(example(folder)["plots"][0]))
        self.assertEqual(points[0][1], plot.TOP + plot.PLOT_HEIGHT)
        self.assertLess(points[1][1], points[0][1])
        self.assertEqual(plot.svg({"series": {}}), "")

    def test_dots_stand_left_of_the_line_at_one_if_they_are_less(self):
        one = {"series": {"a": [["x", 0.5], ["y", 2.0]], "b": [["y", 1.0]]}, "x": "ratio", "kind": "dots"}
        (x_a, row_x), (y_a, row_y), (y_b, row_y_too) = self.marks(plot.svg(one))
        self.assertLess(x_a, y_b)
        self.assertLess(y_b, y_a)
        self.assertLess(row_x, row_y)
        self.assertEqual(row_y, row_y_too)

    def test_marks_of_labelled_series_tell_their_values(self):
        one = {"series": {"a": [[1, 46611.0], [2, 9.0]], "b": [[1, 777.0]]}, "x": "x", "y": "y", "logarithmic": True}
        plain, labelled = plot.svg(one), plot.svg({**one, "labelled": ["a"]})
        words = [t.text for t in xml.etree.ElementTree.fromstring(labelled).iter(SVG + "text")]
        self.assertIn("46,611", words)
        self.assertIn("9", words)
        self.assertNotIn("777", words)
        self.assertNotIn("46,611", plain)

    def test_labels_do_not_overlap(self):
        for low, high in ((1.0, 1.7), (0.02, 4.0), (1e-9, 1e3), (4000.0, 1e6)):
            axis = plot.Axis([low, high], 0, plot.PLOT_WIDTH, True)
            labels = axis.ticks()
            self.assertGreaterEqual(len(labels), 2, (low, high))
            tree = xml.etree.ElementTree.fromstring("<g>" + "".join(plot.x_axis(axis, 100, "")) + "</g>")
            spans = [(float(t.get("x")), plot.width_of([t.text])) for t in tree.iter("text") if t.text]
            for (x, width), (next_x, next_width) in zip(spans, spans[1:]):
                self.assertGreater(next_x - next_width / 2, x + width / 2, (low, high))


class KeptRecords(unittest.TestCase):
    def test_the_page_of_results_is_what_the_kept_records_give(self):
        """docs/results.md and its plots: nothing typed, nothing left from older records."""
        path = os.path.join(ROOT, "docs", "results.md")
        folder = markdown_report.folder_of(path)
        text, drawings = markdown_report.page(record.read_kept(os.path.join(ROOT, "benchmarks", "records")),
                                              os.path.basename(folder))
        remedy = "; write it by benchmarks/run --report-only --results"
        with open(path, encoding="utf-8") as file:
            self.assertTrue(file.read() == text, "docs/results.md is not what benchmarks/records gives" + remedy)
        self.assertEqual(sorted(os.listdir(folder)), sorted(drawings), remedy)
        for name, drawing in drawings.items():
            with open(os.path.join(folder, name), encoding="utf-8") as file:
                self.assertTrue(file.read() == drawing, name + remedy)

    def test_kept_records_are_of_families_and_in_the_file_of_their_processor(self):
        kept = record.read_kept(os.path.join(ROOT, "benchmarks", "records"))
        self.assertTrue(kept)
        names = [family.NAME for family in families.ALL]
        for name, records in kept.items():
            here = [one["family"] for one in records]
            self.assertEqual(here, [family for family in names if family in here])
            for one in records:
                self.assertEqual(record.file_of_processor(one), name + ".json")
                self.assertIn(one["size"], ("quick", "full"))
                self.assertRegex(one["date"], r"^20\d\d-\d\d-\d\d$")

    def test_a_record_takes_the_place_of_that_of_its_family_and_processor(self):
        with tempfile.TemporaryDirectory() as folder:
            one = example(folder)
            other = {**one, "machine": {**one["machine"], "cpu": "Intel(R) Xeon(R) Processor @ 2.0GHz", "instruction_set": "avx512"}}
            kept = os.path.join(folder, "records")
            for records in ([one, {**one, "family": "first"}], [{**one, "seed": 7}], [other]):
                record.keep(kept, records, ["first", "example"])
            found = record.read_kept(kept)
            self.assertEqual(list(found), ["c-avx2", "intel-xeon-avx512"])
            self.assertEqual([(r["family"], r["seed"]) for r in found["c-avx2"]], [("first", 1), ("example", 7)])
            self.assertEqual(found["intel-xeon-avx512"], [other])

    def test_a_small_run_does_not_take_the_place_of_a_large_one(self):
        with tempfile.TemporaryDirectory() as folder:
            one = example(folder)
            kept = os.path.join(folder, "records")
            record.keep(kept, [sized(one, "full")], ["example"])
            with self.assertRaisesRegex(ValueError, "'example' at size full.*size quick"):
                record.keep(kept, [sized(one, "quick")], ["example"])
            self.assertEqual(record.read_kept(kept)["c-avx2"][0]["size"], "full")


class Ratios(unittest.TestCase):
    FIGURE = {"scene", "name", "over", "cell", "where", "over_where"}

    def test_every_row_has_what_the_table_needs(self):
        names = [family.NAME for family in families.ALL]
        aims = [row for group in ratios.groups() for row in group["rows"]]
        for group in ratios.groups():
            self.assertEqual({"title", "source", "rows"}, set(group))
        for row in aims:
            self.assertLessEqual(set(row), {"what", "asked", "at_least", "command", "family"} | self.FIGURE, row)
            self.assertTrue(row["what"] and row["command"], row)
        for row in aims + [row for limit in ratios.limits() for row in limit.get("figures", ())]:
            figure = self.FIGURE & set(row)
            self.assertIn(figure, (set(), {"scene", "name"}, {"scene", "name", "over"}, {"cell", "where"},
                                   {"cell", "where", "over_where"}), row)
            self.assertEqual("family" in row, bool(figure), row)
            self.assertIn(row.get("family", names[0]), names, row)

    def test_no_figure_is_typed(self):
        """Numbers of an aim are what was asked, and what its words need to name a scene."""
        for limit in ratios.limits():
            self.assertNotRegex(limit["text"], r"\d\.\d|\d %", limit)
        for group in ratios.groups():
            for row in group["rows"]:
                self.assertNotIn("measured", row)

    def test_verdicts(self):
        for value, asked, expected in ((1.1, 1.1, ratios.HELD), (1.2, 1.1, ratios.MISSED)):
            self.assertEqual(ratios.verdict({"asked": asked}, (value, 0.9, 1.3)), expected)
        self.assertEqual(ratios.verdict({"asked": 3, "at_least": True}, (2.9, 2.9, 3.1)), ratios.MISSED)
        self.assertEqual(ratios.verdict({"asked": 3, "at_least": True}, (3.0, 2.9, 3.1)), ratios.HELD)
        self.assertEqual(ratios.verdict({}, (2.9, 2.9, 2.9)), ratios.NO_AIM)

    def test_figures_come_from_measurements_and_tables(self):
        with tempfile.TemporaryDirectory() as folder:
            one = example(folder)
        one["measurements"].append({"scene": "s", "name": "plain", "unit": "ns", "median": 6.0, "low": 5.0, "high": 7.0,
                                    "repetitions": 3})
        for spec, expected in (({"scene": "s", "name": "slow|er"}, (2.0, 1.0, 3.0)),
                               ({"scene": "*", "name": "plain"}, (6.0, 5.0, 7.0)),
                               ({"scene": "s", "name": "plain", "over": ["s", "slow|er"]}, (2.0, 2.0, 2.0)),
                               ({"cell": ["T", "b"], "where": {"a": 1}}, (0.5, 0.5, 0.5)),
                               ({"cell": ["T", "b"], "where": {"a": 1}, "over_where": {"a": 1}}, (1.0, 1.0, 1.0)),
                               ({"scene": "t", "name": "plain"}, None), ({"cell": ["T", "b"], "where": {"a": 2}}, None),
                               ({"cell": ["U", "b"], "where": {"a": 1}}, None),
                               ({"scene": "s", "name": "plain", "over": ["s", "none"]}, None)):
            self.assertEqual(ratios.figure(spec, one), expected, spec)

    def test_an_aim_has_a_row_for_each_record_with_its_figure(self):
        with tempfile.TemporaryDirectory() as folder:
            one = example(folder)
        other = {**one, "size": "full", "date": "2030-01-02", "measurements": [
            {**one["measurements"][0], "ratio": {"to": "base", "median": 1.2, "low": 1.1, "high": 1.4, "repetitions": 3}}]}
        row = {"what": "w", "asked": 1.3, "command": "c", "family": "example", "scene": "s", "name": "slow|er"}
        here = ["C (avx2), tiny, " + one["date"], "c"]
        self.assertEqual(list(ratios.rows_of({"rows": [row]}, [one, other])),
                         [["w", "at most 1.3", "2.00 (1.00 .. 3.00)", ratios.MISSED, *here],
                          ["w", "at most 1.3", "1.20 (1.10 .. 1.40)", ratios.HELD, "C (avx2), full, 2030-01-02", "c"]])
        self.assertEqual(list(ratios.rows_of({"rows": [{**row, "family": "none"}]}, [one])),
                         [["w", "at most 1.3", ratios.NO_RECORD, ratios.NO_RECORD, "-", "c"]])

    def test_documents_that_are_named_exist(self):
        for group in ratios.groups():
            self.assertTrue(os.path.exists(os.path.join(ROOT, group["source"])), group["source"])


if __name__ == "__main__":
    unittest.main()
