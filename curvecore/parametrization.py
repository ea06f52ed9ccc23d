"""Rules that give the parameters t_i of points.

Every rule returns n strictly increasing values, the first exactly 0 and the
last exactly 1; the caller maps them to its own interval (`spread`).

References
----------
.. [1] E. T. Y. Lee, "Choosing nodes in parametric curve interpolation",
   Computer-Aided Design 21 (1989) 363-370: the power family.
.. [2] L. N. Trefethen, "Approximation Theory and Approximation Practice",
   SIAM 2013, chapter 2: Chebyshev points of the second kind.
.. [3] L. Brutman, "On the Lebesgue function for polynomial interpolation",
   SIAM J. Numer. Anal. 15 (1978) 694-704: the extended points of the first.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arithmetic import (
    DoubleDouble,
    add,
    cumulative_sum,
    difference,
    divide,
    exact_lengths,
    logarithm,
    multiply,
    rescaled,
    square_root,
)
from curvecore.arrays import FloatArray, finite_number, integer, point_array
from curvecore.errors import CurveError


class Spaced(NamedTuple):
    """Increasing parameters, given by their distances: sums over turns of a closed curve would be rounded.

    Attributes
    ----------
    spacing : ndarray, shape (n - 1,)
        Distances of consecutive ones.
    """

    spacing: FloatArray


def uniform(n: int) -> FloatArray:
    """Return n equally spaced parameters in [0, 1].

    Parameters
    ----------
    n : int
        Number of points, at least 2.

    Returns
    -------
    ndarray, shape (n,)
        i / (n - 1), each correctly rounded.

    See Also
    --------
    chebyshev : Spacing that many points need.
    chord_length : Spacing by distance.

    Examples
    --------
    >>> from curvecore import uniform
    >>> uniform(5).tolist()
    [0.0, 0.25, 0.5, 0.75, 1.0]
    """
    count = integer(n, "n", 2)
    return np.arange(count, dtype=np.float64) / (count - 1)


def chebyshev(n: int) -> FloatArray:
    """Return the n Chebyshev points of the second kind, mapped to [0, 1].

    Parameters
    ----------
    n : int
        Number of points, at least 2. Above some 10**8 the points next to 1
        are no longer distinct in double precision.

    Returns
    -------
    ndarray, shape (n,)
        (1 - cos(pi i / (n - 1))) / 2, symmetric about 1/2.

    See Also
    --------
    uniform : Equal spacing.
    lebesgue_constant : What the spacing does.

    Examples
    --------
    >>> from curvecore import chebyshev
    >>> chebyshev(5).round(9).tolist()
    [0.0, 0.146446609, 0.5, 0.853553391, 1.0]
    """
    count = integer(n, "n", 2)
    # sin(x/2)**2 keeps all digits next to 0, where 1 - cos(x) loses them.
    half = np.sin(np.arange((count + 1) // 2) * (math.pi / (2 * (count - 1)))) ** 2
    return _symmetric(half, count, "n is too large: neighbouring Chebyshev points")


def chebyshev_roots(n: int) -> FloatArray:
    """Return the n Chebyshev points of the first kind, stretched to [0, 1].

    These are the roots of the Chebyshev polynomial T_n. They leave out the ends of the interval that they
    belong to; here the first and the last one are its ends (extended Chebyshev points). Their Lebesgue
    constant is within 0.03 of 2/pi (log n + 0.5772 + log(4/pi)), which the least one tends to [3]_.

    Parameters
    ----------
    n : int
        Number of points, at least 2; not above some 10**8, as of `chebyshev`.

    Returns
    -------
    ndarray, shape (n,)
        (1 - cos((2 i + 1) a) / cos(a)) / 2 with a = pi / (2 n), symmetric about 1/2.

    See Also
    --------
    chebyshev : Points of the second kind.
    uniform : Equal spacing.

    Examples
    --------
    >>> from curvecore import chebyshev_roots
    >>> chebyshev_roots(5).round(9).tolist()
    [0.0, 0.190983006, 0.5, 0.809016994, 1.0]
    """
    count = integer(n, "n", 2)
    step = math.pi / (2 * count)
    # A product of sines keeps all digits next to 0, where the difference of cosines loses them.
    index = np.arange((count + 1) // 2)
    half = np.sin((index + 1) * step) * np.sin(index * step) / math.cos(step)
    return _symmetric(half, count, "n is too large: neighbouring Chebyshev points")


def _symmetric(half: FloatArray, count: int, what: str) -> FloatArray:
    """Return so many parameters, of which the lower half is given, the middle one with it."""
    parameters = np.empty(count)
    parameters[: half.size] = half
    parameters[count - half.size :] = 1.0 - half[::-1]
    if count % 2:
        parameters[count // 2] = 0.5
    _check_increasing(parameters, what)
    return parameters


def chord_length(points: ArrayLike) -> FloatArray:
    """Return parameters in proportion to the distances between the points.

    Parameters
    ----------
    points : array_like, shape (n, dim)
        Consecutive points must be distinct.

    Returns
    -------
    ndarray, shape (n,)
        Each within 0.51 units in its last place, however many the points are.

    Raises
    ------
    CurveError
        If consecutive points coincide, or lie so close together that their
        parameters would be equal in double precision.

    See Also
    --------
    centripetal, power, uniform : Other rules.

    Notes
    -----
    The distance h of two parameters next to t is off by up to 2**-53 t / h of itself. A curve through points
    very close together, and every bound of its errors, is for these t and not for the exact ones.

    Examples
    --------
    >>> from curvecore import chord_length
    >>> chord_length([[0, 0], [1, 0], [1, 3]]).tolist()
    [0.0, 0.25, 1.0]
    """
    return _power(point_array(points), 1.0, "chord-length")


def centripetal(points: ArrayLike) -> FloatArray:
    """Return parameters in proportion to the square roots of the distances.

    Parameters
    ----------
    points : array_like, shape (n, dim)
        n >= 2; consecutive points must be distinct.

    Returns
    -------
    ndarray, shape (n,)
        From 0 to 1, strictly increasing.

    Raises
    ------
    CurveError
        If points are unusable, two neighbours coincide, or parameters would.

    See Also
    --------
    chord_length, power, uniform : Other rules.

    Examples
    --------
    >>> from curvecore import centripetal
    >>> centripetal([[0, 0], [1, 0], [5, 0]]).round(9).tolist()
    [0.0, 0.333333333, 1.0]
    """
    return _power(point_array(points), 0.5, "centripetal")


def power(points: ArrayLike, alpha: float) -> FloatArray:
    """Return parameters with spacing proportional to distance ** alpha.

    Parameters
    ----------
    points : array_like, shape (n, dim)
        Consecutive points must be distinct unless alpha is 0.
    alpha : float
        At least 0; 0 is `uniform`, 1/2 `centripetal`, 1 `chord_length`.

    Returns
    -------
    ndarray, shape (n,)
        As accurate as those of `chord_length`.

    Raises
    ------
    CurveError
        As `chord_length`, and for an alpha that is negative or not finite.

    See Also
    --------
    uniform, centripetal, chord_length : The same for alpha 0, 1/2 and 1.

    Examples
    --------
    >>> from curvecore import power
    >>> power([[0, 0], [1, 0], [5, 0]], 0.5).round(9).tolist()
    [0.0, 0.333333333, 1.0]
    """
    return _power(point_array(points), _exponent(alpha), "power-family")


def relative_spacing(points: FloatArray, alpha: float, rule: str) -> FloatArray:
    """Return distance ** alpha, relative to the largest one.

    Parameters
    ----------
    points : ndarray, shape (n, dim)
        Checked points.
    alpha : float
        At least 0.
    rule : str
        The rule's name for messages.

    Returns
    -------
    ndarray, shape (n - 1,)
        In [0, 1]; 0 only where the power underflows.

    Raises
    ------
    CurveError
        For a negative alpha, and for coincident points unless alpha is 0.
    """
    with np.errstate(under="ignore"):
        spacing = _spacing(points, _exponent(alpha), rule).high
        return np.asarray(spacing / spacing.max())


def _exponent(alpha: float) -> float:
    exponent = finite_number(alpha, "alpha")
    if exponent < 0.0:
        raise CurveError(f"alpha must be at least 0, not {exponent}")
    return exponent


def _power(points: FloatArray, alpha: float, rule: str) -> FloatArray:
    """Return the parameters, each within 0.51 units in its last place."""
    with np.errstate(under="ignore"):
        total = cumulative_sum(_spacing(points, alpha, rule))
        shares = divide(total, DoubleDouble(total.high[-1], total.low[-1]))
    parameters = np.zeros(len(points))
    parameters[1:] = shares.high
    _check_increasing(parameters, f"{rule} parameters cannot distinguish these points: parameters")
    return parameters


def _spacing(points: FloatArray, alpha: float, rule: str) -> DoubleDouble:
    """Return distance ** alpha, (n - 1,), in units such that the largest one is about 1."""
    if alpha == 0.0:
        return DoubleDouble(np.ones(len(points) - 1), np.zeros(len(points) - 1))
    length = _relative_distances(points, rule)
    if alpha in (0.5, 1.0):
        return length if alpha == 1.0 else square_root(length)
    rounded = length.high**alpha
    # By the difference of logarithms the power is off, relatively.
    wanted = multiply(logarithm(length), DoubleDouble(np.array(alpha), np.array(0.0)))
    reached = logarithm(DoubleDouble(rounded, np.zeros_like(rounded)))
    return DoubleDouble(rounded, rounded * add(wanted, DoubleDouble(-reached.high, -reached.low)).high)


def _relative_distances(points: FloatArray, rule: str) -> DoubleDouble:
    """Return the distances of consecutive points in units of a power of two, the largest one about 1."""
    # Halves, because the difference of two finite coordinates may overflow.
    halved = 0.5 * points if np.abs(points).max() > 1e300 else points
    step = difference(halved[1:], halved[:-1])
    largest = np.abs(step.high).max(axis=1)
    if not largest.all():
        i = int(np.argmin(largest))
        raise CurveError(
            f"points {i} and {i + 1} coincide; {rule} parameters need distinct consecutive points", (i, i + 1)
        )
    # Each in its own units, which keeps every square in range.
    _, exponent = np.frexp(largest)
    lengths = exact_lengths(rescaled(step, -exponent[:, None]))
    return rescaled(lengths, exponent - exponent.max())


def _check_increasing(parameters: FloatArray, what: str) -> None:
    increasing = parameters[1:] > parameters[:-1]
    if not increasing.all():
        i = int(np.argmin(increasing))
        raise CurveError(f"{what} {i} and {i + 1} would be equal in double precision", (i, i + 1))


def with_one_more(parameters: FloatArray, t: float) -> FloatArray:
    """Return parameters with one more at t inside of them, or halfway to the next where t is one of them."""
    index = int(np.searchsorted(parameters, t))
    if parameters[index] == t:
        t = 0.5 * (t + float(parameters[index + 1]))
        index += 1
    return np.insert(parameters, index, t)


def spread(shares: FloatArray, start: float, end: float) -> FloatArray:
    """Return the parameters at shares of an interval, (n,); the last one is its end exactly."""
    t: FloatArray = start + shares * (end - start)
    t[-1] = end
    return t
