# SPDX-License-Identifier: MIT
"""Pairs over all images of the cell, with their shifts."""
from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from . import _arguments as arguments
from . import _core
from ._core import InvalidParameter

# ASE and matscipy leave out pairs as far apart as the cutoff: what is nearer by more than rounding is within this.
BELOW = 1 - 2.0**-51


def request(cutoff: Any, kinds: Any, atoms: int, half: bool, factor: float = 1, *,
            exclusions: npt.NDArray[np.int32] | None = None) -> _core.Request | None:
    """What to find; None where every cutoff is 0, so that there are no pairs."""
    types = radii = None
    cutoffs: npt.NDArray[np.float64] = np.zeros((1, 1))
    if isinstance(cutoff, dict):
        cutoffs, types = arguments.matrix(cutoff, kinds, atoms)
    elif np.ndim(cutoff) == 0:
        cutoffs = np.array([[arguments.length(cutoff, "cutoff")]])
    else:
        radii = arguments.numbers(cutoff, "cutoff")
        if radii.shape != (atoms,):
            raise InvalidParameter(f"cutoff has the shape {radii.shape} for {atoms} atoms; give one radius for each, a "
                                   "number, or a dict of pairs of elements")
        if not (np.isfinite(radii).all() and (radii >= 0).all()):
            worst = int(np.flatnonzero(~(np.isfinite(radii) & (radii >= 0)))[0])
            raise InvalidParameter(f"cutoff[{worst}] is {radii[worst]}; radii must be finite and not negative")
    if not (cutoffs if radii is None else radii).any():
        return None
    return _core.Request(cutoffs * factor, types, None if radii is None else radii * factor, half, exclusions)


def request_of_particles(cutoff: Any, types: Any, exclusions: Any, half: bool) -> _core.Request:
    """By a number, radii, or a matrix with types; without some pairs."""
    left_out = None if exclusions is None else arguments.index_pairs(exclusions, "exclusions").copy()
    if types is not None:
        return _core.Request(*arguments.typed_cutoffs(cutoff, types), None, half, left_out)
    if np.ndim(cutoff) > 1:
        raise InvalidParameter(f"cutoff has the shape {np.shape(cutoff)}; give types beside a matrix, or a number or radii")
    wanted = request(cutoff, None, len(cutoff) if np.ndim(cutoff) == 1 else 0, half, exclusions=left_out)
    if wanted is None:
        raise InvalidParameter(f"cutoff is {cutoff!r}; give a number > 0, or radii of which one is")
    return wanted


def described(cutoff: Any) -> str:
    """A number as it is, an array by its size."""
    if np.ndim(cutoff) == 0:
        return str(cutoff)
    return f"<{len(cutoff)} radii>" if np.ndim(cutoff) == 1 else f"<{len(cutoff)} types>"


def no_pairs(quantities: str, single: bool, out: tuple[Any, ...] | None) -> tuple[Any, ...]:
    if out is not None:
        return tuple(array[:0] for array in out)
    shapes = {"i": (0,), "j": (0,), "d": (0,), "D": (0, 3), "S": (0, 3)}
    real = np.float32 if single else np.float64
    return tuple(np.zeros(shapes[letter], real if letter in "dD" else np.int64) for letter in quantities)


def find(quantities: str, positions: Any, cell: Any, pbc: Any, cutoff: Any, kinds: Any, self_interaction: bool,
         half: bool, threads: int | None, dtype: Any, out: Any) -> Any:
    letters = arguments.quantities(quantities)
    points = arguments.points(positions)
    single = arguments.is_single(dtype)
    given = arguments.given_arrays(out, letters, single, points)
    vectors, periodic = arguments.box(cell, pbc)
    wanted = request(cutoff, kinds, len(points), half, BELOW)
    number = arguments.threads(threads)

    def arrays(distinct: str) -> tuple[Any, ...]:
        if wanted is None:
            return no_pairs(distinct, single, given)
        return _core.find_pairs(distinct, points, vectors, periodic, wanted, bool(self_interaction), number, single, given)

    return arguments.in_order(letters, arrays)


