"""Curves as piecewise polynomials, chains too."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from curvecore.arrays import FloatArray
from curvecore.bezier.bernstein_algebra import elevated, weights
from curvecore.bezier.conversion import bezier_stretch
from curvecore.errors import CurveError
from curvecore.families.curve import ParametricCurve

_MOST_SAMPLED = (
    24  # degree from which on Bernstein coefficients of sampled values have lost half their digits
)


def joined_pieces(curve: ParametricCurve) -> FloatArray | None:
    """Return `bezier_pieces`; of a chain those of all pieces, raised to one degree, if all have some."""
    if len(curve.pieces) == 1:
        return curve.bezier_pieces()
    parts = [part for piece in curve.pieces if (part := joined_pieces(piece)) is not None]
    return _joined(parts) if len(parts) == len(curve.pieces) else None


def polynomial_pieces(curve: ParametricCurve) -> FloatArray:
    """Return the Bernstein coefficients of a curve between its breaks, (k, degree + 1, dim).

    Raises
    ------
    CurveError
        If there are no such polynomials, or their degree is too high.
    """
    if len(curve.pieces) > 1:
        return _joined([polynomial_pieces(piece) for piece in curve.pieces])
    controls = curve.bezier_pieces()
    if controls is not None:
        return controls
    if curve.interpolants() is not None:
        return np.stack([bezier_stretch(curve, *ends) for ends in _stretches(curve)])
    if curve.degree is None or curve.degree > _MOST_SAMPLED:
        raise CurveError(
            "curve must have pieces that are polynomials of a moderate degree; cubic_path approximates others"
        )
    return _sampled(curve, curve.degree)


def _stretches(curve: ParametricCurve) -> list[tuple[float, float]]:
    return list(pairwise(curve.breaks.tolist()))


def _sampled(curve: ParametricCurve, degree: int) -> FloatArray:
    """Return the polynomials through values inside the pieces: at a break itself the curve may jump."""
    places = np.sin((np.arange(degree + 1) + 0.5) * (np.pi / (2 * (degree + 1)))) ** 2
    starts, lengths = curve.breaks[:-1, None], np.diff(curve.breaks)[:, None]
    values = curve.evaluate(starts + places * lengths)
    return np.asarray(np.linalg.solve(weights(places, degree), values), dtype=np.float64)


def _joined(parts: list[FloatArray]) -> FloatArray:
    degree = max(part.shape[1] for part in parts)
    return np.concatenate([elevated(part, degree - part.shape[1]) for part in parts])
