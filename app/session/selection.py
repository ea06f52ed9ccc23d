"""Selected points, selected curves, hovered point and scrub line; each names something that exists."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import TYPE_CHECKING

from ..document.model import Curve
from ..document.selection import (
    Choice,
    followed_curves,
    followed_points,
    returned_curves,
    returned_points,
)
from ..document.shapes import whole_shapes
from ..view_model.pivot import Pivot
from .highlight import Highlight

if TYPE_CHECKING:
    from .session import Session


class Selection:
    """Selection and the like, neither saved nor undone.

    One curve is edited: its points are shown and selected. Or none is, and curves are chosen as wholes; the
    active one is then the last that was edited or chosen.

    Whatever is asked for, it names what exists in the document shown. The session's signals tell of it.

    Attributes
    ----------
    points
        Indices of the selected points of the active curve.
    curves
        Indices of the curves that are worked on together; the active one is one of them.
    last
        The curve that was chosen last, of several at once the foremost.
    is_editing
        Whether the active curve is edited.
    hovered
        The point under the pointer, or -1.
    scrub
        The t of the scrub line, or None.
    pivot
        What was chosen to turn, scale and mirror about, with what it was chosen for; None for the middle.
    turns
        Whether the box around what is selected has grips that rotate and skew; until something else is.
    """

    def __init__(self, session: Session) -> None:
        self._session = session
        self.points: frozenset[int] = frozenset()
        self.curves = frozenset({0})
        self.is_editing = True
        self.last = 0
        # While no curve is edited, those that are chosen: all of `curves`, or none at all.
        self._chosen: frozenset[int] = frozenset()
        self.hovered = -1
        self.scrub: float | None = None
        self.pivot: Pivot | None = None
        self.turns = False
        # The place that was asked for: the scrub line stands there as far as the curve goes.
        self._scrub_asked: float | None = None

    @property
    def point(self) -> int | None:
        """The selected point if exactly one is selected."""
        return next(iter(self.points)) if len(self.points) == 1 else None

    @property
    def chosen(self) -> frozenset[int]:
        """The curves that are acted on as wholes: those chosen, or several beside the one that is edited."""
        if not self.is_editing:
            return self._chosen
        return self.curves if len(self.curves) > 1 else frozenset()

    @property
    def marked(self) -> frozenset[int]:
        """The curves that are seen to be selected: the edited one or several, those chosen, or none."""
        return self.curves if self.is_editing else self._chosen

    def highlight(self, *, whole_curves: bool = False) -> Highlight:
        """Return the selected points, or else the chosen curves, or the edited one, with all of their shapes.

        `whole_curves` passes over the points, as where the list of curves has the focus.
        """
        if self.points and not whole_curves:
            return Highlight(frozenset({self._session.active_index}), self.points)
        return Highlight(whole_shapes(self._session.document, self.marked))

    @property
    def whole(self) -> frozenset[int]:
        """The selected curves, with all others of their shapes."""
        return whole_shapes(self._session.document, self.curves)

    def set_points(self, indices: Collection[int]) -> None:
        """Select the points at `indices` of the active curve, those that exist; it is edited with any."""
        session, before = self._session, self.points
        count = len(session.active_curve.points)
        points = frozenset(int(index) for index in indices if 0 <= index < count)
        if points and not self.is_editing:
            self.activate(session.active_index)
        self.points = points
        if self.points != before:
            self.set_turns(False)
            session.history.end_run()
            session.selection_changed.emit(self.points)

    def set_hovered(self, index: int) -> None:
        """Take note of the point under the pointer; -1 for none."""
        before, count = self.hovered, len(self._session.active_curve.points)
        self.hovered = index if 0 <= index < count else -1
        if self.hovered != before:
            self._session.hovered_changed.emit(self.hovered)

    def set_scrub(self, t: float | None) -> None:
        """Move the scrub line to `t`, or put it away (None).

        It stays on the curve that is edited: at the end nearer to `t` where that lies outside, away while
        there is no curve, and at `t` again when there is one that goes as far.
        """
        self._scrub_asked, before = t, self.scrub
        curve = None if t is None else self._session.active_view.curve
        if t is None or curve is None:
            self.scrub = None
        else:
            start, end = curve.domain
            self.scrub = float(min(max(t, start), end))
        if self.scrub != before:
            self._session.scrub_changed.emit(self.scrub)

    def keep_scrub(self) -> None:
        """Put the scrub line where it was asked for, as far as the present curve goes."""
        self.set_scrub(self._scrub_asked)

    def set_pivot(self, pivot: Pivot | None) -> None:
        """Turn, scale and mirror about another place, or about the middle (None)."""
        before, self.pivot = self.pivot, pivot
        if (before and before.place) != (pivot and pivot.place):
            self._session.pivot_changed.emit()

    def set_turns(self, turns: bool) -> None:
        """Have grips that rotate and skew, or such that scale."""
        before, self.turns = self.turns, turns
        if self.turns != before:
            self._session.grips_changed.emit()

    # Curves

    def activate(self, index: int) -> None:
        """Edit a curve, and select it alone; of another one nothing is selected yet."""
        self._take((index,), index, is_editing=True)

    def choose(self, indices: Collection[int]) -> None:
        """Choose curves as wholes, those that exist, or none at all; no curve is edited any more.

        Curves of one shape are chosen together. The active one is one of them, as `set_curves` has it.
        """
        document = self._session.document
        places = [index for index in indices if 0 <= index < len(document.curves)]
        self._take(whole_shapes(document, places), is_editing=False)

    def show_choice(self, indices: Collection[int]) -> None:
        """Show curves as chosen while a gesture goes on; `choose` or `restore` ends it."""
        self._chosen = frozenset(indices)
        self._session.selected_curves_changed.emit(self.curves)

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
        before, places = self.choice, range(len(session.document.curves))
        wanted = active if active is not None and active in places else session.active_index
        existing = {index for index in indices if index in places}
        if wanted not in existing:
            wanted = min(existing, key=lambda index: abs(index - wanted), default=wanted)
        self.curves = frozenset({*existing, wanted})
        self.is_editing, self._chosen = is_editing, frozenset() if is_editing else frozenset(existing)
        if wanted != session.active_index:
            session.interrupted.emit()
            session.cancel()
            session.offered_at = None
            self.enter(wanted)
            self.keep_scrub()
            session.active_changed.emit(wanted)
        if self.chosen or not is_editing:
            self.set_points([])
        self.last = max(existing - before.curves, default=self.last if self.last in existing else wanted)
        if (self.curves, self.chosen, self.is_editing) != (before.curves, before.chosen, before.is_editing):
            self.set_turns(False)
            session.selected_curves_changed.emit(self.curves)

    @property
    def choice(self) -> Choice:
        """All that is selected now."""
        return Choice(self._session.active_index, self.points, self.curves, self.chosen, self.is_editing)

    def restore(self, choice: Choice) -> None:
        """Select what was selected before; the active curve is the one of then already."""
        self._take(choice.curves if choice.is_editing else choice.chosen, is_editing=choice.is_editing)
        self.set_points(choice.points)

    def reset(self) -> None:
        """Edit the active curve, with nothing of it selected, and tell nobody yet."""
        self.points, self.curves = frozenset(), frozenset({self._session.active_index})
        self.is_editing, self._chosen, self.last = True, frozenset(), self._session.active_index

    def enter(self, index: int) -> None:
        """Make curve `index` the active one; what belonged to the other is put away."""
        self.set_points([])
        self.set_hovered(-1)
        self._session.active_index = index

    # From document to document

    def follow_curves(self, before: Sequence[Curve]) -> bool:
        """Select the same curves where they are now; return whether their places are other ones."""
        session, old = self._session, (self.curves, self._chosen)
        after, active = session.document.curves, session.active_index
        several = self._chosen if not self.is_editing else self.curves if len(self.curves) > 1 else ()
        kept = followed_curves(several, before, after)
        if active not in kept:
            # A curve that was added is what is worked on now; where one has gone nobody has chosen another.
            kept = frozenset({active} if self.is_editing or len(after) > len(before) else ())
        self.last = max(followed_curves({self.last}, before, after), default=active)
        self.curves = kept or frozenset({active})
        self._chosen = frozenset() if self.is_editing else kept
        return (self.curves, self._chosen) != old

    def followed_points(self, before: Sequence[Curve]) -> frozenset[int]:
        """Return where the selected points of the curve that was active are in the one that is."""
        session = self._session
        if not self.points or session.active_index >= len(before):
            return frozenset()
        old = before[session.active_index].points
        return followed_points(self.points, old, session.active_curve.points)

    def select_returned(self, before: Sequence[Curve]) -> None:
        """Select the points, or the curves, that undo or redo has brought back."""
        session = self._session
        curves, active = session.committed.curves, session.active_index
        returned = returned_curves(before, curves)
        if len(returned) > 1 or (returned and not self.is_editing):
            self.set_curves(returned)
        elif self.is_editing and not self.points and len(before) == len(curves):
            self.set_points(returned_points(before[active].points, session.active_curve.points))
