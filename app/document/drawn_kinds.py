"""What tools draw, by the style that it begins with."""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

import msgspec
from msgspec.structs import replace

from .style import NO_PAINT, PLAIN_STYLE, Style


class DrawnKind(msgspec.Struct, frozen=True):
    """A kind of thing that tools draw. To add one: a constant, which the records of tools name.

    Attributes
    ----------
    subject
        What the next one is called.
    begins
        Returns the style of the first one in a drawing, from that of new documents; from then on it is what
        was set while such a tool is in use.  None where it is always the style that was used last, as it is
        for all of them in sketches.
    """

    subject: str
    begins: Callable[[Style], Style] | None = None


def _line(usual: Style) -> Style:
    return replace(usual.flat, fill=NO_PAINT) if usual.has_stroke else PLAIN_STYLE


SHAPES: Final = DrawnKind("What is drawn next")
LINES: Final = DrawnKind("The next line", _line)
