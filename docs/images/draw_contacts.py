#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Draws the contact map and P(s) of docs/necklaces.md: of a chain along Hilbert's curve in space, as dchmd contacts draws them.

usage: draw_contacts.py DCHMD FOLDER; writes contact-map.svg and contact-separation.svg
"""
import pathlib
import random
import re
import subprocess
import sys
import tempfile

ORDER, FRAMES, GAP = 3, 6, 1.25  # 8^ORDER beads, one apart, that shake
PICTURES = {"Contact map": "contact-map.svg", "P(s)": "contact-separation.svg"}


def hilbert(order):
    """The cells of a cube of side 2^order along Hilbert's curve (Skilling's transposed indices)."""
    for index in range(8**order):
        x = [sum((index >> (3 * bit + 2 - axis) & 1) << bit for bit in range(order)) for axis in range(3)]
        carry = x[2] >> 1
        for axis in (2, 1):
            x[axis] ^= x[axis - 1]
        x[0] ^= carry
        bit = 2
        while bit < 2**order:
            for axis in (2, 1, 0):
                if x[axis] & bit:
                    x[0] ^= bit - 1
                else:
                    swap = (x[0] ^ x[axis]) & (bit - 1)
                    x[0], x[axis] = x[0] ^ swap, x[axis] ^ swap
            bit *= 2
        yield tuple(x)


def write_chain(path):
    numbers, beads = random.Random(5), list(hilbert(ORDER))
    assert all(sum(abs(p - q) for p, q in zip(a, b)) == 1 for a, b in zip(beads, beads[1:]))
    with open(path, "w", encoding="utf-8") as file:
        for frame in range(FRAMES):
            file.write(f"ITEM: TIMESTEP\n{frame}\nITEM: NUMBER OF ATOMS\n{len(beads)}\nITEM: BOX BOUNDS ff ff ff\n"
                       + "-1 9\n" * 3 + "ITEM: ATOMS id mol x y z\n")
            for k, bead in enumerate(beads, start=1):
                file.write(f"{k} 1 " + " ".join(f"{place + numbers.uniform(-0.25, 0.25):.4f}" for place in bead) + "\n")


def drawings(page):
    """By heading, the drawings of a page as files of their own, in its light colors."""
    style = re.sub(r"@media .*?\n}\n", "", re.search(r"<style>(.*?)</style>", page, re.DOTALL)[1], flags=re.DOTALL)
    variables = re.search(r":root \{.*?\n}\n", style, re.DOTALL)[0].replace("light dark", "light")
    rules = variables + "\n".join(re.findall(r"^svg [^{].*", style, re.MULTILINE))
    for heading, box, rest in re.findall(r"<h2>([^<]*)</h2>.*?<svg viewBox=\"([^\"]*)\"(.*?</svg>)", page, re.DOTALL):
        width, height = box.split()[2:]
        head, body = rest.split(">", 1)
        yield heading, (f"<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"{box}\" width=\"{width}\" height=\"{height}\" "
                        f"font-family=\"sans-serif\" font-size=\"12\"{head}>\n<style>{rules}</style>\n"
                        f"<rect width=\"{width}\" height=\"{height}\" fill=\"white\"/>{body}\n")


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    with tempfile.TemporaryDirectory() as folder:
        chain, page = pathlib.Path(folder) / "chain.lammpstrj", pathlib.Path(folder) / "contacts.html"
        write_chain(chain)
        subprocess.run([sys.argv[1], "contacts", chain, "--gap", str(GAP), "--plot", page, "--quiet"], check=True)
        drawn = dict(drawings(page.read_text(encoding="utf-8")))
    for heading, name in PICTURES.items():
        (pathlib.Path(sys.argv[2]) / name).write_text(drawn[heading], encoding="utf-8")


if __name__ == "__main__":
    main()
