"""Bounding boxes of curves: the smallest axis-parallel ones."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from curvecore.arithmetic import scale_by_power
from curvecore.arrays import FloatArray, IntArray
from curvecore.bezier.bernstein import sign_changes, values
from curvecore.bezier.pieces import BezierPieces, alike, bezier_pieces, parameters_at
from curvecore.families.curve import ParametricCurve


class Box(NamedTuple):
    """The smallest box that holds a curve.

    Attributes
    ----------
    minimum, maximum : ndarray, shape (dim,)
        Values that the curve takes.
    error : float
        How far the curve may leave the box: a few roundings for the Hermite
        families; measured, relative 1e-14 or so, for `LagrangeCurve`.

    See Also
    --------
    bounding_box : The function that returns it.

    Examples
    --------
    >>> from curvecore import LagrangeCurve, bounding_box
    >>> box = bounding_box(LagrangeCurve([[0, 0], [1, 2], [4, 0]], [0, 1, 2]))
    >>> box.minimum.round(9).tolist(), box.maximum.round(9).tolist()
    ([0.0, 0.0], [4.0, 2.0])
    """

    minimum: FloatArray
    maximum: FloatArray
    error: float


def bounding_box(curve: ParametricCurve) -> Box:
    """Return the smallest axis-parallel box that holds the curve over its domain.

    Parameters
    ----------
    curve : ParametricCurve
        Of any family and dim.

    Returns
    -------
    Box
        Not the box of the control points, which is larger: extrema are where
        a coordinate's derivative changes sign.

    See Also
    --------
    Box : What it returns.
    flatten : A polyline.

    Examples
    --------
    >>> from curvecore import LagrangeCurve, bounding_box
    >>> box = bounding_box(LagrangeCurve([[0, 0], [1, 2], [4, 0]], [0, 1, 2]))
    >>> box.minimum.round(9).tolist(), box.maximum.round(9).tolist()
    ([0.0, 0.0], [4.0, 2.0])
    """
    return bounding_boxes([curve], [bezier_pieces(curve)])[0]


def bounding_boxes(curves: Sequence[ParametricCurve], parts: Sequence[BezierPieces]) -> list[Box]:
    """Return the boxes of many curves, whose pieces are at hand, in a fraction of the time.

    Parameters
    ----------
    curves : sequence of ParametricCurve
        Of any families and dims.
    parts : sequence of BezierPieces
        Of each curve; their errors are those of the boxes.

    Returns
    -------
    list of Box
        As `bounding_box`.
    """
    boxes = []
    for curve, part, turns in zip(curves, parts, turning_points(curves, parts), strict=True):
        reached = [turns.points]
        if not _are_exact(curve, part):
            # Pieces of a lower degree follow the curve, they are not it: it may turn where two of them meet.
            reached.append(scale_by_power(part.controls[:, 0], part.exponent))
        points = np.concatenate([*(piece.knot_points for piece in curve.pieces), *reached])
        error = float(scale_by_power(part.error.max(keepdims=True), part.exponent)[0])
        boxes.append(Box(points.min(axis=0), points.max(axis=0), error))
    return boxes


class Turns(NamedTuple):
    """The parameters inside the pieces of a curve where a coordinate turns back.

    Attributes
    ----------
    points : ndarray, shape (k, dim)
        The parameters.
    axis : ndarray, shape (k,)
        Which coordinate turns there.
    """

    points: FloatArray
    axis: IntArray


def turning_points(curves: Sequence[ParametricCurve], parts: Sequence[BezierPieces]) -> list[Turns]:
    """Return the turning points of the coordinates of many curves, without the joints of their pieces.

    Parameters
    ----------
    curves : sequence of ParametricCurve
        Of any families and dims.
    parts : sequence of BezierPieces
        Of each curve.

    Returns
    -------
    list of Turns
        Of each curve.
    """
    by_index: dict[int, Turns] = {}
    for same in alike(parts):
        turns = _turning_points([curves[index] for index in same], [parts[index] for index in same])
        by_index.update(zip(same.tolist(), turns, strict=True))
    return [by_index[index] for index in range(len(curves))]


def _are_exact(curve: ParametricCurve, part: BezierPieces) -> bool:
    return bool(curve.degree == part.controls.shape[1] - 1)


def _turning_points(curves: Sequence[ParametricCurve], parts: Sequence[BezierPieces]) -> list[Turns]:
    """Return the turning points of coordinates, of curves all of whose pieces have one degree and dim."""
    controls = np.concatenate([part.controls for part in parts])
    slopes = np.concatenate([part.slopes for part in parts])
    after = np.cumsum([len(part.starts) for part in parts])
    # All coordinates at once.
    flat = slopes.transpose(2, 0, 1).reshape(-1, slopes.shape[1])
    roots = sign_changes(flat, np.zeros(len(flat)))
    axis, piece = np.divmod(roots.piece, len(slopes))
    s = roots.s
    owner = np.searchsorted(after, piece, side="right")
    exponents = np.array([part.exponent for part in parts])
    points = scale_by_power(values(controls[piece], s), exponents[owner][:, None])
    order = np.argsort(owner, kind="stable")
    bounds = np.searchsorted(owner[order], np.arange(len(parts) + 1))
    result = []
    for index, (curve, part) in enumerate(zip(curves, parts, strict=True)):
        here = order[bounds[index] : bounds[index + 1]]
        if _are_exact(curve, part):
            reached = points[here]
        else:
            t = parameters_at(part, piece[here] - (after[index] - len(part.starts)), s[here])
            reached = curve.evaluate(t)
        result.append(Turns(reached, axis[here]))
    return result
