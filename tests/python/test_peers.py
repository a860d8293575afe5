"""The same numbers from other packages, where conventions agree or the map between them is known."""

from __future__ import annotations

from collections.abc import Callable
from types import ModuleType
from typing import Any

import numpy as np
import pytest
import scipy.sparse as sparse
import scipy.spatial
from conftest import random_rows

import derham


def agree(ours: sparse.sparray, theirs: Any, tolerance: float = 1e-11) -> None:
    """Up to rounding, of the largest entry."""
    assert ours.shape == theirs.shape
    assert abs(ours - sparse.csr_array(theirs)).max() <= tolerance * abs(theirs).max()


# gudhi: simplex trees, persistent cohomology

COMPLEXES: dict[str, Callable[[], derham.Complex]] = {
    "torus": derham.generate.csaszar_torus,
    "cube": lambda: derham.generate.box(3, 2),
    "CP2": derham.generate.complex_projective_plane,
    "RP2": derham.generate.projective_plane,
    "Klein bottle": derham.generate.klein_bottle,
    "Poincaré sphere": derham.generate.poincare_sphere,
    "S2 x S1": lambda: derham.generate.product(derham.generate.sphere(2), derham.generate.cycle(3)),
    "two circles": lambda: derham.generate.disjoint_union(derham.generate.cycle(3), derham.generate.cycle(5)),
    "not pure": lambda: derham.Complex([(0, 1, 2, 3), (3, 4), (4, 5, 6), (5, 7), (6, 7), (8,)]),
    **{
        f"random {n}": lambda n=n: derham.Complex(random_rows(n, n + 5, 11, seed=n))  # type: ignore[misc]
        for n in range(1, 5)
    },
}


def rank_modulo(matrix: np.ndarray, p: int) -> int:
    """By Gauß over the integers modulo a prime."""
    rows, rank = matrix.astype(np.int64) % p, 0
    for column in range(rows.shape[1]):
        pivots = np.flatnonzero(rows[rank:, column]) + rank
        if pivots.size == 0:
            continue
        rows[[rank, pivots[0]]] = rows[[pivots[0], rank]]
        rows[rank] = rows[rank] * pow(int(rows[rank, column]), -1, p) % p
        others = np.flatnonzero(rows[:, column])
        others = others[others != rank]
        rows[others] = (rows[others] - np.outer(rows[others, column], rows[rank])) % p
        rank += 1
        if rank == len(rows):
            break
    return rank


@pytest.mark.parametrize("name", COMPLEXES)
def test_counts_and_betti_numbers_of_gudhi(name: str) -> None:
    gudhi = pytest.importorskip("gudhi")
    K = COMPLEXES[name]()
    tree = gudhi.SimplexTree()
    for k in range(K.dimension + 1):
        above = K.incidence(k, k + 1).sum(axis=1) if k < K.dimension else np.zeros(K.size(k))
        for maximal in K.simplices(k)[above == 0].tolist():
            tree.insert(maximal)
    counts = [0] * (K.dimension + 1)
    for simplex, _ in tree.get_simplices():
        counts[len(simplex) - 1] += 1
    assert K.sizes == tuple(counts)
    for p in (2, 3, 11):  # 2 sees what is not orientable
        ranks = [0] + [rank_modulo(K.d(k).toarray(), p) for k in range(K.dimension)] + [0]
        tree.compute_persistence(homology_coeff_field=p, persistence_dim_max=True)
        assert [K.size(k) - ranks[k] - ranks[k + 1] for k in range(K.dimension + 1)] == tree.betti_numbers()


# scikit-fem: P1, Nédélec, Raviart–Thomas and P0, of lowest order, which are Whitney forms up to their normalisation


def random_mesh(n: int, seed: int) -> derham.Complex:
    """The Delaunay triangulation of random points, without slivers; rows and their vertices in any order."""
    random = np.random.default_rng(seed)
    points = random.random((30 * n, n))
    rows = scipy.spatial.Delaunay(points).simplices
    edges = points[rows[:, 1:]] - points[rows[:, :1]]
    rows = rows[abs(np.linalg.det(edges)) > 1e-3]
    used, renumbered = np.unique(rows, return_inverse=True)
    rows = random.permutation(renumbered.reshape(-1, n + 1))
    return derham.Complex([random.permutation(row) for row in rows], points[used])


