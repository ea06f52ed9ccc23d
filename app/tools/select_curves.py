"""Press on curves that are not edited: move them whole, select several, edit one; and the rubber bands.

A drag moves the curve that was pressed, or all selected curves if it is one of them. A click edits a curve;
while none is edited it selects the group or shape of the curve, and a double click edits it. With Ctrl a
group is passed over.
"""

from __future__ import annotations

import numpy as np
from msgspec.structs import replace

from curvecore.arrays import FloatArray

from ..document.curve_edits import locked_message
from ..document.group_edits import pressed_curves
from ..document.groups import expand_to_shapes, shape_of
from ..document.model import Vector
from ..document.point_group import NO_POINTS, PointGroup, group_points, points_of
from ..document.selection import SelectionState
from ..document.several_curves import common_name, name_or_count, whole_unlocked_curves
from ..view_model.curve.curve_view import CurveView
from .drag_points import Click, press_on_group
from .editing_session import EditingSession
from .marks import Marks
from .pointer import Cursor, Hint, Hit, Part, drag_to_move, selection_text
from .tool import Gesture, ToolEvent


def activate_pressed(event: ToolEvent) -> ToolEvent:
    """Make another edited curve that is pressed the active one; return the event with the hit on that curve.

    A point or handle of any edited curve activates it; its line does where it is of the active shape. Other
    events are returned as they are.
    """
    session, hit, pointer = event.session, event.hit, event.pointer
    if hit is not None and hit.curve >= 0:
        session.selected.switch_active(hit.curve)
        event = replace(event, hit=hit.on_active_curve)
    elif hit is not None and _is_of_active_shape(event, hit) and not pointer.shift:
        session.selected.activate(hit.index)
        event = event.with_hit()
    else:
        return event
    if not pointer.shift:
        session.say(f"Editing “{session.active_view.source.display_name}”.")
    return event


def press_on_curve(event: ToolEvent, hit: Hit, on_click: Click | None = None) -> Gesture:
    """Start to move the curve that was hit, with all that is selected together with it.

    While no curve is edited, what is dragged is selected from then on. `on_click` replaces what a click does.
    """
    session, selects = event.session, None
    if not session.selected.is_editing and hit.index not in session.selected.whole_curves:
        curves = _intended(event, hit)
        active = min(curves, key=lambda curve: abs(curve - session.active_index))
        selects = SelectionState(active, NO_POINTS, curves, curves, is_editing=False)
    on_click = on_click or (lambda _click: click_curve(event, hit))
    return press_on_group(event, _moved_group(event, hit), on_click, selects)


def end_of_other_curve(event: ToolEvent) -> Hit | None:
    """Return the end of an open curve beside the edited ones that is hit, which Shift adds to the points.

    None while curves are selected as wholes, with no points.
    """
    selected = event.session.selected
    if not selected.is_editing or (selected.whole_curves and not selected.group.parts):
        return None
    hit = event.canvas.hit(event.pointer, frozenset({Part.OTHER_END})) if event.pointer.is_there else None
    is_end = hit is not None and hit.part is Part.OTHER_END and hit.curve not in selected.active_curves
    return hit if is_end else None


def press_on_end(event: ToolEvent, end: Hit) -> Gesture:
    """Start to move the curve whose end was hit; a click adds the end to the selected points."""
    curve = Hit(Part.OTHER_CURVE, end.curve, end.position)

    def add(_click: ToolEvent) -> None:
        session, selected = event.session, event.session.selected
        group = selected.group.joined(points_of(end.curve, [end.index]))
        # The curve is edited together with the others, and its points can be selected.
        selected.set_curves(selected.curves | {end.curve})
        selected.set_group(group)
        session.say(f"{selection_text(selected.group)}.")

    return press_on_curve(event, curve, add)


