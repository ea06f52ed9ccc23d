"""Curves as piecewise polynomials, chains too, and piecewise polynomials as curves."""

from __future__ import annotations

import numpy as np

from curvecore.arrays import FloatArray, read_only
from curvecore.bezier.bernstein_algebra import elevated, weights
from curvecore.errors import CurveError
from curvecore.families.curve import ParametricCurve

_MOST_SAMPLED = (
    24  # degree from which on Bernstein coefficients of sampled values have lost half their digits
)


def exact_pieces(curve: ParametricCurve) -> FloatArray | None:
    """Return the Bezier pieces of a curve; of a chain those of all its curves, raised to one degree."""
    if len(curve.pieces) == 1:
        return curve.exact_pieces()
    parts = [part for piece in curve.pieces if (part := exact_pieces(piece)) is not None]
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
    controls = curve.exact_pieces()
    if controls is not None:
        return controls
    if curve.degree is None or curve.degree > _MOST_SAMPLED:
        raise CurveError(
            "curve must have pieces that are polynomials of a moderate degree; cubic_path approximates others"
        )
    return _sampled(curve, curve.degree)


def _sampled(curve: ParametricCurve, degree: int) -> FloatArray:
    """Return the polynomials through values inside the pieces: at a break itself the curve may jump."""
    places = np.sin((np.arange(degree + 1) + 0.5) * (np.pi / (2 * (degree + 1)))) ** 2
    starts, lengths = curve.breaks[:-1, None], np.diff(curve.breaks)[:, None]
    values = curve.evaluate(starts + places * lengths)
    return np.asarray(np.linalg.solve(weights(places, degree), values), dtype=np.float64)


def _joined(parts: list[FloatArray]) -> FloatArray:
    degree = max(part.shape[1] for part in parts)
    return np.concatenate([elevated(part, degree - part.shape[1]) for part in parts])


class PolynomialPieces(ParametricCurve):
    """A curve of Bezier pieces of any degree that may jump where they meet: all control points are its data.

    Parameters
    ----------
    controls : ndarray, shape (k, degree + 1, dim)
    breaks : ndarray, shape (k + 1,)
        Strictly increasing.
    """

    __slots__ = ("_controls",)

    name = "polynomial_pieces"
    title = "piecewise polynomial"
    interpolates = False

    def __init__(self, controls: FloatArray, breaks: FloatArray) -> None:
        self._controls = read_only(controls)
        self._jets = read_only(controls.reshape(-1, 1, controls.shape[2]))
        self._parameters = read_only(breaks)
        self._chosen = ()

    @property
    def breaks(self) -> FloatArray:
        """As given."""
        return self._parameters

    @property
    def degree(self) -> int:
        """That of all pieces."""
        return int(self._controls.shape[1]) - 1

    def bezier_pieces(self) -> FloatArray:
        """Return the control points."""
        return self._controls

    def _basis(self, t: FloatArray, order: int) -> FloatArray:
        if order:
            raise CurveError("derivatives of these functions are not needed")
        piece = np.clip(np.searchsorted(self._parameters, t, side="right") - 1, 0, len(self._controls) - 1)
        places = (t - self._parameters[piece]) / np.diff(self._parameters)[piece]
        result = np.zeros((len(t), *self._controls.shape[:2]))
        result[np.arange(len(t)), piece] = weights(places, self.degree)
        return result.reshape(len(t), -1, 1)
