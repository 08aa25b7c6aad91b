# SPDX-License-Identifier: GPL-2.0-or-later
"""Atoms in the bath of fix langevin/philox, moved in plain Python."""

import math


def philox(counter, key):
    """Philox4x32-10 as Salmon et al. (SC 2011) write it down."""
    for _ in range(10):
        even, odd = 0xD2511F53 * counter[0], 0xCD9E8D57 * counter[2]
        counter = (odd >> 32 ^ counter[1] ^ key[0], odd & 0xFFFFFFFF, even >> 32 ^ counter[3] ^ key[1], even & 0xFFFFFFFF)
        key = ((key[0] + 0x9E3779B9) & 0xFFFFFFFF, (key[1] + 0xBB67AE85) & 0xFFFFFFFF)
    return counter


def noise(seed, step, atom):
    words = philox((atom, step & 0xFFFFFFFF, step >> 32, 0), (seed, 0))
    return [(word + 0.5) / 2**32 - 0.5 for word in words[:3]]


class Gas:
    """Atoms without forces between them, in a bath, moved as LAMMPS's velocity Verlet does: product by product."""

    def __init__(self, types, seed, damping, temperature, ratios=(1.0, 1.0), masses=(1.0, 1.7), first_step=0):
        self.types, self.seed, self.damping, self.temperature = types, seed, damping, temperature
        self.ratios, self.masses, self.step = ratios, masses, first_step
        self.dt = 0.005
        self.v = {atom: [0.0] * 3 for atom in types}
        self.f = self.forces()

    def forces(self):
        found = {}
        for atom, kind in self.types.items():
            mass, ratio = self.masses[kind - 1], self.ratios[kind - 1]
            drag = -mass / self.damping / 1.0 * (1.0 / ratio)
            strength = math.sqrt(mass) * math.sqrt(24.0 * 1.0 / self.damping / self.dt / 1.0) / 1.0 * (1.0 / math.sqrt(ratio))
            strength *= math.sqrt(self.temperature(self.step))
            found[atom] = [drag * v + strength * u for v, u in zip(self.v[atom], noise(self.seed, self.step, atom))]
        return found

    def kick(self):
        for atom, kind in self.types.items():
            factor = 0.5 * self.dt * 1.0 / self.masses[kind - 1]
            self.v[atom] = [v + factor * f for v, f in zip(self.v[atom], self.f[atom])]

    def move(self, steps):
        for _ in range(steps):
            self.step += 1
            self.kick()
            self.f = self.forces()
            self.kick()

    def atoms(self):
        return {atom: (kind, *self.v[atom], *self.f[atom]) for atom, kind in self.types.items()}
