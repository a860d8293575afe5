"""Files of more than 4 GiB, where 32 bits no longer count the bytes. They are sparse: nearly all of each is a hole."""
import os
import re
import unittest
import zipfile

from runner import Case, main, run

HOLE = (4 << 30) + (1 << 20)


class SparseFile:
    """A file to write into; long runs of zeros become holes."""

    def __init__(self, path):
        self.file = open(path, "wb")

    def write(self, data):
        if len(data) >= 1 << 16 and data.count(0) == len(data):
            self.file.seek(len(data), os.SEEK_CUR)
        else:
            self.file.write(data)
        return len(data)

    def tell(self):
        return self.file.tell()

    def seek(self, *where):
        return self.file.seek(*where)

    def flush(self):
        self.file.flush()

    def close(self):
        self.file.close()


def write_pieces(path, *pieces):
    """Bytes, or the lengths of holes."""
    with open(path, "wb") as file:
        for piece in pieces:
            if isinstance(piece, int):
                file.seek(piece, os.SEEK_CUR)
            else:
                file.write(piece)


@unittest.skipIf(os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") < 12 << 30, "needs 12 GiB of memory")
class LargeFiles(Case):
    def expect_same(self, large, original):
        """The mesh in the large file is that of the original."""
        self.assertGreater(large.stat().st_size, 1 << 32)
        meshes = []
        for path in (large, original):
            copy = self.directory / "copy.npz"
            code, _, errors = run("convert", path, copy)
            self.assertEqual(code, 0, errors)
            with zipfile.ZipFile(copy) as arrays:
                meshes.append({name: arrays.read(name) for name in arrays.namelist()})
        self.assertEqual(*meshes)
        large.unlink()

    def test_mesh_behind_a_long_comment(self):
        volume = self.generate("volume.npz", "box", "--cells", 2)
        surface = self.generate("surface.npz", "sphere", "--level", 1)
        for source, extension, comment_line in ((volume, "mesh", 1), (surface, "obj", 0)):
            with self.subTest(extension=extension):
                original = self.directory / f"original.{extension}"
                self.assertEqual(run("convert", source, original)[0], 0)
                lines = original.read_bytes().splitlines(keepends=True)
                large = self.directory / f"large.{extension}"
                write_pieces(large, b"".join(lines[:comment_line]), b"# ", HOLE, b"\n", b"".join(lines[comment_line:]))
                self.expect_same(large, original)

    def test_error_behind_a_long_comment(self):
        large = self.directory / "large.off"
        write_pieces(large, b"OFF\n# ", HOLE, b"\n3 1 0\n0 0 0\n1 0 0\n0 1 nan\n3 0 1 2\n")
        code, _, errors = run("info", large)
        self.assertEqual(code, 3, errors)
        self.assertIn("large.off:6: found 'nan'", errors)
        large.unlink()

    def test_gmsh_section_without_a_meaning(self):
        for options in ((), ("--gmsh-version", "4.1", "--binary")):
            with self.subTest(options=options):
                original = self.generate("original.npz", "box", "--cells", 2)
                small = self.directory / "small.msh"
                self.assertEqual(run("convert", original, small, *options)[0], 0)
                head, tail = re.match(rb"(?s)(.*?\$EndMeshFormat\n)(.*)", small.read_bytes()).groups()
                large = self.directory / "large.msh"
                write_pieces(large, head, b"$Comments\n", HOLE, b"\n$EndComments\n", tail)
                self.expect_same(large, small)

    def test_ply_element_without_a_meaning(self):
        original = self.generate("original.npz", "sphere", "--level", 1)
        small = self.directory / "small.ply"
        self.assertEqual(run("convert", original, small, "--binary")[0], 0)
        data = small.read_bytes()
        first, second = data.index(b"element vertex"), data.index(b"end_header\n") + len(b"end_header\n")
        padding = b"element padding %d\nproperty double a\nproperty double b\n" % (HOLE // 16)
        large = self.directory / "large.ply"
        write_pieces(large, data[:first], padding, data[first:second], HOLE // 16 * 16, data[second:])
        self.expect_same(large, small)

    def test_vtu_array_behind_a_hole(self):
        original = self.generate("original.npz", "box", "--cells", 2)
        small = self.directory / "small.vtu"
        self.assertEqual(run("convert", original, small)[0], 0)
        data = small.read_bytes()
        start = data.index(b"_", data.index(b"<AppendedData")) + 1
        head = re.sub(rb'offset="(\d+)"', lambda found: b'offset="%d"' % (int(found[1]) + HOLE), data[:start])
        self.assertNotEqual(head, data[:start])
        large = self.directory / "large.vtu"
        write_pieces(large, head, HOLE, data[start:])
        self.expect_same(large, small)

    def test_npz_behind_a_large_array(self):
        small = self.generate("small.npz", "box", "--cells", 2)
        header = b"{'descr': '<f8', 'fortran_order': False, 'shape': (%d,), }" % (HOLE // 8)
        header = header.ljust(117) + b"\n"
        large = self.directory / "large.npz"
        with zipfile.ZipFile(small) as arrays, zipfile.ZipFile(SparseFile(large), "w", zipfile.ZIP_STORED) as out:
            with out.open("other.npy", "w", force_zip64=True) as other:
                other.write(b"\x93NUMPY\x01\x00" + len(header).to_bytes(2, "little") + header)
                for _ in range(HOLE >> 20):
                    other.write(bytes(1 << 20))
            for name in arrays.namelist():
                out.writestr(name, arrays.read(name))
            file = out.fp
        file.close()
        self.assertLess(os.stat(large).st_blocks * 512, 1 << 24)
        self.expect_same(large, small)

    def test_zeros_at_the_end(self):
        volume = self.generate("volume.npz", "box", "--cells", 2)
        surface = self.generate("surface.npz", "sphere", "--level", 1)
        for source, extensions in ((volume, ("msh", "vtu")), (surface, ("ply", "stl"))):
            for extension in extensions:
                with self.subTest(extension=extension):
                    path = self.directory / f"zeros.{extension}"
                    self.assertEqual(run("convert", source, path)[0], 0)
                    os.truncate(path, HOLE)
                    code, out, errors = run("info", path)
                    self.assertEqual(code, 3, errors)
                    self.assertIn(path.name, errors)
                    self.assertEqual(out, "")
                    path.unlink()


if __name__ == "__main__":
    main()
