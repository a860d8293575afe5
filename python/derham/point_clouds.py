"""Complexes of point clouds."""

from __future__ import annotations

from importlib.util import find_spec
from typing import Literal

import numpy as np
import numpy.typing as npt
import scipy.sparse as sparse
from scipy.spatial import cKDTree
from scipy.special import comb

from . import _derham
from ._arguments import Floats, Integers, float_array, index_dtype, one_of, real_number, whole_number
from .complex import Complex
from .errors import GeometryError, InputError, LimitError

#: Entries of the sparse matrices that cliques are made of at a time.
_BLOCK = 1 << 22


def rips(
    points: npt.ArrayLike,
    radius: float,
    dimension: int,
    *,
    limit: int = 10_000_000,
    backend: Literal["gudhi", "numpy"] | None = None,
) -> Complex:
    """The Vietoris–Rips complex: every set of points whose distances are all at most `radius` is a simplex.

    points     (count, m); point i is vertex i. Points far from all others are isolated vertices
    radius     the greatest length of an edge, not half of it: PyDEC's delta, GUDHI's max_edge_length
    dimension  simplices of higher dimension are left out, 0 to 6; the complex has less where there are none
    limit      of the number of simplices of every degree
    backend    who finds the cliques, always the same ones: "gudhi", which counts only afterwards; "numpy", which stops at
               the limit; by default GUDHI if it is installed and the limit is not in doubt

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
    limit = whole_number(limit, "the limit", 0, 2**63)
    if backend is not None:
        one_of(backend, ("gudhi", "numpy"), "the backend")
    vertices = np.arange(len(x), dtype=index_dtype).reshape(-1, 1)
    if len(x) == 0 or dimension == 0:
        return Complex(vertices)
    edges = _edges(x, radius, limit)
    if backend is None:
        backend = "gudhi" if find_spec("gudhi") and _at_most(edges, dimension) <= limit else "numpy"
    cliques = _cliques_of_gudhi if backend == "gudhi" else _cliques
    return _complex([vertices, edges, *cliques(len(x), edges, dimension, limit)])


def _edges(x: Floats, radius: float, limit: int) -> Integers:
    """Pairs of points at most `radius` apart. The tree finds candidates only: its rounding is not ours."""
    tree = cKDTree(x)
    reach = radius * (1 + 1e-12)
    _require((int(tree.count_neighbors(tree, reach)) - len(x)) // 2, 1, limit)
    pairs = tree.query_pairs(reach, output_type="ndarray")
    pairs = pairs[np.linalg.norm(x[pairs[:, 0]] - x[pairs[:, 1]], axis=1) <= radius]
    edges: Integers = pairs[np.lexsort((pairs[:, 1], pairs[:, 0]))].astype(index_dtype)
    return edges


def _at_most(edges: Integers, dimension: int) -> float:
    """A bound of the number of simplices of one degree: behind its first vertex, a simplex has neighbours of that."""
    behind = np.bincount(edges[:, 0])
    return max(float(comb(behind, k).sum()) for k in range(1, dimension + 1))


def _cliques(vertex_count: int, edges: Integers, dimension: int, limit: int) -> list[Integers]:
    """The simplices of degree 2, 3, …: each with every vertex behind its last one that neighbours all its vertices."""
    shape = (vertex_count, vertex_count)
    behind = sparse.csr_array((np.ones(len(edges), np.bool_), (edges[:, 0], edges[:, 1])), shape=shape)
    lists = [edges]
    common, parents = behind, edges[:, 0]
    for k in range(2, dimension + 1):
        common = _common_of_cofaces(common, parents, behind, k, limit)
        parents = np.repeat(np.arange(len(lists[-1])), np.diff(common.indptr))
        lists.append(np.column_stack([lists[-1][parents], common.indices]).astype(index_dtype))
    return lists[1:]


def _common_of_cofaces(
    common: sparse.csr_array, parents: Integers, behind: sparse.csr_array, k: int, limit: int
) -> sparse.csr_array:
    """From the common neighbours behind every (k-2)-simplex those behind every (k-1)-simplex, in blocks."""
    last = common.indices
    work = np.cumsum(np.diff(common.indptr)[parents])
    cuts = np.searchsorted(work, np.arange(_BLOCK, work[-1] if len(work) else 0, _BLOCK)).tolist()
    blocks, count = [], 0
    for a, b in zip([0, *cuts], [*cuts, len(last)]):
        blocks.append(common[parents[a:b]].multiply(behind[last[a:b]]).tocsr())
        count += blocks[-1].nnz
        _require(count, k, limit)
    return sparse.csr_array(sparse.vstack(blocks, format="csr"))


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
