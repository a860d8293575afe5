"""What all rooms of Complex share: degrees, shapes, and arrays as the compiled half takes them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Literal, TypeAlias

import numpy as np
import numpy.typing as npt

from . import _derham
from .errors import InputError, TopologyError

Side: TypeAlias = Literal["primal", "dual"]
Floats: TypeAlias = npt.NDArray[np.float64]
#: Indices: of 64 bits in a build with DERHAM_INDEX64, but that is not the type checker's business.
Integers: TypeAlias = npt.NDArray[np.int32]

#: The type of indices of simplices and vertices.
index_dtype: np.dtype[Any] = np.dtype(np.int32 if _derham.index_bits == 32 else np.int64)


def float_array(values: npt.ArrayLike, name: str) -> Floats:
    """Real numbers in C order; itself if it is one already. InputError for anything else."""
    array = np.asarray(values)
    if array.dtype.kind not in "fiub":
        raise InputError(f"{name} is an array of {array.dtype}; expected real numbers")
    return np.ascontiguousarray(array, dtype=np.float64)


def index_array(values: npt.ArrayLike, name: str) -> Integers:
    """Indices in C order; itself if it is one already. InputError if they are no integers or do not fit."""
    array = np.asarray(values)
    if array.size == 0 and array.dtype.kind == "f":
        array = array.astype(index_dtype)
    if array.dtype.kind not in "iu":
        raise InputError(f"{name} is an array of {array.dtype}; expected integers")
    limits = np.iinfo(index_dtype)
    if array.dtype.itemsize >= index_dtype.itemsize and array.dtype != index_dtype and array.size:
        low, high = array.min(), array.max()
        if low < limits.min or high > limits.max:
            raise InputError(f"{name} holds {high if high > limits.max else low}; expected at most {limits.max}")
    return np.ascontiguousarray(array, dtype=index_dtype)


def smallest_offsets(last: int) -> np.dtype[Any]:
    """The type of row pointers that scipy keeps as it is: that of the indices while they fit."""
    return index_dtype if last <= np.iinfo(index_dtype).max else np.dtype(np.int64)


def read_only(array: npt.NDArray[Any]) -> npt.NDArray[Any]:
    array.flags.writeable = False
    return array


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
        """|K_k|; 0 outside of 0 <= k <= n."""
        return self._sizes[k] if 0 <= k < len(self._sizes) else 0

    def _degree(self, k: int, low: int = 0, high: int | None = None, name: str = "k") -> int:
        high = self.dimension if high is None else high
        if isinstance(k, (int, np.integer)) and low <= k <= high:
            return int(k)
        expected = f"expected {low} to {high} in this complex" if low <= high else "there is none in this complex"
        raise InputError(f"the degree {name} is {k!r}; {expected} of dimension {self.dimension}")

    def _side(self, side: str) -> bool:
        """Whether the side is dual. Dual cells have an orientation where the complex has one."""
        if side == "primal":
            return False
        if side != "dual":
            raise InputError(f"the side is {side!r}; expected 'primal' or 'dual'")
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

    def _result(self, out: Floats | None, shape: tuple[int, ...]) -> Floats:
        """A new array, or `out` if it is one to write to."""
        if out is None:
            return np.empty(shape)
        if out.shape != shape or out.dtype != np.float64 or not out.flags.c_contiguous or not out.flags.writeable:
            raise InputError(
                f"out is an array of {out.dtype} of shape {out.shape}; expected a writable C-ordered one of float64 of "
                f"shape {shape}"
            )
        return out

    def _sets(self, simplices: Mapping[int, npt.ArrayLike]) -> list[list[int]]:
        """A set of simplices by degree as the compiled half takes it."""
        lists: list[list[int]] = [[] for _ in self._sizes]
        for k, indices in simplices.items():
            array = np.unique(index_array(indices, f"the set of {k}-simplices"))
            k = self._degree(k)
            if array.size and (array[0] < 0 or array[-1] >= self._sizes[k]):
                wrong = array[0] if array[0] < 0 else array[-1]
                raise InputError(f"there is no {k}-simplex {wrong}; expected 0 to {self._sizes[k] - 1}")
            lists[k] = array.tolist()
        return lists

    @staticmethod
    def _by_degree(lists: Sequence[npt.NDArray[Any]]) -> dict[int, Integers]:
        return {k: indices for k, indices in enumerate(lists) if len(indices)}
