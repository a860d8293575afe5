"""Vietoris–Rips complexes: against all subsets of the points, against GUDHI, and what is refused."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

import derham
from derham import point_clouds


def subsets(points: np.ndarray, radius: float, dimension: int) -> list[list[tuple[int, ...]]]:
    """The definition: all sets of at most dimension + 1 points whose distances are at most radius."""
    near = np.linalg.norm(points[:, None] - points[None], axis=2) <= radius
    lists = []
    for k in range(dimension + 1):
        sets = itertools.combinations(range(len(points)), k + 1)
        lists.append([s for s in sets if all(near[i, j] for i, j in itertools.combinations(s, 2))])
    return [simplices for k, simplices in enumerate(lists) if simplices or k == 0]


def lists_of(K: derham.Complex) -> list[list[tuple[int, ...]]]:
    return [list(map(tuple, K.simplices(k).tolist())) for k in range(K.dimension + 1)]


@pytest.fixture(params=[None, "derham", "gudhi"])
def backend(request: pytest.FixtureRequest) -> str | None:
    if request.param == "gudhi":
        pytest.importorskip("gudhi")
    return request.param


@pytest.mark.parametrize("m", [1, 2, 3, 5])
@pytest.mark.parametrize("radius", [0, 0.2, 0.6, np.inf])
@pytest.mark.parametrize("dimension", [0, 1, 2, 3, 4, 6])
def test_all_subsets_in_order(m: int, radius: float, dimension: int, backend: str | None) -> None:
    points = np.random.default_rng(m).random((11, m))
    K = derham.rips(points, radius, dimension, backend=backend)
    assert lists_of(K) == subsets(points, radius, dimension)


@pytest.mark.parametrize(("count", "m", "radius"), [(400, 1, 0.01), (400, 2, 0.12), (300, 3, 0.25), (200, 4, 0.4)])
def test_both_ways_and_gudhi_itself_agree(count: int, m: int, radius: float) -> None:
    gudhi = pytest.importorskip("gudhi")
    points = np.random.default_rng(count).random((count, m))
    K, L = (derham.rips(points, radius, 3, backend=name) for name in ("derham", "gudhi"))
    assert K.dimension == 3 and lists_of(K) == lists_of(L)
    tree = gudhi.RipsComplex(points=points, max_edge_length=radius).create_simplex_tree(max_dimension=3)
    assert sorted(tuple(s) for s, _ in tree.get_simplices()) == sorted(itertools.chain(*lists_of(K)))


def test_edges_as_long_as_the_radius_are_in(backend: str | None) -> None:
    square = np.array(list(itertools.product(range(3), range(3))))
    assert derham.rips(square, 1, 2, backend=backend).sizes == (9, 12)
    assert derham.rips(square, np.sqrt(2), 3, backend=backend).sizes == (9, 20, 16, 4)
    assert derham.rips(square, np.nextafter(1, 0), 2, backend=backend).sizes == (9,)


def test_isolated_and_equal_points(backend: str | None) -> None:
    K = derham.rips([(0, 0), (0, 0), (1, 0), (9, 9)], 1, 2, backend=backend)
    assert K.sizes == (4, 3, 1) and not K.is_pure and K.components == 2 and K.metric_source is None
    assert derham.rips(np.zeros((0, 3)), 1, 2, backend=backend).sizes == (0,)
    assert derham.rips([(1.0,)], 1, 2, backend=backend).sizes == (1,)


def test_the_hexagon_is_a_circle_then_a_sphere_then_a_simplex() -> None:
    """Adamaszek & Adams, "The Vietoris–Rips complexes of a circle", 2017: here an octahedron, S², between."""
    angles = np.arange(6) * np.pi / 3
    hexagon = np.column_stack([np.cos(angles), np.sin(angles)])
    sizes = [derham.rips(hexagon, radius, 5).sizes for radius in (1.01, 1.74, 2.01)]
    assert sizes == [(6, 6), (6, 12, 8), (6, 15, 20, 15, 6, 1)]
    assert derham.rips(hexagon, 1.74, 5).check().closed


def test_what_is_refused(backend: str | None) -> None:
    square = [(0, 0), (1, 0), (0, 1), (1, 1)]
    for arguments, message in [
        (([1, 2], 1, 1), r"shape \(2,\)"),
        ((square, -1, 1), "radius is -1"),
        ((square, np.nan, 1), "radius is nan"),
        ((square, 1, 7), "dimension is 7; expected 0 to 6"),
        ((square, 1, 1.5), "dimension is 1.5"),
        ((["a"], 1, 1), "real numbers"),
    ]:
        with pytest.raises(derham.InputError, match=message):
            derham.rips(*arguments, backend=backend)
    with pytest.raises(derham.InputError, match="limit is -1"):
        derham.rips(square, 1, 1, limit=-1, backend=backend)
    with pytest.raises(derham.GeometryError, match="point 1 is"):
        derham.rips([(0, 0), (0, np.inf)], 1, 1, backend=backend)
    with pytest.raises(derham.InputError, match="backend is 'ripser'"):
        derham.rips(square, 1, 1, backend="ripser")  # type: ignore[arg-type]


@pytest.mark.parametrize(("limit", "degree"), [(14, 1), (15, 2), (19, 2)])
def test_too_many(limit: int, degree: int, backend: str | None) -> None:
    """Six points near each other have 15 edges, 20 triangles, 15 tetrahedra."""
    points = np.random.default_rng(1).random((6, 2))
    assert derham.rips(points, 2, 3, limit=20, backend=backend).sizes == (6, 15, 20, 15)
    with pytest.raises(derham.LimitError, match=f"simplices of degree {degree}, or more; expected at most {limit}"):
        derham.rips(points, 2, 3, limit=limit, backend=backend)


def test_gudhi_is_asked_by_default_but_not_for_too_much(monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("gudhi")
    asked = []
    monkeypatch.setattr(point_clouds, "_cliques_of_gudhi", lambda *arguments: asked.append(arguments) or [])
    points = np.random.default_rng(1).random((200, 2))
    derham.rips(points, 0.1, 3)
    derham.rips(points[:64], 0.1, 3)
    assert len(asked) == 1
    with pytest.raises(derham.LimitError):
        derham.rips(points, np.inf, 3, limit=100_000)
    assert len(asked) == 1


@pytest.mark.parametrize("count", [63, 64, 65])
def test_few_points_and_many(count: int) -> None:
    """Without a tree, and with one."""
    points = np.random.default_rng(count).integers(0, 8, (count, 2)).astype(float)
    for radius in (1.0, np.sqrt(2), 2.0):
        assert lists_of(derham.rips(points, radius, 2, backend="derham")) == subsets(points, radius, 2)
