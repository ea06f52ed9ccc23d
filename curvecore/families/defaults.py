"""Methods of every curve that a family may override, each with its default.

The defaults follow from what a family must say, `ParametricCurve._basis`, and from its `breaks` and `degree`.
They are correct, if slower; a family overrides what it knows how to do faster or exactly.

- Values: `_evaluate`, `derivatives_at`, `local_basis`, `support`.
- Polynomial pieces: `bezier_pieces` and what exact arithmetic needs.
- Other data for the same curve: `same_shape_as`, `near`, `refined`, `restricted`.
- Joints, and derivatives with respect to the parameters.

Their results are at the end of the file.
"""

from __future__ import annotations

from abc import ABC
from typing import TYPE_CHECKING, ClassVar, NamedTuple, Protocol, Self

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arithmetic import UNIT_ROUNDOFF, made_finite
from curvecore.arrays import BoolArray, FloatArray, IntArray, parameter_row
from curvecore.bezier.bernstein import weights
from curvecore.errors import CurveError

if TYPE_CHECKING:
    from curvecore.families.curve import Extrapolate, ParametricCurve

    class _Curve(Protocol):
        """The members of `ParametricCurve` that the defaults use."""

        @property
        def points(self) -> FloatArray: ...
        @property
        def parameters(self) -> FloatArray: ...
        @property
        def jets(self) -> FloatArray: ...
        @property
        def domain(self) -> tuple[float, float]: ...
        def evaluate(self, t: ArrayLike, order: int = 0, extrapolate: Extrapolate = True) -> FloatArray: ...
        def with_data(self, jets: ArrayLike, parameters: ArrayLike) -> Self: ...
        def _finite_basis(self, t: FloatArray, order: int) -> FloatArray: ...
else:
    _Curve = ABC

JOINT_ORDERS = 4
"""The number of derivatives compared at joints, the curve itself included: jumps of c to c'''."""

JOINT_ROUNDINGS = 32.0 * UNIT_ROUNDOFF
"""Share of the sizes of its terms by which a derivative at a joint may be off."""

_HIGHEST_DRAWN = 8
"""Degree up to which control points of the pieces are of use to draw and to search a curve."""

_STEP = 2.0**-13
"""Share of the distance of neighbouring parameters by which one is moved for a difference quotient."""


