"""The methods of `rounding`, one operation of a decimal context after another.

All take exact data and an arithmetic: a `decimal.Context`, or anything with
its four operations. They are written as plain loops on purpose: the order of
operations is what they are about. Each is a `Form`: what is computed once from
the data, and what is computed from that for every t.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from decimal import ROUND_HALF_EVEN, Context, Decimal
from functools import reduce
from itertools import accumulate
from typing import NamedTuple, Protocol, TypeAlias

import numpy as np

from curvecore.arithmetic import LARGEST
from curvecore.arrays import FloatArray
from curvecore.errors import CurveError
from curvecore.rounding.data import Data

_GUARD = 40
_MOST_GUARDED = 3000
"""Digits of an arithmetic that counts as exact, at most: 60 parameters may come as close as 1e-40."""


class Arithmetic(Protocol):
    """Four rounded operations."""

    def add(self, a: Decimal, b: Decimal, /) -> Decimal:
        """Return a + b."""

    def subtract(self, a: Decimal, b: Decimal, /) -> Decimal:
        """Return a - b."""

    def multiply(self, a: Decimal, b: Decimal, /) -> Decimal:
        """Return a b."""

    def divide(self, a: Decimal, b: Decimal, /) -> Decimal:
        """Return a / b."""


Row: TypeAlias = list[Decimal]


def exact_context(data: Data, t: FloatArray) -> Context:
    """Return an arithmetic in which none of the first thirty digits of a result is rounded.

    With the t axis scaled to a largest absolute t of 1, which elimination does
    not notice, a Vandermonde matrix of parameters at least g apart has entries
    up to 1, its inverse (the coefficients of the basis functions) entries up to
    (2/g)**(n-1), and entries grow at most 2**(n-1) times under way (Higham,
    "Accuracy and Stability of Numerical Algorithms", 2nd ed., section 9.3). The
    rows of derivatives are not scaled alike.

    Raises
    ------
    CurveError
        If that takes more than 3000 digits.
    """
    size = math.log10(max(float(np.abs(data.parameters).max()), float(np.abs(t).max(initial=0.0))))
    with np.errstate(over="ignore"):
        closest = math.log10(min(float(np.diff(data.parameters).min()), LARGEST))
    order = data.jets.shape[1]
    rows = len(data.parameters) if order == 1 else 2 * order
    lost = (rows - 1) * (math.log10(4.0) + size - closest) + 4 * (order - 1) * abs(size)
    if _GUARD + lost > _MOST_GUARDED:
        raise CurveError(
            f"parameters must be further apart for exact coefficients: they take {_GUARD + lost:.0f} digits, "
            f"{_MOST_GUARDED} are the most"
        )
    return Context(prec=_GUARD + math.ceil(max(lost, 0.0)), rounding=ROUND_HALF_EVEN, traps=[])


class Prepared(NamedTuple):
    """Results that a method computes once for one polynomial.

    Attributes
    ----------
    coefficients : list of rows
        What the method's functions are multiplied with: a_k, divided
        differences, points, derivatives; the weights of the barycentric form.
    helpers : list of rows
        Parameters, and what depends on them alone.
    """

    coefficients: list[Row]
    helpers: list[Row]


class Form(NamedTuple):
    """A method: its preparation of a stretch of the data, and the point that it makes from that at one t."""

    prepare: Callable[[Data, int, Arithmetic], Prepared]
    value: Callable[[Prepared, Decimal, Arithmetic], Row]

    def __call__(
        self,
        data: Data,
        t: Sequence[Decimal],
        a: Arithmetic,
        store: Callable[[Decimal], Decimal] | None = None,
    ) -> list[Row]:
        """Return the points at all t, every operation done by `a`; `store` rounds a coefficient."""
        prepared: dict[int, Prepared] = {}
        rows = []
        for x, segment in zip(t, data.segments(np.array([float(x) for x in t])).tolist(), strict=True):
            if segment not in prepared:
                preparation = self.prepare(data, segment, a)
                if store is not None:
                    preparation = Prepared(
                        [[store(x) for x in row] for row in preparation.coefficients], preparation.helpers
                    )
                prepared[segment] = preparation
            rows.append(self.value(prepared[segment], x, a))
        return rows


def decimals(values: FloatArray) -> Row:
    """Return numbers as Decimals, exactly."""
    return [Decimal(float(x)) for x in values]


def _columns(points: FloatArray) -> list[Row]:
    return [decimals(column) for column in points.T]


def _horner(coefficients: Row, t: Decimal, a: Arithmetic) -> Decimal:
    result = coefficients[-1]
    for coefficient in coefficients[-2::-1]:
        result = a.add(a.multiply(result, t), coefficient)
    return result


def _solve(matrix: list[Row], right: list[Row], a: Arithmetic) -> list[Row]:
    """Return the solutions of a system for several right-hand sides (rows of them), by elimination."""
    n = len(matrix)
    for k in range(n - 1):
        pivot = max(range(k, n), key=lambda i: _size(matrix[i][k]))
        for table in (matrix, right):
            table[k], table[pivot] = table[pivot], table[k]
        for i in range(k + 1, n):
            factor = a.divide(matrix[i][k], matrix[k][k])
            for table, first in ((matrix, k + 1), (right, 0)):
                row, top = table[i], table[k]
                for j in range(first, len(row)):
                    row[j] = a.subtract(row[j], a.multiply(factor, top[j]))
    solutions = []
    for column in range(len(right[0])):
        solution = [Decimal(0)] * n
        for k in range(n - 1, -1, -1):
            total = right[k][column]
            for j in range(k + 1, n):
                total = a.subtract(total, a.multiply(matrix[k][j], solution[j]))
            solution[k] = a.divide(total, matrix[k][k])
        solutions.append(solution)
    return solutions


def _size(value: Decimal) -> Decimal:
    """Return |value|; a NaN is never a pivot while there is another number."""
    return value.copy_abs() if not value.is_nan() else Decimal(-1)


def _monomial(data: Data, segment: int, a: Arithmetic) -> Prepared:
    parameters, jets = data.stretch(segment)
    matrix, right = [], []
    for t, jet in zip(decimals(parameters), jets, strict=True):
        powers = _powers(t, jets.shape[0] * jets.shape[1], a)
        matrix += [_derivative_row(powers, order, a) for order in range(len(jet))]
        right += [decimals(number) for number in jet]
    return Prepared(_solve(matrix, right, a), [])


def _power_value(prepared: Prepared, t: Decimal, a: Arithmetic) -> Row:
    return [_horner(column, t, a) for column in prepared.coefficients]


def _powers(t: Decimal, count: int, a: Arithmetic) -> Row:
    return [Decimal(1), *accumulate([t] * (count - 1), a.multiply)]


def _newton(data: Data, _segment: int, a: Arithmetic) -> Prepared:
    parameters = decimals(data.parameters)
    tables = _columns(data.jets[:, 0])
    for column in tables:
        for order in range(1, len(parameters)):
            for i in range(len(parameters) - 1, order - 1, -1):
                gap = a.subtract(parameters[i], parameters[i - order])
                column[i] = a.divide(a.subtract(column[i], column[i - 1]), gap)
    return Prepared(tables, [parameters])


def _newton_value(prepared: Prepared, t: Decimal, a: Arithmetic) -> Row:
    (parameters,) = prepared.helpers
    row = []
    for column in prepared.coefficients:
        result = column[-1]
        for i in range(len(parameters) - 2, -1, -1):
            result = a.add(a.multiply(result, a.subtract(t, parameters[i])), column[i])
        row.append(result)
    return row


def _product_without(x: Decimal, parameters: Row, skipped: int, a: Arithmetic) -> Decimal:
    """Return the product of x - t_j over all j but one, in ascending order."""
    return reduce(a.multiply, (a.subtract(x, t_j) for j, t_j in enumerate(parameters) if j != skipped))


def _dot(weights: Row, column: Row, a: Arithmetic) -> Decimal:
    return reduce(a.add, map(a.multiply, weights, column))


def _lagrange(data: Data, _segment: int, a: Arithmetic) -> Prepared:
    parameters = decimals(data.parameters)
    below = [_product_without(t_i, parameters, i, a) for i, t_i in enumerate(parameters)]
    return Prepared(_columns(data.jets[:, 0]), [parameters, below])


def _lagrange_value(prepared: Prepared, t: Decimal, a: Arithmetic) -> Row:
    parameters, below = prepared.helpers
    basis = [a.divide(_product_without(t, parameters, i, a), divisor) for i, divisor in enumerate(below)]
    return [_dot(basis, column, a) for column in prepared.coefficients]


def _barycentric(data: Data, _segment: int, a: Arithmetic) -> Prepared:
    parameters, one = decimals(data.parameters), Decimal(1)
    weights = [a.divide(one, _product_without(t_i, parameters, i, a)) for i, t_i in enumerate(parameters)]
    return Prepared([weights, *_columns(data.jets[:, 0])], [parameters])


def _barycentric_value(prepared: Prepared, t: Decimal, a: Arithmetic) -> Row:
    (parameters,), (weights, *columns) = prepared.helpers, prepared.coefficients
    if t in parameters:
        # The point itself, as a k-digit number: a product with 1 rounds it.
        hit = parameters.index(t)
        return [a.multiply(Decimal(1), column[hit]) for column in columns]
    shares = [a.divide(w, a.subtract(t, t_i)) for w, t_i in zip(weights, parameters, strict=True)]
    total = reduce(a.add, shares)
    return [a.divide(_dot(shares, column, a), total) for column in columns]


def _derivative_row(powers: Row, order: int, a: Arithmetic) -> Row:
    if order == 0:
        return powers.copy()
    row = [Decimal(0)] * order
    for k in range(order, len(powers)):
        row.append(a.multiply(Decimal(math.perm(k, order)), powers[k - order]))
    return row


def _hermite_basis(data: Data, segment: int, _a: Arithmetic) -> Prepared:
    parameters, jets = data.stretch(segment)
    return Prepared([decimals(axis) for axis in jets.reshape(-1, jets.shape[2]).T], [decimals(parameters)])


def _hermite_value(prepared: Prepared, t: Decimal, a: Arithmetic) -> Row:
    ((start, end),) = prepared.helpers
    functions = _FUNCTIONS[len(prepared.coefficients[0]) // 2]
    h = a.subtract(end, start)
    s, r = a.divide(a.subtract(t, start), h), a.divide(a.subtract(end, t), h)
    left, right = functions(s, r, h, a), functions(r, s, a.subtract(Decimal(0), h), a)
    return [_dot([*left, *right], column, a) for column in prepared.coefficients]


def _cubic(s: Decimal, r: Decimal, h: Decimal, a: Arithmetic) -> Row:
    """Return (r r) (r + 3 s) and ((r r) s) h."""
    rr = a.multiply(r, r)
    return [
        a.multiply(rr, a.add(r, a.multiply(Decimal(3), s))),
        a.multiply(a.multiply(rr, s), h),
    ]


def _quintic(s: Decimal, r: Decimal, h: Decimal, a: Arithmetic) -> Row:
    """Return three functions of one end.

    q = (r r) r; q ((r r + (5 r) s) + (10 s) s); (((q s) (r + 4 s))) h;
    (((q s) s) / 2) (h h).
    """
    rr = a.multiply(r, r)
    q = a.multiply(rr, r)
    qs = a.multiply(q, s)
    middle = a.add(rr, a.multiply(a.multiply(Decimal(5), r), s))
    inner = a.add(middle, a.multiply(a.multiply(Decimal(10), s), s))
    return [
        a.multiply(q, inner),
        a.multiply(a.multiply(qs, a.add(r, a.multiply(Decimal(4), s))), h),
        a.multiply(a.divide(a.multiply(qs, s), Decimal(2)), a.multiply(h, h)),
    ]


def _septic(s: Decimal, r: Decimal, h: Decimal, a: Arithmetic) -> Row:
    """Return four functions of one end.

    q = (r r) (r r); q ((((r r) r + (7 (r r)) s) + (21 r) (s s)) + (35 (s s)) s);
    ((q s) ((r r + (6 r) s) + (15 s) s)) h; (((q s) s) / 2 (r + 5 s)) (h h); ((((q s) s) s) / 6) ((h h) h).
    """
    rr, ss, hh = a.multiply(r, r), a.multiply(s, s), a.multiply(h, h)
    q = a.multiply(rr, rr)
    qs = a.multiply(q, s)
    qss = a.multiply(qs, s)

    def product(number: int, *factors: Decimal) -> Decimal:
        return reduce(a.multiply, factors, Decimal(number))

    cubic = a.add(a.multiply(rr, r), product(7, rr, s))
    cubic = a.add(a.add(cubic, product(21, r, ss)), product(35, ss, s))
    quadratic = a.add(a.add(rr, product(6, r, s)), product(15, s, s))
    linear = a.add(r, product(5, s))
    return [
        a.multiply(q, cubic),
        a.multiply(a.multiply(qs, quadratic), h),
        a.multiply(a.multiply(a.divide(qss, Decimal(2)), linear), hh),
        a.multiply(a.divide(a.multiply(qss, s), Decimal(6)), a.multiply(hh, h)),
    ]


_FUNCTIONS = {2: _cubic, 3: _quintic, 4: _septic}
"""Functions of one end, by the number of data there."""

LAGRANGE_METHODS = {
    "monomial": Form(_monomial, _power_value),
    "newton": Form(_newton, _newton_value),
    "lagrange": Form(_lagrange, _lagrange_value),
    "barycentric": Form(_barycentric, _barycentric_value),
}
HERMITE_METHODS = {
    "monomial": Form(_monomial, _power_value),
    "basis": Form(_hermite_basis, _hermite_value),
}
