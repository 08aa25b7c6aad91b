# SPDX-License-Identifier: GPL-2.0-or-later
"""Pair styles of random scripts, with cutoffs and sizes by type."""

from table_files import section, soft

SW = "A A A 1.0 0.9 1.8 21.0 1.2 -0.333333333333 7.049556277 0.6022245584 4.0 0.0 0.0\n"
TABLES = section("LOW", soft(3.0, 0.9), 0.002, 8.0, 300) + section("HIGH", soft(7.0, 0.6), 0.001, 8.0, 500, "")


class PairStyles:
    """For a Script: a pair style for its atoms, its dimension and its newton setting."""

    def numbers(self, largest):
        """Size and cutoff of each pair of types."""
        for i in range(self.types):
            for j in range(i, self.types):
                mixed = (self.sizes[i] + self.sizes[j]) / 2
                yield f"{i + 1} {j + 1}", mixed, min(largest, mixed * self.random.uniform(1.12, 2.8))

    def pair(self):
        styles = ["lj/cut", "lj/cut", "table", "morse", "soft", "yukawa", "lj/expand", "buck", "hybrid", "overlay",
                  "gromacs", "sw"]
        if self.style == "charge":
            styles += ["dsf"] * 4
        if self.style == "sphere":
            styles += ["gran/hooke/history", "gran/hertz/history"] * 8
        style = "soft" if self.soft else self.random.choice(styles)
        if style == "sw" and (self.newton != "on" or self.style == "bond" or self.dimension == 2):
            style = "lj/cut"
        uniform, largest = self.random.uniform, 7.5
        pairs = list(self.numbers(largest))
        depth = self.between(0.2, 1.2)
        self.levels_within = min(c for t, s, c in pairs) if style == "lj/cut" else 0

        def lj(name=""):
            return [f"pair_coeff {t} {name} {depth} {s:.3f} {c:.4f}" for t, s, c in pairs]

        def morse(name=""):
            return [f"pair_coeff {t} {name} {depth} 4.0 {1.1 * s:.3f} {c:.4f}" for t, s, c in pairs]

        if style == "lj/cut":
            self.add("pair_style lj/cut 2.5", *lj())
        elif style == "morse":
            self.add("pair_style morse 2.5", *morse())
        elif style == "soft":
            self.add("pair_style soft 1.0", *(f"pair_coeff {t} 8.0 {c:.4f}" for t, s, c in pairs))
        elif style == "yukawa":
            self.add("pair_style yukawa 1.5 2.5", *(f"pair_coeff {t} 4.0 {c:.4f}" for t, s, c in pairs))
        elif style == "table":
            self.add(f"pair_style table {'spline' if len(pairs) % 2 else 'linear'} {len(pairs)}00",
                     *(f"pair_coeff {t} random.table {'LOW' if k % 2 else 'HIGH'} {c:.4f}" for k, (t, s, c) in enumerate(pairs)))
        elif style == "lj/expand":
            self.add("pair_style lj/expand 2.5",
                     *(f"pair_coeff {t} {depth} 0.9 {s - 0.9:.3f} {uniform(1.1, 2.0):.4f}" for t, s, c in pairs))
        elif style == "buck":
            self.add("pair_style buck 2.5", *(f"pair_coeff {t} 1000.0 {0.15 * s:.4f} 0.1 {c:.4f}" for t, s, c in pairs))
        elif style == "hybrid":
            first, rest = pairs[0], pairs[1:] or [pairs[0]]
            self.add("pair_style hybrid lj/cut 2.5 morse 2.5",
                     *(f"pair_coeff {t} morse {depth} 4.0 {1.1 * s:.3f} {c:.4f}" for t, s, c in rest),
                     f"pair_coeff {first[0]} lj/cut {depth} 1.0 {first[2]:.4f}")
        elif style == "overlay":
            self.add("pair_style hybrid/overlay lj/cut 2.5 yukawa 1.2 2.0", *lj("lj/cut"),
                     f"pair_coeff * * yukawa 2.0 {self.between(1.1, 2.4)}")
        elif style == "gromacs":
            self.add("pair_style lj/gromacs 0.9 2.5", *(f"pair_coeff {t} {depth} {s:.3f}" for t, s, c in pairs))
        elif style.startswith("gran"):
            self.add(f"pair_style {style} 200.0 NULL 5.0 NULL 0.5 {self.random.choice((0, 1))}", "pair_coeff * *")
        elif style == "sw":
            self.add("pair_style sw", f"pair_coeff * * random.sw {' '.join('A' * self.types)}")
        else:
            self.add("pair_style lj/cut/coul/dsf 0.2 2.5 3.0", *lj())
        if style in ("lj/cut", "table", "morse", "lj/expand", "buck"):
            self.add(f"pair_modify shift {self.random.choice(('yes', 'no'))}")
