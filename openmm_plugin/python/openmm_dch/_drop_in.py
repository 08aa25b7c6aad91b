# SPDX-License-Identifier: MIT
"""The drop-in: OpenMM's own NonbondedForce and its forces of implicit solvent on DCH's lists."""

import warnings

from . import force as _force


_PRECISIONS = {"mixed": _force.DropInPrecision_Mixed, "double": _force.DropInPrecision_Double}


def enable(precision="mixed"):
    """Has the NonbondedForces of all Contexts that are made from now on computed on DCH's lists, and their
    GBSAOBCForces and CustomGBForces as openmm.app writes them.

    Systems and scripts stay as they are. This holds on the platforms Reference and CPU; what is not covered keeps
    OpenMM's own kernel, and the reason is written to standard error, once. The environment variable OPENMM_DCH=1 does
    the same from the start.

    precision is that of the platform CPU: "mixed" (pairs in single precision, sums in double) or "double", which takes
    longer: reciprocal space is OpenMM's function on one thread then, and implicit solvent has one thread too. Reference
    is in double always.

    Warns the first time if Contexts were made after the import of the package, which keep what they have. Raises
    OpenMMException if the kernels are missing, and ValueError for another precision.
    """
    if precision not in _PRECISIONS:
        raise ValueError(f"openmm_dch.enable(): precision is {precision!r}; give one of {sorted(_PRECISIONS)}")
    if _force.countOfForcesBeforeDropIn() > 0:
        warnings.warn("openmm_dch.enable(): Contexts that were made before keep OpenMM's own forces; call enable() "
                      "first, or context.reinitialize(preserveState=True) of each", stacklevel=2)
    _force.enableDropIn(_PRECISIONS[precision])


def disable():
    """Contexts that are made from now on have OpenMM's own forces; those that there are stay as they are.

    It ends enable_reciprocal() as well.
    """
    _force.disableDropIn()


def enable_reciprocal():
    """Has the sums of PME and LJPME in reciprocal space computed on DCH's meshes by OpenMM's own NonbondedForce on the
    platform CPU, which keeps the pairs, in Contexts that compute forces for the first time from now on.

    enable() does so too, for forces that are left to OpenMM; disable() ends it. Call neither of these while another
    thread makes a Context.

    Returns True; False, and nothing changes, if another plugin has such kernels, as OpenMM's own for PME. Raises
    OpenMMException as enable() does.
    """
    return _force.enableReciprocal()


def status(context):
    """Who computes the nonbonded forces of a Context and those of implicit solvent: a list with a dict for each, in the order of the System.

    force: its index in the System; name: its name; direct: who computes pairs, "DCH" or "OpenMM"; reciprocal: who
    computes the sum in reciprocal space, the same, or "" where there is none; reason: why OpenMM computes pairs, or "".
    """
    return _force.nonbondedStatus(context)
