"""The experiment of the stability laboratory: no part of the document."""

from __future__ import annotations

import msgspec

from app.document.words import NamedEnum
from app.view_model.line_styles import BLUE, GREEN, PURPLE, USUAL_STYLE, VERMILLION, LineStyle

LEAST_DIGITS, MOST_DIGITS = 2, 16
MOST_DECIMALS = 6
USUAL_SHIFT = 100.0


class Calculation(NamedEnum):
    """A way to compute the curve, in the order in which the window lists them.

    Attributes
    ----------
    tip
        How it computes.
    style
        Its lines.
    """

    def __init__(self, value: str, label: str = "", tip: str = "", style: LineStyle = USUAL_STYLE) -> None:
        super().__init__(value, label)
        self.tip, self.style = tip, style

    MONOMIAL = (
        "monomial",
        "Monomials",
        "Solve the system for the coefficients of 1, t, t², …, then Horner's scheme",
        LineStyle(VERMILLION, width=2.0, dashes=(5.0, 2.0)),
    )
    NEWTON = (
        "newton",
        "Newton",
        "Divided differences, then Newton's form",
        LineStyle(PURPLE, width=2.0, dashes=(6.0, 2.0, 1.0, 2.0)),
    )
    LAGRANGE = (
        "lagrange",
        "Lagrange",
        "The basis functions Lᵢ as products, times the points",
        LineStyle(BLUE, width=2.0, dashes=(2.0, 2.0)),
    )
    BARYCENTRIC = (
        "barycentric",
        "Barycentric",
        "The second barycentric formula",
        LineStyle(GREEN, width=2.0, dashes=(1.0, 1.5)),
    )
    BASIS = (
        "basis",
        "Hermite basis",
        "The Hermite basis functions of the local parameter",
        LineStyle(BLUE, width=2.0, dashes=(2.0, 2.0)),
    )


class RoundedPart(NamedEnum):
    """The numbers that are rounded, in the order in which the window lists them."""

    EVERY_STEP = "every_step", "every step"
    COEFFICIENTS = "coefficients", "the coefficients"
    DATA = "data", "the data"


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
    rounding: RoundedPart = RoundedPart.EVERY_STEP
    digits: int = 4
    methods: frozenset[Calculation] = frozenset(
        {Calculation.MONOMIAL, Calculation.LAGRANGE, Calculation.BASIS}
    )
    decimals: int | None = None
    shift: float = 0.0
