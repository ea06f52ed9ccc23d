"""The tools over t: ticks of the t-rail, and the scrub line."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np

from ..document import words
from ..document.derivatives import DERIVATIVES
from ..document.model import Curve, Document, ParametrizationKind, Vector
from ..document.point_group import PointGroup, points_of
from ..document.rule_edits import freeze_parameters, set_parameters
from ..document.words import decimal_sum
from ..view_model.curve.curve_view import CurveView
from .drag import Drag
from .editing_session import EditingSession
from .gesture import CANCELLED, THRESHOLD
from .pointer import Cursor, Hint, Hit, Part, Pointer, Stride
from .tool import OldGesture, Tool, ToolEvent, ToolRecord

_LEAST_GAP = 1e-3
"""Part of the whole interval that stays between two ticks: it can be seen, and the curve be computed."""


class Scrubbing(OldGesture):
    """Scrub line that follows the pointer; a click on a function selects its point.

    Parameters
    ----------
    t_at
        Tells the parameter at the pointer, None for none.
    """

    def __init__(self, event: ToolEvent, t_at: Callable[[ToolEvent], float | None]) -> None:
        self._t_at, self._press, self._before = t_at, event.pointer, event.session.scrub.t
        hit = event.hit
        # The point of the function that was pressed: a click means it, only a drag from there scrubs.
        self._point = hit.index if hit is not None and hit.part is Part.FUNCTION else None
        self.move(event)

    def move(self, event: ToolEvent) -> None:
        """Scrub to the pointer."""
        if self._point is not None:
            if math.dist(self._press.pixel, event.pointer.pixel) < THRESHOLD:
                return
            self._point = None
        t, curve = self._t_at(event), event.view.curve
        if curve is not None and t is not None:
            start, end = curve.domain
            event.session.scrub.set(min(max(t, start), end))

    def release(self, event: ToolEvent) -> None:
        """Leave the scrub line here, or select the point of the function that was clicked."""
        self.move(event)
        if self._point is not None:
            event.session.selected.set_points([self._point])

    def cancel(self, event: ToolEvent) -> None:
        """Bring the scrub line back."""
        event.session.scrub.set(self._before)
        if self._point is None:
            event.session.say(CANCELLED)


class ScrubTool(Tool):
    """Tool that moves the scrub line by a drag; the plots over t have no other gesture."""

    cursor = Cursor.ARROW

    def press(self, event: ToolEvent) -> None:
        """Begin to scrub."""
        self.gesture = Scrubbing(event, self.t_at)

    def nudge(self, event: ToolEvent, direction: Vector, stride: Stride) -> bool:
        """Leave arrow keys alone: no point is meant here."""
        return False

    def t_at(self, event: ToolEvent) -> float | None:
        """Return the parameter at the pointer, None for none."""
        return event.pointer.position[0]

    def hover(self, event: ToolEvent) -> Hint:
        """Return what a press here would do."""
        return Hint("Drag, or press ← →, to scrub (Shift: ten times as far) · Wheel zooms along t")


class ScrubAlongTool(ScrubTool):
    """Tool that moves the scrub line to the nearest place of what is drawn."""

    def t_at(self, event: ToolEvent) -> float | None:
        """Return the parameter of what is nearest."""
        hit = event.with_hit().hit
        return hit.t if hit is not None else None


class DragTicks(Drag, frozen=True):
    """Drag of parameters along the t-rail, all by the same way; their order is kept.

    Attributes
    ----------
    parameters
        Those in force at the press, one for each knot.
    grabbed
        The knot whose tick was pressed.
    knots
        The knots that move, the grabbed one among them.
    idle
        The knots whose t does nothing to the curve; they make way for the others.
    point
        The point of the grabbed knot, for the name of the step.
    start
        The t of the pointer at the press.
    before
        The document before its parameters were made manual.
    """

    curve: int
    parameters: Sequence[float]
    grabbed: int
    knots: frozenset[int]
    idle: frozenset[int]
    point: int
    start: float
    before: Document

    keys = "E: all ticks on that side"

    @property
    def name(self) -> str:
        """The name of the step."""
        if len(self.knots) == 1:
            return f"Change t of point {self.point}"
        return f"Change t of {len(self.knots)} points"

    def readout(self, pointer: Pointer) -> str:
        """Return where the grabbed tick is, and how many go along."""
        by, moving = self._displacement(pointer)
        if moving <= self.idle:
            return _idle_words(self.point)
        text = f"t of point {self.point} = {words.number(self.parameters[self.grabbed] + by)}"
        if len(moving) > 1:
            text = f"{text}, {len(moving)} ticks by {words.number(by)}"
        if makes_way := self._making_way(moving):
            text = f"{text}, {words.count_of(len(makes_way), 'hollow tick')} beside making way"
        return f"{text}{_turns_manual(self.before.curves[self.curve])}"

    def document_at(self, pointer: Pointer) -> Document:
        """Move by the whole way from the press, as far as the ticks that stay let it.

        With E held every tick from the grabbed one on, towards the side the pointer has moved to from the
        press, goes along: the spacings there stay, and only the gap behind opens. Where none of those that
        move does anything to the curve, nothing changes.
        """
        by, moving = self._displacement(pointer)
        if moving <= self.idle:
            return self.before
        moved = [self._sum(t, by) if knot in moving else t for knot, t in enumerate(self.parameters)]
        for knot, (before, after) in self._making_way(moving).items():
            share = (self.parameters[knot] - self.parameters[before]) / (
                self.parameters[after] - self.parameters[before]
            )
            moved[knot] = moved[before] + share * (moved[after] - moved[before])
        return set_parameters(self.document, self.curve, moved)

    def _sum(self, t: float, by: float) -> float:
        return t + by

    def _making_way(self, moving: frozenset[int]) -> dict[int, tuple[int, int]]:
        """Return the idle knots that keep their place between two others of which one moves, with those."""
        beside = {
            knot: (self._beside(knot, moving, -1), self._beside(knot, moving, 1))
            for knot in sorted(self.idle - moving)
        }
        return {knot: both for knot, both in beside.items() if both[0] in moving or both[1] in moving}

    def _beside(self, knot: int, moving: frozenset[int], step: int) -> int:
        """Return the next knot on a side that does not make way, or one beyond all."""
        knot += step
        while 0 <= knot < len(self.parameters) and knot in self.idle and knot not in moving:
            knot += step
        return knot

    def _displacement(self, pointer: Pointer) -> tuple[float, frozenset[int]]:
        """Return how far the ticks move, and which."""
        by = pointer.position[0] - self.start
        count = len(self.parameters)
        moving = self.knots
        if pointer.ripple:
            moving = frozenset(range(self.grabbed, count) if by > 0 else range(self.grabbed + 1))
        return self._as_far_as_can_be(by, moving), moving

    def _as_far_as_can_be(self, by: float, moving: frozenset[int]) -> float:
        t = self.parameters
        margin = _LEAST_GAP * (t[-1] - t[0])
        for knot in moving:
            before, after = self._beside(knot, moving, -1), self._beside(knot, moving, 1)
            if before >= 0 and before not in moving:
                gap = t[knot] - t[before]
                by = max(by, min(margin * (knot - before), gap / 2) - gap)
            if after < len(t) and after not in moving:
                gap = t[after] - t[knot]
                by = min(by, gap - min(margin * (after - knot), gap / 2))
        return by


class NudgeTicks(DragTicks, frozen=True):
    """Move of ticks by a key: the step is added in decimal numbers."""

    def _sum(self, t: float, by: float) -> float:
        return decimal_sum(t, by)


class RailTool(ScrubTool):
    """Tool that drags ticks along the t-rail, and scrubs elsewhere."""

    def press(self, event: ToolEvent) -> None:
        """Begin to drag the tick here, or else to scrub."""
        if event.hit is not None and event.hit.part is Part.TICK:
            self._press_on_tick(event, event.hit)
        else:
            super().press(event)

    @staticmethod
    def _press_on_tick(event: ToolEvent, hit: Hit) -> None:
        session, pointer, before = event.session, event.pointer, event.session.selected.group
        one = points_of(session.active_index, [hit.index])
        if hit.index not in session.selected.points:
            session.selected.set_group(before.joined(one) if pointer.shift else one)
        drag = _drag(session, pointer.position[0], hit.knot, hit.index)
        event.drags.press(pointer, drag, on_click=lambda: _click(event, one, before))

    def nudge(self, event: ToolEvent, direction: Vector, stride: Stride) -> bool:
        """Move the selected ticks by a round number; return whether there are any."""
        session = event.session
        if not direction[0] or not session.selected.points or not len(session.active_view.ticks):
            return False
        first = min(session.selected.points)
        drag = _drag(session, -direction[0] * stride.length(), first, first, NudgeTicks)
        event.drags.nudge(drag, ("ticks", session.active_index, session.selected.points))
        return True

    def lit(self, hit: Hit | None) -> int:
        """Return the point of a tick or of a function."""
        return hit.index if hit is not None and hit.part is not Part.SCRUB else -1

    def hover(self, event: ToolEvent) -> Hint:
        """Return what a press here would do."""
        hit = event.hit
        if hit is None or hit.part is Part.SCRUB:
            return Hint("Drag to scrub: each point shows its weight at t · Escape puts the line away")
        if hit.part is Part.TICK:
            return _tick_hint(hit, event.pointer, event.view, event.session.selected.points)
        if hit.part is Part.PLACE:
            return Hint(
                f"The dot of point {hit.index}: near t = {words.number(hit.position[0])} it acts most · "
                "Drag to scrub"
            )
        kind = f"{DERIVATIVES[hit.kind - 1].name} function" if hit.kind else "basis function"
        point = event.view.source.family.point
        return Hint(f"The {kind} of {point} {hit.index} · Click to select the point")


def _click(event: ToolEvent, one: PointGroup, before: PointGroup) -> None:
    """Select the point of a tick alone; with Shift add it, or take it out."""
    event.session.selected.set_group(before.toggled(one) if event.pointer.shift else one)


def _drag(
    session: EditingSession, start: float, knot: int, point: int, kind: type[DragTicks] = DragTicks
) -> DragTicks:
    parameters = session.active_view.ticks.tolist()
    knots = {other for other in session.selected.points if other != point} | {knot}
    # Frozen once: in every step of the drag only the points whose ticks move are other values.
    frozen = freeze_parameters(session.document, session.active_index, parameters)
    view = session.active_view
    curve = view.curve if view.is_current else None
    idle = [] if curve is None else np.flatnonzero(curve.idle_parameters).tolist()
    return kind(
        frozen,
        session.active_index,
        parameters,
        knot,
        frozenset(knots),
        frozenset(idle),
        point,
        start,
        session.document,
    )


def _idle_words(point: int) -> str:
    return f"A hollow tick: t of point {point} does nothing to the curve, those of filled ticks do"


def _turns_manual(curve: Curve) -> str:
    """Return, to follow a sentence, that the rule for the parameters gives way, unless they are manual."""
    kind = curve.parametrization.kind
    return "" if kind is ParametrizationKind.MANUAL else f"; {kind.phrase} turns manual"


def _tick_hint(hit: Hit, pointer: Pointer, view: CurveView, selection: frozenset[int]) -> Hint:
    """Return the hint over a tick; one that does nothing to the curve is none to drag alone."""
    index, family = hit.index, view.source.family
    is_one_of_several = index in selection and len(selection) > 1
    what = f"t of {len(selection)} points" if is_one_of_several else f"t of point {index}"
    if not (family.interpolates or is_one_of_several or view.curve is None):
        if view.is_current and view.curve.idle_parameters[hit.knot]:
            text = f"{_idle_words(index)} · E: all ticks on the side you move to go along"
            return Hint(text, cursor=Cursor.WIDER if pointer.ripple else None)
        what = f"{what}, a knot of the curve" if 0 < index < len(view.points) - 1 else what
    drag = f"Drag to change {what}{_turns_manual(view.source)}"
    keys = "E: all ticks on the side you move to go along · Shift+click selects more · Double-click types t"
    return Hint(f"{drag} · {keys}", cursor=Cursor.WIDER)


RAIL = ToolRecord(name="rail", make=RailTool, hint="")
SCRUB_ALONG = ToolRecord(name="scrub_along", make=ScrubAlongTool, hint="")
SCRUB = ToolRecord(name="scrub", make=ScrubTool, hint="")
