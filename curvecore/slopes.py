"""Slopes of chords, which all rules for tangents begin with, and the refusal of what no double can hold."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import NamedTuple, ParamSpec

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arrays import FloatArray, parameter_array, point_array
from curvecore.errors import CurveError

_Arguments = ParamSpec("_Arguments")


def in_range(rule: Callable[_Arguments, FloatArray]) -> Callable[_Arguments, FloatArray]:
    """Make a rule refuse to return what no double can hold."""

    @wraps(rule)
    def checked(*args: _Arguments.args, **kwargs: _Arguments.kwargs) -> FloatArray:
        with np.errstate(over="ignore", under="ignore", invalid="ignore"):
            estimates = rule(*args, **kwargs)
        if not np.isfinite(estimates).all():
            i = int(np.argmin(np.isfinite(estimates).all(axis=1)))
            raise CurveError(
                f"points around {i} lie too far apart for parameters so close: "
                "the derivative there exceeds the largest number",
                (i,),
            )
        return estimates

    return checked


class Steps(NamedTuple):
    """Differences of checked points and parameters.

    Attributes
    ----------
    spacing : ndarray, shape (n - 1, 1)
        Segment lengths h_i in t.
    slope : ndarray, shape (n - 1, dim)
        (p_(i+1) - p_i) / h_i.
    """

    spacing: FloatArray
    slope: FloatArray


class Spaced(NamedTuple):
    """Increasing parameters, given by their distances: sums over turns of a closed curve would be rounded.

    Attributes
    ----------
    spacing : ndarray, shape (n - 1,)
        Distances of consecutive ones.
    """

    spacing: FloatArray


def steps_of(points: ArrayLike, parameters: ArrayLike) -> Steps:
    """Check points, (n, dim), and parameters, (n,), and return their differences."""
    places = point_array(points)
    if isinstance(parameters, Spaced):
        return differences(places, parameters.spacing)
    return differences(places, np.diff(parameter_array(parameters, len(places))))


def differences(points: FloatArray, spacing: FloatArray) -> Steps:
    """Return the differences of points, (n, dim), so far apart in t, (n - 1,)."""
    h = spacing[:, None]
    return Steps(h, (points[1:] - points[:-1]) / h)
