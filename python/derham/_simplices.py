"""The room complex: lists of simplices, signs, lookup, neighbours."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt
import scipy.sparse as sparse

from ._arguments import Integers, index_array, signed_dtype
from ._base import Base, compressed, smallest_offsets
from .errors import InputError


class SignedIndex(NamedTuple):
    """Positions of simplices in their list, and the signs of the aliases they were asked by: arrays, or two numbers for one."""

    index: Integers | Any  # type: ignore[assignment]  # not that of tuples
    sign: npt.NDArray[np.int8] | Any


class Simplices(Base):
    """The lists K_0, …, K_n and what is found in them."""

    @property
    def is_orientable(self) -> bool:
        """Whether its simplices have coherent orientations; else all top simplices count as positive."""
        return self._core.is_orientable()

    @property
    def is_pure(self) -> bool:
        """Whether every maximal simplex has the dimension of the complex."""
        return self._core.is_pure()

    @property
    def one_sided(self) -> Integers:
        """The proof that K is not orientable: a closed walk of top simplices, each sharing a facet with the next and the last
        with the first, along which orientation is reversed. Empty if K is orientable."""
        return self._core.one_sided()

    @property
    def components(self) -> int:
        """The number of connected components."""
        return self._core.component_count()

    @property
    def euler_characteristic(self) -> int:
        """χ = Σ (-1)^k |K_k|."""
        return sum((-1) ** k * size for k, size in enumerate(self._sizes))

    def simplices(self, k: int) -> Integers:
        """K_k: the sorted vertices of every k-simplex; the position in the list is the index in every form and matrix.

        Vertices by id, top simplices in the order of the input, every degree between in lexicographic order.

        Shape    (|K_k|, k+1), read-only, no copy
        Raises   InputError unless 0 <= k <= n

        >>> import derham
        >>> derham.Complex([(0, 1, 2), (3, 2, 1)]).simplices(1)
        array([[0, 1],
               [0, 2],
               [1, 2],
               [1, 3],
               [2, 3]], dtype=int32)
        """
        return self._core.simplices(self._degree(k))

    def oriented_simplices(self) -> Integers:
        """The top simplices as positively oriented tuples: sorted, with the last two vertices exchanged where `signs` is -1.

        Shape    (|K_n|, n+1), a copy
        """
        rows: Integers = self.simplices(self.dimension).copy()
        if self.dimension > 0:
            negative = self.signs < 0
            rows[negative, -2:] = rows[negative, :-3:-1]
        return rows

    def faces(self, k: int) -> Integers:
        """The indices of the faces of every k-simplex; place j is the face without its vertex number k-j.

        Shape    (|K_k|, k+1), read-only, no copy
        Raises   InputError unless 1 <= k <= n
        """
        return self._core.faces(self._degree(k, 1))

    @property
    def signs(self) -> npt.NDArray[np.int8]:
        """S(representative) of every top simplex: +1 where its sorted tuple is positively oriented, else -1.

        Shape    (|K_n|,), read-only, no copy
        """
        return self._core.signs()

    def find(self, tuples: npt.ArrayLike) -> SignedIndex:
        """The index and sign of every alias: any order of the vertices of a simplex. -1 and 0 where it is none of K.

        Shape    tuples (count, k+1), or (k+1,) for one
        Raises   InputError on a wrong shape, or unless 0 <= k <= n
        Source   Elcott & Schröder, "Building your own DEC at home", §3.2

        >>> import derham
        >>> derham.Complex([(0, 1, 2)]).find([(1, 0), (0, 2), (0, 3)])
        SignedIndex(index=array([ 0,  1, -1], dtype=int32), sign=array([-1,  1,  0], dtype=int8))
        """
        array = index_array(tuples, "tuples")
        if array.ndim == 1 and np.ndim(tuples) == 1 and 1 <= array.size <= self.dimension + 1:
            index, sign = self._core.find(array.reshape(1, -1))
            return SignedIndex(int(index[0]), int(sign[0]))
        if array.ndim != 2 or not 1 <= array.shape[1] <= self.dimension + 1:
            raise InputError(
                f"tuples have shape {array.shape}; expected (count, k+1) with 0 <= k <= {self.dimension}, a row for "
                "every simplex, or (k+1,)"
            )
        return SignedIndex(*self._core.find(array))

    def index(self, tuples: npt.ArrayLike) -> SignedIndex:
        """As `find`, for simplices of K only.

        Shape    as `find`
        Raises   as `find`; InputError naming the first tuple that is no simplex of K

        >>> import derham
        >>> derham.Complex([(0, 1, 2)]).index((2, 1))
        SignedIndex(index=2, sign=-1)
        """
        found = self.find(tuples)
        if np.ndim(found.sign) == 0:
            if found.sign == 0:
                raise InputError(f"the tuple {_text(tuples)} is no simplex of the complex")
        elif not found.sign.all():
            row = int(np.flatnonzero(found.sign == 0)[0])
            raise InputError(f"row {row}, the tuple {_text(np.asarray(tuples)[row])}, is no simplex of the complex", row)
        return found

    def incidence(self, k: int, m: int, dtype: npt.DTypeLike = np.int8) -> sparse.csr_array:
        """Which m-simplices are incident on every k-simplex: its faces (m < k), its cofaces (m > k), itself.

        Shape    |K_k| × |K_m|, entries 1 in increasing order
        Invalid  as int8, products whose sums exceed 127: take dtype=int
        Raises   InputError unless 0 <= k, m <= n
        Source   Elcott & Schröder, §4
        """
        k, m = self._degree(k), self._degree(m, name="m")
        offsets, indices = self._core.incidence(k, m)
        arrays = np.ones(indices.size, signed_dtype(dtype)), indices, offsets.astype(smallest_offsets(indices.size))
        return compressed(sparse.csr_array, arrays, (self._sizes[k], self._sizes[m]))

    def closure(self, simplices: Mapping[int, npt.ArrayLike]) -> dict[int, Integers]:
        """All faces of a set of simplices, and they themselves. A set is a mapping from degrees to indices.

        Raises   InputError naming an index that is none

        >>> import derham
        >>> derham.Complex([(0, 1, 2)]).closure({1: [2]})
        {0: array([1, 2], dtype=int32), 1: array([2], dtype=int32)}
        """
        return self._by_degree(self._core.closure(self._sets(simplices)))

    def open_star(self, simplices: Mapping[int, npt.ArrayLike]) -> dict[int, Integers]:
        """All simplices that have one of the set as a face, and they themselves.

        Raises   as `closure`
        """
        return self._by_degree(self._core.open_star(self._sets(simplices)))

    def link(self, simplices: Mapping[int, npt.ArrayLike]) -> dict[int, Integers]:
        """The closure of the star without the star of the closure.

        Raises   as `closure`
        """
        return self._by_degree(self._core.link(self._sets(simplices)))


def _text(tuple_: npt.ArrayLike) -> str:
    return "(" + ", ".join(str(v) for v in np.asarray(tuple_)) + ")"
