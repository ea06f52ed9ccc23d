"""Rectangles and ellipses: the edit that draws one in a box, and the tools that do it by a drag."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import partial
from itertools import pairwise

import msgspec
from msgspec.structs import replace

from ...document import words
from ...document.constraints import has_parallel_velocities, tie
from ...document.curve_edits import (
    add_curve,
    has_default_name,
    new_curve_like,
    replace_curve,
    unused_name,
    without_curve,
)
from ...document.limits import EditError, checked_vector
from ...document.model import Document, Parametrization, ParametrizationKind, Point, Vector
from ...document.point_group import NO_POINTS
from ...document.selection import SelectionState
from ...document.style import Style
from ...document.words import decimal_sum
from ...families import HERMITE
from ..marks import Marks, Note
from ..pointer import Hint, Pointer
from ..snapping import Snapper
from ..tool import GestureRow, Tool, ToolEvent, ToolRecord, TypedDrag
from ..typed_amount import TypedAmount

Piece = tuple[Vector, Vector, Vector, Vector]
"""Control points of a cubic piece."""

_QUARTER = 4 / 3 * (math.sqrt(2) - 1)
"""Length of the handles of a quarter circle, divided by its radius."""

_SMOOTH = 1e-12
"""Relative difference up to which two velocities at a point differ by rounding errors alone."""


def rectangle_in(low: Vector, high: Vector) -> Sequence[Piece]:
    """Return the sides of a box from its upper left corner on, clockwise, as in SVG."""
    (left, bottom), (right, top) = low, high
    corners = ((left, top), (right, top), (right, bottom), (left, bottom), (left, top))
    return [
        (start, _between(start, end, 1 / 3), _between(end, start, 1 / 3), end)
        for start, end in pairwise(corners)
    ]


def ellipse_in(low: Vector, high: Vector) -> Sequence[Piece]:
    """Return the quarters of the ellipse in a box from its right on, clockwise, as in SVG."""
    (left, bottom), (right, top) = low, high
    x, y = (left + right) / 2, (bottom + top) / 2
    points = ((right, y), (x, bottom), (left, y), (x, top), (right, y))
    corners = ((right, bottom), (left, bottom), (left, top), (right, top))
    return [
        (start, _between(start, corner, _QUARTER), _between(end, corner, _QUARTER), end)
        for (start, end), corner in zip(pairwise(points), corners, strict=True)
    ]


def _between(start: Vector, end: Vector, share: float) -> Vector:
    """Return the point at a share of the line from `start` to `end`."""
    return (start[0] + (end[0] - start[0]) * share, start[1] + (end[1] - start[1]) * share)


def drawn_index(document: Document, active: int) -> int:
    """Return the index of a new curve: in front, or that of an empty active curve moved to the front."""
    return len(_rest(document, active).curves)


def draw_closed_curve(
    document: Document, active: int, name: str, pieces: Sequence[Piece], style: Style
) -> Document:
    """Return the document with a closed cubic curve of connected pieces in front.

    It has `style` and the rules of the active curve. If the active curve is empty, it is replaced. The
    parameters are spaced by the chords of the pieces.
    """
    model, rest = document.curves[active], _rest(document, active)
    if rest is not document:
        curve = replace(model, parametrization=Parametrization(), visible=True)
    else:
        curve = new_curve_like(document, replace(model, style=style), Parametrization())
    if has_default_name(curve.name):
        curve = replace(curve, name=unused_name(rest, name))
    rule = curve.parametrization
    if rule.kind is not ParametrizationKind.CHORD_LENGTH:
        rule = Parametrization()
    curve = replace(curve.with_family(HERMITE), closed=True, parametrization=rule)
    index, drawn = len(rest.curves), replace(curve, points=_points(pieces, rule.end - rule.start))
    return replace_curve(add_curve(rest, index, curve), index, drawn)


def _rest(document: Document, active: int) -> Document:
    """Return the document without the active curve if that is empty and unlocked, to be replaced."""
    curve = document.curves[active]
    return document if curve.points or curve.locked else without_curve(document, active)


def _points(pieces: Sequence[Piece], span: float) -> tuple[Point, ...]:
    """Return the points of pieces whose parameters are spaced by the chords over an interval."""
    chords = [math.dist(piece[0], piece[3]) for piece in pieces]
    whole = sum(chords)
    # A handle is p ± h v / 3.
    factors = [3.0 * whole / (chord * span) for chord in chords]
    return tuple(
        _point(piece[0], _velocity(pieces[at - 1][2:], factors[at - 1]), _velocity(piece, factors[at]))
        for at, piece in enumerate(pieces)
    )


def _velocity(ends: Sequence[Vector], factor: float) -> Vector:
    (x, y), (to_x, to_y) = ends[:2]
    return checked_vector((factor * (to_x - x), factor * (to_y - y)), "a velocity")


def _point(position: Vector, before: Vector, after: Vector) -> Point:
    x, y = checked_vector(position, "a point")
    if math.dist(before, after) <= _SMOOTH * math.hypot(*after):
        return Point(x, y, velocity=after)
    corner = Point(x, y, velocity=before, corner=True, velocity_after=after)
    return tie(corner, before, after) if has_parallel_velocities(corner) else corner


_SIDES = ("its width", "its height")
_TOO_LATE = (
    "Type width and height while you drag, or later in the Transform panel. "
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
    regular
        Its name in a square, with the article.
    pieces
        Returns its pieces by the lower left and the upper right corner of the box.
    """

    name: str
    phrase: str
    regular: str
    pieces: Callable[[Vector, Vector], Sequence[Piece]]

    @property
    def hint(self) -> str:
        """Hint of the tool."""
        return f"Drag to draw {self.phrase}"

    @property
    def keys(self) -> str:
        """Effects of the modifier keys."""
        return f"Ctrl: {self.regular} · Shift: about the centre"


