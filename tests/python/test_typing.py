"""What a type checker makes of a program that uses the package."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

PROGRAM = """
import numpy as np
import derham

K = derham.generate.box(2, (3, 4), lengths=(1.0, 2.0), jitter=0.1)
L = derham.Complex([(0, 1, 2), (2, 3)], points=[(0, 0), (1, 0), (0, 1), (1, 1)])
M = derham.Complex(np.array([[0, 1, 2]]), np.zeros((3, 2)))
x = K.points[:, 0]
w = K.integrate(lambda x: np.stack([x[:, 1], -x[:, 0]], axis=1), 1)
density: np.ndarray[tuple[int, ...], np.dtype[np.float64]] = K.apply_d(w, 1)
stiffness = K.d(0).T @ K.star(1, "power", weights=np.zeros(K.size(0))) @ K.d(0)
star = K.star(1, material=(np.eye(2)[np.newaxis], np.zeros(K.size(2), int)))
K.star(1, "round")  # error: arg-type
K.star(1, kinds="whitney")  # error: call-arg
K.star(1, "whitney")
K.star_inverse(1, "whitney")  # error: arg-type
K.codifferential(1, "whitney")  # error: arg-type
K.laplacian(1, "whitney")  # error: arg-type
K.weak_laplacian(1, "whitney")  # error: arg-type
K.interior(np.ones(2), w, 1, star="whitney")  # error: arg-type
K.points.position  # error: union-attr
K.index((0, 1)).position  # error: attr-defined
K.index([(0, 1)]).index.position  # error: union-attr
K.find([(0, 1)]).sign.astype(float)
where = K.locate([0.1, 0.1], nearest=True)
where.distance + 1, K.points[K.simplices(2)[where.simplex]].T @ where.barycentric
K.locate([0.1, 0.1], nearby=True)  # error: call-arg
boundary, inclusion = K.boundary_complex()
boundary.simplices(1)[inclusion[0]]
if K.check() and K.star_verdict(1):
    print(K.check().verdict.upper(), K.star_verdict(1).condition + 1)
K.check().verdict = "yes"  # error: misc
index, sign = K.find([(0, 1)])
fine: derham.Complex = K.refined().fine
E = K.form_space([0, 1]).extension(0)
K.lie(lambda x: x, w, 1, trace="upwind")
K.closure({0: [1, 2]})[1].tolist()
try:
    derham.read("mesh.msh", planar=True).write("mesh.vtu", binary=False)
except derham.FileError as error:
    print(error.line + 1, error.path.upper())
derham.set_thread_count("two")  # error: arg-type
derham.rips(np.zeros((3, 2)), 0.5, 1).laplacian(0)
"""


def test_a_program_is_checked(tmp_path: Path) -> None:
    api = pytest.importorskip("mypy.api")
    path = tmp_path / "program.py"
    path.write_text(PROGRAM)
    output, _, _ = api.run(["--strict", f"--cache-dir={tmp_path}", str(path)])
    remarks = [re.search(r"# error: (\S+)", line) for line in PROGRAM.splitlines()]
    expected = [(str(i), remark[1]) for i, remark in enumerate(remarks, 1) if remark]
    assert re.findall(r"program\.py:(\d+): error: .*\[(\S+)\]", output) == expected, output
