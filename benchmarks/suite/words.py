# SPDX-License-Identifier: MIT
"""Numbers and facts as both reports print them."""

from . import machine


def number(value):
    """Three significant digits; whole numbers as they are."""
    if value is None:
        return "-"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, int):
        return str(value) if abs(value) < 10**7 else f"{value:.3g}"
    if not isinstance(value, float):
        return str(value)
    if value != value:
        return "-"
    if value == 0:
        return "0"
    if 1e-3 <= abs(value) < 1e7:
        digits = 0 if abs(value) >= 100 else 1 if abs(value) >= 10 else 2 if abs(value) >= 1 else 3
        return f"{value:.{digits}f}"
    return f"{value:.1e}"


MEASURED = ["scene", "what", "unit", "median", "lowest .. highest", "runs", "ratio", "lowest .. highest", "to"]


def measured_row(m):
    row = [m["scene"], m["name"], m["unit"], number(m["median"]), f"{number(m['low'])} .. {number(m['high'])}",
           str(m["repetitions"])]
    ratio = m.get("ratio")
    if not ratio:
        return row + ["", "", ""]
    return row + [number(ratio["median"]), f"{number(ratio['low'])} .. {number(ratio['high'])}", ratio["to"]]


def facts(record):
    """Name and value of what a reader has to know of a run."""
    computer, build, source = record["machine"], record["build"], record["source"]
    hosts = ", ".join(f"{name} {version}" for name, version in record["hosts"].items())
    hashes = ", ".join(f"{scene} {value}" for scene, value in record["list_hash"].items())
    return [("date", record["date"]), ("note", record.get("note", "")),
            ("processor", f"{computer['cpu']}, {computer['processors']} of them, {computer['instruction_set']}"),
            ("processors that others used when it began", number(computer["load_before"])),
            ("system", computer["system"]),
            ("compiler", f"{build['compiler']}, {build['type']} {build['flags']}"),
            ("commit", source["commit"][:12] + (" and changes to it" if source["changed"] else "")),
            ("hosts", hosts), ("seed", number(record["seed"])), ("list hash", hashes),
            ("took", f"{number(record['seconds'])} s, {number(record['processor_seconds'])} s of them on the processor"),
            ("checked", record["checked"])]


def warning(records, missing=()):
    """What limits the figures, or "". `missing` are titles of families that have no record."""
    small = [f"{record['title']} ({record['size']})" for record in records if record["size"] != "full"]
    busy = [record["title"] for record in records if machine.is_busy(record["machine"]["load_before"])]
    found = []
    if small:
        found.append("Small sizes, for a first look: " + ", ".join(small) + ".")
    if busy:
        found.append("Others used the machine when these began, so that times scatter: " + ", ".join(busy) + ".")
    if missing:
        found.append("Not here, since they have not been run: " + ", ".join(missing) + ".")
    return " ".join(found)
