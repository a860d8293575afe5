"""Construction, lists, lookup: what goes in and what comes out."""

from __future__ import annotations

import copy
import ctypes
import gc
import itertools
import multiprocessing
import pickle
import threading
import weakref

import numpy as np
import pytest
from conftest import random_rows

import derham


def lists_of(rows: np.ndarray) -> list[set[tuple[int, ...]]]:
    """The obvious construction: all subsets of all rows."""
    return [
        {tuple(sorted(face)) for row in rows.tolist() for face in itertools.combinations(row, k + 1)}
        for k in range(rows.shape[1])
    ]


@pytest.mark.parametrize("n", range(7))
def test_lists_are_the_subsets_of_the_rows(n: int) -> None:
    rows = random_rows(n, n + 5, 9, seed=n)
    K = derham.Complex(rows)
    assert K.dimension == n and K.sizes == tuple(map(len, lists_of(rows)))
    for k, expected in enumerate(lists_of(rows)):
        found = K.simplices(k).tolist()
        assert set(map(tuple, found)) == expected
        if k < n:
            assert found == sorted(found)
    assert (K.simplices(n) == np.sort(rows, axis=1)).all()  # in the order of the input


def test_every_alias_is_found_with_its_sign() -> None:
    K = derham.Complex([(0, 1, 2, 3)])
    for alias in itertools.permutations(range(4)):
        index, sign = K.index(alias)
        assert index == 0 and sign == round(np.linalg.det(np.eye(4)[list(alias)]))
    index, sign = K.index([(3, 1), (1, 3)])
    assert index[0] == index[1] and sign.tolist() == [-1, 1]
    assert K.find((1, 1)).sign == 0


def test_input_of_any_integer_type_and_tuples() -> None:
    rows = [(0, 1, 2), (2, 1, 3)]
    expected = derham.Complex(rows).simplices(1)
    for dtype in (np.int8, np.uint8, np.int32, np.int64, np.uint64):
        assert (derham.Complex(np.array(rows, dtype)).simplices(1) == expected).all()
    fortran = np.asfortranarray(np.array(rows))
    assert (derham.Complex(fortran).simplices(1) == expected).all()


def test_mixed_dimensions_make_a_complex_that_is_not_pure() -> None:
    K = derham.Complex([(0, 1, 2), (2, 3)], points=[(0, 0), (1, 0), (0, 1), (1, 1)])
    assert K.sizes == (4, 4, 1) and not K.is_pure
    with pytest.raises(derham.TopologyError, match="pure"):
        K.volumes(1)


def test_the_empty_complex() -> None:
    K = derham.Complex([])
    assert K.sizes == (0,) and K.simplices(0).shape == (0, 1) and K.d(0).shape == (0, 0)


def test_orientation_by_volume() -> None:
    points = [(0, 0), (1, 0), (0, 1)]
    assert derham.Complex([(0, 2, 1)], points=points).signs.tolist() == [1]
    assert derham.Complex([(0, 2, 1)]).signs.tolist() == [-1]
    assert not derham.generate.moebius_strip().is_orientable


@pytest.mark.parametrize("metric", ["none", "points", "corners", "lengths"])
def test_pickle_and_copy(metric: str) -> None:
    K = {
        "none": lambda: derham.Complex(random_rows(3, 8, 9, seed=1)),
        "points": lambda: derham.generate.torus(5, 4),
        "corners": lambda: derham.generate.periodic_box(2, 4, jitter=0.2),
        "lengths": lambda: derham.Complex([(0, 2, 1), (1, 2, 3)], edge_lengths_squared=[1, 2, 1, 2, 1]),
    }[metric]()
    L = pickle.loads(pickle.dumps(K))
    assert copy.copy(K) is K and copy.deepcopy(K) is K
    for k in range(K.dimension + 1):
        assert (K.simplices(k) == L.simplices(k)).all()
    assert (K.signs == L.signs).all()
    if metric != "none":
        assert K.metric_source == L.metric_source
        np.testing.assert_allclose(K.dual_volumes(0), L.dual_volumes(0), rtol=1e-12)


