"""The command line: verdicts, exit codes, JSON, refusals."""
import json
import os
import signal
import subprocess

from runner import PROGRAM, Case, main, run

MOEBIUS = "0 1 2\n1 2 3\n2 3 4\n3 4 0\n4 0 1\n"
# The Poincaré sphere (Björner & Lutz 2000): one tetrahedron a word, one vertex a hexadecimal digit.
POINCARE = """
    0138 013e 015d 015e 018d 023b 023e 0269 026b 029e 038b 045c 045d 047a 047c 04ad 05ce 0679
    067a 06ab 079c 08ab 08ad 09ce 1249 124a 1269 126c 12ac 138c 13ac 13ae 147a 147b 149b 159b
    159d 15be 168c 168d 169d 17ae 17be 234d 234e 23bd 249e 24ad 26bc 2acd 2bcd 3456 345d 346e
    356a 359a 359d 36ae 378b 378c 379c 379d 37bd 39ac 456c 468c 468e 478b 478c 489b 489e 56ab
    56bc 59ab 5bce 679d 67ae 67de 68de 7bde 89ab 89af 89ef 8adf 8def 9acf 9cef acdf bcde cdef
"""


class Info(Case):
    def test_box(self):
        info = self.json("info", self.generate("box.msh", "box", "--cells", 4))
        self.assertEqual(info["dimension"], 3)
        self.assertEqual(info["ambient_dimension"], 3)
        self.assertEqual(info["simplices"], [125, 604, 864, 384])
        self.assertEqual(info["boundary_simplices"], [98, 288, 192, 0])
        self.assertEqual(info["euler_characteristic"], 1)
        self.assertEqual(info["components"], 1)
        self.assertIs(info["orientable"], True)
        self.assertEqual(info["manifold"], "yes")
        self.assertIs(info["closed"], False)
        self.assertAlmostEqual(info["volume"], 1, places=12)
        self.assertEqual((info["inverted"], info["degenerate"]), (0, 0))
        self.assertIs(info["delaunay"], True)
        self.assertIs(info["well_centered"], False)
        self.assertEqual([s["zero"] for s in info["star"]], [0, 304, 384, 0])
        self.assertEqual([s["negative"] for s in info["star"]], [0, 0, 0, 0])
        self.assertEqual(len(info["star"]), 4)

    def test_abstract_meshes_have_no_metric(self):
        info = self.json("info", self.file("moebius.facets", MOEBIUS))
        self.assertEqual(info["simplices"], [5, 10, 5])
        self.assertIs(info["orientable"], False)
        self.assertEqual(info["manifold"], "yes")
        self.assertIs(info["closed"], False)
        for key in ("ambient_dimension", "volume", "inverted", "degenerate", "delaunay", "well_centered", "star"):
            self.assertIsNone(info[key], key)

    def test_every_dimension(self):
        for n in range(7):
            simplex = " ".join(str(v) for v in range(n + 1)) + "\n"
            info = self.json("info", "-", "--format", "facets", stdin=simplex)
            self.assertEqual(info["dimension"], n)
            self.assertEqual(len(info["simplices"]), n + 1)
            self.assertEqual(info["manifold"], "yes")
            self.assertEqual(info["euler_characteristic"], 1)

    def test_empty_mesh(self):
        info = self.json("info", self.file("empty.facets", "# nothing\n"))
        self.assertEqual(info["dimension"], -1)
        self.assertEqual(info["simplices"], [])
        self.assertEqual(info["euler_characteristic"], 0)
        self.assertEqual(info["components"], 0)
        self.assertEqual(info, self.json("info", self.file("nothing.facets", "")))
        self.assertIs(self.json("check", self.file("nothing.facets", ""))["ok"], True)

    def test_non_pure(self):
        info = self.json("info", self.file("mixed.facets", "0 1 2\n2 3\n4\n"))
        self.assertEqual(info["simplices"], [5, 4, 1])
        self.assertEqual(info["manifold"], "no")
        self.assertEqual(info["components"], 2)

    def test_sphere_in_space(self):
        info = self.json("info", self.generate("sphere.off", "sphere", "--level", 2))
        self.assertEqual(info["ambient_dimension"], 3)
        self.assertIs(info["closed"], True)
        self.assertIsNone(info["inverted"])
        self.assertIs(info["well_centered"], True)

    def test_flat_simplex(self):
        flat = self.file("flat.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n2 0 0\n0 1 0\n3 0 1 2\n3 0 1 3\n")
        info = self.json("info", flat)
        self.assertEqual(info["degenerate"], 1)
        self.assertIsNone(info["star"])


