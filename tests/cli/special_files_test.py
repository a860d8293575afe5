"""Files that are no ordinary files, for every format; and writers that are killed."""
import ctypes
import os
import random
import signal
import subprocess
import threading
import time
import unittest

from runner import PROGRAM, Case, main, run

# Extension and options of every way to write a mesh; a tetrahedral mesh where the format holds one.
VOLUMES = [("node", ()), ("msh", ()), ("msh", ("--binary",)), ("msh", ("--gmsh-version", "4.1")),
           ("msh", ("--gmsh-version", "4.1", "--binary")), ("mesh", ()), ("vtk", ()), ("vtk", ("--binary",)), ("vtu", ()),
           ("vtu", ("--ascii",)), ("facets", ()), ("npz", ())]
SURFACES = [("obj", ()), ("off", ()), ("ply", ()), ("ply", ("--ascii",)), ("stl", ()), ("stl", ("--ascii",))]


def obey_permissions():
    """Takes from root, in whose name tests may run, the right to read what the permissions forbid."""
    if os.geteuid() == 0:
        drop, override, read_search = 24, 1, 2  # PR_CAPBSET_DROP, CAP_DAC_OVERRIDE, CAP_DAC_READ_SEARCH
        for capability in (override, read_search):
            if ctypes.CDLL(None).prctl(drop, capability, 0, 0, 0) != 0:
                raise OSError("prctl")


