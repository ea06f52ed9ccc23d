"""Snapping: targets near a point that is dragged or added, and the exact place of each."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from decimal import Decimal

import msgspec
import numpy as np
from msgspec.structs import replace

from curvecore.arrays import FloatArray

from ..document.guide_edits import place_words
from ..document.model import Axis, Guide, Page, Vector
from ..document.transforms import decimal_sum
from ..document.words import NamedEnum
from ..view_model.curve_view import CurveView
from ..view_model.nearest import NearestPoint
from .pointer import Pointer

REACH = 8.0
"""Pixels within which something snaps."""


class SnapKind(NamedEnum):
    """Kind of thing to snap to."""

    GRID = "grid", "The grid"
    GUIDES = "guides", "Guides"
    PAGE = "page", "The page"
    POINTS = "points", "Other points"
    CURVES = "curves", "Other curves"
    LEVEL = "level", "Level or plumb with the neighbours"


class Snapping(msgspec.Struct, frozen=True):
    """The person's choice: whether to snap, and to what."""

    on: bool = False
    kinds: frozenset[SnapKind] = frozenset(SnapKind)


class Snap(msgspec.Struct, frozen=True):
    """A catch: the place that something has snapped to.

    Attributes
    ----------
    position
        The exact place.
    label
        Its name, such as "point 3", "grid" (a crossing of it), "grid x" (one line), "guide x = 20", "page
        left", "level with point 2".
    guides
        The points that the place is level with or straight above; a line is drawn from each.
    axes
        Which coordinates were caught.
    grid_line
        The coordinate that a line of the grid holds, None where it is none or a crossing.
    """

    position: Vector
    label: str
    guides: tuple[Vector, ...] = ()
    axes: tuple[int, ...] = (0, 1)
    grid_line: int | None = None


def with_snap(text: str, caught: Snap | None) -> str:
    """Return a sentence about a gesture, with what it has snapped to."""
    return f"{text} · snapped to: {caught.label}" if caught is not None and text else text


class SnapPlaces(msgspec.Struct, frozen=True, eq=False):
    """Places to snap to, (k, 2); `name` tells what each is called."""

    positions: FloatArray
    name: Callable[[int], str]

    def nearest(self, position: Vector, reach: float) -> tuple[float, Snap] | None:
        """Return the distance of the nearest point and a snap to it, None beyond `reach`."""
        if not len(self.positions):
            return None
        distances = np.hypot(*(self.positions - position).T)
        best = int(np.argmin(distances))
        if distances[best] > reach:
            return None
        x, y = self.positions[best].tolist()
        return float(distances[best]), Snap((x, y), self.name(best))


class _Line(msgspec.Struct, frozen=True):
    """A coordinate to snap to; a neighbour's has that as its `guide`."""

    value: float
    label: str
    guide: Vector | None = None
    is_grid: bool = False


class DrawnLine(msgspec.Struct, frozen=True):
    """A level or upright line of the drawing: a guide, an edge or a middle of the page.

    Attributes
    ----------
    kind
        What is snapped to with it.
    axis, value
        The coordinate that its points have in common, 0 or 1, and its value.
    label
        Its name.
    """

    kind: SnapKind
    axis: int
    value: float
    label: str

    @property
    def as_guide(self) -> Guide:
        """The same as a guide."""
        return Guide(list(Axis)[self.axis], self.value)


def lines_of_guides(guides: Sequence[Guide]) -> Iterator[DrawnLine]:
    """Yield the lines of guides that are level or upright."""
    for guide in guides:
        if not guide.lean:
            yield DrawnLine(
                SnapKind.GUIDES, guide.axis.coordinate, guide.position, f"guide {place_words(guide)}"
            )


def lines_of_page(page: Page | None) -> Iterator[DrawnLine]:
    """Yield the edges and the middles of a page: where two meet are its corners and its centre."""
    if page is None:
        return
    of_axes = ((page.x, page.width, ("left", "right")), (page.y, page.height, ("bottom", "top")))
    for axis, (start, size, (first, last)) in enumerate(of_axes):
        for name, way in ((first, 0.0), ("middle", size / 2), (last, size)):
            yield DrawnLine(SnapKind.PAGE, axis, decimal_sum(start, way), f"page {name}")


class Targets(msgspec.Struct, frozen=True):
    """Targets of snapping besides the grid and the lines of the drawing.

    Attributes
    ----------
    points
        Points of this and of other curves.
    neighbours
        The points whose heights and verticals count, with their names.
    curves
        The other curves with their names.
    """

    points: tuple[SnapPlaces, ...] = ()
    neighbours: tuple[tuple[Vector, str], ...] = ()
    curves: tuple[tuple[NearestPoint, str], ...] = ()

    def with_places(self, places: Mapping[str, Vector]) -> Targets:
        """Return the targets with more places, by their names."""
        names = list(places)
        more = SnapPlaces(np.array(list(places.values())), lambda place: names[place])
        return replace(self, points=(*self.points, more))


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
    return _targets(views, curve, {**moving, curve: {*own, *beside}}, beside, kinds)


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
            *(_points(view, without.get(place, ()), view.source.name) for place, view in others),
        ]
    if SnapKind.CURVES in kinds:
        curves = [(NearestPoint(view), view.source.name) for place, view in others if place not in without]
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
                points += _named(view, rest, "" if index == active else view.source.name)
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


