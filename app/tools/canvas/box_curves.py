"""The tools that draw a curve in a box, which a drag opens from corner to corner: a rectangle, an ellipse."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import partial

import msgspec

from ...document import words
from ...document.edits import EditError
from ...document.forms import AnyForm, Ellipse, Rectangle
from ...document.model import Vector
from ...document.transforms import decimal_sum
from ..form_tool import HANDLE_GESTURES, Begun, DrawForm, FormTool
from ..pointer import Pointer
from ..tool import GestureRow, ToolContext, ToolRecord

_SIDES = ("its width", "its height", "the radius of its corners")
"""What can be typed; the last only of what has corners."""


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


class DrawInBox(DrawForm, frozen=True, kw_only=True):
    """A drag from one corner of the box, or with Shift from its middle, to the opposite corner."""

    drawn: BoxCurve

    typed_keys = DrawForm.typed_keys | {"-"}

    @property
    def name(self) -> str:
        """The name of the step."""
        return f"Draw {self.drawn.name}"

    @property
    def modifiers(self) -> str:
        """Effects of the modifier keys."""
        return self.drawn.keys

    @property
    def sides(self) -> Sequence[str]:
        """Width and height, and the radius of its corners."""
        return self.drawn.typed

    def form_at(self, pointer: Pointer) -> AnyForm:
        """Return the form in the box where that has an area."""
        start, end = self._box(pointer)
        (left, right), (low, high) = (sorted(ends) for ends in zip(start, end, strict=True))
        size = _way((left, low), (right, high))
        if not all(size):
            raise EditError("Drag to the side and up or down: the box has no area.")
        return self.drawn.form((left, low), size, max(self.typed.further, 0.0))

    def readout(self, pointer: Pointer) -> str:
        """Return width × height, with a mark where a digit goes that is typed."""
        sides = [words.number(abs(side)) for side in _way(*self._box(pointer))]
        for at, text in enumerate(self.typed.fields[:2]):
            if text or (self.typed.is_pair and at == self.typed.at):
                sides[at] = f"{words.with_minus(text)}{'|' if at == self.typed.at else ''}"
        size = f"{' × '.join(sides)} {self.begun.unit}".rstrip()
        further = "".join(self.typed.fields[2:])
        if not further and self.typed.at < len(sides):
            return size
        mark = "|" if self.typed.at == len(sides) else ""
        return f"{size} · radius {words.with_minus(further)}{mark} {self.begun.unit}".rstrip()

    def _box(self, pointer: Pointer) -> tuple[Vector, Vector]:
        start, end = self.begun.start, self.begun.snapper.at(pointer)
        way = _way(start, end)
        if pointer.ctrl:
            side = max(map(abs, way))
            way = (math.copysign(side, way[0]), math.copysign(side, way[1]))
            end = _after(start, way)
        if self.typed.counts:
            way = self._as_typed(way, pointer)
            end = _after(start, way)
        return (_after(start, (-way[0], -way[1])) if pointer.shift else start), end

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

    too_late = "Type width and height while you drag; later they have fields"

    def __init__(self, drawn: BoxCurve) -> None:
        super().__init__()
        self._drawn, self.how, self.modifiers = drawn, drawn.hint, drawn.keys

    def drag(self, context: ToolContext, begun: Begun) -> DrawInBox:
        """Return the drag of a box."""
        return DrawInBox(context.host.document, begun, drawn=self._drawn)


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
