"""The methods of the laboratory: which are compared, how each looks, and how wrong it is."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QIcon, QPalette
from PySide6.QtWidgets import QCheckBox, QGridLayout, QWidget

from ...appearance.theme import FollowsTheme, Theme
from ...document.words import number
from ...plotting.pens import SIGN, sign_pixmap
from ...qt.labels import Label
from ...view_model.analysis.laboratory import Trial
from ...view_model.analysis.settings import Calculation, RoundedPart
from ...view_model.analysis.wording import short
from ...widgets.controls import check_box, named

_HEADINGS = (
    ("Method", "Choose what is computed and drawn"),
    ("Digits\nlost", "How many of the digits are wrong where the curve is worst"),
    ("Largest\nerror", "The largest distance to the true curve"),
    ("at t", "Where the largest error is"),
    (
        "Condition",
        "At worst. κ: how many times solving the system can magnify rounding; "
        "Λ: how many times the curve itself magnifies errors of its points",
    ),
)
_CELLS = {"lost": "15.9", "error": "8.9·10⁻¹⁶", "place": "0.55", "condition": "κ 1.2·10¹⁶"}
"""The columns of numbers, each with as long a text as there is: its room is kept, so that nothing jumps."""


class MethodTable(FollowsTheme, QWidget):
    """A row for each method: a check box with its style, and what came out.

    Signals
    -------
    chosen
        Other methods are to be compared.
    """

    chosen = Signal(frozenset)

    def __init__(self) -> None:
        super().__init__()
        named(self, "laboratoryTable", "Methods and their errors")
        self._grid = QGridLayout(self)
        self._grid.setContentsMargins(0, 0, 0, 0)
        self._grid.setHorizontalSpacing(7)
        self._grid.setVerticalSpacing(4)
        self._grid.setColumnStretch(0, 1)
        for column, (text, tip) in enumerate(_HEADINGS):
            heading = Label(text)
            heading.setToolTip(tip)
            heading.setForegroundRole(QPalette.ColorRole.PlaceholderText)
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
        box.setIconSize(SIGN)
        box.clicked.connect(lambda: self.chosen.emit(self._compared ^ {method}))
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
        """Whether the method can be chosen for this family."""
        return not self._boxes[method].isHidden()

    def render_methods(self, available: Sequence[Calculation], chosen: frozenset[Calculation]) -> None:
        """Show the methods that there are, and check those that are compared."""
        self._compared = chosen
        widest = max(box.sizeHint().width() for box in self._boxes.values())
        self._grid.setColumnMinimumWidth(0, widest)
        for method, box in self._boxes.items():
            box.setVisible(method in available)
            box.setChecked(method in chosen)
            for cell in self._cells[method]:
                cell.setVisible(method in available)

    def render_trial(self, trial: Trial | None, lebesgue: float | None, *, faded: bool) -> None:
        """Show what came out; faded while something else is being computed."""
        for method, cells in self._cells.items():
            outcome = trial.outcome(method) if trial is not None else None
            texts = ("–",) * len(_CELLS)
            if trial is not None and outcome is not None:
                error, t = outcome.worst
                lost, place = f"{outcome.lost:.1f}", number(t, 2)
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
