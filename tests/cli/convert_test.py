"""derham convert: pairs of formats, what is lost, options, exit codes; and .npz files from and for numpy."""
import json
import subprocess
import zipfile

import numpy as np

from runner import PROGRAM, Case, main, run

SQUARE = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n"
QUAD = "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n"
TETRAHEDRA = np.array([[0, 1, 2, 3], [1, 2, 3, 4]])
POSITIONS = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1 / 3]])


class Convert(Case):
    def convert(self, source, target, *options):
        return self.json("convert", source, self.directory / target, *options)

    def test_surfaces_there_and_back(self):
        source = self.file("a.off", SQUARE)
        for target in ("b.ply", "b.obj", "b.msh", "b.npz", "b.stl"):
            summary = self.convert(source, target)
            self.assertEqual((summary["vertices"], summary["top_simplices"], summary["dimension"]), (4, 2, 2))
            self.convert(self.directory / target, "c.off")
            self.assertEqual((self.directory / "c.off").read_text(), SQUARE, target)

    def test_encodings(self):
        source = self.file("a.off", SQUARE)
        self.convert(source, "b.ply")
        self.assertIn(b"binary_little_endian", (self.directory / "b.ply").read_bytes())
        self.convert(source, "b.ply", "--ascii")
        self.assertIn(b"format ascii", (self.directory / "b.ply").read_bytes())
        self.convert(source, "b.stl", "--binary")
        self.assertEqual((self.directory / "b.stl").stat().st_size, 84 + 2 * 50)
        self.convert(source, "b.stl", "--ascii")
        self.assertTrue((self.directory / "b.stl").read_text().startswith("solid"))

    def test_formats_by_option(self):
        source = self.file("a.anything", SQUARE)
        summary = self.convert(source, "b.off", "--from", "off", "--to", "obj")
        self.assertEqual(summary["format"], "obj")
        self.assertTrue((self.directory / "b.off").read_text().startswith("v "))
        self.assertEqual(self.convert(source, "b.obj", "--format", "off")["format"], "obj")
        self.assertIn("unknown format", run("convert", source, self.directory / "b.obj", "--format", "nonsense")[2])
        self.assertIn("--from,--format", run("convert", "--help")[1])
        code, out, _ = run("convert", "-", "-", "--to", "off", "-q", stdin=SQUARE)
        self.assertEqual((code, out), (0, SQUARE))

    def test_what_is_lost_is_said(self):
        numbers = np.array([1 / 3, 2, 3, 4])
        np.savez(self.directory / "a.npz", simplices=[[0, 1, 2], [0, 2, 3]], points=POSITIONS[:4] / 3, point_data_u=numbers,
                 lower_1=[[0, 1]], part_numbers=[7], part_degrees=[1], part_offsets=[0, 1], part_members=[0],
                 form_w_1_primal=numbers)
        lost = " ".join(self.convert(self.directory / "a.npz", "b.stl")["not_carried"])
        for what in ("parts (1)", "lower dimension (1)", "fields (1)", "forms (1)", "32-bit", "order of vertices"):
            self.assertIn(what, lost)
        code, _, errors = run("convert", self.directory / "a.npz", self.directory / "b.obj")
        self.assertEqual(code, 0)
        self.assertIn("format obj does not hold parts (1)", errors)
        self.assertEqual(self.convert(self.directory / "a.npz", "c.npz")["not_carried"], [])

    def test_reading_options(self):
        quad = self.file("q.off", QUAD)
        error = self.json("convert", quad, self.directory / "b.off", code=3)["error"]
        self.assertEqual(error["line"], 7)
        self.assertIn("--triangulate", error["message"])
        summary = self.convert(quad, "b.off", "--triangulate")
        self.assertEqual(summary["notes"], ["split 1 polygon into 2 triangles, fans about first vertices"])
        self.assertEqual((self.directory / "b.off").read_text(), SQUARE)
        for command in ("info", "check"):
            self.json(command, quad, "--triangulate")
        self.assertEqual(self.json("info", quad, "--triangulate", "--planar")["ambient_dimension"], 2)
        self.assertEqual(self.json("operators", quad, "--triangulate", "--out", self.directory / "o")["stars"], True)
        unused = self.file("u.off", SQUARE.replace("4 2 0", "5 2 0").replace("\n3 0 1 2", "\n9 9 9\n3 0 1 2"))
        self.assertEqual(self.convert(unused, "b.off")["vertices"], 5)
        self.assertEqual(self.convert(unused, "b.off", "--drop-unused")["dropped_vertices"], 1)
        self.assertEqual((self.directory / "b.off").read_text(), SQUARE)

    def test_reorder(self):
        """The same mesh with other numbers; npz keeps what they were, and the way back gives the first mesh."""
        source = self.generate("a.npz", "box", "--cells", 4)
        for extension in (".npz", ".msh", ".facets"):
            summary = self.convert(source, "b" + extension, "--reorder")
            self.assertEqual(summary["reordered"]["method"], "Hilbert")
            self.assertEqual((summary["vertices"], summary["top_simplices"]), (125, 384))
        self.assertIn("vertex_tags", " ".join(self.convert(source, "b.msh", "--reorder")["not_carried"]))
        self.assertIsNone(self.convert(source, "c.npz")["reordered"])
        self.convert(source, "c.facets")
        summary = self.convert(self.directory / "c.facets", "d.facets", "--reorder")
        self.assertEqual(summary["reordered"]["method"], "reverse Cuthill-McKee")
        plain, other = self.json("info", source), self.json("info", self.directory / "b.npz")
        for key in ("simplices", "boundary_simplices", "euler_characteristic", "manifold", "delaunay", "inverted"):
            self.assertEqual(plain[key], other[key], key)
        self.assertAlmostEqual(plain["volume"], other["volume"])
        empty = self.file("empty.off", "OFF\n0 0 0\n")
        self.assertIsNone(self.convert(empty, "e.off", "--reorder")["reordered"])

    def test_refusals(self):
        source = self.file("a.off", SQUARE)
        target = self.directory / "b.off"
        for arguments in ((source, self.directory / "b.unknown"), (source, "-"), (source, target, "--to", "offf"),
                          (source, target, "--from", "nonsense"), (source, target, "--binary"),
                          (source, self.directory / "b.ply", "--binary", "--ascii"), (source, target, "--gmsh-version", "2.2"),
                          (source, self.directory / "b.msh", "--gmsh-version", "3"), (source,)):
            self.assertEqual(run("convert", *arguments)[0], 2, arguments)
        self.assertIn("did you mean 'off'", run("convert", source, target, "--to", "offf")[2])
        self.assertEqual(run("convert", self.directory / "missing.off", target)[0], 3)
        tetrahedron = self.file("t.facets", "0 1 2 3\n")
        error = self.json("convert", tetrahedron, target, code=4)["error"]
        self.assertEqual(error["kind"], "input")
        self.assertIn("positions", error["message"])
        self.assertEqual(run("convert", source, self.directory / "no" / "b.off")[0], 4)
        self.assertFalse(target.exists())


