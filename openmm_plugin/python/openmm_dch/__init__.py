# SPDX-License-Identifier: MIT
"""OpenMM's nonbonded forces on neighbor lists from a discrete center hierarchy, and contacts of bead chains.

    import openmm_dch
    openmm_dch.enable()                  # all Systems, before Contexts are made

    openmm_dch.replaceNonbonded(system)  # or one System

Importing it loads the kernels for OpenMM's platforms Reference and CPU.
"""

import openmm as _openmm

from ._drop_in import disable, enable, enable_reciprocal, status
from ._location import PLUGINS as _PLUGINS
from ._location import VERSION as __version__
from .force import DCHNonbondedForce, NecklaceContactForce

__all__ = ["DCHNonbondedForce", "NecklaceContactForce", "__version__", "disable", "enable", "enable_reciprocal",
           "replaceNonbonded", "status"]


def _load_plugins():
    known = set(_openmm.Platform.getPluginLoadFailures())
    _openmm.Platform.loadPluginsFromDirectory(_PLUGINS)
    failures = [f for f in _openmm.Platform.getPluginLoadFailures() if f not in known]
    if failures:
        raise ImportError("openmm_dch: OpenMM could not load its plugins: " + "; ".join(failures))


def replaceNonbonded(system):
    """Puts a DCHNonbondedForce in the place of each NonbondedForce of a System, and returns the new ones as a list.

    They come last in the System. Raises OpenMMException, and changes nothing, if one uses Ewald, PME or LJPME, which
    DCHNonbondedForce does not have, or if there is none.
    """
    found = [i for i, force in enumerate(system.getForces()) if isinstance(force, _openmm.NonbondedForce)]
    if not found:
        raise _openmm.OpenMMException("replaceNonbonded: the System has no NonbondedForce")
    forces = [DCHNonbondedForce.fromNonbonded(system.getForce(i)) for i in found]
    for i in reversed(found):
        system.removeForce(i)
    for force in forces:
        system.addForce(force)
    return forces


_load_plugins()
