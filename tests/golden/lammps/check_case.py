#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""One script, native and with DCH lists: same lists, same energies, verified at every rebuild.

The lists at step 0 are compared here, from dumps through LAMMPS's C interface; those of every rebuild by `dch verify`.
"""

import argparse
import re
import sys
from collections import Counter

import numpy

from lammps_run import SCRIPTS, Host, largest_relative_difference, thermo_tables

STEP_0_TOLERANCE = 1e-12
LAST_STEP_TOLERANCE = 1e-6  # the order of additions differs, and trajectories are chaotic


def require(condition, message, output=""):
    if not condition:
        sys.exit(f"FAILED: {message}\n{output}")


def read_dump(prefix, ranks):
    """The pairs of every list, sorted: rows of list, low ID, high ID, box vectors between them, special bits."""
    box, positions, pairs = None, {}, []
    for rank in range(ranks):
        with open(f"{prefix}.{rank}", encoding="ascii") as lines:
            for line in lines:
                kind, _, words = line.partition(" ")
                if kind == "box":
                    box = list(map(float, words.split()))
                elif kind == "atom":
                    tag, *position = words.split()
                    positions[int(tag)] = list(map(float, position))
                else:
                    pairs.append(words)
    rows = canonical(numpy.loadtxt(pairs, ndmin=2).reshape(-1, 7), box, positions)
    return rows[numpy.lexsort(rows.T)]


def canonical(pairs, box, positions):
    by_tag = numpy.zeros((max(positions) + 1, 3))
    by_tag[list(positions)] = list(positions.values())
    number, i, j = pairs[:, :3].astype(int).T
    image = box_vectors(pairs[:, 3:6] - (by_tag[j] - by_tag[i]), box)
    # Of a pair of an atom with its own image, the one whose first box vector that is not 0 counts up.
    first = numpy.take_along_axis(image, (image != 0).argmax(axis=1)[:, None], axis=1)[:, 0]
    turned = (i > j) | ((i == j) & (first < 0))
    image[turned] *= -1
    return numpy.column_stack([number, numpy.minimum(i, j), numpy.maximum(i, j), image, pairs[:, 6].astype(int)])


def box_vectors(shift, box):
    """Whole numbers of box vectors that the shifts consist of."""
    xlo, ylo, zlo, xhi, yhi, zhi, xy, yz, xz = box
    c = numpy.rint(shift[:, 2] / (zhi - zlo))
    b = numpy.rint((shift[:, 1] - c * yz) / (yhi - ylo))
    a = numpy.rint((shift[:, 0] - c * xz - b * xy) / (xhi - xlo))
    return numpy.column_stack([a, b, c]).astype(int)


def only_in(first, second):
    """The rows that the first has more of."""
    return list((Counter(map(tuple, first.tolist())) - Counter(map(tuple, second.tolist()))).elements())


def check_lists_at_start(host, case, ranks, variables):
    dumps = []
    for lists in ("stock", "dch"):
        prefix = host.work / f"dump.{lists}"
        code, output = host.run(ranks, [host.tools / "list_dump", prefix, case],
                                {**variables, "lists": lists, "load": host.loader, "steps": 0})
        require(code == 0, f"list_dump of the {lists} lists ended with {code}", output)
        dumps.append(read_dump(prefix, ranks))
    native, ours = dumps
    require(len(native) > 0, "the native lists are empty: the case tests nothing")
    if not numpy.array_equal(native, ours):
        missing, invented = only_in(native, ours), only_in(ours, native)
        require(False, f"lists differ at step 0: {len(missing)} pairs only native, {len(invented)} only DCH, "
                f"for example {(missing + invented)[0]}")
    return len(native)


def check_run(host, case, ranks, variables, expected_list, rounding):
    outputs = []
    for lists, load in (("stock", "/dev/null"), ("dch", host.loader)):
        code, output = host.run(ranks, [host.lmp, "-in", case], {**variables, "lists": lists, "load": load})
        require(code == 0, f"the {lists} run ended with {code}", output)
        outputs.append(output)
    native, ours = (thermo_tables(output)[-1] for output in outputs)
    first = largest_relative_difference(native[0], ours[0])
    last = largest_relative_difference(native[-1], ours[-1])
    require(first <= STEP_0_TOLERANCE + 10 * rounding, f"thermo output at step 0 differs by {first:.3g}", outputs[1])
    require(last <= LAST_STEP_TOLERANCE + 1e5 * rounding, f"thermo output after the run differs by {last:.3g}", outputs[1])

    builds = [int(re.findall(r"Neighbor list builds = (\d+)", output)[-1]) for output in outputs]
    keeps_lists = "expiry                  exact" in outputs[1]
    require(builds[0] == builds[1] or (keeps_lists and builds[1] < builds[0]),
            f"{builds[0]} native builds but {builds[1]} with DCH lists", outputs[1])
    verified = re.search(r"verified +(\d+) builds, (\d+) pairs, all equal", outputs[1])
    require(verified, "dch stats does not say that builds were verified", outputs[1])
    require(int(verified[1]) == builds[1] + 1 and int(verified[1]) > 3,
            f"{verified[1]} of {builds[1] + 1} builds were verified; at least 4 are needed", outputs[1])
    require(int(verified[2]) > 0, "no pair was compared", outputs[1])
    require(f"{expected_list}: DCH" in outputs[1], f"no line '{expected_list}: DCH' in dch stats", outputs[1])
    return first, verified


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    Host.add_arguments(parser)
    parser.add_argument("--case", required=True)
    parser.add_argument("--ranks", type=int, required=True)
    parser.add_argument("--list", required=True, help="the list that dch stats has to show as ours")
    parser.add_argument("--rounding", type=float, default=0,
                        help="by how much ghosts are rounded in a wide box: energies depend on the side of a pair")
    parser.add_argument("--var", nargs=2, action="append", default=[])
    arguments = parser.parse_args()
    host = Host(arguments)
    case = SCRIPTS / f"in.{arguments.case}"
    variables = dict(arguments.var)
    pairs = check_lists_at_start(host, case, arguments.ranks, variables)
    difference, verified = check_run(host, case, arguments.ranks, variables, arguments.list,
                                     arguments.rounding)
    print(f"{pairs} pairs equal at step 0, energies to {difference:.2g}; {verified[0]}")


if __name__ == "__main__":
    main()
