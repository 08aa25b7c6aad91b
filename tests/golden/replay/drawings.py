# SPDX-License-Identifier: MIT
"""Faults in the drawings of a page, found from the page alone: words that leave their drawing or run into others, and
shapes without a color. A browser fills a shape that no rule of the style sheet speaks of with black."""

import re

SIZE = 12  # pixels, of all words: the style sheet's font
WIDTHS = {" ": 0.32, ".": 0.32, ",": 0.32, ":": 0.34, "i": 0.28, "j": 0.28, "l": 0.28, "f": 0.36, "t": 0.4, "r": 0.42, "(": 0.4,
          ")": 0.4, "-": 0.37, "m": 0.98, "w": 0.82, "%": 0.96, "M": 0.87, "W": 1.0}  # of DejaVu Sans, a wide one, in sizes
DIGIT, LETTER = 0.64, 0.62
ANCHORS = {"end": 1.0, "middle": 0.5, "start": 0.0}


def rules_of(style):
    """[(selector without "svg", {property: value})], in order."""
    found = []
    for selectors, body in re.findall(r"([^{}]+)\{([^{}]*)\}", style):
        properties = dict(part.split(":", 1) for part in body.split(";") if ":" in part)
        properties = {name.strip(): value.strip() for name, value in properties.items()}
        found += [(selector.strip().removeprefix("svg "), properties) for selector in selectors.split(",")]
    return found


def look_of(element, rules):
    """Properties of an element by its name and its classes; later rules win, as all are about as specific."""
    tag, classes = element.tag.split("}")[-1], element.get("class", "").split()
    look = {}
    for selector, properties in sorted(rules, key=lambda rule: rule[0].count(".")):
        names = selector.split(".")
        if names[0] in ("", tag) and all(name in classes for name in names[1:]) and selector:
            look.update(properties)
    return look


def box_of(word, look):
    width = SIZE * sum(WIDTHS.get(c, DIGIT if c.isdigit() else LETTER) for c in word.text)
    left = float(word.get("x")) - ANCHORS[look.get("text-anchor", "start")] * width
    base = float(word.get("y"))
    return left, base - 0.8 * SIZE, left + width, base + 0.25 * SIZE


def are_apart(a, b):
    return a[2] <= b[0] + 1 or b[2] <= a[0] + 1 or a[3] <= b[1] + 3 or b[3] <= a[1] + 3


def faults_of(drawing, rules):
    _, _, width, height = map(float, drawing.get("viewBox").split())
    boxes = []
    for element in drawing.iter():
        tag, look = element.tag.split("}")[-1], look_of(element, rules)
        if tag == "text":
            box = box_of(element, look)
            if box[0] < 0 or box[1] < 0 or box[2] > width or box[3] > height:
                yield f"outside of its drawing: {element.text}"
            for other, there in boxes:
                if not are_apart(box, there):
                    yield f"overlap: {other} | {element.text}"
            boxes.append((element.text, box))
        elif tag in ("path", "polyline", "polygon", "rect", "circle"):
            if not look.get("fill") and not element.get("fill"):
                yield f"a {tag} of class {element.get('class')} without a color is black"
            if tag == "polyline" and (look.get("fill") != "none" or "var(" not in look.get("stroke", "")):
                yield f"a line of class {element.get('class')} without a color of its own"
        elif tag == "line" and not look.get("stroke"):
            yield f"a line of class {element.get('class')} that is not seen"


def drawing_faults(root):
    """Of all drawings of a page, given by its root element."""
    rules = rules_of(re.sub(r"@media[^{]*\{\s*[^{}]*\{[^{}]*\}\s*\}", "", root.find(".//style").text))
    drawings = list(root.iter("svg"))
    return ([] if drawings else ["no drawing"]) + [fault for drawing in drawings for fault in faults_of(drawing, rules)]
