# SPDX-License-Identifier: GPL-2.0-or-later
"""Files of tables for `pair_style table`."""


def lennard_jones(epsilon, sigma):
    """Energy and force at a distance."""
    def numbers(r):
        s6 = (sigma / r) ** 6
        return 4 * epsilon * (s6 * s6 - s6), 24 * epsilon * (2 * s6 * s6 - s6) / r
    return numbers


def soft(height, width):
    """The same of what is finite where atoms meet."""
    def numbers(r):
        s = 1 + (r / width) ** 2
        return height / s ** 2, 4 * height * r / width ** 2 / s ** 3
    return numbers


def section(keyword, numbers, inner, outer, length, spacing="R"):
    """Equally far from each other in r (R), in r^2 (RSQ), or in the logarithm of r, which the file says line by line ("")."""
    part = [k / (length - 1) for k in range(length)]
    if spacing == "R":
        distances = [inner + (outer - inner) * p for p in part]
    elif spacing == "RSQ":
        distances = [(inner ** 2 + (outer ** 2 - inner ** 2) * p) ** 0.5 for p in part]
    else:
        distances = [inner * (outer / inner) ** p for p in part]
    head = f"N {length}" + (f" {spacing} {inner} {outer}" if spacing else "")
    lines = [f"{k + 1} {r:.15g} " + "{:.15g} {:.15g}".format(*numbers(r)) for k, r in enumerate(distances)]
    return "\n".join([keyword, head, "", *lines, "", ""])


def write_tables(path):
    """A, B and C of Lennard-Jones, which a `pair_style table linear 1500` takes in three ways."""
    path.write_text("# three tables\n\n" + section("A", lennard_jones(1.0, 1.0), 0.5, 2.5, 400) +
                    section("B", lennard_jones(0.7, 0.9), 0.45, 2.5, 300, "") +
                    section("C", lennard_jones(0.9, 0.95), 0.55, 2.6, 1500, "RSQ"))
