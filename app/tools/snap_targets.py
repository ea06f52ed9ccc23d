"""Targets of snapping: what each gesture can snap to, of the curves that there are."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence

import numpy as np
from msgspec.structs import replace

from ..document.constraints import ends_of, is_straight
from ..document.model import Vector
from ..view_model.curve.curve_view import CurveView
from ..view_model.curve.distances import NearestPoint
from .snapping import SnapKind, SnapPlaces, Targets

Moving = Mapping[int, Collection[int]]
"""Points that move along and are nothing to snap to, by their curves."""


def targets_of(
    views: Sequence[CurveView], curve: int, moving: Moving, place: int, kinds: Collection[SnapKind]
) -> Targets:
    """Collect what a point of a curve can snap to.

    Parameters
    ----------
    views, curve
        The curves, and which of them the point is of.
    moving
        What moves along.
    place
        The index of the point that is drawn or about to be added; −1 for what has no neighbours.
    kinds
        The kinds wanted; what is not wanted costs nothing.
    """
    own = moving.get(curve, ())
    beside = _neighbours(views[curve], own, place)
    # Not on a neighbour: two coincident points in a row have no distance to go by.
    targets = _targets(views, curve, {**moving, curve: {*own, *beside}}, beside, kinds)
    return _with_middles(targets, views, curve, moving) if SnapKind.MIDDLES in kinds else targets


def targets_of_handle(
    views: Sequence[CurveView], active: int, point: int, kinds: Collection[SnapKind]
) -> Targets:
    """Collect what the end of a handle of `point` can snap to: level with its point it is a flat tangent."""
    # Not on its own point: a handle of no length has no direction.
    return _targets(views, active, {active: {point}}, [point, *_neighbours(views[active], (), point)], kinds)


def _targets(
    views: Sequence[CurveView], curve: int, without: Moving, level: Sequence[int], kinds: Collection[SnapKind]
) -> Targets:
    """Collect curves that stay, and all points but those `without`; `level` are those whose heights count."""
    own = views[curve]
    others = [(place, view) for place, view in enumerate(views) if place != curve and view.source.visible]
    points, curves = [], []
    if SnapKind.POINTS in kinds:
        points = [
            _points(own, without.get(curve, ())),
            *(_points(view, without.get(place, ()), view.source.display_name) for place, view in others),
        ]
    if SnapKind.CURVES in kinds:
        curves = [
            (NearestPoint(view), view.source.display_name) for place, view in others if place not in without
        ]
    return Targets(tuple(points), _named(own, level) if SnapKind.LEVEL in kinds else (), tuple(curves))


def targets_of_side(
    views: Sequence[CurveView], active: int, moving: Moving, kinds: Collection[SnapKind]
) -> Targets:
    """Collect what a side of the box around `moving` can snap to: it meets points that it is level with."""
    points: tuple[tuple[Vector, str], ...] = ()
    if SnapKind.POINTS in kinds:
        for index, view in enumerate(views):
            if index == active or view.source.visible:
                rest = sorted({*range(len(view.points))}.difference(moving.get(index, ())))
                points += _named(view, rest, "" if index == active else view.source.display_name)
    return Targets(neighbours=points)


def _named(view: CurveView, indices: Sequence[int], of: str = "") -> tuple[tuple[Vector, str], ...]:
    points = view.source.points
    return tuple((points[index].position, _name(index, of)) for index in indices)


def _name(index: int, of: str) -> str:
    return f"point {index} of {of}" if of else f"point {index}"


def _points(view: CurveView, without: Collection[int], of: str = "") -> SnapPlaces:
    numbers = np.setdiff1d(np.arange(len(view.points)), np.array(sorted(without), dtype=np.intp))
    return SnapPlaces(view.points[numbers], lambda place: _name(int(numbers[place]), of))


def _neighbours(view: CurveView, moving: Collection[int], place: int) -> list[int]:
    if place < 0:
        return []
    count = len(view.source.points)
    beside = [place - 1, place + 1]
    if view.source.is_closed:
        beside = [index % count for index in beside]
    return [index for index in beside if 0 <= index < count and index not in moving]


def _with_middles(targets: Targets, views: Sequence[CurveView], curve: int, moving: Moving) -> Targets:
    """Return the targets with midpoints of segments; those of what moves are none."""
    found = list(_middles(views[curve], frozenset(moving.get(curve, ()))))
    for place, view in enumerate(views):
        if place != curve and view.source.visible:
            found += _middles(view, moving.get(place), view.source.display_name)
    return replace(targets, points=(*targets.points, *found))


def _middles(view: CurveView, own: Collection[int] | None, of: str = "") -> Iterator[SnapPlaces]:
    """Yield midpoints of segments of a curve; of the one worked on those that stay.

    `own` are its points that move; None for another curve, none of which does.
    """
    source, view_points = view.source, view.points
    count = len(view_points) if source.is_closed else len(view_points) - 1
    if not view.is_current or count < 1:
        return
    straight = [
        segment
        for segment in range(count)
        if is_straight(source, segment) and (own is None or not {*own} & {*ends_of(source, segment)})
    ]
    ends = np.array([ends_of(source, segment) for segment in straight], dtype=np.intp).reshape(-1, 2)
    places = [view_points[ends].mean(axis=1)]
    numbers = list(straight)
    if own is None and view.curve is not None and len(view.parameters) == count + 1:
        # A bent segment of the curve that is worked on may be another one when its points move.
        bent = sorted({*range(count)} - {*straight})
        t = view.parameters
        places.append(view.curve.evaluate((t[bent] + t[[each + 1 for each in bent]]) / 2))
        numbers += bent
    yield SnapPlaces(np.concatenate(places), lambda place: f"midpoint of {of or f'segment {numbers[place]}'}")
