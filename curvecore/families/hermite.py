"""Piecewise polynomials with given derivatives at the joints: cubic, quintic and septic Hermite curves.

`PiecewiseHermite` is what the families share; a family adds its constructor and the functions of its width.
Values come from control points or from expansions (``hermite_taylor``), whichever is faster for so many
parameters, and from the factored functions of ``hermite_basis`` where numbers are too large or too small.
"""

from __future__ import annotations

from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arithmetic import LIMIT, made_finite, vector_lengths
from curvecore.arrays import (
    FloatArray,
    IntArray,
    end_to_end,
    extremes,
    integer,
    parameter_row,
    read_only,
    stacked_jets,
)
from curvecore.bezier.bernstein import control_points, evaluate_inside, weighted_columns
from curvecore.bezier.control_points import cubic_path
from curvecore.errors import CurveError
from curvecore.families.chain import Chain
from curvecore.families.curve import ParametricCurve
from curvecore.families.defaults import JOINT_ORDERS, Interpolant, JointDerivatives, LocalBasis, Slopes
from curvecore.families.hermite_basis import (
    CUBIC,
    QUINTIC,
    LeftFunctions,
    end_derivative_terms,
    left_functions,
    local_coordinates,
    slopes_of,
)
from curvecore.families.hermite_taylor import TaylorPieces, taylor_pieces
from curvecore.families.same_shape import (
    BezierChain,
    check_smooth_joints,
    joint_jets,
    pieces_of,
    smooth_stretches,
)

_ALL = 64  # segments, up to which it pays to expand all of them for a single parameter
_DENSE = 4  # parameters a segment, from which on it pays to expand more
_SAMPLES = 100  # parameters, from which on a cubic is taken to be sampled, and hardly once
_SAMPLED = 256  # segments of a cubic, up to which it then pays
_MANY = 10_000  # parameters from which on it pays to ask whether they ascend


