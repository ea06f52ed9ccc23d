"""Curves end to end over one t axis: what a corner or a break makes of a curve."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arrays import FloatArray, IntArray, jet_array, parameter_values, read_only
from curvecore.curve import Curve
from curvecore.errors import CurveError
from curvecore.immutable import Immutable

__all__ = ["Chain"]


class Chain(Immutable):
    """Curves joined end to end.

    Each piece begins at the parameter where the one before it ends. A chain is linear in the data of
    its pieces taken together: a joint between two pieces has a row of data for each side, so that
    ``einsum("mir,ird->md", chain.basis(t), chain.jets) == chain.evaluate(t)`` as for any curve.

    Parameters
    ----------
    pieces : sequence of Curve
        At least one, of the same dimension and with the same number of derivatives in their jets.

    Raises
    ------
    CurveError
        If a piece does not begin where the one before it ends, or the pieces do not go together.

    Attributes
    ----------
    pieces : tuple of Curve
        The pieces.
    row_of_parameter : ndarray of int, shape (rows,)
        For each row of `jets` the index of its parameter in `parameters`.
    """

    __slots__ = ("_parameters", "pieces", "row_of_parameter")

    def __init__(self, pieces: Sequence[Curve]) -> None:
        self.pieces = tuple(pieces)
        _check(self.pieces)
        first, *others = (piece.parameters for piece in self.pieces)
        self._parameters = read_only(np.concatenate([first, *(each[1:] for each in others)]))
        self.row_of_parameter: IntArray = _rows([len(piece.parameters) for piece in self.pieces])
        self.row_of_parameter.setflags(write=False)

    @property
    def parameters(self) -> FloatArray:
        """The parameters of all joints, each once, shape (k,)."""
        return self._parameters

    @property
    def jets(self) -> FloatArray:
        """The data of the pieces, one after the other, shape (rows, R, dim)."""
        return np.concatenate([piece.jets for piece in self.pieces])

    @property
    def points(self) -> FloatArray:
        """The points of the joints, each once, shape (k, dim)."""
        first, *others = (piece.points for piece in self.pieces)
        return np.concatenate([first, *(each[1:] for each in others)])

    @property
    def domain(self) -> tuple[float, float]:
        """The first and the last parameter."""
        return (float(self._parameters[0]), float(self._parameters[-1]))

    @property
    def degree(self) -> int:
        """The largest degree of any piece."""
        return max(piece.degree for piece in self.pieces)

    def evaluate(self, t: ArrayLike, order: int = 0) -> FloatArray:
        """Return the order-th derivative at t, per unit of t to the power `order`.

        Parameters
        ----------
        t : array_like, scalar or shape (m,)
            Finite. Outside the domain the first or last piece goes on; at a joint the piece after it counts.
        order : int, optional
            At least 0.

        Returns
        -------
        ndarray
            Shape (dim,) for a scalar, (m, dim) for shape (m,).
        """
        values = parameter_values(t)
        piece_of = self._piece_of(values.values)
        result = np.empty((len(values.values), self.pieces[0].points.shape[1]))
        for index, piece in enumerate(self.pieces):
            here = piece_of == index
            if here.any():
                result[here] = piece.evaluate(values.values[here], order)
        return result[0] if values.is_scalar else result

    def basis(self, t: ArrayLike, order: int = 0) -> FloatArray:
        """Return the order-th derivatives of the basis functions of all rows, shape (m, rows, R)."""
        values = parameter_values(t).values
        piece_of = self._piece_of(values)
        result = np.zeros((len(values), len(self.row_of_parameter), self.pieces[0].jets.shape[1]))
        start = 0
        for index, piece in enumerate(self.pieces):
            here, end = piece_of == index, start + len(piece.parameters)
            if here.any():
                result[here, start:end] = piece.basis(values[here], order)
            start = end
        return result

    def with_jets(self, jets: ArrayLike) -> Chain:
        """Return a chain with the same parameters and other data, shape (rows, R, dim)."""
        rows = jet_array(jets, (len(self.row_of_parameter), self.pieces[0].jets.shape[1]))
        cuts = np.cumsum([len(piece.parameters) for piece in self.pieces])[:-1]
        parts = np.split(rows, cuts)
        return Chain([piece.with_jets(part) for piece, part in zip(self.pieces, parts, strict=True)])

    def _piece_of(self, t: FloatArray) -> IntArray:
        starts = np.array([piece.domain[0] for piece in self.pieces[1:]])
        return np.searchsorted(starts, t, side="right")


def _rows(counts: Sequence[int]) -> IntArray:
    rows, start = [], 0
    for count in counts:
        rows.append(np.arange(start, start + count))
        start += count - 1
    return np.concatenate(rows)


def _check(pieces: tuple[Curve, ...]) -> None:
    if not pieces:
        raise CurveError("pieces must hold at least one curve")
    for index in range(1, len(pieces)):
        before, after = pieces[index - 1], pieces[index]
        if before.domain[1] != after.domain[0]:
            raise CurveError(
                f"pieces[{index}] must begin at t = {before.domain[1]!r}, where the piece before it ends, "
                f"not at {after.domain[0]!r}"
            )
        if before.jets.shape[1:] != after.jets.shape[1:]:
            raise CurveError(f"pieces[{index}] must have jets of the shape of pieces[{index - 1}]")
