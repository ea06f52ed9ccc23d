"""The joint certificate, the smoothness of the curve at each joint: summary, table, and a joint in words."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from typing import Any

from PySide6.QtCore import (
    QAbstractTableModel,
    QEvent,
    QModelIndex,
    QObject,
    QPersistentModelIndex,
    QSize,
    Qt,
    Signal,
)
from PySide6.QtGui import QAction, QKeyEvent, QKeySequence, QResizeEvent, QShowEvent
from PySide6.QtWidgets import QAbstractItemView, QTableView, QWidget

from ...appearance.theme import LIGHT, FollowsTheme, Theme
from ...document.words import number
from ...qt.labels import MUTED, Label
from ...qt.overrides import ENTER, ClaimsKeys, SafeOverrides
from ...view_model.analysis.joints import Certificate, JointKind, JointRow, angle_text
from ...widgets.boxes import column_of, row_of
from ...widgets.controls import action_button, named
from ...widgets.fields import fit_row_height, set_up_number_table
from ...widgets.number_text import decimal_mark

COLUMNS = ("Joint", "Class", "c", "c′", "c″", "c‴", "∠", "κ")
_TIPS = (
    "The joint, by its point: ✓ smooth, ? not decided, △ acceleration jumps, ◇ speed jumps, ▲ corner",
    "Parametric continuity C of the motion; geometric continuity G of the line, where higher",
    "Jump of the point",
    "Jump of the velocity: length of the difference, after minus before",
    "Jump of the acceleration: length of the difference, after minus before",
    "Jump of the jerk: length of the difference, after minus before",
    "Angle between the tangents before and after",
    "Jump of the curvature, after minus before",
)
_BAD = (JointKind.CORNER, JointKind.BREAK)
_DIGITS = 3, 2
"""Digits of jumps, and those in a table that is too narrow for them."""
_LEAST_EXPONENT = 1e4
"""Size of a jump from which on it may have an exponent."""


_Index = QModelIndex | QPersistentModelIndex


class JointsModel(SafeOverrides, QAbstractTableModel):
    """Joints for a table view; read only.

    Attributes
    ----------
    digits
        Significant digits of jumps.
    """

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.rows: Sequence[JointRow] = ()
        self.digits = _DIGITS[0]
        self.theme: Theme = LIGHT

    def render(self, rows: Sequence[JointRow]) -> None:
        """Show joints; where there are as many as before, the selection stays."""
        if len(rows) != len(self.rows):
            self.beginResetModel()
            self.rows = rows
            self.endResetModel()
        elif rows:
            self.rows = rows
            self.dataChanged.emit(self.index(0, 0), self.index(len(rows) - 1, len(COLUMNS) - 1))

    def rowCount(self, parent: _Index | None = None) -> int:
        return 0 if parent is not None and parent.isValid() else len(self.rows)

    def columnCount(self, parent: _Index | None = None) -> int:
        return 0 if parent is not None and parent.isValid() else len(COLUMNS)

    def data(self, index: _Index, role: int = Qt.ItemDataRole.DisplayRole) -> Any:  # noqa: ANN401
        """Return the text, colour, alignment or tooltip of a cell."""
        row = self.rows[index.row()]
        match role:
            case Qt.ItemDataRole.DisplayRole:
                return self.texts(row)[index.column()]
            case Qt.ItemDataRole.TextAlignmentRole:
                side = Qt.AlignmentFlag.AlignLeft if index.column() < 2 else Qt.AlignmentFlag.AlignRight
                return side | Qt.AlignmentFlag.AlignVCenter
            case Qt.ItemDataRole.ForegroundRole:
                if row.kind in _BAD and index.column() < 2:
                    return self.theme.warning
                return self.theme.muted if self.texts(row)[index.column()] == "0" else None
            case Qt.ItemDataRole.ToolTipRole | Qt.ItemDataRole.AccessibleDescriptionRole:
                return row.words
        return None

    def headerData(
        self, section: int, orientation: Qt.Orientation, role: int = Qt.ItemDataRole.DisplayRole
    ) -> Any:  # noqa: ANN401
        """Return the title or tooltip of a column."""
        if orientation is not Qt.Orientation.Horizontal:
            return None
        match role:
            case Qt.ItemDataRole.DisplayRole:
                return COLUMNS[section]
            case Qt.ItemDataRole.ToolTipRole:
                return _TIPS[section]
            case Qt.ItemDataRole.TextAlignmentRole:
                side = Qt.AlignmentFlag.AlignLeft if section < 2 else Qt.AlignmentFlag.AlignRight
                return side | Qt.AlignmentFlag.AlignVCenter
        return None

    def texts(self, row: JointRow) -> tuple[str, ...]:
        """Return the texts of a row."""
        mark = decimal_mark()

        def written(value: float) -> str:
            # Four digits before the mark are no longer than two with an exponent.
            return number(value, self.digits, mark, step=float(abs(value) < _LEAST_EXPONENT))

        *jumps, angle, curvature, _ = row.written(written)
        if row.angle > 0.0:
            angle = angle_text(row.angle, self.digits, mark)
        return (f"{row.kind.value} {row.joint}", row.smoothness, *jumps, angle, curvature)


_PADDING = 5
_DETAIL_LINES, _LEAST_ROWS = 4, 3
_HOW = "Click a joint, or press Enter, to zoom to it."


class JointsView(ClaimsKeys, QTableView):
    """The table of joints.

    Signals
    -------
    visited
        A row was clicked, or Enter was pressed in it.
    copy_requested
        The keys for Copy were pressed.
    """

    visited = Signal(int)
    copy_requested = Signal()

    def __init__(self, model: JointsModel) -> None:
        super().__init__()
        named(self, "jointsTable", "Joints")
        self.setModel(model)
        self.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.setTabKeyNavigation(False)
        set_up_number_table(self, _PADDING)
        self.horizontalHeader().setObjectName("jointsColumns")
        self.horizontalHeader().setMinimumSectionSize(18)
        self.verticalHeader().hide()
        self._joints, self._needed = model, list[int]()
        self.clicked.connect(lambda index: self.visited.emit(index.row()))
        self.verticalScrollBar().valueChanged.connect(lambda: self.fit_columns(anew=False))

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange and hasattr(self, "_needed"):
            fit_row_height(self)
            self.fit_columns(anew=True)

    def fit_columns(self, *, anew: bool) -> None:
        """Give each column the width of its texts, and a share of the rest.

        Unless `anew`, no column becomes narrower while there is room, so that nothing moves in a drag.
        """
        across, room, before = self.horizontalHeader(), self.viewport().width(), self._needed
        for self._joints.digits in _DIGITS:
            self._needed = self._needed_widths()
            if sum(self._needed) <= room:
                break
        if before and not anew and sum(kept := list(map(max, self._needed, before))) <= room:
            self._needed = kept
        # The jumps of the highest orders are cut to "1.8…" before κ leaves the table.
        for column in (5, 4, 3):
            excess = max(sum(self._needed) - room, 0)
            self._needed[column] -= min(excess, self._needed[column] * 3 // 5)
        # Joint and class are read from the left.
        spare = max(room - sum(self._needed), 0) // (len(COLUMNS) - 2)
        for column, width in enumerate(self._needed):
            across.resizeSection(column, width + (spare if column > 1 else 0))

    def _needed_widths(self) -> list[int]:
        """Return the widths of the widest texts in sight with padding, titles included."""
        advance, first = self.fontMetrics().horizontalAdvance, self.verticalScrollBar().value()
        last = first + self.viewport().height() // self.verticalHeader().defaultSectionSize() + 1
        rows = [COLUMNS, *map(self._joints.texts, self._joints.rows[first:last])]
        return [max(map(advance, set(texts))) + 2 * _PADDING + 2 for texts in zip(*rows, strict=True)]

    def sizeHint(self) -> QSize:
        # Qt's own, of 192 pixels, would make the panel scroll as a whole, where the table scrolls by itself.
        rows = self.horizontalHeader().height() + _LEAST_ROWS * self.verticalHeader().defaultSectionSize()
        return QSize(self.minimumSizeHint().width(), rows)

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self.fit_columns(anew=True)

    def claims(self, event: QKeyEvent) -> bool:
        # Where a shortcut of the window is also one of the widget, Qt does nothing at all.
        return event.matches(QKeySequence.StandardKey.Copy)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.matches(QKeySequence.StandardKey.Copy):
            self.copy_requested.emit()
        elif event.key() in ENTER and self.currentIndex().isValid():
            self.visited.emit(self.currentIndex().row())
        else:
            super().keyPressEvent(event)


class JointsPanel(FollowsTheme, QWidget):
    """Summary, table, and the selected joint in words.

    Signals
    -------
    visited
        A joint was clicked, to zoom to it: its `JointRow`.
    became_visible
        The panel became visible.
    """

    visited = Signal(object)
    became_visible = Signal()

    def __init__(self, copy: QAction, match: QAction, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("jointsPanel")
        self._model = JointsModel(self)
        self._points: Collection[int] = ()
        self._t_text: Callable[[float, str], str] = lambda t, _mark: str(t)
        self.view = JointsView(self._model)
        self._summary = Label(name="jointsSummary", label="Summary of the joints", wordWrap=True)
        self._summary.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self._detail = Label(
            name="jointsDetail", label="The selected joint in words", wordWrap=True, role=MUTED
        )
        self._detail.setAlignment(Qt.AlignmentFlag.AlignTop | Qt.AlignmentFlag.AlignLeft)
        # It keeps its height, whatever its text.
        self._detail.setMinimumHeight(self.fontMetrics().lineSpacing() * _DETAIL_LINES)
        self._copy = action_button(copy, name="copyJoints", icon_size=0, flat=True)
        self._match = action_button(match, name="matchCurvatureInJoints", flat=True)
        self._spare = QWidget()
        self._spare.hide()
        top = Qt.AlignmentFlag.AlignTop
        head = row_of((self._summary, 1), (self._match, top), (self._copy, top), margins=(12, 8, 8, 6))
        foot = column_of(self._detail, margins=(12, 6, 12, 8))
        column_of(head, (self.view, 1), foot, (self._spare, 1), margins=0, spacing=0, parent=self)
        self.follow_theme()
        self.view.visited.connect(lambda row: self.visited.emit(self._model.rows[row]))
        self.view.copy_requested.connect(copy.trigger)
        self.view.selectionModel().currentChanged.connect(self._show_detail)
        self._show_detail()

    def render_certificate(self, certificate: Certificate, t_text: Callable[[float, str], str]) -> None:
        """Show a certificate, with parameters written by `t_text`; without joints only its summary."""
        self._t_text = t_text
        is_new = len(certificate.rows) != len(self._model.rows)
        self._model.render(certificate.rows)
        self.view.fit_columns(anew=is_new)
        has_rows = bool(certificate.rows)
        # The worst of all joints; kinds are listed from smooth to broken.
        worst = max(
            (row.kind for row in certificate.rows), key=list(JointKind).index, default=JointKind.SMOOTH
        )
        sign = f"{worst.value} " if has_rows else ""
        self._summary.setText(sign + certificate.summary)
        for part in (self.view, self._detail):
            part.setVisible(has_rows)
        self._spare.setVisible(not has_rows)
        self._copy.setVisible(has_rows)
        self._match.setVisible(has_rows)
        self._show_detail()

    def set_selection(self, points: Collection[int]) -> None:
        """Select the joint of the selected point, where there is just one; none after another selection."""
        is_new, self._points = points != self._points, points
        found = next((n for n, row in enumerate(self._model.rows) if {row.joint} == points), None)
        if found is None and is_new:
            self.view.selectionModel().clear()
        elif found is not None and self.view.currentIndex().row() != found:
            self.view.setCurrentIndex(self._model.index(found, 0))

    def _show_detail(self, _current: QModelIndex | None = None, _previous: QModelIndex | None = None) -> None:
        row_number = self.view.currentIndex().row()
        if not 0 <= row_number < len(self._model.rows):
            self._detail.setText(_HOW)
            return
        row = self._model.rows[row_number]
        t = self._t_text(row.t, decimal_mark())
        # Only a closed curve has a joint at its first point.
        where = f"Joint {row.joint} at t = {t}" if row.joint else "Joint 0, where the curve closes"
        facts = " · ".join(filter(None, (row.smoothness, row.measured)))
        self._detail.setText(f"{row.kind.value} {where}: {facts}\n{row.words}")

    def set_theme(self, theme: Theme) -> None:
        self._model.theme = theme
        self.view.viewport().update()

    def showEvent(self, event: QShowEvent) -> None:
        super().showEvent(event)
        self.became_visible.emit()
