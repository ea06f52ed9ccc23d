"""What the window shows of one curve of the document."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
import numpy.typing as npt

from app.document.model import (
    AccelerationRule,
    Curve,
    Family,
    Node,
    Parametrization,
    ParametrizationKind,
    Vector,
    VelocityRule,
)
from curvecore import (
    CurveError,
    HermiteCurve,
    LagrangeCurve,
    QuinticHermiteCurve,
    bessel_velocities,
    catmull_rom_velocities,
    centripetal,
    chebyshev,
    chord_length,
    finite_difference_velocities,
    flatten_parameters,
    natural_spline_accelerations,
    natural_spline_velocities,
    power,
    uniform,
)

Floats = npt.NDArray[np.float64]
CoreCurve = LagrangeCurve | HermiteCurve | QuinticHermiteCurve
Box = tuple[float, float, float, float]

_PARAMETERS: dict[ParametrizationKind, Callable[[Floats, float], Floats]] = {
    ParametrizationKind.UNIFORM: lambda points, _: uniform(len(points)),
    ParametrizationKind.CHORD_LENGTH: lambda points, _: chord_length(points),
    ParametrizationKind.CENTRIPETAL: lambda points, _: centripetal(points),
    ParametrizationKind.POWER: power,
    ParametrizationKind.CHEBYSHEV: lambda points, _: chebyshev(len(points)),
}

_VELOCITIES: dict[VelocityRule, Callable[[Floats, Floats, float], Floats]] = {
    VelocityRule.NATURAL_SPLINE: lambda points, t, _: natural_spline_velocities(points, t),
    VelocityRule.BESSEL: lambda points, t, _: bessel_velocities(points, t),
    VelocityRule.FINITE_DIFFERENCE: lambda points, t, _: finite_difference_velocities(points, t),
    VelocityRule.CATMULL_ROM: catmull_rom_velocities,
}

_ACCELERATIONS: dict[AccelerationRule, Callable[[Floats, Floats], Floats]] = {
    AccelerationRule.NATURAL_SPLINE: natural_spline_accelerations,
    AccelerationRule.ZERO: lambda points, _: np.zeros_like(points),
}


@dataclass(frozen=True, eq=False)
class Polyline:
    """A curve as drawn: the parameters of its vertices (k,) and the vertices (k, 2)."""

    parameters: Floats
    points: Floats


@dataclass(frozen=True, eq=False)
class CurveView:
    """One curve of the document with everything that a canvas or panel draws of it.

    Attributes
    ----------
    source
        The document's value this was made from.
    points
        The nodes' positions, (n, 2).
    curve
        The core's curve; the last good one where the present nodes and rules give none, None where there
        never was one.
    problem
        Why the present nodes and rules give no curve, as a sentence; empty where they do.
    """

    source: Curve
    points: Floats
    curve: CoreCurve | None
    problem: str = ""
    _flattened: dict[tuple[float, Box | None], Polyline] = field(default_factory=dict)

    @property
    def is_current(self) -> bool:
        """Whether `curve` belongs to the present nodes and rules."""
        return self.curve is not None and not self.problem

    @property
    def parameters(self) -> Floats:
        """The parameters t_i of `curve`, empty without one."""
        return self.curve.parameters if self.curve is not None else np.empty(0)

    @cached_property
    def polyline(self) -> Floats:
        """The curve as a polyline (k, 2), within a thousandth of its size."""
        if self.curve is None:
            return np.empty((0, 2))
        size = float(np.ptp(self.points, axis=0).max()) if len(self.points) else 1.0
        return self.flattened(max(size, 1e-300) * 1e-3).points

    def flattened(self, tolerance: float, box: Box | None = None) -> Polyline:
        """Return the curve as a polyline within `tolerance` of it inside `box`."""
        key = (tolerance, box)
        if key not in self._flattened:
            self._flattened.clear()
            self._flattened[key] = _flatten(self.curve, tolerance, box)
        return self._flattened[key]

    def velocity_of(self, index: int) -> Vector | None:
        """Return the velocity at node `index`, set or estimated; None where the family has none."""
        return self._derivative(index, 1)

    def acceleration_of(self, index: int) -> Vector | None:
        """Return the acceleration at node `index`, set or estimated; None where the family has none."""
        return self._derivative(index, 2)

    def _derivative(self, index: int, order: int) -> Vector | None:
        if self.curve is None or not self.is_current or order > self.source.family.derivatives:
            return None
        x, y = self.curve.jets[index, order]
        return (float(x), float(y))

    def spacing(self, index: int, *, ahead: bool) -> float | None:
        """Return the length in t of the segment ahead of or behind node `index`, None beyond the ends."""
        t = self.parameters
        other = index + 1 if ahead else index - 1
        if not self.is_current or not 0 <= other < len(t):
            return None
        return abs(float(t[other] - t[index]))


def view_of(curve: Curve, previous: CurveView | None = None) -> CurveView:
    """Return the view of `curve`; `previous` lends the last good curve if there is none now."""
    points = np.array([(node.x, node.y) for node in curve.nodes], dtype=float).reshape(-1, 2)
    if len(points) < 2:
        return CurveView(curve, points, None, "A curve needs at least two points.")
    try:
        return CurveView(curve, points, _core_curve(curve, points))
    except CurveError as problem:
        last_good = previous.curve if previous is not None else None
        return CurveView(curve, points, last_good, _sentence(str(problem)))


def _core_curve(curve: Curve, points: Floats) -> CoreCurve:
    parameters = parameters_of(curve, points)
    if curve.family is Family.LAGRANGE:
        return LagrangeCurve(points, parameters)
    velocities = _with_explicit(
        _VELOCITIES[curve.velocity_rule](points, parameters, curve.parametrization.alpha),
        [node.velocity for node in curve.nodes],
    )
    if curve.family is Family.HERMITE:
        return HermiteCurve(points, velocities, parameters)
    accelerations = _with_explicit(
        _ACCELERATIONS[curve.acceleration_rule](points, parameters),
        [node.acceleration for node in curve.nodes],
    )
    return QuinticHermiteCurve(points, velocities, accelerations, parameters)


def parameters_of(curve: Curve, points: Floats) -> Floats:
    """Return the parameters t_i that the rule of `curve` gives for `points`, (n,)."""
    rule = curve.parametrization
    if rule.kind is ParametrizationKind.MANUAL:
        return np.array([np.nan if node.t is None else node.t for node in curve.nodes])
    return _onto_interval(_PARAMETERS[rule.kind](points, rule.alpha), rule)


def _onto_interval(parameters: Floats, rule: Parametrization) -> Floats:
    if (rule.start, rule.end) == (0.0, 1.0):
        return parameters
    mapped = rule.start + parameters * (rule.end - rule.start)
    mapped[-1] = rule.end
    return mapped


def _with_explicit(estimated: Floats, explicit: list[Vector | None]) -> Floats:
    result = np.array(estimated, dtype=float)
    for index, vector in enumerate(explicit):
        if vector is not None:
            result[index] = vector
    return result


def _flatten(curve: CoreCurve | None, tolerance: float, box: Box | None) -> Polyline:
    if curve is None:
        return Polyline(np.empty(0), np.empty((0, 2)))
    parameters = flatten_parameters(curve, tolerance, box)
    return Polyline(parameters, curve.evaluate(parameters))


def _sentence(text: str) -> str:
    text = text[:1].upper() + text[1:]
    return text if text.endswith(".") else text + "."


def appended_squeeze(before: CurveView, node: Node) -> float:
    """Return by which factor appending `node` squeezes the parameters of the points before it.

    One where the parameters stay, or where there is nothing to compare.
    """
    curve = before.source
    if curve.is_manual or not before.is_current or len(curve.nodes) < 2:
        return 1.0
    points = np.vstack([before.points, node.position])
    try:
        after = parameters_of(curve, points)
    except CurveError:
        return 1.0
    old = before.parameters
    return float((after[-2] - after[0]) / (old[-1] - old[0]))


def appended_parameter(before: CurveView, node: Node) -> float:
    """Return a manual parameter for a point appended to `before`: as fast as the curve so far."""
    t = before.parameters
    if len(t) == 0 or not before.is_current:
        given = [each.t for each in before.source.nodes if each.t is not None]
        return (given[-1] + 1.0) if given else before.source.parametrization.start
    chords = np.hypot(*np.diff(before.points, axis=0).T)
    new = float(np.hypot(*(np.array(node.position) - before.points[-1])))
    span = float(t[-1] - t[0])
    mean = span / (len(t) - 1)
    total = float(chords.sum())
    step = span * new / total if total > 0 else mean
    return float(t[-1]) + max(step, mean * 1e-3)
