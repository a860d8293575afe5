"""Whatever is given as an argument of whatever is public: it works, or a derham.Error says what was expected."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest

import derham

RAGGED: list[Any] = [[0, 1], [1]]

ODD: list[Any] = [
    None, True, -1, 0, 1, 3, 7, 2**31, 2**63, 2**70, 1.0, 1.5, np.nan, np.inf, 1j, "a", "", "\udcff", b"x", (), [], {}, {0: [0]},
    {9: [0]}, {"a": [0]}, {0: [-1]}, {0: [0.5]}, {0: 5}, {0: RAGGED}, [[0, 1]], RAGGED, [range(15)], range(15), [[]], [None],
    ["a"], [2**70], (1, 2), (1, 2, 3), np.int64(1), np.int8(1), np.uint64(2), np.float32(1), np.True_, np.array(1),
    np.array([1]), np.zeros(0), np.zeros((0, 2)), np.zeros((0, 3), int), np.zeros((3, 0)), np.ones(3), np.ones((2, 2)),
    np.ones((3, 3, 3)), np.full((4, 2), np.nan), np.full((4, 2), 1e300), np.full((4, 3), np.inf),
    np.ma.masked_array([1.0, 2, 3], [0, 1, 0]), np.array([1, 2], object), np.array(["2020"], "datetime64[D]"), object(),
    object, iter([1, 2]), slice(3), lambda x: x, lambda x: None, "primal", "dual", "whitney", "power", np.float64, "float16",
    bool, np.uint8,
]  # fmt: skip


def strip(**metric: Any) -> derham.Complex:
    return derham.Complex([(0, 1, 2), (1, 2, 3)], **metric)


COMPLEXES: dict[str, Callable[[], derham.Complex]] = {
    "empty": lambda: derham.Complex([]),
    "points": lambda: derham.Complex([(0,), (1,)], points=[(0,), (1,)]),
    "interval": lambda: derham.generate.box(1, 3),
    "square": lambda: derham.generate.box(2, 2, jitter=0.2),
    "cube": lambda: derham.generate.box(3, 1),
    "n = 4": lambda: derham.generate.regular_simplex(4),
    "n = 5": lambda: derham.generate.sphere(5),
    "n = 6": lambda: derham.generate.regular_simplex(6),
    "not orientable": derham.generate.moebius_strip,
    "not pure": lambda: derham.Complex([(0, 1, 2), (2, 3)], points=[(0, 0), (1, 0), (0, 1), (1, 1)]),
    "disconnected": lambda: derham.generate.disjoint_union(derham.generate.cycle(3), derham.generate.path(2)),
    "lengths": lambda: strip(edge_lengths_squared=[1, 2, 1, 2, 1]),
    "corners": lambda: derham.generate.periodic_box(2, 3),
    "flat": lambda: strip(points=[(0, 0), (1, 0), (2, 0), (3, 0)]),
    "boundary": lambda: derham.generate.box(3, 1).boundary_complex()[0],
}


def calls(K: derham.Complex, path: str) -> dict[str, tuple[Any, ...]]:
    """Arguments of every method that takes some, which are right where the complex has what they ask for."""
    n, k, m = K.dimension, min(1, K.dimension), K.ambient_dimension or max(K.dimension, 1)
    w0, w1 = np.ones(K.size(0)), np.ones(K.size(k))
    return {
        "size": (0,), "dual_cells": (n, [0]), "dual_volumes": (0,), "volumes": (0,), "star": (k,), "star_inverse": (k,),
        "star_verdict": (k,), "hot_weights": (), "form_space": (), "tagged_chain": ("a",), "wedge": (w0, 0, w1, k),
        "codifferential": (k,), "laplacian": (k,), "weak_laplacian": (k,), "mixed_laplacian": (k,), "integrate": (1.0, 0),
        "locate": (np.zeros((2, m)),), "interpolate": (w1, k), "sharp": (w1,), "flat": (np.zeros((K.size(0), m)),),
        "interior": (np.ones(m), w1, k), "lie": (np.ones(m), w1, k), "apply_d": (w0, 0), "apply_boundary": (w1, k),
        "boundary": (k,), "d": (0,), "chain": ([[0]],), "find": ([[0]],), "index": ([[0]],), "incidence": (0, n),
        "closure": ({0: [0]},), "open_star": ({0: [0]},), "link": ({0: [0]},), "simplices": (0,), "faces": (k,),
        "write": (path,), "write_forms": (path + ".vtu", {"u": (w0, 0)}), "trace": (w0, 0), "trace_matrix": (0,),
        "boundary_term": (np.ones(2), 0), "boundary_load": (np.ones(2), 0, np.eye(2)), "robin_matrix": (0, np.eye(2)),
        "boundary_material": ([([0], 1.0)],), "cfl_bound": (np.ones(m),), "tagged_facets": ("a",),
        "tagged_simplices": ("a",),
        "renumbered": (),
    }  # fmt: skip


def variations(function: Any, arguments: tuple[Any, ...]) -> Iterator[tuple[tuple[Any, ...], dict[str, Any]]]:
    """Every argument replaced by every odd value, and every other one given."""
    yield arguments, {}
    for place in range(len(arguments)):
        for value in ODD:
            yield (*arguments[:place], value, *arguments[place + 1 :]), {}
    for name in list(inspect.signature(function).parameters)[len(arguments) :]:
        for value in ODD:
            yield arguments, {name: value}


def require_errors_of_ours(function: Callable[..., Any], arguments: tuple[Any, ...]) -> None:
    for args, kwargs in variations(function, arguments):
        try:
            function(*args, **kwargs)
        except derham.Error as error:
            assert "\n" not in str(error)
        except Exception as error:  # of a function that is an argument
            assert any(callable(value) for value in (*args, *kwargs.values())), (function, args, kwargs, error)


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("name", COMPLEXES)
def test_methods(name: str, tmp_path, monkeypatch) -> None:  # type: ignore[no-untyped-def]
    monkeypatch.chdir(tmp_path)  # some odd values are names of files
    K = COMPLEXES[name]()
    all_calls = calls(K, str(tmp_path / "mesh.off"))
    for method, arguments in all_calls.items():
        require_errors_of_ours(getattr(K, method), arguments)
    for method in dir(derham.Complex):
        if not method.startswith("_") and method not in all_calls:
            try:
                value = getattr(K, method)
                repr(value() if callable(value) else value)
            except derham.Error:
                pass
    repr(K), K._repr_html_()


@pytest.mark.filterwarnings("ignore")
def test_functions(tmp_path) -> None:  # type: ignore[no-untyped-def]
    K, count = derham.generate.box(2, 1), derham.thread_count()
    require_errors_of_ours(derham.Complex, (K.simplices(2),))
    require_errors_of_ours(derham.Complex, ([(0, 1, 2), (2, 3)],))
    require_errors_of_ours(derham.read, (str(tmp_path / "nothing.off"),))
    require_errors_of_ours(derham.from_meshio, (None,))
    require_errors_of_ours(derham.rips, ([(0, 0), (1, 0)], 1.0, 1))
    require_errors_of_ours(derham.set_thread_count, (count,))
    derham.set_thread_count(count)
    require_errors_of_ours(derham.SimplicialMap, (K, K, [0, 1, 2, 3]))
    for whole in (K.form_space(), K.refined(), derham.SimplicialMap(K, K, [0, 1, 2, 3])):
        for method, function in inspect.getmembers(whole, inspect.ismethod):
            if not method.startswith("_"):
                required = [p for p in inspect.signature(function).parameters.values() if p.default is p.empty]
                require_errors_of_ours(function, (np.ones(K.size(1)), 1)[-len(required) :])


@pytest.mark.filterwarnings("ignore")
def test_generators() -> None:
    usual: dict[str, Any] = {
        "dimension": 2, "cells": 3, "layers": 1, "level": 0, "segments": 5, "sides": 4, "rings": 1, "spec": "2x2x1",
        "size": 4, "p": 5, "q": 2, "a": derham.generate.cycle(3), "b": derham.generate.path(2),
    }  # fmt: skip
    for name, function in inspect.getmembers(derham.generate, inspect.isfunction):
        if function.__module__ == "derham.generate" and not name.startswith("_"):
            required = [p.name for p in inspect.signature(function).parameters.values() if p.default is p.empty]
            arguments = (3, 3) if name == "clifford_torus" else tuple(usual[p] for p in required)
            require_errors_of_ours(function, arguments)


def test_arrays_of_every_layout_are_the_same() -> None:
    K = derham.generate.box(2, 3, jitter=0.2)
    w = np.random.default_rng(1).integers(-9, 9, K.size(1)).astype(float)
    expected = K.apply_d(w, 1)
    twice = np.zeros(2 * len(w))
    twice[::2] = w
    frozen = w.copy()
    frozen.flags.writeable = False
    layouts = [
        w.tolist(), tuple(w), twice[::2], w[::-1].copy()[::-1], w.astype(">f8"), w.astype(np.float32), w.astype(np.int8),
        w.astype(np.longdouble), frozen, np.ma.masked_array(w), np.asfortranarray(w), memoryview(w), Wrapped(w),
    ]  # fmt: skip
    for layout in layouts:
        assert (K.apply_d(layout, 1) == expected).all()
    columns = np.stack([w, -w, 2 * w], axis=1)
    for layout in (columns, np.asfortranarray(columns), columns[::-1].copy()[::-1], columns.astype(">f4")):
        assert (K.apply_d(layout, 1) == np.stack([expected, -expected, 2 * expected], axis=1)).all()
    rows, points = K.simplices(2), K.points
    same = (rows[::-1].copy()[::-1], np.asfortranarray(rows), rows.astype(">i8"), rows.tolist(), Wrapped(rows), iter(rows))
    for a in same:
        L = derham.Complex(a, np.asfortranarray(points))
        assert (L.simplices(1) == K.simplices(1)).all() and (L.points == points).all()


class Wrapped:
    """What a data frame or a tensor is to numpy; its rows are not what one finds by iterating."""

    def __init__(self, array: np.ndarray) -> None:
        self.array = array

    def __array__(self, dtype: Any = None, copy: Any = None) -> np.ndarray:
        return np.array(self.array, dtype)

    def __iter__(self) -> Iterator[str]:
        return iter(("name of a column",))


def test_arguments_are_copied_or_only_read() -> None:
    rows, points = np.array([(0, 1, 2), (1, 2, 3)]), np.array([(0, 0), (1, 0), (0, 1), (1, 1.0)])
    K, weights = derham.Complex(rows, points), np.zeros(4)
    star = K.star(1, "power", weights=weights)
    before = star.diagonal().copy()
    rows[:], points[:], weights[:] = 0, 9, 0.1
    assert K.simplices(2).tolist() == [[0, 1, 2], [1, 2, 3]] and K.points.max() == 1
    assert (star.diagonal() == before).all()


def test_out_is_not_the_argument() -> None:
    K = derham.generate.cycle(4)
    memory = np.arange(5.0)
    for out in (memory[:4], memory[1:]):
        for action in (K.apply_d, K.apply_boundary, lambda w, k, out: K.apply_d(w, 0, "dual", out)):
            with pytest.raises(derham.InputError, match="shares memory"):
                action(memory[:4], int(action == K.apply_boundary), out=out)
    assert memory.tolist() == [0, 1, 2, 3, 4]
