"""The rooms geometry and dual: positions, volumes, dual volumes and cells."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ._arguments import Floats, index_list
from ._base import Base
from .reports import DualReport, DualVerdict, QualityReport


@dataclass(frozen=True)
class DualCell:
    """A dual cell as it is drawn: circumcentres (count, d), and paths or closed loops of their numbers."""

    points: Floats
    polylines: tuple[tuple[int, ...], ...]
    polygons: tuple[tuple[int, ...], ...]


class Geometry(Base):
    """What needs a metric: positions, corners or edge lengths. GeometryError where there is none."""

    @property
    def metric_source(self) -> str | None:
        """What the metric is made of: "points", "corners", "edge_lengths_squared", or None if there is none."""
        return self._core.metric_source()

    @property
    def ambient_dimension(self) -> int:
        """m, the dimension of space; 0 if there are no positions."""
        return self._core.ambient_dimension

    @property
    def points(self) -> Floats | Any:
        """The positions of the vertices, or None if there are none. Shape (|V|, m), units length, read-only, no copy.

        Type checkers take them for an array, so that programs need not ask for None.
        """
        points: Any = self._core.points()
        return None if points is None else np.asarray(points)

    def corners(self) -> Floats:
        """The positions of the corners of every top simplex in the order of its sorted vertices, in its own chart.

        Shape    (|K_n|, n+1, m); with edge lengths only, (|K_n|, n+1, n) in a frame of its own
        Units    length
        Raises   GeometryError without a metric
        """
        return self._core.corners()

    def edge_lengths_squared(self) -> Floats:
        """Squared edge lengths.

        Shape    (|E|,), units length^2
        Raises   GeometryError without a metric; InputError for n = 0
        """
        return self._core.edge_lengths_squared()

    def volumes(self, k: int) -> Floats:
        """The volumes of the k-simplices: 1, lengths, areas, …, never negative.

        Shape    (|K_k|,), units length^k
        Cost     for 0 < k < n that of all degrees; nothing is kept
        Raises   InputError unless 0 <= k <= n; GeometryError without a metric
        """
        return self._core.volumes(self._degree(k))

    def dual_volumes(self, k: int) -> Floats:
        """The signed volumes of the circumcentric dual cells of the k-simplices.

        Shape    (|K_k|,), units length^(n-k)
        Law      (volumes(k) * dual_volumes(k)).sum() is C(n, k) times the volume, on every mesh
        Cost     that of all degrees; nothing is kept
        Raises   InputError unless 0 <= k <= n; GeometryError without a metric, or naming flat top simplices
        Source   Elcott & Schröder, §6.2.1, with 1/(n-k) and signs
        """
        return self._core.dual_volumes(self._degree(k))

    def quality(self) -> QualityReport:
        """Which top simplices are flat or inverted, and how large they are.

        Raises   GeometryError without a metric
        """
        return QualityReport(*self._core.quality())

    def dual_report(self) -> DualReport:
        """What the circumcentric dual is like: Delaunay, one-sided, well-centred; zeros and negative entries by degree.

        Raises   GeometryError without a metric
        """
        stars, delaunay, one_sided, well_centered, degenerate = self._core.dual_report()
        return DualReport(tuple(DualVerdict(*star) for star in stars), delaunay, one_sided, well_centered, degenerate)

    def dual_cells(self, k: int, simplices: npt.ArrayLike) -> list[DualCell]:
        """The circumcentric dual cells of some k-simplices as points, paths and loops, for pictures.

        Shape    simplices (count,), indices in `simplices(k)`
        Raises   InputError unless n-k <= 3 and simplices are in [0, |K_k|); GeometryError naming a flat simplex
        """
        cells = self._core.dual_cells(self._degree(k), index_list(simplices, "simplices"))
        return [DualCell(p, tuple(map(tuple, a)), tuple(map(tuple, b))) for p, a, b in cells]
