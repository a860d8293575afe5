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
    def test_the_old_file_or_the_new_one(self):
        """A writer that is killed at any moment leaves the old file, or, if it was done, the new one; never a part."""
        old = self.generate("old.npz", "box", "--cells", 2)
        new = self.generate("new.npz", "box", "--cells", 12)
        rng = random.Random(5)
        kills = 0
        for extension in ("msh", "mesh", "vtk", "vtu", "facets", "npz"):
            contents = []
            for source in (old, new):
                path = self.directory / f"{source.stem}.{extension}"
                self.assertEqual(run("convert", source, path, "-q")[0], 0)
                contents.append(path.read_bytes())
            target = self.directory / f"target.{extension}"
            begin = time.monotonic()
            run("convert", new, target, "-q")
            whole = time.monotonic() - begin
            target.write_bytes(contents[0])
            killed = 0
            for _ in range(400):
                if killed == 40:
                    break
                child = subprocess.Popen([PROGRAM, "convert", new, target, "-q"])
                time.sleep(rng.uniform(0, whole))
                child.kill()
                code = child.wait()
                killed += code == -signal.SIGKILL
                found = target.read_bytes()
                self.assertIn(found, contents, f"{extension}: {len(found)} bytes")
                if code == 0:
                    self.assertEqual(found, contents[1])
                if found == contents[1]:
                    target.write_bytes(contents[0])
                for left in self.directory.glob(f"*target.{extension}*"):  # what SIGKILL leaves no time to remove
                    if left != target:
                        left.unlink()
            kills += killed
        self.assertGreaterEqual(kills, 200)


if __name__ == "__main__":
    main()
