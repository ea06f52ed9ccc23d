"""Presses on curves that are not edited: to move them whole, to choose several, to edit one."""

from __future__ import annotations

from ..document.several_curves import named
from . import hints
from .drag_machine import EditingHost
from .drags import Refuse
from .pointer import Cursor, Hint, Hit, Part
from .tool import ToolContext


class CurvePicker:
    """Choice among curves: a drag moves the one that is pressed, or all that are chosen if it is one of them.

    A click edits it; while no curve is edited it is chosen, and a double click edits it.
    """

    def press(self, context: ToolContext, hit: Hit) -> None:
        """Begin to drag the curve hit, whole, with those that are chosen together with it; or a click."""
        host, target, pointer = context.host, context.target, context.pointer
        group = target.with_curve(hit.index)
        if refusal := target.refusal_of(group):
            context.drags.press(pointer, Refuse(host.document, refusal), lambda: _click(context, hit))
        else:
            context.drags.press(pointer, target.moving(group, pointer), lambda: _click(context, hit))

    def unpick(self, context: ToolContext) -> None:
        """Choose the active curve alone; while none is edited, none at all."""
        host = context.host
        had_others = len(host.selected.chosen) > 1
        if not host.selected.is_editing:
            host.selected.choose(())
        elif had_others:
            host.selected.set_curves((host.active_index,))
            host.say(f"Only “{host.active_view.source.name}” is chosen.")

    def hint(self, context: ToolContext, hit: Hit) -> Hint:
        """Return what a press on another curve would do."""
        host, target = context.host, context.target
        group, is_chosen = target.with_curve(hit.index), hit.index in host.selected.chosen
        if refusal := target.refusal_of(group):
            name, verb = host.document.curves[hit.index].name, _verb(host)
            locked = Hint(f"Click to {verb} “{name}” (locked) · Shift+click: choose it too", grab=True)
            return Hint(refusal) if is_chosen else locked
        drag = hints.to_move(group.quoted, context.pointer, snaps=context.settings.snapping.on)
        return Hint(f"{drag} · {_words_of_click(context, hit, is_chosen=is_chosen)}", cursor=Cursor.MOVE)

    def idle_hint(self, context: ToolContext) -> Hint | None:
        """Return the hint beside everything while the transforms act on whole curves, or none is edited."""
        host, group = context.host, context.target.group
        if group is not None and group.is_whole:
            after = "only the one edited" if host.selected.is_editing else "none"
            return Hint(f"{chosen_curves(host)} · G moves, S scales, R turns them · Click here: {after}")
        if host.selected.is_editing:
            return None
        return Hint(
            "Drag to choose curves inside, Alt: those touched too · Shift adds · Double-click edits one"
        )


def _verb(host: EditingHost) -> str:
    return "edit" if host.selected.is_editing else "choose"


def _words_of_click(context: ToolContext, hit: Hit, *, is_chosen: bool) -> str:
    """Return what a click on a curve does, and what Shift would change of drag and click."""
    host = context.host
    name, is_editing = host.document.curves[hit.index].name, host.selected.is_editing
    if context.pointer.shift:
        return "click to take it out" if is_chosen else "click to choose it too"
    if is_chosen:
        click = f"Click to edit “{name}” alone" if is_editing else f"Double-click to edit “{name}”"
        return f"Shift: one axis, a click takes it out · {click}"
    later = "" if is_editing else ", double-click to edit it"
    return f"click to {_verb(host)} it{later} · Shift+click: choose it too"


def _click(context: ToolContext, hit: Hit) -> None:
    """Edit the curve hit, or choose it; with Shift choose it too, or no longer."""
    host, chosen = context.host, context.host.selected.chosen
    if context.pointer.shift and host.selected.is_editing:
        host.selected.set_curves(host.selected.curves ^ {hit.index})
    elif context.pointer.shift:
        host.selected.choose(chosen ^ {hit.index})
    elif host.selected.is_editing or context.pointer.is_double:
        edit_curve(context, hit.index)
        return
    else:
        host.selected.choose((hit.index,))
    host.say(f"{chosen_curves(host)}.")


def edit_curve(context: ToolContext, curve: int) -> None:
    """Edit a curve from now on, and select the point of it that lies under the pointer."""
    host = context.host
    host.selected.activate(curve)
    hit = context.with_hit().hit
    if hit is not None and hit.part is Part.POINT:
        host.selected.set_points([hit.index])
    host.say(f"Editing “{host.active_view.source.name}” now.")


def chosen_curves(host: EditingHost) -> str:
    """Return a sentence about the curves that the tools act on."""
    chosen, active = host.selected.chosen, host.active_view.source.name
    if not host.selected.is_editing:
        if len(chosen) == 1:
            return f"“{active}” is chosen"
        return f"{named(host.document, chosen)} chosen" if chosen else "No curve is chosen"
    if not chosen:
        return f"Only “{active}” is chosen"
    return f"{named(host.document, chosen)} chosen, “{active}” is edited"
