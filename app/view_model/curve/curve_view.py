"""The view of one curve of the document: its core curve, polyline and derivatives, or why there is none.

`view_of` makes the view of a curve; it takes from the view before whatever did not change::

    view = view_of(curve)
    view.problem or view.curve.evaluate(0.5)
    moved = view_of(curve_after_a_drag, view)

While points are dragged, polylines and handles follow the points, and the core's curve is computed when
it is used.
"""

from __future__ import annotations

from functools import cached_property
from math import floor, log2
from operator import attrgetter

import msgspec
import numpy as np

from curvecore import CardinalBasis, CurveError, ParametricCurve
from curvecore.arrays import BoolArray, FloatArray

from ...document.model import Curve, Vector
from ...document.words import number
from ...families.family import OverdueCallError
from ..geometry import at_knots, size_of
from .core_curve import (
    Cardinal,
    Cardinals,
    CoreCurve,
    Sides,
    checked_parameters,
    core_curve,
    core_or_last,
    refusal_of,
)
from .moving import Box, Displacement, Flattener, FlatteningKey, MovingPoints, Polyline
from .point_arrays import PointArrays, arrays_of, rows_changed

__all__ = [
    "TOO_FEW",
    "Box",
    "CurveView",
    "ParametricCurve",
    "Polyline",
    "curve_through",
    "view_of",
]

TOO_FEW = "A curve needs at least two points."

_MOST_TOLERANCES = 2e4

_SAMPLES = 257

LINE = tuple(
    name
    for name in Curve.__struct_fields__
    if name not in ("name", "style", "shape", "groups", "visible", "locked", "other_settings")
)
"""Fields of a curve that shape its line."""

_runs = attrgetter(*LINE)


class CurveMap(msgspec.Struct, frozen=True, eq=False, gc=False):
    """The affine map x -> x A^T + b from the curve of another view to the curve of this one.

    Attributes
    ----------
    root
        The other view, whose curve is not itself the image of one.
    matrix
        A, (2, 2).
    shift
        b, (2,).
    stretch
        The largest factor by which the map makes lengths longer.
    """

    root: CurveView
    matrix: FloatArray
    shift: FloatArray
    stretch: float

    def polyline(self, tolerance: float) -> Polyline | None:
        """Return the mapped curve as a polyline; None where the visible part alone is flattened faster."""
        before = tolerance / self.stretch if self.stretch > 0.0 else 0.0
        low, high = self.root.drawn_box
        if not 0.0 < before >= float((high - low).max()) / _MOST_TOLERANCES:
            return None
        line = self.root.flattened(before)
        points = line.points @ self.matrix.T + self.shift
        return Polyline(line.parameters, points, line.deviation * self.stretch)


