"""What letters were written as: the words, the font and the place that their outlines came from."""

from __future__ import annotations

from typing import Annotated, Final, NamedTuple

from .fields import Requirement, above, between, printed
from .guide import Length
from .value import Value
from .words import NamedEnum

LONGEST_TEXT: Final = 300
_LONGEST_FONT = 255

_WORDS = Requirement(
    lambda words: len(words) <= LONGEST_TEXT, f"be a text of at most {LONGEST_TEXT} letters", shown=len
)


LETTER_SPACING: Final = (-1.0, 10.0)
"""Shares of the size between which what is added between letters lies."""

LINE_SPACING: Final = (0.1, 10.0)
"""The same for the way from line to line, in multiples of that of the font."""


class PlaceInLine(NamedEnum):
    """Where something lies along a line of text.

    Attributes
    ----------
    share
        How much of the line lies before it.
    """

    def __init__(self, value: str, label: str = "", share: float = 0.0) -> None:
        super().__init__(value, label)
        self.share = share


class TextAlign(PlaceInLine):
    """Part of each line that stands where a text was begun; in a frame lines may fill its width."""

    LEFT = "left", "Left", 0.0
    CENTRE = "centre", "Centre", 0.5
    RIGHT = "right", "Right", 1.0
    JUSTIFIED = "justify", "Justify", 0.0


class Setting(NamedTuple):
    """How the letters of a text stand to each other; see `Text`."""

    letter_spacing: float = 0.0
    line_spacing: float = 1.0
    align: TextAlign = TextAlign.LEFT


class Text(Value, frozen=True):
    """What the letters of a text were written as; each of their curves has it.

    Attributes
    ----------
    words
        The text, of one or more lines.
    font
        Family of the font.
    x, y
        Where the baseline of the first line begins, or has its middle or end by `align`, before the letters
        were moved or turned.
    size
        What an em is long.
    bold, italic
        The style of the font.
    begins
        Whether it begins with the curve that has this: copies of it may lie side by side.
    letter_spacing
        What is added between letters, in sizes.
    line_spacing
        The way from line to line, in multiples of that of the font.
    align
        Which part of each line stands at x.
    """

    words: Annotated[str, _WORDS]
    font: Annotated[str, printed(_LONGEST_FONT, f"be a name of at most {_LONGEST_FONT} characters")]
    x: Length
    y: Length
    size: Annotated[Length, above(0)]
    bold: bool = False
    italic: bool = False
    begins: bool = False
    letter_spacing: Annotated[float, between(*LETTER_SPACING)] = 0.0
    line_spacing: Annotated[float, between(*LINE_SPACING)] = 1.0
    align: TextAlign = TextAlign.LEFT

    @property
    def setting(self) -> Setting:
        """How the letters stand to each other."""
        return Setting(self.letter_spacing, self.line_spacing, self.align)
