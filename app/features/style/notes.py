"""What the form of styles says below its fields."""

from __future__ import annotations

from collections.abc import Sequence

from ...appearance.theme import Theme
from ...document.style import Style
from ...view_model.look.palette import adjustment_of

HOW_TO_CHOOSE = "Nothing is chosen. Click a curve, or press Ctrl+A for all."


def note_on(styles: Sequence[Style], theme: Theme) -> str:
    """Return how the canvas shows styles on the paper of a theme, where it is not as they print."""
    lines = (each.stroke for each in styles if each.has_stroke)
    moved = next(filter(None, (adjustment_of(theme.paper.name(), stroke) for stroke in lines)), "")
    return f"The line is {moved}." if moved else ""
