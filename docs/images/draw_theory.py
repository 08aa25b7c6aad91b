#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Draws the pictures of docs/theory.md from a hierarchy that this script makes by the definition.

usage: draw_theory.py FOLDER; writes theory-levels.svg, theory-edges.svg and theory-droplet.svg, which moves
"""
import math
import pathlib
import random
import sys

RADIUS = 10.0  # R_0: a center covers the points this near
CUTOFF = 18.0  # rho_0: the neighbors of a point are this near
SIDE = 200.0
PERIOD, MOMENTS = 12, 36  # of the drop that moves: seconds, and how many are drawn
COLORS = ("#444444", "#1f5fbf", "#d98c00", "#2e8b57")


def scene():
    """A dense drop and a thin gas around it."""
    numbers = random.Random(7)
    points = []
    while len(points) < 110:
        spread = 27 if len(points) < 70 else 75
        point = (SIDE / 2 + numbers.uniform(-spread, spread), SIDE / 2 + numbers.uniform(-spread, spread))
        if all(math.dist(point, other) > 3.5 for other in points):
            points.append(point)
    return points


def levels_of(points):
    """Levels of (nodes, parents): a node becomes a center unless one is within R_i, and its parent is the nearest center."""
    nodes, radius, levels = list(range(len(points))), RADIUS, []
    while True:
        centers = []
        for node in nodes:
            if all(math.dist(points[node], points[center]) > radius for center in centers):
                centers.append(node)
        parents = {node: min(centers, key=lambda center: math.dist(points[node], points[center])) for node in nodes}
        levels.append((nodes, parents))
        if len(centers) == 1:
            levels.append((centers, {}))
            return levels
        nodes, radius = centers, 2 * radius


def circle(place, radius, look):
    return f"<circle cx='{place[0]:.1f}' cy='{place[1]:.1f}' r='{radius:.1f}' {look}/>"


def lines(pairs, look):
    steps = "".join(f"M{a[0]:.0f} {a[1]:.0f}L{b[0]:.0f} {b[1]:.0f}" for a, b in pairs)
    return f"<path d='{steps}' {look}/>"


def panel(column, title, shapes):
    left = column * (SIDE + 20) + 10
    return [f"<g transform='translate({left:.0f} 26)'>", f"<text x='0' y='-9'>{title}</text>",
            f"<svg width='{SIDE:.0f}' height='{SIDE:.0f}'>",
            f"<rect width='{SIDE:.0f}' height='{SIDE:.0f}' fill='none' stroke='#cccccc'/>", *shapes, "</svg></g>"]


def drawing(panels):
    width = len(panels) * (SIDE + 20)
    shapes = [shape for column, (title, content) in enumerate(panels) for shape in panel(column, title, content)]
    head = f"<svg xmlns='http://www.w3.org/2000/svg' width='{width:.0f}' height='{SIDE + 36:.0f}' font-family='sans-serif' font-size='12'>"
    return "\n".join([head, "<rect width='100%' height='100%' fill='white'/>", *shapes, "</svg>"]) + "\n"


def draw_levels(points, levels):
    panels = []
    for level in range(3):
        nodes, parents = levels[level]
        below, above, radius = COLORS[level], COLORS[level + 1], RADIUS * 2**level
        centers = levels[level + 1][0]
        shapes = [circle(points[node], radius, f"fill='{above}' fill-opacity='0.07' stroke='{above}' stroke-opacity='0.5'")
                  for node in centers]
        shapes.append(lines([(points[node], points[parents[node]]) for node in nodes if parents[node] != node], f"stroke='{above}'"))
        shapes += [circle(points[node], 2, f"fill='{below}'") for node in nodes]
        shapes += [circle(points[node], 3.5, f"fill='{above}'") for node in centers]
        panels.append((f"{len(nodes)} nodes of level {level}, {len(centers)} centers", shapes))
    return drawing(panels)


def pairs_within(points, nodes, reach):
    return [(a, b) for k, a in enumerate(nodes) for b in nodes[:k] if math.dist(points[a], points[b]) <= reach]


def draw_edges(points, levels):
    panels, reach = [], CUTOFF
    for level in range(3):
        nodes, _ = levels[level]
        edges = pairs_within(points, nodes, reach)
        shapes = [lines([(points[a], points[b]) for a, b in edges], f"stroke='{COLORS[level]}' stroke-opacity='0.45'")]
        shapes += [circle(points[node], 2 + level * 0.7, f"fill='{COLORS[level]}'") for node in nodes]
        panels.append((f"{len(edges)} edges of level {level}", shapes))
        parents = levels[level][1]
        reach += 2 * RADIUS * 2**level
        for a, b in edges:  # what the page says of parents
            assert math.dist(points[parents[a]], points[parents[b]]) <= reach
    return drawing(panels)


def droplet(share):
    """A drop that swings between long and flat while its points turn, and a few that leave it and return. share: of a period."""
    numbers, turn, points = random.Random(11), 2 * math.pi * share, []
    stretch = 1 + 0.45 * math.sin(turn)
    while len(points) < 90:
        radius, angle, phase = 48 * math.sqrt(numbers.random()), numbers.uniform(0, 2 * math.pi), numbers.uniform(0, 2 * math.pi)
        if len(points) % 9 == 0:
            radius += 38 * math.sin(turn / 2 + phase) ** 4
        angle += 0.5 * math.sin(turn + radius / 40)
        points.append((SIDE / 2 + radius * stretch * math.cos(angle), SIDE / 2 + radius / stretch * math.sin(angle)))
    return points


def animated(name, values, look=""):
    return f"<{name} dur='{PERIOD}s' repeatCount='indefinite' values='{';'.join(values)}' {look}/>"


def draw_droplet():
    """Points with the balls of the first two levels of centers: a ball is seen while its point is a center."""
    moments = [droplet(k / MOMENTS) for k in range(MOMENTS)]
    levels = [levels_of(points) for points in moments]
    balls, dots = [], []
    for point in range(len(moments[0])):
        places = [f"{points[point][0]:.1f} {points[point][1]:.1f}" for points in moments]
        motion = animated("animateTransform", [*places, places[0]], "attributeName='transform' type='translate'")
        for level in (2, 1):
            is_center = [len(found) > level and point in found[level][0] for found in levels]
            if not any(is_center):
                continue
            seen = animated("animate", ["1" if there else "0" for there in is_center], "attributeName='opacity' calcMode='discrete'")
            ball = circle((0, 0), RADIUS * 2**(level - 1), f"fill='{COLORS[level]}' fill-opacity='0.1' stroke='{COLORS[level]}'")
            balls.append(f"<g opacity='{int(is_center[0])}'>{seen}<g transform='translate({places[0]})'>{motion}{ball}</g></g>")
        dots.append(f"<g transform='translate({places[0]})'>{motion}{circle((0, 0), 2, f'fill={COLORS[0]!r}')}</g>")
    return drawing([("a drop that moves, and its centers", balls + dots)])


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[1])
    points = scene()
    levels = levels_of(points)
    (folder / "theory-levels.svg").write_text(draw_levels(points, levels), encoding="utf-8")
    (folder / "theory-edges.svg").write_text(draw_edges(points, levels), encoding="utf-8")
    (folder / "theory-droplet.svg").write_text(draw_droplet(), encoding="utf-8")


if __name__ == "__main__":
    main()
