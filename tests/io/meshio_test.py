"""Mesh files against meshio, both ways: what it writes derham reads to the same arrays, and the other way round.

usage: meshio_test.py DERHAM
The arrays pass through .npz files, which convert_test.py compares with numpy on its own.
"""
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy as np
from scipy.spatial import Delaunay

try:
    import meshio
except ImportError:
    print("skipped: the Python package meshio is not installed (scripts/setup test installs it)")
    sys.exit(77)

PROGRAM = sys.argv.pop(1)
READABLE = subprocess.run([PROGRAM, "info", "x", "--format", "?"], capture_output=True, text=True).stderr.split("formats are ")[1]
READABLE = READABLE.strip().split(", ")
NAMES = {1: "line", 2: "triangle", 3: "tetra"}


def mesh_of(dimension, ambient, seed=7):
    """Points over many orders of magnitude, all of them used, and simplices."""
    random = np.random.default_rng(seed)
    if dimension == 1:
        points, rows = random.normal(size=(40, ambient)), np.stack([np.arange(40), (np.arange(40) + 1) % 40], axis=1)
    else:
        parameters = random.uniform(size=(60, dimension))
        rows = Delaunay(parameters).simplices
        points = random.normal(size=(60, ambient))
    return points * 10.0 ** random.integers(-9, 9, size=(len(points), 1)), rows.astype(np.int64)


