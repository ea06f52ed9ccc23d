"""A bar that shows a gradient from its start to its end, with its stops to take hold of."""

from __future__ import annotations

from PySide6.QtCore import QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QKeyEvent, QMouseEvent, QPainter, QPaintEvent, QPen, QPolygonF
from PySide6.QtWidgets import QSizePolicy, QWidget

from ...appearance.colours import fill_colour
from ...appearance.theme import Theme, rim
from ...appearance.themed import FollowsTheme
from ...document.gradient import Gradient, Stop, with_stop_at, with_stop_between
from ...qt.gradients import brush_of
from ...qt.keys import DELETE, ClaimsKeys
from ...widgets.controls import named

_BAR, _MARK, _REACH = 16.0, 5.0, 7.0
"""Pixels: the height of the bar, half the width of a mark, and how far from it a press still means it."""

_SQUARE = 4
"""Pixels along the sides of the squares that are seen through a gradient."""

_STEPS = {Qt.Key.Key_Left: -1, Qt.Key.Key_Right: 1}
"""Keys that choose another stop, and how many further."""

_TIP = (
    "The stops of the gradient: click the bar to add one, drag one to move it, Delete removes it, ← → go "
    "from one to the next; Escape cancels a drag"
)


class StopBar(FollowsTheme, ClaimsKeys, QWidget):
    """Shows stops, of which one is chosen, and asks for others.

    Signals
    -------
    picked
        Another stop is chosen: its place among them.
    looked_at
        A stop is being dragged: all stops as they would be.
    wanted
        Other stops are wanted, of which this one is chosen.
    given_up
        What was looked at is not wanted.
    """

    picked = Signal(int)
    looked_at = Signal(object)
    wanted = Signal(object, int)
    given_up = Signal()

    def __init__(self, name: str, label: str) -> None:
        super().__init__()
        named(self, name, f"{label}, stops of the gradient", _TIP)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self._stops: tuple[Stop, ...] = ()
        self._chosen = 0
        self._paper: Theme | None = None
        # The stops at the press, and those that are looked at, while one is dragged.
        self._held: tuple[Stop, ...] | None = None
        self._last: tuple[Stop, ...] | None = None
        self.follow_theme()

    def render_stops(self, stops: tuple[Stop, ...], chosen: int) -> None:
        """Show stops, and which of them is chosen."""
        self._stops, self._chosen = stops, chosen
        self.update()

    def sizeHint(self) -> QSize:
        return QSize(120, round(_BAR + 2 * _MARK + 3))

    def set_theme(self, theme: Theme) -> None:
        """Take the colours of `theme`."""
        self.update()

    def show_paper(self, paper: Theme) -> None:
        """Show colours as they are drawn on this paper."""
        if paper is not self._paper:
            self._paper = paper
            self.update()

    # Places

    def place_of(self, offset: float) -> QPointF:
        """Return the tip of the mark at an offset."""
        return QPointF(_MARK + 1 + offset * self._length, _BAR)

    @property
    def _length(self) -> float:
        return max(self.width() - 2 * (_MARK + 1), 1.0)

    def _offset_at(self, x: float) -> float:
        return round(min(max((x - _MARK - 1) / self._length, 0.0), 1.0), 3)

    def _stop_at(self, x: float) -> int | None:
        """Return the nearest stop within reach; of several at one place the chosen one, or the last."""
        off = [abs(self.place_of(stop.offset).x() - x) for stop in self._stops]
        near = [index for index, distance in enumerate(off) if distance <= _REACH]
        if not near:
            return None
        return self._chosen if self._chosen in near else min(near, key=lambda index: (off[index], -index))

    # Painting

    def paintEvent(self, event: QPaintEvent) -> None:
        if len(self._stops) < 2:
            return
        with QPainter(self) as painter:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            self._paint_bar(painter)
            for index, stop in enumerate(self._stops):
                if index != self._chosen:
                    self._paint_mark(painter, stop, is_chosen=False)
            self._paint_mark(painter, self._stops[self._chosen], is_chosen=True)

    def _paint_bar(self, painter: QPainter) -> None:
        bar = QRectF(_MARK + 1, 1, self._length, _BAR - 2)
        painter.fillRect(bar, Qt.GlobalColor.white)
        for column in range(int(bar.width()) // _SQUARE + 1):
            for row in range(column % 2, int(bar.height()) // _SQUARE + 1, 2):
                square = QRectF(bar.left() + column * _SQUARE, bar.top() + row * _SQUARE, _SQUARE, _SQUARE)
                painter.fillRect(square.intersected(bar), Qt.GlobalColor.lightGray)
        shown = Gradient(self._stops, start=(bar.left(), 0.0), end=(bar.right(), 0.0), side=(bar.left(), 1.0))
        painter.fillRect(bar, brush_of(shown, (self._paper or self.theme).curve, 1.0, lambda place: place))
        painter.setPen(QPen(self.theme.accent if self.hasFocus() else rim(self.theme), 1.0))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.drawRect(bar)

    def _paint_mark(self, painter: QPainter, stop: Stop, *, is_chosen: bool) -> None:
        tip, half = self.place_of(stop.offset), _MARK
        corners = [(0, -2), (half, half - 1), (half, 2 * half), (-half, 2 * half), (-half, half - 1)]
        painter.setPen(QPen(self.theme.accent if is_chosen else self.theme.ink, 2.0 if is_chosen else 1.0))
        painter.setBrush(fill_colour(stop.colour, self._paper or self.theme))
        painter.drawPolygon(QPolygonF([tip + QPointF(x, y) for x, y in corners]))

    # What the person did

    def mousePressEvent(self, event: QMouseEvent) -> None:
        if event.button() != Qt.MouseButton.LeftButton or len(self._stops) < 2:
            return
        x = event.position().x()
        at = self._stop_at(x)
        if at is None:
            self._add(self._offset_at(x))
            return
        self._held, self._last = self._stops, None
        if at != self._chosen:
            self.picked.emit(at)

    def _add(self, offset: float) -> None:
        stops, at = with_stop_between(self._stops, offset)
        if stops != self._stops:
            self.wanted.emit(stops, at)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        if self._held is None:
            return
        stops = with_stop_at(self._held, self._chosen, self._offset_at(event.position().x()))
        if stops != (self._last or self._held):
            self._last = stops
            self.looked_at.emit(stops)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        last, held = self._last, self._held
        self._held = self._last = None
        if last is not None and last != held:
            self.wanted.emit(last, self._chosen)
        elif last is not None:
            self.given_up.emit()

    def abandon(self) -> None:
        """End a drag here; what the mouse still does before its release means nothing."""
        self._held = self._last = None

    def claims(self, event: QKeyEvent) -> bool:
        return event.key() in (*_STEPS, *DELETE) or (
            event.key() == Qt.Key.Key_Escape and self._held is not None
        )

    def keyPressEvent(self, event: QKeyEvent) -> None:
        key = Qt.Key(event.key())
        if key == Qt.Key.Key_Escape and self._held is not None:
            self.abandon()
            self.given_up.emit()
        elif key in _STEPS and self._stops:
            self.picked.emit((self._chosen + _STEPS[key]) % len(self._stops))
        elif key in DELETE:
            self.remove()
        else:
            super().keyPressEvent(event)

    def remove(self) -> None:
        """Ask for the stops without the chosen one, as long as two are left."""
        rest = (*self._stops[: self._chosen], *self._stops[self._chosen + 1 :])
        if len(rest) > 1:
            self.wanted.emit(rest, max(self._chosen - 1, 0))
