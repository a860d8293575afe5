"""Meshes of other packages, if they are installed: meshio and PyVista."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from ._arguments import Integers, float_array, index_array, shown
from .errors import GeometryError, InputError

if TYPE_CHECKING:
    from .complex import Complex

_CELLS = ("vertex", "line", "triangle", "tetra")


def from_meshio(mesh: Any, *, planar: bool = False) -> Complex:
    """The complex of the simplices of highest dimension of a `meshio.Mesh`; vertices that they do not use are left out.

    planar   leave the third coordinates out, which must be 0
    Raises   InputError if the mesh has no simplices, or cells that are none
    """
    from .complex import Complex

    if not hasattr(mesh, "cells") or not hasattr(mesh, "points"):
        raise InputError(f"the mesh is {shown(mesh)}; expected one of meshio, with points and cells")
    found: dict[str, list[npt.NDArray[Any]]] = {}
    for block in mesh.cells:
        if block.type not in _CELLS:
            raise InputError(f"the mesh has cells of type {block.type!r}; expected {', '.join(_CELLS)}")
        found.setdefault(block.type, []).append(index_array(block.data, "the cells"))
    if not found:
        raise InputError("the mesh has no cells; expected simplices")
    rows = np.concatenate(found[max(found, key=_CELLS.index)])
    used, rows = np.unique(rows, return_inverse=True)
    points = float_array(mesh.points, "the points of the mesh")
    if used.size and not 0 <= used[0] <= used[-1] < len(points):
        wrong = used[0] if used[0] < 0 else used[-1]
        raise InputError(f"the mesh has a cell with vertex {wrong}; expected 0 to {len(points) - 1}")
    points = points[used]
    if planar:
        if points.ndim != 2 or points.shape[1] != 3 or points[:, 2].any():
            raise InputError("the mesh is not planar: third coordinates are missing or not 0")
        points = points[:, :2]
    return Complex(rows.reshape(-1, max(map(_CELLS.index, found)) + 1), points)


def to_meshio(K: Complex) -> Any:
    """A `meshio.Mesh` of the top simplices, positively oriented, dimension 0 to 3.

    Raises   GeometryError unless the complex has points
    """
    import meshio  # type: ignore[import-untyped, import-not-found, unused-ignore]

    points, rows = _points_and_rows(K)
    return meshio.Mesh(points, [(_CELLS[K.dimension], rows)])


def to_pyvista(K: Complex) -> Any:
    """A `pyvista.UnstructuredGrid` of the top simplices, dimension 0 to 3 in space of dimension up to 3.

    Raises   GeometryError unless the complex has points
    """
    import pyvista  # type: ignore[import-untyped, import-not-found, unused-ignore]

    points, rows = _points_and_rows(K)
    space = np.zeros((len(points), 3))
    space[:, : points.shape[1]] = points
    vtk_types = (1, 3, 5, 10)  # VTK_VERTEX, VTK_LINE, VTK_TRIANGLE, VTK_TETRA
    return pyvista.UnstructuredGrid({vtk_types[K.dimension]: rows}, space)


def _points_and_rows(K: Complex) -> tuple[npt.NDArray[np.float64], Integers]:
    from .complex import Complex

    if not isinstance(K, Complex):
        raise InputError(f"K is {shown(K)}; expected a complex")
    if K.points is None:
        raise GeometryError("the complex has no points to draw")
    if K.dimension > 3 or K.ambient_dimension > 3:
        raise InputError(f"the complex has dimension {K.dimension} in space of {K.ambient_dimension}; expected at most 3")
    return K.points, K.oriented_simplices()
