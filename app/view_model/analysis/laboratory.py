"""The curve computed with few decimal digits by several methods, and how wrong each comes out.

The truth is the curve itself, through data that are not rounded, over the shifted t. It is computed in
fractions, at many t only for pieces of few points; else in double precision, which is as good as 16 digits.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise
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
    round_data,
    rounded_decimals,
)
from curvecore.arrays import FloatArray

from ...tasks.progress import Report, silent
from ..curve.core_curve import in_words
from ..curve.curve_view import CurveView, ParametricCurve
from ..geometry import all_along
from .laboratory_settings import Calculation, LaboratorySettings, RoundedPart

SAMPLES = 240
"""About so many parameters t on the whole curve."""

MOST_POINTS = 60
"""Up to so many points everything is computed."""

MOST_AT_ALL = 200
"""Above so many points nothing is: a window should not compute for a minute."""

_MOST_EXACT = 16
"""Points of one polynomial up to which its truth is computed in fractions, with some n**4 operations."""

_MORE_OF_TRUTH = 2
"""Digits that are shown of the truth beyond those that are computed with."""

_CHUNK = 48
"""Parameters between two looks at whether the result is still wanted; above `MOST_POINTS` points what is
done once for all parameters costs too much to be done for each chunk."""

_MOST_CONDITION = 128
_FARTHEST = 1e12

_Result = TypeVar("_Result")


@dataclass(frozen=True, eq=False)
class Outcome:
    """The result of one method.

    Attributes
    ----------
    pieces
        The computed curve as polylines (k, 2); it is broken where the method came to no number.
    errors
        The distance to the truth for each t of the `Trial`, (m,); infinite where there is no number.
    lost
        The number of wrong digits at the worst t; 0 as good as can be, `digits` nothing is right.
    worst
        The largest of the errors, and the t (not shifted) where it is.
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
        """Return what this method made, None if it was not tried."""
        return next((each for each in self.outcomes if each.calculation is calculation), None)


@dataclass(frozen=True)
class Digits:
    """The very digits that the methods get at one t.

    Attributes
    ----------
    t
        Where, not shifted.
    truth
        x and y with two digits more, all of them correct, as text.
    rows
        For each method x and y as decimal numbers of so many digits, as text.
    """

    t: float
    truth: tuple[str, str]
    rows: tuple[tuple[Calculation, tuple[str, str]], ...]


def calculations(view: CurveView) -> tuple[Calculation, ...]:
    """Return the methods that there are for a curve: none unless polynomials through its data make it."""
    family, curve = view.source.family, view.curve
    is_hermite = family.derivatives and (curve is None or curve.degree == 2 * family.derivatives + 1)
    if not (is_hermite or family.curve_class.is_one_polynomial):
        return ()
    return tuple(Calculation(method.value) for method in available_methods(view.source.family.derivatives))


def try_methods(view: CurveView, settings: LaboratorySettings, report: Report = silent) -> Trial | str:
    """Compute a curve by the chosen methods; where that cannot be, return why, as a sentence."""
    if not view.is_current:
        return view.problem
    if not calculations(view):
        return (
            f"The laboratory computes polynomials through the points; {view.source.family.a_curve} is "
            "made of other functions."
        )
    count = len(view.parameters)
    if count > MOST_AT_ALL:
        return f"{count} points are too many for arithmetic done digit by digit; it goes up to {MOST_AT_ALL}."
    try:
        return _trial(view, settings, report)
    except CurveError as problem:
        return _refusal(settings, problem)