class Peer:
    """The lowest elements of scikit-fem on the mesh of a complex with n = m, and the k-forms that are their basis functions.

    `cochains[k]` has as columns the integrals of those, from their definition: of a vector field along an edge that has it
    as its degree of freedom, in Nédélec's space; its flux through a facet in Raviart and Thomas's. In the plane, where
    Whitney's edge elements are the one as well as the other, k = 1 is Nédélec's.
    """

    def __init__(self, fem: ModuleType, K: derham.Complex) -> None:
        n = K.dimension
        name = {2: "Tri", 3: "Tet"}[n]
        self.mesh = getattr(fem, f"Mesh{name}")(K.points.T, K.simplices(n).T)
        assert (self.mesh.t.T == K.simplices(n)).all()
        lowest = {k: getattr(fem, f"Element{name}{kind}")() for k, kind in ((0, "P1"), (1, "N1"), (n, "P0"))}
        self.basis = {k: fem.Basis(self.mesh, element, intorder=2) for k, element in lowest.items()}
        self.flux_basis = fem.Basis(self.mesh, getattr(fem, f"Element{name}RT1")(), intorder=2)
        if n == 3:
            self.basis[2] = self.flux_basis
        edges = self.mesh.facets if n == 2 else self.mesh.edges
        dofs = self.basis[1].facet_dofs[0] if n == 2 else self.basis[1].edge_dofs[0]
        # along the first side of the reference triangle N1 is (y-1, -x), of the reference tetrahedron (1-y-z, x, x)
        along_edges = self._cochain(K, edges, dofs, np.full(edges.shape[1], -1.0 if n == 2 else 1.0))
        # RT1 flows out of the first neighbour of a facet; through y = 0 (z = 0) with unit speed, where the facet has measure
        # 1 (1/2); positive top simplices have facets with outward flux positive where d has +1
        facets, first = self.mesh.facets, self.mesh.f2t[0]
        index, _ = K.index(facets.T)
        outward = np.asarray(K.d(n - 1, dtype=float).tocsr()[first, index]).ravel()
        self.fluxes = self._cochain(K, facets, self.flux_basis.facet_dofs[0], outward * (1 if n == 2 else 0.5))
        self.cochains = {
            0: sparse.csr_array(sparse.eye_array(K.size(0))),
            1: along_edges,
            n - 1: along_edges if n == 2 else self.fluxes,
            n: sparse.csr_array(sparse.diags_array(K.volumes(n))),  # of the function that is 1 on a top simplex
        }

    @staticmethod
    def _cochain(K: derham.Complex, tuples: np.ndarray, dofs: np.ndarray, integrals: np.ndarray) -> sparse.csr_array:
        index, sign = K.index(tuples.T)
        return sparse.csr_array((sign * integrals, (index, dofs)), shape=(K.size(len(tuples) - 1), len(dofs)))


@pytest.fixture(params=[(2, 1), (2, 2), (3, 3), (3, 4)], ids=str)
def peer(request: pytest.FixtureRequest) -> tuple[derham.Complex, Peer, ModuleType]:
    fem = pytest.importorskip("skfem")
    K = random_mesh(*request.param)
    return K, Peer(fem, K), fem


def product(u: Any, v: Any) -> Any:
    """⟨u, v⟩ of scalars or vectors at quadrature points."""
    return (u * v).sum(axis=0) if u.ndim > 2 else u * v


def test_whitney_masses_of_scikit_fem(peer: tuple[derham.Complex, Peer, ModuleType]) -> None:
    K, P, fem = peer
    mass = fem.BilinearForm(lambda u, v, _: product(u, v))
    for k, B in P.cochains.items():
        agree(B.T @ K.star(k, "whitney") @ B, mass.assemble(P.basis[k]))
    B = P.fluxes
    agree(B.T @ K.star(K.dimension - 1, "whitney") @ B, mass.assemble(P.flux_basis))


def test_whitney_masses_with_materials_of_scikit_fem(peer: tuple[derham.Complex, Peer, ModuleType]) -> None:
    K, P, fem = peer
    n, random = K.dimension, np.random.default_rng(7)
    roots = random.standard_normal((K.size(n), n, n))
    tensors = roots @ roots.transpose(0, 2, 1) + 0.1 * np.eye(n)
    numbers = random.random(K.size(n)) + 0.5

    def spread(values: np.ndarray, basis: Any) -> np.ndarray:
        """The same at every quadrature point."""
        moved = np.moveaxis(values, 0, -1)[..., np.newaxis]
        return np.broadcast_to(moved, (*moved.shape[:-1], basis.dx.shape[1]))

    scaled = fem.BilinearForm(lambda u, v, w: w.a * product(u, v))
    bent = fem.BilinearForm(lambda u, v, w: np.einsum("i...,ij...,j...->...", u, w.a, v))
    for k, B in P.cochains.items():
        basis = P.basis[k]
        agree(B.T @ K.star(k, "whitney", material=numbers) @ B, scaled.assemble(basis, a=spread(numbers, basis)))
        if 0 < k < n:  # on covectors for k = 1, on flux vectors for k = 2
            agree(B.T @ K.star(k, "whitney", material=tensors) @ B, bent.assemble(basis, a=spread(tensors, basis)))


