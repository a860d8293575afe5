"""Ranking by least squares: the results of games are a 1-form on the graph of who played whom, scores are a 0-form.

Results = gradient of scores + cycles of three + cycles that no triangle fills. Only the first part ranks anybody.
(Jiang, Lim, Yao, Ye, "Statistical ranking and combinatorial Hodge theory", 2011; PyDEC's example of the same name.)
"""

from itertools import combinations

import numpy as np
import scipy.sparse as sparse
import scipy.sparse.linalg as linalg

import derham


def least_squares(A: sparse.sparray, y: np.ndarray) -> np.ndarray:
    return linalg.lsqr(A, y, atol=1e-15, btol=1e-15)[0]


def parts(K: derham.Complex, y: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The gradient, the curl and the harmonic part of results, orthogonal to each other."""
    gradient = K.d(0) @ least_squares(K.d(0), y)
    curl = K.boundary(2) @ least_squares(K.boundary(2), y)
    return gradient, curl, y - gradient - curl


random = np.random.default_rng(1)

# Everybody plays everybody: scores are mean margins, and triangles fill every cycle
teams = 8
K = derham.Complex(list(combinations(range(teams), 3)))
margin = random.integers(-9, 10, (teams, teams))
margin = margin - margin.T  # margin[i, j]: by how much j beats i
i, j = K.simplices(1).T
scores = least_squares(K.d(0), margin[i, j])
mean_margins = margin.mean(axis=0)
print("all play all, best first:", np.argsort(-scores), "scores", np.round(np.sort(scores - scores.mean())[::-1], 3))
gradient, curl, harmonic = parts(K, margin[i, j])
print(f"squared norms: gradient {gradient @ gradient:.3f}, curl {curl @ curl:.3f}, harmonic {harmonic @ harmonic:.0e}")
assert np.allclose(scores - scores.mean(), mean_margins) and np.allclose(harmonic, 0, atol=1e-9)

# On a ring everybody plays the next two; three things happen at once, and least squares tell them apart
teams = 12
ring = np.arange(teams)
K = derham.Complex(np.column_stack([ring, ring + 1, ring + 2]) % teams)
strength = random.standard_normal(teams)
fair = K.d(0) @ strength
scissors = K.boundary(2)[:, [4]] @ np.array([0.7])  # three teams that beat each other in turn
i, j = K.simplices(1).T
escher = (j - i + teams // 2) % teams - teams // 2  # all beat the one before them by 1, and the one before that by 2
for found, expected in zip(parts(K, fair + scissors + escher), (fair, scissors, escher)):
    print(f"norm {np.linalg.norm(found):.6f}, expected {np.linalg.norm(expected):.6f}")
    assert np.allclose(found, expected)