class DrawInBox(TypedDrag, kw_only=True):
    """A drag from one corner of the box, or with Shift from its middle, to the opposite corner.

    Attributes
    ----------
    drawn
        The curve that it draws.
    active
        The curve that was edited at the press.
    start
        Where the press was.
    unit
        The name of the unit of length.
    style
        Style of the curve.
    """

    drawn: BoxCurve
    active: int
    start: Vector
    snapper: Snapper
    unit: str
    style: Style

    def click(self, event: ToolEvent) -> None:
        """Say that it takes a drag."""
        event.session.say(f"{self.drawn.hint}.", is_hint=True)

    def document_at(self, pointer: Pointer) -> Document:
        """Return the document with the curve in the box; raise EditError where that has no area."""
        (left, right), (low, high) = (sorted(ends) for ends in zip(*self._box(pointer), strict=True))
        if left == right or low == high:
            raise EditError("Drag to the side and up or down: the box has no area.")
        pieces = self.drawn.pieces((left, low), (right, high))
        name = self.drawn.name.capitalize()
        return draw_closed_curve(self.document, self.active, name, pieces, self.style)

    def undo_text(self, pointer: Pointer) -> str:
        """Return "Draw ellipse"."""
        return f"Draw {self.drawn.name}"

    @property
    def keys(self) -> str:
        """Effects of the modifier keys, and the sides that can be typed."""
        at = self.typed.at
        return f"{self.drawn.keys} · digits: {_SIDES[at]}, Tab: {_SIDES[1 - at]}"

    def amount(self, pointer: Pointer) -> str:
        """Return width × height, with a mark where a digit goes that is typed."""
        sides = [words.number(abs(side)) for side in _offset(*self._box(pointer))]
        return f"{' × '.join(self.typed.texts(sides))} {self.unit}".rstrip()

    def marks(self, event: ToolEvent) -> Marks:
        """Return the snap, and width and height beside the pointer."""
        marks, pointer = super().marks(event), event.pointer
        if not self.has_moved:
            return marks
        return replace(marks, note=Note(pointer.position, self.amount(pointer), self.start))

    def _box(self, pointer: Pointer) -> tuple[Vector, Vector]:
        start, end = self.start, self.snapper.at(pointer)
        offset = _offset(start, end)
        if pointer.ctrl:
            side = max(map(abs, offset))
            offset = (math.copysign(side, offset[0]), math.copysign(side, offset[1]))
            end = _after(start, offset)
        if self.typed.counts:
            offset = self._as_typed(offset, pointer)
            end = _after(start, offset)
        return (_after(start, (-offset[0], -offset[1])) if pointer.shift else start), end

    def _as_typed(self, offset: Vector, pointer: Pointer) -> Vector:
        """Return an offset with the typed width and height, towards the pointer."""
        if self.typed.is_pair:
            width, height = self.typed.pair(math.nan)
        else:
            width = self.typed.number(math.nan)
            height = width if pointer.ctrl else math.nan
        # About the centre, half of the box lies on each side of it.
        share = 0.5 if pointer.shift else 1.0
        across, up = (
            along if math.isnan(side) else math.copysign(share, along) * side
            for along, side in zip(offset, (width, height), strict=True)
        )
        return (across, up)


