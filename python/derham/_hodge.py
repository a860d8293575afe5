"""The room hodge: Hodge stars, what they are good for, and weights that make one good."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Literal, TypeAlias, TypeVar

import numpy as np
import numpy.typing as npt
import scipy.sparse as sparse

from . import _derham
from ._arguments import Floats, Integers, float_array, index_list, one_of, real_number, shown
from ._base import compressed, diagonal_matrix
from ._geometry import Geometry
from .errors import GeometryError, InputError
from .reports import HotWeights, StarReport

#: Kinds of Hodge stars: diagonal ones, whose inverse is sparse, and all.
DiagonalStarKind: TypeAlias = Literal["circumcentric", "power", "barycentric", "lumped"]
StarKind: TypeAlias = Literal[DiagonalStarKind, "whitney"]
STAR_KINDS: tuple[str, ...] = ("circumcentric", "power", "barycentric", "lumped", "whitney")

#: Numbers (|K_n|,) or one; symmetric tensors (|K_n|, m, m) or one (m, m); or such rows with the row of every top simplex.
Material: TypeAlias = "npt.ArrayLike | tuple[npt.ArrayLike, npt.ArrayLike]"


T = TypeVar("T")


def with_inverse(work: Callable[..., T], *arguments: Any) -> T:
    """work(*arguments), which takes the inverse of a diagonal star. Where that has zeros, the error says what else there is."""
    try:
        return work(*arguments)
    except GeometryError as error:
        raise GeometryError(
            f"{str(error).partition('; use ')[0]}; use kind='power' with weights=K.hot_weights().weights, kind='barycentric' "
            "(accurate for k = 0 and n only), a mesh with positive dual volumes, or for Laplacians mixed_laplacian, which is "
            "valid on every mesh"
        ) from None


class Hodge(Geometry):
    """Where metric meets topology."""

    def star(
        self,
        k: int,
        kind: StarKind = "circumcentric",
        *,
        weights: npt.ArrayLike | None = None,
        material: Material | None = None,
    ) -> sparse.sparray:
        """⋆_k, from primal k-forms to dual (n-k)-forms.

        kind     "circumcentric" (diagonal, signed: see `star_verdict`), "power" (with `weights` (|V|,), length^2),
                 "barycentric" and "lumped" (good for k = 0 and n only), "whitney" (the mass matrix: positive on every mesh)
        Shape    |K_k| × |K_k|: diagonal, of its numbers no copy is made (`.diagonal()` for numbers, `.tocsr()` to slice); for
                 "whitney" by rows
        Units    length^(n-2k), times the material's
        Raises   InputError for a wrong degree, kind, weights or material; TopologyError if K is not orientable
                 (but for "whitney"); GeometryError without a metric, or naming flat top simplices
        Source   Elcott & Schröder, §6.2; Bell & Hirani, "PyDEC", 2012, §10 (whitney)

        >>> import derham
        >>> derham.generate.bcc_lattice(3).star(3).diagonal()[:3]
        array([12., 12., 12.])
        """
        k = self._degree(k)
        one_of(kind, STAR_KINDS, "the kind of star")
        if kind == "whitney":
            arrays = self._core.whitney_mass(k, self._material(material))
            return compressed(sparse.csr_array, arrays, (self._sizes[k],) * 2)
        return diagonal_matrix(self._star(kind, weights, material).diagonal(k))

    def star_inverse(
        self,
        k: int,
        kind: DiagonalStarKind = "circumcentric",
        *,
        weights: npt.ArrayLike | None = None,
        material: Material | None = None,
    ) -> sparse.dia_array:
        """The inverse of a diagonal ⋆_k, without the sign of the star back, which is (-1)^(k(n-k)) times it.

        Shape    |K_k| × |K_k|, units length^(2k-n)
        Raises   as `star`; GeometryError naming simplices whose dual volume is zero; InputError for "whitney", whose
                 inverse is not sparse: factorise it
        """
        k = self._degree(k)
        star = self._star(kind, weights, material, "factorise star(k, 'whitney')")
        return diagonal_matrix(with_inverse(star.inverse_diagonal, k))

    def star_verdict(
        self,
        k: int,
        kind: StarKind = "circumcentric",
        *,
        weights: npt.ArrayLike | None = None,
        material: Material | None = None,
    ) -> StarReport:
        """What `star` of these arguments is good for here: positive or not, where it is zero or negative, its condition,
        its error on constant forms, and what to use instead.

        Raises   as `star`; InputError for n = 0

        >>> import derham
        >>> verdict = derham.generate.box(2, 2).star_verdict(1)
        >>> verdict.definiteness, len(verdict.zero)
        ('not positive', 4)
        """
        k = self._degree(k)
        one_of(kind, STAR_KINDS, "the kind of star")
        if kind == "whitney":
            return StarReport(k, *self._core.whitney_report(k, self._material(material)))
        return StarReport(k, *self._star(kind, weights, material).report(k))

    def hot_weights(self, margin: float = 0.02) -> HotWeights:
        """Weights (|V|,) that make the power star positive and accurate, or the proof that there are none.

        margin   the least dual length of a facet, as a part of that of barycentres
        Use      star(k, "power", weights=K.hot_weights().weights)
        Units    of the weights: length^2
        Raises   InputError unless 0 < margin < 1 and n >= 1; GeometryError without a metric, or naming flat top simplices
        Source   Mullen, Memari, de Goes, Desbrun, "HOT: Hodge-optimized triangulations", 2011

        >>> import derham
        >>> K = derham.generate.box(2, 3)
        >>> bool(K.star_verdict(1)), bool(K.star_verdict(1, "power", weights=K.hot_weights().weights))
        (False, True)
        """
        weights, energy_before, energy, before, after, excluded, advice = self._core.hot_weights(
            real_number(margin, "margin")
        )
        return HotWeights(weights, energy_before, energy, tuple(before), tuple(after), excluded, advice)

    def _star(
        self, kind: str, weights: npt.ArrayLike | None, material: Material | None, instead: str = "take mixed_laplacian(k)"
    ) -> _derham.Star:
        """A diagonal star, kept if it has neither weights nor a material. `instead`: what to do who asks for "whitney"."""
        if not isinstance(kind, str) or kind not in STAR_KINDS[:-1]:
            reason = f", whose inverse is not sparse: {instead}" if isinstance(kind, str) and kind == "whitney" else ""
            raise InputError(
                f"the kind of star is {shown(kind)}{reason}; expected a diagonal one of {', '.join(STAR_KINDS[:-1])}"
            )
        if weights is not None and kind != "power":
            raise InputError(f"weights are given for the {kind} star; only kind='power' has weights")
        if weights is not None:
            weights = float_array(weights, "weights")
            if weights.shape != (self._sizes[0],):
                raise InputError(f"weights have shape {weights.shape}; expected ({self._sizes[0]},), one for every vertex")
        plain = weights is None and material is None
        if plain and ("star", kind) in self._kept:
            kept: _derham.Star = self._kept["star", kind]
            return kept
        star = _derham.Star(self._core, kind, weights, self._material(material))
        if plain:
            self._kept["star", kind] = star
        return star

    def _material(self, material: Material | None) -> tuple[Floats, Integers | None] | None:
        """Numbers (rows,) or tensors (rows, m, m), and the row of every top simplex or None."""
        if material is None:
            return None
        rows: Integers | None = None
        numbers: Any = material
        if isinstance(material, tuple):
            if len(material) != 2:
                raise InputError(
                    f"the material is a tuple of {len(material)}; expected a pair of numbers or tensors and the row of every "
                    "top simplex, or an array"
                )
            numbers, tags = material
            rows = index_list(tags, "the rows of the material")
            if rows.shape != (self._sizes[-1],):
                raise InputError(f"the rows of the material have shape {rows.shape}; expected ({self._sizes[-1]},)")
        values = float_array(numbers, "material")
        if values.ndim in (0, 2):
            values = values[np.newaxis]
        if values.ndim not in (1, 3) or (values.ndim == 3 and values.shape[1] != values.shape[2]):
            raise InputError(
                f"the material has shape {np.shape(numbers)}; expected a number, ({self._sizes[-1]},) numbers, a tensor "
                f"(m, m) or ({self._sizes[-1]}, m, m) tensors"
            )
        return values, rows
