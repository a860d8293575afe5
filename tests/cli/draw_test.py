"""Pictures: what is drawn, in which order, and what is refused."""
import pathlib
import re
import xml.etree.ElementTree as xml

from runner import Case, main, run

DOCS = pathlib.Path(__file__).parents[2] / "docs"
# Two obtuse triangles on a common edge, which is not Delaunay.
OBTUSE = "OFF\n4 2 0\n0 0 0\n2 0 0\n1 0.5 0\n1 -0.5 0\n3 0 1 2\n3 1 0 3\n"
TETRAHEDRON = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n"


class Draw(Case):
    def classes(self, svg):
        """How often each kind of line stands in a picture, and how often a triangle."""
        root = xml.fromstring(svg)
        paths = [p for p in root.iter() if p.tag.endswith("path")]
        names = [p.get("class", "triangle") for p in paths]
        return {name: names.count(name) for name in names}

    def test_the_picture_of_the_readme(self):
        mesh = self.generate("box.msh", "box", "--dimension", 2, "--cells", 7, "--jitter", 0.25, "--seed", 3)
        code, _, errors = run("draw", mesh, "--planar", "--width", 420, "--out", self.directory / "box.svg")
        self.assertEqual(code, 0)
        self.assertIn("136 positive (blue), 0 zero (yellow), 25 negative (red)", errors)
        self.assertEqual((self.directory / "box.svg").read_text(), (DOCS / "dual-cells.svg").read_text())

    def test_negative_dual_lengths_are_told_apart(self):
        mesh = self.file("obtuse.off", OBTUSE)
        code, svg, _ = run("draw", mesh, "--planar", "--out", "-")
        self.assertEqual(code, 0)
        self.assertEqual(self.classes(svg), {"triangle": 2, "edge": 6, "negative": 2, "positive": 4})
        code, svg, _ = run("draw", mesh, "--planar", "--mesh-alone", "--out", "-")
        self.assertEqual(self.classes(svg), {"triangle": 2, "edge": 6})

    def test_what_lies_behind_is_drawn_first(self):
        mesh = self.file("tetrahedron.off", TETRAHEDRON)
        code, svg, _ = run("draw", mesh, "--out", "-")
        self.assertEqual(code, 0)
        shades = [int(m) for m in re.findall(r"rgb\((\d+),", svg)]
        self.assertEqual((len(shades), shades[-1], max(shades)), (4, 233, 233))  # the slanted one faces the eye
        kinds = [name if name else "triangle" for name in re.findall(r'<path (?:class="(\w+)")?', svg)]
        # Each triangle before its own lines, and those before the next triangle.
        self.assertEqual([i for i, kind in enumerate(kinds) if kind == "triangle"], [0, 7, 14, 21])
        _, turned, _ = run("draw", mesh, "--up", "x", "--out", "-")
        self.assertNotEqual(svg, turned)

    def test_flat_triangles_have_no_dual_lines(self):
        code, svg, _ = run("draw", self.file("flat.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n"), "--planar", "--out", "-")
        self.assertEqual(code, 0)
        self.assertEqual(self.classes(svg), {"triangle": 1, "edge": 3})
        self.assertNotIn("nan", svg)

    def test_json(self):
        mesh = self.file("obtuse.off", OBTUSE)
        told = self.json("draw", mesh, "--planar", "--out", self.directory / "a.svg")
        self.assertEqual(told["triangles"], 2)
        self.assertEqual(told["dual_edges"], {"negative": 1, "zero": 0, "positive": 4})

    def test_refusals(self):
        box = self.generate("box.msh", "box", "--cells", 1)
        old = self.file("old.svg", "old")
        for mesh, words in [(box, "triangles"), (self.file("a.facets", "0 1 2\n"), "positions")]:
            code, _, errors = run("draw", mesh, "--out", old)
            self.assertEqual(code, 3)
            self.assertIn(words, errors)
        self.assertEqual(run("draw", self.file("o.off", OBTUSE), "--out", old, "--up", "w")[0], 2)
        self.assertEqual(run("draw", self.file("o.off", OBTUSE), "--out", old, "--width", "0")[0], 2)
        self.assertEqual(run("draw", self.file("o.off", OBTUSE), "--out", self.directory / "no" / "a.svg")[0], 4)
        self.assertEqual(old.read_text(), "old")


if __name__ == "__main__":
    main()
