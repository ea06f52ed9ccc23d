"""The canvas: the widget of the drawing, with tools, menus and rulers."""

from __future__ import annotations

from collections.abc import Iterable

from PySide6.QtCore import QPoint, QPointF, Qt, Signal
from PySide6.QtGui import QContextMenuEvent, QFocusEvent, QKeyEvent, QMouseEvent
from PySide6.QtWidgets import QWidget

from ..document.fields import Scroll
from ..document.model import Axis, Vector
from ..plotting.axes import Extent
from ..plotting.camera import Camera
from ..plotting.scrolling import EdgeScroll
from ..plotting.tool_plot import MOVING_KEYS, ToolPlot
from ..tools.box import TransformKind
from ..tools.guides import hint_on_ruler, press_on_ruler
from ..tools.marks import Marks
from ..tools.pointer import Hint, Hit, Part, Pointer
from ..tools.tool import CanvasQueries, ToolRecord
from ..tools.toolbox import Toolbox
from ..tools.transform import transform_by_key
from .fitting import Framing
from .scene import CanvasScene


class SteadyView:
    """Keeps scale and position of the drawing while panels beside the canvas are resized.

    Only when the window is resized, the drawing is fitted again, unless the user has zoomed, panned or drawn
    since it was fitted.
    """

    def __init__(self, canvas: QWidget, camera: Camera, framing: Framing) -> None:
        self._canvas, self._camera, self._framing = canvas, camera, framing
        self._window_size = canvas.window().size()
        self._remember()
        camera.changed.connect(self._remember)
        camera.resized = self._follow_size

    def _remember(self) -> None:
        self._pixel_map, self._corner = self._camera.pixel_map, self._drawing_corner()

    def _drawing_corner(self) -> QPointF:
        """Return the corner of the drawing in the window."""
        return self._camera.origin + QPointF(self._canvas.mapTo(self._canvas.window(), QPoint()))

    def _follow_size(self) -> None:
        size = self._canvas.window().size()
        is_new, self._window_size = size != self._window_size, size
        if is_new and self._framing.is_as_fitted:
            self._framing.fit()
        else:
            moved = self._drawing_corner() - self._corner
            self._camera.keep(self._pixel_map, (moved.x(), moved.y()))
        self._remember()


class DrawnCanvas(CanvasQueries):
    """The drawing as tools see it.

    Parameters
    ----------
    plot, drawing
        The plot, and the scene with all layers.
    """

    def __init__(self, plot: Canvas, drawing: CanvasScene) -> None:
        self._plot, self._drawing = plot, drawing

    def hit(self, pointer: Pointer, parts: frozenset[Part]) -> Hit | None:
        return self._drawing.hit(pointer, parts)

    def locked_at(self, pointer: Pointer) -> int:
        return self._drawing.locked_at(pointer)

    def grid_spacing(self) -> float:
        return self._drawing.grid.spacing(self._plot.pixel_map)

    def shows_curves(self, indices: Iterable[int]) -> bool:
        return self._plot.framing.shows_curves(indices)

    def scroll_of_drag(self) -> Scroll:
        return self._plot.edge.scroll


