"""How lines and marks look: one vocabulary for figures, ghosts, methods, plots and their legends. No Qt.

A look names its colour; the theme decides which shade that is.
"""

from __future__ import annotations

import enum

import msgspec

from app.view_model.analysis.figures import Style
from app.view_model.analysis.laboratory_settings import Calculation
from app.view_model.analysis.settings import GHOST_KINDS, Ghost, all_ghosts

Dashes = tuple[float, ...]
"""Lengths of a dash, a gap, a dash and so on, in widths of the line; empty for a solid line."""

SOLID: Dashes = ()
DASHED: Dashes = (4.0, 2.0)
DOTTED: Dashes = (1.0, 2.0)

KIND_DASHES = (SOLID, DASHED, DOTTED)
"""Position, velocity and acceleration functions."""


class Mark(enum.Enum):
    """The forms of marks: told apart without colours."""

    RING = enum.auto()
    DIAMOND = enum.auto()
    SQUARE = enum.auto()
    CROSS = enum.auto()
    DOT = enum.auto()


class Look(msgspec.Struct, frozen=True):
    """How something is drawn.

    Attributes
    ----------
    colour
        The name of a colour of the theme, or an Okabe–Ito colour as documents write it.
    width
        Pixels, where nothing is enlarged.
    """

    colour: str = "accent"
    opacity: float = 1.0
    width: float = 1.0
    dashes: Dashes = SOLID
    mark: Mark = Mark.DOT


_BLUE, _VERMILLION, _GREEN, _PURPLE = "#0072b2", "#d55e00", "#009e73", "#cc79a7"
_ORANGE, _SKY, _YELLOW = "#e69f00", "#56b4e9", "#f0e442"

USUAL_LOOK = Look()
CURVE_LOOK = Look("curve", width=2.0)
CURE_LOOK = Look("accent", width=2.0, dashes=(4.0, 3.0))
FILE_LOOK = Look("muted", width=1.5, dashes=(6.0, 4.0))

LOOKS = {
    Style.COMB_TEETH: Look("accent", 0.35),
    Style.COMB_EDGE: Look("accent", 0.9),
    Style.VELOCITY: Look(_GREEN, width=1.6),
    Style.ACCELERATION: Look(_VERMILLION, width=1.6),
    Style.CIRCLE: Look(_PURPLE, width=1.4),
    Style.CIRCLE_CENTRE: Look(_PURPLE, 0.8),
    Style.BEZIER: Look("handle", 0.9),
    Style.BEZIER_POINT: Look("handle", mark=Mark.SQUARE),
    Style.POLYGON: Look("muted", 0.8, dashes=(2.0, 4.0)),
    Style.TICK: Look("accent", width=1.4),
    Style.INFLECTION: Look(_SKY, width=1.8, mark=Mark.RING),
    Style.SHARPEST: Look(_VERMILLION, width=1.4, mark=Mark.DIAMOND),
    Style.FLATTEST: Look(_GREEN, width=1.6, mark=Mark.SQUARE),
    Style.CROSSING: Look(_PURPLE, width=2.0, mark=Mark.CROSS),
    Style.BAND: Look("accent", 0.16),
    Style.ENSEMBLE: Look("muted", 0.3),
}

_FAMILY_COLOURS = (_BLUE, _VERMILLION, _GREEN, _ORANGE, _PURPLE, _SKY, _YELLOW)
_RULE_LOOKS = (
    Look(_PURPLE, width=1.5, dashes=(3.3, 2.0)),
    Look(_ORANGE, width=1.5, dashes=(1.3, 2.0)),
    Look(_SKY, width=1.5, dashes=(9.3, 2.7)),
    Look(_YELLOW, width=1.5, dashes=(9.3, 2.7, 1.3, 2.7)),
)
"""Of ghosts under other rules, in their order."""


def ghost_look(ghost: Ghost) -> Look:
    """Return how a ghost looks: no two have the same dashes."""
    if ghost.kind is not None:
        return _RULE_LOOKS[GHOST_KINDS.index(ghost.kind)]
    place = all_ghosts().index(ghost)
    colour = _FAMILY_COLOURS[place % len(_FAMILY_COLOURS)]
    return Look(colour, width=1.5, dashes=(6.0, 2.7, *(1.3, 2.7) * place))


METHOD_LOOKS = {
    Calculation.MONOMIAL: Look(_VERMILLION, width=2.0, dashes=(5.0, 2.0)),
    Calculation.NEWTON: Look(_PURPLE, width=2.0, dashes=(6.0, 2.0, 1.0, 2.0)),
    Calculation.LAGRANGE: Look(_BLUE, width=2.0, dashes=(2.0, 2.0)),
    Calculation.BARYCENTRIC: Look(_GREEN, width=2.0, dashes=(1.0, 1.5)),
    Calculation.BASIS: Look(_BLUE, width=2.0, dashes=(2.0, 2.0)),
}
