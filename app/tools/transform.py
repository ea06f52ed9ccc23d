"""Move, scale, rotate and skew: the drag of a transform, by the pointer or by a typed amount."""

from __future__ import annotations

import math
from enum import Enum

from msgspec.structs import replace

from ..document import words
from ..document.model import Document, Vector
from ..document.point_group import PointGroup
from ..document.several_curves import move_group, transform_group
from ..document.transforms import LARGEST_SKEW, rotation, scaling, skew
from .drag import Drag, plus
from .drags import MovePoints
from .pointer import SNAP_KEY, STEP_KEYS, Pointer
from .snapping import Snapper
from .typed_amount import TypedAmount

_LEAST_ARM = 20.0
"""Pixels: begun closer to the centre, a scale would jump at the first move."""


class TransformKind(Enum):
    """Kind of transform.

    Attributes
    ----------
    title
        The word for it.
    key
        What a tool calls the key that begins it, and goes on with it where another one is in flight: a
        capital letter with Shift.
    keys
        What keys change meanwhile.
    """

    MOVE = ("Move", "g", f"X, Y, Ctrl or Shift: one axis · {SNAP_KEY} · type a number, or x Tab y")
    SCALE = ("Scale", "s", "X or Y: one axis · type a number, or x Tab y")
    ROTATE = ("Rotate", "r", f"{STEP_KEYS} · type a number")

    SKEW = ("Skew", "R", f"X or Y: along which axis · {STEP_KEYS} · type a number")

    def __init__(self, title: str, key: str, keys: str) -> None:
        self.title, self.key, self.keys = title, key, keys

    @property
    def is_angle(self) -> bool:
        """Whether its amount is an angle."""
        return self in (TransformKind.ROTATE, TransformKind.SKEW)

    def amount(self, document: Document) -> TypedAmount:
        """Return the amount while nothing is typed: a move goes by lengths."""
        return TypedAmount(unit=document.unit if self is TransformKind.MOVE else None)


_STEP = 15.0
"""Degrees from one angle to the next, with the key for steps."""


def grip_keys(kind: TransformKind, *, has_opposite: bool) -> str:
    """Return what modifiers change while a grip rotates or skews; one may have an opposite corner or side."""
    if not has_opposite:
        return STEP_KEYS
    opposite = "corner" if kind is TransformKind.ROTATE else "side"
    return f"Ctrl: steps of 15° · Shift: about the opposite {opposite}"


