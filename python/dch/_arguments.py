# SPDX-License-Identifier: MIT
"""Reads arguments: arrays of the right type and shape, or an error that names the value, the limit and the remedy."""
from __future__ import annotations

import math
import os
from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt

from ._core import InvalidParameter
from ._elements import NUMBERS

Floats = npt.NDArray[np.float64]
REAL_KINDS = "fiub"


def numbers(values: Any, name: str) -> Floats:
    """As a contiguous array of float64: the same one if it is one, else a copy."""
    if type(values) is np.ndarray and values.dtype == np.float64 and values.flags.carray:
        return values
    try:
        array = np.asarray(values)
    except ValueError as error:
        raise InvalidParameter(f"{name} cannot be read as an array ({error}); give rows of equal length") from error
    if array.dtype.kind not in REAL_KINDS:
        raise InvalidParameter(f"{name} is an array of {array.dtype}; give real numbers, such as float64")
    return np.require(array, np.float64, ["C", "A"])


def points(values: Any, name: str = "positions") -> Floats:
    array = numbers(values, name)
    if array.size == 0 and array.ndim <= 2:
        return array.reshape(0, 3)
    if array.ndim != 2 or array.shape[1] != 3:
        raise InvalidParameter(f"{name} has the shape {array.shape}; give one of (n, 3), three coordinates for each atom")
    return array


def index_pairs(values: Any, name: str) -> npt.NDArray[np.int32]:
    """Pairs of particles; whether there are such particles is for the library to say."""
    array = np.asarray(values)
    if array.size == 0 and array.ndim <= 2:
        return np.zeros((0, 2), np.int32)
    if array.ndim != 2 or array.shape[1] != 2 or array.dtype.kind not in "iu":
        raise InvalidParameter(f"{name} has the shape {array.shape} and the type {array.dtype}; give whole numbers in the "
                               "shape (m, 2), the indices of two particles in each row")
    least, most = int(array.min()), int(array.max())
    if least < 0 or most >= 2**31:
        raise InvalidParameter(f"{name} has the index {least if least < 0 else most}; give indices of particles, from 0 on")
    return np.require(array, np.int32, ["C", "A"])


def indices(values: Any, name: str) -> npt.NDArray[np.int32]:
    """Whole numbers that are not negative, in one row."""
    array = np.asarray(values)
    if array.ndim != 1 or array.size and array.dtype.kind not in "iu":
        raise InvalidParameter(f"{name} has the shape {array.shape} and the type {array.dtype}; give whole numbers in one row")
    if array.size and not 0 <= int(array.min()) <= int(array.max()) < 2**31:
        raise InvalidParameter(f"{name} has numbers from {array.min()} to {array.max()}; give numbers from 0 on")
    return np.require(array, np.int32, ["C", "A"])


def box(cell: Any, pbc: Any) -> tuple[Floats, tuple[bool, bool, bool]]:
    """The vectors of a cell as rows, and along which of them it is periodic.

    Without a cell nothing is periodic; a cell is periodic unless pbc says otherwise.
    """
    if cell is None:
        if pbc is not None and np.any(pbc):
            raise InvalidParameter(f"pbc is {pbc!r}, but there is no cell; give its three vectors as rows")
        return np.zeros((3, 3)), (False, False, False)
    vectors = numbers(cell, "cell")
    if vectors.shape == (3,):
        vectors = np.diag(vectors)
    if vectors.shape != (3, 3):
        raise InvalidParameter(f"cell has the shape {vectors.shape}; give three vectors as rows, (3, 3), or three lengths")
    if not np.isfinite(vectors).all():
        raise InvalidParameter(f"cell is {vectors.tolist()}; all components must be finite")
    if pbc is None or isinstance(pbc, bool):
        flag = pbc is not False
        return vectors, (flag, flag, flag)
    flags = np.asarray(pbc)
    if flags.shape not in [(), (3,)] or flags.dtype.kind not in "biu":
        raise InvalidParameter(f"pbc is {pbc!r}; give True, False, or three of them")
    x, y, z = (bool(flag) for flag in (flags.tolist() if flags.ndim else 3 * [flags]))
    return vectors, (x, y, z)


