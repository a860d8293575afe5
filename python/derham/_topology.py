"""The rooms boundary and forms: ∂ and d as matrices and without, chains, the manifold certificate."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt
import scipy.sparse as sparse

from ._arguments import Floats, Integers, array_of, index_array, index_dtype, signed_dtype
from ._base import Side, compressed, read_only, smallest_offsets
from ._boundary import Boundary
from ._simplices import Simplices
from .errors import InputError
from .reports import ManifoldDefect, ManifoldReport


class Topology(Boundary, Simplices):
    """What needs no metric."""

    def boundary(self, k: int, dtype: npt.DTypeLike = np.int8) -> sparse.csc_array:
        """∂_k by columns: the faces of every k-simplex with their signs.

        Shape    |K_{k-1}| × |K_k|; 0 × |K_0| for k = 0
        Memory   indices are the library's own, read-only; values and column pointers are made once and shared
        Law      boundary(k-1) @ boundary(k) is zero, exactly
        Invalid  as int8, products of matrices whose sums exceed 127: they are int8, too. Take dtype=int
        Raises   InputError unless 0 <= k <= n
        Source   Elcott & Schröder, §4

        >>> import derham
        >>> derham.Complex([(0, 1, 2)]).boundary(2).toarray()
        array([[ 1],
               [-1],
               [ 1]], dtype=int8)
        """
        k = self._degree(k)
        return compressed(sparse.csc_array, self._table(k, dtype), (self.size(k - 1), self._sizes[k]))

    def d(self, k: int, side: Side = "primal", dtype: npt.DTypeLike = np.int8) -> sparse.sparray:
        """d_k, the exterior derivative of k-forms, by rows: the transpose of `boundary(k + 1)`.

        On dual k-forms it is (-1)^(n-k) ∂_{n-k}, by columns; dual cells are open at the boundary, so that the form
        counts as zero there.

        Shape    |K_{k+1}| × |K_k|; dual: |K_{n-k-1}| × |K_{n-k}|; no rows for k = n
        Memory   as `boundary`
        Law      d(k+1) @ d(k) is zero, exactly
        Invalid  as int8, graph Laplacians and other products as with `boundary`: take dtype=int
        Raises   InputError unless 0 <= k <= n; TopologyError for dual forms if K is not orientable
        Source   Elcott & Schröder, §6.1

        >>> import derham
        >>> derham.Complex([(0, 1, 2)]).d(1).toarray()
        array([[ 1, -1,  1]], dtype=int8)
        """
        k = self._degree(k)
        if self._side(side):
            dual = self.boundary(self.dimension - k, dtype)
            return -dual if (self.dimension - k) % 2 else dual
        return compressed(sparse.csr_array, self._table(k + 1, dtype), (self.size(k + 1), self._sizes[k]))

    def _table(self, k: int, dtype: npt.DTypeLike) -> tuple[npt.NDArray[Any], Integers, Integers]:
        """Values, indices and pointers of ∂_k by columns, which are those of d_{k-1} by rows."""
        dtype = signed_dtype(dtype)
        found: tuple[npt.NDArray[Any], Integers, Integers] | None = self._kept.get(("table", k, dtype))
        if found is None:
            found = self._kept["table", k, dtype] = self._new_table(k, dtype)
        return found

    def _new_table(self, k: int, dtype: np.dtype[Any]) -> tuple[npt.NDArray[Any], Integers, Integers]:
        if not 1 <= k <= self.dimension:
            pointers = np.zeros(self.size(k) + 1, index_dtype)
            return np.zeros(0, dtype), np.zeros(0, index_dtype), pointers
        faces = self._core.faces(k)
        if dtype == np.int8:
            values = np.empty(faces.shape, np.int8)
            values[:] = [(-1) ** (k - j) for j in range(k + 1)]
            if k == self.dimension:
                values *= self.signs[:, np.newaxis]
        else:
            values = self._table(k, np.int8)[0].astype(dtype)
        pointers = np.arange(0, faces.size + 1, k + 1, dtype=smallest_offsets(faces.size))
        return read_only(values.reshape(-1)), faces.reshape(-1), read_only(pointers)

    def apply_d(
        self,
        w: npt.ArrayLike,
        k: int,
        side: Side = "primal",
        out: Floats | None = None,
        *,
        boundary: npt.ArrayLike | None = None,
    ) -> Floats:
        """d_k w without a matrix, for primal forms on several threads: much faster than `d(k) @ w`.

        boundary of dual forms: the k-form's trace, a dual k-form on the boundary (|∂K_{n-1-k}|,). Dual cells are then closed
                 there, d(d(w)) = 0 with the trace and its d; else they are open, as if it were 0
        Shape    w (|K_k|,) or (|K_k|, columns); the result (|K_{k+1}|, …), written to `out` if that is given; dual
                 k-forms have a value for every (n-k)-simplex
        Cost     one pass over the face table; the same bits for any number of threads
        Raises   InputError unless 0 <= k < n, or on a wrong shape; TopologyError as `d`
        """
        k = self._degree(k, 0, self.dimension - 1)
        if boundary is not None:
            if not self._side(side) or out is not None:
                raise InputError("boundary is given; expected side='dual' and no out")
            core, complex, _ = self._boundary()
            return core.d(k, self._one_form(w, k, side), complex._one_form(boundary, k, side, "boundary"))
        if self._side(side):
            result = self.apply_boundary(self._form(w, k, side), self.dimension - k, out)
            return np.negative(result, out=result) if (self.dimension - k) % 2 else result
        x = self._form(w, k)
        y = self._result(out, (self._sizes[k + 1], *x.shape[1:]), x)
        self._core.apply_coboundary(k, x, y)
        return y

    def apply_boundary(self, c: npt.ArrayLike, k: int, out: Floats | None = None) -> Floats:
        """∂_k c without a matrix, for real chains c.

        Shape    c (|K_k|,) or (|K_k|, columns); the result (|K_{k-1}|, …)
        Cost     one pass over the face table, on one thread
        Raises   InputError unless 1 <= k <= n, or on a wrong shape
        """
        k = self._degree(k, 1)
        x = self._form(c, k, name="c")
        y = self._result(out, (self._sizes[k - 1], *x.shape[1:]), x)
        self._core.apply_boundary(k, x, y)
        return y

    def chain(self, tuples: npt.ArrayLike, coefficients: npt.ArrayLike = 1) -> npt.NDArray[np.int64]:
        """The k-chain Σ coefficients[i] tuples[i], for oriented simplices given by any alias.

        The integral of a k-form over it is their dot product; its boundary is `boundary(k) @ chain`.

        Shape    tuples (count, k+1), coefficients (count,) or one; the result (|K_k|,)
        Raises   InputError naming a tuple that is no simplex of K, or for coefficients that are not whole

        >>> import derham
        >>> K = derham.Complex([(0, 1, 2)])
        >>> K.boundary(1) @ K.chain([(0, 1), (1, 2)])
        array([-1,  0,  1])
        """
        rows = np.atleast_2d(index_array(tuples, "tuples"))
        index, sign = self.index(rows)
        whole = array_of(coefficients, "coefficients")
        if whole.shape not in ((), index.shape) or whole.dtype.kind not in "iu":
            raise InputError(
                f"coefficients are an array of {whole.dtype} of shape {whole.shape}; expected integers, one or {index.shape}"
            )
        result = np.zeros(self._sizes[rows.shape[1] - 1], np.int64)
        np.add.at(result, index, sign * whole.astype(np.int64))
        return result

    def check(self) -> ManifoldReport:
        """Whether K is a combinatorial manifold, possibly with boundary, and what is wrong where it is not.

        Source   Elcott & Schröder, §2, with the vertex test made decidable

        >>> import derham
        >>> derham.Complex([(0, 1, 2), (0, 3, 4)]).check().verdict
        'no'
        """
        verdict, pure, closed, orientable, defects = self._core.check()
        return ManifoldReport(
            verdict, pure, closed, orientable, tuple(ManifoldDefect(k, tuple(s), d) for k, s, d in defects)
        )
