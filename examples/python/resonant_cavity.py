"""The modes of a square resonant cavity, d δ E = λ E with E tangentially 0 on the boundary: 1, 1, 2, 4, 4, 5, 5, 8, …

The mesh is PyDEC's. One of its edges is not Delaunay: the diagonal star is negative there, and the star's verdict says
so. The Whitney mass is positive.
"""

from pathlib import Path

import numpy as np
import scipy.sparse.linalg as linalg

import derham

K = derham.read(Path(__file__).parents[2] / "tests" / "dual" / "cavity" / "cavity2d.node")
print(K)

verdict = K.star_verdict(1)
print("star of edges", verdict.definiteness, "at", K.simplices(1)[verdict.negative].tolist())
print(verdict.advice)
assert len(verdict.negative) == 1

E = K.form_space("boundary").extension(1)
A = E.T @ K.d(1).T @ K.star(2, "whitney") @ K.d(1) @ E
M = E.T @ K.star(1, "whitney") @ E
eigenvalues = linalg.eigsh(A.tocsc(), k=8, M=M.tocsc(), sigma=4.4, return_eigenvectors=False)  # gradients have 0
modes = np.sort(eigenvalues)
print("modes", np.round(modes, 4))
assert np.allclose(modes, [1, 1, 2, 4, 4, 5, 5, 8], rtol=5e-3)
