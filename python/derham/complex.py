"""derham.Complex: an oriented simplicial complex of any dimension, with or without a metric."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from os import PathLike
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _derham
from ._arguments import (
    Integers,
    flag,
    float_array,
    format_name,
    index_array,
    index_dtype,
    path_text,
    shown,
)
from ._contraction import Contraction
from ._data import GivenForm
from ._fields import Fields
from ._laplacians import Laplacians
from ._mesh import Mesh
from ._wedge import Wedge
from .errors import InputError


class Complex(Wedge, Contraction, Laplacians, Fields, Mesh):
    """The closure of some simplices, oriented, with exact boundary operators; with positions or lengths also a metric.

    simplices             (count, n+1) vertices of the top simplices in any order, n = 0 to 6; or tuples of several
                          lengths, which make a complex that is not pure. Every vertex must be used.
    points                (|V|, m) positions of the vertices, m >= n
    edge_lengths_squared  (|E|,) by the index of the edge, instead of positions: `simplices(1)` has lexicographic order
    corners               (count, n+1, m) positions of the corners of every simplex on its own, for periodic meshes
    drop_unused           leave out vertices that are in no simplex, else they are refused; `vertex_tags` then has their
                          old numbers

    Top simplices are oriented coherently, each component by its total signed volume where n = m, else so that its first
    tuple is positive. A complex does not change; copies are itself. Metrics exist for pure complexes of dimension 0 to 4; points
    alone (n = 0) have volumes, stars and integrals, but no Laplacians.

    Cost     linear; other Python threads may run meanwhile
    Raises   InputError naming the first offending row; GeometryError naming a position or length that is none;
             LimitError when a list would overflow the index type
    Source   Elcott & Schröder, "Building your own DEC at home", §2, §3, §5

    >>> import derham
    >>> derham.Complex([(0, 1, 2), (1, 2, 3)], points=[(0, 0), (1, 0), (0, 1), (1, 1)])
    derham.Complex of dimension 2 in space of dimension 2: 4, 5, 2 simplices
    """

    def __init__(
        self,
        simplices: npt.ArrayLike | Iterable[Iterable[int]],
        points: npt.ArrayLike | None = None,
        edge_lengths_squared: npt.ArrayLike | None = None,
        *,
        corners: npt.ArrayLike | None = None,
        drop_unused: bool = False,
    ) -> None:
        given = [name for name, value in (("points", points), ("corners", corners),
                                          ("edge_lengths_squared", edge_lengths_squared)) if value is not None]
        if len(given) > 1:
            raise InputError(f"{' and '.join(given)} are given; expected one of them, for each is a metric")
        positions = _positions(points, 2, "points", "(vertices, m)")
        vertex_count = -1 if positions is None else len(positions)
        places = _positions(corners, 3, "corners", "(simplices, n+1, m)")
        lengths = _positions(edge_lengths_squared, 1, "edge_lengths_squared", "(edges,)")
        rows, ends = _rows(simplices)
        drop = flag(drop_unused, "drop_unused")
        if ends is None and places is not None and places.shape[:2] != rows.shape:
            raise InputError(f"corners have shape {places.shape}; expected {rows.shape} and the dimension of space")
        if ends is None:
            core = _derham.Complex(rows, vertex_count, positions, places, lengths, drop)
        elif places is None and lengths is None:
            core = _derham.Complex(rows, ends, vertex_count, positions, drop)
        else:
            raise InputError(f"simplices of several dimensions with {given[0]}; give simplices of one dimension")
        self._set(core)

    def _set(self, core: _derham.Complex) -> None:
        self._core = core
        self._kept = {}
        self._sizes = tuple(core.size(k) for k in range(core.dimension + 1))

    @classmethod
    def _of(cls, core: _derham.Complex) -> Complex:
        self = Complex.__new__(Complex)
        self._set(core)
        return self

    def write(
        self,
        path: str | PathLike[str],
        format: str | None = None,
        *,
        binary: bool | None = None,
        gmsh_41: bool = False,
    ) -> None:
        """Writes the mesh, complete or not at all, in the format of the name's extension or the one that is given.

        Raises   InputError if the format cannot hold the mesh; FileError if the file cannot be written
        """
        encoding = None if binary is None else flag(binary, "binary")
        self._core.write(path_text(path), format_name(format), encoding, flag(gmsh_41, "gmsh_41"))

    def write_forms(
        self,
        path: str | PathLike[str],
        forms: Mapping[str, GivenForm],
    ) -> None:
        """Writes a picture of forms for ParaView and VTK, a .vtu file: {name: (w, k)} or {name: (w, k, side)}.

        Functions are data of points. Other forms are data of the cells that are k-simplices (of dual forms: (n-k)-simplices), NaN
        on all others: cells are the simplices of all degrees, each with its `degree`, `index` and `sign`.

        Raises   InputError unless n and m are 1 to 3, or on a wrong shape; GeometryError without points; FileError if it
                 cannot be written
        """
        named = [(name, self.dimension - k if dual else k, w) for name, w, k, dual in self._named_forms(forms)]
        self._core.draw(path_text(path), named)

    def __repr__(self) -> str:
        space = {
            None: "without a metric",
            "edge_lengths_squared": "with edge lengths",
        }.get(self.metric_source, f"in space of dimension {self.ambient_dimension}")
        return f"derham.Complex of dimension {self.dimension} {space}: {', '.join(map(str, self._sizes))} simplices"

    def _repr_html_(self) -> str:
        heads = "".join(f"<th>{k}-simplices</th>" for k in range(self.dimension + 1))
        cells = "".join(f"<td>{size:,}</td>" for size in self._sizes)
        title = repr(self).partition(":")[0]
        return f"<table><caption>{title}</caption><tr>{heads}</tr><tr>{cells}</tr></table>"

    def __copy__(self) -> Complex:
        return self

    def __deepcopy__(self, memo: dict[int, Any]) -> Complex:
        return self

    def __reduce__(self) -> tuple[Any, ...]:
        return _restored, (self._core.state(),)


def _restored(state: dict[str, Any]) -> Complex:
    return Complex._of(_derham.Complex.restored(state))


def read(
    path: str | PathLike[str],
    format: str | None = None,
    *,
    triangulate: bool = False,
    corner_nodes: bool = False,
    planar: bool = False,
    drop_unused: bool = False,
) -> Complex:
    """The complex in a mesh file: .node/.ele, .msh, .mesh, .vtk, .vtu, .obj, .off, .ply, .stl, .facets, .npz.

    format        the name of the format, instead of detecting it
    triangulate   split polygons into triangles, else they are refused
    corner_nodes  of elements of higher order keep the corners, else they are refused
    planar        read a mesh whose third coordinates are 0 as one in the plane
    drop_unused   leave out vertices that are in no simplex, else they are refused

    Raises   FileError naming the line if the file cannot be read; InputError if its simplices are no complex
    """
    flags = [
        flag(triangulate, "triangulate"),
        flag(corner_nodes, "corner_nodes"),
        flag(planar, "planar"),
        flag(drop_unused, "drop_unused"),
    ]
    return Complex._of(_derham.read(path_text(path), format_name(format), *flags))


def _positions(values: npt.ArrayLike | None, ndim: int, name: str, expected: str) -> Any:
    if values is None:
        return None
    array = float_array(values, name)
    if array.ndim != ndim:
        raise InputError(f"{name} have shape {array.shape}; expected {expected}")
    return array


def _rows(simplices: Any) -> tuple[Integers, Integers | None]:
    """(rows, None) of one length, or (vertices, ends) of several."""
    if not hasattr(simplices, "__array__"):  # data frames and tensors have one
        try:
            tuples = [tuple(row) for row in simplices]
        except TypeError:
            raise InputError(
                f"simplices are {shown(simplices)}; expected (count, n+1), the vertices of a simplex in every row"
            ) from None
        lengths = [len(row) for row in tuples]
        if len(set(lengths)) > 1:
            if min(lengths) == 0:
                raise InputError(f"row {lengths.index(0)} has no vertices", lengths.index(0))
            vertices = index_array([v for row in tuples for v in row], "simplices")
            return vertices, np.cumsum(lengths).astype(index_dtype)
        simplices = np.array(tuples) if tuples else np.zeros((0, 1), index_dtype)
    rows = index_array(simplices, "simplices")
    if rows.ndim == 2 and rows.shape[0] <= 7 < rows.shape[1]:
        raise InputError(
            f"the dimension of the simplices is {rows.shape[1] - 1}; expected 0 to 6. Rows are simplices: if columns are, give "
            f"the transposed array, simplices.T of shape {rows.shape[::-1]}"
        )
    if rows.ndim != 2 or rows.shape[1] == 0:
        raise InputError(f"simplices have shape {rows.shape}; expected (count, n+1), the vertices of a simplex in every row")
    return rows, None
