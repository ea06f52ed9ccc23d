"""Views of many curves before anybody draws them: beside the window, so that it need not wait."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from ...document.model import Curve
from .carried_views import views_after
from .curve_view import CurveView, view_of


def views_ahead(
    curves: Sequence[Curve],
    told: Callable[[float], object],
    originals: Sequence[CurveView | None] = (),
) -> list[CurveView]:
    """Return the views of curves, with what every one of them is asked for when it is first shown.

    Parameters
    ----------
    curves
        The document's values.
    told
        Hears the share that is done; what it raises ends the work.
    originals
        The views of what curves are copies of, moved perhaps; None for those that are none.
    """
    places = [place for place, view in enumerate(originals) if view is not None]
    lent = views_after([curves[place] for place in places], [originals[place] for place in places])
    copies = dict(zip(places, lent, strict=True))
    views = []
    for place, curve in enumerate(curves):
        told(place / len(curves))
        view = copies.get(place) or view_of(curve)
        if len(view.points):
            _ = view.extent  # kept by the view, and with it the polyline that it is made of
        views.append(view)
    return views
