"""The Select tool: points, handles, the curve, the box with grips, other curves, and the rubber band."""

from __future__ import annotations

from msgspec.structs import replace

from ...document import words
from ...document.model import Vector
from ...document.several_curves import PointGroup
from .. import hints
from ..curve_picker import CurvePicker, chosen_curves, edit_curve
from ..drags import BendCurve
from ..marks import GestureMarks
from ..marquee import CurveMarquee, Marquee
from ..move_pivot import PIVOT_HINT, MovePivot, is_on_pivot, is_roomy
from ..parts import GESTURES, press_on_part, unless_locked
from ..pointer import Cursor, Hint, Hit, Part
from ..tool import GestureRow, Tool, ToolContext, ToolRecord
from ..transform import TransformKind
from ..transform_box import Grip, TransformBox


class SelectTool(Tool):
    """Tool that selects, moves and bends."""

    cursor = Cursor.ARROW
    finds_other_curves = True

    def __init__(self) -> None:
        self._picker = CurvePicker()
        self._drags_grip = False

    def press(self, context: ToolContext) -> None:
        """Begin what a press here means."""
        hit, grip = context.hit, self._grip_at(context)
        if self._is_on_pivot(context):
            self.gesture = MovePivot(context)
        elif hit is not None and hit.part is Part.OTHER_CURVE:
            self._picker.press(context, hit)
        elif hit is not None and hit.part is not Part.CURVE:
            press_on_part(context, hit)
        elif grip is not None:
            self._press_on_grip(context, grip)
        elif hit is not None:
            self._press_on_curve(context, hit)
        elif (group := self._inside(context)) is not None:
            moving = context.target.moving(group, context.pointer)
            context.drags.press(context.pointer, moving, lambda: self._deselect(context))
        elif context.host.selected.is_editing:
            self.gesture = Marquee(context, self._picker.unpick)
        else:
            self.gesture = CurveMarquee(context, self._picker.unpick)

    def key(self, context: ToolContext, key: str) -> bool:
        """Edit the curve that is chosen with Enter."""
        selected = context.host.selected
        if key != "enter" or selected.is_editing or context.drags.is_pressed or not selected.chosen:
            return False
        edit_curve(context, context.host.active_index)
        return True

    def walk(self, context: ToolContext, step: int) -> bool:
        """Select the next point; while no curve is edited, choose the next curve."""
        host = context.host
        if host.selected.is_editing:
            return super().walk(context, step)
        host.selected.choose(((host.active_index + step) % len(host.views),))
        host.say(f"{chosen_curves(host)}.")
        return True

    def _deselect(self, context: ToolContext) -> None:
        """Let go of what the box is around: a click inside it means the empty place there."""
        if context.host.selected.points:
            context.host.selected.set_points([])
        else:
            self._picker.unpick(context)

    def _press_on_grip(self, context: ToolContext, grip: Grip) -> None:
        self._drags_grip = True
        if grip.rotates:
            turning = context.target.transform(TransformKind.ROTATE, context.pointer)
            context.drags.press(context.pointer, replace(turning, by_grip=True))
            return
        context.drags.press(context.pointer, context.target.scaling(grip, context.pointer))

    def _press_on_curve(self, context: ToolContext, hit: Hit) -> None:
        host, pointer = context.host, context.pointer
        said = f"t = {words.number(hit.t)} · c(t) = ({words.vector(hit.position)})"
        bend = BendCurve(host.document, host.active_index, context.view, hit, pointer.position)
        context.drags.press(pointer, unless_locked(context, bend), on_click=lambda: host.say(said))

    def end(self) -> None:
        """Drop the rubber band, or the grip."""
        super().end()
        self._drags_grip = False

    # What is shown

    def hover(self, context: ToolContext) -> Hint:
        """Return what a press here would do."""
        hit, grip, group = context.hit, self._grip_at(context), context.target.group
        snaps = context.settings.snapping.on
        if self._is_on_pivot(context):
            return PIVOT_HINT
        if hit is not None and hit.part is Part.OTHER_CURVE:
            return self._picker.hint(context, hit)
        if grip is not None and group is not None and (hit is None or hit.part is Part.CURVE):
            return hints.on_grip(grip, group, context.target.refusal_of(group))
        if hit is None and (inside := self._inside(context)) is not None:
            return hints.inside_box(inside, context.pointer, snaps=snaps)
        if hit is None and (idle := self._picker.idle_hint(context)) is not None:
            return idle
        return hints.to_select(hit, context.view, context.host.selected.points, context.pointer, snaps=snaps)

    def marks(self, context: ToolContext) -> GestureMarks:
        """Return the rubber band, or the box with grips and the amount of what one of them does."""
        is_idle, box = self.gesture is None and not context.drags.is_pressed, self._box(context)
        is_banding = isinstance(self.gesture, Marquee)
        return GestureMarks(
            band=self.gesture.band if isinstance(self.gesture, Marquee) else None,
            box=box if is_idle else None,
            frame=None if is_idle or is_banding else box,
            pivot=self._pivot(context) if not is_banding else None,
            snap=context.snappers.caught,
            note=context.note() if self._drags_grip else None,
        )

    @staticmethod
    def _box(context: ToolContext) -> TransformBox | None:
        target = context.target
        is_shown = context.settings.shows_box and not target.refusal_of(target.group)
        return target.box if is_shown else None

    def _inside(self, context: ToolContext) -> PointGroup | None:
        """Return what a drag from inside the box moves, None beside it; Shift draws a rubber band there."""
        box = None if context.pointer.shift else self._box(context)
        is_inside = box is not None and box.holds(context.pointer)
        return context.target.group if is_inside else None

    def _pivot(self, context: ToolContext) -> Vector | None:
        """Return the pivot that can be taken: one that was chosen, or the middle of the box."""
        target = context.target
        if (place := target.pivot) is not None:
            return place
        box = self._box(context)
        return box.centre if box is not None else None

    def _is_on_pivot(self, context: ToolContext) -> bool:
        """Whether a press takes the pivot; one that nobody chose gives way to points and handles."""
        place, hit, box = self._pivot(context), context.hit, self._box(context)
        is_plain = hit is None or hit.part is Part.CURVE
        is_free = context.target.pivot is not None or (
            is_plain and box is not None and is_roomy(box, context.pointer)
        )
        return place is not None and is_free and is_on_pivot(place, context.pointer)

    def _grip_at(self, context: ToolContext) -> Grip | None:
        box = self._box(context)
        return box.grip_at(context.pointer) if box is not None else None


