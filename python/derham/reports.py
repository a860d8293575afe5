"""Answers to questions about a complex, to be read by people (`print`, notebooks) and programs alike."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, fields
from html import escape
from typing import Any

import numpy as np
import numpy.typing as npt


def _in_words(value: Any) -> str:
    """A value on one line; long lists by their length and first entries."""
    if isinstance(value, float):
        return f"{value:.6g}"
    if isinstance(value, (np.ndarray, tuple, list)):
        if len(value) == 0:
            return "none"
        first = ", ".join(str(v) for v in value[:6])
        return f"{len(value)}: {first}{', …' if len(value) > 6 else ''}"
    if isinstance(value, bool):
        return "yes" if value else "no"
    return str(value)


def table(caption: str, rows: Iterable[tuple[str, str]]) -> str:
    """For notebooks."""
    cells = "".join(f"<tr><th>{escape(name)}</th><td>{escape(value)}</td></tr>" for name, value in rows)
    return f"<table><caption>{escape(caption)}</caption>{cells}</table>"


class Report:
    """Written as a small table."""

    def _rows(self) -> list[tuple[str, str]]:
        return [(f.name.replace("_", " "), _in_words(getattr(self, f.name))) for f in fields(self)]  # type: ignore[arg-type]

    def __repr__(self) -> str:
        rows = self._rows()
        width = max(len(name) for name, _ in rows)
        return "\n".join([type(self).__name__] + [f"  {name:<{width}}  {value}" for name, value in rows])

    def _repr_html_(self) -> str:
        return table(type(self).__name__, self._rows())


@dataclass(frozen=True, repr=False, eq=False)
class ManifoldDefect(Report):
    """What is wrong at a simplex: its kind (facet, ring, link, unproved, orientation), its vertices, and how to mend it."""

    kind: str
    simplex: tuple[int, ...]
    detail: str


@dataclass(frozen=True, repr=False, eq=False)
class ManifoldReport(Report):
    """Whether a complex is a combinatorial manifold: `verdict` is "yes", "no" or "unproved".

    Truth is a proof: `if K.check(): …`.
    """

    verdict: str
    pure: bool
    closed: bool
    orientable: bool
    defects: tuple[ManifoldDefect, ...]

    def __bool__(self) -> bool:
        return self.verdict == "yes"

    def _rows(self) -> list[tuple[str, str]]:
        rows = super()._rows()
        rows[-1] = ("defects", str(len(self.defects)) if self.defects else "none")
        return rows + [(f"{d.kind} {d.simplex}", d.detail) for d in self.defects[:6]]


@dataclass(frozen=True, repr=False, eq=False)
class StarReport(Report):
    """What a Hodge star of degree k is good for on a mesh, and what to use instead.

    `definiteness` is "positive", "not positive" or "unproved"; `zero` and `negative` are the k-simplices with such diagonal
    entries; `condition` is exact for diagonals and from below for matrices; `constant_error` is the largest error of the
    products of constant forms over the volume, NaN where it is not defined. Units of entries: length^(n-2k).
    """

    degree: int
    definiteness: str
    zero: npt.NDArray[Any]
    negative: npt.NDArray[Any]
    smallest: float
    largest: float
    condition: float
    constant_error: float
    advice: str

    def __bool__(self) -> bool:
        return self.definiteness == "positive"


@dataclass(frozen=True, repr=False, eq=False)
class QualityReport(Report):
    """Top simplices that a metric cannot believe: flat ones and inverted ones; volumes in units of length^n."""

    degenerate: npt.NDArray[Any]
    inverted: npt.NDArray[Any]
    smallest_volume: float
    largest_volume: float
    total_volume: float


@dataclass(frozen=True, repr=False, eq=False)
class DualVerdict(Report):
    """What the circumcentric star of one degree is like: its smallest entry, and where it is zero or negative."""

    min: float
    zero: npt.NDArray[Any]
    negative: npt.NDArray[Any]
    undefined: int


@dataclass(frozen=True, repr=False, eq=False)
class DualReport(Report):
    """What the circumcentric dual is like; `star` has a DualVerdict for every degree."""

    star: tuple[DualVerdict, ...]
    pairwise_delaunay: bool
    one_sided: bool
    well_centered: bool
    degenerate: npt.NDArray[Any]

    def _rows(self) -> list[tuple[str, str]]:
        stars = [
            (f"star {k}", f"min {s.min:.6g}, {len(s.zero)} zero, {len(s.negative)} negative, {s.undefined} undefined")
            for k, s in enumerate(self.star)
        ]
        return stars + super()._rows()[1:]


@dataclass(frozen=True, repr=False, eq=False)
class HotWeights(Report):
    """Weights for the power star, and what they do.

    `energy` is Σ |T| |c_T - b_T|², c_T power centres and b_T barycentres, before for weights 0; units length^(n+2). The
    k-simplices whose dual volume is not positive are lists by degree. `excluded_range` is not 0 if there are no good weights.
    """

    weights: npt.NDArray[Any]
    energy_before: float
    energy: float
    not_positive_before: tuple[npt.NDArray[Any], ...]
    not_positive: tuple[npt.NDArray[Any], ...]
    excluded_range: float
    advice: str

    def __bool__(self) -> bool:
        return not any(len(list_) for list_ in self.not_positive)

    def _rows(self) -> list[tuple[str, str]]:
        counts = [", ".join(str(len(x)) for x in lists) for lists in (self.not_positive_before, self.not_positive)]
        rows = super()._rows()
        rows[3:5] = [("not positive before", counts[0]), ("not positive", counts[1])]
        return rows
