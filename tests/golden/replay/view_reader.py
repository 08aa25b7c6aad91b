# SPDX-License-Identifier: MIT
"""Reads the page of dchmd replay --view as replay/src/report/view_page.hpp describes it."""

import base64
import html.parser
import json
import re
import zlib


class Page(html.parser.HTMLParser):
    """The scripts of a page, and what it takes from elsewhere."""

    def __init__(self, path):
        super().__init__()
        self.scripts, self.taken, self.tags = [], [], []
        with open(path, encoding="utf-8") as file:
            self.feed(file.read())
        self.close()

    def handle_starttag(self, tag, attributes):
        self.tags.append(tag)
        self.taken += [value for name, value in attributes if name in ("src", "href", "data")]
        if tag == "script":
            self.scripts.append("")

    def handle_data(self, data):
        if self.tags and self.tags[-1] == "script":
            self.scripts[-1] += data

    def handle_endtag(self, tag):
        self.tags.append("/" + tag)


class Numbers:
    def __init__(self, text):
        self.bytes, self.at = zlib.decompress(base64.b64decode(text, validate=True)), 0

    def next(self):
        value, shift = 0, 0
        while True:
            byte = self.bytes[self.at]
            self.at += 1
            value |= (byte & 127) << shift
            shift += 7
            if byte < 128:
                return value

    def pairs(self, rows):
        found = []
        for row in range(rows):
            neighbor = row
            for _ in range(self.next()):
                neighbor += self.next()
                found.append((row, neighbor))
        return found


class ViewedFrame:
    """A frame as the page has it: facts, places, contacts, and by level nodes, parents and edges."""

    def __init__(self, facts):
        self.facts = facts
        numbers = Numbers(facts["data"])
        sizes = [high - low for low, high in zip(facts["low"], facts["high"])]
        self.places = [[low + size * numbers.next() / 65535 for low, size in zip(facts["low"], sizes)]
                       for _ in range(facts["atoms"])]
        self.contacts = numbers.pairs(facts["atoms"])
        self.nodes, self.parents, self.edges = [], [], []
        for i, level in enumerate(facts["levels"]):
            nodes = list(range(level["nodes"]))
            if i > 0:
                node = 0
                for k in range(level["nodes"]):
                    node += numbers.next()
                    nodes[k] = node
            self.nodes.append(nodes)
            self.parents.append([numbers.next() - 1 for _ in nodes])
            self.edges.append(numbers.pairs(len(nodes)) if i > 0 else [])
        self.is_whole = numbers.at == len(numbers.bytes)

    def sums(self):
        """Of all numbers of a kind, each times its place: what a reader in a browser has to get, too."""

        def weighed(values):
            return sum(k % 1000 * value for k, value in enumerate(values, start=1))

        flat = [[number for pair in pairs for number in pair] for pairs in (self.contacts, *self.edges[1:])]
        return [weighed(values) for values in (*flat, *self.nodes[1:], *self.parents)]


def read_view(path):
    """What holds for all frames, the frames, and the page."""
    page = Page(path)
    found = re.fullmatch(r"\nconst run = (.*?);\nconst frames = \[\n(.*?)\];\n(.*)", page.scripts[-1], re.DOTALL)
    frames = [ViewedFrame(json.loads(line.rstrip(","))) for line in found[2].splitlines()]
    return json.loads(found[1]), frames, page
