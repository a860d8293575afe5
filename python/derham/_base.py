"""What all rooms of Complex share: degrees, sides, the shapes of forms, sets of simplices."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from copy import copy
from typing import Any, Literal, TypeAlias, TypeVar

import numpy as np
import numpy.typing as npt
import scipy.sparse as sparse

from . import _derham
from ._arguments import Floats, Integers, float_array, index_dtype, index_limits, index_list, shown
from .errors import InputError, TopologyError

Side: TypeAlias = Literal["primal", "dual"]

Matrix = TypeVar("Matrix", sparse.csr_array, sparse.csc_array)
_empty = {kind: kind((0, 0)) for kind in (sparse.csr_array, sparse.csc_array, sparse.dia_array)}


def smallest_offsets(last: int) -> np.dtype[Any]:
    """The type of row pointers that scipy keeps as it is: that of the indices while they fit."""
    return index_dtype if last <= index_limits.max else np.dtype(np.int64)


def read_only(array: npt.NDArray[Any]) -> npt.NDArray[Any]:
    array.flags.writeable = False
    return array


def compressed(
    kind: type[Matrix], arrays: tuple[npt.NDArray[Any], Integers, Integers], shape: tuple[int, int]
) -> Matrix:
    """The matrix of values, indices and pointers, which are its memory.

    scipy's constructor would look for the least type of index and take ten times as long as a call with a small mesh may:
    these arrays are sound, so a copy of an empty matrix takes them as they are.
    """
    if arrays[1].dtype != arrays[2].dtype:
        return kind(arrays, shape=shape, copy=False)
    matrix = copy(_empty[kind])
    matrix._shape = shape
    matrix.data, matrix.indices, matrix.indptr = arrays
    return matrix


def diagonal_matrix(diagonal: Floats) -> sparse.dia_array:
    """The square matrix with this diagonal, which is its memory."""
    matrix = copy(_empty[sparse.dia_array])
    matrix._shape = (diagonal.size, diagonal.size)
    matrix.data, matrix.offsets = diagonal[np.newaxis], np.zeros(1, np.int32)
    return matrix


class Base:
    """The compiled complex and what is derived from it and kept."""

    _core: _derham.Complex
    _kept: dict[Any, Any]
    _sizes: tuple[int, ...]

    @property
    def dimension(self) -> int:
        """n, the dimension of the complex."""
        return len(self._sizes) - 1

    @property
    def sizes(self) -> tuple[int, ...]:
        """|K_0|, …, |K_n|: how many simplices there are of every degree."""
        return self._sizes

    def size(self, k: int) -> int:
        """|K_k|; 0 outside of 0 <= k <= n. Raises InputError unless k is a whole number."""
        if not isinstance(k, (int, np.integer)):
            raise InputError(f"the degree k is {shown(k)}; expected a whole number")
        return self._sizes[k] if 0 <= k < len(self._sizes) else 0

    def _degree(self, k: int, low: int = 0, high: int | None = None, name: str = "k") -> int:
        high = self.dimension if high is None else high
        if isinstance(k, (int, np.integer)) and low <= k <= high:
            return int(k)
        expected = f"expected {low} to {high} in this complex" if low <= high else "there is none in this complex"
        raise InputError(f"the degree {name} is {shown(k)}; {expected} of dimension {self.dimension}")

    def _side(self, side: str) -> bool:
        """Whether the side is dual. Dual cells have an orientation where the complex has one."""
        if not isinstance(side, str) or side not in ("primal", "dual"):
            raise InputError(f"the side is {shown(side)}; expected 'primal' or 'dual'")
        if side == "primal":
            return False
        if not self._core.is_orientable():
            raise TopologyError("the complex is not orientable, so its dual cells have no coherent orientation")
        return True

    def _form(self, w: npt.ArrayLike, k: int, side: str = "primal", name: str = "w") -> Floats:
        """The values of a k-form, one column or several, checked."""
        array = float_array(w, name)
        degree = self.dimension - k if side == "dual" else k
        count = self._sizes[degree]
        if array.ndim in (1, 2) and array.shape[0] == count and array.shape[-1] > 0:
            return array
        if count == 0 and array.shape == (0,):
            return array
        raise InputError(
            f"{name} has shape {array.shape}; a {side} {k}-form of this complex has shape ({count},), one value for "
            f"every {degree}-simplex, or ({count}, columns)"
        )

    def _one_form(self, w: npt.ArrayLike, k: int, side: str = "primal", name: str = "w") -> Floats:
        """As `_form`, but one column only."""
        array = self._form(w, k, side, name)
        if array.ndim == 2:
            raise InputError(f"{name} has shape {array.shape}; expected one form, of shape ({array.shape[0]},)")
        return array

    def _result(self, out: Floats | None, shape: tuple[int, ...], x: Floats) -> Floats:
        """A new array, or `out` if it is one to write to and none of the memory of the argument x."""
        if out is None:
            return np.empty(shape)
        if not isinstance(out, np.ndarray):
            raise InputError(f"out is {shown(out)}; expected an array of shape {shape}")
        if out.shape != shape or out.dtype != np.float64 or not out.flags.c_contiguous or not out.flags.writeable:
            raise InputError(
                f"out is an array of {out.dtype} of shape {out.shape}; expected a writable C-ordered one of float64 of "
                f"shape {shape}"
            )
        if np.shares_memory(out, x):
            raise InputError("out shares memory with the argument, which is read while out is written")
        return out

    def _sets(self, simplices: Mapping[int, npt.ArrayLike]) -> list[Integers]:
        """A set of simplices by degree as the compiled half takes it."""
        if not isinstance(simplices, Mapping):
            raise InputError(f"the set of simplices is {shown(simplices)}; expected a mapping from degrees to indices")
        lists = [np.zeros(0, index_dtype) for _ in self._sizes]
        for k, indices in simplices.items():
            k = self._degree(k)
            array = np.unique(index_list(indices, f"the set of {k}-simplices"))
            if array.size and (array[0] < 0 or array[-1] >= self._sizes[k]):
                wrong = array[0] if array[0] < 0 else array[-1]
                raise InputError(f"there is no {k}-simplex {wrong}; expected 0 to {self._sizes[k] - 1}")
            lists[k] = array
        return lists

    @staticmethod
    def _by_degree(lists: Sequence[npt.NDArray[Any]]) -> dict[int, Integers]:
        return {k: indices for k, indices in enumerate(lists) if len(indices)}
