#!/usr/bin/env python3
"""What a call of the Python package costs on the smallest meshes: every public method of Complex and more, in microseconds.

    python bench/python_overhead.py [--threads COUNT] [--limit MICROSECONDS]

The least of 20 repeats, because other work on the machine only adds. Calls above the limit are marked; the exit status is 1 if
there are any. What writes files or pickles, and what solves (`hot_weights`), is measured but has no limit.
"""

from __future__ import annotations

import argparse
import pickle
import sys
import tempfile
import timeit
from collections.abc import Callable
from pathlib import Path

import numpy as np

import derham

REPEATS, SECONDS = 20, 0.003
UNLIMITED = {"hot_weights", "pickle", "write", "write_forms"}


def microseconds(action: Callable[[], object]) -> float:
    action()  # makes what is kept
    number = max(1, int(SECONDS / max(1e-7, min(timeit.repeat(action, number=1, repeat=5)))))
    return min(timeit.repeat(action, number=number, repeat=REPEATS)) / number * 1e6


def calls(folder: Path) -> dict[str, Callable[[], object]]:
    """A call of every method, and of some with other arguments, by name."""
    K = derham.Complex(np.array([[0, 1, 2], [1, 2, 3]], np.int32), np.array([[0, 0], [1, 0], [0.5, 1], [1.5, 1]]))
    rows, points = K.simplices(2), K.points
    B = K.boundary_complex()[0]
    u, w, q, b = (np.ones(count) for count in (*K.sizes, B.size(0)))  # a function, a 1-form, a density; on the boundary
    X, at = np.array([1.0, 2.0]), np.array([[0.5, 0.3]])
    S, space, edge = B.star(0), K.form_space(), np.array([[0, 1]], np.int32)
    tagged = K.with_data(parts={"part": edge})
    return {
        "Complex(rows)": lambda: derham.Complex(rows),
        "Complex(rows, points)": lambda: derham.Complex(rows, points),
        "pickle": lambda: pickle.loads(pickle.dumps(K)),
        "ambient_dimension": lambda: K.ambient_dimension,
        "apply_boundary": lambda: K.apply_boundary(w, 1),
        "apply_d": lambda: K.apply_d(u, 0),
        "apply_d, dual": lambda: K.apply_d(q, 0, "dual"),
        "apply_d, boundary": lambda: K.apply_d(q, 0, "dual", boundary=b),
        "boundary": lambda: K.boundary(1),
        "boundary_complex": K.boundary_complex,
        "boundary_load": lambda: K.boundary_load(b, 0, S),
        "boundary_material": lambda: K.boundary_material([([0], 1.0)]),
        "boundary_simplices": K.boundary_simplices,
        "boundary_term": lambda: K.boundary_term(b, 0),
        "cfl_bound": lambda: K.cfl_bound(X),
        "chain": lambda: K.chain(edge),
        "check": K.check,
        "closure": lambda: K.closure({1: [0]}),
        "codifferential": lambda: K.codifferential(1, "barycentric"),
        "components": lambda: K.components,
        "corners": K.corners,
        "d": lambda: K.d(0),
        "d, dual": lambda: K.d(0, "dual"),
        "dimension": lambda: K.dimension,
        "dual_cells": lambda: K.dual_cells(0, [0]),
        "dual_report": K.dual_report,
        "dual_volumes": lambda: K.dual_volumes(0),
        "edge_lengths_squared": K.edge_lengths_squared,
        "euler_characteristic": lambda: K.euler_characteristic,
        "faces": lambda: K.faces(2),
        "find": lambda: K.find(edge),
        "flat": lambda: K.flat(points),
        "form_space": K.form_space,
        "forms": lambda: K.forms,
        "form_space.extension": lambda: space.extension(0),
        "hot_weights": K.hot_weights,
        "incidence": lambda: K.incidence(0, 2),
        "index": lambda: K.index(edge),
        "integrate": lambda: K.integrate(X, 1),
        "interior": lambda: K.interior(X, w, 1),
        "interior, algebraic": lambda: K.interior(w, q, 2, kind="algebraic", star="barycentric"),
        "interpolate": lambda: K.interpolate(w, 1),
        "is_orientable": lambda: K.is_orientable,
        "is_pure": lambda: K.is_pure,
        "laplacian": lambda: K.laplacian(0),
        "lie": lambda: K.lie(X, w, 1),
        "link": lambda: K.link({0: [0]}),
        "locate": lambda: K.locate(at),
        "metric_source": lambda: K.metric_source,
        "mixed_laplacian": lambda: K.mixed_laplacian(1),
        "mixed_laplacian, space": lambda: K.mixed_laplacian(1, space=space),
        "notes": lambda: K.notes,
        "one_sided": lambda: K.one_sided,
        "open_star": lambda: K.open_star({0: [0]}),
        "oriented_simplices": K.oriented_simplices,
        "parts": lambda: K.parts,
        "points": lambda: K.points,
        "quality": K.quality,
        "refined": K.refined,
        "renumbered": K.renumbered,
        "rips": lambda: derham.rips(points, 1.2, 2),
        "robin_matrix": lambda: K.robin_matrix(0, S),
        "sharp": lambda: K.sharp(w),
        "signs": lambda: K.signs,
        "simplex_fields": lambda: K.simplex_fields,
        "simplex_tags": lambda: K.simplex_tags,
        "simplices": lambda: K.simplices(1),
        "size": lambda: K.size(1),
        "sizes": lambda: K.sizes,
        "star": lambda: K.star(0),
        "star, whitney": lambda: K.star(1, "whitney"),
        "star_inverse": lambda: K.star_inverse(0),
        "star_verdict": lambda: K.star_verdict(1),
        "tagged_chain": lambda: tagged.tagged_chain("part"),
        "tagged_facets": lambda: tagged.tagged_facets("part"),
        "tagged_simplices": lambda: tagged.tagged_simplices("part"),
        "trace": lambda: K.trace(w, 1),
        "trace_matrix": lambda: K.trace_matrix(1),
        "vertex_fields": lambda: K.vertex_fields,
        "vertex_tags": lambda: K.vertex_tags,
        "volumes": lambda: K.volumes(1),
        "weak_laplacian": lambda: K.weak_laplacian(0),
        "with_data": lambda: K.with_data(vertex_fields={"u": u}),
        "wedge": lambda: K.wedge(u, 0, w, 1),
        "wedge, dual": lambda: K.wedge(q, 0, w, 1, sides=("dual", "primal")),
        "write": lambda: K.write(folder / "mesh.off"),
        "write_forms": lambda: K.write_forms(folder / "forms.vtu", {"u": (u, 0)}),
    }


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--threads", type=int, default=derham.thread_count())
    parser.add_argument("--limit", type=float, default=20)
    options = parser.parse_args()
    derham.set_thread_count(options.threads)
    above = []
    with tempfile.TemporaryDirectory() as folder:
        measured = calls(Path(folder))
        public = {name for name in dir(derham.Complex) if not name.startswith("_")}
        missing = public - {name.partition(",")[0] for name in measured}
        if missing:
            sys.exit(f"no call of {', '.join(sorted(missing))} is measured")
        for name, action in measured.items():
            time = microseconds(action)
            slow = time > options.limit and name not in UNLIMITED
            above += [name] * slow
            print(f"{name:24}{time:9.1f} µs{'  above the limit' if slow else ''}")
    print(f"{len(measured)} calls, {options.threads} threads; {len(above)} above {options.limit:g} µs")
    return bool(above)


if __name__ == "__main__":
    sys.exit(main())