def neighbor_list(quantities: str, a: Any, cutoff: Any, self_interaction: bool = False, *, half: bool = False,
                  threads: int | None = None, dtype: Any = np.float64, out: Any = None) -> Any:
    """All pairs of atoms within a cutoff, over all images of the cell; called as ase.neighborlist.neighbor_list.

    The cutoff may be larger than the cell, atoms may lie outside it, and cells may be skewed.

    Parameters
    ----------
    quantities
        Which arrays to return, in this order: 'i' and 'j', the indices of the two atoms, (n,) int64; 'S', the shift
        of j in cell vectors, (n, 3) int64, 0 along open axes; 'D' = r_j - r_i + S . cell, (n, 3) float64; 'd', its
        length, (n,) float64.
    a
        ase.Atoms, or what has positions, cell, pbc and (for a dict of cutoffs) numbers as these have.
    cutoff
        A number; an array of radii, one for each atom, whose sums are the cutoffs; or a dict of pairs of elements, as
        {('H', 'O'): 1.2, (1, 1): 0.8}, where other pairs are left out. Pairs are nearer than their cutoff.
    self_interaction
        Whether each atom is paired with itself too, with S = 0. Its images are neighbors in any case.
    half
        Each pair once, i <= j.
    threads
        How many; by the environment variable DCH_NUM_THREADS, else 1, if None. Results do not depend on it.
    dtype
        float32 or float64, of 'd' and 'D'. Which pairs there are does not depend on it: float32 is float64, rounded.
    out
        An array for each letter, of the type and the shape of the result, with as many rows as there are pairs or more.
        What is returned are views of their beginnings, and no new memory is taken for them.

    Returns
    -------
    A tuple of arrays, or the one array if there is one letter, sorted by i.

    Raises
    ------
    InvalidParameter, a ValueError; MemoryError before the arrays are made if the machine cannot hold them.

    >>> from ase.build import bulk
    >>> i, d = neighbor_list("id", bulk("Cu", a=3.6, cubic=True), 2.6)
    >>> len(i), round(float(d.max()), 4)
    (48, 2.5456)
    """
    kinds = a.numbers if isinstance(cutoff, dict) else None
    return find(quantities, a.positions, np.asarray(a.cell), a.pbc, cutoff, kinds, self_interaction, half, threads, dtype, out)


def neighbour_list(quantities: str, atoms: Any = None, cutoff: Any = None, positions: Any = None, cell: Any = None,
                   pbc: Any = None, numbers: Any = None, *, half: bool = False, threads: int | None = None,
                   dtype: Any = np.float64, out: Any = None) -> Any:
    """All pairs of atoms within a cutoff, called as matscipy.neighbours.neighbour_list.

    Takes atoms as neighbor_list does, or positions (n, 3), cell (3, 3) with vectors as rows (or three lengths) and
    pbc. Without a cell nothing is periodic. numbers are for a dict of cutoffs. All else is as neighbor_list has it.

    >>> i, j, S = neighbour_list("ijS", positions=[[0, 0, 0]], cell=[2, 2, 2], pbc=[True, False, False], cutoff=2.1)
    >>> S.tolist()
    [[-1, 0, 0], [1, 0, 0]]
    """
    if cutoff is None:
        raise InvalidParameter("there is no cutoff; give a number, radii, or a dict of pairs of elements")
    if atoms is not None:
        if any(given is not None for given in (positions, cell, pbc, numbers)):
            raise InvalidParameter("both atoms and positions, cell, pbc or numbers are given; give either")
        positions, cell, pbc, numbers = atoms.positions, np.asarray(atoms.cell), atoms.pbc, atoms.numbers
    elif positions is None:
        raise InvalidParameter("there are no positions; give atoms, or an array of (n, 3)")
    return find(quantities, positions, cell, pbc, cutoff, numbers, False, half, threads, dtype, out)


