"""Form of a fit to fewer points: family, number or tolerance, and the result."""

from __future__ import annotations

import msgspec
from PySide6.QtCore import QSignalBlocker, Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QScrollArea, QWidget

from ...document.words import NamedEnum
from ...families import FAMILIES, Family
from ...qt.labels import Label
from ...qt.overrides import SafeOverrides
from ...widgets.boxes import column_of, form_of, row_of
from ...widgets.controls import ThinProgress, check_box, choice_box, push_button
from ...widgets.fields import RangedDoubleSpinBox, RangedSpinBox
from ...widgets.frames import scroll_vertically

_DIGITS = 6
_COUNTS = (2, 500)


class FitGoal(NamedEnum):
    """Goal of a fit: a distance or a number of points."""

    WITHIN = "within", "Within a distance"
    COUNT = "count", "Number of points"


class FitOptions(msgspec.Struct, frozen=True):
    """Options of a fit; either the count or the tolerance is given."""

    family: Family
    count: int | None
    tolerance: float | None
    keeps_times: bool


class FitPanel(SafeOverrides, QScrollArea):
    """Form of a fit.

    Signals
    -------
    options_changed
        The options have changed.
    applied, cancelled
        The result is applied, or discarded.
    """

    options_changed = Signal()
    applied = Signal()
    cancelled = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        scroll_vertically(self, "fitPanel")
        self._families = list(FAMILIES)
        titles = [family.label for family in self._families]
        self.family = choice_box("fitFamily", "Family", "Family of the curve with fewer points", titles)
        goals = [goal.label for goal in FitGoal]
        self.goal = choice_box("fitGoal", "Goal", "Largest distance, or number of points", goals)
        tip = "Largest distance from the current curve"
        self.tolerance = RangedDoubleSpinBox("fitTolerance", "Largest distance", tip, (1e-6, 1e9))
        self.tolerance.setDecimals(_DIGITS)
        self.tolerance.setStepType(RangedDoubleSpinBox.StepType.AdaptiveDecimalStepType)
        self.count = RangedSpinBox("fitCount", "Points", "Number of points of the new curve", _COUNTS)
        words = "Keep the t of every position, as for a motion; otherwise keep only the shape"
        self.keeps_times = check_box("fitTimes", "Keep the times", words)
        self.result = Label(name="fitResult", wordWrap=True)
        self.progress = ThinProgress("fitProgress", "Progress of the fit")
        self.apply_button = push_button(
            "applyFit", "Replace the Curve", "Replace the curve with the fit, as one step of the history"
        )
        self.cancel_button = push_button("cancelFit", "Cancel", "Keep the curve unchanged (Esc)")
        self._lay_out()
        self._connect()

    def _lay_out(self) -> None:
        page = QWidget()
        form = form_of(
            ("Family", self.family),
            ("Goal", self.goal),
            ("Distance", self.tolerance),
            ("Points", self.count),
            ("", self.keeps_times),
        )
        buttons = row_of(self.apply_button, self.cancel_button, 1, spacing=8)
        parts = (form, self.result, self.progress, buttons, 1)
        column_of(*parts, margins=(10, 10, 8, 10), spacing=10, parent=page)
        self._form = form
        self.setWidget(page)

    def _connect(self) -> None:
        self.family.activated.connect(self.options_changed)
        self.goal.activated.connect(self._show_goal)
        self.goal.activated.connect(self.options_changed)
        for box in (self.tolerance, self.count):
            box.valueChanged.connect(self.options_changed)
        self.keeps_times.clicked.connect(self.options_changed)
        self.apply_button.clicked.connect(self.applied)
        self.cancel_button.clicked.connect(self.cancelled)

    def _show_goal(self) -> None:
        is_count = self.goal.currentIndex() == list(FitGoal).index(FitGoal.COUNT)
        self._form.setRowVisible(self.count, is_count)
        self._form.setRowVisible(self.tolerance, not is_count)

    @property
    def options(self) -> FitOptions | str:
        """The options of the fit, or the problem of one."""
        is_count = self.goal.currentIndex() == list(FitGoal).index(FitGoal.COUNT)
        if problem := str(self.count.problem if is_count else self.tolerance.problem):
            return problem
        return FitOptions(
            self._families[self.family.currentIndex()],
            self.count.value() if is_count else None,
            None if is_count else self.tolerance.value(),
            self.keeps_times.isChecked(),
        )

    def begin(self, family: Family, tolerance: float, count: int) -> None:
        """Show the family of a curve, and a tolerance and a number of points that suit its size."""
        if family in self._families:
            self.family.setCurrentIndex(self._families.index(family))
        with QSignalBlocker(self.tolerance), QSignalBlocker(self.count):
            self.tolerance.setValue(tolerance)
            self.count.setValue(min(max(count, _COUNTS[0]), _COUNTS[1]))
        self._show_goal()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Escape:
            self.cancelled.emit()
            return
        super().keyPressEvent(event)

    def render_result(self, words: str, *, can_apply: bool, busy: bool) -> None:
        """Show the result, or the reason why there is none."""
        self.result.setText(words)
        self.apply_button.setEnabled(can_apply)
        self.progress.setVisible(busy)
        if not busy:
            self.progress.reset()
