"""The drags of the pen: a point appended, inserted, or the first of another curve."""

from __future__ import annotations

from enum import Enum, auto
from functools import cached_property

import msgspec
from msgspec.structs import replace

from ..document import point_edits, words
from ..document.constraints import tied_to_straight_segment
from ..document.curve_edits import replace_curve
from ..document.model import Document, Vector
from ..view_model.append import Appending, with_point_appended
from ..view_model.curve.curve_view import CurveView, view_of
from ..view_model.curve.handles import derivative_from_handle
from ..view_model.reshape import Reshaped, with_point_inserted
from .drag import CurveDrag, plus
from .drags import in_steps
from .pointer import SNAP_KEY, STEP_KEYS, Hit, Part, Pointer
from .snapping import Snapper


class PenAct(Enum):
    """Act of the pen where there is no point and no handle."""

    APPEND = auto()
    INSERT = auto()
    BEGIN = auto()


def pen_act(hit: Hit | None, view: CurveView, *, shift: bool, finished: bool = False) -> PenAct:
    """Return what a press does: on the curve insert, beside it append; with Shift append everywhere.

    A closed curve has no end to go on from, and that of a finished one is left alone: beside them another
    curve begins.
    """
    if shift:
        return PenAct.APPEND
    if hit is not None and hit.part is Part.CURVE:
        return PenAct.INSERT
    return PenAct.BEGIN if view.source.is_closed or finished else PenAct.APPEND


def place_in_steps(view: CurveView, pointer: Pointer) -> Vector | None:
    """Return where Ctrl puts the next point: at a step of 15°, seen from the one before."""
    points = view.source.points
    if not (pointer.ctrl and points and pointer.is_there) or view.source.is_closed:
        return None
    before = points[-1].position
    return plus(before, in_steps(pointer.offset_from(before)))


def _is_away(pointer: Pointer, press: Pointer) -> bool:
    """Whether the pointer is no longer where it was pressed."""
    (x, y), (at_x, at_y) = pointer.pixel, press.pixel
    return max(abs(x - at_x), abs(y - at_y)) >= 3


class AppendPoint(CurveDrag, frozen=True):
    """New last point at the press; dragging sets its velocity, or moves it where there is none.

    With Alt the handle behind the point stays where it was, and only the one ahead of it follows.

    Attributes
    ----------
    append
        What a press there makes that does not become a drag.
    """

    press: Pointer
    snapper: Snapper
    append: Appending = with_point_appended
    # The velocity when Alt was not held.
    _whole: list[Vector] = msgspec.field(default_factory=list)

    @property
    def name(self) -> str:
        """The name of the step."""
        return f"Add point {len(self.view.source.points)}"

    @property
    def keys(self) -> str:
        """Effects of the modifier keys while it is dragged."""
        # Where the point lies was decided at the press; only a velocity is still being set.
        if not self.view.source.family.derivatives:
            return SNAP_KEY
        return f"{STEP_KEYS} · Alt: the handle ahead alone"

    def readout(self, pointer: Pointer) -> str:
        """Return where it goes, and where its velocity points."""
        place = self._place(pointer)
        note = f"{self.name} at {words.pair_text(place)}"
        if not self._sets_velocity(pointer):
            return note
        way = self._displacement(pointer, place)
        note = f"{note}, velocity at {words.direction(way)}"
        if pointer.alt:
            return f"{note} · a corner"
        if self.view.source.is_closed:
            return note
        # What will hold when the next point comes.
        is_first = not self.view.source.points
        return f"{note} · {'the handle stays here' if is_first else 'handles stay at most this long'}"

    def _is_dragged(self, pointer: Pointer) -> bool:
        return _is_away(pointer, self.press)

    def _sets_velocity(self, pointer: Pointer) -> bool:
        return self._is_dragged(pointer) and self.view.source.family.derivatives > 0

    def _place(self, pointer: Pointer) -> Vector:
        moves = self._is_dragged(pointer) and not self._sets_velocity(pointer)
        at = pointer if moves else self.press
        stepped = place_in_steps(self.view, at)
        if stepped is None:
            return self.snapper.at(at)
        self.snapper.reset()
        return stepped

    @staticmethod
    def _displacement(pointer: Pointer, place: Vector) -> Vector:
        """Return how far the handle is drawn out, and where to: with Ctrl or Shift in steps."""
        way = pointer.offset_from(place)
        return in_steps(way) if pointer.holds_line else way

    def document_at(self, pointer: Pointer) -> Document:
        """Return the document with the new point."""
        place, index = self._place(pointer), len(self.view.source.points)
        document = self.append(self.document, self.curve, self.view, place)
        return self._with_handles(document, index, pointer) if self._sets_velocity(pointer) else document

    def _with_handles(self, document: Document, index: int, pointer: Pointer) -> Document:
        """Return the document with the handle of the new point drawn out."""
        view, place = view_of(document.curves[self.curve]), self._place(pointer)
        tip = plus(place, self._displacement(pointer, place))
        velocity = derivative_from_handle(view, index, 1, tip, ahead=True)
        if pointer.alt:
            return self._with_handle_ahead(document, index, velocity)
        self._whole[:] = [velocity]
        return point_edits.set_velocity(document, self.curve, index, velocity)

    def _with_handle_ahead(self, document: Document, index: int, velocity: Vector) -> Document:
        """Return the document with another velocity ahead of the new point alone."""
        before = self._whole[0] if self._whole else document.curves[self.curve].points[index].velocity
        document = point_edits.make_corner(document, self.curve, index, before, velocity)
        curve = document.curves[self.curve]
        points = (*curve.points[:index], tied_to_straight_segment(curve, index))
        return document.with_curve(self.curve, replace(curve, points=points))


class BeginCurve(AppendPoint, frozen=True):
    """First point of another curve at the press; the document has the empty curve already."""

    @property
    def name(self) -> str:
        """The name of the step."""
        return f"Begin {self.view.source.name}"


class InsertPoint(CurveDrag, frozen=True, dict=True):
    """New point on the curve where it was pressed, the shape kept if possible; dragging moves it."""

    hit: Hit
    press: Pointer
    snapper: Snapper

    @property
    def name(self) -> str:
        """The name of the step."""
        return f"Insert point {self.hit.index}"

    keys = SNAP_KEY

    def readout(self, pointer: Pointer) -> str:
        """Return where it goes."""
        if self._is_on_curve(pointer):
            return f"{self.name} at t = {words.number(self.hit.t)}"
        return f"{self.name} at {words.pair_text(self.snapper.at(pointer))}"

    def _is_on_curve(self, pointer: Pointer) -> bool:
        return not _is_away(pointer, self.press)

    @cached_property
    def on_curve(self) -> Reshaped:
        """The curve with the point where it was pressed."""
        return with_point_inserted(self.view, self.hit.t)

    def document_at(self, pointer: Pointer) -> Document:
        """Return the document with the new point; dragged away it takes its handles along."""
        document = replace_curve(self.document, self.curve, self.on_curve.curve)
        if self._is_on_curve(pointer):
            return document
        place = self.snapper.at(pointer)
        if not self.view.source.family.interpolates:
            # The control point is not where the curve was pressed: it goes the same way.
            way = (place[0] - self.hit.position[0], place[1] - self.hit.position[1])
            place = plus(self.on_curve.curve.points[self.hit.index].position, way)
        return point_edits.set_position(document, self.curve, self.hit.index, place)
