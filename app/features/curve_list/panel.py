"""The list of curves, the panel with its buttons, and the menu of colours behind a swatch."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial

from PySide6.QtCore import QEvent, QPoint, Qt, Signal
from PySide6.QtGui import (
    QAction,
    QContextMenuEvent,
    QHelpEvent,
    QIcon,
    QKeyEvent,
    QKeySequence,
    QMouseEvent,
    QPainter,
    QPaintEvent,
)
from PySide6.QtWidgets import QAbstractItemView, QListView, QMenu, QToolTip, QWidget

from ...appearance.colours import CURVE_COLOURS, fill_colour, paint_picture
from ...appearance.theme import theme_of
from ...document.groups import Node
from ...document.model import Document
from ...document.style import NO_PAINT, Style
from ...qt.labels import tip_of
from ...qt.overrides import DELETE, ENTER, ClaimsKeys, SafeOverrides
from ...view_model.palette import adjustment_of
from ...widgets.boxes import column_of, row_of
from ...widgets.colour_popup import ColourPopup
from ...widgets.controls import action_button, menu_with_tips, named
from ...widgets.fields import end_editing
from .model import CurveListModel, RowMarks
from .row_drag import RowDrag, stays
from .rows import RowDelegate, RowParts, Spot

_RENAME = (Qt.Key.Key_F2, *ENTER)
_STEPS = {Qt.Key.Key_Up: -1, Qt.Key.Key_Down: 1}
_FOLDS = {Qt.Key.Key_Left: False, Qt.Key.Key_Right: True}

_ALL = QKeySequence.StandardKey.SelectAll


class CurveListView(ClaimsKeys, QListView):
    """List that reports clicks, drags and keys; the selection comes from the session, by the model.

    Curves are identified by their indices in the document.

    Signals
    -------
    entry_clicked
        A row was clicked or walked to (a Node).
    rows_selected
        These curves are to be selected together (a set of indices).
    all_wanted
        All curves are to be selected.
    spot_clicked
        The swatch, the lock or the eye of a row was clicked (Node, Spot).
    moved
        A row was dragged to another place (Node, Drop).
    deletion_wanted
        These curves are to be deleted (a set).

    Attributes
    ----------
    curves
        The model.
    parts
        Where rows have their parts.
    """

    entry_clicked = Signal(object)
    rows_selected = Signal(object)
    all_wanted = Signal()
    spot_clicked = Signal(object, object)
    moved = Signal(object, object)
    deletion_wanted = Signal(object)

    def __init__(self, model: CurveListModel, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.curves, self.parts = model, RowParts(self, model)
        # The row that keys continue from, and the last row of a selection that began there.
        self._current = self._reached = 0
        self._followed = 0
        self._drag = RowDrag(self, model, self.parts, partial(self._fold, is_open=True))
        self.setModel(model)
        tip = (
            "The front curve is at the top. Click to select a curve, or to edit it while another one is"
            " edited; right-click › Edit Curve shows its points. Double-click to rename, drag to reorder;"
            " Ctrl or Shift+click selects several. Left and Right fold and unfold shapes and groups"
        )
        named(self, "curveList", "Curves", tip)
        self._delegate = RowDelegate(self, model, self.parts)
        self.setItemDelegate(self._delegate)
        self.setFrameShape(QListView.Shape.NoFrame)
        self.setSelectionMode(QAbstractItemView.SelectionMode.NoSelection)
        self.setEditTriggers(QAbstractItemView.EditTrigger.EditKeyPressed)
        self.setUniformItemSizes(True)
        self.setMouseTracking(True)

    def follow(self) -> None:
        """Mark the selected rows, and continue from them."""
        marks = self.curves.marks
        if not self._is_about(self._current):
            self._current = self.curves.row_about(marks.curves, marks.active)
        if self._reached >= self.curves.rowCount() or not self._indices_of(self._reached) <= marks.curves:
            self._reached = self._current
        index = self.curves.index(self._current)
        if self.currentIndex() != index:
            self.setCurrentIndex(index)
        if marks.active != self._followed:
            self._followed = marks.active
            self.scrollTo(index)
        self.viewport().update()

    def _is_about(self, row: int) -> bool:
        """Return whether a row stands for the selected curves, or else for the active one."""
        if row >= self.curves.rowCount():
            return False
        entry, marks = self.curves.entries[row], self.curves.marks
        is_of_one = len(marks.curves) == 1 and marks.active in entry.indices and not entry.is_open
        return entry.indices == marks.curves or is_of_one

    def _indices_of(self, row: int) -> frozenset[int]:
        return self.curves.entries[row].indices

    def edit_name(self, row: int) -> None:
        """Start to edit the name in a row, after accepting the name that is being typed."""
        end_editing(self)
        self._current = row
        self.setRowHidden(row, False)
        self.setCurrentIndex(self.curves.index(row))
        self.scrollTo(self.curves.index(row))
        self.edit(self.curves.index(row))

    @property
    def target_curves(self) -> frozenset[int]:
        """Curves that commands act on while the list has the focus."""
        marks = self.curves.marks
        here = self._indices_of(self._current)
        return marks.curves if len(marks.curves) > 1 else here

    @property
    def current(self) -> int:
        """Row that keys act on."""
        return self._current

    # Mouse: a click selects or switches, a drag moves the row

    @property
    def is_dragging(self) -> bool:
        """Whether a row is being dragged."""
        return self._drag.drop is not None

    def mousePressEvent(self, event: QMouseEvent) -> None:
        self._drag.end()
        position = event.position().toPoint()
        row = self.parts.row_at(position)
        if event.button() != Qt.MouseButton.LeftButton or row < 0:
            return
        if self.parts.is_on_opener(position):
            self._fold(row, is_open=not self.curves.entries[row].is_open)
            return
        indices, spot = self._indices_of(row), self.parts.spot_at(position)
        selected = self.curves.marks.curves
        held = event.modifiers()
        if spot is not Spot.NAME:
            self.spot_clicked.emit(self.curves.entries[row].node, spot)
        elif held & Qt.KeyboardModifier.ControlModifier:
            self.rows_selected.emit(selected - indices if indices <= selected else selected | indices)
        elif held & Qt.KeyboardModifier.ShiftModifier:
            self._select_to(row)
        else:
            self._drag.press(row, position)
            self._reached = row
            if not self._is_of_several(row):
                self._go(row)

    def _is_of_several(self, row: int) -> bool:
        selected = self.curves.marks.curves
        return self._indices_of(row) <= selected and len(selected) > 1

    def _go(self, row: int) -> None:
        """Select the curves of a row."""
        self._current = max(0, min(row, self.curves.rowCount() - 1))
        self.entry_clicked.emit(self.curves.entries[self._current].node)
        self.scrollTo(self.curves.index(self._current))

    def _select_to(self, row: int) -> None:
        """Select from the current row to this one."""
        self._reached = max(0, min(row, self.curves.rowCount() - 1))
        low, high = sorted((self._current, self._reached))
        self.rows_selected.emit(frozenset().union(*map(self._indices_of, range(low, high + 1))))
        self.scrollTo(self.curves.index(self._reached))

    def _fold(self, row: int, *, is_open: bool) -> None:
        """Open or fold the shape or group of a row."""
        self.curves.open(row, is_open)
        self._reached = self.curves.rowCount()
        self.follow()

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        if event.buttons() & Qt.MouseButton.LeftButton:
            self._drag.move(event.position().toPoint())

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        drop, row = self._drag.drop, self._drag.row
        self._drag.end()
        if row < 0:
            return
        if drop is None:
            if self._is_of_several(row):
                # Not at the press, because a drag moves all of them.
                self._go(row)
        elif not stays(drop, self.curves.entries[row].node, row):
            self.moved.emit(self.curves.entries[row].node, drop)

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        at = event.position().toPoint()
        is_plain = not event.modifiers() & ~Qt.KeyboardModifier.KeypadModifier
        row, parts = self.parts.row_at(at), self.parts
        if is_plain and row >= 0 and not parts.is_on_opener(at) and parts.spot_at(at) is Spot.NAME:
            self.edit_name(row)
        else:
            self.mousePressEvent(event)

    def paintEvent(self, event: QPaintEvent) -> None:
        super().paintEvent(event)
        if self.is_dragging:
            with QPainter(self.viewport()) as painter:
                self._drag.paint(painter)

    # Keys

    def event(self, event: QEvent) -> bool:
        if event.type() == QEvent.Type.WindowBlocked and self.is_dragging:
            # A dialog grabs the mouse, so that the release is lost.
            self._drag.end()
        return super().event(event)

    def claims(self, event: QKeyEvent) -> bool:
        # Escape cancels a drag, F2 renames and Del deletes curves, before the window gets these keys.
        if event.key() == Qt.Key.Key_Escape:
            return self.is_dragging
        return event.key() in _RENAME or _deletes(event) or event.matches(_ALL)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        step, is_open = _STEPS.get(Qt.Key(event.key())), _FOLDS.get(Qt.Key(event.key()))
        is_plain = not event.modifiers() & ~Qt.KeyboardModifier.KeypadModifier
        if event.key() == Qt.Key.Key_Escape and self.is_dragging:
            self._drag.end()
        elif event.matches(_ALL):
            self.all_wanted.emit()
        elif step is not None and event.modifiers() & Qt.KeyboardModifier.ShiftModifier:
            self._select_to(self._next_visible(self._reached, step))
        elif step is not None and is_plain:
            self._go(self._next_visible(self._current, step))
        elif is_open is not None and is_plain:
            self._walk_fold(is_open=is_open)
        elif event.key() in _RENAME and self.state() != QAbstractItemView.State.EditingState:
            self.edit_name(self._current)
        elif _deletes(event):
            self.deletion_wanted.emit(self.target_curves)
        else:
            # Other keys are shortcuts of the window; the list would use letters for its own search.
            event.ignore()

    def _next_visible(self, row: int, step: int) -> int:
        """Return the next visible row, or else the same row."""
        rows = range(row + step, self.curves.rowCount() if step > 0 else -1, step)
        return next((row_there for row_there in rows if not self.isRowHidden(row_there)), row)

    def _walk_fold(self, *, is_open: bool) -> None:
        """Open the current entry or go into it; fold it or go to its container."""
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
            QToolTip.showText(event.globalPos(), tip_of(self.parts.tip_at(event.pos())), self)
            return True
        return super().viewportEvent(event)


def _deletes(event: QKeyEvent) -> bool:
    """Return whether a key deletes; with Shift or Ctrl it belongs to an action."""
    return event.key() in DELETE and not event.modifiers() & ~Qt.KeyboardModifier.KeypadModifier


class CurveList(SafeOverrides, QWidget):
    """List of curves with its buttons.

    Signals
    -------
    visible_switched, locked_switched
        The eye or the lock of the row of a node was clicked.
    colour_picked, fill_picked
        Another colour, or another fill, was selected for these curves.
    colour_previewed, preview_cancelled
        A colour for these curves is previewed; the preview is cancelled.
    row_targeted
        A menu about the row of a node is wanted.
    menu_requested
        A menu is requested at a position of the screen.

    Attributes
    ----------
    view
        The QListView.
    """

    visible_switched = Signal(object)
    locked_switched = Signal(object)
    colour_picked = Signal(object, str)
    fill_picked = Signal(object, str)
    colour_previewed = Signal(object, str)
    preview_cancelled = Signal()
    row_targeted = Signal(object)
    menu_requested = Signal(QPoint)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("curveListPanel")
        self.model = CurveListModel(self)
        self.view = CurveListView(self.model, self)
        self._buttons = row_of(1, margins=(6, 4, 6, 4), spacing=2)
        column_of((self.view, 1), self._buttons, margins=0, spacing=0, parent=self)
        self.view.spot_clicked.connect(self._switch)

    def add_buttons(self, actions: Sequence[QAction]) -> None:
        """Add a small button for each action below the list."""
        for position, action in enumerate(actions):
            button = action_button(action, flat=True)
            # The icons are set later, with the theme; without a fixed size the docks would be laid out again.
            button.setFixedSize(26, 26)
            self._buttons.insertWidget(position, button)

    def render_document(self, document: Document, marks: RowMarks) -> None:
        """Show the curves of `document` and the marks."""
        self.model.show_document(document, marks)
        self.view.follow()

    # Input of the user

    def _switch(self, node: Node, spot: Spot) -> None:
        if spot is Spot.SWATCH:
            self.choose_colour(frozenset(node.indices))
        elif spot is Spot.EYE:
            self.visible_switched.emit(node)
        else:
            self.locked_switched.emit(node)

    def choose_colour(self, indices: frozenset[int]) -> QMenu:
        """Open the menu of colours for curves beside their swatch."""
        row = self.model.row_about(indices, max(indices))
        style = self.model.row(row).style
        position = self.view.viewport().mapToGlobal(self.view.parts.entry_rect(row).bottomLeft())
        if not self.view.isVisible():
            position = self.window().mapToGlobal(self.window().rect().center())
        menu = colour_menu(
            style,
            lambda paint: self.colour_picked.emit(indices, paint),
            lambda paint: self.fill_picked.emit(indices, paint),
            lambda: self._open_choice(indices, style, position),
            self,
        )
        menu.popup(position)
        return menu

    def _open_choice(self, indices: frozenset[int], style: Style, position: QPoint) -> None:
        """Open the popup for any colour at a position of the screen."""
        colour = fill_colour(style.colour, theme_of(self.palette())).name()
        popup = ColourPopup("otherColour", colour, self)
        popup.colour_changed.connect(lambda paint: self.colour_previewed.emit(indices, paint))
        popup.chosen.connect(lambda paint: self.colour_picked.emit(indices, paint))
        popup.cancelled.connect(self.preview_cancelled)
        popup.open_at(position)

    def abandon(self) -> None:
        """Close the popup of colours and cancel its preview."""
        for popup in self.findChildren(ColourPopup):
            popup.cancel()

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        """Request the context menu of the curve under the pointer, or of the active one."""
        position = self.view.viewport().mapFromGlobal(event.globalPos())
        if event.reason() == QContextMenuEvent.Reason.Keyboard:
            position = self.view.parts.entry_rect(self.view.current).center()
        if (node := self.view.parts.node_at(position)) is not None:
            self.row_targeted.emit(node)
        self.menu_requested.emit(self.view.viewport().mapToGlobal(position))


_SWATCH = 12


def colour_menu(
    style: Style,
    paint: Callable[[str], object],
    fill: Callable[[str], object],
    choose_other: Callable[[], object],
    parent: QWidget,
) -> QMenu:
    """Return the menu of colours for curves of a style; it calls `paint` or `fill`."""
    menu = menu_with_tips("colourMenu", parent)
    menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
    _add_paints(menu, "colour", CURVE_COLOURS, style.colour, paint)
    menu.addSeparator()
    other = menu.addAction("Other Colour…", choose_other)
    other.setObjectName("colour_Other")
    other.setToolTip("Choose any colour, with a live preview")
    inside = menu.addMenu("Fill")
    inside.setObjectName("fillMenu")
    inside.setToolTipsVisible(True)
    _add_paints(inside, "fill", {"None": NO_PAINT, **CURVE_COLOURS}, style.fill, fill)
    return menu


def _add_paints(
    menu: QMenu, name: str, paints: dict[str, str], now: str, choose: Callable[[str], object]
) -> None:
    theme = theme_of(menu.palette())
    for word, paint in paints.items():
        action = menu.addAction(QIcon(paint_picture(paint, theme, _SWATCH)), word)
        action.setObjectName(f"{name}_{word.replace(' ', '_')}")
        moved = adjustment_of(theme.paper.name(), paint) if name == "colour" else ""
        action.setToolTip(f"{word} {moved}".strip())
        action.setCheckable(True)
        action.setChecked(paint == now)
        action.triggered.connect(lambda _checked=False, paint=paint: choose(paint))
