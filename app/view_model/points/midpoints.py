"""A point more in the middle of some segments of a curve."""

from __future__ import annotations

from collections.abc import Collection

import msgspec
import numpy as np
from msgspec.structs import replace

from ..curve.curve_view import CurveView, view_of
from ..fitting.reshape import (
    Reshaped,
    change_of_shape,
    inserted_index,
    refuse_without_curve,
    with_point_inserted,
)


class Halved(msgspec.Struct, frozen=True):
    """A curve with segments halved, the points that were made, and where those are now that were given."""

    made: Reshaped
    new: frozenset[int]
    old: frozenset[int]


def with_midpoints(view: CurveView, segments: Collection[int], points: Collection[int]) -> Halved:
    """Return the curve with a point in the middle of each of these segments, and the places of `points` then.

    Its shape is kept as far as it is by one point; see `reshape.with_point_inserted`.

    Raises
    ------
    EditError
        If there is no curve, or no room for a point.
    """
    refuse_without_curve(view)
    now, new, old, steps, middles = view, frozenset[int](), frozenset(points), list[Reshaped](), list[float]()
    # From the last on: what lies behind keeps its place, whatever a rule makes of the parameters.
    for segment in sorted(segments, reverse=True):
        t = _middle(now, segment)
        index = inserted_index(now, t)
        steps.append(with_point_inserted(now, t))
        middles.append(_middle(view, segment))
        now = view_of(steps[-1].curve)
        new = _shifted(new, index) | {index}
        old = _shifted(old, index)
    moved, left_rule = (
        any(getattr(step, name) for step in steps) for name in ("parameters_moved", "left_rule")
    )
    # Where each keeps the shape, all do up to their sum.
    residual = sum(step.residual for step in steps)
    if moved:
        residual = change_of_shape(view, now, np.sort(np.append(view.parameters, middles)))
    made = replace(steps[-1], residual=residual, parameters_moved=moved, left_rule=left_rule)
    return Halved(made, new, old)


def _middle(view: CurveView, segment: int) -> float:
    """Return the parameter between a point and the next one."""
    assert view.curve is not None
    places, end = view.curve.places, view.curve.domain[1]
    after = places[segment + 1] if segment + 1 < len(places) else end
    return float(places[segment] + after) / 2


def _shifted(points: frozenset[int], index: int) -> frozenset[int]:
    """Return the places of points after another one came before `index`."""
    return frozenset(each + (each >= index) for each in points)
