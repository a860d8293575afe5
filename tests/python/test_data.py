"""Parts, fields and forms beside the simplices."""

from __future__ import annotations

import pickle
from pathlib import Path

import numpy as np
import pytest

import derham


def test_parts_are_chains() -> None:
    K = derham.generate.box(2, 2)
    loop = np.array([(0, 1), (1, 2), (2, 5), (5, 8), (8, 7), (7, 6), (6, 3), (3, 0)])
    L = K.with_data(parts={"loop": loop, 9: loop[:2, ::-1], "two": (np.array([5, 1]), 2), "corner": np.array([[8]])})
    assert [(p.name, p.number, p.degree, p.count) for p in L.parts] == [
        ("loop", 1, 1, 8), ("", 9, 1, 2), ("two", 1, 2, 2), ("corner", 1, 0, 1)]
    np.testing.assert_array_equal(L.tagged_simplices("loop"), loop)
    np.testing.assert_array_equal(L.tagged_simplices(9), loop[:2, ::-1])
    np.testing.assert_array_equal(L.tagged_chain("two"), np.isin(np.arange(8), [1, 5]))
    index, sign = K.index(loop)
    np.testing.assert_array_equal(L.tagged_chain("loop")[index], sign)
    assert not L.apply_boundary(L.tagged_chain("loop"), 1).any()
    np.testing.assert_array_equal(np.sort(L.tagged_facets("loop")), np.sort(index))
    assert L.tagged_chain("loop") @ K.integrate(lambda p: np.stack([-p[:, 1], p[:, 0]], 1) / 2, 1) == pytest.approx(1)
    assert not K.parts and np.shares_memory(K.simplices(2), L.simplices(2))


def test_data_of_the_same_name_give_way() -> None:
    K = derham.generate.box(2, 1)
    L = K.with_data(vertex_fields={"u": np.arange(4)}, simplex_fields={"u": [[1, 2], [3, 4]]}, parts={"a": [(0, 1)]})
    M = L.with_data(vertex_fields={"u": np.zeros(4), "v": np.ones(4)}, parts={"a": [(1, 3), (0, 3)], 4: [(0, 1)]})
    assert L.vertex_fields["u"].tolist() == [0, 1, 2, 3] and M.vertex_fields["u"].tolist() == [0, 0, 0, 0]
    assert M.simplex_fields["u"].tolist() == [[1, 2], [3, 4]] and set(M.vertex_fields) == {"u", "v"}
    assert [(p.name, p.number, p.count) for p in M.parts] == [("a", 1, 2), ("", 4, 1)]
    assert M.tagged_simplices("a").tolist() == [[1, 3], [0, 3]]


@pytest.mark.parametrize("name", ["k.npz", "k.msh", "pickle", "renumbered"])
def test_data_travel(tmp_path: Path, name: str) -> None:
    K = derham.generate.box(3, 2, jitter=0.1)
    K = K.with_data(
        parts={"wall": K.simplices(2)[K.boundary_simplices()[2]], "half": (np.arange(10), 3)},
        vertex_fields={"u": K.points[:, 0]},
        simplex_fields={"rho": np.arange(48.0)},
        forms={"w": (np.arange(K.size(1)), 1), "q": (np.arange(K.size(1)), 2, "dual")} if name in ("k.npz", "pickle") else None,
    )
    if name == "pickle":
        L = pickle.loads(pickle.dumps(K))
    elif name == "renumbered":
        L, vertices, rows = K.renumbered()
        np.testing.assert_array_equal(L.simplex_fields["rho"], K.simplex_fields["rho"][rows])
        np.testing.assert_array_equal(L.vertex_fields["u"], L.points[:, 0])
        np.testing.assert_array_equal(L.tagged_chain("half")[np.argsort(rows)], K.tagged_chain("half"))
        return
    else:
        K.write(tmp_path / name)
        L = derham.read(tmp_path / name)
    for part in ("wall", "half"):
        np.testing.assert_array_equal(L.tagged_chain(part), K.tagged_chain(part))
    np.testing.assert_array_equal(L.vertex_fields["u"], K.points[:, 0])
    np.testing.assert_array_equal(L.simplex_fields["rho"], np.arange(48.0))
    assert L.forms.keys() == K.forms.keys()
    for form, (w, k, side) in K.forms.items():
        assert L.forms[form][1:] == (k, side)
        np.testing.assert_array_equal(L.forms[form][0], w)


