"""Chains: curves end to end over one t axis, with corners and jumps between them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arrays import (
    FloatArray,
    IntArray,
    end_to_end,
    jet_array,
    parameter_array,
    parameter_row,
    read_only,
)
from curvecore.bezier.bernstein import elevated
from curvecore.errors import CurveError
from curvecore.families.curve import ParametricCurve
from curvecore.families.defaults import Interpolant, JointDerivatives, LocalBasis


class Chain(ParametricCurve):
    """Curves joined end to end.

    Each piece begins at the parameter where the one before it ends. A chain is linear in the data of
    its pieces taken together: a joint between two pieces has a row of data for each side, so that
    ``einsum("mir,ird->md", chain.basis(t), chain.jets) == chain.evaluate(t)`` as for any curve.

    Parameters
    ----------
    pieces : sequence of ParametricCurve
        At least one, of the same dimension and with the same number of derivatives in their jets.

    Raises
    ------
    CurveError
        If a piece does not begin where the one before it ends, or the pieces do not go together.

    Attributes
    ----------
    pieces : tuple of ParametricCurve
        The pieces.

    See Also
    --------
    HermiteCurve : What a chain is mostly made of.

    Examples
    --------
    >>> from curvecore import Chain, HermiteCurve
    >>> before = HermiteCurve([[0, 0], [1, 0]], [[1, 0], [1, 0]], [0, 1])
    >>> after = HermiteCurve([[1, 0], [1, 1]], [[0, 1], [0, 1]], [1, 2])
    >>> corner = Chain([before, after])
    >>> corner
    Chain(pieces=2, n=3, dim=2, domain=(0, 2))
    >>> corner([0.5, 1.5]).round(9).tolist()
    [[0.5, 0.0], [1.0, 0.5]]
    >>> corner.jets.shape
    (4, 2, 2)
    """

    __slots__ = ("_pieces",)

    title = "Chain"

    def __init__(self, pieces: Sequence[ParametricCurve]) -> None:
        self._pieces = tuple(pieces)
        _check(self._pieces)
        self._chosen = tuple(self._pieces[0].chosen.items())
        self._parameters = read_only(end_to_end(piece.parameters for piece in self._pieces))
        self._jets = read_only(np.concatenate([piece.jets for piece in self._pieces]))

    def __repr__(self) -> str:
        """Return a short description: number of pieces, joints and so on."""
        return f"Chain(pieces={len(self._pieces)}, {self._shape_in_words()})"

    @property
    def name(self) -> str:  # type: ignore[override]
        """The name of the pieces."""
        return self._pieces[0].name

    @property
    def functions_key(self) -> tuple[object, ...]:
        """The key of the pieces."""
        return self._pieces[0].functions_key

    @property
    def pieces(self) -> tuple[ParametricCurve, ...]:
        """The pieces."""
        return self._pieces

    @property
    def points(self) -> FloatArray:
        """The points of the joints, each once, shape (k, dim)."""
        return np.delete(self._jets[:, 0], self._cuts(), axis=0)

    @property
    def degree(self) -> int | None:
        """The largest degree of any piece; None where one is no polynomial."""
        degrees = [piece.degree for piece in self._pieces]
        return None if None in degrees else max(degree for degree in degrees if degree is not None)

    @property
    def breaks(self) -> FloatArray:
        """The breaks of the pieces, each once."""
        return end_to_end(piece.breaks for piece in self._pieces)

    @property
    def is_local(self) -> bool:  # type: ignore[override]
        """Whether all pieces are of local families."""
        return all(piece.is_local for piece in self._pieces)

    @property
    def interpolates(self) -> bool:  # type: ignore[override]
        """Whether all pieces run through their points."""
        return all(piece.interpolates for piece in self._pieces)

    @property
    def passes_points(self) -> bool:
        """Whether all pieces pass through their points."""
        return all(piece.passes_points for piece in self._pieces)

    @property
    def is_positive(self) -> bool:
        """Whether no B_i0 of any piece is negative there."""
        return all(piece.is_positive for piece in self._pieces)

    def _evaluate(self, t: FloatArray, order: int) -> FloatArray:
        """Return the curve, or a derivative; at a joint of two pieces the one after it counts."""
        result = np.empty((len(t), self._jets.shape[2]))
        for part in self._parts(t):
            result[part.where] = part.piece.evaluate(part.t, order)
        return result

    def _basis(self, t: FloatArray, order: int) -> FloatArray:
        """Return the order-th derivatives of the basis functions of all rows, shape (m, rows, R)."""
        result = np.zeros((len(t), *self._jets.shape[:2]))
        for part in self._parts(t):
            rows = slice(part.row, part.row + len(part.piece.parameters))
            result[part.where, rows] = part.piece.basis(part.t, order)
        return result

    def with_jets(self, jets: ArrayLike) -> Chain:
        """Return a chain with the same parameters and other data, shape (rows, R, dim)."""
        rows = jet_array(jets, self._jets.shape[:2])
        parts = np.split(rows, self._cuts())
        return Chain([piece.with_jets(part) for piece, part in zip(self._pieces, parts, strict=True)])

    def with_data(self, jets: ArrayLike, parameters: ArrayLike) -> Chain:
        """Return a chain with other data (rows, R, dim) and as many other parameters, each once."""
        rows = jet_array(jets, self._jets.shape[:2])
        of_rows = parameter_array(parameters, len(self._parameters))[joint_of_row(self)]
        parts = zip(self._pieces, np.split(rows, self._cuts()), np.split(of_rows, self._cuts()), strict=True)
        return Chain([piece.with_data(*data) for piece, *data in parts])

    # Piece by piece

    def local_basis(self, t: ArrayLike, order: int = 0) -> LocalBasis:
        """Return the functions that live on each t's segment, where all pieces are local."""
        at = parameter_row(t)
        segment = np.empty(len(at), dtype=np.intp)
        values = np.empty((len(at), 2, self._jets.shape[1]))
        for part in self._parts(at):
            local = part.piece.local_basis(part.t, order)
            segment[part.where], values[part.where] = local.segment + part.joint, local.values
        return LocalBasis(segment, values)

    def interpolants(self) -> list[Interpolant] | None:
        """Return the interpolants of the pieces; None where one of them has none."""
        parts = [part for piece in self._pieces if (part := piece.interpolants()) is not None]
        if len(parts) < len(self._pieces):
            return None
        return [interpolant for part in parts for interpolant in part]

    def joint_derivatives(self, *, before: bool) -> JointDerivatives:
        """Return c to c''' at the ends of all segments of all pieces."""
        sides = [piece.joint_derivatives(before=before) for piece in self._pieces]
        return JointDerivatives(*(np.concatenate(column) for column in zip(*sides, strict=True)))

    def parameter_derivatives(self, t: ArrayLike) -> FloatArray:
        """Return dc(t)/dt_i, shape (m, k, dim): a joint of two pieces moves the ends of both."""
        at = parameter_row(t)
        result = np.zeros((len(at), len(self._parameters), self._jets.shape[2]))
        for part in self._parts(at):
            joints = slice(part.joint, part.joint + len(part.piece.parameters))
            result[part.where, joints] = part.piece.parameter_derivatives(part.t)
        return result

    def local_parameter_derivatives(self, t: FloatArray) -> tuple[IntArray, FloatArray]:
        """Return the segments of t, and dc(t)/dt_i of their two ends, (m, 2, dim); see `ParametricCurve`."""
        segment = np.empty(len(t), dtype=np.intp)
        moves = np.empty((len(t), 2, self._jets.shape[2]))
        for part in self._parts(t):
            of_piece, moves[part.where] = part.piece.local_parameter_derivatives(part.t)
            segment[part.where] = of_piece + part.joint
        return segment, moves

    def _parts(self, t: FloatArray) -> Iterator[_PieceParameters]:
        """Yield the pieces that hold some of t; the first and the last one go on outside the domain."""
        starts = np.array([piece.domain[0] for piece in self._pieces[1:]])
        piece_of = np.searchsorted(starts, t, side="right")
        row = 0
        for index, piece in enumerate(self._pieces):
            where = np.flatnonzero(piece_of == index)
            if where.size:
                yield _PieceParameters(piece, where, t[where], row, row - index)
            row += len(piece.parameters)

    def _cuts(self) -> IntArray:
        """Return the rows of jets at which pieces begin, but the first."""
        return np.cumsum([len(piece.parameters) for piece in self._pieces])[:-1]


