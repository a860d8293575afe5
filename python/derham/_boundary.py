"""The boundary as a complex of its own, and what goes there and back: traces, natural data, Robin conditions."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt
import scipy.sparse as sparse

from . import _derham
from ._arguments import Floats, Integers, float_array, index_list, real_number, shown
from ._base import Base, compressed
from .errors import InputError

if TYPE_CHECKING:
    from .complex import Complex


class Boundary(Base):
    """∂K and the forms on it. Each degree and side is as on any complex; ∂K has dimension n-1."""

    def boundary_simplices(self) -> dict[int, Integers]:
        """The simplices on the boundary: the closure of the facets with exactly one coface."""
        return self._by_degree(self._core.boundary_simplices())

    def boundary_complex(self) -> tuple[Complex, list[Integers]]:
        """The boundary as a complex of its own, oriented as the boundary of K (for n = 1 its points are positive), with its
        metric if K has one.

        With it comes the inclusion by degree: `inclusion[k][i]` is the index in K of the boundary's k-simplex i. The same
        objects in every call.

        Raises   InputError for n = 0; TopologyError if K is not pure
        """
        complex, inclusion = self._boundary()[1:]
        return complex, inclusion

    def trace(self, w: npt.ArrayLike, k: int) -> Floats:
        """tr w, the restriction of a primal k-form to the boundary, where it is a k-form: Dirichlet data for k = 0, the
        tangential part for k = 1, the flux outwards for k = n-1.

        Shape    w (|K_k|,); the result (|∂K_k|,)
        Law      tr dw = d tr w; for n >= 2 the sum of dw is that of tr w (Stokes)
        Raises   InputError unless 0 <= k < n, or on a wrong shape; as `boundary_complex`
        Source   Arnold, Falk, Winther, "Finite element exterior calculus", 2006, §2.2

        >>> import derham
        >>> K = derham.Complex([(0, 1, 2)])
        >>> bool(K.trace([1.0, 2, 4], 1).sum() == K.apply_d([1.0, 2, 4], 1).sum())
        True
        """
        k = self._degree(k, 0, self.dimension - 1)
        return self._boundary()[0].trace(k, self._one_form(w, k))

    def trace_matrix(self, k: int) -> sparse.csr_array:
        """The matrix of `trace`.

        Shape    |∂K_k| × |K_k|
        Raises   InputError unless 0 <= k < n and n <= 4; as `boundary_complex`
        """
        k = self._degree(k, 0, self.dimension - 1)
        core, complex, _ = self._boundary()
        return compressed(sparse.csr_array, core.trace_matrix(k), (complex.size(k), self._sizes[k]))

    def boundary_term(self, b: npt.ArrayLike, j: int) -> Floats:
        """trᵀ b, what a dual j-form b on the boundary adds to a right-hand side, a dual (j+1)-form on K.

        b has the integrals of tr ⋆w over the dual cells within ∂K: with k = n-1-j,
        ⟨da, w⟩ = ⟨a, δw⟩ + trace(a, k) @ b. For k = 0 it is the flux outwards.

        Shape    b (|∂K_k|,); the result (|K_k|,)
        Raises   InputError unless 0 <= j < n, or on a wrong shape; as `boundary_complex`
        Source   Desbrun, Kanso, Tong 2008, §6
        """
        j = self._degree(j, 0, self.dimension - 1, "j")
        core, complex, _ = self._boundary()
        return core.boundary_term(j, complex._one_form(b, j, "dual", "b"))

    def boundary_load(self, g: npt.ArrayLike, k: int, S: Any) -> Floats:
        """trᵀ S g, what a density g on the boundary, a primal k-form there, adds to the right-hand side of a weak problem of
        k-forms: natural data tr ⋆du = ⋆g (for functions the derivative outwards), or the data of a Robin condition.

        S        an inner product of k-forms on ∂K: `B.star(k, …)`, B = boundary_complex()[0], with a `boundary_material`
        Shape    g (|∂K_k|,), S |∂K_k| × |∂K_k|; the result (|K_k|,)
        Raises   as `boundary_term`
        """
        k = self._degree(k, 0, self.dimension - 1)
        complex = self.boundary_complex()[0]
        return self.boundary_term(self._inner_product(S, k) @ complex._one_form(g, k, name="g"), self.dimension - 1 - k)

    def robin_matrix(self, k: int, S: Any) -> sparse.csr_array:
        """trᵀ S tr, what a Robin condition tr ⋆du = ⋆h(g - tr u) adds to a weak operator on k-forms: S as for
        `boundary_load`, made with the number h as material.

        Shape    |K_k| × |K_k|
        Raises   as `boundary_load`; InputError for n > 4
        """
        k = self._degree(k, 0, self.dimension - 1)
        S = self._inner_product(S, k)
        if isinstance(S, sparse.dia_array) and S.offsets.tolist() == [0]:
            places = np.arange(S.shape[0] + 1)
            arrays: Any = S.diagonal(), places[:-1], places
        else:
            S = S if isinstance(S, sparse.csr_array) else sparse.csr_array(S)
            arrays = S.data, S.indices, S.indptr
        data = float_array(arrays[0], "S")
        indices, pointers = (np.ascontiguousarray(part, np.int32) for part in arrays[1:])
        return compressed(sparse.csr_array, self._boundary()[0].robin_matrix(k, data, indices, pointers), (self._sizes[k],) * 2)

    def boundary_material(self, parts: Iterable[tuple[npt.ArrayLike, float]]) -> Floats:
        """A material on the boundary: on some facets of K a number, 0 elsewhere. Stars and masses of the boundary with it are
        those of these parts alone, weighed: Robin numbers, prescribed fluxes, impedances.

        parts    pairs of facets, by their index in K, and a number
        Shape    (|∂K_{n-1}|,)
        Raises   InputError naming a facet that is not on the boundary, or that two parts have
        """
        try:
            pairs = [(facets, value) for facets, value in parts]
        except (TypeError, ValueError):
            raise InputError(f"parts is {shown(parts)}; expected pairs of facets and a number") from None
        boundary = self.boundary_complex()[1][-1]
        place = np.full(self.size(self.dimension - 1), -1)
        place[boundary] = np.arange(len(boundary))
        material, given = np.zeros(len(boundary)), np.zeros(len(boundary), bool)
        for facets, value in pairs:
            found = index_list(facets, "the facets")
            at = np.full(len(found), -1)
            inside = (found >= 0) & (found < len(place))
            at[inside] = place[found[inside]]
            if (wrong := at < 0).any():
                raise InputError(f"the facet {found[wrong][0]} is not on the boundary")
            if (wrong := given[at]).any():
                raise InputError(f"the facet {found[wrong][0]} is in two parts")
            given[at], material[at] = True, real_number(value, "the number of a part")
        return material

    def _boundary(self) -> tuple[_derham.Boundary, Complex, list[Integers]]:
        """The boundary as the compiled half has it, its complex, the inclusion."""
        found: tuple[_derham.Boundary, Complex, list[Integers]] | None = self._kept.get("boundary")
        if found is None:
            core = _derham.Boundary(self._core)
            found = self._kept["boundary"] = core, self._of(core.complex()), core.inclusion()
        return found

    def _inner_product(self, S: Any, k: int) -> Any:
        count = self.boundary_complex()[0].size(k)
        if not sparse.issparse(S):
            S = float_array(S, "S")
        if np.shape(S) != (count, count):
            raise InputError(f"S has shape {np.shape(S)}; an inner product of {k}-forms on the boundary, {(count, count)}")
        return S

    @classmethod
    def _of(cls, core: Any) -> Complex:
        raise NotImplementedError
