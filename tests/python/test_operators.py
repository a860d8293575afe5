"""Operators on forms against what they must be."""

from __future__ import annotations

from itertools import combinations
from math import pi

import numpy as np
import pytest
import scipy.sparse as sparse
from conftest import random_rows

import derham


def test_codifferential_and_laplacian_are_composed_of_star_and_d() -> None:
    for K in (derham.generate.a_star_lattice(2, 4), derham.generate.bcc_lattice(3), derham.generate.a_star_lattice(4, 3)):
        n = K.dimension
        for k in range(n + 1):
            down = up = sparse.csr_array((K.size(k), K.size(k)))
            if k:
                delta = K.star_inverse(k - 1) @ K.d(k - 1).T @ K.star(k)
                assert abs(K.codifferential(k) - delta).max() < 1e-12 * abs(delta).max()
                down = K.d(k - 1) @ delta
            if k < n:
                up = K.star_inverse(k) @ K.d(k).T @ K.star(k + 1) @ K.d(k)
            laplacian = K.laplacian(k)
            assert abs(laplacian - (down + up)).max() < 1e-12 * abs(laplacian).max()
            weak = (K.star(k) @ laplacian).toarray()
            np.testing.assert_allclose(weak, weak.T, atol=1e-10)


def test_kernels_count_betti_numbers() -> None:
    K = derham.generate.a_star_lattice(3, 3)
    for k, betti in enumerate((1, 3, 3, 1)):
        eigenvalues = np.linalg.eigvalsh((K.star(k) @ K.laplacian(k)).toarray())
        assert eigenvalues[0] > -1e-9 and np.sum(eigenvalues < 1e-9) == betti
        dual = K.laplacian(3 - k, side="dual")
        assert dual.shape == K.laplacian(k).shape
        np.testing.assert_allclose(
            (dual @ K.star(k)).toarray(), (K.star(k) @ K.laplacian(k)).toarray(), atol=1e-9
        )


def test_weak_and_mixed_laplacians() -> None:
    K = derham.generate.a_star_lattice(3, 3)
    for k in range(4):
        difference = K.weak_laplacian(k) - K.star(k) @ K.laplacian(k)
        assert abs(difference).max() < 1e-9
    for K in (derham.generate.annulus(), derham.generate.periodic_box(2, 3, jitter=0.2)):
        if K.metric_source is None:
            K = derham.Complex(K.simplices(2), edge_lengths_squared=np.ones(K.size(1)))
        betti_1 = 2 if K.euler_characteristic == 0 and K.boundary_simplices() == {} else 1
        mixed = K.mixed_laplacian(1)
        eigenvalues = np.linalg.eigvalsh(mixed.matrix.toarray())
        assert mixed.sigma == K.size(0) == np.sum(eigenvalues < -1e-9)
        assert np.sum(abs(eigenvalues) < 1e-9) == betti_1
    square = derham.generate.box(2, 3)
    relative = square.mixed_laplacian(2, space=square.form_space())
    assert relative.sigma == len(square.form_space().free(1))
    assert np.sum(abs(np.linalg.eigvalsh(relative.matrix.toarray())) < 1e-9) == 1  # H²(square, boundary)
    with pytest.raises(derham.InputError, match="another complex"):
        square.mixed_laplacian(1, space=K.form_space())


def test_hot_weights() -> None:
    K = derham.generate.box(2, 4)
    hot = K.hot_weights()
    assert hot and len(hot.not_positive_before[1]) > 0 and not hot.advice
    assert (K.star(1, "power", weights=hot.weights).diagonal() > 0).all()
    assert "not positive" in repr(hot)


