# SPDX-License-Identifier: MIT
"""dchmd query against all pairs and all images with NumPy, and SciPy's spanning tree and components: nearest atoms, closest
pairs, clusters and their number at every cutoff, in boxes of every kind, where atoms come and go.

    query.py DCH FOLDER_OF_TRAJECTORIES DOCS
"""

import itertools
import json
import os
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

import h5py
import numpy
from scipy.sparse import csr_matrix
from scipy.sparse.csgraph import connected_components, minimum_spanning_tree

from contact_oracle import read_dump
from dch_command import Checks, check_keys, expect_failure, run, run_example
from drawings import drawing_faults

CARDS = ["Nearest atoms", "Closest pair", "Clusters at every cutoff", "Largest cluster", "Sizes of clusters"]
OUTPUTS = ["--out", "query.h5", "--report", "report.json", "--plot", "page.html"]


def all_distances(points, cell):
    """Distances of nearest images; rows of `cell` are the periodic vectors."""
    d = points[:, None] - points[None, :]
    images = [numpy.dot(numpy.array(shift), cell) for shift in itertools.product((-2, -1, 0, 1, 2), repeat=len(cell))]
    return numpy.sqrt(min_over(((d + image) ** 2).sum(axis=2) for image in images) if len(cell) else (d**2).sum(axis=2))


def min_over(arrays):
    least = next(arrays)
    for array in arrays:
        least = numpy.minimum(least, array)
    return least


def ask(checks, command, folder, path, *options):
    """Runs the command; its report and the path of its data."""
    result = run(command, "query", path, *OUTPUTS, *options, cwd=folder)
    checks.that(result.returncode == 0 and result.stderr == "", f"query {path} {options}: {result.stderr}")
    with open(os.path.join(folder, "report.json")) as file:
        return os.path.join(folder, "query.h5"), json.load(file), result.stdout


def check_nearest(checks, what, ids, distances, found, lengths, k):
    """Rows of nearest atoms have the distances of all pairs, and name atoms at these distances, each once."""
    n = len(ids)
    others = distances + numpy.diag(numpy.full(n, numpy.inf))
    wanted = numpy.sort(others, axis=1)[:, :k]
    wanted = numpy.pad(wanted[:, : n - 1], ((0, 0), (0, max(0, k - (n - 1)))), constant_values=numpy.inf)
    checks.that(numpy.allclose(lengths, wanted, 1e-9, 0), f"{what}: distances of the nearest")
    index = {atom: place for place, atom in enumerate(ids)}
    for i, row in enumerate(found):
        named = [index[j] for j in row if j >= 0]
        ok = len(set(named)) == len(named) == min(k, n - 1) and i not in named
        ok = ok and numpy.allclose(others[i, named], lengths[i][: len(named)], 1e-9, 0)
        if not checks.that(ok, f"{what}: nearest of the id {ids[i]}: {row}"):
            return


def check_clusters(checks, what, ids, distances, cutoffs, file, rows, edges):
    """Labels are the components of all pairs within each cutoff; the tree has the weight of SciPy's."""
    labels = file["atoms/cluster"][rows]
    largest, numbers = [], []
    for column, cutoff in enumerate(cutoffs):
        number, component = connected_components(csr_matrix(distances <= cutoff), directed=False)
        smallest = {c: min(ids[component == c]) for c in range(number)}
        wanted = [smallest[c] for c in component]
        checks.that(labels[:, column].tolist() == wanted, f"{what}: clusters at {cutoff}")
        numbers.append(number)
        largest.append(int(numpy.bincount(component).max()))
    lengths = file["tree/distance"][edges]
    wanted = minimum_spanning_tree(csr_matrix(distances + 1e-300)).data
    checks.that(len(lengths) == len(ids) - 1 and numpy.allclose(lengths, numpy.sort(wanted), 1e-9, 1e-200), f"{what}: spanning tree")
    place = {atom: k for k, atom in enumerate(ids)}
    pairs = [(place[i], place[j]) for i, j in zip(file["tree/i"][edges], file["tree/j"][edges])]
    checks.that(all(numpy.isclose(distances[i, j], d, 1e-9, 0) for (i, j), d in zip(pairs, lengths)), f"{what}: edges")
    return numbers, largest, lengths


