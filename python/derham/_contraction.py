"""Interior products, Lie derivatives, and how far a step of transport may go."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Literal, TypeAlias

import numpy as np
import numpy.typing as npt

from ._arguments import Floats, float_array, one_of, shown, whole_number
from ._base import Side
from ._hodge import DiagonalStarKind, Hodge, with_inverse
from ._topology import Topology
from .errors import GeometryError, InputError

#: A function of points (count, m) at once, or its value where it is constant.
Field: TypeAlias = "Callable[[Floats], npt.ArrayLike] | npt.ArrayLike"

#: The highest order of a quadrature rule: a higher one takes longer to make than anybody waits.
MAX_ORDER = 200


class Contraction(Topology, Hodge):
    """What contracts forms with vector fields."""

    def interior(
        self,
        X: Field,
        w: npt.ArrayLike,
        k: int,
        *,
        kind: Literal["whitney", "algebraic"] = "whitney",
        side: Side = "primal",
        trace: Literal["mean", "upwind"] = "mean",
        order: int = 1,
        star: DiagonalStarKind = "circumcentric",
    ) -> Floats:
        """The interior product i_X w of a k-form.

        kind     "whitney": of primal forms with a smooth vector field, by quadrature of Whitney forms, exact up to `order`.
                 "algebraic": (-1)^(k(n-k)) ⋆(⋆w ∧ X♭) with a diagonal `star`, of dual forms, of primal n-forms, and of
                 primal 1-forms in the plane
        X        a vector (m,), or a function of points (count, m) with values of this shape, or (m,) where it is constant;
                 "algebraic": X♭, the values of a 1-form of the other side
        trace    of the values on both sides of a face "mean", or that of the side where X comes from, "upwind", which
                 stable explicit transport needs; of "whitney" only
        Shape    those of a k-form and a (k-1)-form
        Cost     "whitney": two passes, and one call of X with a point for every node and every top simplex around it
        Exact    for constant X and w; "algebraic" of primal forms on lattices only
        Raises   InputError unless 1 <= k <= n, on a wrong shape, or where there is no such product; GeometryError without
                 positions; "algebraic": as `star_inverse`
        Source   Bossavit 2003; Heumann & Hiptmair 2011 (upwind); Hirani 2003, chapter 8 (algebraic)
        """
        k = self._degree(k, 1)
        one_of(kind, ("whitney", "algebraic"), "the kind of contraction")
        if kind == "algebraic":
            dual = self._side(side)
            form = self._one_form(w, k, side)
            flat: Any = X
            X_flat = self._one_form(flat, 1, "primal" if dual else "dual", "X")
            contract = self._star(star, None, None, "take kind='whitney'").contract
            return with_inverse(contract, k, dual, X_flat, form)
        one_of(side, ("primal", "dual"), "the side")
        if side != "primal":
            raise InputError(f"the side is {shown(side)}; the contraction by Whitney forms is on the primal side only")
        form = self._one_form(w, k)
        one_of(trace, ("mean", "upwind"), "the trace")
        order = whole_number(order, "the order", 0, MAX_ORDER)
        return self._core.contract(k, form, self._vectors(X), trace == "upwind", order)

    def lie(
        self,
        X: Field,
        w: npt.ArrayLike,
        k: int,
        *,
        kind: Literal["whitney", "algebraic"] = "whitney",
        side: Side = "primal",
        trace: Literal["mean", "upwind"] = "mean",
        order: int = 1,
        star: DiagonalStarKind = "circumcentric",
    ) -> Floats:
        """The Lie derivative L_X w = d i_X w + i_X dw of a k-form; arguments as those of `interior`.

        Shape    that of w
        Laws     d L_X = L_X d; the integral of L_X w over a closed M is zero for n-forms
        Raises   as `interior`, but for 0 <= k <= n
        Source   Hirani 2003, §8.5; Mullen et al., "Discrete Lie advection of differential forms", 2011
        """
        k = self._degree(k)
        self._side(side)
        form = self._one_form(w, k, side)

        def contracted(v: Floats, degree: int) -> Floats:
            return self.interior(X, v, degree, kind=kind, side=side, trace=trace, order=order, star=star)

        result = np.zeros_like(form)
        if k > 0:
            result += self.apply_d(contracted(form, k), k - 1, side)
        if k < self.dimension:
            result += contracted(self.apply_d(form, k, side), k + 1)
        return result

    def cfl_bound(self, X: Field, *, order: int = 1) -> float:
        """The largest stable time step of w ← w - dt L_X w with upwind traces, Euler's method; infinite where X = 0.

        Below it no value of a density (k = n) becomes negative and functions keep the range of their neighbours; for the
        degrees between it is a guide.

        Shape    X as for `interior`
        Units    time: length over that of X
        Raises   as `interior`

        >>> import derham
        >>> round(derham.generate.box(1, 4).cfl_bound([2.0]), 12)
        0.125
        """
        return self._core.cfl_bound(self._vectors(X), whole_number(order, "the order", 0, MAX_ORDER))

    def _vectors(self, X: Field) -> Any:
        """A vector (m,), or a function of points (count, m) with values of the same shape."""
        if self.metric_source == "edge_lengths_squared":
            raise GeometryError("a vector field in space needs positions, but the metric is one of edge lengths")
        m = self.ambient_dimension
        if not callable(X):
            vector = float_array(X, "X")
            if vector.shape != (m,):
                raise InputError(f"X has shape {vector.shape}; expected a vector ({m},) or a function of points")
            return vector
        function = X

        def at(points: Floats) -> Floats:
            values = float_array(function(points), "the values of X")
            if m == 1 and values.shape == points.shape[:1]:
                return values.reshape(points.shape)
            if values.shape not in (points.shape, (m,)):
                raise InputError(
                    f"X has values of shape {values.shape} at {len(points)} points; expected {points.shape}, or ({m},) if "
                    "constant"
                )
            return np.ascontiguousarray(np.broadcast_to(values, points.shape))

        return at
