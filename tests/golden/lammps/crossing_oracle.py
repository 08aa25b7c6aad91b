# SPDX-License-Identifier: GPL-2.0-or-later
"""Which bonds went through each other between two frames of a dump, by all pairs and in exact arithmetic."""

import numpy

ROWS = 200  # of bonds that are compared with all others at once
MARGIN = 1e-4  # beyond which doubles decide
UNIT_BITS = 200  # of the integers that stand for coordinates: their last digit is 2^-200
DEPTH = 50  # halvings of the step: roots closer to each other than that are one that touches


class Frame:
    """A frame of `dump custom ... id x y z ix iy iz`, sorted by ID."""

    def __init__(self, step, cell, low, rows):
        self.step, self.cell, self.low = step, cell, low
        self.ids = rows[:, 0].astype(int)
        self.positions, self.counts = rows[:, 1:4], rows[:, 4:7]


def read_frames(path):
    frames, lines = [], path.read_text().splitlines()
    at = 0
    while at < len(lines):
        step, rows = int(lines[at + 1]), int(lines[at + 3])
        bounds = numpy.array([list(map(float, line.split())) for line in lines[at + 5:at + 8]])
        table = numpy.array([list(map(float, line.split())) for line in lines[at + 9:at + 9 + rows]])
        xy, xz, yz = bounds[:, 2] if bounds.shape[1] == 3 else (0.0, 0.0, 0.0)
        low = bounds[:, 0] - [min(0, xy, xz, xy + xz), min(0, yz), 0]
        high = bounds[:, 1] - [max(0, xy, xz, xy + xz), max(0, yz), 0]
        edges = high - low
        cell = numpy.array([[edges[0], xy, xz], [0, edges[1], yz], [0, 0, edges[2]]])
        frames.append(Frame(step, cell, low, table))
        at += 9 + rows
    return frames


def read_rows(path):
    """Rows of all frames of a dump local: [(step, rows)]."""
    frames, lines = [], path.read_text().splitlines()
    at = 0
    while at < len(lines):
        step, count = int(lines[at + 1]), int(lines[at + 3])
        rows = [list(map(float, line.split())) for line in lines[at + 9:at + 9 + count]]
        frames.append((step, rows))
        at += 9 + count
    return frames


def read_bonds(path):
    """Bonds of a data file, as IDs, ascending."""
    lines = iter(path.read_text().splitlines())
    for line in lines:
        if line.split()[:1] == ["Bonds"]:
            break
    next(lines)
    bonds = []
    for line in lines:
        if not line.strip():
            break
        i, j = map(int, line.split()[2:4])
        bonds.append((min(i, j), max(i, j)))
    return bonds


def cross(u, v):
    return (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])


def dot(u, v):
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]


