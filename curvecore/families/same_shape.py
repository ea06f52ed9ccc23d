"""Data that give a curve of one family the shape of another: Bezier pieces, and derivatives at their ends.

A change of basis of polynomial pieces rounds, and nothing else, where the family that is wanted has pieces of
that degree which join as smoothly. Where it has not, the reason is told.

References
----------
.. [1] G. Farin, "Curves and Surfaces for CAGD", 5th ed., Morgan Kaufmann 2002, sections 5.1 (derivatives at
   the ends), 6.1 and 6.4 (degree elevation and reduction) and 8.2 (B-splines and their Bezier points).
"""

from __future__ import annotations

from itertools import pairwise
from math import comb, perm
from typing import NamedTuple

import numpy as np

from curvecore.arrays import BoolArray, FloatArray
from curvecore.bezier.bernstein import elevated
from curvecore.errors import CurveError
from curvecore.families.curve import ParametricCurve

_RESIDUE = 1e-10
"""Share of the largest term up to which a difference counts as rounding."""

_NAMES = ("position", "velocity", "acceleration", "jerk")
"""The derivatives, by their orders."""


class BezierChain(NamedTuple):
    """Polynomial pieces of one degree, end to end.

    Attributes
    ----------
    controls : ndarray, shape (k, degree + 1, dim)
    breaks : ndarray, shape (k + 1,)
        Where the pieces meet, and the ends.
    """

    controls: FloatArray
    breaks: FloatArray


def pieces_of(curve: ParametricCurve, degree: int | None, wanted: str) -> BezierChain:
    """Return the pieces of a curve, written in a degree if one is given.

    Parameters
    ----------
    curve : ParametricCurve
        Of any family.
    degree : int or None
        That of the family `wanted`, which is named in messages.

    Raises
    ------
    CurveError
        If they are no polynomials, or of a higher degree, or the curve has corners.
    """
    check_polynomials(curve, wanted)
    if degree is not None and curve.surely_exceeds(degree):
        raise _too_high(curve.degree, degree, wanted, pieces=len(curve.breaks) - 1)
    controls = curve.exact_pieces()
    assert controls is not None
    if degree is not None:
        controls = _of_degree(controls, degree, wanted)
    return BezierChain(controls, curve.breaks)


def check_polynomials(curve: ParametricCurve, wanted: str) -> None:
    """Raise CurveError where a curve has corners, or no polynomial pieces that can be computed exactly."""
    if len(curve.pieces) > 1:
        raise CurveError(
            f"a {wanted} curve has no corners inside, and this curve has {len(curve.pieces) - 1}"
        )
    if curve.degree is None:
        raise CurveError(f"it does not consist of polynomials, and a {wanted} curve does")
    if not curve.has_exact_pieces:
        raise CurveError(
            f"the curve through its {len(curve.parameters)} points is not known exactly enough to be "
            "written in another way"
        )


def check_one_polynomial(curve: ParametricCurve, wanted: str) -> None:
    """Raise CurveError where a curve is not one polynomial, or one that cannot be computed exactly."""
    check_polynomials(curve, wanted)
    pieces = len(curve.breaks) - 1
    if pieces > 1:
        raise CurveError(
            f"a {wanted} curve is one polynomial from end to end, and this curve has {pieces} pieces"
        )


def check_smooth_joints(chain: BezierChain, derivatives: int, wanted: str) -> None:
    """Raise CurveError where only derivatives above the acceleration jump: that is no corner."""
    jumps = _jumps(chain, derivatives)
    is_corner = np.any(jumps[:3], axis=0)
    for order in range(3, derivatives + 1):
        count = int(np.count_nonzero(jumps[order] & ~is_corner))
        if count:
            joints = "1 joint" if count == 1 else f"{count} joints"
            raise CurveError(
                f"its {_NAMES[order]} jumps at {joints}, and that of a {wanted} curve is continuous"
            )


