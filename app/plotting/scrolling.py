"""Moving the view: panning with the mouse, the wheel and the trackpad, and a drag at the edge."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QObject, QPointF, Qt, QTimer
from PySide6.QtGui import QInputDevice, QKeyEvent, QMouseEvent, QNativeGestureEvent, QWheelEvent
from PySide6.QtWidgets import QWidget

from ..document.model import Vector
from ..tools.gesture import THRESHOLD
from .camera import Camera


class Panning:
    """Panning of a plot with the mouse; the pointer's shape shows that it would.

    Every method takes an event that the plot received; what concerns other gestures is left alone.
    """

    def __init__(self, camera: Camera, viewport: QWidget) -> None:
        self._camera, self._viewport = camera, viewport
        self._from: QPointF | None = None
        self._button = Qt.MouseButton.MiddleButton
        self._space_down = False

    @property
    def is_active(self) -> bool:
        """Whether the drawing follows the mouse."""
        return self._from is not None

    @property
    def owns_cursor(self) -> bool:
        """Whether the shape of the pointer is that of panning."""
        return self._space_down or self.is_active

    def press(self, event: QMouseEvent) -> bool:
        """Begin, if this press means panning; return whether it does."""
        means_it = event.button() == Qt.MouseButton.MiddleButton or (
            event.button() == Qt.MouseButton.LeftButton and self._space_down
        )
        if means_it and not self.is_active:
            self._from, self._button = event.position(), event.button()
            self._viewport.setCursor(Qt.CursorShape.ClosedHandCursor)
        return means_it

    def move(self, event: QMouseEvent) -> bool:
        """Let the drawing follow; return whether it does."""
        if self._from is None:
            return False
        moved = event.position() - self._from
        self._from = event.position()
        self._camera.pan(moved.x(), moved.y())
        return True

    def release(self, event: QMouseEvent) -> bool:
        """End, if the button that began it is let go; return whether it is."""
        ends = self.is_active and event.button() == self._button
        if ends:
            self.stop()
        return ends

    def stop(self) -> None:
        """End, if it is going on."""
        if self.is_active:
            self._from = None
            self._show_cursor()

    def hear_key(self, event: QKeyEvent, *, down: bool) -> None:
        """Note whether Space is down."""
        if event.key() == Qt.Key.Key_Space and not event.isAutoRepeat():
            self._space_down = down
            self._show_cursor()

    def reset_key(self) -> None:
        """Count Space as released: in another window its release is never heard of."""
        self._space_down = False

    def _show_cursor(self) -> None:
        shape = Qt.CursorShape.OpenHandCursor if self._space_down else Qt.CursorShape.ArrowCursor
        self._viewport.setCursor(shape)


ZOOM_STEP = 1.2
"""Zoom factor of one notch of the wheel."""

_NOTCH = 120.0
"""`QWheelEvent.angleDelta` of one notch."""

_PAN_STEP = 60.0
"""Pixels of one notch, or of as much of a trackpad that does not count in pixels."""

_SHIFT, _CTRL = Qt.KeyboardModifier.ShiftModifier, Qt.KeyboardModifier.ControlModifier


class Scrolling:
    """Panning and zooming of a plot by wheel and trackpad.

    Which of the two it was is told by the phases of the event, and where the system sends none (X11) by the
    device. `QWheelEvent.pixelDelta` tells nothing: X11 sets it for some wheels, and not for libinput's
    trackpads.
    """

    def __init__(self, camera: Camera, viewport: QWidget) -> None:
        self._camera, self._viewport = camera, viewport
        self._zooms = False

    def wheel(self, event: QWheelEvent) -> None:
        """Pan or zoom by a wheel event."""
        # What comes after the fingers have left goes on with what they began, whatever is held now.
        if event.phase() != Qt.ScrollPhase.ScrollMomentum:
            self._zooms = _zooms(event)
        if self._zooms:
            notches = event.angleDelta().y() / _NOTCH
            if notches:
                self._camera.zoom(ZOOM_STEP**notches, event.position())
            return
        moved = _moved(event)
        if not moved.isNull():
            self._camera.pan(moved.x(), moved.y())

    def pinch(self, event: QNativeGestureEvent) -> bool:
        """Zoom by two fingers that move apart or together; return whether the gesture is that."""
        if event.gestureType() != Qt.NativeGestureType.ZoomNativeGesture:
            return False
        place = QPointF(self._viewport.mapFromGlobal(event.globalPosition()))
        # Each event tells by how much of itself the picture grows.
        factor = 1.0 + event.value()
        if factor > 0:
            self._camera.zoom(factor, place)
        return True


def _is_trackpad(event: QWheelEvent) -> bool:
    device = event.device()
    is_pad = device is not None and device.type() == QInputDevice.DeviceType.TouchPad
    return is_pad or event.phase() != Qt.ScrollPhase.NoScrollPhase


def _zooms(event: QWheelEvent) -> bool:
    """Whether an event means zooming: Ctrl does, and a wheel that is turned forth or back on its own."""
    held, turned = event.modifiers(), event.angleDelta()
    if held & _CTRL:
        return True
    return not (_is_trackpad(event) or held & _SHIFT or abs(turned.x()) > abs(turned.y()))


def _moved(event: QWheelEvent) -> QPointF:
    """Return by how many pixels the drawing is moved."""
    pixels = QPointF(event.pixelDelta())
    if not _is_trackpad(event) or pixels.isNull():
        pixels = QPointF(event.angleDelta()) * (_PAN_STEP / _NOTCH)
    if event.modifiers() & _SHIFT:
        # Some systems turn it sideways themselves.
        pixels = QPointF(pixels.x() or pixels.y(), 0.0)
    return pixels


_ZONE = 10.0
"""Pixels inside the edge from which on it scrolls: beyond the edge of a screen no mouse can go."""

_TICK_MS = 16
_LEAST, _GAIN, _MOST = 1.5, 0.15, 30.0
"""Pixels of a tick: at least, more for every pixel further out, at most."""


class EdgeScroll(QObject):
    """Moves the view of a plot towards a pointer at its edge, the faster the further out it is.

    A press near the edge scrolls nothing until the pointer has moved outwards from there.

    Parameters
    ----------
    camera
        The camera that it moves.
    scrolled
        Called after each move: what is dragged is somewhere else now.
    """

    def __init__(self, camera: Camera, scrolled: Callable[[], None]) -> None:
        super().__init__(camera)
        self._camera, self._scrolled = camera, scrolled
        self._at_press = self._way = (0.0, 0.0)
        self._timer = QTimer(self, interval=_TICK_MS)
        self._timer.timeout.connect(self._scroll)

    def begin(self, pixel: Vector) -> None:
        """Take note of a press at a pixel of the plot area."""
        self.stop()
        self._at_press = self._overshoot(pixel)

    def follow(self, pixel: Vector) -> None:
        """Scroll from now on if the pointer is at the edge here, or no longer."""
        shown = self._camera.pixel_map
        is_inside = _ZONE <= pixel[0] <= shown.width - _ZONE and _ZONE <= pixel[1] <= shown.height - _ZONE
        if is_inside and self._way == (0.0, 0.0):
            return
        x, y = (
            _beyond(now, before) for now, before in zip(self._overshoot(pixel), self._at_press, strict=True)
        )
        self._way = (_step(x), _step(y))
        if not any(self._way):
            self._timer.stop()
        elif not self._timer.isActive():
            self._timer.start()

    def stop(self) -> None:
        """Scroll no longer: the drag has ended."""
        self._timer.stop()
        self._at_press = self._way = (0.0, 0.0)

    def _overshoot(self, pixel: Vector) -> Vector:
        """Return how far a pixel lies in the zone at the edges or beyond: to the right and down positive."""
        shown = self._camera.pixel_map
        x, y = (
            max(at - (size - _ZONE), 0.0) + min(at - _ZONE, 0.0)
            for at, size in zip(pixel, (shown.width, shown.height), strict=True)
        )
        return (x, y)

    def _scroll(self) -> None:
        self._camera.pan(-self._way[0], -self._way[1])
        self._scrolled()


def _beyond(now: float, before: float) -> float:
    """Return how much further out a coordinate is than it was at the press, 0 if it is not."""
    if before and now * before > 0 and abs(now) < abs(before) + THRESHOLD:
        return 0.0  # no drag yet
    return max(now - max(before, 0.0), 0.0) + min(now - min(before, 0.0), 0.0)


def _step(out: float) -> float:
    """Return by how many pixels to scroll in a tick."""
    if not out:
        return 0.0
    step = min(_LEAST + _GAIN * abs(out), _MOST)
    return step if out > 0 else -step
