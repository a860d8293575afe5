"""Reading and writing, generators, the command line."""

from __future__ import annotations

import inspect
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

import derham

DATA = Path(__file__).parents[2] / "data"


@pytest.mark.parametrize("name", ["m.msh", "m.vtu", "m.node", "m.npz", "m.mesh", "m.vtk"])
def test_round_trip(tmp_path: Path, name: str) -> None:
    K = derham.generate.box(3, 2, jitter=0.2)
    K.write(tmp_path / name)
    L = derham.read(tmp_path / name)
    assert (K.simplices(3) == L.simplices(3)).all() and (K.signs == L.signs).all()
    np.testing.assert_array_equal(K.points, L.points)


def test_periodic_mesh_and_facets(tmp_path: Path) -> None:
    K = derham.generate.bcc_lattice(3)
    K.write(tmp_path / "m.npz")
    np.testing.assert_array_equal(derham.read(tmp_path / "m.npz").star(2).diagonal(), K.star(2).diagonal())
    M = derham.generate.moebius_strip()
    M.write(tmp_path / "m.facets")
    assert derham.read(tmp_path / "m.facets").sizes == M.sizes


@pytest.mark.skipif(not DATA.is_dir(), reason="the meshes of the repository are not there")
def test_meshes_of_the_repository() -> None:
    paths = [p for p in sorted(DATA.rglob("*")) if p.suffix in {".off", ".obj", ".msh", ".mesh", ".vtu", ".vtk", ".ele"}]
    assert paths
    for path in paths:
        K = derham.read(path, drop_unused=True)
        assert K.size(0) > 0


def test_every_generator_makes_a_sound_complex() -> None:
    arguments = {
        "box": (3, 2), "periodic_box": (2, 3), "ball": (2, 2), "icosphere": (1,), "torus": (5, 4), "solid_torus": (1, 4),
        "clifford_torus": (3, 3), "a_star_lattice": (2, 3), "bcc_lattice": (3,), "voxels": ("2x2x1",), "cycle": (4,),
        "path": (3,), "sphere": (2,), "lens_space": (3, 1), "grid_torus": (2,), "regular_simplex": (3,),
        "simplex_boundary": (2,), "cross_polytope": (2,),
    }
    made = 0
    for name, function in inspect.getmembers(derham.generate, inspect.isfunction):
        if function.__module__ != "derham.generate" or name.startswith("_"):
            continue
        if name in {"disjoint_union", "product", "cone", "suspension", "barycentric_subdivision"}:
            continue
        K = function(*arguments.get(name, ()))
        assert K.check().verdict == "yes", name
        assert function.__doc__
        made += 1
    assert made >= 25


def test_constructions() -> None:
    g = derham.generate
    assert g.cone(g.csaszar_torus()).check().verdict == "no"
    assert g.suspension(g.sphere(1)).euler_characteristic == 2
    assert g.disjoint_union(g.sphere(2), g.sphere(2)).components == 2
    assert g.barycentric_subdivision(g.regular_simplex(2)).size(2) == 6
    assert g.product(g.cycle(3), g.cycle(3)).euler_characteristic == 0


def test_oriented_simplices(tmp_path: Path) -> None:
    K = derham.generate.box(3, 2)
    rows = K.oriented_simplices()
    corners = K.points[rows]
    assert (np.linalg.det(corners[:, 1:] - corners[:, :1]) > 0).all()
    assert (K.signs < 0).any() and (derham.Complex(rows).signs == K.signs).all()


def test_command_line() -> None:
    found = subprocess.run([sys.executable, "-m", "derham", "--version"], capture_output=True, text=True)
    if found.returncode and "not part of this installation" in found.stderr:
        pytest.skip("built without the command line")
    assert found.stdout == f"derham {derham.__version__}\n"
    bad = subprocess.run([sys.executable, "-m", "derham", "no-command"], capture_output=True, text=True)
    assert bad.returncode == 2 and "there is no command" in bad.stderr


def test_a_boundary_can_be_written(tmp_path: Path) -> None:
    B = derham.generate.box(3, 2).boundary_complex()[0]
    B.write(tmp_path / "b.off")
    np.testing.assert_array_equal(derham.read(tmp_path / "b.off").points, B.points)


def test_pictures_of_forms(tmp_path: Path) -> None:
    """Read by VTK, for which they are: meshio reads binary ones only where the base64 of Python stops at padding."""
    pyvista = pytest.importorskip("pyvista")
    K = derham.generate.box(2, 2)
    u, w, q = K.points[:, 0], np.arange(16.0), np.arange(8.0)
    K.write_forms(tmp_path / "forms.vtu", {"u": (u, 0), "w": (w, 1), "q": (q, 0, "dual")})
    grid = pyvista.read(tmp_path / "forms.vtu")
    np.testing.assert_array_equal(grid.point_data["u"], u)
    np.testing.assert_array_equal(grid.cell_data["w"][grid.celltypes == pyvista.CellType.LINE], w)
    np.testing.assert_array_equal(grid.cell_data["q"][grid.celltypes == pyvista.CellType.TRIANGLE], q)
    with pytest.raises(derham.InputError, match="u has shape"):
        K.write_forms(tmp_path / "forms.vtu", {"u": (w, 0)})
    with pytest.raises(derham.GeometryError, match="no points"):
        derham.generate.klein_bottle().write_forms(tmp_path / "k.vtu", {})


def test_pictures_over_time(tmp_path: Path) -> None:
    K, pictures = derham.generate.box(2, 2), []
    for step in range(3):
        pictures.append((0.1 * step, Path(f"heat_{step}.vtu")))
        K.write_forms(tmp_path / pictures[-1][1], {"u": (step * K.points[:, 0], 0)})
    derham.write_series(tmp_path / "heat.pvd", pictures)
    entries = ElementTree.parse(tmp_path / "heat.pvd").getroot().findall("Collection/DataSet")
    assert [(float(e.attrib["timestep"]), e.attrib["file"]) for e in entries] == [(t, str(path)) for t, path in pictures]
    for wrong, message in (([(float("nan"), "a")], "time"), ([(0, "")], "empty|name"), (5, "expected pairs"), ([(0,)], "pairs")):
        with pytest.raises(derham.InputError, match=message):
            derham.write_series(tmp_path / "heat.pvd", wrong)  # type: ignore[arg-type]
    with pytest.raises(FileNotFoundError):
        derham.write_series(tmp_path / "nowhere" / "heat.pvd", pictures)
