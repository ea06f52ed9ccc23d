"""The same curve, computed by several methods with k decimal digits.

What is rounded to k significant digits, half to even, is one of three things
(`Rounding`): the result of every addition, subtraction, multiplication and
division, as on a pocket calculator; the coefficients alone, found and evaluated
exactly; or the data alone, with exact arithmetic after that. `rounded_data` rounds
data, and `exact_values` is the truth to compare with.

Where every step is rounded the data enter exactly as they are: what is seen is
the method alone. The order of the operations is part of the contract, so that a
pocket calculator gives the same digits:

``monomial``
    Rows 1, t_i, t_i t_i, (t_i t_i) t_i, ...; elimination with partial pivoting
    (the first of equal pivots), row - (entry / pivot) pivot row; back
    substitution, (rhs - a_(k,k+1) x_(k+1) - ...) / pivot from left to right;
    Horner. For the Hermite families one system for each segment, in powers of
    t: rows for the point, velocity (acceleration, jerk) at its beginning, then
    at its end, with entries k t**(k-1), (k (k-1)) t**(k-2) and (k (k-1) (k-2)) t**(k-3).
``newton``
    Divided differences (a - b) / (t_(i+j) - t_i); from the last,
    result (t - t_i) + difference.
``lagrange``
    prod (t - t_j) over j != i in ascending order, over prod (t_i - t_j); sum
    of these times p_i in ascending order.
``barycentric``
    w_i = 1 / prod (t_i - t_j); sum of (w_i / (t - t_i)) p_i over sum of
    w_i / (t - t_i); p_i where t = t_i.
``basis``
    Hermite: h = t_(i+1) - t_i, s = (t - t_i) / h, r = (t_(i+1) - t) / h, and the
    factored functions of s and r that `_cubic`, `_quintic` and `_septic` spell out.

The coefficients of a method are what its functions of t are multiplied with:
those of 1, t, t**2, ...; divided differences; the points; the weights w_i and
the points; points and their derivatives. An error e of the coefficient
of t**k moves the curve by e t**k, one of a point p_i by e L_i(t).

References
----------
.. [1] N. J. Higham, "Accuracy and Stability of Numerical Algorithms", 2nd
   ed., SIAM 2002, sections 5.3 (Newton), 9.1 (pivoting), 22 (Vandermonde).
.. [2] N. J. Higham, "The numerical stability of barycentric Lagrange
   interpolation", IMA J. Numer. Anal. 24 (2004) 547-556.
"""

from __future__ import annotations

from decimal import ROUND_HALF_EVEN, Context, Decimal
from enum import StrEnum

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arithmetic import LARGEST
from curvecore.arrays import (
    FloatArray,
    integer,
    parameter_row,
)
from curvecore.errors import CurveError
from curvecore.rounding.data import Data, decimal_context
from curvecore.rounding.decimal_methods import (
    HERMITE_METHODS,
    LAGRANGE_METHODS,
    Form,
    decimals,
    exact_context,
)

_DISPLAYED = 30
"""Digits of a result that was computed exactly: enough beyond those shown that to round again is no error."""


class Method(StrEnum):
    """Methods to compute a curve from its data; see the module.

    See Also
    --------
    evaluate_rounded : The computation.
    available_methods : Those that go with the data.

    Examples
    --------
    >>> from curvecore import Method
    >>> [method.value for method in Method]
    ['monomial', 'newton', 'lagrange', 'barycentric', 'basis']
    """

    MONOMIAL = "monomial"
    NEWTON = "newton"
    LAGRANGE = "lagrange"
    BARYCENTRIC = "barycentric"
    BASIS = "basis"


class Rounding(StrEnum):
    """Numbers that are rounded to k digits; see the module.

    See Also
    --------
    evaluate_rounded : The computation.

    Examples
    --------
    >>> from curvecore import Rounding
    >>> [rounding.value for rounding in Rounding]
    ['every_step', 'coefficients', 'data']
    """

    EVERY_STEP = "every_step"
    COEFFICIENTS = "coefficients"
    DATA = "data"


def available_methods(derivatives: int) -> tuple[Method, ...]:
    """Return the methods that there are for some data.

    Parameters
    ----------
    derivatives : int
        How many are given at each point: 0 to 3.

    Returns
    -------
    tuple of Method
        In the order in which they are explained.

    See Also
    --------
    evaluate_rounded : The computation.

    Examples
    --------
    >>> from curvecore import available_methods
    >>> [method.value for method in available_methods(1)]
    ['monomial', 'basis']
    """
    return tuple(map(Method, _forms(integer(derivatives, "derivatives", 0))))


