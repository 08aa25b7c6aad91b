# SPDX-License-Identifier: MIT
"""Contacts of chains by looking at all pairs with NumPy: an oracle that shares nothing with the command."""

import numpy


def read_dump(path):
    """Frames of a LAMMPS dump with orthogonal boxes: step, time if there is one, box lengths (None along an open axis),
    columns by name in order of id."""
    frames, timed, in_ns = [], False, False
    with open(path) as file:
        while line := file.readline():
            item, *words = line.removeprefix("ITEM: ").split()
            if item == "UNITS":
                in_ns = file.readline().strip() == "nano"
            elif item == "TIME":
                time = float(file.readline())
                time = round(1000 * time, 9) if in_ns else time  # to picoseconds
                timed = True
            elif item == "TIMESTEP":
                step = int(file.readline())
            elif item == "NUMBER":
                atoms = int(file.readline())
            elif item == "BOX":
                assert len(words) == 4, "orthogonal boxes alone"
                bounds = [list(map(float, file.readline().split())) for _ in range(3)]
                box = [high - low if flag[0] == "p" else None for (low, high), flag in zip(bounds, words[1:])]
            elif item == "ATOMS":
                rows = [list(map(float, file.readline().split())) for _ in range(atoms)]
                table = numpy.array(sorted(rows, key=lambda row: row[words.index("id")]))
                frames.append({"step": step, "time": time if timed else step, "box": box,
                               **{name: table[:, k] for k, name in enumerate(words)}})
                timed = False
            else:
                raise ValueError(line)
    return frames


def nearest(d, length):
    """Displacements along one axis as those to the nearest image."""
    return d if length is None else d - length * numpy.round(d / length)


def chains_by_molecule(frame):
    """[(ids in order, False)] in ascending order of first id."""
    members = {}
    for atom, molecule in zip(frame["id"].astype(int), frame["mol"].astype(int)):
        if molecule:
            members.setdefault(molecule, []).append(int(atom))
    return sorted((ids, False) for ids in members.values() if len(ids) > 1)


class Contacts:
    """The contacts of each frame as a matrix over places, the beads in order along one chain after the other."""

    def __init__(self, frames, chains, radius, gap, skip=1, pairs="all"):
        self.frames = frames
        self.ids = numpy.array([atom for ids, _ in chains for atom in ids])
        self.first = numpy.cumsum([0] + [len(ids) for ids, _ in chains])
        self.ring = [ring for _, ring in chains]
        self.chain = numpy.repeat(numpy.arange(len(chains)), numpy.diff(self.first))
        self.bonds = self.separations()
        self.same = self.chain[:, None] == self.chain[None, :]
        within = self.same & (self.bonds > skip)
        self.asked = {"all": within | ~self.same, "within": within, "between": ~self.same}[pairs]
        self.asked &= numpy.triu(numpy.ones_like(self.asked), 1)
        radii = numpy.array([radius(atom) for atom in self.ids])
        reach = radii[:, None] + radii[None, :] + gap
        self.nearest_to_reach = numpy.inf
        self.found = [self.of_frame(frame, reach) for frame in frames]

    def separations(self):
        """Bonds between two places of a chain, around a ring the shorter way; meaningless for two chains."""
        along = numpy.arange(len(self.ids))
        bonds = abs(along[:, None] - along[None, :])
        for chain, ring in enumerate(self.ring):
            if ring:
                part = slice(self.first[chain], self.first[chain + 1])
                bonds[part, part] = numpy.minimum(bonds[part, part], part.stop - part.start - bonds[part, part])
        return bonds

    def of_frame(self, frame, reach):
        rows = {int(atom): k for k, atom in enumerate(frame["id"])}
        order = [rows[atom] for atom in self.ids]
        distance2 = numpy.zeros(reach.shape)
        for axis, length in zip("xyz", frame["box"]):
            d = frame[axis][order][:, None] - frame[axis][order][None, :]
            distance2 += nearest(d, length) ** 2
        distance = numpy.sqrt(distance2)
        self.nearest_to_reach = min(self.nearest_to_reach, abs(distance - reach)[self.asked].min())
        return self.asked & (distance <= reach)

    def per_frame(self):
        """Contacts within and between chains of each frame."""
        return [[int((found & self.same).sum()) for found in self.found],
                [int((found & ~self.same).sum()) for found in self.found]]

    def events(self):
        """Sorted (id, id, first frame, frames, begin, last, begun before, not ended)."""
        events = []
        for p, q in zip(*numpy.nonzero(numpy.any(self.found, axis=0))):
            a, b = sorted((int(self.ids[p]), int(self.ids[q])))
            there = [bool(found[p, q]) for found in self.found]
            k = 0
            while k < len(there):
                if not there[k]:
                    k += 1
                    continue
                end = there.index(False, k) if False in there[k:] else len(there)
                events.append((a, b, k, end - k, self.frames[k]["time"], self.frames[end - 1]["time"], int(k == 0),
                               int(end == len(there))))
                k = end
        return sorted(events)

    def binned(self, first_place):
        """Contacts of all frames, and pairs, between the bins, both as symmetric matrices."""
        bin_of = numpy.repeat(numpy.arange(len(first_place) - 1), numpy.diff(first_place))
        sums = []
        for matrix in (sum(found.astype(int) for found in self.found), self.asked.astype(int)):
            total = numpy.zeros((len(first_place) - 1,) * 2, int)
            numpy.add.at(total, (bin_of[:, None], bin_of[None, :]), matrix)
            sums.append(total + total.T - numpy.diag(numpy.diag(total)))
        return sums

    def separation(self):
        """Contacts of all frames, and pairs, by the number of bonds between the beads."""
        longest = max((self.bonds * self.same).max(), 0) + 1
        inside = self.asked & self.same
        pairs = numpy.bincount(self.bonds[inside], minlength=longest)
        contacts = sum(numpy.bincount(self.bonds[found & self.same], minlength=longest) for found in self.found)
        return contacts, pairs


def lay_chains(frames, members, longest_bond):
    """[(ids in order, closed)] through the atoms of each list: from the first to the nearest that is left, as the largest
    distance in all frames, as long as it is below longest_bond; closed where the ends are, too, and the way around comes
    back to where it began."""
    chains = []
    for ids in members:
        row = numpy.searchsorted(frames[0]["id"], ids)  # the atoms are the same in all frames
        vectors = numpy.array([[nearest(frame[axis][row][:, None] - frame[axis][row][None, :], length)
                                for axis, length in zip("xyz", frame["box"])] for frame in frames])
        farthest = numpy.sqrt((vectors ** 2).sum(axis=1)).max(axis=0)
        left = set(range(len(ids)))
        while left:
            chain = [left.pop()]
            while left and farthest[chain[-1], following := min(left, key=lambda k: farthest[chain[-1], k])] < longest_bond:
                chain.append(following)
                left.discard(following)
            around = vectors[:, :, chain, chain[1:] + chain[:1]].sum(axis=2)
            closed = len(chain) > 2 and farthest[chain[-1], chain[0]] < longest_bond and abs(around).max() < 1e-6
            chains.append(([int(ids[k]) for k in chain], bool(closed)))
    return chains
