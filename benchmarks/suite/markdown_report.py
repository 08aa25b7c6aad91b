# SPDX-License-Identifier: MIT
"""docs/results.md, wholly from the kept records."""

import os

from . import plot, ratios, words
from .record import processor_of, write_file

HEAD = """# Results

Written by `benchmarks/run --results` from the records in `benchmarks/records`; a test compares them. Do not edit it by hand.
[benchmarks/README.md](../benchmarks/README.md) says what each benchmark does.
"""
RECORDS = """## Records

A ratio below 1 is in favor of what stands in the row. It is the median over runs of the ratio of both in the same run."""


def table(columns, rows):
    lines = ["| " + " | ".join(columns) + " |", "|" + "---|" * len(columns)]
    return lines + ["| " + " | ".join(cell.replace("|", "\\|") for cell in row) + " |" for row in rows]


def aims_and_records(records):
    lines = ["## Aims and records", "", ratios.NOTE, "", ratios.summary(records)]
    for group in ratios.groups():
        lines += ["", f"### {group['title']}", "", f"Discussed in `{group['source']}`.", ""]
        lines += table(ratios.COLUMNS, [[*row[:-1], f"`{row[-1]}`"] for row in ratios.rows_of(group, records)])
    return lines + ["", f"## {ratios.WHEN_NOT_TITLE}", "", *(f"- {reason}" for reason in ratios.reasons(records)), ""]


def images(record, prefix, drawings, folder):
    """Lines that show the plots of a record, which go into `drawings` by name."""
    lines = []
    for k, one in enumerate(record["plots"]):
        drawing = plot.svg(one)
        if drawing:
            name = f"{prefix}-{record['family']}-{k + 1}.svg"
            drawings[name] = drawing + "\n"
            lines += ["", f"![{one['title']}]({folder}/{name})", "", f"*{one['title']}.*"]
    return lines


def family(record, prefix, drawings, folder):
    lines = ["", f"#### {record['title']}", ""]
    lines += table(["", ""], [[name, value] for name, value in words.facts(record) if value and value != "-"])
    if record["commands"]:
        lines += ["", *(f"    {command}" for command in record["commands"])]
    for reason in record["left_out"]:
        lines += ["", f"Left out: {reason}"]
    lines += images(record, prefix, drawings, folder)
    if record["measurements"]:
        lines += ["", *table(words.MEASURED, [words.measured_row(m) for m in record["measurements"]])]
    for one in record["tables"]:
        lines += ["", f"##### {one['title']}", ""]
        if one["note"]:
            lines += [one["note"], ""]
        lines += table(one["columns"], [[words.number(cell) for cell in row] for row in one["rows"]])
    return lines


def page(kept, folder):
    """Text of the page and its drawings by name, from the records by processor; `folder` is that of the drawings."""
    drawings = {}
    lines = [HEAD, *aims_and_records([record for records in kept.values() for record in records]), RECORDS]
    for prefix, records in kept.items():
        lines += ["", f"### {processor_of(records[0])}"]
        limits = words.warning(records)
        if limits:
            lines += ["", f"**{limits}**"]
        for record in records:
            lines += family(record, prefix, drawings, folder)
    return "\n".join(lines) + "\n", drawings


def folder_of(path):
    """Of the drawings, beside the page."""
    return os.path.splitext(path)[0] + "-plots"


def write(path, kept):
    """The drawings take the place of those that are there."""
    folder = folder_of(path)
    text, drawings = page(kept, os.path.basename(folder))
    os.makedirs(folder, exist_ok=True)
    for old in os.listdir(folder):
        if old.endswith(".svg") and old not in drawings:
            os.remove(os.path.join(folder, old))
    for name, drawing in drawings.items():
        write_file(os.path.join(folder, name), drawing)
    write_file(path, text)
