"""Colours of pictures."""

from __future__ import annotations

import msgspec

from ...view_model import palette


class PictureStyle(msgspec.Struct, frozen=True):
    """The colours of a picture; without `paper` its background is transparent.

    `theme`, "light" or "dark", is the paper that the colours of the points are made for.
    """

    ink: str
    paper: str | None = None
    theme: str = "light"


INK = PictureStyle(palette.INK["light"])
LIGHT = PictureStyle(palette.INK["light"], palette.PAPER["light"])
DARK = PictureStyle(palette.INK["dark"], palette.PAPER["dark"], "dark")
