"""The cost of solving a system for coefficients, against the basis form that needs none.

Operations are counted exactly; times are measured on this machine.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from curvecore import operation_counts
from curvecore.arrays import FloatArray

from ...tasks.progress import Report, silent
from ..curve.curve_view import CurveView
from .laboratory import calculations
from .laboratory_settings import Calculation

MOST_POINTS = 1000
"""The chart ends here."""

_ROUNDS = 15
_ROUND_SECONDS = 0.002
"""Every round repeats its work for about so long, for the clock to be finer than the work."""

_MOST_SECONDS = 0.3
"""After so long what has been measured must do."""


@dataclass(frozen=True, eq=False)
class SolvingCost:
    """Solving against the basis form, for one polynomial through the points of a curve.

    Attributes
    ----------
    count
        Points n.
    solving, basis
        Operations to the first point of the curve.
    further
        Operations for every further point: from the coefficients, by the basis form, and by its barycentric
        variant.
    seconds
        Measured medians to the first point.
    doubled
        The factors by which `solving` and `basis` grow with twice as many points.
    piecewise
        Operations that a Hermite curve's own small systems take; None for other curves.
    other
        One of the family’s curves in words, where these are made of other functions.
    """

    count: int
    solving: int
    basis: int
    further: tuple[int, int, int]
    seconds: tuple[float, float]
    doubled: tuple[float, float]
    piecewise: int | None
    other: str = ""

    @property
    def ratio(self) -> float:
        """The operations of solving over those of the basis form."""
        return self.solving / self.basis


@dataclass(frozen=True, eq=False)
class CostChart:
    """Operations to the first point over the number of points: n, solving, basis form, (k,) each."""

    n: FloatArray
    solving: FloatArray
    basis: FloatArray


def cost_of(view: CurveView, report: Report = silent) -> SolvingCost | None:
    """Count and measure for a curve; None without one."""
    if not view.is_current:
        return None
    t = view.parameters
    points, middle = view.at_knots, 0.5 * (t[0] + t[1])
    solving, basis = _counts(len(t))
    seconds = (
        _median(lambda: _solve(t, points, middle), report),
        _median(lambda: _sum_basis(t, points, middle), report),
    )
    family, piecewise, other = view.source.family, None, ""
    if not calculations(view):
        other = family.a_curve
    elif family.derivatives:
        piecewise = operation_counts(Calculation.MONOMIAL, len(t), derivatives=family.derivatives).setup
    solved, form, barycentric = (
        operation_counts(each, len(t)).per_point
        for each in (Calculation.MONOMIAL, Calculation.LAGRANGE, Calculation.BARYCENTRIC)
    )
    twice = _counts(2 * len(t))
    return SolvingCost(
        count=len(t),
        solving=solving,
        basis=basis,
        further=(solved, form, barycentric),
        seconds=seconds,
        doubled=(twice[0] / solving, twice[1] / basis),
        piecewise=piecewise,
        other=other,
    )


def cost_chart() -> CostChart:
    """Return the counts for numbers of points from 2 to `MOST_POINTS`."""
    n = np.unique(np.geomspace(2, MOST_POINTS, 40).round().astype(int))
    counts = np.array([_counts(int(each)) for each in n], dtype=np.float64)
    return CostChart(n.astype(np.float64), counts[:, 0], counts[:, 1])


def _counts(count: int) -> tuple[int, int]:
    solving = operation_counts(Calculation.MONOMIAL, count)
    return solving.total(1), operation_counts(Calculation.LAGRANGE, count).total(1)


def _solve(t: FloatArray, points: FloatArray, at: float) -> FloatArray:
    """Solve for the coefficients and evaluate once."""
    with np.errstate(all="ignore"):
        try:
            coefficients = np.asarray(np.linalg.solve(np.vander(t, increasing=True), points))
        except np.linalg.LinAlgError:
            # A pivot vanished, after all the work but the last of it.
            coefficients = points
        return np.asarray(np.vander([at], len(t), increasing=True) @ coefficients)


def _sum_basis(t: FloatArray, points: FloatArray, at: float) -> FloatArray:
    """Compute all L_i as products and add up."""
    with np.errstate(all="ignore"):
        below = t[:, None] - t
        np.fill_diagonal(below, 1.0)
        above = np.broadcast_to(at - t, below.shape).copy()
        np.fill_diagonal(above, 1.0)
        return np.asarray((np.prod(above, axis=1) / np.prod(below, axis=1)) @ points)


def _median(work: Callable[[], object], report: Report) -> float:
    """Return how long some work takes, in seconds."""
    start = time.perf_counter()
    work()
    once = max(time.perf_counter() - start, 1e-7)
    repeats = max(1, min(200, int(_ROUND_SECONDS / once)))
    times: list[float] = []
    while len(times) < _ROUNDS and not (times and time.perf_counter() - start > _MOST_SECONDS):
        report(0.0, "Measuring")
        begin = time.perf_counter()
        for _ in range(repeats):
            work()
        times.append((time.perf_counter() - begin) / repeats)
    return float(np.median(times))
