"""Tools that draw forms: the handles of those that are chosen are dragged with each of them."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import ClassVar, NamedTuple, Self

import msgspec
from msgspec.structs import replace

from ..document import words
from ..document.form import Form, FormHandle
from ..document.form_edits import drawn_place, with_form_drawn
from ..document.forms import AnyForm
from ..document.model import Document, Vector
from ..document.several_curves import named, whole_curves
from ..document.style import Style
from ..view_model.shapes.formed import Formed, formed, with_form
from .drag import Drag
from .marks import FormMark, GestureMarks, Note
from .pointer import Cursor, Hint, Pointer
from .snapping import Snapper
from .tool import GestureRow, Tool, ToolContext
from .typed_amount import TypedAmount

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


class Begun(msgspec.Struct, frozen=True):
    """What there was at the press that begins to draw a form.

    Attributes
    ----------
    active, layer
        The curve that was edited, and the layer to draw in.
    start
        Where it was.
    unit
        The name of the unit of length.
    style
        Of what is drawn.
    """

    active: int
    layer: str
    start: Vector
    snapper: Snapper
    unit: str
    style: Style


class DrawForm(Drag, frozen=True):
    """A drag that draws a form; its numbers can be typed meanwhile.

    Attributes
    ----------
    typed
        The numbers as typed so far.
    typed_keys
        What can be typed: keys of `TypedAmount`, and "tab".
    """

    begun: Begun
    typed: TypedAmount = TypedAmount()

    typed_keys: ClassVar[frozenset[str]] = frozenset("0123456789.") | {"backspace", "tab"}

    @property
    def modifiers(self) -> str:
        """Effects of the modifier keys."""
        raise NotImplementedError

    @property
    def sides(self) -> Sequence[str]:
        """The numbers that can be typed, in words."""
        raise NotImplementedError

    def form_at(self, pointer: Pointer) -> AnyForm:
        """Return the form as drawn to the pointer; raise EditError where it is none yet."""
        raise NotImplementedError

    @property
    def keys(self) -> str:
        """Effects of the modifier keys, and what else can be typed."""
        sides, at = self.sides, self.typed.at
        return f"{self.modifiers} · digits: {sides[at]}, Tab: {sides[(at + 1) % len(sides)]}"

    def with_key(self, key: str) -> Self | None:
        """Return the drag after a key that types; None for any other key."""
        if key not in self.typed_keys:
            return None
        typed = self.typed.after_tab(None, len(self.sides)) if key == "tab" else self.typed.after(key)
        return None if typed is None else replace(self, typed=typed)

    def document_at(self, pointer: Pointer) -> Document:
        """Return the document with the form."""
        begun = self.begun
        return with_form_drawn(self.document, begun.active, self.form_at(pointer), begun.style, begun.layer)


class FormTool(Tool):
    """Tool that draws a form; the handles of chosen forms can be dragged, and a click chooses another one.

    A further one has its own `DrawForm`, which `drag` makes, and these words.

    Attributes
    ----------
    how
        What draws one.
    modifiers
        Effects of the modifier keys.
    too_late
        What to do about a digit that is typed after the drag.
    """

    how: str
    modifiers: str
    too_late: str

    def __init__(self) -> None:
        self._drag: DrawForm | None = None

    def drag(self, context: ToolContext, begun: Begun) -> DrawForm:
        """Return the drag that draws a form."""
        raise NotImplementedError

    # Drawing

    def begin(self, context: ToolContext) -> None:
        """Begin to draw; a release before a drag is `click`."""
        host, snapper = context.host, context.snappers.for_new(-1)
        active, layer, start = host.active_index, host.selected.layer, snapper.at(context.pointer)
        begun = Begun(active, layer, start, snapper, context.settings.unit, host.model.style)
        self._drag = self.drag(context, begun)
        place = drawn_place(host.document, active, layer)
        context.drags.press(context.pointer, self._drag, lambda: self.click(context), active=place)

    def end(self) -> None:
        """Drop the drag."""
        super().end()
        self._drag = None

    def claims(self, context: ToolContext, key: str) -> bool:
        """Whether a key is for its numbers: a digit also after the drag, when it would be a shortcut."""
        drag = self._drag
        return key.isdigit() or (drag is not None and (key == "enter" or key in drag.typed_keys))

    def key(self, context: ToolContext, key: str) -> bool:
        """Take what is typed of its numbers while it is dragged; "enter" ends that."""
        if self._drag is None:
            if key.isdigit():
                otherwise = "The toolbar changes the family, or V and then the digit."
                context.host.refuse(f"{self.too_late} (Ctrl+Shift+M). {otherwise}")
            return key.isdigit()
        if key == "enter":
            context.drags.release(context.pointer)
            return True
        changed = self._drag.with_key(key)
        if changed is not None:
            self._drag = changed
            context.drags.exchange(context.pointer, changed)
        return changed is not None

    def hint(self) -> Hint:
        """Return what a press beside all handles would do."""
        return Hint(f"{self.how} · {self.modifiers} · V goes back to Select")

    # Events

    def press(self, context: ToolContext) -> None:
        """Begin to drag a handle, or to draw."""
        if not press_on_handle(context):
            self.begin(context)

    def click(self, context: ToolContext) -> None:
        """Edit the form under the pointer, or tell how one is drawn."""
        host = context.host
        for curve in context.surface.curves_at(context.pointer):
            if (now := formed(host.document.curves[curve])) is not None and now.handles:
                host.selected.activate(curve)
                host.say(f"Editing “{host.document.curves[curve].seen_name}” now.")
                return
        host.say(f"{self.how}.")

    def hover(self, context: ToolContext) -> Hint:
        """Return what a press here would do."""
        if (hint := handle_hint(context)) is not None:
            return hint
        context.preview_snap(-1)
        return self.hint()

    def marks(self, context: ToolContext) -> GestureMarks:
        """Return the handles of chosen forms, what is snapped to, and the numbers of what is drawn."""
        forms, marks, drag, pointer = (
            handle_marks(context), super().marks(context), self._drag, context.pointer
        )  # fmt: skip
        note = None
        if drag is not None and context.drags.progress_at(pointer):
            note = Note(pointer.position, drag.readout(pointer), drag.begun.start)
        return replace(marks, forms=forms, note=note or marks.note)


# Handles of those that are chosen, for any tool


def press_on_handle(context: ToolContext, kind: type[Form] = Form) -> bool:
    """Begin to drag the handle of a form of a kind that is under the pointer; return whether there is one."""
    held, host = _held_at(context, kind), context.host
    if held is None:
        return False
    snapper = context.snappers.for_group(whole_curves(host.document, [held.curve]))
    drag = DragFormHandle(host.document, *held, snapper, context.settings.unit)
    context.drags.press(context.pointer, drag, lambda: host.say(f"{_hint_of(context, held)}."))
    return True


def handle_hint(context: ToolContext, kind: type[Form] = Form) -> Hint | None:
    """Return what a press on the handle under the pointer would do; None where there is none."""
    held = _held_at(context, kind)
    return None if held is None else Hint(_hint_of(context, held), cursor=Cursor.MOVE)


def handle_marks(context: ToolContext, kind: type[Form] = Form) -> tuple[FormMark, ...]:
    """Return the marks of all handles."""
    return tuple(
        FormMark(place, is_round=handle.is_round)
        for _, now in _chosen_forms(context, kind)
        for handle, place in now.handles
    )


def _hint_of(context: ToolContext, held: _Held) -> str:
    name = context.host.document.curves[held.curve].name
    return " · ".join(filter(None, (f"Drag to change the {held.handle.words} of “{name}”", held.handle.keys)))


def _chosen_forms(context: ToolContext, kind: type[Form]) -> Iterator[tuple[int, Formed]]:
    """Yield the forms that are chosen, or edited, and can be changed."""
    host = context.host
    places = host.selected.chosen | (host.selected.edited if host.selected.is_editing else frozenset())
    for place in sorted(places) if len(places) <= _MOST else ():
        curve = host.document.curves[place]
        if curve.is_free and isinstance(curve.form, kind) and (now := formed(curve)) is not None:
            yield place, now


def _held_at(context: ToolContext, kind: type[Form]) -> _Held | None:
    """Return the handle under the pointer, the nearest one."""
    pointer = context.pointer
    near = [
        (math.dist(place, pointer.position), _Held(curve, now, handle))
        for curve, now in _chosen_forms(context, kind)
        for handle, place in now.handles
    ]
    distance, held = min(near, key=lambda each: each[0], default=(math.inf, None))
    return held if distance * pointer.scale <= _REACH else None
