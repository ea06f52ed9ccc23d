"""Drag of a row of the list: from the press to the drop between rows, or into a shape or group."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import msgspec
from PySide6.QtCore import QPoint
from PySide6.QtGui import QPainter, QPen
from PySide6.QtWidgets import QApplication, QListView

from ...appearance.theme import theme_of
from ...document.groups import OUTSIDE, Container, Node
from ...tasks.task import DelayedCall
from .model import CurveListModel, Entry
from .rows import INDENT, RowParts


class Drop(msgspec.Struct, frozen=True):
    """Target position of dragged curves.

    Attributes
    ----------
    gap
        The row below the drop; the number of rows for the end of the list.
    at
        The index in the document before which curves are inserted.
    container
        The shape or group of the drop.
    is_onto
        Whether the drop is onto the row, to the front of its shape or group, and not above the row.
    """

    gap: int
    at: int
    container: Container
    is_onto: bool = False


def drop_at(entries: Sequence[Entry], gap: int, depth: int) -> Drop:
    """Return the position between two rows at the requested depth of shapes and groups, where possible.

    Below the last row of an open shape or group the drop may be inside or outside of it.
    """
    above = entries[gap - 1] if gap > 0 else None
    below = entries[gap].node if gap < len(entries) else None
    outer = below.container if below is not None else OUTSIDE
    inner = _inner(above) if above is not None else outer
    containers = [inner]
    while containers[-1] != outer:
        containers.append(containers[-1].parent)
    container = containers[max(0, min(len(containers) - 1, inner.depth - depth))]
    return Drop(gap, below.indices.stop if below is not None else 0, container)


def stays(drop: Drop, dragged: Node, row: int) -> bool:
    """Return whether a drop would leave the dragged row where it is."""
    return not drop.is_onto and drop.gap in (row, row + 1) and drop.container == dragged.container


def _inner(above: Entry) -> Container:
    return above.node.as_container if above.is_open else above.node.container


OPENS_MS = 600
"""Milliseconds for which a drag rests on a folded shape or group before that opens."""


class RowDrag:
    """Press on a row, and the drag that follows; a folded row under a resting drag opens.

    Parameters
    ----------
    open_row
        Function that opens the shape or group of a row.

    Attributes
    ----------
    row
        The row that was pressed; −1 for none.
    drop
        The drop at the current position; None without a drag.
    """

    def __init__(
        self, view: QListView, model: CurveListModel, parts: RowParts, open_row: Callable[[int], object]
    ) -> None:
        self._view, self._model, self._parts, self._open_row = view, model, parts, open_row
        self.row = -1
        self.drop: Drop | None = None
        self._press: QPoint | None = None
        self._position = QPoint()
        self._opening = DelayedCall(view, OPENS_MS, self._open_below)

    def press(self, row: int, position: QPoint) -> None:
        """Start with a press on a row."""
        self.row, self._press = row, position

    def move(self, position: QPoint) -> None:
        """Follow the pointer."""
        if self._press is None:
            return
        if self.drop is not None or abs(position.y() - self._press.y()) >= QApplication.startDragDistance():
            self._follow(position, self._press)

    def end(self) -> None:
        """End the drag."""
        self._press, self.row, self.drop = None, -1, None
        self._opening.stop()
        self._view.viewport().update()

    def _follow(self, position: QPoint, press: QPoint) -> None:
        """Show the position of the drop, and open a folded row after a moment."""
        before, self.drop = self.drop, self._drop_at(position, press)
        self._position = position
        if not self.drop.is_onto or self._model.entries[self.drop.gap].is_open:
            self._opening.stop()
        elif self.drop != before or not self._opening.isActive():
            self._opening.start()
        self._view.viewport().update()

    def _open_below(self) -> None:
        """Open the shape or group under the resting drag."""
        if self._press is None or self.drop is None or not self.drop.is_onto:
            return
        dragged = self._model.entries[self.row].node
        self._open_row(self.drop.gap)
        self.row = next(row for row, entry in enumerate(self._model.entries) if entry.node == dragged)
        self._follow(self._position, self._press)

    def _drop_at(self, position: QPoint, press: QPoint) -> Drop:
        """Return the drop at a position: between rows, or onto the middle half of a shape or group."""
        entries, row = self._model.entries, self._parts.row_at(position)
        if row not in (-1, self.row) and entries[row].holds:
            rect = self._view.visualRect(self._model.index(row))
            if abs(position.y() - rect.center().y()) <= rect.height() // 4:
                # Into the shape or group of the row, in front of its curves.
                node = entries[row].node
                return Drop(row, node.indices.stop, node.as_container, is_onto=True)
        gap, deeper = self._gap_at(position), round((position.x() - press.x()) / INDENT)
        depth = entries[self.row].node.depth + deeper
        if row == gap - 1 and deeper >= 0:
            # On the lower half of a row, unless moved to the left: at the same depth.
            depth = max(depth, entries[row].node.depth)
        return drop_at(entries, gap, depth)

    def _gap_at(self, position: QPoint) -> int:
        """Return between which rows a drop would fall, by the number of the row below it, from the top."""
        top = self._view.visualRect(self._model.index(0))
        gap = round((position.y() - top.top()) / max(top.height(), 1))
        return max(0, min(gap, self._model.rowCount()))

    def paint(self, painter: QPainter) -> None:
        """Draw the drop: a line between rows, or a frame around a row."""
        view, model, drop = self._view, self._model, self.drop
        if drop is None:
            return
        last = model.rowCount() - 1
        rect = view.visualRect(model.index(min(drop.gap, last)))
        painter.setPen(QPen(theme_of(view.palette()).accent, 2))
        if drop.is_onto:
            painter.drawRect(rect.adjusted(2, 1, -2, -1))
            return
        y = max(rect.top() if drop.gap <= last else rect.bottom(), 1)
        left = 4 + INDENT * (1 + drop.container.depth) * model.has_folds
        painter.drawLine(left, y, view.viewport().width() - 4, y)