def _trial(view: CurveView, settings: LaboratorySettings, report: Report) -> Trial:
    count = len(view.parameters)
    chosen, note = _affordable(view, settings)
    per_segment = max(3, SAMPLES // (count - 1))
    experiments = [
        (_Experiment(piece, settings), all_along(piece.parameters, per_segment)) for piece in view.pieces
    ]
    t = np.concatenate([where for _, where in experiments])
    truth = np.vstack([experiment.truth(where) for experiment, where in experiments])
    outcomes, computed = list[Outcome](), list[FloatArray]()
    for calculation in chosen:
        # From rounded data, with exact arithmetic, all methods come to the same.
        if settings.rounding is not RoundedPart.DATA or not outcomes:
            computed = [each.values(where, calculation, report) for each, where in experiments]
        outcomes.append(_outcome(calculation, computed, truth, t, settings.digits))
    solves = settings.rounding is RoundedPart.EVERY_STEP and count <= _MOST_CONDITION
    condition = max(experiment.condition() for experiment, _ in experiments) if solves else None
    return Trial(view, settings, t, tuple(outcomes), condition, note)


def digits_at(view: CurveView, settings: LaboratorySettings, t: float) -> Digits | None:
    """Return the very digits at one t, None where nothing can be computed."""
    if not (view.is_current and calculations(view)) or len(view.parameters) > MOST_POINTS:
        return None
    start, end = view.parameters[[0, -1]].tolist()
    t = min(max(t, start), end)
    piece = next(each for each in view.pieces if t <= each.parameters[-1])
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
    """One piece of the curve with the data that the computation is given."""

    def __init__(self, piece: ParametricCurve, settings: LaboratorySettings) -> None:
        self._piece, self._settings = piece, settings
        self._shifted = piece.parameters + settings.shift
        self._jets, self._parameters = piece.jets, self._shifted
        if settings.decimals is not None:
            self._jets = round_data(self._jets, settings.decimals)
            self._parameters = round_data(self._parameters, settings.decimals)
        # Refused where they make no curve.
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
        """Return x and y of the curve itself at one t, every digit of it."""
        points, *derivatives = self._piece.jets.swapaxes(0, 1)
        at, shown = t + self._settings.shift, self._settings.digits + _MORE_OF_TRUTH
        x, y = exact_decimals(points, self._shifted, at, shown, *derivatives)
        return f"{x:.{shown}g}", f"{y:.{shown}g}"

    def values(self, t: FloatArray, calculation: Calculation, report: Report) -> FloatArray:
        """Return what a method computes, (m, 2)."""
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
        # As many as are shown of the truth: what is computed exactly has no last digit of its own.
        shown = self._settings.digits + _MORE_OF_TRUTH
        return f"{x:.{shown}g}", f"{y:.{shown}g}"

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
    """Return the chosen methods that are not too slow, and a sentence on what is left out."""
    chosen = [each for each in calculations(view) if each in settings.methods]
    if len(view.parameters) <= MOST_POINTS or settings.rounding is RoundedPart.DATA:
        return chosen, ""
    notes = []
    if Calculation.LAGRANGE in chosen:
        chosen.remove(Calculation.LAGRANGE)
        notes.append(
            f"Above {MOST_POINTS} points Lagrange is left out: its products take n² operations for every t. "
            "The barycentric form is the same polynomial."
        )
    if settings.rounding is RoundedPart.COEFFICIENTS and view.source.family.derivatives == 0:
        chosen = [each for each in chosen if each is not Calculation.MONOMIAL]
        notes.append(f"Above {MOST_POINTS} points the monomials' coefficients are not found exactly.")
    return chosen, " ".join(notes)


def _refusal(settings: LaboratorySettings, problem: CurveError) -> str:
    if settings.rounding is RoundedPart.COEFFICIENTS:
        return f"The coefficients are not found exactly: {problem}."
    if settings.rounding is RoundedPart.DATA:
        return f"To {settings.digits} digits, neighbouring t are the same number; keep more of them."
    if settings.decimals is not None:
        return f"To {settings.decimals} decimals, neighbouring t are the same number; keep more of them."
    return f"The shift is too large: neighbouring t become the same number ({in_words(str(problem))})."


def _outcome(
    calculation: Calculation, computed: list[FloatArray], truth: FloatArray, t: FloatArray, digits: int
) -> Outcome:
    found = np.vstack(computed)
    with np.errstate(over="ignore"):
        away = found - truth
        errors = np.nan_to_num(np.hypot(away[:, 0], away[:, 1]), nan=np.inf)
    lost = float(digits_lost(found, truth, digits).max())
    worst = int(np.argmax(errors))
    pieces = tuple(part for each in computed for part in _finite_runs(each))
    return Outcome(calculation, pieces, errors, lost, (float(errors[worst]), float(t[worst])))


def _finite_runs(points: FloatArray) -> list[FloatArray]:
    """Return the stretches of a polyline that are numbers, none of them too far away to be drawn."""
    good = np.asarray(np.isfinite(points).all(axis=1))
    ends = np.flatnonzero(np.diff(good)) + 1
    bounds = [0, *ends.tolist(), len(points)]
    runs = [points[start:end] for start, end in pairwise(bounds) if good[start] and end - start > 1]
    return [np.clip(run, -_FARTHEST, _FARTHEST) for run in runs]
