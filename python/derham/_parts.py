"""Named parts of a mesh: curves, surfaces and regions."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
import numpy.typing as npt

from ._arguments import Integers, flag, index_array, index_dtype, index_list, shown
from ._base import Base
from .errors import InputError

#: The tuples of vertices of some simplices, or (indices, k)
GivenPart: TypeAlias = npt.ArrayLike | tuple[npt.ArrayLike, int]


@dataclass(frozen=True)
class Part:
    """A named set of simplices of one dimension: a physical group of Gmsh, a marker of TetGen, a reference of Medit."""

    name: str
    number: int
    degree: int
    count: int


class Parts(Base):
    """Parts as they are listed, as chains, as facets with conditions."""

    @property
    def parts(self) -> tuple[Part, ...]:
        """The tagged points, curves, surfaces and regions of the mesh."""
        return tuple(Part(*part) for part in self._core.parts())

    def tagged_simplices(self, part: str | int, degree: int | None = None) -> Integers:
        """The simplices of a part, each with its vertices in the order of the mesh.

        part     its name or its number
        degree   of the part, where several have the name or number
        Shape    (count, degree+1)
        Raises   InputError naming the parts there are
        """
        return self._core.tagged_simplices(self._part(part, degree)[0])

    def tagged_chain(self, part: str | int, degree: int | None = None, *, coherent: bool = False) -> npt.NDArray[np.int64]:
        """A tagged curve, surface or region as a chain: its simplices, each oriented as the file lists its vertices; those
        of top degree are positive.

        part     its name or its number
        degree   of the part, where several have the name or number
        coherent orient the simplices so that they cancel on every common face of two of them

        The integral of a form over it, a circulation or flux, is their dot product.
        Shape    (|K_degree|,)
        Raises   InputError naming the parts there are; TopologyError if it cannot be made coherent
        """
        place, degree = self._part(part, degree)
        simplices, coefficients = self._core.tagged_chain(place, flag(coherent, "coherent"))
        chain = np.zeros(self._sizes[degree], np.int64)
        chain[simplices] = coefficients
        return chain

    def tagged_facets(self, *parts: str | int) -> Integers:
        """The facets on the boundary that tagged parts of degree n-1 hold, for `form_space` and `boundary_material`. For a sheet
        inside of K see `tagged_chain`.

        parts    names or numbers
        Shape    (facets,), increasing, each once
        Raises   InputError naming the parts there are, or a simplex that is no facet of K or not on the boundary
        """
        places = [self._part(part, self.dimension - 1)[0] for part in parts]
        found = [self._core.tagged_facets(place) for place in places]
        return np.unique(np.concatenate([np.zeros(0, index_dtype), *found]))

    def _part(self, part: str | int, degree: int | None) -> tuple[int, int]:
        """The place of a part in their list, and its degree."""
        column = "number" if isinstance(part, (int, np.integer)) else "name"
        parts = self.parts
        found = [i for i, p in enumerate(parts) if getattr(p, column) == part and degree in (None, p.degree)]
        if len(found) != 1:
            known = ", ".join(f"{p.name!r} (number {p.number}, degree {p.degree})" for p in parts) or "none"
            raise InputError(f"{len(found) or 'no'} parts have the {column} {shown(part)}; there are {known}")
        return found[0], parts[found[0]].degree

    def _part_members(self, name: str | int, part: GivenPart) -> tuple[int, Integers]:
        """Its degree, and its members as the compiled half takes them."""
        what = f"the part {name!r}"
        if isinstance(part, tuple) and len(part) == 2 and isinstance(part[1], (int, np.integer)):
            k = self._degree(part[1], name=f"of {what}")
            index = index_list(part[0], what)
            if index.size and not 0 <= index.min() <= index.max() < self._sizes[k]:
                wrong = index.min() if index.min() < 0 else index.max()
                raise InputError(f"{what} has the {k}-simplex {wrong}; expected 0 to {self._sizes[k] - 1}")
            rows = self._core.simplices(k)[index]
        else:
            rows = index_array(part, what)
            if rows.ndim != 2 or not 1 <= rows.shape[1] <= self.dimension + 1:
                raise InputError(f"{what} has shape {rows.shape}; expected (count, k+1) vertices, or a pair (indices, k)")
            k = rows.shape[1] - 1
            index, _ = self._core.find(rows)
            if index.size and index.min() < 0:
                row = int(index.argmin())
                raise InputError(f"{what}: row {row}, {tuple(rows[row].tolist())}, is no simplex of the complex", row)
        members, first = np.unique(index, return_index=True)
        if members.size < index.size:
            row = int(np.setdiff1d(np.arange(index.size), first)[0])
            raise InputError(f"{what}: row {row}, {tuple(rows[row].tolist())}, is there twice", row)
        return k, members if k in (0, self.dimension) else np.ascontiguousarray(rows).reshape(-1)

    def _pure(self) -> None:
        if not self._core.is_pure():
            raise InputError("the complex is not pure: only pure ones have parts and fields")