class PiecewiseHermite(ParametricCurve):
    """Base of the Hermite families; R and the functions differ.

    On a segment of length h, with r + s = 1 the relative distances to its
    ends, B_ik = h**k f_k(s, r), and each derivative divides by h once more.
    """

    __slots__ = ("_columns", "_expansions")
    _caches = ("_columns", "_expansions")

    can_close = True
    is_local = True
    most_points = None
    _functions: ClassVar[tuple[LeftFunctions, ...]]

    _columns: FloatArray | None  # weighted control points, made when first needed
    _expansions: dict[int, TaylorPieces | None] | None  # of derivatives by their order, likewise

    @property
    def breaks(self) -> FloatArray:
        """The parameters: the derivatives that are not given may jump at any joint."""
        return self._parameters

    @property
    def is_positive(self) -> bool:
        """True: B_i0 and B_(i+1)0 are positive on their segment, and add up to 1."""
        return True

    @property
    def degree(self) -> int:
        """The degree of each piece: 2 R - 1."""
        return len(self._functions) - 1

    def _evaluate(self, t: FloatArray, order: int) -> FloatArray:
        # At a joint the segment to the right counts, at the last joint the one to the left.
        curve = self._evaluate_inside(t, order)
        return self._evaluate_anywhere(t, order) if curve is None else curve

    def local_basis(self, t: ArrayLike, order: int = 0) -> LocalBasis:
        """Return the 2 R basis functions that live on each t's segment; see `ParametricCurve.local_basis`."""
        at, rank = parameter_row(t), integer(order, "order", 0)
        local = self._scaled_basis(at, rank)
        values = local.values
        with np.errstate(over="ignore", under="ignore", invalid="ignore"):
            h = np.diff(self._parameters)[local.segment, None]
            for k in range(values.shape[2]):
                for _ in range(k - rank):
                    values[:, :, k] *= h
                for _ in range(rank - k):
                    values[:, :, k] /= h
        made_finite(values)
        return local

    def _basis(self, t: FloatArray, order: int) -> FloatArray:
        """Return all basis functions; `local_basis` leaves out the zeros, all but 2 R entries of a row."""
        local = self.local_basis(t, order)
        m, _, width = local.values.shape
        n = len(self._parameters)
        result = np.zeros(m * n * width)
        # B_i and B_(i+1) lie side by side in a row.
        first = np.arange(0, m * n * width, n * width) + local.segment * width
        for column, values in enumerate(local.values.reshape(m, 2 * width).T):
            result[first + column] = values
        return result.reshape(m, n, width)

    _finite_basis = _basis  # `local_basis` makes them finite

    def bezier_pieces(self) -> FloatArray:
        """Return the Bezier control points of all segments, shape (n - 1, 2 R, dim).

        Cubic: p, p + h v / 3; quintic: p, p + h v / 5, p + 2 h v / 5 + h**2 a / 20; septic: p, p + h v / 7,
        p + 2 h v / 7 + h**2 a / 42, p + 3 h v / 7 + h**2 a / 14 + h**3 j / 210, all ahead of a joint; behind
        it the mirror image.
        """
        controls = control_points(self._jets, self._parameters)
        return controls if np.isfinite(controls).all() else np.nan_to_num(controls)

    def bezier_slopes(self, exponent: int) -> Slopes | None:
        """Return the control points of the derivatives, from the data."""
        return slopes_of(np.ldexp(self._jets, -exponent), self._parameters)

    def interpolants(self) -> list[Interpolant]:
        """Return the data of both ends of each segment."""
        t, jets = self._parameters, self._jets
        return [Interpolant(t[i : i + 2], jets[i : i + 2]) for i in range(len(t) - 1)]

    def joint_derivatives(self, *, before: bool) -> JointDerivatives:
        """Return c to c''' at the ends of all segments, given derivatives exactly."""
        values = self._jets[1:] if before else self._jets[:-1]
        scale = vector_lengths(values)
        for order in range(values.shape[1], JOINT_ORDERS):
            terms = end_derivative_terms(self._jets, self._parameters, int(before), order)
            values = np.concatenate((values, terms.sum(axis=0)[:, None]), axis=1)
            scale = np.column_stack((scale, vector_lengths(terms).sum(axis=0)))
        return JointDerivatives(values, scale)

    def parameter_derivatives(self, t: ArrayLike) -> FloatArray:
        """Return dc(t)/dt_i at fixed data, - sum over r of B_ir(t) c^(r+1)(t_i), shape (m, n, dim)."""
        at = parameter_row(t)
        segment, moves = self.local_parameter_derivatives(at)
        result = np.zeros((len(at), *self.points.shape))
        rows = np.arange(len(at))
        for end in (0, 1):
            result[rows, segment + end] = moves[:, end]
        return result

    def local_parameter_derivatives(self, t: FloatArray) -> tuple[IntArray, FloatArray]:
        """Return the segments of t, and dc(t)/dt_i of their two ends, (m, 2, dim)."""
        segment, values = self.local_basis(t)
        moves = np.empty((len(t), 2, self.points.shape[1]))
        with np.errstate(over="ignore", under="ignore", invalid="ignore"):
            for end in (0, 1):
                given = self._jets[segment + end][:, 1:]
                order = given.shape[1] + 1
                beyond = end_derivative_terms(self._jets, self._parameters, end, order).sum(axis=0)
                slopes = np.concatenate([given, beyond[segment, None]], axis=1)
                moves[:, end] = -np.einsum("mr,mrd->md", values[:, end], slopes)
        return segment, moves

    @classmethod
    def check_shape(cls, curve: ParametricCurve) -> None:
        """Raise where pieces are of a higher degree, or a jerk jumps where the acceleration is continuous."""
        check_smooth_joints(cls._pieces_of(curve), cls.derivatives, cls.title)

    @classmethod
    def _pieces_of(cls, curve: ParametricCurve) -> BezierChain:
        chains = [pieces_of(piece, 2 * cls.derivatives + 1, cls.title) for piece in curve.pieces]
        controls = np.concatenate([chain.controls for chain in chains])
        return BezierChain(controls, end_to_end(chain.breaks for chain in chains))

    @classmethod
    def same_shape_as(cls, curve: ParametricCurve) -> ParametricCurve:
        """Return the curve with the same derivatives at the breaks of another of at most its degree.

        A `Chain` where one of them jumps.
        """
        parts = smooth_stretches(cls._pieces_of(curve), cls.derivatives)
        curves = [cls.from_jets(joint_jets(part, cls.derivatives, cls.title), part.breaks) for part in parts]
        return curves[0] if len(curves) == 1 else Chain(curves)

    def _weighted_controls(self) -> FloatArray:
        if self._columns is None:
            with np.errstate(over="ignore", under="ignore", invalid="ignore"):
                columns = weighted_columns(control_points(self._jets, self._parameters))
            self._columns = read_only(made_finite(columns))
        return self._columns

    def _is_inside(self, t: FloatArray) -> bool:
        least, most = extremes(t) if t.size else self.domain
        return bool(least >= self._parameters[0] and most <= self._parameters[-1])

    def _segments(self, t: FloatArray) -> IntArray:
        """Return the index of the segment that holds each t."""
        inner = self._parameters[1:-1]
        if t.size > 4 * inner.size and t.size > _MANY and bool((t[1:] >= t[:-1]).all()):
            # Few joints sought among many ascending parameters, not the reverse.
            count = np.diff(np.searchsorted(t, inner), prepend=0, append=t.size)
            return np.repeat(np.arange(count.size), count)
        return np.searchsorted(inner, t, side="right")

    def _evaluate_at_once(self, t: FloatArray, order: object) -> FloatArray | None:
        """Evaluate by expansions that exist already."""
        pieces = self._expansions.get(order) if self._expansions and type(order) is int else None
        if pieces is None or not t.size or not self._are_worth_expansions(t):
            return None
        return pieces.evaluate(t)

    def _are_worth_expansions(self, t: FloatArray) -> bool:
        # Whether or not the expansions are there already: in what order a curve is asked changes nothing.
        segments = len(self._parameters) - 1
        if segments <= _ALL or t.size >= _DENSE * segments:
            return True
        return segments <= _SAMPLED and t.size >= _SAMPLES and self.degree == 3

    def _evaluate_inside(self, t: FloatArray, order: int) -> FloatArray | None:
        """Evaluate by expansions or through the control points, where that is possible."""
        if not t.size or order > self.degree:
            return None
        # Of quintics and above, control points are the faster way to values of a curve that is new.
        if (order or self.degree == 3) and self._are_worth_expansions(t):
            pieces = self._taylor_pieces(order)
            return None if pieces is None else pieces.evaluate(t)
        if order or not self._is_inside(t):
            return None
        columns = self._weighted_controls()
        # Near the end of the floating point range the general method is the safe one.
        if np.abs(columns).max() >= LIMIT:
            return None
        return evaluate_inside(t, self._segments(t), self._parameters, columns)

    def _taylor_pieces(self, order: int) -> TaylorPieces | None:
        if self._expansions is None:
            self._expansions = {}
        if order not in self._expansions:
            joints, jets = self._parameters, self._jets
            self._expansions[order] = taylor_pieces(joints[:-1], joints[1:], jets[:-1], jets[1:], order)
        return self._expansions[order]

    def _evaluate_anywhere(self, t: FloatArray, order: int) -> FloatArray:
        """Sum the basis functions times the data, both free of powers of h."""
        local = self._scaled_basis(t, order)
        h = np.diff(self._parameters)[local.segment, None]
        curve = np.zeros((t.size, self._jets.shape[2]))
        for end in (0, 1):
            data = self._jets[local.segment + end]
            for k in range(data.shape[1]):
                term = data[:, k]
                for _ in range(k):
                    term = term * h
                curve += local.values[:, end, k, None] * term
        for _ in range(order):
            curve /= h
        made_finite(curve)
        if order == 0:
            self._put_points(curve, t)
        return curve

    def _scaled_basis(self, t: FloatArray, order: int) -> LocalBasis:
        """Return the functions of the local s, without the powers of h."""
        joints = self._parameters
        width = self._jets.shape[1]
        segment = self._segments(t)
        values = np.zeros((t.size, 2, width))
        if order > self.degree:
            return LocalBasis(segment, values)
        exact = order > 0 or not self._is_inside(t)
        with np.errstate(over="ignore", under="ignore", invalid="ignore"):
            at = local_coordinates(t, joints[segment], joints[segment + 1], exact)
            for k, function in enumerate(self._functions[order](at)):
                values[:, 0, k] = function
            for k, function in enumerate(self._functions[order](at.mirrored())):
                np.multiply(function, (-1.0) ** (k + order), out=values[:, 1, k])
        return LocalBasis(segment, values)


