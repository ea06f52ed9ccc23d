"""The pointer: position and modifier keys, the part under it, the hint about it; offsets in the plane."""

from __future__ import annotations

import math
from enum import Enum, auto

import msgspec
from msgspec.structs import replace

from ..document.model import Vector
from ..document.point_group import PointGroup

# Effects of keys in all drags, in hints and status line. `Pointer.is_constrained`: Ctrl or Shift is held.
AXIS_KEYS = "Ctrl or Shift: one axis"
STEP_KEYS = "Ctrl or Shift: steps of 15°"
SNAP_KEY = "%: snap on or off"


class Part(Enum):
    """A part of the drawing that can be hit.

    Attributes
    ----------
    POINT, HANDLE
        A point, and the end of a handle, of any curve that is edited.
    CURVE
        The line of the active curve.
    TICK
        The mark of a knot on the t-rail.
    FUNCTION
        The graph of a basis function.
    SCRUB
        The scrub line.
    DOT
        A dot on the edge of the t-rail, which stands for a control point.
    IMAGE, IMAGE_CORNER
        The picture to trace, and a corner of it.
    OTHER_CURVE
        The line of another curve than the active one, or its fill.
    OTHER_POINT
        A point of another curve that is edited; `Hit.on_active_curve` makes it POINT.
    OTHER_END
        The first or the last point of another curve, one that is open, visible and unlocked; likewise.
    GUIDE
        A guide, a line that a person has dragged out of a ruler.
    """

    POINT = auto()
    HANDLE = auto()
    CURVE = auto()
    TICK = auto()
    FUNCTION = auto()
    SCRUB = auto()
    DOT = auto()
    IMAGE = auto()
    IMAGE_CORNER = auto()
    OTHER_CURVE = auto()
    OTHER_POINT = auto()
    OTHER_END = auto()
    GUIDE = auto()


class Hit(msgspec.Struct, frozen=True):
    """A part of the drawing under the pointer.

    A tool reads it as ``event.hit``, for a press and a hover: ``if hit.part is Part.POINT``, the point
    ``hit.index`` of the active curve is there.

    Attributes
    ----------
    part
        The kind of part.
    index
        An index that `part` gives its meaning: of the point of its curve, for a point, a handle, a tick or a
        function; of the point before which a new one would be inserted, for the line of the active curve; in
        the document, for another curve and a guide; of the control point, for a dot; −1 for all else.
    curve
        The index of its curve, for a point or a handle of another curve than the active one; −1 for all
        else. `on_active_curve` is the hit once that curve is active.
    position
        Its exact position in the plane (on the curve: the nearest point of it).
    ahead
        For a handle: whether it lies on the segment after the point.
    t
        For the curve: the parameter there.
    order
        For a handle or a basis function: the order of the derivative, 0 for the position.
    knot
        For a tick: the knot it stands at; a closed curve has one more knot than points. For a corner of the
        picture to trace: 0 to 3, counterclockwise from the lower left.
    over
        For a handle: the point that it lies over, −1 for none.
    inside
        For another curve: whether it is hit inside its fill, and not on its line.
    """

    part: Part
    index: int
    position: Vector
    curve: int = -1
    ahead: bool = True
    t: float = 0.0
    order: int = 0
    knot: int = -1
    over: int = -1
    inside: bool = False

    @property
    def on_active_curve(self) -> Hit:
        """The same point or handle, once its curve is the active one."""
        is_point = self.part in (Part.OTHER_POINT, Part.OTHER_END)
        return replace(self, part=Part.POINT if is_point else self.part, curve=-1)


