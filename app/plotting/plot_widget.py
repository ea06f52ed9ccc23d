"""A plot that is painted by layers: pyqtgraph's view and axes, with mouse and keys."""

from __future__ import annotations

from typing import Any

from msgspec.structs import replace
from PySide6.QtCore import QEvent, QPoint, QPointF, QRectF, Qt, Signal
from PySide6.QtGui import (
    QContextMenuEvent,
    QEnterEvent,
    QFocusEvent,
    QKeyEvent,
    QMouseEvent,
    QNativeGestureEvent,
    QPainter,
    QPaintEvent,
    QPen,
    QResizeEvent,
    QWheelEvent,
)
from PySide6.QtWidgets import QGraphicsView, QSizePolicy, QWidget

from ..appearance.theme import Theme, theme_of
from ..qt.overrides import SafeOverrides, guard_library
from ..tools.pointer import Pointer
from .axes import Axes, Axis, Rulers
from .camera import Camera, ViewBox
from .graphs import ChildGroup, pg
from .layers import LayerStack
from .pixel_map import PixelMap
from .scrolling import Panning, Scrolling

_FOCUS_WIDTH = 2

# pyqtgraph's classes below the plot: Qt calls their overrides as it calls those of the program.
guard_library(pg.GraphicsView, pg.GraphicsScene, pg.ViewBox, ChildGroup)


class PaintedPlot(SafeOverrides, pg.GraphicsView):  # type: ignore[misc]  # pyqtgraph has no types
    """A plot of layers, beside its axes.

    Attributes
    ----------
    camera
        The visible part of the plane.
    layers
        The layers that are painted.
    rulers
        Marks on the axes while these are rulers.

    Signals
    -------
    painted
        The viewport has been painted.
    style_changed
        Theme or scale have changed.
    """

    painted = Signal()
    style_changed = Signal()

    camera_class: type[Camera] = Camera

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._box = ViewBox()
        self._axes = Axes(self._box, self._repaint_all)
        self.camera = self.camera_class(self, self._box)
        self.rulers = Rulers(self.viewport(), self._axes, self.camera, lambda: self.layers.is_due)
        self.layers = LayerStack(
            self.viewport(), lambda: self.camera.area, lambda: self.rulers.spread, self._axes.paint
        )
        self._shows_focus = False
        self._set_up_view()
        self._axes.set_scale(self.font(), 1.0)
        self.camera.changed.connect(self._repaint_all)

    def _set_up_view(self) -> None:
        self.setCentralItem(self._axes.frame)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.enableMouse(False)
        # The picture of the still layers contains the paper; Qt need not cache another one.
        self.setCacheMode(QGraphicsView.CacheModeFlag.CacheNone)
        # Every pixel is painted here: Qt need not fill the background.
        self.viewport().setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        # The window handles dropped files.
        self.setAcceptDrops(False)
        self.setMouseTracking(True)
        self.viewport().setMouseTracking(True)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)

    def getViewBox(self) -> Any:  # noqa: ANN401, N802 - as in pyqtgraph's PlotWidget
        """Return the view box."""
        return self._box

    def getAxis(self, side: str) -> Axis:  # noqa: N802 - as in pyqtgraph's PlotWidget
        """Return the axis along y, "left", or the one along x, "bottom"."""
        return self._axes[side]

    @property
    def pixel_map(self) -> PixelMap:
        """The present map from the plane to the pixels of the plot area."""
        return self.camera.pixel_map

    def to_pixel(self, x: float, y: float) -> QPoint:
        """Return the viewport pixel nearest to a point of the plane."""
        return self.camera.to_pixel(x, y)

    def to_plane(self, pixel: QPoint | QPointF) -> tuple[float, float]:
        """Return the point of the plane at a viewport pixel."""
        return self.camera.to_plane(pixel)

    def show_rulers(self, visible: bool) -> None:
        """Show the axes as rulers, the one along x above the drawing, or as plain axes."""
        if visible != self._axes.are_rulers:
            self._axes.set_rulers(visible)
            self.camera.follow_area()
            self.camera.changed.emit()

    # Painting

    def set_theme(self, theme: Theme) -> None:
        """Use the colours of `theme`."""
        self._axes.set_theme(theme)
        self.layers.theme = theme
        self.setBackground(theme.paper)
        self._repaint_all()
        self.style_changed.emit()

    def set_scale(self, scale: float) -> None:
        """Enlarge lines and numbers, for a projector."""
        self.layers.scale = scale
        self._axes.set_scale(self.font(), scale)
        self._repaint_all()
        self.style_changed.emit()

    def _repaint_all(self) -> None:
        self.layers.reset_ground()
        self.viewport().update()

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        if hasattr(self, "layers"):
            # pyqtgraph resizes the view in its constructor.
            self.camera.reset_origin()
            self.layers.reset_ground()

    def paintEvent(self, event: QPaintEvent) -> None:
        # Nothing is an item of Qt's graphics scene, so neither Qt's view nor pyqtgraph paints.
        origin, area, shown = self.camera.origin, self.camera.area, self.camera.pixel_map
        region = event.region()
        with QPainter(self.viewport()) as painter:
            self.layers.paint_ground(painter, shown, origin, region)
            painter.translate(origin)
            self.rulers.paint(painter, shown, self.layers.theme)
            if region.intersects(area):
                painter.setClipRect(QRectF(area).translated(-origin))
                self.layers.paint(painter, shown)
        if self._shows_focus:
            self._paint_focus()
        self.painted.emit()

    def _paint_focus(self) -> None:
        painter = QPainter(self.viewport())
        painter.setPen(QPen(theme_of(self.palette()).accent, _FOCUS_WIDTH))
        inset = _FOCUS_WIDTH / 2
        painter.drawRect(QRectF(self.viewport().rect()).adjusted(inset, inset, -inset, -inset))
        painter.end()

    def _show_focus(self, visible: bool) -> None:
        """Draw a frame around the plot for the focus of the keyboard, or none."""
        if visible != self._shows_focus:
            self._shows_focus = visible
            self.viewport().update()


