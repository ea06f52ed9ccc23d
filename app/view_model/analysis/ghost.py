"""The ghosts: the same points under every family, and under every rule that needs nothing but the points."""

from __future__ import annotations

import msgspec

from ...document.model import ParametrizationKind
from ...families import FAMILIES, Family
from ..line_styles import (
    BLUE,
    GREEN,
    GREY,
    ORANGE,
    PURPLE,
    SKY,
    VERMILLION,
    YELLOW,
    LineStyle,
)

_NEED_MORE = (ParametrizationKind.POWER, ParametrizationKind.MANUAL)

_FAMILY_COLOURS = (BLUE, VERMILLION, GREEN, ORANGE, PURPLE, SKY, YELLOW, GREY)
_LONG, _MIDDLE, _DOT = (6.0, 2.7), (3.0, 2.7), (1.3, 2.7)
_FAMILY_DASHES = (
    _LONG,
    _LONG + _DOT,
    _LONG + _DOT + _DOT,
    _LONG + _MIDDLE,
    _LONG + _MIDDLE + _DOT,
    _MIDDLE + _DOT,
    _LONG + _MIDDLE + _MIDDLE,
    _MIDDLE + _DOT + _DOT,
    (12.0, 2.7),
)
"""Dashes of the first families; each further family has one more dot."""
_RULE_STYLES = (
    LineStyle(PURPLE, width=1.5, dashes=(3.3, 2.0)),
    LineStyle(ORANGE, width=1.5, dashes=(1.3, 2.0)),
    LineStyle(SKY, width=1.5, dashes=(9.3, 2.7)),
    LineStyle(YELLOW, width=1.5, dashes=(9.3, 2.7, 1.3, 2.7)),
    LineStyle(GREEN, width=1.5, dashes=(3.3, 2.0, 1.3, 2.0)),
)


class Ghost(msgspec.Struct, frozen=True):
    """The same points under another family or another rule for the parameters: one of the two."""

    family: Family | None = None
    kind: ParametrizationKind | None = None

    @property
    def name(self) -> str:
        """The name of the family or the rule."""
        return self.family.name if self.family is not None else str(self.kind)

    @property
    def title(self) -> str:
        """The text in the window: Chord length."""
        record = self.family if self.family is not None else self.kind
        return record.label if record is not None else ""

    @property
    def short(self) -> str:
        """A shorter title for narrow places."""
        return self.family.short if self.family is not None else self.title

    @property
    def action_name(self) -> str:
        """The object name of its action: ghostChordLength."""
        return "ghost" + "".join(word.capitalize() for word in self.name.split("_"))

    @property
    def is_of_family(self) -> bool:
        """Whether the ghost has another family; else it has another rule."""
        return self.kind is None

    @property
    def step(self) -> str:
        """The undo step of making it the curve: Use chord length parameters."""
        if self.kind is not None:
            return f"Use {self.kind.phrase} parameters"
        return f"Switch to {self.title}"

    @property
    def tip(self) -> str:
        """The tooltip of its action."""
        if self.family is not None:
            return f"Also draw the same points as a {self.family.full_title} curve"
        assert self.kind is not None
        return f"Also draw the curve with {self.kind.phrase} parameters"

    @property
    def style(self) -> LineStyle:
        """The look of its line: no two ghosts have the same dashes."""
        if self.family is None:
            return _RULE_STYLES[_rules().index(self)]
        rank = FAMILIES.index(self.family)
        colour = _FAMILY_COLOURS[rank % len(_FAMILY_COLOURS)]
        many = rank >= len(_FAMILY_DASHES)
        return LineStyle(colour, width=1.5, dashes=_LONG + _DOT * rank if many else _FAMILY_DASHES[rank])


def all_ghosts() -> tuple[Ghost, ...]:
    """Return a ghost for every family and for every rule that needs nothing but the points, in order."""
    return (*(Ghost(family=family) for family in FAMILIES), *_rules())


def _rules() -> tuple[Ghost, ...]:
    return tuple(Ghost(kind=kind) for kind in ParametrizationKind if kind not in _NEED_MORE)
