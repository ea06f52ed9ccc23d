"""The page of a drawing."""

from __future__ import annotations

from typing import Annotated

from .decimals import decimal_sum
from .fields import above
from .guide import Length
from .style import USUAL_WIDTH
from .value import Value


class Page(Value, frozen=True, omit_defaults=False):
    """The part of the plane that pictures show.

    Attributes
    ----------
    x, y
        Where its lower left corner lies.
    width, height
        Its size.
    """

    x: Length
    y: Length
    width: Annotated[Length, above(0)]
    height: Annotated[Length, above(0)]

    @property
    def top(self) -> float:
        """Where its upper edge lies."""
        return decimal_sum(self.y, self.height)

    @property
    def usual_width(self) -> float:
        """Width of a line on it whose style says none."""
        return USUAL_WIDTH * max(self.width, self.height)
