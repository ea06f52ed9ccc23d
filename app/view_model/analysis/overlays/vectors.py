"""Velocities and accelerations as arrows at the points, and at the scrub line."""

from __future__ import annotations

from functools import partial

import numpy as np

from curvecore.arrays import FloatArray

from ...geometry import usual_length
from ...line_styles import GREEN, VERMILLION, LineStyle
from ...settings import Factor
from ..overlay import Figure, Figures, Group, Overlay, OverlayInput, Shape, number

VELOCITY = LineStyle(GREEN, width=1.6)
ACCELERATION = LineStyle(VERMILLION, width=1.6)

VELOCITY_SCALE = Factor("velocityScale", "Length of the arrows")
ACCELERATION_SCALE = Factor("accelerationScale", "Length of the arrows")
"""1 makes the longest a quarter of the curve's size."""

_SHARE = 0.25
"""The longest arrow against the size of the points at scale 1."""

_LONGEST = 4.0
_EQUAL = 1e-6
"""Vectors on both sides of a point that differ by less, relatively, are one."""


def _vectors(order: int, style: LineStyle, scale: Factor, symbol: str, data: OverlayInput) -> Figures:
    """Return the arrows of a derivative of order 1 or 2; two where it jumps at a point."""
    positions, arrows = _at_knots(data, order)
    if not len(positions):
        return Figures()
    longest = usual_length(arrows, _LONGEST)
    unit = _SHARE * data.size / longest * data.value(scale) if longest > 0 else 0.0
    figures = [_figure(style, positions, arrows * unit)]
    here, arrow = data.at_scrub(0), data.at_scrub(order)
    if here is not None and arrow is not None:
        label = f"{symbol} {number(float(np.hypot(*arrow)))}"
        figures.append(_figure(style, here[None], arrow[None] * unit, label))
    return Figures(figures)


def _figure(style: LineStyle, positions: FloatArray, arrows: FloatArray, label: str = "") -> Figure:
    points = np.hstack([positions, positions + arrows]).reshape(-1, 2)
    return Figure(style, Shape.ARROWS, points, label)


def _at_knots(data: OverlayInput, order: int) -> tuple[FloatArray, FloatArray]:
    """Return the knots and the derivative there, from both sides where these differ."""
    positions, arrows = [], []
    for piece, curve in zip(data.samples, data.view.pieces, strict=True):
        derivative = piece.velocities if order == 1 else piece.accelerations
        ends = derivative.reshape(len(curve.parameters) - 1, -1, 2)
        before, after = ends[:, -1], ends[:, 0]
        size = np.abs(ends[:, [0, -1]]).max()
        jumps = np.abs(after[1:] - before[:-1]).max(axis=1) > _EQUAL * size
        points = curve.knot_points
        positions += [points[:-1], points[1:-1][jumps], points[-1:]]
        arrows += [after, before[:-1][jumps], before[-1:]]
    if not positions:
        return np.empty((0, 2)), np.empty((0, 2))
    return np.vstack(positions), np.vstack(arrows)


def _overlay(
    order: int, name: str, plural: str, symbol: str, style: LineStyle, scale: Factor, more: str = ""
) -> Overlay:
    """Return the overlay of a derivative, whose vectors have this name."""
    return Overlay(
        name=plural.lower(),
        text=plural,
        full_name=f"{plural} as Arrows",
        tip=f"Draw {symbol} as arrows at the points and at the scrub line{more}",
        key=f"Ctrl+Alt+{order + 1}",
        icon=name.lower(),
        group=Group.SHAPE,
        rank=10 + 10 * order,
        layer=60 + 10 * order,
        draw=partial(_vectors, order, style, scale, f"|{symbol}|"),
        settings=(scale,),
        follows_scrub=True,
        legend=lambda _view, _settings: [(style, f"{name} {symbol}")],
    )


VELOCITIES = _overlay(1, "Velocity", "Velocities", "c′", VELOCITY, VELOCITY_SCALE)
ACCELERATIONS = _overlay(
    2, "Acceleration", "Accelerations", "c″", ACCELERATION, ACCELERATION_SCALE, "; two where it jumps"
)