def typed_cutoffs(cutoff: Any, types: Any) -> tuple[Floats, npt.NDArray[np.int32]]:
    """A symmetric matrix of cutoffs, and the type of each particle, a row of it."""
    matrix = numbers(cutoff, "cutoff")
    if matrix.ndim != 2 or matrix.shape[0] != matrix.shape[1] or matrix.size == 0:
        raise InvalidParameter(f"cutoff has the shape {matrix.shape}, and types are given; give a matrix with a row and a "
                               "column for each type")
    kinds = np.asarray(types)
    if kinds.ndim != 1 or (kinds.size and kinds.dtype.kind not in "iu"):
        raise InvalidParameter(f"types has the shape {kinds.shape} and the type {kinds.dtype}; give a whole number for each "
                               "particle")
    wrong = np.flatnonzero((kinds < 0) | (kinds >= len(matrix)))
    if len(wrong):
        raise InvalidParameter(f"types[{wrong[0]}] is {kinds[wrong[0]]}; give rows of the matrix of cutoffs, from 0 to "
                               f"{len(matrix) - 1}")
    return matrix.copy(), kinds.astype(np.int32)


def length(value: Any, name: str) -> float:
    array = numbers(value, name)
    number = float(array) if array.ndim == 0 else math.nan
    if not (math.isfinite(number) and number >= 0):
        raise InvalidParameter(f"{name} is {value!r}; give a finite number that is not negative")
    return number


def count(value: Any, name: str, least: int, most: int) -> int:
    array = np.asarray(value)
    if array.ndim != 0 or array.dtype.kind not in "iu" or not least <= int(array) <= most:
        raise InvalidParameter(f"{name} is {value!r}; give a whole number from {least} to {most}")
    return int(array)


def threads(value: int | None) -> int:
    """As given, else by the environment variable DCH_NUM_THREADS, else 1."""
    if value is None:
        text = os.environ.get("DCH_NUM_THREADS", "1")
        if not text.isdecimal() or not 1 <= int(text) <= 4096:
            raise InvalidParameter(f"DCH_NUM_THREADS is {text!r}; set it to a whole number from 1 to 4096, or unset it")
        return int(text)
    return count(value, "threads", 1, 4096)


def quantities(letters: Any) -> str:
    if not isinstance(letters, str) or not letters:
        raise InvalidParameter(f"quantities is {letters!r}; give a text of the letters i, j, d, D and S")
    for letter in letters:
        if letter not in "ijdDS":
            raise InvalidParameter(f"quantities is {letters!r}, and {letter!r} is none of i, j, d, D and S; leave it out")
    return letters


def is_single(dtype: Any) -> bool:
    """Whether numbers are asked for as float32, else as float64."""
    if dtype is np.float64:
        return False
    try:
        kind = np.dtype(dtype)
    except TypeError as error:
        raise InvalidParameter(f"dtype is {dtype!r}, which is no type of numbers; give float32 or float64") from error
    if kind not in (np.float32, np.float64):
        raise InvalidParameter(f"dtype is {kind}; give float32 or float64")
    return bool(kind == np.float32)


def check_given(name: str, array: Any, kind: npt.DTypeLike, shape: tuple[int | None, ...]) -> None:
    """An array to write to, of this type and shape, in which None is any number."""
    wanted = tuple("n" if length is None else length for length in shape)
    if not isinstance(array, np.ndarray) or array.dtype != kind or array.ndim != len(shape) or any(
            want is not None and have != want for have, want in zip(array.shape, shape)):
        found = f"the shape {array.shape} and the type {array.dtype}" if isinstance(array, np.ndarray) else repr(array)
        raise InvalidParameter(f"out for {name} has {found}; give an array of {np.dtype(kind)} with the shape {wanted}")
    if not (array.flags.writeable and array.flags.c_contiguous and array.flags.aligned):
        raise InvalidParameter(f"out for {name} is read-only or not contiguous; give an array that numpy has made")


