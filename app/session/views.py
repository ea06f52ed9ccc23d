"""View-models of the curves that are shown, kept as long as the curves are the same values."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from itertools import compress
from operator import is_not

from ..document.model import Curve
from ..families import Family
from ..view_model.curve_view import CurveView, view_of


class Views:
    """The views of a document's curves; made anew only for curves that are other values than before."""

    def __init__(self) -> None:
        self._views: list[CurveView] = []
        self._curves: tuple[Curve, ...] = ()
        self._ahead: Sequence[CurveView] = ()

    def of(self, curves: tuple[Curve, ...]) -> list[CurveView]:
        """Return the views of `curves`."""
        if self._curves is curves:
            return self._views
        place = self._only_other(curves)
        if place is not None:
            self._views = [*self._views]
            self._views[place] = view_of(curves[place], self._views[place])
        else:
            known = {id(view.source): view for view in (*self._views, *self._ahead)}
            self._ahead = ()
            # A curve that was changed takes its last good shape from its place in the list.
            same_places = len(curves) == len(self._views)
            self._views = [
                known.get(id(curve)) or view_of(curve, self._views[place] if same_places else None)
                for place, curve in enumerate(curves)
            ]
        self._curves = curves
        return self._views

    def _only_other(self, curves: tuple[Curve, ...]) -> int | None:
        """Return the place of the one curve that is another value, as under most drags, None otherwise."""
        if self._ahead or len(curves) != len(self._curves):
            return None
        others = list(compress(range(len(curves)), map(is_not, curves, self._curves)))
        return others[0] if len(others) == 1 else None

    def renew(self, families: Collection[Family]) -> None:
        """Make the views of curves of these families anew: their functions are other ones."""
        self._views = [
            view_of(view.source, view) if view.source.family in families else view for view in self._views
        ]

    def expect(self, views: Sequence[CurveView]) -> None:
        """Have views of curves that come with the next change, made beside the window."""
        self._ahead = views

    def take(self, views: Sequence[CurveView] = ()) -> None:
        """Go on with `views`, as far as they are of the curves that are asked for, and with no others."""
        self._views, self._curves = list(views), ()
