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

weights = K.hot_weights().weights
print("star of edges:", K.star_verdict(1).definiteness, "before,", K.star_verdict(1, "power", weights=weights).definiteness)
star = K.star(1, "power", weights=weights).diagonal()
root = sparse.diags_array(np.sqrt(star))  # in the norm of the star, least squares are those of root @ …


def nearest(A: sparse.sparray, w: np.ndarray) -> np.ndarray:
    """The A x that is nearest to w."""
    x = linalg.lsqr(root @ A, root @ w, atol=1e-15, btol=1e-15)[0]
    return A @ x


w = np.random.default_rng(1).standard_normal(K.size(1))
exact = nearest(K.d(0), w)
coexact = nearest(K.star_inverse(1, "power", weights=weights) @ K.d(1).T, w)
harmonic = w - exact - coexact

parts = np.array([exact, coexact, harmonic])
products = (parts * star) @ parts.T / ((w * star) @ w)
print("squared norms", np.diag(products).round(4), "sum", np.trace(products).round(12))
print("products     ", abs(products - np.diag(np.diag(products))).max())
assert np.allclose(products, np.diag(np.diag(products)), atol=1e-12)

print("d harmonic   ", abs(K.d(1) @ harmonic).max())
print("δ harmonic   ", abs(K.d(0).T @ (star * harmonic)).max())
assert max(abs(K.d(1) @ harmonic).max(), abs(K.d(0).T @ (star * harmonic)).max()) < 1e-10

A = K.weak_laplacian(1, "power", weights=weights)
M = K.star(1, "power", weights=weights)
smallest = linalg.eigsh(A.tocsc(), k=2 * genus + 2, M=M.tocsc(), sigma=-0.01, return_eigenvectors=False)
dimension = int((abs(smallest) < 1e-9).sum())
print("eigenvalues of Δ", np.sort(abs(smallest)).round(4), "harmonic forms", dimension)
assert dimension == 2 * genus  # β_1, twice the genus