class Check(Case):
    def defects(self, text, kinds):
        report = self.json("check", self.file("mesh.facets", text), code=1 if kinds else 0)
        self.assertIs(report["ok"], not kinds)
        self.assertEqual([(d["kind"], d["simplex"]) for d in report["defects"]], kinds)
        for defect in report["defects"]:
            self.assertTrue(defect["detail"])
        return report

    def test_sound(self):
        self.defects("0 1 2 3\n", [])

    def test_bow_tie(self):
        self.defects("0 1 2\n0 3 4\n", [("link", [0])])

    def test_tetrahedra_sharing_less_than_a_face(self):
        self.defects("0 1 2 3\n0 4 5 6\n", [("link", [0])])
        self.defects("0 1 2 3\n0 1 4 5\n", [("ring", [0, 1])])

    def test_three_cofaces(self):
        self.defects("0 1 2 3\n0 1 2 4\n0 1 2 5\n", [("facet", [0, 1, 2])])
        self.defects("0 1 2\n0 1 3\n0 1 4\n", [("facet", [0, 1])])

    def test_duplicate_and_repeat(self):
        self.defects("0 1 2 3\n1 0 3 2\n", [("duplicate", [0, 1, 2, 3])])
        self.defects("0 1 2 3\n0 0 1 2\n", [("repeat", [0, 0, 1, 2])])

    def test_repeat_that_leaves_a_vertex_unused(self):
        path = self.file("repeat.node", "4 2 0 0\n0 0 0\n1 1 0\n2 0 1\n3 1 1\n")
        self.file("repeat.ele", "2 3 0\n0 0 1 2\n1 1 2 2\n")
        report = self.json("check", path, code=1)
        self.assertEqual([(d["kind"], d["simplex"]) for d in report["defects"]], [("repeat", [1, 2, 2])])

    def test_one_sided(self):
        report = self.json("check", self.file("m.facets", MOEBIUS), code=1)
        self.assertEqual([d["kind"] for d in report["defects"]], ["orientation"])

    def test_inverted_and_degenerate(self):
        nodes = "4 2 0 0\n0 0 0\n1 1 0\n2 1 1\n3 0.4 0.2\n"
        path = self.file("folded.node", nodes)
        self.file("folded.ele", "2 3 0\n0 0 1 2\n1 0 2 3\n")
        report = self.json("check", path, code=1)
        self.assertEqual([d["kind"] for d in report["defects"]], ["inverted"])
        flat = self.file("flat.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n2 0 0\n0 1 0\n3 0 1 2\n3 0 1 3\n")
        report = self.json("check", flat, code=1)
        self.assertEqual([(d["kind"], d["simplex"]) for d in report["defects"]], [("degenerate", [0, 1, 2])])

    def test_suspension_of_the_poincare_sphere_is_unproved(self):
        rows = [[int(v, 16) for v in word] for word in POINCARE.split()]
        text = "".join(" ".join(map(str, row + [apex])) + "\n" for apex in (16, 17) for row in rows)
        report = self.defects(text, [("unproved", [16]), ("unproved", [17])])
        self.assertEqual(report["counts"]["unproved"], 2)
        self.assertEqual(self.json("info", self.file("suspension.facets", text))["manifold"], "unproved")

    def test_at_most_twenty_of_a_kind(self):
        bow_ties = "".join(f"{5*i} {5*i+1} {5*i+2}\n{5*i} {5*i+3} {5*i+4}\n" for i in range(30))
        path = self.file("ties.facets", bow_ties)
        report = self.json("check", path, code=1)
        self.assertEqual((len(report["defects"]), report["counts"]["link"]), (20, 30))
        self.assertEqual(len(self.json("check", path, "--all", code=1)["defects"]), 30)

    def test_file_numbers_are_named(self):
        msh = ("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n5\n"
               + "".join(f"{10 * (i + 1)} {i} {i * i} 0\n" for i in range(5))
               + "$EndNodes\n$Elements\n2\n7 2 0 10 20 30\n9 2 0 10 40 50\n$EndElements\n")
        report = self.json("check", self.file("tie.msh", msh), code=1)
        link = [d for d in report["defects"] if d["kind"] == "link"]
        self.assertEqual(link[0]["simplex"], [0])
        self.assertIn("10", link[0]["detail"])
        tie = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv -1 0 0\nv -1 1 0\nf 1 2 3\nf 1 4 5\n"
        report = self.json("check", self.file("tie.obj", tie), code=1)
        self.assertEqual(report["defects"][0]["simplex"], [0])
        self.assertIn("file numbers 1]", report["defects"][0]["detail"])