class Numpy(Case):
    def test_numpy_reads_what_derham_writes(self):
        box = self.generate("box.npz", "box", "--cells", 3)
        arrays = np.load(box)
        self.assertEqual(sorted(arrays.files), ["points", "simplices"])
        self.assertEqual((arrays["points"].shape, arrays["points"].dtype), ((64, 3), np.float64))
        self.assertEqual((arrays["simplices"].shape, arrays["simplices"].dtype.kind), ((162, 4), "i"))
        self.assertTrue(np.array_equal(np.unique(arrays["simplices"]), np.arange(64)))
        with zipfile.ZipFile(box) as archive:
            self.assertIsNone(archive.testzip())
        torus = np.load(self.generate("periodic.npz", "periodic-box", "--cells", 3, "--dimension", 2))
        self.assertEqual(torus["corners"].shape, (18, 3, 2))
        self.assertEqual(int(torus["vertex_count"]), 9)
        self.assertAlmostEqual(self.json("info", self.directory / "periodic.npz")["volume"], 1, places=12)

    def test_derham_reads_what_numpy_writes(self):
        flux = np.arange(9.0)
        for number, save in enumerate((np.savez, np.savez_compressed)):
            for types in ("<i4", ">i8", "u2"):
                source, target = self.directory / f"a{number}.npz", self.directory / "b.npz"
                save(source, simplices=np.asfortranarray(TETRAHEDRA.astype(types)), points=np.asfortranarray(POSITIONS),
                     point_data_u=np.arange(10.0).reshape(5, 2), row_data_r=np.array([1.5, np.nan]), row_tags=[5, 6],
                     form_flux_1_primal=flux, part_numbers=[3], part_names=["Öl"], part_degrees=[3], part_offsets=[0, 2],
                     part_members=[0, 1], other=[1])
                summary = self.json("convert", source, target)
                self.assertEqual(summary["notes"], ["skipped the array 'other'"])
                back = np.load(target)
                self.assertTrue(np.array_equal(back["simplices"], TETRAHEDRA))
                self.assertTrue(np.array_equal(back["points"], POSITIONS))
                self.assertTrue(np.array_equal(back["point_data_u"], np.arange(10.0).reshape(5, 2)))
                self.assertTrue(np.array_equal(back["row_data_r"], [1.5, np.nan], equal_nan=True))
                self.assertTrue(np.array_equal(back["form_flux_1_primal"], flux))
                self.assertEqual(back["part_names"][0].decode(), "Öl")
                self.assertTrue(np.array_equal(back["row_tags"], [5, 6]))

    def test_arrays_can_be_mapped(self):
        box = self.generate("box.npz", "box", "--cells", 2)
        with zipfile.ZipFile(box) as archive:
            for entry in archive.infolist():
                with open(box, "rb") as file:
                    file.seek(entry.header_offset + 26)
                    name, extra = np.frombuffer(file.read(4), "<u2")
                start = entry.header_offset + 30 + int(name) + int(extra)
                self.assertEqual((entry.compress_type, start % 64), (zipfile.ZIP_STORED, 0))

    def test_infos_of_parts(self):
        np.savez(self.directory / "a.npz", simplices=TETRAHEDRA, points=POSITIONS, lower_2=[[0, 1, 2], [0, 1, 4]],
                 part_numbers=[1, 9], part_names=["a solid", "line\n\"quoted\""], part_degrees=[3, 2], part_offsets=[0, 2, 3],
                 part_members=[0, 1, 1])
        info = self.json("info", self.directory / "a.npz")
        self.assertEqual(info["parts"], [{"name": "a solid", "number": 1, "dimension": 3, "count": 2},
                                         {"name": "line\n\"quoted\"", "number": 9, "dimension": 2, "count": 1}])
        self.assertEqual((info["lower_simplices"], info["not_faces"]), (2, 1))
        text = run("info", self.directory / "a.npz")[1]
        self.assertIn('"line\\n\\"quoted\\"", number 9: 1 simplices of dimension 2', text)
        self.assertIn("lower simplices  2, 1 of them no faces of the complex", text)


if __name__ == "__main__":
    main()
