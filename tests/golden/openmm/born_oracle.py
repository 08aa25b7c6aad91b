# SPDX-License-Identifier: MIT
"""Energies and forces of generalized Born models by all pairs, from the formulas of OpenMM's manual, and random Systems.

Forces are derivatives of the energy by complex steps, which are exact to rounding: only energies are written down here.
"""

import numpy as np
import openmm
from openmm.app.internal import customgbforces

FORMS = {"HCT": customgbforces.GBSAHCTForce, "OBC1": customgbforces.GBSAOBC1Force, "OBC2": customgbforces.GBSAOBC2Force,
         "GBn": customgbforces.GBSAGBnForce, "GBn2": customgbforces.GBSAGBn2Force}
TANH = {"GBSAOBC": (1, 0.8, 4.85), "OBC1": (0.8, 0, 2.909125), "OBC2": (1, 0.8, 4.85),
        "GBn": (1.09511284, 1.907992938, 2.50798245)}
NECK_SCALE = {"GBn": 0.361825, "GBn2": 0.826836}
COULOMB = {True: 138.935485, False: 8.9875517923e9 * (1.602176634e-19)**2 * 6.02214076e23 * 1e6}  # customs; GBSAOBC


def offset_of(form):
    return 0.0195141 if form == "GBn2" else 0.009


def nearest_images(d, box):
    """Each displacement's shortest image, by its real part."""
    if box is None:
        return d
    d = d - np.round(d.real @ np.linalg.inv(box)) @ box
    steps = np.array([[a, b, c] for a in (-1, 0, 1) for b in (-1, 0, 1) for c in (-1, 0, 1)]) @ box
    best = np.argmin(np.sum((d.real[..., None, :] + steps)**2, axis=-1), axis=-1)
    return d + steps[best]


def integrals(scene, r, within):
    """I[i], from column vectors of i and rows of j."""
    a = (scene["radius"] - offset_of(scene["form"]))[:, None]
    s = (scene["screen"] * (scene["radius"] - offset_of(scene["form"])))[None, :]
    upper, apart = r + s, np.where((r - s).real < 0, s - r, r - s)
    lower = np.where(apart.real > a, apart, a + 0j)
    h = 0.5 * (1 / lower - 1 / upper + 0.25 * (r - s * s / r) * (1 / upper**2 - 1 / lower**2) + 0.5 * np.log(lower / upper) / r)
    if scene["form"] == "GBSAOBC":
        h = h + np.where(a < (s - r).real, 1 / a - 1 / lower, 0)
    h = np.where(a < upper.real, h, 0)
    if scene["form"] in NECK_SCALE:
        at, height = scene["neck_at"], scene["neck_height"]
        reach = scene["radius"][:, None] + scene["radius"][None, :] + 0.68
        neck = height / (1 + 100 * (r - at)**2 + 0.3 * 1000000 * (r - at)**6)
        h = h + NECK_SCALE[scene["form"]] * np.where(r.real <= reach, neck, 0)
    return np.sum(np.where(within, h, 0), axis=1)


def energy(scene, x):
    n, form = len(x), scene["form"]
    d = nearest_images(x[None, :] - x[:, None], scene["box"])
    d[np.arange(n), np.arange(n)] = 10 * scene["cutoff"]
    r = np.sqrt(np.sum(d * d, axis=-1))
    within = r.real < scene["cutoff"]
    a, radius, q = scene["radius"] - offset_of(form), scene["radius"], scene["charge"]
    psi = integrals(scene, r, within) * a
    if form == "HCT":
        born = a / (1 - psi)
    else:
        alpha, beta, gamma = scene["tanh"].T if form == "GBn2" else TANH[form]
        born = 1 / (1 / a - np.tanh(alpha * psi - beta * psi**2 + gamma * psi**3) / radius)

    def screened(f):
        return 1 / scene["solute"] - np.exp(-scene["kappa"] * f) / scene["solvent"]

    constant = COULOMB[form != "GBSAOBC"]
    total = np.sum(-0.5 * constant * screened(born) * q**2 / born)
    total += np.sum(scene["surface"] * (radius + 0.14)**2 * (radius / born)**6)
    products = born[:, None] * born[None, :]
    f = np.sqrt(r * r + products * np.exp(-r * r / (4 * products)))
    pairs = -0.5 * constant * screened(f) * q[:, None] * q[None, :] * (1 / f - 1 / scene["cutoff"])
    return total + np.sum(np.where(within, pairs, 0))


def energy_and_forces(scene):
    x = scene["positions"].astype(complex)
    forces = np.zeros(x.shape)
    for k in np.ndindex(*x.shape):
        moved = x.copy()
        moved[k] += 1e-30j
        forces[k] = -energy(scene, moved).imag / 1e-30
    return energy(scene, x).real, forces


