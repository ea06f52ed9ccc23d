"""Selected points, selected curves, hovered point and scrub line; each names something that exists."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import TYPE_CHECKING

from ..document.model import Curve
from ..document.selection import followed_curves, followed_points, returned_curves, returned_points
from ..document.shapes import whole_shapes
from ..view_model.pivot import Pivot

if TYPE_CHECKING:
    from .session import Session


class Selection:
    """Selection and the like, neither saved nor undone.

    Whatever is asked for, it names what exists in the document shown. The session's signals tell of it.

    Attributes
    ----------
    points
        Indices of the selected points of the active curve.
    curves
        Indices of the curves that are worked on together; the active one is one of them.
    hovered
        The point under the pointer, or -1.
    scrub
        The t of the scrub line, or None.
    pivot
        What was chosen to turn, scale and mirror about, with what it was chosen for; None for the middle.
    """

    def __init__(self, session: Session) -> None:
        self._session = session
        self.points: frozenset[int] = frozenset()
        self.curves = frozenset({0})
        self.hovered = -1
        self.scrub: float | None = None
        self.pivot: Pivot | None = None
        # The place that was asked for: the scrub line stands there as far as the curve goes.
        self._scrub_asked: float | None = None

    @property
    def point(self) -> int | None:
        """The selected point if exactly one is selected."""
        return next(iter(self.points)) if len(self.points) == 1 else None

    @property
    def whole(self) -> frozenset[int]:
        """The selected curves, with all others of their shapes."""
        return whole_shapes(self._session.document, self.curves)

    def set_points(self, indices: Collection[int]) -> None:
        """Select the points at `indices` of the active curve, those that exist."""
        session, before = self._session, self.points
        count = len(session.active_curve.points)
        self.points = frozenset(int(index) for index in indices if 0 <= index < count)
        if self.points != before:
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

    # Curves

    def activate(self, index: int) -> None:
        """Edit another curve, and select it alone; nothing of it is selected yet."""
        self.set_curves((index,), index)

    def set_curves(self, indices: Collection[int], active: int | None = None) -> None:
        """Select curves to work on together, those that exist.

        The curve that is edited is one of them: `active`, or the one edited so far, or the selected one
        nearest to it. With several no points are selected, so that tools act on the curves.
        """
        session = self._session
        if session.is_previewing:
            # The gesture may edit a curve that goes with its preview.
            session.interrupt()
        before, places = self.curves, range(len(session.document.curves))
        wanted = active if active is not None and active in places else session.active_index
        existing = {index for index in indices if index in places}
        if wanted not in existing:
            wanted = min(existing, key=lambda index: abs(index - wanted), default=wanted)
        self.curves = frozenset({*existing, wanted})
        if wanted != session.active_index:
            session.interrupted.emit()
            session.cancel()
            session.offered_at = None
            self.enter(wanted)
            self.keep_scrub()
            session.active_changed.emit(wanted)
        if len(self.curves) > 1:
            self.set_points([])
        if self.curves != before:
            session.selected_curves_changed.emit(self.curves)

    def enter(self, index: int) -> None:
        """Make curve `index` the active one; what belonged to the other is put away."""
        self.set_points([])
        self.set_hovered(-1)
        self._session.active_index = index

    # From document to document

    def follow_curves(self, before: Sequence[Curve]) -> bool:
        """Select the same curves where they are now; return whether their places are other ones."""
        session, old = self._session, self.curves
        after, active = session.document.curves, session.active_index
        kept = followed_curves(old, before, after) if len(old) > 1 else frozenset[int]()
        self.curves = kept if active in kept else frozenset({active})
        return self.curves != old

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
        if len(returned := returned_curves(before, curves)) > 1:
            self.set_curves(returned)
        elif not self.points and len(before) == len(curves):
            self.set_points(returned_points(before[active].points, session.active_curve.points))
