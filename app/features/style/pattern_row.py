"""Row of patterns: those that every document can use, and those of the document."""

from __future__ import annotations

from collections.abc import Iterable

from PySide6.QtCore import QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QIcon, QPainter, QPen, QPixmap
from PySide6.QtWidgets import QGridLayout, QToolButton, QWidget

from ...appearance.theme import LIGHT, Theme, rim
from ...appearance.themed import FollowsTheme
from ...document.gradient import Gradient, GradientKind, Tile
from ...document.patterns import PATTERNS, colouring
from ...qt.gradients import brush_of
from ...widgets.tool_buttons import tool_button

_SIDE, _ACROSS, _MOST = 24, 6, 18
"""Pixels along the sides of a picture; patterns in a row, and in all."""

_TILE = 10.0
"""Pixels of a tile in its picture."""


class PatternRow(FollowsTheme, QWidget):
    """Patterns, taken with one click; the one that is in use is on.

    Signals
    -------
    chosen
        A pattern is wanted: its `Tile`.
    """

    chosen = Signal(object)

    def __init__(self, paint: str, label: str) -> None:
        super().__init__()
        self._paint, self._label = paint, label
        self._tiles: dict[Tile, str] = {}
        self._buttons: dict[Tile, QToolButton] = {}
        self._used: Tile | None = None
        self._colour, self._theme = "", LIGHT
        self._grid = QGridLayout(self)
        self._grid.setContentsMargins(0, 0, 0, 0)
        self._grid.setSpacing(4)
        self._grid.setColumnStretch(_ACROSS, 1)
        self.follow_theme()

    def render_pattern(self, used: Tile | None, colour: str, others: Iterable[Tile]) -> None:
        """Show which pattern is in use, all of them in its colour, and what others the document has."""
        tiles = {each.tile: each.title for each in PATTERNS}
        for number, tile in enumerate(others, start=1):
            tiles.setdefault(tile, f"Pattern {number} of the document")
        kept = dict(list(tiles.items())[:_MOST])
        if (kept, colour) != (self._tiles, self._colour):
            self._tiles, self._colour = kept, colour
            self._fill()
        self._used = used
        for tile, button in self._buttons.items():
            button.setChecked(tile == used)

    def _fill(self) -> None:
        for button in self._buttons.values():
            self._grid.removeWidget(button)
            button.deleteLater()
        self._buttons = {}
        for place, (tile, title) in enumerate(self._tiles.items()):
            name = f"{self._paint}Pattern{place}"
            button = tool_button(name, f"{self._label}: {title}", title, icon_size=_SIDE)
            button.setCheckable(True)
            button.setIcon(self._picture(tile))
            button.clicked.connect(lambda _checked, tile=tile: self._choose(tile))
            self._buttons[tile] = button
            self._grid.addWidget(button, place // _ACROSS, place % _ACROSS)

    def _choose(self, tile: Tile) -> None:
        # What is on is what the owner shows.
        for each, button in self._buttons.items():
            button.setChecked(each == self._used)
        self.chosen.emit(tile)

    def _picture(self, tile: Tile) -> QIcon:
        picture = QPixmap(QSize(2 * _SIDE, 2 * _SIDE))
        picture.setDevicePixelRatio(2)
        picture.fill(Qt.GlobalColor.transparent)
        _, _, width, height = tile.view
        size = _TILE / max(width, height)
        corners = (2.0, 2.0), (2.0 + size * width, 2.0), (2.0, 2.0 + size * height)
        pattern = Gradient(colouring(self._colour), GradientKind.PATTERN, *corners, tile=tile)
        area = QRectF(QPointF(1, 1), QSize(_SIDE - 2, _SIDE - 2))
        with QPainter(picture) as painter:
            painter.setRenderHints(
                QPainter.RenderHint.Antialiasing | QPainter.RenderHint.SmoothPixmapTransform
            )
            painter.fillRect(area, LIGHT.paper)
            painter.fillRect(area, brush_of(pattern, LIGHT.curve, 1.0, lambda place: place))
            painter.setPen(QPen(rim(self._theme), 1.0))
            painter.drawRect(area.adjusted(0.5, 0.5, -0.5, -0.5))
        return QIcon(picture)

    def set_theme(self, theme: Theme) -> None:
        """Take the colours of `theme`."""
        self._theme = theme
        for tile, button in self._buttons.items():
            button.setIcon(self._picture(tile))
