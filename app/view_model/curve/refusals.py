"""Refusals of the core in the program's words: the one place that puts them on the screen.

The core counts arguments and indices, as its callers do. A person sees points, their t and the numbers typed.
"""

from __future__ import annotations

import re

from curvecore import CurveError

from ...document.derivatives import DERIVATIVES
from ...document.model import Curve
from ...document.words import with_minus

_SUBSCRIPTS = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")
_NAMES = {"points": "", **{each.plural: each.letter for each in DERIVATIVES}}
_ENTRY = re.compile(rf"\b({'|'.join(_NAMES)}|parameters)\[(\d+)(?:, (\d+))?\]")
_NUMBER = re.compile(r"(?<![\w.])(-?\d+(?:\.\d+)?(?:e[+-]?\d+)?)(?![\w.]|\))")


def refusal_of(problem: CurveError, curve: Curve) -> str:
    """Return why the core refused a curve of the document, as a sentence."""
    text = str(problem)
    if text.startswith("parameters must be strictly increasing") and len(problem.indices) == 2:
        return _not_increasing(text, problem.indices, curve)
    if curve.is_closed and len(curve.points) in problem.indices:
        # Where the curve returns to its first point.
        text = re.sub(rf"\b{len(curve.points)}\b", "0", text)
    return sentence(in_words(text))


def in_words(text: str) -> str:
    """Return a refusal of the core with t₁ for parameters[1], x of point 2 for points[2, 0], and so on."""
    return _NUMBER.sub(lambda found: _number(found[1]), _ENTRY.sub(_entry, text))


def sentence(text: str) -> str:
    """Return text with a capital at the beginning and a full stop at the end."""
    text = text[:1].upper() + text[1:]
    return text if text.endswith(".") else text + "."


def _not_increasing(text: str, indices: tuple[int, ...], curve: Curve) -> str:
    before, after = indices
    second, first = (_number(each) for each in re.findall(r"= (\S+)", text)[:2])
    if not curve.is_manual:
        return (
            f"{_t(before)} and {_t(after)} are the same number, {first}: for an interval from "
            f"{_number(repr(curve.parametrization.start))} to {_number(repr(curve.parametrization.end))} "
            f"points {before} and {after % len(curve.points)} lie too close together."
        )
    if after == len(curve.points):
        return (
            f"{_t(before)} = {first} must be less than {second}, where the curve returns to its first point."
        )
    return f"{_t(after)} = {second} must be greater than {_t(before)} = {first}."


def _t(index: int) -> str:
    return "t" + str(index).translate(_SUBSCRIPTS)


def _entry(found: re.Match[str]) -> str:
    name, row, column = found[1], int(found[2]), found[3]
    if name == "parameters":
        return _t(row)
    component = "xy"[int(column)] if column in ("0", "1") else ""
    return f"{_NAMES[name]}{component} of point {row}".strip()


def _number(text: str) -> str:
    """Return a number as it is shown and typed: every digit it has, no point without digits, a true minus."""
    value = float(text)
    shown = f"{value:.0f}" if value == round(value) and abs(value) < 1e15 else f"{value!r}"
    return with_minus(shown)
