"""The Bézier control polygon of every segment."""

from __future__ import annotations

import numpy as np

import curvecore
from curvecore.arrays import FloatArray

from ...curve.curve_view import CurveView
from ...line_styles import LineStyle, Mark, Sign
from ..overlay import Figure, Figures, Group, Overlay, OverlayInput, Shape, number

SIDES = LineStyle("handle", 0.9, mark=Mark.SQUARE, sign=Sign.LINE_WITH_MARK)
CONTROL_POINT = LineStyle("handle", mark=Mark.SQUARE)

_MOST = 32
"""Points of the longest polynomial that is converted; the work grows with the fourth power."""

_WORST = 1e10
"""Condition number above which the control points are meaningless."""


def _is_one_polynomial(view: CurveView) -> bool:
    return view.curve is not None and view.curve.is_one_polynomial


def bezier(data: OverlayInput) -> Figures:
    """Return the control polygons of the segments, or that of one polynomial, or a note why not."""
    view = data.view
    if _is_one_polynomial(view):
        return _of_polynomial(data)
    figures = []
    for piece in view.pieces:
        if (controls := piece.exact_pieces()) is not None:
            figures += _polygons(controls)
    if figures:
        return Figures(figures)
    return Figures(note=f"Not drawn: {view.source.family.a_curve} has no known control points.")


def _of_polynomial(data: OverlayInput) -> Figures:
    """Return the control polygon of a Lagrange curve, or a note why it is not drawn; heavy."""
    curve = data.view.present_curve
    count = len(curve.parameters)
    if count > _MOST:
        return Figures(
            note=f"Not drawn: polynomials of up to {_MOST} points are converted; this one has {count}."
        )
    controls, condition = curvecore.lagrange_to_bezier(curve)
    if condition > _WORST:
        return Figures(
            note=f"Not drawn: errors of the points grow by a factor of {number(condition)}, the condition "
            "number, in the control points."
        )
    words = f"One polynomial of degree {count - 1}; condition number {number(condition)}."
    away = float(np.abs(controls - data.view.points.mean(axis=0)).max())
    if away > 3 * data.size:
        words += f" The control points are up to {number(away)} away."
    return Figures(_polygons(controls[None]), words)


def _polygons(controls: FloatArray) -> list[Figure]:
    """Return the lines and the inner points of control polygons (k, d + 1, 2)."""
    breaks = np.full((len(controls), 1, 2), np.nan)
    lines = np.concatenate([controls, breaks], axis=1).reshape(-1, 2)
    inner = controls[:, 1:-1].reshape(-1, 2)
    return [Figure(SIDES, Shape.LINE, lines), Figure(CONTROL_POINT, Shape.MARKS, inner)]


BEZIER = Overlay(
    name="bezier",
    text="Bézier Polygons",
    tip="Draw the Bézier control polygon of every segment",
    key="Ctrl+Alt+7",
    icon="bezier-polygon",
    group=Group.POLYGONS,
    rank=70,
    layer=40,
    draw=bezier,
    settles=_is_one_polynomial,
    legend=lambda _view, _settings: [(SIDES, "Bézier polygon")],
)
