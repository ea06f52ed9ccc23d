"""Moving the view: panning with the mouse, the wheel and the trackpad, and a drag at the edge."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QObject, QPoint, QPointF, Qt, QTimer
from PySide6.QtGui import QInputDevice, QKeyEvent, QMouseEvent, QNativeGestureEvent, QWheelEvent
from PySide6.QtWidgets import QWidget

from ..document.fields import NO_SCROLL, Ranges, Scroll
from ..document.model import Vector
from ..tools.tool import THRESHOLD
from .camera import Camera


class Panning:
    """Panning of a plot with the mouse; the pointer has the shape of a hand.

    Every method is given an event of the plot, and ignores events of other gestures.
    """

    def __init__(self, camera: Camera, viewport: QWidget) -> None:
        self._camera, self._viewport = camera, viewport
        self._from: QPointF | None = None
        self._button = Qt.MouseButton.MiddleButton
        self._space_down = False

    @property
    def is_active(self) -> bool:
        """Whether a pan is in progress."""
        return self._from is not None

    @property
    def owns_cursor(self) -> bool:
        """Whether the pointer has the shape of panning."""
        return self._space_down or self.is_active

    def press(self, event: QMouseEvent) -> bool:
        """Begin to pan if the press means that; return whether it does."""
        pans = event.button() == Qt.MouseButton.MiddleButton or (
            event.button() == Qt.MouseButton.LeftButton and self._space_down
        )
        if pans and not self.is_active:
            self._from, self._button = event.position(), event.button()
            self._viewport.setCursor(Qt.CursorShape.ClosedHandCursor)
        return pans

    def move(self, event: QMouseEvent) -> bool:
        """Move the drawing with the mouse; return whether a pan is in progress."""
        if self._from is None:
            return False
        offset = event.position() - self._from
        self._from = event.position()
        self._camera.pan(offset.x(), offset.y())
        return True

    def release(self, event: QMouseEvent) -> bool:
        """End the pan if its button is released; return whether it is."""
        ends = self.is_active and event.button() == self._button
        if ends:
            self.stop()
        return ends

    def stop(self) -> None:
        """End the pan, if one is in progress."""
        if self.is_active:
            self._from = None
            self._show_cursor()

    def change_key(self, event: QKeyEvent, *, down: bool) -> None:
        """Record whether Space is down."""
        if event.key() == Qt.Key.Key_Space and not event.isAutoRepeat():
            self._space_down = down
            self._show_cursor()

    def reset_key(self) -> None:
        """Count Space as released: its release in another window is not reported."""
        self._space_down = False

    def _show_cursor(self) -> None:
        shape = Qt.CursorShape.OpenHandCursor if self._space_down else Qt.CursorShape.ArrowCursor
        self._viewport.setCursor(shape)


ZOOM_STEP = 1.2
"""Zoom factor of one notch of the wheel."""

_NOTCH = 120.0
"""`QWheelEvent.angleDelta` of one notch."""

_PAN_STEP = 60.0
"""Pixels of one notch of the wheel, or of a trackpad that does not report pixels."""

_SHIFT, _CTRL = Qt.KeyboardModifier.ShiftModifier, Qt.KeyboardModifier.ControlModifier


class Scrolling:
    """Panning and zooming of a plot by wheel and trackpad.

    The phases of an event distinguish the two, or the device where the system sends no phases (X11).
    `QWheelEvent.pixelDelta` does not: X11 sets it for some wheels, and not for libinput's trackpads.
    """

    def __init__(self, camera: Camera, viewport: QWidget) -> None:
        self._camera, self._viewport = camera, viewport
        self._zooms = False

    def wheel(self, event: QWheelEvent) -> None:
        """Pan or zoom by a wheel event."""
        # Momentum after the fingers have left goes on with their gesture, whatever keys are held now.
        if event.phase() != Qt.ScrollPhase.ScrollMomentum:
            self._zooms = _means_zoom(event)
        if self._zooms:
            notches = event.angleDelta().y() / _NOTCH
            if notches:
                self._camera.zoom(ZOOM_STEP**notches, event.position())
            return
        offset = _pan_offset(event)
        if not offset.isNull():
            self._camera.pan(offset.x(), offset.y())

    def pinch(self, event: QNativeGestureEvent) -> bool:
        """Zoom by a pinch; return whether the gesture is one."""
        if event.gestureType() != Qt.NativeGestureType.ZoomNativeGesture:
            return False
        centre = QPointF(self._viewport.mapFromGlobal(event.globalPosition()))
        # Each event reports the relative growth.
        factor = 1.0 + event.value()
        if factor > 0:
            self._camera.zoom(factor, centre)
        return True


def _is_trackpad(event: QWheelEvent) -> bool:
    device = event.device()
    is_pad = device is not None and device.type() == QInputDevice.DeviceType.TouchPad
    return is_pad or event.phase() != Qt.ScrollPhase.NoScrollPhase


def _means_zoom(event: QWheelEvent) -> bool:
    """Whether an event means zooming: with Ctrl, or a vertical turn of a wheel without Shift."""
    keys, turned = event.modifiers(), event.angleDelta()
    if keys & _CTRL:
        return True
    return not (_is_trackpad(event) or keys & _SHIFT or abs(turned.x()) > abs(turned.y()))


def _pan_offset(event: QWheelEvent) -> QPointF:
    """Return the pixels by which the drawing is panned."""
    pixels = QPointF(event.pixelDelta())
    if not _is_trackpad(event) or pixels.isNull():
        pixels = QPointF(event.angleDelta()) * (_PAN_STEP / _NOTCH)
    if event.modifiers() & _SHIFT:
        # Some systems exchange x and y themselves.
        pixels = QPointF(pixels.x() or pixels.y(), 0.0)
    return pixels


_ZONE = 10.0
"""Pixels inside the edge at which scrolling begins: no mouse leaves the edge of the screen."""

_TICK_MS = 16
_LEAST, _GAIN, _GENTLE_GAIN, _MOST = 1.5, 0.15, 0.01, 30.0
"""Pixels of a tick: the least, the gain for every pixel further out, over a panel of the window, the most."""


class EdgeScroll(QObject):
    """Scrolling towards a pointer at the edge of a plot, the faster the further out it is.

    Over other panels of the window it gains little speed. A press near the edge scrolls nothing until the
    pointer has moved outwards from there.

    Parameters
    ----------
    camera
        The camera of the plot.
    viewport
        The widget of the plot.
    scrolled
        Called after each move: the point under the pointer is another one now.
    """

    def __init__(self, camera: Camera, viewport: QWidget, scrolled: Callable[[], None]) -> None:
        super().__init__(camera)
        self._camera, self._viewport, self._scrolled = camera, viewport, scrolled
        self._at_press = self._offset = (0.0, 0.0)
        self._before: Ranges | None = None
        self._timer = QTimer(self, interval=_TICK_MS)
        self._timer.timeout.connect(self._scroll)

    def begin(self, pixel: Vector) -> None:
        """Record a press at a pixel of the plot area."""
        self.stop()
        self._at_press = self._overshoot(pixel)

    def follow(self, pixel: Vector) -> None:
        """Start or stop to scroll, for a pointer at this pixel."""
        if not any(self._overshoot(pixel)) and self._offset == (0.0, 0.0):
            return
        pairs = zip(self._overshoot(pixel), self._at_press, strict=True)
        x, y = (_beyond(now, before) for now, before in pairs)
        self._offset = (_step(x, self._panel(pixel[0], 0)), _step(y, self._panel(pixel[1], 1)))
        if not any(self._offset):
            self._timer.stop()
        elif not self._timer.isActive():
            self._timer.start()

    def stop(self) -> None:
        """Stop scrolling at the end of the drag."""
        self._timer.stop()
        self._at_press, self._offset, self._before = (0.0, 0.0), (0.0, 0.0), None

    @property
    def scroll(self) -> Scroll:
        """The parts of the plane visible before the drag and now, where it has scrolled the view."""
        return NO_SCROLL if self._before is None else (self._before, self._camera.ranges)

    def restore(self) -> None:
        """Show the range that was visible before the drag."""
        before = self._before
        self.stop()
        if before is not None:
            self._camera.show_box(*before)

    def _overshoot(self, pixel: Vector) -> Vector:
        """Return the depth of a pixel in the zone at the edges: positive to the right and down."""
        pixel_map = self._camera.pixel_map
        x, y = (
            max(coordinate - (size - _ZONE), 0.0) + min(coordinate - _ZONE, 0.0)
            for coordinate, size in zip(pixel, (pixel_map.width, pixel_map.height), strict=True)
        )
        return (x, y)

    def _panel(self, coordinate: float, axis: int) -> float:
        """Return the part of the way of a pixel, along x (0) or y (1), that is over panels of the window."""
        viewport, window, origin = self._viewport, self._viewport.window(), self._camera.origin
        corner = viewport.mapTo(window, QPoint())
        plot = (viewport.width(), viewport.height())[axis]
        whole = (window.width(), window.height())[axis]
        start = -(origin.x(), origin.y())[axis]
        outer = start - (corner.x(), corner.y())[axis]
        return abs(min(max(coordinate, outer), outer + whole) - min(max(coordinate, start), start + plot))

    def _scroll(self) -> None:
        if self._before is None:
            self._before = self._camera.ranges
        self._camera.pan(-self._offset[0], -self._offset[1])
        self._scrolled()


def _beyond(now: float, before: float) -> float:
    """Return the distance of a coordinate beyond that of the press, or 0."""
    if before and now * before > 0 and abs(now) < abs(before) + THRESHOLD:
        return 0.0  # no drag yet
    return max(now - max(before, 0.0), 0.0) + min(now - min(before, 0.0), 0.0)


def _step(out: float, over_panels: float) -> float:
    """Return the pixels to scroll in a tick for a way out, of which a part is over panels of the window."""
    if not out:
        return 0.0
    free = max(abs(out) - over_panels, 0.0)
    step = min(_LEAST + _GAIN * free + _GENTLE_GAIN * over_panels, _MOST)
    return step if out > 0 else -step
