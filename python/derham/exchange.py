"""Meshes of other packages, if they are installed: PyVista, and what is common to all."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ._arguments import Floats, Integers, shown
from .errors import GeometryError, InputError

if TYPE_CHECKING:
    from .complex import Complex

def to_pyvista(K: Complex) -> Any:
    """A `pyvista.UnstructuredGrid` of the top simplices, positively oriented, with the fields of the complex; dimension 0 to 3 in
    space of dimension up to 3. Parts do not come along.

    Raises   GeometryError unless the complex has points
    """
    import pyvista  # type: ignore[import-untyped, import-not-found, unused-ignore]

    points, rows = points_and_rows(K)
    space = np.zeros((len(points), 3))
    space[:, : points.shape[1]] = points
    vtk_types = (1, 3, 5, 10)  # VTK_VERTEX, VTK_LINE, VTK_TRIANGLE, VTK_TETRA
    grid = pyvista.UnstructuredGrid({vtk_types[K.dimension]: rows}, space)
    for data, fields in ((grid.point_data, K.vertex_fields), (grid.cell_data, K.simplex_fields)):
        for name, values in fields.items():
            data[name] = values
    return grid


def points_and_rows(K: Complex) -> tuple[Floats, Integers]:
    """The points and the oriented top simplices of a complex that others can draw."""
    from .complex import Complex

    if not isinstance(K, Complex):
        raise InputError(f"K is {shown(K)}; expected a complex")
    if K.points is None:
        raise GeometryError("the complex has no points to draw")
    if K.dimension > 3 or K.ambient_dimension > 3:
        raise InputError(f"the complex has dimension {K.dimension} in space of {K.ambient_dimension}; expected at most 3")
    return K.points, K.oriented_simplices()
