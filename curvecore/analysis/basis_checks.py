"""Checks of basis functions: whether they add up to 1, and are 1 or 0 at the parameters."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from curvecore.arrays import FloatArray
from curvecore.families.basis_curve import MEASURED
from curvecore.families.curve import ParametricCurve
from curvecore.families.lagrange import LagrangeCurve

_ROUNDING = 2.0**-46
"""Rounding of functions and of their sum, per unit of the sum of their sizes: 64 roundings, 128 u."""

_PER_SEGMENT = 16
_MOST_SAMPLES = 640
_STENCIL = np.arange(-3.0, 4.0)
_STEP = 1.0 / 64.0
_SLOPE_AGREES = 1e-3
"""Relative difference up to which a slope and the differences of values count as one: the stencil's own
error is the 7th derivative times the 6th power of a step of a 64th of a gap."""


class SumDefect(NamedTuple):
    """The parameter at which the functions are farthest from adding up to 1.

    Attributes
    ----------
    t : float
    total : float
        Their sum there.

    See Also
    --------
    sum_defect : The function that returns it.

    Examples
    --------
    >>> import numpy as np
    >>> from curvecore import BasisCurve, Scheme, sum_defect
    >>> doubled = Scheme("doubled", lambda t, x: 2 * np.stack([1 - t, t], axis=1))
    >>> sum_defect(BasisCurve([[0], [1]], [0, 1], doubled)).total
    2.0
    """

    t: float
    total: float


class CardinalDefect(NamedTuple):
    """The value of a function at a parameter that is farthest from the 1 or the 0 that it should be.

    Attributes
    ----------
    function, parameter : int
        i and j of B_i(t_j).
    value : float

    See Also
    --------
    cardinal_defect : The function that returns it.

    Examples
    --------
    >>> import numpy as np
    >>> from curvecore import BasisCurve, Scheme, cardinal_defect
    >>> doubled = Scheme("doubled", lambda t, x: 2 * np.stack([1 - t, t], axis=1))
    >>> defect = cardinal_defect(BasisCurve([[0], [1]], [0, 1], doubled))
    >>> defect.value, defect.wanted
    (2.0, 1)
    """

    function: int
    parameter: int
    value: float

    @property
    def wanted(self) -> int:
        """1 for a function's own parameter, else 0."""
        return int(self.function == self.parameter)


class Miss(NamedTuple):
    """The point that a curve misses by most.

    Attributes
    ----------
    point : int
        i.
    distance : float
        Between c(t_i) and p_i.

    See Also
    --------
    worst_miss : The function that returns it.

    Examples
    --------
    >>> import numpy as np
    >>> from curvecore import BasisCurve, Scheme, worst_miss
    >>> doubled = Scheme("doubled", lambda t, x: 2 * np.stack([1 - t, t], axis=1))
    >>> worst_miss(BasisCurve([[0], [1]], [0, 1], doubled)).distance
    1.0
    """

    point: int
    distance: float


class SlopeDefect(NamedTuple):
    """The parameter at which the stated B_i' differs most from the slope of B_i.

    Attributes
    ----------
    function : int
    t : float
    said, found : float
        B_i'(t), and the slope of the values around t; both per unit of t.

    See Also
    --------
    slope_defect : The function that returns it.

    Examples
    --------
    >>> import numpy as np
    >>> from curvecore import BasisCurve, Scheme, slope_defect
    >>> class Wrong(BasisCurve):
    ...     scheme = Scheme("wrong", lambda t, x, order: np.stack([1 - t, t], axis=1), has_orders=True)
    >>> round(slope_defect(Wrong([[0], [1]], [0, 1])).found, 6)
    -1.0
    """

    function: int
    t: float
    said: float
    found: float


def sum_defect(curve: ParametricCurve) -> SumDefect | None:
    """Return the parameter at which the sum of the B_i0 is farthest from 1; None where it is 1, to rounding.

    Where they do not, moving all points by the same way moves the curve by another.

    Parameters
    ----------
    curve : ParametricCurve
        Sampled at 16 parameters a segment, at most 640 in all, the parameters among them where they are
        fewer.

    Returns
    -------
    SumDefect or None
        Off by more than 1e-9 and than 128 u times the sum of sizes, u = 2**-53.

    See Also
    --------
    SumDefect : What it returns.
    cardinal_defect, worst_miss, slope_defect : Other checks.

    Examples
    --------
    >>> from curvecore import LagrangeCurve, sum_defect, uniform
    >>> sum_defect(LagrangeCurve([[0, 0], [1, 2], [3, 1]], uniform(3))) is None
    True
    """
    t = _sample_parameters(curve)
    functions = curve.basis(t)[:, :, 0]
    with np.errstate(over="ignore", invalid="ignore"):
        totals = functions.sum(axis=1)
        off = np.abs(totals - 1.0)
        is_off = off > MEASURED + _ROUNDING * np.abs(functions).sum(axis=1)
    if not is_off.any():
        return None
    worst = int(np.where(is_off, off, -1.0).argmax())
    return SumDefect(float(t[worst]), float(totals[worst]))