class Refusals(Case):
    def refused(self, code, *arguments, stdin=None):
        error = self.json(*arguments, code=code, stdin=stdin)["error"]
        self.assertEqual(set(error), {"kind", "message", "file", "line"})
        self.assertTrue(error["message"])
        return error

    def test_mistyped_command_and_kind(self):
        code, out, errors = run("inof", "x")
        self.assertEqual((code, out), (2, ""))
        self.assertIn("did you mean 'info'", errors)
        self.assertIn("did you mean 'box'", self.refused(2, "generate", "bix", "--out", self.directory / "x.msh")["message"])

    def test_usage(self):
        self.assertEqual(run()[0], 2)
        self.assertEqual(run("info")[0], 2)
        self.assertEqual(run("info", "a", "--no-such-option")[0], 2)
        self.assertEqual(run("--version")[0], 0)
        self.assertEqual(run("info", "--help")[0], 0)
        self.refused(2, "generate", "box", "--cells", 0, "--out", self.directory / "x.msh")
        self.refused(2, "generate", "box", "--out", self.directory / "x.unknown")

    def test_options_of_other_kinds(self):
        out = self.directory / "x.facets"
        for arguments in (("bcc", "--dimension", 2), ("sphere", "--cells", 9), ("600-cell", "--seed", 1), ("box", "--spec", "3x3")):
            message = self.refused(2, "generate", *arguments, "--out", out)["message"]
            self.assertIn(arguments[1], message)
        self.assertIn("9", self.refused(2, "generate", "box", "--dimension", 9, "--out", out)["message"])
        self.assertFalse(out.exists())

    def test_several_files_do_not_fit_on_stdout(self):
        box = self.directory / "box.facets"
        self.json("generate", "box", "--out", box)
        self.refused(2, "operators", box, "--out", "-")

    def test_standard_input_has_a_name(self):
        self.assertEqual(self.refused(3, "info", "-", stdin="0 1 1\n")["file"], "stdin")
        self.assertEqual(self.refused(3, "info", "-", stdin="0 x\n")["file"], "stdin")
        nodes = "3 2 0 0\n1 0 0\n2 1 0\n3 0 1\n"
        self.assertEqual(self.json("info", "-", stdin=nodes + "1 3 0\n1 1 2 3\n")["simplices"], [3, 3, 1])
        self.refused(3, "check", "-", stdin="3 3 0\n1 1 2 3\n2 2 3 4\n3 3 4 5\n")  # an .ele file without nodes

    def test_tetrahedra_in_the_plane(self):
        mesh = self.file("flat.mesh", "MeshVersionFormatted 2\nDimension 2\nVertices 4\n0 0 0 1 0 0 0 1 0 1 1 0\n"
                         "Tetrahedra 1\n1 2 3 4 0\nEnd\n")
        for command in (("info",), ("check",), ("operators", "--out", self.directory / "out")):
            self.assertIn("dimension 3", self.refused(3, *command, mesh)["message"])

    def test_unreadable(self):
        missing = self.refused(3, "info", self.directory / "missing.msh")
        self.assertIn("missing.msh", missing["file"])
        self.assertEqual(self.refused(3, "info", self.file("bad.off", "OFF\n3 1 0\n0 0 0\n1 0 nan\n0 1 0\n3 0 1 2\n"))["line"], 4)
        self.refused(3, "info", self.directory)

    def test_rows_that_no_complex_can_hold(self):
        for rows in ("0 1 2\n2 1 0\n", "0 1 1\n", "0 1 3\n"):
            path = self.file("bad.facets", rows)
            self.refused(3, "info", path)
            self.refused(3, "operators", path, "--out", self.directory / "out")

    def test_unused_vertices(self):
        mesh = self.file("unused.off", "OFF\n4 1 0\n0 0 0\n9 9 9\n1 0 0\n0 1 0\n3 0 2 3\n")
        self.assertIn("vertex 1", self.refused(3, "info", mesh)["message"])
        self.assertEqual(self.json("info", mesh, "--drop-unused")["simplices"], [3, 3, 1])
        self.json("operators", mesh, "--drop-unused", "--out", self.directory / "out")
        self.assertEqual((self.directory / "out" / "simplices0.txt").read_text(), "0\n2\n3\n")

    def test_reorder(self):
        """Reordered meshes give the same answers, in the file's numbers."""
        box = self.generate("box.msh", "box", "--cells", 3)
        self.assertEqual(self.json("info", box, "--reorder")["simplices"], self.json("info", box)["simplices"])
        self.json("check", box, "--reorder")
        for options, out in (((), "a"), (("--reorder",), "b")):
            self.json("operators", box, *options, "--out", self.directory / out, code=0)
        for k in range(4):
            plain, other = ((self.directory / out / f"simplices{k}.txt").read_text().splitlines() for out in "ab")
            self.assertNotEqual(plain, other)
            simplices = [sorted(sorted(int(v) for v in line.split()[k == 3:]) for line in lines) for lines in (plain, other)]
            self.assertEqual(*simplices)
        bad = self.file("bad.facets", "0 1 2\n1 2 3\n1 2 4\n7 5 6\n")
        defects = [self.json("check", bad, *options, code=1)["defects"] for options in ((), ("--reorder",))]
        self.assertEqual(*(sorted((d["kind"], d["simplex"]) for d in found) for found in defects))

    def test_unwritable(self):
        box = self.generate("box.msh", "box", "--cells", 1)
        self.refused(4, "operators", box, "--out", box)
        self.refused(4, "generate", "box", "--out", self.directory / "no" / "such" / "x.msh")
        if os.path.exists("/dev/full"):
            with open("/dev/full", "w") as full:
                self.assertEqual(subprocess.run([PROGRAM, "info", box], stdout=full, stderr=subprocess.DEVNULL).returncode, 4)

    def test_too_large(self):
        self.refused(6, "generate", "box", "--cells", 10000000, "--out", self.directory / "x.msh")
        self.assertEqual(list(self.directory.iterdir()), [])

    def test_closed_streams(self):
        box = self.generate("box.msh", "box", "--cells", 1)
        for number, closed in enumerate(("<&-", ">&-", "2>&-")):
            target = self.directory / f"copy{number}.ele"
            command = f'exec "$1" generate box --cells 1 --out "$2" {closed}'
            self.assertEqual(subprocess.run(["sh", "-c", command, "sh", PROGRAM, target], capture_output=True).returncode, 0)
            self.assertEqual(self.json("info", target)["simplices"], [8, 19, 18, 6])
        self.assertEqual(subprocess.run(["sh", "-c", 'exec "$1" info "$2" >&-', "sh", PROGRAM, box], capture_output=True).returncode, 4)

    def test_size_limit(self):
        command = 'ulimit -f 1; exec "$1" generate box --cells 10 --out "$2"'
        done = subprocess.run(["bash", "-c", command, "bash", PROGRAM, self.directory / "x.msh"], capture_output=True)
        self.assertEqual(done.returncode, 4)
        self.assertEqual(list(self.directory.iterdir()), [])

    def test_without_threads(self):
        box = self.generate("box.msh", "box", "--cells", 16)
        for limit in (18000, 20000, 24000, 30000, 60000):
            def limited(*arguments):
                command = f'ulimit -v {limit}; exec "$@"'
                return subprocess.run(["bash", "-c", command, "bash", PROGRAM, *arguments], capture_output=True)

            if limited("--version").returncode == 0:  # else not even the program fits, as with a sanitizer's shadow memory
                done = limited("info", box)
                self.assertIn(done.returncode, (0, 6), done.stderr)

    def test_json_after_a_mistyped_command(self):
        self.assertIn("info", self.refused(2, "inf", "x")["message"])

    def test_quiet(self):
        self.assertEqual(run("generate", "box", "--out", self.directory / "x.msh", "--quiet"), (0, "", ""))


    def test_options_in_any_place(self):
        box = self.generate("box.msh", "box", "--cells", 1)
        self.assertEqual(self.json("info", box), self.json("info", box, "-q"))
        code, out, _ = run("--json", "info", box)
        self.assertEqual((code, json.loads(out)["simplices"]), (0, [8, 19, 18, 6]))
        self.assertEqual(run("generate", "--cells", "2,1", "--dimension", 2, "box", "--out", self.directory / "b.off")[0], 0)
        self.assertEqual(self.json("info", self.directory / "b.off")["simplices"], [6, 9, 4])


