"""Where the rows of the list have their parts: what opens them, swatch, name, lock and eye."""

from __future__ import annotations

from enum import Enum

from PySide6.QtCore import QPoint, QRect
from PySide6.QtWidgets import QListView

from ...appearance.theme import Theme, theme_of
from ...document.groups import Node
from ...view_model.palette import adjustment_of
from .entries import Row
from .model import CurveListModel

INDENT = 14
"""Pixels by which what is in a shape or group stands to the right of it; as wide is what opens it."""

ICON, SWATCH = 16, 12
"""Pixels of an icon, and of the swatch of a curve."""

_PAD = 8


class Spot(Enum):
    """A part of a row that can be clicked."""

    SWATCH = "swatch"
    NAME = "name"
    LOCK = "lock"
    EYE = "eye"


def spot_rect(row: QRect, spot: Spot) -> QRect:
    """Return where in a row a part of it lies."""
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
    """Rows and their parts in the viewport of a list, and what a click on them does."""

    def __init__(self, view: QListView, model: CurveListModel) -> None:
        self._view, self._model = view, model

    def entry_rect(self, row: int) -> QRect:
        """Return where a row has its parts."""
        rect = self._view.visualRect(self._model.index(row))
        if self._model.has_folds:
            rect.setLeft(rect.left() + INDENT * (1 + self._model.entries[row].node.depth))
        return rect

    def row_rect(self, place: int) -> QRect:
        """Return where the row of a curve, or of what it is in while that is folded, has its parts."""
        return self.entry_rect(self._model.row_of(place))

    def opener_rect(self, row: int) -> QRect:
        """Return where a row opens what is in its shape or group."""
        rect = self.entry_rect(row)
        return QRect(rect.left() - INDENT + 2, rect.top(), INDENT, rect.height())

    def row_at(self, place: QPoint) -> int:
        """Return the row at a place; −1 for none."""
        return self._view.indexAt(place).row()

    def node_at(self, place: QPoint) -> Node | None:
        """Return what the row at a place is about."""
        row = self.row_at(place)
        return self._model.entries[row].node if row >= 0 else None

    def is_on_opener(self, place: QPoint) -> bool:
        """Whether a click at a place opens or folds a row."""
        row = self.row_at(place)
        return row >= 0 and self._model.entries[row].opens and place.x() < self.entry_rect(row).left()

    def spot_at(self, place: QPoint) -> Spot:
        """Return the part of a row at a place."""
        row = self.row_at(place)
        for spot in (Spot.SWATCH, Spot.LOCK, Spot.EYE):
            if spot_rect(self.entry_rect(row), spot).contains(place):
                return spot
        return Spot.NAME

    def tip_at(self, place: QPoint) -> str:
        """Return what a click at a place would do."""
        number = self.row_at(place)
        if number < 0:
            return self._view.toolTip()
        row, entry = self._model.row(number), self._model.entries[number]
        if self.is_on_opener(place):
            return f"{'Fold' if entry.is_open else 'Open'} “{row.name}” (Left, Right)"
        theme = theme_of(self._view.palette())
        return _spot_tip(self.spot_at(place), row, theme)


def _spot_tip(spot: Spot, row: Row, theme: Theme) -> str:
    moved = adjustment_of(theme.paper.name(), row.style.colour)
    tips = {
        Spot.SWATCH: f"Choose the colour of “{row.name}”" + (f"; it is {moved}" if moved else ""),
        Spot.NAME: f"“{row.name}”: {row.facts}. Double-click to rename, drag to reorder;"
        " right-click › Edit Curve shows its points.",
        Spot.LOCK: f"{'Unlock' if row.locked else 'Lock'} “{row.name}”",
        Spot.EYE: f"{'Hide' if row.visible else 'Show'} “{row.name}”",
    }
    return tips[spot]
