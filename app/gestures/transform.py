"""Move, scale and rotate by keys: the pointer moves with no button down, and a number may be typed."""

from __future__ import annotations

import math
from collections.abc import Callable
from enum import Enum

import msgspec
from msgspec.structs import replace

from app.document.model import Document, Vector
from app.document.several_curves import NodeGroup, mapped, moved
from app.document.transforms import rotation, scaling
from app.gestures import words
from app.gestures.drags import MovePoints
from app.gestures.machine import DragMachine, Host
from app.gestures.pointer import Pointer
from app.gestures.snapping import Magnet

_LEAST_ARM = 20.0
"""Pixels: begun closer to the centre, a scale would jump at the first move."""


class TransformKind(Enum):
    """What is done to the selection."""

    MOVE = "Move"
    SCALE = "Scale"
    ROTATE = "Rotate"


class Transform(msgspec.Struct, frozen=True):
    """A transform in flight.

    Attributes
    ----------
    centre
        What is scaled and rotated about.
    start
        Where the pointer was when it began.
    magnet, grip
        For a move: what snaps, and which node of which curve.
    axis
        0 or 1 where an axis is locked.
    typed
        The amount as typed so far; the pointer gives it while this is empty.
    by_grip
        Whether it is dragged by the grip of a box, where no keys are taken.
    """

    kind: TransformKind
    document: Document
    group: NodeGroup
    centre: Vector
    start: Vector
    magnet: Magnet
    grip: tuple[int, int]
    axis: int | None = None
    typed: str = ""
    by_grip: bool = False

    @property
    def name(self) -> str:
        """The name of the step."""
        return f"{self.kind.value} {words.group(self.group)}"

    @property
    def keys(self) -> str:
        """What keys change."""
        if self.by_grip:
            return "Shift: steps of 15°"
        turn = {
            TransformKind.MOVE: "X or Y: one axis · Ctrl: snap, or not",
            TransformKind.SCALE: "X or Y: one axis",
            TransformKind.ROTATE: "Shift: steps of 15°",
        }[self.kind]
        return f"{turn} · type a number · Enter or click: done"

    def note_at(self, pointer: Pointer) -> str:
        """Tell the amount."""
        if self.kind is TransformKind.ROTATE:
            return f"Rotate {words.angle(self._degrees(pointer))}{self._cursor_mark()}"
        along = "" if self.axis is None else f" along {'xy'[self.axis]}"
        if self.kind is TransformKind.SCALE:
            return f"Scale {words.number(self._factor(pointer))}{along}{self._cursor_mark()}"
        by = self._way(pointer)
        amount = words.vector(by) if self.axis is None else words.number(by[self.axis])
        note = f"Move {amount}{along}{self._cursor_mark()}"
        one = self.group.only_node
        return note if one is None else f"{note} · {words.point_at(one[1], self._moved(by))}"

    def _moved(self, by: Vector) -> Vector:
        curve, index = self.grip
        held = self.document.curves[curve].nodes[index].position
        return (held[0] + by[0], held[1] + by[1])

    def place_at(self, pointer: Pointer) -> Vector | None:
        """Return where the node is that is moved, None while nodes are scaled or rotated."""
        return self._moved(self._way(pointer)) if self.kind is TransformKind.MOVE else None

    def _cursor_mark(self) -> str:
        """Tell what has been typed where it is no number yet."""
        unfinished = self.typed and _amount(self.typed) is None
        return f" ({self.typed.replace('-', '−')}…)" if unfinished else ""

    def document_at(self, pointer: Pointer) -> Document:
        """Transform by the whole amount since the beginning."""
        if self.kind is TransformKind.MOVE:
            if self.typed:
                self.magnet.release()
                return moved(self.document, self.group, self._way(pointer))
            return self._move().document_at(pointer)
        if self.kind is TransformKind.ROTATE:
            by = rotation(self._degrees(pointer), self.centre)
        else:
            factor = self._factor(pointer)
            x, y = (1.0 if self.axis == other else factor for other in (1, 0))
            by = scaling(x, y, self.centre)
        return mapped(self.document, self.group, by)

    def _move(self) -> MovePoints:
        return MovePoints(self.document, self.group, self.start, self.magnet, self.grip, self.axis)

    def _way(self, pointer: Pointer) -> Vector:
        if not self.typed:
            return self._move().way_at(pointer)[0]
        amount = _amount(self.typed) or 0.0
        return (0.0, amount) if self.axis == 1 else (amount, 0.0)

    def _factor(self, pointer: Pointer) -> float:
        if self.typed:
            amount = _amount(self.typed)
            return 1.0 if amount is None else amount
        arm = max(math.dist(self.start, self.centre), _LEAST_ARM / pointer.scale)
        grown = math.dist(pointer.position, self.centre) - math.dist(self.start, self.centre)
        return 1.0 + grown / arm

    def _degrees(self, pointer: Pointer) -> float:
        if self.typed:
            return _amount(self.typed) or 0.0
        first, now = (_direction(self.centre, place) for place in (self.start, pointer.position))
        turned = (now - first + 180.0) % 360.0 - 180.0
        return 15.0 * round(turned / 15.0) if pointer.shift else turned