def random_scene(form, seed, periodic, n=None):
    """Particles that may overlap, in a box that may be skewed or in none."""
    rng = np.random.default_rng([seed, 17])
    n = n or int(rng.integers(2, 60))
    cutoff = rng.uniform(0.8, 1.3)
    widths = cutoff * rng.uniform(2.3, 3.5, 3)
    box = np.diag(widths)
    if rng.random() < 0.5:
        box[1, 0], box[2, 0], box[2, 1] = rng.uniform(-0.3, 0.3, 3) * (widths[0], widths[0], widths[1])
    kinds = rng.uniform(0.101, 0.199, int(rng.integers(1, 9)))
    radius = kinds[rng.integers(0, len(kinds), n)]
    salted, surface = rng.random() < 0.5, rng.random() < 0.5
    scene = {"form": form, "cutoff": cutoff, "box": box if periodic else None, "radius": radius,
             "charge": rng.uniform(-1, 1, n), "screen": rng.uniform(0.4, 1.1, n), "solute": rng.uniform(1, 3),
             "solvent": rng.uniform(20, 80), "kappa": rng.uniform(0.5, 2) if salted and form != "GBSAOBC" else 0,
             "surface": 28.3919551 if surface and form != "GBSAOBC" else 0,
             "tanh": np.stack([rng.uniform(0.3, 1, n), rng.uniform(0.2, 0.8, n), rng.uniform(0.1, 0.4, n)], axis=-1)}
    if form == "GBSAOBC":
        scene["surface_energy"] = rng.uniform(0, 3)
        scene["surface"] = 4 * np.pi * scene["surface_energy"]
    if form == "GBn2":
        scene["screen"][rng.random(n) < 0.2] *= -0.7  # as that of sulfur
    scene["positions"] = spread(rng, n, box, scene["radius"])
    return scene


def spread(rng, n, box, radius):
    """Places at random of which no two are nearer than 0.07 nm, as bonds bring them, or all where they fit."""
    places = []
    side = min(1.0, (n / 60.0) ** (1 / 3))
    while len(places) < n:
        place = rng.uniform(0, side, 3) @ box
        d = nearest_images(np.array([p - place for p in places] or [box[0] / 2]), box)
        if np.min(np.linalg.norm(d, axis=-1)) > 0.07:
            places.append(place)
    return np.array(places)


def make_force(scene):
    """OpenMM's force; for GBn and GBn2 the scene gets the tables of its pairs."""
    form, periodic = scene["form"], scene["box"] is not None
    if form == "GBSAOBC":
        force = openmm.GBSAOBCForce()
        force.setSoluteDielectric(scene["solute"])
        force.setSolventDielectric(scene["solvent"])
        force.setSurfaceAreaEnergy(scene["surface_energy"])
        for q, radius, screen in zip(scene["charge"], scene["radius"], scene["screen"]):
            force.addParticle(q, radius, screen)
    else:
        force = FORMS[form](solventDielectric=scene["solvent"], soluteDielectric=scene["solute"],
                            SA="ACE" if scene["surface"] else None, cutoff=scene["cutoff"], kappa=scene["kappa"])
        for k, (q, radius, screen) in enumerate(zip(scene["charge"], scene["radius"], scene["screen"])):
            force.addParticle([q, radius, screen] + (list(scene["tanh"][k]) if form == "GBn2" else []))
        force.finalize()
    force.setNonbondedMethod(force.CutoffPeriodic if periodic else force.CutoffNonPeriodic)
    force.setCutoffDistance(scene["cutoff"])
    if form in NECK_SCALE:
        take_necks(scene)
    return force


def take_necks(scene):
    """d0 and m0 of all pairs, by bilinear interpolation in the tables for radii of 0.1 to 0.2 nm. Of a Discrete2DFunction
    the first index is the quick one, so openmm.app's tables have the second particle's radius in rows."""
    at = (scene["radius"] - 0.1) * 200
    low = np.minimum(np.floor(at).astype(int), 19)
    part = (at - low)[:, None]
    weights = np.zeros((len(at), 21))
    np.put_along_axis(weights, low[:, None], 1 - part, axis=1)
    np.put_along_axis(weights, low[:, None] + 1, part, axis=1)
    for name, table in (("neck_at", customgbforces.d0), ("neck_height", customgbforces.m0)):
        scene[name] = weights @ np.array(table).reshape(21, 21).T @ weights.T


def make_system(scene, *forces):
    system = openmm.System()
    for _ in scene["positions"]:
        system.addParticle(12)
    if scene["box"] is not None:
        system.setDefaultPeriodicBoxVectors(*scene["box"])
    for force in forces:
        system.addForce(force)
    return system
