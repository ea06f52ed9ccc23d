"""What the form of styles says below its fields."""

from __future__ import annotations

from collections.abc import Sequence

from ...appearance.theme import Theme
from ...document.style import Style
from ...state.window_state import WindowState
from ...view_model.look.palette import adjustment_of

HOW_TO_CHOOSE = "Nothing is chosen. Click a curve, or press Ctrl+A for all."
_SHOWN_EXACTLY = "Paper as Printed (in View, Display Mode) shows it as it prints."


def note_on(styles: Sequence[Style], state: WindowState, theme: Theme) -> str:
    """Return how the canvas shows styles on the paper of a theme, where it is not as they print."""
    if state.thin_lines:
        return "Thin Lines is on (in View, Display Mode): widths, dashes and fills are not shown."
    if state.as_printed:
        return ""
    lines = (each.stroke for each in styles if each.has_stroke and each.stroke_gradient is None)
    moved = next(filter(None, (adjustment_of(theme.paper.name(), stroke) for stroke in lines)), "")
    return f"The line is {moved}. {_SHOWN_EXACTLY}" if moved else ""
