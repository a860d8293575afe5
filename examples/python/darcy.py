"""Darcy flow, v = -κ ∇p and div v = 0, with the flux of a constant velocity prescribed on the boundary: exact to round-off.

Fluxes through the facets are a primal (n-1)-form f, pressures at the circumcentres a dual 0-form p, and ⋆f = κ dᵀp on any
Delaunay mesh, in the plane and in space. Nothing is divided by ⋆. (Hirani, Nakshatrala, Chaudhry, arXiv 0810.3434.)
"""

import numpy as np
import scipy.sparse as sparse
import scipy.sparse.linalg as linalg
from scipy.spatial import Delaunay

import derham


def flow(points: np.ndarray, velocity: np.ndarray, permeability: float) -> tuple[derham.Complex, np.ndarray, np.ndarray]:
    """Fluxes and pressures in the convex hull of some points; the pressure of simplex 0 is 0."""
    K = derham.Complex(Delaunay(points).simplices, points)
    n = K.dimension
    prescribed = K.form_space("boundary")
    flux = K.integrate(velocity, n - 1, flux=True)
    flux[prescribed.free(n - 1)] = 0

    E, div = prescribed.extension(n - 1), K.d(n - 1)[1:]  # the equation of simplex 0 is minus the sum of the others
    A = sparse.block_array([[E.T @ K.star(n - 1) @ E, -permeability * (div @ E).T], [div @ E, None]], format="csc")
    x = linalg.spsolve(A, np.concatenate([np.zeros(E.shape[1]), -div @ flux]))
    f, p = np.split(x, [E.shape[1]])
    return K, flux + E @ f, np.concatenate([[0], p])


random = np.random.default_rng(1)
for n, count in ((2, 1000), (3, 400)):
    points = random.standard_normal((count, n))
    points /= np.linalg.norm(points, axis=1, keepdims=True)
    points[count // 4 :] *= 0.9 * random.random((count - count // 4, 1)) ** (1 / n)  # a quarter remains on the sphere
    velocity, permeability = random.standard_normal(n), 0.3
    K, flux, pressure = flow(points, velocity, permeability)

    flux_error = abs(flux - K.integrate(velocity, n - 1, flux=True)).max()
    centers = np.concatenate([cell.points for cell in K.dual_cells(n, np.arange(K.size(n)))])
    linear = -(centers - centers[0]) @ velocity / permeability
    pressure_error = abs(pressure - linear).max() / abs(linear).max()
    print(f"{K}\n  error of the flux {flux_error:.0e}, of the pressure at circumcentres {pressure_error:.0e}")
    assert flux_error < 1e-11 and pressure_error < 1e-11
