"""A curve of few points near many data: so many, or as few as keep a tolerance.

References
----------
.. [1] P. J. Schneider, "An algorithm for automatically fitting digitized curves", Graphics Gems, Academic
   Press 1990, 612-626: parameters that move, corners apart, within a tolerance.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arrays import integer, point_array, tolerance_value
from curvecore.errors import CurveError
from curvecore.families.curve import ParametricCurve
from curvecore.families.setting import SettingValue
from curvecore.fitting.fitter import MOST, Fitter, Told
from curvecore.fitting.joints import scatter_of, sharp_turns
from curvecore.fitting.least_squares import least_squares_curve
from curvecore.fitting.records import Data, Fit
from curvecore.fitting.search import fewest

_SEARCH = 0.3
"""Share of the work that a search among some of the data takes."""

_DENSE, _ABOVE_ERRORS = 5.0, 20.0
"""Data within the reach of a corner that tell of their errors; how far that is above these, at least."""


def fit(
    points: ArrayLike,
    family: type[ParametricCurve],
    count: int | None = None,
    *,
    tolerance: float | None = None,
    parameters: ArrayLike | None = None,
    closed: bool = False,
    with_corners: bool = True,
    settings: Mapping[str, SettingValue] | None = None,
    progress: Callable[[float], object] = lambda _share: None,
) -> Fit:
    """Return a curve of few points near many data.

    All jets of the curve are unknowns of a linear least-squares problem, those of derivatives too: few
    points, each with the derivatives that fit best. It begins in the first and ends in the last of the data.
    The data's parameters begin by chord length and move to the feet of their perpendiculars; the joints move
    to where the error is; both until the largest deviation no longer falls.

    Parameters
    ----------
    points : array_like, shape (m, dim)
        The data, in order along the curve; m >= 2.
    family : type of ParametricCurve
        The class of the curve: any, whether its curves pass through their points or not.
    count : int, optional
        The points of the curve, at least 2. At a closed one the last is not counted again.
    tolerance : float, optional
        In place of `count`: the largest deviation allowed, above 0.
    parameters : array_like, shape (m,), optional
        Those of the data, strictly increasing. They are kept as they are, and deviations are measured
        between data and curve at the same parameter. Else they begin at 0 and end at 1, by chord length.
    closed : bool, optional
        Whether a last segment leads back to the first point, where the jet is the same. The data go around
        once; that they return to the first one need not be said.
    with_corners : bool, optional
        Whether the curve may have a corner where the data turn sharply, in a family with derivatives.
    settings : mapping, optional
        Values of the family's `settings`, by their names; of a closed curve such as make it periodic.
    progress : callable, optional
        Hears the share that is done, between 0 and 1, now and then; what it raises ends the work.

    Returns
    -------
    Fit
        With a tolerance the curve of the fewest points found that keeps it, else the nearest one found:
        look at its `deviation`. Where the errors of the data are larger than the tolerance, that is one
        of few points, not one that follows them (`is_scattered`).

    Raises
    ------
    CurveError
        If the data are no points, coincide, or are too few for so many points; if neither or both of count
        and tolerance are given, or the functions of so many points cannot be told apart at the data.

    See Also
    --------
    Fit : What it returns.
    least_squares_curve : With given parameters, in one step.

    Notes
    -----
    Distances are measured to the foot of a perpendicular near the datum: no datum is farther away from the
    curve. The fewest points are searched by doubling and halving, guided by the order of the approximation,
    error ~ h^p; they are the fewest for the joints that were tried. Near the tolerance the data that are
    farthest off count more than the others: the largest deviation is to be small, not only the mean.

    Examples
    --------
    >>> import numpy as np
    >>> from curvecore import HermiteCurve, fit
    >>> angle = np.linspace(0, np.pi, 200)
    >>> found = fit(np.column_stack([np.cos(angle), np.sin(angle)]), HermiteCurve, tolerance=1e-3)
    >>> found.deviation <= 1e-3, len(found.curve.points) < 10
    (True, True)
    """
    if (count is None) == (tolerance is None):
        raise CurveError("either count or tolerance must be given")
    data = Data.of(points, parameters, closed, _grain(points, count, tolerance))
    size = float(data.along[-1])
    corners: list[int] = []
    if with_corners and family.derivatives and family.is_local:
        reach = 5.0 * tolerance if tolerance is not None else size / (4.0 * max(count or 0, 4))
        spacing = size / len(data.points)
        reach = max(reach, 4.0 * spacing)
        if reach > _DENSE * spacing:
            reach = max(reach, _ABOVE_ERRORS * scatter_of(data.points))
        corners = sharp_turns(data.points, reach, closed=closed)
        # So many are none.
        corners = corners if len(corners) <= MOST // 4 else []
    told = Told(progress)
    solve = partial(least_squares_curve, family, closed=closed, settings=settings)
    moves = parameters is None
    fitter = partial(
        Fitter, family=family, solve=solve, closed=closed, told=told, tolerance=tolerance or 0.0, moves=moves
    )
    everything = fitter(data, corners=corners)
    if tolerance is None:
        assert count is not None
        return data.told(everything.attempt(count).fit)
    few, their_corners = data.thinned(corners)
    if len(few.points) == len(data.points):
        return data.told(fewest(everything).fit)
    told.goes(0.0, _SEARCH)
    found = fewest(fitter(few, corners=their_corners), persists=False)
    told.goes(_SEARCH, 1.0)
    return data.told(fewest(everything, (len(found.joints) - closed, found)).fit)


def _grain(points: ArrayLike, count: int | None, tolerance: float | None) -> float:
    """Return the length below which the data tell of their errors, not of a curve."""
    if tolerance is not None:
        return 2.0 * tolerance_value(tolerance)
    return float(np.ptp(point_array(points), axis=0).max()) / (8.0 * integer(count, "count", 2))
