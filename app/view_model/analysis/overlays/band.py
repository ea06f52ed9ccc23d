"""The region that the curve can reach with errors of points and parameters, at worst.

With errors ε of the points alone the region is exact: discs of radius ε·Λ(t) around c(t), all together.
Velocities and accelerations that are estimated follow the points, where they are not linear in these to first
order; the parameters stay.
Errors δ of the parameters enter to first order, estimates that follow them included, with their exact worst
case across the curve; the points stay.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np

import curvecore
from curvecore.arrays import BoolArray, FloatArray

from ...basis import parameter_moves
from ...curve.curve_view import CurveView
from ...geometry import Samples, to_the_left, unit_tangents
from ...line_styles import LineStyle, Sign
from ...settings import SettingValues
from ..overlay import (
    PARAMETER_ERROR,
    POINT_ERROR,
    Entry,
    Figure,
    Figures,
    Group,
    Overlay,
    OverlayInput,
    Shape,
    errors_text,
    number,
)

AREA = LineStyle("accent", 0.16, sign=Sign.AREA)

_MOST = 300
"""Samples of a whole curve; with errors of the parameters half as many, for these cost ten times as much."""

_JUMP, _TURN = 0.25, 0.94
"""Change of the slope of the outline, and cosine of a turn, from one sample to the next, that leave a gap."""

_CORNERS = 32
"""Corners of a disc."""


_MOST_FOLLOWED = 40
"""Knots up to which estimates follow the parameters: for each parameter all are estimated again."""


def band(data: OverlayInput) -> Figures:
    """Return the region, and its largest half-width in words."""
    epsilon, delta = data.value(POINT_ERROR), data.value(PARAMETER_ERROR)
    curve = data.view.curve
    if curve is None or epsilon == delta == 0.0:
        return Figures(note="Both errors are 0: the band has no width.")
    if data.view.cardinal is None or (data.view.growth_holds and np.isinf(data.view.growth)):
        return Figures(note="Not drawn: the smallest error of a point makes the curve infinite.")
    most = _MOST if delta == 0.0 else _MOST // 2
    pieces = [_thinned(piece, most) for piece in data.samples]
    polygons: list[FloatArray] = []
    best, best_t = 0.0, float(curve.domain[0])
    # Without errors of parameters nothing follows them.
    follows = bool(delta) and data.view.source.family.derivatives > 0
    is_held = follows and len(data.view.parameters) > _MOST_FOLLOWED
    for index, (piece, core) in enumerate(zip(pieces, data.view.pieces, strict=True)):
        moves = parameter_moves(data.view, index, piece.parameters) if follows and not is_held else None
        errors = (piece.parameters, epsilon, delta)
        radii = curvecore.worst_case_band(
            core, *errors, cardinal=data.view.cardinal, sensitivity=moves
        ).across
        polygons += _strip(piece, radii)
        largest, t = _largest(piece.parameters, radii)
        if largest > best:
            best, best_t = largest, t
    words = f"Largest half-width {number(best)} at t = {data.view.t_text(best_t)}"
    if is_held:
        words += ", with estimates that do not follow t"
    if delta == 0.0:
        words += f", {number(best / epsilon)} times ε"
    if data.view.growth_holds:
        words += f"; the effects of points are those of small errors in x or y {data.view.growth_holds}"
    elif data.view.linearised:
        words += f"; the effects of points are those {data.view.linearised}"
    return Figures([Figure(AREA, Shape.AREA, np.vstack(polygons))], f"{words}.")


def _thinned(piece: Samples, most: int) -> Samples:
    """Return the samples without repetitions, and not more than a drawing needs."""
    t = piece.parameters
    indices = np.flatnonzero(np.append(np.diff(t) > 1e-9 * (t[-1] - t[0]), True))
    step = -(-len(indices) // most)
    indices = np.unique(np.append(indices[::step], indices[-1]))
    return Samples(*(column[indices] for column in piece))


def _strip(piece: Samples, radii: FloatArray) -> list[FloatArray]:
    """Return polygons that cover the discs around the samples and the area between them."""
    tangents = unit_tangents(piece.velocities)
    speed = np.hypot(piece.velocities[:, 0], piece.velocities[:, 1])
    growth = np.gradient(radii, piece.parameters) / np.where(speed > 0, speed, np.inf)
    # Where discs grow they touch their envelope behind the centre; faster than the curve, they have none.
    behind = np.clip(np.nan_to_num(growth), -1.0, 1.0)
    middle = piece.points - (radii * behind)[:, None] * tangents
    half = (radii * np.sqrt(1.0 - behind**2))[:, None] * to_the_left(tangents)
    left, right = middle + half, middle - half
    discs = _abrupt(behind, tangents)
    return [*_ribbons(left, right, tangents), *_discs(piece.points[discs], radii[discs])]


def _abrupt(behind: FloatArray, tangents: FloatArray) -> BoolArray:
    """Return the mask of samples where the outline turns so far that the disc is needed; with both ends."""
    jumps = np.abs(np.diff(behind)) > _JUMP
    jumps |= (tangents[1:] * tangents[:-1]).sum(axis=1) < _TURN
    return np.asarray(np.append(True, jumps) | np.append(jumps, True))


def _ribbons(left: FloatArray, right: FloatArray, tangents: FloatArray) -> list[FloatArray]:
    """Return the quadrilaterals between neighbouring cross-sections, joined where none is twisted.

    One that is twisted, in a bend sharper than the band is wide, would cancel the filling of others.
    """
    ahead = tangents[:-1] + tangents[1:]
    is_plain = np.ones(len(ahead), dtype=bool)
    for side in (left, right):
        is_plain &= (np.diff(side, axis=0) * ahead).sum(axis=1) > 0
    polygons = []
    cuts = np.flatnonzero(np.diff(is_plain)) + 1
    for start, end in pairwise([0, *cuts.tolist(), len(is_plain)]):
        if is_plain[start]:
            polygons.append(_closed(np.vstack([right[start : end + 1], left[start : end + 1][::-1]])))
        else:
            cells = np.stack([right[:-1], right[1:], left[1:], left[:-1]], axis=1)[start:end]
            polygons += [_closed(cell) for cell in _untwisted(cells)]
    return polygons


def _untwisted(cells: FloatArray) -> FloatArray:
    """Return quadrilaterals (k, 4, 2) with their corners in order around the middle."""
    away = cells - cells.mean(axis=1, keepdims=True)
    order = np.argsort(np.arctan2(away[:, :, 1], away[:, :, 0]), axis=1)
    return np.take_along_axis(cells, order[:, :, None], axis=1)


def _discs(centres: FloatArray, radii: FloatArray) -> list[FloatArray]:
    angle = np.linspace(0.0, 2 * np.pi, _CORNERS, endpoint=False)
    rim = np.column_stack([np.cos(angle), np.sin(angle)])
    return [_closed(centre + radius * rim) for centre, radius in zip(centres, radii, strict=True)]


def _closed(polygon: FloatArray) -> FloatArray:
    return np.vstack([polygon, np.full((1, 2), np.nan)])


def _largest(t: FloatArray, radii: FloatArray) -> tuple[float, float]:
    """Return the maximum of the parabola through the largest sample and its neighbours, and its t."""
    index = int(np.argmax(radii))
    best, best_t = float(radii[index]), float(t[index])
    if 0 < index < len(t) - 1:
        before, after = radii[index - 1] - best, radii[index + 1] - best
        h, k = t[index - 1] - best_t, t[index + 1] - best_t
        bend = (before / h - after / k) / (h - k)
        slope = before / h - bend * h
        if bend < 0:
            shift = -slope / (2 * bend)
            return best + float(slope * shift / 2), best_t + float(shift)
    return best, best_t


def _legend(view: CurveView, settings: SettingValues) -> list[Entry]:
    # Errors of parameters count to first order; those of points exactly, unless a rule is not linear in them.
    is_first_order = settings.value(PARAMETER_ERROR) or view.linearised
    worst = "Worst case to first order" if is_first_order else "Worst case"
    return [(AREA, f"{worst}, {errors_text(settings)}")]


BAND = Overlay(
    name="band",
    text="Sensitivity Band",
    tip="Shade the region that the curve can reach with errors of points and parameters",
    key="Ctrl+Alt+8",
    icon="band",
    group=Group.ERRORS,
    rank=90,
    layer=10,
    draw=band,
    settings=(POINT_ERROR, PARAMETER_ERROR),
    legend=_legend,
)
