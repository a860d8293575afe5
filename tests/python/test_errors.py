"""What is refused, as which class, and whether the message says what was expected and what was given."""

from __future__ import annotations

import errno
import os
import pickle
import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import derham

K = derham.generate.box(2, 2)
M = derham.generate.moebius_strip()

REFUSED: list[tuple[type[Exception], str, Callable[[], object]]] = [
    (ValueError, r"degree k is 3; expected 0 to 2", lambda: K.simplices(3)),
    (ValueError, r"degree k is -1; expected 0 to 2", lambda: K.d(-1)),
    (ValueError, r"degree k is 1\.0; expected 0 to 2", lambda: K.star(1.0)),  # type: ignore[arg-type]
    (ValueError, r"degree k is 2; expected 0 to 1", lambda: K.apply_d(np.ones(8), 2)),
    (ValueError, r"degree k is 0; expected 1 to 2", lambda: K.faces(0)),
    (ValueError, r"w has shape \(3,\); a primal 1-form .* shape \(16,\)", lambda: K.apply_d([1, 2, 3], 1)),
    (ValueError, r"w has shape \(9,\); a dual 0-form .* shape \(8,\)", lambda: K.apply_d(np.ones(9), 0, "dual")),
    (ValueError, r"w has shape \(16, 1, 1\)", lambda: K.apply_d(np.ones((16, 1, 1)), 1)),
    (ValueError, r"the side is 'left'; expected 'primal' or 'dual'", lambda: K.d(0, "left")),  # type: ignore[arg-type]
    (ValueError, r"array of complex128; expected real numbers", lambda: K.apply_d(np.ones(16) * 1j, 1)),
    (ValueError, r"out is an array of float32",
     lambda: K.apply_d(np.ones(16), 1, out=np.ones(8, np.float32))),  # type: ignore[arg-type]
    (ValueError, r"simplices is an array of float64; expected integers", lambda: derham.Complex(np.ones((2, 3)))),
    (ValueError, r"simplices have shape \(3,\)", lambda: derham.Complex(np.arange(3))),
    (ValueError, r"row 1 .*repeat|row 1 .*more than once|row 1", lambda: derham.Complex([(0, 1, 2), (2, 2, 3)])),
    (ValueError, r"points have shape \(3,\)", lambda: derham.Complex([(0, 1)], points=[1, 2, 3])),
    (ValueError, r"vertex 2", lambda: derham.Complex([(0, 1)], points=[(0,), (1,), (2,)])),
    (ValueError, r"points and edge_lengths_squared are given",
     lambda: derham.Complex([(0, 1)], [(0,), (1,)], edge_lengths_squared=[1])),
    (ValueError, r"dimension", lambda: derham.Complex([(0, 1, 2)], points=[(0,), (1,), (2,)])),
    (ValueError, r"dimension of the simplices is 7; expected 0 to 6", lambda: derham.Complex([range(8)])),
    (derham.GeometryError, r"vertex 1", lambda: derham.Complex([(0, 1)], points=[(0,), (np.nan,)])),
    (ValueError, r"the tuple \(0, 8\) is no simplex", lambda: K.index((0, 8))),
    (ValueError, r"row 1, the tuple \(0, 8\)", lambda: K.index([(0, 1), (0, 8)])),
    (ValueError, r"tuples have shape \(2, 4\)", lambda: K.find(np.zeros((2, 4), int))),
    (ValueError, r"no 1-simplex 16; expected 0 to 15", lambda: K.closure({1: [16]})),
    (ValueError, r"kind of star is 'round'; expected .*circumcentric", lambda: K.star(1, "round")),  # type: ignore[arg-type]
    (ValueError, r"only kind='power'", lambda: K.star(1, weights=np.zeros(9))),
    (ValueError, r"not sparse: factorise star\(k, 'whitney'\); expected a diagonal one",
     lambda: K.star_inverse(1, "whitney")),  # type: ignore[arg-type]
    (ValueError, r"not sparse: take mixed_laplacian", lambda: K.laplacian(1, "whitney")),  # type: ignore[arg-type]
    (ValueError, r"not sparse: take mixed_laplacian", lambda: K.weak_laplacian(1, "whitney")),  # type: ignore[arg-type]
    (ValueError, r"not sparse: take mixed_laplacian", lambda: K.codifferential(1, "whitney")),  # type: ignore[arg-type]
    (ValueError, r"not sparse: take kind='whitney'",
     lambda: K.interior(np.ones(16), np.ones(8), 2, kind="algebraic", star="whitney")),  # type: ignore[arg-type]
    (ValueError, r"material", lambda: K.star(1, material=np.ones(3))),
    (derham.TopologyError, r"not orientable", lambda: M.apply_d(np.ones(5), 0, "dual")),
    (derham.GeometryError, r"has no metric", lambda: M.volumes(1)),
    (ValueError, r"dimension of the complex is 5; expected 0 to 4", lambda: derham.generate.box(5, 1).star(0)),
    (derham.GeometryError, r"4 dual volumes are zero.* use kind='power' with weights=.*barycentric.*mixed_laplacian",
     lambda: K.star_inverse(1)),
    (derham.GeometryError, r"dual volumes are zero.* kind='power'.*mixed_laplacian", lambda: K.laplacian(2)),
    (derham.GeometryError, r"dual volumes.* zero.* kind='power'.*mixed_laplacian", lambda: K.weak_laplacian(2)),
    (derham.GeometryError, r"dual volumes are zero.* kind='power'.*mixed_laplacian", lambda: K.codifferential(2)),
    (derham.GeometryError, r"dual volumes are zero.* kind='power'",
     lambda: K.interior(np.ones(16), np.ones(8), 2, kind="algebraic")),
    (ValueError, r"dimension of the simplices is 8; expected 0 to 6.* simplices\.T of shape \(9, 3\)",
     lambda: derham.Complex(np.arange(27).reshape(3, 9))),
    (ValueError, r"dimension of the complex is 0; expected 1 to 4",
     lambda: derham.Complex([(0,)], points=[(0,)]).laplacian(0)),
    (ValueError, r"points have shape \(3,\); expected \(count, 2\), or \(2,\) for one", lambda: K.locate([0, 0, 0])),
    (ValueError, r"values of shape \(3,\) at \d+ points; expected \(\d+, 2\), or \(2,\) if constant",
     lambda: K.integrate(lambda x: [1, 2, 3], 1)),
    (ValueError, r"X has values of shape \(3,\) .* or \(2,\) if", lambda: K.interior(lambda x: [1, 2, 3], np.ones(16), 1)),
    (ValueError, r"3 numbers of cells; expected one, or 2", lambda: derham.generate.box(2, (1, 2, 3))),
    (derham.LimitError, r"", lambda: derham.generate.box(2, 2_000_000)),
    (FileNotFoundError, r"/nowhere.off: cannot open: No such file", lambda: derham.read("/nowhere.off")),
    (IsADirectoryError, r"cannot read", lambda: derham.read("/")),
    (FileNotFoundError, r"cannot create", lambda: K.write("/nowhere/mesh.off")),
    (IsADirectoryError, r"cannot write", lambda: K.write("/", "off")),
    (NotADirectoryError, r"cannot create", lambda: K.write("/dev/null/mesh.off")),
    (ValueError, r"no format 'xyz'; expected", lambda: derham.read("/nowhere.off", "xyz")),
    (ValueError, r"tells no format", lambda: K.write("mesh.unknown")),
    (ValueError, r"the path .* holds a zero character", lambda: K.write("mesh.off\0.txt")),
    (ValueError, r"the path .* is not UTF-8", lambda: derham.read("\udcff.off")),
    (ValueError, r"a name in forms '.*udcff' is not UTF-8", lambda: K.write_forms("x.vtu", {"\udcff": (np.ones(9), 0)})),
    (ValueError, r"binary is 1; expected True or False", lambda: K.write("mesh.off", binary=1)),  # type: ignore[arg-type]
    (ValueError, r"simplices has masked entries", lambda: derham.Complex(np.ma.masked_array([(0, 1)], [(True, False)]))),
    (ValueError, r"w has masked entries", lambda: K.apply_d(np.ma.masked_less(np.arange(16.0), 3), 1)),
    (ValueError, r"w makes no array: .*inhomogeneous|w is an array of object", lambda: K.apply_d([[1], [1, 2]], 1)),
    (ValueError, r"simplices are None; expected \(count, n\+1\)", lambda: derham.Complex(None)),  # type: ignore[arg-type]
    (ValueError, r"simplices are \[0, 1, 2\]; expected", lambda: derham.Complex([0, 1, 2])),
    (ValueError, r"corners have shape \(3, 1, 1\); expected \(1, 3\)",
     lambda: derham.Complex([(0, 1, 2)], corners=np.ones((3, 1, 1)))),
    (ValueError, r"edge_lengths_squared have shape \(1, 3\); expected \(edges,\)",
     lambda: derham.Complex([(0, 1, 2)], edge_lengths_squared=[[1, 1, 1]])),
    (ValueError, r"dtype is uint8; the entries 1 and -1 need", lambda: K.d(0, dtype=np.uint8)),
    (ValueError, r"dtype is bool", lambda: K.boundary(1, bool)),
    (ValueError, r"dtype is 'colour'; expected a type", lambda: K.boundary(1, "colour")),
    (ValueError, r"coefficients are an array of float64 of shape \(\)", lambda: K.chain([(0, 1)], 0.5)),
    (ValueError, r"coefficients .* of shape \(3,\); expected integers, one or \(1,\)",
     lambda: K.chain([(0, 1)], [1, 2, 3])),
    (ValueError, r"tuples have shape \(4,\)", lambda: K.find((0, 1, 2, 3))),
    (ValueError, r"the set of simplices is \[0\]; expected a mapping", lambda: K.link([0])),  # type: ignore[arg-type]
    (ValueError, r"weights have shape \(9, 1\); expected \(9,\)", lambda: K.star(1, "power", weights=np.zeros((9, 1)))),
    (ValueError, r"the material is a tuple of 3; expected a pair",
     lambda: K.star(1, material=(1, 2, 3))),  # type: ignore[arg-type]
    (ValueError, r"the rows of the material have shape \(1,\)", lambda: K.star(1, material=(1, 2))),
    (ValueError, r"prescribed has shape \(1, 2\)", lambda: K.form_space([[0, 1]])),
    (ValueError, r"simplices has shape \(1, 1\)", lambda: K.dual_cells(1, [[0]])),
    (ValueError, r"the order is 1000000; expected 0 to 200", lambda: K.integrate(1.0, 2, order=10**6)),
    (ValueError, r"the order is None", lambda: K.interior([1, 0], np.ones(16), 1, order=None)),  # type: ignore[arg-type]
    (ValueError, r"margin is 'a'; expected a real number", lambda: K.hot_weights("a")),  # type: ignore[arg-type]
    (ValueError, r"space is 5; expected a form space", lambda: K.mixed_laplacian(1, space=5)),  # type: ignore[arg-type]
    (derham.GeometryError, r"has no metric", lambda: M.locate([(0, 0)])),
    (derham.TopologyError, r"refinement needs a pure complex", lambda: derham.Complex([(0, 1, 2), (2, 3)]).refined()),
    (ValueError, r"cells is an array of float64; expected integers",
     lambda: derham.generate.box(2, 2.5)),  # type: ignore[arg-type]
    (ValueError, r"the arguments are 3, 1\.5, 1; expected ball\(dimension: int, layers: int",
     lambda: derham.generate.ball(3, 1.5)),  # type: ignore[arg-type]
    (ValueError, r"the argument is None; expected a complex", lambda: derham.generate.cone(None)),  # type: ignore[arg-type]
    (ValueError, r"number of threads is 0; expected 1 to", lambda: derham.set_thread_count(0)),
]


