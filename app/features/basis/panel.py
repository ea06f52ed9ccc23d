"""The plot of basis functions: its hit test, a t typed at its tick, and the gestures."""

from __future__ import annotations

import numpy as np
from msgspec.structs import replace
from PySide6.QtCore import QPoint, QPointF, Qt, Signal
from PySide6.QtGui import QContextMenuEvent, QFocusEvent, QKeyEvent, QMouseEvent
from PySide6.QtWidgets import QWidget

from ...appearance.theme import Theme
from ...document.expression import ExpressionError
from ...plotting.camera import CameraOverT
from ...plotting.pixel_map import PixelMap
from ...plotting.tool_plot import ToolPlot
from ...qt.labels import WARNING, Label
from ...tools.pointer import Hit, Part, Pointer
from ...tools.tool import CanvasQueries
from ...tools.toolbox import Toolbox
from ...view_model.basis import BasisView
from ...widgets.boxes import column_of
from ...widgets.fields import PopupLine, read_number
from ...widgets.frames import OverlayFrame
from ...widgets.number_text import decimal_mark, exact_text
from .scene import BasisScene, RailLayer, rail_height

TICK_REACH = 10.0
"""Pixels to either side of a tick within which it is grabbed."""

FUNCTION_REACH = 10.0

_SCRUB_REACH = 4.0

_NODE_REACH = 5.0


def hit_test(
    pointer: Pointer, pixel_map: PixelMap, basis: BasisView | None, rail: RailLayer, kinds: frozenset[int]
) -> Hit | None:
    """Return the part under the pointer: on the rail a tick, above it the scrub line or a function.

    On the edge of the rail lie the dots of control points; a nearer tick, or one pointed at, comes first.
    """
    if (node := _hit_node(pointer, pixel_map, rail)) is not None:
        return node
    if pointer.pixel[1] > pixel_map.height - rail_height(rail.scale) - 2:
        return _hit_tick(pointer, pixel_map, rail)
    scrub = rail.scrub
    if scrub is not None and abs(pixel_map.point(scrub, 0)[0] - pointer.pixel[0]) <= _SCRUB_REACH:
        return Hit(Part.SCRUB, -1, (scrub, 0.0))
    return _hit_line(pointer, pixel_map, basis, kinds) if basis is not None else None


def _hit_node(pointer: Pointer, pixel_map: PixelMap, rail: RailLayer) -> Hit | None:
    if rail.visible_nodes is None:
        return None
    top = pixel_map.height - rail_height(rail.scale)
    if abs(pointer.pixel[1] - top) > _NODE_REACH:
        return None
    distances = np.abs(pixel_map.x(rail.visible_nodes) - pointer.pixel[0])
    index = int(np.argmin(distances))
    nearest_tick = float(np.abs(pixel_map.x(rail.parameters) - pointer.pixel[0]).min())
    if distances[index] > _NODE_REACH or (pointer.pixel[1] > top and nearest_tick <= distances[index]):
        return None
    return Hit(Part.DOT, index, (float(rail.visible_nodes[index]), 0.0))


def _hit_tick(pointer: Pointer, pixel_map: PixelMap, rail: RailLayer) -> Hit | None:
    parameters = rail.parameters
    if not len(parameters):
        return None
    distances = np.abs(pixel_map.x(parameters) - pointer.pixel[0])
    # A selected tick wins over its neighbours.
    for index in np.flatnonzero(distances <= TICK_REACH).tolist():
        if rail.owner(index) in rail.selection:
            distances[index] -= TICK_REACH
    index = int(np.argmin(distances))
    if distances[index] > TICK_REACH:
        return None
    return Hit(Part.TICK, rail.owner(index), (float(parameters[index]), 0.0), knot=index)


def _hit_line(pointer: Pointer, pixel_map: PixelMap, basis: BasisView, kinds: frozenset[int]) -> Hit | None:
    t = pointer.position[0]
    start, end = basis.curve.domain
    if not start <= t <= end:
        return None
    best: tuple[float, Hit] | None = None
    for kind in basis.drawn_kinds(kinds):
        values = basis.value_at(t, kind)
        distances = np.abs(pixel_map.y(values) - pointer.pixel[1])
        # Functions that are zero here lie on top of each other; none of them is hit.
        distances[values == 0] = np.inf
        index = int(np.argmin(distances))
        if distances[index] <= FUNCTION_REACH and (best is None or distances[index] < best[0]):
            hit = Hit(Part.FUNCTION, basis.owners[index], (t, float(values[index])), order=kind)
            best = (float(distances[index]), hit)
    return best[1] if best is not None else None


_WIDTH, _WIDEST_REASON = 150, 320


