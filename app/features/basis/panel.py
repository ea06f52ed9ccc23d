"""The basis panel: the functions with the gestures of the t-rail, typing at a tick, and the menu."""

from __future__ import annotations

from msgspec.structs import replace
from PySide6.QtCore import QPoint, QPointF, Qt, Signal
from PySide6.QtGui import QContextMenuEvent, QFocusEvent, QKeyEvent, QMouseEvent

from ...plotting.camera import CameraOverT
from ...plotting.tool_plot import ToolPlot
from ...tools.pointer import Hit, Part, Pointer
from ...tools.tool import CanvasQueries, Finder
from ...tools.toolbox import Toolbox
from .hits import hit_test
from .layers import rail_height
from .scene import BasisScene
from .tick_edit import TickEdit


class BasisPanel(ToolPlot, CanvasQueries):
    """The basis functions of the active curve over t, with the gestures on them.

    Attributes
    ----------
    drawing
        The scene: what is drawn.

    Signals
    -------
    drag_changed
        Ticks are being dragged, or no longer.
    tick_pointed
        A menu about the tick of a point is wanted.
    menu_requested
        The menu of the t-rail is wanted at a place of the screen.

    Attributes
    ----------
    tick_edit
        Reports a t that was typed.
    """

    drag_changed = Signal(bool)
    tick_pointed = Signal(int)
    menu_requested = Signal(QPoint)

    camera: CameraOverT
    camera_class = CameraOverT

    def __init__(self, tools: Toolbox) -> None:
        super().__init__(tools)
        tools.surface = self
        self.setObjectName("basisPanel")
        self.drawing = BasisScene(self, self.camera)
        self._ripple_down = False
        self.tick_edit = TickEdit(self)
        self.gesture_began.connect(self.drawing.hold_domain)
        self.gesture_ended.connect(self.drawing.release_domain)
        self.gesture_ended.connect(lambda: self.drag_changed.emit(False))

    # Gestures

    def _pressed(self, pointer: Pointer) -> None:
        super()._pressed(pointer)
        if self.tools.is_dragging:
            self.drag_changed.emit(True)

    def abandon_gesture(self) -> None:
        """Drop the gesture in flight, and what is being typed; the document is another one."""
        self.tick_edit.hide()
        super().abandon_gesture()

    def hit(self, pointer: Pointer, tool: Finder) -> Hit | None:
        drawing = self.drawing
        return hit_test(pointer, self.pixel_map, drawing.basis, drawing.rail, drawing.functions.kinds)

    def rail_pixel(self, t: float) -> QPointF:
        """Return where in the viewport the tick at `t` is grabbed."""
        shown = self.pixel_map
        area = QPointF(shown.point(t, 0.0)[0], shown.height - rail_height(self.layers.scale) + 8)
        return self.camera.origin + area

    def set_scale(self, scale: float) -> None:
        """Enlarge lines, ticks and numbers, for a projector."""
        super().set_scale(scale)
        self.drawing.show_values()

    def pointer_at(self, event: QMouseEvent | QPointF) -> Pointer:
        return replace(super().pointer_at(event), ripple=self._ripple_down)

    # Typing at a tick, its menu, and keys

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        hit = self._hit_at(event.position()) if event.button() == Qt.MouseButton.LeftButton else None
        if hit is not None and hit.part is Part.TICK and not event.modifiers():
            self._edit_knot(hit.knot)
            event.accept()
        else:
            super().mouseDoubleClickEvent(event)

    def edit_tick(self, point: int) -> None:
        """Let the person type the parameter of a point at its tick."""
        if len(self.drawing.rail.parameters):
            self._edit_knot(point)

    def _edit_knot(self, knot: int) -> None:
        self.tools.cancel()
        t = float(self.drawing.rail.parameters[knot])
        place = self.rail_pixel(t) - QPointF(0, 8)
        self.tick_edit.open(knot, t, QPointF(self.viewport().mapTo(self, place.toPoint())))

    def _menu_wanted(self, event: QContextMenuEvent) -> None:
        """Ask for the menu of the t-rail."""
        self._select_for_menu(event)
        self.menu_requested.emit(event.globalPos())

    def _select_for_menu(self, event: QContextMenuEvent) -> None:
        """Let a right click on a tick that is not selected select it: the menu is about it."""
        if event.reason() != QContextMenuEvent.Reason.Mouse:
            return
        hit = self._hit_at(QPointF(event.pos()))
        if hit is not None and hit.part is Part.TICK:
            self.tick_pointed.emit(hit.index)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_E and not event.modifiers():
            # The repeats count, too: the press may have gone to another widget, before the mouse came here.
            self._set_ripple(down=True)
            event.accept()
        else:
            super().keyPressEvent(event)

    def keyReleaseEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_E and not event.isAutoRepeat():
            self._set_ripple(down=False)
        super().keyReleaseEvent(event)

    def focusOutEvent(self, event: QFocusEvent) -> None:
        self._set_ripple(down=False)
        super().focusOutEvent(event)

    def _set_ripple(self, *, down: bool) -> None:
        """Note whether E is down, and show at once what it changes of a drag, or would of a press."""
        was_down, self._ripple_down = self._ripple_down, down
        if down != was_down and self._pointer is not None:
            self._pointer = replace(self._pointer, ripple=down)
            self.move_again()
            self.tell()