class Operators(Case):
    def test_a_directory_used_before_keeps_nothing_of_the_other_mesh(self):
        out = self.directory / "out"
        self.json("operators", self.generate("box.msh", "box", "--cells", 1), "--out", out)
        self.assertTrue((out / "star3.mtx").exists())
        summary = self.json("operators", self.file("m.facets", MOEBIUS), "--out", out, code=1)
        self.assertIs(summary["stars"], False)
        self.assertEqual(sorted(p.name for p in out.iterdir()), sorted(summary["files"]))


class Demo(Case):
    def test_json(self):
        picture = self.directory / "demo.vtu"
        demo = self.json("demo", self.generate("box.msh", "box", "--cells", 2), "--out", picture)
        self.assertIs(demo["ok"], True)
        self.assertGreaterEqual(demo["meshes"][0]["simplices"][3], 50000)
        self.assertEqual(demo["meshes"][1]["simplices"], [27, 98, 120, 48])
        self.assertTrue(picture.read_bytes().startswith(b"<?xml"))

    def test_text(self):
        code, out, _ = run("demo", "--out", self.directory / "demo.vtu")
        self.assertEqual(code, 0)
        for promise in ("manifold         yes", "boundary of a boundary: zero, exactly", "degree 3 = C(3,3)", "certificate"):
            self.assertIn(promise, out)


class Interrupted(Case):
    def test_no_temporary_is_left(self):
        child = subprocess.Popen([PROGRAM, "generate", "box", "--cells", "60", "--out", self.directory / "big.msh", "-q"])
        while child.poll() is None and not list(self.directory.iterdir()):
            pass
        child.send_signal(signal.SIGTERM)
        self.assertIn(child.wait(), (0, -signal.SIGTERM))
        self.assertIn([p.name for p in self.directory.iterdir()], ([], ["big.msh"]))


if __name__ == "__main__":
    main()
