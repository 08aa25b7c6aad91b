# SPDX-License-Identifier: MIT
"""Plots as SVG, to stand in the page of the report or in a file."""

import html
import math

PLOT_WIDTH, PLOT_HEIGHT, ROW = 340, 270, 22
TOP, BOTTOM, LETTER = 14, 48, 6.6  # LETTER: width of one, generously
COLORS = ("#1b5fc1", "#e08e0b", "#2e8b57", "#c0392b", "#8e44ad", "#00838f", "#7a5230", "#d6508f", "#555555", "#7aa9e8")
GRID = "#e6e6e6"


class Axis:
    """Values to pixels; a logarithmic one has a place of its own for 0, one decade below the least value."""

    def __init__(self, values, begin, end, logarithmic, from_zero=False):
        self.begin, self.end, self.logarithmic = begin, end, logarithmic
        self.has_zero = logarithmic and min(values) <= 0
        if logarithmic:
            logs = [math.log10(v) for v in values if v > 0] or [0.0]
            margin = 0.04 * (max(logs) - min(logs)) or 0.5
            self.low, self.high = min(logs) - margin, max(logs) + margin
            if self.has_zero:
                self.low = math.floor(self.low) - 1
        else:
            margin = 0.05 * (max(values) - min(values)) or 0.5 * abs(max(values)) or 1.0
            self.low, self.high = 0 if from_zero else min(values) - margin, max(values) + margin

    def at(self, value):
        if self.logarithmic:
            value = math.log10(value) if value > 0 else self.low
        return self.begin + (value - self.low) / (self.high - self.low) * (self.end - self.begin)

    def ticks(self):
        """Value and label."""
        return self.logarithmic_ticks() if self.logarithmic else self.linear_ticks()

    def logarithmic_ticks(self):
        first = math.floor(self.low) + 1 if self.has_zero else math.floor(self.low)
        decades = range(first, math.ceil(self.high) + 1)
        every = math.ceil(len(decades) / 9)
        for steps in ((1,), (1, 2, 5), (1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8)):
            found = [step * 10.0**k for k in decades if k % every == 0 for step in steps]
            inside = [(v, label_of(v)) for v in found if self.low - 1e-9 <= math.log10(v) <= self.high + 1e-9]
            if len(inside) >= 4:
                break
        return ([(0.0, "0")] if self.has_zero else []) + inside

    def linear_ticks(self):
        step = 10 ** math.floor(math.log10(self.high - self.low))
        while (self.high - self.low) / step < 4:
            step /= 2
        return [(k * step, label_of(k * step)) for k in range(math.ceil(self.low / step), math.floor(self.high / step) + 1)]


def label_of(value):
    if value != 0 and not 1e-3 <= abs(value) < 1e6:
        return f"{value:.0e}".replace("e-0", "e-").replace("e+0", "e")
    return f"{value:,.6g}" if abs(value) >= 1000 else f"{value:.6g}"


def width_of(words):
    return LETTER * max((len(word) for word in words), default=0)


def text(x, y, what, anchor="middle", extra=""):
    return f"<text x='{x:.1f}' y='{y:.1f}' text-anchor='{anchor}' {extra}>{html.escape(what)}</text>"


def line(x1, y1, x2, y2, color=GRID):
    return f"<line x1='{x1:.1f}' y1='{y1:.1f}' x2='{x2:.1f}' y2='{y2:.1f}' stroke='{color}'/>"


def mark(x, y, color, name, radius=3.5):
    return f"<circle cx='{x:.1f}' cy='{y:.1f}' r='{radius}' fill='{color}'><title>{html.escape(name)}</title></circle>"


def document(width, height, parts):
    """White, since a page may be dark."""
    return (f"<svg xmlns='http://www.w3.org/2000/svg' width='{width:.0f}' height='{height:.0f}' "
            f"viewBox='0 0 {width:.0f} {height:.0f}' font-family='sans-serif' font-size='11'>"
            f"<rect width='100%' height='100%' fill='white'/>{''.join(parts)}</svg>")


