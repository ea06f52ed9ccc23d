"""Records of a fit: the data, and the resulting curve."""

from __future__ import annotations

from math import ceil
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arrays import FloatArray, IntArray, parameter_array, point_array
from curvecore.errors import CurveError
from curvecore.families.curve import ParametricCurve
from curvecore.fitting.joints import lengths_along

_MANY = 1500
"""Data among which the number of points is searched; all of them count in the end."""


class Fit(NamedTuple):
    """A curve near data.

    Attributes
    ----------
    curve : ParametricCurve
        Of the family asked for; a `Chain` of such curves where the data have corners.
    parameters : ndarray, shape (m,)
        Where on the curve the data belong.
    deviation : float
        The largest distance of the data from the curve there.
    root_mean_square : float
        The root of the mean of the squared distances.
    worst : int
        The index of the datum of the largest distance.
    is_scattered : bool
        Whether a tolerance was not kept because the data lie around the curve without a trend: they have
        errors as large as that, and more points would follow these alone.

    See Also
    --------
    fit : The function that returns it.

    Examples
    --------
    >>> from curvecore import HermiteCurve, fit
    >>> found = fit([[0, 0], [1, 1], [2, 2], [3, 3]], HermiteCurve, 2)
    >>> found.curve
    HermiteCurve(n=2, dim=2, domain=(0, 1))
    >>> round(found.deviation, 9), len(found.parameters)
    (0.0, 4)
    """

    curve: ParametricCurve
    parameters: FloatArray
    deviation: float
    root_mean_square: float
    worst: int
    is_scattered: bool = False


class Data(NamedTuple):
    """Data without those that coincide with the one before.

    Attributes
    ----------
    points, along
        (m, dim), and the length of the polyline so far, (m,).
    parameters
        Where they begin, (m,): a share of the length, or what was given.
    rows, total
        The index of each among all, and how many these are.
    """

    points: FloatArray
    along: FloatArray
    parameters: FloatArray
    rows: IntArray
    total: int

    @classmethod
    def of(cls, points: ArrayLike, parameters: ArrayLike | None, closed: bool, grain: float) -> Data:
        """Return data that are checked; `grain` is the length below which they tell of their errors."""
        data = point_array(points)
        total = len(data)
        given = None if parameters is None else parameter_array(parameters, total)
        if closed and given is None and (data[0] != data[-1]).any():
            data = np.concatenate([data, data[:1]])
        along = lengths_along(data, grain)
        is_new = np.append(True, np.diff(along) > 0.0) | (given is not None)
        if not along[-1] > 0.0 or not np.isfinite(along[-1]):
            raise CurveError("points must be distinct, and not too far apart to measure")
        at = along / along[-1] if given is None else given
        rows = np.flatnonzero(is_new)
        return cls(data[rows], along[rows], at[rows], np.asarray(rows), total)

    def thinned(self, corners: list[int]) -> tuple[Data, list[int]]:
        """Return some of the data, by which a search goes quickly, and where their corners are."""
        step = ceil(len(self.points) / _MANY)
        rows = np.union1d(np.arange(0, len(self.points), step), [*corners, len(self.points) - 1])
        points, along, parameters = self.points[rows], self.along[rows], self.parameters[rows]
        indices: list[int] = np.searchsorted(rows, corners).tolist()
        return Data(points, along, parameters, self.rows[rows], self.total), indices

    def of_all(self, fit: Fit) -> Fit:
        """Return the fit as one of all data: left out ones have the parameter of the one before."""
        which = np.searchsorted(self.rows, np.arange(self.total), side="right") - 1
        return fit._replace(parameters=fit.parameters[which], worst=int(self.rows[fit.worst]) % self.total)
