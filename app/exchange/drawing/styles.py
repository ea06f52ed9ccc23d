"""Colours of pictures."""

from __future__ import annotations

import msgspec

from ...view_model import palette


class Style(msgspec.Struct, frozen=True):
    """The colours of a picture; without `paper` its background is transparent.

    `theme`, "light" or "dark", is the paper that the colours of the points are made for.
    """

    ink: str
    paper: str | None = None
    theme: str = "light"


INK = Style(palette.INK["light"])
LIGHT = Style(palette.INK["light"], palette.PAPER["light"])
DARK = Style(palette.INK["dark"], palette.PAPER["dark"], "dark")