class Meshio(unittest.TestCase):
    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.directory = pathlib.Path(directory.name)

    def convert(self, source, target, *options):
        done = subprocess.run([PROGRAM, "convert", source, target, "-q", *options], capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, 0, done.stderr)
        return target

    def same(self, points, rows, expected_points, expected_rows, rtol=0.0):
        if points.shape[1] > expected_points.shape[1]:  # many formats hold planar meshes in space only
            self.assertFalse(points[:, expected_points.shape[1]:].any())
            points = points[:, :expected_points.shape[1]]
        np.testing.assert_allclose(points, expected_points, rtol=rtol, atol=0)
        np.testing.assert_array_equal(rows, expected_rows)

    def both_ways(self, extension, dimension, ambient, options=(), data=False, rtol=0.0, **keywords):
        """`rtol` is what meshio loses when it writes."""
        points, rows = mesh_of(dimension, ambient)
        on_points, on_rows = {}, {}
        if data:
            random = np.random.default_rng(1)
            on_points = {"u": random.normal(size=len(points)), "v": random.normal(size=(len(points), 3))}
            on_rows = {"c": [random.normal(size=len(rows))]}

        # From meshio to derham.
        source = self.directory / f"meshio{extension}"
        meshio.Mesh(points, [(NAMES[dimension], rows)], point_data=on_points, cell_data=on_rows).write(source, **keywords)
        read = np.load(self.convert(source, self.directory / "read.npz"))
        self.same(read["points"], read["simplices"], points, rows, rtol)
        if data:
            for name, values in on_points.items():
                np.testing.assert_allclose(read[f"point_data_{name}"], values, rtol=rtol, atol=0)
            np.testing.assert_allclose(read["row_data_c"], on_rows["c"][0], rtol=rtol, atol=0)

        # From derham to meshio.
        arrays = {"points": points, "simplices": rows}
        arrays.update({f"point_data_{name}": values for name, values in on_points.items()})
        arrays.update({f"row_data_{name}": values[0] for name, values in on_rows.items()})
        np.savez(self.directory / "written.npz", **arrays)
        target = self.convert(self.directory / "written.npz", self.directory / f"derham{extension}", *options)
        back = meshio.read(target)
        self.same(back.points, back.cells_dict[NAMES[dimension]], points, rows)
        self.assertEqual(list(back.cells_dict), [NAMES[dimension]])
        if data:
            for name, values in on_points.items():
                np.testing.assert_array_equal(back.point_data[name], values)
            np.testing.assert_array_equal(back.cell_data["c"][0], on_rows["c"][0])

    def need(self, *formats):
        missing = [name for name in formats if name not in READABLE]
        if missing:
            self.skipTest(f"this derham does not read {', '.join(missing)}")

    def test_gmsh(self):
        for version, file_format in (("2.2", "gmsh22"), ("4.1", "gmsh")):
            for binary in (False, True):
                for dimension, ambient in ((1, 3), (2, 3), (3, 3)):
                    with self.subTest(version=version, binary=binary, dimension=dimension):
                        encoding = "--binary" if binary else "--ascii"
                        self.both_ways(".msh", dimension, ambient, ("--gmsh-version", version, encoding), data=True,
                                       file_format=file_format, binary=binary)

    def test_gmsh_physical_groups(self):
        points, rows = mesh_of(3, 3)
        groups = np.arange(len(rows)) % 3 + 1
        names = {"odd": np.array([1, 3]), "even": np.array([2, 3])}
        mesh = meshio.Mesh(points, [("tetra", rows), ("triangle", rows[:5, :3])], field_data=names,
                           cell_data={"gmsh:physical": [groups, np.full(5, 9)], "gmsh:geometrical": [groups, np.full(5, 1)]})
        mesh.write(self.directory / "a.msh", file_format="gmsh22", binary=False)
        read = np.load(self.convert(self.directory / "a.msh", self.directory / "a.npz"))
        found = {}
        for i, number in enumerate(read["part_numbers"]):
            members = read["part_members"][read["part_offsets"][i]:read["part_offsets"][i + 1]]
            found[int(number)] = (int(read["part_degrees"][i]), read["part_names"][i].decode(), list(members))
        for group, name in ((1, "odd"), (2, "even"), (3, "")):
            self.assertEqual(found[group], (3, name, list(np.flatnonzero(groups == group))))
        self.assertEqual(found[9], (2, "", [0, 1, 2, 3, 4]))

    def test_vtk(self):
        self.need("vtk")
        for version in ("4.2", "5.1"):
            for binary in (False, True):
                for dimension, ambient in ((1, 3), (2, 3), (3, 3)):
                    with self.subTest(version=version, binary=binary, dimension=dimension):
                        self.both_ways(".vtk", dimension, ambient, ("--binary" if binary else "--ascii",), data=True,
                                       file_format="vtk42" if version == "4.2" else "vtk51", binary=binary)

    def test_vtu(self):
        self.need("vtu")
        for keywords in ({"binary": False}, {"compression": None}, {"compression": "zlib"}):
            for dimension, ambient in ((1, 3), (2, 3), (3, 3)):
                with self.subTest(**keywords, dimension=dimension):
                    is_text = "binary" in keywords  # meshio writes 12 digits
                    self.both_ways(".vtu", dimension, ambient, ("--ascii",) if is_text else (), data=True,
                                   rtol=1e-11 if is_text else 0.0, **keywords)

    def test_medit(self):
        for dimension, ambient in ((2, 2), (2, 3), (3, 3)):
            with self.subTest(dimension=dimension, ambient=ambient):
                self.both_ways(".mesh", dimension, ambient)

    def test_tetgen(self):
        self.both_ways(".node", 3, 3)

    def test_ply(self):
        for binary in (False, True):
            with self.subTest(binary=binary):
                self.both_ways(".ply", 2, 3, ("--binary" if binary else "--ascii",), binary=binary)

    def test_ply_data(self):
        points, rows = mesh_of(2, 3)
        values = np.linspace(0, 1, len(points))
        meshio.Mesh(points, [("triangle", rows)], point_data={"quality": values}).write(self.directory / "a.ply", binary=True)
        read = np.load(self.convert(self.directory / "a.ply", self.directory / "a.npz"))
        np.testing.assert_array_equal(read["point_data_quality"], values)
        back = meshio.read(self.convert(self.directory / "a.npz", self.directory / "b.ply"))
        np.testing.assert_array_equal(back.point_data["quality"], values)

    def test_off(self):
        self.both_ways(".off", 2, 3)

    def test_obj(self):
        self.both_ways(".obj", 2, 3)

    def test_stl(self):
        """Corners are compared: the format has no vertices. Bytes hold 32-bit numbers."""
        points, rows = mesh_of(2, 3)
        points = points.astype(np.float32).astype(float)
        corners = points[rows]
        for binary in (False, True):
            with self.subTest(binary=binary):
                meshio.Mesh(points, [("triangle", rows)]).write(self.directory / "a.stl", binary=binary)
                read = np.load(self.convert(self.directory / "a.stl", self.directory / "a.npz"))
                np.testing.assert_array_equal(read["points"][read["simplices"]], corners)
                self.assertEqual(len(read["points"]), len(points))
                target = self.convert(self.directory / "a.npz", self.directory / "b.stl", "--binary" if binary else "--ascii")
                back = meshio.read(target)
                np.testing.assert_array_equal(back.points[back.cells_dict["triangle"]], corners)


if __name__ == "__main__":
    unittest.main(verbosity=1)
