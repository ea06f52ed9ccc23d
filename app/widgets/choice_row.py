"""Buttons side by side, one for each member of an enumeration."""

from __future__ import annotations

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QWidget

from ..appearance.theme import Theme
from ..appearance.themed import FollowsTheme
from ..document.words import NamedEnum
from .boxes import row_of
from .tool_buttons import choice_style, tool_button


class ChoiceRow(FollowsTheme, QWidget):
    """One of a few, taken with one click; none is on while they differ.

    Signals
    -------
    chosen
        A button was clicked: the member.
    """

    chosen = Signal(object)

    def __init__(self, name: str, label: str, tip: str, kind: type[NamedEnum]) -> None:
        super().__init__()
        self.setObjectName(name)
        self._buttons = {}
        for member in kind:
            text = member.label
            button = tool_button(
                f"{name}_{member.value}",
                f"{label}: {text}",
                f"{tip}: {text.lower()}",
                text=text,
            )
            button.setCheckable(True)
            button.clicked.connect(lambda _checked, member=member: self._choose(member))
            self._buttons[member] = button
        self._shown: object = None
        row_of(*self._buttons.values(), 1, margins=0, spacing=4, parent=self)
        self.follow_theme()

    def render_value(self, value: object) -> None:
        """Show a member as the one that is on; anything else for none."""
        self._shown = value
        for member, button in self._buttons.items():
            button.setChecked(member is value)

    def _choose(self, member: NamedEnum) -> None:
        # What is on is what the owner shows.
        self.render_value(self._shown)
        self.chosen.emit(member)

    def set_theme(self, theme: Theme) -> None:
        """Take the colours of `theme`."""
        self.setStyleSheet(choice_style(theme))