def _offset(start: Vector, end: Vector) -> Vector:
    # In decimals, so that what begins and ends on lines of a grid of 0.1 measures whole steps of it.
    return (decimal_sum(end[0], -start[0]), decimal_sum(end[1], -start[1]))


def _after(start: Vector, offset: Vector) -> Vector:
    return (decimal_sum(start[0], offset[0]), decimal_sum(start[1], offset[1]))


class BoxCurveTool(Tool):
    """Tool that draws a curve in a box, whose width and height can be typed meanwhile."""

    def __init__(self, drawn: BoxCurve) -> None:
        self._drawn = drawn

    def press(self, event: ToolEvent) -> DrawInBox:
        """Begin to draw."""
        session, snapper, unit = event.session, event.snapping.for_new_point(-1), event.session.document.unit
        active = session.active_index
        drawn = drawn_index(session.document, active)
        return DrawInBox(
            document=session.document,
            selects=SelectionState(drawn, NO_POINTS, frozenset({drawn}), frozenset(), is_editing=True),
            drawn=self._drawn,
            active=active,
            start=snapper.at(event.pointer),
            snapper=snapper,
            unit=unit,
            style=session.template_curve.style,
            typed=TypedAmount(unit=unit),
        )

    def wants_key(self, event: ToolEvent, key: str) -> bool:
        """Return whether a key is a digit: after the drag it would be a shortcut."""
        return key.isdigit()

    def key(self, event: ToolEvent, key: str) -> bool:
        """Say of a digit that it comes too late."""
        if not key.isdigit():
            return super().key(event, key)
        event.session.refuse(_TOO_LATE)
        return True

    def hover(self, event: ToolEvent) -> Hint:
        """Return the hint."""
        event.preview_snap(-1)
        return Hint(f"{self._drawn.hint} · {self._drawn.keys} · V returns to Select")


def _tool(drawn: BoxCurve, *, rank: int, key: str, icon: str, keywords: str) -> ToolRecord:
    """Return the tool that draws a curve in a box."""
    title = drawn.name.title()
    return ToolRecord(
        name=drawn.name,
        make=partial(BoxCurveTool, drawn),
        hint=f"{drawn.hint}; V or Escape returns to Select.",
        empty_message=f"Drag on the canvas to draw {drawn.phrase}.",
        doing=f"drawing {drawn.name}s",
        gestures=(
            GestureRow("Drag", f"draw {drawn.phrase} from corner to corner of its box"),
            GestureRow("Ctrl, Shift", f"{drawn.regular}; about the centre"),
            GestureRow("Digits, Tab while dragging", f"type {words.enumerated(_SIDES)}"),
        ),
        rank=rank,
        action=f"{drawn.name}Tool",
        title=title,
        full_name=f"{title} Tool",
        key=key,
        icon=icon,
        tip=f"Draw {drawn.phrase}: drag from corner to corner; {drawn.keys}",
        in_menu=True,
        keywords=keywords,
    )


RECTANGLE = _tool(
    BoxCurve(
        name="rectangle",
        phrase="a rectangle",
        regular="a square",
        pieces=rectangle_in,
    ),
    rank=26,
    key="B",
    icon="rectangle-horizontal",
    keywords="box square quadrilateral",
)
ELLIPSE = _tool(
    BoxCurve(
        name="ellipse",
        phrase="an ellipse",
        regular="a circle",
        pieces=ellipse_in,
    ),
    rank=27,
    key="O",
    icon="ellipse",
    keywords="circle oval round",
)