class SpecialFiles(Case):
    def setUp(self):
        super().setUp()
        self.volume = self.generate("volume.npz", "box", "--cells", 3)
        self.surface = self.generate("surface.npz", "sphere", "--level", 1)

    def ways(self):
        for source, ways in ((self.volume, VOLUMES), (self.surface, SURFACES)):
            for extension, options in ways:
                with self.subTest(extension=extension, options=options):
                    yield source, extension, options

    def written(self, source, extension, options, name="mesh"):
        path = self.directory / f"{name}.{extension}"
        code, _, errors = run("convert", source, path, *options)
        self.assertEqual(code, 0, errors)
        return path

    def refused(self, code, *arguments):
        found, out, errors = run(*arguments)
        self.assertEqual(found, code, errors)
        self.assertTrue(errors.startswith("derham: "), errors)
        self.assertEqual(out, "")
        return errors

    def test_pipes(self):
        for source, extension, options in self.ways():
            if extension == "node":
                continue  # a pair of files
            path = self.written(source, extension, options)
            pipe = self.directory / f"pipe.{extension}"
            os.mkfifo(pipe)
            writer = threading.Thread(target=lambda: pipe.write_bytes(path.read_bytes()))
            writer.start()
            through = self.directory / "through.npz"
            code, _, errors = run("convert", pipe, through, "--from", "gmsh" if extension == "msh" else
                                  "medit" if extension == "mesh" else extension)
            writer.join()
            pipe.unlink()
            self.assertEqual(code, 0, errors)
            self.assertEqual(run("convert", path, self.directory / "direct.npz")[0], 0)
            self.assertEqual(through.read_bytes(), (self.directory / "direct.npz").read_bytes())

    def test_what_is_no_mesh(self):
        for _, extension, _ in self.ways():
            absent = self.directory / f"absent.{extension}"
            self.assertIn("No such file", self.refused(3, "info", absent))
            directory = self.directory / f"directory.{extension}"
            directory.mkdir(exist_ok=True)
            self.assertIn("irectory", self.refused(3, "info", directory))
            empty = self.directory / f"empty.{extension}"
            empty.write_bytes(b"")
            if extension != "facets":  # no facets make the empty complex
                self.refused(3, "info", empty)
            zeros = self.directory / f"zeros.{extension}"
            zeros.write_bytes(bytes(4096))
            self.refused(3, "info", zeros)

    def test_unreadable(self):
        for source, extension, options in self.ways():
            path = self.written(source, extension, options)
            path.chmod(0)
            done = subprocess.run([PROGRAM, "info", path], capture_output=True, text=True, preexec_fn=obey_permissions)
            self.assertEqual(done.returncode, 3, done.stderr)
            self.assertIn("Permission denied", done.stderr)
            path.unlink()

    def test_places_that_take_nothing(self):
        names = {"msh": "gmsh", "mesh": "medit", "node": "tetgen"}
        for source, extension, options in self.ways():
            directory = self.directory / f"directory.{extension}"
            directory.mkdir(exist_ok=True)
            self.refused(4, "convert", source, directory, *options)
            self.refused(4, "convert", source, self.directory / "absent" / f"x.{extension}", *options)
            if extension != "node":
                self.assertIn("No space", self.refused(4, "convert", source, "/dev/full", *options, "--to",
                                                       names.get(extension, extension)))

    def test_faces_that_cannot_be_removed(self):
        """The old faces would be read with the new mesh: where they must stay, so does the old mesh."""
        closed = self.directory / "closed"
        closed.mkdir()
        self.written(self.surface, "node", (), "a")
        old = {extension: (self.directory / f"a.{extension}").read_bytes() for extension in ("node", "ele")}
        for extension in old:
            (closed / f"a.{extension}").symlink_to(self.directory / f"a.{extension}")
        (closed / "a.face").write_text("0 0\n")
        closed.chmod(0o555)
        done = subprocess.run([PROGRAM, "convert", self.volume, closed / "a.node"], capture_output=True, text=True,
                              preexec_fn=obey_permissions)
        closed.chmod(0o755)
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertIn("cannot remove this file of an older mesh: Permission denied", done.stderr)
        for extension, content in old.items():
            self.assertEqual((self.directory / f"a.{extension}").read_bytes(), content)

    def test_names_that_are_not_utf8(self):
        for source, extension, options in self.ways():
            path = os.fsencode(self.directory) + b"/\xff\xfe\x01." + extension.encode()
            self.assertEqual(subprocess.run([PROGRAM, "convert", source, path, "-q", *options]).returncode, 0)
            done = subprocess.run([PROGRAM, "convert", path, self.directory / "back.npz", "-q"], capture_output=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertTrue(os.path.exists(path))

    def test_carriage_returns_and_no_last_newline(self):
        for source, extension, options in self.ways():
            if "--binary" in options or (extension in ("vtu", "ply", "stl") and "--ascii" not in options) or \
                    extension in ("npz", "node"):
                continue
            path = self.written(source, extension, options)
            plain = path.read_bytes()
            self.assertEqual(run("convert", path, self.directory / "plain.npz")[0], 0)
            path.write_bytes(plain.rstrip(b"\n").replace(b"\n", b"\r\n"))
            code, _, errors = run("convert", path, self.directory / "changed.npz")
            self.assertEqual(code, 0, errors)
            self.assertEqual((self.directory / "plain.npz").read_bytes(), (self.directory / "changed.npz").read_bytes())


class KilledWriters(Case):
    @staticmethod
    def contents(path):
        """The bytes of a mesh, which may be a pair of files; nothing if there is none."""
        paths = (path, path.with_suffix(".ele")) if path.suffix == ".node" else (path,)
        return tuple(file.read_bytes() for file in paths) if paths[-1].exists() else ()

    def killed(self, new, target, options, allowed):
        """How many of some writers could be killed; each left one of the allowed contents, of which the last is new."""
        command = [PROGRAM, "convert", new, target, "-q", *options]
        begin = time.monotonic()
        subprocess.run(command, check=True)
        whole = time.monotonic() - begin
        killed = 0
        for _ in range(150):
            if killed == 15:
                break
            for path, content in zip((target, target.with_suffix(".ele")), allowed[0]):
                path.write_bytes(content)
            child = subprocess.Popen(command)
            time.sleep(self.rng.uniform(0, whole))
            child.kill()
            code = child.wait()
            killed += code == -signal.SIGKILL
            found = self.contents(target)
            self.assertIn(found, allowed, f"{[len(content) for content in found]} bytes")
            if code == 0:
                self.assertEqual(found, allowed[-1])
            for left in self.directory.glob(".derham-*.tmp"):  # what SIGKILL leaves no time to remove
                left.unlink()
        return killed

    def test_the_old_file_or_the_new_one(self):
        """A writer that is killed at any moment leaves the old file, or, if it was done, the new one; never a part."""
        self.rng = random.Random(5)
        kills = 0
        for sizes, ways in (((("box", "--cells", 2), ("box", "--cells", 12)), VOLUMES),
                            ((("sphere", "--level", 1), ("sphere", "--level", 5)), SURFACES)):
            old, new = (self.generate(f"{name}.npz", *size) for name, size in zip(("old", "new"), sizes))
            for extension, options in ways:
                with self.subTest(extension=extension, options=options):
                    allowed = []
                    for source in (old, new):
                        path = self.directory / f"{source.stem}.{extension}"
                        self.assertEqual(run("convert", source, path, "-q", *options)[0], 0)
                        allowed.append(self.contents(path))
                    if extension == "node":  # of two files there may be none for a moment
                        allowed.insert(1, ())
                    kills += self.killed(new, self.directory / f"target.{extension}", options, allowed)
        self.assertGreaterEqual(kills, 200)


if __name__ == "__main__":
    main()
