"""The menu of colours behind a swatch of the list: of the line, and of the inside."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import Qt
from PySide6.QtGui import QIcon
from PySide6.QtWidgets import QMenu, QWidget

from ...appearance.colours import CURVE_COLOURS, paint_picture
from ...appearance.theme import theme_of
from ...document.style import NO_PAINT, Style
from ...view_model.palette import adjustment_of

_PICTURE = 12


def colour_menu(
    style: Style,
    paint: Callable[[str], object],
    fill: Callable[[str], object],
    choose_other: Callable[[], object],
    parent: QWidget,
) -> QMenu:
    """Return the menu for curves of a style; what is chosen is told to `paint`, or to `fill`."""
    menu = QMenu(parent)
    menu.setObjectName("colourMenu")
    menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
    menu.setToolTipsVisible(True)
    _add_paints(menu, "colour", CURVE_COLOURS, style.colour, paint)
    menu.addSeparator()
    other = menu.addAction("Other Colour…", choose_other)
    other.setObjectName("colour_Other")
    other.setToolTip("Choose any colour; it is seen at once")
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
        action = menu.addAction(QIcon(paint_picture(paint, theme, _PICTURE)), word)
        action.setObjectName(f"{name}_{word.replace(' ', '_')}")
        moved = adjustment_of(theme.paper.name(), paint) if name == "colour" else ""
        action.setToolTip(f"{word} {moved}".strip())
        action.setCheckable(True)
        action.setChecked(paint == now)
        action.triggered.connect(lambda _checked=False, paint=paint: choose(paint))
