"""Snapping: the targets that attract a point that is dragged or added, and the exact position there.

`Snapper` snaps one point; `SnapTargets` makes the snapper of a gesture when that begins.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from decimal import Decimal
from operator import itemgetter

import msgspec
import numpy as np
from msgspec.structs import replace

from curvecore.arrays import FloatArray

from ..document.constraints import ends_of, is_straight
from ..document.model import Document, Guide, Vector
from ..document.plane_edits import guide_label
from ..document.point_group import PointGroup
from ..document.words import NamedEnum
from ..view_model.boxes import Bounds, nine_positions
from ..view_model.curve.curve_view import CurveView
from ..view_model.curve.distances import NearestPoint
from .box import Grip
from .editing_session import EditingSession
from .pointer import Pointer, in_steps, plus

REACH = 8.0
"""Pixels within which something snaps."""


class SnapKind(NamedEnum):
    """Kind of target."""

    GRID = "grid", "Grid"
    GUIDES = "guides", "Guides"
    POINTS = "points", "Other points"
    CURVES = "curves", "Other curves"
    MIDDLES = "middles", "Midpoints of segments"
    LEVEL = "level", "Alignment with neighbours"


class Snapping(msgspec.Struct, frozen=True):
    """Whether to snap, and the kinds of targets."""

    on: bool = False
    kinds: frozenset[SnapKind] = frozenset(SnapKind)


class Snap(msgspec.Struct, frozen=True):
    """A catch: the exact position on a target.

    Attributes
    ----------
    position
        The exact position.
    label
        Its name, such as "point 3", "grid" (a crossing of it), "grid x" (one line), "guide x = 20",
        "level with point 2".
    guides
        The points that it is level with or straight above; a line is drawn from each.
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
    """Return a sentence about a gesture, followed by its snap."""
    return f"{text} · snapped to: {caught.label}" if caught is not None and text else text


class SnapPoints(msgspec.Struct, frozen=True, eq=False):
    """Positions to snap to, (k, 2); `name` returns the label of each."""

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


class Targets(msgspec.Struct, frozen=True):
    """Targets of snapping besides the grid and the guides.

    Attributes
    ----------
    points
        Points of this and of other curves.
    neighbours
        The points whose heights and verticals count, with their names.
    curves
        The other curves with their names.
    """

    points: tuple[SnapPoints, ...] = ()
    neighbours: tuple[tuple[Vector, str], ...] = ()
    curves: tuple[tuple[NearestPoint, str], ...] = ()

    def with_positions(self, positions: Mapping[str, Vector]) -> Targets:
        """Return the targets with more places, by their names."""
        names = list(positions)
        more = SnapPoints(np.array(list(positions.values())), lambda index: names[index])
        return replace(self, points=(*self.points, more))


