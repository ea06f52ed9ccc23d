"""The region to which errors of points and parameters can bring the curve, at worst.

With errors ε of the points alone the region is exact: discs of radius ε·Λ(t) around c(t), all together.
Errors δ of the parameters enter to first order, with their exact worst case across the curve.
"""

from __future__ import annotations

import numpy as np

from app.view_model.analysis.comb import unit_tangents
from app.view_model.analysis.figures import Figure, Floats, Shape, Style, number
from app.view_model.analysis.samples import Samples
from app.view_model.analysis.scene import Scene
from app.view_model.curve_view import CoreCurve
from curvecore import worst_case_band

_MOST = 300
"""Samples of a whole curve; with errors of the parameters half as many, for these cost ten times as much."""

_CORNERS = 12
"""Quadrilaterals of a disc."""


def band(scene: Scene) -> tuple[list[Figure], str]:
    """Return the region, and its largest half-width in words."""
    epsilon, delta = scene.settings.point_error or 0.0, scene.settings.parameter_error
    curve = scene.view.curve
    if curve is None or epsilon == delta == 0.0:
        return [], "Both errors are 0: the curve stays where it is."
    most = _MOST if delta == 0.0 else _MOST // 2
    pieces = [_thinned(piece, most) for piece in scene.samples]
    cells: list[Floats] = []
    best, best_t, gap = 0.0, float(curve.domain[0]), 0.0
    for piece, core in zip(pieces, scene.view.pieces, strict=True):
        radii = worst_case_band(core, piece.parameters, epsilon, delta).across
        cells += [_strip(piece, radii), _discs(piece, radii)]
        place = int(np.argmax(radii))
        if radii[place] > best:
            best, best_t = float(radii[place]), float(piece.parameters[place])
            gap = float(np.diff(piece.parameters).max())
    best, best_t = _refined(curve, (epsilon, delta), (best, best_t), gap)
    words = f"Largest half-width {number(best)} at t = {number(best_t)}"
    if delta == 0.0:
        words += f", {number(best / epsilon)} times ε"
    return [Figure(Style.BAND, Shape.CELLS, np.vstack(cells).reshape(-1, 2))], f"{words}."


def _thinned(piece: Samples, most: int) -> Samples:
    """Leave out samples that repeat the one before, and more than a drawing needs."""
    t = piece.parameters
    kept = np.flatnonzero(np.append(np.diff(t) > 1e-9 * (t[-1] - t[0]), True))
    step = -(-len(kept) // most)
    kept = np.unique(np.append(kept[::step], kept[-1]))
    return Samples(t[kept], piece.points[kept], piece.velocities[kept], piece.accelerations[kept])


def _strip(piece: Samples, radii: Floats) -> Floats:
    """Return quadrilaterals (k, 4, 2) between the discs that follow each other along the curve."""
    tangents = unit_tangents(piece.velocities)
    normals = np.column_stack([-tangents[:, 1], tangents[:, 0]])
    speed = np.hypot(piece.velocities[:, 0], piece.velocities[:, 1])
    growth = np.gradient(radii, piece.parameters) / np.where(speed > 0, speed, np.inf)
    # Where discs grow they touch their envelope behind the centre; faster than the curve, they have none.
    behind = np.clip(np.nan_to_num(growth), -1.0, 1.0)
    middle = piece.points - (radii * behind)[:, None] * tangents
    half = (radii * np.sqrt(1.0 - behind**2))[:, None] * normals
    left, right = middle + half, middle - half
    cells = np.stack([left[:-1], right[:-1], right[1:], left[1:]], axis=1)
    # Sorted around their middle: where a cell is twisted its halves would cancel each other's filling.
    away = cells - cells.mean(axis=1, keepdims=True)
    order = np.argsort(np.arctan2(away[:, :, 1], away[:, :, 0]), axis=1)
    result: Floats = np.take_along_axis(cells, order[:, :, None], axis=1)
    return result


def _discs(piece: Samples, radii: Floats) -> Floats:
    """Return discs, as quadrilaterals (k, 4, 2), at both ends and where the radius has a local maximum."""
    rising = np.diff(radii) > 0
    places = [0, *(np.flatnonzero(rising[:-1] & ~rising[1:]) + 1).tolist(), len(radii) - 1]
    angle = np.linspace(0.0, 2 * np.pi, 2 * _CORNERS + 1)
    rim = np.column_stack([np.cos(angle), np.sin(angle)])
    fan = np.stack([np.zeros((_CORNERS, 2)), rim[:-2:2], rim[1:-1:2], rim[2::2]], axis=1)
    discs = piece.points[places][:, None, None] + radii[places][:, None, None, None] * fan
    result: Floats = discs.reshape(-1, 4, 2)
    return result


def _refined(
    curve: CoreCurve, errors: tuple[float, float], found: tuple[float, float], gap: float
) -> tuple[float, float]:
    """Return the largest half-width near the widest sample, and its t."""
    best, best_t = found
    for _ in range(3):
        t = np.clip(best_t + gap * np.linspace(-1.0, 1.0, 9), *curve.domain)
        radii = worst_case_band(curve, t, *errors).across
        place = int(np.argmax(radii))
        if radii[place] > best:
            best, best_t = float(radii[place]), float(t[place])
        gap /= 4
    return best, best_t
