"""The look of lines and marks: one vocabulary for figures, ghosts, methods, plots and their legends. No Qt.

A line style names its colour; the theme decides which shade that is.
"""

from __future__ import annotations

import enum

import msgspec

Dashes = tuple[float, ...]
"""Lengths of a dash, a gap, a dash and so on, in widths of the line; empty for a solid line."""

SOLID: Dashes = ()
DASHED: Dashes = (4.0, 2.0)
DOTTED: Dashes = (1.0, 2.0)

DASH_DOTTED: Dashes = (4.0, 2.0, 1.0, 2.0)

KIND_DASHES = (SOLID, DASHED, DOTTED, DASH_DOTTED)
"""Functions of the position, the velocity and the derivatives of higher orders."""


class Mark(enum.Enum):
    """The shapes of marks, which differ without colours."""

    RING = enum.auto()
    DIAMOND = enum.auto()
    SQUARE = enum.auto()
    CROSS = enum.auto()
    DOT = enum.auto()


class Sign(enum.Enum):
    """The symbols of an entry in a legend."""

    LINE = enum.auto()
    MARK = enum.auto()
    LINE_WITH_MARK = enum.auto()
    AREA = enum.auto()


class LineStyle(msgspec.Struct, frozen=True):
    """The look of a line, a mark or an area.

    Attributes
    ----------
    colour
        The name of a colour of the theme, or an Okabe–Ito colour as documents write it.
    opacity
        From 0 (invisible) to 1.
    width
        Width in pixels at scale 1.
    dashes
        The pattern of the line: `SOLID`, `DASHED`, or lengths in widths of the line.
    mark
        The shape of the marks, where points are marked.
    sign
        The symbol in the legend: a line, a mark, both, or an area.
    """

    colour: str = "accent"
    opacity: float = 1.0
    width: float = 1.0
    dashes: Dashes = SOLID
    mark: Mark = Mark.DOT
    sign: Sign = Sign.LINE


BLUE, VERMILLION, GREEN, PURPLE = "#0072b2", "#d55e00", "#009e73", "#cc79a7"
ORANGE, SKY, YELLOW = "#e69f00", "#56b4e9", "#f0e442"
"""Okabe–Ito colours."""

GREY = "#7f7f7f"
"""A further colour that differs from those on either paper."""

USUAL_STYLE = LineStyle()
CURVE_STYLE = LineStyle("curve", width=2.0)
CURE_STYLE = LineStyle("accent", width=2.0, dashes=(4.0, 3.0))
FILE_STYLE = LineStyle("muted", width=1.5, dashes=(6.0, 4.0))
