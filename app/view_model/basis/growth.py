"""The growth of errors of the points on the curve: the Lebesgue function Λ(t) and the constant Λ.

Where velocities or accelerations are estimated they follow the points, so it is the cardinal functions of the
points that count, Λ(t) = Σ |Cᵢ(t)|. Errors of the data, where estimated derivatives count as given, are
another question: they grow by Σ |Bᵢ₀(t)|, which is 1 for every Hermite curve.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from curvecore import CardinalBasis, lebesgue_constant
from curvecore.analysis.stability import lebesgue_constants
from curvecore.arithmetic import LARGEST
from curvecore.arrays import FloatArray

from ..curve.core_curve import unbounded
from ..curve.curve_view import CurveView
from .basis_view import BasisView


def growth_at(view: CurveView, t: FloatArray) -> FloatArray:
    """Return Λ(t) of the points of a current curve at t (m,)."""
    return view.cardinal.sums(t) if view.cardinal is not None else t * 0.0 + LARGEST


def growth_of_points(view: CurveView, basis: BasisView | None = None) -> float:
    """Return the Lebesgue constant Λ of the points of a curve; infinite where it is beyond all floats.

    `basis` lends functions, of which many take long. What is on screen may still be the functions of another
    curve.
    """
    if not view.is_current or view.basis_curve is None:
        return math.nan
    return basis.lebesgue_constant if basis is not None and _lends(basis, view) else view.growth


def growth_of_data(view: CurveView, basis: BasisView | None = None) -> float:
    """Return the Lebesgue constant where velocities and accelerations stay as they are."""
    if not view.is_current or view.basis_curve is None:
        return math.nan
    if view.basis_curve.is_positive:
        return 1.0
    if basis is not None and _lends(basis, view):
        return basis.lebesgue_constant
    return lebesgue_constant(CardinalBasis(view.basis_curve, closed=view.source.is_closed))


def _lends(basis: BasisView, view: CurveView) -> bool:
    """Whether these are dense functions, and of this curve: family, settings and parameters decide."""
    own = view.basis_curve
    if own is None or basis.curve.is_local or basis.curve.functions_key != own.functions_key:
        return False
    if view.source.is_closed:
        return False  # the samples may be those of an open curve
    return bool(np.array_equal(basis.curve.parameters, view.parameters))


def growths_of_points(views: Sequence[CurveView]) -> list[float]:
    """Return the Lebesgue constants Λ of the points of many current curves in a fraction of the time."""
    bases = [view.cardinal for view in views]
    following = [basis for basis in bases if basis is not None and basis.follows]
    constants = map(unbounded, lebesgue_constants(following))
    return [
        math.inf
        if basis is None
        else next(constants)
        if basis.follows
        else unbounded(lebesgue_constant(basis))
        for basis in bases
    ]
