"""Scrolling and pinching: the wheel of a mouse zooms, two fingers on a trackpad pan, a pinch zooms."""

from __future__ import annotations

from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QInputDevice, QNativeGestureEvent, QWheelEvent
from PySide6.QtWidgets import QWidget

from .camera import Camera

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