def evaluate_rounded(
    points: ArrayLike,
    parameters: ArrayLike,
    t: ArrayLike,
    method: Method | str,
    digits: int,
    velocities: ArrayLike | None = None,
    accelerations: ArrayLike | None = None,
    jerks: ArrayLike | None = None,
    *,
    rounding: Rounding | str = Rounding.EVERY_STEP,
) -> FloatArray:
    """Return a curve computed in decimal arithmetic of so many digits.

    Parameters
    ----------
    points : array_like, shape (n, dim)
        p_i; n >= 2.
    parameters : array_like, shape (n,)
        Strictly increasing.
    t : float or array_like, shape (m,)
        Any finite values; a scalar counts as m = 1.
    method : Method or str
        ``"monomial"``, ``"newton"``, ``"lagrange"`` or ``"barycentric"``; with
        velocities ``"basis"`` or ``"monomial"``.
    digits : int
        From 2 to 16: significant digits of what is rounded.
    velocities, accelerations, jerks : array_like, shape (n, dim), optional
        Velocities make it the cubic Hermite curve, accelerations with them the quintic one, all three the
        septic one.
    rounding : Rounding or str, optional
        ``"every_step"``, ``"coefficients"`` or ``"data"`` (points, derivatives
        and parameters). With rounded data all methods give the same values.

    Returns
    -------
    ndarray, shape (m, dim)
        The k-digit results as floats (up to 15 digits, printing them gives
        the very digits back). NaN where a division by 0 came up, as when a
        pivot vanishes or two parameters cannot be told apart. Results beyond
        the floating point range are limited to the largest number.

    Raises
    ------
    CurveError
        If data are unusable, the method is unknown or does not apply to the
        data, digits is out of range, parameters become equal by rounding the
        data, or are so close together that exact coefficients would need
        more than 3000 digits.

    See Also
    --------
    exact_values : The truth.
    digits_lost : The difference.
    rounded_decimals : The digits themselves.

    Notes
    -----
    "Exactly" means with so many digits that no error reaches the twentieth
    one: 40 more than elimination on parameters of this spacing can lose.
    The time is that of the Decimal operations, some 0.1 us each:
    m n**2 dim of them for ``"lagrange"``, m n dim for the others, n**3 / 3 at
    first for ``"monomial"``. The segment of a Hermite curve is found exactly.

    Examples
    --------
    >>> from curvecore import evaluate_rounded
    >>> points, parameters = [[0.0], [1.0], [4.0]], [0, 1, 2]
    >>> evaluate_rounded(points, parameters, [0.3], "newton", 2).tolist()
    [[0.09]]
    >>> evaluate_rounded(points, parameters, [0.3], "lagrange", 2).tolist()
    [[0.11]]
    """
    rows = rounded_decimals(
        points, parameters, t, method, digits, velocities, accelerations, jerks, rounding=rounding
    )
    values = np.array([[float(x) if x.is_finite() else np.nan for x in row] for row in rows])
    limited: FloatArray = np.clip(values, -LARGEST, LARGEST)
    return limited.reshape(len(rows), np.shape(points)[1])


def rounded_decimals(
    points: ArrayLike,
    parameters: ArrayLike,
    t: ArrayLike,
    method: Method | str,
    digits: int,
    velocities: ArrayLike | None = None,
    accelerations: ArrayLike | None = None,
    jerks: ArrayLike | None = None,
    *,
    rounding: Rounding | str = Rounding.EVERY_STEP,
) -> list[list[Decimal]]:
    """Return the result of `evaluate_rounded` as Decimals, m lists of dim: the digits themselves.

    Parameters
    ----------
    points : array_like, shape (n, dim)
        p_i; n >= 2.
    parameters : array_like, shape (n,)
        Strictly increasing.
    t : float or array_like, shape (m,)
        Any finite values; a scalar counts as m = 1.
    method : Method or str
        One that goes with the data: see `available_methods`.
    digits : int
        From 2 to 16: significant digits of what is rounded.
    velocities, accelerations, jerks : array_like, shape (n, dim), optional
        Velocities make it the cubic Hermite curve, accelerations with them the quintic one, all three the
        septic one.
    rounding : Rounding or str, optional
        What is rounded: ``"every_step"``, ``"coefficients"`` or ``"data"``.

    Returns
    -------
    list of list of Decimal
        m rows of dim; what was evaluated exactly is given to 30 digits.

    See Also
    --------
    evaluate_rounded : The same as floats.

    Examples
    --------
    >>> from curvecore import rounded_decimals
    >>> ((digits,),) = rounded_decimals([[0.0], [1.0], [4.0]], [0, 1, 2], [0.3], "lagrange", 3)
    >>> print(digits)
    0.090
    """
    data = Data.of(points, parameters, velocities, accelerations, jerks)
    form, context = _form(data, method), decimal_context(digits)
    where = parameter_row(t)
    match _known(rounding):
        case Rounding.EVERY_STEP:
            return form(data, decimals(where), context)
        case Rounding.COEFFICIENTS:
            exact = exact_context(data, where)
            rows = form(data, decimals(where), exact, context.plus)
        case Rounding.DATA:
            data = data.rounded(digits)
            # In exact arithmetic they are all the same; these two need the least of it.
            form = _form(data, Method.BASIS if data.jets.shape[1] > 1 else Method.NEWTON)
            rows = form(data, decimals(where), exact_context(data, where))
    context_displayed = Context(prec=_DISPLAYED, rounding=ROUND_HALF_EVEN, traps=[])
    return [[context_displayed.plus(x) for x in row] for row in rows]


def _forms(derivatives: int) -> dict[str, Form]:
    return HERMITE_METHODS if derivatives else LAGRANGE_METHODS


def _form(data: Data, method: Method | str) -> Form:
    table = _forms(data.jets.shape[1] - 1)
    if str(method) not in table:
        raise CurveError(f"method must be one of {', '.join(sorted(table))} for these data, not {method!r}")
    return table[str(method)]


def _known(rounding: Rounding | str) -> Rounding:
    try:
        return Rounding(rounding)
    except ValueError:
        raise CurveError(f"rounding must be one of {', '.join(Rounding)}, not {rounding!r}") from None
