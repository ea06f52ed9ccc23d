"""Presses on points and handles, which mean the same to the tools that select and add points."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from ..document.curve_edits import replace_curve
from ..document.model import Document
from ..document.point_group import points_of
from ..view_model.point_kinds import toggled, with_handle_retracted
from . import hints
from .drag import Drag
from .drags import DragHandle, MovePoints, PullVelocity, Refuse
from .pointer import Hit, Part
from .tool import GestureRow, ToolEvent

GESTURES = (
    GestureRow("Drag a point", "move it; Ctrl or Shift keeps to one axis"),
    GestureRow("Alt+drag a point", "pull out its velocity", needs_derivatives=True),
    GestureRow(
        "Drag a handle",
        "set velocity (square), acceleration (diamond), jerk (triangle); Ctrl or Shift: 15°, Alt: break",
        selected=True,
        needs_derivatives=True,
    ),
    GestureRow("Ctrl+click a handle", "retract it into its point", selected=True, needs_derivatives=True),
)
"""Rows of the sheet of keys and mouse."""


def press_on_part(event: ToolEvent, hit: Hit, click: Callable[[], None] | None = None) -> None:
    """Begin to drag a point or a handle; a click does `click`, or else selects."""
    if hit.part is not Part.POINT:
        _press_on_handle(event, hit)
        return
    selecting = click_on(event, hit.index)
    if hit.index not in event.session.selected.points:
        # Alone, for a drag with Shift moves this point along an axis; only a click adds it to the others.
        event.session.selected.set_points([hit.index])
    drag = unless_locked(event, _point_drag(event, hit))
    event.drags.press(event.pointer, drag, on_click=click or selecting)


def toggling(event: ToolEvent, hit: Hit) -> Callable[[], None] | None:
    """Return what the second click of a double click on a point does; None where it is a click like any."""
    pointer = event.pointer
    is_meant = pointer.is_double and not (pointer.shift or pointer.ctrl or pointer.alt)
    if hit.part is not Part.POINT or not is_meant or not event.view.source.family.derivatives:
        return None
    return partial(_toggle, event, hit.index)


def _toggle(event: ToolEvent, index: int) -> None:
    """Make a smooth point of a corner, and a corner of any other."""
    session, view = event.session, event.view
    kind, active = toggled(view, index), session.active_index

    def edit(document: Document) -> Document:
        return replace_curve(document, active, kind.made(view, [index]))

    if session.change(f"{kind.step} point {index}", edit):
        session.say(f"{kind.title} at point {index}; a double click toggles corner and smooth.")


def click_on(event: ToolEvent, index: int) -> Callable[[], None]:
    """Return what a click selects: a point alone, or with Shift added to the others or taken away."""
    session, before, one = (
        event.session,
        event.session.selected.group,
        points_of(event.session.active_index, [index]),
    )
    if not event.pointer.shift:
        return lambda: session.selected.set_group(one)

    def toggle() -> None:
        session.selected.set_group(before.toggled(one))
        session.say(f"{hints.selected(session.selected.group)}.")

    return toggle


def unless_locked(event: ToolEvent, drag: Drag) -> Drag:
    """Return the drag, or one that is refused because the curve is locked."""
    source = event.view.source
    return Refuse(event.session.document, hints.LOCKED.format(source.seen_name)) if source.locked else drag


def dragged_with(event: ToolEvent, hit: Hit) -> str:
    """Return what a drag of the point hit moves, in words: the selected points, if it is one of them."""
    session = event.session
    curve, group = hit.curve if hit.part is Part.OTHER_POINT else session.active_index, session.selected.group
    if hit.index in group.of(curve) and group.count > 1:
        return group.words
    source = session.views[curve].source
    of = f" of “{source.name}”" if curve != session.active_index else ""
    return f"{source.family.point} {hit.index}{of}"


def _press_on_handle(event: ToolEvent, hit: Hit) -> None:
    session, pointer = event.session, event.pointer
    snapper = event.snapping.for_handle(hit.index)
    handle = DragHandle(session.document, session.active_index, event.view, hit, pointer.position, snapper)
    # A drag drags the handle; a click means what lies below it, for a click does nothing to a handle.
    click = click_on(event, hit.over) if hit.over >= 0 else None
    if pointer.ctrl and not (pointer.shift or pointer.alt) and hit.kind == 1:
        click = partial(_retract, event, hit)
    event.drags.press(pointer, unless_locked(event, handle), click)


def _retract(event: ToolEvent, hit: Hit) -> None:
    """Retract the handle that was clicked into its point."""
    session, view, active = event.session, event.view, event.session.active_index

    def edit(document: Document) -> Document:
        return replace_curve(document, active, with_handle_retracted(view, hit.index, ahead=hit.ahead))

    if session.change(f"Retract handle of point {hit.index}", edit):
        session.say(f"Retracted the handle of point {hit.index}; Alt+drag the point pulls it out again.")


def _point_drag(event: ToolEvent, hit: Hit) -> MovePoints | PullVelocity:
    session, pointer = event.session, event.pointer
    if pointer.alt and event.view.source.family.derivatives:
        snapper = event.snapping.for_handle(hit.index)
        return PullVelocity(session.document, session.active_index, event.view, hit.index, snapper)
    group, grip = session.selected.group, (session.active_index, hit.index)
    snapper = event.snapping.for_points(group, grip)
    return MovePoints(session.document, group, pointer.position, snapper, grip)