def test_parts_are_refined() -> None:
    K = derham.generate.box(2, 1).with_data(parts={"diagonal": [(0, 3)]}, vertex_fields={"x": [0, 1, 0, 1]})
    fine = K.refined().fine
    assert fine.parts[0].count == 2 and fine.tagged_chain("diagonal").sum() == 2
    np.testing.assert_array_equal(fine.vertex_fields["x"], fine.points[:, 0])


@pytest.mark.parametrize(("data", "message"), [
    ({"parts": {"a": [(0, 1), (1, 2)]}}, r"the part 'a': row 1, \(1, 2\), is no simplex of the complex"),
    ({"parts": {"a": [(0, 1), (1, 0)]}}, r"the part 'a': row 1, \(1, 0\), is there twice"),
    ({"parts": {"a": [0, 1]}}, r"the part 'a' has shape \(2,\); expected \(count, k\+1\) vertices, or a pair"),
    ({"parts": {"a": ([5], 1)}}, "the part 'a' has the 1-simplex 5; expected 0 to 4"),
    ({"parts": {"a": ([5], 3)}}, "the degree of the part 'a' is 3; expected 0 to 2"),
    ({"parts": {(1, 2): [(0, 1)]}}, "parts is .*; expected a mapping from names"),
    ({"parts": [(0, 1)]}, "expected a mapping from names"),
    ({"vertex_fields": {"u": [1, 2]}}, r"the field 'u' has shape \(2,\); expected \(4,\) or \(4, components\)"),
    ({"simplex_fields": {"u": [1, 2, 3, 4]}}, r"expected \(2,\) or \(2, components\)"),
    ({"forms": {"w": [1, 2]}}, r"the form 'w' is \[1, 2\]; expected \(w, k\) or \(w, k, side\)"),
    ({"forms": {"w": ([1, 2], 1)}}, r"w has shape \(2,\)"),
])
def test_wrong_data(data: dict[str, object], message: str) -> None:
    with pytest.raises(derham.InputError, match=message):
        derham.generate.box(2, 1).with_data(**data)  # type: ignore[arg-type]


def test_a_complex_that_is_not_pure_has_none() -> None:
    K = derham.Complex([(0, 1, 2), (2, 3)])
    for data in ({"parts": {"a": [(2, 3)]}}, {"vertex_fields": {"u": np.zeros(4)}}):
        with pytest.raises(derham.InputError, match="not pure"):
            K.with_data(**data)  # type: ignore[arg-type]


def test_unused_vertices_can_be_dropped() -> None:
    points = np.arange(10.0).reshape(5, 2) ** 2
    K = derham.Complex([(4, 1, 3)], points, drop_unused=True)
    assert K.sizes == (3, 3, 1) and K.vertex_tags.tolist() == [1, 3, 4]
    np.testing.assert_array_equal(K.points, points[[1, 3, 4]])
    assert derham.Complex([(7, 3), (3, 9)], drop_unused=True).size(0) == 3
    assert derham.Complex([(7, 3), (3, 9, 1)], drop_unused=True).sizes == (4, 4, 1)
    assert derham.Complex([(0, 1)], drop_unused=True).vertex_tags is None
    with pytest.raises(derham.InputError):
        derham.Complex([(4, 1, 3)], points)


def test_fields_of_one_name_are_all_there(tmp_path: Path) -> None:
    path = tmp_path / "two.vtk"
    path.write_text(
        "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 3 double\n0 0 0 1 0 0 0 1 0\nCELLS 1 4\n"
        "3 0 1 2\nCELL_TYPES 1\n5\nPOINT_DATA 3\nSCALARS u double\nLOOKUP_TABLE default\n1 2 3\nSCALARS u double\n"
        "LOOKUP_TABLE default\n4 5 6\nCELL_DATA 1\nSCALARS u double\nLOOKUP_TABLE default\n7\n"
    )
    K = derham.read(path)
    assert {name: u.tolist() for name, u in K.vertex_fields.items()} == {"u": [1, 2, 3], "u (2)": [4, 5, 6]}
    assert K.simplex_fields["u"].tolist() == [7]