def legend(names, x):
    parts = []
    for k, name in enumerate(names):
        parts.append(mark(x + 16, TOP + 8 + 18 * k, COLORS[k % len(COLORS)], name, 4))
        parts.append(text(x + 26, TOP + 12 + 18 * k, name, "start"))
    return parts


def x_axis(x, bottom, title):
    parts = []
    last_end = -math.inf
    for value, label in x.ticks():
        parts.append(line(x.at(value), TOP, x.at(value), bottom))
        if x.at(value) - width_of([label]) / 2 > last_end:  # labels may not run into each other
            parts.append(text(x.at(value), bottom + 15, label))
            last_end = x.at(value) + width_of([label]) / 2
    return parts + [text((x.begin + x.end) / 2, bottom + 34, title)]


def y_axis(x, y, title):
    parts = []
    for value, label in y.ticks():
        parts.append(line(x.begin, y.at(value), x.end, y.at(value)))
        parts.append(text(x.begin - 6, y.at(value) + 4, label, "end"))
    middle = (TOP + y.begin) / 2
    return parts + [text(14, middle, title, extra=f"transform='rotate(-90 14 {middle:.1f})'")]


def curves(plot):
    """A line from point to point as they are given, with a mark at each that names its values, and beside it the second
    one in the series that are to be labelled."""
    values = [point for points in plot["series"].values() for point in points]
    left = 36 + LETTER * 6
    x = Axis([p[0] for p in values], left, left + PLOT_WIDTH, plot.get("logarithmic_x", False))
    y = Axis([p[1] for p in values], TOP + PLOT_HEIGHT, TOP, plot["logarithmic"], plot.get("from_zero", False))
    parts = x_axis(x, y.begin, plot["x"]) + y_axis(x, y, plot["y"])
    for k, (name, points) in enumerate(plot["series"].items()):
        color = COLORS[k % len(COLORS)]
        path = " ".join(f"{x.at(a):.1f},{y.at(b):.1f}" for a, b in points)
        parts.append(f"<polyline points='{path}' fill='none' stroke='{color}' stroke-opacity='.5'/>")
        parts += [mark(x.at(a), y.at(b), color, f"{name}: {a:.4g}, {b:.3g}") for a, b in points]
        if name in plot.get("labelled", ()):
            parts += [text(x.at(a) + 6, y.at(b) + 12, f"{b:,.6g}", "start") for a, b in points]
    parts += legend(plot["series"], x.end)
    height = max(TOP + PLOT_HEIGHT, TOP + 18 * len(plot["series"])) + BOTTOM
    return document(x.end + 36 + width_of(plot["series"]), height, parts)


def dots(plot):
    """A row for each name, a mark for each series in it, and a line at 1."""
    rows = list(dict.fromkeys(name for points in plot["series"].values() for name, _ in points))
    left, bottom = 12 + width_of(rows), TOP + ROW * max(len(rows), math.ceil(18 / ROW * len(plot["series"])))
    x = Axis([v for points in plot["series"].values() for _, v in points] + [1.0], left, left + PLOT_WIDTH, True)
    parts = x_axis(x, bottom, plot["x"])
    for k, name in enumerate(rows):
        height = TOP + ROW * (k + 0.5)
        parts += [line(left, height, x.end, height), text(left - 8, height + 4, name, "end")]
    parts.append(line(x.at(1), TOP, x.at(1), bottom, "#333333"))
    for k, (name, points) in enumerate(plot["series"].items()):
        parts += [mark(x.at(value), TOP + ROW * (rows.index(row) + 0.5), COLORS[k % len(COLORS)], f"{row}, {name}: {value:.3g}")
                  for row, value in points]
    parts += legend(plot["series"], x.end)
    return document(x.end + 36 + width_of(plot["series"]), bottom + BOTTOM, parts)


def svg(plot):
    """The plot of a record, or "" if it has no points."""
    if not any(plot["series"].values()):
        return ""
    return dots(plot) if plot.get("kind") == "dots" else curves(plot)
