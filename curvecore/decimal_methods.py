"""The methods of `rounding`, one operation of a decimal context after another.

All take exact data and an arithmetic: a `decimal.Context`, or anything with
its four operations. They are written as plain loops on purpose: the order of
operations is what they are about.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from decimal import Decimal
from typing import NamedTuple, Protocol, TypeAlias

import numpy as np

from curvecore.arrays import FloatArray, IntArray

__all__ = ["HERMITE_METHODS", "LAGRANGE_METHODS", "Arithmetic", "Data", "Evaluator"]


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


class Data(NamedTuple):
    """Checked data of a curve.

    Attributes
    ----------
    parameters : ndarray, shape (n,)
    jets : ndarray, shape (n, R, dim)
        R = 1 for one polynomial, 2 and 3 for piecewise Hermite curves.
    """

    parameters: FloatArray
    jets: FloatArray

    def segments(self, t: FloatArray) -> IntArray:
        """Return the polynomial that counts at each t."""
        if self.jets.shape[1] == 1:
            return np.zeros(len(t), dtype=np.intp)
        return np.searchsorted(self.parameters[1:-1], t, side="right")

    def stretch(self, segment: int) -> tuple[FloatArray, FloatArray]:
        """Return the parameters and jets that make a polynomial."""
        if self.jets.shape[1] == 1:
            return self.parameters, self.jets
        return self.parameters[segment : segment + 2], self.jets[segment : segment + 2]


Evaluator: TypeAlias = Callable[[Data, Sequence[Decimal], Arithmetic], list[Row]]


def _exact(values: FloatArray) -> Row:
    return [Decimal(float(x)) for x in values]


def _columns(points: FloatArray) -> list[Row]:
    return [_exact(column) for column in points.T]


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
    """Return |value|; what is not a number is never a pivot while there is another one."""
    return value.copy_abs() if not value.is_nan() else Decimal(-1)


def _monomial(data: Data, t: Sequence[Decimal], a: Arithmetic) -> list[Row]:
    nodes = _exact(data.parameters)
    matrix = [_powers(node, len(nodes), a) for node in nodes]
    right = [_exact(point) for point in data.jets[:, 0]]
    coefficients = _solve(matrix, right, a)
    return [[_horner(column, x, a) for column in coefficients] for x in t]


def _powers(t: Decimal, count: int, a: Arithmetic) -> Row:
    powers = [Decimal(1), t]
    while len(powers) < count:
        powers.append(a.multiply(powers[-1], t))
    return powers[:count]


def _newton(data: Data, t: Sequence[Decimal], a: Arithmetic) -> list[Row]:
    nodes = _exact(data.parameters)
    tables = []
    for column in _columns(data.jets[:, 0]):
        for order in range(1, len(nodes)):
            for i in range(len(nodes) - 1, order - 1, -1):
                gap = a.subtract(nodes[i], nodes[i - order])
                column[i] = a.divide(a.subtract(column[i], column[i - 1]), gap)
        tables.append(column)
    rows = []
    for x in t:
        row = []
        for column in tables:
            result = column[-1]
            for i in range(len(nodes) - 2, -1, -1):
                result = a.add(a.multiply(result, a.subtract(x, nodes[i])), column[i])
            row.append(result)
        rows.append(row)
    return rows


def _product_without(x: Decimal, nodes: Row, skipped: int, a: Arithmetic) -> Decimal:
    """Return the product of x - t_j over all j but one, in ascending order."""
    result: Decimal | None = None
    for j, node in enumerate(nodes):
        if j != skipped:
            factor = a.subtract(x, node)
            result = factor if result is None else a.multiply(result, factor)
    assert result is not None
    return result


def _dot(weights: Row, column: Row, a: Arithmetic) -> Decimal:
    total = a.multiply(weights[0], column[0])
    for weight, value in zip(weights[1:], column[1:], strict=True):
        total = a.add(total, a.multiply(weight, value))
    return total


def _lagrange(data: Data, t: Sequence[Decimal], a: Arithmetic) -> list[Row]:
    nodes, columns = _exact(data.parameters), _columns(data.jets[:, 0])
    below = [_product_without(node, nodes, i, a) for i, node in enumerate(nodes)]
    rows = []
    for x in t:
        basis = [
            a.divide(_product_without(x, nodes, i, a), denominator) for i, denominator in enumerate(below)
        ]
        rows.append([_dot(basis, column, a) for column in columns])
    return rows


def _barycentric(data: Data, t: Sequence[Decimal], a: Arithmetic) -> list[Row]:
    nodes, columns = _exact(data.parameters), _columns(data.jets[:, 0])
    one = Decimal(1)
    weights = [a.divide(one, _product_without(node, nodes, i, a)) for i, node in enumerate(nodes)]
    rows = []
    for x in t:
        if x in nodes:
            # The point itself, as a k-digit number: a product with 1 rounds it.
            hit = nodes.index(x)
            rows.append([a.multiply(one, column[hit]) for column in columns])
            continue
        shares = [a.divide(w, a.subtract(x, node)) for w, node in zip(weights, nodes, strict=True)]
        total = shares[0]
        for share in shares[1:]:
            total = a.add(total, share)
        rows.append([a.divide(_dot(shares, column, a), total) for column in columns])
    return rows


def _hermite_monomial(data: Data, t: Sequence[Decimal], a: Arithmetic) -> list[Row]:
    segments = data.segments(np.array([float(x) for x in t]))
    solved: dict[int, list[Row]] = {}
    rows = []
    for x, segment in zip(t, segments, strict=True):
        if segment not in solved:
            solved[segment] = _segment_coefficients(data, int(segment), a)
        rows.append([_horner(column, x, a) for column in solved[segment]])
    return rows


def _segment_coefficients(data: Data, segment: int, a: Arithmetic) -> list[Row]:
    width = data.jets.shape[1]
    matrix, right = [], []
    for joint in (segment, segment + 1):
        powers = _powers(Decimal(float(data.parameters[joint])), 2 * width, a)
        for order in range(width):
            matrix.append(_derivative_row(powers, order, a))
            right.append(_exact(data.jets[joint, order]))
    return _solve(matrix, right, a)


def _derivative_row(powers: Row, order: int, a: Arithmetic) -> Row:
    if order == 0:
        return list(powers)
    row = [Decimal(0)] * order
    for k in range(order, len(powers)):
        factor = k if order == 1 else k * (k - 1)
        row.append(a.multiply(Decimal(factor), powers[k - order]))
    return row


def _hermite_basis(data: Data, t: Sequence[Decimal], a: Arithmetic) -> list[Row]:
    functions = _cubic if data.jets.shape[1] == 2 else _quintic
    nodes = _exact(data.parameters)
    jets = [[_exact(order) for order in jet] for jet in data.jets]
    segments = data.segments(np.array([float(x) for x in t]))
    rows = []
    for x, i in zip(t, segments, strict=True):
        h = a.subtract(nodes[i + 1], nodes[i])
        s, r = a.divide(a.subtract(x, nodes[i]), h), a.divide(a.subtract(nodes[i + 1], x), h)
        left, right = functions(s, r, h, a), functions(r, s, a.subtract(Decimal(0), h), a)
        weights = [*left, *right]
        terms = [*jets[i], *jets[i + 1]]
        rows.append([_dot(weights, [term[d] for term in terms], a) for d in range(data.jets.shape[2])])
    return rows


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


LAGRANGE_METHODS: dict[str, Evaluator] = {
    "monomial": _monomial,
    "newton": _newton,
    "lagrange": _lagrange,
    "barycentric": _barycentric,
}
HERMITE_METHODS: dict[str, Evaluator] = {"monomial": _hermite_monomial, "basis": _hermite_basis}
