"""The Select tool: points, handles, the curve, the box with grips, other curves, and the rubber band."""

from __future__ import annotations

from msgspec.structs import replace

from ...document.curve_edits import locked_message
from ...document.model import Vector
from ...document.point_group import PointGroup
from ...view_model.curve.curve_view import CurveView
from ..bend import hint_on_line, press_on_line
from ..box import Grip
from ..drag_handles import GESTURES, hint_on_part, press_on_part
from ..drag_points import Click, kind_on_double_click, label_of_moved, press_on_group, toggling_kind
from ..guides import hint_on_guide, press_on_guide
from ..marks import Marks
from ..pointer import Cursor, Hint, Hit, Part
from ..select_curves import (
    activate_pressed,
    click_curve,
    deselect_curves,
    end_of_other_curve,
    hint_beside_curves,
    hint_on_curve,
    press_on_curve,
    press_on_end,
    press_with_band,
    select_hit,
)
from ..tool import Gesture, GestureRow, Tool, ToolEvent, ToolRecord
from ..transform import PIVOT_HINT, hint_inside_box, hint_on_grip, is_on_pivot, press_on_grip, press_on_pivot

_ON_EMPTY = (
    "Drag to select points, Shift adds · Escape: whole curves · P adds points · Wheel zooms, Space pans"
)


class SelectTool(Tool):
    """Tool that selects, moves and bends: `press` decides by precedence, each gesture has its file."""

    cursor = Cursor.ARROW
    hits = Tool.hits | {Part.OTHER_POINT, Part.OTHER_CURVE, Part.GUIDE}
    shows_box = True
    edits_points = False

    def __init__(self) -> None:
        # What a press would act on: a point of another curve, a guide.
        self._spot: Vector | None = None
        self._guide: int | None = None
        # The line of the last press, and where: a double click is of two there, though the first has brought
        # handles and a box.
        self._pressed: tuple[CurveView, Hit] | None = None

    # A second click on a line is for that line. Else from the top: the pivot; points, handles and lines of
    # other curves; grips; the line of the active curve; guides; the inside of the box and of fills. The plot
    # has found the topmost of all but pivot and grips.

    def press(self, event: ToolEvent) -> Gesture:
        """Return the gesture that begins here."""
        line, self._pressed = self._line_clicked_twice(event), None
        if line is not None:
            return self._press_on_line(event, line, is_second=True)
        if self._is_on_pivot(event):
            return press_on_pivot(event, _click_at_pivot(event))
        if event.pointer.shift and (end := end_of_other_curve(event)) is not None:
            return press_on_end(event, end)
        return self._press(event)

    def _press(self, event: ToolEvent) -> Gesture:
        # Another curve that is edited becomes the active one if it is pressed, and the hit is on that.
        event = activate_pressed(event)
        hit, grip = event.hit, _grip_at(event)
        if hit is not None and hit.part is Part.OTHER_CURVE and not hit.inside:
            if event.session.selected.is_editing:
                self._pressed = (event.session.views[hit.index], hit)
            return press_on_curve(event, hit)
        if hit is not None and not _is_below_grips(hit):
            return press_on_part(event, hit, toggling_kind(event, hit))
        if grip is not None:
            return press_on_grip(event, grip)
        if hit is not None and hit.part is Part.CURVE:
            return self._press_on_line(event, hit)
        if hit is not None and hit.part is Part.GUIDE:
            self._guide = hit.index
            return press_on_guide(event, hit.index)
        return _press_inside(event, hit) if hit is not None else _press_beside(event)

    def _press_on_line(self, event: ToolEvent, hit: Hit, *, is_second: bool = False) -> Gesture:
        self._pressed = (event.view, hit)
        return press_on_line(event, hit, is_second=is_second)

    def _line_clicked_twice(self, event: ToolEvent) -> Hit | None:
        """Return the hit on the line that is double-clicked; None for any other press."""
        pointer, pressed = event.pointer, self._pressed
        if not pointer.is_double or pointer.shift or pointer.ctrl or pointer.alt or pressed is None:
            return None
        view, hit = pressed
        if hit.part is Part.OTHER_CURVE:
            # The first click has made that curve the active one.
            hit = event.hit if event.hit is not None and event.hit.part is Part.CURVE else hit
        return hit if view is event.view and hit.part is Part.CURVE else None

    @staticmethod
    def _is_on_pivot(event: ToolEvent) -> bool:
        """Return whether a press takes the pivot; the middle of a box only beside all that can be hit.

        Where whole curves are selected there is no line to bend, and the middle comes before these.
        """
        hit, group, box, pivot = event.hit, event.box.group, event.rectangle, event.box.pivot
        position = pivot or (box.centre if box is not None else None)
        # The middle of a straight segment whose ends are selected is that of their box.
        is_line = hit is not None and hit.part in (Part.CURVE, Part.OTHER_CURVE)
        is_beside = hit is None or hit.inside or hit.part is Part.GUIDE
        is_beside |= is_line and group is not None and group.is_whole
        has_room = box is not None and box.is_roomy(event.pointer.scale)
        is_free = pivot is not None or (has_room and is_beside)
        return position is not None and is_free and is_on_pivot(position, event.pointer)

    def key(self, event: ToolEvent, key: str) -> bool:
        """Edit the selected curves with Enter."""
        selected = event.session.selected
        if key != "enter" or selected.is_editing or not selected.whole_curves:
            return super().key(event, key)
        selected.edit_selected()
        select_hit(event)
        return True

    # What a press would do

    def hover(self, event: ToolEvent) -> Hint:
        """Return the hint, and note the point or guide that a press would act on."""
        hit, grip, box = event.hit, _grip_at(event), event.rectangle
        is_pivot, group = self._is_on_pivot(event), event.box.group
        is_guide = hit is not None and hit.part is Part.GUIDE and grip is None and not is_pivot
        self._guide = hit.index if hit is not None and is_guide else None
        self._spot = _unselected_point(event, hit)
        if event.pointer.shift and (end := end_of_other_curve(event)) is not None:
            self._spot, hit = end.position, Hit(Part.OTHER_CURVE, end.curve, end.position)
        if is_pivot:
            return PIVOT_HINT
        if grip is not None and group is not None and box is not None and _is_below_grips(hit):
            return hint_on_grip(grip, box, group, event.box.refusal_of(group))
        if hit is not None and hit.part is Part.OTHER_CURVE and not (hit.inside and _is_for_box(event)):
            return hint_on_curve(event, hit)
        if self._guide is not None:
            return hint_on_guide(event, self._guide)
        if hit is not None and not hit.inside:
            return _hint_on_active(event, hit)
        return _hint_beside(event)

    def marks(self, event: ToolEvent) -> Marks:
        """Return the box with grips, its pivot, and the point or guide that a press would act on."""
        box, pivot = event.rectangle, event.box.pivot
        return Marks(
            box=box,
            pivot=pivot or (box.centre if box is not None else None),
            pivot_box=box if pivot is None else None,
            snap=event.snapping.caught,
            spot=self._spot,
            guide=self._guide,
        )


