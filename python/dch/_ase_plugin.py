# SPDX-License-Identifier: MIT
"""What the entry point `ase.plugins` names: neighbor lists of dch by the name "dch" for ASE 4, where its calculators find them.

An ASE that has no such plugins does not look here, and gets none from here.
"""
from __future__ import annotations

from typing import Any

from . import _pairs

__all__ = ["neighbor_list"]


def neighbor_list(quantities: str, atoms: Any, cutoff: Any, *, self_interaction: bool = False) -> Any:
    """dch.neighbor_list, with the arguments by which ASE calls a plugin."""
    return _pairs.neighbor_list(quantities, atoms, cutoff, self_interaction)


__ase_plugins__: set[Any] = set()
try:
    from ase._4.plugins.neighborlist import NeighborListPlugin
except ImportError:
    pass
else:
    __ase_plugins__.add(NeighborListPlugin("dch", long_name="Neighbor lists from discrete center hierarchies",
                                           citation="The authors of dch: dch, neighbor lists for molecular dynamics",
                                           implementation="dch._ase_plugin.neighbor_list"))
