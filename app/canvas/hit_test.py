"""Hit test: the point, handle, curve or filled area under the pointer."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from msgspec.structs import replace

from curvecore.arrays import FloatArray

from ..document.groups import shape_ranges
from ..document.model import Vector
from ..document.point_group import PointGroup
from ..plotting.pixel_map import PixelMap
from ..tools.pointer import Hit, Part
from ..view_model.curve.curve_view import CurveView, ParametricCurve, Polyline
from ..view_model.curve.handles import NO_HANDLES, Handles
from ..view_model.geometry import is_inside, windings
from .shape_painting import line_of

POINT_REACH, HANDLE_REACH, CURVE_REACH = 12.0, 10.0, 8.0
"""Pixels from the pointer within which a point, a handle or a line is grabbed: beside a point, the point."""

_NEAR_ENOUGH = 0.5
_SLIDES, _SAMPLES = 3, 17
"""Rounds of the search, and samples of each: the piece that is left is below a part in 4096."""

_Near = tuple[Hit, float] | None
"""A hit with its distance in pixels, None for none within reach."""


def hit_test(
    pixel: Vector,
    pixel_map: PixelMap,
    view: CurveView,
    polyline: Polyline | None,
    selection: frozenset[int],
    handles: Handles,
    facing: Handles = NO_HANDLES,
) -> Hit | None:
    """Return the part of the active curve under `pixel`.

    A selected point comes before the handles of the selected points, then other points, the handles that face
    the selected ones, and the curve.
    """
    selected = _nearest_point(pixel, pixel_map, view, sorted(selection))
    handle = _nearest_handle(pixel, pixel_map, handles)
    if selected is not None and (handle is None or selected[1] <= handle[1]):
        return selected[0]
    point = _nearest_point(pixel, pixel_map, view, range(len(view.points)))
    if handle is not None:
        over = point[0].index if point is not None and point[0].index not in selection else -1
        return replace(handle[0], over=over)
    if point is not None:
        return point[0]
    if (facing_handle := _nearest_handle(pixel, pixel_map, facing)) is not None:
        return facing_handle[0]
    return _on_curve(pixel, pixel_map, view, polyline) if polyline is not None else None


def _nearest_point(pixel: Vector, pixel_map: PixelMap, view: CurveView, indices: Sequence[int]) -> _Near:
    if not len(indices):
        return None
    candidates = np.asarray(indices)
    away = pixel_map.points(view.points[candidates]) - pixel
    distances = np.hypot(away[:, 0], away[:, 1])
    # The last of coincident points wins: it is drawn on top.
    best = len(distances) - 1 - int(np.argmin(distances[::-1]))
    if distances[best] > POINT_REACH:
        return None
    index = int(candidates[best])
    return Hit(Part.POINT, index, view.source.points[index].position), float(distances[best])


def _nearest_handle(pixel: Vector, pixel_map: PixelMap, handles: Handles) -> _Near:
    if not len(handles):
        return None
    away = pixel_map.points(handles.positions) - pixel
    distances = np.hypot(away[:, 0], away[:, 1])
    best = int(np.argmin(distances))
    # Written so that NaN fails.
    if not distances[best] <= HANDLE_REACH:
        return None
    nearest = handles[best]
    hit = Hit(Part.HANDLE, nearest.index, nearest.position, ahead=nearest.ahead, order=nearest.order)
    return hit, float(distances[best])


class NearestPart(NamedTuple):
    """A point or a handle under the pointer, and how many pixels away it is."""

    hit: Hit
    distance: float


class PixelPoints:
    """Points of several curves in pixels, each curve with its index: one pass finds the nearest.

    Attributes
    ----------
    pixel_map
        The map from the plane to these pixels.
    """

    def __init__(self, views: Sequence[tuple[int, CurveView]], pixel_map: PixelMap) -> None:
        self.pixel_map, self._views = pixel_map, dict(views)
        self._pixels = pixel_map.points(np.concatenate([view.points for _, view in views]))
        counts = [len(view.points) for _, view in views]
        self._curves = np.repeat([curve_index for curve_index, _ in views], counts)
        self._indices = np.concatenate([np.arange(count) for count in counts])

    def nearest(self, pixel: Vector, preferred: PointGroup) -> NearestPart | None:
        """Return the point within reach that is nearest to `pixel`; of coincident ones a preferred one."""
        distances = np.hypot(*(self._pixels - pixel).T)
        minimum = float(distances.min(initial=math.inf))
        # Written so that NaN fails.
        if not minimum <= POINT_REACH:
            return None
        rows = np.flatnonzero(distances == minimum)
        nearest = list(zip(self._curves[rows].tolist(), self._indices[rows].tolist(), strict=True))
        is_preferred = (pair for pair in nearest if pair[1] in preferred.of(pair[0]))
        curve, index = next(is_preferred, nearest[-1])
        position = self._views[curve].source.points[index].position
        return NearestPart(Hit(Part.OTHER_POINT, index, position, curve=curve), minimum)


class EndFinder:
    """Finder of the ends of open curves that are visible and unlocked."""

    def __init__(self) -> None:
        self._views: Sequence[CurveView] = ()
        # Found at the first hit test, and valid as long as the views are the same.
        self._ends: list[Hit] | None = None

    def render(self, views: Sequence[CurveView]) -> None:
        """Find ends of these views from now on."""
        if views is not self._views:
            self._views, self._ends = views, None

    def nearest(self, active: int | None, pixel: Vector, pixel_map: PixelMap) -> NearestPart | None:
        """Return the end within reach of a point that is nearest to `pixel`, not one of the active curve."""
        if self._ends is None:
            self._ends = [end for index, view in enumerate(self._views) for end in _ends(index, view)]
        others = [end for end in self._ends if end.curve != active]
        if not others:
            return None
        distances = np.hypot(*(pixel_map.points(np.array([end.position for end in others])) - pixel).T)
        best = int(np.argmin(distances))
        # Written so that NaN fails.
        return NearestPart(others[best], float(distances[best])) if distances[best] <= POINT_REACH else None


def _ends(index: int, view: CurveView) -> list[Hit]:
    """Return the ends of a curve that can be continued."""
    curve = view.source
    if curve.is_closed or not curve.is_selectable or not view.has_curve:
        return []
    ends = (0, len(curve.points) - 1)
    return [Hit(Part.OTHER_END, end, curve.points[end].position, curve=index) for end in ends]


def handle_or_point(
    pixel: Vector,
    pixel_map: PixelMap,
    point: NearestPart | None,
    handles: Sequence[tuple[int, Handles]],
    facing: Sequence[tuple[int, Handles]],
    selected: PointGroup,
) -> NearestPart | None:
    """Return the nearest point of some curves, or one of their handles, where that comes first in `hit_test`.

    `handles` are those of the selected points of each curve; `facing` those of their neighbours.
    """
    is_selected = point is not None and point.hit.index in selected.of(point.hit.curve)
    handle = _nearest_of(pixel, pixel_map, handles)
    if handle is not None and not (is_selected and point is not None and point.distance <= handle.distance):
        is_over = point is not None and not is_selected and point.hit.curve == handle.hit.curve
        over = point.hit.index if point is not None and is_over else -1
        return NearestPart(replace(handle.hit, over=over), handle.distance)
    return point or _nearest_of(pixel, pixel_map, facing)


def _nearest_of(
    pixel: Vector, pixel_map: PixelMap, handles: Sequence[tuple[int, Handles]]
) -> NearestPart | None:
    """Return the nearest handle of some curves within reach."""
    nearest_handles = [
        NearestPart(replace(nearest[0], curve=curve), nearest[1])
        for curve, handles_of_curve in handles
        if (nearest := _nearest_handle(pixel, pixel_map, handles_of_curve)) is not None
    ]
    return min(nearest_handles, key=lambda handle: handle.distance, default=None)


def nearer(nearest: NearestPart | None, hit: Hit | None, pixel: Vector, pixel_map: PixelMap) -> Hit | None:
    """Return a point or handle of another curve, where it is nearer than the one that is hit."""
    if nearest is None:
        return hit
    is_part = hit is not None and hit.part is not Part.CURVE
    away = math.dist(pixel_map.point(*hit.position), pixel) if hit is not None and is_part else math.inf
    return nearest.hit if nearest.distance < away else hit


def _on_curve(pixel: Vector, pixel_map: PixelMap, view: CurveView, polyline: Polyline) -> Hit | None:
    if view.curve is None or not view.is_current or len(polyline.points) < 2:
        return None
    nearest = PixelOutline([pixel_map.points(polyline.points)]).nearest(pixel)
    if nearest is None or nearest.distance > CURVE_REACH:
        return None
    t0, t1 = polyline.parameters[nearest.segment : nearest.segment + 2]
    t = float(t0 + nearest.share * (t1 - t0))
    x, y = view.curve.evaluate(t)
    if np.hypot(*np.subtract(pixel_map.point(float(x), float(y)), pixel)) > nearest.distance + _NEAR_ENOUGH:
        # On a straight piece the polyline knows the line, not the speed along it.
        t = _slid(view.curve, pixel_map, pixel, (float(t0), float(t1)))
    t = _nearer(view.curve, pixel_map.plane(*pixel), t, (float(t0), float(t1)))
    x, y = view.curve.evaluate(t)
    index = int(np.searchsorted(view.parameters, t))
    return Hit(Part.CURVE, max(index, 1), (float(x), float(y)), t=t)


def _nearer(curve: ParametricCurve, position: Vector, t: float, between: tuple[float, float]) -> float:
    """Return `t` after one Newton step towards the nearest point of the curve itself, not of its polyline."""
    velocity = curve.evaluate(t, 1)
    squared = float(velocity @ velocity)
    # Written so that NaN fails.
    if not 0.0 < squared < math.inf:
        return t
    step = float((np.array(position) - curve.evaluate(t)) @ velocity) / squared
    return min(max(t + step, between[0]), between[1])


def _slid(curve: ParametricCurve, pixel_map: PixelMap, pixel: Vector, between: tuple[float, float]) -> float:
    """Return the t in an interval at which the curve is nearest to a pixel, to a fraction of a pixel."""
    share = 0.5
    for _ in range(_SLIDES):
        t = np.linspace(*between, _SAMPLES)
        nearest = PixelOutline([pixel_map.points(curve.evaluate(t))]).nearest(pixel)
        assert nearest is not None
        between, share = (float(t[nearest.segment]), float(t[nearest.segment + 1])), nearest.share
    return between[0] + share * (between[1] - between[0])


class NearestSegment(NamedTuple):
    """The segment nearest to a pixel, the share of its length at which it is nearest, and the distance."""

    segment: int
    share: float
    distance: float


class PixelOutline:
    """Segments of polylines in pixels, numbered one polyline after the other: one pass finds the nearest."""

    def __init__(self, polylines: Sequence[FloatArray]) -> None:
        # Far vertices would overflow when squared; no pointer reaches beyond this limit.
        clipped = [np.clip(points, -1e9, 1e9) for points in polylines]
        self._starts = np.vstack([points[:-1] for points in clipped])
        self._along = np.vstack([np.diff(points, axis=0) for points in clipped])
        squared = (self._along**2).sum(axis=1)
        self._squared = np.where(squared > 0, squared, 1.0)

    def nearest(self, pixel: Vector) -> NearestSegment | None:
        """Return the segment nearest to `pixel`, the last of several; None without segments."""
        if not len(self._starts):
            return None
        away = np.asarray(pixel) - self._starts
        shares = np.clip((away * self._along).sum(axis=1) / self._squared, 0.0, 1.0)
        gaps = away - shares[:, None] * self._along
        distances = np.hypot(gaps[:, 0], gaps[:, 1])
        best = len(distances) - 1 - int(np.argmin(distances[::-1]))
        return NearestSegment(best, float(shares[best]), float(distances[best]))


_ANYWHERE = np.array([[-np.inf, -np.inf], [np.inf, np.inf]])

_OUTWARD = np.array([[-1.0], [1.0]])
"""Directions in which the corners of a box move when it grows."""


class LineFinder:
    """Finder of the curve under a pixel, among curves with their indices in the document."""

    def __init__(self) -> None:
        self._views: Sequence[tuple[int, CurveView]] = ()
        # Computed at the first hit test.
        self._outline: _Outline | None = None

    def render(self, views: Sequence[tuple[int, CurveView]]) -> None:
        """Find these curves from now on."""
        self._views, self._outline = views, None

    def hit(self, pixel: Vector, pixel_map: PixelMap) -> Hit | None:
        """Return the curve at `pixel`, the last one where several lie."""
        if not self._views:
            return None
        if self._outline is None or self._outline.pixel_map is not pixel_map:
            self._outline = _Outline(self._views, pixel_map)
        return self._outline.hit(pixel)


class _Outline:
    """Curves as lines of pixels; only curves whose boxes are near the pixel are tested."""

    def __init__(self, views: Sequence[tuple[int, CurveView]], pixel_map: PixelMap) -> None:
        self.pixel_map, self._views = pixel_map, views
        boxes, off = zip(*(_box_of(view) for _, view in views), strict=True)
        self._boxes = np.array(boxes) + np.array(off)[:, None, None] * _OUTWARD
        self._near: list[int] = []
        self._segments: PixelOutline | None = None
        self._curve_indices = np.empty(0, dtype=np.intp)

    def hit(self, pixel: Vector) -> Hit | None:
        """Return the curve within reach that is nearest."""
        self._look_near(pixel)
        nearest = None if self._segments is None else self._segments.nearest(pixel)
        if nearest is None or nearest.distance > CURVE_REACH:
            return None
        return Hit(Part.OTHER_CURVE, int(self._curve_indices[nearest.segment]), self.pixel_map.plane(*pixel))

    def _look_near(self, pixel: Vector) -> None:
        position = self.pixel_map.plane(*pixel)
        reach = (CURVE_REACH + 1.0) / np.array([self.pixel_map.sx, self.pixel_map.sy])
        low, high = self._boxes[:, 0] - reach, self._boxes[:, 1] + reach
        near = np.flatnonzero(((low <= position) & (position <= high)).all(axis=1)).tolist()
        if near != self._near:
            self._near = near
            polylines = [pixels_of(self._views[row][1], self.pixel_map) for row in near]
            self._segments = PixelOutline(polylines) if near else None
            self._curve_indices = np.repeat(
                [self._views[row][0] for row in near], [len(polyline) - 1 for polyline in polylines]
            )


def _box_of(view: CurveView) -> tuple[FloatArray, float]:
    """Return a box, and a bound of the distance by which the curve leaves it."""
    view.drawn_box  # noqa: B018 - with it the box is known, if it can be
    return view.known_box or (_ANYWHERE, 0.0)


def pixels_of(view: CurveView, pixel_map: PixelMap) -> FloatArray:
    """Return the curve as a polyline in pixels."""
    return pixel_map.points(line_of(view, pixel_map).points)


class FilledAreas:
    """Filled shapes that are visible and unlocked, and the boxes around them.

    A locked shape is ignored, as the paper is.
    """

    def __init__(self) -> None:
        self._views: Sequence[CurveView] = ()
        # Computed at the first hit test, and valid as long as the views are the same.
        self._shapes: list[range] | None = None
        self._boxes = np.empty((0, 2, 2))

    def render(self, views: Sequence[CurveView]) -> None:
        """Use the areas of these views from now on."""
        if views is not self._views:
            self._views, self._shapes = views, None

    def hit(self, pixel: Vector, pixel_map: PixelMap, active: int | None, line: Hit | None) -> Hit | None:
        """Return the topmost area at `pixel`, or the `line` there unless the area covers it.

        The inside of the edited shape is no hit: a press there begins a rubber band for its points.
        """
        top = self._topmost(pixel, pixel_map)
        if top is None or (line is not None and line.index >= top.start):
            return line
        if active in top:
            return None
        return Hit(Part.OTHER_CURVE, top.start, pixel_map.plane(*pixel), inside=True)

    def _topmost(self, pixel: Vector, pixel_map: PixelMap) -> range | None:
        if self._shapes is None:
            self._find()
        assert self._shapes is not None
        position = np.array([pixel_map.plane(*pixel)])
        is_around = np.all((self._boxes[:, 0] <= position) & (position <= self._boxes[:, 1]), axis=1)
        for number in reversed(np.flatnonzero(is_around).tolist()):
            views = self._drawn(self._shapes[number])
            turns = windings([line_of(view, pixel_map).points for view in views], position)
            if is_inside(turns, views[0].source.style.fill_rule)[0]:
                return self._shapes[number]
        return None

    def _find(self) -> None:
        curves = [view.source for view in self._views]
        shapes = [(curves[indices.start], indices) for indices in shape_ranges(curves)]
        filled = [indices for first, indices in shapes if first.style.has_fill and first.is_selectable]
        self._shapes = [indices for indices in filled if self._drawn(indices)]
        self._boxes = np.array([self._box(indices) for indices in self._shapes]).reshape(-1, 2, 2)

    def _drawn(self, indices: range) -> list[CurveView]:
        return [self._views[index] for index in indices if self._views[index].has_curve]

    def _box(self, indices: range) -> FloatArray:
        first, *others = [view.drawn_box for view in self._drawn(indices)]
        if not others:
            return first
        corners = np.vstack([first, *others])
        return np.array([corners.min(axis=0), corners.max(axis=0)])
