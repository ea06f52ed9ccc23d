"""Colours of pictures."""

from __future__ import annotations

import msgspec

from ...document.style import Style
from ...view_model.look import palette


class PictureStyle(msgspec.Struct, frozen=True):
    """The colours of a picture; without `paper` its background is transparent.

    `theme`, "light" or "dark", is the paper that the colours of the points are made for. What `is_as_printed`
    has the very colours that were chosen, whether they can be seen or not.
    """

    ink: str
    paper: str | None = None
    theme: str = "light"
    is_as_printed: bool = False

    def seen(self, colour: str) -> str:
        """Return a colour as it is drawn on the paper, the same as on the screen's; empty for the ink."""
        return (
            (colour if self.is_as_printed else palette.colour_on(self.paper, colour)) if colour else self.ink
        )

    def adjustment_of(self, colour: str) -> str:
        """Return what becomes of a colour that cannot be seen on the paper; empty if nothing does."""
        return "" if self.is_as_printed else palette.adjustment_of(self.paper, colour)

    def on_page(self) -> PictureStyle:
        """Return the colours of a picture of a page: light paper is white then, as the screen has it."""
        return PRINTED if self == LIGHT else self

    def stroke_of(self, style: Style) -> str:
        """Return the colour of a line; only one that lies on paper alone is moved to be seen there."""
        return style.stroke if style.stroke and style.has_fill else self.seen(style.stroke)

    def fill_of(self, style: Style) -> str:
        """Return the colour of an inside: what somebody chose to be white is white on any paper."""
        return style.fill or self.ink


INK = PictureStyle(palette.INK["light"])
LIGHT = PictureStyle(palette.INK["light"], palette.PAPER["light"])
PRINTED = PictureStyle(palette.INK["light"], palette.WHITE, is_as_printed=True)
DARK = PictureStyle(palette.INK["dark"], palette.PAPER["dark"], "dark")
