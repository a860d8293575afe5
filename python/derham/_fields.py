"""Between smooth and discrete forms: integration, interpolation, sharps and flats."""

from __future__ import annotations

from math import comb
from typing import Any, Literal, NamedTuple

import numpy as np
import numpy.typing as npt

from . import _derham
from ._arguments import Floats, Integers, flag, float_array, index_dtype, one_of, whole_number
from ._contraction import MAX_ORDER, Field
from ._geometry import Geometry
from .errors import InputError


class Located(NamedTuple):
    """Where points are: the top simplex, or -1; barycentric coordinates there; the distance from that place, NaN for -1."""

    simplex: Integers | Any
    barycentric: Floats
    distance: Floats | Any


class Fields(Geometry):
    """What smooth and discrete forms have to do with one another."""

    def integrate(self, f: Field, k: int, *, order: int = 3, flux: bool = False) -> Floats:
        """The de Rham map: the integrals of a smooth k-form over the k-simplices, by a rule exact up to `order`.

        f        a function of points (count, m): its values (count,) for k = 0 and for densities (k = n, times the volume
                 form of K's own orientation where n < m), its components (count, C(m, k)) otherwise, those of
                 dx^i ∧ … ∧ dx^j with i < … < j in lexicographic order, for k = 1 so a vector field; where they are
                 constant it may return one number, or C(m, k); or these numbers themselves
        flux     f is a vector field (count, m), taken as the (n-1)-form of its flux; k = n-1 and m = n
        Shape    (|K_k|,)
        Cost     one call of f with (order//2 + 1)^k points for every k-simplex
        Raises   InputError for a wrong degree, order, or number of components; GeometryError without positions; TopologyError
                 for a density if K is not orientable and n < m
        Source   Whitney, "Geometric integration theory", 1957, §IV.27

        >>> import derham
        >>> K = derham.generate.box(2, 4)
        >>> float(round(K.integrate(lambda x: x[:, 0] * x[:, 1], 2).sum(), 12))
        0.25
        """
        k = self._degree(k)
        order, flux = whole_number(order, "the order", 0, MAX_ORDER), flag(flux, "flux")
        nodes = self._core.nodes(k, order)
        m, width = nodes.shape[2], comb(nodes.shape[2], k)
        if flux and (k != self.dimension - 1 or m != self.dimension):
            raise InputError(
                f"the flux of a vector field is a form of degree n-1 where n = m; k is {k}, n {self.dimension}, m {m}"
            )
        points = nodes.reshape(-1, m)
        given = f(points) if callable(f) else f
        if 0 < k == self.dimension < m and np.shape(given) in ((), (len(points),) if callable(f) else ()):
            density = np.broadcast_to(float_array(given, "the values of the density"), len(points))
            return self._core.integrate_density(order, np.ascontiguousarray(density))
        values = _values(given, len(points), m if flux else width)
        if flux:  # i_X of the volume form: without dx^j the component (-1)^j X_j
            values = (values * (-1.0) ** np.arange(m))[:, ::-1]
        return self._core.integrate(k, order, np.ascontiguousarray(values))

    def locate(self, points: npt.ArrayLike, *, nearest: bool = False) -> Located:
        """The top simplices that points are in, their barycentric coordinates there, and their distance from there.

        nearest  points outside are taken for the nearest ones of the complex; else they are in simplex -1, at distance NaN.
                 On surfaces in space and other complexes of lower dimension than space that is always so
        Shape    points (count, m): (count,), (count, n+1) and (count,). One point (m,): a number, (n+1,) and a number
        Units    of the distance: length
        Cost     N log N for N top simplices when it is first asked, kept; then about log N a point
        Raises   InputError on a wrong shape, or for n = 0; GeometryError without positions

        >>> import derham
        >>> simplex, barycentric, distance = derham.generate.box(1, 2).locate([3.0], nearest=True)
        >>> simplex, barycentric.tolist(), distance
        (1, [0.0, 1.0], 2.0)
        """
        locator: _derham.Locator | None = self._kept.get("locator")
        if locator is None:
            locator = self._kept["locator"] = _derham.Locator(self._core)
        m = self.ambient_dimension
        x = float_array(points, "points")
        if x.ndim not in (1, 2) or x.shape[-1] != m:
            raise InputError(f"points have shape {x.shape}; expected (count, {m}), or ({m},) for one")
        simplex, barycentric, distance = locator.locate(x.reshape(-1, m), flag(nearest, "nearest") or m > self.dimension)
        if x.ndim == 1:
            return Located(int(simplex[0]), barycentric[0], float(distance[0]))
        return Located(simplex, barycentric, distance)

    def interpolate(self, w: npt.ArrayLike, k: int, points: npt.ArrayLike | None = None) -> Floats | Any:
        """The Whitney map: the components at points of the piecewise linear k-form with these integrals.

        points   (count, m), or (m,) for one, see `locate`; by default the barycentres of the top simplices
        Shape    (count,) for one component, else (count, C(m, k)) as `integrate` takes them; for one point a number, or
                 (C(m, k),); NaN outside
        Units    those of the integrals over length^k
        Raises   InputError on a wrong shape; GeometryError without a metric, or naming flat top simplices
        Source   Whitney 1957, §IV.27

        >>> import derham
        >>> K = derham.generate.box(2, 3)
        >>> float(round(K.interpolate(K.points[:, 0], 0, [0.3, 0.7]), 12))
        0.3
        """
        k = self._degree(k)
        form = self._one_form(w, k, name="w")
        if points is None:
            count = self._sizes[-1]
            simplex: Integers = np.arange(count, dtype=index_dtype)
            barycentric = np.full((count, self.dimension + 1), 1 / (self.dimension + 1))
        else:
            simplex, barycentric, _ = self.locate(points)
        one = np.ndim(simplex) == 0
        values: Any = self._core.interpolate(k, form, np.atleast_1d(np.asarray(simplex, index_dtype)), barycentric)
        values = values[:, 0] if values.shape[1] == 1 else values
        return values[0] if one else values

    def sharp(self, w: npt.ArrayLike, kind: Literal["whitney", "pd", "pp"] = "whitney") -> Floats:
        """The vectors of a primal 1-form.

        kind     "whitney": at the barycentre of every top simplex; "pd": at its circumcentre; "pp": at every vertex
        Shape    (|K_n|, m), for "pp" (|V|, m)
        Units    those of w over length
        Exact    for constant forms
        Raises   InputError on a wrong kind or shape, or for n = 0; GeometryError without a metric, or naming flat top simplices
        Source   Hirani 2003, §5.8 (pp)
        """
        one_of(kind, ("whitney", "pd", "pp"), "the kind of sharp")
        return self._core.sharp(kind, self._one_form(w, self._degree(1)))

    def flat(self, X: npt.ArrayLike, kind: Literal["ppp", "dpp", "dpd"] = "ppp") -> Floats:
        """The 1-form of vectors.

        kind     "ppp": of vectors at the vertices; "dpp": of vectors in the top simplices; both make primal forms. "dpd": of
                 the latter, a dual form
        Shape    X (|V|, m) for "ppp", else (|K_n|, m); the result (|E|,), for "dpd" (|K_{n-1}|,)
        Units    those of X times length
        Raises   InputError on a wrong kind or shape, or for n = 0; GeometryError without a metric, or naming flat top simplices;
                 TopologyError for "dpd" if K is not orientable
        Exact    for constant fields, "ppp" for linear ones
        Source   Hirani 2003, §5.4 to §5.6
        """
        one_of(kind, ("ppp", "dpp", "dpd"), "the kind of flat")
        vectors = float_array(X, "X")
        m = self.ambient_dimension or self.dimension
        expected = (self._sizes[0] if kind == "ppp" else self._sizes[-1], m)
        if vectors.shape != expected:
            raise InputError(f"X has shape {vectors.shape}; the flat {kind} expects {expected}")
        return self._core.flat(kind, vectors)


def _values(given: npt.ArrayLike, count: int, width: int) -> Floats:
    """The values of a field at points, shape (count, width), from what it returned there or is."""
    values = float_array(given, "the values of the field")
    if width == 1 and values.shape == (count,):
        return values[:, np.newaxis]
    if np.ndim(given) == 0 or values.shape in ((width,), (count, width)):
        return np.broadcast_to(values, (count, width))
    expected = f"({count},)" if width == 1 else f"({count}, {width})"
    raise InputError(
        f"the field has values of shape {values.shape} at {count} points; expected {expected}, or ({width},) if constant"
    )