def given_arrays(out: Any, letters: str, single: bool, *read: Floats) -> tuple[Any, ...] | None:
    """Arrays to write to, one for each letter; none of them overlaps another one, or those that are read meanwhile."""
    if out is None:
        return None
    arrays = (out,) if isinstance(out, np.ndarray) else tuple(out) if isinstance(out, (tuple, list)) else ()
    if len(arrays) != len(letters) or len(set(letters)) != len(letters):
        raise InvalidParameter(f"out has {len(arrays)} arrays for the quantities {letters!r}; give an array for each letter, "
                               "and each letter once")
    for letter, array in zip(letters, arrays):
        kind = np.dtype(np.int64 if letter in "ijS" else np.float32 if single else np.float64)
        check_given(letter, array, kind, (None, 3) if letter in "DS" else (None,))
    for k, array in enumerate(arrays):
        if any(np.may_share_memory(array, other) for other in (*arrays[:k], *read)):
            raise InvalidParameter(f"out for {letters[k]} shares memory with another array; give arrays of their own")
    return arrays


def check_pair(out: Any, shape: tuple[int, int], real: npt.DTypeLike, *read: Floats) -> None:
    """Arrays for indices and distances, which overlap neither each other nor what is read."""
    if not isinstance(out, (tuple, list)) or len(out) != 2:
        raise InvalidParameter(f"out is {type(out).__name__}; give two arrays, one for indices and one for distances")
    for name, array, kind in zip(("index", "distance"), out, (np.int32, real)):
        check_given(name, array, kind, shape)
        if any(np.may_share_memory(array, other) for other in (*read, *(out[:1] if name == "distance" else ()))):
            raise InvalidParameter(f"out for {name} shares memory with another array; give arrays of their own")


def in_order(letters: str, find: Callable[[str], tuple[Any, ...]]) -> Any:
    """The array of each letter, found once, in a tuple; the array itself for one letter."""
    distinct = "".join(dict.fromkeys(letters))
    found = dict(zip(distinct, find(distinct)))
    if len(letters) == 1:
        return found[letters]
    if len(letters) == len(distinct):
        return tuple(found.values())
    return tuple(found[letter].copy() for letter in letters)


def kept(value: Any) -> Any:
    """None and numbers as they are, arrays as copies that the caller does not change later."""
    return value if value is None or np.ndim(value) == 0 else np.array(value)


def element(key: Any) -> int:
    """The atomic number of a symbol, or a number as it is."""
    if isinstance(key, str):
        if key not in NUMBERS:
            raise InvalidParameter(f"cutoff has the key {key!r}, which is no element; give symbols or atomic numbers")
        return NUMBERS[key]
    return count(key, "an element of a key of cutoff", 0, 2**31 - 1)


def matrix(cutoff: dict[Any, Any], kinds: Any, atoms: int) -> tuple[Floats, npt.NDArray[np.int32]]:
    """Cutoffs by pair of those elements that there are, 0 for those that no key names; the row of each atom.

    kinds are atomic numbers, or any whole numbers.
    """
    if kinds is None:
        raise InvalidParameter("cutoff is a dict, but there are no atomic numbers; give one for each atom")
    array = np.asarray(kinds)
    if array.shape != (atoms,) or (atoms and array.dtype.kind not in "iu"):
        raise InvalidParameter(f"atomic numbers have the shape {array.shape} and the type {array.dtype}; give a whole "
                               f"number for each of the {atoms} atoms")
    present, types = np.unique(array, return_inverse=True)
    row = {int(number): k for k, number in enumerate(present)}
    cutoffs = np.zeros((max(len(row), 1), max(len(row), 1)))
    for key, value in cutoff.items():
        if not isinstance(key, tuple) or len(key) != 2:
            raise InvalidParameter(f"cutoff has the key {key!r}; give pairs of elements, such as ('H', 'O')")
        a, b = element(key[0]), element(key[1])
        reach = length(value, f"cutoff[{key!r}]")
        if a in row and b in row:
            cutoffs[row[a], row[b]] = cutoffs[row[b], row[a]] = reach
    return cutoffs, types.astype(np.int32)