class Pointer(msgspec.Struct, frozen=True):
    """One press, move or release.

    Design space and screen space are apart: a gesture moves points by ``pointer.offset_from(start)``, in the
    plane, and compares distances in ``pixel``.

    Attributes
    ----------
    position
        Its position in the plane of the plot: (x, y) on the canvas, (t, value) in the basis panel.
    pixel
        Its position in pixels of the plot area.
    shift, ctrl, alt
        Modifier keys.
    scale
        Pixels per unit of the plane, for lengths on the screen.
    ripple
        Whether E is held: on the t-rail, the ticks ahead move along.
    is_double
        Whether a press is the second one of a double click.
    """

    position: Vector
    pixel: Vector
    shift: bool = False
    ctrl: bool = False
    alt: bool = False
    scale: float = 1.0
    ripple: bool = False
    is_double: bool = False

    @property
    def pixel_size(self) -> float:
        """The size of a pixel in the plane."""
        return 1.0 / self.scale

    @property
    def is_constrained(self) -> bool:
        """Whether Ctrl or Shift is held: a drag keeps to one axis, or an angle to steps of 15°."""
        return self.ctrl or self.shift

    @property
    def is_there(self) -> bool:
        """Whether the pointer is over the plot."""
        return math.isfinite(self.position[0])

    def offset_from(self, position: Vector) -> Vector:
        """Return the offset of the pointer from a position in the plane."""
        return (self.position[0] - position[0], self.position[1] - position[1])


ELSEWHERE = Pointer((math.inf, math.inf), (math.inf, math.inf))
"""The pointer after it has left the plot."""

ORIGIN = Pointer((0.0, 0.0), (0.0, 0.0))
"""The pointer of an edit by keys."""


class Cursor(Enum):
    """Shape of the pointer: its name in Qt, or the name of an icon."""

    ARROW = "ArrowCursor"
    CROSS = "CrossCursor"
    HAND = "PointingHandCursor"
    MOVE = "SizeAllCursor"
    WIDER = "SizeHorCursor"
    HIGHER = "SizeVerCursor"
    RISING = "SizeBDiagCursor"
    FALLING = "SizeFDiagCursor"
    ROTATE = "rotate"
    BEND = "bend"


class Hint(msgspec.Struct, frozen=True):
    """The effect of a press, before it is made: ``Hint("Drag to move point 2", grab=True)``.

    Attributes
    ----------
    text
        A sentence for the status line.
    grab, cursor
        Whether something can be grabbed; the shape of the pointer, where it is another one.
    highlighted
        The point to highlight, −1 for none; None for the point under the pointer.
    """

    text: str = ""
    grab: bool = False
    cursor: Cursor | None = None
    highlighted: int | None = None

    def cursor_over(self, idle: Cursor) -> Cursor:
        """Return the shape of the pointer; `idle` where a press means nothing in particular."""
        return self.cursor or (Cursor.HAND if self.grab else idle)


def selection_text(group: PointGroup) -> str:
    """Return "Point 3 selected", "5 points in 2 curves selected"."""
    words = f"{group.label} selected" if group.parts else "no point selected"
    return f"{words[0].upper()}{words[1:]}"


def drag_to_move(what: str, pointer: Pointer) -> str:
    """Return the effect of a drag of points or curves with the keys that are held."""
    axis = " along one axis" if pointer.is_constrained else ""
    return f"Drag to move {what}{axis}"


def snap_key_text(*, snaps: bool) -> str:
    """Return the present effect of the key for snapping."""
    return f"%: {'no snap' if snaps else 'snap'}"


# Offsets in the plane


def minus(a: Vector, b: Vector) -> Vector:
    """Return the offset from `b` to `a`."""
    return (a[0] - b[0], a[1] - b[1])


def plus(a: Vector, b: Vector) -> Vector:
    """Return the position at the offset `b` from `a`."""
    return (a[0] + b[0], a[1] + b[1])


def longer_axis(offset: Vector) -> int:
    """Return the axis, 0 or 1, along which an offset is longer."""
    return 0 if abs(offset[0]) >= abs(offset[1]) else 1


def axis_held(offset: Vector, pointer: Pointer) -> int | None:
    """Return the axis that Ctrl or Shift keeps an offset to, None while neither is held."""
    return longer_axis(offset) if pointer.is_constrained else None


def along_axis(offset: Vector, axis: int | None) -> Vector:
    """Return the part of an offset along one axis, all of it for None."""
    return offset if axis is None else (offset[0], 0.0) if axis == 0 else (0.0, offset[1])


def in_steps(v: Vector) -> Vector:
    """Turn `v` to the nearest multiple of 15 degrees; along the axes exactly."""
    steps = round(math.degrees(math.atan2(v[1], v[0])) / 15)
    length = math.hypot(*v)
    if steps % 6 == 0:
        x, y = ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))[steps // 6 % 4]
    else:
        x, y = math.cos(math.radians(15 * steps)), math.sin(math.radians(15 * steps))
    return (length * x, length * y)