def compare(checks, what, frames, k, cutoffs, path, report):
    """@param frames [(ids, positions, cell)], as the command should have seen them"""
    all_lengths, atoms = [], 0
    with h5py.File(path) as file:
        first = [*file["frames/first"][:], len(file["atoms/id"])]
        first_edge = [*file["frames/first_edge"][:], len(file["tree/i"])]
        checks.that(len(first) == len(frames) + 1, f"{what}: {len(first) - 1} frames")
        for number, (ids, points, cell) in enumerate(frames):
            rows, edges = slice(first[number], first[number + 1]), slice(first_edge[number], first_edge[number + 1])
            place = f"{what}, frame {number}"
            checks.that(file["atoms/id"][rows].tolist() == ids.tolist(), f"{place}: ids")
            distances = all_distances(points, cell)
            check_nearest(checks, place, ids, distances, file["atoms/nearest"][rows], file["atoms/distance"][rows], k)
            numbers, largest, lengths = check_clusters(checks, place, ids, distances, cutoffs, file, rows, edges)
            all_lengths.extend(lengths)
            atoms += len(ids)
            for column, found in enumerate(report["clusters"]):
                checks.that((found["clusters"][number], found["largest"][number]) == (numbers[column], largest[column]),
                            f"{place}: {found['clusters'][number]} clusters at {cutoffs[column]}")
            i, j = file["frames/closest_i"][number], file["frames/closest_j"][number]
            least = (distances + numpy.diag(numpy.full(len(ids), numpy.inf))).min()
            a, b = numpy.searchsorted(ids, [i, j])
            checks.that(i < j and numpy.isclose(distances[a, b], least, 1e-9, 0), f"{place}: closest pair {i} {j}")
            checks.that(numpy.isclose(report["per_frame"]["closest_distance"][number], least, 1e-9, 0), f"{place}: {least}")
    lengths = numpy.array(all_lengths)
    for cutoff, clusters in zip(report["curve"]["cutoff"], report["curve"]["clusters"]):
        wanted = (atoms - numpy.count_nonzero(lengths <= cutoff)) / len(frames)
        checks.that(abs(clusters - wanted) <= 1e-9 * wanted, f"{what}: {clusters} clusters at {cutoff}, not {wanted}")
    checks.that(report["curve"]["clusters"][-1] == 1, f"{what}: the curve ends in one cluster")
    for found in report["clusters"]:
        sizes = found["sizes"]
        checks.that(sum(a * b for a, b in zip(sizes["atoms"], sizes["number"])) == atoms, f"{what}: sizes")
        checks.that(sum(sizes["number"]) == sum(found["clusters"]), f"{what}: number of sizes")
    print(f"{what}: {len(frames)} frames, {atoms // len(frames)} atoms", flush=True)


def write_dump(path, frames, bounds):
    """@param bounds lines of the box, with the words after BOX BOUNDS in front"""
    with open(path, "w") as file:
        for step, (ids, points) in enumerate(frames):
            file.write(f"ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF ATOMS\n{len(ids)}\nITEM: BOX BOUNDS {bounds}"
                       "ITEM: ATOMS id x y z\n")
            file.writelines(f"{atom} {x!r} {y!r} {z!r}\n" for atom, (x, y, z) in zip(ids, points.tolist()))