class Snapper:
    """Snapping of one point to the targets near it, with the last catch.

    ``snapper.snap(position, pointer)`` returns the position itself, or that of the nearest target within a
    few pixels, which is `caught` until the next question.

    Attributes
    ----------
    caught
        The catch of the last `snap`, None for none.
    """

    def __init__(
        self,
        settings: Callable[[], Snapping],
        grid: Callable[[], float],
        collect: Callable[[], Targets],
        guides: Iterable[Guide] = (),
    ) -> None:
        self._settings, self._grid = settings, grid
        self._collect, self._guides = collect, tuple(guides)
        self._targets: Targets | None = None
        self._asked: tuple[Vector, float, int | None, bool] | None = None
        self.caught: Snap | None = None

    def snap(self, position: Vector, pointer: Pointer, axis: int | None = None) -> Vector:
        """Return the position that `position` snaps to, itself if no target is near; `axis` restricts it."""
        # Whether to snap is asked each time: a key turns it on and off in mid-drag.
        question = (position, pointer.scale, axis, self._settings().on)
        if question != self._asked:
            # The same move asks more than once: for the document, and for the words about it.
            self._asked = question
            self.caught = self._find(position, REACH / pointer.scale, axis) if question[3] else None
        return self.caught.position if self.caught is not None else position

    def at(self, pointer: Pointer) -> Vector:
        """Return the position of the pointer, snapped."""
        return self.snap(pointer.position, pointer)

    def reset(self) -> None:
        """Forget the last catch."""
        self.caught = self._asked = None

    def _find(self, position: Vector, reach: float, axis: int | None) -> Snap | None:
        if self._targets is None:
            self._targets = self._collect()
        targets = self._targets
        if axis is not None:
            return self._on_lines(targets, position, reach, (axis,))
        on_points = (points.nearest(position, reach) for points in targets.points)
        on_curves = (_on_curve(curve, name, position, reach) for curve, name in targets.curves)
        return _nearest(on_points) or _nearest(on_curves) or self._on_lines(targets, position, reach, (0, 1))

    def _on_lines(self, targets: Targets, position: Vector, reach: float, axes: Sequence[int]) -> Snap | None:
        lines = {axis: self._line(targets, position, reach, axis) for axis in axes}
        caught = {axis: line for axis, line in lines.items() if line is not None}
        if not caught:
            return None
        x, y = (caught[axis].value if axis in caught else position[axis] for axis in (0, 1))
        by_grid = [axis for axis, line in caught.items() if line.is_grid]
        labels = [line.label for line in caught.values()]
        if len(by_grid) == 2:
            labels = ["grid"]
        guides = tuple(line.guide for line in caught.values() if line.guide is not None)
        grid_line = by_grid[0] if len(by_grid) == 1 else None
        return Snap((x, y), " · ".join(labels), guides, tuple(caught), grid_line)

    def _line(self, targets: Targets, position: Vector, reach: float, axis: int) -> _Line | None:
        """Return the coordinate to snap to along one axis: of a guide, of a neighbour, of the grid."""
        value, kinds = position[axis], self._settings().kinds
        guides = [
            _Line(guide.position, f"guide {guide_label(guide)}")
            for guide in self._guides
            if SnapKind.GUIDES in kinds and guide.axis.coordinate == axis
        ]
        level = [_level(at, name, position, axis) for at, name in targets.neighbours]
        grid = []
        if SnapKind.GRID in kinds:
            grid = [_Line(grid_value(value, self._grid()), f"grid {'xy'[axis]}", is_grid=True)]
        for lines in (guides, level, grid):
            near = [line for line in lines if abs(line.value - value) <= reach]
            if near:
                return min(near, key=lambda line: abs(line.value - value))
        return None


def stepped_from(fixed: Vector, pointer: Pointer, snapper: Snapper) -> Vector:
    """Return the end of a line from a fixed position: with Ctrl or Shift at a step of 15°."""
    if not pointer.is_constrained:
        return snapper.at(pointer)
    # An angle that is held leaves nothing to be drawn elsewhere.
    snapper.reset()
    return plus(fixed, in_steps(pointer.offset_from(fixed)))


def _on_curve(curve: NearestPoint, name: str, position: Vector, reach: float) -> tuple[float, Snap] | None:
    nearest = curve.within(position, reach)
    if nearest is None:
        return None
    x, y = nearest.point.tolist()
    return nearest.distance, Snap((x, y), name)


def _nearest(snaps: Iterable[tuple[float, Snap] | None]) -> Snap | None:
    """Return the snap with the least distance."""
    nearest = min((snap for snap in snaps if snap is not None), key=itemgetter(0), default=None)
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


# Targets of each gesture

Moving = Mapping[int, Collection[int]]
"""Points that move along and are no targets, by their curves."""


def targets_of(
    views: Sequence[CurveView], curve: int, moving: Moving, index: int, kinds: Collection[SnapKind]
) -> Targets:
    """Collect the targets of a point of a curve.

    Parameters
    ----------
    views, curve
        The curves, and which of them the point is of.
    moving
        What moves along.
    index
        The index of the point that is drawn or about to be added; −1 for what has no neighbours.
    kinds
        The kinds wanted; what is not wanted costs nothing.
    """
    along = moving.get(curve, ())
    beside = _neighbours(views[curve], along, index)
    # Not on a neighbour: two coincident points in a row have no distance to go by.
    targets = _targets(views, curve, {**moving, curve: {*along, *beside}}, beside, kinds)
    return _with_middles(targets, views, curve, moving) if SnapKind.MIDDLES in kinds else targets


