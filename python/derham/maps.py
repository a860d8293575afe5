"""Simplicial maps, and what they do to forms and chains."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt
import scipy.sparse as sparse

from . import _derham
from ._arguments import Floats, Integers, array_of, index_list, shown, signed_dtype
from ._base import compressed
from ._simplices import SignedIndex
from .complex import Complex
from .errors import InputError


class SimplicialMap:
    """A map of the vertices of K to those of L that takes every simplex of K to a simplex of L, perhaps of lower dimension.

    vertices  (|V(K)|,): where every vertex goes

    Cost     a search in L for every maximal simplex of K
    Raises   InputError on a wrong length, or naming a simplex of K whose image is none of L
    Source   Munkres, "Elements of Algebraic Topology", 1984, §2, §12

    >>> import derham
    >>> phi = derham.SimplicialMap(derham.generate.cycle(6), derham.generate.cycle(3), [0, 1, 2, 0, 1, 2])
    >>> int(phi.pullback([1.0, 0, 0], 1).sum())  # twice around
    2
    """

    def __init__(self, source: Complex, target: Complex, vertices: npt.ArrayLike) -> None:
        for complex in (source, target):
            if not isinstance(complex, Complex):
                raise InputError(f"a map goes between complexes; one is {shown(complex)}")
        if source.dimension == 0:
            raise InputError("the dimension of the source is 0; expected 1 to 6")
        self.source = source
        self.target = target
        self.vertices: Integers = index_list(vertices, "vertices").copy()
        self.vertices.flags.writeable = False
        self._core = _derham.SimplicialMap(source._core, target._core, self.vertices)

    def __reduce__(self) -> tuple[Any, ...]:
        return SimplicialMap, (self.source, self.target, self.vertices)

    def images(self, k: int) -> SignedIndex:
        """Where every positively oriented k-simplex of K goes, and the sign of its orientation there; -1 and 0 if it is
        collapsed.

        Shape    (|K_k|,)
        Raises   InputError unless 0 <= k <= n
        """
        return SignedIndex(*self._core.images(self.source._degree(k)))

    def matrix(self, k: int, dtype: npt.DTypeLike = np.int8) -> sparse.csr_array:
        """The pullback of k-forms; its transpose is the pushforward of k-chains.

        Shape    |K_k| × |L_k|, entries ±1
        Invalid  as int8, products whose sums exceed 127: take dtype=int
        Raises   InputError unless 0 <= k <= n
        """
        index, sign = self.images(k)
        kept = sign != 0
        pointers = np.concatenate([[0], np.cumsum(kept)]).astype(index.dtype)
        arrays = sign[kept].astype(signed_dtype(dtype)), index[kept], pointers
        return compressed(sparse.csr_array, arrays, (self.source.size(k), self.target.size(k)))

    def pullback(self, w: npt.ArrayLike, k: int) -> Floats:
        """φ*w, the k-form on K whose value on a simplex is that of w on its image; 0 where the simplex is collapsed.

        Shape    w (|L_k|,); the result (|K_k|,)
        Laws     d φ*w = φ* dw;  φ*(a ∧ b) = φ*a ∧ φ*b; both exact
        Raises   InputError unless 0 <= k <= dimension of K and L, or on a wrong shape
        """
        k = self.source._degree(self.target._degree(k))
        result = np.empty(self.source.size(k))
        self._core.pullback(k, self.target._one_form(w, k), result)
        return result

    def pushforward(self, c: npt.ArrayLike, k: int) -> npt.NDArray[Any]:
        """φ_* c, the image of a k-chain; collapsed simplices vanish. Integers stay integers.

        Shape    c (|K_k|,); the result (|L_k|,)
        Law      ∂ φ_* c = φ_* ∂c
        Raises   as `pullback`
        """
        k = self.source._degree(self.target._degree(k))
        index, sign = self.images(k)
        chain = array_of(c, "c")
        if chain.shape != sign.shape:
            raise InputError(f"c has shape {chain.shape}; a {k}-chain of the source has shape {sign.shape}")
        kept = sign != 0
        result = np.zeros(self.target.size(k), np.result_type(chain, np.int64))
        np.add.at(result, index[kept], sign[kept] * chain[kept])
        return result

    def __matmul__(self, first: SimplicialMap) -> SimplicialMap:
        """First the other map, then this one."""
        if not isinstance(first, SimplicialMap):
            return NotImplemented
        if first.target is not self.source:
            raise InputError("the first map ends in another complex than the second begins in")
        return SimplicialMap(first.source, self.target, self.vertices[first.vertices])