MIXED = {
    "curve and triangle": lambda: derham.Complex([(0, 1, 2), (3, 2)], points=[(0, 0), (1, 0), (0, 1), (1, 1)]),
    "points and tetrahedron": lambda: derham.Complex([(4,), (3, 1, 0, 2), (5, 6)]),
    "nothing": lambda: derham.Complex([]),
    "ends of a path": lambda: derham.generate.path(3).boundary_complex()[0],
    "boundary of a cube": lambda: derham.generate.box(3, 2).boundary_complex()[0],
    "dimension 6": lambda: derham.Complex([range(7)], points=np.eye(7)),
    "Klein bottle": derham.generate.klein_bottle,
    "refined lengths": lambda: derham.Complex([(0, 2, 1)], edge_lengths_squared=[1, 2, 1]).refined().fine,
}


@pytest.mark.parametrize("make", MIXED.values(), ids=MIXED)
def test_every_complex_can_be_pickled(make) -> None:  # type: ignore[no-untyped-def]
    K = make()
    L = pickle.loads(pickle.dumps(K))
    assert (K.sizes, K.is_pure, K.metric_source, K.ambient_dimension) == (
        L.sizes, L.is_pure, L.metric_source, L.ambient_dimension)
    for k in range(K.dimension + 1):
        np.testing.assert_array_equal(K.simplices(k), L.simplices(k))
    np.testing.assert_array_equal(K.signs, L.signs)
    if K.points is not None:
        np.testing.assert_array_equal(K.points, L.points)
    if K.metric_source is not None:
        np.testing.assert_array_equal(K.volumes(K.dimension), L.volumes(K.dimension))


def test_pickles_have_the_rest_of_the_mesh(tmp_path) -> None:  # type: ignore[no-untyped-def]
    path = tmp_path / "two.msh"
    path.write_text(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n$Elements\n3\n"
        "1 1 2 8 1 2 3\n2 2 2 3 1 1 2 3\n3 2 2 3 1 1 3 4\n$EndElements\n$NodeData\n1\n\"heat\"\n1\n0\n3\n0\n1\n4\n"
        "1 0.5\n2 1\n3 2\n4 3\n$EndNodeData\n"
    )
    K = derham.read(path)
    L = pickle.loads(pickle.dumps(K))
    assert K.parts and L.parts == K.parts and L.notes == K.notes
    np.testing.assert_array_equal(L.vertex_fields["heat"], [0.5, 1, 2, 3])
    assert L.vertex_tags.tolist() == [1, 2, 3, 4] and L.simplex_tags.tolist() == [2, 3]
    np.testing.assert_array_equal(K.tagged_chain(8), L.tagged_chain(8))


def test_matrices_are_as_scipy_would_make_them() -> None:
    K = derham.generate.box(3, 2)
    for A in (K.d(1), K.d(3), K.boundary(2), K.boundary(0), K.d(1, dtype=float), K.incidence(1, 3), K.star(1, "whitney"),
              K.laplacian(0, "barycentric"), K.form_space().extension(1), K.refined().prolongation(1)):
        A.check_format(full_check=True)
        B = type(A)((A.data, A.indices, A.indptr), shape=A.shape)
        assert vars(A).keys() == vars(B).keys() and A.shape == B.shape and A.dtype == B.dtype
        assert (A != B).nnz == 0 and (A.T @ A).shape == (A.shape[1],) * 2
        A.data = 0 * A.data
    assert abs(K.d(1)).sum() == 3 * K.size(2)  # what is done to one matrix does not show in the next
    D = K.star(1)
    E = type(D)((D.data, D.offsets), shape=D.shape)
    assert vars(D).keys() == vars(E).keys() and (D.data == E.data).all() and not D.data.flags.owndata


def test_views_live_as_long_as_they_are_used() -> None:
    def fresh() -> list[np.ndarray]:
        K = derham.generate.box(3, 6)
        return [K.simplices(2), K.faces(3), K.signs, K.star(1).data, K.d(1).indices, K.points]

    kept = fresh()
    copies = [view.copy() for view in kept]
    gc.collect()
    rubble = [np.full(view.shape, 7, view.dtype) for view in kept for _ in range(20)]  # would overwrite freed memory
    gc.collect()
    for view, expected in zip(kept, copies, strict=True):
        np.testing.assert_array_equal(view, expected)
    assert len(rubble) == 20 * len(kept)