def _press_inside(event: ToolEvent, area: Hit) -> Gesture:
    """Begin inside another filled curve: move it, draw a rubber band over it, or click it."""
    if _is_for_box(event):
        return _press_beside(event)
    if not event.session.selected.is_editing and not event.pointer.shift:
        return press_on_curve(event, area)
    return press_with_band(event, lambda release: click_curve(release, area), is_on_curve=True)


def _press_beside(event: ToolEvent) -> Gesture:
    """Begin to move the contents of the box, or a rubber band."""
    if (group := _group_inside(event)) is not None:
        return press_on_group(event, group, _deselect)
    return press_with_band(event, deselect_curves)


def _is_for_box(event: ToolEvent) -> bool:
    """Return whether a press inside another filled curve acts on the box around the selection."""
    is_choosing = not event.session.selected.is_editing and not event.pointer.shift
    return not is_choosing and _group_inside(event) is not None


def _group_inside(event: ToolEvent) -> PointGroup | None:
    """Return the points that a drag inside the box moves, None beside it, or with Shift."""
    box = None if event.pointer.shift else event.rectangle
    return event.box.group if box is not None and box.holds(event.pointer) else None


def _deselect(event: ToolEvent) -> None:
    """Deselect the contents of the box: a click inside it is one on the empty plane."""
    if event.session.selected.points:
        event.session.selected.set_points([])
    else:
        deselect_curves(event)


def _click_at_pivot(event: ToolEvent) -> Click | None:
    """Return the click on the pivot of selected curves: another curve may lie there."""
    hit, selected = event.hit, event.session.selected
    if (
        hit is None
        or hit.part is not Part.OTHER_CURVE
        or selected.is_editing
        or hit.index in selected.whole_curves
    ):
        return None
    return lambda _release: click_curve(event, hit)