def single_roots(at):
    """Roots in (0, 1) of a cubic where it changes its sign, as [(low, high)] times 2^DEPTH. `at`: its values at 0, 1/3, 2/3
    and 1, all times a number."""
    a, b, c, d = at
    # Bernstein coefficients, times 6 and, with each halving, times 8.
    pieces = [(0, 0, (6 * a, -5 * a + 18 * b - 9 * c + 2 * d, 2 * a - 9 * b + 18 * c - 5 * d, 6 * d))]
    roots = []
    while pieces:
        low, depth, (p, q, r, s) = pieces.pop()
        signs = [x > 0 for x in (p, q, r, s)]
        changes = sum(x != y for x, y in zip(signs, signs[1:]))
        if changes == 0 or (depth == DEPTH and changes > 1):
            continue
        width = 1 << (DEPTH - depth)
        if depth == DEPTH:
            roots.append((low, low + width))
            continue
        pq, qr, rs = p + q, q + r, r + s
        pqr, qrs = pq + qr, qr + rs
        middle = pqr + qrs
        pieces += [(low, depth + 1, (8 * p, 4 * pq, 2 * pqr, middle)),
                   (low + width // 2, depth + 1, (middle, 2 * qrs, 4 * rs, 8 * s))]
    return sorted(roots)


def whole(x):
    """x times 2^UNIT_BITS."""
    numerator, denominator = float(x).as_integer_ratio()
    assert denominator <= 1 << UNIT_BITS
    return numerator * ((1 << UNIT_BITS) // denominator)


def passages(p, q):
    """[(time, sign)] of bonds p and q, each (a before, b before, a now, b now). In integers: multiples of 2^-UNIT_BITS."""
    exact = [[tuple(map(whole, end)) for end in bond] for bond in (p, q)]

    def state(t, scale):
        """The bonds and what is between their beginnings at t / scale, times scale."""
        (pa, pb), (qa, qb) = [[tuple((scale - t) * x + t * y for x, y in zip(bond[k], bond[k + 2])) for k in (0, 1)]
                              for bond in exact]
        u, v, d = [tuple(x - y for x, y in zip(*ends)) for ends in ((pb, pa), (qb, qa), (qa, pa))]
        return u, v, d

    def volume(t, scale):
        u, v, d = state(t, scale)
        return dot(cross(u, v), d)

    found = []
    for low, high in single_roots([volume(third, 3) for third in range(4)]):
        u, v, d = state(low + high, 2 << DEPTH)
        n = cross(u, v)
        along = [dot(cross(d, w), n) / dot(n, n) for w in (v, u)]
        assert all(min(abs(x), abs(x - 1)) > 1e-9 for x in along), "a crossing at a bead: choose other positions"
        if all(0 < x < 1 for x in along):
            rises = volume(high, 1 << DEPTH) > volume(low, 1 << DEPTH)
            found.append(((low + high) / (2 << DEPTH), 1 if rises else -1))
    return found


def crossings(old, new, bonds):
    """{(ID, ID, ID, ID): [(step, sign)]} of pairs of bonds without a common atom, from one frame to the next."""
    assert (old.ids == new.ids).all()
    place = {tag: k for k, tag in enumerate(new.ids)}
    lattice = old.cell @ numpy.rint(numpy.linalg.inv(old.cell) @ new.cell)  # the old one in the basis of now
    start = old.positions + old.counts @ old.cell.T - new.counts @ lattice.T
    i, j = (numpy.array([place[bond[k]] for bond in bonds]) for k in (0, 1))

    def image(a, b):
        return numpy.rint((a - b) @ numpy.linalg.inv(new.cell).T)

    shift = image(new.positions[i], new.positions[j])
    ends = numpy.stack([start[i], start[j] + shift @ lattice.T, new.positions[i], new.positions[j] + shift @ new.cell.T])
    middles = ends.mean(axis=0)
    radius = numpy.sqrt(((ends - middles) ** 2).sum(axis=2)).max(axis=0)
    found = {}
    for first in range(0, len(bonds), ROWS):
        p, q = numpy.meshgrid(numpy.arange(first, min(first + ROWS, len(bonds))), numpy.arange(len(bonds)), indexing="ij")
        p, q = p[q > p], q[q > p]
        count = image(middles[p], middles[q])
        apart = middles[q] + count @ (0.5 * (lattice + new.cell)).T - middles[p]
        near = (apart ** 2).sum(axis=1) < (radius[p] + radius[q] + 1e-6) ** 2
        p, q, count = p[near], q[near], count[near]
        moved = ends[:, q] + numpy.stack([count @ cell.T for cell in (lattice, lattice, new.cell, new.cell)])
        for k in numpy.flatnonzero(volumes_differ(ends[:, p], moved)):
            pair = tuple(bonds[p[k]]) + tuple(bonds[q[k]])
            if len(set(pair)) < 4 or not may_cross(ends[:, p[k]], moved[:, k]):
                continue
            events = passages(ends[:, p[k]], moved[:, k])
            if events:
                found[pair] = [(old.step + t * (new.step - old.step), sign) for t, sign in events]
    return found


def may_cross(p, q):
    """False where the lines through the bonds meet well outside of these; by doubles, so that few need integers."""
    lines = [(x, y - x) for x, y in ((p[1] - p[0], p[3] - p[2]), (q[1] - q[0], q[3] - q[2]), (q[0] - p[0], q[2] - p[2]))]
    values = [numpy.dot(numpy.cross(u, v), d) for u, v, d in ([x + t * y for x, y in lines] for t in (0, 1 / 3, 2 / 3, 1))]
    for root in numpy.roots(numpy.polyfit((0, 1 / 3, 2 / 3, 1), values, 3)):
        if abs(root.imag) > MARGIN or not -MARGIN < root.real < 1 + MARGIN:
            continue
        u, v, d = [x + root.real * y for x, y in lines]
        n = numpy.cross(u, v)
        if root.imag != 0 or numpy.dot(n, n) < MARGIN:
            return True
        along = [numpy.dot(numpy.cross(d, w), n) / numpy.dot(n, n) for w in (v, u)]
        if all(-MARGIN < x < 1 + MARGIN for x in along):
            return True
    return False


def volumes_differ(p, q):
    """False where the cubic's Bernstein coefficients have one sign, well beyond rounding."""
    def volume(t):
        a, b, c, d = [(1 - t) * bond[k] + t * bond[k + 2] for bond in (p, q) for k in (0, 1)]
        return (numpy.cross(b - a, d - c) * (c - a)).sum(axis=1)

    a, b, c, d = volume(0.0), volume(1 / 3), volume(2 / 3), volume(1.0)
    all_four = numpy.array([a, (-5 * a + 18 * b - 9 * c + 2 * d) / 6, (2 * a - 9 * b + 18 * c - 5 * d) / 6, d])
    return (all_four.min(axis=0) < 1e-9) & (all_four.max(axis=0) > -1e-9)
