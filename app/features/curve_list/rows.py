"""Rows of the list of curves: a swatch, a name, a lock and an eye, and how names are edited."""

from __future__ import annotations

from enum import Enum
from typing import TYPE_CHECKING

from PySide6.QtCore import QModelIndex, QPersistentModelIndex, QRect, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QPainter, QPen
from PySide6.QtWidgets import QLineEdit, QStyledItemDelegate, QStyleOptionViewItem, QWidget

from ...appearance.icons import icon
from ...appearance.swatches import draw_style
from ...appearance.theme import Theme, mix, theme_of
from ...document.curve_tree import NodeKind
from ...qt.overrides import Guarded
from ...view_model.palette import adjustment_of
from ...widgets.controls import named
from .dropping import Drop
from .model import Row

if TYPE_CHECKING:
    from .view import CurveListView

Index = QModelIndex | QPersistentModelIndex

_ICON, _PAD, _SWATCH, _BAR = 16, 8, 12, 3
INDENT = 14
"""Pixels by which what is in a shape or group stands to the right of it; as wide is what opens it."""


class Spot(Enum):
    """A part of a row that can be clicked."""

    SWATCH = "swatch"
    NAME = "name"
    LOCK = "lock"
    EYE = "eye"


def spot_rect(row: QRect, spot: Spot) -> QRect:
    """Return where in a row a part of it lies."""
    side, top = _ICON + _PAD, row.top()
    left = {
        Spot.SWATCH: row.left(),
        Spot.LOCK: row.right() - 2 * side - _PAD // 2,
        Spot.EYE: row.right() - side - _PAD // 2,
    }
    if spot is Spot.NAME:
        start = row.left() + _SWATCH + 2 * _PAD
        return QRect(start, top, left[Spot.LOCK] - start, row.height())
    width = _SWATCH + 2 * _PAD if spot is Spot.SWATCH else side
    return QRect(left[spot], top, width, row.height())


class RowDelegate(Guarded, QStyledItemDelegate):
    """Paints a row, and edits its name in place."""

    def __init__(self, view: CurveListView) -> None:
        super().__init__(view)
        self._view = view

    def paint(self, painter: QPainter, option: QStyleOptionViewItem, index: Index) -> None:
        """Paint a row; called by Qt."""
        view, number = self._view, index.row()
        entry, row, theme = view.curves.entries[number], view.curves.row(number), theme_of(view.palette())
        is_active, is_chosen = view.shows_edited(entry), view.curves.is_chosen(entry)
        is_one_of_many = is_chosen and (len(view.selected) > 1 or not view.is_editing)
        if is_active or is_chosen:
            painter.fillRect(option.rect, mix(theme.accent, theme.paper, 0.2 if view.hasFocus() else 0.12))
        if is_active and is_one_of_many:
            painter.fillRect(
                QRect(option.rect.left(), option.rect.top(), _BAR, option.rect.height()), theme.accent
            )
        painter.save()
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, True)
        rect = view.entry_rect(number)
        if entry.opens:
            self._paint_switch(
                painter, view.opener_rect(number), "fold-open" if entry.is_open else "fold", True
            )
        swatch = spot_rect(rect, Spot.SWATCH)
        if is_one_of_many:
            self._paint_ring(painter, swatch, theme.accent)
        if entry.node.kind is NodeKind.LAYER:
            # That into which what is new comes is seen at once.
            self._paint_switch(painter, swatch, "layers", view.curves.is_layer_now(entry))
        elif entry.node.kind is NodeKind.GROUP:
            # What is in a group need not look the same.
            self._paint_switch(painter, swatch, "group", True)
        else:
            draw_style(painter, QRectF(swatch).center(), _SWATCH, row.style, theme)
        font = painter.font()
        font.setBold(is_active)
        painter.setFont(font)
        painter.setPen(theme.ink if row.visible else theme.muted)
        name = spot_rect(rect, Spot.NAME)
        elided = painter.fontMetrics().elidedText(row.name, Qt.TextElideMode.ElideRight, name.width())
        painter.drawText(name, int(Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignLeft), elided)
        lock, eye = "lock" if row.locked else "unlock", "eye" if row.visible else "eye-off"
        self._paint_switch(painter, spot_rect(rect, Spot.LOCK), lock, row.locked)
        self._paint_switch(painter, spot_rect(rect, Spot.EYE), eye, row.visible)
        painter.restore()

    @staticmethod
    def _paint_ring(painter: QPainter, rect: QRect, colour: QColor) -> None:
        """Mark what is selected with others, by more than a colour behind it."""
        ring = QRectF(0, 0, _SWATCH + 6, _SWATCH + 6)
        ring.moveCenter(QRectF(rect).center())
        painter.setPen(QPen(colour, 1.5))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.drawEllipse(ring)

    def _paint_switch(self, painter: QPainter, rect: QRect, name: str, on: bool) -> None:
        place = QRect(0, 0, _ICON, _ICON)
        place.moveCenter(rect.center())
        # What is as usual steps back.
        painter.setOpacity(1.0 if on else 0.45)
        icon(name, theme_of(self._view.palette())).paint(painter, place)
        painter.setOpacity(1.0)

    def sizeHint(self, option: QStyleOptionViewItem, index: Index) -> QSize:
        return QSize(120, option.fontMetrics.height() + 12)

    def createEditor(self, parent: QWidget, option: QStyleOptionViewItem, index: Index) -> QWidget:
        what = self._view.curves.entries[index.row()].node.kind.name.lower()
        tip = f"Name of the {what} (Enter to set, Escape to leave it)"
        return named(QLineEdit(parent), "curveNameEditor", f"Name of the {what}", tip)

    def updateEditorGeometry(self, editor: QWidget, option: QStyleOptionViewItem, index: Index) -> None:
        rect = self._view.entry_rect(index.row())
        editor.setGeometry(spot_rect(rect, Spot.NAME).adjusted(-4, 1, 0, -1))


def draw_drop(painter: QPainter, view: CurveListView, drop: Drop) -> None:
    """Draw where what is dragged would fall: a line between rows, or a frame around one."""
    last = view.curves.rowCount() - 1
    rect = view.visualRect(view.curves.index(min(drop.gap, last)))
    painter.setPen(QPen(theme_of(view.palette()).accent, 2))
    if drop.is_onto:
        painter.drawRect(rect.adjusted(2, 1, -2, -1))
        return
    y = max(rect.top() if drop.gap <= last else rect.bottom(), 1)
    left = 4 + INDENT * (1 + drop.container.depth) * view.curves.has_folds
    painter.drawLine(left, y, view.viewport().width() - 4, y)


def spot_tip(spot: Spot, row: Row, theme: Theme) -> str:
    """Return what a click on a part of a row does."""
    moved = adjustment_of(theme.paper.name(), row.style.colour)
    tips = {
        Spot.SWATCH: f"Choose the colour of “{row.name}”" + (f"; it is {moved}" if moved else ""),
        Spot.NAME: f"“{row.name}”: {row.facts}. Double-click to rename, drag to reorder.",
        Spot.LOCK: f"{'Unlock' if row.locked else 'Lock'} “{row.name}”",
        Spot.EYE: f"{'Hide' if row.visible else 'Show'} “{row.name}”",
    }
    return tips[spot]
