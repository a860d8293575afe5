"""Meshes and small triangulations to compute and to test with. Every function makes a `derham.Complex`.

"Star" says which Hodge stars are good for them; where nothing is said, all dual volumes are positive or there are no positions.
Raises   InputError for arguments out of range; LimitError for meshes that do not fit the index type
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from . import _derham
from ._arguments import float_array, index_array, shown, whole_number
from .complex import Complex
from .errors import InputError


def _made(generator: Callable[..., _derham.Complex], *arguments: Any) -> Complex:
    """What a compiled generator makes of arguments; InputError if they are no numbers that it takes."""
    try:
        return Complex._of(generator(*arguments))
    except TypeError:
        given = ", ".join(map(shown, arguments))
        expected = str(generator.__doc__).partition(" ->")[0]
        raise InputError(f"the arguments are {given}; expected {expected}, with integers of 32 bits") from None


def _core(a: Complex) -> _derham.Complex:
    if not isinstance(a, Complex):
        raise InputError(f"the argument is {shown(a)}; expected a complex")
    return a._core


def _cells(dimension: int, cells: int | Sequence[int]) -> list[int]:
    """One number stands for all axes."""
    dimension = whole_number(dimension, "the dimension", 1, 6)
    numbers = index_array(cells, "cells")
    if np.ndim(cells) == 0:
        return [int(numbers[0])] * dimension
    if numbers.shape != (dimension,):
        raise InputError(f"there are {len(numbers)} numbers of cells; expected one, or {dimension}, one per axis")
    return [int(count) for count in numbers]


def _lengths(lengths: Sequence[float]) -> list[float]:
    numbers = float_array(lengths, "lengths")
    return [float(length) for length in numbers.reshape(-1)]


def box(
    dimension: int,
    cells: int | Sequence[int],
    *,
    lengths: Sequence[float] = (),
    jitter: float = 0,
    seed: int = 1,
) -> Complex:
    """The box [0, lengths[0]] × … of cubes, each cut into n! simplices along its main diagonal, n = 1 to 6.

    cells    along every axis, one number or one per axis
    lengths  of the sides; by default 1
    jitter   interior vertices move by jitter · (length of a cell) · a random number of [-1/2, 1/2) along every axis

    Star     circumcentric dual volumes of degrees 0 < k < n are zero, or negative with jitter: take "power" with
             `weights=K.hot_weights().weights`, or "whitney" and `mixed_laplacian`
    Source   Freudenthal 1942; Kuhn 1960

    >>> import derham
    >>> derham.generate.box(2, (3, 2)).sizes
    (12, 23, 12)
    """
    return _made(_derham.box, _cells(dimension, cells), _lengths(lengths), jitter, seed)


def periodic_box(
    dimension: int,
    cells: int | Sequence[int],
    *,
    lengths: Sequence[float] = (),
    jitter: float = 0,
    seed: int = 1,
) -> Complex:
    """The box with opposite sides identified, a flat n-torus; at least 3 cells along every axis.

    Star     many circumcentric dual volumes of degrees 0 < k < n are zero, whatever the weights: take "whitney" and
             `mixed_laplacian`; or `a_star_lattice`, a flat torus with positive ones
    """
    return _made(_derham.periodic_box, _cells(dimension, cells), _lengths(lengths), jitter, seed)


def ball(dimension: int, layers: int, radius: float = 1) -> Complex:
    """The solid ball of R^n in shells: (n+1)! layers^n simplices, n = 1 to 6."""
    return _made(_derham.ball, dimension, layers, radius)


def icosphere(level: int, radius: float = 1) -> Complex:
    """The sphere in R³: an icosahedron, every triangle cut into four `level` times."""
    return _made(_derham.icosphere, level, radius)


def torus(segments: int, sides: int, major: float = 1, minor: float = 0.4) -> Complex:
    """The torus of revolution about the z axis in R³: 2 segments · sides triangles.

    Star     many circumcentric dual volumes of degrees 0 < k < n are zero, whatever the weights: take "whitney" and
             `mixed_laplacian`
    """
    return _made(_derham.torus, segments, sides, major, minor)


def solid_torus(rings: int, segments: int, major: float = 1, minor: float = 0.4) -> Complex:
    """The solid torus of revolution about the z axis: 18 rings² segments tetrahedra.

    Star     many circumcentric dual volumes of degrees 0 < k < n are zero, whatever the weights: take "whitney" and
             `mixed_laplacian`
    """
    return _made(_derham.solid_torus, rings, segments, major, minor)


def clifford_torus(a: int, b: int, radius: float = 1) -> Complex:
    """The flat torus in R⁴.

    Star     many circumcentric dual volumes of degrees 0 < k < n are zero, whatever the weights: take "whitney" and
             `mixed_laplacian`
    """
    return _made(_derham.clifford_torus, a, b, radius)


def a_star_lattice(dimension: int, cells: int, scale: float = 1) -> Complex:
    """The Delaunay triangulation of the lattice A_n* on a torus: all dual volumes of all degrees are positive.

    Source   Conway & Sloane, "Low-dimensional lattices VI", 1992
    """
    return _made(_derham.a_star_lattice, dimension, cells, scale)


def bcc_lattice(cells: int, cell_length: float = 1) -> Complex:
    """The body-centred cubic tetrahedra on the cubic torus of cells³ cubes; well-centred.

    Source   Sommerville 1923
    """
    return _made(_derham.bcc_lattice, cells, cell_length)


def voxels(spec: str) -> Complex:
    """Unit cubes of a grid, given as a full box and boxes taken away (-) or put back (+): "3x3x1-1,1,0" is a ring.

    Star     as `box`

    >>> import derham
    >>> derham.generate.voxels("3x3x1-1,1,0").sizes
    (32, 112, 128, 48)
    """
    return _made(_derham.voxels, spec)


def example() -> Complex:
    """Two regular tetrahedra: the smallest mesh that shows everything."""
    return _made(_derham.example)


def regular_simplex(dimension: int) -> Complex:
    """One regular n-simplex of edge length 1, n = 1 to 6."""
    return _made(_derham.regular_simplex, dimension)


def simplex_boundary(dimension: int) -> Complex:
    """S^n as the n+2 facets of the regular simplex in the unit sphere, n = 0 to 6."""
    return _made(_derham.simplex_boundary, dimension)


def cross_polytope(dimension: int) -> Complex:
    """S^n as the 2^(n+1) facets of the cross polytope, n = 0 to 6."""
    return _made(_derham.cross_polytope, dimension)


def cell_600() -> Complex:
    """S³ as the 600 tetrahedra of the 600-cell. Source: Coxeter, "Regular polytopes", §8.7"""
    return _made(_derham.cell_600)


def cycle(size: int) -> Complex:
    """S¹ as a polygon; no positions."""
    return _made(_derham.cycle, size)


def path(size: int) -> Complex:
    """An interval of `size` edges; no positions."""
    return _made(_derham.path, size)


def sphere(dimension: int) -> Complex:
    """S^n as the boundary of the (n+1)-simplex, n = 0 to 6; no positions."""
    return _made(_derham.sphere, dimension)


def projective_plane() -> Complex:
    """RP² on 6 vertices."""
    return _made(_derham.projective_plane)


def klein_bottle() -> Complex:
    """The Klein bottle on 8 vertices."""
    return _made(_derham.klein_bottle)


def csaszar_torus() -> Complex:
    """The torus on 7 vertices (Möbius 1861, Császár 1949)."""
    return _made(_derham.csaszar_torus)


def moebius_strip() -> Complex:
    """The Möbius strip on 5 vertices."""
    return _made(_derham.moebius_strip)


def annulus() -> Complex:
    """The annulus on 6 vertices."""
    return _made(_derham.annulus)


def complex_projective_plane() -> Complex:
    """CP² on 9 vertices. Source: Kühnel & Banchoff 1983"""
    return _made(_derham.complex_projective_plane)


def poincare_sphere() -> Complex:
    """The Poincaré sphere on 16 vertices. Source: Björner & Lutz 2000"""
    return _made(_derham.poincare_sphere)


def lens_space(p: int, q: int) -> Complex:
    """The lens space L(p, q): H_1 = Z_p."""
    return _made(_derham.lens_space, p, q)


def grid_torus(dimension: int, cells: int = 3) -> Complex:
    """T^n as a periodic box without positions, n = 1 to 6."""
    return _made(_derham.grid_torus, dimension, cells)


def disjoint_union(a: Complex, b: Complex) -> Complex:
    """a and b side by side: the vertices of b follow those of a."""
    return _made(_derham.disjoint_union, _core(a), _core(b))


def product(a: Complex, b: Complex) -> Complex:
    """The product, cut into staircases; points are those of a followed by those of b.

    Source   Eilenberg & Steenrod 1952, II.8

    >>> import derham
    >>> derham.generate.product(derham.generate.sphere(2), derham.generate.sphere(2)).sizes
    (16, 84, 216, 240, 96)
    """
    return _made(_derham.product, _core(a), _core(b))


def cone(a: Complex) -> Complex:
    """The join with one new vertex; no positions."""
    return _made(_derham.cone, _core(a))


def suspension(a: Complex) -> Complex:
    """The join with two new vertices; no positions."""
    return _made(_derham.suspension, _core(a))


def barycentric_subdivision(a: Complex) -> Complex:
    """A vertex for every simplex, a simplex for every flag, with positions if a has them."""
    return _made(_derham.barycentric_subdivision, _core(a))
