"""Tables of the laboratory: the errors of the methods, and the digits that they compute at one t."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QEvent, QSize, Qt, Signal
from PySide6.QtGui import QFontDatabase, QIcon
from PySide6.QtWidgets import QApplication, QCheckBox, QWidget

from ...appearance.theme import FollowsTheme, Theme
from ...document.words import number, short, with_minus
from ...plotting.pens import SIGN, sign_pixmap
from ...qt.labels import MUTED, Label
from ...qt.overrides import SafeOverrides
from ...view_model.analysis.laboratory import Digits, Trial
from ...view_model.analysis.settings import Calculation, RoundedPart
from ...widgets.boxes import grid_of
from ...widgets.controls import check_box, named

_HEADINGS = (
    ("Method", "Select the methods to compute and draw"),
    ("Digits\nlost", "Number of wrong digits where the error is largest"),
    ("Largest\nerror", "Largest distance from the true curve"),
    ("at t", "Parameter of the largest error"),
    (
        "Condition",
        "Bounds. κ: factor by which solving the system can magnify rounding errors; "
        "Λ: factor by which the curve itself magnifies errors in its points",
    ),
)
_CELLS = {"lost": "15.9", "error": "8.9·10⁻¹⁶", "place": "0.55", "condition": "κ 1.2·10¹⁶"}
"""Columns of numbers, each with its longest text, whose width is reserved so that the layout never jumps."""


_SIGN = QSize(20, SIGN.height())
"""A short sample of a line: the table has the width of a dock."""


class MethodTable(FollowsTheme, QWidget):
    """Table with a row for each method: a check box in its style, its errors and its condition.

    Signals
    -------
    methods_changed
        The person selects other methods to compare.
    """

    methods_changed = Signal(frozenset)

    def __init__(self) -> None:
        super().__init__()
        named(self, "laboratoryTable", "Methods and their errors")
        self._grid = grid_of(4, 4, stretched=[0], margins=0, parent=self)
        for column, (text, tip) in enumerate(_HEADINGS):
            heading = Label(text, role=MUTED)
            heading.setToolTip(tip)
            heading.setAlignment(_side(column))
            self._grid.addWidget(heading, 0, column)
        self._compared = frozenset[Calculation]()
        self._boxes: dict[Calculation, QCheckBox] = {}
        self._cells: dict[Calculation, list[Label]] = {}
        for row, method in enumerate(Calculation, start=1):
            self._add_row(row, method)
        self.follow_theme()

    def _add_row(self, row: int, method: Calculation) -> None:
        box = check_box(f"method_{method.value}", method.label, method.tip, f"Compare {method.label}")
        box.setIconSize(_SIGN)
        box.clicked.connect(lambda: self.methods_changed.emit(self._compared ^ {method}))
        self._boxes[method] = box
        self._grid.addWidget(box, row, 0)
        self._cells[method] = []
        for column, (name, longest) in enumerate(_CELLS.items(), start=1):
            cell = Label(name=f"{name}_{method.value}")
            cell.setMinimumWidth(cell.fontMetrics().horizontalAdvance(longest))
            cell.setAlignment(_side(column))
            self._cells[method].append(cell)
            self._grid.addWidget(cell, row, column)

    def offers(self, method: Calculation) -> bool:
        """Return whether the family has this method."""
        return not self._boxes[method].isHidden()

    def render_methods(self, available: Sequence[Calculation], compared: frozenset[Calculation]) -> None:
        """Show the methods of the family, and check those that are compared."""
        self._compared = compared
        widest = max(box.sizeHint().width() for box in self._boxes.values())
        self._grid.setColumnMinimumWidth(0, widest)
        for method, box in self._boxes.items():
            box.setVisible(method in available)
            box.setChecked(method in compared)
            for cell in self._cells[method]:
                cell.setVisible(method in available)

    def render_trial(self, trial: Trial | None, lebesgue: float | None, *, faded: bool) -> None:
        """Show the errors of a trial; faded while another one is computed."""
        for method, cells in self._cells.items():
            outcome = trial.outcome(method) if trial is not None else None
            texts = ("–",) * len(_CELLS)
            if trial is not None and outcome is not None:
                error, t = outcome.worst
                lost = f"{outcome.lost:.1f}"
                place = number(t, 2, step=float(trial.t[-1] - trial.t[0]) / 100.0)
                texts = (lost, short(error), place, _condition(method, trial, lebesgue))
            for cell, text in zip(cells, texts, strict=True):
                cell.setText(text)
                cell.setEnabled(not faded)

    def set_theme(self, theme: Theme) -> None:
        for method, box in self._boxes.items():
            box.setIcon(QIcon(sign_pixmap(method.style, theme, self.devicePixelRatioF())))


def _side(column: int) -> Qt.AlignmentFlag:
    side = Qt.AlignmentFlag.AlignRight if column else Qt.AlignmentFlag.AlignLeft
    return side | Qt.AlignmentFlag.AlignVCenter


def _condition(method: Calculation, trial: Trial, lebesgue: float | None) -> str:
    if method is Calculation.MONOMIAL and trial.settings.rounding is not RoundedPart.DATA:
        return f"κ {short(trial.condition)}" if trial.condition is not None else "–"
    return f"Λ {short(lebesgue)}" if lebesgue is not None else "–"


_USUAL_DIGITS = 9
_SMALLER = 0.75


class DigitsTable(SafeOverrides, QWidget):
    """Table of x and y at one t with all digits: the true values, then those of each method."""

    def __init__(self) -> None:
        super().__init__()
        named(self, "digitsTable", "Computed digits")
        self._title = Label(name="digitsTitle")
        self._title.setToolTip(
            "Move the scrub line (T) to choose t; otherwise t is where the error is largest"
        )
        self._grid = grid_of(6, 2, stretched=[0], margins=0, parent=self)
        self._grid.addWidget(self._title, 0, 0)
        for column, text in ((1, "x"), (2, "y")):
            heading = Label(_aligned(text), role=MUTED)
            heading.setFont(QFontDatabase.systemFont(QFontDatabase.SystemFont.FixedFont))
            self._grid.addWidget(heading, 0, column)
        self._rows: list[tuple[Label, Label, Label]] = []
        self._count = 0

    @property
    def texts(self) -> list[tuple[str, str, str]]:
        """Visible rows: name, x, y."""
        return [(name.text(), x.text(), y.text()) for name, x, y in self._rows if not name.isHidden()]

    def render_digits(self, digits: Digits | None, count: int, t: str) -> None:
        """Show the values at one t, given as text, computed with `count` digits."""
        self.setVisible(digits is not None)
        if digits is None:
            return
        self._title.setText(f"At t = {t}")
        rows = [("True", *map(_aligned, digits.truth))]
        rows += [(method.label, *map(_aligned, pair)) for method, pair in digits.rows]
        while len(self._rows) < len(rows):
            self._add_row()
        self._count = count
        for index, labels in enumerate(self._rows):
            texts = rows[index] if index < len(rows) else ("", "", "")
            for label, text in zip(labels, texts, strict=True):
                label.setText(text)
                label.setVisible(index < len(rows))
        self._style_digits()

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange and hasattr(self, "_rows"):
            self._style_digits()

    def _style_digits(self) -> None:
        style = _digits_style(self._count, self.font().pointSizeF() / QApplication.font().pointSizeF())
        for labels in self._rows:
            for label in labels[1:]:
                label.setStyleSheet(style)

    def _add_row(self) -> None:
        labels = (Label(), Label(), Label())
        for column, label in enumerate(labels):
            if column:
                label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
            self._grid.addWidget(label, len(self._rows) + 1, column)
        self._rows.append(labels)


def _digits_style(count: int, scale: float) -> str:
    """Return the style of so many digits: two long numbers must fit beside each other in a narrow dock.

    It is a style sheet because that of an enlarged dock would override a font.
    """
    font = QFontDatabase.systemFont(QFontDatabase.SystemFont.FixedFont)
    size = f" font-size: {scale * _SMALLER * font.pointSizeF()}pt;" if count > _USUAL_DIGITS else ""
    return f'font-family: "{font.family()}";{size}'


def _aligned(text: str) -> str:
    """Return the text with a true minus, or a blank in its place, so that leading digits are aligned."""
    return with_minus(text if text.startswith("-") else f" {text}")
