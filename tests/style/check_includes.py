# SPDX-License-Identifier: MIT
"""The floors of the house: a folder includes only what stands below it (docs/architecture.md). Says of each include
that goes up, or that no floor knows, where it stands; exit status 1 if there is one."""
import functools
import pathlib
import re
import sys

# From the ground up. A floor is the part of a path after src/ or include/dch/; the longest one that fits holds.
FLOORS = {
    "lib": ["base", "simd", "geometry", "hierarchy", "leaves", "lists", "clusters", "engines", "grid"],
    "necklace_polymer": ["chains", "balls", "cages", "contacts", "crossing", "analysis", "generators"],
    "trajectory": ["base", "files", "frames", "process", "lammps", "gromacs", "dcd", "h5md", "topology", ""],
    "replay": ["base", "options", "input", "engines", "plot", "report", "analysis", "commands"],
    "lammps_pair_style": ["host", "points", "crossings", "clusters", "lists", "verify", "neighbor", "styles", "plugin"],
}
# What a box may include of others, beside itself.
BELOW = {
    "lib": [],
    "forces": ["lib"],
    "proximity": ["lib"],
    "kinetic": ["lib"],
    "zonotope": ["lib"],
    "zonotope_fit": ["lib", "zonotope"],
    "necklace_polymer": ["lib"],
    "power_diagram": ["lib", "necklace_polymer"],
    "trajectory": ["lib"],
    "lammps_pair_style": ["lib", "forces", "necklace_polymer"],
    "openmm_plugin": ["lib", "forces", "necklace_polymer"],
    "python": ["lib", "necklace_polymer", "proximity", "trajectory"],
    "replay": ["lib", "kinetic", "necklace_polymer", "proximity", "trajectory"],
}
ENDINGS = {".cpp", ".hpp", ".h"}


def box_of(path):
    return path.parts[0]


def sources(root):
    """Without the headers that only lead on to where others have moved."""
    return [p.relative_to(root) for box in BELOW for p in sorted((root / box).rglob("*"))
            if p.suffix in ENDINGS and "moved" not in p.parts]


class House:
    def __init__(self, root):
        self.root = root
        self.files = sources(root)
        self.by_tail = {}
        for path in self.files:
            parts = path.parts
            for k in range(1, len(parts)):
                self.by_tail.setdefault("/".join(parts[k:]), []).append(path)

    @functools.lru_cache(maxsize=None)
    def floor_of(self, path):
        """Where it stands among the floors of its box. A public header that is in no folder of a floor stands where the
        source of the same name does, and one without such a source anywhere: None."""
        floors = FLOORS[box_of(path)]
        sources_of_name = [p for p in self.files if p.stem == path.stem and box_of(p) == box_of(path) and "src" in p.parts]
        for p in [path, *sources_of_name]:
            named = [part for part in p.parts[1:-1] if part in floors]
            if named:
                return floors.index(named[0])
        return len(floors) - 1 if sources_of_name else None

    def target(self, path, name, quoted):
        """The file that an include names, or None if it is not of this house."""
        if not quoted and not name.startswith("dch/"):
            found = [p for p in self.by_tail.get(name, []) if box_of(p) == box_of(path) == "lammps_pair_style"]
        else:
            found = self.by_tail.get(name, [])
        own = [p for p in found if box_of(p) == box_of(path)]
        return (own or found or [None])[0]

    def faults(self):
        for path in self.files:
            text = (self.root / path).read_text()
            for match in re.finditer(r'^#include ([<"])([^>"]+)[>"]', text, re.MULTILINE):
                quoted, name = match[1] == '"', match[2]
                target = self.target(path, name, quoted)
                if target is None:
                    if quoted and box_of(path) in FLOORS or name.startswith("dch/"):
                        yield f"{path}: {name} is nowhere in the house"
                    continue
                yield from self.fault_of(path, target)

    def fault_of(self, path, target):
        own, other = box_of(path), box_of(target)
        if own != other:
            if other not in BELOW[own]:
                yield f"{path} includes {target}: {own} does not stand on {other}"
        elif own in FLOORS and None not in (self.floor_of(target), self.floor_of(path)):
            if self.floor_of(target) > self.floor_of(path):
                yield f"{path} includes {target}, which stands above it"


def main():
    house = House(pathlib.Path(sys.argv[1]))
    faults = sorted(set(house.faults()))
    for fault in faults:
        print(fault)
    print(f"{len(house.files)} sources, {len(faults)} includes that go up")
    return 1 if faults or not house.files else 0


if __name__ == "__main__":
    sys.exit(main())
