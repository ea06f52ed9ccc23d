"""The stability laboratory: the curve computed with few decimal digits by several methods, and their errors.

The truth is the curve itself, through data that are not rounded, over the shifted t. It is computed in
fractions, at many t only for pieces of few points; else in double precision, which is as good as 16 digits.
`trial_words` are the findings in a sentence or two. `cost_of` compares the cost of solving a system for
coefficients with that of the basis form, which needs none: operations are counted exactly, times are
measured on this machine.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise
from math import log10
from typing import TypeVar

import numpy as np

from curvecore import (
    CurveError,
    available_methods,
    digits_lost,
    evaluate_rounded,
    exact_decimals,
    exact_values,
    monomial_condition,
    operation_counts,
    round_data,
    rounded_decimals,
)
from curvecore.arrays import FloatArray

from ...document.words import short
from ...tasks.progress import Report, silent
from ..curve.core_curve import in_words
from ..curve.curve_view import CurveView, ParametricCurve
from ..geometry import all_along
from .settings import Calculation, LaboratorySettings, RoundedPart

SAMPLES = 240
"""Approximate number of parameters t on the whole curve."""

MOST_POINTS = 60
"""Points up to which all methods are computed."""

MOST_AT_ALL = 200
"""Points above which nothing is computed: a window should not compute for a minute."""

_MOST_EXACT = 16
"""Points of one polynomial up to which its truth is computed in fractions, with some n**4 operations."""

_MORE_OF_TRUTH = 2
"""Digits of the truth that are displayed beyond those of the computation."""

_CHUNK = 48
"""Parameters between two checks that the result is still wanted; above `MOST_POINTS` points the work that is
done once for all parameters is too much to be done for each chunk."""

_MOST_CONDITION = 128
_FARTHEST = 1e12

_Result = TypeVar("_Result")


@dataclass(frozen=True, eq=False)
class Outcome:
    """The result of one method.

    Attributes
    ----------
    pieces
        The computed curve as polylines (k, 2); it is broken where the method gives no number.
    errors
        The distance to the truth for each t of the `Trial`, (m,); infinite where there is no number.
    lost
        The number of wrong digits at the worst t, from 0 to `digits`.
    worst
        The largest error, and its t (not shifted).
    """

    calculation: Calculation
    pieces: tuple[FloatArray, ...]
    errors: FloatArray
    lost: float
    worst: tuple[float, float]


@dataclass(frozen=True, eq=False)
class Trial:
    """The findings of the laboratory about one curve.

    Attributes
    ----------
    view, settings
        The curve and the experiment.
    t
        The parameters of the comparison, not shifted, (m,).
    outcomes
        One for each method.
    condition
        The 2-norm condition number of the system for the monomials' coefficients; None if not computed, and
        where that system is solved exactly.
    note
        A sentence on the methods that are left out; empty if none is.
    """

    view: CurveView
    settings: LaboratorySettings
    t: FloatArray
    outcomes: tuple[Outcome, ...]
    condition: float | None
    note: str = ""

    def outcome(self, calculation: Calculation) -> Outcome | None:
        """Return the outcome of a method, None if it was not tried."""
        return next((tried for tried in self.outcomes if tried.calculation is calculation), None)


@dataclass(frozen=True)
class Digits:
    """The digits that the methods compute at one t.

    Attributes
    ----------
    t
        The parameter, not shifted.
    truth
        x and y with two digits more, all of them correct, as text.
    rows
        For each method x and y as decimal numbers, as text.
    """

    t: float
    truth: tuple[str, str]
    rows: tuple[tuple[Calculation, tuple[str, str]], ...]


def calculations(view: CurveView) -> tuple[Calculation, ...]:
    """Return the methods for a curve: none unless it consists of polynomials through its data."""
    family, curve = view.source.family, view.curve
    is_hermite = family.derivatives and (curve is None or curve.degree == 2 * family.derivatives + 1)
    if not (is_hermite or family.curve_class.is_one_polynomial):
        return ()
    return tuple(Calculation(method.value) for method in available_methods(view.source.family.derivatives))


def try_methods(view: CurveView, settings: LaboratorySettings, report: Report = silent) -> Trial | str:
    """Return a curve computed by the selected methods, or a sentence why that is impossible."""
    if not view.is_current:
        return view.problem
    if not calculations(view):
        return (
            f"The laboratory computes polynomials through the points; {view.source.family.a_curve} is "
            "made of other functions."
        )
    count = len(view.parameters)
    if count > MOST_AT_ALL:
        return f"The laboratory computes curves of up to {MOST_AT_ALL} points; this one has {count}."
    try:
        return _trial(view, settings, report)
    except CurveError as problem:
        return _refusal(settings, problem)


def _trial(view: CurveView, settings: LaboratorySettings, report: Report) -> Trial:
    count = len(view.parameters)
    methods, note = _affordable(view, settings)
    per_segment = max(3, SAMPLES // (count - 1))
    experiments = [
        (_Experiment(piece, settings), all_along(piece.parameters, per_segment)) for piece in view.pieces
    ]
    t = np.concatenate([where for _, where in experiments])
    truth = np.vstack([experiment.truth(where) for experiment, where in experiments])
    outcomes, computed = list[Outcome](), list[FloatArray]()
    for calculation in methods:
        # From rounded data, with exact arithmetic, all methods give the same.
        if settings.rounding is not RoundedPart.DATA or not outcomes:
            computed = [trial.values(where, calculation, report) for trial, where in experiments]
        outcomes.append(_outcome(calculation, computed, truth, t, settings.digits))
    solves = settings.rounding is RoundedPart.EVERY_STEP and count <= _MOST_CONDITION
    condition = max(experiment.condition() for experiment, _ in experiments) if solves else None
    return Trial(view, settings, t, tuple(outcomes), condition, note)


def digits_at(view: CurveView, settings: LaboratorySettings, t: float) -> Digits | None:
    """Return the digits at one t, None where nothing can be computed."""
    if not (view.is_current and calculations(view)) or len(view.parameters) > MOST_POINTS:
        return None
    start, end = view.parameters[[0, -1]].tolist()
    t = min(max(t, start), end)
    piece = next(piece for piece in view.pieces if t <= piece.parameters[-1])
    try:
        experiment = _Experiment(piece, settings)
        rows = tuple(
            (calculation, experiment.digits(t, calculation))
            for calculation in calculations(view)
            if calculation in settings.methods
        )
    except CurveError:
        return None
    return Digits(t, experiment.true_digits(t), rows)


class _Experiment:
    """One piece of the curve with the data for the computation."""

    def __init__(self, piece: ParametricCurve, settings: LaboratorySettings) -> None:
        self._piece, self._settings = piece, settings
        self._shifted = piece.parameters + settings.shift
        self._jets, self._parameters = piece.jets, self._shifted
        if settings.decimals is not None:
            self._jets = round_data(self._jets, settings.decimals)
            self._parameters = round_data(self._parameters, settings.decimals)
        # Raise where the data give no curve.
        self._shifted_curve = piece.with_data(piece.jets, self._shifted)
        self._given_curve = piece.with_data(self._jets, self._parameters)

    def truth(self, t: FloatArray) -> FloatArray:
        """Return the points of the curve itself, (m, 2)."""
        at = t + self._settings.shift
        points, *derivatives = self._piece.jets.swapaxes(0, 1)
        if not derivatives and len(points) > _MOST_EXACT:
            return self._shifted_curve.evaluate(at)
        return exact_values(points, self._shifted, at, *derivatives)

    def true_digits(self, t: float) -> tuple[str, str]:
        """Return x and y of the curve itself at one t, with all digits correct."""
        points, *derivatives = self._piece.jets.swapaxes(0, 1)
        at, count = t + self._settings.shift, self._settings.digits + _MORE_OF_TRUTH
        x, y = exact_decimals(points, self._shifted, at, count, *derivatives)
        return f"{x:.{count}g}", f"{y:.{count}g}"

    def values(self, t: FloatArray, calculation: Calculation, report: Report) -> FloatArray:
        """Return the points that a method computes, (m, 2)."""
        at, result = t + self._settings.shift, np.full((len(t), 2), np.nan)
        chunk = _CHUNK if len(self._parameters) <= MOST_POINTS else len(t)
        for start in range(0, len(t), chunk):
            report(start / len(t), "Computing")
            part = slice(start, start + chunk)
            result[part] = self._rounded(evaluate_rounded, at[part], calculation)
        return result

    def digits(self, t: float, calculation: Calculation) -> tuple[str, str]:
        """Return the digits of x and y at one t."""
        ((x, y),) = self._rounded(rounded_decimals, t + self._settings.shift, calculation)
        if self._settings.rounding is RoundedPart.EVERY_STEP:
            return str(x), str(y)
        # As many as of the truth: an exact result has no last digit.
        count = self._settings.digits + _MORE_OF_TRUTH
        return f"{x:.{count}g}", f"{y:.{count}g}"

    def _rounded(
        self, compute: Callable[..., _Result], at: FloatArray | float, calculation: Calculation
    ) -> _Result:
        points, *derivatives = self._jets.swapaxes(0, 1)
        how = (calculation, self._settings.digits, *derivatives)
        return compute(points, self._parameters, at, *how, rounding=self._settings.rounding)

    def condition(self) -> float:
        """Return the condition number of the system for the coefficients in powers of t."""
        return monomial_condition(self._given_curve)


def _affordable(view: CurveView, settings: LaboratorySettings) -> tuple[list[Calculation], str]:
    """Return the selected methods that are not too slow, and a sentence about those left out."""
    selected = [method for method in calculations(view) if method in settings.methods]
    if len(view.parameters) <= MOST_POINTS or settings.rounding is RoundedPart.DATA:
        return selected, ""
    notes = []
    if Calculation.LAGRANGE in selected:
        selected.remove(Calculation.LAGRANGE)
        notes.append(
            f"Above {MOST_POINTS} points Lagrange is left out: its products take n² operations for every t. "
            "The barycentric form is the same polynomial."
        )
    if settings.rounding is RoundedPart.COEFFICIENTS and view.source.family.derivatives == 0:
        selected = [method for method in selected if method is not Calculation.MONOMIAL]
        notes.append(
            f"Above {MOST_POINTS} points the coefficients of the monomials are not computed exactly."
        )
    return selected, " ".join(notes)


def _refusal(settings: LaboratorySettings, problem: CurveError) -> str:
    if settings.rounding is RoundedPart.COEFFICIENTS:
        return f"The coefficients cannot be computed exactly: {problem}."
    if settings.rounding is RoundedPart.DATA:
        return f"Rounded to {settings.digits} digits, neighbouring t are the same number. Keep more."
    if settings.decimals is not None:
        return f"Rounded to {settings.decimals} decimals, neighbouring t are the same number. Keep more."
    return f"The shift is too large: neighbouring t become the same number ({in_words(str(problem))})."


def _outcome(
    calculation: Calculation, computed: list[FloatArray], truth: FloatArray, t: FloatArray, digits: int
) -> Outcome:
    values = np.vstack(computed)
    with np.errstate(over="ignore"):
        away = values - truth
        errors = np.nan_to_num(np.hypot(away[:, 0], away[:, 1]), nan=np.inf)
    lost = float(digits_lost(values, truth, digits).max())
    worst = int(np.argmax(errors))
    pieces = tuple(run for points in computed for run in _finite_runs(points))
    return Outcome(calculation, pieces, errors, lost, (float(errors[worst]), float(t[worst])))


def _finite_runs(points: FloatArray) -> list[FloatArray]:
    """Return the stretches of a polyline that are numbers, none of them too far away to be drawn."""
    good = np.asarray(np.isfinite(points).all(axis=1))
    ends = np.flatnonzero(np.diff(good)) + 1
    bounds = [0, *ends.tolist(), len(points)]
    runs = [points[start:end] for start, end in pairwise(bounds) if good[start] and end - start > 1]
    return [np.clip(run, -_FARTHEST, _FARTHEST) for run in runs]


# Findings in words

_HOPELESS = 0.7
"""Correct digits below which a result counts as lost."""

_NEARLY_ALL = 0.5
"""Digits between a loss and the worst case up to which the difference needs no explanation."""


def trial_words(trial: Trial) -> str:
    """Return the findings in a sentence or two, with the lost digits beside those that may be lost."""
    if not trial.outcomes:
        return "Select a method to compute the curve."
    monomial = trial.outcome(Calculation.MONOMIAL)
    match trial.settings.rounding:
        case RoundedPart.DATA:
            return (
                "Only the data are rounded: every method gives the same curve. An error of the points grows "
                "by a factor of Λ at most; an error of tᵢ moves the curve by Lᵢ(t) c′(tᵢ) times as much."
            )
        case RoundedPart.COEFFICIENTS if monomial is not None:
            return (
                f"Only the coefficients are rounded, to {trial.settings.digits} digits. An error in the "
                "coefficient of tᵏ moves the curve by tᵏ times as much, so that the error grows with |t|."
            )
        case RoundedPart.EVERY_STEP if monomial is not None and trial.condition is not None:
            return _on_solving(trial, monomial, trial.condition)
    best = min(trial.outcomes, key=lambda outcome: outcome.lost)
    return f"{best.calculation.label} loses {best.lost:.1f} of {trial.settings.digits} digits."


def growth_words(trial: Trial) -> str:
    """Return a remark on the Λ of the table where it is not that of the status line; else nothing."""
    is_of_data = trial.settings.rounding is RoundedPart.DATA
    has_growth = any(is_of_data or tried.calculation is not Calculation.MONOMIAL for tried in trial.outcomes)
    if not (trial.view.source.family.derivatives and has_growth):
        return ""
    return (
        "This Λ applies to the data, with fixed estimates; the status line shows Λ of the points, including "
        "the estimates."
    )


def _on_solving(trial: Trial, monomial: Outcome, condition: float) -> str:
    """Return the meaning of the condition number, and why less was lost where that is so."""
    digits, may_go = trial.settings.digits, log10(max(condition, 1.0))
    most = f"all {digits} digits" if may_go >= digits else f"{may_go:.1f} of {digits} digits"
    bound = f"κ = {short(condition)} bounds the effect of rounding on the coefficients of the monomials"
    if monomial.lost > digits - _HOPELESS:
        return f"{digits} digits are not enough for the monomials. {bound}: {most} may be lost."
    if monomial.lost > min(may_go, digits) - _NEARLY_ALL:
        return f"{bound}: {most} may be lost."
    return (
        f"{bound}: at worst {most} are lost. The curve lost {monomial.lost:.1f}: these points and roundings "
        "are not the worst case, and elimination finds coefficients that nearly fit the points even where "
        "they are wrong."
    )


# The cost of solving a system

_MOST_COUNTED = 1000
"""The largest number of points in the chart."""

_ROUNDS = 15
_ROUND_SECONDS = 0.002
"""Seconds of a round, which repeats its work so that the clock is finer than the work."""

_MOST_SECONDS = 0.3
"""Seconds after which no further rounds are measured."""


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
        Operations for the small systems of a Hermite curve; None for other curves.
    other
        The words for a curve of the family, where it is made of other functions.
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
    """Return the counted and measured cost for a curve; None without one."""
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
        operation_counts(method, len(t)).per_point
        for method in (Calculation.MONOMIAL, Calculation.LAGRANGE, Calculation.BARYCENTRIC)
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
    """Return the counts for numbers of points from 2 to `_MOST_COUNTED`."""
    n = np.unique(np.geomspace(2, _MOST_COUNTED, 40).round().astype(int))
    counts = np.array([_counts(int(count)) for count in n], dtype=np.float64)
    return CostChart(n.astype(np.float64), counts[:, 0], counts[:, 1])


def _counts(count: int) -> tuple[int, int]:
    solving = operation_counts(Calculation.MONOMIAL, count)
    return solving.total(1), operation_counts(Calculation.LAGRANGE, count).total(1)


def _solve(t: FloatArray, points: FloatArray, at: float) -> FloatArray:
    """Return the curve at one t, by the coefficients of a solved system."""
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
    """Return the median time of some work, in seconds."""
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
