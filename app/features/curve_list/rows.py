"""Rows of the list of curves: their parts, how they are painted, and how names are edited."""

from __future__ import annotations

from enum import Enum

from PySide6.QtCore import QModelIndex, QPersistentModelIndex, QPoint, QPointF, QRect, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QPainter, QPen
from PySide6.QtWidgets import QLineEdit, QListView, QStyledItemDelegate, QStyleOptionViewItem, QWidget

from ...appearance.colours import draw_style
from ...appearance.icons import icon
from ...appearance.theme import Theme, mix, theme_of
from ...document.groups import Node, NodeKind
from ...qt.overrides import SafeOverrides
from ...view_model.palette import adjustment_of
from ...widgets.controls import named
from .model import CurveListModel, Entry, Row

INDENT = 14
"""Pixels by which what is in a shape or group stands to the right of it; as wide is what opens it."""

ICON, SWATCH = 16, 12
"""Pixels of an icon, and of the swatch of a curve."""

_PAD = 8


class Spot(Enum):
    """Part of a row that can be clicked."""

    SWATCH = "swatch"
    NAME = "name"
    LOCK = "lock"
    EYE = "eye"


def spot_rect(row: QRect, spot: Spot) -> QRect:
    """Return the rectangle of a part of a row."""
    side, top = ICON + _PAD, row.top()
    left = {
        Spot.SWATCH: row.left(),
        Spot.LOCK: row.right() - 2 * side - _PAD // 2,
        Spot.EYE: row.right() - side - _PAD // 2,
    }
    if spot is Spot.NAME:
        start = row.left() + SWATCH + 2 * _PAD
        return QRect(start, top, left[Spot.LOCK] - start, row.height())
    width = SWATCH + 2 * _PAD if spot is Spot.SWATCH else side
    return QRect(left[spot], top, width, row.height())


class RowParts:
    """Geometry of rows and their parts in the viewport of a list."""

    def __init__(self, view: QListView, model: CurveListModel) -> None:
        self._view, self._model = view, model

    def entry_rect(self, row: int) -> QRect:
        """Return the rectangle of the parts of a row."""
        rect = self._view.visualRect(self._model.index(row))
        if self._model.has_folds:
            rect.setLeft(rect.left() + INDENT * (1 + self._model.entries[row].node.depth))
        return rect

    def row_rect(self, position: int) -> QRect:
        """Return the rectangle of the row of a curve, or of the folded entry that contains it."""
        return self.entry_rect(self._model.row_of(position))

    def opener_rect(self, row: int) -> QRect:
        """Return the rectangle of the arrow that opens a row."""
        rect = self.entry_rect(row)
        return QRect(rect.left() - INDENT + 2, rect.top(), INDENT, rect.height())

    def row_at(self, position: QPoint) -> int:
        """Return the row at a position; −1 for none."""
        return self._view.indexAt(position).row()

    def node_at(self, position: QPoint) -> Node | None:
        """Return the node of the row at a position."""
        row = self.row_at(position)
        return self._model.entries[row].node if row >= 0 else None

    def is_on_opener(self, position: QPoint) -> bool:
        """Return whether a click at a position opens or folds a row."""
        row = self.row_at(position)
        return row >= 0 and self._model.entries[row].opens and position.x() < self.entry_rect(row).left()

    def spot_at(self, position: QPoint) -> Spot:
        """Return the part of a row at a position."""
        row = self.row_at(position)
        for spot in (Spot.SWATCH, Spot.LOCK, Spot.EYE):
            if spot_rect(self.entry_rect(row), spot).contains(position):
                return spot
        return Spot.NAME

    def tip_at(self, position: QPoint) -> str:
        """Return the tip about a click at a position."""
        number = self.row_at(position)
        if number < 0:
            return self._view.toolTip()
        row, entry = self._model.row(number), self._model.entries[number]
        if self.is_on_opener(position):
            return f"{'Fold' if entry.is_open else 'Open'} “{row.name}” (Left, Right)"
        theme = theme_of(self._view.palette())
        return _spot_tip(self.spot_at(position), row, theme)


def _spot_tip(spot: Spot, row: Row, theme: Theme) -> str:
    moved = adjustment_of(theme.paper.name(), row.style.colour)
    tips = {
        Spot.SWATCH: f"Set the colour of “{row.name}”" + (f"; it is {moved}" if moved else ""),
        Spot.NAME: f"“{row.name}”: {row.facts}. Double-click to rename, drag to reorder;"
        " right-click › Edit Curve shows its points.",
        Spot.LOCK: f"{'Unlock' if row.locked else 'Lock'} “{row.name}”",
        Spot.EYE: f"{'Hide' if row.visible else 'Show'} “{row.name}”",
    }
    return tips[spot]


Index = QModelIndex | QPersistentModelIndex