def test_integrals_of_polynomials_commute_with_d() -> None:
    K = derham.generate.box(3, 2, jitter=0.2)

    def grad(x: np.ndarray) -> np.ndarray:
        return np.stack([2 * x[:, 0] * x[:, 1], x[:, 0] ** 2 + 2 * x[:, 1], 3 * x[:, 2] ** 2], axis=1)

    def f(x: np.ndarray) -> np.ndarray:
        return x[:, 0] ** 2 * x[:, 1] + x[:, 1] ** 2 + x[:, 2] ** 3

    np.testing.assert_allclose(K.apply_d(K.integrate(f, 0), 0), K.integrate(grad, 1), atol=1e-14)
    flux = K.integrate(grad, 2, flux=True)
    np.testing.assert_allclose(
        K.apply_d(flux, 2), K.integrate(lambda x: 2 * x[:, 1] + 2 + 6 * x[:, 2], 3), atol=1e-14
    )
    assert K.integrate(1.0, 3).sum() == pytest.approx(1)
    np.testing.assert_allclose(K.integrate([1, 0, 0], 1), K.apply_d(K.points[:, 0], 0), atol=1e-15)


def test_interpolation_inverts_integration_of_constants(K: derham.Complex) -> None:
    n, m = K.dimension, K.ambient_dimension
    if n != m or K.metric_source != "points":
        return
    random = np.random.default_rng(1)
    inside = K.corners().mean(axis=1)
    for k in range(n + 1):
        components = random.standard_normal(len(list(combinations(range(m), k))))
        w = K.integrate(components, k)
        expected = np.broadcast_to(components, (len(inside), len(components))).squeeze()
        np.testing.assert_allclose(K.interpolate(w, k), expected, atol=1e-12)
        np.testing.assert_allclose(K.interpolate(w, k, inside), expected, atol=1e-12)


def test_locate() -> None:
    K = derham.generate.box(2, 3)
    simplex, barycentric, distance = K.locate([[0.1, 0.2], [2, 2]])
    assert distance[0] == 0 and np.isnan(distance[1])
    assert simplex[1] == -1 and np.isnan(K.interpolate(np.ones(K.size(0)), 0, [[2, 2]])).all()
    corners = K.points[K.simplices(2)[simplex[0]]]
    np.testing.assert_allclose(barycentric[0] @ corners, [0.1, 0.2], atol=1e-15)
    S = derham.generate.icosphere(2)
    w = S.points[:, 2]
    assert S.interpolate(w, 0, [[0, 0, 2.0]])[0] == pytest.approx(1, abs=0.05)


def test_distances_of_located_points() -> None:
    S, square = derham.generate.icosphere(3), derham.generate.box(2, 3)
    assert S.locate([[0, 0, 3.0], [0, 0, 1]]).distance == pytest.approx([2, 0], abs=0.02)
    found = square.locate([[2.0, 0.5], [1, 3], [0.5, 0.5]], nearest=True)
    np.testing.assert_allclose(found.distance, [1, 2, 0], atol=1e-15)
    corners = square.points[square.simplices(2)[found.simplex]]
    np.testing.assert_allclose(np.einsum("ij,ijk->ik", found.barycentric, corners), [[1, 0.5], [1, 1], [0.5, 0.5]], atol=1e-15)


def test_one_point(K: derham.Complex) -> None:
    if K.points is None:
        return
    point, w = K.corners().mean(axis=1)[0], np.random.default_rng(8).standard_normal(K.size(1))
    simplex, barycentric, distance = K.locate(point)
    many = K.locate(point[np.newaxis])
    assert (simplex, distance) == (many.simplex[0], many.distance[0]) and isinstance(simplex, int)
    assert barycentric.tolist() == many.barycentric[0].tolist()
    for k, form in ((0, K.points[:, 0]), (1, w)):
        assert np.array_equal(K.interpolate(form, k, point), K.interpolate(form, k, [point])[0])


def test_functions_whose_values_are_constant(K: derham.Complex) -> None:
    m = K.ambient_dimension
    X = np.arange(1.0, m + 1)
    assert (K.integrate(lambda x: 2.0, 0) == 2).all()
    assert np.array_equal(K.integrate(lambda x: X, 1), K.integrate(X, 1))
    assert np.array_equal(K.integrate(lambda x: 3, K.dimension), K.integrate(3, K.dimension))
    w = K.integrate(X[::-1], 1)
    constant = K.interior(X, w, 1)
    np.testing.assert_allclose(K.interior(lambda x: X, w, 1), constant, atol=1e-12)
    np.testing.assert_allclose(K.interior(lambda x: np.tile(X, (len(x), 1)), w, 1), constant, atol=1e-12)


