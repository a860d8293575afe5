"""The matrices that `operators` writes, checked again by scipy against the file alone."""
import itertools

import numpy as np
import scipy.io
import scipy.sparse as sp
import scipy.spatial

from runner import Case, main, run


def read(directory):
    """Simplices by degree, signs of the top ones, and the matrices of one output directory."""
    n = max(int(p.stem[9:]) for p in directory.glob("simplices*.txt"))
    simplices, signs = [], None
    for k in range(n + 1):
        rows = [line.split() for line in (directory / f"simplices{k}.txt").read_text().splitlines()]
        if k == n:
            signs = np.array([{"+1": 1, "-1": -1}[row[0]] for row in rows])
            rows = [row[1:] for row in rows]
        simplices.append([tuple(map(int, row)) for row in rows])
    d = [sp.csr_matrix(scipy.io.mmread(directory / f"d{k}.mtx")) for k in range(n)]
    boundary = [None] + [sp.csr_matrix(scipy.io.mmread(directory / f"boundary{k}.mtx")) for k in range(1, n + 1)]
    star = None
    if (directory / "star0.mtx").exists():
        star = [np.atleast_1d(scipy.io.mmread(directory / f"star{k}.mtx").squeeze()) for k in range(n + 1)]
    return simplices, signs, d, boundary, star


def boundary_by_definition(simplices, signs, k):
    """The chapter's assembly: entry S(representative)(-1)^i."""
    index = {s: i for i, s in enumerate(simplices[k - 1])}
    matrix = sp.lil_matrix((len(simplices[k - 1]), len(simplices[k])), dtype=int)
    for column, simplex in enumerate(simplices[k]):
        sign = signs[column] if k == len(simplices) - 1 else 1
        for i in range(k + 1):
            matrix[index[simplex[:i] + simplex[i + 1:]], column] = sign * (-1) ** i
    return sp.csr_matrix(matrix)


