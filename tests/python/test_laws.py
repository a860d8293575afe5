"""∂∂ = 0, dd = 0, Stokes and relatives, through numpy and scipy, on random complexes of dimension 0 to 4."""

from __future__ import annotations

import pickle
from pathlib import Path

import numpy as np
import pytest
import scipy.sparse as sparse
from conftest import random_rows
from hypothesis import given, settings
from hypothesis import strategies as st

import derham

complexes = st.builds(
    lambda n, extra, count, seed: derham.Complex(random_rows(n, n + 1 + extra, count, seed)),
    st.integers(0, 4), st.integers(0, 8), st.integers(1, 20), st.integers(0, 2**32 - 1),
)
laws = settings(max_examples=40, deadline=None)


def obvious_boundary(K: derham.Complex, k: int) -> np.ndarray:
    """Σ (-1)^i of the face without vertex i, looked up in a dictionary."""
    rows = {tuple(s): i for i, s in enumerate(K.simplices(k - 1).tolist())}
    matrix = np.zeros((K.size(k - 1), K.size(k)), np.int8)
    signs = K.signs if k == K.dimension else np.ones(K.size(k), np.int8)
    for j, simplex in enumerate(K.simplices(k).tolist()):
        for i in range(k + 1):
            matrix[rows[tuple(simplex[:i] + simplex[i + 1 :])], j] = (-1) ** i * signs[j]
    return matrix


@laws
@given(complexes)
def test_boundary_is_the_obvious_one_and_d_its_transpose(K: derham.Complex) -> None:
    assert K.boundary(0).shape == (0, K.size(0)) and K.d(K.dimension).shape == (0, K.size(K.dimension))
    for k in range(1, K.dimension + 1):
        assert (K.boundary(k).toarray() == obvious_boundary(K, k)).all()
        assert (K.d(k - 1).toarray() == K.boundary(k).toarray().T).all()


@laws
@given(complexes)
def test_dd_is_zero_exactly(K: derham.Complex) -> None:
    for k in range(K.dimension):
        assert not (K.d(k + 1) @ K.d(k)).count_nonzero()
        if k:
            assert not (K.boundary(k) @ K.boundary(k + 1)).count_nonzero()


@laws
@given(complexes, st.integers(0, 2**32 - 1))
def test_stokes_and_the_matrix_free_operators(K: derham.Complex, seed: int) -> None:
    random = np.random.default_rng(seed)
    for k in range(K.dimension):
        w = random.integers(-9, 9, K.size(k)).astype(float)
        c = random.integers(-9, 9, K.size(k + 1)).astype(float)
        assert K.apply_d(w, k) @ c == w @ K.apply_boundary(c, k + 1)
        assert (K.apply_d(w, k) == K.d(k) @ w).all()
        assert (K.apply_boundary(c, k + 1) == K.boundary(k + 1) @ c).all()
        several = np.stack([w, 2 * w], axis=1)
        assert (K.apply_d(several, k) == K.d(k) @ several).all()


@laws
@given(complexes)
def test_dual_derivative(K: derham.Complex) -> None:
    if not K.is_orientable:
        return
    n = K.dimension
    for k in range(n):
        w = np.arange(1.0, K.size(n - k) + 1)
        np.testing.assert_array_equal(K.apply_d(w, k, "dual"), K.d(k, "dual") @ w)
        np.testing.assert_array_equal(K.d(k, "dual").toarray(), (-1) ** (n - k) * K.boundary(n - k).toarray())


@laws
@given(complexes)
def test_incidence_is_containment(K: derham.Complex) -> None:
    sets = [[set(s) for s in K.simplices(k).tolist()] for k in range(K.dimension + 1)]
    for k in range(K.dimension + 1):
        for m in range(K.dimension + 1):
            expected = [[a <= b or b <= a for b in sets[m]] for a in sets[k]]
            assert (K.incidence(k, m).toarray() == np.array(expected)).all()


def test_star_closure_link() -> None:
    K = derham.generate.sphere(2)
    assert {k: len(v) for k, v in K.open_star({0: [0]}).items()} == {0: 1, 1: 3, 2: 3}
    assert {k: len(v) for k, v in K.link({0: [0]}).items()} == {0: 3, 1: 3}
    assert {k: len(v) for k, v in K.closure({2: [1]}).items()} == {0: 3, 1: 3, 2: 1}
    assert K.boundary_simplices() == {}


def test_boundary_complex() -> None:
    K = derham.generate.box(3, 2)
    boundary, inclusion = K.boundary_complex()
    assert boundary.euler_characteristic == 2 and boundary.check().closed
    assert (K.points[inclusion[0]] == boundary.points).all()
    # the image of its fundamental chain is the boundary of that of K
    image = np.zeros(K.size(2), np.int64)
    image[inclusion[2]] = boundary.signs
    assert (K.boundary(3) @ np.ones(K.size(3), np.int64) == image).all()
    assert abs(boundary.volumes(2).sum() - 6) < 1e-12
    torus, _ = derham.generate.solid_torus(1, 4).boundary_complex()
    assert torus.euler_characteristic == 0


@pytest.mark.parametrize("metric", ["points", "corners", "edge_lengths_squared"])
def test_the_boundary_keeps_its_metric_when_refined_written_and_pickled(metric: str, tmp_path: Path) -> None:
    box = derham.generate.box(3, 2)
    rows = box.oriented_simplices()
    given = {"points": box.points, "corners": box.points[rows], "edge_lengths_squared": box.edge_lengths_squared()}
    boundary, _ = derham.Complex(rows, **{metric: given[metric]}).boundary_complex()
    boundary.write(tmp_path / "m.npz")
    for K in (boundary, boundary.refined().fine, derham.read(tmp_path / "m.npz"), pickle.loads(pickle.dumps(boundary))):
        assert K.metric_source == metric
        assert abs(K.volumes(2).sum() - 6) < 1e-12


def test_chains() -> None:
    K = derham.generate.box(2, 3)
    c = K.chain([(0, 1), (5, 1), (5, 1)], [2, 1, 1])
    assert c.sum() == 0 and (K.boundary(1) @ c)[[0, 1, 5]].tolist() == [-2, 4, -2]


def test_matrices_are_the_memory_of_the_library() -> None:
    K = derham.generate.box(3, 4)
    for k in range(3):
        A = K.d(k)
        assert A.dtype == np.int8 and A.indices.dtype == np.int32 == A.indptr.dtype
        assert np.shares_memory(A.indices, K.faces(k + 1)) and np.shares_memory(A.data, K.d(k).data)
        assert np.shares_memory(A.indices, K.boundary(k + 1).indices)
        assert A.has_canonical_format and isinstance(A, sparse.csr_array)
        B = K.d(k, dtype=np.float64)
        assert B.dtype == np.float64 and not (A - B).count_nonzero()
    assert np.shares_memory(K.star(1).data, K.star(1).data)
