"""The joints as a table: a row for each, a column for each thing that may jump."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from PySide6.QtCore import QAbstractTableModel, QModelIndex, QObject, QPersistentModelIndex, Qt

from ...appearance.theme import LIGHT, Theme
from ...document.words import number
from ...qt.overrides import SafeOverrides
from ...view_model.analysis.joints import JointKind, JointRow
from ...widgets.number_text import decimal_mark

COLUMNS = ("Joint", "Class", "c", "c′", "c″", "c‴", "∠", "κ")
_TIPS = (
    "The joint, by its point: ✓ smooth, ? not decided, △ acceleration jumps, ◇ speed jumps, ▲ corner",
    "Parametric continuity C, of the motion; geometric continuity G, of the line, where it says more",
    "Jump of the point",
    "Jump of the velocity: the length of after minus before",
    "Jump of the acceleration: the length of after minus before",
    "Jump of the jerk: the length of after minus before",
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
        """Show these joints; where there are as many as before, what is chosen stays."""
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
        """Return what Qt asks for."""
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
        """Return what stands above a column."""
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
