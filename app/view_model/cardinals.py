"""The cardinal functions of a curve's points: what each of them does, with the estimates that follow it."""

from __future__ import annotations

import math
from functools import cached_property

import msgspec
import numpy as np

from app.document.model import Curve, VelocityRule
from app.view_model.jets import moved_with_points
from app.view_model.point_arrays import PointArrays
from curvecore import Curve as CoreCurve
from curvecore import CurveError, lebesgue_constant
from curvecore.analysis.cardinal import CardinalBasis
from curvecore.arrays import BoolArray, FloatArray

_MANY, _REACH = 200, 24
"""Points from which on an estimate forgets a point after so many: 1e-14 of it is left, as a rule."""


class Cardinal(msgspec.Struct, frozen=True, eq=False, dict=True):
    """Cardinal functions, and what they were made of.

    Attributes
    ----------
    rules, numbers
        All that they depend on.
    functions
        None where an estimate is beyond all floats.
    """

    rules: tuple[object, ...]
    numbers: tuple[FloatArray | BoolArray, ...]
    functions: CardinalBasis | None

    @cached_property
    def growth(self) -> float:
        """Their Lebesgue constant."""
        return lebesgue_constant(self.functions) if self.functions is not None else math.inf


class Cardinals:
    """Remembers the cardinal functions of one curve, which change with few of its edits.

    They depend on parameters, rules, corners and on which derivatives were set, not on the points.
    """

    def __init__(self) -> None:
        self._known: Cardinal | None = None

    def of(self, curve: Curve, points: FloatArray, basis_curve: CoreCurve, arrays: PointArrays) -> Cardinal:
        """Return the functions of a curve.

        Parameters
        ----------
        curve
            The document's value.
        points
            Its points at its knots, (k, 2).
        basis_curve
            A core curve with its basis functions.
        arrays
            The numbers in its points.
        """
        rules: tuple[object, ...] = (
            curve.family, curve.velocity_rule, curve.acceleration_rule, curve.is_closed,
        )  # fmt: skip
        is_set = ~np.isnan(arrays.given[:, :, : curve.family.derivatives, 0])
        numbers: tuple[FloatArray | BoolArray, ...] = (basis_curve.parameters, arrays.corners, is_set)
        if curve.velocity_rule is VelocityRule.CATMULL_ROM and curve.family.derivatives:
            rules, numbers = (*rules, curve.parametrization.alpha), (*numbers, points)
        known = self._known
        if known is None or known.rules != rules or not all(map(np.array_equal, known.numbers, numbers)):
            known = Cardinal(rules, numbers, _made(curve, points, basis_curve, arrays))
            self._known = known
        return known


def _made(
    curve: Curve, points: FloatArray, basis_curve: CoreCurve, arrays: PointArrays
) -> CardinalBasis | None:
    if not curve.family.derivatives:
        return CardinalBasis(basis_curve)
    follow = moved_with_points(curve, points, basis_curve.parameters, arrays)
    try:
        if len(curve.points) < _MANY:
            return CardinalBasis(basis_curve, follow, closed=curve.is_closed)
        return CardinalBasis(basis_curve, follow, closed=curve.is_closed, reach=_REACH)
    except CurveError:
        return None
