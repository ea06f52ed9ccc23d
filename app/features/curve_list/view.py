"""The list widget of the curves: rows with a swatch, a name, a lock and an eye, dragged to another place."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QPoint, QRect, Qt, QTimer, Signal
from PySide6.QtGui import QHelpEvent, QKeyEvent, QKeySequence, QMouseEvent, QPainter, QPaintEvent
from PySide6.QtWidgets import (
    QAbstractItemView,
    QApplication,
    QLineEdit,
    QListView,
    QStyledItemDelegate,
    QToolTip,
    QWidget,
)

from ...appearance.theme import theme_of
from ...document.curve_tree import Node
from ...qt.keys import DELETE, ENTER, ClaimsKeys
from ...qt.labels import tip_of
from ...widgets.controls import named
from .dropping import Drop, drop_at, drop_onto, stays
from .model import CurveListModel, Entry
from .rows import INDENT, RowDelegate, Spot, draw_drop, spot_rect, spot_tip

_OPENS_MS = 600
"""Milliseconds for which a drag rests on a folded shape or group before that opens."""

_RENAME = (Qt.Key.Key_F2, *ENTER)
_STEPS = {Qt.Key.Key_Up: -1, Qt.Key.Key_Down: 1}
_FOLDS = {Qt.Key.Key_Left: False, Qt.Key.Key_Right: True}

_ALL = QKeySequence.StandardKey.SelectAll


class CurveListView(ClaimsKeys, QListView):
    """Reports what the person did; which row is the active one comes from the session.

    Curves are named by their places in the document, wherever they stand in the list.

    Signals
    -------
    activated_row
        The row of a curve was clicked or walked to.
    chosen_entry
        The row of a shape, group or layer was clicked or walked to (a Node).
    rows_selected
        These curves shall be worked on together (a set of places).
    all_wanted
        All curves shall be.
    spot_clicked
        The swatch, the lock or the eye of a row was clicked (Node, Spot).
    moved
        A row was dragged to another place (Node, Drop).
    deletion_wanted
        These curves shall be deleted (a set), or the layer of this name with them.
    """

    activated_row = Signal(int)
    chosen_entry = Signal(object)
    rows_selected = Signal(object)
    all_wanted = Signal()
    spot_clicked = Signal(object, object)
    moved = Signal(object, object)
    deletion_wanted = Signal(object, str)

    def __init__(self, model: CurveListModel, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.curves = model
        self.active, self.is_editing = 0, True
        self.selected: frozenset[int] = frozenset()
        # The row that keys go on from, and where choosing row by row has come to from it.
        self._current = self._reached = 0
        self._press: QPoint | None = None
        self._pressed_row = -1
        self._drop: Drop | None = None
        self._dragged_to = QPoint()
        self._opening = QTimer(self, singleShot=True, interval=_OPENS_MS)
        self._opening.timeout.connect(self._open_below)
        self.setModel(model)
        tip = (
            "The curve in front is at the top. Click a curve to edit it, double-click to rename it,"
            " drag it to another place; Ctrl or Shift+click chooses several. Left and Right fold"
            " shapes and groups"
        )
        named(self, "curveList", "Curves", tip)
        self._delegate = RowDelegate(self)
        self.setItemDelegate(self._delegate)
        self.setFrameShape(QListView.Shape.NoFrame)
        self.setSelectionMode(QAbstractItemView.SelectionMode.NoSelection)
        self.setEditTriggers(QAbstractItemView.EditTrigger.EditKeyPressed)
        self.setUniformItemSizes(True)
        self.setMouseTracking(True)

    def show_active(self, row: int, selected: frozenset[int], *, is_editing: bool = True) -> None:
        """Mark the row of the active curve as edited, if it is, and those that are selected."""
        self.is_editing = is_editing
        changed, self.active, self.selected = row != self.active, row, selected
        if not self._is_about(self._current):
            self._current = self.curves.row_about(selected, row)
        if self._reached >= self.curves.rowCount() or not self._places(self._reached) <= selected:
            self._reached = self._current
        index = self.curves.index(self._current)
        if self.currentIndex() != index:
            self.setCurrentIndex(index)
        if changed:
            self.scrollTo(index)
        self.viewport().update()

    def _is_about(self, row: int) -> bool:
        """Whether a row is about the curves that are selected, or else the active one."""
        if row >= self.curves.rowCount():
            return False
        entry = self.curves.entries[row]
        if not self.selected:
            return not entry.places and self.curves.is_chosen(entry)
        return entry.places == self.selected or (len(self.selected) == 1 and self.shows_active(entry))

    def shows_active(self, entry: Entry) -> bool:
        """Whether an entry is that of the active curve, or of what it is in while that is folded."""
        return self.active in entry.node.places and not entry.is_open

    def shows_edited(self, entry: Entry) -> bool:
        """Whether an entry is that of the curve that is edited, or of what it is in."""
        return self.is_editing and self.shows_active(entry)

    def _places(self, row: int) -> frozenset[int]:
        return self.curves.entries[row].places

    def edit_name(self, row: int) -> None:
        """Let the person type another name in a row; one that is being typed is taken as it is."""
        editor = self.viewport().findChild(QLineEdit)
        if self.state() == QListView.State.EditingState and editor is not None:
            self.commitData(editor)
            self.closeEditor(editor, QStyledItemDelegate.EndEditHint.NoHint)
        self._current = row
        self.setCurrentIndex(self.curves.index(row))
        self.scrollTo(self.curves.index(row))
        self.edit(self.curves.index(row))

    @property
    def meant(self) -> frozenset[int]:
        """The curves that commands are about while the list has the keys: of an open shape also one alone."""
        here = self._places(self._current) or self.selected or frozenset({self.active})
        return self.selected if len(self.selected) > 1 else here

    @property
    def current(self) -> int:
        """The row that keys act on."""
        return self._current

    def row_rect(self, place: int) -> QRect:
        """Return where the row of a curve, or of what it is in while that is folded, has its parts."""
        return self.entry_rect(self.curves.row_of(place))

    def entry_rect(self, row: int) -> QRect:
        """Return where a row has its parts, in the viewport."""
        rect = self.visualRect(self.curves.index(row))
        if self.curves.has_folds:
            rect.setLeft(rect.left() + INDENT * (1 + self.curves.entries[row].node.depth))
        return rect

    def opener_rect(self, row: int) -> QRect:
        """Return where a row opens what is in its shape or group."""
        rect = self.entry_rect(row)
        return QRect(rect.left() - INDENT + 2, rect.top(), INDENT, rect.height())

    def _row_at(self, place: QPoint) -> int:
        return self.indexAt(place).row()

    def places_at(self, place: QPoint) -> frozenset[int]:
        """Return the curves that the row at a place of the viewport is about."""
        node = self.node_at(place)
        return frozenset(node.places if node is not None else ())

    def node_at(self, place: QPoint) -> Node | None:
        """Return what the row at a place of the viewport is about."""
        row = self._row_at(place)
        return self.curves.entries[row].node if row >= 0 else None

    def _is_on_opener(self, place: QPoint) -> bool:
        row = self._row_at(place)
        return row >= 0 and self.curves.entries[row].opens and place.x() < self.entry_rect(row).left()

    def spot_at(self, place: QPoint) -> Spot:
        """Return the part of a row at a place of the viewport."""
        rect = self.entry_rect(self._row_at(place))
        for spot in (Spot.SWATCH, Spot.LOCK, Spot.EYE):
            if spot_rect(rect, spot).contains(place):
                # There is nothing to colour in an empty layer.
                return spot if spot is not Spot.SWATCH or self.places_at(place) else Spot.NAME
        return Spot.NAME

    # Mouse: a click activates or switches, a drag moves the row

    @property
    def is_dragging(self) -> bool:
        """Whether a row is being dragged."""
        return self._drop is not None

    def mousePressEvent(self, event: QMouseEvent) -> None:
        self._press, self._pressed_row = None, -1
        row = self._row_at(event.position().toPoint())
        if event.button() != Qt.MouseButton.LeftButton or row < 0:
            return
        if self._is_on_opener(event.position().toPoint()):
            self._fold(row, is_open=not self.curves.entries[row].is_open)
            return
        places, spot = self._places(row), self.spot_at(event.position().toPoint())
        held = event.modifiers()
        if spot is not Spot.NAME:
            self.spot_clicked.emit(self.curves.entries[row].node, spot)
        elif held & Qt.KeyboardModifier.ControlModifier:
            others = self.selected - places
            self.rows_selected.emit(others if places <= self.selected else others | places)
        elif held & Qt.KeyboardModifier.ShiftModifier:
            self._choose_to(row)
        else:
            # What holds no curve is not dragged.
            self._press, self._pressed_row = event.position().toPoint() if places else None, row
            self._reached = row
            if not self._is_of_several(row):
                self._go(row)

    def _is_of_several(self, row: int) -> bool:
        return self._places(row) <= self.selected and len(self.selected) > 1

    def _go(self, row: int) -> None:
        """Edit the curve of a row, or choose all that is in a shape or group."""
        self._current = max(0, min(row, self.curves.rowCount() - 1))
        entry = self.curves.entries[self._current]
        if entry.holds:
            self.chosen_entry.emit(entry.node)
        else:
            self.activated_row.emit(entry.node.places.start)
        self.scrollTo(self.curves.index(self._current))

    def _choose_to(self, row: int) -> None:
        """Choose from the current row to this one."""
        self._reached = max(0, min(row, self.curves.rowCount() - 1))
        low, high = sorted((self._current, self._reached))
        self.rows_selected.emit(frozenset().union(*map(self._places, range(low, high + 1))))
        self.scrollTo(self.curves.index(self._reached))

    def _fold(self, row: int, *, is_open: bool) -> None:
        """Show what is in the shape or group of a row, or no longer."""
        self.curves.open(row, is_open)
        self._reached = self.curves.rowCount()
        self.show_active(self.active, self.selected, is_editing=self.is_editing)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        place = event.position().toPoint()
        if self._press is None or not event.buttons() & Qt.MouseButton.LeftButton:
            return
        if self._drop is None and abs(place.y() - self._press.y()) < QApplication.startDragDistance():
            return
        self._follow_drag(place)

    def _follow_drag(self, place: QPoint) -> None:
        """Show where a drop would fall; what is folded there opens after a moment."""
        assert self._press is not None
        before, self._drop = self._drop, self._drop_at(place, self._press)
        self._dragged_to = place
        if not self._drop.is_onto or self.curves.entries[self._drop.gap].is_open:
            self._opening.stop()
        elif self._drop != before or not self._opening.isActive():
            self._opening.start()
        self.viewport().update()

    def _open_below(self) -> None:
        """Open the shape or group that the drag rests on; the rows below it go down."""
        if self._drop is None or not self._drop.is_onto:
            return
        dragged = self.curves.entries[self._pressed_row].node
        self._fold(self._drop.gap, is_open=True)
        self._pressed_row = next(
            row for row, entry in enumerate(self.curves.entries) if entry.node == dragged
        )
        self._follow_drag(self._dragged_to)

    def _drop_at(self, place: QPoint, press: QPoint) -> Drop:
        """Return where a drop would fall: between rows, or on one that opens, in the middle half of that."""
        entries, row = self.curves.entries, self._row_at(place)
        if row not in (-1, self._pressed_row) and entries[row].holds:
            rect = self.visualRect(self.curves.index(row))
            if abs(place.y() - rect.center().y()) <= rect.height() // 4:
                return drop_onto(entries, row)
        gap, deeper = self._gap_at(place), round((place.x() - press.x()) / INDENT)
        depth = entries[self._pressed_row].node.depth + deeper
        if row == gap - 1 and deeper >= 0:
            # On the lower half of a row, and not to the left: beside that.
            depth = max(depth, entries[row].node.depth)
        return drop_at(entries, gap, depth)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        drop, row = self._drop, self._pressed_row
        self._end_drag()
        if row < 0:
            return
        if drop is None:
            if self._is_of_several(row):
                # Not at the press: a drag takes all of them along.
                self._go(row)
        elif not stays(drop, self.curves.entries[row].node, row):
            self.moved.emit(self.curves.entries[row].node, drop)

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        place = event.position().toPoint()
        is_plain = not event.modifiers() & ~Qt.KeyboardModifier.KeypadModifier
        row = self._row_at(place)
        if is_plain and row >= 0 and not self._is_on_opener(place) and self.spot_at(place) is Spot.NAME:
            self.edit_name(row)
        else:
            self.mousePressEvent(event)

    def _gap_at(self, place: QPoint) -> int:
        """Return between which rows a drop would fall, by the number of the row below it, from the top."""
        top = self.visualRect(self.curves.index(0))
        gap = round((place.y() - top.top()) / max(top.height(), 1))
        return max(0, min(gap, self.curves.rowCount()))

    def _end_drag(self) -> None:
        self._press, self._pressed_row, self._drop = None, -1, None
        self._opening.stop()
        self.viewport().update()

    def paintEvent(self, event: QPaintEvent) -> None:
        super().paintEvent(event)
        if self._drop is not None:
            with QPainter(self.viewport()) as painter:
                draw_drop(painter, self, self._drop)

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
        step, is_open = _STEPS.get(Qt.Key(event.key())), _FOLDS.get(Qt.Key(event.key()))
        is_plain = not event.modifiers() & ~Qt.KeyboardModifier.KeypadModifier
        if event.key() == Qt.Key.Key_Escape and self.is_dragging:
            self._end_drag()
        elif event.matches(_ALL):
            self.all_wanted.emit()
        elif step is not None and event.modifiers() & Qt.KeyboardModifier.ShiftModifier:
            self._choose_to(self._reached + step)
        elif step is not None and is_plain:
            self._go(self._current + step)
        elif is_open is not None and is_plain:
            self._walk_fold(is_open=is_open)
        elif event.key() in _RENAME and self.state() != QAbstractItemView.State.EditingState:
            self.edit_name(self._current)
        elif _deletes(event):
            entry = self.curves.entries[self._current]
            self.deletion_wanted.emit(self.meant, self.curves.chosen_layer(entry))
        else:
            # Everything else is for the window's shortcuts; the list's own search by letters would eat them.
            event.ignore()

    def _walk_fold(self, *, is_open: bool) -> None:
        """Open the current entry, or go into it; fold it, or go to what it is in."""
        row = self._current
        entry, around = self.curves.entries[row], self.curves.row_around(row)
        if entry.opens and entry.is_open != is_open:
            self._fold(row, is_open=is_open)
        elif is_open and entry.opens:
            self._go(row + 1)
        elif not is_open and around is not None:
            self._go(around)

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
        row, entry = self.curves.row(number), self.curves.entries[number]
        if self._is_on_opener(place):
            return f"{'Fold' if entry.is_open else 'Open'} “{row.name}” (Left, Right)"
        return spot_tip(self.spot_at(place), row, theme_of(self.palette()))


def _deletes(event: QKeyEvent) -> bool:
    """Whether a key deletes; held with Shift or Ctrl it is an action's."""
    return event.key() in DELETE and not event.modifiers() & ~Qt.KeyboardModifier.KeypadModifier
