# SPDX-License-Identifier: MIT
"""docs/results.md from the records."""

import glob
import os

from . import plot, ratios, words

HEAD = """# Results

Written by `benchmarks/run` from its records and from `benchmarks/suite/ratios.toml`; do not edit it by hand.
[benchmarks/README.md](../benchmarks/README.md) says what each benchmark does, and which runs write this file.
"""
MEASURED = """## Records

A ratio below 1 is in favor of what stands in the row. It is the median over runs of the ratio of both in the same run."""


def table(columns, rows):
    lines = ["| " + " | ".join(columns) + " |", "|" + "---|" * len(columns)]
    return lines + ["| " + " | ".join(cell.replace("|", "\\|") for cell in row) + " |" for row in rows]


def asked_and_measured(records):
    lines = ["## Asked and measured", "", ratios.NOTE, "", ratios.summary()]
    for group in ratios.groups():
        lines += ["", f"### {group['title']}", "", f"From `{group['source']}`.", ""]
        lines += table(ratios.COLUMNS, [[*row[:-1], f"`{row[-1]}`"] for row in ratios.rows_of(group, records)])
    return lines + ["", f"## {ratios.WHEN_NOT_TITLE}", "", *(f"- {reason}" for reason in ratios.WHEN_NOT), ""]


def images(record, folder):
    """Writes the plots of a record beside the document; lines that show them."""
    lines = []
    for k, one in enumerate(record["plots"]):
        drawing = plot.svg(one)
        if drawing:
            name = f"{record['family']}-{k + 1}.svg"
            with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                file.write(drawing + "\n")
            lines += ["", f"![{one['title']}]({os.path.basename(folder)}/{name})", "", f"*{one['title']}.*"]
    return lines


def family(record, folder):
    lines = ["", f"### {record['title']}", ""]
    lines += table(["", ""], [[name, value] for name, value in words.facts(record) if value and value != "-"])
    if record["commands"]:
        lines += ["", *(f"    {command}" for command in record["commands"])]
    for reason in record["left_out"]:
        lines += ["", f"Left out: {reason}"]
    lines += images(record, folder)
    if record["measurements"]:
        lines += ["", *table(words.MEASURED, [words.measured_row(m) for m in record["measurements"]])]
    for one in record["tables"]:
        lines += ["", f"#### {one['title']}", ""]
        if one["note"]:
            lines += [one["note"], ""]
        lines += table(one["columns"], [[words.number(cell) for cell in row] for row in one["rows"]])
    return lines


def write(path, records, missing=()):
    """The plots go into a folder beside the document, in place of those there."""
    folder = os.path.splitext(path)[0] + "-plots"
    os.makedirs(folder, exist_ok=True)
    for old in glob.glob(os.path.join(glob.escape(folder), "*.svg")):
        os.remove(old)
    lines = [HEAD, *asked_and_measured(records), MEASURED]
    limits = words.warning(records, missing)
    if limits:
        lines += ["", f"**{limits}**"]
    for record in records:
        lines += family(record, folder)
    with open(path + ".part", "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")
    os.replace(path + ".part", path)
