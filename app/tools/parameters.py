"""Parameters of the points: drag ticks along the t-rail, scrub along t; from the press to the undo step."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from ..document import words
from ..document.derivatives import DERIVATIVES
from ..document.model import Curve, Document, ParametrizationKind
from ..document.point_group import points_of
from ..document.rule_edits import freeze_parameters, set_parameters
from ..document.words import decimal_sum
from ..view_model.curve.curve_view import CurveView
from .editing_session import EditingSession
from .nudge import DIRECTIONS
from .pointer import ORIGIN, Cursor, Hint, Hit, Part, Pointer
from .tool import Drag, Gesture, Tool, ToolEvent, ToolRecord

_LEAST_GAP = 1e-3
"""Part of the whole interval that stays between two ticks: visible, and enough for the curve."""

# The scrub line

ParameterAt = Callable[[ToolEvent], float | None]


class Scrub(Gesture, kw_only=True):
    """Drag of the scrub line, from the press on.

    Attributes
    ----------
    before
        Where the scrub line was at the press.
    parameter_at
        Returns the parameter at the pointer, None for none.
    """

    starts_at_press = True
    before: float | None
    parameter_at: ParameterAt

    def move(self, event: ToolEvent) -> None:
        """Scrub to the pointer."""
        t, curve = self.parameter_at(event), event.view.curve
        if curve is not None and t is not None:
            start, end = curve.domain
            event.session.scrub.set(min(max(t, start), end))

    def cancel(self, event: ToolEvent) -> None:
        """Put the scrub line where it was."""
        event.session.scrub.set(self.before)
        super().cancel(event)


class ScrubFromFunction(Scrub, kw_only=True):
    """Press on a function: a click selects its point, only a drag scrubs."""

    starts_at_press = False


class ScrubTool(Tool):
    """Tool that drags the scrub line; the plots over t have no other gesture."""

    cursor = Cursor.ARROW

    def press(self, event: ToolEvent) -> Gesture:
        """Begin to scrub; on a function a click selects its point."""
        hit, before = event.hit, event.session.scrub.t
        if hit is None or hit.part is not Part.FUNCTION:
            return Scrub(before=before, parameter_at=self.parameter_at)
        index = hit.index
        return ScrubFromFunction(
            before=before,
            parameter_at=self.parameter_at,
            on_click=lambda release: release.session.selected.set_points([index]),
        )

    def parameter_at(self, event: ToolEvent) -> float | None:
        """Return the parameter at the pointer, None for none."""
        return event.pointer.position[0]

    def key(self, event: ToolEvent, key: str) -> bool:
        """Take no keys: arrows and Tab are about no point here."""
        return False

    def hover(self, event: ToolEvent) -> Hint:
        """Return the hint."""
        return Hint("Drag, or press ← →, to scrub (Shift: ten times as far) · Wheel zooms along t")


class ScrubAlongTool(ScrubTool):
    """Tool that drags the scrub line along a drawn curve."""

    def parameter_at(self, event: ToolEvent) -> float | None:
        """Return the parameter of the nearest point of the curve."""
        hit = event.with_hit().hit
        return hit.t if hit is not None else None


# Ticks


class RailTool(ScrubTool):
    """Tool that drags ticks along the t-rail, and scrubs elsewhere."""

    def press(self, event: ToolEvent) -> Gesture:
        """Begin to drag the tick here, or else to scrub."""
        hit = event.hit
        return (
            press_on_tick(event, hit) if hit is not None and hit.part is Part.TICK else super().press(event)
        )

    def key(self, event: ToolEvent, key: str) -> bool:
        """Move the selected ticks by a round number with ← and →."""
        session, direction = event.session, DIRECTIONS.get(key, (0.0, 0.0))[0]
        points = session.selected.points
        if not direction or not points or not len(session.active_view.ticks):
            return False
        first = min(points)
        drag = _drag(event.session, -direction * event.key_step(on_grid=False), first, first, NudgeTicks)
        run = ("ticks", session.active_index, points)
        if session.change(drag.undo_text(ORIGIN), lambda _document: drag.document_at(ORIGIN), run=run):
            session.say(drag.amount(ORIGIN))
        return True

    def hover(self, event: ToolEvent) -> Hint:
        """Return the hint."""
        hit = event.hit
        if hit is None or hit.part is Part.SCRUB:
            return Hint("Drag to scrub along t · Escape hides the line")
        hint = self._hint_on(event, hit)
        return Hint(hint.text, hint.grab, hint.cursor, highlighted=hit.index)

    @staticmethod
    def _hint_on(event: ToolEvent, hit: Hit) -> Hint:
        if hit.part is Part.TICK:
            return _tick_hint(hit, event.pointer, event.view, event.session.selected.points)
        if hit.part is Part.DOT:
            return Hint(
                f"The dot of point {hit.index}: its influence is largest near "
                f"t = {event.view.t_text(hit.position[0])} · "
                "Drag to scrub"
            )
        kind = f"{DERIVATIVES[hit.order - 1].name} function" if hit.order else "basis function"
        point = event.view.source.family.point
        return Hint(f"The {kind} of {point} {hit.index} · Click to select the point")


def press_on_tick(event: ToolEvent, hit: Hit) -> Gesture:
    """Start to drag the tick that was hit, with those of all selected points.

    A click selects its point alone; with Shift it is added to the selection, or removed.
    """
    session, pointer = event.session, event.pointer
    selected, before = session.selected, session.selected.group
    point = points_of(session.active_index, [hit.index])
    if hit.index not in selected.points:
        selected.set_group(before.joined(point) if pointer.shift else point)
    drag = _drag(session, pointer.position[0], hit.knot, hit.index)
    drag.on_click = lambda _release: selected.set_group(before.toggled(point) if pointer.shift else point)
    return drag


class DragTicks(Drag, kw_only=True):
    """Drag of parameters along the t-rail, all by the same offset; their order is kept.

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

    def document_at(self, pointer: Pointer) -> Document:
        """Return the document with the ticks moved as far as those that stay let them.

        With E held every tick from the grabbed one on, towards the side the pointer has moved to from the
        press, moves along: the spacings there stay, and only the gap behind opens. Where none of those that
        move does anything to the curve, nothing changes.
        """
        by, moving = self._offset(pointer)
        if moving <= self.idle:
            return self.before
        moved = [self._sum(t, by) if knot in moving else t for knot, t in enumerate(self.parameters)]
        for knot, (before, after) in self._adjusted(moving).items():
            share = (self.parameters[knot] - self.parameters[before]) / (
                self.parameters[after] - self.parameters[before]
            )
            moved[knot] = moved[before] + share * (moved[after] - moved[before])
        return set_parameters(self.document, self.curve, moved)

    def _sum(self, t: float, by: float) -> float:
        return t + by

    def _adjusted(self, moving: frozenset[int]) -> dict[int, tuple[int, int]]:
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

    def _offset(self, pointer: Pointer) -> tuple[float, frozenset[int]]:
        """Return the offset of the ticks, and the knots that move."""
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

    def undo_text(self, pointer: Pointer) -> str:
        """Return "Change t of point 2", "Change t of 3 points"."""
        if len(self.knots) == 1:
            return f"Change t of point {self.point}"
        return f"Change t of {len(self.knots)} points"

    def amount(self, pointer: Pointer) -> str:
        """Return t of the grabbed tick, and the number of ticks that move along."""
        by, moving = self._offset(pointer)
        if moving <= self.idle:
            return _idle_words(self.point)
        step = min((self.parameters[-1] - self.parameters[0]) / 1000.0, 1.0)
        text = f"t of point {self.point} = {words.number(self.parameters[self.grabbed] + by, step=step)}"
        if len(moving) > 1:
            text = f"{text}, {len(moving)} ticks by {words.number(by)}"
        if adjusted := self._adjusted(moving):
            text = f"{text}, {words.count_of(len(adjusted), 'hollow tick')} beside adjusted"
        return f"{text}{_turns_manual(self.before.curves[self.curve])}"


