"""What letters were written as: the words, the font and the place that their outlines came from."""

from __future__ import annotations

from typing import Annotated, Final

from .fields import Requirement, above, printed
from .guide import Length
from .value import Value

LONGEST_TEXT: Final = 300
_LONGEST_FONT = 255

_WORDS = Requirement(
    lambda words: len(words) <= LONGEST_TEXT, f"be a text of at most {LONGEST_TEXT} letters", shown=len
)


class Text(Value, frozen=True):
    """What the letters of a text were written as; each of their curves has it.

    Attributes
    ----------
    words
        The text, of one or more lines.
    font
        Family of the font.
    x, y
        Where the baseline of the first line begins, before the letters were moved or turned.
    size
        What an em is long.
    bold, italic
        The style of the font.
    begins
        Whether it begins with the curve that has this: copies of it may lie side by side.
    """

    words: Annotated[str, _WORDS]
    font: Annotated[str, printed(_LONGEST_FONT, f"be a name of at most {_LONGEST_FONT} characters")]
    x: Length
    y: Length
    size: Annotated[Length, above(0)]
    bold: bool = False
    italic: bool = False
    begins: bool = False
