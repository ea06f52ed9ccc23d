"""What the stability laboratory computes: an experiment, no part of the document."""

from __future__ import annotations

import enum

import msgspec

LEAST_DIGITS, MOST_DIGITS = 2, 16
MOST_DECIMALS = 6
USUAL_SHIFT = 100.0


class Calculation(enum.StrEnum):
    """A way to compute the curve, in the order in which the window lists them."""

    MONOMIAL = "monomial"
    NEWTON = "newton"
    LAGRANGE = "lagrange"
    BARYCENTRIC = "barycentric"
    BASIS = "basis"


class Rounding(enum.StrEnum):
    """What is rounded, in the order in which the window lists it."""

    EVERY_STEP = "every_step"
    COEFFICIENTS = "coefficients"
    DATA = "data"


ROUNDING_NAMES = {
    Rounding.EVERY_STEP: "every step",
    Rounding.COEFFICIENTS: "the coefficients",
    Rounding.DATA: "the data",
}

METHOD_NAMES = {
    Calculation.MONOMIAL: "Monomials",
    Calculation.NEWTON: "Newton",
    Calculation.LAGRANGE: "Lagrange",
    Calculation.BARYCENTRIC: "Barycentric",
    Calculation.BASIS: "Hermite basis",
}


class LaboratorySettings(msgspec.Struct, frozen=True):
    """The experiment.

    Attributes
    ----------
    on
        Whether anything is computed at all.
    rounding
        What is rounded: every single operation, or once only the coefficients or the data, all else exact.
    digits
        How many significant decimal digits are kept.
    methods
        What is compared.
    decimals
        Digits behind the decimal point that the data are rounded to first; None leaves them as they are.
    shift
        What is added to every t before the computation.
    """

    on: bool = False
    rounding: Rounding = Rounding.EVERY_STEP
    digits: int = 4
    methods: frozenset[Calculation] = frozenset(
        {Calculation.MONOMIAL, Calculation.LAGRANGE, Calculation.BASIS}
    )
    decimals: int | None = None
    shift: float = 0.0