class CurveView(msgspec.Struct, frozen=True, eq=False, dict=True):
    """One curve of the document with all that a canvas or a panel draws of it.

    `curve` is the core's curve, `problem` says why there is none, `polyline` and `flattened` are what is
    drawn. While points are dragged and all else rests, and where all points were mapped, the polyline
    follows them, and the core's curve is computed only when it is used.

    Attributes
    ----------
    source
        The curve of the document.
    points
        The positions of the points, (n, 2).
    arrays
        All numbers in the points; the next view takes from here what stays.
    displacement
        The move of some points from those of a view before, where nothing else has changed.
    curve_map
        The map from the curve of another view, where all points were mapped with their curve.
    """

    source: Curve
    points: FloatArray
    arrays: PointArrays
    _ready: CoreCurve | None = None
    displacement: Displacement | None = None
    curve_map: CurveMap | None = None
    _flattener: Flattener = msgspec.field(default_factory=Flattener)
    _cardinals: Cardinals = msgspec.field(default_factory=Cardinals)
    _flattened: dict[FlatteningKey, Polyline] = msgspec.field(default_factory=dict)

    @cached_property
    def _core(self) -> CoreCurve:
        if self._ready is not None:
            return self._ready
        if self.curve_map is not None:
            return core_or_last(self.source, self.arrays, self.curve_map.root.curve)
        assert self.displacement is not None
        before = self.displacement.moving.curve
        return core_or_last(self.source, self.arrays, before, before)

    @property
    def is_followed(self) -> bool:
        """Whether the polyline follows moved points, and the core's curve has not been computed yet."""
        return self._ready is None and "_core" not in self.__dict__

    def settle(self) -> None:
        """Compute the core's curve: the drag is over, and all that is drawn becomes exact."""
        self._core  # noqa: B018 - cached

    @property
    def curve(self) -> ParametricCurve | None:
        """The core's curve.

        The last good one where the present points and rules give none, None where there never was one.
        """
        return self._core.curve

    @property
    def present_curve(self) -> ParametricCurve:
        """The curve of a view that has one."""
        assert self.curve is not None
        return self.curve

    @property
    def known_curve(self) -> ParametricCurve | None:
        """The core's curve, or one with the same functions if it has yet to be made."""
        return self.curve_map.root.curve if self.curve_map is not None and self.is_followed else self.curve

    @property
    def has_curve(self) -> bool:
        """Whether a curve can be drawn, the present or the last good one."""
        return self.is_followed or self._core.curve is not None

    @property
    def problem(self) -> str:
        """A sentence why the present points and rules give no curve; empty where they do."""
        return "" if self.is_followed else self._core.problem

    @property
    def is_overdue(self) -> bool:
        """Whether the curve is refused because functions of a file take too long."""
        return not self.is_followed and self._core.is_overdue

    @property
    def sides(self) -> Sides | None:
        """The jets before and after each knot, where the family has derivatives and `curve` is current."""
        return self._core.sides

    @property
    def is_current(self) -> bool:
        """Whether `curve` belongs to the present points and rules."""
        return self.is_followed or (self._core.curve is not None and not self._core.problem)

    @property
    def parameters(self) -> FloatArray:
        """The parameters of the knots of `curve`, empty without one."""
        if self.displacement is not None:
            return self.displacement.moving.curve.parameters
        return self.curve.parameters if self.curve is not None else np.empty(0)

    def t_text(self, t: float, mark: str = ".") -> str:
        """Return the text of a parameter, with digits to a thousandth of the interval, and to 1 at least."""
        start, end = self.parameters[[0, -1]].tolist() if len(self.parameters) else (0.0, 0.0)
        return number(t, mark=mark, step=min((end - start) / 1000.0, 1.0))

    @cached_property
    def ticks(self) -> FloatArray:
        """The parameters that the present rule gives, one for each knot; empty where it gives none.

        The family may refuse them: then `curve` has other parameters, or there is no curve.
        """
        if self.is_current:
            return self.parameters
        if not self.source.points:
            return np.empty(0)
        try:
            return checked_parameters(self.source, self.at_knots, self.arrays)
        except CurveError:
            return np.empty(0)

    @property
    def pieces(self) -> tuple[ParametricCurve, ...]:
        """The curves that `curve` is a chain of; one, unless it has corners."""
        return self.curve.pieces if self.curve is not None else ()

    @cached_property
    def basis_curve(self) -> ParametricCurve | None:
        """A curve with the basis functions of `curve`, one set for each knot: corners do not change them."""
        if self.displacement is not None:
            return self.displacement.moving.curve
        if self.curve is None or len(self.pieces) == 1:
            return self.curve
        nothing = np.zeros((len(self.parameters), self.curve.jets.shape[1], 2))
        return self.pieces[0].with_data(nothing, self.parameters)

    @property
    def at_knots(self) -> FloatArray:
        """The points' positions, of a closed curve the first one once more at the end, (k, 2)."""
        return at_knots(self.points, closed=self.source.is_closed)

    def owner(self, knot: int) -> int:
        """Return the point that a knot belongs to."""
        return knot % len(self.source.points)

    def spacing(self, index: int, *, ahead: bool) -> float | None:
        """Return the length in t of the segment ahead of or behind point `index`, None beyond the ends."""
        t = self.parameters
        if not self.is_current:
            return None
        if index == 0 and not ahead and self.source.is_closed:
            index = len(t) - 1
        other = index + 1 if ahead else index - 1
        return abs(float(t[other] - t[index])) if 0 <= other < len(t) else None

    @cached_property
    def corners(self) -> list[int]:
        """The points at which the curve may turn sharply; the ends of an open curve have one side only."""
        return self._with_two_sides(self.arrays.corners & ~self.arrays.ties)

    @cached_property
    def two_sided(self) -> list[int]:
        """The points with derivatives of their own on each side: corners, and where velocities are tied."""
        return self._with_two_sides(self.arrays.corners)

    def _with_two_sides(self, holds: BoolArray) -> list[int]:
        if not self.source.family.derivatives:
            return []
        last = len(self.points) - 1
        indices: list[int] = np.flatnonzero(holds).tolist()
        return [index for index in indices if self.source.is_closed or 0 < index < last]

    @property
    def cardinal(self) -> CardinalBasis | None:
        """The cardinal functions of the points of `curve`, with the estimates; None where there is no curve.

        Also None where the derivatives that a point carries along are beyond all floats.
        """
        return self._cardinal.functions if self.is_current else None

    @property
    def growth(self) -> float:
        """The Lebesgue constant of the points of a current curve; infinite where `cardinal` is None."""
        return self._cardinal.growth

    @cached_property
    def _cardinal(self) -> Cardinal:
        assert self.basis_curve is not None
        return self._cardinals.of(self.source, self.at_knots, self.basis_curve, self.arrays)

    @property
    def linearised(self) -> str:
        """A remark on the effects of points where estimates are not linear in them; else empty."""
        return next((rule.linearised for rule in self.source.rules if rule.linearised), "")

    @property
    def growth_holds(self) -> str:
        """The range where the growth of errors holds, if it differs for other points; else empty."""
        return next((rule.growth_holds for rule in self.source.rules if rule.growth_holds), "")

    @cached_property
    def polyline(self) -> FloatArray:
        """The curve as a polyline (k, 2), within a thousandth of its size."""
        return self._whole[0].points

    @cached_property
    def samples(self) -> FloatArray:
        """Positions at equally spaced parameters, (257, 2), by which a curve is compared with others.

        Curves of families that differ agree at few of them.
        """
        return self.present_curve.evaluate(np.linspace(self.parameters[0], self.parameters[-1], _SAMPLES))

    @cached_property
    def extent(self) -> FloatArray:
        """Lowest and highest corner of the points, and of the curve with them, (2, 2, 2)."""
        points = np.array([self.points.min(axis=0), self.points.max(axis=0)])
        if not len(self.polyline):
            return np.array([points, points])
        low, high = np.minimum(points[0], self.drawn_box[0]), np.maximum(points[1], self.drawn_box[1])
        return np.array([points, (low, high)])

    @cached_property
    def drawn_box(self) -> FloatArray:
        """Lowest and highest corner of the polyline of a curve that there is, (2, 2)."""
        return np.array([self.polyline.min(axis=0), self.polyline.max(axis=0)])

    @property
    def known_box(self) -> tuple[FloatArray, float] | None:
        """The box of the polyline, and the largest deviation of the curve; None before its first use."""
        if "drawn_box" not in self.__dict__ or not self._whole[1]:
            return None
        return self.drawn_box, self._whole[1]

    @property
    def whole_line(self) -> tuple[Polyline, float] | None:
        """The polyline with the tolerance that it keeps everywhere; None before its first use."""
        return self._whole if "_whole" in self.__dict__ and self._whole[1] else None

    def take_over(self, line: Polyline, tolerance: float, box: FloatArray, extent: FloatArray) -> None:
        """Set the polyline, the tolerance that it keeps everywhere, its box and its extent."""
        self.__dict__.update(_whole=(line, tolerance), drawn_box=box, extent=extent)

    @cached_property
    def _whole(self) -> tuple[Polyline, float]:
        """The polyline, and the tolerance that it keeps everywhere; none where it misses its own."""
        size = size_of(self.points) if len(self.points) else 1.0
        # A power of two: it stays while the curve is moved, and what follows the curve with it.
        tolerance = 2.0 ** floor(log2(max(size, 1e-300) * 1e-3))
        polyline = self.flattened(tolerance)
        return polyline, tolerance if polyline.reached <= tolerance else 0.0

    def flattened(self, tolerance: float, box: Box | None = None) -> Polyline:
        """Return the curve as a polyline within `tolerance` of it inside `box`.

        Where `polyline` is known and close enough it is the result: of thousands of curves that are small
        on the screen each is flattened once, for its box, and not again to be drawn.
        """
        if "_whole" in self.__dict__ and 0.0 < self._whole[1] <= tolerance:
            return self._whole[0]
        key = (tolerance, box)
        if key not in self._flattened:
            self._flattened.clear()
            moved = None if self.displacement is None else self.displacement.polyline(key)
            if self.curve_map is not None:
                moved = self.curve_map.polyline(tolerance)
            self._flattened[key] = moved or self._flattener.polyline(self.curve, key)
        return self._flattened[key]

    def velocity_of(self, index: int, *, ahead: bool = True) -> Vector | None:
        """Return the velocity at point `index`, set or estimated; None where the family has none.

        At a corner there are two, one before the point and one ahead of it.
        """
        return self.derivative_of(index, 1, ahead=ahead)

    def derivative_of(self, index: int, order: int, *, ahead: bool = True) -> Vector | None:
        """Return the derivative of an order at point `index`, set or estimated, as `velocity_of` does."""
        if self.sides is None or order > self.source.family.derivatives:
            return None
        x, y = self.sides[ahead][index, order]
        return (float(x), float(y))


