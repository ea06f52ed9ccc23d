"""Presses on curves that are not edited: to move them whole, to choose several, to edit one."""

from __future__ import annotations

from msgspec.structs import replace

from ..document.point_group import PointGroup, points_of
from ..document.several_curves import changed_whole, name_of, named
from ..document.shape_edits import pressed
from ..document.shapes import shape_of, whole_shapes
from . import hints
from .drag_machine import EditingHost
from .pointer import Cursor, Hint, Hit, Part
from .tool import ToolContext
from .transform_drags import moving


class CurvePicker:
    """Choice among curves: a drag moves what is pressed, or all that is chosen if it is a part of that.

    A click edits a curve; while none is edited it chooses the group or shape that it is in, and a double
    click edits it. With Ctrl a group is passed over.
    """

    def entered(self, context: ToolContext) -> ToolContext:
        """Return the context of a press on another curve that is edited: that is the active one from then on.

        A point or handle of any is pressed as one of its own; the line of one, where it is of the same shape.
        """
        host, hit, pointer = context.host, context.hit, context.pointer
        if hit is not None and hit.curve >= 0:
            host.selected.go_to(hit.curve)
            context = context.at(replace(pointer, hit=hit.as_own))
        elif hit is not None and _is_of_edited_shape(context, hit) and not pointer.shift:
            host.selected.activate(hit.index)
            context = context.with_hit()
        else:
            return context
        if not pointer.shift:
            host.say(f"Editing “{host.active_view.source.seen_name}” now.")
        return context

    def press(self, context: ToolContext, hit: Hit) -> None:
        """Begin to drag what is hit, with all that is chosen together with it; or a click.

        While no curve is edited, what is dragged is chosen from then on.
        """
        drag, selected = moving(context, _dragged(context, hit)), context.host.selected
        is_chosen = selected.is_editing or hit.index in selected.chosen
        chooses = frozenset[int]() if is_chosen else _meant(context, hit)
        context.drags.press(context.pointer, drag, lambda: click_curve(context, hit), chooses=chooses)

    def unpick(self, context: ToolContext) -> None:
        """Choose the active curve alone; while none is edited, none at all."""
        host = context.host
        had_others = len(host.selected.chosen) > 1
        if not host.selected.is_editing:
            host.selected.choose(())
        elif had_others:
            host.selected.set_curves((host.active_index,))
            host.say(f"Only “{host.active_view.source.seen_name}” is chosen.")
        if locked := _words_of_locked(context):
            host.refuse(locked)

    def hint(self, context: ToolContext, hit: Hit) -> Hint:
        """Return what a press on another curve would do."""
        host = context.host
        if _is_of_edited_shape(context, hit) and not context.pointer.shift:
            name = host.document.curves[hit.index].name
            return Hint(f"Drag to bend “{name}” or move a point of it, click to edit it", grab=True)
        group, is_chosen = _dragged(context, hit), hit.index in host.selected.chosen
        if hit.inside and (host.selected.is_editing or context.pointer.shift):
            return Hint(f"{_words_within(context, hit)} · Drag: select with a rubber band", grab=True)
        click = _words_of_click(context, hit, is_chosen=is_chosen)
        drag = hints.to_move(group.quoted, context.pointer)
        return Hint(f"{drag} · {click}", cursor=Cursor.MOVE)

    def idle_hint(self, context: ToolContext) -> Hint | None:
        """Return the hint beside what can be pressed, where there is more to say than of points to select.

        That is on what is locked, and while the transforms act on whole curves, or none is edited.
        """
        host, group = context.host, context.target.group
        if locked := _words_of_locked(context):
            return Hint(locked)
        if group is not None and group.is_whole:
            after = "only the one edited" if host.selected.is_editing else "none"
            return Hint(f"{chosen_curves(host)} · G moves, S scales, R turns · Click here: {after}")
        if host.selected.is_editing:
            return None
        return Hint("Drag to choose curves inside · Shift adds · Double-click edits one")


def _verb(host: EditingHost) -> str:
    return "edit" if host.selected.is_editing else "choose"


def _words_of_click(context: ToolContext, hit: Hit, *, is_chosen: bool) -> str:
    """Return what a click on a curve does, and what Shift would change of drag and click."""
    host = context.host
    name, is_editing = _name(context, hit), host.selected.is_editing
    if context.pointer.shift:
        return "click to take it out" if is_chosen else "click to choose it too"
    if is_chosen:
        if is_editing:
            return f"Shift: one axis, a click takes it out · Click to edit “{name}” alone"
        grips = "scale" if context.host.box.turns else "rotate and skew"
        click = f"Click: grips that {grips} · " if _turns_grips(context, hit) else ""
        edit = f"Double-click to edit “{name}” · "
        return f"{click}{edit}Shift: one axis, a click takes it out"
    later = "" if is_editing else ", double-click to edit it"
    return f"click to {_verb(host)} it{later} · Shift+click: choose it too"


