"""The Select tool: points, handles, the curve, the box with grips, other curves, and the rubber band."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from msgspec.structs import replace

from ...document.model import Vector
from ...document.point_group import PointGroup
from ...view_model.curve.curve_view import CurveView
from .. import hints
from ..bend import hint_on_line, press_on_line
from ..curve_picker import CurvePicker, click_curve, select_hit
from ..drag_handles import GESTURES, hint_on_part, press_on_part
from ..drag_points import kind_on_double_click, label_of_moved, toggling_kind
from ..gesture import Gesture
from ..guides import GuidePicker
from ..marks import Marks
from ..marquee import Band, CurveMarquee, Marquee
from ..pointer import Cursor, Hint, Hit, Part
from ..tool import GestureRow, Tool, ToolEvent, ToolRecord
from ..transform import TransformKind
from ..transform_box import Grip, TransformBox
from ..transform_drags import PIVOT_HINT, MovePivot, is_on_pivot, moving, scaling, turning

_ON_EMPTY = (
    "Drag to select points, Shift adds · Escape: whole curves · P adds points · Wheel zooms, Space pans"
)


class SelectTool(Tool):
    """Tool that selects, moves and bends."""

    cursor = Cursor.ARROW
    finds_other_curves = True
    finds_guides = True
    shows_box = True

    def __init__(self) -> None:
        self._picker, self._guides = CurvePicker(), GuidePicker()
        self._drags_grip = False
        self._lit: Vector | None = None
        # The line that the last press was on, and where: a double click is of two there, though the first
        # has brought handles and a box.
        self._pressed: tuple[CurveView, Hit] | None = None

    def press(self, event: ToolEvent) -> Gesture | None:
        """Begin what a press here means."""
        line, self._pressed = self._line_clicked_twice(event), None
        if line is not None:
            return self._press_on_curve(event, line, is_second=True)
        if self._is_on_pivot(event):
            self.gesture = MovePivot(event, self._click_at_pivot(event))
            return None
        return self._press(self._picker.entered(event))

    def _press(self, event: ToolEvent) -> Gesture | None:
        hit, grip = event.hit, self._grip_at(event)
        if hit is not None and hit.part is Part.OTHER_CURVE and not hit.inside:
            self._picker.press(event, hit)
        elif hit is not None and not _is_below_grips(hit):
            return press_on_part(event, hit, toggling_kind(event, hit))
        elif grip is not None:
            self._press_on_grip(event, grip)
        elif hit is not None and hit.part is Part.GUIDE:
            self._guides.press(event, hit)
        elif hit is not None and hit.inside:
            self._press_within(event, hit)
        elif hit is not None:
            return self._press_on_curve(event, hit)
        else:
            self._press_beside(event)
        return None

    def _press_within(self, event: ToolEvent, area: Hit) -> None:
        """Begin in what another curve fills: to move it, or a rubber band over it, or a click on it."""
        if not self._is_pressed_within(event):
            self._press_beside(event)
        elif not event.session.selected.is_editing and not event.pointer.shift:
            self._picker.press(event, area)
        else:
            self.gesture = self._band(event)(event, lambda event: click_curve(event, area), is_on_curve=True)

    def _press_beside(self, event: ToolEvent) -> None:
        """Begin to move what the box is around, or a rubber band."""
        if (group := self._inside(event)) is not None:
            drag = moving(event, group)
            event.drags.press(event.pointer, drag, lambda: self._deselect(event))
        else:
            self.gesture = self._band(event)(event, self._picker.unpick)

    def _is_pressed_within(self, event: ToolEvent) -> bool:
        """Whether a press in what another curve fills is about that, and not about the box around points."""
        is_choosing = not event.session.selected.is_editing and not event.pointer.shift
        return is_choosing or self._inside(event) is None

    @staticmethod
    def _band(event: ToolEvent) -> type[Band]:
        return Marquee if event.session.selected.is_editing else CurveMarquee

    def key(self, event: ToolEvent, key: str) -> bool:
        """Edit what is chosen with Enter."""
        selected = event.session.selected
        if key != "enter" or selected.is_editing or event.drags.is_pressed or not selected.chosen:
            return False
        selected.edit_chosen()
        select_hit(event)
        return True

    def reset(self) -> None:
        """Forget the curve of another document."""
        self._pressed = None

    def _deselect(self, event: ToolEvent) -> None:
        """Let go of what the box is around: a click inside it means the empty place there."""
        if event.session.selected.points:
            event.session.selected.set_points([])
        else:
            self._picker.unpick(event)

    @staticmethod
    def _click_at_pivot(event: ToolEvent) -> Callable[[], None] | None:
        """Return what a click on the pivot of chosen curves means: another curve that lies there."""
        hit, session = event.hit, event.session
        if hit is None or hit.part is not Part.OTHER_CURVE or session.selected.is_editing:
            return None
        if hit.index in session.selected.chosen:
            return None
        return partial(click_curve, event, hit)

    def _press_on_grip(self, event: ToolEvent, grip: Grip) -> None:
        self._drags_grip = True
        drag = scaling if grip.does is TransformKind.SCALE else turning
        event.drags.press(event.pointer, drag(event, grip))

    def _press_on_curve(self, event: ToolEvent, hit: Hit, *, is_second: bool = False) -> Gesture:
        self._pressed = (event.view, hit)
        return press_on_line(event, hit, is_second=is_second)

    def _line_clicked_twice(self, event: ToolEvent) -> Hit | None:
        """Return where the line is that a double click is on; None where it is on none."""
        pointer, pressed = event.pointer, self._pressed
        if not pointer.is_double or pointer.shift or pointer.ctrl or pointer.alt or pressed is None:
            return None
        view, hit = pressed
        return hit if view is event.view else None

    def end(self) -> None:
        """Drop the rubber band, or the grip."""
        super().end()
        self._drags_grip = False

    # What is shown

    def hover(self, event: ToolEvent) -> Hint:
        """Return what a press here would do."""
        hit, grip, group = event.hit, self._grip_at(event), event.box.group
        takes_pivot = self._is_on_pivot(event)
        self._guides.hover(hit if grip is None and not takes_pivot else None)
        self._lit = _unselected_place(event, hit)
        if takes_pivot:
            return PIVOT_HINT
        box = self._box(event)
        if grip is not None and group is not None and box is not None and _is_below_grips(hit):
            return hints.on_grip(grip, box, group, event.box.refusal_of(group))
        if (
            hit is not None
            and hit.part is Part.OTHER_CURVE
            and (not hit.inside or self._is_pressed_within(event))
        ):
            return self._picker.hint(event, hit)
        if (beside := self._guides.hint(event)) is not None:
            return beside
        if hit is not None and not hit.inside:
            return self._hint_on_part(event, hit)
        return self._idle_hint(event) or Hint(_ON_EMPTY)

    @staticmethod
    def _hint_on_part(event: ToolEvent, hit: Hit) -> Hint:
        """Return the hint over a point, a handle or the line of a curve that is edited."""
        view, moves, pointer = event.view, label_of_moved(event, hit), event.pointer
        snaps = event.settings.snapping.on
        if hit.curve >= 0:
            view, hit = event.session.views[hit.curve], hit.as_own
        if view.source.locked:
            return Hint(hints.LOCKED.format(view.source.display_name))
        if hit.part is Part.CURVE:
            return hint_on_line(view, pointer)
        hint = hint_on_part(hit, view, moves, pointer, snaps=snaps)
        return replace(hint, text=f"{hint.text}{kind_on_double_click(hit, view, pointer)}")

    def _idle_hint(self, event: ToolEvent) -> Hint | None:
        """Return what a press beside everything would do, None for nothing in particular."""
        inside = self._inside(event)
        if inside is None:
            return self._picker.idle_hint(event)
        return hints.inside_box(inside, event.pointer, snaps=event.settings.snapping.on)

    def marks(self, event: ToolEvent) -> Marks:
        """Return the rubber band, or the box with grips and the amount of what one of them does."""
        is_idle, box = self.gesture is None and not event.drags.is_pressed, self._box(event)
        is_banding, pivot = isinstance(self.gesture, Band), event.box.pivot
        centre = box.centre if box is not None else None
        return Marks(
            band=self.gesture.band if isinstance(self.gesture, Band) else None,
            box=box if is_idle else None,
            frame=None if is_idle or is_banding else box,
            pivot=event.drags.about_at(event.pointer) or (None if is_banding else pivot or centre),
            pivot_box=box if is_idle and pivot is None else None,
            snap=event.snapping.caught,
            note=event.note() if self._drags_grip else None,
            spot=self._lit if is_idle else None,
            guide=self._guides.lit,
        )

    @staticmethod
    def _box(event: ToolEvent) -> TransformBox | None:
        target = event.box
        box = target.rectangle if event.settings.shows_box else None
        return box if box is not None and not target.refusal_of(target.group) else None

    def _inside(self, event: ToolEvent) -> PointGroup | None:
        """Return what a drag from inside the box moves, None beside it; Shift draws a rubber band there."""
        box = None if event.pointer.shift else self._box(event)
        is_inside = box is not None and box.holds(event.pointer)
        return event.box.group if is_inside else None

    def _is_on_pivot(self, event: ToolEvent) -> bool:
        """Whether a press takes the pivot; one that nobody chose gives way to points, handles and lines.

        Where whole curves are chosen there is no line to bend, and it comes before these.
        """
        hit, group, box = event.hit, event.box.group, self._box(event)
        pivot = event.box.pivot
        place = pivot or (box.centre if box is not None else None)
        # The middle of a straight segment whose ends are selected is that of their box.
        is_line = hit is not None and hit.part in (Part.CURVE, Part.OTHER_CURVE)
        is_beside = hit is None or hit.inside or hit.part is Part.GUIDE
        is_beside |= is_line and group is not None and group.is_whole
        has_room = box is not None and box.is_roomy(event.pointer.scale)
        is_free = pivot is not None or (has_room and is_beside)
        return place is not None and is_free and is_on_pivot(place, event.pointer)

    def _grip_at(self, event: ToolEvent) -> Grip | None:
        box = self._box(event)
        return box.grip_at(event.pointer) if box is not None else None


def _is_below_grips(hit: Hit | None) -> bool:
    """Whether a grip of the box comes before what is hit."""
    return hit is None or hit.inside or hit.part in (Part.CURVE, Part.GUIDE)


def _unselected_place(event: ToolEvent, hit: Hit | None) -> Vector | None:
    """Return where the point of another curve is that is hit; None for one that is selected."""
    if hit is None or hit.part is not Part.OTHER_POINT:
        return None
    return hit.position if hit.index not in event.session.selected.group.of(hit.curve) else None


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
        GestureRow("Double-click a point", "make it a corner, or a corner smooth", needs_derivatives=True),
        GestureRow("Shift+click a point", "select it too, or no longer"),
        GestureRow("Click a small ring", "select a point of another curve of the shape, as any other"),
        GestureRow("Drag beside the curve", "select with a rubber band; Shift adds"),
        GestureRow("Drag the curve", "bend it, the points stay; Alt: points come along, Ctrl: points alone"),
        GestureRow("Click the curve", "select both ends; Shift: too; double click: insert"),
        GestureRow(
            "Drag inside the box", "move all in it; Shift+drag: rubber band", selected=True, curves=True
        ),
        GestureRow(
            "Drag a grip of the box",
            "scale (Ctrl keeps proportions, Shift the pivot) or rotate (Ctrl: 15° steps)",
            selected=True,
            curves=True,
        ),
        GestureRow("Click a chosen curve", "grips that rotate and skew, or scale again", curves=True),
        GestureRow("Drag out of a ruler", "a guide; drag it to move it, back to the ruler to remove it"),
        GestureRow("Double-click a guide or a ruler", "type where the guide lies"),
        GestureRow(
            "Drag the cross in the box",
            "move the pivot; double click, Shift+click: back",
            selected=True,
            curves=True,
        ),
        GestureRow("Tab, Shift+Tab", "select the next or previous point"),
        GestureRow("Escape", "select nothing; once more: whole curves, none edited", selected=True),
        GestureRow(
            "Drag another curve", "move it whole; with none edited choose it, too; Ctrl, Shift: one axis"
        ),
        GestureRow("Click another curve", "edit it"),
        GestureRow("Shift+click another curve", "choose it too, or no longer"),
        GestureRow("With no curve edited", "a click chooses a curve, a double click or Enter edits it"),
        GestureRow("Ctrl+click, no curve edited", "choose a shape, and not the group that it is in"),
        GestureRow("Click within a fill", "as on the line around it; the topmost is meant"),
        GestureRow("Rubber band, no curve edited", "choose curves inside"),
    ),
    rank=10,
    action="selectTool",
    title="Select",
    full_name="Select Tool",
    key="V",
    icon="select",
    tip="Select and drag points and handles",
)