def view_of(curve: Curve, previous: CurveView | None = None) -> CurveView:
    """Return the view of `curve`.

    `previous` lends what did not change, and the last good curve if there is none now. The result is the
    same as without it, bit for bit.
    """
    arrays = arrays_of(curve.points, previous.arrays if previous is not None else None)
    points = arrays.positions
    if len(curve.points) < 2:
        return CurveView(curve, points, arrays, CoreCurve(None, TOO_FEW))
    displacement = _displacement_of(curve, arrays, previous)
    if previous is not None and (displacement is not None or _lends(previous)):
        handed_on = (previous._flattener, previous._cardinals)
    else:
        handed_on = (Flattener(), Cardinals())
    if displacement is not None:
        return CurveView(curve, points, arrays, None, displacement, None, *handed_on)
    try:
        core = _core_of(curve, arrays, previous)
    except CurveError as problem:
        last_good = previous.curve if previous is not None else None
        words = refusal_of(problem, curve)
        is_overdue = isinstance(problem, OverdueCallError)
        if is_overdue and last_good is not None:
            words += " The last curve that could be drawn is shown."
        return CurveView(curve, points, arrays, CoreCurve(last_good, words, is_overdue=is_overdue))
    return CurveView(curve, points, arrays, core, None, None, *handed_on)


