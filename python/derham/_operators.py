"""The rooms forms and operators: wedge, δ and Δ, integration and interpolation, sharps and flats."""

from __future__ import annotations

from collections.abc import Sequence
from math import comb
from typing import Any, Literal, NamedTuple

import numpy as np
import numpy.typing as npt
import scipy.sparse as sparse

from . import _derham
from ._arguments import Floats, Integers, flag, float_array, index_dtype, one_of, shown, whole_number
from ._base import Side, compressed
from ._contraction import MAX_ORDER, Contraction, Field
from ._metric import DiagonalStarKind, Material, with_inverse
from .errors import InputError
from .spaces import FormSpace


class Located(NamedTuple):
    """Where points are: the top simplex, or -1; barycentric coordinates there; the distance from that place, NaN for -1."""

    simplex: Integers | Any
    barycentric: Floats
    distance: Floats | Any


class MixedLaplacian(NamedTuple):
    """`matrix` x = λ `mass` x for x = (σ, u); the first `sigma` unknowns are those of σ."""

    sigma: int
    matrix: sparse.csr_array
    mass: sparse.csr_array


class Operators(Contraction):
    """Operators on forms, most of which need a metric."""

    def wedge(
        self, a: npt.ArrayLike, p: int, b: npt.ArrayLike, q: int, *, sides: Side | tuple[Side, Side] = "primal"
    ) -> Floats:
        """a ∧ b of a p-form and a q-form. Needs no metric.

        sides    those of a and b, or of both. Primal forms: the cup product, made antisymmetric. With dual forms there is
                 f ∧ b of a function and a form of any sides, by means of f about every simplex, on the side of the form (of
                 the second if both are functions); and a ∧ b of dual 1-forms for n = 2. The integral of a primal k-form
                 ∧ a dual (n-k)-form is `a @ b`
        Shape    those of forms of these degrees and sides; the result too
        Laws     of primal forms d(a ∧ b) = da ∧ b + (-1)^p a ∧ db; of all b ∧ a = (-1)^(pq) a ∧ b. Associative on closed
                 forms only
        Invalid  Leibniz' rule of functions and forms of different sides, but for constants; products with dual forms
                 are not exact on constant forms; dual 2-forms of boundary vertices are 0
        Raises   InputError where there is no such product, or on a wrong shape; TopologyError for dual forms unless K is
                 orientable and pure
        Source   Whitney, "On products in a complex", 1938; Wilson 2007, §5; Ptáčková & Velho 2021, §3.1 (polygons)

        >>> import derham
        >>> K = derham.Complex([(0, 1, 2)])
        >>> K.wedge([1.0, 2, 6], 0, [1.0], 0, sides=("primal", "dual"))
        array([3.])
        """
        if not isinstance(sides, str) and (not isinstance(sides, Sequence) or len(sides) != 2):
            raise InputError(f"sides is {shown(sides)}; expected 'primal', 'dual', or two of them")
        a_side, b_side = (sides, sides) if isinstance(sides, str) else sides
        a_dual, b_dual = self._side(a_side), self._side(b_side)
        p = self._degree(p, name="p")
        q = self._degree(q, 0, self.dimension - p, name="q")
        x, y = self._one_form(a, p, a_side, "a"), self._one_form(b, q, b_side, "b")
        if not (a_dual or b_dual):
            result = np.empty(self._sizes[p + q])
            self._core.apply_wedge(p, x, q, y, result)
            return result
        if p == 0:
            return self._core.function_wedge(a_dual, x, b_dual, q, y)
        if q == 0:
            return self._core.function_wedge(b_dual, y, a_dual, p, x)
        if self.dimension == 2 and a_dual and b_dual:
            return self._core.polygon_wedge(x, y)
        raise InputError(
            f"there is no product of a {a_side} {p}-form and a {b_side} {q}-form in dimension {self.dimension}; there are "
            "those of primal forms, of functions with all forms, and of dual 1-forms in dimension 2"
        )

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
        sigma = self.size(k - 1)
        shape = (sigma + self._sizes[k],) * 2
        matrix, mass = (
            compressed(sparse.csr_array, arrays, shape)
            for arrays in self._core.mixed_laplacian(k, self._material(material))
        )
        if space is None:
            return MixedLaplacian(sigma, matrix, mass)
        if not isinstance(space, FormSpace):
            raise InputError(f"space is {shown(space)}; expected a form space of this complex")
        if space.complex is not self:
            raise InputError("the form space is of another complex")
        free_sigma = space.free(k - 1) if k else space.free(0)[:0]
        free = np.concatenate([free_sigma, sigma + space.free(k)])
        return MixedLaplacian(len(free_sigma), matrix[free][:, free], mass[free][:, free])

    def _count(self, k: int, dual: bool) -> int:
        return self._sizes[self.dimension - k if dual else k]

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
