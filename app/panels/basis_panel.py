"""The basis panel: every basis function over t, the t-rail at its foot, and the scrub line."""

from __future__ import annotations

import numpy as np
from msgspec.structs import replace
from PySide6.QtCore import QPoint, QPointF, Qt, Signal
from PySide6.QtGui import QContextMenuEvent, QFocusEvent, QKeyEvent, QMouseEvent
from PySide6.QtWidgets import QWidget

from app.document.edits import EditError
from app.gestures.pointer import Hit, Part, Pointer
from app.gestures.rail import RailTool
from app.panels.basis_layers import FunctionLayer, RailLayer, rail_height
from app.panels.tick_edit import TickEdit
from app.plot.plot_widget import PlotWidget
from app.theme import LIGHT, Theme
from app.view_model.basis_view import BasisView, basis_view
from app.view_model.curve_view import CurveView

TICK_REACH = 10.0
"""Pixels to either side of a tick within which it is grabbed."""

FUNCTION_REACH = 10.0

_CALM_RANGE = (-0.5, 1.2)
_PADDING = 0.035


class BasisPanel(PlotWidget):
    """Draws all basis functions of the active curve; x axis t.

    Signals
    -------
    hint_changed
        What a press here would do (a sentence).
    progress_changed
        How far the gesture in flight has come (a sentence); empty when it has ended.
    gesture_began
        A press begins a gesture.
    pointed_at
        The parameter t under the pointer, or None when it has left.
    extent_changed
        (least, greatest) value of the functions if they leave the visible range, else None.
    drag_changed
        Ticks are being dragged, or no longer.
    menu_requested
        The menu of the t-rail is wanted at a place of the screen.
    """

    hint_changed = Signal(str)
    progress_changed = Signal(str)
    gesture_began = Signal()
    pointed_at = Signal(object)
    extent_changed = Signal(object)
    drag_changed = Signal(bool)
    menu_requested = Signal(QPoint)

    def __init__(self, tool: RailTool, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("basisPanel")
        self.setAccessibleName("Basis functions")
        self.setAccessibleDescription("The basis functions over t; drag a tick at the foot to change t.")
        self._tool = tool
        self._view: CurveView | None = None
        self._basis: BasisView | None = None
        self._values: tuple[float, float] = _CALM_RANGE
        self._functions = FunctionLayer(self, LIGHT)
        self._rail = RailLayer(self, LIGHT)
        self.getViewBox().sigResized.connect(self._show_values)
        self._ripple_down = False
        self._pointer: Pointer | None = None
        self.tick_edit = TickEdit(self)
        self.tick_edit.typed.connect(self._set_tick)

    # What is shown

    def render_view(self, view: CurveView) -> None:
        """Show the functions of `view`; they are sampled again only if a parameter or the family changed."""
        self._view = view
        if _is_of(self._basis, view):
            return
        old = self._basis
        self._basis = basis_view(view, self._basis)
        self._functions.render(self._basis)
        self._rail.render(self._basis)
        moved = self._basis is not None and (old is None or old.curve.domain != self._basis.curve.domain)
        if (moved or not view.source.nodes) and not self._tool.is_pressed:
            self.fit_domain()
        self._report_extent()

    @property
    def emphasised(self) -> frozenset[int]:
        """The points whose functions are drawn thick."""
        return self._functions.emphasised

    @property
    def kinds(self) -> frozenset[int]:
        """The kinds of functions that are shown."""
        return self._functions.kinds

    @property
    def basis(self) -> BasisView | None:
        """The functions on screen, None without a curve."""
        return self._basis

    def set_theme(self, theme: Theme) -> None:
        """Take the colours of `theme`."""
        self._functions.theme = self._rail.theme = theme
        super().set_theme(theme)

    def set_scale(self, scale: float) -> None:
        """Enlarge lines, ticks and numbers, for a projector."""
        self._functions.scale = self._rail.scale = scale
        super().set_scale(scale)
        self._show_values()

    def set_selection(self, selection: frozenset[int]) -> None:
        """Draw the functions of these points thick."""
        self._rail.selection = selection
        self._emphasise()

    def set_hovered(self, index: int) -> None:
        """Draw the functions of this point thick, too (−1 for none)."""
        self._rail.hovered = index
        self._emphasise()

    def _emphasise(self) -> None:
        hovered = self._rail.hovered
        self._functions.emphasised = self._rail.selection | ({hovered} if hovered >= 0 else frozenset())
        self._functions.refresh()
        self._rail.refresh()

    def set_scrub(self, t: float | None) -> None:
        """Move the scrub line, or put it away (None)."""
        self._rail.scrub = t
        self._rail.refresh()

    def set_kinds(self, kinds: frozenset[int]) -> None:
        """Show these kinds of functions: 0 position, 1 velocity, 2 acceleration."""
        self._functions.kinds = kinds
        self._functions.refresh()
        self._report_extent()

    # Ranges

    def fit_domain(self) -> None:
        """Show the whole interval of t."""
        domain = self._domain()
        if domain is not None:
            start, end = domain
            padding = _PADDING * (end - start)
            self.getViewBox().setXRange(start - padding, end + padding, padding=0)
        self._show_values()

    @property
    def t_range(self) -> tuple[float, float]:
        """The part of t that is visible."""
        start, _, end, _ = self.pixel_map.box
        return start, end

    def set_t_range(self, start: float, end: float) -> None:
        """Show this part of t."""
        self.getViewBox().setXRange(start, end, padding=0)

    def _domain(self) -> tuple[float, float] | None:
        """Return the interval of t; without points that which the rule is going to span, else None."""
        if self._basis is not None:
            return self._basis.curve.domain
        if self._view is None or self._view.source.nodes:
            return None
        rule = self._view.source.parametrization
        return rule.start, rule.end

    def fit_values(self) -> None:
        """Show the functions from their least to their greatest value."""
        if self._basis is not None:
            low, high = self._basis.extent(self._functions.kinds)
            margin = 0.05 * (high - low)
            self._values = (min(low - margin, _CALM_RANGE[0]), max(high + margin, _CALM_RANGE[1]))
            self._show_values()

    def calm_values(self) -> None:
        """Show the usual range again, −0.5 to 1.2."""
        self._values = _CALM_RANGE
        self._show_values()

    def _show_values(self) -> None:
        """Map the range of values to the part of the plot area above the rail."""
        low, high = self._values
        height = self.getViewBox().rect().height()
        rail = rail_height(self._rail.scale)
        share = rail / max(height - rail, 1.0)
        self.getViewBox().setYRange(low - share * (high - low), high, padding=0)
        self._report_extent()

    def _report_extent(self) -> None:
        extent = self._basis.extent(self._functions.kinds) if self._basis is not None else None
        low, high = self._values
        inside = extent is None or (extent[0] >= low and extent[1] <= high)
        self.extent_changed.emit(None if inside else extent)

    def zoom(self, factor: float, pixel: QPointF) -> None:
        """Zoom along t."""
        t, _ = self.to_plane(pixel)
        start, _, end, _ = self.pixel_map.box
        self.getViewBox().setXRange(t + (start - t) / factor, t + (end - t) / factor, padding=0)

    def pan(self, dx: float, dy: float) -> None:
        """Move along t."""
        start, _, end, _ = self.pixel_map.box
        by = -dx / self.pixel_map.sx
        self.getViewBox().setXRange(start + by, end + by, padding=0)

    def rail_pixel(self, t: float) -> QPointF:
        """Return where in the viewport the tick at `t` is grabbed."""
        shown = self.pixel_map
        area = QPointF(shown.point(t, 0.0)[0], shown.height - rail_height(self._rail.scale) + 8)
        return self._area_origin() + area

    # Gestures

    @property
    def is_dragging(self) -> bool:
        """Whether a gesture is in flight."""
        return self._tool.is_pressed

    def cancel_gesture(self) -> bool:
        """Drop the gesture in flight; return whether there was one."""
        was_pressed = self._tool.cancel()
        self._end_gesture()
        return was_pressed

    def forget_gesture(self) -> None:
        """Drop the gesture in flight; the document is another one."""
        self._tool.forget()
        self._end_gesture()

    def _end_gesture(self) -> None:
        self.drag_changed.emit(False)
        self.progress_changed.emit("")

    def pressed(self, pointer: Pointer) -> None:
        self.gesture_began.emit()
        hit = self._hit(pointer)
        if hit is not None and hit.part is Part.TICK:
            self.drag_changed.emit(True)
        self._tool.press(replace(pointer, hit=hit), self._rail.scrub)

    def moved(self, pointer: Pointer) -> None:
        pointer = replace(pointer, ripple=self._ripple_down)
        self._tool.move(pointer)
        self.progress_changed.emit(self._tool.progress(pointer))
        self.pointed_at.emit(pointer.position[0])

    def released(self, pointer: Pointer) -> None:
        self._tool.release(replace(pointer, ripple=self._ripple_down))
        self._end_gesture()
        x, y = pointer.pixel
        if 0 <= x <= self.pixel_map.width and 0 <= y <= self.pixel_map.height:
            self.hovered_at(pointer)
        else:
            self.left()

    def hovered_at(self, pointer: Pointer) -> None:
        self._pointer = pointer
        hint = self._tool.hover(replace(pointer, hit=self._hit(pointer)))
        shape = Qt.CursorShape.SizeHorCursor if hint.grab else Qt.CursorShape.ArrowCursor
        self.viewport().setCursor(shape)
        self.hint_changed.emit(hint.text)
        self.pointed_at.emit(pointer.position[0])

    def hover_again(self) -> None:
        """Tell anew what lies under a pointer that rests while the functions change."""
        if self._pointer is not None and not self.is_dragging and not self._panning.is_active:
            pixel = self._pointer.pixel
            self.hovered_at(Pointer(self.pixel_map.plane(*pixel), pixel, scale=self.pixel_map.sx))

    def left(self) -> None:
        if not self._tool.is_pressed:
            self._pointer = None
            self._tool.hover(Pointer((np.inf, np.inf), (np.inf, np.inf)))
            self.hint_changed.emit("")
            self.pointed_at.emit(None)

    def _hit(self, pointer: Pointer) -> Hit | None:
        if self._basis is None:
            return None
        if pointer.pixel[1] > self.pixel_map.height - rail_height(self._rail.scale) - 2:
            return self._hit_tick(pointer)
        scrub = self._rail.scrub
        if scrub is not None and abs(self.pixel_map.point(scrub, 0)[0] - pointer.pixel[0]) <= 4:
            return Hit(Part.SCRUB, -1, (scrub, 0.0))
        return self._hit_function(pointer)

    def _hit_tick(self, pointer: Pointer) -> Hit | None:
        assert self._basis is not None
        parameters = self._basis.curve.parameters
        distances = np.abs(self.pixel_map.x(parameters) - pointer.pixel[0])
        # A selected tick wins over its neighbours.
        for index, owner in enumerate(self._basis.owners):
            if owner in self._rail.selection and distances[index] <= TICK_REACH:
                distances[index] -= TICK_REACH
        index = int(np.argmin(distances))
        if distances[index] > TICK_REACH:
            return None
        return Hit(Part.TICK, self._basis.owners[index], (float(parameters[index]), 0.0), knot=index)

    def _hit_function(self, pointer: Pointer) -> Hit | None:
        assert self._basis is not None
        t, shown = pointer.position[0], self.pixel_map
        start, end = self._basis.curve.domain
        if not start <= t <= end:
            return None
        best: tuple[float, Hit] | None = None
        for kind in sorted(self._functions.kinds & set(range(self._basis.kinds))):
            values = self._basis.value_at(t, kind)
            distances = np.abs(shown.y(values) - pointer.pixel[1])
            # Functions that are zero here lie on top of each other; none of them is meant.
            distances[values == 0] = np.inf
            index = int(np.argmin(distances))
            if distances[index] <= FUNCTION_REACH and (best is None or distances[index] < best[0]):
                hit = Hit(Part.FUNCTION, self._basis.owners[index], (t, float(values[index])), kind=kind)
                best = (float(distances[index]), hit)
        return best[1] if best is not None else None

    # Typing at a tick, its menu, and keys

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        hit = self._hit(self.pointer_at(event)) if event.button() == Qt.MouseButton.LeftButton else None
        if hit is not None and hit.part is Part.TICK and not event.modifiers():
            self._edit_knot(hit.knot)
            event.accept()
        else:
            super().mouseDoubleClickEvent(event)

    def edit_tick(self, node: int) -> None:
        """Let the person type the parameter of a node at its tick."""
        if self._basis is not None:
            self._edit_knot(self._basis.owners.index(node))

    def _edit_knot(self, knot: int) -> None:
        assert self._basis is not None
        self._tool.cancel()
        t = float(self._basis.curve.parameters[knot])
        place = self.rail_pixel(t) - QPointF(0, 8)
        self.tick_edit.open(knot, t, QPointF(self.viewport().mapTo(self, place.toPoint())))

    def _set_tick(self, knot: int, t: float) -> None:
        if self._basis is None or knot >= self._basis.count:
            self.tick_edit.close_and_return()
            return
        try:
            self._tool.set_value(knot, t)
        except EditError as reason:
            self.tick_edit.refuse(reason)
            return
        self.tick_edit.close_and_return()

    def menu_wanted(self, event: QContextMenuEvent) -> None:
        """Ask for the menu of the t-rail."""
        self._select_for_menu(event)
        self.menu_requested.emit(event.globalPos())

    def _select_for_menu(self, event: QContextMenuEvent) -> None:
        """Let a right click on a tick that is not selected select it: the menu is about it."""
        if event.reason() != QContextMenuEvent.Reason.Mouse:
            return
        hit = self._hit(self.pointer_at(QPointF(event.pos())))
        if hit is not None and hit.part is Part.TICK:
            self._tool.choose(hit.index)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_E and not event.modifiers():
            # The repeats count, too: the press may have gone to another widget, before the mouse came here.
            self._ripple_down = True
            event.accept()
        elif (event.key() == Qt.Key.Key_Escape and self.cancel_gesture()) or self._nudge(event):
            event.accept()
        else:
            super().keyPressEvent(event)

    def _nudge(self, event: QKeyEvent) -> bool:
        """Move the selected ticks by a pixel: with Shift ten, with Ctrl a tenth."""
        direction = {Qt.Key.Key_Left: -1, Qt.Key.Key_Right: 1}.get(Qt.Key(event.key()))
        if direction is None:
            return False
        held = event.modifiers()
        step = direction / self.pixel_map.sx
        if held & Qt.KeyboardModifier.ShiftModifier:
            step *= 10
        if held & Qt.KeyboardModifier.ControlModifier:
            step /= 10
        return self._tool.nudge(step)

    def keyReleaseEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_E and not event.isAutoRepeat():
            self._ripple_down = False
        super().keyReleaseEvent(event)

    def focusOutEvent(self, event: QFocusEvent) -> None:
        self._ripple_down = False
        super().focusOutEvent(event)


def _is_of(basis: BasisView | None, view: CurveView) -> bool:
    """Tell whether these are the functions of `view`: they depend on the family and the parameters alone."""
    if basis is None or not view.is_current or len(view.source.nodes) <= basis.owners[-1]:
        return False
    same_family = basis.curve.degree == view.pieces[0].degree and basis.kinds == view.pieces[0].jets.shape[1]
    closes = (basis.owners[-1] == 0) is view.source.is_closed
    return same_family and closes and np.array_equal(view.parameters, basis.curve.parameters)
