"""The Bézier control polygon of every segment, and the polygon of the points themselves."""

from __future__ import annotations

import numpy as np

from app.view_model.analysis.figures import Figure, Floats, Shape, Style, number
from app.view_model.analysis.scene import Scene
from app.view_model.curve_view import CurveView
from curvecore import lagrange_to_bezier

_MOST = 32
"""Points of the longest polynomial that is converted; the work grows with the fourth power."""

_WORST = 1e10
"""Condition number above which the control points say nothing any more."""


def polygon(view: CurveView) -> list[Figure]:
    """Return the polygon through the points."""
    points = view.points[[*range(len(view.points)), *([0] if view.source.is_closed else [])]]
    return [Figure(Style.POLYGON, Shape.LINE, points)]


def bezier_polygons(view: CurveView) -> tuple[list[Figure], str]:
    """Return the control polygons of the segments of piecewise polynomials, or in words why not."""
    figures = []
    for piece in view.pieces:
        if (controls := piece.bezier_pieces()) is not None:
            figures += _polygons(controls)
    if figures or view.source.family.is_one_polynomial:
        return figures, ""
    return [], f"Not drawn: no control points are known of a {view.source.family.title} curve."


def bezier_polygon_of_polynomial(scene: Scene) -> tuple[list[Figure], str]:
    """Return the one control polygon of a Lagrange curve, or in words why it is not drawn."""
    curve = scene.view.curve
    if curve is None or not curve.is_one_polynomial:
        return [], ""
    count = len(curve.parameters)
    if count > _MOST:
        return [], f"Not drawn: one polynomial of {count} points; up to {_MOST} are converted."
    controls, condition = lagrange_to_bezier(curve)
    if condition > _WORST:
        return [], (
            f"Not drawn: its condition number is {number(condition)}; errors of the points grow as much in "
            "the control points."
        )
    words = f"One polynomial of degree {count - 1}; condition number {number(condition)}."
    away = float(np.abs(controls - scene.view.points.mean(axis=0)).max())
    if away > 3 * scene.size:
        words += f" The control points lie up to {number(away)} away."
    return _polygons(controls[None]), words


def _polygons(controls: Floats) -> list[Figure]:
    """Return the lines and the inner points of control polygons (k, d + 1, 2)."""
    breaks = np.full((len(controls), 1, 2), np.nan)
    lines = np.concatenate([controls, breaks], axis=1).reshape(-1, 2)
    inner = controls[:, 1:-1].reshape(-1, 2)
    return [Figure(Style.BEZIER, Shape.LINE, lines), Figure(Style.BEZIER_POINT, Shape.MARKS, inner)]
