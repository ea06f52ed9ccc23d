"""Presses on points and handles, which mean the same to the tools that select and add points."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from ..document.curve_edits import replace_curve
from ..document.model import Document
from ..document.point_group import points_of
from ..view_model.points.point_kinds import toggled
from ..view_model.points.straight import with_handle_retracted
from . import hints
from .drag import Drag
from .drags import DragHandle, MovePoints, PullVelocity, Refuse
from .pointer import Hit, Part
from .tool import GestureRow, ToolContext

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


def press_on_part(context: ToolContext, hit: Hit, click: Callable[[], None] | None = None) -> None:
    """Begin to drag a point or a handle; a click does `click`, or else selects."""
    if hit.part is not Part.POINT:
        _press_on_handle(context, hit)
        return
    selecting = click_on(context, hit.index)
    if hit.index not in context.host.selected.points:
        # Alone, for a drag with Shift moves this point along an axis; only a click adds it to the others.
        context.host.selected.set_points([hit.index])
    drag = unless_locked(context, _point_drag(context, hit))
    context.drags.press(context.pointer, drag, on_click=click or selecting)


def toggling(context: ToolContext, hit: Hit) -> Callable[[], None] | None:
    """Return what the second click of a double click on a point does; None where it is a click like any."""
    pointer = context.pointer
    is_meant = pointer.is_double and not (pointer.shift or pointer.ctrl or pointer.alt)
    if hit.part is not Part.POINT or not is_meant or not context.view.source.family.derivatives:
        return None
    return partial(_toggle, context, hit.index)


def _toggle(context: ToolContext, index: int) -> None:
    """Make a smooth point of a corner, and a corner of any other."""
    host, view = context.host, context.view
    kind, active = toggled(view, index), host.active_index

    def edit(document: Document) -> Document:
        return replace_curve(document, active, kind.made(view, [index]))

    if host.change(f"{kind.step} point {index}", edit):
        host.say(f"{kind.title} at point {index}; a double click toggles corner and smooth.")


def click_on(context: ToolContext, index: int) -> Callable[[], None]:
    """Return what a click selects: a point alone, or with Shift added to the others or taken away."""
    host, before, one = (
        context.host,
        context.host.selected.group,
        points_of(context.host.active_index, [index]),
    )
    if not context.pointer.shift:
        return lambda: host.selected.set_group(one)

    def toggle() -> None:
        host.selected.set_group(before.toggled(one))
        host.say(f"{hints.selected(host.selected.group)}.")

    return toggle


def unless_locked(context: ToolContext, drag: Drag) -> Drag:
    """Return the drag, or one that is refused because the curve is locked."""
    source = context.view.source
    return Refuse(context.host.document, hints.LOCKED.format(source.seen_name)) if source.locked else drag


def dragged_with(context: ToolContext, hit: Hit) -> str:
    """Return what a drag of the point hit moves, in words: the selected points, if it is one of them."""
    host = context.host
    curve, group = hit.curve if hit.part is Part.OTHER_POINT else host.active_index, host.selected.group
    if hit.index in group.of(curve) and group.count > 1:
        return group.words
    source = host.views[curve].source
    of = f" of “{source.name}”" if curve != host.active_index else ""
    return f"{source.family.point} {hit.index}{of}"


def _press_on_handle(context: ToolContext, hit: Hit) -> None:
    host, pointer = context.host, context.pointer
    snapper = context.snappers.for_handle(hit.index)
    handle = DragHandle(host.document, host.active_index, context.view, hit, pointer.position, snapper)
    # A drag drags the handle; a click means what lies below it, for a click does nothing to a handle.
    click = click_on(context, hit.over) if hit.over >= 0 else None
    if pointer.ctrl and not (pointer.shift or pointer.alt) and hit.kind == 1:
        click = partial(_retract, context, hit)
    context.drags.press(pointer, unless_locked(context, handle), click)


def _retract(context: ToolContext, hit: Hit) -> None:
    """Retract the handle that was clicked into its point."""
    host, view, active = context.host, context.view, context.host.active_index

    def edit(document: Document) -> Document:
        return replace_curve(document, active, with_handle_retracted(view, hit.index, ahead=hit.ahead))

    if host.change(f"Retract handle of point {hit.index}", edit):
        host.say(f"Retracted the handle of point {hit.index}; Alt+drag the point pulls it out again.")


def _point_drag(context: ToolContext, hit: Hit) -> MovePoints | PullVelocity:
    host, pointer = context.host, context.pointer
    if pointer.alt and context.view.source.family.derivatives:
        snapper = context.snappers.for_handle(hit.index)
        return PullVelocity(host.document, host.active_index, context.view, hit.index, snapper)
    group, grip = host.selected.group, (host.active_index, hit.index)
    snapper = context.snappers.for_group(group, grip)
    return MovePoints(host.document, group, pointer.position, snapper, grip)