_LEFT = Qt.MouseButton.LeftButton
_NO_KEYS = Qt.KeyboardModifier.NoModifier

_MODIFIERS = {
    Qt.Key.Key_Shift: ("shift", Qt.KeyboardModifier.ShiftModifier),
    Qt.Key.Key_Control: ("ctrl", Qt.KeyboardModifier.ControlModifier),
    Qt.Key.Key_Alt: ("alt", Qt.KeyboardModifier.AltModifier),
}
"""Modifier keys with their field of a pointer and Qt's flag."""

_REASON = Qt.FocusReason
_BY_KEYS = (_REASON.TabFocusReason, _REASON.BacktabFocusReason, _REASON.ShortcutFocusReason)


def _with_keys(pointer: Pointer, modifiers: Qt.KeyboardModifier, **changes: bool) -> Pointer:
    """Return the pointer with the pressed modifier keys, except for `changes`."""
    bits = modifiers.value
    if not (bits or changes):
        return pointer
    flags = {name: bool(bits & flag.value) for name, flag in _MODIFIERS.values()}
    return replace(pointer, **{**flags, **changes})


class PlotWidget(PaintedPlot):
    """A plot that pans and zooms by mouse, wheel and trackpad; a subclass handles everything else.

    Presses and moves that do neither arrive as a `Pointer`: position in the plane, pixel and modifier keys.
    Everything inside the axes is drawn by its layers, see `Layer`.
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._panning = Panning(self.camera, self.viewport())
        self._scrolling = Scrolling(self.camera, self.viewport())
        self._menu_refused = False
        # The last pointer, None once the mouse has left; and whether its left button is down.
        self._pointer: Pointer | None = None
        self._is_held = False

    # Overridden by subclasses

    def _pressed(self, pointer: Pointer) -> None:
        """Handle a press of the left button."""

    def _moved(self, pointer: Pointer) -> None:
        """Handle a move with the left button down."""

    def _released(self, pointer: Pointer) -> None:
        """Handle the release of the left button."""

    def _hovered_at(self, pointer: Pointer) -> None:
        """Handle a move with no button down."""

    def _left(self) -> None:
        """Handle the pointer leaving the widget."""

    @property
    def zoom_centre(self) -> QPointF:
        """The pixel of the viewport about which keys zoom: under the pointer, or in the middle."""
        if self._pointer is None:
            return self.camera.centre()
        return self.camera.origin + QPointF(*self._pointer.pixel)

    @property
    def is_dragging(self) -> bool:
        """Whether a gesture is in flight."""
        return False

    def cancel_gesture(self) -> bool:
        """Drop the gesture in flight; return whether there was one."""
        return False

    def _menu_wanted(self, event: QContextMenuEvent) -> None:
        """Handle the request of a menu, while no gesture is in flight."""

    # Events

    def pointer_at(self, event: QMouseEvent | QPointF) -> Pointer:
        """Return the pointer of a mouse event, or of a viewport position."""
        position, modifiers = (
            (event, _NO_KEYS) if isinstance(event, QPointF) else (event.position(), event.modifiers())
        )
        shown, pixel = self.camera.pixel_map, self.camera.area_pixel(position)
        pointer = Pointer(shown.plane(*pixel), pixel, scale=shown.sx)
        # Python's flags are slow, and every move of the mouse runs through this.
        return pointer if modifiers is _NO_KEYS else _with_keys(pointer, modifiers)

    def mousePressEvent(self, event: QMouseEvent) -> None:
        self._press_by(event, is_double=False)

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        # The second press of a double click is an ordinary press, because quick clicks must all count; a tool
        # may treat it differently.
        self._press_by(event, is_double=True)

    def _press_by(self, event: QMouseEvent, *, is_double: bool) -> None:
        if event.button() == Qt.MouseButton.RightButton:
            # It cancels a gesture, a drag or a transform, and must not open a menu then.
            self._menu_refused = self._panning.is_active or (self.is_dragging and self.cancel_gesture())
            if self._menu_refused:
                event.accept()
                return
        self.setFocus(Qt.FocusReason.MouseFocusReason)
        # The frame of the focus is for the keyboard only.
        self._show_focus(False)
        if self._is_held and event.button() == Qt.MouseButton.LeftButton:
            self._drop_gesture()  # the release was never reported
        if not self._panning.press(event) and event.button() == Qt.MouseButton.LeftButton:
            self._pointer, self._is_held = self.pointer_at(event), True
            self._pressed(replace(self._pointer, is_double=is_double) if is_double else self._pointer)
        event.accept()

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        event.accept()
        refused, self._menu_refused = self._menu_refused, False
        if not refused and not self.is_dragging:
            self._menu_wanted(event)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        if not self._panning.move(event):
            self._pointer = self.pointer_at(event)
            buttons = event.buttons()
            if buttons is _LEFT or buttons.value & _LEFT.value:
                self._moved(self._pointer)
            elif not buttons.value:
                if self._is_held:
                    # The release went to another widget, for instance to a list that a key has opened.
                    self._drop_gesture()
                self._hovered_at(self._pointer)
        event.accept()

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        # A drag ends with the left button, even while the middle one pans.
        if not self._panning.release(event) and event.button() == Qt.MouseButton.LeftButton:
            self._pointer, self._is_held = self.pointer_at(event), False
            self._released(self._pointer)
        event.accept()

    def event(self, event: QEvent) -> bool:
        if event.type() == QEvent.Type.WindowBlocked:
            # A dialog gets the mouse, and its release.
            self._drop_gesture()
        if (
            event.type() == QEvent.Type.ShortcutOverride
            and isinstance(event, QKeyEvent)
            and self.is_dragging
            and Qt.Key(event.key()) in _MODIFIERS
        ):
            # Otherwise a release of Alt alone would focus the menu bar.
            event.accept()
            return True
        if isinstance(event, QNativeGestureEvent) and self._scrolling.pinch(event):
            event.accept()
            return True
        return bool(super().event(event))

    def _drop_gesture(self) -> None:
        """Cancel the gesture or the pan of the mouse."""
        self._is_held = False
        self._panning.reset_key()
        self._panning.stop()
        if self.is_dragging:
            self.cancel_gesture()

    def _change_modifier(self, event: QKeyEvent, *, down: bool) -> None:
        key = Qt.Key(event.key())
        if key not in _MODIFIERS or event.isAutoRepeat() or self._pointer is None:
            return
        name, _flag = _MODIFIERS[key]
        self._pointer = _with_keys(self._pointer, event.modifiers(), **{name: down})
        self.move_again()

    def move_again(self) -> None:
        """Repeat the last move after a modifier key or the view has changed."""
        if self._pointer is None or self._panning.is_active:
            return
        pixel_map, pixel = self.pixel_map, self._pointer.pixel
        self._pointer = replace(self._pointer, position=pixel_map.plane(*pixel), scale=pixel_map.sx)
        if self.is_dragging:
            self._moved(self._pointer)
        elif not self._is_held:
            self._hovered_at(self._pointer)

    def wheelEvent(self, event: QWheelEvent) -> None:
        self._scrolling.wheel(event)
        event.accept()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        self._panning.change_key(event, down=True)
        self._change_modifier(event, down=True)
        event.ignore()

    def keyReleaseEvent(self, event: QKeyEvent) -> None:
        self._panning.change_key(event, down=False)
        self._change_modifier(event, down=False)
        event.ignore()

    def enterEvent(self, event: QEnterEvent) -> None:
        event.accept()

    def leaveEvent(self, event: QEvent) -> None:
        if not self.is_dragging:
            self._pointer = None
        self._left()
        event.accept()

    def focusInEvent(self, event: QFocusEvent) -> None:
        # With the mouse, no frame is needed.
        self._show_focus(event.reason() in _BY_KEYS)
        super().focusInEvent(event)

    def focusOutEvent(self, event: QFocusEvent) -> None:
        self._show_focus(False)
        self._panning.reset_key()
        super().focusOutEvent(event)