def _direction(centre: Vector, place: Vector) -> float:
    return math.degrees(math.atan2(place[1] - centre[1], place[0] - centre[0]))


def _amount(typed: str) -> float | None:
    """Return the number typed, None while it is none yet ("−", ".")."""
    try:
        value = float(typed)
    except ValueError:
        return None
    return value if math.isfinite(value) else None


class ModalTransform:
    """The transform that keys began, and what further keys make of it."""

    def __init__(self, host: Host, machine: DragMachine) -> None:
        self._host, self._machine = host, machine
        self._transform: Transform | None = None
        self.last: Pointer | None = None

    @property
    def now(self) -> Transform | None:
        """The transform in flight."""
        return self._transform if self._machine.is_pressed else None

    def begin(self, transform: Transform, pointer: Pointer) -> None:
        """Begin; the document follows the pointer from now on."""
        self._transform, self.last = transform, pointer
        self._machine.press_at_once(pointer, transform)

    def follow(self, pointer: Pointer) -> None:
        """Follow the pointer, no button down."""
        self.last = pointer
        self._machine.move(pointer)

    def finish(self, pointer: Pointer) -> None:
        """Make it a step of the history."""
        self._machine.release(pointer)
        self._transform = None

    def drop(self) -> None:
        """Forget it; the machine has been told."""
        self._transform = None

    def key(self, key: str) -> bool:
        """Take a key: a digit, ".", "-", "x", "y", "g", "s", "r", "backspace" or "enter"."""
        now, last = self.now, self.last
        if now is None or last is None:
            return False
        if key == "enter":
            self.finish(last)
            return True
        change = self._change(now, key)
        if change is None:
            return False
        self._transform = change()
        self._machine.exchange(last, self._transform)
        return True

    def _change(self, now: Transform, key: str) -> Callable[[], Transform] | None:
        kinds = {"g": TransformKind.MOVE, "s": TransformKind.SCALE, "r": TransformKind.ROTATE}
        if key in kinds:
            return lambda: replace(now, kind=kinds[key], typed="")
        if key in ("x", "y") and now.kind is not TransformKind.ROTATE:
            axis = "xy".index(key)
            return lambda: replace(now, axis=None if now.axis == axis else axis)
        if key == "backspace":
            return lambda: replace(now, typed=now.typed[:-1])
        if key == "-":
            # A minus sign turns the amount round, wherever it is typed.
            turned = now.typed[1:] if now.typed.startswith("-") else f"-{now.typed}"
            return lambda: replace(now, typed=turned)
        if (key == "." and "." not in now.typed) or (len(key) == 1 and key in "0123456789"):
            return lambda: replace(now, typed=now.typed + key)
        return None
