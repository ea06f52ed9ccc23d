"""Facts about each curve of a document, in numbers."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import chain
from typing import NamedTuple

import numpy as np

from curvecore import Length
from curvecore.analysis.bounding_boxes import Box, bounding_boxes
from curvecore.arithmetic import LARGEST, SMALLEST
from curvecore.bezier.pieces import FINE, BezierPieces, bezier_pieces

from ..document.model import Curve, Document, Parametrization
from ..document.style import PLAIN_STYLE, Style
from ..families import Family, FamilySetting, SettingValue
from ..tasks.progress import Report, silent
from ..view_model.arc_lengths import lengths_of
from ..view_model.basis import growth_of_data, growths_of_points
from ..view_model.curve.curve_view import CurveView, ParametricCurve, view_of
from ..view_model.curve.rounded_parameters import ParameterRounding
from ..view_model.extents import around_dot
from .drawing.drawing import complexity_problem, refuse_out_of_range
from .drawing.outlines import frame_around
from .errors import ExchangeError

LENGTH_TOLERANCE = 1e-9
"""Error that arc lengths aim at, against the whole length."""

AMPLIFICATION_WORTH_A_WORD = 100.0
"""Lebesgue constant from which the growth of errors is mentioned."""

_POINTS_AT_ONCE = 2000
"""Points of the curves that are worked on together: some megabytes."""


class LebesgueConstants(NamedTuple):
    """Lebesgue constants: factors by which errors can grow on the curve.

    Attributes
    ----------
    data
        Growth of errors of the points where velocities and accelerations stay.
    points
        Growth of errors of the points where estimated derivatives follow them.
    holds
        Validity of the constant of the points, where other points have another one; else empty.
    """

    data: float
    points: float
    holds: str = ""


@dataclass(frozen=True)
class CurveFacts:
    """Facts about one curve; those that need a curve are None where there is none.

    Attributes
    ----------
    name, family, parametrization
        As in the document.
    settings
        All settings of the family, by their records.
    points
        Number of points.
    style
        Stroke and fill.
    closed, visible
        Whether the curve returns to its first point, and whether it is drawn.
    shape, groups
        Names of the shape and of the groups that it is in, the outermost first.
    corners
        Number of corners.
    smooth
        Number of points with one direction but a speed for each side.
    degree
        Degree of the polynomial, or of each piece.
    kind
        Name of its functions where they are no polynomials; empty where it is unknown.
    difference_digits
        Digits of the first derivatives where these are differences of values; otherwise empty.
    pieces
        Number of pieces; 0 without a curve.
    domain
        First and last parameter.
    length
        Arc length over the domain, with a bound of its error; also None beyond all floats.
    lebesgue_constant
        Growth of errors; `LARGEST` or more is beyond all floats.
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
    kind: str = ""
    difference_digits: tuple[int, ...] = ()
    pieces: int = 0
    domain: tuple[float, float] | None = None
    length: Length | None = None
    lebesgue_constant: LebesgueConstants | None = None
    box: tuple[float, float, float, float] | None = None
    warnings: tuple[str, ...] = ()
    closed: bool = False
    corners: int = 0
    smooth: int = 0
    visible: bool = True
    style: Style = PLAIN_STYLE
    shape: str = ""
    groups: tuple[str, ...] = ()
    settings: Mapping[FamilySetting, SettingValue] = field(default_factory=dict)


def facts_of(document: Document, report: Report = silent) -> tuple[CurveFacts, ...]:
    """Return the facts about every curve of a document; `report` is called with the progress."""
    facts: list[CurveFacts] = []
    for curves in _blocks(document.curves):
        shapes = []
        for index, curve in enumerate(curves, start=len(facts)):
            report(index / len(document.curves), "Examining curves")
            shapes.append(_shape_of(curve))
        facts += _facts_of_block(curves, shapes)
    report(1.0, "Examining curves")
    return tuple(facts)


def _blocks(curves: Sequence[Curve]) -> Iterator[list[Curve]]:
    """Divide curves into blocks that are computed together, as calls cost more than small curves."""
    block: list[Curve] = []
    points = 0
    for curve in curves:
        block.append(curve)
        points += len(curve.points)
        if points >= _POINTS_AT_ONCE:
            yield block
            block, points = [], 0
    if block:
        yield block


class _Shape(NamedTuple):
    """A curve that can be computed.

    Attributes
    ----------
    curve
        The document's value.
    view, core
        The computed curve.
    pieces
        Bézier pieces of `core`, of which box and length are made.
    rounding
        Rounding of its parameters.
    """

    curve: Curve
    view: CurveView
    core: ParametricCurve
    pieces: BezierPieces
    rounding: ParameterRounding


def _shape_of(curve: Curve) -> _Shape | str:
    """Return the computed parts of a curve, or the reason why it cannot be computed."""
    if reason := complexity_problem(curve):
        return reason
    view = view_of(curve)
    if view.curve is None:
        return view.problem
    return _Shape(curve, view, view.curve, bezier_pieces(view.curve), ParameterRounding(view))