class Transform(Drag, frozen=True):
    """A transform in flight.

    Attributes
    ----------
    centre
        What is scaled, rotated and skewed about.
    hold
        What a skew takes along with the pointer: a place of the box.
    start
        Where the pointer was when it began.
    snapper, grip
        For a move: what snaps, and which point of which curve.
    opposite
        What a grip rotates or skews about with Shift: the other side; None where Shift means steps.
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
    group: PointGroup
    centre: Vector
    hold: Vector
    start: Vector
    snapper: Snapper
    grip: tuple[int, int]
    opposite: Vector | None = None
    axis: int | None = None
    typed: TypedAmount = TypedAmount()
    by_grip: bool = False
    everything: bool = False

    @property
    def name(self) -> str:
        """The name of the step."""
        return f"{self.kind.title} {'all ' if self._is_all else ''}{self.group.label}"

    @property
    def remark(self) -> str:
        """What of the group is locked."""
        return self.group.remark

    @property
    def refusal(self) -> str:
        """Why what is typed is no number yet."""
        return self.typed.refusal

    @property
    def _is_all(self) -> bool:
        return self.everything and self.group.only_point is None

    @property
    def keys(self) -> str:
        """Effects of the keys."""
        if self.by_grip:
            return grip_keys(self.kind, has_opposite=self.opposite is not None)
        if self.typed.is_pair:
            return f"{self.typed.keys} · Enter or click: done"
        return f"{self.kind.keys} · Enter or click: done"

    def with_key(self, key: str) -> Transform | None:
        """Return the transform that a key makes of it, of another kind, axis or amount, if it means one.

        Raises
        ------
        EditError
            For a letter that is none of a unit.
        """
        if self.typed.continues_unit(key):
            return replace(self, typed=self.typed.after(key))
        kind = next((kind for kind in TransformKind if kind.key == key), None)
        if kind is not None:
            return replace(self, kind=kind, typed=kind.amount(self.document))
        if (key in ("x", "y") and self.kind is TransformKind.ROTATE) or (key == "tab" and self.kind.is_angle):
            return None
        if key in ("x", "y"):
            axis = "xy".index(key)
            locked = None if self.axis == axis else axis
            return replace(self, axis=locked, typed=self.typed.joined(axis))
        if key == "tab":
            return replace(self, axis=None, typed=self.typed.after_tab(self.axis))
        typed = self.typed.after(key)
        return replace(self, typed=typed) if typed is not None else None

    @property
    def locked_axis(self) -> tuple[Vector, int] | None:
        """A point on the axis that is locked, and which it is; None where none is."""
        is_locked = self.axis is not None and self.kind is not TransformKind.ROTATE
        return (self.centre, self.axis) if is_locked and self.axis is not None else None

    def readout(self, pointer: Pointer) -> str:
        """Return the amount; of all points because none is selected, that too."""
        note, one = f"{self.kind.title} {self._amount_at(pointer)}", self.group.only_point
        if self._is_all:
            what = self.group.label
            return f"All {what}: {note[0].lower()}{note[1:]}"
        if one is None or self.kind is not TransformKind.MOVE:
            return note
        return f"{note} · {words.point_at(one[1], self._moved(self._displacement(pointer)))}"

    def _amount_at(self, pointer: Pointer) -> str:
        """Return the amount in words; with what is typed where that is an expression, or no number yet."""
        mark = self.typed.mark
        if self.kind is TransformKind.ROTATE:
            return f"{words.angle(self._degrees(pointer))}{mark}"
        if self.kind is TransformKind.SKEW:
            return f"{words.angle(self._skewed(pointer))} along {'xy'[self.axis or 0]}{mark}"
        if self.typed.is_pair:
            return self.typed.told("0" if self.kind is TransformKind.MOVE else "1")
        along = "" if self.axis is None else f" along {'xy'[self.axis]}"
        if self.kind is TransformKind.SCALE:
            return f"{words.number(self._factor(pointer))}{along}{mark}"
        by = self._displacement(pointer)
        if self.axis is None:
            return f"{words.pair_text(by)}{mark}"
        return f"{words.number(by[self.axis])}{along}{mark}"

    def _moved(self, by: Vector) -> Vector:
        curve, index = self.grip
        return plus(self.document.curves[curve].points[index].position, by)

    def place_at(self, pointer: Pointer) -> Vector | None:
        """Return where the point is that is moved, None while points are scaled or rotated."""
        return self._moved(self._displacement(pointer)) if self.kind is TransformKind.MOVE else None

    def document_at(self, pointer: Pointer) -> Document:
        """Transform by the whole amount since the beginning."""
        if self.kind is TransformKind.MOVE:
            if self.typed.counts:
                self.snapper.reset()
                return move_group(self.document, self.group, self._displacement(pointer))
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
        return MovePoints(self.document, self.group, self.start, self.snapper, self.grip, self.axis)

    def _displacement(self, pointer: Pointer) -> Vector:
        if not self.typed.counts:
            return self._move().displacement(pointer)
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
        first, now = (_direction(self._about(pointer), place) for place in (self.start, pointer.position))
        turned = (now - first + 180.0) % 360.0 - 180.0
        return _STEP * round(turned / _STEP) if self._is_stepped(pointer) else turned

    def _skewed(self, pointer: Pointer) -> float:
        """Return the degrees with which what is held goes along with the pointer."""
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
        return pointer.holds_line if self.opposite is None else pointer.ctrl

    def about(self, pointer: Pointer) -> Vector | None:
        """Return what it rotates or skews about."""
        return self._about(pointer) if self.kind.is_angle else None

    def _about(self, pointer: Pointer) -> Vector:
        """Return what is rotated or skewed about; nothing can be skewed about the side that is held."""
        if self.opposite is None:
            return self.centre
        across = 1 - (self.axis or 0)
        is_on_side = self.kind is TransformKind.SKEW and self.centre[across] == self.hold[across]
        return self.opposite if pointer.shift or is_on_side else self.centre


def _direction(centre: Vector, place: Vector) -> float:
    return math.degrees(math.atan2(place[1] - centre[1], place[0] - centre[0]))
