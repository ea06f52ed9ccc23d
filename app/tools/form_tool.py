"""Tools that draw forms: the handles of those that are chosen are dragged with each of them."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

from msgspec.structs import replace

from ..document import words
from ..document.form import FormHandle
from ..document.forms import AnyForm
from ..document.model import Document
from ..document.several_curves import named, whole_curves
from ..view_model.formed import Formed, formed, with_form
from .drag import Drag
from .marks import FormMark, GestureMarks
from .pointer import Cursor, Hint, Pointer
from .snapping import Snapper
from .tool import GestureRow, Tool, ToolContext

_REACH = 8.0
"""Pixels from a handle within which a press means it."""

_MOST = 20
"""Of more forms than so many no handles are shown."""

HANDLE_GESTURES = (
    GestureRow("Drag a handle of it", "change its size, or the radius of its corners, later too"),
    GestureRow("Click a rectangle or ellipse", "edit it, and see its handles"),
)


class _Held(NamedTuple):
    """A handle of a form, and the place of the curve that it is of."""

    curve: int
    now: Formed
    handle: FormHandle


class DragFormHandle(Drag, frozen=True):
    """A drag of a handle of a form."""

    curve: int
    now: Formed
    handle: FormHandle
    snapper: Snapper
    unit: str

    @property
    def name(self) -> str:
        """The name of the step."""
        return f"Change {self.handle.words} of “{named(self.document, (self.curve,))}”"

    @property
    def keys(self) -> str:
        """Effects of the modifier keys."""
        return self.handle.keys

    def document_at(self, pointer: Pointer) -> Document:
        """Return the document with the handle at the pointer."""
        return with_form(self.document, self.curve, self._form(pointer), self.now.by)

    def _form(self, pointer: Pointer) -> AnyForm:
        to = self.now.as_drawn(self.snapper.at(pointer))
        return self.now.form.dragged(self.handle.name, to, ctrl=pointer.ctrl, shift=pointer.shift)

    def readout(self, pointer: Pointer) -> str:
        """Return the numbers that it has now."""
        return numbers_of(self._form(pointer), self.unit)


def numbers_of(form: AnyForm, unit: str) -> str:
    """Return the numbers of a form with their short names, such as "W 20 · H 10 · Rx 2 mm"."""
    shown = [f"{each.label} {words.number(getattr(form, each.name))}" for each in form.fields]
    return f"{' · '.join(shown)} {unit}".rstrip()


class FormTool(Tool):
    """Tool that draws a form; the handles of chosen forms can be dragged, and a click chooses another one."""

    # What it does beside the handles

    def begin(self, context: ToolContext) -> None:
        """Begin to draw; a release before a drag is `click`."""
        raise NotImplementedError

    @property
    def how(self) -> str:
        """What draws one."""
        raise NotImplementedError

    def hint(self, context: ToolContext) -> Hint:
        """Return what a press beside all handles would do."""
        raise NotImplementedError

    # Events

    def press(self, context: ToolContext) -> None:
        """Begin to drag a handle, or to draw."""
        held, host, pointer = _held_at(context), context.host, context.pointer
        if held is None:
            self.begin(context)
            return
        snapper = context.snappers.for_group(whole_curves(host.document, [held.curve]))
        drag = DragFormHandle(host.document, *held, snapper, context.settings.unit)
        context.drags.press(pointer, drag, lambda: host.say(f"{_hint_of(context, held)}."))

    def click(self, context: ToolContext) -> None:
        """Edit the form under the pointer, or tell how one is drawn."""
        host = context.host
        for curve in context.surface.curves_at(context.pointer):
            if formed(host.document.curves[curve]) is not None:
                host.selected.activate(curve)
                host.say(f"Editing “{host.document.curves[curve].name}” now.")
                return
        host.say(f"{self.how}.")

    def hover(self, context: ToolContext) -> Hint:
        """Return what a press here would do."""
        held = _held_at(context)
        if held is not None:
            return Hint(_hint_of(context, held), cursor=Cursor.MOVE)
        context.preview_snap(-1)
        return self.hint(context)

    def marks(self, context: ToolContext) -> GestureMarks:
        """Return the handles of chosen forms, and what is snapped to."""
        forms = tuple(
            FormMark(place, is_round=handle.is_round)
            for _, now in _chosen_forms(context)
            for handle, place in now.handles
        )
        return replace(super().marks(context), forms=forms)


def _hint_of(context: ToolContext, held: _Held) -> str:
    name = context.host.document.curves[held.curve].name
    return " · ".join(filter(None, (f"Drag to change the {held.handle.words} of “{name}”", held.handle.keys)))


def _chosen_forms(context: ToolContext) -> Iterator[tuple[int, Formed]]:
    """Yield the forms that are chosen, or edited, and can be changed."""
    host = context.host
    places = host.selected.chosen | (host.selected.edited if host.selected.is_editing else frozenset())
    for place in sorted(places) if len(places) <= _MOST else ():
        curve = host.document.curves[place]
        if curve.is_free and (now := formed(curve)) is not None:
            yield place, now


def _held_at(context: ToolContext) -> _Held | None:
    """Return the handle under the pointer, the nearest one."""
    pointer = context.pointer
    near = [
        (math.dist(place, pointer.position), _Held(curve, now, handle))
        for curve, now in _chosen_forms(context)
        for handle, place in now.handles
    ]
    distance, held = min(near, key=lambda each: each[0], default=(math.inf, None))
    return held if distance * pointer.scale <= _REACH else None
