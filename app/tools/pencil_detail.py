"""The distance of a curve from what the pencil has drawn."""

from __future__ import annotations

from ..document.words import NamedEnum


class PencilDetail(NamedEnum):
    """The distance of a curve from a line that was drawn.

    Attributes
    ----------
    pixels
        The largest deviation, on the screen.
    """

    def __init__(self, value: str, label: str = "", pixels: float = 0.0) -> None:
        super().__init__(value, label)
        self.pixels = pixels

    FINE = "fine", "Fine (1 px)", 1.0
    MEDIUM = "medium", "Medium (2 px)", 2.0
    SMOOTH = "smooth", "Smooth (5 px)", 5.0
    VERY_SMOOTH = "very_smooth", "Very smooth (10 px)", 10.0
