# SPDX-License-Identifier: MIT
"""Energies and forces of two Contexts at the same positions, compared."""

import numpy as np
from scipy.spatial import KDTree

LARGEST_ERROR = 1e-4
ROUNDING = 1e-6  # of distances in OpenMM's own single precision, relative to the cutoff


class WrongForces(Exception):
    """Both forces should give the same energies and forces, and do not."""


def beside_the_cutoff(context):
    """Whether each particle is in a pair that rounding may put on either side of the cutoff, where its force jumps."""
    cutoffs = [f.getCutoffDistance()._value for f in context.getSystem().getForces() if hasattr(f, "getCutoffDistance")]
    state = context.getState(getPositions=True)
    positions = state.getPositions(asNumpy=True)._value
    is_beside = np.zeros(len(positions), bool)
    if not cutoffs:
        return is_beside
    box = None
    if context.getSystem().usesPeriodicBoundaryConditions():
        box = np.diag(state.getPeriodicBoxVectors(asNumpy=True)._value)  # those of the scenes have right angles
        positions = positions % box % box  # twice: the first may round up to the box
    tree = KDTree(positions, boxsize=box)
    for cutoff in set(cutoffs):
        pairs = tree.query_pairs(cutoff * (1 + ROUNDING), output_type="ndarray")
        apart = positions[pairs[:, 0]] - positions[pairs[:, 1]]
        if box is not None:
            apart -= box * np.round(apart / box)
        is_beside[pairs[np.linalg.norm(apart, axis=1) > cutoff * (1 - ROUNDING)]] = True
    return is_beside


def compare(native, dch):
    """Differences of the energies and of the forces, relative to the energy and the forces' root mean square. Forces of
    particles beside the cutoff are left out."""
    (energy, forces), (found_energy, found_forces) = native.energy_and_forces(), dch.energy_and_forces()
    counts = ~beside_the_cutoff(native.context)
    if not np.mean(counts) > 0.9:
        raise WrongForces(f"only {np.sum(counts)} of {len(counts)} particles are in no pair beside the cutoff")
    return (abs(found_energy - energy) / abs(energy),
            float(np.sqrt(np.sum((found_forces - forces)[counts] ** 2) / np.sum(forces[counts] ** 2))))
