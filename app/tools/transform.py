"""Move, scale, rotate and skew the selection, by grips of its box or by keys; move the pivot of these.

A grip is dragged with the button down. A key (G, S, R, Shift+R) begins a drag that follows
the pointer without a button until a click or Enter (`Toolbox.begin`); meanwhile digits type the amount, X and
Y lock an axis, and G, S, R go on with another transform.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from msgspec.structs import replace

from ..document import words
from ..document.limits import EditError
from ..document.model import Document, Vector
from ..document.point_group import PointGroup
from ..document.several_curves import move_group, transform_group
from ..document.transforms import LARGEST_SKEW, rotation, scaling, set_coordinates, skew
from ..view_model.curve.curve_view import CurveView
from ..view_model.pivot import Pivot
from ..view_model.resize import stretched
from .box import Grip, TransformBox, TransformKind
from .drag_points import MovePoints, nearest_point
from .marks import Marks, Note
from .pointer import (
    AXIS_KEYS,
    SNAP_KEY,
    STEP_KEYS,
    Cursor,
    Hint,
    Pointer,
    along_axis,
    axis_held,
    drag_to_move,
    longer_axis,
    minus,
    plus,
    snap_key_text,
)
from .snapping import Snapper
from .tool import Drag, Gesture, ToolEvent, TypedDrag
from .typed_amount import TypedAmount

# By a grip of the box


def press_on_grip(event: ToolEvent, grip: Grip) -> Drag:
    """Start to drag a grip of the box around the selection: it scales, rotates or skews."""
    if grip.does is not TransformKind.SCALE:
        return _by_grip(event, grip)
    session, box = event.session, event.box
    assert box.group is not None
    assert box.rectangle is not None
    return ScaleBox(
        document=session.document,
        views=session.views,
        group=box.group,
        box=box.rectangle,
        pivot=box.centre,
        grip=grip,
        start=event.pointer.position,
        snapper=event.snapping.for_grip(grip, box.group),
        even=box.keeps_proportions and bool(grip.x and grip.y),
    )


def hint_on_grip(grip: Grip, box: TransformBox, group: PointGroup, refusal: str) -> Hint:
    """Return the hint over a grip of the box around a group, or why it cannot be changed."""
    if refusal:
        return Hint(refusal)
    keys = _SCALE_KEYS if grip.does is TransformKind.SCALE else _turn_keys(grip.does, has_opposite=box.turns)
    return Hint(f"Drag to {grip.does.title.lower()} {group.label} · {keys}", cursor=grip.cursor)


_SCALE_KEYS = f"Shift: about the pivot · Ctrl: keep proportions · {SNAP_KEY}"

_TOLERANCE = 0.05
"""Pixels that the box may be off where the curves answer to a stretch with another shape."""


def _note(event: ToolEvent, drag: Drag) -> Note | None:
    """Return the amount of a drag, to stand beside the pointer."""
    text = drag.status(event).partition(" · ")[0] if drag.has_moved else ""
    return Note(event.pointer.position, text, event.box.centre) if text else None


class ScaleBox(Drag, kw_only=True):
    """Drag of a grip of the box: it scales the selected points, or selected curves.

    The corner or the side of the box that the grip moves snaps: the grip lies beside it.

    Attributes
    ----------
    views
        The views of the curves at the press.
    pivot
        The fixed position with Shift.
    even
        Whether proportions are kept without a key.
    """

    views: Sequence[CurveView]
    box: TransformBox
    pivot: Vector
    grip: Grip
    start: Vector
    snapper: Snapper
    even: bool = False

    keys = _SCALE_KEYS

    def document_at(self, pointer: Pointer) -> Document:
        """Return the document scaled about the opposite side, or about the pivot with Shift."""
        x, y = self._factors(self._offset(pointer), pointer)
        about, caught = self._fixed(pointer), self.snapper.caught
        by = scaling(x, y, about)
        document = stretched(
            self.document,
            self.views,
            self.group,
            (by.point(self.box.low), by.point(self.box.high)),
            even=longer_axis(self._arm(pointer)) if self._is_even(pointer) else None,
            about=about,
            tolerance=0.0 if caught is not None else _TOLERANCE / pointer.scale,
        )
        if caught is not None:
            for axis in caught.axes:
                # Exactly on the target, to the last bit.
                document = self._with_side(document, axis, caught.position[axis])
        return document

    def _with_side(self, document: Document, axis: int, value: float) -> Document:
        side, curves = self._corner[axis], self.document.curves
        for curve, indices in self.group.parts:
            outermost = [index for index in indices if curves[curve].points[index].position[axis] == side]
            if outermost:
                document = set_coordinates(document, curve, dict.fromkeys(outermost, value), axis)
        return document

    @property
    def _corner(self) -> Vector:
        """The corner of the box that moves, or the middle of the side."""
        return self.box.position(self.grip.x, self.grip.y)

    def _fixed(self, pointer: Pointer) -> Vector:
        opposite, corner = self.box.position(-self.grip.x, -self.grip.y), self._corner
        if not pointer.shift:
            return opposite
        # Nothing can be scaled about the side that moves.
        x, y = (
            there if about == side else about
            for about, there, side in zip(self.pivot, opposite, corner, strict=True)
        )
        return (x, y)

    def _arm(self, pointer: Pointer) -> Vector:
        """Return the offset from the fixed position to the corner."""
        x, y = minus(self._corner, self._fixed(pointer))
        return (x if self.grip.x else 0.0, y if self.grip.y else 0.0)

    def _is_even(self, pointer: Pointer) -> bool:
        return self.even or pointer.ctrl

    def _offset(self, pointer: Pointer) -> Vector:
        """Return the offset of the corner, after snapping."""
        corner, arm = self._corner, self._arm(pointer)
        offset = pointer.offset_from(self.start)
        axis = None if self.grip.x and self.grip.y else 0 if self.grip.x else 1
        if self._is_even(pointer):
            # The part along the diagonal; only its longer side can snap without leaving it.
            # By directions, not by squares: that of a tiny box is nothing to divide by.
            length = math.hypot(*arm)
            across, up = arm[0] / length, arm[1] / length
            along = offset[0] * across + offset[1] * up
            offset, axis = (along * across, along * up), longer_axis(arm)
        target = self.snapper.snap(plus(corner, offset), pointer, axis)
        return offset if self.snapper.caught is None else minus(target, corner)

    def _factors(self, offset: Vector, pointer: Pointer) -> Vector:
        arm = self._arm(pointer)
        if self._is_even(pointer):
            axis = longer_axis(arm)
            factor = 1 + offset[axis] / arm[axis]
            return (factor, factor)
        return (
            1 + offset[0] / arm[0] if arm[0] else 1.0,
            1 + offset[1] / arm[1] if arm[1] else 1.0,
        )

    def undo_text(self, pointer: Pointer) -> str:
        """Return "Scale 4 points"."""
        return f"Scale {self.group.label}"

    def amount(self, pointer: Pointer) -> str:
        """Return the factors."""
        x, y = self._factors(self._offset(pointer), pointer)
        return f"Scale {words.number(x)}" if x == y else f"Scale {words.number(x)} × {words.number(y)}"

    def marks(self, event: ToolEvent) -> Marks:
        """Return the frame, the snap, and the factors beside the pointer."""
        return replace(super().marks(event), note=_note(event, self))


# By keys, or by a grip that rotates or skews


def transform_by_key(event: ToolEvent, kind: TransformKind) -> Transform:
    """Start the transform that a key begins at the pointer; with nothing selected, of all points.

    Raises
    ------
    EditError
        Where there is nothing to transform, or it is locked.
    """
    if refusal := event.box.refusal_of_keys:
        raise EditError(refusal)
    box = event.box
    group = box.for_keys
    grabbed = nearest_point(event, group)
    return Transform(
        document=event.session.document,
        kind=kind,
        group=group,
        centre=box.centre,
        hold=box.bounds.position(1, 1),
        start=event.pointer.position,
        snapper=event.snapping.for_points(group, grabbed),
        grabbed=grabbed,
        typed=_untyped(kind, event.session.document),
        everything=box.group is None,
    )


def _by_grip(event: ToolEvent, grip: Grip) -> Transform:
    drag, box = transform_by_key(event, grip.does), event.box.rectangle
    drag.by_grip = True
    if box is not None and box.turns:
        drag.hold, drag.opposite = box.position(grip.x, grip.y), box.position(-grip.x, -grip.y)
        drag.axis = int(grip.y == 0)
    return drag


def _untyped(kind: TransformKind, document: Document) -> TypedAmount:
    """Return the amount while nothing is typed: a move is typed in lengths."""
    return TypedAmount(unit=document.unit if kind is TransformKind.MOVE else None)


_STEP = 15.0
"""Degrees from one angle to the next, with the key for steps."""

_LEAST_ARM = 20.0
"""Pixels: begun closer to the centre, a scale would jump at the first move."""

_KEYS = frozenset("xygsrR") | {"tab", "enter"}


def _turn_keys(kind: TransformKind, *, has_opposite: bool) -> str:
    """Return the effects of modifiers while a grip rotates or skews."""
    if not has_opposite:
        return STEP_KEYS
    opposite = "corner" if kind is TransformKind.ROTATE else "side"
    return f"Ctrl: steps of 15° · Shift: about the opposite {opposite}"


class Transform(TypedDrag, kw_only=True):
    """Drag that moves, scales, rotates or skews by the offset of the pointer, or by a typed amount.

    Attributes
    ----------
    centre
        The fixed position of scale, rotation and skew.
    hold
        The corner or side of the box that follows the pointer in a skew.
    start
        Where the pointer was when it began.
    snapper, grabbed
        For a move: the snapper, and the curve and index of the point that snaps.
    opposite
        The fixed position with Shift, on the other side of the box; None where Shift means steps.
    axis
        0 or 1 where an axis is locked.
    typed
        The amount as typed so far; the pointer gives it while this is empty.
    by_grip
        Whether it is dragged by the grip of a box, where no keys are taken.
    everything
        Whether it acts on all points of the curve because none is selected: the words say so.
    """

    kind: TransformKind
    centre: Vector
    hold: Vector
    start: Vector
    snapper: Snapper
    grabbed: tuple[int, int]
    opposite: Vector | None = None
    axis: int | None = None
    by_grip: bool = False
    everything: bool = False

    # Keys

    def wants_key(self, key: str) -> bool:
        """Return whether a key is for the transform: a digit, ".", "-", "x", "y" …."""
        return not self.by_grip and (key in _KEYS or self.typed.claims(key))

    def key(self, event: ToolEvent, key: str) -> bool:
        """Take a typed character, "tab", "x", "y", or "g", "s", "r", "R" for another transform.

        Raises
        ------
        EditError
            For a letter that is none of a unit.
        """
        kind = next((kind for kind in TransformKind if kind.key == key), None)
        if self.by_grip:
            return False
        if self.typed.continues_unit(key):
            return self.type(key)
        if kind is not None:
            self.kind, self.typed = kind, _untyped(kind, self.document)
        elif key in ("x", "y") and self.kind is not TransformKind.ROTATE:
            axis = "xy".index(key)
            self.axis, self.typed = None if self.axis == axis else axis, self.typed.joined(axis)
        elif key == "tab" and not self.kind.is_angle:
            self.axis, self.typed = None, self.typed.after_tab(self.axis)
        elif key in ("x", "y", "tab"):
            return False
        else:
            return self.type(key)
        return True

    # The document

    def document_at(self, pointer: Pointer) -> Document:
        """Return the document transformed by the whole amount since the beginning."""
        if self.kind is TransformKind.MOVE:
            if self.typed.counts:
                self.snapper.reset()
                return move_group(self.document, self.group, self._offset(pointer))
            return self._move().document_at(pointer)
        if self.kind is TransformKind.ROTATE:
            return transform_group(
                self.document, self.group, rotation(self._degrees(pointer), self._about(pointer))
            )
        if self.kind is TransformKind.SKEW:
            by = skew(self.axis or 0, self._skewed(pointer), self._about(pointer))
            return transform_group(self.document, self.group, by)
        x, y = self._factors(pointer)
        return transform_group(self.document, self.group, scaling(x, y, self.centre))

    def _move(self) -> MovePoints:
        return MovePoints(
            document=self.document,
            group=self.group,
            grabbed=self.grabbed,
            start=self.start,
            snapper=self.snapper,
            axis=self.axis,
        )

    def _offset(self, pointer: Pointer) -> Vector:
        if not self.typed.counts:
            return self._move().offset(pointer)
        if self.typed.is_pair:
            return self.typed.pair(0.0)
        amount = self.typed.number(0.0)
        return (0.0, amount) if self.axis == 1 else (amount, 0.0)

    def _factors(self, pointer: Pointer) -> Vector:
        if self.typed.is_pair:
            return self.typed.pair(1.0)
        factor = self._factor(pointer)
        return (1.0 if self.axis == 1 else factor, 1.0 if self.axis == 0 else factor)

    def _factor(self, pointer: Pointer) -> float:
        if self.typed.counts:
            return self.typed.number(1.0)
        arm = max(math.dist(self.start, self.centre), _LEAST_ARM / pointer.scale)
        grown = math.dist(pointer.position, self.centre) - math.dist(self.start, self.centre)
        return 1.0 + grown / arm

    def _degrees(self, pointer: Pointer) -> float:
        if self.typed.counts:
            return self.typed.number(0.0)
        x, y = self._about(pointer)
        first, now = (math.degrees(math.atan2(at[1] - y, at[0] - x)) for at in (self.start, pointer.position))
        turned = (now - first + 180.0) % 360.0 - 180.0
        return _STEP * round(turned / _STEP) if self._is_stepped(pointer) else turned

    def _skewed(self, pointer: Pointer) -> float:
        """Return the degrees by which the held corner or side follows the pointer."""
        if self.typed.counts:
            return self.typed.number(0.0)
        axis = self.axis or 0
        arm = self.hold[1 - axis] - self._about(pointer)[1 - axis]
        if not arm:
            return 0.0
        degrees = math.degrees(math.atan((pointer.position[axis] - self.start[axis]) / arm))
        most, step = (75.0, _STEP) if self._is_stepped(pointer) else (LARGEST_SKEW, 0.0)
        return min(max(step * round(degrees / step) if step else degrees, -most), most)

    def _is_stepped(self, pointer: Pointer) -> bool:
        # With an opposite corner or side, Shift means that.
        return pointer.is_constrained if self.opposite is None else pointer.ctrl

    def _about(self, pointer: Pointer) -> Vector:
        """Return the centre of rotation or skew; nothing can be skewed about the side that is held."""
        if self.opposite is None:
            return self.centre
        across = 1 - (self.axis or 0)
        is_on_side = self.kind is TransformKind.SKEW and self.centre[across] == self.hold[across]
        return self.opposite if pointer.shift or is_on_side else self.centre

    # Words and marks

    def undo_text(self, pointer: Pointer) -> str:
        """Return "Rotate 4 points", "Scale all 5 points"."""
        return f"{self.kind.title} {'all ' if self._is_all else ''}{self.group.label}"

    @property
    def _is_all(self) -> bool:
        return self.everything and self.group.only_point is None

    @property
    def keys(self) -> str:
        """Effects of the keys."""
        if self.by_grip:
            return _turn_keys(self.kind, has_opposite=self.opposite is not None)
        return f"{self.typed.keys if self.typed.is_pair else self.kind.keys} · Enter or click: done"

    def amount(self, pointer: Pointer) -> str:
        """Return the amount; of all points because none is selected, that as well."""
        text, one = f"{self.kind.title} {self._amount_at(pointer)}", self.group.only_point
        if self._is_all:
            return f"All {self.group.label}: {text[0].lower()}{text[1:]}"
        if one is None or self.kind is not TransformKind.MOVE:
            return text
        return f"{text} · {words.point_at(one[1], self._moved(self._offset(pointer)), pointer.pixel_size)}"

    def _amount_at(self, pointer: Pointer) -> str:
        """Return the amount in words; with the typed text where that is an expression, or no number yet."""
        mark = self.typed.mark
        if self.kind is TransformKind.ROTATE:
            return f"{words.angle(self._degrees(pointer))}{mark}"
        if self.kind is TransformKind.SKEW:
            return f"{words.angle(self._skewed(pointer))} along {'xy'[self.axis or 0]}{mark}"
        if self.typed.is_pair:
            return self.typed.pair_text("0" if self.kind is TransformKind.MOVE else "1")
        along = "" if self.axis is None else f" along {'xy'[self.axis]}"
        if self.kind is TransformKind.SCALE:
            return f"{words.number(self._factor(pointer))}{along}{mark}"
        offset = self._offset(pointer)
        if self.axis is None:
            return f"{words.pair_text(offset)}{mark}"
        return f"{words.number(offset[self.axis])}{along}{mark}"

    def _moved(self, offset: Vector) -> Vector:
        curve, index = self.grabbed
        return plus(self.document.curves[curve].points[index].position, offset)

    def position_at(self, pointer: Pointer) -> Vector | None:
        """Return the position of the grabbed point, None while points are scaled or rotated."""
        return self._moved(self._offset(pointer)) if self.kind is TransformKind.MOVE else None

    def marks(self, event: ToolEvent) -> Marks:
        """Return the amount beside the pointer, the locked axis, the pivot, and the snap."""
        if self.by_grip:
            marks = super().marks(event)
            pivot = self._about(event.pointer) if self.kind.is_angle else marks.pivot
            return replace(marks, pivot=pivot, note=_note(event, self))
        is_axis_drawn = self.axis is not None and self.kind is not TransformKind.ROTATE
        return Marks(
            frame=event.box.rectangle,
            pivot=event.box.pivot if self.kind is TransformKind.MOVE else self.centre,
            snap=event.snapping.caught,
            note=_note(event, self),
            axis=(self.centre, along_axis((1.0, 1.0), self.axis)) if is_axis_drawn else None,
        )


def hint_inside_box(group: PointGroup, pointer: Pointer, *, snaps: bool) -> Hint:
    """Return the hint inside the box around a group."""
    keys = f"Ctrl: one axis · Shift+drag: rubber band · {snap_key_text(snaps=snaps)} · Click: deselect"
    return Hint(f"{drag_to_move(group.quoted_label, pointer)} · {keys}", cursor=Cursor.MOVE)


# The pivot: only the centre of transforms changes, nothing in the document

_PIVOT_REACH = 7.0
"""Pixels from the mark of the pivot within which a press takes it."""

PIVOT_HINT = Hint(
    "Drag the pivot, about which the selection is rotated, scaled and mirrored · "
    "Shift+click: reset it to the middle",
    cursor=Cursor.MOVE,
)


def is_on_pivot(pivot: Vector, pointer: Pointer) -> bool:
    """Return whether a press would take the mark of a pivot."""
    return math.dist(pivot, pointer.position) * pointer.scale <= _PIVOT_REACH


def press_on_pivot(event: ToolEvent, on_click: Callable[[ToolEvent], object] | None) -> MovePivot:
    """Start to drag the pivot. A double click or Shift+click puts it back; `on_click` is any other click."""
    pointer = event.pointer

    def click(release: ToolEvent) -> None:
        if pointer.is_double or (pointer.shift and on_click is None):
            release.box.pivot = None
        if on_click is not None:
            on_click(release)

    return MovePivot(
        press=pointer.position,
        start=event.box.centre,
        before=event.session.box.pivot,
        snapper=event.snapping.for_pivot(event.box.bounds),
        on_click=click,
    )


class MovePivot(Gesture, kw_only=True):
    """Drag of the pivot. Ctrl or Shift keeps to one axis; it snaps to the nine positions of the box.

    Attributes
    ----------
    press, start
        The positions of the press and of the pivot then.
    before
        The pivot that was set before.
    """

    press: Vector
    start: Vector
    before: Pivot | None
    snapper: Snapper

    def move(self, event: ToolEvent) -> None:
        """Let the pivot follow the pointer."""
        pointer = event.pointer
        offset = pointer.offset_from(self.press)
        axis = axis_held(offset, pointer)
        event.box.pivot = self.snapper.snap(plus(self.start, along_axis(offset, axis)), pointer, axis)

    def cancel(self, event: ToolEvent) -> None:
        """Put the pivot where it was."""
        event.session.box.set_pivot(self.before)
        super().cancel(event)

    def status(self, event: ToolEvent) -> str:
        """Return the position of the pivot."""
        centre = words.pair_text(event.box.centre, event.pointer.pixel_size)
        return f"Pivot {centre} · {AXIS_KEYS} · {SNAP_KEY} · Escape cancels"

    def marks(self, event: ToolEvent) -> Marks:
        """Return the frame, the pivot, and its snap."""
        return replace(super().marks(event), snap=event.snapping.caught)