# The families

_SMOOTH = 1e-6
"""Share of the largest velocity by which those on both sides of a joint may differ, by differences."""


class HermiteCurve(PiecewiseHermite):
    """Cubic pieces with given velocities.

    Continuously differentiable; c''(t) may jump at the joints.

    Parameters
    ----------
    points : array_like, shape (n, dim)
        p_i = c(t_i), finite; n >= 2, dim >= 1. Copied.
    velocities : array_like, shape (n, dim)
        v_i = c'(t_i), per unit of t. Copied.
    parameters : array_like, shape (n,)
        t_i, finite and strictly increasing. Copied.

    Raises
    ------
    CurveError
        If an argument does not have the shape or values above.

    See Also
    --------
    QuinticHermiteCurve : With accelerations too.
    bessel_velocities, natural_spline_velocities, catmull_rom_velocities : Rules for the velocities.

    Notes
    -----
    Values and derivatives have errors of at most a small multiple of
    u sum |B_ir^(order)(t) d_ir|, u = 2**-53. Results beyond the floating
    point range become the largest finite number.

    Examples
    --------
    >>> from curvecore import HermiteCurve
    >>> curve = HermiteCurve([[0, 0], [1, 0]], [[0, 3], [0, -3]], [0, 1])
    >>> curve
    HermiteCurve(n=2, dim=2, domain=(0, 1))
    >>> curve([0, 0.5, 1]).round(9).tolist()
    [[0.0, 0.0], [0.5, 0.75], [1.0, 0.0]]
    >>> curve.bezier_pieces().tolist()
    [[[0.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, 0.0]]]
    """

    __slots__ = ()

    name = "hermite"
    title = "Hermite"
    full_title = "cubic Hermite"
    rank = 20
    derivatives = 1
    follows = True
    _functions = CUBIC

    def __init__(self, points: ArrayLike, velocities: ArrayLike, parameters: ArrayLike) -> None:
        self._keep(stacked_jets(points, velocities=velocities), parameters)

    @classmethod
    def near(cls, curve: ParametricCurve, tolerance: float) -> ParametricCurve:
        """Return cubic pieces with a curve's points and velocities at their ends; see `ParametricCurve`."""
        if curve.has_exact_pieces:
            return cls.same_shape_as(curve)
        path = cubic_path(curve, tolerance)
        ends, spacing = path.control_points, np.diff(path.parameters)[:, None]
        ahead, behind = 3.0 * (ends[:, 1] - ends[:, 0]) / spacing, 3.0 * (ends[:, 3] - ends[:, 2]) / spacing
        turns = np.abs(behind[:-1] - ahead[1:])
        if (turns > _SMOOTH * np.abs(ahead).max()).any():
            raise CurveError(
                f"its direction jumps at t = {path.parameters[1:-1][turns.max(axis=1).argmax()]:g}"
            )
        points = np.concatenate((ends[:, 0], ends[-1:, 3]))
        return cls(points, np.concatenate((ahead, behind[-1:])), path.parameters)