def test_wedge() -> None:
    K = derham.Complex(random_rows(3, 8, 12, seed=3))
    random = np.random.default_rng(2)
    for p in range(3):
        for q in range(3 - p):
            a, b = random.standard_normal(K.size(p)), random.standard_normal(K.size(q))
            ab = K.wedge(a, p, b, q)
            np.testing.assert_allclose(K.wedge(b, q, a, p), (-1) ** (p * q) * ab, atol=1e-14)
            leibniz = K.wedge(K.apply_d(a, p), p + 1, b, q) + (-1) ** p * K.wedge(a, p, K.apply_d(b, q), q + 1)
            np.testing.assert_allclose(K.apply_d(ab, p + q), leibniz, atol=1e-13)


def test_wedges_of_functions_with_all_forms(K: derham.Complex) -> None:
    n = K.dimension
    random = np.random.default_rng(4)
    dual_function, function = random.standard_normal(K.size(n)), random.standard_normal(K.size(0))
    for k in range(n + 1):
        a = random.standard_normal(K.size(k))  # a primal k-form, or a dual (n-k)-form
        about = K.incidence(k, n)
        means = about @ dual_function / about.sum(axis=1)
        corners = function[K.simplices(k)].mean(axis=1)
        np.testing.assert_allclose(K.wedge(dual_function, 0, a, k, sides=("dual", "primal")), means * a, atol=1e-14)
        np.testing.assert_allclose(K.wedge(dual_function, 0, a, n - k, sides="dual"), means * a, atol=1e-14)
        np.testing.assert_allclose(K.wedge(function, 0, a, n - k, sides=("primal", "dual")), corners * a, atol=1e-14)
        if k < n:  # of two functions the second one's side counts
            swapped = K.wedge(a, n - k, function, 0, sides=("dual", "primal"))
            np.testing.assert_array_equal(swapped, K.wedge(function, 0, a, n - k, sides=("primal", "dual")))


def test_wedge_of_dual_one_forms() -> None:
    K = derham.generate.icosphere(1)
    random = np.random.default_rng(5)
    a, b, g = random.standard_normal(K.size(1)), random.standard_normal(K.size(1)), random.standard_normal(K.size(2))
    ab = K.wedge(a, 1, b, 1, sides="dual")
    assert ab.shape == (K.size(0),) and abs(ab).max() > 0.1
    np.testing.assert_allclose(K.wedge(b, 1, a, 1, sides="dual"), -ab, atol=1e-14)
    left = K.apply_d(K.wedge(g, 0, b, 1, sides="dual"), 1, "dual")
    right = K.wedge(K.apply_d(g, 0, "dual"), 1, b, 1, sides="dual") + K.wedge(g, 0, K.apply_d(b, 1, "dual"), 2, sides="dual")
    np.testing.assert_allclose(left, right, atol=1e-13)
    C = derham.generate.box(3, 1)
    with pytest.raises(derham.InputError, match="no product of a dual 1-form and a primal 1-form in dimension 3"):
        C.wedge(np.ones(C.size(2)), 1, np.ones(C.size(1)), 1, sides=("dual", "primal"))


def test_sharp_and_flat_of_constants() -> None:
    K = derham.generate.ball(3, 2)
    X = np.array([1.0, -2.0, 0.5])
    w = K.flat(np.broadcast_to(X, (K.size(0), 3)))
    np.testing.assert_allclose(w, K.integrate(X, 1), atol=1e-14)
    np.testing.assert_allclose(K.flat(np.broadcast_to(X, (K.size(3), 3)), "dpp"), w, atol=1e-12)
    for kind in ("whitney", "pd", "pp"):
        vectors = K.sharp(w, kind)  # type: ignore[arg-type]
        np.testing.assert_allclose(vectors, np.broadcast_to(X, vectors.shape), atol=1e-9)
    assert K.flat(np.zeros((K.size(3), 3)), "dpd").shape == (K.size(2),)