def _facts_of_block(curves: Sequence[Curve], shapes: Sequence[_Shape | str]) -> Iterator[CurveFacts]:
    """Yield the facts about curves; expensive ones are computed for all of them together."""
    good = {index: shape for index, shape in enumerate(shapes) if not isinstance(shape, str)}
    usable = [*good.values()]
    around = bounding_boxes([shape.core for shape in usable], [shape.pieces for shape in usable])
    boxes = dict(zip(good, around, strict=True))
    constants_of_shapes = dict(zip(good, _lebesgue_constants([shape.view for shape in usable]), strict=True))
    lengths = dict(zip(good, _lengths(usable, [*constants_of_shapes.values()]), strict=True))
    for index, (curve, shape) in enumerate(zip(curves, shapes, strict=True)):
        if isinstance(shape, str):
            yield replace(_facts_of_points(curve), warnings=(shape,))
        else:
            yield _facts_with_curve(shape, boxes[index], lengths[index], constants_of_shapes[index])


def _facts_with_curve(shape: _Shape, around: Box, length: Length, constants: LebesgueConstants) -> CurveFacts:
    curve, core = shape.curve, shape.core
    box, warnings = _edges(curve, around)
    return replace(
        _facts_of_points(curve),
        degree=core.degree,
        kind=core.kind,
        difference_digits=core.pieces[0].difference_digits,
        pieces=len(core.breaks) - 1,
        domain=core.domain,
        length=length if length.value < LARGEST else None,
        lebesgue_constant=constants,
        box=box,
        warnings=(*warnings, *_amplification(constants), *filter(None, [shape.rounding.remark])),
        closed=curve.is_closed,
        corners=len(shape.view.corners),
        smooth=len(shape.view.two_sided) - len(shape.view.corners) if shape.view.arrays.ties.any() else 0,
    )


def _facts_of_points(curve: Curve) -> CurveFacts:
    """Return the facts that need no more than the document's value."""
    return CurveFacts(
        curve.name,
        curve.family,
        curve.parametrization,
        len(curve.points),
        visible=curve.visible,
        style=curve.style,
        shape=curve.shape,
        groups=curve.groups,
        settings=curve.family.settings.values(curve.settings_in_effect),
    )


def _edges(curve: Curve, box: Box) -> tuple[tuple[float, float, float, float] | None, tuple[str, ...]]:
    """Return the edges of the curve without a warning, or no edges with one."""
    corners = np.array([box.minimum, box.maximum])
    try:
        refuse_out_of_range(curve, corners)
        # A curve without length is drawn as a dot.
        is_dot = (corners[0] == corners[1]).all()
        frame_around([around_dot(corners[0], curve.style) if is_dot else corners])
    except ExchangeError as problem:
        return None, (str(problem),)
    left, bottom, right, top = corners.ravel().tolist()
    return (left, bottom, right, top), ()


def _lengths(shapes: Sequence[_Shape], constants_of_shapes: Sequence[LebesgueConstants]) -> list[Length]:
    """Return arc lengths; their bounds count the effect of the rounding of t."""
    lengths = lengths_of([shape.pieces for shape in shapes], LENGTH_TOLERANCE)
    others = [
        []
        if shape.rounding.is_lost(*constants[:2], length.error / max(length.value, SMALLEST))
        else shape.rounding.disturbed()
        for shape, constants, length in zip(shapes, constants_of_shapes, lengths, strict=True)
    ]
    # Deviations of the pieces count by the weights, too.
    pieces = [bezier_pieces(case.curve, min(FINE / case.weight, 1e-6)) for case in chain(*others)]
    moved = iter(lengths_of(pieces, LENGTH_TOLERANCE))
    for index, (length, cases) in enumerate(zip(lengths, others, strict=True)):
        effect = sum(case.weight * abs(next(moved).value - length.value) for case in cases)
        lengths[index] = length._replace(error=min(length.error + effect, LARGEST))
    return lengths


def _lebesgue_constants(views: Sequence[CurveView]) -> list[LebesgueConstants]:
    """Return the constants of the data and of the points."""
    return [
        LebesgueConstants(
            constant if view.cardinal and not view.cardinal.follows else growth_of_data(view),
            constant,
            view.growth_holds,
        )
        for view, constant in zip(views, growths_of_points(views), strict=True)
    ]


def _amplification(constants: LebesgueConstants) -> tuple[str, ...]:
    """Return a warning if small errors in the points grow along the curve."""
    if constants.points < AMPLIFICATION_WORTH_A_WORD:
        return ()
    times = f"up to {constants.points:.2g}-fold" if constants.points < LARGEST else "without bound"
    constant = " ".join(filter(None, ("Lebesgue constant", constants.holds)))
    return (f"Errors in the points grow {times} along the curve ({constant}).",)
