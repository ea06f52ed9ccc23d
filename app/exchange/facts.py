"""What there is to know about each curve of a document, in numbers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from app.document.model import Curve, Document, Family, Parametrization
from app.exchange.drawing import ExchangeError, frame_around, refuse_wild, too_much
from app.exchange.progress import Report, silent
from app.view_model.arc_lengths import arc_lengths_of
from app.view_model.curve_view import CoreCurve, view_of
from app.view_model.growth import growth_of_data, growth_of_points
from curvecore import LagrangeCurve, Length, bounding_box
from curvecore.scaling import LARGEST

LENGTH_TOLERANCE = 1e-9
"""Error that arc lengths aim at, against the whole length."""

AMPLIFICATION_WORTH_A_WORD = 100.0
"""Lebesgue constant from which the growth of errors is mentioned."""

_MOST_POINTS_EXAMINED = 500


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
        Arc length over the domain, with a bound of its error. None too where it is beyond all floats, and
        for Lagrange curves of so many points that it would take long.
    lebesgue_constant
        How errors grow; None too for Lagrange curves of so many points that it would take minutes.
    box
        Left, bottom, right and top edge of the curve.
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


def facts_of(document: Document, report: Report = silent) -> tuple[CurveFacts, ...]:
    """Return the facts about every curve of a document; `report` hears how far it has come."""
    facts = []
    for index, curve in enumerate(document.curves):
        report(index / len(document.curves), "Examining curves")
        facts.append(_curve_facts(curve))
    report(1.0, "Examining curves")
    return tuple(facts)


def _curve_facts(curve: Curve) -> CurveFacts:
    if reason := too_much(curve):
        return _facts_without_curve(curve, reason)
    view = view_of(curve)
    core = view.curve
    if core is None:
        return _facts_without_curve(curve, view.problem)
    box, warnings = _box(curve, core)
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


def _box(curve: Curve, core: CoreCurve) -> tuple[tuple[float, float, float, float] | None, tuple[str, ...]]:
    """Return the edges of the curve and nothing to say, or no edges and the reason."""
    box = bounding_box(core)
    corners = np.array([box.minimum, box.maximum])
    try:
        refuse_wild(curve, corners)
        frame_around([corners])
    except ExchangeError as problem:
        return None, (str(problem),)
    left, bottom, right, top = corners.ravel().tolist()
    return (left, bottom, right, top), ()


def _length(core: CoreCurve) -> Length | None:
    if _is_slow(core):
        return None
    length = arc_lengths_of(core, LENGTH_TOLERANCE).total
    return length if length.value < np.finfo(float).max else None


def _is_slow(core: CoreCurve) -> bool:
    """Whether each of the many evaluations that a fact takes is itself a long sum."""
    return isinstance(core, LagrangeCurve) and len(core.points) > _MOST_POINTS_EXAMINED


def _amplification(growth: Growth | None) -> tuple[str, ...]:
    """Return a warning if small errors in the points grow along the curve."""
    if growth is None or growth.points < AMPLIFICATION_WORTH_A_WORD:
        return ()
    times = f"up to {growth.points:.2g}-fold" if growth.points < LARGEST else "beyond all bounds"
    return (f"Errors in the points grow {times} along the curve (Lebesgue constant).",)