def test_interior_product_and_lie_derivative() -> None:
    K = derham.generate.box(2, 3, jitter=0.2)
    X, w = np.array([0.5, 2.0]), K.integrate([3.0, -1.0], 1)
    np.testing.assert_allclose(K.interior(X, w, 1), 0.5 * 3 - 2, atol=1e-13)
    np.testing.assert_allclose(K.lie(X, w, 1), 0, atol=1e-12)
    np.testing.assert_allclose(
        K.interior(lambda x: np.broadcast_to(X, x.shape), w, 1), K.interior(X, w, 1), atol=1e-15
    )
    u = np.sin(K.points[:, 0])
    turning = lambda x: np.stack([-x[:, 1], x[:, 0]], axis=1)  # noqa: E731
    np.testing.assert_allclose(  # d L_X = L_X d
        K.apply_d(K.lie(turning, u, 0), 0), K.lie(turning, K.apply_d(u, 0), 1), atol=1e-13
    )
    line = derham.generate.box(1, 3)  # a density of 1, 2, 3 in the intervals, carried to the right
    masses = np.array([1.0, 2.0, 3.0]) / 3
    np.testing.assert_allclose(line.interior([1.0], masses, 1, trace="upwind"), [0, 1, 2, 3], atol=1e-14)
    np.testing.assert_allclose(line.interior([1.0], masses, 1), [1, 1.5, 2.5, 3], atol=1e-14)
    T = derham.generate.periodic_box(2, 4, jitter=0.2)
    assert abs(T.lie(X, np.arange(T.size(2), dtype=float), 2, trace="upwind").sum()) < 1e-10

    def fails(x: np.ndarray) -> np.ndarray:
        raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        K.interior(fails, w, 1)


def at_each_point(X, calls):  # type: ignore[no-untyped-def]
    """The same field, asked for one point at a time."""

    def field(points: np.ndarray) -> np.ndarray:
        calls.append(len(points))
        return np.concatenate([X(point[np.newaxis]) for point in points]) if len(points) else X(points)

    return field


@pytest.mark.parametrize("trace", ["mean", "upwind"])
def test_fields_are_asked_for_all_points_at_once(K: derham.Complex, trace: str) -> None:
    """The numbers are those of the obvious way, i_X linear in the values of the field at the nodes, on any threads."""
    n, m = K.dimension, K.ambient_dimension
    random = np.random.default_rng(6)
    A, b = random.standard_normal((m, m)), random.standard_normal(m)
    X = lambda x: np.sin(x @ A.T) + b  # noqa: E731
    before = derham.thread_count()
    for k in range(1, n + 1):
        w, calls = random.standard_normal(K.size(k)), []
        results = []
        for threads in (1, 2, 4):
            derham.set_thread_count(threads)
            results.append(K.interior(X, w, k, trace=trace, order=2))  # type: ignore[arg-type]
        derham.set_thread_count(before)
        singly = K.interior(at_each_point(X, calls), w, k, trace=trace, order=2)  # type: ignore[arg-type]
        np.testing.assert_allclose(singly, results[0], rtol=1e-12, atol=1e-12)
        assert len(calls) == 1 and calls[0] >= K.size(k - 1)
        assert results[0].tobytes() == results[1].tobytes() == results[2].tobytes()
        constant = lambda x: np.broadcast_to(b, x.shape)  # noqa: E731
        np.testing.assert_array_equal(
            K.interior(constant, w, k, trace=trace), K.interior(b, w, k, trace=trace)  # type: ignore[arg-type]
        )


def test_contraction_of_functions_of_the_point() -> None:
    """i_X of dx^1 at the vertices is X itself; of a 2-form at the midpoints of edges; each in its place."""
    K = derham.generate.box(3, 2, jitter=0.3)
    X = lambda x: np.stack([x[:, 0] ** 2, x[:, 1], 1 + x[:, 2] * x[:, 0]], axis=1)  # noqa: E731
    for axis in range(3):
        w = K.integrate(np.eye(3)[axis], 1)
        np.testing.assert_allclose(K.interior(X, w, 1), X(K.points)[:, axis], atol=1e-13)
    w = K.integrate([1.0, 0, 0], 2)  # dx ∧ dy
    expected = K.integrate(lambda x: np.stack([-X(x)[:, 1], X(x)[:, 0], 0 * x[:, 0]], axis=1), 1, order=5)
    np.testing.assert_allclose(K.interior(X, w, 2, order=5), expected, atol=1e-13)