def targets_of_handle(
    views: Sequence[CurveView], active: int, point: int, kinds: Collection[SnapKind]
) -> Targets:
    """Collect the targets of the end of a handle: level with its point it is a flat tangent."""
    # Not on its own point: a handle of no length has no direction.
    return _targets(views, active, {active: {point}}, [point, *_neighbours(views[active], (), point)], kinds)


def _targets(
    views: Sequence[CurveView], curve: int, without: Moving, level: Sequence[int], kinds: Collection[SnapKind]
) -> Targets:
    """Collect curves that stay, and all points but those `without`; `level` are those whose heights count."""
    view_of_curve = views[curve]
    others = [(other, view) for other, view in enumerate(views) if other != curve and view.source.visible]
    points, curves = [], []
    if SnapKind.POINTS in kinds:
        points = [
            _points(view_of_curve, without.get(curve, ())),
            *(_points(view, without.get(other, ()), view.source.display_name) for other, view in others),
        ]
    if SnapKind.CURVES in kinds:
        curves = [
            (NearestPoint(view), view.source.display_name) for other, view in others if other not in without
        ]
    return Targets(
        tuple(points), _named(view_of_curve, level) if SnapKind.LEVEL in kinds else (), tuple(curves)
    )


def targets_of_side(
    views: Sequence[CurveView], active: int, moving: Moving, kinds: Collection[SnapKind]
) -> Targets:
    """Collect the targets of a side of the box around `moving`: points that it is level with."""
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


def _points(view: CurveView, without: Collection[int], of: str = "") -> SnapPoints:
    numbers = np.setdiff1d(np.arange(len(view.points)), np.array(sorted(without), dtype=np.intp))
    return SnapPoints(view.points[numbers], lambda row: _name(int(numbers[row]), of))


def _neighbours(view: CurveView, moving: Collection[int], index: int) -> list[int]:
    if index < 0:
        return []
    count = len(view.source.points)
    beside = [index - 1, index + 1]
    if view.source.is_closed:
        beside = [neighbour % count for neighbour in beside]
    return [neighbour for neighbour in beside if 0 <= neighbour < count and neighbour not in moving]


def _with_middles(targets: Targets, views: Sequence[CurveView], curve: int, moving: Moving) -> Targets:
    """Return the targets with midpoints of segments, except those that move."""
    middles = list(_middles(views[curve], frozenset(moving.get(curve, ()))))
    for other, view in enumerate(views):
        if other != curve and view.source.visible:
            middles += _middles(view, moving.get(other), view.source.display_name)
    return replace(targets, points=(*targets.points, *middles))


def _middles(view: CurveView, moving: Collection[int] | None, of: str = "") -> Iterator[SnapPoints]:
    """Yield midpoints of segments of a curve; of the one worked on those that stay.

    `moving` are its points that move; None for another curve, none of which does.
    """
    source, view_points = view.source, view.points
    count = len(view_points) if source.is_closed else len(view_points) - 1
    if not view.is_current or count < 1:
        return
    straight = [
        segment
        for segment in range(count)
        if is_straight(source, segment) and (moving is None or not {*moving} & {*ends_of(source, segment)})
    ]
    ends = np.array([ends_of(source, segment) for segment in straight], dtype=np.intp).reshape(-1, 2)
    positions = [view_points[ends].mean(axis=1)]
    numbers = list(straight)
    if moving is None and view.curve is not None and len(view.parameters) == count + 1:
        # A bent segment of the curve that is worked on may be another one when its points move.
        bent = sorted({*range(count)} - {*straight})
        t = view.parameters
        positions.append(view.curve.evaluate((t[bent] + t[[segment + 1 for segment in bent]]) / 2))
        numbers += bent
    yield SnapPoints(np.concatenate(positions), lambda row: f"midpoint of {of or f'segment {numbers[row]}'}")


