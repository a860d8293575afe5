"""δ and Laplace–de Rham as matrices."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt
import scipy.sparse as sparse

from ._arguments import shown
from ._base import Side, compressed
from ._hodge import DiagonalStarKind, Hodge, Material, with_inverse
from .errors import InputError
from .spaces import FormSpace


class MixedLaplacian(NamedTuple):
    """`matrix` x = λ `mass` x for x = (σ, u); the first `sigma` unknowns are those of σ."""

    sigma: int
    matrix: sparse.csr_array
    mass: sparse.csr_array


class Laplacians(Hodge):
    """What is composed of d and ⋆."""

    def codifferential(
        self,
        k: int,
        kind: DiagonalStarKind = "circumcentric",
        *,
        side: Side = "primal",
        weights: npt.ArrayLike | None = None,
        material: Material | None = None,
    ) -> sparse.csr_array:
        """δ of k-forms, on primal ones ⋆_{k-1}⁻¹ d_{k-1}ᵀ ⋆_k, with a diagonal star.

        Shape    |K_{k-1}| × |K_k|; dual: |K_{n-k+1}| × |K_{n-k}|
        Units    length^-2
        Boundary natural: the flux through it counts as zero
        Raises   InputError unless 1 <= k <= n; otherwise as `star_inverse`
        Source   Hirani 2003, §3.7
        """
        k = self._degree(k, 1)
        dual = self._side(side)
        arrays = with_inverse(self._star(kind, weights, material).codifferential, k, dual)
        shape = (self._count(k - 1, dual), self._count(k, dual))
        return compressed(sparse.csr_array, arrays, shape)

    def laplacian(
        self,
        k: int,
        kind: DiagonalStarKind = "circumcentric",
        *,
        side: Side = "primal",
        weights: npt.ArrayLike | None = None,
        material: Material | None = None,
    ) -> sparse.csr_array:
        """Laplace–de Rham Δ = dδ + δd of k-forms with a diagonal star; for functions minus the Laplacian of analysis.

        Shape    |K_k| × |K_k|; dual: |K_{n-k}| × |K_{n-k}|
        Units    length^-2
        Matrix   self-adjoint for ⋆; where all dual volumes are positive, positive semi-definite with a kernel of
                 dimension β_k on primal forms
        Boundary natural
        Raises   InputError unless 0 <= k <= n and n >= 1; otherwise as `star_inverse`
        Source   Elcott & Schröder, "Building your own DEC at home", §7

        >>> import derham
        >>> K = derham.generate.a_star_lattice(2, 6)
        >>> bool(abs(K.laplacian(0).sum(axis=1)).max() < 1e-12)
        True
        """
        k = self._degree(k)
        dual = self._side(side)
        arrays = with_inverse(self._star(kind, weights, material).laplacian, k, dual)
        return compressed(sparse.csr_array, arrays, (self._count(k, dual),) * 2)

    def weak_laplacian(
        self,
        k: int,
        kind: DiagonalStarKind = "circumcentric",
        *,
        weights: npt.ArrayLike | None = None,
        material: Material | None = None,
    ) -> sparse.csr_array:
        """⋆_k Δ of primal k-forms with a diagonal star: an eigenproblem is solved with it against `star(k)`.

        Shape    |K_k| × |K_k|, units length^(n-2k-2)
        Matrix   symmetric; positive semi-definite with a kernel of dimension β_k where the stars are positive
        Raises   InputError unless 0 <= k <= n and n >= 1; otherwise as `star_inverse(k - 1)`
        """
        k = self._degree(k)
        arrays = with_inverse(self._star(kind, weights, material).weak_laplacian, k)
        return compressed(sparse.csr_array, arrays, (self._sizes[k],) * 2)

    def mixed_laplacian(
        self, k: int, *, material: Material | None = None, space: FormSpace | None = None
    ) -> MixedLaplacian:
        """Laplace–de Rham of k-forms u with Whitney masses and σ = δu as an unknown of its own: valid on every mesh.

        space    where u and σ are prescribed to be 0; rows and columns are then those of free simplices
        Shape    matrix and mass: σ and u, |K_{k-1}| + |K_k|, or how many of them are free
        Raises   InputError unless 0 <= k <= n and n >= 1, or for a form space of another complex; GeometryError without a
                 metric, or naming flat top simplices
        Source   Arnold, Falk, Winther, "Finite element exterior calculus", 2006, §7
        """
        k = self._degree(k)
        sigma, kept = self.size(k - 1), None
        count = sigma + self._sizes[k]
        if space is not None:
            if not isinstance(space, FormSpace):
                raise InputError(f"space is {shown(space)}; expected a form space of this complex")
            if space.complex is not self:
                raise InputError("the form space is of another complex")
            free_sigma = space.free(k - 1) if k else space.free(0)[:0]
            kept = np.concatenate([free_sigma, sigma + space.free(k)])
            sigma, count = len(free_sigma), len(kept)
        matrix, mass = (
            compressed(sparse.csr_array, arrays, (count, count))
            for arrays in self._core.mixed_laplacian(k, self._material(material), kept)
        )
        return MixedLaplacian(sigma, matrix, mass)

    def _count(self, k: int, dual: bool) -> int:
        return self._sizes[self.dimension - k if dual else k]