def deselect_curves(event: ToolEvent) -> None:
    """Select the active curve alone; while none is edited, none at all."""
    session = event.session
    had_others = len(session.selected.whole_curves) > 1
    if not session.selected.is_editing:
        session.selected.select_whole(())
    elif had_others:
        session.selected.set_curves((session.active_index,))
        session.say(f"Only “{session.active_view.source.display_name}” is selected.")
    if locked := _locked_words(event):
        session.refuse(locked)


# What a press would do


def hint_on_curve(event: ToolEvent, hit: Hit) -> Hint:
    """Return the hint over another curve."""
    session = event.session
    if _is_of_active_shape(event, hit) and not event.pointer.shift:
        name = session.document.curves[hit.index].name
        return Hint(f"Drag to bend “{name}” or move one of its points, click to edit it", grab=True)
    group, is_selected = _moved_group(event, hit), hit.index in session.selected.whole_curves
    if hit.inside and (session.selected.is_editing or event.pointer.shift):
        return Hint(f"{_words_inside(event, hit)} · Drag: select with a rubber band", grab=True)
    click = _click_words(event, hit, is_selected=is_selected)
    drag = drag_to_move(group.quoted_label, event.pointer)
    return Hint(f"{drag} · {click}", cursor=Cursor.MOVE)


def hint_beside_curves(event: ToolEvent) -> Hint | None:
    """Return the hint beside everything, where there is more to say than of points to select.

    That is on what is locked, and while the transforms act on whole curves, or none is edited.
    """
    session, group = event.session, event.box.group
    if locked := _locked_words(event):
        return Hint(locked)
    if group is not None and group.is_whole:
        after = "select only the edited one" if session.selected.is_editing else "deselect"
        return Hint(f"{selected_curves(session)} · G moves, S scales, R rotates · Click here: {after}")
    if session.selected.is_editing:
        return None
    return Hint("Drag to select curves inside · Shift adds · Double-click edits one")


def _verb(session: EditingSession) -> str:
    return "edit" if session.selected.is_editing else "select"


def _click_words(event: ToolEvent, hit: Hit, *, is_selected: bool) -> str:
    """Return the effect of a click on a curve, and of Shift on drag and click."""
    session = event.session
    name, is_editing = _name(event, hit), session.selected.is_editing
    end = "its end " if end_of_other_curve(event) is not None else ""
    if event.pointer.shift and end:
        return f"click to add {end}to the selection"
    if event.pointer.shift:
        return "click to remove it from the selection" if is_selected else "click to add it to the selection"
    if is_selected:
        if is_editing:
            return f"Shift: one axis, a click removes it from the selection · Click to edit “{name}” alone"
        grips = "scale" if event.session.box.turns else "rotate and skew"
        click = f"Click: grips that {grips} · " if _turns_grips(event, hit) else ""
        edit = f"Double-click to edit “{name}” · "
        return f"{click}{edit}Shift: one axis, a click removes it from the selection"
    later = f", double-click to {'insert a point' if is_editing else 'edit it'}"
    return f"click to {_verb(session)} it{later} · Shift+click: add {end or 'it '}to the selection"


def _words_inside(event: ToolEvent, hit: Hit) -> str:
    """Return the effect of a click inside a filled curve, where a drag is a rubber band."""
    name = _name(event, hit)
    if not event.pointer.shift:
        return f"Click to edit “{name}” · Shift+click: add it to the selection"
    is_selected = hit.index in event.session.selected.whole_curves
    change = f"remove “{name}” from" if is_selected else f"add “{name}” to"
    return f"Click to {change} the selection"


def _name(event: ToolEvent, hit: Hit) -> str:
    """Return the name of the curves that a click edits or selects."""
    session = event.session
    is_one = session.selected.is_editing and not event.pointer.shift
    return name_or_count(session.document, (hit.index,) if is_one else _intended(event, hit))


