"""Volumes, dual volumes, Hodge stars and their verdicts."""

from __future__ import annotations

from math import comb, factorial, pi

import numpy as np
import pytest
import scipy.sparse as sparse

import derham


def test_volumes_are_determinants(K: derham.Complex) -> None:
    n = K.dimension
    corners = K.corners()
    edges = corners[:, 1:] - corners[:, :1]
    gram = np.einsum("tic,tjc->tij", edges, edges)
    np.testing.assert_allclose(K.volumes(n), np.sqrt(np.linalg.det(gram)) / factorial(n), rtol=1e-10)
    np.testing.assert_allclose(K.volumes(1) ** 2, K.edge_lengths_squared(), rtol=1e-12)


def test_dual_volumes_fill_the_mesh(K: derham.Complex) -> None:
    total = K.volumes(K.dimension).sum()
    for k in range(K.dimension + 1):
        found = (K.volumes(k) * K.dual_volumes(k)).sum()
        assert found == pytest.approx(comb(K.dimension, k) * total, rel=1e-10)
        np.testing.assert_allclose(K.star(k).diagonal() * K.volumes(k), K.dual_volumes(k), rtol=1e-12, atol=1e-14)


def test_known_stars() -> None:
    K = derham.generate.bcc_lattice(3)
    assert K.star(0).diagonal() == pytest.approx(0.5)
    assert set(K.star(1).diagonal().round(12)) == {1 / 8, 3 / 8}
    assert K.star(2).diagonal() == pytest.approx(1)
    triangle = derham.generate.regular_simplex(2)
    assert triangle.star(1).diagonal() == pytest.approx(0.28867513459)
    assert isinstance(K.star(1), sparse.dia_array)
    inverse = K.star_inverse(1) @ K.star(1)
    np.testing.assert_allclose(inverse.diagonal(), 1, rtol=1e-15)


def test_whitney_mass_of_constants(K: derham.Complex) -> None:
    if K.ambient_dimension != K.dimension or K.metric_source != "points":
        return
    total = K.volumes(K.dimension).sum()
    x = K.points
    dx = [K.apply_d(x[:, c], 0) for c in range(K.dimension)]
    M = K.star(1, "whitney")
    for i, a in enumerate(dx):
        for j, b in enumerate(dx):
            assert a @ M @ b == pytest.approx(total if i == j else 0, abs=1e-12)
    assert abs(M - M.T).max() == 0 and M.indices.dtype == np.int32


def test_laplacian_of_the_sphere() -> None:
    K = derham.generate.icosphere(3)
    weak = K.d(0).T @ K.star(1) @ K.d(0)
    z = K.points[:, 2]
    assert (z @ weak @ z) / (z @ K.star(0) @ z) == pytest.approx(2, rel=1e-2)
    assert K.volumes(2).sum() == pytest.approx(4 * pi, rel=2e-2)


def test_edge_lengths_alone_are_a_metric() -> None:
    K = derham.generate.icosphere(1)
    L = derham.Complex(K.simplices(2), edge_lengths_squared=K.edge_lengths_squared())
    assert L.points is None and L.ambient_dimension == 0
    np.testing.assert_allclose(K.star(1).diagonal(), L.star(1).diagonal(), rtol=1e-9)


def test_materials() -> None:
    K = derham.generate.box(2, 3, jitter=0.2)
    half = np.where(np.arange(K.size(2)) % 2, 2.0, 3.0)
    np.testing.assert_allclose(K.star(1, material=2.0).diagonal(), 2 * K.star(1).diagonal(), rtol=1e-12)
    by_tag = K.star(1, material=([3.0, 2.0], np.arange(K.size(2)) % 2))
    np.testing.assert_array_equal(K.star(1, material=half).diagonal(), by_tag.diagonal())
    tensor = K.star(1, "whitney", material=np.diag([2.0, 2.0]))
    assert abs(tensor - 2 * K.star(1, "whitney")).max() < 1e-14
    power = K.star(1, "power", weights=np.full(K.size(0), 0.1))
    np.testing.assert_allclose(power.diagonal(), K.star(1).diagonal(), atol=1e-12)


def test_verdicts() -> None:
    K = derham.generate.box(3, 4)
    verdict = K.star_verdict(1)
    assert not verdict and len(verdict.zero) == 304 and "whitney" in verdict.advice.lower()
    assert verdict.definiteness == "not positive" and str(len(verdict.zero)) in repr(verdict)
    assert "<table>" in verdict._repr_html_()
    whitney = K.star_verdict(1, "whitney")
    assert whitney and whitney.constant_error < 1e-12 and whitney.condition > 1
    report = K.dual_report()
    assert report.pairwise_delaunay and not report.well_centered and len(report.star[2].zero) == 384
    quality = K.quality()
    assert len(quality.inverted) == 0 and quality.total_volume == pytest.approx(1)


def test_manifold_report() -> None:
    assert derham.generate.box(3, 2).check()
    report = derham.Complex([(0, 1, 2, 3), (0, 1, 4, 5)]).check()
    assert report.verdict == "no" and report.defects[0].simplex == (0, 1) and report.defects[0].kind == "ring"
    assert "(0, 1)" in repr(report) and "ring" in report._repr_html_()


def test_dual_cells() -> None:
    K = derham.generate.a_star_lattice(2, 4)
    (cell,) = K.dual_cells(0, 5)
    assert len(cell.polygons) == 1 and len(cell.polygons[0]) in (6, 12)
    corners = cell.points[list(cell.polygons[0])]
    x, y = corners.T
    area = abs(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))) / 2
    assert area == pytest.approx(K.dual_volumes(0)[5])


def kinds_without_zeros(K: derham.Complex) -> list[str]:
    """The stars that are positive in every degree."""
    weights = {"power": K.hot_weights().weights}
    kinds = ("circumcentric", "power", "whitney")
    return [
        kind for kind in kinds
        if all(K.star_verdict(k, kind, weights=weights.get(kind)) for k in range(K.dimension + 1))  # type: ignore[arg-type]
    ]  # fmt: skip


def test_generators_say_which_star_to_take() -> None:
    G = derham.generate
    for K in (G.box(2, 3), G.box(2, 5, jitter=0.4), G.box(3, 2, jitter=0.3), G.voxels("3x3x1-1,1,0")):
        assert kinds_without_zeros(K) == ["power", "whitney"]
    for K in (G.periodic_box(2, 4), G.periodic_box(3, 3), G.torus(12, 8), G.solid_torus(1, 9), G.clifford_torus(5, 5)):
        assert kinds_without_zeros(K) == ["whitney"]
    for K in (G.ball(3, 2), G.icosphere(1), G.a_star_lattice(2, 4), G.bcc_lattice(3), G.example(), G.cell_600(),
              G.cross_polytope(3), G.regular_simplex(3), G.simplex_boundary(3)):
        assert kinds_without_zeros(K) == ["circumcentric", "power", "whitney"]
    silent = [name for name in ("ball", "icosphere", "cell_600") if "Star" in getattr(G, name).__doc__]
    assert not silent and all("Star" in getattr(G, name).__doc__ for name in ("box", "periodic_box", "torus", "voxels"))