def joint_jets(chain: BezierChain, derivatives: int, wanted: str) -> FloatArray:
    """Return the points and derivatives where pieces meet, shape (k + 1, derivatives + 1, dim).

    Raises
    ------
    CurveError
        If one of them jumps.
    """
    for order, jumps in enumerate(_jumps(chain, derivatives)):
        if jumps.any():
            jumping, like = (f"its {_NAMES[order]}", "that of ") if order else ("the curve", "")
            t = float(chain.breaks[1 + int(np.argmax(jumps))])
            raise CurveError(f"{jumping} jumps at t = {t:.6g}, and {like}a {wanted} curve is continuous")
    return np.concatenate([_end_jets(chain, derivatives, 0), _end_jets(chain, derivatives, 1)[-1:]])


def smooth_stretches(chain: BezierChain, derivatives: int) -> list[BezierChain]:
    """Divide a chain at the joints where the curve is continuous and one of its first derivatives jumps."""
    breaks, *jumps = _jumps(chain, derivatives)
    cuts = np.flatnonzero(np.any(jumps, axis=0) & ~breaks) + 1
    ends = [0, *cuts.tolist(), len(chain.controls)]
    return [
        BezierChain(chain.controls[start:end], chain.breaks[start : end + 1]) for start, end in pairwise(ends)
    ]


def _jumps(chain: BezierChain, derivatives: int) -> list[BoolArray]:
    """Return at which joints each derivative jumps, by its order, (k - 1,)."""
    ahead, behind = _end_jets(chain, derivatives, 0), _end_jets(chain, derivatives, 1)
    steps, jumps = np.diff(chain.breaks), []
    for order in range(derivatives + 1):
        before, after = behind[:-1, order], ahead[1:, order]
        jump = np.abs(after - before).max(axis=1, initial=0.0)
        # Rounding of the control points, seen through divisions by both lengths.
        noise = np.abs(chain.controls).max() / np.minimum(steps[:-1], steps[1:]) ** order
        scale = np.abs(np.concatenate([before, after])).max(initial=0.0)
        jumps.append(jump > _RESIDUE * scale + 64.0 * perm(7, order) * 2.0**-53 * noise)
    return jumps


def _end_jets(chain: BezierChain, derivatives: int, end: int) -> FloatArray:
    """Return derivatives at the beginnings (0) or the ends (1) of the pieces, shape (k, R, dim)."""
    degree = chain.controls.shape[1] - 1
    h = np.diff(chain.breaks)[:, None]
    columns = []
    for order in range(derivatives + 1):
        if order > degree:
            columns.append(np.zeros_like(chain.controls[:, 0]))
            continue
        differences = np.diff(chain.controls, n=order, axis=1)[:, -1 if end else 0]
        columns.append(perm(degree, order) * differences / h**order)
    return np.stack(columns, axis=1)


def _of_degree(controls: FloatArray, degree: int, wanted: str) -> FloatArray:
    """Return the pieces with control points of a degree."""
    while controls.shape[1] - 1 > degree:
        higher = controls.shape[1] - 1
        highest = np.abs(np.diff(controls, n=higher, axis=1)).max()
        if highest > _RESIDUE * comb(higher, higher // 2) * np.abs(controls).max():
            raise _too_high(higher, degree, wanted, pieces=len(controls))
        controls = _reduced(controls)
    return elevated(controls, degree - controls.shape[1] + 1)


def _too_high(higher: int | None, degree: int, wanted: str, *, pieces: int) -> CurveError:
    is_one = "it is one polynomial" if pieces == 1 else "its pieces are polynomials"
    return CurveError(f"{is_one} of degree {higher}, the pieces of a {wanted} curve have degree {degree}")


def _reduced(controls: FloatArray) -> FloatArray:
    """Return the control points before an elevation: from both ends to the middle."""
    degree = controls.shape[1] - 1
    result = np.empty_like(controls[:, 1:])
    for i in range((degree + 1) // 2):
        before = result[:, i - 1] if i else 0.0
        result[:, i] = (degree * controls[:, i] - i * before) / (degree - i)
    for i in range(degree - 1, (degree + 1) // 2 - 1, -1):
        after = result[:, i + 1] if i + 1 < degree else 0.0
        result[:, i] = (degree * controls[:, i + 1] - (degree - i - 1) * after) / (i + 1)
    return result