class FamilyDefaults(_Curve):
    """The part of `ParametricCurve` that a family may override; it follows from the basis functions."""

    __slots__ = ()

    title: ClassVar[str]
    interpolates: ClassVar[bool]
    is_continuous: ClassVar[bool]
    is_local: ClassVar[bool]

    # What a family says of its pieces

    @property
    def breaks(self) -> FloatArray:
        """The parameters at which derivatives may jump, ascending, the ends included; shape (k,)."""
        return self.parameters[[0, -1]]

    @property
    def degree(self) -> int | None:
        """The degree of the polynomial, or of each polynomial piece; None where they are none."""
        return None

    @property
    def kind(self) -> str:
        """Words for its functions where they are no polynomials; empty where they are, or it is not known."""
        return ""

    @property
    def is_positive(self) -> bool:
        """Whether no B_i0 is negative in the domain; they add up to 1, so that no error grows there."""
        return False

    @property
    def passes_points(self) -> bool:
        """Whether c(t_i) is p_i, as the family says by `interpolates`; measured where that may be wrong."""
        return self.interpolates

    @property
    def knot_points(self) -> FloatArray:
        """The points c(t_i), shape (n, dim): p_i, or beside these."""
        return self.points if self.passes_points else self.evaluate(self.parameters)

    @property
    def nodes(self) -> FloatArray:
        """The parameters near which the points act most, shape (n,): t_i, of control points others."""
        return self.parameters

    @property
    def idle_parameters(self) -> BoolArray:
        """Whether the curve does not change when t_i alone changes, shape (n,)."""
        return np.zeros(len(self.parameters), dtype=bool)

    @property
    def difference_digits(self) -> tuple[int, ...]:
        """Digits that the first, second and third derivatives keep where they are differences of values.

        Of functions as smooth as their parameters are spaced. Empty where derivatives are no differences.
        """
        return ()

    # Values

    def _evaluate(self, t: FloatArray, order: int) -> FloatArray:
        """Return the order-th derivative of the curve at finite t (m,), as (m, dim).

        Numbers may overflow on the way, without warnings. A family that overrides it returns finite numbers,
        and p_i at t_i where it interpolates.
        """
        basis = self._finite_basis(t, order)
        data = self.jets.reshape(-1, self.jets.shape[2])
        curve = made_finite(basis.reshape(len(basis), len(data)) @ data)
        if order == 0 and self.passes_points:
            self._put_points(curve, t)
        return curve

    def _put_points(self, curve: FloatArray, t: FloatArray) -> None:
        """Put p_i into rows of `curve` where t is t_i."""
        joint = np.minimum(np.searchsorted(self.parameters, t), len(self.parameters) - 1)
        hit = t == self.parameters[joint]
        curve[hit] = self.points[joint[hit]]

    def _evaluate_at_once(self, t: FloatArray, order: object) -> FloatArray | None:
        """Evaluate at unchecked arguments, where the checks would take most of the time; else return None.

        Parameters
        ----------
        t : ndarray, shape (m,)
            Any doubles.
        order : object
            An int, or something else.
        """
        return None

    def derivatives_at(self, t: FloatArray, orders: tuple[int, ...]) -> list[FloatArray]:
        """Return derivatives of several orders at many parameters, where that takes less than one by one.

        Parameters
        ----------
        t : ndarray, shape (m,)
            Finite.
        orders : tuple of int
            Each at least 0.

        Returns
        -------
        list of ndarray, shape (m, dim)
            As from `evaluate`; a family says by how much they may be less accurate.
        """
        return [self.evaluate(t, order) for order in orders]

    def local_basis(self, t: ArrayLike, order: int = 0) -> LocalBasis:
        """Return the basis functions that live on each t's segment, where `is_local`.

        Parameters
        ----------
        t : float or array_like, shape (m,)
            Finite; a scalar counts as m = 1.
        order : int, optional
            Order of the derivative, at least 0.

        Returns
        -------
        LocalBasis
            The two functions of each kind that are not 0 there, and which they are.

        Raises
        ------
        CurveError
            If the family's functions reach further.
        """
        raise CurveError("curve must be of a family whose functions are local")

    def support(self, index: int) -> tuple[float, float]:
        """Return the interval outside of which all functions of a point are 0, as far as that is known.

        Parameters
        ----------
        index : int
            Of the point, from 0 to n - 1.

        Returns
        -------
        tuple of float
            Its ends; the whole domain where it is not known.
        """
        if not self.is_local:
            return self.domain
        t = self.parameters
        return float(t[max(index - 1, 0)]), float(t[min(index + 1, len(t) - 1)])

    # Polynomial pieces

    def bezier_pieces(self) -> FloatArray | None:
        """Return the Bezier control points of the pieces between `breaks`.

        Returns
        -------
        ndarray, shape (k - 1, degree + 1, dim), or None
            None where the pieces are no polynomials, of a degree above 8, or the one polynomial through all
            points: control points are then of no use to draw them (see `lagrange_to_bezier`). Here from
            degree + 1 values inside each piece, to a few roundings of the largest.
        """
        if self.degree is None or self.degree > _HIGHEST_DRAWN:
            return None
        if len(self.breaks) == 2 and self.degree == len(self.points) - 1:
            return None
        controls = self._sampled_pieces(self.degree)
        if self.is_continuous:
            # Neighbours meet at the same point, which is p_i where the curve passes it.
            ends = self.evaluate(self.breaks)
            controls[:, 0], controls[:, -1] = ends[:-1], ends[1:]
        return controls

    def _sampled_pieces(self, degree: int) -> FloatArray:
        """Return the control points of the polynomials through values inside the pieces.

        Their shape is (k, degree + 1, dim). At a break itself the curve may jump.
        """
        s = np.sin((np.arange(degree + 1) + 0.5) * (np.pi / (2 * (degree + 1)))) ** 2
        starts, lengths = self.breaks[:-1, None], np.diff(self.breaks)[:, None]
        with np.errstate(over="ignore", under="ignore", invalid="ignore"):
            values = self.evaluate(starts + s * lengths)
            return made_finite(np.asarray(np.linalg.solve(weights(s, degree), values), dtype=np.float64))

    def exact_pieces(self) -> FloatArray | None:
        """Return the Bezier control points of the pieces between `breaks`, also of high degree.

        Returns
        -------
        ndarray, shape (k - 1, degree + 1, dim), or None
            For a change of basis; None where the curve is no polynomial, or one through too many points.
        """
        return self.bezier_pieces()

    @property
    def has_exact_pieces(self) -> bool:
        """Whether `exact_pieces` returns them; known before they are computed."""
        return self.exact_pieces() is not None

    def surely_exceeds(self, degree: int) -> bool:
        """Return whether the pieces are known to be of a higher degree before they are computed.

        Parameters
        ----------
        degree : int

        Returns
        -------
        bool
            False where only `exact_pieces` can tell.
        """
        return False

    def bezier_slopes(self, exponent: int) -> Slopes | None:
        """Return the control points of the derivatives of `bezier_pieces`, from the data.

        Parameters
        ----------
        exponent : int
            They are divided by 2**exponent.

        Returns
        -------
        Slopes or None
            They do not depend on how far away the origin is. None where they are not known better than as
            differences of the control points.
        """
        return None

    def interpolants(self) -> list[Interpolant] | None:
        """Return the data that each polynomial piece between `breaks` interpolates.

        Returns
        -------
        list of Interpolant, or None
            What exact arithmetic needs to know of a curve; None where that is not known.
        """
        return None

    # Other data for the same curve

    @classmethod
    def check_shape(cls, curve: ParametricCurve) -> None:
        """Raise where no curve of this family is another one; the other work of `same_shape_as` is left out.

        Derivatives may jump at corners: one above the acceleration that jumps anywhere else is a reason, too.

        Parameters
        ----------
        curve : ParametricCurve
            Of another family.

        Raises
        ------
        CurveError
            The message says why. Here it is left to `same_shape_as`.
        """

    @classmethod
    def same_shape_as(cls, curve: ParametricCurve) -> ParametricCurve:
        """Return a curve of this family that is another one, written with other data.

        Parameters
        ----------
        curve : ParametricCurve
            Of another family.

        Returns
        -------
        ParametricCurve
            The same curve but for rounding.

        Raises
        ------
        CurveError
            If there is none, or no way to it is known: the message says why.
        """
        raise CurveError(f"no curve of another family can be written as a {cls.title} curve")

    @classmethod
    def near(cls, curve: ParametricCurve, tolerance: float) -> ParametricCurve:
        """Return a curve of this family that keeps within a distance of another one.

        Here the other one itself, by `same_shape_as`; a family that can follow any curve overrides it.

        Parameters
        ----------
        curve : ParametricCurve
            Of any family.
        tolerance : float
            Largest distance at equal parameters, greater than 0.

        Returns
        -------
        ParametricCurve
            A curve of this family, or several end to end.

        Raises
        ------
        CurveError
            If it can be none of this family, or no way to it is known.
        """
        return cls.same_shape_as(curve)

    def refined(self, t: float) -> Self | None:
        """Return the same curve with one more control point, for more detail near t.

        Parameters
        ----------
        t : float
            Inside the domain.

        Returns
        -------
        ParametricCurve or None
            None where that is done by one more point on the curve, or cannot be done.
        """
        return None

    def restricted(self, start: float, end: float) -> Self | None:
        """Return the same curve on a stretch of its domain, as one of its own family.

        Parameters
        ----------
        start, end : float
            Inside the domain, start < end.

        Returns
        -------
        ParametricCurve or None
            None where that takes the data at both ends of the stretch alone, or cannot be done.
        """
        return None

    # Joints

    def joint_derivatives(self, *, before: bool) -> JointDerivatives:
        """Return c to c''' at the ends of all segments.

        Parameters
        ----------
        before : bool
            Whether before t_1, ..., t_(n-1), or after t_0, ..., t_(n-2).

        Returns
        -------
        JointDerivatives
            Of n - 1 ends.
        """
        t, h = self.parameters, np.diff(self.parameters)
        at = np.where(before & np.isin(t, self.breaks), np.nextafter(t, -np.inf), t)
        shorter = np.minimum(np.concatenate((h[:1], h)), np.concatenate((h, h[-1:])))
        orders = [self._about_a_point(at, order, shorter) for order in range(JOINT_ORDERS + 1)]
        values, sizes = (np.stack(columns, axis=1) for columns in zip(*orders, strict=True))
        # From beside a break to it: without this step, parameters far from 0 would make derivatives jump.
        values = values[:, :-1] + (t - at)[:, None, None] * values[:, 1:]
        values[:, 0] = self.evaluate(t)
        side = slice(1, None) if before else slice(-1)
        return JointDerivatives(values[side], sizes[side, :-1])

    def _about_a_point(self, t: FloatArray, order: int, h: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return derivatives (m, dim) and the sizes of their terms (m,), with the first point as the origin.

        Derivatives of functions that add up to 1 add up to 0: where the origin lies counts for nothing. Those
        that are differences, over lengths h, are off by the digits they lose, as terms of that size would be.
        """
        basis = self._finite_basis(t, order)
        origin = self.jets[0, 0]
        data = self.jets.copy()
        data[:, 0] -= origin
        digits = self.difference_digits[order - 1 : order] if order else ()
        lost = sum(2.0 * 10.0**-count for count in digits) / h**order
        shifts = basis[:, :, 0].sum(axis=1)
        if order:
            roundings = 64.0 * UNIT_ROUNDOFF * np.abs(basis[:, :, 0]).sum(axis=1)
            shifts[np.abs(shifts) <= roundings + lost] = 0.0
        flat, rows = basis.reshape(len(t), -1), data.reshape(basis[0].size, -1)
        values = flat @ rows + shifts[:, None] * origin
        size = (np.abs(flat) @ np.abs(rows) + np.abs(shifts[:, None] * origin)).max(axis=1)
        reach = np.abs(data[:, 0]).max() + (shifts != 0.0) * np.abs(origin).max()
        return values, size + lost / JOINT_ROUNDINGS * reach

    # Derivatives with respect to the parameters

    def parameter_derivatives(self, t: ArrayLike) -> FloatArray:
        """Return dc(t)/dt_i at fixed t and data, for all i.

        Parameters
        ----------
        t : float or array_like, shape (m,)
            A scalar counts as m = 1.

        Returns
        -------
        ndarray, shape (m, n, dim)
            Per unit of t. Here by differences of curves with moved parameters, to some nine digits; the
            ends are moved outwards only, for a basis may end where they are.
        """
        at = parameter_row(t)
        moves = [self._moved_by(index, at) for index in range(len(self.parameters))]
        return np.stack(moves, axis=1)

    def _moved_by(self, index: int, t: FloatArray) -> FloatArray:
        """Return dc(t)/dt_index, shape (m, dim), to some nine digits.

        An end is moved outwards only, for a basis may end where it is.
        """
        joints = self.parameters
        step = float(np.diff(joints[max(index - 1, 0) : index + 2]).min()) * _STEP

        def moved(by: float) -> FloatArray:
            parameters = joints.copy()
            parameters[index] += by * step
            return self.with_data(self.jets, parameters).evaluate(t)

        if 0 < index < len(joints) - 1:
            # Of order 4: what is left out is the fifth derivative.
            return (8.0 * (moved(1) - moved(-1)) - (moved(2) - moved(-2))) / (12.0 * step)
        outwards = -1.0 if index == 0 else 1.0
        here, one, two, three = (moved(outwards * k) for k in range(4))
        return outwards * (-11.0 * here + 18.0 * one - 9.0 * two + 2.0 * three) / (6.0 * step)

    def parameter_derivative(self, index: int, t: ArrayLike) -> FloatArray:
        """Return dc(t)/dt_i of one i.

        Parameters
        ----------
        index : int
            i, from 0 to n - 1.
        t : float or array_like, shape (m,)
            A scalar counts as m = 1.

        Returns
        -------
        ndarray, shape (m, dim)
            As from `parameter_derivatives`.
        """
        return self.parameter_derivatives(t)[:, index]

    def local_parameter_derivatives(self, t: FloatArray) -> tuple[IntArray, FloatArray]:
        """Return the segments of t, and dc(t)/dt_i of their two ends, where `is_local`.

        Parameters
        ----------
        t : ndarray, shape (m,)
            Finite.

        Returns
        -------
        segment : ndarray of int, shape (m,)
            Between which joints each t lies.
        moves : ndarray, shape (m, 2, dim)
            Of the two joints.
        """
        segment = self.local_basis(t).segment
        moves = self.parameter_derivatives(t)
        return segment, np.take_along_axis(moves, (segment[:, None] + np.arange(2))[:, :, None], axis=1)


# Results


class LocalBasis(NamedTuple):
    """The basis functions that are not zero by construction.

    Attributes
    ----------
    segment : ndarray of int, shape (m,)
        Index i of the segment from joint i to joint i + 1 that holds t.
    values : ndarray, shape (m, 2, R)
        ``[k, 0, r]`` is B_ir(t_k) and ``[k, 1, r]`` is B_(i+1)r(t_k).

    See Also
    --------
    ParametricCurve.local_basis : The method that returns it.

    Examples
    --------
    >>> from curvecore import HermiteCurve
    >>> curve = HermiteCurve([[0], [1], [0]], [[0], [0], [0]], [0, 1, 2])
    >>> local = curve.local_basis([0.5, 1.5])
    >>> local.segment.tolist(), local.values[:, :, 0].tolist()
    ([0, 1], [[0.5, 0.5], [0.5, 0.5]])
    """

    segment: IntArray
    values: FloatArray


class Interpolant(NamedTuple):
    """Data that one polynomial piece of a curve interpolates: it is of the least degree that does.

    Attributes
    ----------
    parameters : ndarray, shape (k,)
        The piece lies between the first and the last.
    jets : ndarray, shape (k, R, dim)
        Its value and R - 1 derivatives there.

    See Also
    --------
    ParametricCurve.interpolants : The method that returns them.

    Examples
    --------
    >>> from curvecore import HermiteCurve
    >>> curve = HermiteCurve([[0], [1], [0]], [[0], [1], [2]], [0, 1, 3])
    >>> [each.parameters.tolist() for each in curve.interpolants()]
    [[0.0, 1.0], [1.0, 3.0]]
    >>> curve.interpolants()[1].jets.tolist()
    [[[1.0], [1.0]], [[0.0], [2.0]]]
    """

    parameters: FloatArray
    jets: FloatArray


class JointDerivatives(NamedTuple):
    """Derivatives on one side of joints, and the sizes of the terms they are sums of.

    Attributes
    ----------
    values : ndarray, shape (k, 4, dim)
        c, c', c'', c'''.
    scale : ndarray, shape (k, 4)
        What their roundings are relative to.
    """

    values: FloatArray
    scale: FloatArray


class Slopes(NamedTuple):
    """Control points of derivatives with respect to the local s in [0, 1] of each piece.

    Attributes
    ----------
    values : ndarray, shape (k, degree, dim)
    error : ndarray, shape (k,)
        What they may be off.
    """

    values: FloatArray
    error: FloatArray
