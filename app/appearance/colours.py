"""The colours of points and curves: apart for every eye, legible on either paper."""

from __future__ import annotations

from functools import lru_cache
from typing import Final

from PySide6.QtGui import QColor

from ..document.style import NO_PAINT
from ..view_model.palette import OKABE_ITO, colour_on, point_palette
from .theme import Theme

CURVE_COLOURS: Final = {
    "Ink": "",
    "Blue": "#0072b2",
    "Vermillion": "#d55e00",
    "Bluish green": "#009e73",
    "Reddish purple": "#cc79a7",
    "Orange": "#e69f00",
    "Sky blue": "#56b4e9",
    "Yellow": "#f0e442",
}
"""The colours a curve can have, as a document writes them; the ink is that of the theme."""


def curve_colour(code: str, theme: Theme) -> QColor:
    """Return the colour of a line in this theme: as chosen, or moved until it can be seen on the paper."""
    if code in ("", NO_PAINT):
        return QColor(theme.curve)
    return QColor(colour_on(theme.paper.name(), code))


def fill_colour(code: str, theme: Theme) -> QColor:
    """Return the colour of an area in this theme: as chosen, for an area is seen by what lies around it."""
    return QColor(theme.curve) if code in ("", NO_PAINT) else QColor(code)


def line_colour(code: str, theme: Theme) -> QColor:
    """Return a colour of marks and lines that are told apart by it: Okabe–Ito, darker on light paper."""
    published = OKABE_ITO["dark"]
    return QColor(OKABE_ITO[theme.name][published.index(code)]) if code in published else QColor(code)


@lru_cache(maxsize=8)
def point_colours(n: int, theme: Theme) -> tuple[QColor, ...]:
    """
    Return one colour for each of ``n`` points, all legible on the theme's paper.

    Up to eight points have the Okabe–Ito colours, darker on light paper; the eighth is the ink.
    More points run through an even ramp of hues whose lightness alternates, so that neighbours
    can be told apart however many there are.

    Parameters
    ----------
    n : int
        How many, 0 or more.
    theme : Theme
        Where they will be drawn.

    Returns
    -------
    tuple of QColor
        The colours by point index; the same objects for the same arguments, not to be changed.
    """
    return tuple(QColor(code) for code in point_palette(n, theme.name, theme.ink.name()))
