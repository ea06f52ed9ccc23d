"""Text as it is written on the screen: names, paths and messages are data, not HTML.

Where a text has a tag in its first line, a ``QLabel`` and a tooltip show it as HTML; in a menu an “&” becomes
an underline.
"""

from __future__ import annotations

import re

from PySide6.QtGui import Qt
from PySide6.QtWidgets import QLabel, QWidget

_NO_SPACE = "\N{ZERO WIDTH SPACE}"
_LONG_WORD = re.compile(r"\S{16}(?=\S{16})")
"""Sixteen characters of a longer word stay together."""


class Label(QLabel):
    """A label of plain text, or of HTML with `is_html`, in which data go through `html_of`.

    `name` is its object name, `label` its name for screen readers.
    """

    def __init__(
        self,
        text: str = "",
        *,
        name: str = "",
        label: str = "",
        wordWrap: bool = False,  # noqa: N803 - as Qt has it
        is_html: bool = False,
    ) -> None:
        super().__init__(text, wordWrap=wordWrap)
        self.setObjectName(name)
        self.setAccessibleName(label)
        self.setTextFormat(Qt.TextFormat.RichText if is_html else Qt.TextFormat.PlainText)


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