class _PieceParameters(NamedTuple):
    """A piece of a chain and the parameters t that it holds.

    Attributes
    ----------
    piece : ParametricCurve
    where : ndarray of int, shape (k,)
        Indices of its parameters among all that were asked for.
    t : ndarray, shape (k,)
    row, joint : int
        Index of its first row in the jets and of its first joint in the parameters of the chain.
    """

    piece: ParametricCurve
    where: IntArray
    t: FloatArray
    row: int
    joint: int


def joint_of_row(curve: ParametricCurve) -> IntArray:
    """Return for each row of the jets the index of its parameter; a joint of two pieces has two rows."""
    counts = [len(piece.parameters) for piece in curve.pieces]
    return np.arange(sum(counts)) - np.repeat(np.arange(len(counts)), counts)


def exact_pieces(curve: ParametricCurve) -> FloatArray | None:
    """Return the Bezier pieces of a curve; of a chain those of all its curves, raised to one degree."""
    if len(curve.pieces) == 1:
        return curve.exact_pieces()
    parts = [part for piece in curve.pieces if (part := exact_pieces(piece)) is not None]
    return joined_pieces(parts) if len(parts) == len(curve.pieces) else None


def joined_pieces(parts: list[FloatArray]) -> FloatArray:
    """Return Bezier pieces of several curves, (k, degree + 1, dim), raised to one degree."""
    degree = max(part.shape[1] for part in parts)
    return np.concatenate([elevated(part, degree - part.shape[1]) for part in parts])


def _check(pieces: tuple[ParametricCurve, ...]) -> None:
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
