"""Complexes that the tests share."""

from __future__ import annotations

import numpy as np
import pytest

import derham


def random_rows(n: int, vertices: int, count: int, seed: int) -> np.ndarray:
    """Different (n+1)-subsets of the vertices, every vertex used, in any order."""
    random = np.random.default_rng(seed)
    rows = {tuple(sorted(random.choice(vertices, n + 1, replace=False))) for _ in range(count)}
    used, renumbered = np.unique(np.array(sorted(rows)), return_inverse=True)
    rows = renumbered.reshape(-1, n + 1)
    return np.array([random.permutation(row) for row in rows])


MESHES = {
    "interval": lambda: derham.generate.box(1, 5, jitter=0.3),
    "square": lambda: derham.generate.box(2, 3, jitter=0.3),
    "cube": lambda: derham.generate.box(3, 2, jitter=0.2),
    "hypercube": lambda: derham.generate.box(4, 1),
    "sphere": lambda: derham.generate.icosphere(1),
    "lattice": lambda: derham.generate.a_star_lattice(3, 3),
    "ball": lambda: derham.generate.ball(4, 1),
}


@pytest.fixture(params=MESHES, ids=str)
def K(request: pytest.FixtureRequest) -> derham.Complex:
    return MESHES[request.param]()
