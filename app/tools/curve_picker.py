"""Presses on curves that are not edited: to move them whole, to choose several, to edit one."""

from __future__ import annotations

from msgspec.structs import replace

from ..document.group_edits import pressed_curves
from ..document.groups import expand_to_shapes, shape_of
from ..document.point_group import PointGroup, points_of
from ..document.several_curves import common_name, name_or_count, whole_unlocked_curves
from . import hints
from .editing_session import EditingSession
from .pointer import Cursor, Hint, Hit, Part
from .tool import ToolEvent
from .transform_drags import moving


class CurvePicker:
    """Choice among curves: a drag moves what is pressed, or all that is chosen if it is a part of that.

    A click edits a curve; while none is edited it chooses the group or shape that it is in, and a double
    click edits it. With Ctrl a group is passed over.
    """

    def entered(self, event: ToolEvent) -> ToolEvent:
        """Return the event of a press on another curve that is edited: that is the active one from then on.

        A point or handle of any is pressed as one of its own; the line of one, where it is of the same shape.
        """
        session, hit, pointer = event.session, event.hit, event.pointer
        if hit is not None and hit.curve >= 0:
            session.selected.go_to(hit.curve)
            event = event.at(replace(pointer, hit=hit.as_own))
        elif hit is not None and _is_of_edited_shape(event, hit) and not pointer.shift:
            session.selected.activate(hit.index)
            event = event.with_hit()
        else:
            return event
        if not pointer.shift:
            session.say(f"Editing “{session.active_view.source.display_name}” now.")
        return event

    def press(self, event: ToolEvent, hit: Hit) -> None:
        """Begin to drag what is hit, with all that is chosen together with it; or a click.

        While no curve is edited, what is dragged is chosen from then on.
        """
        drag, selected = moving(event, _dragged(event, hit)), event.session.selected
        is_chosen = selected.is_editing or hit.index in selected.chosen
        chooses = frozenset[int]() if is_chosen else _meant(event, hit)
        event.drags.press(event.pointer, drag, lambda: click_curve(event, hit), chooses=chooses)

    def unpick(self, event: ToolEvent) -> None:
        """Choose the active curve alone; while none is edited, none at all."""
        session = event.session
        had_others = len(session.selected.chosen) > 1
        if not session.selected.is_editing:
            session.selected.choose(())
        elif had_others:
            session.selected.set_curves((session.active_index,))
            session.say(f"Only “{session.active_view.source.display_name}” is chosen.")
        if locked := _words_of_locked(event):
            session.refuse(locked)

    def hint(self, event: ToolEvent, hit: Hit) -> Hint:
        """Return what a press on another curve would do."""
        session = event.session
        if _is_of_edited_shape(event, hit) and not event.pointer.shift:
            name = session.document.curves[hit.index].name
            return Hint(f"Drag to bend “{name}” or move a point of it, click to edit it", grab=True)
        group, is_chosen = _dragged(event, hit), hit.index in session.selected.chosen
        if hit.inside and (session.selected.is_editing or event.pointer.shift):
            return Hint(f"{_words_within(event, hit)} · Drag: select with a rubber band", grab=True)
        click = _words_of_click(event, hit, is_chosen=is_chosen)
        drag = hints.to_move(group.quoted_label, event.pointer)
        return Hint(f"{drag} · {click}", cursor=Cursor.MOVE)

    def idle_hint(self, event: ToolEvent) -> Hint | None:
        """Return the hint beside what can be pressed, where there is more to say than of points to select.

        That is on what is locked, and while the transforms act on whole curves, or none is edited.
        """
        session, group = event.session, event.box.group
        if locked := _words_of_locked(event):
            return Hint(locked)
        if group is not None and group.is_whole:
            after = "only the one edited" if session.selected.is_editing else "none"
            return Hint(f"{chosen_curves(session)} · G moves, S scales, R turns · Click here: {after}")
        if session.selected.is_editing:
            return None
        return Hint("Drag to choose curves inside · Shift adds · Double-click edits one")


def _verb(session: EditingSession) -> str:
    return "edit" if session.selected.is_editing else "choose"


def _words_of_click(event: ToolEvent, hit: Hit, *, is_chosen: bool) -> str:
    """Return what a click on a curve does, and what Shift would change of drag and click."""
    session = event.session
    name, is_editing = _name(event, hit), session.selected.is_editing
    if event.pointer.shift:
        return "click to take it out" if is_chosen else "click to choose it too"
    if is_chosen:
        if is_editing:
            return f"Shift: one axis, a click takes it out · Click to edit “{name}” alone"
        grips = "scale" if event.session.box.turns else "rotate and skew"
        click = f"Click: grips that {grips} · " if _turns_grips(event, hit) else ""
        edit = f"Double-click to edit “{name}” · "
        return f"{click}{edit}Shift: one axis, a click takes it out"
    later = "" if is_editing else ", double-click to edit it"
    return f"click to {_verb(session)} it{later} · Shift+click: choose it too"