def _words_within(context: ToolContext, hit: Hit) -> str:
    """Return what a click in what a curve fills does, where a drag is a rubber band."""
    name = _name(context, hit)
    if not context.pointer.shift:
        return f"Click to edit “{name}” · Shift+click: choose it too"
    is_chosen = hit.index in context.host.selected.chosen
    return f"Click to take “{name}” out" if is_chosen else f"Click to choose “{name}” too"


def _name(context: ToolContext, hit: Hit) -> str:
    """Return the name of what a click is about: the curve that it edits, or what it chooses."""
    host = context.host
    is_one = host.selected.is_editing and not context.pointer.shift
    return named(host.document, (hit.index,) if is_one else _meant(context, hit))


def _meant(context: ToolContext, hit: Hit) -> frozenset[int]:
    """Return the curves that a press on one of them means; with Ctrl its shape, whatever group it is in."""
    host = context.host
    if context.pointer.ctrl:
        return whole_shapes(host.document, (hit.index,))
    return pressed(host.document, hit.index, host.selected.choice)


def _dragged(context: ToolContext, hit: Hit) -> PointGroup:
    document, chosen = context.host.document, context.host.selected.chosen
    meant = chosen if hit.index in chosen else _meant(context, hit)
    return changed_whole(document, meant)


def _words_of_locked(context: ToolContext) -> str:
    """Return why a press on a line does nothing to it: it is locked; empty where none is."""
    document, pointer = context.host.document, context.pointer
    place = context.surface.locked_at(pointer) if pointer.is_there else -1
    return hints.LOCKED.format(named(document, shape_of(document, place))) if place >= 0 else ""


def _is_of_edited_shape(context: ToolContext, hit: Hit) -> bool:
    """Whether the line of another curve of the shape that is edited is hit."""
    host, selected = context.host, context.host.selected
    is_line = hit.part is Part.OTHER_CURVE and not hit.inside and hit.index not in selected.chosen
    return is_line and selected.is_editing and hit.index in shape_of(host.document, host.active_index)


def click_curve(context: ToolContext, hit: Hit) -> None:
    """Edit the curve hit, or choose what it is in; with Shift choose it too, or no longer."""
    host, selected = context.host, context.host.selected
    if context.pointer.shift and selected.is_editing:
        selected.set_curves(_toggled(selected.curves, _meant(context, hit)))
    elif context.pointer.shift:
        selected.choose(_toggled(selected.chosen, _meant(context, hit)))
    elif selected.is_editing or context.pointer.is_double:
        edit_curve(context, hit.index)
        return
    elif _turns_grips(context, hit):
        host.box.set_turns(not host.box.turns)
        host.say(f"{chosen_curves(host)} · The grips {'rotate and skew' if host.box.turns else 'scale'} now.")
        return
    else:
        selected.choose(_meant(context, hit))
    host.say(f"{chosen_curves(host)}.")


def _turns_grips(context: ToolContext, hit: Hit) -> bool:
    """Whether a click has the box take other grips: on what is chosen already, where there is a box."""
    meant, chosen = _meant(context, hit), context.host.selected.chosen
    # With Ctrl a part of what is chosen is wanted alone.
    is_chosen = meant == chosen if context.pointer.ctrl else meant <= chosen
    return is_chosen and context.settings.shows_box and not context.target.refusal_of(context.target.group)


def _toggled(chosen: frozenset[int], curves: frozenset[int]) -> frozenset[int]:
    return chosen - curves if curves <= chosen else chosen | curves


def edit_curve(context: ToolContext, curve: int) -> None:
    """Edit a curve from now on, and select the point of it that lies under the pointer."""
    context.host.selected.activate(curve)
    select_hit(context)


def select_hit(context: ToolContext) -> None:
    """Select the point under the pointer of the curves that are edited now, and say which are."""
    host, hit = context.host, context.with_hit().hit
    if hit is not None and hit.part is Part.POINT:
        host.selected.set_group(points_of(hit.curve if hit.curve >= 0 else host.active_index, [hit.index]))
    several = named(host.document, host.selected.chosen) if host.selected.chosen else ""
    host.say(f"Editing {several} now." if several else f"Editing “{host.active_view.source.seen_name}” now.")


def chosen_curves(host: EditingHost) -> str:
    """Return a sentence about the curves that the tools act on."""
    chosen, active = host.selected.chosen, host.active_view.source.seen_name
    if not host.selected.is_editing:
        if name := name_of(host.document, chosen):
            return f"“{name}” is chosen"
        return f"{named(host.document, chosen)} chosen" if chosen else "No curve is chosen"
    if not chosen:
        return f"Only “{active}” is chosen"
    return f"{named(host.document, chosen)} chosen, “{active}” is edited"
