"""The strip of colours below the canvas: a click paints the fill, Shift+click the stroke."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QPoint, QSize, Qt, Signal
from PySide6.QtGui import QAction, QContextMenuEvent, QIcon, QKeyEvent, QMouseEvent, QWheelEvent
from PySide6.QtWidgets import QAbstractItemView, QListView, QListWidget, QListWidgetItem, QMenu, QWidget

from ...appearance.swatches import paint_picture
from ...appearance.theme import Theme
from ...appearance.themed import FollowsTheme
from ...document.style import NO_PAINT
from ...qt.keys import ENTER
from ...qt.overrides import Guarded
from ...view_model.look.palettes import Palette, Swatch
from ...widgets.boxes import row_of
from ...widgets.controls import choice_box, named
from ...widgets.tool_buttons import action_button

_SIDE, _PICTURE, _HEIGHT = 18, 14, 26
_NONE = Swatch(NO_PAINT, "None")
_HOW = "click: fill, Shift+click: stroke"


class SwatchList(Guarded, QListWidget):
    """Colours in a row; arrow keys go from one to the next, Enter and Shift+Enter paint.

    Signals
    -------
    chosen
        A colour is meant for the "fill" or the "stroke": (paint, colour).
    """

    chosen = Signal(str, str)

    def __init__(self) -> None:
        super().__init__()
        named(self, "paletteSwatches", "Colours", "")
        self.setFlow(QListView.Flow.LeftToRight)
        self.setWrapping(False)
        self.setUniformItemSizes(True)
        self.setIconSize(QSize(_PICTURE, _PICTURE))
        self.setGridSize(QSize(_SIDE, _SIDE))
        self.setFixedHeight(_SIDE + 4)
        self.setFrameShape(QListWidget.Shape.NoFrame)
        self.setVerticalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        # A click leaves the keys with the canvas: Enter is meant for what was painted.
        self.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.setSelectionMode(QAbstractItemView.SelectionMode.NoSelection)
        self.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)

    def show_swatches(self, swatches: Sequence[Swatch], theme: Theme, paper: Theme) -> None:
        """Show these colours, as they are on a paper; the one that has the keyboard keeps it."""
        row = max(self.currentRow(), 0)
        self.clear()
        for each in swatches:
            item = QListWidgetItem(QIcon(paint_picture(each.colour, theme, paper, _PICTURE)), "")
            words = each.name if each.colour == NO_PAINT else each.words
            item.setToolTip(f"{words} ({_HOW})")
            item.setData(Qt.ItemDataRole.AccessibleTextRole, words)
            item.setData(Qt.ItemDataRole.UserRole, each.colour)
            item.setSizeHint(QSize(_SIDE, _SIDE))
            self.addItem(item)
        self.setCurrentRow(min(row, len(swatches) - 1))

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        super().mouseReleaseEvent(event)
        item = self.itemAt(event.position().toPoint())
        if item is not None and event.button() == Qt.MouseButton.LeftButton:
            self._choose(item, event.modifiers())

    def keyPressEvent(self, event: QKeyEvent) -> None:
        item = self.currentItem()
        if item is not None and event.key() in ENTER:
            self._choose(item, event.modifiers())
        elif item is not None and event.key() == Qt.Key.Key_Menu:
            self._offer(item, self.visualItemRect(item).center())
        else:
            super().keyPressEvent(event)

    def wheelEvent(self, event: QWheelEvent) -> None:
        bar, turned = self.horizontalScrollBar(), event.angleDelta()
        bar.setValue(bar.value() - (turned.y() or turned.x()) * _SIDE // 40)
        event.accept()

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        place = event.pos()
        if (item := self.itemAt(place)) is not None:
            self._offer(item, place)

    def _choose(self, item: QListWidgetItem, modifiers: Qt.KeyboardModifier) -> None:
        paint = "stroke" if modifiers & Qt.KeyboardModifier.ShiftModifier else "fill"
        self.chosen.emit(paint, item.data(Qt.ItemDataRole.UserRole))

    def _offer(self, item: QListWidgetItem, place: QPoint) -> None:
        """Offer to paint either."""
        menu, colour = QMenu(self), item.data(Qt.ItemDataRole.UserRole)
        menu.setObjectName("swatchMenu")
        menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        for paint in ("fill", "stroke"):
            entry = menu.addAction(f"Set {paint.capitalize()}")
            entry.triggered.connect(lambda _=False, paint=paint: self.chosen.emit(paint, colour))
        menu.popup(self.viewport().mapToGlobal(place))


class PaletteBar(FollowsTheme, QWidget):
    """A palette, and the choice among all.

    Signals
    -------
    chosen
        See `SwatchList`.
    palette_chosen
        Another palette is to be shown: its place among them.
    """

    chosen = Signal(str, str)
    palette_chosen = Signal(int)

    def __init__(self, opens: QAction) -> None:
        super().__init__()
        named(self, "paletteBar", "Palette")
        self._titles: tuple[str, ...] = ()
        self._shown: tuple[Swatch, ...] = ()
        self._paper = self.theme
        self.box = choice_box("paletteBox", "Palette", "Which colours are offered")
        self.box.activated.connect(self.palette_chosen)
        self.swatches = SwatchList()
        self.swatches.chosen.connect(self.chosen)
        row_of(
            (self.swatches, 1), self.box, action_button(opens), margins=(4, 1, 4, 1), spacing=4, parent=self
        )
        self.setFixedHeight(max(_HEIGHT, self.sizeHint().height()))
        self.follow_theme()

    def render_palettes(self, palettes: Sequence[Palette], place: int, paper: Theme) -> None:
        """Offer palettes, and show the one at a place, as its colours are on a paper."""
        titles = tuple(each.title for each in palettes)
        if titles != self._titles:
            self._titles = titles
            self.box.clear()
            self.box.addItems(titles)
        self.box.setCurrentIndex(place)
        wanted = (palettes[place].swatches, paper)
        if wanted != (self._shown, self._paper):
            self._shown, self._paper = wanted
            self._show()

    def _show(self) -> None:
        self.swatches.show_swatches((_NONE, *self._shown), self.theme, self._paper)

    def set_theme(self, theme: Theme) -> None:
        """Take the colours of `theme`."""
        self.setStyleSheet(f"QListWidget {{ background: transparent; color: {theme.ink.name()}; }}")
        self._show()