SELECT = ToolRecord(
    name="select",
    make=SelectTool,
    hint="Drag points and handles; P adds points.",
    doing="selecting",
    gestures=(
        GestureRow("Drag a chosen curve", "move all chosen curves", curves=True),
        GestureRow("G, S, R, arrows, Del, the box", "act on all chosen curves", curves=True),
        GestureRow("Escape, a click beside them", "choose only the one edited", curves=True),
        *GESTURES,
        GestureRow("Click a point", "select it alone"),
        GestureRow("Shift+click a point", "select it too, or no longer"),
        GestureRow("Drag beside the curve", "select with a rubber band; Shift adds"),
        GestureRow("Drag the curve", "bend it, the points stay; Alt: points come along, Ctrl: points alone"),
        GestureRow("Click the curve", "tell t and c(t) there"),
        GestureRow(
            "Drag inside the box", "move all in it; Shift+drag: rubber band", selected=True, curves=True
        ),
        GestureRow(
            "Drag a grip of the box",
            "scale (Ctrl keeps proportions, Shift the pivot) or rotate (Ctrl: 15° steps)",
            selected=True,
            curves=True,
        ),
        GestureRow(
            "Drag the cross in the box", "move the pivot; double click: back", selected=True, curves=True
        ),
        GestureRow("Tab, Shift+Tab", "select the next or previous point"),
        GestureRow("Escape", "select nothing; once more: whole curves, none edited", selected=True),
        GestureRow("Drag another curve", "move it whole; Shift keeps to one axis"),
        GestureRow("Click another curve", "edit it"),
        GestureRow("Shift+click another curve", "choose it too, or no longer"),
        GestureRow("With no curve edited", "a click chooses a curve, a double click or Enter edits it"),
        GestureRow("Rubber band, no curve edited", "choose curves inside; Alt: also those touched"),
    ),
    place=10,
    action="selectTool",
    title="Select",
    full_name="Select Tool",
    key="V",
    icon="select",
    tip="Select and drag points and handles",
)
