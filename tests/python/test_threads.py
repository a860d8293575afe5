"""Other Python threads run during all work that grows with the complex, and none of ours breaks the end of the interpreter."""

from __future__ import annotations

import subprocess
import sys
import threading
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import derham
from derham import _derham


class Work:
    """A complex of 132 thousand tetrahedra, and what its calls need."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.K = derham.generate.box(3, 28, jitter=0.2)
        self.rows = self.K.simplices(3)
        self.w = [np.ones(size) for size in self.K.sizes]
        self.all = [np.arange(size, dtype=self.rows.dtype) for size in self.K.sizes]
        self.refined = self.K.refined()
        self.tagged_file = folder / "tagged.msh"
        self.tagged_file.write_text(tagged_mesh(self.K))
        self.tagged = derham.read(self.tagged_file)
        self.place = {part.name: i for i, part in enumerate(self.tagged.parts)}
        self.core = self.K._core
        self.boundary = _derham.Boundary(self.core)
        self.star = _derham.Star(self.core, "barycentric", None, None)
        self.plane = derham.generate.box(2, 40)
        self.small = derham.generate.box(3, 10)

    @property
    def L(self) -> derham.Complex:
        """The same complex, with nothing of what it keeps."""
        return derham.Complex._of(self.K._core)


LONG: dict[str, Callable[[Work], object]] = {
    "Complex": lambda x: derham.Complex(x.rows, x.K.points),
    "read": lambda x: derham.read(x.tagged_file),
    "write": lambda x: x.K.write(x.folder / "other.msh"),
    "write_forms": lambda x: x.K.write_forms(x.folder / "picture.vtu", {"w": (x.w[1], 1)}),
    "incidence": lambda x: x.K.incidence(0, 3),
    "apply_d": lambda x: x.K.apply_d(np.ones((x.K.size(1), 20)), 1),
    "apply_boundary": lambda x: x.K.apply_boundary(np.ones((x.K.size(2), 20)), 2),
    "closure": lambda x: x.K.closure({3: x.all[3]}),
    "dual_volumes": lambda x: x.K.dual_volumes(1),
    "dual_report": lambda x: x.K.dual_report(),
    "dual_cells": lambda x: x.K.dual_cells(0, range(0, x.K.size(0), 20)),
    "star": lambda x: x.L.star(1),
    "star_verdict": lambda x: x.K.star_verdict(1, "barycentric"),
    "Whitney mass": lambda x: x.K.star(1, "whitney"),
    "hot_weights": lambda x: x.plane.hot_weights(),
    "codifferential": lambda x: x.K.codifferential(1, "barycentric"),
    "laplacian": lambda x: x.K.laplacian(1, "barycentric"),
    "weak_laplacian": lambda x: x.K.weak_laplacian(1, "barycentric"),
    "mixed_laplacian": lambda x: x.K.mixed_laplacian(1),
    "locate": lambda x: x.L.locate([[0.5, 0.5, 0.5]]),
    "locate many": lambda x: x.K.locate(x.K.points),
    "interpolate": lambda x: x.K.interpolate(x.w[1], 1),
    "sharp": lambda x: x.K.sharp(x.w[1], "pp"),
    "interior": lambda x: x.K.interior([1.0, 0, 0], x.w[2], 2),
    "interior of a function": lambda x: x.K.interior(lambda p: p, x.w[2], 2),
    "cfl_bound": lambda x: x.K.cfl_bound([1.0, 0, 0]),
    "refined": lambda x: x.K.refined(),
    "prolongation": lambda x: x.refined.prolongation(1),
    "restriction": lambda x: x.refined.restriction(1),
    "renumbered": lambda x: x.K.renumbered(),
    "generate.box": lambda x: derham.generate.box(3, 28),
    "barycentric_subdivision": lambda x: derham.generate.barycentric_subdivision(x.small),
}


SHORT: dict[str, Callable[[Work], object]] = {
    "Complex": lambda x: _derham.Complex(x.rows, x.K.size(0), None, None, None),
    "state": lambda x: x.core.state(),
    "component_count": lambda x: x.core.component_count(),
    "check": lambda x: x.core.check(),
    "find": lambda x: x.core.find(x.rows),
    "incidence": lambda x: x.core.incidence(0, 3),
    "open_star": lambda x: x.core.open_star([x.all[0][:1], x.all[1][:1]]),
    "link": lambda x: x.core.link([x.all[0][:1], x.all[1][:1]]),
    "boundary_simplices": lambda x: x.core.boundary_simplices(),
    "Boundary": lambda x: _derham.Boundary(x.core),
    "Boundary.complex": lambda x: x.boundary.complex(),
    "Boundary.trace": lambda x: x.boundary.trace(1, x.w[1]),
    "Boundary.trace_matrix": lambda x: x.boundary.trace_matrix(1),
    "SimplicialMap": lambda x: _derham.SimplicialMap(x.core, x.core, x.all[0]),
    "corners": lambda x: x.core.corners(),
    "volumes": lambda x: [x.core.volumes(k) for k in (1, 3)],
    "edge_lengths_squared": lambda x: x.core.edge_lengths_squared(),
    "quality": lambda x: x.core.quality(),
    "renumbered": lambda x: x.core.renumbered(False),
    "inverse_diagonal": lambda x: x.star.inverse_diagonal(1),
    "nodes": lambda x: x.core.nodes(1, 3),
    "flat": lambda x: x.core.flat("ppp", x.K.points),
    "apply_wedge": lambda x: x.core.apply_wedge(1, x.w[1], 2, x.w[2], x.w[3]),
    "form_space": lambda x: x.core.form_space(None),
    "with_data": lambda x: x.tagged._core.with_data([], [], [], []),
    "tagged_chain": lambda x: x.tagged._core.tagged_chain(x.place["body"], False),
    "tagged_facets": lambda x: x.tagged._core.tagged_facets(x.place["skin"]),
}


def tagged_mesh(K: derham.Complex) -> str:
    """K as Gmsh has it, with a part "body" of all tetrahedra and a part "skin" of the facets on the boundary."""
    parts = {2: K.simplices(2)[K.boundary_simplices()[2]], 3: K.simplices(3)}
    elements = [
        f"{2 * degree - 2} 2 {degree} {degree} {' '.join(map(str, row))}"
        for degree, rows in parts.items()
        for row in (rows + 1).tolist()
    ]
    points = [f"{i} {x} {y} {z}" for i, (x, y, z) in enumerate(K.points.tolist(), 1)]
    lines = [
        "$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", "2", '2 2 "skin"', '3 3 "body"', "$EndPhysicalNames",
        "$Nodes", str(len(points)), *points, "$EndNodes",
        "$Elements", str(len(elements)), *(f"{i} {element}" for i, element in enumerate(elements, 1)), "$EndElements", "",
    ]  # fmt: skip
    return "\n".join(lines)


@pytest.fixture(scope="module")
def work(tmp_path_factory: pytest.TempPathFactory) -> Work:
    return Work(tmp_path_factory.mktemp("meshes"))


def longest_pause_of_another_thread(call: Callable[[], object]) -> float:
    """Of a thread that does nothing but wake up, as a part of the time of the call."""
    done, ticks = threading.Event(), [0.0]

    def tick() -> None:
        while not done.is_set():
            time.sleep(0.0003)
            ticks.append(time.perf_counter())

    worker = threading.Thread(target=tick)
    worker.start()
    while len(ticks) < 3:
        time.sleep(0.001)
    begin = time.perf_counter()
    call()
    end = time.perf_counter()
    done.set()
    worker.join()
    times = [begin, *(t for t in ticks if begin < t < end), end]
    return max(b - a for a, b in zip(times, times[1:])) / (end - begin)


@pytest.mark.parametrize("name", LONG)
def test_other_threads_run_meanwhile(name: str, work: Work) -> None:
    """If the lock of the interpreter were held, the pause would be the whole call, every time."""
    assert any(longest_pause_of_another_thread(lambda: LONG[name](work)) < 0.6 for _ in range(25))


def test_a_lock_that_is_held_is_a_pause() -> None:
    text = "a" * 20_000_000
    assert min(longest_pause_of_another_thread(lambda: text.encode("utf-16")) for _ in range(3)) > 0.6


def another_thread_runs_during(call: Callable[[], object]) -> bool:
    """Whether the lock is given up during a call, however short, if the thread that waits for it wakes up in time."""
    done, count = threading.Event(), 0

    def run() -> None:
        nonlocal count
        while not done.is_set():
            time.sleep(0)
            count += 1

    interval = sys.getswitchinterval()
    worker = threading.Thread(target=run)
    sys.setswitchinterval(1000)  # nobody takes the lock away
    try:
        worker.start()
        before = count
        call()
        return count > before
    finally:
        done.set()
        sys.setswitchinterval(interval)
        worker.join()


@pytest.mark.parametrize("name", SHORT)
def test_short_calls_give_up_the_lock(name: str, work: Work) -> None:
    assert any(another_thread_runs_during(lambda: SHORT[name](work)) for _ in range(200))


def test_nobody_takes_the_lock_away() -> None:
    text = "a" * 200_000
    assert not any(another_thread_runs_during(lambda: text.encode("utf-16")) for _ in range(50))


@pytest.mark.parametrize("work", ["derham.Complex(rows)", "K.interior(lambda x: x, K.points[:, 0], 1)"])
def test_threads_of_the_background_end_with_the_interpreter(work: str) -> None:
    program = f"""
import threading, time, derham
K = derham.generate.box(1, 100_000) if "interior" in {work!r} else derham.generate.box(3, 20)
rows = K.simplices(K.dimension)
started = threading.Event()
def run():
    while True:
        {work.replace("K.points[:, 0]", "rows[:, 0] * 1.0")}
        started.set()
for _ in range(2):
    threading.Thread(target=run, daemon=True).start()
started.wait()
time.sleep(0.02)
"""
    for _ in range(3):
        ended = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=60, check=False)
        assert (ended.returncode, ended.stderr) == (0, "")
