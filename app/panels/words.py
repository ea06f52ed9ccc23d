"""The names of the rules, as the panels write them."""

from __future__ import annotations

from collections.abc import Sequence

from app.document.model import AccelerationRule, VelocityRule

VELOCITY_RULES = {
    VelocityRule.NATURAL_SPLINE: "Natural C² spline",
    VelocityRule.BESSEL: "Bessel (parabola)",
    VelocityRule.FINITE_DIFFERENCE: "Finite difference",
    VelocityRule.CATMULL_ROM: "Catmull–Rom",
}

ACCELERATION_RULES = {
    AccelerationRule.NATURAL_SPLINE: "From the C² spline",
    AccelerationRule.ZERO: "Zero",
}

# Two tables, because members of two StrEnums with the same value are equal.

VELOCITY_ESTIMATES = {
    VelocityRule.NATURAL_SPLINE: "estimated by the natural spline rule",
    VelocityRule.BESSEL: "estimated by the Bessel (parabola) rule",
    VelocityRule.FINITE_DIFFERENCE: "estimated by the finite difference rule",
    VelocityRule.CATMULL_ROM: "estimated by the Catmull–Rom rule",
}

ACCELERATION_ESTIMATES = {
    AccelerationRule.NATURAL_SPLINE: "estimated by the natural spline rule",
    AccelerationRule.ZERO: "estimated as zero",
}


def count_of(number: int, noun: str) -> str:
    """Return "1 point", "2 points"."""
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"


def names_of(names: Sequence[str]) -> str:
    """Return the first names, and how many more there are."""
    shown = list(names[:3])
    if len(names) > len(shown):
        shown.append(f"{len(names) - len(shown)} more")
    return shown[0] if len(shown) == 1 else f"{', '.join(shown[:-1])} and {shown[-1]}"


def listed(names: Sequence[str]) -> str:
    """Return "a was", "a and b were": the beginning of a sentence that says what became of them."""
    return f"{names_of(names)} {'was' if len(names) == 1 else 'were'}"
