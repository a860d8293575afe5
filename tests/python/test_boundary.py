"""Traces, data on the boundary, Robin conditions: the laws of the boundary through numpy."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import sparse

import derham


@pytest.fixture
def random() -> np.random.Generator:
    return np.random.default_rng(5)


@pytest.fixture(params=(1, 2, 3, 4), ids="n={}".format)
def M(request: pytest.FixtureRequest) -> derham.Complex:
    return derham.generate.box(request.param, 2 if request.param < 4 else 1, jitter=0.2)


def test_the_trace_commutes_with_d_and_stokes(M: derham.Complex, random: np.random.Generator) -> None:
    B, inclusion = M.boundary_complex()
    n = M.dimension
    for k in range(n):
        w = random.standard_normal(M.size(k))
        np.testing.assert_array_equal(M.trace_matrix(k) @ w, M.trace(w, k))
        np.testing.assert_array_equal(abs(M.trace(w, k)), abs(w[inclusion[k]]))
        if k < n - 1:
            np.testing.assert_allclose(M.trace(M.apply_d(w, k), k + 1), B.apply_d(M.trace(w, k), k), atol=1e-14)
    w = random.standard_normal(M.size(n - 1))
    if n >= 2:
        assert M.apply_d(w, n - 1).sum() == pytest.approx(M.trace(w, n - 1).sum())
    assert M.boundary_complex()[0] is B


def test_the_boundary_term_is_the_transpose(M: derham.Complex, random: np.random.Generator) -> None:
    B = M.boundary_complex()[0]
    n = M.dimension
    for j in range(n):
        k = n - 1 - j
        b, w = random.standard_normal(B.size(k)), random.standard_normal(M.size(n - j))
        term = M.boundary_term(b, j)
        np.testing.assert_array_equal(term, M.trace_matrix(k).T @ b)
        closed = M.apply_d(w, j, "dual", boundary=b)
        np.testing.assert_allclose(closed, M.apply_d(w, j, "dual") + (-1) ** k * term, atol=1e-14)
        np.testing.assert_array_equal(M.apply_d(w, j, "dual", boundary=0 * b), M.apply_d(w, j, "dual"))
        if j < n - 1:
            db = B.apply_d(b, j, "dual")
            np.testing.assert_allclose(M.apply_d(closed, j + 1, "dual", boundary=db), 0, atol=1e-13)


def test_loads_and_robin_matrices(M: derham.Complex, random: np.random.Generator) -> None:
    B, inclusion = M.boundary_complex()
    facets = inclusion[-1][:2]
    h = M.boundary_material([(facets, 3.0)])
    assert h.sum() == 6 and (h[:2] == 3).all()
    for k in range(M.dimension):
        S = B.star(k, "whitney", material=h)
        T = M.trace_matrix(k)
        a, g = random.standard_normal(M.size(k)), random.standard_normal(B.size(k))
        assert a @ M.boundary_load(g, k, S) == pytest.approx(M.trace(a, k) @ S @ g)
        robin = M.robin_matrix(k, S)
        for inner in (S, S.toarray(), sparse.coo_array(S), sparse.dia_array(np.diag(S.diagonal())), B.star(k, "barycentric")):
            difference = M.robin_matrix(k, inner) - T.T @ inner @ T
            assert abs(difference).max() < 1e-15 and robin.shape == (M.size(k),) * 2
        assert a @ (robin @ a) >= 0


def test_a_robin_condition() -> None:
    """-u'' = 0 on [0, 1], u'(1) = h (1 - u(1)), u(0) = 0: u = x h / (1 + h)."""
    K, h = derham.generate.box(1, 5), 2.0
    B, inclusion = K.boundary_complex()
    right = [f for f in inclusion[0] if K.points[f, 0] == 1]
    S = B.star(0, "whitney", material=K.boundary_material([(right, h)]))
    A = K.d(0).T @ K.star(1, "whitney") @ K.d(0) + K.robin_matrix(0, S)
    load = K.boundary_load(np.ones(B.size(0)), 0, S)
    E = K.form_space([f for f in inclusion[0] if K.points[f, 0] == 0]).extension(0)
    u = E @ sparse.linalg.spsolve((E.T @ A @ E).tocsc(), E.T @ load)
    np.testing.assert_allclose(u, K.points[:, 0] * h / (1 + h), atol=1e-13)


def test_natural_data() -> None:
    """Δu = 0 on a square with ∂u/∂x = 1 on the right, -1 on the left: u = x + c."""
    K = derham.generate.box(2, 3, jitter=0.3)
    B, inclusion = K.boundary_complex()
    middle = K.points[K.simplices(1)[inclusion[1]]].mean(axis=1)
    g = K.boundary_material([(inclusion[1][middle[:, 0] == 1], 1.0), (inclusion[1][middle[:, 0] == 0], -1.0)])
    load = K.boundary_load(np.ones(B.size(0)), 0, B.star(0, "whitney", material=g))
    A = K.d(0).T @ K.star(1, "whitney") @ K.d(0)
    np.testing.assert_allclose(A @ K.points[:, 0], load, atol=1e-14)


def test_tagged_facets(tmp_path) -> None:  # type: ignore[no-untyped-def]
    path = tmp_path / "square.msh"
    path.write_text(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n1 7 \"left\"\n1 8 \"right\"\n2 3 \"plate\"\n"
        "$EndPhysicalNames\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n$Elements\n4\n"
        "1 1 2 8 1 2 3\n2 1 2 7 1 4 1\n3 2 2 3 1 1 2 3\n4 2 2 3 1 1 3 4\n$EndElements\n"
    )
    K = derham.read(path, planar=True)
    right, left = K.index([(1, 2), (0, 3)]).index
    assert K.tagged_facets("right").tolist() == [right] and K.tagged_facets().tolist() == []
    assert K.tagged_facets("right", 7).tolist() == sorted([right, left])
    with pytest.raises(derham.InputError, match="plate"):
        K.tagged_facets("plate")


def test_refused() -> None:
    K = derham.generate.box(2, 2)
    B, inclusion = K.boundary_complex()
    inner = np.setdiff1d(np.arange(K.size(1)), inclusion[1])[0]
    for message, action in (
        (f"facet {inner} is not on the boundary", lambda: K.boundary_material([([inner], 1)])),
        ("facet 99 is not on the boundary", lambda: K.boundary_material([([99], 1)])),
        ("is in two parts", lambda: K.boundary_material([(inclusion[1], 1), (inclusion[1][:1], 2)])),
        (r"degree k is 2; expected 0 to 1", lambda: K.trace(np.ones(8), 2)),
        (r"S has shape \(9, 9\)", lambda: K.robin_matrix(0, K.star(0))),
        (r"b has shape \(3,\)", lambda: K.boundary_term(np.ones(3), 0)),
        (r"expected side='dual'", lambda: K.apply_d(np.ones(9), 0, boundary=np.ones(8))),
    ):
        with pytest.raises(derham.InputError, match=message):
            action()
    with pytest.raises(derham.TopologyError):
        derham.Complex([(0, 1, 2), (2, 3)]).boundary_complex()
