"""Panel with the list of curves, its buttons, and the menu of colours behind a swatch."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from PySide6.QtCore import QPoint, Qt, Signal
from PySide6.QtGui import QAction, QContextMenuEvent, QIcon
from PySide6.QtWidgets import QMenu, QWidget

from ...appearance.colours import CURVE_COLOURS, fill_colour, paint_picture
from ...appearance.theme import theme_of
from ...document.groups import Node
from ...document.model import Document
from ...document.style import NO_PAINT, Style
from ...qt.overrides import SafeOverrides
from ...view_model.palette import adjustment_of
from ...widgets.boxes import column_of, row_of
from ...widgets.colour_popup import ColourPopup
from ...widgets.controls import action_button
from .model import CurveListModel, RowMarks
from .rows import Spot
from .view import CurveListView


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
        self._choice: ColourPopup | None = None
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
        popup = self._choice = ColourPopup("otherColour", colour, self)
        popup.colour_changed.connect(lambda paint: self.colour_previewed.emit(indices, paint))
        popup.chosen.connect(lambda paint: self.colour_picked.emit(indices, paint))
        popup.cancelled.connect(self.preview_cancelled)
        popup.destroyed.connect(self._forget_choice)
        popup.open_at(position)

    def abandon(self) -> None:
        """Close the popup of colours and cancel its preview."""
        if self._choice is not None:
            self._choice.cancel()

    def _forget_choice(self) -> None:
        self._choice = None

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
    menu = QMenu(parent)
    menu.setObjectName("colourMenu")
    menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
    menu.setToolTipsVisible(True)
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
