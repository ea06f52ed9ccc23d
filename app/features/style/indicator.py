"""Fill and stroke in the status line: of what is chosen, or of what is drawn next."""

from __future__ import annotations

from collections.abc import Collection

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtGui import QIcon
from PySide6.QtWidgets import QWidget

from ...appearance.swatches import paints_picture
from ...appearance.theme import LIGHT, Theme
from ...appearance.themed import FollowsTheme
from ...document.style import GRADIENTS, NO_PAINT, Style
from ...qt.labels import tip_of
from ...widgets.boxes import row_of
from ...widgets.controls import named
from ...widgets.percent_field import MIXED
from ...widgets.tool_buttons import tool_button
from .subject import Shown

_SIZE = QSize(35, 16)
_PADDING = 4

_TITLE = "Fill and stroke"

_Looks = tuple[str | None, str | None]
"""Fill and stroke; None for several."""


class StyleIndicator(FollowsTheme, QWidget):
    """A button with the two paints; its tip tells them in words.

    Signals
    -------
    clicked
        The panel is wanted.
    """

    clicked = Signal()

    def __init__(self) -> None:
        super().__init__()
        named(self, "styleIndicator")
        self._button = tool_button("styleNow", _TITLE, f"{_TITLE}; a click opens the Style panel", flat=True)
        self._button.setIconSize(_SIZE)
        self._button.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self._button.clicked.connect(self.clicked)
        # No taller than the words beside it: the status line would grow.
        self._button.setMaximumHeight(self.fontMetrics().height() + _PADDING)
        row_of(self._button, margins=(4, 0, 0, 0), spacing=0, parent=self)
        self._looks: _Looks = (NO_PAINT, NO_PAINT)
        self._paper = LIGHT
        self.follow_theme()

    def render_styles(self, shown: Shown, paper: Theme) -> None:
        """Show the paints of some styles as they are on a paper."""
        # Thousands have few styles.
        styles = {*shown.styles}
        looks = (_common(styles, "fill"), _common(styles, "stroke"))
        words = " · ".join(f"{paint} {_words(styles, paint)}" for paint in GRADIENTS)
        told = f"{shown.words}: {words}"
        if told != self._button.accessibleName():
            self._button.setAccessibleName(told)
            self._button.setToolTip(tip_of(f"{told}; a click opens the Style panel"))
        if (looks, paper) != (self._looks, self._paper):
            self._looks, self._paper = looks, paper
            self._draw()

    def set_theme(self, theme: Theme) -> None:
        """Take the colours of `theme`."""
        self._draw()

    def _draw(self) -> None:
        self._button.setIcon(QIcon(paints_picture(*self._looks, self.theme, self._paper)))


def _common(styles: Collection[Style], paint: str) -> str | None:
    """Return the paint that styles have in common, without any no paint; None for several."""
    found = {getattr(each, paint) for each in styles} or {NO_PAINT}
    return str(found.pop()) if len(found) == 1 else None


def _words(styles: Collection[Style], paint: str) -> str:
    laid = [gradient.kind.what for each in styles if (gradient := each.gradients.get(GRADIENTS[paint]))]
    if laid:
        return laid[0] if len(styles) == 1 else MIXED
    common = _common(styles, paint)
    return MIXED if common is None else common or "ink"
