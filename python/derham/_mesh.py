"""What a mesh says beside its simplices: named parts and fields; conditions on parts of the boundary; refinement."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np
import numpy.typing as npt

from ._arguments import Integers, flag, index_dtype, index_list, one_of, shown
from ._base import Base
from .errors import InputError
from .spaces import FormSpace, Refinement

if TYPE_CHECKING:
    from .complex import Complex


@dataclass(frozen=True)
class Part:
    """A named set of simplices of one dimension: a physical group of Gmsh, a marker of TetGen, a reference of Medit."""

    name: str
    number: int
    degree: int
    count: int


class Renumbered(NamedTuple):
    """`complex` with other numbers: `vertices` (|V|,) has the new number of every vertex, `rows` the old number of every top
    simplex."""

    complex: Complex
    vertices: Integers
    rows: Integers


class Mesh(Base):
    """Parts, fields, notes; and what is made with them."""

    @property
    def parts(self) -> tuple[Part, ...]:
        """The tagged points, curves, surfaces and regions of the file."""
        return tuple(Part(name, number, degree, len(members)) for name, number, degree, members in self._core.parts())

    @property
    def fields(self) -> dict[str, npt.NDArray[np.float64]]:
        """The numbers that the file has on vertices or on simplices, by name. Shape (count, components)."""
        return {name: values for name, _, values in self._core.fields()}

    @property
    def notes(self) -> tuple[str, ...]:
        """What the reader did that the reader of its result should know."""
        return tuple(self._core.notes())

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

    def form_space(self, prescribed: Literal["boundary"] | npt.ArrayLike | None = "boundary") -> FormSpace:
        """Forms with boundary conditions: what is prescribed is on the closure of some facets.

        prescribed  "boundary" for all of it (relative forms), None for nothing (absolute), or the indices of facets
        """
        facets: Integers | None = None
        if not isinstance(prescribed, str):
            facets = index_list(() if prescribed is None else prescribed, "prescribed")
        elif prescribed != "boundary":
            raise InputError(f"prescribed is {prescribed!r}; expected 'boundary', None, or the indices of facets")
        self_: Any = self
        return FormSpace(self_, self._core.form_space(facets))

    def refined(self) -> Refinement:
        """The edgewise subdivision, with prolongation and restriction of forms; parts, positions and lengths come along.

        >>> import derham
        >>> derham.generate.sphere(2).refined().fine.sizes
        (10, 24, 16)
        """
        self_: Any = self
        return Refinement(self_)

    def renumbered(self, order: Literal["hilbert", "cuthill-mckee"] = "hilbert") -> Renumbered:
        """The same complex with numbers in which what is near has near numbers, so that everything runs faster on a mesh whose
        numbers are not: along a Hilbert curve through the positions, or by reverse Cuthill–McKee, which needs none.

        Parts, fields and orientation come along. The value of a k-form w on the k-simplices is carried by
        `index, sign = L.index(vertices[K.simplices(k)])` and `v[index] = sign * w`; for k = n with `K.oriented_simplices()`.

        Cost     linear, V log V for "hilbert"
        Raises   InputError for another order, or for "hilbert" without positions
        Source   Skilling, "Programming the Hilbert curve", 2004; George 1971

        >>> import derham
        >>> derham.generate.cycle(6).renumbered("cuthill-mckee").vertices.size
        6
        """
        one_of(order, ("hilbert", "cuthill-mckee"), "the order")
        core, vertices, rows = self._core.renumbered(order == "hilbert")
        self_: Any = self
        return Renumbered(self_._of(core), vertices, rows)