class QuinticHermiteCurve(PiecewiseHermite):
    """Quintic pieces with given velocities and accelerations.

    Twice continuously differentiable; c'''(t) may jump at the joints.

    Parameters
    ----------
    points : array_like, shape (n, dim)
        p_i = c(t_i), finite; n >= 2, dim >= 1. Copied.
    velocities : array_like, shape (n, dim)
        v_i = c'(t_i), per unit of t. Copied.
    accelerations : array_like, shape (n, dim)
        a_i = c''(t_i), per unit of t squared. Copied.
    parameters : array_like, shape (n,)
        t_i, finite and strictly increasing. Copied.

    Raises
    ------
    CurveError
        If an argument does not have the shape or values above.

    See Also
    --------
    HermiteCurve : With velocities alone.
    natural_spline_accelerations, zero_accelerations : Rules for the accelerations.

    Notes
    -----
    Accuracy and limits are those of `HermiteCurve`.

    Examples
    --------
    >>> from curvecore import QuinticHermiteCurve
    >>> curve = QuinticHermiteCurve([[0], [1]], [[0], [0]], [[0], [0]], [0, 1])
    >>> curve
    QuinticHermiteCurve(n=2, dim=1, domain=(0, 1))
    >>> curve([0, 0.5, 1]).round(9).tolist()
    [[0.0], [0.5], [1.0]]
    >>> curve(0.5, order=1).round(9).tolist()
    [1.875]
    """

    __slots__ = ()

    name = "quintic_hermite"
    title = "quintic Hermite"
    rank = 30
    derivatives = 2
    _functions = QUINTIC

    def __init__(
        self,
        points: ArrayLike,
        velocities: ArrayLike,
        accelerations: ArrayLike,
        parameters: ArrayLike,
    ) -> None:
        self._keep(stacked_jets(points, velocities=velocities, accelerations=accelerations), parameters)


