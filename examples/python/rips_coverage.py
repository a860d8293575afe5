"""Do sensors cover a square, if all that is known is who hears whom? The Vietoris–Rips complex of their reach answers.

Sensors on the fence hear their neighbours there. If the fence is the boundary of some triangles of the complex, every point
inside is within reach / √3 of a sensor. (de Silva & Ghrist, "Coordinate-free coverage in sensor networks with controlled
boundaries via homology", 2006.)
"""

import numpy as np
import scipy.ndimage as ndimage
import scipy.sparse as sparse
import scipy.sparse.linalg as linalg
from scipy.spatial import cKDTree

import derham

cells, jitter, reach = 20, 0.1, 1.7  # neighbours on the grid, also across a square, are at most (1 + 2 jitter) √2 apart
random = np.random.default_rng(1)


def remainder(A: sparse.sparray, y: np.ndarray) -> np.ndarray:
    """What is left of y by least squares."""
    return y - A @ linalg.lsqr(A, y, atol=1e-14, btol=1e-14)[0]


def holes(points: np.ndarray) -> int:
    """How many parts of the square no sensor is near, by looking at a fine grid of points."""
    sample = np.stack(np.meshgrid(*[np.linspace(0, cells, 20 * cells + 1)] * 2), axis=-1)
    distance, _ = cKDTree(points).query(sample)
    return int(ndimage.label(distance > reach / np.sqrt(3))[1])


side = np.column_stack([np.arange(cells), np.zeros(cells)])
fence = np.concatenate([side, side[:, ::-1] + [cells, 0], cells - side, [0, cells] - side[:, ::-1]])
inner = np.stack(np.meshgrid(*[np.arange(1.0, cells)] * 2), axis=-1).reshape(-1, 2)
inner += random.uniform(-jitter, jitter, inner.shape)

for failures in ([], [(6, 6)], [(6, 6), (14, 9)], [(5, 5), (15, 5), (10, 15)]):
    works = [all(np.hypot(*(x - center)) > 3 for center in failures) for x in inner]
    points = np.concatenate([fence, inner[works]])
    K = derham.rips(points, reach, 2)
    loop = np.arange(len(fence))
    fence_chain = K.chain(np.column_stack([loop, np.roll(loop, -1)]))
    gap = np.linalg.norm(remainder(K.boundary(2), fence_chain))

    forms = random.standard_normal((K.size(1), 6))  # what is neither gradient nor curl is harmonic
    harmonic = [remainder(K.boundary(2), remainder(K.d(0), w)) for w in forms.T]
    betti = np.linalg.matrix_rank(harmonic, tol=1e-6)
    print(f"{K.sizes} simplices, fence {gap:.2e} from a boundary, {betti} harmonic forms, {holes(points)} holes seen")
    assert betti == holes(points) == len(failures)
    assert (gap < 1e-8) == (not failures)
