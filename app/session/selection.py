"""The selection: points, curves, the box around them, the scrub line; neither saved nor undone."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

import msgspec
import numpy as np

from curvecore.arrays import FloatArray

from ..document.differences import reshaped_curves
from ..document.groups import expand_to_shapes
from ..document.model import Document
from ..document.point_group import NO_POINTS, PointGroup, PointsEdit, group_points
from ..document.selection import (
    SelectionState,
    existing_points,
    followed_curves,
    followed_selection,
    returned_curves,
    returned_points,
)
from ..document.several_curves import (
    common_name,
    locked_remark,
    name_or_count,
    remove_curves,
    unlocked_curves,
)
from ..document.style import Style
from ..view_model.curve.curve_view import CurveView
from ..view_model.pivot import Pivot

if TYPE_CHECKING:
    from .session import Session


class Selection:
    """Selected points and curves, and the point under the pointer; each names something that exists.

    One curve is edited, and with it those of its shape and those selected beside it: their points are shown
    and selected, some of the active one if any. Or none is, and curves are selected as wholes; the active one
    is then the last that was edited or selected. The session's signals report each change.

    Attributes
    ----------
    group
        The selected points, of all curves that are edited.
    curves
        Indices of the curves that are worked on together; the active one is one of them.
    last
        The curve that was selected last, of several at once the foremost.
    is_editing
        Whether the active curve is edited.
    hovered
        The point under the pointer, or -1.
    is_implicit
        Whether a tool began to edit the active curve while nothing was selected.
    next_style
        The style that was set, or used last, while nothing was selected, or before curves were
        imported: that of the next curve drawn. None where that looks like the active curve.
    """

    def __init__(self, session: Session) -> None:
        self._session = session
        self.group = NO_POINTS
        self.curves = frozenset({0})
        self.is_editing = True
        self.last = 0
        # While no curve is edited, those selected as wholes: all of `curves`, or none at all.
        self._whole_curves: frozenset[int] = frozenset()
        self.hovered = -1
        self.is_implicit = False
        self.next_style: Style | None = None

    @property
    def points(self) -> frozenset[int]:
        """Indices of the selected points of the active curve."""
        return self.group.of(self._session.active_index)

    @property
    def active_curves(self) -> frozenset[int]:
        """The curves whose points can be selected: the active one, its shape, and those selected with it."""
        return self.with_shapes if self.is_editing else frozenset()

    @property
    def whole_curves(self) -> frozenset[int]:
        """The curves that are selected as wholes: any, or several beside the active one that is edited."""
        if not self.is_editing:
            return self._whole_curves
        return self.curves if len(self.curves) > 1 else frozenset()

    @property
    def target_curves(self) -> frozenset[int]:
        """Target of actions on curves: whole curves, those of selected points, or the active shape."""
        active = self._session.active_index
        return self.whole_curves or self.group.curves or expand_to_shapes(self._session.document, (active,))

    @property
    def marked(self) -> frozenset[int]:
        """The curves that are marked as selected: the edited ones, those selected as wholes, or none."""
        return self.curves if self.is_editing else self._whole_curves

    def for_clipboard(self, *, whole_curves: bool = False) -> ClipboardSelection:
        """Return the selected points, or else the whole curves, or the active one with all of its shape.

        `whole_curves` passes over the points, as where the list of curves has the focus.
        """
        if self.group.parts and not whole_curves:
            return ClipboardSelection(self.group.curves, self.group)
        # One curve of a shape can be selected alone, in the list.
        return ClipboardSelection(self.with_shapes if self.is_editing else self._whole_curves)

    @property
    def with_shapes(self) -> frozenset[int]:
        """The selected curves, with all others of their shapes."""
        return expand_to_shapes(self._session.document, self.curves)

    @property
    def state(self) -> SelectionState:
        """The present selection."""
        active = self._session.active_index
        parts = (self.group, self.curves, self.whole_curves, self.is_editing, self.is_implicit)
        return SelectionState(active, *parts)

    # Select

    def set_points(self, indices: Collection[int]) -> None:
        """Select points of the active curve alone, those that exist; it is edited with any."""
        self.set_group(group_points([(self._session.active_index, frozenset(map(int, indices)))]))

    def set_group(self, group: PointGroup) -> None:
        """Select points of the curves that are edited, those that exist.

        The active curve is edited with any, and one of those with some: the one so far, or the nearest to it.
        """
        active = self._session.active_index
        if not self.is_editing and existing_points(group, self._session.document.curves, {active}).parts:
            self.activate(active)
        existing = self._existing(group)
        if existing.parts and not existing.of(active):
            self._turn_to(min(existing.curves, key=lambda curve: abs(curve - active)))
        self._put(existing)

    def show_group(self, group: PointGroup) -> None:
        """Show points as selected while a gesture goes on, perhaps none of the active curve.

        `set_group` or `restore` ends it.
        """
        self._put(self._existing(group))

    def keep_group(self, group: PointGroup) -> None:
        """Select the existing ones of some points: none, unless there is one of the active curve."""
        existing = self._existing(group)
        self._put(existing if existing.of(self._session.active_index) else NO_POINTS)

    def _existing(self, group: PointGroup) -> PointGroup:
        if not group.parts:
            return NO_POINTS
        return existing_points(group, self._session.document.curves, self.active_curves)

    def _put(self, group: PointGroup) -> None:
        if group != self.group:
            self.group = group
            self._session.box.set_turns(False)
            self._session.history.end_run()
            self._session.selection_changed.emit(self.points)

    def set_hovered(self, index: int) -> None:
        """Take note of the point under the pointer; -1 for none."""
        before, count = self.hovered, len(self._session.active_curve.points)
        self.hovered = index if 0 <= index < count else -1
        if self.hovered != before:
            self._session.hovered_changed.emit(self.hovered)

    # Curves

    def activate(self, index: int) -> None:
        """Edit a curve, and select it alone; of another one nothing is selected yet."""
        self._take((index,), index, is_editing=True)

    def edit_selected(self) -> None:
        """Edit the selected whole curves: several shapes together, or the active curve with its shape."""
        active = self._session.active_index
        others = self._whole_curves - expand_to_shapes(self._session.document, (active,))
        self._take((*self._whole_curves, active) if others else (active,), active, is_editing=True)

    def switch_active(self, index: int) -> None:
        """Make another of the curves that are edited the active one; the same points are selected."""
        group = self.group
        self._turn_to(index)
        self._put(group)

    def _turn_to(self, index: int) -> None:
        self._take((*(self.curves if len(self.curves) > 1 else ()), index), index, is_editing=True)

    def select_whole(self, indices: Collection[int]) -> None:
        """Select curves as wholes, those that exist, or none at all; no curve is edited any more.

        Curves of one shape are selected together. The active one is one of them, as in `set_curves`.
        """
        document = self._session.document
        existing = [index for index in indices if 0 <= index < len(document.curves)]
        self._take(expand_to_shapes(document, existing), is_editing=False)

    def edit_active(self) -> None:
        """Edit the active curve, because the tool needs one; implicitly where it was not selected."""
        is_lent, style = self.is_implicit or not self.marked, self.next_style
        self.activate(self._session.active_index)
        self.is_implicit, self.next_style = is_lent, style

    def select_imported(self, indices: Collection[int], style: Style) -> None:
        """Select imported curves as wholes; the next curve drawn has this style, not theirs."""
        self.select_whole(indices)
        self.next_style = style

    def show_whole(self, indices: Collection[int]) -> None:
        """Show whole curves as selected during a gesture; `select_whole` or `restore` ends it."""
        self._whole_curves = frozenset(indices)
        self._session.selected_curves_changed.emit(self.curves)

    def show(self, state: SelectionState) -> None:
        """Show points or whole curves as selected while a gesture goes on."""
        if state.is_editing:
            self.set_group(state.points)
        else:
            self.show_whole(state.whole_curves)

    def set_curves(self, indices: Collection[int], active: int | None = None) -> None:
        """Select curves to work on together, those that exist.

        The active curve is one of them: `active`, or the one so far, or the selected one nearest to it. With
        several no points are selected, so that tools act on the curves.
        """
        wanted = self._session.active_index if active is None else active
        self._take(indices or (wanted,), active, is_editing=self.is_editing)

    def _take(self, indices: Collection[int], active: int | None = None, *, is_editing: bool) -> None:
        session = self._session
        if session.is_previewing:
            # The gesture may edit a curve that goes with its preview.
            session.interrupt()
        before, present = self.state, range(len(session.document.curves))
        wanted = active if active is not None and active in present else session.active_index
        existing = frozenset(index for index in indices if index in present)
        if wanted not in existing:
            wanted = min(existing, key=lambda index: abs(index - wanted), default=wanted)
        self.assign((*existing, wanted), existing, is_editing=is_editing)
        self.is_implicit = False
        if existing:
            self.next_style = None
        if wanted != session.active_index:
            session.gesture_ended.emit()
            session.cancel()
            self.make_active(wanted)
            self._session.scrub.keep()
            session.active_changed.emit(wanted)
        # No point stays selected of a curve that is not edited any more.
        self.keep_group(NO_POINTS if self.whole_curves or not is_editing else self.group)
        self.last = max(existing - before.curves, default=self.last if self.last in existing else wanted)
        if (self.curves, self.whole_curves, self.is_editing) != (
            before.curves,
            before.whole_curves,
            before.is_editing,
        ):
            self._session.box.set_turns(False)
            session.selected_curves_changed.emit(self.curves)

    def restore(self, state: SelectionState) -> None:
        """Restore a selection, with its active curve."""
        curves = state.curves if state.is_editing else state.whole_curves
        self._take(curves, state.active, is_editing=state.is_editing)
        self.set_group(state.points)

    def make_active(self, index: int) -> None:
        """Make curve `index` the active one; points of the other are deselected."""
        self.set_points([])
        self.set_hovered(-1)
        self._session.active_index = index

    def assign(
        self, curves: Collection[int], whole: Collection[int] = (), *, is_editing: bool = True
    ) -> None:
        """Set the selected curves without a signal; `whole` of them where none is edited."""
        self.curves, self.is_editing = frozenset(curves), is_editing
        self._whole_curves = frozenset() if is_editing else frozenset(whole)

    # To another document

    def clear(self) -> None:
        """Deselect everything: the document is replaced."""
        self.set_points([])
        self.edit_active()
        self.next_style = None

    def begin_opened(self) -> None:
        """Begin with a document that was opened: its curves are edited implicitly.

        None hidden or locked is edited.
        """
        self.is_implicit = False
        if not self._session.active_curve.is_selectable:
            self.select_whole(())

    def reset(self) -> None:
        """Edit the active curve, with no point selected, without a signal yet."""
        active = self._session.active_index
        self.assign((active,))
        self.group, self.last = NO_POINTS, active

    # Around a gesture

    def begin_curve(self, index: int) -> None:
        """Edit curve `index`, which a gesture begins, and nothing else; without a signal yet."""
        self.make_active(index)
        self.assign((index,))
        # It is not in the document yet.
        self.is_implicit = True

    def keep_previewed(self) -> None:
        """Keep the selection that a dropped gesture has shown, as far as it is valid."""
        if not self.is_editing and self.whole_curves and self.whole_curves != self.curves:
            self.set_curves(self.whole_curves)
        self.keep_group(self.group)

    # To another state

    @contextmanager
    def following(self, before: Document) -> Iterator[None]:
        """Follow from a document to the present one, around the signal that reports it.

        No listener of the signal finds a selected curve or point that the document does not have. The canvas
        has to get the points before the selection.
        """
        session, curves = self._session, self._session.document.curves
        if session.active_index in self.curves and reshaped_curves(before, session.document) is not None:
            # As during most drags: selection and hovered point are unchanged.
            yield
            session.scrub.follow()
            return
        marked = [curve for index, curve in enumerate(before.curves) if index in self.marked]
        session.active_index = min(session.active_index, len(curves) - 1)
        old = self.state
        new = followed_selection(old, before.curves, curves)
        session.active_index = new.active
        self.last = max(followed_curves({self.last}, before.curves, curves), default=new.active)
        self.assign(new.curves, new.whole_curves, is_editing=new.is_editing)
        if marked and not self.marked:
            # They were deleted: what is drawn next looks like the foremost of them, unless they were brought.
            self.next_style = self.next_style or marked[-1].style
        elif all(curve is not curves[new.active] for curve in before.curves):
            # It was begun, or worked on.
            self.is_implicit, self.next_style = False, None
        self.keep_group(self.group)
        self.set_hovered(self.hovered)
        yield
        self.keep_group(new.points)
        session.scrub.follow()
        if (new.curves, new.whole_curves, new.is_editing) != (old.curves, old.whole_curves, old.is_editing):
            session.selected_curves_changed.emit(self.curves)

    def select_returned(self, document: Document, then: SelectionState | None) -> None:
        """Select the points or curves that undo or redo has brought back; restore the selection of `then`.

        Likewise where curves selected since are removed with the step, as copies are.
        """
        now, before = self._session.committed, document.curves
        curves = now.curves
        returned = returned_curves(before, curves)
        is_left = len(before) > len(curves)
        if then is not None and _comes_back(then, returned, self, is_left=is_left):
            self.restore(then)
        elif len(returned) > 1 or (returned and not self.is_editing):
            self.set_curves(returned)
        elif self.is_editing and not self.group.parts and len(before) == len(curves):
            self.keep_group(returned_points(self.active_curves, before, curves))


def _comes_back(then: SelectionState, returned: Collection[int], now: Selection, *, is_left: bool) -> bool:
    """Return whether the selection before a step is restored, because undo has brought back some of it.

    Likewise where nothing is selected any more, because the curves that the step had made are removed: then
    edited or whole curves.
    """
    has_gone = is_left and not now.marked
    if then.is_editing:
        has_gone = has_gone and not then.is_implicit
        return not now.is_editing and (has_gone or not then.curves.isdisjoint(returned))
    return not then.whole_curves.isdisjoint(returned) or (has_gone and bool(then.whole_curves))


class ClipboardSelection(msgspec.Struct, frozen=True):
    """Points or curves that Copy, Cut, Duplicate and Delete act on.

    Attributes
    ----------
    curves
        The curves, whole; those of the points where there are points.
    points
        The points; none for whole curves.
    remark
        The part that cannot be changed: "1 locked curve stays"; empty for nothing.
    """

    curves: frozenset[int]
    points: PointGroup = NO_POINTS
    remark: str = ""

    def unlocked(self, document: Document) -> ClipboardSelection:
        """Return it without the curves that are locked, unless all are; points stay as they are."""
        if self.points.parts:
            return self
        return ClipboardSelection(
            unlocked_curves(document, self.curves), remark=locked_remark(document, self.curves)
        )

    def curves_of(self, document: Document) -> frozenset[int]:
        """Return the curves that are whole: also those of which all points are selected.

        The only curve never is: without them the document is empty, and of the same family.
        """
        if not self.points.parts:
            return self.curves
        if len(document.curves) == 1:
            return frozenset()
        return frozenset(
            curve
            for curve, indices in self.points.parts
            if len(indices) == len(document.curves[curve].points)
        )

    def label(self, document: Document) -> str:
        """Return the words "point 3" or "4 points", the name of the curve, or "2 curves"."""
        is_whole = self.curves_of(document) == self.curves
        return name_or_count(document, self.curves) if is_whole else self.points.label

    def label_in_sentence(self, document: Document) -> str:
        """Return its label within a sentence: "3 points", the name in quotation marks, or "2 curves"."""
        if self.points.parts:
            return self.points.count_label
        name = common_name(document, self.curves)
        return name_or_count(document, self.curves) if name is None else f"“{name}”"

    def label_with_remark(self, document: Document) -> str:
        """Return the label with the remark: "2 curves; 1 locked curve stays"."""
        return "; ".join(filter(None, (self.label_in_sentence(document), self.remark)))

    def removed_from(self, document: Document, delete: PointsEdit) -> Document:
        """Return the document without it; `delete` deletes points of one curve."""
        whole = self.curves_of(document)
        for curve, indices in self.points.parts:
            if curve not in whole:
                document = delete(document, curve, indices)
        return remove_curves(document, whole)


class BoxState:
    """The pivot and the grips of the box around the selection; neither saved nor undone.

    Parameters
    ----------
    pivot_changed, grips_changed
        Told when a pivot is elsewhere, and when the grips do something else.

    Attributes
    ----------
    pivot
        The pivot that was set, with the points that it was set for; None for the middle.
    turns
        Whether its grips rotate and skew; until something else is selected.
    """

    def __init__(self, pivot_changed: Callable[[], None], grips_changed: Callable[[], None]) -> None:
        self._pivot_changed, self._grips_changed = pivot_changed, grips_changed
        self.pivot: Pivot | None = None
        self.turns = False

    def set_pivot(self, pivot: Pivot | None) -> None:
        """Turn, scale and mirror about another place; None for the middle."""
        before, self.pivot = self.pivot, pivot
        if (before and before.position) != (pivot and pivot.position):
            self._pivot_changed()

    def set_turns(self, turns: bool) -> None:
        """Have grips that rotate and skew, or such that scale."""
        before, self.turns = self.turns, turns
        if self.turns != before:
            self._grips_changed()


class ScrubLine:
    """A place on the curve that is edited; neither saved nor undone.

    Parameters
    ----------
    view
        Returns the view of the curve that is edited.
    changed
        Told of another `t`.

    Attributes
    ----------
    t
        Where it stands, or None.
    """

    def __init__(self, view: Callable[[], CurveView], changed: Callable[[float | None], None]) -> None:
        self._view, self._changed = view, changed
        self.t: float | None = None
        # The place that was asked for: the line stands there as far as the curve goes.
        self._asked: float | None = None
        # The parameters of the curve that it stands on; its share of them since they have been stretched.
        self._parameters: FloatArray | None = None
        self._share: float | None = None

    def set(self, t: float | None) -> None:
        """Move the line to `t`, or put it away (None).

        It stays on the curve that is edited: at the end nearer to `t` where that lies outside, away while
        there is no curve, and at `t` again when there is one that goes as far.
        """
        self._asked, self._share, before = t, None, self.t
        curve = None if t is None else self._view().curve
        if t is None or curve is None:
            self.t = None
        else:
            self._parameters = self._view().parameters
            start, end = curve.domain
            self.t = float(min(max(t, start), end))
        if self.t != before:
            self._changed(self.t)

    def keep(self) -> None:
        """Put the line where it was asked for, as far as the present curve goes."""
        self.set(self._asked)

    def follow(self) -> None:
        """Keep the line on a changed curve: at its relative place where only the interval is another one."""
        if self._asked is None:
            return
        old, view = self._parameters, self._view()
        if self.t is not None and old is not None and view.curve is not None and old is not view.parameters:
            new = view.parameters
            scale = float(new[-1] - new[0]) / float(old[-1] - old[0])
            if (new[0], scale) != (old[0], 1.0) and _are_stretched(old, new, scale):
                share = self._share or (self.t - float(old[0])) / float(old[-1] - old[0])
                self.set(float(new[0]) + share * float(new[-1] - new[0]))
                self._share = share
                return
        self.keep()


def _are_stretched(old: FloatArray, new: FloatArray, scale: float) -> bool:
    """Whether parameters are others over another interval, and nothing else."""
    if len(old) != len(new):
        return False
    return bool(np.abs(new[0] + (old - old[0]) * scale - new).max() <= 1e-9 * (new[-1] - new[0]))