def _grip_at(event: ToolEvent) -> Grip | None:
    box = event.rectangle
    return box.grip_at(event.pointer) if box is not None else None


def _is_below_grips(hit: Hit | None) -> bool:
    """Return whether a grip of the box has precedence over the hit."""
    return hit is None or hit.inside or hit.part in (Part.CURVE, Part.GUIDE)


def _unselected_point(event: ToolEvent, hit: Hit | None) -> Vector | None:
    """Return the position of the point of another curve that is hit; None for one that is selected."""
    if hit is None or hit.part is not Part.OTHER_POINT:
        return None
    return hit.position if hit.index not in event.session.selected.group.of(hit.curve) else None


def _hint_on_active(event: ToolEvent, hit: Hit) -> Hint:
    """Return the hint over a point, a handle or the line of a curve that is edited."""
    view, moves, pointer = event.view, label_of_moved(event, hit), event.pointer
    if hit.curve >= 0:
        view, hit = event.session.views[hit.curve], hit.on_active_curve
    if view.source.locked:
        return Hint(locked_message([view.source.display_name]))
    if hit.part is Part.CURVE:
        return hint_on_line(view, pointer)
    hint = hint_on_part(hit, view, moves, pointer, snaps=event.snapping.is_on)
    return replace(hint, text=f"{hint.text}{kind_on_double_click(hit, view, pointer)}")


def _hint_beside(event: ToolEvent) -> Hint:
    """Return the hint beside everything."""
    inside = _group_inside(event)
    if inside is not None:
        return hint_inside_box(inside, event.pointer, snaps=event.snapping.is_on)
    return hint_beside_curves(event) or Hint(_ON_EMPTY)


SELECT = ToolRecord(
    name="select",
    make=SelectTool,
    hint="Drag points and handles; P adds points.",
    doing="selecting",
    gestures=(
        GestureRow("Drag a selected curve", "move all selected curves", curves=True),
        GestureRow("G, S, R, arrows, Del, the box", "act on all selected curves", curves=True),
        GestureRow("Escape, a click beside them", "select only the edited one", curves=True),
        *GESTURES,
        GestureRow("Click a point", "select only this point"),
        GestureRow("Double-click a point", "make it a corner, or a corner smooth", needs_derivatives=True),
        GestureRow("Shift+click a point", "add to or remove from the selection; ends of any open curve"),
        GestureRow("Click a small ring", "select a point of another curve of the shape"),
        GestureRow("Drag beside the curve", "select with a rubber band; Shift adds"),
        GestureRow("Drag the curve", "bend it, the points stay; Alt: points as well, Ctrl: points only"),
        GestureRow("Click the curve", "select both ends; Shift: add them; double click: insert"),
        GestureRow(
            "Drag inside the box", "move all in it; Shift+drag: rubber band", selected=True, curves=True
        ),
        GestureRow(
            "Drag a grip of the box",
            "scale (Ctrl keeps proportions, Shift the pivot) or rotate (Ctrl: 15° steps)",
            selected=True,
            curves=True,
        ),
        GestureRow("Click a selected curve", "switch the grips between scaling and rotating", curves=True),
        GestureRow("Drag out of a ruler", "add a guide; drag it to move it, back to the ruler to remove it"),
        GestureRow("Double-click a guide or a ruler", "type its position"),
        GestureRow(
            "Drag the cross in the box",
            "move the pivot; double click, Shift+click: reset it",
            selected=True,
            curves=True,
        ),
        GestureRow("Tab, Shift+Tab", "select the next or previous point"),
        GestureRow("Escape", "deselect the points; again: select whole curves", selected=True),
        GestureRow(
            "Drag another curve", "move the whole curve; select it if none is edited; Ctrl, Shift: one axis"
        ),
        GestureRow("Click another curve", "edit it; double click: insert a point"),
        GestureRow("Shift+click another curve", "add to or remove from the selection"),
        GestureRow("With no curve edited", "a click selects a curve, a double click or Enter edits it"),
        GestureRow("Ctrl+click, no curve edited", "select a shape without its group"),
        GestureRow("Click within a fill", "same as on its outline; the topmost fill counts"),
        GestureRow("Rubber band, no curve edited", "select curves inside"),
    ),
    rank=10,
    action="selectTool",
    title="Select",
    full_name="Select Tool",
    key="V",
    icon="select",
    tip="Select and drag points and handles",
    in_toolbar=True,
)
