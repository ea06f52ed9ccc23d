"""Settings of the tools."""

from __future__ import annotations

import msgspec

from app.tools.snapping import Snapping


class ToolSettings(msgspec.Struct, frozen=True):
    """Settings of the tools, as the person has them.

    Attributes
    ----------
    snapping
        Whether to snap, and to what.
    unit
        The name of the unit of length, for what is measured.
    shows_box
        Whether two or more selected points, or several selected curves, get a box with grips.
    """

    snapping: Snapping = Snapping()
    unit: str = ""
    shows_box: bool = True
