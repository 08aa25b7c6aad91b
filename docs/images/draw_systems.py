#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Draws the pictures of docs/lammps/polymers.md, colloids.md, grains.md and biomolecules.md: where atoms stand at the end of short
runs of the scripts of these pages, on lists of LAMMPS's own.

usage: draw_systems.py LMP DCHMD PEPTIDE FOLDER; writes system-polymers.svg, system-colloids.svg, system-grains.svg and
system-biomolecules.svg; PEPTIDE is the folder of LAMMPS's example
"""
import math
import pathlib
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass, field

WIDTH = 320.0  # of each picture
COLORS = ("#1f5fbf", "#d98c00", "#2e8b57", "#9b3d8f", "#b03a2e", "#3a8f9b", "#7a6a2f", "#5b5b8f")
EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "examples" / "lammps"
# Of a line of Atoms: where type, molecule, diameter and place stand.
COLUMNS = {"atomic": (1, None, None, 2), "bond": (2, 1, None, 3), "full": (2, 1, None, 4), "sphere": (1, None, 2, 4)}


@dataclass
class Atom:
    kind: int
    molecule: int
    diameter: float
    place: tuple  # in the box
    image: tuple  # of the box, in which the atom is


@dataclass
class System:
    low: tuple
    high: tuple
    atoms: dict = field(default_factory=dict)  # by ID
    bonds: list = field(default_factory=list)


def read_data(path):
    """What write_data has written."""
    section, style, bounds, atoms, bonds = None, None, [], {}, []
    for line in path.read_text(encoding="utf-8").splitlines()[1:]:
        words = line.split()
        if words and words[0].isalpha() and words[0][0].isupper():
            section, style = words[0], words[-1]
            columns = COLUMNS[style] if section == "Atoms" else None
        elif words[2:] in (["xlo", "xhi"], ["ylo", "yhi"], ["zlo", "zhi"]):
            bounds.append((float(words[0]), float(words[1])))
        elif words and section == "Atoms":
            kind, molecule, diameter, place = columns
            atoms[int(words[0])] = Atom(int(words[kind]), int(words[molecule]) if molecule else 0,
                                        float(words[diameter]) if diameter else 0.0,
                                        tuple(map(float, words[place:place + 3])), tuple(map(int, words[place + 3:place + 6])))
        elif words and section == "Bonds":
            bonds.append((int(words[2]), int(words[3])))
    return System(tuple(b[0] for b in bounds), tuple(b[1] for b in bounds), dict(sorted(atoms.items())), sorted(bonds))


def circle(place, radius, look):
    return f"<circle cx='{place[0]:.1f}' cy='{place[1]:.1f}' r='{radius:.1f}' {look}/>"


def lines(pairs, look):
    return f"<path d='{''.join(f'M{a[0]:.1f} {a[1]:.1f}L{b[0]:.1f} {b[1]:.1f}' for a, b in pairs)}' {look}/>"


class Plane:
    """Two axes of a box on a sheet, with its frame."""

    def __init__(self, system, across, up, top=None):
        self.axes, self.low = (across, up), system.low
        self.top = system.high[up] if top is None else top
        self.scale = WIDTH / (system.high[across] - system.low[across])
        self.height = (self.top - system.low[up]) * self.scale

    def __call__(self, place):
        across, up = self.axes
        return (place[across] - self.low[across]) * self.scale, (self.top - place[up]) * self.scale

    def drawing(self, shapes):
        size = f"width='{WIDTH:.0f}' height='{self.height:.0f}'"
        return "\n".join([f"<svg xmlns='http://www.w3.org/2000/svg' {size}>", f"<rect {size} fill='white' stroke='#999999'/>",
                          *shapes, "</svg>"]) + "\n"


def sections(plane, atoms, axis, height, radius_of, look_of):
    """Spheres as a plane across an axis cuts them."""
    for atom in atoms:
        square = radius_of(atom)**2 - (atom.place[axis] - height)**2
        if square > 0:
            yield circle(plane(atom.place), math.sqrt(square) * plane.scale, look_of(atom))


def draw_polymers(system):
    """A layer two beads thick, with the bonds in it."""
    plane, shown = Plane(system, 0, 1), {}
    for number, atom in system.atoms.items():
        if 0 <= atom.place[2] - system.low[2] < 2:
            shown[number] = atom
    shapes = []
    for color in range(len(COLORS)):
        mine = {number: atom for number, atom in shown.items() if atom.molecule % len(COLORS) == color}
        places = [(mine[a].place, mine[b].place) for a, b in system.bonds if a in mine and b in mine]
        near = [(plane(a), plane(b)) for a, b in places if math.dist(a, b) < 2]  # not through a face of the box
        shapes.append(f"<g stroke='{COLORS[color]}' fill='{COLORS[color]}'>")
        shapes.append(lines(near, "stroke-width='3'"))
        shapes += [circle(plane(atom.place), 0.28 * plane.scale, "stroke='none'") for atom in mine.values()]
        shapes.append("</g>")
    return plane.drawing(shapes)


def draw_colloids(system):
    """A section through the centers of colloids."""
    plane, large = Plane(system, 0, 1), [atom for atom in system.atoms.values() if atom.kind == 2]
    height = large[0].place[2]
    return plane.drawing(["<g fill='#1f5fbf'>", *sections(plane, system.atoms.values(), 2, height, lambda atom: 0.5 if atom.kind == 1 else 5,
                                                          lambda atom: "fill='#d98c00'" if atom.kind == 2 else ""), "</g>"])


def draw_grains(system):
    """A section across the floor."""
    plane = Plane(system, 0, 2, top=max(atom.place[2] + atom.diameter / 2 for atom in system.atoms.values()))
    height = 4.0  # through the first row of large grains
    return plane.drawing(["<g fill='#1f5fbf'>", *sections(plane, system.atoms.values(), 1, height, lambda atom: atom.diameter / 2,
                                                          lambda atom: "fill='#d98c00'" if atom.kind == 1 else ""), "</g>"])


def draw_biomolecules(system):
    """The peptide whole, and oxygens of water behind it, in a layer."""
    edges = [high - low for low, high in zip(system.low, system.high)]
    peptide = {number: atom for number, atom in system.atoms.items() if atom.kind <= 12}
    whole = {number: tuple(x + i * edge for x, i, edge in zip(atom.place, atom.image, edges)) for number, atom in peptide.items()}
    center = [sum(place[axis] for place in whole.values()) / len(whole) for axis in range(3)]
    plane = Plane(system, 0, 1)
    water = [atom for atom in system.atoms.values() if atom.kind == 13 and abs(atom.place[2] - center[2]) < 3]
    shapes = ["<g fill='#bcd2f0'>", *(circle(plane(atom.place), 1.4 * plane.scale, "") for atom in water), "</g>",
              lines([(plane(whole[a]), plane(whole[b])) for a, b in system.bonds if a in whole and b in whole],
                    "stroke='#b03a2e' stroke-width='4' stroke-linecap='round'"),
              "<g fill='#b03a2e'>", *(circle(plane(place), 0.4 * plane.scale, "") for place in whole.values()), "</g>"]
    return plane.drawing(shapes)


def run(lmp, folder, script, *variables):
    """The system at the end of a script."""
    (folder / "in.drawn").write_text(f"include {script}\nwrite_data drawn.data nocoeff\n", encoding="utf-8")
    command = [lmp, "-log", "none", "-screen", "none", "-in", "in.drawn"]
    for name, value in variables:
        command += ["-var", name, value]
    subprocess.run(command, cwd=folder, check=True)
    return read_data(folder / "drawn.data")


def systems(lmp, dchmd, peptide, folder):
    subprocess.run([dchmd, "generate", "melt", "--chains", "80", "--beads", "100", folder / "walks.data"], check=True,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    run(lmp, folder, EXAMPLES / "in.chain.equilibrate", ("push", "300"), ("carry", "100"), ("settle", "1"))
    yield "polymers", draw_polymers(run(lmp, folder, EXAMPLES / "in.chain", ("steps", "20")))
    yield "colloids", draw_colloids(run(lmp, folder, EXAMPLES / "in.colloid"))
    yield "grains", draw_grains(run(lmp, folder, EXAMPLES / "in.granular"))
    shutil.copy(pathlib.Path(peptide) / "data.peptide", folder)
    script = (pathlib.Path(peptide) / "in.peptide").read_text(encoding="utf-8")
    assert script.rstrip().endswith("300"), "the example runs for another number of steps"
    (folder / "in.peptide").write_text(script.rstrip().removesuffix("300") + "20\n", encoding="utf-8")
    yield "biomolecules", draw_biomolecules(run(lmp, folder, "in.peptide"))


def main():
    if len(sys.argv) != 5:
        sys.exit(__doc__)
    lmp, dchmd, peptide, target = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        for name, drawing in systems(lmp, dchmd, peptide, pathlib.Path(folder)):
            (pathlib.Path(target) / f"system-{name}.svg").write_text(drawing, encoding="utf-8")


if __name__ == "__main__":
    main()
