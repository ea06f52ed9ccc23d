"""A family with settings of both kinds: Lagrange curves that sway between their points."""

from __future__ import annotations

import numpy as np
from numpy.polynomial import Polynomial

from curvecore import FamilySetting, LagrangeCurve, ParametricCurve
from curvecore.arrays import FloatArray

_SIDES = (("left", "Left"), ("right", "Right"))


class SwayingCurve(ParametricCurve):
    """The polynomial through the points, and the one that vanishes at all parameters."""

    __slots__ = ()

    name = "tests_swaying"
    title = "swaying"
    settings = (
        FamilySetting("amount", "amount of sway", 2, "How far it sways", limits=(0, 9)),
        FamilySetting(
            "first_side",
            "first side",
            "left",
            "The side it sways to first",
            choices=_SIDES,
        ),
    )

    def _basis(self, t: FloatArray, order: int) -> FloatArray:
        count = len(self.parameters)
        sway = Polynomial.fromroots(self.parameters)
        amount = int(self.chosen["amount"]) * (1 if self.chosen["first_side"] == "left" else -1)
        own = amount * (sway.deriv(order) if order else sway)(t)
        basis = LagrangeCurve(np.zeros((count, 1)), self.parameters).basis(t, order)
        return np.asarray(basis + own[:, None, None] * (-1.0) ** np.arange(count)[:, None])