def same_line(curve: Curve, other: CurveView) -> CurveView | None:
    """Return the view of `curve` where it differs from a view's curve in its style and its name alone.

    It shares all that was computed of the other; None where the line of the curve may differ.
    """
    if other.displacement is not None or other.problem or not _lends(other):
        return None
    if _runs(curve) != _runs(other.source):
        return None
    view = CurveView(
        curve,
        other.points,
        other.arrays,
        other._ready,
        curve_map=other.curve_map,
        _cardinals=other._cardinals,
        _flattened=other._flattened,
    )
    view.__dict__.update(other.__dict__)
    return view


def _displacement_of(curve: Curve, arrays: PointArrays, previous: CurveView | None) -> Displacement | None:
    """Return the displacement of points since the view before; None where anything else has changed."""
    if previous is None or len(arrays.points) != len(previous.points):
        return None
    known = previous.displacement.moving.to(curve, arrays) if previous.displacement is not None else None
    return known or _first_displacement(curve, arrays, previous)


def _first_displacement(curve: Curve, arrays: PointArrays, previous: CurveView) -> Displacement | None:
    rows = rows_changed(arrays.points, previous.arrays.points)
    if (
        not rows
        or not all(rule.is_linear for rule in curve.rules)
        or _resting_parameters(curve, arrays, previous) is None
        or previous.curve is None
        or len(previous.pieces) > 1
    ):
        return None
    try:
        moves = MovingPoints(previous.source, previous.arrays, previous.curve, previous.sides, rows)
    except CurveError:
        return None
    return moves.to(curve, arrays) if moves.is_safe else None


def _lends(previous: CurveView) -> bool:
    """Whether results of the functions of a view can be used again: the functions are the same."""
    known = previous.known_curve
    return known is None or previous.source.family.makes(known)


def _core_of(curve: Curve, arrays: PointArrays, previous: CurveView | None) -> CoreCurve:
    knots = at_knots(arrays.positions, closed=curve.is_closed)
    parameters = _resting_parameters(curve, arrays, previous)
    if parameters is None:
        parameters = checked_parameters(curve, knots, arrays)
    if previous is not None and not _lends(previous):
        previous = None
    return core_curve(curve, knots, parameters, arrays, _same_parameters(curve, parameters, previous))


def _resting_parameters(curve: Curve, arrays: PointArrays, previous: CurveView | None) -> FloatArray | None:
    """Return the parameters of the view before where the rule and all that it depends on are the same."""
    if (
        previous is None
        or not previous.is_current
        or curve.parametrization != previous.source.parametrization
        or curve.parametrization.kind.depends_on_points
        or curve.is_closed != previous.source.is_closed
        or len(arrays.points) != len(previous.points)
        or arrays.times is not previous.arrays.times
    ):
        return None
    return previous.parameters


def _same_parameters(
    curve: Curve, parameters: FloatArray, previous: CurveView | None
) -> ParametricCurve | None:
    """Return the curve before if it has the same functions and parameters, and only other data."""
    if previous is None or not previous.is_current or previous.source.functions_key != curve.functions_key:
        return None
    old = previous.curve
    if old is None or len(old.pieces) > 1:
        return None
    is_same = old.parameters is parameters or np.array_equal(old.parameters, parameters)
    return old if is_same else None


def curve_through(view: CurveView, points: FloatArray, parameters: FloatArray) -> ParametricCurve:
    """Return the core curve through other points (k, 2), at parameters (k,), under the rules of a view."""
    result = core_curve(view.source, points, parameters, view.arrays).curve
    assert result is not None
    return result
