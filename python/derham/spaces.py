"""Forms with boundary conditions, and a complex with its refinement."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import scipy.sparse as sparse

from . import _derham
from ._arguments import Integers
from ._base import compressed
from .errors import InputError, TopologyError
from .reports import table

if TYPE_CHECKING:
    from .complex import Complex


class FormSpace:
    """The primal forms that are prescribed on a part Γ of the boundary of K: those of the relative complex (K, Γ).

    A system A x = b with data g on Γ becomes Eᵀ A E x = Eᵀ (b - A g), E = extension(k).
    """

    def __init__(self, complex: Complex, lists: list[tuple[Integers, Integers]]) -> None:
        self.complex = complex
        self._lists = lists

    def free(self, k: int) -> Integers:
        """The k-simplices that are not in Γ: the unknowns.

        Shape    (free,), increasing indices
        Raises   InputError unless 0 <= k <= n
        """
        return self._lists[self.complex._degree(k)][0]

    def prescribed(self, k: int) -> Integers:
        """The k-simplices in Γ.

        Shape    (prescribed,), increasing indices
        Raises   InputError unless 0 <= k <= n
        """
        return self._lists[self.complex._degree(k)][1]

    def extension(self, k: int) -> sparse.csc_array:
        """E, extension by zero.

        Shape    |K_k| × |free(k)|
        Raises   InputError unless 0 <= k <= n
        """
        free = self.free(k)
        pointers = np.arange(len(free) + 1, dtype=free.dtype)
        return compressed(sparse.csc_array, (np.ones(len(free)), free, pointers), (self.complex.size(k), len(free)))

    def __repr__(self) -> str:
        counts = ", ".join(f"{len(free)} of {len(free) + len(held)}" for free, held in self._lists)
        return f"derham.FormSpace with {counts} free values by degree"

    def _repr_html_(self) -> str:
        return table("FormSpace", [
            (f"free {k}-simplices", f"{len(free):,} of {len(free) + len(held):,}") for k, (free, held) in enumerate(self._lists)
        ])


class Refinement:
    """The edgewise subdivision of K: every k-simplex is cut into 2^k by the midpoints of its edges, n = 1 to 4.

    Laws     d prolongation = prolongation d; restriction prolongation = 1; both exact
    Source   Freudenthal 1942; Edelsbrunner & Grayson 2000
    """

    def __init__(self, coarse: Complex) -> None:
        if not 1 <= coarse.dimension <= 4:
            raise InputError(f"the dimension of the complex is {coarse.dimension}; expected 1 to 4")
        if not coarse.is_pure:
            raise TopologyError("a refinement needs a pure complex: some maximal simplices have lower dimension than others")
        self.coarse = coarse
        self._core = _derham.Refinement(coarse._core)
        #: The fine complex, with the metric and the parts of the coarse one.
        self.fine: Complex = coarse._of(self._core.fine())

    def __reduce__(self) -> tuple[Any, ...]:
        return Refinement, (self.coarse,)

    def __repr__(self) -> str:
        return f"derham.Refinement from {self.coarse.sizes} to {self.fine.sizes} simplices"

    def prolongation(self, k: int) -> sparse.csr_array:
        """P: the integrals of the Whitney form of a coarse k-form over the fine simplices.

        Shape    |fine K_k| × |K_k|
        Raises   InputError unless 0 <= k <= n
        """
        arrays = self._core.prolongation(self.coarse._degree(k))
        return compressed(sparse.csr_array, arrays, (self.fine.size(k), self.coarse.size(k)))

    def restriction(self, k: int) -> sparse.csr_array:
        """R: the sum of the values on the pieces of every coarse simplex.

        Shape    |K_k| × |fine K_k|
        Raises   InputError unless 0 <= k <= n
        """
        arrays = self._core.restriction(self.coarse._degree(k))
        return compressed(sparse.csr_array, arrays, (self.coarse.size(k), self.fine.size(k)))

    def _repr_html_(self) -> str:
        sizes = zip(self.coarse.sizes, self.fine.sizes, strict=True)
        return table("Refinement", [(f"{k}-simplices", f"{a:,} into {b:,}") for k, (a, b) in enumerate(sizes)])
