"""Segments cut out of a curve; what is left keeps its shape."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence

from msgspec.structs import replace

from ...document.edits import EditError
from ...document.model import Point
from ...document.straight_edits import why_not_straight
from ..curve.curve_view import CurveView, view_of
from ..fitting.reshape import baked, refuse_without_curve
from .splitting import Split, beginning, names_of_parts, part_of, residual_of_parts


def without_segments(view: CurveView, segments: Collection[int]) -> Split:
    """Return what is left of a curve without some segments: a closed one is open then, an open one in parts.

    Parameters are manual then, and all derivatives explicit. A point without a segment is left out.

    Raises
    ------
    EditError
        If the curve has no segments of its own, or nothing would be left.
    """
    if reason := why_not_straight(view.source.family):
        raise EditError(reason)
    refuse_without_curve(view)
    whole = view_of(baked(view))
    runs = [run for run in _runs(whole, segments) if len(run) > 1]
    if not runs:
        raise EditError("Nothing of the curve would be left; Delete removes it whole.")
    names = names_of_parts(view.source.name, len(runs))
    ended = ([beginning(run[0]), *run[1:-1], run[-1].without_corner()] for run in runs)
    parts = (
        part_of(whole.source, run, run[-1].t or 0.0, each) for run, each in zip(ended, names, strict=True)
    )
    curves = tuple(parts)
    return Split(curves, residual_of_parts(view, curves))


def _runs(whole: CurveView, segments: Collection[int]) -> Iterator[Sequence[Point]]:
    """Yield the points of what is left, piece by piece; of a closed curve from where a segment goes on."""
    points, first = whole.source.points, 0
    if whole.source.is_closed:
        first = min(segments) + 1
        period = float(whole.parameters[-1] - whole.parameters[0])
        again = [replace(point, t=(point.t or 0.0) + period) for point in points[:first]]
        points = (*points[first:], *again)
    run: list[Point] = []
    for place, point in enumerate(points):
        run.append(point)
        if (first + place) % len(points) in segments or place == len(points) - 1:
            yield run
            run = []
