"""The list widget of the curves: rows with a swatch, a name, a lock and an eye, dragged to another place."""

from __future__ import annotations

from enum import Enum

from PySide6.QtCore import (
    QEvent,
    QModelIndex,
    QPersistentModelIndex,
    QPoint,
    QRect,
    QRectF,
    QSize,
    Qt,
    Signal,
)
from PySide6.QtGui import (
    QColor,
    QHelpEvent,
    QKeyEvent,
    QKeySequence,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPen,
)
from PySide6.QtWidgets import (
    QAbstractItemView,
    QApplication,
    QLineEdit,
    QListView,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QToolTip,
    QWidget,
)

from ...appearance.colours import curve_colour
from ...appearance.icons import icon
from ...appearance.theme import mix, theme_of
from ...qt.keys import DELETE, ENTER, ClaimsKeys
from ...qt.labels import tip_of
from ...qt.overrides import Guarded
from ...view_model.palette import adjustment_of
from ...widgets.controls import named
from .model import CurveListModel, Row

Index = QModelIndex | QPersistentModelIndex

_ICON, _PAD, _SWATCH, _BAR = 16, 8, 12, 3
_RENAME = (Qt.Key.Key_F2, *ENTER)
_STEPS = {Qt.Key.Key_Up: 1, Qt.Key.Key_Down: -1}
"""Steps to the next curve of the document: the list has the one in front at the top."""

_ALL = QKeySequence.StandardKey.SelectAll


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


class _RowDelegate(Guarded, QStyledItemDelegate):
    """Paints a row, and edits its name in place."""

    def __init__(self, view: CurveListView) -> None:
        super().__init__(view)
        self._view = view

    def paint(self, painter: QPainter, option: QStyleOptionViewItem, index: Index) -> None:
        """Paint a row; called by Qt."""
        place = self._view.curves.place_of(index)
        theme, row = theme_of(self._view.palette()), self._view.curves.row(place)
        rect: QRect = option.rect
        is_active, is_chosen = place == self._view.active, place in self._view.selected
        is_one_of_many = is_chosen and len(self._view.selected) > 1
        if is_active or is_chosen:
            painter.fillRect(rect, mix(theme.accent, theme.paper, 0.2 if self._view.hasFocus() else 0.12))
        if is_active and is_one_of_many:
            painter.fillRect(QRect(rect.left(), rect.top(), _BAR, rect.height()), theme.accent)
        painter.save()
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, True)
        swatch = spot_rect(rect, Spot.SWATCH)
        if is_one_of_many:
            self._paint_ring(painter, swatch, theme.accent)
        self._paint_swatch(painter, swatch, curve_colour(row.colour, theme))
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
    def _paint_swatch(painter: QPainter, rect: QRect, colour: QColor) -> None:
        disc = QRectF(0, 0, _SWATCH, _SWATCH)
        disc.moveCenter(QRectF(rect).center())
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(colour)
        painter.drawEllipse(disc)

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
        tip = "Name of the curve (Enter to set, Escape to leave it)"
        return named(QLineEdit(parent), "curveNameEditor", "Name of the curve", tip)

    def updateEditorGeometry(self, editor: QWidget, option: QStyleOptionViewItem, index: Index) -> None:
        rect: QRect = option.rect
        editor.setGeometry(spot_rect(rect, Spot.NAME).adjusted(-4, 1, 0, -1))


