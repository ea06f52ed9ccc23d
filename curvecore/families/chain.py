"""Curves end to end over one t axis: what a corner or a break makes of a curve."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arrays import FloatArray, IntArray, jet_array, parameter_array, parameter_values, read_only
from curvecore.errors import CurveError
from curvecore.families.curve import Curve, Interpolant, JointDerivatives, LocalBasis


class Chain(Curve):
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

    __slots__ = ("_pieces", "_rows")

    title = "Chain"

    def __init__(self, pieces: Sequence[Curve]) -> None:
        self._pieces = tuple(pieces)
        _check(self._pieces)
        first, *others = (piece.parameters for piece in self.pieces)
        self._parameters = read_only(np.concatenate([first, *(each[1:] for each in others)]))
        self._rows = _rows([len(piece.parameters) for piece in self.pieces])
        self._rows.setflags(write=False)
        self._jets = read_only(np.concatenate([piece.jets for piece in self._pieces]))

    @property
    def name(self) -> str:  # type: ignore[override]
        """That of the pieces."""
        return self._pieces[0].name

    @property
    def pieces(self) -> tuple[Curve, ...]:
        """The pieces."""
        return self._pieces

    @property
    def row_of_parameter(self) -> IntArray:
        """For each row of `jets` the index of its parameter in `parameters`."""
        return self._rows

    @property
    def points(self) -> FloatArray:
        """The points of the joints, each once, shape (k, dim)."""
        first, *others = (piece.points for piece in self.pieces)
        return np.concatenate([first, *(each[1:] for each in others)])

    @property
    def degree(self) -> int | None:
        """The largest degree of any piece; None where one is no polynomial."""
        degrees = [piece.degree for piece in self.pieces]
        known = [degree for degree in degrees if degree is not None]
        return max(known) if len(known) == len(degrees) else None

    @property
    def breaks(self) -> FloatArray:
        """Those of the pieces, each once."""
        first, *others = (piece.breaks for piece in self.pieces)
        return np.concatenate([first, *(each[1:] for each in others)])

    @property
    def is_local(self) -> bool:  # type: ignore[override]
        """Whether all pieces are of local families."""
        return all(piece.is_local for piece in self.pieces)

    @property
    def is_positive(self) -> bool:
        """Whether no B_i0 of any piece is negative there."""
        return all(piece.is_positive for piece in self.pieces)

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

    def with_data(self, jets: ArrayLike, parameters: ArrayLike) -> Chain:
        """Return a chain with other data (rows, R, dim) and as many other parameters, each once."""
        rows = jet_array(jets, (len(self.row_of_parameter), self.pieces[0].jets.shape[1]))
        joints = parameter_array(parameters, len(self._parameters))
        made: list[Curve] = []
        row = joint = 0
        for piece in self.pieces:
            count = len(piece.parameters)
            made.append(piece.with_data(rows[row : row + count], joints[joint : joint + count]))
            row, joint = row + count, joint + count - 1
        return Chain(made)

    # Piece by piece

    def local_basis(self, t: ArrayLike, order: int = 0) -> LocalBasis:
        """Return the functions that live on each t's segment, where all pieces are local; see `Curve`."""
        at = parameter_values(t).values
        piece_of = self._piece_of(at)
        segment = np.empty(len(at), dtype=np.intp)
        values = np.empty((len(at), 2, self._jets.shape[1]))
        first = 0
        for index, piece in enumerate(self.pieces):
            here = np.flatnonzero(piece_of == index)
            if here.size:
                local = piece.local_basis(at[here], order)
                segment[here], values[here] = local.segment + first, local.values
            first += len(piece.parameters) - 1
        return LocalBasis(segment, values)

    def interpolants(self) -> list[Interpolant] | None:
        """Return those of the pieces; None where one of them has none."""
        found: list[Interpolant] = []
        for piece in self.pieces:
            own = piece.interpolants()
            if own is None:
                return None
            found += own
        return found

    def joint_derivatives(self, *, before: bool) -> JointDerivatives:
        """Return c, c', c'' at the ends of all segments of all pieces."""
        sides = [piece.joint_derivatives(before=before) for piece in self.pieces]
        return JointDerivatives(*(np.concatenate(column) for column in zip(*sides, strict=True)))

    def parameter_derivatives(self, t: ArrayLike) -> FloatArray:
        """Return dc(t)/dt_i, shape (m, k, dim): a joint of two pieces moves the ends of both."""
        at = parameter_values(t).values
        result = np.zeros((len(at), *self.points.shape))
        piece_of = self._piece_of(at)
        first = 0
        for index, piece in enumerate(self.pieces):
            here = np.flatnonzero(piece_of == index)
            count = len(piece.parameters)
            if here.size:
                result[here, first : first + count] = piece.parameter_derivatives(at[here])
            first += count - 1
        return result

    def local_parameter_derivatives(self, t: FloatArray) -> tuple[IntArray, FloatArray]:
        """Return the segments of t, and dc(t)/dt_i of their two ends, (m, 2, dim); see `Curve`."""
        piece_of = self._piece_of(t)
        segment = np.empty(len(t), dtype=np.intp)
        moves = np.empty((len(t), 2, self.points.shape[1]))
        first = 0
        for index, piece in enumerate(self.pieces):
            here = np.flatnonzero(piece_of == index)
            if here.size:
                own, moves[here] = piece.local_parameter_derivatives(t[here])
                segment[here] = own + first
            first += len(piece.parameters) - 1
        return segment, moves

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
