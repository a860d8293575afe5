"""The Hodge decomposition of a random 1-form on a surface of genus 3: exact + coexact + harmonic, by least squares.

The surface is the boundary of a bar of cubes with three holes; its triangles have right angles, so the circumcentric
star has zeros. Weights make it positive.
"""

import numpy as np
import scipy.sparse as sparse
import scipy.sparse.linalg as linalg

import derham

genus = 3
holes = "".join(f"-{2 * i + 1},1,0" for i in range(genus))
K = derham.generate.voxels(f"{2 * genus + 1}x3x1{holes}").boundary_complex()[0].refined().fine
print(K)
print("Euler characteristic", K.euler_characteristic, "manifold", K.check().verdict)
assert K.euler_characteristic == 2 - 2 * genus

power = {"kind": "power", "weights": K.hot_weights().weights}
print("star of edges:", K.star_verdict(1).definiteness, "without weights,", K.star_verdict(1, **power).definiteness, "with them")
star = K.star(1, **power)
root = star.sqrt()  # in the norm of the star, least squares are those of root @ …


def nearest(A: sparse.sparray, w: np.ndarray) -> np.ndarray:
    """The A x that is nearest to w."""
    x = linalg.lsqr(root @ A, root @ w, atol=1e-15, btol=1e-15)[0]
    return A @ x


w = np.random.default_rng(1).standard_normal(K.size(1))
exact = nearest(K.d(0), w)
coexact = nearest(K.star_inverse(1, **power) @ K.d(1).T, w)
harmonic = w - exact - coexact

parts = np.array([exact, coexact, harmonic])
products = parts @ star @ parts.T / (w @ star @ w)
norms = np.diag(products)
print("squared norms", norms.round(4), "sum", norms.sum().round(12), "products", f"{abs(products - np.diag(norms)).max():.0e}")
assert np.allclose(products, np.diag(norms), atol=1e-12)

residuals = abs(K.d(1) @ harmonic).max(), abs(K.d(0).T @ star @ harmonic).max()
print("of the harmonic part d is {:.0e} and ⋆δ {:.0e}".format(*residuals))
assert max(residuals) < 1e-10

A, M = K.weak_laplacian(1, **power).tocsc(), star.tocsc()
eigenvalues = linalg.eigsh(A, k=2 * genus + 2, M=M, sigma=-0.01, return_eigenvectors=False)
dimension = int((abs(eigenvalues) < 1e-9).sum())
print("smallest eigenvalues of Δ", np.sort(abs(eigenvalues)).round(4), "so harmonic forms:", dimension)
assert dimension == 2 * genus
