"""The rooms forms and operators: wedge, δ and Δ, integration and interpolation, sharps and flats, contraction."""

from __future__ import annotations

from collections.abc import Callable
from math import comb
from typing import Any, Literal, NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt
import scipy.sparse as sparse

from . import _derham
from ._arguments import Floats, Integers, flag, float_array, one_of, shown, whole_number
from ._base import Side
from ._metric import Material, Metric, StarKind
from ._topology import Topology
from .errors import GeometryError, InputError
from .spaces import FormSpace

#: A function of points (count, m) at once, or its value where it is constant.
Field: TypeAlias = "Callable[[Floats], npt.ArrayLike] | npt.ArrayLike"

#: The highest order of a quadrature rule: a higher one takes longer to make than anybody waits.
MAX_ORDER = 200


class MixedLaplacian(NamedTuple):
    """`matrix` x = λ `mass` x for x = (σ, u); the first `sigma` unknowns are those of σ."""

    sigma: int
    matrix: sparse.csr_array
    mass: sparse.csr_array


class Operators(Topology, Metric):
    """Operators on forms, most of which need a metric."""

    def wedge(self, a: npt.ArrayLike, p: int, b: npt.ArrayLike, q: int) -> Floats:
        """a ∧ b of a primal p-form and a primal q-form: the cup product, made antisymmetric. Needs no metric.

        Shape    a (|K_p|,), b (|K_q|,); the result (|K_{p+q}|,)
        Laws     d(a ∧ b) = da ∧ b + (-1)^p a ∧ db; b ∧ a = (-1)^(pq) a ∧ b. Associative on closed forms only
        Raises   InputError unless p, q >= 0 and p+q <= n, or on a wrong shape
        Source   Whitney, "On products in a complex", 1938; Wilson 2007, §5
        """
        p = self._degree(p, name="p")
        q = self._degree(q, 0, self.dimension - p, name="q")
        result = np.empty(self._sizes[p + q])
        self._core.apply_wedge(p, self._one_form(a, p, name="a"), q, self._one_form(b, q, name="b"), result)
        return result

    def codifferential(
        self,
        k: int,
        kind: StarKind = "circumcentric",
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
        arrays = self._star(kind, weights, material).codifferential(k, dual)
        shape = (self._count(k - 1, dual), self._count(k, dual))
        return sparse.csr_array(arrays, shape=shape, copy=False)

    def laplacian(
        self,
        k: int,
        kind: StarKind = "circumcentric",
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
        Raises   InputError unless 0 <= k <= n; otherwise as `star_inverse`
        Source   Elcott & Schröder, "Building your own DEC at home", §7

        >>> import derham
        >>> K = derham.generate.a_star_lattice(2, 6)
        >>> bool(abs(K.laplacian(0).sum(axis=1)).max() < 1e-12)
        True
        """
        k = self._degree(k)
        dual = self._side(side)
        arrays = self._star(kind, weights, material).laplacian(k, dual)
        return sparse.csr_array(arrays, shape=(self._count(k, dual),) * 2, copy=False)

    def weak_laplacian(
        self,
        k: int,
        kind: StarKind = "circumcentric",
        *,
        weights: npt.ArrayLike | None = None,
        material: Material | None = None,
    ) -> sparse.csr_array:
        """⋆_k Δ of primal k-forms with a diagonal star: an eigenproblem is solved with it against `star(k)`.

        Shape    |K_k| × |K_k|, units length^(n-2k-2)
        Matrix   symmetric; positive semi-definite with a kernel of dimension β_k where the stars are positive
        Raises   as `star_inverse(k - 1)`
        """
        k = self._degree(k)
        arrays = self._star(kind, weights, material).weak_laplacian(k)
        return sparse.csr_array(arrays, shape=(self._sizes[k],) * 2, copy=False)

    def mixed_laplacian(
        self, k: int, *, material: Material | None = None, space: FormSpace | None = None
    ) -> MixedLaplacian:
        """Laplace–de Rham of k-forms u with Whitney masses and σ = δu as an unknown of its own: valid on every mesh.

        space    where u and σ are prescribed to be 0; rows and columns are then those of free simplices
        Raises   InputError unless 0 <= k <= n; GeometryError naming flat top simplices
        Source   Arnold, Falk, Winther, "Finite element exterior calculus", 2006, §7
        """
        k = self._degree(k)
        sigma = self.size(k - 1)
        shape = (sigma + self._sizes[k],) * 2
        matrix, mass = (
            sparse.csr_array(arrays, shape=shape, copy=False)
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

        f        a function of points (count, m): its values (count,) for k = 0 and for densities (k = m), its components
                 (count, C(m, k)) otherwise, those of dx^i ∧ … ∧ dx^j with i < … < j in lexicographic order, for k = 1 so
                 a vector field; or these numbers themselves where they are constant
        flux     f is a vector field (count, m), taken as the (n-1)-form of its flux; k = n-1 and m = n
        Shape    (|K_k|,)
        Cost     one call of f with (order//2 + 1)^k points for every k-simplex
        Raises   InputError for a wrong degree, order, or number of components; GeometryError without positions
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
        values = _values(f, nodes.reshape(-1, m), m if flux else width)
        if flux:  # i_X of the volume form: without dx^j the component (-1)^j X_j
            values = (values * (-1.0) ** np.arange(m))[:, ::-1]
        return self._core.integrate(k, order, np.ascontiguousarray(values))

    def locate(self, points: npt.ArrayLike) -> tuple[Integers, Floats]:
        """The top simplices that points are in, and their barycentric coordinates there; -1 outside.

        On surfaces in space and other complexes of lower dimension than space, those of the nearest points.

        Shape    points (count, m); (count,) and (count, n+1)
        Raises   InputError on a wrong shape; GeometryError without positions
        """
        locator: _derham.Locator | None = self._kept.get("locator")
        if locator is None:
            locator = self._kept["locator"] = _derham.Locator(self._core)
        x = float_array(points, "points")
        if x.ndim != 2 or x.shape[1] != self.ambient_dimension:
            raise InputError(f"points have shape {x.shape}; expected (count, {self.ambient_dimension})")
        if self.ambient_dimension == self.dimension:
            return locator.locate(x)
        simplex, barycentric, _ = locator.nearest(x)
        return simplex, barycentric

    def interpolate(self, w: npt.ArrayLike, k: int, points: npt.ArrayLike | None = None) -> Floats:
        """The Whitney map: the components at points of the piecewise linear k-form with these integrals.

        points   (count, m), see `locate`; by default the barycentres of the top simplices
        Shape    (count,) for one component, else (count, C(m, k)) as `integrate` takes them; NaN outside
        Units    those of the integrals over length^k
        Raises   InputError on a wrong shape; GeometryError naming flat top simplices
        Source   Whitney 1957, §IV.27
        """
        k = self._degree(k)
        form = self._one_form(w, k, name="w")
        if points is None:
            count = self._sizes[-1]
            simplex: Integers = np.arange(count, dtype=self.simplices(0).dtype)
            barycentric = np.full((count, self.dimension + 1), 1 / (self.dimension + 1))
        else:
            simplex, barycentric = self.locate(points)
        values = self._core.interpolate(k, form, simplex, barycentric)
        return values[:, 0] if values.shape[1] == 1 else values

    def sharp(self, w: npt.ArrayLike, kind: Literal["whitney", "pd", "pp"] = "whitney") -> Floats:
        """The vectors of a primal 1-form.

        kind     "whitney": at the barycentre of every top simplex; "pd": at its circumcentre; "pp": at every vertex
        Shape    (|K_n|, m), for "pp" (|V|, m)
        Exact    for constant forms
        Source   Hirani 2003, §5.8 (pp)
        """
        one_of(kind, ("whitney", "pd", "pp"), "the kind of sharp")
        return self._core.sharp(kind, self._one_form(w, self._degree(1)))

    def flat(self, X: npt.ArrayLike, kind: Literal["ppp", "dpp", "dpd"] = "ppp") -> Floats:
        """The 1-form of vectors.

        kind     "ppp": of vectors (|V|, m) at the vertices; "dpp": of vectors (|K_n|, m) in the top simplices; both make
                 primal forms (|E|,). "dpd": of the latter, a dual form (|K_{n-1}|,)
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

    def interior(
        self, X: Field, w: npt.ArrayLike, k: int, *, trace: Literal["mean", "upwind"] = "mean", order: int = 1
    ) -> Floats:
        """The interior product i_X w of a primal k-form with a smooth vector field, by quadrature of Whitney forms.

        X        a vector (m,), or a function of points (count, m); it is called for one point at a time
        trace    of the values on both sides of a face "mean", or that of the side where X comes from, "upwind", which
                 stable explicit transport needs
        Shape    w (|K_k|,); the result (|K_{k-1}|,)
        Exact    for constant X and w
        Raises   InputError unless 1 <= k <= n, or on a wrong shape; GeometryError without positions
        Source   Bossavit 2003; Heumann & Hiptmair 2011 (upwind)
        """
        k = self._degree(k, 1)
        form = self._one_form(w, k)
        one_of(trace, ("mean", "upwind"), "the trace")
        order = whole_number(order, "the order", 0, MAX_ORDER)
        if self.metric_source == "edge_lengths_squared":
            raise GeometryError("a vector field in space needs positions, but the metric is one of edge lengths")
        m, upwind = self.ambient_dimension, trace == "upwind"
        if callable(X):
            function = X

            def at(point: Any) -> Floats:
                return np.ascontiguousarray(_values(function, point, m))

            return self._core.contract(k, form, at, upwind, order)
        vector = float_array(X, "X")
        if vector.shape != (m,):
            raise InputError(f"X has shape {vector.shape}; expected a vector ({m},) or a function of points")
        return self._core.contract(k, form, vector, upwind, order)

    def lie(
        self, X: Field, w: npt.ArrayLike, k: int, *, trace: Literal["mean", "upwind"] = "mean", order: int = 1
    ) -> Floats:
        """The Lie derivative L_X w = d i_X w + i_X dw of a primal k-form; arguments as those of `interior`.

        Laws     d L_X = L_X d; the integral of L_X w over a closed M is zero for n-forms
        """
        k = self._degree(k)
        form = self._one_form(w, k)
        result = np.zeros(self._sizes[k])
        if k > 0:
            result += self.apply_d(self.interior(X, form, k, trace=trace, order=order), k - 1)
        if k < self.dimension:
            result += self.interior(X, self.apply_d(form, k), k + 1, trace=trace, order=order)
        return result


def _values(f: Field, points: Floats, width: int) -> Floats:
    """The values of a field at points, shape (count, width)."""
    values: Any = float_array(f(points) if callable(f) else f, "the values of the field")
    count = len(points)
    expected = (count, width)
    if not callable(f):
        values = np.broadcast_to(values, expected) if values.shape in ((), (width,)) else values
    elif width == 1 and values.shape == (count,):
        values = values[:, np.newaxis]
    if values.shape != expected:
        raise InputError(
            f"the field has values of shape {values.shape} at {count} points; expected "
            + (f"({count},)" if width == 1 else f"{expected}")
        )
    return np.asarray(values, np.float64)
