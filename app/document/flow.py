"""How the words of a text fill a frame: they wrap in its width, and each of its lines is a paragraph."""

from __future__ import annotations

from typing import Annotated, Final

from .fields import between
from .value import Value

USUAL_LINE: Final = 1.25
"""The way from line to line, in sizes, that nobody chose."""

Box = tuple[float, float, float, float]
"""Left and upper, right and lower edge."""


class Flow(Value, frozen=True):
    """What of a text in a frame is not said by its letters.

    Attributes
    ----------
    line
        The way from line to line, in sizes.
    grows
        Whether the frame is as high as what is in it, whose first line stays on its baseline; else the words
        begin at its upper edge, and may not fit.
    is_justified
        Whether the lines of a paragraph, but for its last one, are stretched to the width of the frame.
    """

    line: Annotated[float, between(0.05, 100.0)] = USUAL_LINE
    grows: bool = False
    is_justified: bool = False


def stretched(box: Box, before: Box, after: Box) -> Box:
    """Return the box in the units of a text, y down, of a frame in the plane that becomes another, y up.

    Both are its left and lower, right and upper edge; a letter stays as large as it is.
    """
    left, low, right, top = before
    across, down = (box[2] - box[0]) / (right - left), (box[3] - box[1]) / (top - low)
    return (
        box[0] + (after[0] - left) * across,
        box[1] + (top - after[3]) * down,
        box[2] + (after[2] - right) * across,
        box[3] + (low - after[1]) * down,
    )


def rough_frame(box: Box, baseline: float, size: float, flow: Flow, paragraphs: int) -> Box:
    """Return the frame that a text has for whoever has no fonts: of one that grows the height is a guess."""
    if not flow.grows:
        return box
    top = baseline - size * (0.3 + flow.line / 2)
    return (box[0], top, box[2], top + paragraphs * flow.line * size)
