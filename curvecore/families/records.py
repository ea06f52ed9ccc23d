"""Named results of curves: local functions, what pieces interpolate, sides of joints, slopes of pieces."""

from __future__ import annotations

from typing import NamedTuple

from curvecore.arithmetic import UNIT_ROUNDOFF
from curvecore.arrays import FloatArray, IntArray

JOINT_ORDERS = 4
"""The number of derivatives compared at joints, the curve itself included: jumps of c to c'''."""

JOINT_ROUNDINGS = 32.0 * UNIT_ROUNDOFF
"""Share of the sizes of its terms by which a derivative at a joint may be off."""


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