def _words_within(event: ToolEvent, hit: Hit) -> str:
    """Return what a click in what a curve fills does, where a drag is a rubber band."""
    name = _name(event, hit)
    if not event.pointer.shift:
        return f"Click to edit “{name}” · Shift+click: choose it too"
    is_chosen = hit.index in event.session.selected.chosen
    return f"Click to take “{name}” out" if is_chosen else f"Click to choose “{name}” too"


def _name(event: ToolEvent, hit: Hit) -> str:
    """Return the name of what a click is about: the curve that it edits, or what it chooses."""
    session = event.session
    is_one = session.selected.is_editing and not event.pointer.shift
    return name_or_count(session.document, (hit.index,) if is_one else _meant(event, hit))


def _meant(event: ToolEvent, hit: Hit) -> frozenset[int]:
    """Return the curves that a press on one of them means; with Ctrl its shape, whatever group it is in."""
    session = event.session
    if event.pointer.ctrl:
        return expand_to_shapes(session.document, (hit.index,))
    return pressed_curves(session.document, hit.index, session.selected.choice)


def _dragged(event: ToolEvent, hit: Hit) -> PointGroup:
    document, chosen = event.session.document, event.session.selected.chosen
    meant = chosen if hit.index in chosen else _meant(event, hit)
    return whole_unlocked_curves(document, meant)


def _words_of_locked(event: ToolEvent) -> str:
    """Return why a press on a line does nothing to it: it is locked; empty where none is."""
    document, pointer = event.session.document, event.pointer
    place = event.canvas.locked_at(pointer) if pointer.is_there else -1
    return hints.LOCKED.format(name_or_count(document, shape_of(document, place))) if place >= 0 else ""


def _is_of_edited_shape(event: ToolEvent, hit: Hit) -> bool:
    """Whether the line of another curve of the shape that is edited is hit."""
    session, selected = event.session, event.session.selected
    is_line = hit.part is Part.OTHER_CURVE and not hit.inside and hit.index not in selected.chosen
    return is_line and selected.is_editing and hit.index in shape_of(session.document, session.active_index)


def click_curve(event: ToolEvent, hit: Hit) -> None:
    """Edit the curve hit, or choose what it is in; with Shift choose it too, or no longer."""
    session, selected = event.session, event.session.selected
    if event.pointer.shift and selected.is_editing:
        selected.set_curves(_toggled(selected.curves, _meant(event, hit)))
    elif event.pointer.shift:
        selected.choose(_toggled(selected.chosen, _meant(event, hit)))
    elif selected.is_editing or event.pointer.is_double:
        edit_curve(event, hit.index)
        return
    elif _turns_grips(event, hit):
        session.box.set_turns(not session.box.turns)
        session.say(
            f"{chosen_curves(session)} · The grips {'rotate and skew' if session.box.turns else 'scale'} now."
        )
        return
    else:
        selected.choose(_meant(event, hit))
    session.say(f"{chosen_curves(session)}.")


def _turns_grips(event: ToolEvent, hit: Hit) -> bool:
    """Whether a click has the box take other grips: on what is chosen already, where there is a box."""
    meant, chosen = _meant(event, hit), event.session.selected.chosen
    # With Ctrl a part of what is chosen is wanted alone.
    is_chosen = meant == chosen if event.pointer.ctrl else meant <= chosen
    return is_chosen and event.settings.shows_box and not event.box.refusal_of(event.box.group)


def _toggled(chosen: frozenset[int], curves: frozenset[int]) -> frozenset[int]:
    return chosen - curves if curves <= chosen else chosen | curves


def edit_curve(event: ToolEvent, curve: int) -> None:
    """Edit a curve from now on, and select the point of it that lies under the pointer."""
    event.session.selected.activate(curve)
    select_hit(event)


def select_hit(event: ToolEvent) -> None:
    """Select the point under the pointer of the curves that are edited now, and say which are."""
    session, hit = event.session, event.with_hit().hit
    if hit is not None and hit.part is Part.POINT:
        session.selected.set_group(
            points_of(hit.curve if hit.curve >= 0 else session.active_index, [hit.index])
        )
    several = name_or_count(session.document, session.selected.chosen) if session.selected.chosen else ""
    session.say(
        f"Editing {several} now." if several else f"Editing “{session.active_view.source.display_name}” now."
    )


def chosen_curves(session: EditingSession) -> str:
    """Return a sentence about the curves that the tools act on."""
    chosen, active = session.selected.chosen, session.active_view.source.display_name
    if not session.selected.is_editing:
        if name := common_name(session.document, chosen):
            return f"“{name}” is chosen"
        return f"{name_or_count(session.document, chosen)} chosen" if chosen else "No curve is chosen"
    if not chosen:
        return f"Only “{active}” is chosen"
    return f"{name_or_count(session.document, chosen)} chosen, “{active}” is edited"
