"""Velocities and accelerations as arrows at the points, and at the scrub line."""

from __future__ import annotations

import numpy as np

from app.view_model.analysis.figures import Figure, Floats, Shape, Style, number
from app.view_model.analysis.scene import Scene, usual_length

_SHARE = 0.25
"""The longest arrow against the size of the points at scale 1."""

_LONGEST = 4.0
_EQUAL = 1e-6
"""Vectors on both sides of a point that differ by less, relatively, are one."""

_STYLES = {1: Style.VELOCITY, 2: Style.ACCELERATION}
_NAMES = {1: "|c′|", 2: "|c″|"}


def vectors(scene: Scene, order: int) -> list[Figure]:
    """Return the arrows of a derivative of order 1 or 2; two where it jumps at a point."""
    places, arrows = _at_knots(scene, order)
    if not len(places):
        return []
    settings = scene.settings
    scale = settings.velocity_scale if order == 1 else settings.acceleration_scale
    longest = usual_length(arrows, _LONGEST)
    unit = _SHARE * scene.size / longest * scale if longest > 0 else 0.0
    figures = [_figure(order, places, arrows * unit)]
    here, arrow = scene.at_scrub(0), scene.at_scrub(order)
    if here is not None and arrow is not None:
        label = f"{_NAMES[order]} {number(float(np.hypot(*arrow)))}"
        figures.append(_figure(order, here[None], arrow[None] * unit, label))
    return figures


def _figure(order: int, places: Floats, arrows: Floats, label: str = "") -> Figure:
    points = np.hstack([places, places + arrows]).reshape(-1, 2)
    return Figure(_STYLES[order], Shape.ARROWS, points, label)


def _at_knots(scene: Scene, order: int) -> tuple[Floats, Floats]:
    """Return the knots and the derivative there, from both sides where these differ."""
    places, arrows = [], []
    for piece, curve in zip(scene.samples, scene.view.pieces, strict=True):
        derivative = piece.velocities if order == 1 else piece.accelerations
        ends = derivative.reshape(len(curve.parameters) - 1, -1, 2)
        before, after = ends[:, -1], ends[:, 0]
        size = np.abs(ends[:, [0, -1]]).max()
        jumps = np.abs(after[1:] - before[:-1]).max(axis=1) > _EQUAL * size
        places += [curve.points[:-1], curve.points[1:-1][jumps], curve.points[-1:]]
        arrows += [after, before[:-1][jumps], before[-1:]]
    if not places:
        return np.empty((0, 2)), np.empty((0, 2))
    return np.vstack(places), np.vstack(arrows)
