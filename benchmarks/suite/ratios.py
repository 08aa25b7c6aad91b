# SPDX-License-Identifier: MIT
"""What was aimed at beside what was measured: ratios.toml, with the ratios that records have."""

import os
import tomllib

from . import words

PATH = os.path.join(os.path.dirname(os.path.abspath(__file__)), "ratios.toml")
COLUMNS = ["ratio", "asked", "measured", "held?", "in the records below", "command"]
HELD, MISSED, PARTLY, NOT_MEASURED, NO_AIM = "held", "missed", "in part", "not measured", "-"
SMALLER = "not measured at that size"
NOTE = ("Times of ours over times of the other, unless a row says otherwise: smaller is better, and above 1 is a loss. 'Measured' is of "
        "runs at full size on a Xeon with AVX-512, from the document named, and what is held or missed goes by that; the records "
        "below are those of this report, with the processor and the size that they name. Commands are those of "
        "benchmarks/README.md.")
WHEN_NOT_TITLE = "When not to use DCH"
WHEN_NOT = [
    "Your particles are spread evenly, with one cutoff, and you can have a good SIMD grid: built anew each time from the same kernels, "
    "it beats repair and list of the hierarchy by a quarter to two thirds. The grids of the hosts here are not that good, which is "
    "why the adapters win.",
    "You want three lists of an even liquid, or spheres of sizes up to 1:10: a tuned grid for each list or range of sizes is as fast. "
    "In LAMMPS, colloids 1:50 in a dense solvent take 1.12 of the time of `neighbor multi`.",
    "Your atoms form a thin hot gas: they leave their clusters all the time and have few neighbors, so that the best grid takes half "
    "the time, and LAMMPS's bins two thirds (scene `hotgas`).",
    "Your processor has no AVX-512: lists and forces gain less over the hosts' own. On an EPYC with AVX2 a step of OpenMM takes 0.50 to "
    "0.56 of its own time in the Lennard-Jones fluid and 0.70 to 0.82 in water, where a Xeon with AVX-512 takes 0.39 and 0.42.",
    "You need rows sorted by index: the sorting takes three times as long as finding the pairs.",
    "Most of your time goes elsewhere. With lattice sums, bonds or many-body forces, the loop gains what lists had of it: 9 % for a "
    "peptide in water, 29 % for embedded atoms. PME systems keep OpenMM's own force.",
    "You have few neighbors an atom and a tuned skin, as in a Kremer-Grest melt: the loop gains a fifth over stock LAMMPS at its "
    "best. `skin auto` does not pay in runs of some hundred steps.",
    "You have many cores for one process, or a GPU: two threads take 0.83 of the time of one, and there are no kernels for GPUs. "
    "Runs on several MPI processes are tested, but not measured.",
    "About 100 bytes an atom beyond the list are too much, or 450 for each atom of a thin gas.",
    "You look for contacts in a collapsed globule with the wrapped hierarchy of the necklaces: a cell list is faster. `ContactFinder` "
    "takes a hierarchy over space there. The power diagram costs sixty times as much as either.",
]


def groups():
    with open(PATH, "rb") as file:
        return tomllib.load(file)["group"]


def verdict(row):
    """Whether what was measured is what was asked."""
    measured = row["measured"]
    if not measured:
        return NOT_MEASURED
    if "asked" not in row:
        return NO_AIM
    if row.get("smaller"):
        return SMALLER
    holds = [value >= row["asked"] if row.get("at_least") else value <= row["asked"] for value in measured]
    return HELD if all(holds) else PARTLY if any(holds) else MISSED


def number(value):
    """As written, but with two digits behind the point at least where it has any."""
    return str(value) if isinstance(value, int) or round(value, 2) != value else f"{value:.2f}"


def range_of(values):
    return " to ".join(number(value) for value in dict.fromkeys(values)) or "-"


def recorded(row, records):
    """The measurements in the records that are this ratio, with what they were measured on."""
    if "record" not in row:
        return []
    family, scene, name = row["record"]
    found = next((r for r in records if r["family"] == family), {"measurements": []})
    return [m for m in found["measurements"] if m["name"] == name and "ratio" in m
            and (m["scene"].startswith(scene[1:]) if scene.startswith("~") else m["scene"] == scene)]


def rows_of(group, records):
    """Cells of the table, as text."""
    for row in group["rows"]:
        asked = "-" if "asked" not in row else f"at {'least' if row.get('at_least') else 'most'} {number(row['asked'])}"
        measured = range_of(row["measured"]) + (f" ({row['note']})" if "note" in row else "")
        here = "; ".join(f"{words.number(m['ratio']['median'])} ({words.number(m['ratio']['low'])} .. "
                         f"{words.number(m['ratio']['high'])})" for m in recorded(row, records)) or "-"
        yield [row["what"], asked, measured, verdict(row), here, row["command"]]


def summary():
    """How many aims were held."""
    verdicts = [verdict(row) for group in groups() for row in group["rows"]]
    return (f"Of {sum(v != NO_AIM for v in verdicts)} aims {verdicts.count(HELD)} are held, {verdicts.count(PARTLY)} in part, "
            f"{verdicts.count(MISSED)} missed, {sum(v in (NOT_MEASURED, SMALLER) for v in verdicts)} not measured at full size.")
