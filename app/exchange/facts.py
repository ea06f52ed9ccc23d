"""What there is to know about each curve of a document, in numbers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from msgspec.structs import replace

from app.document.model import Curve, Document, Family, Parametrization
from app.exchange.drawing import ExchangeError, Floats, drawing_of, extent_of, too_much
from app.view_model.curve_view import CoreCurve, view_of
from app.view_model.growth import growth_of_data, growth_of_points
from curvecore import LagrangeCurve
from curvecore.scaling import LARGEST

LENGTH_TOLERANCE = 1e-9
"""Relative error that the arc length aims at."""

AMPLIFICATION_WORTH_A_WORD = 100.0
"""Lebesgue constant from which the growth of errors is mentioned."""

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(16)
_MOST_POINTS_EXAMINED = 500
_MOST_INTERVALS = 1 << 16
_DEEPEST = 30


class Length(NamedTuple):
    """An arc length, and about how wrong it may be."""

    value: float
    error: float


class Growth(NamedTuple):
    """Lebesgue constants: how many times errors can come out enlarged on the curve.

    Attributes
    ----------
    data
        Errors of the points, where velocities and accelerations stay.
    points
        Errors of the points, where those that are estimated follow them.
    """

    data: float
    points: float


@dataclass(frozen=True)
class CurveFacts:
    """Facts about one curve; those that need a curve are None where there is none.

    Attributes
    ----------
    name, family, parametrization
        As in the document.
    points
        Number of points.
    closed, visible
        Whether the curve returns to its first point, and whether it is drawn.
    corners
        How many points it may turn sharply at.
    degree
        Of the polynomial, or of each piece.
    domain
        First and last parameter.
    length
        Arc length over the domain, numerically. None too where it is beyond all floats, and for
        Lagrange curves of so many points that it would take minutes.
    lebesgue_constant
        How errors grow; None too for Lagrange curves of so many points that it would take minutes.
    box
        Left, bottom, right and top edge of the curve; about, within `RELATIVE_TOLERANCE` of its size.
    warnings
        Sentences.
    """

    name: str
    family: Family
    parametrization: Parametrization
    points: int
    degree: int | None = None
    domain: tuple[float, float] | None = None
    length: Length | None = None
    lebesgue_constant: Growth | None = None
    box: tuple[float, float, float, float] | None = None
    warnings: tuple[str, ...] = ()
    closed: bool = False
    corners: int = 0
    visible: bool = True


def facts_of(document: Document) -> tuple[CurveFacts, ...]:
    """Return the facts about every curve of a document."""
    return tuple(_curve_facts(curve) for curve in document.curves)


def _curve_facts(curve: Curve) -> CurveFacts:
    if reason := too_much(curve):
        return _facts_without_curve(curve, reason)
    view = view_of(curve)
    core = view.curve
    if core is None:
        return _facts_without_curve(curve, view.problem)
    box, warnings = _box(curve)
    growth = None if _is_slow(core) else Growth(growth_of_data(view), growth_of_points(view))
    return CurveFacts(
        name=curve.name,
        family=curve.family,
        parametrization=curve.parametrization,
        points=len(curve.nodes),
        degree=core.degree,
        domain=core.domain,
        length=_length(core),
        lebesgue_constant=growth,
        box=box,
        warnings=(*warnings, *_amplification(growth)),
        closed=curve.is_closed,
        corners=len(view.corners),
        visible=curve.visible,
    )


def _facts_without_curve(curve: Curve, reason: str) -> CurveFacts:
    return CurveFacts(
        curve.name,
        curve.family,
        curve.parametrization,
        len(curve.nodes),
        warnings=(reason,),
        visible=curve.visible,
    )


def _box(curve: Curve) -> tuple[tuple[float, float, float, float] | None, tuple[str, ...]]:
    """Return the edges of the curve and nothing to say, or no edges and the reason."""
    try:
        (outline,) = drawing_of(Document((replace(curve, visible=True),))).outlines
    except ExchangeError as problem:
        return None, (str(problem),)
    (left, bottom), (right, top) = extent_of(outline.control_points).tolist()
    return (left, bottom, right, top), ()


def _length(core: CoreCurve) -> Length | None:
    if _is_slow(core):
        return None
    length = arc_length(core, LENGTH_TOLERANCE)
    return length if np.isfinite(length.value) else None


def _is_slow(core: CoreCurve) -> bool:
    """Whether each of the many evaluations that a fact takes is itself a long sum."""
    return isinstance(core, LagrangeCurve) and len(core.points) > _MOST_POINTS_EXAMINED


def _amplification(growth: Growth | None) -> tuple[str, ...]:
    """Return a warning if small errors in the points grow along the curve."""
    if growth is None or growth.points < AMPLIFICATION_WORTH_A_WORD:
        return ()
    times = f"up to {growth.points:.2g}-fold" if growth.points < LARGEST else "beyond all bounds"
    return (f"Errors in the points grow {times} along the curve (Lebesgue constant).",)


def arc_length(core: CoreCurve, tolerance: float) -> Length:
    """Return the arc length of a curve over its domain.

    Gauss-Legendre quadrature with 16 nodes on every segment, halved where the halves disagree with the
    whole. At a cusp the speed has a kink, and the bounded number of halvings is what limits the accuracy;
    the error says so.

    Parameters
    ----------
    core
        A curve in the plane.
    tolerance
        Relative error aimed at.
    """
    low, high = core.parameters[:-1], core.parameters[1:]
    most = max(_MOST_INTERVALS, 4 * len(low))
    whole = _quadrature(core, low, high)
    total = error = 0.0
    for halvings_left in reversed(range(_DEEPEST)):
        middle = low + (high - low) / 2
        halves = np.stack([_quadrature(core, low, middle), _quadrature(core, middle, high)])
        better = halves.sum(axis=0)
        with np.errstate(invalid="ignore"):
            difference = np.abs(better - whole)
        rough = difference > tolerance * (total + better.sum()) / max(len(better), 64)
        if halvings_left == 0 or 2 * np.count_nonzero(rough) > most:
            rough[:] = False
        total += float(better[~rough].sum())
        error += float(difference[~rough].sum())
        if not rough.any():
            break
        low, high = np.concatenate([low[rough], middle[rough]]), np.concatenate([middle[rough], high[rough]])
        whole = halves[:, rough].ravel()
    return Length(total, error)


def lengths_between(core: CoreCurve, start: Floats, end: Floats | None = None) -> Floats:
    """Return the arc lengths from start (k,) to end (k,), by default between consecutive parameters.

    Sixteen Gauss-Legendre nodes on each stretch between joints, where the curve is one polynomial, and on
    its halves, and theirs, where they disagree: near a cusp the speed has a kink.
    """
    if end is None:
        start, end = start[:-1], start[1:]
    joints = core.parameters
    first = np.searchsorted(joints, start, side="right")
    count = np.maximum(np.searchsorted(joints, end, side="left") - first, 0) + 1
    interval = np.repeat(np.arange(len(start)), count)
    step = np.arange(len(interval)) - (np.cumsum(count) - count)[interval]
    place = first[interval] + step
    low = np.where(step == 0, start[interval], joints[np.minimum(place - 1, len(joints) - 1)])
    high = np.where(step == count[interval] - 1, end[interval], joints[np.minimum(place, len(joints) - 1)])
    total = np.zeros(len(start))
    whole = _quadrature(core, low, high)
    enough = LENGTH_TOLERANCE * whole.sum() / max(len(whole), 64)
    for _ in range(_DEEPEST):
        middle = low + (high - low) / 2
        halves = np.stack([_quadrature(core, low, middle), _quadrature(core, middle, high)])
        better = halves.sum(axis=0)
        rough = np.abs(better - whole) > enough
        total += np.bincount(interval[~rough], weights=better[~rough], minlength=len(start))
        if not rough.any():
            return total
        low, high = np.concatenate([low[rough], middle[rough]]), np.concatenate([middle[rough], high[rough]])
        whole, interval = halves[:, rough].ravel(), np.tile(interval[rough], 2)
    return total + np.bincount(interval, weights=whole, minlength=len(start))


def _quadrature(core: CoreCurve, low: Floats, high: Floats) -> Floats:
    """Return the integral of the speed over every interval (k,)."""
    half = (high - low) / 2
    t = (low + half)[:, None] + half[:, None] * _NODES
    velocity = core.evaluate(t.ravel(), 1)
    with np.errstate(over="ignore", under="ignore"):
        speed = np.hypot(velocity[:, 0], velocity[:, 1]).reshape(t.shape)
        return np.asarray(half * (speed @ _WEIGHTS))