class CurveListView(ClaimsKeys, QListView):
    """Reports what the person did; which row is the active one comes from the session.

    A row is named by the place of its curve in the document, wherever it stands in the list.

    Signals
    -------
    activated_row
        A row was clicked or walked to.
    rows_selected
        These rows shall be worked on together (a set of numbers).
    spot_clicked
        The swatch, the lock or the eye of a row was clicked (row, Spot).
    moved
        A row was dragged to another place (from, to).
    deletion_wanted
        The selected curves shall be deleted.
    """

    activated_row = Signal(int)
    rows_selected = Signal(object)
    spot_clicked = Signal(int, object)
    moved = Signal(int, int)
    deletion_wanted = Signal()

    def __init__(self, model: CurveListModel, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.curves = model
        self.active = 0
        self.selected: frozenset[int] = frozenset()
        # Where choosing row by row has come to, from the active one.
        self._reached = 0
        self._press: QPoint | None = None
        self._pressed_row = -1
        self._gap: int | None = None
        self.setModel(model)
        tip = (
            "The curve in front is at the top. Click a curve to edit it, double-click to rename it,"
            " drag it to another place; Ctrl or Shift+click chooses several"
        )
        named(self, "curveList", "Curves", tip)
        self._delegate = _RowDelegate(self)
        self.setItemDelegate(self._delegate)
        self.setFrameShape(QListView.Shape.NoFrame)
        self.setSelectionMode(QAbstractItemView.SelectionMode.NoSelection)
        self.setEditTriggers(QAbstractItemView.EditTrigger.EditKeyPressed)
        self.setUniformItemSizes(True)
        self.setMouseTracking(True)

    def show_active(self, row: int, selected: frozenset[int]) -> None:
        """Mark the row of the active curve, and those that are selected."""
        changed, self.active, self.selected = row != self.active, row, selected
        if self._reached not in selected:
            self._reached = row
        index = self.curves.index_of(row)
        if self.currentIndex() != index:
            self.setCurrentIndex(index)
        if changed:
            self.scrollTo(index)
        self.viewport().update()

    def edit_name(self, row: int) -> None:
        """Let the person type another name; one that is being typed is taken as it is."""
        editor = self.viewport().findChild(QLineEdit)
        if self.state() == QListView.State.EditingState and editor is not None:
            self.commitData(editor)
            self.closeEditor(editor, QStyledItemDelegate.EndEditHint.NoHint)
        self.edit(self.curves.index_of(row))

    def row_rect(self, row: int) -> QRect:
        """Return where a row lies in the viewport."""
        return self.visualRect(self.curves.index_of(row))

    def _row_at(self, place: QPoint) -> int:
        return self.curves.place_of(self.indexAt(place))

    def spot_at(self, place: QPoint) -> Spot:
        """Return the part of a row at a place of the viewport."""
        rect = self.row_rect(self._row_at(place))
        for spot in (Spot.SWATCH, Spot.LOCK, Spot.EYE):
            if spot_rect(rect, spot).contains(place):
                return spot
        return Spot.NAME

    # Mouse: a click activates or switches, a drag moves the row

    @property
    def is_dragging(self) -> bool:
        """Whether a row is being dragged."""
        return self._gap is not None

    def mousePressEvent(self, event: QMouseEvent) -> None:
        self._press, self._pressed_row = None, -1
        row = self._row_at(event.position().toPoint())
        if event.button() != Qt.MouseButton.LeftButton or row < 0:
            return
        spot = self.spot_at(event.position().toPoint())
        held = event.modifiers()
        if spot is not Spot.NAME:
            self.spot_clicked.emit(row, spot)
        elif held & Qt.KeyboardModifier.ControlModifier:
            self.rows_selected.emit(self.selected ^ {row})
        elif held & Qt.KeyboardModifier.ShiftModifier:
            self._choose_to(row)
        else:
            self._press, self._pressed_row = event.position().toPoint(), row
            self._reached = row
            if not self._is_of_several(row):
                self.activated_row.emit(row)

    def _is_of_several(self, row: int) -> bool:
        return row in self.selected and len(self.selected) > 1

    def _choose_to(self, row: int) -> None:
        """Choose from the active row to this one."""
        self._reached = max(0, min(row, self.curves.rowCount() - 1))
        low, high = sorted((self.active, self._reached))
        self.rows_selected.emit(frozenset(range(low, high + 1)))
        self.scrollTo(self.curves.index_of(self._reached))

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        place = event.position().toPoint()
        if self._press is None or not event.buttons() & Qt.MouseButton.LeftButton:
            return
        if self._gap is None and abs(place.y() - self._press.y()) < QApplication.startDragDistance():
            return
        self._gap = self._gap_at(place)
        self.viewport().update()

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        gap, place = self._gap, self._pressed_row
        self._end_drag()
        if gap is None and place >= 0 and self._is_of_several(place):
            # Not at the press: a drag takes all of them along.
            self.activated_row.emit(place)
        row = self.curves.index_of(place).row()
        if gap is not None and gap not in (row, row + 1):
            below = gap if gap < row else gap - 1
            self.moved.emit(place, self.curves.rowCount() - 1 - below)

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        place = event.position().toPoint()
        is_plain = not event.modifiers() & ~Qt.KeyboardModifier.KeypadModifier
        if is_plain and self._row_at(place) >= 0 and self.spot_at(place) is Spot.NAME:
            self.edit_name(self._row_at(place))
        else:
            self.mousePressEvent(event)

    def _gap_at(self, place: QPoint) -> int:
        """Return between which rows a drop would fall, by the number of the row below it, from the top."""
        top = self.visualRect(self.curves.index(0))
        gap = round((place.y() - top.top()) / max(top.height(), 1))
        return max(0, min(gap, self.curves.rowCount()))

    def _end_drag(self) -> None:
        self._press, self._pressed_row, self._gap = None, -1, None
        self.viewport().update()

    def paintEvent(self, event: QPaintEvent) -> None:
        super().paintEvent(event)
        if self._gap is None:
            return
        last = self.curves.rowCount() - 1
        rect = self.visualRect(self.curves.index(min(self._gap, last)))
        y = rect.top() if self._gap <= last else rect.bottom()
        painter = QPainter(self.viewport())
        painter.setPen(QPen(theme_of(self.palette()).accent, 2))
        painter.drawLine(4, max(y, 1), self.viewport().width() - 4, max(y, 1))
        painter.end()

    # Keys

    def event(self, event: QEvent) -> bool:
        if event.type() == QEvent.Type.WindowBlocked and self.is_dragging:
            # A dialog takes the mouse, and the release with it.
            self._end_drag()
        return super().event(event)

    def claims(self, event: QKeyEvent) -> bool:
        # Escape takes back a drag, F2 renames and Del deletes curves, before they are the window's.
        if event.key() == Qt.Key.Key_Escape:
            return self.is_dragging
        return event.key() in _RENAME or _deletes(event) or event.matches(_ALL)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        step = _STEPS.get(Qt.Key(event.key()))
        if event.key() == Qt.Key.Key_Escape and self.is_dragging:
            self._end_drag()
        elif event.matches(_ALL):
            self.rows_selected.emit(frozenset(range(self.curves.rowCount())))
        elif step is not None and event.modifiers() & Qt.KeyboardModifier.ShiftModifier:
            self._choose_to(self._reached + step)
        elif step is not None and not event.modifiers() & ~Qt.KeyboardModifier.KeypadModifier:
            self.activated_row.emit(max(0, min(self.active + step, self.curves.rowCount() - 1)))
        elif event.key() in _RENAME and self.state() != QAbstractItemView.State.EditingState:
            self.edit_name(self.active)
        elif _deletes(event):
            self.deletion_wanted.emit()
        else:
            # Everything else is for the window's shortcuts; the list's own search by letters would eat them.
            event.ignore()

    def viewportEvent(self, event: QEvent) -> bool:
        if isinstance(event, QHelpEvent) and event.type() == QEvent.Type.ToolTip:
            QToolTip.showText(event.globalPos(), tip_of(self.tip_at(event.pos())), self)
            return True
        return super().viewportEvent(event)

    def tip_at(self, place: QPoint) -> str:
        """Return what a click at a place would do."""
        number = self._row_at(place)
        if number < 0:
            return self.toolTip()
        row: Row = self.curves.row(number)
        moved = adjustment_of(theme_of(self.palette()).paper.name(), row.colour)
        tips = {
            Spot.SWATCH: f"Choose the colour of “{row.name}”" + (f"; it is {moved}" if moved else ""),
            Spot.NAME: f"“{row.name}”: {row.facts}. Double-click to rename, drag to reorder.",
            Spot.LOCK: f"{'Unlock' if row.locked else 'Lock'} “{row.name}”",
            Spot.EYE: f"{'Hide' if row.visible else 'Show'} “{row.name}”",
        }
        return tips[self.spot_at(place)]


def _deletes(event: QKeyEvent) -> bool:
    """Whether a key deletes; held with Shift or Ctrl it is an action's."""
    return event.key() in DELETE and not event.modifiers() & ~Qt.KeyboardModifier.KeypadModifier
