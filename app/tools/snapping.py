"""Snapping: targets near a point that is dragged or added, and the exact place of each."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from decimal import Decimal

import msgspec
import numpy as np
from msgspec.structs import replace

from curvecore.arrays import FloatArray

from ..document.model import Guide, Vector
from ..document.plane_edits import guide_label
from ..document.words import NamedEnum
from ..view_model.curve.distances import NearestPoint
from .offsets import in_steps, plus
from .pointer import Pointer

REACH = 8.0
"""Pixels within which something snaps."""


class SnapKind(NamedEnum):
    """Kind of thing to snap to."""

    GRID = "grid", "Grid"
    GUIDES = "guides", "Guides"
    POINTS = "points", "Other points"
    CURVES = "curves", "Other curves"
    MIDDLES = "middles", "Midpoints of segments"
    LEVEL = "level", "Align with neighbours"


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
        Its name, such as "point 3", "grid" (a crossing of it), "grid x" (one line), "guide x = 20",
        "level with point 2".
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

    points: tuple[SnapPlaces, ...] = ()
    neighbours: tuple[tuple[Vector, str], ...] = ()
    curves: tuple[tuple[NearestPoint, str], ...] = ()

    def with_places(self, places: Mapping[str, Vector]) -> Targets:
        """Return the targets with more places, by their names."""
        names = list(places)
        more = SnapPlaces(np.array(list(places.values())), lambda place: names[place])
        return replace(self, points=(*self.points, more))


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
        guides: Iterable[Guide] = (),
    ) -> None:
        self._settings, self._grid = settings, grid
        self._collect, self._guides = collect, tuple(guides)
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
    """Return where a line from a fixed position ends: with Ctrl or Shift its angle goes in steps of 15°."""
    if not pointer.holds_line:
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
