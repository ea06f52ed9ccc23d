"""Sentences about the basis functions of a curve: measured defects, and the accuracy of derivatives."""

from __future__ import annotations

from curvecore import cardinal_defect, slope_defect, sum_defect, worst_miss

from ..document.words import number
from .curve.curve_view import CurveView

_MOST_KNOTS = 400
"""Knots up to which the functions are measured, which takes arrays of 640 numbers for each."""

_PRIMES = ("′", "″", "‴")
_SUBSCRIPTS = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")


def findings_of(view: CurveView) -> tuple[str, ...]:
    """Return sentences about defects of the functions of a curve, each with the parameter of the worst case.

    Points that the curve misses are reported only for families that interpolate. Built-in families are not
    measured.
    """
    if view.source.family.is_built_in:
        return ()
    curve, functions = view.curve, view.basis_curve
    if curve is None or functions is None or not view.is_current or len(view.parameters) > _MOST_KNOTS:
        return ()
    findings = []
    if (miss := worst_miss(curve)) and curve.interpolates:
        by = number(miss.distance, 2)
        findings.append(f"The curve misses its points: by up to {by} at point {view.owner(miss.point)}.")
    if (off := cardinal_defect(functions)) and functions.interpolates:
        value, at = _near(off.value, off.wanted), off.parameter
        findings.append(f"{_b(off.function)}({_sub('t', at)}) = {value} instead of {off.wanted}.")
    if total := sum_defect(functions):
        by, at_t = number(abs(total.total - 1.0), 2), view.t_text(total.t)
        findings.append(f"The functions do not sum to 1: off by up to {by} at t = {at_t}.")
    if slope := slope_defect(functions):
        name, at_t = _b(slope.function), view.t_text(slope.t)
        findings.append(
            f"{name}′ is not the derivative of {name}: {number(slope.said)} at t = {at_t}, "
            f"where the slope is {number(slope.found)}."
        )
    return tuple(findings)


def remark_on(view: CurveView) -> str:
    """Return a remark on derivatives that are differences, with their digits; empty for exact derivatives."""
    digits = view.pieces[0].difference_digits if view.is_current else ()
    if not digits:
        return ""
    return f"Derivatives are differences: {digits_in_words(digits)}."


def digits_in_words(digits: tuple[int, ...]) -> str:
    """Return the digits that differences keep of each derivative, in words: c′, c″ to some 9, 8 digits."""
    names = (f"c{mark}" for mark in _PRIMES[: len(digits)])
    return f"{', '.join(names)} to some {', '.join(map(str, digits))} digits"


def _near(value: float, wanted: int) -> str:
    """Return a value with enough digits to differ from the wanted one."""
    return next(
        (text for text in (number(value, digits) for digits in (3, 6, 10)) if text != str(wanted)), ""
    )


def _b(function: int) -> str:
    return _sub("B", function)


def _sub(letter: str, index: int) -> str:
    return letter + str(index).translate(_SUBSCRIPTS)
