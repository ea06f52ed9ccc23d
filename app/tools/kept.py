"""Texts and pictures of other programs: chosen by a click, dragged, moved by keys, removed."""

from __future__ import annotations

from typing import NamedTuple

from ..document.kept import KeptPicture, KeptText
from ..document.kept_moves import (
    KeptPlace,
    is_locked,
    move_kept,
    parts_of,
    place_of,
    remove_kept,
    words_of,
)
from ..document.model import Document, Vector
from ..document.words import number
from .drag import Drag, along_axis, axis_held
from .drag_machine import EditingHost
from .pointer import AXIS_KEYS, Cursor, Hint, Pointer, Stride
from .tool import ToolContext

_KEYS = "drag or arrow keys: move it · Del: remove it"


class MoveKept(Drag, frozen=True):
    """Drag of a text or a picture; Ctrl or Shift keeps to one axis."""

    place: KeptPlace
    start: Vector
    unit: str

    keys = AXIS_KEYS

    @property
    def name(self) -> str:
        """The name of the step: what is moved."""
        words = words_of(self.document, self.place)
        return f"Move {words[0].lower()}{words[1:]}"

    def _way(self, pointer: Pointer) -> Vector:
        by = pointer.way_from(self.start)
        return along_axis(by, axis_held(by, pointer))

    def document_at(self, pointer: Pointer) -> Document:
        """Move by the whole way from the press."""
        return move_kept(self.document, self.place, self._way(pointer))

    def readout(self, pointer: Pointer) -> str:
        """Return how far it is moved."""
        x, y = (number(each, 4) for each in self._way(pointer))
        return f"Move by ({x}, {y}){f' {self.unit}' if self.unit else ''}"


class NudgeKept(Drag, frozen=True):
    """Move of a text or a picture by a key."""

    place: KeptPlace
    by: Vector

    @property
    def name(self) -> str:
        """The name of the step."""
        words = words_of(self.document, self.place)
        return f"Nudge {words[0].lower()}{words[1:]}"

    def document_at(self, _pointer: Pointer) -> Document:
        """Move by the step."""
        return move_kept(self.document, self.place, self.by)


class _Choice(NamedTuple):
    """What was clicked, and what there was then: it is chosen as long as that is so."""

    place: KeptPlace
    among: int
    marked: frozenset[int]
    is_editing: bool

    @classmethod
    def of(cls, host: EditingHost, place: KeptPlace) -> _Choice:
        document, selected = host.document, host.selected
        count = len(document.kept_texts) + len(document.kept_pictures)
        return cls(place, count, selected.chosen, selected.is_editing)


class KeptPicker:
    """The text or picture that was clicked, for a tool that finds such; no curve is chosen beside it."""

    def __init__(self) -> None:
        self._host: EditingHost | None = None
        self._choice: _Choice | None = None

    @property
    def chosen(self) -> KeptPlace | None:
        """What was clicked and keys are about; None once something else is chosen."""
        choice, host = self._choice, self._host
        if choice is None or host is None or choice != _Choice.of(host, choice.place):
            return None
        return choice.place

    @property
    def parts(self) -> tuple[KeptText | KeptPicture, ...]:
        """What is chosen, to be framed."""
        place, host = self.chosen, self._host
        return parts_of(host.document, place) if place is not None and host is not None else ()

    def let_go(self) -> bool:
        """Choose none any more; return whether one was chosen."""
        had = self.chosen is not None
        self._choice = self._host = None
        return had

    def choose(self, context: ToolContext, place: KeptPlace) -> None:
        """Choose it, and no curve."""
        host = self._host = context.host
        host.selected.choose(())
        self._choice = _Choice.of(host, place)
        host.say(f"{words_of(host.document, place)} · {_KEYS}.")

    def press(self, context: ToolContext, place: KeptPlace) -> None:
        """Choose it, and begin to drag it."""
        self.choose(context, place)
        drag = MoveKept(context.host.document, place, context.pointer.position, context.settings.unit)
        context.drags.press(context.pointer, drag)

    def nudge(self, context: ToolContext, direction: Vector, stride: Stride) -> bool:
        """Move what is chosen; return whether there is anything."""
        if (place := self.chosen) is None:
            return False
        step = context.step_of(stride)
        nudge = NudgeKept(context.host.document, place, (direction[0] * step, direction[1] * step))
        context.drags.nudge(nudge, ("kept", place))
        return True

    def claims(self, key: str) -> bool:
        """Whether a key is for what is chosen."""
        return key in ("delete", "backspace") and self.chosen is not None

    def key(self, context: ToolContext, key: str) -> bool:
        """Remove what is chosen with Delete; return whether there was anything."""
        place = self.chosen
        if place is None or not self.claims(key) or context.drags.is_pressed:
            return False
        words = words_of(context.host.document, place)
        name = f"Delete {words[0].lower()}{words[1:]}"
        self.let_go()
        return bool(context.host.change(name, lambda now: remove_kept(now, place)))

    def hint(self, context: ToolContext) -> Hint | None:
        """Return what a press on what lies at the pointer would do; None beside all."""
        if (place := find_kept(context)) is None:
            return None
        words, is_chosen = words_of(context.host.document, place), place == self.chosen
        if context.host.selected.is_editing:
            return Hint(f"{words} · Click: choose it · Drag: select with a rubber band", grab=True)
        keys = "arrow keys too · Del: remove it" if is_chosen else "Click: choose it · Shift: rubber band"
        return Hint(f"{words} · Drag: move it, {AXIS_KEYS} · {keys}", cursor=Cursor.MOVE)


def find_kept(context: ToolContext) -> KeptPlace | None:
    """Return the text or picture that a press at the pointer is about; None for none.

    Curves come first, but for what they fill where it lies behind; keys mean rubber bands and curves.
    """
    pointer, hit, document = context.pointer, context.hit, context.host.document
    if pointer.shift or pointer.alt or not pointer.is_there or (hit is not None and not hit.inside):
        return None
    for kept in context.surface.kept_at(pointer):
        place = place_of(document, kept)
        if place is not None and not (hit is not None and kept.behind) and not is_locked(document, place):
            return place
    return None


def words_about_locked(context: ToolContext) -> str:
    """Return what is said of a text or picture at the pointer that stays where it is; empty for none."""
    document = context.host.document
    for kept in context.surface.kept_at(context.pointer) if context.pointer.is_there else ():
        place = place_of(document, kept)
        if place is not None and is_locked(document, place):
            return f"{words_of(document, place)} of the file is locked: it stays where it is"
    return ""
