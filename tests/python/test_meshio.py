"""Meshes from and to meshio, with their tags and data."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import derham


class Block:
    def __init__(self, type: str, data: np.ndarray) -> None:
        self.type, self.data = type, data


class Other:
    """What meshio.Mesh has of interest."""

    def __init__(self, points: np.ndarray, cells: list[Block]) -> None:
        self.points, self.cells = points, cells


def test_meshes_of_meshio() -> None:
    points = np.array([(9, 9, 9), (0, 0, 0), (1, 0, 0), (0, 1, 0)])
    K = derham.from_meshio(Other(points, [Block("line", np.array([[1, 2]])), Block("triangle", np.array([[1, 2, 3]]))]),
                           planar=True)
    assert K.sizes == (3, 3, 1) and K.ambient_dimension == 2
    with pytest.raises(derham.InputError, match="'quad'; expected"):
        derham.from_meshio(Other(points, [Block("quad", np.array([[0, 1, 2, 3]]))]))
    for wrong in (-1, 4):
        with pytest.raises(derham.InputError, match=f"vertex {wrong}; expected 0 to 3"):
            derham.from_meshio(Other(points, [Block("line", np.array([[1, wrong]]))]))
    meshio = pytest.importorskip("meshio")
    L = derham.generate.ball(3, 2)
    mesh = derham.to_meshio(L)
    assert isinstance(mesh, meshio.Mesh)
    M = derham.from_meshio(mesh)
    assert (M.signs == L.signs).all() and (M.simplices(2) == L.simplices(2)).all() and (M.points == L.points).all()
    with pytest.raises(derham.GeometryError, match="no points"):
        derham.to_meshio(derham.generate.klein_bottle())


def tagged_square() -> derham.Complex:
    """The unit square in two regions, a boundary of two parts, a corner; fields."""
    K = derham.generate.box(2, 4, jitter=0.2)
    x, y = K.points[K.simplices(2)].mean(axis=1).T
    ends = K.points[K.simplices(1)]
    return K.with_data(
        parts={
            "left": (np.flatnonzero(x < 0.5), 2),
            "right": (np.flatnonzero(x >= 0.5), 2),
            "inlet": (np.flatnonzero((ends[:, :, 0] == 0).all(axis=1)), 1),
            "outlet": K.simplices(1)[(ends[:, :, 0] == 1).all(axis=1)][:, ::-1],
            "corner": [[0]],
        },
        vertex_fields={"u": K.points[:, 0], "v": K.points},
        simplex_fields={"rho": y},
    )


def same_data(K: derham.Complex, L: derham.Complex) -> None:
    assert {(p.name, p.degree, p.count) for p in K.parts} == {(p.name, p.degree, p.count) for p in L.parts}
    for part in K.parts:
        np.testing.assert_array_equal(K.tagged_chain(part.name), L.tagged_chain(part.name))
        np.testing.assert_array_equal(K.tagged_simplices(part.name), L.tagged_simplices(part.name))
    for ours, theirs in ((K.vertex_fields, L.vertex_fields), (K.simplex_fields, L.simplex_fields)):
        assert ours.keys() == theirs.keys()
        for name, values in ours.items():
            np.testing.assert_array_equal(values, theirs[name])


def test_tags_and_data_come_along() -> None:
    pytest.importorskip("meshio")
    K = tagged_square()
    mesh = derham.to_meshio(K)
    assert mesh.field_data["inlet"].tolist() == [1, 1] and mesh.cell_sets_dict["outlet"]["line"].size == 4
    L = derham.from_meshio(mesh)
    same_data(K, L)
    assert not L.vertex_tags and L.notes == ("cell data 'rho' is kept on the cells of dimension 2 only",)


def test_parts_that_overlap_are_sets() -> None:
    pytest.importorskip("meshio")
    K = tagged_square().with_data(parts={"all": (np.arange(32), 2)})
    mesh = derham.to_meshio(K)
    assert "gmsh:physical" not in mesh.cell_data
    same_data(K, derham.from_meshio(mesh))


def test_through_a_gmsh_file_of_meshio(tmp_path: Path) -> None:
    meshio = pytest.importorskip("meshio")
    mesh = derham.to_meshio(tagged_square())
    mesh.cell_data["gmsh:geometrical"] = mesh.cell_data["gmsh:physical"]
    del mesh.point_data["v"], mesh.cell_data["rho"]  # Gmsh has neither two components nor NaN
    meshio.write(tmp_path / "square.msh", mesh, "gmsh22")  # binary: as text it writes np.float64(0.0)
    same_data(derham.read(tmp_path / "square.msh", planar=True),
              derham.from_meshio(meshio.read(tmp_path / "square.msh"), planar=True))


def test_what_our_gmsh_files_say_to_meshio(tmp_path: Path) -> None:
    meshio = pytest.importorskip("meshio")
    K = tagged_square()
    L = derham.Complex(K.simplices(2), K.points).with_data(  # meshio wants values on all cells, if on any
        parts={part.name: K.tagged_simplices(part.name) for part in K.parts}, vertex_fields={"u": K.points[:, 0]})
    L.write(tmp_path / "square.msh", binary=False)
    same_data(L, derham.from_meshio(meshio.read(tmp_path / "square.msh"), planar=True))


def test_what_has_no_place_is_noted() -> None:
    meshio = pytest.importorskip("meshio")
    points = np.array([(0.0, 0), (9, 9), (1, 0), (0, 1), (1, 1)])
    mesh = meshio.Mesh(
        points,
        [("triangle", np.array([[0, 2, 3]])), ("line", np.array([[0, 2], [0, 1], [2, 4]])), ("triangle", np.array([[2, 4, 3]]))],
        point_data={"t": np.arange(5.0), "gmsh:dim_tags": np.zeros((5, 2), int), "c": np.zeros(5, complex)},
        cell_data={"medit:ref": [np.array([7]), np.array([5, 5, 0]), np.array([8])]},
        point_sets={"tips": np.array([1, 4])},
    )
    K = derham.from_meshio(mesh)
    assert K.vertex_tags.tolist() == [0, 2, 3, 4]
    assert [(p.number, p.degree, p.count) for p in K.parts] == [(7, 2, 1), (5, 1, 1), (8, 2, 1), (1, 0, 1)]
    np.testing.assert_array_equal(K.tagged_simplices(5), [[0, 1]])
    np.testing.assert_array_equal(K.vertex_fields["t"], [0, 2, 3, 4])
    assert K.notes == (
        "point data 'gmsh:dim_tags' is left out",
        "point data 'c' is left out",
        "1 of 2 line cells of part 5 are in no simplex",
        "1 of 2 vertex cells of part 'tips' are in no simplex",
    )