class Operators(Case):
    meshes = {
        "box": ("box.msh", ["box", "--cells", 3, "--jitter", 0.2], 0),
        "square": ("square.node", ["box", "--dimension", 2, "--cells", 5, "--jitter", 0.3], 0),
        "line": ("line.msh", ["box", "--dimension", 1, "--cells", 5], 0),
        "sphere": ("sphere.off", ["sphere", "--level", 1], 0),
        "solid torus": ("solid.msh", ["solid-torus", "--rings", 1, "--segments", 8], 0),
        "example": ("example.msh", ["example"], 0),
        "box of dimension 4": ("box4.facets", ["box", "--dimension", 4, "--cells", 1], 1),
        "boundary of a 7-simplex": ("sphere6.facets", ["simplex-boundary", "--dimension", 6], 1),
    }

    def test_matrices(self):
        for name, (file, recipe, code) in self.meshes.items():
            with self.subTest(name):
                mesh = self.generate(file, *recipe)
                out = self.directory / ("out " + name)
                found, _, errors = run("operators", mesh, "--out", out)
                self.assertEqual(found, code, errors)
                simplices, signs, d, boundary, star = read(out)
                n = len(simplices) - 1
                for k in range(n):  # closed under faces, sorted, in lexicographic order
                    self.assertEqual(simplices[k], sorted({face for s in simplices[n] for face in itertools.combinations(s, k + 1)}))
                for k in range(1, n + 1):
                    self.assertEqual((boundary[k] != boundary_by_definition(simplices, signs, k)).nnz, 0)
                    self.assertEqual((d[k - 1] != boundary[k].T).nnz, 0)
                    if k >= 2:
                        self.assertEqual(abs(boundary[k - 1] @ boundary[k]).sum(), 0)
                rows = abs(boundary[n]).sum(axis=1).A1, boundary[n].sum(axis=1).A1
                self.assertTrue(np.all(rows[1][rows[0] == 2] == 0), "interior facets cancel")
                self.assertEqual(star is None, code == 1)

    def test_laplacian_of_the_coordinates_vanishes_inside(self):
        mesh = self.generate("box.msh", "box", "--cells", 4, "--jitter", 0.2)
        self.assertEqual(run("operators", mesh, "--out", self.directory / "out")[0], 0)
        simplices, signs, d, boundary, star = read(self.directory / "out")
        lines = mesh.read_text().split("$Nodes\n")[1].split("\n")
        points = np.array([line.split()[1:] for line in lines[1:1 + int(lines[0])]], dtype=float)
        weak = d[0].T @ sp.diags(star[1]) @ d[0] @ points
        rim = np.flatnonzero(abs(boundary[3]).sum(axis=1).A1 == 1)
        inside = np.setdiff1d(np.arange(len(points)), [v for f in rim for v in simplices[2][f]])
        self.assertLess(abs(weak[inside]).max(), 1e-12)
        self.assertAlmostEqual(star[0].sum(), 1, places=12)
        self.assertAlmostEqual((1 / star[3]).sum(), 1, places=12)
        # the flux of x/3 through the faces of every tetrahedron is its positive volume
        flux = np.array([np.dot(points[list(t)].mean(axis=0) / 3, np.cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]])) / 2
                         for t in simplices[2]])
        self.assertLess(abs(d[2] @ flux - 1 / star[3]).max(), 1e-14)

    def test_dual_volumes_of_interior_vertices_are_voronoi_cells(self):
        for n, count in ((2, 60), (3, 60)):
            points = np.random.default_rng(n).random((count, n))
            simplices = scipy.spatial.Delaunay(points).simplices
            self.file(f"delaunay{n}.node", f"{count} {n} 0 0\n" + "".join(
                f"{i} " + " ".join(map(repr, map(float, p))) + "\n" for i, p in enumerate(points)))
            mesh = self.file(f"delaunay{n}.ele", f"{len(simplices)} {n + 1} 0\n" + "".join(
                f"{i} " + " ".join(map(str, t)) + "\n" for i, t in enumerate(simplices)))
            self.assertEqual(run("operators", mesh, "--out", self.directory / f"out{n}")[0], 0)
            lists, _, _, boundary, star = read(self.directory / f"out{n}")
            rim = np.flatnonzero(abs(boundary[n]).sum(axis=1).A1 == 1)
            interior = np.setdiff1d(np.arange(count), [v for f in rim for v in lists[n - 1][f]])
            self.assertGreater(len(interior), 10)
            voronoi = scipy.spatial.Voronoi(points)
            for v in interior:
                cell = voronoi.vertices[voronoi.regions[voronoi.point_region[v]]]
                volume = scipy.spatial.ConvexHull(cell).volume
                self.assertLess(abs(star[0][v] - volume), 1e-9 * volume)

    def test_without_orientation(self):
        mesh = self.file("moebius.off", "OFF\n5 5 0\n" + "".join(f"{i} {i*i} {i**3}\n" for i in range(5))
                         + "".join(f"3 {i} {(i+1)%5} {(i+2)%5}\n" for i in range(5)))
        code, _, errors = run("operators", mesh, "--out", self.directory / "out")
        self.assertEqual(code, 1)
        self.assertIn("orient", errors)
        simplices, signs, d, boundary, star = read(self.directory / "out")
        self.assertTrue(np.all(signs == 1))
        self.assertIsNone(star)

    def test_any_order_of_the_corners_gives_the_same_matrices(self):
        mesh = self.generate("box.msh", "box", "--cells", 2, "--jitter", 0.1)
        head, tail = mesh.read_text().split("$Elements\n")
        lines = tail.split("\n")
        shuffled = []
        for i, line in enumerate(lines[1:1 + int(lines[0])]):
            words = line.split()
            corners = words[-4:]
            order = list(itertools.permutations(range(4)))[i % 24]
            shuffled.append(" ".join(words[:-4] + [corners[j] for j in order]))
        other = self.file("other.msh", head + "$Elements\n" + "\n".join([lines[0]] + shuffled + lines[1 + int(lines[0]):]))
        for path, out in ((mesh, "a"), (other, "b")):
            self.assertEqual(run("operators", path, "--out", self.directory / out)[0], 0)
        for file in sorted((self.directory / "a").iterdir()):
            a, b = file.read_bytes(), (self.directory / "b" / file.name).read_bytes()
            if not file.name.startswith("star"):
                self.assertEqual(a, b, file.name)
        self.same_stars(read(self.directory / "a")[4], read(self.directory / "b")[4])

    def same_stars(self, a, b):
        self.assertEqual(len(a), len(b))
        for k, (one, other) in enumerate(zip(a, b)):
            self.assertEqual(one.shape, other.shape)
            self.assertLess(abs(one - other).max() / abs(one).max(), 1e-12, f"star{k}")

    def test_any_order_of_the_corners_of_a_surface_changes_only_the_sign_of_components(self):
        sphere = self.generate("sphere.off", "sphere", "--level", 1).read_text().split("\n")
        points, rows = sphere[2:44], [line.split()[1:] for line in sphere[44:124]]
        far = [" ".join([str(float(line.split()[0]) + 5)] + line.split()[1:]) for line in points]
        two = rows + [[str(int(v) + 42) for v in row] for row in rows]
        for components, positions, tuples in ((1, points, rows), (2, points + far, two)):
            for shift in range(3):
                with self.subTest(components=components, shift=shift):
                    orders = list(itertools.permutations(range(3)))  # even, odd, odd, even, even, odd
                    other = [[row[j] for j in orders[(5 * i + shift + i // 80) % 6]] for i, row in enumerate(tuples)]
                    found = []
                    for name, triangles in (("a", tuples), ("b", other)):
                        text = f"OFF\n{len(positions)} {len(triangles)} 0\n" + "\n".join(positions) + "\n"
                        mesh = self.file(f"{name}.off", text + "".join(f"3 {' '.join(row)}\n" for row in triangles))
                        out = self.directory / f"{components} {shift} {name}"
                        self.assertEqual(run("operators", mesh, "--out", out)[0], 0)
                        found.append(read(out))
                    (simplices, signs, d, boundary, star), (simplices_b, signs_b, d_b, boundary_b, star_b) = found
                    self.assertEqual(simplices, simplices_b)
                    self.assertEqual((d[0] != d_b[0]).nnz, 0)
                    self.assertEqual((boundary[1] != boundary_b[1]).nnz, 0)
                    flips = [set(signs[80 * c:80 * (c + 1)] * signs_b[80 * c:80 * (c + 1)]) for c in range(components)]
                    self.assertTrue(all(len(flip) == 1 for flip in flips), flips)
                    flip = sp.diags(np.repeat([int(f.pop()) for f in flips], 80))
                    self.assertEqual(abs(boundary[2] @ flip - boundary_b[2]).sum(), 0)
                    self.assertEqual(abs(flip @ d[1] - d_b[1]).sum(), 0)
                    self.assertEqual(signs_b[0] != signs[0], shift in (1, 2), "the first row is reflected")
                    self.same_stars(star, star_b)


if __name__ == "__main__":
    main()