class NudgeTicks(DragTicks, kw_only=True):
    """Move of ticks by a key: the step is added in decimal numbers."""

    def _sum(self, t: float, by: float) -> float:
        return decimal_sum(t, by)


def _drag(
    session: EditingSession, start: float, knot: int, point: int, kind: type[DragTicks] = DragTicks
) -> DragTicks:
    view, active = session.active_view, session.active_index
    parameters = view.ticks.tolist()
    knots = {other for other in session.selected.points if other != point} | {knot}
    curve = view.curve if view.is_current else None
    idle = [] if curve is None else np.flatnonzero(curve.idle_parameters).tolist()
    return kind(
        # Frozen once: in every move of the drag only the points whose ticks move are other values.
        document=freeze_parameters(session.document, active, parameters),
        curve=active,
        parameters=parameters,
        grabbed=knot,
        knots=frozenset(knots),
        idle=frozenset(idle),
        point=point,
        start=start,
        before=session.document,
    )


def _idle_words(point: int) -> str:
    return f"Hollow tick: t of point {point} does not affect the curve; the t of filled ticks does"


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
            text = f"{_idle_words(index)} · E: also move all ticks in that direction"
            return Hint(text, cursor=Cursor.WIDER if pointer.ripple else None)
        what = f"{what}, a knot of the curve" if 0 < index < len(view.points) - 1 else what
    drag = f"Drag to change {what}{_turns_manual(view.source)}"
    keys = "E: also move all ticks in that direction · Shift+click selects more · Double-click types t"
    return Hint(f"{drag} · {keys}", cursor=Cursor.WIDER)


RAIL = ToolRecord(name="rail", make=RailTool, hint="")
SCRUB_ALONG = ToolRecord(name="scrub_along", make=ScrubAlongTool, hint="")
SCRUB = ToolRecord(name="scrub", make=ScrubTool, hint="")
