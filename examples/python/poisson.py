"""-Δu = f on the unit square with u = 0 on its boundary, by two stars: with the Whitney mass the error has order 2.

The diagonal star of barycentric dual cells is positive, too, and does not converge.
"""

import numpy as np
import scipy.sparse.linalg as linalg

import derham


def error(cells: int, kind: str) -> float:
    """In the L² norm, for u = sin πx sin πy on a mesh whose vertices are moved at random."""
    K = derham.generate.box(2, cells, jitter=0.3)
    exact = np.sin(np.pi * K.points).prod(axis=1)
    E = K.form_space("boundary").extension(0)  # functions that vanish there
    mass = K.star(0, "whitney")
    A = E.T @ K.d(0).T @ K.star(1, kind) @ K.d(0) @ E
    u = E @ linalg.spsolve(A.tocsc(), E.T @ (mass @ (2 * np.pi**2 * exact)))
    return float(np.sqrt((u - exact) @ mass @ (u - exact)))


print("cells   whitney     barycentric")
sizes = (8, 16, 32, 64)
errors = np.array([[error(cells, kind) for kind in ("whitney", "barycentric")] for cells in sizes])
for cells, (whitney, barycentric) in zip(sizes, errors):
    print(f"{cells:5d}   {whitney:.2e}    {barycentric:.2e}")
orders = np.log2(errors[-2] / errors[-1])
print(f"order    {orders[0]:.2f}        {orders[1]:.2f}")
assert orders[0] > 1.9 and orders[1] < 0.3