class TickEdit(OverlayFrame):
    """A line for a number or an expression at a tick; Enter sets it, Escape or a click elsewhere cancels.

    The reason of a refusal stands above the line, and the text stays for correction.

    Signals
    -------
    typed
        (knot, t) was typed and confirmed; the receiver answers with `close_and_return` or `refuse`.
    """

    typed = Signal(int, float)

    def __init__(self, parent: QWidget) -> None:
        super().__init__("tickEdit", parent)
        self._knot = -1
        self._tick = QPointF()
        self._reason = Label(name="tickProblem", wordWrap=True, role=WARNING)
        tip = "A number or an expression such as 1/3. Enter sets it, Escape cancels"
        self.line = PopupLine("tickValue", "Parameter t", tip)
        self.line.entered.connect(self.confirm)
        self.line.given_up.connect(self.close_and_return)
        self.line.left.connect(self.hide)
        self._rows = column_of(self._reason, self.line, margins=6, spacing=4, parent=self)
        self.follow_theme()
        self.hide()

    @property
    def problem(self) -> str:
        """Reason why the typed number cannot be set; empty for none."""
        return self._reason.text()

    def open(self, knot: int, t: float, tick: QPointF) -> None:
        """Open the line for the parameter `t` of `knot`, above its tick at a pixel of the parent."""
        self._knot, self._tick = knot, tick
        self.line.setText(exact_text(t, decimal_mark()))
        self.line.selectAll()
        self.refuse("")

    def confirm(self) -> None:
        """Read the typed number and report it."""
        try:
            t = read_number(self.line.text())
        except ExpressionError as reason:
            self.refuse(str(reason))
            return
        self.refuse("")
        self.typed.emit(self._knot, t)

    def refuse(self, reason: str) -> None:
        """Show why the number cannot be set, and keep it for correction."""
        self._reason.show_text(reason)
        self.place()
        self.show()
        self.raise_()
        self.line.setFocus(Qt.FocusReason.PopupFocusReason)

    def close_and_return(self) -> None:
        """Hide the line and focus the panel."""
        self.below.setFocus(Qt.FocusReason.PopupFocusReason)
        self.hide()

    def place(self) -> None:
        parent = self.below
        width = min(_WIDEST_REASON if self.problem else _WIDTH, parent.width())
        self._rows.activate()
        height = max(self.heightForWidth(width), self.minimumSizeHint().height())
        left = min(max(int(self._tick.x()) - width // 2, 0), parent.width() - width)
        self.setGeometry(left, max(int(self._tick.y()) - height - 4, 0), width, height)

    def set_theme(self, theme: Theme) -> None:
        self.set_sheet()


class BasisPanel(ToolPlot, CanvasQueries):
    """The basis functions of the active curve over t, with the gestures on them.

    Attributes
    ----------
    drawing
        The scene with all layers.

    Signals
    -------
    drag_changed
        A drag of ticks has begun or ended.
    tick_pointed
        A menu of the tick of a point is requested.
    menu_requested
        The menu of the t-rail is requested at a position of the screen.

    Attributes
    ----------
    tick_edit
        The line in which a t is typed.
    """

    drag_changed = Signal(bool)
    tick_pointed = Signal(int)
    menu_requested = Signal(QPoint)

    camera: CameraOverT
    camera_class = CameraOverT

    def __init__(self, tools: Toolbox) -> None:
        super().__init__(tools)
        tools.canvas = self
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
        """Drop the gesture in flight and the text being typed: another document is open."""
        self.tick_edit.hide()
        super().abandon_gesture()

    def hit(self, pointer: Pointer, parts: frozenset[Part]) -> Hit | None:
        drawing = self.drawing
        return hit_test(pointer, self.pixel_map, drawing.basis, drawing.rail, drawing.functions.kinds)

    def rail_pixel(self, t: float) -> QPointF:
        """Return the pixel of the viewport at which the tick at `t` is grabbed."""
        pixel_map = self.pixel_map
        area = QPointF(pixel_map.point(t, 0.0)[0], pixel_map.height - rail_height(self.layers.scale) + 8)
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
        """Let the user type the parameter of a point at its tick."""
        if len(self.drawing.rail.parameters):
            self._edit_knot(point)

    def _edit_knot(self, knot: int) -> None:
        self.tools.cancel()
        t = float(self.drawing.rail.parameters[knot])
        pixel = self.rail_pixel(t) - QPointF(0, 8)
        self.tick_edit.open(knot, t, QPointF(self.viewport().mapTo(self, pixel.toPoint())))

    def _menu_wanted(self, event: QContextMenuEvent) -> None:
        """Ask for the menu of the t-rail."""
        self._select_for_menu(event)
        self.menu_requested.emit(event.globalPos())

    def _select_for_menu(self, event: QContextMenuEvent) -> None:
        """Select the tick under a right click, which the menu is about, if it is not selected."""
        if event.reason() != QContextMenuEvent.Reason.Mouse:
            return
        hit = self._hit_at(QPointF(event.pos()))
        if hit is not None and hit.part is Part.TICK:
            self.tick_pointed.emit(hit.index)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_E and not event.modifiers():
            # Repeats count as well: the press may have gone to another widget before the mouse came here.
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
        """Record whether E is down, and update the drag or the hint at once."""
        was_down, self._ripple_down = self._ripple_down, down
        if down != was_down and self._pointer is not None:
            self._pointer = replace(self._pointer, ripple=down)
            self.move_again()
            self.show_status()