def cardinal_defect(curve: ParametricCurve) -> CardinalDefect | None:
    """Return which B_i0(t_j) is farthest from 1 for i = j, else from 0.

    Parameters
    ----------
    curve : ParametricCurve
        Of any family.

    Returns
    -------
    CardinalDefect or None
        None where none is off by over 1e-9.

    See Also
    --------
    CardinalDefect : What it returns.
    sum_defect, worst_miss, slope_defect : Other checks.

    Examples
    --------
    >>> from curvecore import LagrangeCurve, cardinal_defect
    >>> cardinal_defect(LagrangeCurve([[0, 0], [1, 2], [3, 1]], [0, 1, 2])) is None
    True
    """
    functions = curve.basis(curve.parameters)[:, :, 0]
    off = np.abs(functions - np.eye(len(functions)))
    parameter, function = np.unravel_index(int(off.argmax()), off.shape)
    if off[parameter, function] <= MEASURED:
        return None
    return CardinalDefect(int(function), int(parameter), float(functions[parameter, function]))


def worst_miss(curve: ParametricCurve) -> Miss | None:
    """Return which point the curve misses by most.

    Parameters
    ----------
    curve : ParametricCurve
        Of any family.

    Returns
    -------
    Miss or None
        None where it passes all, to 1e-9 of their size.

    See Also
    --------
    Miss : What it returns.
    sum_defect, cardinal_defect, slope_defect : Other checks.

    Examples
    --------
    >>> from curvecore import HermiteCurve, worst_miss
    >>> worst_miss(HermiteCurve([[0, 0], [1, 0]], [[1, 1], [1, -1]], [0, 1])) is None
    True
    """
    points = curve.jets[:, 0]
    offsets = curve.evaluate(curve.parameters) - curve.points
    with np.errstate(over="ignore", under="ignore"):
        distances = np.sqrt(np.square(offsets).sum(axis=1))
    index = int(distances.argmax())
    if distances[index] <= MEASURED * float(np.abs(points).max()):
        return None
    return Miss(index, float(distances[index]))


def slope_defect(curve: ParametricCurve) -> SlopeDefect | None:
    """Return the parameter and the function at which B_i0' differs most from the slope of B_i0.

    Parameters
    ----------
    curve : ParametricCurve
        Measured in the middle of each stretch between breaks and parameters, at 64 of them at most, against
        the slope of the polynomial through seven values around it.

    Returns
    -------
    SlopeDefect or None
        None where the two agree to a thousandth.

    See Also
    --------
    SlopeDefect : What it returns.
    sum_defect, cardinal_defect, worst_miss : Other checks.

    Examples
    --------
    >>> from curvecore import HermiteCurve, slope_defect
    >>> slope_defect(HermiteCurve([[0], [1]], [[0], [0]], [0, 1])) is None
    True
    """
    ends = np.union1d(curve.breaks, curve.parameters)
    picked = np.unique(np.linspace(0, len(ends) - 2, min(len(ends) - 1, 64)).astype(int))
    gaps = np.diff(ends)[picked]
    middle = ends[picked] + 0.5 * gaps
    step = _STEP * gaps
    values = curve.basis((middle[:, None] + step[:, None] * _STENCIL).ravel())[:, :, 0]
    values = values.reshape(len(middle), len(_STENCIL), -1)
    weights = LagrangeCurve(np.zeros((len(_STENCIL), 1)), _STENCIL).basis([0.0], 1)[0, :, 0]
    with np.errstate(over="ignore", under="ignore", invalid="ignore"):
        differences = np.einsum("k,mkn->mn", weights, values) / step[:, None]
        derivatives = curve.basis(middle, 1)[:, :, 0]
        # What the values round to, seen through the differences of them.
        noise = 16.0 * _ROUNDING * np.abs(values).sum(axis=(1, 2))[:, None] / step[:, None]
        size = np.maximum(np.abs(differences).max(axis=1), np.abs(derivatives).max(axis=1))[:, None]
        # The seven parameters are rounded as well: far from 0 they are not evenly spaced.
        agrees = _SLOPE_AGREES + _ROUNDING * np.abs(middle) / step
        excess = np.abs(derivatives - differences) - agrees[:, None] * size - noise
    row, function = np.unravel_index(int(np.nan_to_num(excess, nan=-1.0).argmax()), excess.shape)
    if not excess[row, function] > 0.0:
        return None
    at = float(middle[row])
    return SlopeDefect(
        int(function), at, float(derivatives[row, function]), float(differences[row, function])
    )


def _sample_parameters(curve: ParametricCurve) -> FloatArray:
    """Return the parameters of the sums: evenly within each segment, or over all where there are many."""
    t = curve.parameters
    if _PER_SEGMENT * (len(t) - 1) > _MOST_SAMPLES:
        return np.linspace(*curve.domain, _MOST_SAMPLES)
    shares = np.arange(_PER_SEGMENT) / _PER_SEGMENT
    inner: FloatArray = (t[:-1, None] + np.diff(t)[:, None] * shares).ravel()
    return np.append(inner, t[-1])
