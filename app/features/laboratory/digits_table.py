"""The very digits that the methods get at one t, below the true ones."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtGui import QFontDatabase, QPalette
from PySide6.QtWidgets import QGridLayout, QWidget

from ...document.words import number, with_minus
from ...qt.labels import Label
from ...view_model.analysis.laboratory import Digits
from ...widgets.controls import named

_USUAL_DIGITS = 9
_SMALLER = 0.75


class DigitsTable(QWidget):
    """A row for the truth and one for each method: x and y as they were computed, digit by digit."""

    def __init__(self) -> None:
        super().__init__()
        named(self, "digitsTable", "Computed digits")
        self._title = Label(name="digitsTitle")
        self._title.setToolTip("Put the scrub line (T) where you want to look; without it, the worst place")
        self._grid = QGridLayout(self)
        self._grid.setContentsMargins(0, 0, 0, 0)
        self._grid.setHorizontalSpacing(6)
        self._grid.setVerticalSpacing(2)
        self._grid.setColumnStretch(0, 1)
        self._grid.addWidget(self._title, 0, 0)
        for column, text in ((1, "x"), (2, "y")):
            heading = Label(_aligned(text))
            heading.setFont(QFontDatabase.systemFont(QFontDatabase.SystemFont.FixedFont))
            heading.setForegroundRole(QPalette.ColorRole.PlaceholderText)
            self._grid.addWidget(heading, 0, column)
        self._rows: list[tuple[Label, Label, Label]] = []

    @property
    def texts(self) -> list[tuple[str, str, str]]:
        """The rows that are shown: name, x, y."""
        return [(name.text(), x.text(), y.text()) for name, x, y in self._rows if not name.isHidden()]

    def render_digits(self, digits: Digits | None, shown: int) -> None:
        """Show the digits at one t; `shown` are those that are computed with."""
        self.setVisible(digits is not None)
        if digits is None:
            return
        self._title.setText(f"At t = {number(digits.t)}")
        rows = [("True", *map(_aligned, digits.truth))]
        rows += [(method.label, *map(_aligned, pair)) for method, pair in digits.rows]
        while len(self._rows) < len(rows):
            self._add_row()
        style = _digits_style(shown)
        for place, labels in enumerate(self._rows):
            texts = rows[place] if place < len(rows) else ("", "", "")
            for label, text in zip(labels, texts, strict=True):
                label.setText(text)
                label.setVisible(place < len(rows))
            for label in labels[1:]:
                label.setStyleSheet(style)

    def _add_row(self) -> None:
        labels = (Label(), Label(), Label())
        for column, label in enumerate(labels):
            if column:
                label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
            self._grid.addWidget(label, len(self._rows) + 1, column)
        self._rows.append(labels)


def _digits_style(shown: int) -> str:
    """Return the type for so many digits: two long numbers beside each other have to fit a narrow dock.

    As a style sheet, for that of an enlarged dock would take the place of a font.
    """
    font = QFontDatabase.systemFont(QFontDatabase.SystemFont.FixedFont)
    size = f" font-size: {_SMALLER * font.pointSizeF()}pt;" if shown > _USUAL_DIGITS else ""
    return f'font-family: "{font.family()}";{size}'


def _aligned(text: str) -> str:
    """Write a real minus, or leave its room, so that leading digits stand below each other."""
    return with_minus(text if text.startswith("-") else f" {text}")
