#!/usr/bin/env python3
"""Measures libraries that have Python packages on the meshes that bench_peers --save wrote, and reports as Google Benchmark.

usage: bench/peers/peers.py FOLDER REPORT.json [REPETITIONS] [--benchmark_filter=REGEX]

Every task is a function that prepares and returns what is timed, so that copying a mesh into a library is not counted.
Packages that are missing are skipped, and tasks whose "name/order" the regular expression is not in.
"""
import gc
import importlib
import json
import re
import sys
import time
from pathlib import Path

import numpy as np


def numpy_faces(simplices, vertices):
    """Lists and face tables of every degree, by sorting (as PyDEC does): {k: (k-simplices, their faces or None)}."""
    tables = {}
    current = np.sort(simplices, axis=1).astype(np.int64)
    while True:
        k = current.shape[1] - 1
        if k == 0:
            tables[0] = (current, None)
            return tables
        faces = np.concatenate([np.delete(current, i, axis=1) for i in range(k, -1, -1)])
        keys = np.zeros(len(faces), np.int64)
        for column in faces.T:
            keys = keys * vertices + column
        _, first, inverse = np.unique(keys, return_index=True, return_inverse=True)
        tables[k] = (current, inverse.reshape(k + 1, -1).T)
        current = faces[first]


def scipy_d1(simplices, vertices, dtype=np.float64):
    import scipy.sparse
    tables = numpy_faces(simplices, vertices)
    faces = tables[2][1]
    values = np.tile(np.array([1, -1, 1], dtype), len(faces))
    starts = 3 * np.arange(len(faces) + 1, dtype=np.int32)  # csr_array would keep indices of 64 bits
    return scipy.sparse.csr_array((values, faces.ravel().astype(np.int32), starts), shape=(len(faces), len(tables[1][0])))


def numpy_construction(simplices, points):
    return lambda: numpy_faces(simplices, len(points))


def scipy_derivative(simplices, points):
    matrix = scipy_d1(simplices, len(points))
    x = np.ones(matrix.shape[1])
    return lambda: matrix @ x


def scipy_derivative_int8(simplices, points):
    matrix = scipy_d1(simplices, len(points), np.int8)
    x = np.ones(matrix.shape[1])
    return lambda: matrix @ x


def scipy_curl_curl(simplices, points):
    d = scipy_d1(simplices, len(points))
    matrix = (d.T @ d).tocsr()
    x = np.ones(matrix.shape[1])
    return lambda: matrix @ x


def skfem_construction(simplices, points):
    import skfem
    kind = skfem.MeshTet if simplices.shape[1] == 4 else skfem.MeshTri
    p, t = np.ascontiguousarray(points.T), np.ascontiguousarray(simplices.T.astype(np.int64))

    def run():
        mesh = kind(p, t, sort_t=True, validate=False)
        return (mesh.facets, mesh.t2f) + ((mesh.edges, mesh.t2e) if simplices.shape[1] == 4 else ())
    return run


def mfem_construction(simplices, points):
    from mfem import ser as mfem

    def prepare():
        mesh = mfem.Mesh(3, len(points), len(simplices))
        for p in points.tolist():
            mesh.AddVertex(*p)
        for t in simplices.tolist():
            mesh.AddTet(*t)
        return mesh
    return lambda mesh: mesh.FinalizeTetMesh(1, 0, True), prepare


def netgen_construction(simplices, points):
    import netgen.meshing
    import ngsolve

    def prepare():
        mesh = netgen.meshing.Mesh(dim=3)
        mesh.AddPoints(points)
        mesh.Add(netgen.meshing.FaceDescriptor(bc=1))
        mesh.AddElements(dim=3, index=1, data=simplices.astype(np.int32), base=0)
        return mesh
    return ngsolve.Mesh, prepare


def igl_construction(simplices, points):
    import igl
    return lambda: igl.edge_topology(points, simplices)


def igl_laplacian(simplices, points):
    import igl
    return lambda: (igl.cotmatrix(points, simplices), igl.massmatrix(points, simplices))


TASKS = [  # name, packages, number of vertices of a simplex, function
    ("construction: numpy, by sorting", "numpy", 4, numpy_construction),
    ("construction: scikit-fem", "scikit-fem", 4, skfem_construction),
    ("construction: MFEM", "mfem", 4, mfem_construction),
    ("construction: NGSolve", "ngsolve", 4, netgen_construction),
    ("construction: numpy, by sorting", "numpy", 3, numpy_construction),
    ("construction: scikit-fem", "scikit-fem", 3, skfem_construction),
    ("construction: libigl (edges)", "libigl", 3, igl_construction),
    ("d_1 x: scipy", "scipy", 4, scipy_derivative),
    ("d_1 x: scipy, values of int8", "scipy", 4, scipy_derivative_int8),
    ("curl-curl x: scipy, assembled", "scipy", 4, scipy_curl_curl),
    ("Laplacian and mass matrix: libigl", "libigl", 4, igl_laplacian),
    ("Laplacian and mass matrix: libigl", "libigl", 3, igl_laplacian),
]
MODULES = {"scikit-fem": "skfem", "libigl": "igl"}


def present(package):
    try:
        importlib.import_module(MODULES.get(package, package))
        return True
    except ImportError:
        print(f"{package} is not installed", file=sys.stderr)
        return False


def seconds(run, prepare):
    """One run; what it returns is freed outside of the time."""
    prepared = (prepare(),) if prepare else ()
    gc.disable()
    start = time.perf_counter()
    result = run(*prepared)
    elapsed = time.perf_counter() - start
    gc.enable()
    del result, prepared
    return elapsed


def repetitions_of(task, simplices, points, count):
    """Seconds of every repetition: as many as asked, fewer if one takes more than ten seconds."""
    made = task(simplices, points)
    run, prepare = made if isinstance(made, tuple) else (made, None)
    times = []
    while len(times) < count and sum(times) < 10 * count:
        times.append(seconds(run, prepare))
    return times


def main(folder, report, count=5, regex=""):
    benchmarks = []
    for path in sorted(Path(folder).glob("*.npz")):
        with np.load(path) as file:
            simplices, points = file["simplices"], file["points"]
        for name, package, width, task in TASKS:
            wanted = re.search(regex, f"{name}/{path.stem}")
            if simplices.shape[1] != width or not wanted or not present(package):
                continue
            for i, elapsed in enumerate(repetitions_of(task, simplices, points, int(count))):
                benchmarks.append({"run_name": f"{name}/{path.stem}/threads:1", "run_type": "iteration",
                                   "repetition_index": i, "items": len(simplices), "real_time": 1e3 * elapsed,
                                   "time_unit": "ms", "ns/item": 1e9 * elapsed / len(simplices)})
    Path(report).write_text(json.dumps({"benchmarks": benchmarks}, indent=1), encoding="utf-8")


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    given = [a for a in sys.argv[1:] if not a.startswith("--benchmark_filter=")]
    main(*given, regex=next((a.partition("=")[2] for a in sys.argv if a.startswith("--benchmark_filter=")), ""))
