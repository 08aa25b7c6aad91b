# SPDX-License-Identifier: MIT
"""What one benchmark has found, and the file that says so with all that a reader needs to judge it."""

import dataclasses
import datetime
import json
import os
import re
import statistics

SIZES = ("tiny", "quick", "full")


@dataclasses.dataclass
class Measurement:
    """Times of one contender in one scene, by repetition, and the same of what it is compared with."""
    scene: str
    name: str
    unit: str
    values: list
    baseline: str = ""
    baseline_values: list = dataclasses.field(default_factory=list)

    def facts(self):
        """As recorded: with median and spread; the ratio is the median over repetitions of ratios in the same one."""
        facts = {"scene": self.scene, "name": self.name, "unit": self.unit, "values": self.values,
                 **spread(self.values)}
        if self.baseline:
            ratios = [value / base for value, base in zip(self.values, self.baseline_values, strict=True)]
            facts["ratio"] = {"to": self.baseline, **spread(ratios)}
        return facts


def spread(values):
    if not values:
        raise ValueError("a measurement without a repetition")
    return {"median": statistics.median(values), "low": min(values), "high": max(values), "repetitions": len(values)}


@dataclasses.dataclass
class Table:
    title: str
    columns: list
    rows: list
    note: str = ""


@dataclasses.dataclass
class Plot:
    """Curves through points, or with kind "dots" values by name, one row each, on a logarithmic scale around 1.

    y is on a logarithmic scale unless told otherwise, where 0 stands at the bottom.
    """
    title: str
    x: str
    y: str
    series: dict  # name: list of [x, y]; of dots [name of the row, value]
    logarithmic: bool = True
    logarithmic_x: bool = False
    from_zero: bool = False  # the axis of y begins at 0, if it is linear
    kind: str = "curves"


@dataclasses.dataclass
class Result:
    """What a family hands over."""
    measurements: list = dataclasses.field(default_factory=list)
    tables: list = dataclasses.field(default_factory=list)
    plots: list = dataclasses.field(default_factory=list)
    checked: str = ""       # what was compared before anything was timed
    seed: int | None = None
    list_hash: dict = dataclasses.field(default_factory=dict)  # by scene
    left_out: list = dataclasses.field(default_factory=list)   # what could not run, with the reason


def as_record(family, result, suite, facts):
    """One JSON object; `facts` are those of machine, build, source and hosts."""
    return {"family": family.NAME, "title": family.TITLE, "size": suite.size,
            "date": datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%d"), "commands": suite.commands,
            "seconds": round(suite.seconds(), 1), "processor_seconds": round(suite.processor_seconds(), 1), **facts,
            "checked": result.checked, "seed": result.seed,
            "list_hash": result.list_hash, "left_out": result.left_out,
            "measurements": [m.facts() for m in result.measurements],
            "tables": [dataclasses.asdict(t) for t in result.tables],
            "plots": [dataclasses.asdict(p) for p in result.plots]}


def write_file(path, text):
    """The file appears under its name when it is complete."""
    with open(path + ".part", "w", encoding="utf-8") as file:
        file.write(text)
    os.replace(path + ".part", path)


def as_json(what):
    """Indented, but for lists of numbers and words, each of which stands in one line."""
    innermost = r"\[\n\s*([^\[\]{}]*?)\s*\]"  # words with brackets in them may keep their lines
    return re.sub(innermost, lambda found: "[" + re.sub(r",\n *", ", ", found.group(1)) + "]", json.dumps(what, indent=1)) + "\n"


def write(folder, record):
    path = os.path.join(folder, record["family"] + ".json")
    write_file(path, as_json(record))
    return path


def read_all(folder, names):
    """Records of the folder, in the order of the names; those that are not there are left out."""
    records = []
    for name in names:
        path = os.path.join(folder, name + ".json")
        if os.path.exists(path):
            with open(path, encoding="utf-8") as file:
                records.append(json.load(file))
    return records


def processor_of(record):
    """For people, with the instruction set."""
    return f"{record['machine']['cpu']} ({record['machine']['instruction_set']})"


def file_of_processor(record):
    """Name of the file that keeps the records of a processor."""
    name = re.sub(r"\((R|TM)\)|\b(Processor|CPU)\b|@.*", " ", record["machine"]["cpu"])
    return re.sub(r"[^a-z0-9]+", "-", f"{name} {record['machine']['instruction_set']}".lower()).strip("-") + ".json"


def read_kept(folder):
    """{name without .json: records}, one file for each processor."""
    kept = {}
    for name in sorted(os.listdir(folder)) if os.path.isdir(folder) else []:
        if name.endswith(".json"):
            with open(os.path.join(folder, name), encoding="utf-8") as file:
                kept[name.removesuffix(".json")] = json.load(file)
    return kept


def keep(folder, records, names):
    """Puts records into the file of their processor, each in the place of the one of its family that is there.

    `names` are the families in their order. A record of a smaller size is refused where one of a larger size is kept.
    """
    for record in records:
        path = os.path.join(folder, file_of_processor(record))
        there = read_kept(folder).get(os.path.basename(path).removesuffix(".json"), [])
        by_family = {one["family"]: one for one in there}
        old = by_family.get(record["family"])
        if old and SIZES.index(old["size"]) > SIZES.index(record["size"]):
            raise ValueError(f"{path} has '{record['family']}' at size {old['size']}; a record of size {record['size']} does not "
                             "take its place: run that size, or remove the one that is kept")
        by_family[record["family"]] = record
        os.makedirs(folder, exist_ok=True)
        write_file(path, as_json([by_family[name] for name in names if name in by_family]))
