"""Products of forms."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from ._arguments import Floats, shown
from ._base import Base, Side
from .errors import InputError


class Wedge(Base):
    """What multiplies forms; it needs no metric."""

    def wedge(
        self, a: npt.ArrayLike, p: int, b: npt.ArrayLike, q: int, *, sides: Side | tuple[Side, Side] = "primal"
    ) -> Floats:
        """a ∧ b of a p-form and a q-form. Needs no metric.

        sides    those of a and b, or of both. Primal forms: the cup product, made antisymmetric. With dual forms there is
                 f ∧ b of a function and a form of any sides, by means of f about every simplex, on the side of the form (of
                 the second if both are functions); and a ∧ b of dual 1-forms for n = 2. The integral of a primal k-form
                 ∧ a dual (n-k)-form is `a @ b`
        Shape    those of forms of these degrees and sides; the result too
        Laws     of primal forms d(a ∧ b) = da ∧ b + (-1)^p a ∧ db; of all b ∧ a = (-1)^(pq) a ∧ b. Associative on closed
                 forms only
        Invalid  Leibniz' rule of functions and forms of different sides, but for constants; products with dual forms
                 are not exact on constant forms; dual 2-forms of boundary vertices are 0
        Raises   InputError where there is no such product, or on a wrong shape; TopologyError for dual forms unless K is
                 orientable and pure
        Source   Whitney, "On products in a complex", 1938; Wilson 2007, §5; Ptáčková & Velho 2021, §3.1 (polygons)

        >>> import derham
        >>> K = derham.Complex([(0, 1, 2)])
        >>> K.wedge([1.0, 2, 6], 0, [1.0], 0, sides=("primal", "dual"))
        array([3.])
        """
        if not isinstance(sides, str) and (not isinstance(sides, Sequence) or len(sides) != 2):
            raise InputError(f"sides is {shown(sides)}; expected 'primal', 'dual', or two of them")
        a_side, b_side = (sides, sides) if isinstance(sides, str) else sides
        a_dual, b_dual = self._side(a_side), self._side(b_side)
        p = self._degree(p, name="p")
        q = self._degree(q, 0, self.dimension - p, name="q")
        x, y = self._one_form(a, p, a_side, "a"), self._one_form(b, q, b_side, "b")
        if not (a_dual or b_dual):
            result = np.empty(self._sizes[p + q])
            self._core.apply_wedge(p, x, q, y, result)
            return result
        if p == 0:
            return self._core.function_wedge(a_dual, x, b_dual, q, y)
        if q == 0:
            return self._core.function_wedge(b_dual, y, a_dual, p, x)
        if self.dimension == 2 and a_dual and b_dual:
            return self._core.polygon_wedge(x, y)
        raise InputError(
            f"there is no product of a {a_side} {p}-form and a {b_side} {q}-form in dimension {self.dimension}; there are "
            "those of primal forms, of functions with all forms, and of dual 1-forms in dimension 2"
        )