class SnapTargets:
    """Snappers of the gestures, each made when one begins.

    A press asks for one by its subject, such as ``event.snapping.for_points(group, grabbed)``; points that
    move along are no targets.

    Attributes
    ----------
    settings
        Whether to snap, and to what.
    now
        The snapper in use, None for none.
    """

    def __init__(self, session: EditingSession, grid: Callable[[], float]) -> None:
        self._session, self._grid = session, grid
        self.settings = Snapping()
        self.now: Snapper | None = None
        # The snapper of the last hover, and what it was made for.
        self._hovered: tuple[tuple[Document, int, int, Snapping], Snapper] | None = None

    @property
    def is_on(self) -> bool:
        """Whether points snap."""
        return self.settings.on

    def for_new_point(self, index: int) -> Snapper:
        """Return the snapper of a point that is added at `index`, −1 for the first of another curve."""
        # What there is before the press: later the new point would be drawn to itself.
        views, active = self._session.views, self._session.active_index
        return self._make(lambda: targets_of(views, active, {}, index, self.settings.kinds))

    def for_handle(self, point: int) -> Snapper:
        """Return the snapper of the end of a handle."""
        session = self._session
        return self._make(
            lambda: targets_of_handle(session.views, session.active_index, point, self.settings.kinds)
        )

    def for_points(self, group: PointGroup, grabbed: tuple[int, int] | None = None) -> Snapper:
        """Return the snapper of points that move together, of which the grabbed (curve, index) snaps."""
        session, moving = self._session, dict(group.parts)
        # Level with its neighbours is a point; of whole curves none has any that stay.
        curve, index = (session.active_index, -1) if grabbed is None or group.is_whole else grabbed
        views = session.views
        return self._make(lambda: targets_of(views, curve, moving, index, self.settings.kinds))

    def for_pivot(self, bounds: Bounds) -> Snapper:
        """Return the snapper of a pivot: it snaps also to the nine positions of the bounds."""
        views, active = self._session.views, self._session.active_index
        return self._make(
            lambda: targets_of(views, active, {}, -1, self.settings.kinds).with_positions(
                nine_positions(bounds)
            )
        )

    def for_grip(self, grip: Grip, group: PointGroup) -> Snapper:
        """Return the snapper of a corner or a side of the box around a group."""
        if grip.x and grip.y:
            return self.for_points(group)
        session, moving = self._session, dict(group.parts)
        views = session.views
        return self._make(lambda: targets_of_side(views, session.active_index, moving, self.settings.kinds))

    def for_guide(self) -> Snapper:
        """Return the snapper of a guide: points that it meets, and the grid."""
        session = self._session
        return self._make(
            lambda: targets_of_side(session.views, session.active_index, {}, self.settings.kinds), guides=()
        )

    def _make(self, collect: Callable[[], Targets], guides: Sequence[Guide] | None = None) -> Snapper:
        """Return a snapper to the targets of `collect` and to guides, by default those of the document."""
        # Guides as they are at the press.
        guides = self._session.document.guides if guides is None else guides
        self.now = Snapper(lambda: self.settings, self._grid, collect, guides)
        return self.now

    def show_before_press(self, pointer: Pointer, index: int) -> None:
        """Show the snap of a press at `pointer` that adds the point of index `index`."""
        session, settings = self._session, self.settings
        question = (session.document, session.active_index, index, settings)
        if self._hovered is None or self._hovered[0] != question:
            self._hovered = (question, self.for_new_point(index))
        self.now = self._hovered[1]
        self.now.at(pointer)

    @property
    def caught(self) -> Snap | None:
        """The catch of the snapper in use."""
        return self.now.caught if self.now is not None else None

    def reset(self) -> None:
        """Use no snapper."""
        self.now = None
