# SPDX-License-Identifier: MIT
"""Which bonds go through each other between frames: the roots of all pairs' cubics in all images, with NumPy."""

import itertools

import numpy

CHAIN = 12
BOXES = {
    "none": ("ff ff ff\n" + 3 * "0 1\n", numpy.empty((0, 3))),
    "periodic": ("pp pp pp\n" + 3 * "0 9\n", numpy.diag([9.0, 9, 9])),
    "skewed": ("xy xz yz pp pp pp\n0 16 4\n-4 9 3\n0 9 -4\n", numpy.array([[9.0, 0, 0], [4, 9, 0], [3, -4, 9]])),
}


def at(vectors, t):
    return (1 - t) * vectors[0] + t * vectors[1]


def crossings_of(p, q):
    """Time, where on both bonds, and sign. Bonds as arrays (time 0 or 1, end, xyz). The roots of det[b_P, b_Q, q - p] where both
    meet inside; the sign is that by which it falls."""
    b_p, b_q, d = p[:, 1] - p[:, 0], q[:, 1] - q[:, 0], q[:, 0] - p[:, 0]
    times = numpy.array([0.0, 1 / 3, 2 / 3, 1])
    values = [numpy.linalg.det([at(b_p, t), at(b_q, t), at(d, t)]) for t in times]
    cubic = numpy.linalg.solve(numpy.vander(times), values)
    for root in numpy.roots(cubic):
        if abs(root.imag) > 1e-9 or not 0 < root.real < 1:
            continue
        t = root.real
        (u, v), *_ = numpy.linalg.lstsq(numpy.array([at(b_p, t), -at(b_q, t)]).T, at(d, t), rcond=None)
        if 0 < u < 1 and 0 < v < 1:
            yield t, u, v, -numpy.sign(numpy.polyval(numpy.polyder(cubic), t))


def bonds_of_chains(beads):
    return [(k, k + 1) for k in range(beads - 1) if (k + 1) % CHAIN != 0]


def all_crossings(frames, cell, bonds):
    """(frame, bond, bond, time, on the first, on the second, sign) of unwrapped positions, by frame, bonds and time."""
    events = []
    shifts = numpy.array([n @ cell if len(cell) else numpy.zeros(3) for n in
                          map(numpy.array, itertools.product((-2, -1, 0, 1, 2), repeat=len(cell)))])
    for number in range(1, len(frames)):
        moved = numpy.array(frames[number - 1 : number + 1])[:, bonds]  # time, bond, end, xyz
        middles = moved.mean((0, 2))
        radii = numpy.linalg.norm(moved - middles[None, :, None], axis=3).max((0, 2))
        for p, q in itertools.combinations(range(len(bonds)), 2):
            if set(bonds[p]) & set(bonds[q]):
                continue
            apart = numpy.linalg.norm(middles[q] + shifts - middles[p], axis=1)
            for shift in shifts[apart < radii[p] + radii[q]]:
                events += [(number, bonds[p], bonds[q], *event)
                           for event in sorted(crossings_of(moved[:, p], moved[:, q] + shift))]
    return events


def random_chains(seed, chains, frames, speed):
    """Unwrapped positions of random walks that shake."""
    random = numpy.random.default_rng(seed)
    steps = random.normal(size=(chains, CHAIN, 3))
    steps *= 0.9 / numpy.linalg.norm(steps, axis=2)[:, :, None]
    steps[:, 0] = random.uniform(0, 5, (chains, 3))
    first = steps.cumsum(axis=1).reshape(-1, 3)
    moves = random.uniform(-speed, speed, (frames - 1, *first.shape)).cumsum(axis=0)
    return [first, *(first + moves)]


def wrapped(points, cell):
    return points - numpy.floor(points @ numpy.linalg.inv(cell)) @ cell if len(cell) else points
