"""Buttons for looks of letters, each a letter that has it."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QToolButton

from ...widgets.tool_buttons import tool_button

_KEYS = ("B", "I", "U")
"""Letters that are keys, too."""


def letter_button(name: str, letter: str, title: str, is_on: bool) -> QToolButton:
    """Return a switch that shows a letter in the look that it is for."""
    key = f" (Ctrl+{letter})" if letter in _KEYS else ""
    kind = f"{title} letters" if len(letter) == 1 else title
    button = tool_button(name, title, f"{kind}{key}: those that are chosen, else all", text=letter)
    font = button.font()
    font.setBold(letter == "B")
    font.setItalic(letter == "I")
    font.setUnderline(letter == "U")
    font.setStrikeOut(letter == "S")
    button.setFont(font)
    button.setCheckable(True)
    button.setChecked(is_on)
    # Else a click on it would give the focus to the canvas.
    button.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
    return button
