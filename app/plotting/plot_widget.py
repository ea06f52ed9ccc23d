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

# Whatever a plot is made of: Qt calls their overrides as it calls ours.
guard_library(pg.GraphicsView, pg.GraphicsScene, pg.ViewBox, ChildGroup)


class PaintedPlot(SafeOverrides, pg.GraphicsView):  # type: ignore[misc]  # pyqtgraph has no types
    """A plot of layers, beside its axes.

    Attributes
    ----------
    camera
        Which part of the plane is seen.
    layers
        What is painted.
    rulers
        Marks on the axes, while these are rulers.

    Signals
    -------
    painted
        The viewport has been painted.
    style_changed
        Layers have another theme or scale.
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
        # The paper is in the picture of what is still; Qt need not keep another one of it.
        self.setCacheMode(QGraphicsView.CacheModeFlag.CacheNone)
        # Every pixel is painted here: Qt need not paint paper below.
        self.viewport().setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        # A dropped file is the window's business.
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

    def show_rulers(self, shown: bool) -> None:
        """Show the axes as rulers, the one along x above the drawing, or as plain axes."""
        if shown != self._axes.are_rulers:
            self._axes.set_rulers(shown)
            self.camera.follow_area()
            self.camera.changed.emit()

    # Painting

    def set_theme(self, theme: Theme) -> None:
        """Take the colours of `theme`."""
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
            # pyqtgraph resizes while it is being built.
            self.camera.reset_origin()
            self.layers.reset_ground()

    def paintEvent(self, event: QPaintEvent) -> None:
        # Nothing is an item of Qt's graphics scene: neither Qt's view nor pyqtgraph is asked to paint.
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

    def _show_focus(self, shown: bool) -> None:
        """Frame the plot while it has the keyboard's focus, or not."""
        if shown != self._shows_focus:
            self._shows_focus = shown
            self.viewport().update()


_LEFT = Qt.MouseButton.LeftButton
_NO_KEYS = Qt.KeyboardModifier.NoModifier

_MODIFIERS = {
    Qt.Key.Key_Shift: ("shift", Qt.KeyboardModifier.ShiftModifier),
    Qt.Key.Key_Control: ("ctrl", Qt.KeyboardModifier.ControlModifier),
    Qt.Key.Key_Alt: ("alt", Qt.KeyboardModifier.AltModifier),
}
"""Keys that change what a gesture does, which part of a pointer tells, and Qt's flag."""

_BY_KEYS = (
    Qt.FocusReason.TabFocusReason,
    Qt.FocusReason.BacktabFocusReason,
    Qt.FocusReason.ShortcutFocusReason,
)


def _with_keys(pointer: Pointer, held: Qt.KeyboardModifier, **changes: bool) -> Pointer:
    """Return the pointer with the modifier keys that are held, but for `changes`."""
    bits = held.value
    if not (bits or changes):
        return pointer
    flags = {name: bool(bits & flag.value) for name, flag in _MODIFIERS.values()}
    return replace(pointer, **{**flags, **changes})


