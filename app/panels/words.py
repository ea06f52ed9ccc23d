"""The names of the rules, as the panels write them."""

from __future__ import annotations

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