def test_views_are_read_only() -> None:
    K = derham.generate.box(2, 2)
    for view in (K.simplices(1), K.faces(2), K.signs, K.points, K.star(1).data, K.d(0).indices, K.d(0).data):
        assert not view.flags.writeable
        with pytest.raises(ValueError):
            view[...] = 0


def _euler_in_child(K: derham.Complex, queue: multiprocessing.Queue) -> None:
    L = derham.generate.box(3, 12)  # many blocks: asks for threads
    queue.put((K.euler_characteristic, L.euler_characteristic, float(L.apply_d(np.ones(L.size(0)), 0).sum())))


@pytest.mark.filterwarnings("ignore:.*fork.*")
def test_fork() -> None:
    K = derham.generate.box(3, 12)
    context = multiprocessing.get_context("fork")
    queue = context.Queue()
    child = context.Process(target=_euler_in_child, args=(K, queue))
    child.start()
    assert queue.get(timeout=60) == (1, 1, 0.0)
    child.join(60)
    assert child.exitcode == 0


def test_other_threads_run_meanwhile() -> None:
    rows = derham.generate.box(3, 30).simplices(3)
    counted, done = 0, threading.Event()

    def work() -> None:
        for _ in range(3):
            derham.Complex(rows)
        done.set()

    thread = threading.Thread(target=work)
    thread.start()
    while not done.is_set():
        counted += 1
    thread.join()
    assert counted > 1000


def test_the_same_bits_on_any_number_of_threads() -> None:
    before = derham.thread_count()
    results = []
    for count in (1, 2, 4):
        derham.set_thread_count(count)
        K = derham.generate.box(3, 6, jitter=0.3)
        results.append((K.signs.copy(), K.apply_d(np.arange(K.size(1), dtype=float) ** 0.5, 1), K.star(1).data.copy()))
    derham.set_thread_count(before)
    for other in results[1:]:
        for a, b in zip(results[0], other, strict=True):
            assert a.tobytes() == b.tobytes()


def test_repr() -> None:
    K = derham.generate.box(2, 2)
    assert repr(K) == "derham.Complex of dimension 2 in space of dimension 2: 9, 16, 8 simplices"
    assert "<td>16</td>" in K._repr_html_()
    assert "without a metric" in repr(derham.generate.klein_bottle())


@pytest.mark.parametrize(
    "rows", [[(0, 1, 2), (3, 2)], [(5, 4, 3, 6), (0, 1, 2), (2, 4), (7,)], [(0, 2, 1), (1, 2, 3), (3, 4), (4, 5)]], ids=str
)
def test_complexes_that_are_not_pure_are_pickled(rows: list[tuple[int, ...]]) -> None:
    points = np.random.default_rng(1).random((max(map(max, rows)) + 1, 3))
    K = derham.Complex(rows, points)
    L = pickle.loads(pickle.dumps(K))
    assert K.sizes == L.sizes and not L.is_pure and (K.signs == L.signs).all() and (K.points == L.points).all()
    for k in range(K.dimension + 1):
        assert (K.simplices(k) == L.simplices(k)).all()


def test_reports_spaces_and_errors_are_pickled() -> None:
    K = derham.Complex(derham.generate.ball(3, 1).simplices(3), derham.generate.ball(3, 1).points)
    R = K.refined()
    phi = derham.SimplicialMap(K, K, range(K.size(0)))
    S, Q, psi = pickle.loads(pickle.dumps((K.form_space(), R, phi)))
    assert (psi.images(1).index == phi.images(1).index).all() and psi.source is psi.target
    assert (S.free(1) == K.form_space().free(1)).all()
    assert abs(Q.prolongation(1) - R.prolongation(1)).max() == 0 and repr(Q) == repr(R)
    for report in (K.check(), K.star_verdict(1), K.quality(), K.dual_report(), K.hot_weights()):
        assert repr(pickle.loads(pickle.dumps(report))) == repr(report)
    for error in (derham.InputError("a", 3), derham.FileError("p:3: b", "p", 3, "write"), derham.GeometryError("c")):
        for other in (pickle.loads(pickle.dumps(error)), copy.copy(error)):
            assert (type(other), str(other), vars(other)) == (type(error), str(error), vars(error))


