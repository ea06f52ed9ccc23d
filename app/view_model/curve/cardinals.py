"""The cardinal functions of a curve's points: the effect of each, with the estimates that follow it."""

from __future__ import annotations

import math
from functools import cached_property, partial

import msgspec
import numpy as np

from curvecore import CurveError, ParametricCurve, lebesgue_constant
from curvecore.analysis.cardinal import REACH, CardinalBasis
from curvecore.arithmetic import LARGEST
from curvecore.arrays import FloatArray

from ...document.model import Curve
from .jets import moved_with_points
from .point_arrays import PointArrays

_MANY, _SHORT_REACH = 200, 24
"""Points from which on an estimate forgets a point after so many: 1e-14 of it is left, as a rule."""


class Cardinal(msgspec.Struct, frozen=True, eq=False, dict=True):
    """Cardinal functions; None where an estimate is beyond all floats."""

    functions: CardinalBasis | None

    @cached_property
    def growth(self) -> float:
        """Their Lebesgue constant; infinite where it is beyond all floats."""
        return unbounded(lebesgue_constant(self.functions)) if self.functions is not None else math.inf


def unbounded(growth: float) -> float:
    """Return a growth, infinite in place of the largest float."""
    return growth if growth < LARGEST else math.inf


class Cardinals:
    """Remembers the cardinal functions of one curve, which change with few of its edits.

    They depend on parameters, rules, corners and on which derivatives were set, not on the points.
    """

    def __init__(self) -> None:
        self._key: tuple[object, ...] = ()
        self._known = Cardinal(None)

    def of(
        self, curve: Curve, points: FloatArray, basis_curve: ParametricCurve, arrays: PointArrays
    ) -> Cardinal:
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
        is_set = ~np.isnan(arrays.given[:, :, : curve.family.derivatives, 0])
        numbers = [basis_curve.parameters, arrays.corners, arrays.ties, is_set]
        if not all(rule.is_linear for rule in curve.rules):
            numbers += [np.array(curve.parametrization.alpha), points]
        key = (curve.functions_key, curve.is_closed, *curve.rules, *(each.tobytes() for each in numbers))
        if key != self._key:
            self._key, self._known = key, Cardinal(_made(curve, points, basis_curve, arrays))
        return self._known


def _made(
    curve: Curve, points: FloatArray, basis_curve: ParametricCurve, arrays: PointArrays
) -> CardinalBasis | None:
    if not curve.family.derivatives:
        return CardinalBasis(basis_curve, closed=curve.is_closed)
    reach = REACH if len(curve.points) < _MANY else _SHORT_REACH
    moved = partial(moved_with_points, curve, points, basis_curve.parameters, arrays)
    is_local = any(rule.growth_holds for rule in curve.rules)
    sides = [moved(coordinate) for coordinate in (0, 1)] if is_local else []
    try:
        return CardinalBasis(basis_curve, moved(), closed=curve.is_closed, reach=reach, one_sided=sides)
    except CurveError:
        return None