class Snapper:
    """Snapping of one point to what is near, with what it caught last.

    Attributes
    ----------
    caught
        What the last `snap` caught, None for nothing.
    """

    def __init__(
        self,
        settings: Callable[[], Snapping],
        grid: Callable[[], float],
        collect: Callable[[], Targets],
        drawn: Iterable[DrawnLine] = (),
        leaning: Iterable[Guide] = (),
    ) -> None:
        self._settings, self._grid, self._collect, self._drawn = settings, grid, collect, tuple(drawn)
        self._leaning = tuple(leaning)
        self._targets: Targets | None = None
        self._asked: tuple[Vector, float, int | None, bool] | None = None
        self.caught: Snap | None = None

    def snap(self, position: Vector, pointer: Pointer, axis: int | None = None) -> Vector:
        """Return where `position` snaps to, itself if nothing is near; with `axis` only along that."""
        # Whether to snap is asked each time: a key turns it on and off in mid-drag.
        question = (position, pointer.scale, axis, self._settings().on)
        if question != self._asked:
            # The same move asks more than once: for the document, and for the words about it.
            self._asked = question
            self.caught = self._find(position, REACH / pointer.scale, axis) if question[3] else None
        return self.caught.position if self.caught is not None else position

    def at(self, pointer: Pointer) -> Vector:
        """Return where the pointer is, or what it snaps to."""
        return self.snap(pointer.position, pointer)

    def reset(self) -> None:
        """Forget what was caught."""
        self.caught = self._asked = None

    def _find(self, position: Vector, reach: float, axis: int | None) -> Snap | None:
        if self._targets is None:
            self._targets = self._collect()
        targets = self._targets
        if axis is not None:
            return self._on_lines(targets, position, reach, (axis,))
        on_points = (each.nearest(position, reach) for each in targets.points)
        on_curves = (_on_curve(curve, name, position, reach) for curve, name in targets.curves)
        return (
            _nearest(on_points)
            or _nearest(on_curves)
            or self._on_leaning(position, reach)
            or self._on_lines(targets, position, reach, (0, 1))
        )

    def _on_leaning(self, position: Vector, reach: float) -> Snap | None:
        """Return the place on a guide at an angle, or where one meets a guide or the page, if near."""
        kinds = self._settings().kinds
        if not self._leaning or SnapKind.GUIDES not in kinds:
            return None
        straight = [(line.as_guide, line.label) for line in self._drawn if line.kind in kinds]
        return on_leaning(self._leaning, straight, position, reach)

    def _on_lines(self, targets: Targets, position: Vector, reach: float, axes: Sequence[int]) -> Snap | None:
        lines = {axis: self._line(targets, position, reach, axis) for axis in axes}
        caught = {axis: line for axis, line in lines.items() if line is not None}
        if not caught:
            return None
        x = caught[0].value if 0 in caught else position[0]
        y = caught[1].value if 1 in caught else position[1]
        by_grid = [axis for axis, line in caught.items() if line.is_grid]
        labels = [line.label for line in caught.values()]
        if len(by_grid) == 2:
            labels = ["grid"]
        guides = tuple(line.guide for line in caught.values() if line.guide is not None)
        grid_line = by_grid[0] if len(by_grid) == 1 else None
        return Snap((x, y), " · ".join(labels), guides, tuple(caught), grid_line)

    def _line(self, targets: Targets, position: Vector, reach: float, axis: int) -> _Line | None:
        """Return the coordinate to snap to along one axis: of a drawn line, of a neighbour, of the grid."""
        value, kinds = position[axis], self._settings().kinds
        drawn = [
            _Line(line.value, line.label) for line in self._drawn if line.axis == axis and line.kind in kinds
        ]
        level = [_level(at, name, position, axis) for at, name in targets.neighbours]
        grid = []
        if SnapKind.GRID in kinds:
            grid = [_Line(grid_value(value, self._grid()), f"grid {'xy'[axis]}", is_grid=True)]
        for lines in (drawn, level, grid):
            near = [line for line in lines if abs(line.value - value) <= reach]
            if near:
                return min(near, key=lambda line: abs(line.value - value))
        return None


def on_leaning(
    leaning: Sequence[Guide], straight: Sequence[tuple[Guide, str]], position: Vector, reach: float
) -> Snap | None:
    """Return the nearest place on guides at an angle, or where one meets another line, where that is near."""
    lines = [(guide, f"guide {place_words(guide)}") for guide in leaning]
    near = [(guide, label) for guide, label in lines if guide.distance(position) <= reach]
    crossings = []
    for guide, label in near:
        for other, name in (*lines, *straight):
            meeting = guide.meeting(other)
            if meeting is not None and (away := math.dist(meeting, position)) <= reach:
                crossings.append((away, Snap(meeting, f"{label} · {name}")))
    if crossings:
        return _nearest(crossings)
    return _nearest((guide.distance(position), Snap(guide.nearest(position), label)) for guide, label in near)


def _on_curve(curve: NearestPoint, name: str, position: Vector, reach: float) -> tuple[float, Snap] | None:
    nearest = curve.within(position, reach)
    if nearest is None:
        return None
    x, y = nearest.point.tolist()
    return nearest.distance, Snap((x, y), name)


def _nearest(found: Iterable[tuple[float, Snap] | None]) -> Snap | None:
    """Return the nearest of what was found at some distances."""
    nearest = min((each for each in found if each is not None), key=lambda each: each[0], default=None)
    return nearest[1] if nearest is not None else None


def _level(at: Vector, name: str, position: Vector, axis: int) -> _Line:
    if axis == 1:
        return _Line(at[1], f"level with {name}", at)
    side = "above" if position[1] >= at[1] else "below"
    return _Line(at[0], f"straight {side} {name}", at)


def grid_value(value: float, spacing: float) -> float:
    """Return the multiple of `spacing` nearest to `value`, as the decimal number it is meant to be.

    The third line of a grid of 0.1 lies at 0.3, not at 0.1 · 3 = 0.30000000000000004.
    """
    return float(round(value / spacing) * Decimal(repr(spacing)))