class VerletList:
    """Pairs of atoms that move: found with a skin beyond the cutoff, and anew only when some might be missing.

    Pairs are never missing, whatever moves: update() compares how far atoms came, as nearest images, with half the
    skin, and how the cell has changed. Coordinates that were wrapped into the cell, or out of it, since are followed
    without a rebuild. The cutoff may be larger than the cell; if cutoff + skin exceeds half its smallest height, any
    change of the cell makes the list anew. One thread at a time may use an object; another one gets a RuntimeError. Copies
    and what comes out of a pickle have the parameters alone: call update().

    Parameters
    ----------
    cutoff
        A number, or an array of radii, one for each atom, whose sums are the cutoffs. Pairs as far apart as the cutoff
        are in the list. With types: a symmetric matrix, where 0 leaves pairs out.
    skin
        Not negative; 0 for a list that is made anew whenever anything has changed.
    half
        Each pair once, i <= j.
    types
        A row of the matrix of cutoffs for each atom.
    exclusions
        (m, 2) pairs of atoms that are left out, in all their images; such as those joined by bonds.
    threads
        As neighbor_list has them.

    >>> positions = np.array([[0.1, 0.1, 0.1], [0.9, 0.1, 0.1], [4.8, 0.1, 0.1]])
    >>> verlet = VerletList(cutoff=1.0, skin=0.2, half=True)
    >>> verlet.update(positions, cell=[5, 5, 5])
    True
    >>> verlet.pairs("ijS")[2].tolist()
    [[0, 0, 0], [-1, 0, 0]]
    >>> positions[2, 0] -= 5  # wrapped
    >>> verlet.update(positions, cell=[5, 5, 5])
    False
    >>> verlet.pairs("ijS")[2].tolist()
    [[0, 0, 0], [0, 0, 0]]
    >>> verlet
    VerletList(cutoff=1.0, skin=0.2: 3 particles, 3 pairs listed, 1 rebuilds)

    Two types, of which the second has no pairs with itself, and a bond that makes no pair:

    >>> verlet = VerletList([[1.0, 1.5], [1.5, 0]], 0.2, half=True, types=[0, 1, 1], exclusions=[[0, 1]])
    >>> verlet.update([[0, 0, 0], [0.9, 0, 0], [0, 1.4, 0]])
    True
    >>> [k.tolist() for k in verlet.pairs("ij")]
    [[0], [2]]
    """

    def __init__(self, cutoff: Any, skin: float, *, half: bool = False, types: Any = None, exclusions: Any = None,
                 threads: int | None = None) -> None:
        wanted = request_of_particles(cutoff, types, exclusions, half)
        self._made_with = {"cutoff": arguments.kept(cutoff), "skin": skin, "half": half, "types": arguments.kept(types),
                           "exclusions": arguments.kept(exclusions), "threads": threads}
        self._skin = arguments.length(skin, "skin")
        self._cutoff = described(cutoff)
        self._pairs = _core.VerletPairs(wanted, self._skin, arguments.threads(threads))

    def __getstate__(self) -> dict[str, Any]:
        return self._made_with

    def __setstate__(self, made_with: dict[str, Any]) -> None:
        VerletList.__init__(self, **made_with)

    def update(self, positions: Any, cell: Any = None, pbc: Any = None) -> bool:
        """Takes positions (n, 3), the cell (vectors as rows, or three lengths; None for open space) and pbc (all True
        if None). Says whether the list was made anew. After an error there are no pairs until the next update()."""
        vectors, periodic = arguments.box(cell, pbc)
        return self._pairs.update(arguments.points(positions), vectors, periodic)

    def pairs(self, quantities: str = "ijdDS", *, with_skin: bool = False, self_interaction: bool = False,
              dtype: Any = np.float64, out: Any = None) -> Any:
        """The pairs within the cutoff at the positions of the last update(), as neighbor_list returns them; with_skin:
        all that are listed. Arrays of out need as many rows as pairs are listed, those of the skin too."""
        letters, single = arguments.quantities(quantities), arguments.is_single(dtype)
        given = arguments.given_arrays(out, letters, single)
        return arguments.in_order(letters, lambda distinct: self._pairs.pairs(distinct, with_skin, self_interaction, single, given))

    @property
    def rebuilds(self) -> int:
        """How often the list was made anew."""
        return self._pairs.rebuilds

    def __len__(self) -> int:
        """The number of atoms."""
        return self._pairs.particles

    def __repr__(self) -> str:
        return f"VerletList(cutoff={self._cutoff}, skin={self._skin}: {self._pairs.text()})"
