"""The settings of all that is displayed over the curve: neither saved with the document nor undone."""

from __future__ import annotations

from typing import TYPE_CHECKING

import msgspec

from ...document.words import NamedEnum
from ..line_styles import (
    BLUE,
    GREEN,
    PURPLE,
    USUAL_STYLE,
    VERMILLION,
    LineStyle,
)
from ..settings import SettingValues

if TYPE_CHECKING:
    from .ghost import Ghost
    from .overlay import Overlay
    from .plot import Plot

LEAST_DIGITS, MOST_DIGITS = 2, 16
MOST_DECIMALS = 6
USUAL_SHIFT = 100.0


def _dashed(colour: str, *dashes: float) -> LineStyle:
    return LineStyle(colour, width=2.0, dashes=dashes)


_BASIS_FORM = _dashed(BLUE, 2, 2)
"""The line of a basis form; no curve has two of them."""


class Calculation(NamedEnum):
    """A method to compute the curve, in the order of the window.

    Attributes
    ----------
    tip
        The computation, in words.
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
        _dashed(VERMILLION, 5, 2),
    )
    NEWTON = (
        "newton",
        "Newton",
        "Divided differences, then Newton's form",
        _dashed(PURPLE, 6, 2, 1, 2),
    )
    LAGRANGE = "lagrange", "Lagrange", "The basis functions Lᵢ as products, times the points", _BASIS_FORM
    BARYCENTRIC = "barycentric", "Barycentric", "The second barycentric formula", _dashed(GREEN, 1, 1.5)
    BASIS = "basis", "Hermite basis", "The Hermite basis functions of the local parameter", _BASIS_FORM


class RoundedPart(NamedEnum):
    """The numbers that are rounded, in the order of the window."""

    EVERY_STEP = "every_step", "every step"
    COEFFICIENTS = "coefficients", "the coefficients"
    DATA = "data", "the data"


class LaboratorySettings(msgspec.Struct, frozen=True):
    """The experiment.

    Attributes
    ----------
    on
        Whether the experiment is computed.
    rounding
        The numbers that are rounded: those of every single operation, or once only the coefficients or the
        data, all else exact.
    digits
        The number of significant decimal digits.
    methods
        The methods that are compared.
    decimals
        Digits behind the decimal point that the data are rounded to first; None leaves them as they are.
    shift
        The number that is added to every t before the computation.
    """

    on: bool = False
    rounding: RoundedPart = RoundedPart.EVERY_STEP
    digits: int = 4
    methods: frozenset[Calculation] = frozenset(
        {Calculation.MONOMIAL, Calculation.LAGRANGE, Calculation.BASIS}
    )
    decimals: int | None = None
    shift: float = 0.0


class AnalysisSettings(SettingValues, frozen=True):
    """All settings of overlays, plots, ghosts and the laboratory.

    Attributes
    ----------
    overlays
        The overlays that are switched on.
    plots
        The plots over t.
    ghosts
        The variants that are drawn.
    laboratory
        The experiment with rounded arithmetic.
    """

    overlays: frozenset[Overlay] = frozenset()
    plots: frozenset[Plot] = frozenset()
    ghosts: frozenset[Ghost] = frozenset()
    laboratory: LaboratorySettings = LaboratorySettings()

    @property
    def is_empty(self) -> bool:
        """Whether nothing is switched on."""
        return not self.overlays and not self.ghosts
