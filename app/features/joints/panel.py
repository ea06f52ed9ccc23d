"""The joint certificate, the smoothness of the curve at each joint: summary, table, and a joint in words."""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence
from typing import Any

from PySide6.QtCore import QAbstractTableModel, QModelIndex, QObject, QPersistentModelIndex, Qt, Signal
from PySide6.QtGui import QAction, QFont, QKeyEvent, QKeySequence, QShowEvent
from PySide6.QtWidgets import QAbstractItemView, QHeaderView, QTableView, QWidget

from ...appearance.theme import LIGHT, FollowsTheme, Theme
from ...document.words import number
from ...qt.labels import Label
from ...qt.overrides import ENTER, ClaimsKeys, SafeOverrides
from ...view_model.analysis.joints import Certificate, JointKind, JointRow
from ...widgets.boxes import column_of, row_of
from ...widgets.controls import action_button, named
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
_DIGITS = 3

_Index = QModelIndex | QPersistentModelIndex


class JointsModel(SafeOverrides, QAbstractTableModel):
    """Joints for a table view; read only."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.rows: Sequence[JointRow] = ()
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
                return self._texts(row)[index.column()]
            case Qt.ItemDataRole.TextAlignmentRole:
                side = Qt.AlignmentFlag.AlignLeft if index.column() < 2 else Qt.AlignmentFlag.AlignRight
                return side | Qt.AlignmentFlag.AlignVCenter
            case Qt.ItemDataRole.ForegroundRole:
                if row.kind in _BAD and index.column() < 2:
                    return self.theme.warning
                return self.theme.muted if self._texts(row)[index.column()] == "0" else None
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

    def _texts(self, row: JointRow) -> tuple[str, ...]:
        mark = decimal_mark()
        *jumps, angle, curvature, _ = row.written(lambda value: number(value, _DIGITS, mark))
        is_angle = math.isfinite(row.angle) and angle != "0"
        return (
            f"{row.kind.value} {row.joint}",
            row.smoothness,
            *jumps,
            f"{angle}°" if is_angle else angle,
            curvature,
        )


_PADDING = 5
_DETAIL_LINES = 4
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
        self.setShowGrid(False)
        self.setWordWrap(False)
        self.setTabKeyNavigation(False)
        font = QFont(self.font())
        font.setFeature(QFont.Tag("tnum"), 1)
        self.setFont(font)
        self._set_up_headers()
        self.clicked.connect(lambda index: self.visited.emit(index.row()))

    def _set_up_headers(self) -> None:
        across, down, metrics = self.horizontalHeader(), self.verticalHeader(), self.fontMetrics()
        across.setObjectName("jointsColumns")
        across.setHighlightSections(False)
        across.setMinimumSectionSize(18)
        across.setStyleSheet(f"QHeaderView::section {{ padding: 5px {_PADDING}px }}")
        across.setSectionResizeMode(QHeaderView.ResizeMode.Stretch)
        for column, widest in ((0, "Joint "), (1, "≥C⁰, G¹ "), (2, "c 0")):
            across.setSectionResizeMode(column, QHeaderView.ResizeMode.Fixed)
            across.resizeSection(column, metrics.horizontalAdvance(widest) + 2 * _PADDING)
        down.hide()
        down.setSectionResizeMode(QHeaderView.ResizeMode.Fixed)
        down.setDefaultSectionSize(metrics.height() + 8)

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

    def __init__(self, copy: QAction, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("jointsPanel")
        self._model = JointsModel(self)
        self.view = JointsView(self._model)
        self._summary = Label(name="jointsSummary", label="Summary of the joints", wordWrap=True)
        self._summary.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self._detail = Label(name="jointsDetail", label="The selected joint in words", wordWrap=True)
        self._detail.setAlignment(Qt.AlignmentFlag.AlignTop | Qt.AlignmentFlag.AlignLeft)
        # It keeps its height, whatever its text.
        self._detail.setMinimumHeight(self.fontMetrics().lineSpacing() * _DETAIL_LINES)
        self._copy = action_button(copy, name="copyJoints", icon_size=0, flat=True)
        self._spare = QWidget()
        self._spare.hide()
        head = row_of((self._summary, 1), (self._copy, Qt.AlignmentFlag.AlignTop), margins=(12, 8, 8, 6))
        foot = column_of(self._detail, margins=(12, 6, 12, 8))
        column_of(head, (self.view, 1), foot, (self._spare, 1), margins=0, spacing=0, parent=self)
        self.follow_theme()
        self.view.visited.connect(lambda row: self.visited.emit(self._model.rows[row]))
        self.view.copy_requested.connect(copy.trigger)
        self.view.selectionModel().currentChanged.connect(self._show_detail)
        self._show_detail()

    @property
    def summary(self) -> str:
        """The sentence above the table."""
        return self._summary.text()

    @property
    def rows(self) -> list[JointRow]:
        """Rows of the table."""
        return list(self._model.rows)

    def render_certificate(self, certificate: Certificate) -> None:
        """Show a certificate; without joints only its summary."""
        self._model.render(certificate.rows)
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
        self._show_detail()

    def set_selection(self, points: Collection[int]) -> None:
        """Select the joint of the selected point, where there is just one."""
        if len(points) != 1:
            return
        point = next(iter(points))
        for row_number, row in enumerate(self._model.rows):
            if row.joint == point:
                if self.view.currentIndex().row() != row_number:
                    self.view.setCurrentIndex(self._model.index(row_number, 0))
                return

    def _show_detail(self, _current: QModelIndex | None = None, _previous: QModelIndex | None = None) -> None:
        row_number = self.view.currentIndex().row()
        if not 0 <= row_number < len(self._model.rows):
            self._detail.setText(_HOW)
            return
        row = self._model.rows[row_number]
        t = number(row.t, 4, decimal_mark())
        # Only a closed curve has a joint at its first point.
        where = f"Joint {row.joint} at t = {t}" if row.joint else "Joint 0, where the curve closes"
        facts = " · ".join(filter(None, (row.smoothness, row.measured)))
        self._detail.setText(f"{row.kind.value} {where}: {facts}\n{row.words}")

    def set_theme(self, theme: Theme) -> None:
        self._model.theme = theme
        self._detail.setStyleSheet(f"color: {theme.muted.name()}")
        self.view.viewport().update()

    def showEvent(self, event: QShowEvent) -> None:
        super().showEvent(event)
        self.became_visible.emit()
