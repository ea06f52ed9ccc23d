"""View-models of the curves that are shown, kept as long as the curves are the same values."""

from __future__ import annotations

from collections import deque
from collections.abc import Collection, Iterable, Mapping, Sequence
from itertools import chain, compress
from operator import is_not

from ..document.differences import are_last_moved
from ..document.model import Curve
from ..families import Family
from ..view_model.curve.curve_view import CurveView, same_line, view_of
from ..view_model.curve.transformed import views_after

_STATES = 2
"""States of the history beside the present one, whose views are kept: for an undo, and a redo after it."""


class Views:
    """The views of a document's curves; computed anew only for curves that are other values than before."""

    def __init__(self) -> None:
        self._views: list[CurveView] = []
        self._curves: tuple[Curve, ...] = ()
        self._ahead: Sequence[CurveView] = ()
        self._left = deque[list[CurveView]](maxlen=_STATES)

    def of(self, curves: tuple[Curve, ...]) -> list[CurveView]:
        """Return the views of `curves`."""
        if self._curves is curves:
            return self._views
        index = self._only_moved(curves)
        if index is not None:
            self._views = [*self._views]
            self._views[index] = view_of(curves[index], self._views[index])
        else:
            known = list(self._known())
            self._leave_behind(curves)
            by_curve = {id(view.source): view for view in known}
            by_points = {id(view.source.points): view for view in known}
            known_views = [by_curve.get(id(curve)) or _alike(curve, by_points) for curve in curves]
            # A curve that was changed takes its last good shape from its index in the list.
            before = self._views if len(curves) == len(self._views) else [None] * len(curves)
            missing = [index for index, view in enumerate(known_views) if view is None]
            new_views = views_after(
                [curves[index] for index in missing],
                [before[index] for index in missing],
                are_moved=are_last_moved(self._curves, curves),
            )
            new = iter(new_views)
            self._views = [view or next(new) for view in known_views]
        self._curves = curves
        return self._views

    def _only_moved(self, curves: tuple[Curve, ...]) -> int | None:
        """Return the index of the one curve that has other points, as under most drags; None otherwise."""
        if self._ahead or len(curves) != len(self._curves):
            return None
        others = list(compress(range(len(curves)), map(is_not, curves, self._curves)))
        if len(others) != 1 or curves[others[0]].points is self._curves[others[0]].points:
            return None
        return others[0]

    def _leave_behind(self, curves: tuple[Curve, ...]) -> None:
        """Expect no views any more once their curves are there; others may be asked for before."""
        there = set(map(id, curves)) if self._ahead else set()
        if any(id(view.source) in there for view in self._ahead):
            self._ahead = ()

    def _known(self) -> Iterable[CurveView]:
        """Return all views that there are, the best of them last."""
        return chain(*self._left, self._views, self._ahead)

    def leave(self) -> None:
        """Keep the views as those of a state that undo or redo goes back to."""
        self._left.append(self._views)

    def renew(self, families: Collection[Family]) -> None:
        """Make the views of curves of these families anew: their functions are other ones."""
        self._left.clear()
        self._views = [
            view_of(view.source, view) if view.source.family in families else view for view in self._views
        ]

    def expect(self, views: Sequence[CurveView]) -> None:
        """Accept views of curves that the next change adds, computed in a thread."""
        self._ahead = views

    def take(self, views: Sequence[CurveView] = ()) -> None:
        """Go on with `views`, as far as they are of the curves that are asked for, and with no others."""
        self._left.clear()
        self._views, self._curves = list(views), ()


def _alike(curve: Curve, by_points: Mapping[int, CurveView]) -> CurveView | None:
    """Return the view of a new curve with the points and the line of a known one; None for none."""
    alike = by_points.get(id(curve.points))
    return same_line(curve, alike) if alike else None
