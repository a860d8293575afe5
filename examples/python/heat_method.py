"""Geodesic distance by the heat method: heat flows for a moment, and away from its source along shortest paths.

    (⋆ + t dᵀ⋆d) u = δ        heat after a time t = h²
    X = -∇u / |∇u|            unit vectors that point away from the source
    dᵀ⋆d φ = dᵀ⋆ X♭           the function whose gradient is nearest to X

(Crane, Weischedel, Wardetzky, "Geodesics in heat", 2013.) Two sparse systems, for distances on any surface.
"""

from collections.abc import Callable

import numpy as np
import scipy.sparse.linalg as linalg

import derham


def distance(K: derham.Complex, source: int) -> np.ndarray:
    """Of all vertices of a surface from one."""
    d, star0, star1 = K.d(0), K.star(0, "lumped"), K.star(1)
    stiffness = (d.T @ star1 @ d).tocsc()
    delta = np.zeros(K.size(0))
    delta[source] = 1
    u = linalg.spsolve((star0 + K.volumes(1).mean() ** 2 * stiffness).tocsc(), delta)

    gradient = K.sharp(d @ u)
    X = -gradient / np.linalg.norm(gradient, axis=1, keepdims=True)
    phi = linalg.spsolve(stiffness[1:, 1:], (d.T @ (star1 @ K.flat(X, "dpp")))[1:])
    phi = np.concatenate([[0], phi])
    return phi - phi[source]


def error(K: derham.Complex, exact: Callable[[np.ndarray, np.ndarray], np.ndarray], source: int) -> float:
    """The mean error as a part of the mean distance."""
    assert K.star_verdict(1)
    true = exact(K.points, K.points[source])
    return float(abs(distance(K, source) - true).mean() / true.mean())


random = np.random.default_rng(1)
families = {
    "unit sphere": ([derham.generate.icosphere(k) for k in (2, 3, 4, 5)], lambda x, y: np.arccos(np.clip(x @ y, -1, 1))),
    "unit disk": ([derham.generate.ball(2, 2**k) for k in (3, 4, 5, 6)], lambda x, y: np.linalg.norm(x - y, axis=1)),
}
for name, (meshes, exact) in families.items():
    print(f"{name}: vertices, mean relative error of the distance from one of them")
    errors = [error(K, exact, source=random.integers(K.size(0))) for K in meshes]
    print("\n".join(f"{K.size(0):7d}  {100 * e:.2f} %" for K, e in zip(meshes, errors)))
    assert errors[-1] < errors[0] / 2 and errors[-1] < 0.01
