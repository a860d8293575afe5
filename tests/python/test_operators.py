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
        expected = np.broadcast_to(components[0] if len(components) == 1 else components, (len(inside), *components.shape)[: 1 + (len(components) > 1)])
        np.testing.assert_allclose(K.interpolate(w, k), expected, atol=1e-12)
        np.testing.assert_allclose(K.interpolate(w, k, inside), expected, atol=1e-12)


def test_locate() -> None:
    K = derham.generate.box(2, 3)
    simplex, barycentric = K.locate([[0.1, 0.2], [2, 2]])
    assert simplex[1] == -1 and np.isnan(K.interpolate(np.ones(K.size(0)), 0, [[2, 2]])).all()
    corners = K.points[K.simplices(2)[simplex[0]]]
    np.testing.assert_allclose(barycentric[0] @ corners, [0.1, 0.2], atol=1e-15)
    S = derham.generate.icosphere(2)
    w = S.points[:, 2]
    assert S.interpolate(w, 0, [[0, 0, 2.0]])[0] == pytest.approx(1, abs=0.05)


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
