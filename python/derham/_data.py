"""What a mesh says beside its simplices and parts: fields, forms, the file's own numbers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
import numpy.typing as npt

from ._arguments import Floats, Integers, float_array, shown, utf8_text
from ._base import Side
from ._parts import GivenPart, Parts
from .errors import InputError

if TYPE_CHECKING:
    from .complex import Complex

#: (w, k) or (w, k, side)
GivenForm: TypeAlias = tuple[npt.ArrayLike, int] | tuple[npt.ArrayLike, int, Side]


class Data(Parts):
    """Fields, forms, numbers, notes; a complex with more of them."""

    @property
    def vertex_fields(self) -> dict[str, Floats]:
        """The numbers that the mesh has on its vertices, by name. Shape (|V|,), or (|V|, components) if several."""
        return self._fields(True)

    @property
    def simplex_fields(self) -> dict[str, Floats]:
        """The numbers that the mesh has on its top simplices, by name. Shape (|K_n|,), or (|K_n|, components) if several."""
        return self._fields(False)

    @property
    def forms(self) -> dict[str, tuple[Floats, int, Side]]:
        """The discrete forms that the mesh has (an .npz file can hold them), by name: (w, k, side)."""
        return {name: (w, k, "dual" if dual else "primal") for name, k, dual, w in self._core.forms()}

    @property
    def notes(self) -> tuple[str, ...]:
        """What the reader did that the reader of its result should know."""
        return tuple(self._core.notes())

    @property
    def vertex_tags(self) -> npt.NDArray[np.int64] | None:
        """The file's own numbers of the vertices, shape (|V|,), or None where they are 0, 1, 2, …"""
        tags = self._core.vertex_tags()
        return tags if tags.size else None

    @property
    def simplex_tags(self) -> npt.NDArray[np.int64] | None:
        """The file's own numbers of the top simplices, shape (|K_n|,), or None where they are 0, 1, 2, …"""
        tags = self._core.row_tags()
        return tags if tags.size else None

    def with_data(
        self,
        *,
        parts: Mapping[str | int, GivenPart] | None = None,
        vertex_fields: Mapping[str, npt.ArrayLike] | None = None,
        simplex_fields: Mapping[str, npt.ArrayLike] | None = None,
        forms: Mapping[str, GivenForm] | None = None,
    ) -> Complex:
        """The same complex with parts, fields and forms, beside those that it has; of the same names, the new ones count.
        They are written to files that can hold them, and come along in `refined` (all but forms) and `renumbered`.

        parts           {name or number: simplices}: (count, k+1) vertices, where their order is the orientation; or
                        (indices, k), those of `simplices(k)`
        vertex_fields   {name: (|V|,) or (|V|, components)}
        simplex_fields  {name: (|K_n|,) or (|K_n|, components)}, in the order of `simplices(n)`
        forms           {name: (w, k) or (w, k, side)}
        Cost            linear; the lists and the metric of the complex are shared
        Raises          InputError naming the part and its row that is no simplex of K, or is there twice; for a wrong shape

        >>> import derham
        >>> K = derham.generate.box(2, 1).with_data(parts={"diagonal": [(0, 3)], "lower": ([0], 2)})
        >>> K.parts[0].name, K.tagged_chain("diagonal")
        ('diagonal', array([0, 0, 1, 0, 0]))
        """
        fields = [(name, True, *self._field(values, name, 0)) for name, values in _items(vertex_fields, "vertex_fields")]
        fields += [
            (name, False, *self._field(values, name, self.dimension))
            for name, values in _items(simplex_fields, "simplex_fields")
        ]
        numbers = {(part.degree, part.name): part.number for part in self.parts}
        names = {(part.degree, part.number): part.name for part in self.parts}
        numbered = []
        for name, part in _items(parts, "parts", (str, int, np.integer)):
            degree, members = self._part_members(name, part)
            if isinstance(name, str):
                number = numbers.get((degree, name)) or next(i for i in range(1, len(names) + 2) if (degree, i) not in names)
                names[degree, number] = name
            else:
                number, name = int(name), names.get((degree, int(name)), "")
            numbered.append((name, number, degree, members))
        return self._with(numbered, fields, [(name, k, dual, w) for name, w, k, dual in self._named_forms(forms or {})])

    def _field(self, values: npt.ArrayLike, name: str, k: int) -> tuple[int, Floats]:
        """How many components it has, and its values."""
        self._pure()
        array, count = float_array(values, f"the field {name!r}"), self._sizes[k]
        if array.ndim not in (1, 2) or len(array) != count or array.shape[-1] == 0 < count:
            raise InputError(f"the field {name!r} has shape {array.shape}; expected ({count},) or ({count}, components)")
        return 1 if array.ndim == 1 else array.shape[1], array

    def _named_forms(self, forms: Mapping[str, GivenForm]) -> list[tuple[str, Floats, int, bool]]:
        """The name, values, degree and whether dual of each."""
        named = []
        for name, form in _items(forms, "forms"):
            if not isinstance(form, tuple) or len(form) not in (2, 3):
                raise InputError(f"the form {name!r} is {shown(form)}; expected (w, k) or (w, k, side)")
            w, k, *side = form
            given = side[0] if side else "primal"
            dual, k = self._side(given), self._degree(k, name=f"of {name!r}")
            named.append((name, self._one_form(w, k, given, name), k, dual))
        return named

    def _fields(self, on_vertices: bool) -> dict[str, Floats]:
        found: dict[str, Floats] = {}
        for name, there, components, values in self._core.fields():
            if there == on_vertices:
                label, number = name, 1
                while label in found:
                    label, number = f"{name} ({number + 1})", number + 1
                found[label] = values if components == 1 else values.reshape(-1, components)
        return found

    def _with(self, parts: list[Any], fields: list[Any], forms: list[Any], notes: Sequence[str] = ()) -> Complex:
        if parts:
            self._pure()
        self_: Any = self
        result: Complex = self_._of(self._core.with_data(parts, fields, forms, notes))
        return result


def _items(given: Any, name: str, keys: Any = str) -> list[tuple[Any, Any]]:
    if given is None:
        return []
    if not isinstance(given, Mapping) or not all(isinstance(key, keys) for key in given):
        raise InputError(f"{name} is {shown(given)}; expected a mapping from names")
    return [(utf8_text(key, f"a name in {name}") if isinstance(key, str) else key, value) for key, value in given.items()]
