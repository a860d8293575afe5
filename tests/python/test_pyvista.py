"""Meshes for PyVista, if it is installed (it brings VTK, more than 100 MB)."""

from __future__ import annotations

import numpy as np
import pytest

import derham

pyvista = pytest.importorskip("pyvista")


@pytest.mark.parametrize(("n", "vtk_type"), [(1, 3), (2, 5), (3, 10)])
def test_simplices_and_their_volumes(n: int, vtk_type: int) -> None:
    K = derham.generate.box(n, 3, jitter=0.3)
    grid = derham.to_pyvista(K)
    assert grid.n_points == K.size(0) and set(grid.celltypes) == {vtk_type}
    np.testing.assert_array_equal(grid.cells.reshape(-1, n + 2)[:, 1:], K.oriented_simplices())
    np.testing.assert_array_equal(grid.points[:, :n], K.points)
    assert not grid.points[:, n:].any()
    measure = ("Length", "Area", "Volume")[n - 1]
    sizes = grid.compute_cell_sizes(length=n == 1, area=n == 2, volume=n == 3)[measure]
    np.testing.assert_allclose(sizes, K.volumes(n), rtol=1e-6)


def test_vertices_and_surfaces_in_space() -> None:
    points = derham.Complex([(0,), (1,)], points=[(0.0, 1), (2, 3)])
    assert set(derham.to_pyvista(points).celltypes) == {1}
    S = derham.generate.icosphere(2)
    surface = derham.to_pyvista(S).extract_surface(algorithm=None)
    assert surface.n_open_edges == 0 and surface.area == pytest.approx(S.volumes(2).sum())
    surface["u"] = S.points[:, 2]
    assert surface.contour([0.0]).compute_cell_sizes()["Length"].sum() == pytest.approx(2 * np.pi, rel=0.05)


def test_refused() -> None:
    with pytest.raises(derham.GeometryError, match="no points"):
        derham.to_pyvista(derham.generate.klein_bottle())
    with pytest.raises(derham.InputError, match="dimension 4"):
        derham.to_pyvista(derham.generate.box(4, 1))
