"""Complexes of point clouds."""

from __future__ import annotations

from importlib.util import find_spec
from typing import Literal

import numpy as np
import numpy.typing as npt
from scipy.spatial import cKDTree
from scipy.special import comb

from . import _derham
from ._arguments import Floats, Integers, float_array, index_dtype, one_of, real_number, whole_number
from .complex import Complex
from .errors import GeometryError, InputError, LimitError

#: Of so many points no tree is made, nor others asked.
_FEW = 64


def rips(
    points: npt.ArrayLike,
    radius: float,
    dimension: int,
    *,
    limit: int = 10_000_000,
    backend: Literal["gudhi", "derham"] | None = None,
) -> Complex:
    """The Vietoris–Rips complex: every set of points whose distances are all at most `radius` is a simplex.

    points     (count, m); point i is vertex i. Points far from all others are isolated vertices
    radius     the greatest length of an edge, not half of it: PyDEC's delta, GUDHI's max_edge_length
    dimension  simplices of higher dimension are left out, 0 to 6; the complex has less where there are none
    limit      of the number of simplices of every degree
    backend    who finds the cliques, always the same ones: "gudhi", which counts only afterwards; "derham", which stops at
               the limit; by default GUDHI for more than 64 points, if it is installed and the limit is not in doubt

    The complex is seldom pure and has no metric: its simplices overlap in space, and may have more dimensions than space.
    The lists of all degrees have lexicographic order.

    Cost       the number of simplices times that of the common neighbours that each has
    Raises     InputError for a wrong shape, radius, dimension, limit or backend; GeometryError naming a point that is not
               finite; LimitError with too many simplices; ImportError for "gudhi" where it is not installed
    Source     Vietoris 1927; Zomorodian, "Fast construction of the Vietoris–Rips complex", 2010, §4.2

    >>> import derham
    >>> derham.rips([(0, 0), (1, 0), (0, 1), (5, 5)], 1.5, 2).sizes
    (4, 3, 1)
    """
    x = float_array(points, "points")
    if x.ndim != 2 or x.shape[1] == 0:
        raise InputError(f"points have shape {x.shape}; expected (count, m), m at least 1")
    if not np.isfinite(x).all():
        row = int(np.flatnonzero(~np.isfinite(x).all(axis=1))[0])
        raise GeometryError(f"point {row} is {x[row].tolist()}; expected finite coordinates")
    radius = real_number(radius, "the radius")
    if not radius >= 0:
        raise InputError(f"the radius is {radius}; expected a length of 0 or more")
    dimension = whole_number(dimension, "the dimension", 0, 6)
    limit = whole_number(limit, "the limit", 0, 2**63 - 1)
    if backend is not None:
        one_of(backend, ("gudhi", "derham"), "the backend")
    vertices = np.arange(len(x), dtype=index_dtype).reshape(-1, 1)
    if len(x) == 0 or dimension == 0:
        return Complex(vertices)
    edges = _edges(x, radius, limit)
    if backend is None:
        use_gudhi = len(x) > _FEW and find_spec("gudhi") and _at_most(edges, dimension) <= limit
        backend = "gudhi" if use_gudhi else "derham"
    cliques = _cliques_of_gudhi if backend == "gudhi" else _cliques
    return _complex([vertices, edges, *cliques(len(x), edges, dimension, limit)])


def _edges(x: Floats, radius: float, limit: int) -> Integers:
    """Pairs of points at most `radius` apart. The tree finds candidates only: its rounding is not ours."""
    if len(x) <= _FEW:
        edges: Integers = _derham.near_pairs(x, radius, None)
        _require(len(edges), 1, limit)
        return edges
    tree = cKDTree(x)
    reach = radius * (1 + 1e-12)
    _require((int(tree.count_neighbors(tree, reach)) - len(x)) // 2, 1, limit)
    pairs = tree.query_pairs(reach, output_type="ndarray")
    pairs = pairs[np.lexsort((pairs[:, 1], pairs[:, 0]))].astype(index_dtype)
    return _derham.near_pairs(x, radius, pairs)


def _at_most(edges: Integers, dimension: int) -> float:
    """A bound of the number of simplices of one degree: behind its first vertex, a simplex has neighbours of that."""
    behind = np.bincount(edges[:, 0])
    return max(float(comb(behind, k).sum()) for k in range(1, dimension + 1))


def _cliques(vertex_count: int, edges: Integers, dimension: int, limit: int) -> list[Integers]:
    """The simplices of degree 2, 3, …"""
    lists = _derham.cliques(edges, vertex_count, dimension, limit)
    for k, (count, _) in enumerate(lists, 2):
        _require(count, k, limit)
    return [rows for _, rows in lists]


def _cliques_of_gudhi(vertex_count: int, edges: Integers, dimension: int, limit: int) -> list[Integers]:
    import gudhi  # type: ignore[import-untyped, import-not-found, unused-ignore]

    tree = gudhi.SimplexTree()
    tree.insert_batch(np.arange(vertex_count).reshape(1, -1), np.zeros(vertex_count))
    tree.insert_batch(edges.T, np.zeros(len(edges)))
    tree.expansion(dimension)
    lists: list[list[list[int]]] = [[] for _ in range(dimension + 1)]
    for simplex, _ in tree.get_simplices():
        lists[len(simplex) - 1].append(simplex)
    for k in range(2, dimension + 1):
        _require(len(lists[k]), k, limit)
    return [np.array(sorted(lists[k]), index_dtype).reshape(-1, k + 1) for k in range(2, dimension + 1)]


def _require(count: int, k: int, limit: int) -> None:
    if count > limit:
        raise LimitError(
            f"there are {count} simplices of degree {k}, or more; expected at most {limit}. Take a smaller radius or dimension, "
            "or a higher limit"
        )


def _complex(lists: list[Integers]) -> Complex:
    """The complex with these lists of simplices."""
    used = [rows for rows in lists if len(rows)]
    ends = np.cumsum(np.concatenate([np.full(len(rows), rows.shape[1]) for rows in used]))
    flat = np.concatenate([rows.reshape(-1) for rows in used])
    return Complex._of(_derham.Complex(flat, ends.astype(index_dtype), len(lists[0]), None))