def _intended(event: ToolEvent, hit: Hit) -> frozenset[int]:
    """Return the curves that a press on one of them acts on; with Ctrl its shape without its group."""
    session = event.session
    if event.pointer.ctrl:
        return expand_to_shapes(session.document, (hit.index,))
    return pressed_curves(session.document, hit.index, session.selected.state)


def _moved_group(event: ToolEvent, hit: Hit) -> PointGroup:
    document, whole = event.session.document, event.session.selected.whole_curves
    curves = whole if hit.index in whole else _intended(event, hit)
    return whole_unlocked_curves(document, curves)


def _locked_words(event: ToolEvent) -> str:
    """Return that the curve under the pointer is locked; empty where none is."""
    document, pointer = event.session.document, event.pointer
    curve = event.canvas.locked_at(pointer) if pointer.is_there else -1
    return locked_message([name_or_count(document, shape_of(document, curve))]) if curve >= 0 else ""


def _is_of_active_shape(event: ToolEvent, hit: Hit) -> bool:
    """Return whether the line of another curve of the active shape is hit."""
    session, selected = event.session, event.session.selected
    is_line = hit.part is Part.OTHER_CURVE and not hit.inside and hit.index not in selected.whole_curves
    return is_line and selected.is_editing and hit.index in shape_of(session.document, session.active_index)


def click_curve(event: ToolEvent, hit: Hit) -> None:
    """Edit the curve hit, or select its group; with Shift add it to the selection, or remove it."""
    session, selected = event.session, event.session.selected
    if event.pointer.shift and selected.is_editing:
        selected.set_curves(_toggled(selected.curves, _intended(event, hit)))
    elif event.pointer.shift:
        selected.select_whole(_toggled(selected.whole_curves, _intended(event, hit)))
    elif selected.is_editing or event.pointer.is_double:
        edit_curve(event, hit.index)
        return
    elif _turns_grips(event, hit):
        session.box.set_turns(not session.box.turns)
        session.say(
            f"{selected_curves(session)} · "
            f"The grips now {'rotate and skew' if session.box.turns else 'scale'}."
        )
        return
    else:
        selected.select_whole(_intended(event, hit))
    session.say(f"{selected_curves(session)}.")


def _turns_grips(event: ToolEvent, hit: Hit) -> bool:
    """Return whether a click switches the grips of the box: on curves that are selected already."""
    curves, whole = _intended(event, hit), event.session.selected.whole_curves
    # With Ctrl a part of the selection is selected alone.
    is_selected = curves == whole if event.pointer.ctrl else curves <= whole
    return is_selected and event.box.is_visible and not event.box.refusal_of(event.box.group)


def _toggled(whole: frozenset[int], curves: frozenset[int]) -> frozenset[int]:
    return whole - curves if curves <= whole else whole | curves


def edit_curve(event: ToolEvent, curve: int) -> None:
    """Edit a curve, and select its point under the pointer."""
    event.session.selected.activate(curve)
    select_hit(event)


def select_hit(event: ToolEvent) -> None:
    """Select the point under the pointer, and say which curves are edited."""
    session, hit = event.session, event.with_hit().hit
    if hit is not None and hit.part is Part.POINT:
        session.selected.set_group(
            points_of(hit.curve if hit.curve >= 0 else session.active_index, [hit.index])
        )
    whole, name = session.selected.whole_curves, f"“{session.active_view.source.display_name}”"
    session.say(f"Editing {name_or_count(session.document, whole) if whole else name}.")


def selected_curves(session: EditingSession) -> str:
    """Return a sentence about the selected curves."""
    whole, active = session.selected.whole_curves, session.active_view.source.display_name
    if not session.selected.is_editing:
        if name := common_name(session.document, whole):
            return f"“{name}” is selected"
        return f"{name_or_count(session.document, whole)} selected" if whole else "No curve is selected"
    if not whole:
        return f"Only “{active}” is selected"
    return f"{name_or_count(session.document, whole)} selected, “{active}” is edited"