def test_derivatives_of_scikit_fem(peer: tuple[derham.Complex, Peer, ModuleType]) -> None:
    """∫⟨dφ, dψ⟩, the stiffness, and ∫⟨dφ, ψ⟩, which sees the signs of d: grad, curl, div."""
    K, P, fem = peer
    names = ("grad", "curl") if K.dimension == 2 else ("grad", "curl", "div")
    spaces = [(k, name, P.basis[k], P.cochains[k]) for k, name in enumerate(names)]
    if K.dimension == 2:
        spaces.append((1, "div", P.flux_basis, P.fluxes))
    for k, name, basis, B in spaces:
        stiffness = fem.BilinearForm(lambda u, v, _, name=name: product(getattr(u, name), getattr(v, name)))
        d, M, C = K.d(k), K.star(k + 1, "whitney"), P.cochains[k + 1]
        agree(B.T @ d.T @ M @ d @ B, stiffness.assemble(basis))
        weak = fem.BilinearForm(lambda u, v, _, name=name: product(getattr(u, name), v))
        agree(C.T @ M @ d @ B, weak.assemble(basis, P.basis[k + 1]))


def test_mixed_laplacian_of_scikit_fem(peer: tuple[derham.Complex, Peer, ModuleType]) -> None:
    K, P, fem = peer
    n = K.dimension
    mass = fem.BilinearForm(lambda u, v, _: product(u, v)).assemble(P.flux_basis)
    divergence = fem.BilinearForm(lambda u, v, _: u.div * v).assemble(P.flux_basis, P.basis[n])
    theirs = sparse.block_array([[-mass, divergence.T], [divergence, None]]).tocsr()
    B = sparse.block_diag([P.fluxes, P.cochains[n]]).tocsr()
    agree(B.T @ K.mixed_laplacian(n).matrix @ B, theirs)


def test_integrals_and_interpolation_of_scikit_fem(peer: tuple[derham.Complex, Peer, ModuleType]) -> None:
    """A random function of every space at barycentres, and moments against a constant."""
    K, P, fem = peer
    inside = K.corners().mean(axis=1)
    bases = [(k, P.basis[k], B) for k, B in P.cochains.items() if (K.dimension, k) != (2, 2)]
    for k, basis, B in bases:
        x = np.random.default_rng(k).standard_normal(B.shape[1])
        centre = np.full((K.dimension, 1), 1 / (K.dimension + 1))
        there = fem.Basis(P.mesh, basis.elem, quadrature=(centre, np.ones(1))).interpolate(x)
        values = np.moveaxis(np.asarray(there)[..., 0], -1, 0)
        ours = K.interpolate(B @ x, k, inside)
        if k == 2 and K.dimension == 3:  # components dx∧dy, dx∧dz, dy∧dz of the flux of (X, Y, Z): Z, -Y, X
            ours = ours[:, ::-1] * [1, -1, 1]
        np.testing.assert_allclose(ours, values, atol=1e-10 * abs(values).max())


def test_poisson_of_scikit_fem(peer: tuple[derham.Complex, Peer, ModuleType]) -> None:
    K, P, fem = peer
    A = fem.BilinearForm(lambda u, v, _: product(u.grad, v.grad)).assemble(P.basis[0])
    b = fem.LinearForm(lambda v, w: v * np.cos(3 * w.x[0]) * w.x[1]).assemble(fem.Basis(P.mesh, P.basis[0].elem, intorder=4))
    theirs = fem.solve(*fem.condense(A, b, D=P.mesh.boundary_nodes()))
    space = K.form_space()
    E, d = space.extension(0), K.d(0)
    assert set(space.prescribed(0)) == set(P.mesh.boundary_nodes()) and len(space.free(0)) > 3
    stiffness = E.T @ d.T @ K.star(1, "whitney") @ d @ E
    ours = E @ sparse.linalg.spsolve(stiffness.tocsc(), E.T @ b)
    np.testing.assert_allclose(ours, theirs, atol=1e-12 * abs(theirs).max())


# libigl and potpourri3d: surfaces in space, with minus the cotan Laplacian and the cotan Laplacian


def bumpy(K: derham.Complex, seed: int) -> derham.Complex:
    """With vertices moved at random: obtuse triangles, edges that are not Delaunay."""
    random = np.random.default_rng(seed)
    moved = K.points + 0.25 * np.sqrt(K.edge_lengths_squared().min()) * random.standard_normal(K.points.shape)
    return derham.Complex(K.oriented_simplices(), moved)


def upper_half(K: derham.Complex) -> derham.Complex:
    used, rows = np.unique(K.simplices(2)[K.corners()[:, :, 2].mean(axis=1) > 0], return_inverse=True)
    return derham.Complex(rows.reshape(-1, 3), K.points[used])


