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
from app.tools import words
from app.tools.drags import MovePoints
from app.tools.machine import DragMachine, Host
from app.tools.pointer import Pointer
from app.tools.snapping import Magnet
from app.tools.typed_amount import TypedAmount

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
    everything
        Whether it acts on all points of the curve because none is selected: the words say so.
    """

    kind: TransformKind
    document: Document
    group: NodeGroup
    centre: Vector
    start: Vector
    magnet: Magnet
    grip: tuple[int, int]
    axis: int | None = None
    typed: TypedAmount = TypedAmount()
    by_grip: bool = False
    everything: bool = False

    @property
    def name(self) -> str:
        """The name of the step."""
        return f"{self.kind.value} {'all ' if self._is_all else ''}{words.group(self.group)}"

    @property
    def _is_all(self) -> bool:
        return self.everything and self.group.only_node is None

    @property
    def keys(self) -> str:
        """What keys change."""
        if self.by_grip:
            return "Shift: steps of 15°"
        if self.typed.is_pair:
            return f"{self.typed.keys} · Enter or click: done"
        turn = {
            TransformKind.MOVE: "X or Y: one axis · Ctrl: snap, or not · type a number, or x Tab y",
            TransformKind.SCALE: "X or Y: one axis · type a number, or x Tab y",
            TransformKind.ROTATE: "Shift: steps of 15° · type a number",
        }[self.kind]
        return f"{turn} · Enter or click: done"

    def note_at(self, pointer: Pointer) -> str:
        """Tell the amount; of all points because none is selected, that too."""
        note, one = f"{self.kind.value} {self._amount_at(pointer)}", self.group.only_node
        if self._is_all:
            what = words.group(self.group)
            return f"All {what}: {note[0].lower()}{note[1:]}"
        if one is None or self.kind is not TransformKind.MOVE:
            return note
        return f"{note} · {words.point_at(one[1], self._moved(self._way(pointer)))}"

    def _amount_at(self, pointer: Pointer) -> str:
        """Return the amount in words; while one is typed that is no number yet, with that."""
        mark = f" ({self.typed.unfinished}…)" if self.typed.unfinished else ""
        if self.kind is TransformKind.ROTATE:
            return f"{words.angle(self._degrees(pointer))}{mark}"
        if self.typed.is_pair:
            return self.typed.told("0" if self.kind is TransformKind.MOVE else "1")
        along = "" if self.axis is None else f" along {'xy'[self.axis]}"
        if self.kind is TransformKind.SCALE:
            return f"{words.number(self._factor(pointer))}{along}{mark}"
        by = self._way(pointer)
        return f"{words.vector(by) if self.axis is None else words.number(by[self.axis])}{along}{mark}"

    def _moved(self, by: Vector) -> Vector:
        curve, index = self.grip
        held = self.document.curves[curve].nodes[index].position
        return (held[0] + by[0], held[1] + by[1])

    def place_at(self, pointer: Pointer) -> Vector | None:
        """Return where the node is that is moved, None while nodes are scaled or rotated."""
        return self._moved(self._way(pointer)) if self.kind is TransformKind.MOVE else None

    def document_at(self, pointer: Pointer) -> Document:
        """Transform by the whole amount since the beginning."""
        if self.kind is TransformKind.MOVE:
            if self.typed.counts:
                self.magnet.release()
                return moved(self.document, self.group, self._way(pointer))
            return self._move().document_at(pointer)
        if self.kind is TransformKind.ROTATE:
            by = rotation(self._degrees(pointer), self.centre)
        else:
            by = scaling(*self._factors(pointer), self.centre)
        return mapped(self.document, self.group, by)

    def _move(self) -> MovePoints:
        return MovePoints(self.document, self.group, self.start, self.magnet, self.grip, self.axis)

    def _way(self, pointer: Pointer) -> Vector:
        if not self.typed.counts:
            return self._move().way_at(pointer)[0]
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
        first, now = (_direction(self.centre, place) for place in (self.start, pointer.position))
        turned = (now - first + 180.0) % 360.0 - 180.0
        return 15.0 * round(turned / 15.0) if pointer.shift else turned


def _direction(centre: Vector, place: Vector) -> float:
    return math.degrees(math.atan2(place[1] - centre[1], place[0] - centre[0]))


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
        """Take a key: a digit, ".", "-", "tab", "x", "y", "g", "s", "r", "backspace" or "enter"."""
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
            return lambda: replace(now, kind=kinds[key], typed=TypedAmount())
        if key in ("x", "y", "tab") and now.kind is TransformKind.ROTATE:
            return None
        if key in ("x", "y"):
            axis = "xy".index(key)
            return lambda: replace(now, axis=None if now.axis == axis else axis, typed=now.typed.joined(axis))
        if key == "tab":
            return lambda: replace(now, axis=None, typed=now.typed.after_tab(now.axis))
        typed = now.typed.after(key)
        return (lambda: replace(now, typed=typed)) if typed is not None else None
