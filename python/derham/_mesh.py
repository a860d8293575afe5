"""Spaces with conditions on parts of the boundary; refinement; other numbers."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy.typing as npt

from ._arguments import Integers, index_list, one_of
from ._data import Data
from .errors import InputError
from .spaces import FormSpace, Refinement

if TYPE_CHECKING:
    from .complex import Complex


class Renumbered(NamedTuple):
    """`complex` with other numbers: `vertices` (|V|,) has the new number of every vertex, `rows` the old number of every top
    simplex."""

    complex: Complex
    vertices: Integers
    rows: Integers


class Mesh(Data):
    """What is made of a complex with all that its mesh says."""

    def form_space(self, prescribed: Literal["boundary"] | npt.ArrayLike | None = "boundary") -> FormSpace:
        """Forms with boundary conditions: what is prescribed is on the closure of some facets.

        prescribed  "boundary" for all of it (relative forms), None for nothing (absolute), or the indices of facets
        Raises      InputError for what is none of these, or unless n is 1 to 4
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