class PlotWidget(PaintedPlot):
    """A plot that pans and zooms by mouse, wheel and trackpad, and hands everything else on."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._panning = Panning(self.camera, self.viewport())
        self._scrolling = Scrolling(self.camera, self.viewport())
        self._menu_refused = False
        # Where the mouse was heard of last, None once it has left; and whether its left button was down.
        self._pointer: Pointer | None = None
        self._is_held = False

    # A subclass fills in these.

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
        """The pixel of the viewport about which keys zoom: under the pointer, else in the middle."""
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
        """Handle the wish for a menu, while no gesture is in flight."""

    # Events

    def pointer_at(self, event: QMouseEvent | QPointF) -> Pointer:
        """Return the record of a mouse event (or of a bare viewport position)."""
        position, held = (
            (event, _NO_KEYS) if isinstance(event, QPointF) else (event.position(), event.modifiers())
        )
        shown, pixel = self.camera.pixel_map, self.camera.area_pixel(position)
        pointer = Pointer(shown.plane(*pixel), pixel, scale=shown.sx)
        # Python's own flags are slow, and every move of the mouse comes by here.
        return pointer if held is _NO_KEYS else _with_keys(pointer, held)

    def mousePressEvent(self, event: QMouseEvent) -> None:
        self._press_by(event, is_double=False)

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        # The second press of a double click is a press like any other, for quick clicks must all count; a
        # tool may give it a meaning of its own where it hits what the first one did.
        self._press_by(event, is_double=True)

    def _press_by(self, event: QMouseEvent, *, is_double: bool) -> None:
        if event.button() == Qt.MouseButton.RightButton:
            # It takes a gesture back, a drag as well as a transform; it must not open a menu as well.
            self._menu_refused = self._panning.is_active or (self.is_dragging and self.cancel_gesture())
            if self._menu_refused:
                event.accept()
                return
        self.setFocus(Qt.FocusReason.MouseFocusReason)
        # It may have had it: whoever goes on by mouse sees the pointer.
        self._show_focus(False)
        if self._is_held and event.button() == Qt.MouseButton.LeftButton:
            self._release()  # the release was never heard of
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
            held = event.buttons()
            if held is _LEFT or held.value & _LEFT.value:
                self._moved(self._pointer)
            elif not held.value:
                if self._is_held:
                    # The release went elsewhere: to a list that a key has opened, for instance.
                    self._release()
                self._hovered_at(self._pointer)
        event.accept()

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        # A drag with the left button ends with it, also while the middle one pans.
        if not self._panning.release(event) and event.button() == Qt.MouseButton.LeftButton:
            self._pointer, self._is_held = self.pointer_at(event), False
            self._released(self._pointer)
        event.accept()

    def event(self, event: QEvent) -> bool:
        if event.type() == QEvent.Type.WindowBlocked:
            # A dialog takes the mouse, and the release with it.
            self._release()
        if (
            event.type() == QEvent.Type.ShortcutOverride
            and isinstance(event, QKeyEvent)
            and self.is_dragging
            and Qt.Key(event.key()) in _MODIFIERS
        ):
            # Else Alt alone, let go, would go to the menu bar and take the keys along.
            event.accept()
            return True
        if isinstance(event, QNativeGestureEvent) and self._scrolling.pinch(event):
            event.accept()
            return True
        return bool(super().event(event))

    def _release(self) -> None:
        """Drop what the mouse is doing here, panning too."""
        self._is_held = False
        self._panning.reset_key()
        self._panning.stop()
        if self.is_dragging:
            self.cancel_gesture()

    def _hear_modifier(self, event: QKeyEvent, *, down: bool) -> None:
        key = Qt.Key(event.key())
        if key not in _MODIFIERS or event.isAutoRepeat() or self._pointer is None:
            return
        name, _flag = _MODIFIERS[key]
        self._pointer = _with_keys(self._pointer, event.modifiers(), **{name: down})
        self.move_again()

    def move_again(self) -> None:
        """Go on as if the pointer had moved to where it is: another key is held, or the view has moved."""
        if self._pointer is None or self._panning.is_active:
            return
        shown, pixel = self.pixel_map, self._pointer.pixel
        self._pointer = replace(self._pointer, position=shown.plane(*pixel), scale=shown.sx)
        if self.is_dragging:
            self._moved(self._pointer)
        elif not self._is_held:
            self._hovered_at(self._pointer)

    def wheelEvent(self, event: QWheelEvent) -> None:
        self._scrolling.wheel(event)
        event.accept()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        self._panning.hear_key(event, down=True)
        self._hear_modifier(event, down=True)
        event.ignore()

    def keyReleaseEvent(self, event: QKeyEvent) -> None:
        self._panning.hear_key(event, down=False)
        self._hear_modifier(event, down=False)
        event.ignore()

    def enterEvent(self, event: QEnterEvent) -> None:
        event.accept()

    def leaveEvent(self, event: QEvent) -> None:
        if not self.is_dragging:
            self._pointer = None
        self._left()
        event.accept()

    def focusInEvent(self, event: QFocusEvent) -> None:
        # Whoever came by mouse sees the pointer.
        self._show_focus(event.reason() in _BY_KEYS)
        super().focusInEvent(event)

    def focusOutEvent(self, event: QFocusEvent) -> None:
        self._show_focus(False)
        self._panning.reset_key()
        super().focusOutEvent(event)
