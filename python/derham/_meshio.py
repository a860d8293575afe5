"""Meshes of meshio, with their tags and data."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ._arguments import Integers, float_array, index_array, shown
from .errors import InputError
from .exchange import points_and_rows

if TYPE_CHECKING:
    from .complex import Complex

_CELLS = ("vertex", "line", "triangle", "tetra")
#: Data that are the numbers of parts, 0 for none.
_TAGS = ("gmsh:physical", "medit:ref", "cell_tags")


class _Tagged(NamedTuple):
    """A part, by the vertices of the mesh; without a number if it has only a name."""

    name: str
    number: int | None
    degree: int
    simplices: npt.NDArray[Any]


def from_meshio(mesh: Any, *, planar: bool = False) -> Complex:
    """The complex of the simplices of highest dimension of a `meshio.Mesh`. Cells of lower dimension count where tags or sets
    name them; vertices that no simplex uses are left out, `vertex_tags` has the old numbers of the others.

    Integers in the data gmsh:physical, medit:ref or cell_tags, `cell_sets` and `point_sets` become parts, with the names
    in `field_data`; other data become fields. What finds no place is in `notes`.

    planar   leave the third coordinates out, which must be 0
    Raises   InputError if the mesh has no simplices, or cells that are none
    """
    from .complex import Complex

    blocks = _blocks(mesh)
    top = max(degree for degree, _ in blocks)
    points = float_array(mesh.points, "the points of the mesh")
    rows = np.concatenate([cells for degree, cells in blocks if degree == top])
    if rows.size and not 0 <= rows.min() <= rows.max() < len(points):
        wrong = rows.min() if rows.min() < 0 else rows.max()
        raise InputError(f"the mesh has a cell with vertex {wrong}; expected 0 to {len(points) - 1}")
    if planar:
        if points.ndim != 2 or points.shape[1] != 3 or points[rows.ravel(), 2].any():
            raise InputError("the mesh is not planar: third coordinates are missing or not 0")
        points = points[:, :2]
    K = Complex(rows, points, drop_unused=True)
    notes: list[str] = []
    fields = list(_fields(mesh, [degree == top for degree, _ in blocks], K, notes))
    return K._with(_parts_of(mesh, blocks, K, notes), fields, [], notes)


def to_meshio(K: Complex) -> Any:
    """A `meshio.Mesh` of the top simplices, positively oriented, dimension 0 to 3, with parts and fields.

    Parts are `cell_sets` and, unless two of them share a name or a top simplex, also numbers gmsh:physical with names in
    `field_data`. Each of lower dimension is a block of cells of its own, on which fields of top simplices are NaN.

    Raises   GeometryError unless the complex has points
    """
    import meshio  # type: ignore[import-untyped, import-not-found, unused-ignore]

    points, rows = points_and_rows(K)
    lower = [part for part in K.parts if part.degree < K.dimension]
    regions = [part for part in K.parts if part.degree == K.dimension]
    cells = [(_CELLS[K.dimension], rows)]
    cells += [(_CELLS[part.degree], K.tagged_simplices(part.number, part.degree)) for part in lower]
    numbers = [np.zeros(len(rows), np.int64), *(np.full(part.count, part.number) for part in lower)]
    sets: dict[str, list[npt.NDArray[np.int64]]] = {}

    def gather(name: str, block: int, members: npt.NDArray[np.int64]) -> None:
        sets.setdefault(name, [np.zeros(0, np.int64)] * len(cells))[block] = members

    for block, part in enumerate(lower, 1):
        gather(part.name or str(part.number), block, np.arange(part.count))
    numbers_say_all = len({part.name for part in K.parts if part.name}) == sum(bool(part.name) for part in K.parts)
    for part in regions:
        members = np.flatnonzero(K.tagged_chain(part.number, part.degree))
        gather(part.name or str(part.number), 0, members)
        numbers_say_all &= not numbers[0][members].any()
        numbers[0][members] = part.number
    numbers_say_all &= all(part.number for part in K.parts)

    data = {name: [u, *(np.full((len(c), *u.shape[1:]), np.nan) for _, c in cells[1:])] for name, u in K.simplex_fields.items()}
    names = {}
    if K.parts and numbers_say_all:
        data["gmsh:physical"] = numbers
        names = {part.name: np.array([part.number, part.degree]) for part in K.parts if part.name}
    return meshio.Mesh(points, cells, dict(K.vertex_fields), data, names, cell_sets=sets)


def _blocks(mesh: Any) -> list[tuple[int, Integers]]:
    """The degree and the vertices of the cells of every block."""
    if not hasattr(mesh, "cells") or not hasattr(mesh, "points"):
        raise InputError(f"the mesh is {shown(mesh)}; expected one of meshio, with points and cells")
    blocks = []
    for block in mesh.cells:
        if block.type not in _CELLS:
            raise InputError(f"the mesh has cells of type {block.type!r}; expected {', '.join(_CELLS)}")
        degree = _CELLS.index(block.type)
        blocks.append((degree, index_array(block.data, "the cells").reshape(-1, degree + 1)))
    if not blocks:
        raise InputError("the mesh has no cells; expected simplices")
    return blocks


def _tagged(mesh: Any, blocks: list[tuple[int, Integers]]) -> Iterator[_Tagged]:
    """What numbers and sets name, block by block."""
    names = {tuple(np.ravel(value)): name for name, value in getattr(mesh, "field_data", {}).items() if np.size(value) == 2}
    numbered = set()
    for key in _TAGS:
        for (degree, cells), numbers in zip(blocks, getattr(mesh, "cell_data", {}).get(key, ()), strict=False):
            for number in np.unique(index_array(numbers, key)).tolist():
                if number:
                    name = names.get((number, degree), "")
                    numbered.add((name, degree))
                    yield _Tagged(name, number, degree, cells[np.ravel(numbers) == number])
        vertices = np.ravel(getattr(mesh, "point_data", {}).get(key, ()))
        for number in np.unique(vertices).astype(int).tolist():
            if number:
                yield _Tagged(names.get((number, 0), ""), number, 0, np.flatnonzero(vertices == number)[:, np.newaxis])
    for name, members in getattr(mesh, "cell_sets", {}).items():
        for (degree, cells), places in zip(blocks, members, strict=True):
            if places is not None and len(places) and (name, degree) not in numbered and not name.startswith("gmsh:"):
                yield _Tagged(name, None, degree, cells[np.asarray(places)])
    for name, places in getattr(mesh, "point_sets", {}).items():
        yield _Tagged(name, None, 0, np.asarray(places).reshape(-1, 1))


def _parts_of(
    mesh: Any, blocks: list[tuple[int, Integers]], K: Complex, notes: list[str]
) -> list[tuple[str, int, int, Integers]]:
    """The parts as the compiled half takes them, and a note on every one that K has not all of."""
    tags = K.vertex_tags
    new = np.full(len(mesh.points), -1, K.simplices(0).dtype)
    new[slice(None) if tags is None else tags] = np.arange(K.size(0))
    joined: dict[tuple[str, int | None, int], list[npt.NDArray[Any]]] = {}
    for name, number, degree, simplices in _tagged(mesh, blocks):
        joined.setdefault((name, number, degree), []).append(simplices)
    taken = {(degree, number) for _, number, degree in joined}
    parts = []
    for (name, number, degree), lists in joined.items():
        if number is None:
            number = next(i for i in range(1, len(taken) + 2) if (degree, i) not in taken)
            taken.add((degree, number))
        simplices = np.concatenate(lists)
        tuples = new[simplices]
        found, _ = K._core.find(np.ascontiguousarray(tuples))
        there = found >= 0
        if not there.all():
            notes.append(f"{(~there).sum()} of {len(there)} {_CELLS[degree]} cells of part {name or number!r} are in no simplex")
        whole = degree in (0, K.dimension)
        parts.append((name, number, degree, np.unique(found[there]) if whole else tuples[there].reshape(-1)))
    return parts


def _fields(mesh: Any, is_top: list[bool], K: Complex, notes: list[str]) -> Iterator[tuple[str, bool, int, npt.NDArray[Any]]]:
    """The fields as the compiled half takes them, and a note on what is none."""
    tags = K.vertex_tags
    used = slice(None) if tags is None else tags
    data = [(name, True, values, used) for name, values in getattr(mesh, "point_data", {}).items()]
    for name, lists in getattr(mesh, "cell_data", {}).items():
        values = [np.asarray(block) for block, top in zip(lists, is_top, strict=True) if top]
        if len({block.shape[1:] for block in values}) > 1:
            notes.append(f"cell data {name!r} is left out: it has several numbers of components")
            continue
        data.append((name, False, np.concatenate(values), slice(None)))
        if name not in _TAGS and not name.startswith("gmsh:") and not all(is_top):
            notes.append(f"cell data {name!r} is kept on the cells of dimension {K.dimension} only")
    for name, on_vertices, values, kept in data:
        array = np.asarray(values)
        if name in _TAGS:
            continue
        if name.startswith("gmsh:") or array.dtype.kind not in "fiub":
            notes.append(f"{'point' if on_vertices else 'cell'} data {name!r} is left out")
            continue
        columns = np.ascontiguousarray(array[kept].reshape(len(array[kept]), -1), np.float64)
        if columns.shape[1]:
            yield name, on_vertices, columns.shape[1], columns
