"""The panel with the list of curves: which one is edited, what each is called and how it is shown."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QPoint, Qt, Signal
from PySide6.QtGui import QAction, QContextMenuEvent, QIcon
from PySide6.QtWidgets import QMenu, QWidget

from ...appearance.colours import CURVE_COLOURS, curve_colour
from ...appearance.swatches import swatch
from ...appearance.theme import theme_of
from ...document.model import Document
from ...qt.overrides import Guarded
from ...view_model.palette import adjustment_of
from ...widgets.boxes import column_of, row_of
from ...widgets.tool_buttons import action_button
from .model import CurveListModel
from .rows import Spot
from .view import CurveListView


class CurveList(Guarded, QWidget):
    """The list, and buttons for what can be done with a curve.

    Signals
    -------
    visible_switched, locked_switched
        The eye or the lock of the row about these curves was clicked (a set of places).
    colour_chosen
        Another colour was selected for these curves.
    row_meant
        A menu about these curves is wanted.
    menu_requested
        A menu for the active curve is wanted at a place of the screen.

    Attributes
    ----------
    view
        The QListView.
    """

    visible_switched = Signal(object)
    locked_switched = Signal(object)
    colour_chosen = Signal(object, str)
    row_meant = Signal(object)
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
        """Put a small button for each action under the list."""
        for place, action in enumerate(actions):
            button = action_button(action, flat=True)
            # The icons come with the theme, later; docks laid out anew by then would forget their widths.
            button.setFixedSize(26, 26)
            self._buttons.insertWidget(place, button)

    def render_document(
        self, document: Document, active: int, selected: frozenset[int], *, is_editing: bool
    ) -> None:
        """Show the curves of `document`, which of them is edited, if any is, and which are selected."""
        self.model.show_document(document, active if is_editing else None, selected)
        self.view.show_active(active, selected, is_editing=is_editing)

    # What the person did

    def _switch(self, places: frozenset[int], spot: Spot) -> None:
        if spot is Spot.SWATCH:
            self.choose_colour(places)
        elif spot is Spot.EYE:
            self.visible_switched.emit(places)
        else:
            self.locked_switched.emit(places)

    def choose_colour(self, places: frozenset[int]) -> QMenu:
        """Open the palette for curves, and all selected with them, beside their swatch if that is seen."""
        row = self.model.row_about(places, max(places))
        menu = QMenu(self)
        menu.setObjectName("colourMenu")
        menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        menu.setToolTipsVisible(True)
        theme = theme_of(self.palette())
        for name, code in CURVE_COLOURS.items():
            action = menu.addAction(QIcon(swatch(curve_colour(code, theme).name(), 12)), name)
            action.setObjectName(f"colour_{name.replace(' ', '_')}")
            action.setToolTip(f"{name} {adjustment_of(theme.paper.name(), code)}".strip())
            action.setCheckable(True)
            action.setChecked(code == self.model.row(row).colour)
            action.triggered.connect(lambda _checked=False, code=code: self.colour_chosen.emit(places, code))
        rect = self.view.entry_rect(row)
        place = self.view.viewport().mapToGlobal(rect.bottomLeft())
        menu.popup(
            place if self.view.isVisible() else self.window().mapToGlobal(self.window().rect().center())
        )
        return menu

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        """Ask for the menu of the curve under the pointer, or of the active one."""
        place = self.view.viewport().mapFromGlobal(event.globalPos())
        places = self.view.places_at(place)
        if event.reason() == QContextMenuEvent.Reason.Keyboard:
            place = self.view.entry_rect(self.view.current).center()
            places = self.view.places_at(place)
        if places:
            self.row_meant.emit(places)
        self.menu_requested.emit(self.view.viewport().mapToGlobal(place))
