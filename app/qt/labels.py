"""Text as it is written on the screen: names, paths and messages are data, not HTML.

Where a text has a tag in its first line, a ``QLabel`` and a tooltip show it as HTML; in a menu an “&” becomes
an underline.
"""

from __future__ import annotations

import re

from PySide6.QtGui import QPalette, Qt
from PySide6.QtWidgets import QLabel, QWidget

_NO_SPACE = "\N{ZERO WIDTH SPACE}"
_LONG_WORD = re.compile(r"\S{16}(?=\S{16})")
"""Sixteen characters of a longer word stay together."""


INK, MUTED = QPalette.ColorRole.WindowText, QPalette.ColorRole.PlaceholderText
WARNING = QPalette.ColorRole.BrightText
"""Roles in the palette of the colours of text, of secondary text and of warnings, in every theme."""


class Label(QLabel):
    """A label of plain text, or of HTML with `is_html`, in which data go through `html_of`.

    `name` is its object name, `label` its name for screen readers, `role` the role of its colour.
    """

    def __init__(
        self,
        text: str = "",
        *,
        name: str = "",
        label: str = "",
        wordWrap: bool = False,  # noqa: N803 - as Qt has it
        is_html: bool = False,
        role: QPalette.ColorRole = INK,
    ) -> None:
        super().__init__(text, wordWrap=wordWrap)
        if role != INK:
            self.setForegroundRole(role)
        self.setObjectName(name)
        self.setAccessibleName(label)
        self.setTextFormat(Qt.TextFormat.RichText if is_html else Qt.TextFormat.PlainText)

    def show_text(self, text: str) -> None:
        """Show a text; without one the label is hidden."""
        self.setText(text)
        self.setVisible(bool(text))

    def show_problem(self, text: str) -> None:
        """Show a problem, or hide the label without one."""
        self.show_text(f"⚠ {text}" if text else "")


def html_of(text: str) -> str:
    """Return HTML that shows a text as it is written."""
    return text.replace("&", "&amp;").replace("<", "&lt;").replace("\n", "<br>")


def tip_of(text: str) -> str:
    """Return a tooltip that shows a text as it is written."""
    return f"<qt>{html_of(text)}</qt>" if Qt.mightBeRichText(text) else text


def set_tip(widget: QWidget, tip: str) -> None:
    """Set the tooltip of a widget if it differs: Qt sends an event even for the same one."""
    if widget.toolTip() != tip:
        widget.setToolTip(tip)


def menu_text(text: str) -> str:
    """Return a text for an action, a button or a tab, with “&” doubled."""
    return text.replace("&", "&&")


def breakable(text: str) -> str:
    """Return a text whose long words may be broken: a message box cuts off wider ones than the screen."""
    return _LONG_WORD.sub(lambda match: match[0] + _NO_SPACE, text)