@pytest.mark.parametrize(("expected", "message", "action"), REFUSED, ids=[m for _, m, _ in REFUSED])
def test_refused(expected: type[Exception], message: str, action: Callable[[], object]) -> None:
    with pytest.raises(derham.Error) as caught:
        action()
    assert isinstance(caught.value, expected)
    assert re.search(message, str(caught.value))


def test_classes() -> None:
    for error, builtin in (
        (derham.InputError, ValueError), (derham.TopologyError, ValueError), (derham.GeometryError, ValueError),
        (derham.LimitError, OverflowError), (derham.FileError, OSError),
    ):
        assert issubclass(error, builtin) and issubclass(error, derham.Error)


def test_attributes(tmp_path) -> None:  # type: ignore[no-untyped-def]
    with pytest.raises(derham.InputError) as input_error:
        derham.Complex([(0, 1, 2), (2, 1, 0)])
    assert input_error.value.row == 1
    path = tmp_path / "bad.off"
    path.write_text("OFF\n3 1 0\n0 0 0\n1 0 zero\n")
    with pytest.raises(derham.FileError) as file_error:
        derham.read(path)
    error = file_error.value
    assert (error.path, error.line, error.action) == (str(path), 4, "read") and str(error).startswith(f"{path}:4: ")


def test_refusals_of_the_system(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError) as caught:
        derham.read(tmp_path / "none.off")
    error = caught.value
    assert isinstance(error, derham.FileError) and type(error).__name__ == "FileError"
    assert (error.errno, error.filename, error.line) == (errno.ENOENT, str(tmp_path / "none.off"), 0)
    assert str(error) == f"{error.filename}: cannot open: {error.strerror}"
    again = pickle.loads(pickle.dumps(error))
    assert type(again) is type(error) and str(again) == str(error) and again.errno == error.errno
    (tmp_path / "empty.off").write_text("")
    with pytest.raises(derham.FileError) as caught_too:
        derham.read(tmp_path / "empty.off")
    assert type(caught_too.value) is derham.FileError and caught_too.value.errno is None


@pytest.mark.skipif(os.geteuid() == 0, reason="nothing is forbidden to root")
def test_a_file_that_is_forbidden(tmp_path: Path) -> None:
    path = tmp_path / "mesh.off"
    K.write(path)
    path.chmod(0)
    with pytest.raises(PermissionError):
        derham.read(path)