SURFACES: dict[str, Callable[[], derham.Complex]] = {
    "sphere": lambda: derham.generate.icosphere(2),
    "bumpy sphere": lambda: bumpy(derham.generate.icosphere(2), 1),
    "torus": lambda: derham.generate.torus(12, 7),
    "bumpy torus": lambda: bumpy(derham.generate.torus(12, 7), 2),
    "genus 2": lambda: bumpy(derham.generate.voxels("5x3x1-1,1,0-3,1,0").boundary_complex()[0], 3),
    "hull of a ball": lambda: derham.generate.ball(3, 3).boundary_complex()[0],
    "with boundary": lambda: bumpy(upper_half(derham.generate.icosphere(2)), 4),
}


@pytest.fixture(params=SURFACES, ids=str)
def surface(request: pytest.FixtureRequest) -> tuple[derham.Complex, np.ndarray, np.ndarray]:
    """A surface, its points and its triangles as these packages take them."""
    K = SURFACES[request.param]()
    assert K.dimension == 2 and K.ambient_dimension == 3
    return K, np.array(K.points), K.oriented_simplices().astype(np.int64)


Surface = tuple[derham.Complex, np.ndarray, np.ndarray]


def is_acute(K: derham.Complex) -> bool:
    squared = K.edge_lengths_squared()[K.faces(2)]
    return bool((2 * squared.max(axis=1) < squared.sum(axis=1)).all())


def test_cotan_laplacian_of_libigl(surface: Surface) -> None:
    igl = pytest.importorskip("igl")
    K, V, F = surface
    weak = K.d(0).T @ K.star(1) @ K.d(0)
    agree(weak, -igl.cotmatrix(V, F))
    agree(K.d(0).T @ K.star(1, "whitney") @ K.d(0), -igl.cotmatrix(V, F))
    agree(K.weak_laplacian(0), -igl.cotmatrix(V, F))
    lengths = igl.edge_lengths(V, F)
    L = derham.Complex(K.simplices(2), edge_lengths_squared=K.edge_lengths_squared())
    agree(L.d(0).T @ L.star(1) @ L.d(0), -igl.cotmatrix_intrinsic(lengths, F), 1e-9)


def test_masses_of_libigl(surface: Surface) -> None:
    igl = pytest.importorskip("igl")
    K, V, F = surface
    agree(K.star(0, "barycentric").tocsr(), igl.massmatrix(V, F, igl.MASSMATRIX_TYPE_BARYCENTRIC))
    agree(K.star(0, "lumped").tocsr(), igl.massmatrix(V, F, igl.MASSMATRIX_TYPE_BARYCENTRIC))
    agree(K.star(0, "whitney"), igl.massmatrix(V, F, igl.MASSMATRIX_TYPE_FULL))
    np.testing.assert_allclose(2 * K.volumes(2), igl.doublearea(V, F).ravel(), rtol=1e-11)
    voronoi = igl.massmatrix(V, F, igl.MASSMATRIX_TYPE_VORONOI).diagonal()
    assert voronoi.sum() == pytest.approx(K.star(0).diagonal().sum(), rel=1e-12)
    same = np.isclose(K.star(0).diagonal(), voronoi, rtol=1e-10)
    if is_acute(K):
        assert same.all()
    else:  # cut off where a triangle is obtuse; ours has signs there
        obtuse = np.zeros(K.size(0), bool)
        squared = K.edge_lengths_squared()[K.faces(2)]
        obtuse[F[2 * squared.max(axis=1) > squared.sum(axis=1) * (1 + 1e-9)]] = True
        assert same[~obtuse].all() and not same.all()


def test_tetrahedra_of_libigl() -> None:
    igl = pytest.importorskip("igl")
    K = random_mesh(3, 5)
    V, T = np.array(K.points), K.oriented_simplices().astype(np.int64)
    agree(K.d(0).T @ K.star(1, "whitney") @ K.d(0), -igl.cotmatrix(V, T))
    agree(K.star(0, "barycentric").tocsr(), igl.massmatrix(V, T, igl.MASSMATRIX_TYPE_BARYCENTRIC))
    np.testing.assert_allclose(K.volumes(3), abs(igl.volume(V, T)).ravel(), rtol=1e-10)


def test_laplacian_and_areas_of_potpourri3d(surface: Surface) -> None:
    pp3d = pytest.importorskip("potpourri3d")
    K, V, F = surface
    agree(K.d(0).T @ K.star(1) @ K.d(0), pp3d.cotan_laplacian(V, F))
    np.testing.assert_allclose(K.star(0, "barycentric").diagonal(), pp3d.vertex_areas(V, F), rtol=1e-11)
    np.testing.assert_allclose(K.volumes(2), pp3d.face_areas(V, F), rtol=1e-11)