class Canvas(ToolPlot):
    """The drawing area: a plot of equal aspect with the tools of the toolbar, menus and rulers.

    It shows the views that it is given and sends mouse and keys to its `Toolbox`; it changes no document.
    ``canvas.to_pixel(x, y)`` and ``canvas.to_plane(pixel)`` convert positions, for tests as well.

    Attributes
    ----------
    drawing
        The scene with all layers.
    framing
        Fits the drawing into the view.
    edge
        Scrolls it during a drag at the edge.

    Signals
    -------
    menu_requested
        A menu is requested: for a Hit or None, at a position of the screen.
    guide_drawn
        A press on a ruler has begun to draw a guide.
    guide_opened
        The position of a guide, given by its index, shall be typed; or of a new one, given by its axis.
    """

    menu_requested = Signal(object, QPoint)
    guide_drawn = Signal()
    guide_opened = Signal(object)

    def __init__(self, tools: Toolbox, parent: QWidget | None = None) -> None:
        super().__init__(tools, parent)
        self.setObjectName("canvas")
        self.setAccessibleName("Canvas")
        self.setAccessibleDescription("The curve with its points; drag points to change it.")
        self.getViewBox().setAspectLocked(True)
        self.drawing = CanvasScene(self)
        tools.canvas = DrawnCanvas(self, self.drawing)
        self.framing = Framing(self.camera, self.drawing)
        self._steady = SteadyView(self.viewport(), self.camera, self.framing)
        self._menu_pointer: Pointer | None = None
        self.edge = EdgeScroll(self.camera, self.viewport(), self.move_again)
        self.camera.changed.connect(self.hover_again)

    # Display

    @property
    def marks(self) -> Marks:
        """The marks of the gestures over the drawing."""
        return self.drawing.marks.marks

    # Gestures

    def _moved(self, pointer: Pointer) -> None:
        super()._moved(pointer)
        if self._is_held and self.tools.scrolls_view:
            self.edge.follow(pointer.pixel)

    def cancel_gesture(self) -> bool:
        self.edge.restore()
        return super().cancel_gesture()

    def abandon_gesture(self) -> None:
        if self.is_dragging:
            self.edge.restore()
        super().abandon_gesture()

    def _end_gesture(self) -> None:
        self.edge.stop()
        super()._end_gesture()

    def show_marks(self) -> None:
        self.drawing.show_marks(self.tools.marks())
        self._mark_rulers()

    def _mark_rulers(self) -> None:
        """Mark the pointer and the selection on the rulers."""
        if self.rulers.are_visible:
            box = self.tools.box.rectangle
            extent = Extent(box.low, box.high) if box is not None else None
            self.rulers.show(self._pointer.pixel if self._pointer is not None else None, extent)

    # Tools

    def choose_tool(self, record: ToolRecord) -> None:
        """Choose the tool in use."""
        self.edge.restore()
        self.tools.choose(record)
        self._show_tool()

    def _show_tool(self) -> None:
        tool = self.tools.tool
        self.drawing.image.set_grips(Part.IMAGE in tool.hits)
        self.drawing.points.shows_new_handle = tool.shows_new_handle
        self.drawing.points.refresh()
        self._show_cursor(Hint())
        self._end_gesture()
        self.viewport().update()

    def begin_transform(self, kind: TransformKind) -> None:
        """Transform the selected points, or else all, by the pointer until Enter, a click or Escape."""
        self.setFocus(Qt.FocusReason.OtherFocusReason)
        pointer, tools = self._pointer_now(), self.tools
        if tools.is_buttonless:
            has_begun = tools.key(kind.key)
        elif tools.is_pressed:
            has_begun = False
        else:
            has_begun = tools.begin(lambda event: transform_by_key(event, kind), pointer, buttonless=True)
        if has_begun:
            self.gesture_began.emit()
            self._pointer = self._pointer or pointer
            self._show_progress()

    def position_of(self, pointer: Pointer) -> object:
        """Return the position of the dragged point, which may be snapped, or of the pointer."""
        return self.tools.dragged_position() or pointer.position

    @property
    def pointed_position(self) -> Vector:
        """The position under the pointer or its menu; the middle of the view if the mouse is elsewhere."""
        if self._pointer is None and self._menu_pointer is not None:
            return self._menu_pointer.position
        return self._pointer_now().position

    # Guides out of the rulers

    def _axis_at(self, pointer: Pointer) -> Axis | None:
        """Return the axis of guides from the ruler under the pointer; None elsewhere."""
        ruler = None if self.tools.is_buttonless else self.rulers.axis_at(pointer.pixel)
        # Guides are parallel to their ruler.
        return None if ruler is None else (Axis.Y, Axis.X)[ruler]

    def _pressed(self, pointer: Pointer) -> None:
        self.edge.begin(pointer.pixel)
        axis = self._axis_at(pointer)
        if axis is None:
            super()._pressed(pointer)
            return
        self.guide_drawn.emit()
        self.gesture_began.emit()
        self.tools.begin(lambda event: press_on_ruler(event, axis), pointer)
        self._show_progress()

    def _hovered_at(self, pointer: Pointer) -> None:
        self._menu_pointer = None
        axis = self._axis_at(pointer)
        if axis is None:
            super()._hovered_at(pointer)
            return
        self.tools.leave()
        self.show_marks()
        hint = hint_on_ruler(axis)
        self._show_cursor(hint)
        self.hint_changed.emit(hint.text)
        self.pointed_at.emit(pointer.position)

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        pointer = self.pointer_at(event)
        axis, hit = self._axis_at(pointer), self._hit_at(event.position())
        if event.button() == Qt.MouseButton.LeftButton and axis is not None:
            self.guide_opened.emit(axis)
        elif event.button() == Qt.MouseButton.LeftButton and hit is not None and hit.part is Part.GUIDE:
            self.guide_opened.emit(hit.index)
        else:
            super().mouseDoubleClickEvent(event)
            return
        event.accept()

    # Menus and keys

    def _menu_wanted(self, event: QContextMenuEvent) -> None:
        """Request a menu for the hit under the pointer or, by the Menu key, for the selection."""
        by_key = event.reason() == QContextMenuEvent.Reason.Keyboard
        pixel = self.framing.selected_pixel() if by_key else QPointF(event.pos())
        hit = self._hit_at(pixel) if pixel is not None else None
        group = self.tools.box.group
        if by_key and pixel is None and group is not None and group.is_whole:
            middle = self.tools.box.bounds.centre
            centre = self.camera.to_pixel(*middle)
            pixel = QPointF(centre) if self.viewport().rect().contains(centre) else None
            hit = Hit(Part.OTHER_CURVE, self.tools.event.session.active_index, middle)
        corner = (pixel or self.camera.centre()).toPoint()
        self._menu_pointer = self.pointer_at(QPointF(corner))
        self.menu_requested.emit(hit, self.viewport().mapToGlobal(corner))

    def hit_at(self, position: QPoint) -> Hit | None:
        """Return the hit at a position of the screen."""
        return self._hit_at(QPointF(self.viewport().mapFromGlobal(position)))

    def give_key(self, key: str, event: QKeyEvent | None = None) -> bool:
        """Give the tool a key, and keep the points visible that arrows and Tab move or select."""
        had_effect = super().give_key(key, event)
        if had_effect and key in MOVING_KEYS and Part.IMAGE not in self.tools.tool.hits:
            self.framing.reveal_selected()
        return had_effect

    def focusOutEvent(self, event: QFocusEvent) -> None:
        # A transform without a button ends with the focus, unless a menu or another window borrows it.
        borrowed = (Qt.FocusReason.PopupFocusReason, Qt.FocusReason.ActiveWindowFocusReason)
        if self.tools.is_buttonless and event.reason() not in borrowed:
            self.cancel_gesture()
        super().focusOutEvent(event)
