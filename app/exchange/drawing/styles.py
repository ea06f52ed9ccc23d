"""Colours of pictures."""

from __future__ import annotations

from collections.abc import Mapping

import msgspec

from ...document.model import Paper
from ...document.style import Style
from ...view_model import palette


class PictureStyle(msgspec.Struct, frozen=True):
    """The colours of a picture; without `paper` its background is transparent.

    `theme`, "light" or "dark", is the paper that the colours of the points are made for.
    """

    ink: str
    paper: str | None = None
    theme: str = "light"

    def visible_colour(self, colour: str) -> str:
        """Return a colour as it is drawn on the paper, the same as on the screen's; empty for the ink."""
        return palette.colour_on(self.paper, colour) if colour else self.ink

    def adjustment_of(self, colour: str) -> str:
        """Return the change of a colour that is not visible on the paper, in words; empty for none."""
        return palette.adjustment_of(self.paper, colour)

    def stroke_of(self, style: Style) -> str:
        """Return the colour of a line; only one that lies on paper alone is moved to be seen there."""
        return style.stroke if style.stroke and style.has_fill else self.visible_colour(style.stroke)

    def fill_of(self, style: Style) -> str:
        """Return the colour of the inside; unlike that of a line it does not depend on the paper."""
        return style.fill or self.ink


INK = PictureStyle(palette.INK["light"])
LIGHT = PictureStyle(palette.INK["light"], palette.PAPER["light"])
DARK = PictureStyle(palette.INK["dark"], palette.PAPER["dark"], "dark")

ON_PAPER: Mapping[Paper, PictureStyle] = {Paper.LIGHT: LIGHT, Paper.DARK: DARK}
"""The colours on the papers of documents; that of the theme is on none."""