def test_cfl_bound() -> None:
    K = derham.generate.box(2, 4)
    bound = K.cfl_bound([1.0, 0])
    assert 0 < bound <= 0.25 and K.cfl_bound([0.0, 0]) == np.inf
    assert K.cfl_bound(lambda x: np.broadcast_to([2.0, 0], x.shape)) == pytest.approx(bound / 2)
    masses = np.random.default_rng(0).random(K.size(2))
    X = lambda x: np.stack([x[:, 1], -x[:, 0]], axis=1)  # noqa: E731
    step = lambda dt: masses - dt * K.lie(X, masses, 2, trace="upwind")  # noqa: E731
    assert (step(K.cfl_bound(X)) >= 0).all() and (step(50 * K.cfl_bound(X)) < 0).any()


def test_algebraic_contraction() -> None:
    """Through ⋆ and ∧: of dual forms exact for constants, on the primal side of densities; and Cartan's formula."""
    for K in (derham.generate.ball(2, 3), derham.generate.ball(3, 1)):
        n = K.dimension
        X = np.arange(1.0, n + 1)
        flat = K.integrate(X, 1)
        v = np.arange(n, 0, -1.0)
        flux = np.asarray(K.star(1) @ K.integrate(v, 1))  # ⋆v as a dual (n-1)-form
        dual = K.interior(flat, flux, n - 1, kind="algebraic", side="dual")
        by_hand = K.wedge((-1) ** (n - 1) * K.star_inverse(1).diagonal() * flux, 1, flat, 1)
        np.testing.assert_allclose(dual, (-1) ** (n - 1) * K.star(2).diagonal() * by_hand, atol=1e-12)
        lie = K.lie(flat, dual, n - 2, kind="algebraic", side="dual")
        d_lie = K.lie(flat, K.apply_d(dual, n - 2, "dual"), n - 1, kind="algebraic", side="dual")
        np.testing.assert_allclose(K.apply_d(lie, n - 2, "dual"), d_lie, atol=1e-9)
        dual_flat = np.asarray(K.star(n - 1) @ K.integrate(lambda x: np.broadcast_to(X, x.shape), n - 1, flux=True))
        density = K.integrate(1.0, n)
        inner = np.setdiff1d(np.arange(K.size(n - 1)), K.boundary_simplices()[n - 1])
        found = K.interior(dual_flat * (-1) ** (n - 1), density, n, kind="algebraic")
        expected = K.integrate(lambda x: np.broadcast_to(X, x.shape), n - 1, flux=True)
        np.testing.assert_allclose(found[inner], expected[inner], atol=1e-10)
    with pytest.raises(derham.InputError, match="no algebraic interior product of primal 1-forms in dimension 3"):
        K.interior(np.ones(K.size(2)), np.ones(K.size(1)), 1, kind="algebraic")
    with pytest.raises(derham.InputError, match="on the primal side only"):
        K.interior([1.0, 0, 0], np.ones(K.size(2)), 1, side="dual")


def test_densities_on_surfaces() -> None:
    S = derham.generate.icosphere(3)
    np.testing.assert_allclose(S.integrate(1.0, 2), S.volumes(2), rtol=1e-14)
    second = S.integrate(lambda x: x[:, 2] ** 2, 2).sum()
    assert second == pytest.approx(4 * pi / 3, rel=0.02)
    expected = S.volumes(2) * (S.corners() @ [1.0, 2.0, 3.0] + 4).mean(axis=1)  # linear: the value in the middle
    np.testing.assert_allclose(S.integrate(lambda x: x @ [1.0, 2.0, 3.0] + 4, 2, order=1), expected, rtol=1e-12)
    curve = derham.Complex([(0, 1), (1, 2)], points=[(0, 0), (3, 4), (3, 5)])
    np.testing.assert_allclose(curve.integrate(2.0, 1), [10, 2])
    np.testing.assert_allclose(curve.integrate([1.0, 0], 1), [3, 0])
    M = derham.Complex(derham.generate.moebius_strip().simplices(2), points=np.random.default_rng(1).random((5, 3)))
    with pytest.raises(derham.TopologyError, match="orientable"):
        M.integrate(1.0, 2)