class SepticHermiteCurve(PiecewiseHermite):
    """Septic pieces with given velocities, accelerations and jerks.

    Three times continuously differentiable; the fourth derivative, the snap, may jump at the joints. Of all
    motions with these data at both ends of a segment its integral of |c''''|**2 is the least [1]_.

    Parameters
    ----------
    points : array_like, shape (n, dim)
        p_i = c(t_i), finite; n >= 2, dim >= 1. Copied.
    velocities : array_like, shape (n, dim)
        v_i = c'(t_i), per unit of t. Copied.
    accelerations : array_like, shape (n, dim)
        a_i = c''(t_i), per unit of t squared. Copied.
    jerks : array_like, shape (n, dim)
        j_i = c'''(t_i), per unit of t cubed. Copied.
    parameters : array_like, shape (n,)
        t_i, finite and strictly increasing. Copied.

    Raises
    ------
    CurveError
        If an argument does not have the shape or values above.

    See Also
    --------
    QuinticHermiteCurve : Without the jerks.
    natural_spline_jerks : A rule for the jerks.

    Notes
    -----
    Accuracy and limits are those of `HermiteCurve`.

    References
    ----------
    .. [1] D. Mellinger and V. Kumar, "Minimum snap trajectory generation and control for quadrotors", IEEE
       International Conference on Robotics and Automation 2011, 2520-2525.

    Examples
    --------
    >>> from curvecore import SepticHermiteCurve
    >>> rest = [[0], [0]]
    >>> curve = SepticHermiteCurve([[0], [1]], rest, rest, rest, [0, 1])
    >>> curve
    SepticHermiteCurve(n=2, dim=1, domain=(0, 1))
    >>> curve(0.5, order=1).tolist()
    [2.1875]
    """

    __slots__ = ()

    name = "septic_hermite"
    title = "septic Hermite"
    rank = 50
    derivatives = 3
    _functions = left_functions(4)

    def __init__(
        self,
        points: ArrayLike,
        velocities: ArrayLike,
        accelerations: ArrayLike,
        jerks: ArrayLike,
        parameters: ArrayLike,
    ) -> None:
        jets = stacked_jets(points, velocities=velocities, accelerations=accelerations, jerks=jerks)
        self._keep(jets, parameters)


def hermite_functions(t: ArrayLike, parameters: ArrayLike, order: int = 0) -> FloatArray:
    """Return the functions of cubic Hermite pieces: for families that make velocities of their points.

    Parameters
    ----------
    t : float or array_like of any shape
        Finite, inside the domain or not. At a parameter the piece to the right counts.
    parameters : array_like, shape (n,)
        t_i, finite and strictly increasing; n >= 2.
    order : int, optional
        Order of the derivative with respect to t, at least 0.

    Returns
    -------
    ndarray, shape (*shape of t, n, 2)
        ``[..., i, 0]`` belongs to the point p_i, ``[..., i, 1]`` to the velocity v_i, per unit of t.

    Raises
    ------
    CurveError
        If an argument does not have the shape or values above.

    See Also
    --------
    HermiteCurve : The curve with given velocities; its `basis` are these functions.

    Examples
    --------
    >>> from curvecore import hermite_functions
    >>> hermite_functions(0.5, [0, 1]).tolist()
    [[0.5, 0.125], [0.5, -0.125]]
    """
    none = np.zeros((np.size(parameters), 1))
    return HermiteCurve(none, none, parameters).basis(t, order)
