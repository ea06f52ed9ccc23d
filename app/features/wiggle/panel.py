"""Explain this wiggle: the weights of the points at one t in bars and words, and ways to calm the curve."""

from __future__ import annotations

import math
from collections.abc import Sequence

from PySide6.QtCore import QEvent, QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QEnterEvent, QFocusEvent, QKeyEvent, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QPushButton, QScrollArea, QSizePolicy, QWidget

from ...appearance.colours import point_colours
from ...appearance.theme import theme_of
from ...document.derivatives import DERIVATIVES
from ...document.words import short
from ...qt.labels import MUTED, Label
from ...qt.overrides import SafeOverrides
from ...view_model.analysis.wiggle import CURES, MOST_PULLS, Cure, Cures, Explanation, Pull
from ...view_model.curve.curve_view import CurveView
from ...widgets.boxes import column_of, grid_of
from ...widgets.controls import named
from ...widgets.frames import scroll_vertically

_ROW = 19


class WeightBars(SafeOverrides, QWidget):
    """A bar for each datum that pulls, the strongest at the top."""

    def __init__(self) -> None:
        super().__init__()
        tip = "Weight of each point here: bars to the right pull, bars to the left push away"
        named(self, "weightBars", "Weights of the points here", tip)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.pulls: Sequence[Pull] = ()
        self._count = 0

    def sizeHint(self) -> QSize:
        return QSize(260, _ROW * MOST_PULLS)

    def minimumSizeHint(self) -> QSize:
        return QSize(200, _ROW * MOST_PULLS)

    def render_pulls(self, pulls: Sequence[Pull], count: int) -> None:
        """Show the weights of some of `count` points."""
        self.pulls, self._count = pulls, count
        self.setAccessibleDescription("; ".join(f"{_name(pull)}: {short(pull.weight)}" for pull in pulls))
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        try:
            self._paint(painter)
        finally:
            painter.end()

    def _paint(self, painter: QPainter) -> None:
        if not self.pulls:
            return
        theme = theme_of(self.palette())
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, True)
        metrics = self.fontMetrics()
        name = max(metrics.horizontalAdvance(_name(pull)) for pull in self.pulls) + 8.0
        value = max(metrics.horizontalAdvance(short(pull.weight)) for pull in self.pulls) + 8.0
        left, right = name, self.width() - value
        largest = max(abs(pull.weight) for pull in self.pulls) or 1.0
        low = min(0.0, *(pull.weight for pull in self.pulls)) / largest
        high = max(0.0, *(pull.weight for pull in self.pulls)) / largest
        unit = (right - left) / max(high - low, 1e-9)
        zero = left - low * unit
        colours = point_colours(max(self._count, 1), theme)
        for row, pull in enumerate(self.pulls):
            top = row * _ROW
            middle = Qt.AlignmentFlag.AlignVCenter
            painter.setPen(theme.ink)
            painter.drawText(
                QRectF(0, top, name, _ROW), int(middle | Qt.AlignmentFlag.AlignLeft), _name(pull)
            )
            painter.drawText(
                QRectF(right, top, value, _ROW), int(middle | Qt.AlignmentFlag.AlignRight), short(pull.weight)
            )
            end = zero + pull.weight / largest * unit
            painter.fillRect(
                QRectF(QPointF(zero, top + 4), QPointF(end, top + _ROW - 4)), colours[pull.point]
            )
        painter.setPen(QPen(theme.muted, 1.0))
        painter.drawLine(QPointF(zero, 0), QPointF(zero, len(self.pulls) * _ROW))


def _name(pull: Pull) -> str:
    return f"{DERIVATIVES[pull.order - 1].name if pull.order else 'point'} {pull.point}"


_NOWHERE = "Click the curve where it oscillates."


class CureButton(SafeOverrides, QPushButton):
    """A cure, which is previewed while the pointer or the focus is on it.

    Signals
    -------
    looked_at
        The pointer or the focus has entered.
    left
        Both have left, or Escape was pressed.
    """

    looked_at = Signal()
    left = Signal()

    def __init__(self, key: str, text: str, tip: str) -> None:
        super().__init__(text)
        named(self, f"cure_{key}", tip, f"{tip} in one step, which Undo reverts. Hover to preview it")
        self.setAutoDefault(False)
        self.setFocusPolicy(Qt.FocusPolicy.TabFocus)

    def enterEvent(self, event: QEnterEvent) -> None:
        super().enterEvent(event)
        if self.isEnabled():
            self.looked_at.emit()

    def leaveEvent(self, event: QEvent) -> None:
        super().leaveEvent(event)
        if not self.hasFocus():
            self.left.emit()

    def focusInEvent(self, event: QFocusEvent) -> None:
        super().focusInEvent(event)
        self.looked_at.emit()

    def focusOutEvent(self, event: QFocusEvent) -> None:
        super().focusOutEvent(event)
        self.left.emit()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Escape and self.hasFocus():
            self.clearFocus()
            return
        super().keyPressEvent(event)