def test_poisson_with_boundary_conditions() -> None:
    errors = []
    for cells in (8, 16, 32):
        K = derham.generate.box(2, cells, jitter=0.3)
        exact = np.prod(np.sin(pi * K.points), axis=1)
        E = K.form_space().extension(0)
        A = K.d(0).T @ K.star(1, "whitney") @ K.d(0)
        load = K.star(0, "whitney") @ (2 * pi**2 * exact)
        u = E @ sparse.linalg.spsolve((E.T @ A @ E).tocsc(), E.T @ load)
        errors.append(np.sqrt((u - exact) @ K.star(0, "whitney") @ (u - exact)))
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert (orders > 1.8).all() and errors[-1] < 2e-3


def test_form_spaces() -> None:
    K = derham.generate.box(3, 2)
    relative, absolute = K.form_space(), K.form_space(None)
    assert len(relative.free(0)) == 1 and len(absolute.prescribed(2)) == 0
    assert relative.prescribed(2).tolist() == K.boundary_simplices()[2].tolist()
    d = relative.extension(1).T @ K.d(0) @ relative.extension(0)
    full = K.d(0) @ relative.extension(0)
    assert abs(relative.extension(1) @ d - full).max() == 0  # d keeps forms that vanish there
    some = K.form_space(K.boundary_simplices()[2][:1])
    assert len(some.prescribed(0)) == 3


def test_refinement_commutes_with_d() -> None:
    for K in (derham.generate.box(2, 2), derham.generate.bcc_lattice(3), derham.generate.icosphere(0)):
        R = K.refined()
        assert R.fine.size(K.dimension) == 2**K.dimension * K.size(K.dimension)
        assert R.fine.volumes(K.dimension).sum() == pytest.approx(K.volumes(K.dimension).sum())
        for k in range(K.dimension):
            assert abs(R.fine.d(k) @ R.prolongation(k) - R.prolongation(k + 1) @ K.d(k)).max() == 0
            assert abs(K.d(k) @ R.restriction(k) - R.restriction(k + 1) @ R.fine.d(k)).max() == 0
        one = R.restriction(1) @ R.prolongation(1)
        assert abs(one - sparse.eye_array(K.size(1))).max() == 0


def test_the_fine_complex_outlives_its_refinement() -> None:
    import gc

    fine = derham.generate.box(3, 3).refined().fine
    gc.collect()
    assert fine.check() and fine.apply_d(fine.apply_d(fine.points[:, 0], 0), 1).any() == False  # noqa: E712


def test_tagged_chains(tmp_path) -> None:  # type: ignore[no-untyped-def]
    path = tmp_path / "square.msh"
    path.write_text(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n1 7 \"rim\"\n2 3 \"plate\"\n$EndPhysicalNames\n"
        "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n$Elements\n6\n"
        "1 1 2 7 1 1 2\n2 1 2 7 1 2 3\n3 1 2 7 1 4 3\n4 1 2 7 1 4 1\n5 2 2 3 1 1 2 3\n6 2 2 3 1 1 3 4\n$EndElements\n"
    )
    K = derham.read(path, planar=True)
    assert {(p.name, p.degree, p.count) for p in K.parts} == {("rim", 1, 4), ("plate", 2, 2)}
    plate, rim = K.tagged_chain("plate"), K.tagged_chain(7, coherent=True)
    assert plate.tolist() == [1, 1]
    boundary = K.boundary(2) @ plate
    assert (rim == boundary).all() or (rim == -boundary).all()
    assert abs(K.tagged_chain("rim")).sum() == 4 and (K.tagged_chain("rim") != rim).any()
    with pytest.raises(derham.InputError, match="'rim' .number 7, degree 1"):
        K.tagged_chain("hull")
    fine = K.refined().fine
    assert abs(fine.tagged_chain("rim")).sum() == 8
