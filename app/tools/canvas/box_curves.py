"""The tools that draw a curve in a box, which a drag opens from corner to corner: a rectangle, an ellipse."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import partial

import msgspec
from msgspec.structs import replace

from ...document import words
from ...document.edits import EditError
from ...document.form_edits import drawn_place, with_form_drawn
from ...document.forms import AnyForm, Ellipse, Rectangle
from ...document.model import Document, Vector
from ...document.style import Style
from ...document.transforms import decimal_sum
from ..drag import Drag
from ..form_tool import HANDLE_GESTURES, FormTool
from ..marks import GestureMarks, Note
from ..pointer import Hint, Pointer
from ..snapping import Snapper
from ..tool import GestureRow, ToolContext, ToolRecord
from ..typed_amount import TypedAmount

_TYPED = frozenset("0123456789.-") | {"backspace", "tab", "enter"}
_SIDES = ("its width", "its height", "the radius of its corners")
"""What can be typed; the last only of what has corners."""

_TOO_LATE = (
    "Type width and height while you drag; later they have fields (Ctrl+Shift+M). "
    "The toolbar changes the family, or V and then the digit."
)


class BoxCurve(msgspec.Struct, frozen=True, kw_only=True):
    """A curve that a drag draws: a further one is a record, and the `ToolRecord` that `_tool` makes of it.

    Attributes
    ----------
    name
        Its name, such as "ellipse".
    phrase
        The name with its article.
    plural
        Several of them.
    regular
        What it is in a square, with the article.
    form
        Returns it by its lower left corner, its size, and the radius of its corners.
    has_corners
        Whether they are corners between straight lines, which can be round.
    """

    name: str
    phrase: str
    plural: str
    regular: str
    form: Callable[[Vector, Vector, float], AnyForm]
    has_corners: bool = False

    @property
    def typed(self) -> Sequence[str]:
        """What can be typed while it is dragged."""
        return _SIDES if self.has_corners else _SIDES[:2]

    @property
    def hint(self) -> str:
        """What draws it."""
        return f"Drag to draw {self.phrase}"

    @property
    def keys(self) -> str:
        """Effects of the modifier keys."""
        return f"Ctrl: {self.regular} · Shift: about the centre"


class DrawInBox(Drag, frozen=True):
    """A drag from one corner of the box, or with Shift from its middle, to the opposite corner.

    Attributes
    ----------
    active, layer
        The curve that was edited at the press, and the layer to draw in.
    style
        Of what is drawn.
    typed
        Width and height as typed meanwhile, and the radius of its corners.
    """

    active: int
    drawn: BoxCurve
    start: Vector
    snapper: Snapper
    unit: str
    style: Style
    typed: TypedAmount = TypedAmount()
    layer: str = ""

    @property
    def name(self) -> str:
        """The name of the step."""
        return f"Draw {self.drawn.name}"

    @property
    def keys(self) -> str:
        """Effects of the modifier keys, and what else can be typed."""
        what, at = self.drawn.typed, self.typed.at
        return f"{self.drawn.keys} · digits: {what[at]}, Tab: {what[(at + 1) % len(what)]}"

    def with_key(self, key: str) -> DrawInBox | None:
        """Return the drag after a digit, ".", "-", "backspace" or "tab"; None for any other key."""
        count = len(self.drawn.typed)
        typed = self.typed.after_tab(None, count) if key == "tab" else self.typed.after(key)
        return None if typed is None else replace(self, typed=typed)

    def document_at(self, pointer: Pointer) -> Document:
        """Return the document with the curve."""
        start, end = self._box(pointer)
        (left, right), (low, high) = (sorted(ends) for ends in zip(start, end, strict=True))
        size = _way((left, low), (right, high))
        if not all(size):
            raise EditError("Drag to the side and up or down: the box has no area.")
        form = self.drawn.form((left, low), size, max(self.typed.further, 0.0))
        return with_form_drawn(self.document, self.active, form, self.style, self.layer)

    def readout(self, pointer: Pointer) -> str:
        """Return width × height, with a mark where a digit goes that is typed."""
        sides = [words.number(abs(side)) for side in _way(*self._box(pointer))]
        for at, text in enumerate(self.typed.fields[:2]):
            if text or (self.typed.is_pair and at == self.typed.at):
                sides[at] = f"{words.with_minus(text)}{'|' if at == self.typed.at else ''}"
        size = f"{' × '.join(sides)} {self.unit}".rstrip()
        further = "".join(self.typed.fields[2:])
        if not further and self.typed.at < len(sides):
            return size
        mark = "|" if self.typed.at == len(sides) else ""
        return f"{size} · radius {words.with_minus(further)}{mark} {self.unit}".rstrip()

    def _box(self, pointer: Pointer) -> tuple[Vector, Vector]:
        end = self.snapper.at(pointer)
        way = _way(self.start, end)
        if pointer.ctrl:
            side = max(map(abs, way))
            way = (math.copysign(side, way[0]), math.copysign(side, way[1]))
            end = _after(self.start, way)
        if self.typed.counts:
            way = self._as_typed(way, pointer)
            end = _after(self.start, way)
        return (_after(self.start, (-way[0], -way[1])) if pointer.shift else self.start), end

    def _as_typed(self, way: Vector, pointer: Pointer) -> Vector:
        """Return a way as long across and up as was typed, towards the pointer; what was not typed stays."""
        if self.typed.is_pair:
            width, height = self.typed.pair(math.nan)
        else:
            width = self.typed.number(math.nan)
            height = width if pointer.ctrl else math.nan
        # About the centre, half of the box lies on each side of it.
        share = 0.5 if pointer.shift else 1.0
        across, up = (
            along if math.isnan(side) else math.copysign(share, along) * side
            for along, side in zip(way, (width, height), strict=True)
        )
        return (across, up)


def _way(start: Vector, end: Vector) -> Vector:
    # In decimals, so that what begins and ends on lines of a grid of 0.1 measures whole steps of it.
    return (decimal_sum(end[0], -start[0]), decimal_sum(end[1], -start[1]))


def _after(start: Vector, way: Vector) -> Vector:
    return (decimal_sum(start[0], way[0]), decimal_sum(start[1], way[1]))


class BoxCurveTool(FormTool):
    """Tool that draws a form in a box, and changes forms by their handles."""

    def __init__(self, drawn: BoxCurve) -> None:
        self._drawn = drawn
        self._drag: DrawInBox | None = None

    def begin(self, context: ToolContext) -> None:
        """Begin at a corner of the box."""
        host, snapper = context.host, context.snappers.for_new(-1)
        start, style = snapper.at(context.pointer), host.model.style
        active, unit, layer = host.active_index, context.settings.unit, host.selected.layer
        place = drawn_place(host.document, active, layer)
        self._drag = DrawInBox(host.document, active, self._drawn, start, snapper, unit, style, layer=layer)
        context.drags.press(context.pointer, self._drag, lambda: self.click(context), active=place)

    @property
    def how(self) -> str:
        """What draws one."""
        return self._drawn.hint

    def end(self) -> None:
        """Drop the drag."""
        super().end()
        self._drag = None

    def claims(self, context: ToolContext, key: str) -> bool:
        """Whether a key is for width and height: a digit also after the drag, when it would be a shortcut."""
        return key.isdigit() or (self._drag is not None and key in _TYPED)

    def key(self, context: ToolContext, key: str) -> bool:
        """Take what is typed of width and height while the box is dragged; "enter" ends that."""
        if self._drag is None:
            if key.isdigit():
                context.host.refuse(_TOO_LATE)
            return key.isdigit()
        if key == "enter":
            context.drags.release(context.pointer)
            return True
        changed = self._drag.with_key(key)
        if changed is not None:
            self._drag = changed
            context.drags.exchange(context.pointer, changed)
        return changed is not None

    def marks(self, context: ToolContext) -> GestureMarks:
        """Return width and height beside the pointer."""
        marks, drag, pointer = super().marks(context), self._drag, context.pointer
        if drag is None or not context.drags.progress_at(pointer):
            return marks
        return replace(marks, note=Note(pointer.position, drag.readout(pointer), drag.start))

    def hint(self, context: ToolContext) -> Hint:
        """Return what a press beside all handles would do."""
        return Hint(f"{self._drawn.hint} · {self._drawn.keys} · V goes back to Select")


def _tool(drawn: BoxCurve, *, place: int, key: str, icon: str, keywords: str) -> ToolRecord:
    """Return the tool that draws a curve in a box."""
    title = drawn.name.title()
    return ToolRecord(
        name=drawn.name,
        make=partial(BoxCurveTool, drawn),
        hint=f"{drawn.hint}; V or Escape goes back to selecting.",
        beginning=f"Drag on the canvas to draw {drawn.phrase}.",
        doing=f"drawing {drawn.plural}",
        gestures=(
            GestureRow("Drag", f"draw {drawn.phrase} from corner to corner of its box"),
            GestureRow("Ctrl, Shift", f"{drawn.regular}; about the centre"),
            GestureRow("Digits, Tab while dragging", f"type {words.enumerated(drawn.typed)}"),
            *HANDLE_GESTURES,
        ),
        place=place,
        action=f"{drawn.name}Tool",
        title=title,
        full_name=f"{title} Tool",
        key=key,
        icon=icon,
        tip=f"Draw {drawn.phrase}: drag from corner to corner; {drawn.keys}",
        in_menu=True,
        in_toolbar=False,
        keywords=keywords,
    )


RECTANGLE = _tool(
    BoxCurve(
        name="rectangle",
        phrase="a rectangle",
        plural="rectangles",
        regular="a square",
        form=lambda place, size, radius: Rectangle(*place, *size, radius, radius),
        has_corners=True,
    ),
    place=26,
    key="B",
    icon="rectangle-horizontal",
    keywords="box square quadrilateral",
)
ELLIPSE = _tool(
    BoxCurve(
        name="ellipse",
        phrase="an ellipse",
        plural="ellipses",
        regular="a circle",
        form=lambda place, size, _radius: Ellipse(*place, *size),
    ),
    place=27,
    key="O",
    icon="ellipse",
    keywords="circle oval round",
)
