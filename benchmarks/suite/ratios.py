# SPDX-License-Identifier: MIT
"""What was aimed at beside what the records have: ratios.toml names the aims and where in a record each figure stands."""

import fnmatch
import os
import tomllib

from . import words
from .record import processor_of

PATH = os.path.join(os.path.dirname(os.path.abspath(__file__)), "ratios.toml")
COLUMNS = ["ratio", "aim", "measured", "held?", "processor, size, date", "command"]
HELD, MISSED, NO_AIM, NO_RECORD = "held", "missed", "-", "no record"
NOTE = ("Times of ours over times of the other, unless a row says otherwise: smaller is better, and above 1 is a loss. Each figure "
        "is a median from the record that its row names, with the lowest and the highest in brackets; the median decides whether "
        "an aim is held. An aim has a row for each record that has its figure.")
WHEN_NOT_TITLE = "When not to use DCH"


def document():
    with open(PATH, "rb") as file:
        return tomllib.load(file)


def groups():
    return document()["group"]


def limits():
    return document()["limit"]


def measurement_of(record, scene, name):
    """The first one whose scene is that or, with "*" in it, is like that; None if there is none."""
    return next((m for m in record["measurements"] if m["name"] == name and fnmatch.fnmatchcase(m["scene"], scene)), None)


def cell_of(record, title, where, column):
    """The number of a table in the row that has what `where` says."""
    for table in record["tables"]:
        if not table["title"].startswith(title):
            continue
        at = table["columns"].index
        for row in table["rows"]:
            if all(row[at(name)] == value for name, value in where.items()):
                return row[at(column)]
    return None


def figure(row, record):
    """Median, lowest and highest of the ratio in a record, or None if the record does not have it."""
    if "cell" in row:
        cells = [cell_of(record, row["cell"][0], where, row["cell"][1]) for where in (row["where"], row.get("over_where"))
                 if where is not None]
        if None in cells:
            return None
        value = cells[0] if len(cells) == 1 else cells[0] / cells[1]
        return value, value, value
    found = measurement_of(record, row["scene"], row["name"])
    if found and "over" in row:
        other = measurement_of(record, *row["over"])
        return other and (found["median"] / other["median"],) * 3
    one = found and found.get("ratio", found)
    return one and (one["median"], one["low"], one["high"])


def figures(row, records):
    """The figure of a row and its record, for every record that has it."""
    if "family" not in row:
        return []
    found = [(figure(row, record), record) for record in records if record["family"] == row["family"]]
    return [(value, record) for value, record in found if value is not None]


def text_of(value):
    median, low, high = value
    return words.number(median) if low == high else f"{words.number(median)} ({words.number(low)} .. {words.number(high)})"


def origin(record):
    return f"{processor_of(record)}, {record['size']}, {record['date']}"


def verdict(row, value):
    """Whether a median is what was asked."""
    if "asked" not in row:
        return NO_AIM
    return HELD if (value[0] >= row["asked"] if row.get("at_least") else value[0] <= row["asked"]) else MISSED


def rows_of(group, records):
    """Cells of the table, as text."""
    for row in group["rows"]:
        asked = "-" if "asked" not in row else f"at {'least' if row.get('at_least') else 'most'} {row['asked']:g}"
        found = figures(row, records)
        for value, record in found:
            yield [row["what"], asked, text_of(value), verdict(row, value), origin(record), row["command"]]
        if not found:
            yield [row["what"], asked, NO_RECORD, NO_RECORD, "-", row["command"]]


def summary(records):
    """How many aims each processor's records hold."""
    aims = [row for group in groups() for row in group["rows"] if "asked" in row]
    counts = {}
    for row in aims:
        for value, record in figures(row, records):
            key = f"{processor_of(record)}, size {record['size']}"
            counts.setdefault(key, {HELD: 0, MISSED: 0})[verdict(row, value)] += 1
    without = sum(not figures(row, records) for row in aims)
    parts = [f"{key}: {count[HELD]} held, {count[MISSED]} missed" for key, count in counts.items()]
    return f"Of {len(aims)} aims {without} have no record. " + "; ".join(parts) + ("." if parts else "")


def reasons(records):
    """When not to use DCH, each with its figures from the records."""
    for limit in limits():
        found = [f"{row['what']}: {text_of(value)} ({origin(record)})"
                 for row in limit.get("figures", ()) for value, record in figures(row, records)]
        yield limit["text"] + (" Measured: " + "; ".join(found) + "." if found else "")