_BAR, _DOT = 3, 3.0


class RowDelegate(SafeOverrides, QStyledItemDelegate):
    """Delegate that paints a row and edits its name."""

    def __init__(self, view: QListView, model: CurveListModel, parts: RowParts) -> None:
        super().__init__(view)
        self._view, self._model, self._parts = view, model, parts

    def paint(self, painter: QPainter, option: QStyleOptionViewItem, index: Index) -> None:
        """Paint a row; called by Qt."""
        model, number, theme = self._model, index.row(), theme_of(self._view.palette())
        entry, row = model.entries[number], model.row(number)
        painter.save()
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, True)
        self._paint_marks(painter, option.rect, number, theme)
        rect = self._parts.entry_rect(number)
        if entry.opens:
            opener = "fold-open" if entry.is_open else "fold"
            self._paint_switch(painter, self._parts.opener_rect(number), opener, True)
        self._paint_swatch(painter, spot_rect(rect, Spot.SWATCH), entry, row, theme)
        font = painter.font()
        font.setBold(model.marks.is_active(entry))
        painter.setFont(font)
        painter.setPen(theme.ink if row.visible else theme.muted)
        name = spot_rect(rect, Spot.NAME)
        if model.marks.contains_selected(entry):
            name.setRight(name.right() - ICON)
        elided = painter.fontMetrics().elidedText(row.name, Qt.TextElideMode.ElideRight, name.width())
        painter.drawText(name, int(Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignLeft), elided)
        lock, eye = "lock" if row.locked else "unlock", "eye" if row.visible else "eye-off"
        self._paint_switch(painter, spot_rect(rect, Spot.LOCK), lock, row.locked)
        self._paint_switch(painter, spot_rect(rect, Spot.EYE), eye, row.visible)
        painter.restore()

    def _paint_marks(self, painter: QPainter, line: QRect, number: int, theme: Theme) -> None:
        """Mark edited and selected entries, and fainter the folded entries that contain them."""
        model, entry = self._model, self._model.entries[number]
        share = 0.2 if self._view.hasFocus() else 0.12
        if model.marks.is_active(entry) or model.marks.is_selected(entry):
            painter.fillRect(line, mix(theme.accent, theme.paper, share))
        elif model.marks.contains_selected(entry):
            painter.fillRect(line, mix(theme.accent, theme.paper, share / 2))
            name = QRectF(spot_rect(self._parts.entry_rect(number), Spot.NAME))
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(theme.accent)
            painter.drawEllipse(QPointF(name.right() - ICON / 2, name.center().y()), _DOT, _DOT)
        if model.marks.is_active(entry) and model.marks.is_selected_whole(entry):
            painter.fillRect(QRect(line.left(), line.top(), _BAR, line.height()), theme.accent)

    def _paint_swatch(self, painter: QPainter, swatch: QRect, entry: Entry, row: Row, theme: Theme) -> None:
        model = self._model
        if model.marks.is_selected_whole(entry):
            self._paint_ring(painter, swatch, theme.accent)
        if entry.node.kind is NodeKind.GROUP:
            # Curves of a group may have different styles.
            self._paint_switch(painter, swatch, "group", True)
        else:
            draw_style(painter, QRectF(swatch).center(), SWATCH, row.style, theme)

    @staticmethod
    def _paint_ring(painter: QPainter, rect: QRect, colour: QColor) -> None:
        """Mark a curve that is selected with others, by more than a background colour."""
        ring = QRectF(0, 0, SWATCH + 6, SWATCH + 6)
        ring.moveCenter(QRectF(rect).center())
        painter.setPen(QPen(colour, 1.5))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.drawEllipse(ring)

    def _paint_switch(self, painter: QPainter, rect: QRect, name: str, on: bool) -> None:
        position = QRect(0, 0, ICON, ICON)
        position.moveCenter(rect.center())
        # The usual state is drawn faintly.
        painter.setOpacity(1.0 if on else 0.45)
        icon(name, theme_of(self._view.palette())).paint(painter, position)
        painter.setOpacity(1.0)

    def sizeHint(self, option: QStyleOptionViewItem, index: Index) -> QSize:
        return QSize(120, option.fontMetrics.height() + 12)

    def createEditor(self, parent: QWidget, option: QStyleOptionViewItem, index: Index) -> QWidget:
        what = self._model.entries[index.row()].node.kind.name.lower()
        tip = f"Name of the {what} (Enter to set, Escape to cancel)"
        return named(QLineEdit(parent), "curveNameEditor", f"Name of the {what}", tip)

    def updateEditorGeometry(self, editor: QWidget, option: QStyleOptionViewItem, index: Index) -> None:
        rect = self._parts.entry_rect(index.row())
        editor.setGeometry(spot_rect(rect, Spot.NAME).adjusted(-4, 1, 0, -1))
