"""The tool that draws freehand: a drag becomes a curve of few points near the line."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import partial
from time import thread_time

from msgspec.structs import replace

from ...document.curve_edits import NewCurve, locked_message, new_curve_like, replace_curve, with_new_curve
from ...document.fields import Scroll
from ...document.limits import EditError
from ...document.model import Curve, Parametrization, Vector
from ...document.straight_edits import straight_refusal
from ...document.words import NamedEnum, count_of, number, with_decimals
from ...families import FAMILIES
from ...tasks.progress import Report
from ...view_model.fit import SCATTERED, Fitted, fitted
from ...view_model.join import Stretch, redrawn, stretch_along
from ...view_model.settings import ChoiceSetting
from ..background import BackgroundTask
from ..editing_session import EditingSession
from ..marks import Marks
from ..pointer import Hint, Part, Pointer
from ..select_curves import activate_pressed
from ..tool import THRESHOLD, Gesture, GestureRow, Tool, ToolEvent, ToolRecord


class Detail(NamedEnum):
    """The distance of a curve from the line that was drawn.

    Attributes
    ----------
    pixels
        The largest deviation, on the screen.
    """

    def __init__(self, value: str, label: str = "", pixels: float = 0.0) -> None:
        super().__init__(value, label)
        self.pixels = pixels

    FINE = "fine", "Fine (1 px)", 1.0
    MEDIUM = "medium", "Medium (2 px)", 2.0
    SMOOTH = "smooth", "Smooth (5 px)", 5.0
    VERY_SMOOTH = "very_smooth", "Very smooth (10 px)", 10.0


DETAIL = ChoiceSetting(
    "pencilBox",
    "Pencil",
    Detail.MEDIUM,
    tip="Set the largest distance between the curve and the drawn line",
    stored_as="pencil/detail",
)

_CLOSING = 12.0
"""Pixels between beginning and end of a line, up to which it counts as closed."""

_LEAST_ROUND = 5.0
"""Times that length, from which on a line can return."""

_PATIENCE_S = 0.8
"""Seconds of computing before local pieces are used. Smooth lines take a tenth; 50 teeth take a
Bézier curve two."""

_HINT = "Drag to draw freehand; the curve gets few points"


class PencilLine(Gesture, kw_only=True):
    """A line that is being drawn; the document changes only when it ends.

    Attributes
    ----------
    press
        The pointer at the press.
    positions
        The line so far.
    length, farthest
        Pixels that the pointer has travelled, and its largest distance from the press.
    last
        The last pixel.
    refusal
        Why the active curve, on which it begins, has no part to redraw; empty where it has.
    begin, end
        The parameters at which it begins and ends on the active curve; None where it does not.
    """

    starts_at_press = True
    press: Pointer
    positions: list[Vector]
    last: Vector
    refusal: str = ""
    begin: float | None = None
    end: float | None = None
    length: float = 0.0
    farthest: float = 0.0

    @property
    def line(self) -> tuple[Vector, ...]:
        """The line so far; nothing before the pointer has travelled far enough for a drag."""
        return tuple(self.positions) if self.farthest >= THRESHOLD else ()

    def move(self, event: ToolEvent) -> None:
        """Add the position of the pointer."""
        pointer = event.pointer
        self.length += math.dist(pointer.pixel, self.last)
        self.farthest = max(self.farthest, math.dist(pointer.pixel, self.press.pixel))
        self.last = pointer.pixel
        if pointer.position != self.positions[-1]:
            self.positions.append(pointer.position)
            self.end = None if self.begin is None else _parameter_at(event.with_hit())

    def release(self, event: ToolEvent) -> None:
        """Make a curve of the line, beside the window: it takes longer than a moment."""
        session = event.session
        if not self.line:
            session.say(f"{_HINT}.", is_hint=True)
            return
        if (stretch := self._stretch(event)) is not None:
            self._redraw(event, stretch)
            return
        closed = self._returns
        tolerance = event.value(DETAIL).pixels / self.press.scale
        begin = _begun(session)
        model = replace(begin.document.curves[begin.curve_index], closed=closed)
        work = partial(_fitted, model, self.line, tolerance)
        done = partial(_take, session, model, self.press, tolerance, event.canvas.scroll_of_drag())
        event.background.do(BackgroundTask("The pencil's curve", work, done, self.line))

    @property
    def _returns(self) -> bool:
        is_back = math.dist(self.last, self.press.pixel) <= _CLOSING
        return is_back and self.length > _LEAST_ROUND * _CLOSING

    def _stretch(self, event: ToolEvent) -> Stretch | None:
        """Return the part of the active curve that the line replaces, or an end that it extends; or None."""
        if self.begin is None or self._returns or not self.line:
            return None
        return stretch_along(event.view, self.line, self.begin, self.end)

    def _redraw(self, event: ToolEvent, stretch: Stretch) -> None:
        """Put the line in the place of a part of the active curve, beside the window."""
        session, view = event.session, event.view
        tolerance, reach = event.value(DETAIL).pixels / self.press.scale, _CLOSING / self.press.scale
        scroll = event.canvas.scroll_of_drag()

        def work(report: Report) -> Fitted | str:
            try:
                return redrawn(view, stretch, self.line, tolerance=tolerance, reach=reach, report=report)
            except EditError as reason:
                return str(reason)

        def take(result: Fitted | str) -> None:
            if not isinstance(result, str) and view.source != session.active_view.source:
                result = f"“{view.source.name}” has changed meanwhile; draw the line again."
            if isinstance(result, str):
                session.refuse(result)
                return
            curve, active, before = result.curve, session.active_index, session.document.curves
            edit = partial(replace_curve, curve=active, new=curve)
            if session.change(stretch.title, edit, scroll=scroll):
                session.selected.set_points([])
                done = f"{stretch.done}: {_message(result, view.source, self.press, tolerance)}"
                session.report(done, before, [(x, y) for x, y in result.core.points.tolist()])

        event.background.do(BackgroundTask(stretch.title, work, take, self.line))

    def cancel(self, event: ToolEvent) -> None:
        """Say that nothing was drawn."""
        if self.line:
            super().cancel(event)

    def status(self, event: ToolEvent) -> str:
        """Return the detail, and how to close the curve."""
        if not self.line:
            return ""
        detail = event.value(DETAIL).label.lower()
        if (stretch := self._stretch(event)) is not None:
            return f"Release: {stretch.title.lower()} · {detail} · Escape cancels"
        if self.refusal:
            return f"Drawing a new curve, {detail} · {self.refusal}"
        can_close = event.view.source.family.curve_class.can_close
        closed = "back to the beginning: closed · " if can_close else ""
        redraw = "" if self.begin is None else "end on the curve: redraw that part · "
        return f"Drawing, {detail} · {redraw}{closed}Escape cancels"

    def marks(self, event: ToolEvent) -> Marks:
        """Return the line, and the part of the curve that it replaces."""
        stretch = self._stretch(event)
        replaced = () if stretch is None else tuple(map(tuple, stretch.positions(event.view).tolist()))
        return Marks(line=self.line, replaced=replaced)


def _parameter_at(event: ToolEvent) -> float | None:
    """Return the parameter of the active curve under the pointer, None where it has no part to redraw."""
    hit, view = event.hit, event.view
    if hit is None or not _is_on_active_curve(event) or not view.is_current or _refusal(event):
        return None
    return hit.t if hit.part is Part.CURVE else float(view.parameters[hit.index])


def _is_on_active_curve(event: ToolEvent) -> bool:
    hit = event.hit
    is_there = hit is not None and hit.part is not Part.OTHER_CURVE and hit.curve < 0
    return is_there and event.session.selected.is_editing


def _refusal(event: ToolEvent) -> str:
    """Return why the active curve under the pointer has no part to redraw; empty where it has."""
    if not _is_on_active_curve(event):
        return ""
    source = event.view.source
    return locked_message([source.display_name]) if source.locked else straight_refusal(source.family)


def _begun(session: EditingSession) -> NewCurve:
    document = session.document
    return with_new_curve(
        document, session.active_index, new_curve_like(document, session.template_curve, Parametrization())
    )


def _fitted(model: Curve, line: Sequence[Vector], tolerance: float, report: Report) -> Fitted | str:
    """Return the curve near a line; where the family takes long, one of local pieces instead."""
    began = thread_time()

    def hurry(share: float, word: str) -> None:
        if thread_time() - began > _PATIENCE_S and not model.family.curve_class.is_local:
            raise _TooLong
        report(share, word)

    try:
        return fitted(model, line, tolerance=tolerance, report=hurry)
    except _TooLong:
        quick = next(family for family in FAMILIES if family.curve_class.is_local)
        return fitted(model.with_family(quick), line, tolerance=tolerance, report=report)
    except EditError as reason:
        return str(reason)


class _TooLong(Exception):  # noqa: N818 - nothing has gone wrong
    """The family takes longer than a person waits for."""


def _take(
    session: EditingSession,
    model: Curve,
    press: Pointer,
    tolerance: float,
    scroll: Scroll,
    result: Fitted | str,
) -> None:
    """Add the curve of a line to the present document."""
    if isinstance(result, str):
        session.refuse(result)
        return
    try:
        begin = _begun(session)
    except EditError as reason:
        session.refuse(str(reason))
        return
    now = begin.document.curves[begin.curve_index]
    curve = replace(result.curve, name=now.name, style=model.style, shape=now.shape, groups=now.groups)
    if session.change(
        "Draw with the pencil",
        lambda _: replace_curve(begin.document, begin.curve_index, curve),
        active=begin.curve_index,
        scroll=scroll,
    ):
        session.say(_message(result, model, press, tolerance))


def _message(result: Fitted, model: Curve, press: Pointer, tolerance: float) -> str:
    """Return the message: the number of points and the largest deviation."""
    points, family = count_of(len(result.curve.points), "point"), result.curve.family
    pixels = with_decimals(result.deviation * press.scale, 1)
    text = f"{points}; largest deviation {pixels} px ({number(result.deviation, 2)})."
    if family != model.family:
        text += f" It is {family.a_curve}: finding {model.family.a_curve} that close takes too long."
    elif result.is_scattered:
        text += f" {SCATTERED}"
    elif result.deviation > tolerance:
        text += f" No closer {family.title} curve was found; another family may need fewer points."
    return text


class PencilTool(Tool):
    """Tool that draws freehand."""

    hits = frozenset({Part.POINT, Part.CURVE, Part.OTHER_CURVE})

    def press(self, event: ToolEvent) -> PencilLine:
        """Begin a line here, if there is room for a curve."""
        _begun(event.session)
        event = activate_pressed(event)
        pointer = event.pointer
        line = PencilLine(press=pointer, positions=[pointer.position], last=pointer.pixel)
        if not pointer.shift:
            line.begin, line.refusal = _parameter_at(event), _refusal(event)
        return line

    def hover(self, event: ToolEvent) -> Hint:
        """Return the hint."""
        detail, begin = event.value(DETAIL).label.lower(), _parameter_at(event)
        if begin is not None and event.view.curve is not None:
            extends = stretch_along(event.view, (), begin, None) is not None
            what = "Drag to extend the curve, or back" if extends else "Drag from here back"
            return Hint(f"{what} to it to redraw a part · Shift: a new curve · {detail}")
        if refusal := _refusal(event):
            return Hint(f"Drag to draw a new curve freehand · {refusal}")
        return Hint(f"{_HINT} · {detail}; Edit › Tools changes it · V returns to Select")


PENCIL = ToolRecord(
    name="pencil",
    make=PencilTool,
    hint="Drag to draw freehand; V or Escape returns to Select.",
    empty_message="Drag on the canvas to draw freehand; a curve of few points near the line results.",
    doing="drawing freehand",
    gestures=(
        GestureRow("Drag", "draw a line; it becomes a curve of few points"),
        GestureRow("Drag back to the beginning", "draw a closed curve"),
        GestureRow("Drag from the curve to the curve", "redraw that part; Shift: a new curve"),
        GestureRow("Drag from an end of the curve", "extend it; to its other end: close it"),
        GestureRow("Escape", "cancel the line"),
    ),
    rank=25,
    action="pencilTool",
    title="Pencil",
    full_name="Pencil Tool",
    key="D",
    settings=(DETAIL,),
    icon="pencil",
    tip="Draw freehand: a curve of few points near the line",
    in_menu=True,
    in_toolbar=True,
)
