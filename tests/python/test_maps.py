"""Simplicial maps: pullback, pushforward, composition."""

from __future__ import annotations

import numpy as np
import pytest

import derham


@pytest.fixture(params=(1, 2, 3, 4), ids="n={}".format)
def phi(request: pytest.FixtureRequest) -> derham.SimplicialMap:
    """The projection of a product with a path to its first factor, which collapses simplices."""
    n = request.param
    L = derham.generate.grid_torus(n - 1) if n > 1 else derham.generate.cycle(4)
    if n == 1:
        return derham.SimplicialMap(derham.generate.cycle(8), L, np.arange(8) % 4)
    K = derham.generate.product(L, derham.generate.path(2))
    return derham.SimplicialMap(K, L, np.arange(K.size(0)) // 3)


def test_laws(phi: derham.SimplicialMap) -> None:
    K, L = phi.source, phi.target
    random = np.random.default_rng(3)
    for k in range(L.dimension + 1):
        w = random.standard_normal(L.size(k))
        np.testing.assert_array_equal(phi.matrix(k) @ w, phi.pullback(w, k))
        c = random.integers(-5, 5, K.size(k))
        assert (phi.pushforward(c, k) == phi.matrix(k).T @ c).all() and phi.pushforward(c, k).dtype == np.int64
        if k < L.dimension:
            difference = K.apply_d(phi.pullback(w, k), k) - phi.pullback(L.apply_d(w, k), k + 1)
            np.testing.assert_allclose(difference, 0, atol=1e-14)
        if k > 0:
            assert (L.boundary(k) @ phi.pushforward(c, k) == phi.pushforward(K.boundary(k) @ c, k - 1)).all()
        for q in range(L.dimension + 1 - k):
            v = random.standard_normal(L.size(q))
            product = K.wedge(phi.pullback(w, k), k, phi.pullback(v, q), q)
            np.testing.assert_allclose(phi.pullback(L.wedge(w, k, v, q), k + q), product, atol=1e-14)


def test_images_against_the_tuples(phi: derham.SimplicialMap) -> None:
    K, L = phi.source, phi.target
    for k in range(K.dimension + 1):
        index, sign = phi.images(k)
        for i, row in enumerate(phi.vertices[K.simplices(k)].tolist()[:50]):
            expected = (-1, 0) if k > L.dimension or len(set(row)) < k + 1 else L.index(row)
            own = K.signs[i] if k == K.dimension else 1
            assert (index[i], sign[i]) == (expected[0], expected[1] * own)


def test_composition() -> None:
    circles = [derham.generate.cycle(size) for size in (12, 6, 3)]
    first = derham.SimplicialMap(circles[0], circles[1], np.arange(12) % 6)
    second = derham.SimplicialMap(circles[1], circles[2], np.arange(6) % 3)
    both = second @ first
    w = np.arange(3.0)
    np.testing.assert_array_equal(both.pullback(w, 1), first.pullback(second.pullback(w, 1), 1))
    fundamental = circles[0].signs.astype(int)
    assert abs(both.pushforward(fundamental * circles[0].signs, 1)).tolist() == [4, 4, 4]  # four times around


def test_refused() -> None:
    K, L = derham.generate.cycle(4), derham.generate.cycle(3)
    for message, action in (
        ("goes to", lambda: derham.SimplicialMap(K, derham.generate.cycle(5), [0, 2, 4, 1])),
        ("3 images for 4", lambda: derham.SimplicialMap(K, L, [0, 1, 2])),
        ("array of float64", lambda: derham.SimplicialMap(K, L, [0.5, 1, 2, 0])),
        ("c has shape", lambda: derham.SimplicialMap(L, L, [0, 1, 2]).pushforward([1], 1)),
        ("dimension of the source is 0", lambda: derham.SimplicialMap(derham.Complex([(0,)]), L, [0])),
        ("another complex", lambda: derham.SimplicialMap(L, L, [0, 1, 2]) @ derham.SimplicialMap(L, K, [0, 0, 0])),
    ):
        with pytest.raises(derham.InputError, match=message):
            action()


@pytest.mark.parametrize("order", ["hilbert", "cuthill-mckee"])
@pytest.mark.parametrize("n", [1, 2, 3, 4])
def test_renumbered(n: int, order: str) -> None:
    plain = derham.generate.box(n, (40, 9, 4, 2)[n - 1], jitter=0.2)
    random = np.random.default_rng(7)
    shuffle = random.permutation(plain.size(0))
    K = derham.Complex(random.permutation(shuffle[plain.oriented_simplices()]), plain.points[np.argsort(shuffle)])
    L, vertices, rows = K.renumbered(order)  # type: ignore[arg-type]
    np.testing.assert_array_equal(L.simplices(n), np.sort(vertices[K.simplices(n)[rows]], axis=1))
    np.testing.assert_array_equal(L.points[vertices], K.points)
    assert np.ptp(L.simplices(n), axis=1).mean() < np.ptp(K.simplices(n), axis=1).mean()

    def carried(w: np.ndarray, k: int) -> np.ndarray:
        index, sign = L.index(vertices[K.oriented_simplices() if k == n else K.simplices(k)])
        v = np.empty_like(w)
        v[index] = sign * w
        return v

    for k in range(n):
        w = random.standard_normal(K.size(k))
        np.testing.assert_allclose(L.apply_d(carried(w, k), k), carried(K.apply_d(w, k), k + 1), atol=1e-14)
    assert (L.index(vertices[K.oriented_simplices()]).sign == 1).all()