class WigglePanel(QScrollArea):
    """Explanation of the curve at one t, and cures to try.

    Signals
    -------
    looked_at
        The key of the cure to preview; empty for none.
    applied
        The key of the cure to apply.
    """

    looked_at = Signal(str)
    applied = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        scroll_vertically(self, "wigglePanel")
        self.words = Label(_NOWHERE, name="wiggleWords", wordWrap=True)
        self.title = Label(name="wiggleTitle")
        self.bars = WeightBars()
        self._headings = [Label(name=name, role=MUTED) for name in ("curesState", "swingNow", "lebesgueNow")]
        self.buttons: dict[str, CureButton] = {}
        self._effects: dict[str, tuple[Label, Label]] = {}
        self.calm = Label(name="nothingToCure", wordWrap=True)
        self._rows = QWidget()
        self._lay_out()

    def _lay_out(self) -> None:
        page = QWidget()
        self._fill_rows()
        parts = (self.words, self.calm, self._rows, self.title, self.bars, 1)
        column_of(*parts, margins=(10, 10, 8, 10), spacing=8, parent=page)
        self.setWidget(page)
        self.setMinimumWidth(page.minimumSizeHint().width() + self.verticalScrollBar().sizeHint().width())

    def _fill_rows(self) -> None:
        grid = grid_of(10, 3, stretched=[0], margins=0, parent=self._rows)
        for column, heading in enumerate(self._headings):
            if column:
                heading.setAlignment(Qt.AlignmentFlag.AlignRight)
            grid.addWidget(heading, 0, column)
        self._headings[1].setToolTip(
            "Largest distance of the curve from the straight line between the two points"
        )
        self._headings[2].setToolTip(
            "The Lebesgue constant: the factor by which errors in the points can grow"
        )
        for row, (key, text, tip, *_) in enumerate(CURES, start=1):
            button = CureButton(key, text, tip)
            button.looked_at.connect(lambda key=key: self.looked_at.emit(key))
            button.left.connect(lambda: self.looked_at.emit(""))
            button.clicked.connect(lambda _checked=False, key=key: self.applied.emit(key))
            self.buttons[key] = button
            grid.addWidget(button, row, 0)
            effects = (Label(name=f"swing_{key}"), Label(name=f"lebesgue_{key}"))
            for column, label in enumerate(effects, start=1):
                label.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
                grid.addWidget(label, row, column)
            self._effects[key] = effects

    def render_explanation(self, explanation: Explanation | None, view: CurveView) -> None:
        """Show an explanation of a curve; without one, an instruction."""
        known = explanation is not None
        self.title.setVisible(known)
        self.bars.setVisible(known)
        is_calm = explanation is not None and explanation.is_calm
        self.calm.setVisible(is_calm)
        self._rows.setVisible(not is_calm)
        if explanation is None:
            self.words.setText(view.problem or _NOWHERE)
            return
        self.words.setText(" ".join(explanation.sentences))
        at = view.t_text(explanation.t)
        together = ", together" if explanation.adds_up else ";"
        self.title.setText(f"Weights at t = {at}{together} Λ(t) = {short(explanation.lebesgue)}")
        self.bars.render_pulls(explanation.pulls, len(view.source.points))
        self.calm.setText(_calm_words(explanation))

    def render_cures(self, cures: Cures | None, *, busy: bool) -> None:
        """Show the effect of each cure; muted while cures are being tried."""
        for row, (key, _, tip, *_) in enumerate(CURES):
            cure = cures.cures[row] if cures is not None else None
            self.buttons[key].setEnabled(cure is not None and cure.document is not None)
            self.buttons[key].setStatusTip(cure.problem or tip if cure is not None else tip)
            swing, lebesgue = self._effects[key]
            for label, text in ((swing, _swing(cure, cures)), (lebesgue, _lebesgue(cure))):
                label.setText(text)
                label.setEnabled(not busy)
        now = ("", "") if cures is None else (short(cures.overshoot), _finite(cures.lebesgue))
        texts = ("trying cures…" if busy else "Possible cures", f"Overshoot {now[0]} →", f"Λ {now[1]} →")
        for heading, text in zip(self._headings, texts, strict=True):
            heading.setText(text)


def _calm_words(explanation: Explanation) -> str:
    within = short(explanation.overshoot)
    return f"Nothing to cure here: the curve stays within {within} of the straight line between its points."


def _finite(value: float) -> str:
    return short(value) if math.isfinite(value) else ""


def _swing(cure: Cure | None, cures: Cures | None) -> str:
    if cure is None or cures is None:
        return ""
    if cure.document is None:
        return "in use" if cure.is_in_use else "same curve" if cure.is_same else "not possible"
    return f"{'worse, ' if cure.is_worse(cures.overshoot) else ''}{short(cure.overshoot)}"


def _lebesgue(cure: Cure | None) -> str:
    return _finite(cure.lebesgue) if cure is not None else ""