@pytest.mark.parametrize("method", ["spawn", "forkserver"])
def test_other_processes(method: str) -> None:
    with multiprocessing.get_context(method).Pool(1) as pool:
        K = derham.generate.ball(2, 3)
        (there,) = pool.map(K.dual_volumes, [1])
        assert (there == K.dual_volumes(1)).all()
        with pytest.raises(derham.InputError, match="degree k is 3"):
            pool.map(K.dual_volumes, [3])


def test_threads_in_the_same_complex() -> None:
    K = derham.generate.box(3, 6, jitter=0.3)
    w = [np.random.default_rng(1).standard_normal(size) for size in K.sizes]

    def work(found: list[bytes]) -> None:
        arrays = [
            K.apply_d(w[1], 1), K.wedge(w[1], 1, w[1], 1), K.star(1).data, K.star(2, "whitney").data, K.dual_volumes(0),
            K.locate(K.corners().mean(axis=1))[1], K.d(1, dtype=float).data, K.interior(lambda x: x, w[1], 1),
            K.boundary_complex()[0].points, K.refined().fine.signs, K.mixed_laplacian(1).matrix.data, K.incidence(0, 3).indices,
        ]  # fmt: skip
        found.extend(a.tobytes() for a in arrays)

    results: list[list[bytes]] = [[] for _ in range(5)]
    threads = [threading.Thread(target=work, args=(found,)) for found in results[1:]]
    for thread in threads:
        thread.start()
    for count in (1, 3, 2):
        derham.set_thread_count(count)
    for thread in threads:
        thread.join()
    work(results[0])
    assert all(found == results[0] for found in results) and len(results[0]) == 12


def test_a_complex_is_freed_with_its_last_reference() -> None:
    K = derham.generate.box(3, 2)
    K.locate([(0.1, 0.1, 0.1)]), K.star(1), K.d(1)
    space, reference = K.form_space(), weakref.ref(K)
    del K
    assert reference() is space.complex
    del space
    assert reference() is None


def test_reports_are_tables() -> None:
    K = derham.generate.box(2, 2)
    reports = [K.check(), K.star_verdict(1), K.star_verdict(1, "whitney"), K.quality(), K.dual_report(),
               K.dual_report().star[1], K.hot_weights(), derham.Complex([(0, 1, 2), (0, 3, 4)]).check().defects[0]]
    for report in reports:
        name = type(report).__name__
        assert repr(report).startswith(name + "\n")
        html = report._repr_html_()
        assert html.startswith(f"<table><caption>{name}</caption><tr><th>") and html.count("<tr>") == repr(report).count("\n")
    assert {type(report) for report in reports} == set(all_subclasses(derham.reports.Report))
    for other in (K.form_space(), K.refined()):
        assert other._repr_html_().startswith("<table><caption>") and type(other).__name__ in repr(other)


def all_subclasses(root: type) -> list[type]:
    return [found for child in root.__subclasses__() for found in (child, *all_subclasses(child))]


def test_loops_on_several_threads_leave_no_memory_behind() -> None:
    class Usage(ctypes.Structure):
        _fields_ = [(f"field_{i}", ctypes.c_size_t) for i in range(10)]  # the eighth: bytes in use

    libc = ctypes.CDLL(None)
    if not hasattr(libc, "mallinfo2"):
        pytest.skip("not with this C library")
    libc.mallinfo2.restype = Usage
    K, before, used = derham.generate.box(3, 12), derham.thread_count(), []
    derham.set_thread_count(2)
    for _ in range(2):
        for _ in range(50):
            K.dual_volumes(1)
        gc.collect()
        used.append(libc.mallinfo2().field_7)
    derham.set_thread_count(before)
    assert used[1] - used[0] < 100_000


def test_products_of_other_types_do_not_overflow() -> None:
    leaves = 199
    star = derham.Complex([(0, leaf) for leaf in range(1, leaves + 1)])
    d = star.d(0, dtype=int)
    assert (d.T @ d).diagonal()[0] == leaves
    assert (star.incidence(0, 1, dtype=int) @ star.incidence(1, 0, dtype=int)).diagonal()[0] == leaves
    with pytest.raises(derham.InputError):
        star.incidence(0, 1, dtype=bool)