# Rubber bands

_BAND_KEYS = "Shift: add to the selection"


def press_with_band(event: ToolEvent, on_click: Click, *, is_on_curve: bool = False) -> RubberBand:
    """Start a rubber band: around points of the curves that are edited, around whole curves where none is.

    A click beside everything deselects, with Shift it leaves the selection. With nothing to deselect, and
    where the press is on a curve, it is `on_click`.
    """
    session = event.session
    before, is_editing = session.selected.state, session.selected.is_editing

    def click(release: ToolEvent) -> None:
        if is_on_curve or not (release.pointer.shift or (is_editing and before.points.parts)):
            on_click(release)
        elif not release.pointer.shift:
            session.selected.set_points([])

    kind = PointBand if is_editing else CurveBand
    return kind(start=event.pointer.position, before=before, on_click=click)


class RubberBand(Gesture, kw_only=True):
    """Rubber band: selects the contents, live; with Shift in addition to the selection before.

    Attributes
    ----------
    start
        The corner where the press was.
    before
        The selection before.
    """

    start: Vector
    before: SelectionState

    def marks(self, event: ToolEvent) -> Marks:
        """Return the band."""
        return Marks(band=(self.start, event.pointer.position) if self.has_moved else None)

    def _corners(self, event: ToolEvent) -> tuple[FloatArray, FloatArray]:
        corners = (self.start, event.pointer.position)
        return np.min(corners, axis=0), np.max(corners, axis=0)


class PointBand(RubberBand, kw_only=True):
    """Rubber band that selects points of all curves that are edited."""

    def move(self, event: ToolEvent) -> None:
        """Select the points inside, while the band is drawn."""
        session, (low, high) = event.session, self._corners(event)
        inside = group_points(
            (curve, _points_inside(session.views[curve], low, high))
            for curve in session.selected.active_curves
        )
        session.selected.show_group(self.before.points.joined(inside) if event.pointer.shift else inside)

    def release(self, event: ToolEvent) -> None:
        """Keep the points selected."""
        event.session.selected.set_group(event.session.selected.group)

    def status(self, event: ToolEvent) -> str:
        """Return the number of selected points."""
        return f"{selection_text(event.session.selected.group)} · {_BAND_KEYS} · Escape cancels"


def _points_inside(view: CurveView, low: FloatArray, high: FloatArray) -> frozenset[int]:
    points = view.points
    return frozenset(np.flatnonzero(np.all((points >= low) & (points <= high), axis=1)).tolist())


class CurveBand(RubberBand, kw_only=True):
    """Rubber band that selects visible, unlocked curves inside; shapes and groups as wholes."""

    def move(self, event: ToolEvent) -> None:
        """Select the curves inside, while the band is drawn."""
        before = self.before.whole_curves if event.pointer.shift else frozenset()
        event.session.selected.show_whole(before | self._inside(event))

    def _inside(self, event: ToolEvent) -> frozenset[int]:
        views, document = event.session.views, event.session.document
        low, high = self._corners(event)
        free = {index for index, view in enumerate(views) if view.source.is_selectable and view.has_curve}
        inside = {index for index in free if _is_inside(views[index], low, high)}
        result: set[int] = set()
        for index in inside:
            if index not in result:
                group = pressed_curves(document, index, self.before) & free
                result |= group if group <= inside else set()
        return frozenset(result)

    def release(self, event: ToolEvent) -> None:
        """Keep the curves selected."""
        event.session.selected.select_whole(event.session.selected.whole_curves)

    def status(self, event: ToolEvent) -> str:
        """Return which curves are selected."""
        return f"{selected_curves(event.session)} · {_BAND_KEYS} · Escape cancels"


def _is_inside(view: CurveView, low: FloatArray, high: FloatArray) -> bool:
    return bool(np.all(view.polyline.min(axis=0) >= low) and np.all(view.polyline.max(axis=0) <= high))