def random_frames(number, atoms, extent, change):
    """Points that shake, a tight group among them; with `change`, some of them come and go."""
    generator = numpy.random.default_rng(number)
    points = generator.uniform(0, extent, (atoms, 3))
    points[: atoms // 3] = extent / 2 + generator.normal(0, extent / 25, (atoms // 3, 3))
    points[5] = points[4]  # coincident
    frames = []
    for _ in range(4):
        kept = numpy.sort(generator.choice(atoms, atoms - 9, False)) if change else numpy.arange(atoms)
        frames.append((3 * kept + 7, points[kept]))
        points = points + generator.normal(0, extent / 400, points.shape)
    return frames


def check_boxes(checks, command, docs, folder):
    """Open, mixed and skewed boxes, atoms that come and go, several threads."""
    low = "0 10\n"
    boxes = {
        "open": ("ff ff ff\n" + 3 * low, []),
        "periodic": ("pp pp pp\n" + 3 * low, numpy.diag([10.0, 10, 10])),
        "slab": ("pp pp ff\n" + 3 * low, numpy.diag([10.0, 10, 10])[:2]),
        "skewed": ("xy xz yz pp pp pp\n0 17 4\n-4 10 3\n0 10 -4\n", numpy.array([[10.0, 0, 0], [4, 10, 0], [3, -4, 10]])),
    }
    for number, (name, (bounds, cell)) in enumerate(boxes.items()):
        for change, k, threads in ((False, 12, 1), (True, 1, 3)):
            frames = random_frames(number, 90, 10, change)
            path = os.path.join(folder, "run.lammpstrj")
            write_dump(path, frames, bounds)
            cutoffs = [0.123456789, 0.5123456789, 1.2123456789]
            data, report, _ = ask(checks, command, folder, path, "--nearest", k, "--threads", threads, "--clusters",
                                  ",".join(map(repr, [cutoffs[2], cutoffs[0], cutoffs[1]])))
            compare(checks, f"{name}, atoms change: {change}", [(ids, points, cell) for ids, points in frames], k, cutoffs,
                    data, report)
            checks.that(report["threads"] == threads, f"threads: {report['threads']}")
            check_keys(checks, report, docs, {"always", "clusters"}, "query")


def check_real(checks, command, data, docs, folder):
    """A real polymer in solvent; the page; without clusters."""
    path = os.path.join(data, "polymer.lammpstrj")
    frames = [(frame["id"].astype(int), numpy.array([frame["x"], frame["y"], frame["z"]]).T, numpy.diag(frame["box"]))
              for frame in read_dump(path)[:4:2]]
    found, report, table = ask(checks, command, folder, path, "--nearest", "3", "--clusters", "5.0123", "--frames", ":4:2")
    compare(checks, "polymer", frames, 3, [5.0123], found, report)
    shown = run_example(checks, docs, folder, "query.h5", "atoms/nearest")
    checks.that(shown.startswith("["), f"the example: {shown}")
    page = open(os.path.join(folder, "page.html")).read()
    for card in CARDS:
        checks.that(f"<h2>{card}" in page, f"the page lacks the card {card}")
    faults = drawing_faults(ElementTree.fromstring(page.split("\n", 1)[1]))  # raises unless all elements are closed
    checks.that(not faults, f"the page: {faults}")
    closest = report["closest"]
    for word in (f"the ids {closest['i']} and {closest['j']} in frame {closest['frame']}", "clusters at 5.012", "nearest no. 3"):
        checks.that(word in table, f"the table lacks {word!r}: {table}")
    _, report, table = ask(checks, command, folder, path, "--frames", "0")
    check_keys(checks, report, docs, {"always"}, "query")
    checks.that("clusters" not in table, f"no clusters were asked for: {table}")


def check_few(checks, command, folder):
    """One atom, two that coincide, more neighbors asked for than there are, and positions that overflow a square."""
    path = os.path.join(folder, "few.lammpstrj")
    bounds = "ff ff ff\n" + 3 * "0 1\n"
    write_dump(path, [([4], numpy.zeros((1, 3)))], bounds)
    data, report, table = ask(checks, command, folder, path, "--nearest", "3", "--clusters", "1")
    checks.that(report["closest"]["distance"] is None and "none: no frame has two atoms" in table, f"one atom: {table}")
    checks.that(report["clusters"][0]["clusters"] == [1] and report["curve"]["cutoff"] == [], "one cluster")
    with h5py.File(data) as file:
        checks.that(file["atoms/nearest"][:].tolist() == [[-1] * 3], "no neighbor")
        checks.that(numpy.isinf(file["atoms/distance"][:]).all() and numpy.isnan(file["frames/closest_distance"][0]), "none")
    write_dump(path, [([4, 9], numpy.full((2, 3), 1e90))], bounds)
    data, report, _ = ask(checks, command, folder, path, "--nearest", "2", "--clusters", "0,1")
    checks.that(report["closest"] == {"distance": 0, "i": 4, "j": 9, "frame": 0}, f"coincident: {report['closest']}")
    checks.that([found["clusters"] for found in report["clusters"]] == [[1], [1]], "coincident atoms are a cluster at 0")
    with h5py.File(data) as file:
        checks.that(file["atoms/nearest"][:].tolist() == [[9, -1], [4, -1]], "the one neighbor")
    write_dump(path, [([4, 9], numpy.array([[0.0, 0, 0], [1, float("nan"), 0]]))], bounds)
    expect_failure(checks, command, ["query", path, *OUTPUTS], 3, [path, "frame 0"])


def check_usage(checks, command, data):
    path = os.path.join(data, "polymer.lammpstrj")
    for options, parts in ((["--nearest", "0"], ["--nearest '0'", "from 1 to 1024"]), (["--nearest", "1025"], ["--nearest '1025'"]),
                           (["--nearest", "many"], ["--nearest 'many'"]), (["--clusters", "1,x"], ["--clusters 'x'"]),
                           (["--clusters", "-1"], ["--clusters -1", "at least 0"]), (["--clusters", "nan"], ["--clusters 'nan'"]),
                           (["--clusters", "1,"], ["--clusters ''"]), (["--threads", "0"], ["--threads '0'"]),
                           (["--clusters", ",".join(map(str, range(65)))], ["65 cutoffs", "64 are the most"]),
                           (["--frames", "42:"], [path, "frame 42"]), (["--report", "query.h5"], ["--out and --report"])):
        outputs = OUTPUTS if "--report" not in options else OUTPUTS[:2]
        expect_failure(checks, command, ["query", path, *outputs, *options], 2, parts)


def main(command, data, docs):
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        check_boxes(checks, command, docs, folder)
        check_real(checks, command, data, docs, folder)
        check_few(checks, command, folder)
    check_usage(checks, command, data)
    checks.finish()


if __name__ == "__main__":
    main(*sys.argv[1:])
