"""Classes of joints never contradict exact arithmetic on the same doubles, however short a piece is."""

from itertools import pairwise
from math import comb, factorial

import numpy as np
from flint import arb, ctx, fmpq, fmpq_mat

from curvecore import (
    BSplineCurve,
    CubicSplineCurve,
    HermiteCurve,
    QuinticHermiteCurve,
    SepticHermiteCurve,
    bessel_velocities,
    centripetal,
    chord_length,
    joint_report,
    natural_spline_velocities,
    uniform,
)
from tests.rows import each_row

LIMIT = 1e-9
"""The tolerance of the classes; a jump within a factor of 2 of it may be judged either way."""


def rational(number):
    return fmpq(*float(number).as_integer_ratio())


def rationals(array):
    return [[rational(x) for x in row] for row in array]


def combined(rows, weights):
    """The sum of vectors with weights."""
    return [sum((w * row[d] for w, row in zip(weights, rows, strict=True)), fmpq(0)) for d in range(2)]


def of_bezier(controls, h):
    """c to c''' at both ends of a Bezier piece over a length h: differences of its control points."""
    degree, ends = len(controls) - 1, ([], [])
    for order in range(4):
        signs = [(-1) ** (order - k) * comb(order, k) for k in range(order + 1)]
        factor = fmpq(factorial(degree), factorial(max(degree - order, 0))) / h**order
        for end, first in zip(ends, (0, degree - order), strict=True):
            whole = order <= degree
            rows = controls[first : first + order + 1] if whole else controls[:1]
            end.append(combined(rows, [factor * sign for sign in signs] if whole else [fmpq(0)]))
    return ends


def of_jets(jets, t):
    """The same of Hermite pieces of any width, by their control points."""
    pieces = []
    for (left, right), h in zip(pairwise(jets), steps(t), strict=True):
        width = len(left)
        degree = 2 * width - 1
        ahead, behind = [], []
        for k in range(width):
            weights = [
                h**j * fmpq(comb(k, j) * factorial(degree - j), factorial(degree)) for j in range(k + 1)
            ]
            ahead.append(combined(left[: k + 1], weights))
            behind.append(combined(right[: k + 1], [(-1) ** j * w for j, w in enumerate(weights)]))
        pieces.append(of_bezier(ahead + behind[::-1], h))
    return pieces


def steps(t):
    return [after - before for before, after in pairwise(t)]


def of_spline(curve):
    """The same of a cubic spline, by its definition: the velocities with which c'' goes on."""
    t, points, ends = [rational(x) for x in curve.parameters], rationals(curve.points), curve.chosen["ends"]
    n, h = len(t), steps(t)
    slopes = [
        [(b - a) / step for a, b in zip(p, q, strict=True)]
        for (p, q), step in zip(pairwise(points), h, strict=True)
    ]
    matrix, right = [[fmpq(0)] * n for _ in range(n)], [[fmpq(0)] * 2 for _ in range(n)]

    def put(row, piece, end, order, sign):
        """Add a derivative at an end of a piece, of the order 2 or 3, to an equation."""
        near, far = (piece + 1, piece) if end else (piece, piece + 1)
        way = -1 if end else 1
        if order == 2:
            weights = (-4 * way / h[piece], -2 * way / h[piece], -6 * way / h[piece])
        else:
            weights = (6 / h[piece] ** 2, 6 / h[piece] ** 2, 12 / h[piece] ** 2)
        matrix[row][near] += sign * weights[0]
        matrix[row][far] += sign * weights[1]
        right[row] = [a + sign * weights[2] * b for a, b in zip(right[row], slopes[piece], strict=True)]

    for i in range(1, n - 1):
        put(i, i - 1, 1, 2, 1)
        put(i, i, 0, 2, -1)
    if ends == "natural":
        put(0, 0, 0, 2, 1)
        put(n - 1, n - 2, 1, 2, 1)
    elif ends == "clamped":
        matrix[0][0] = matrix[-1][-1] = fmpq(1)
    elif ends == "periodic":
        matrix[0][0], matrix[0][-1] = fmpq(1), fmpq(-1)
        put(n - 1, n - 2, 1, 2, 1)
        put(n - 1, 0, 0, 2, -1)
    else:
        put(0, 0, 1, 3, 1)
        put(0, 1, 0, 3, -1)
        put(n - 1, n - 3, 1, 3, 1)
        put(n - 1, n - 2, 0, 3, -1)
    flat = [fmpq_mat(n, k, [x for row in rows for x in row]) for rows, k in ((matrix, n), (right, 2))]
    velocities = flat[0].solve(flat[1])
    return of_jets([[p, [velocities[i, 0], velocities[i, 1]]] for i, p in enumerate(points)], t)


def of_b_spline(curve):
    """The same of a B-spline, by the blossoms of its pieces."""
    p, knots = curve.degree, [rational(x) for x in curve.knots]
    points, t = rationals(curve.points), [rational(x) for x in curve.parameters]

    def blossom(span, places):
        rows = points[span - p : span + 1]
        for r, place in enumerate(places, 1):
            shares = [
                (place - knots[span - p + i]) / (knots[span + 1 + i - r] - knots[span - p + i])
                for i in range(r, p + 1)
            ]
            rows = [combined((a, b), (1 - s, s)) for a, b, s in zip(rows, rows[1:], shares, strict=False)]
        return rows[0]

    pieces = []
    for start, end in pairwise(t):
        span = max(i for i in range(p, len(knots) - p - 1) if knots[i] <= start)
        controls = [blossom(span, [start] * (p - k) + [end] * k) for k in range(p + 1)]
        pieces.append(of_bezier(controls, end - start))
    return pieces


def size(vector):
    return sum((x * x for x in vector), arb(0)).sqrt()


def less(first, second):
    return [a - b for a, b in zip(first, second, strict=True)]


def line_of(values):
    """Direction, curvature vector, and the part across the direction of its change along the curve."""
    _, v, a, j = values
    speed = size(v)
    unit = [x / speed for x in v]

    def along(vector):
        return sum((x * y for x, y in zip(vector, unit, strict=True)), arb(0))

    def across(vector):
        return less(vector, [along(vector) * x for x in unit])

    third = [(x - 3 * along(a) / speed * y) / speed**3 for x, y in zip(j, a, strict=True)]
    return unit, [x / speed**2 for x in across(a)], across(third)


def judged(jump, larger, typical):
    """Whether a jump is surely none (False), surely one (True), or near the limit (None)."""
    if float(jump) > 2 * LIMIT * max(float(larger), float(typical)):
        return True
    return False if float(jump) <= 0.5 * LIMIT * float(larger) else None


def exact_jumps(pieces, t, index):
    """Verdicts on c' to c''', and on direction, curvature and its change, at one joint; None at a rest."""
    before, after = (
        [[arb(x) for x in row] for row in each] for each in (pieces[index - 1][1], pieces[index][0])
    )
    beside = [(pieces[index - 1], steps(t)[index - 1]), (pieces[index], steps(t)[index])]
    way = arb(0)
    for (start, end), h in beside:
        speeds = size(map(arb, start[1])) + size(map(arb, end[1]))
        way += (size(map(arb, less(start[0], end[0]))) + arb(h) / 2 * speeds) / 2
    typical = [way / arb(sum(h for _, h in beside)) ** order for order in range(4)]
    motion = [
        judged(size(less(a, b)), max(map(float, map(size, (a, b)))), typical[order])
        for order, (a, b) in enumerate(zip(before[1:], after[1:], strict=True), 1)
    ]
    slow = min(float(size(before[1])), float(size(after[1])))
    if slow <= 2 * LIMIT * float(typical[1]):
        return motion, [None] * 3
    sizes = (1.0, typical[2] / typical[1] ** 2, typical[3] / typical[1] ** 3)
    line = [
        judged(size(less(a, b)), max(map(float, map(size, (a, b)))), typical_size)
        for a, b, typical_size in zip(line_of(before), line_of(after), sizes, strict=True)
    ]
    return motion, line


def jets_of(curve):
    return [rationals(each) for each in curve.jets]


def random_curve(kind, rng):
    """A curve with a piece of a length from 1 to 1e-10, its exact pieces, and whether it is closed."""
    count = int(rng.integers(4, 8))
    points = rng.uniform(-3.0, 3.0, (count, 2))
    short = int(rng.integers(0, count - 1))
    points[short + 1] = points[short] + 10.0 ** -rng.uniform(0.0, 10.0) * rng.standard_normal(2)
    closed = kind == "periodic"
    points = np.concatenate((points, points[:1])) if closed else points
    t = [chord_length(points), centripetal(points), uniform(len(points))][int(rng.integers(0, 3))]
    if kind in ENDS:
        curve = CubicSplineCurve(points, t, ends=kind)
        return curve, of_spline(curve), closed
    if kind == "b_spline":
        curve = BSplineCurve(points, t)
        return curve, of_b_spline(curve), closed
    given = rng.standard_normal((3, count, 2))
    curve = {
        "natural velocities": lambda: HermiteCurve(points, natural_spline_velocities(points, t), t),
        "bessel": lambda: HermiteCurve(points, bessel_velocities(points, t), t),
        "quintic": lambda: QuinticHermiteCurve(points, *given[:2], t),
        "septic": lambda: SepticHermiteCurve(points, *given, t),
        # On a line, at a steady speed: nothing jumps but what coordinates are rounded by.
        "line": lambda: HermiteCurve(np.outer(t, given[0, 0]), np.tile(given[0, 0], (count, 1)), t),
    }[kind]()
    return curve, of_jets(jets_of(curve), [rational(x) for x in t]), closed


ENDS = ["natural", "clamped", "not_a_knot", "periodic"]
KINDS = [*ENDS, "b_spline", "bessel", "quintic", "septic", "line", "natural velocities"]


@each_row("kind", KINDS)
def test_certain_classes_are_true(kind, rng):
    """A jump was none below 1e-9 of its terms, which are 1e20 times the values beside a short piece."""
    decided = 0
    ctx.prec, was = 400, ctx.prec
    for _ in range(20):
        curve, pieces, closed = random_curve(kind, rng)
        t = [rational(x) for x in curve.parameters]
        for joint in joint_report(curve, closed=closed):
            motion, line = exact_jumps(pieces, t, joint.joint)
            for order, is_open, jumps in (
                (joint.parametric, joint.is_parametric_open, motion),
                (joint.geometric, joint.is_geometric_open, line),
            ):
                assert order >= 0
                assert True not in jumps[:order], (kind, joint.label, motion, line)
                assert is_open or order == 3 or jumps[order] is not False, (kind, joint.label, motion, line)
                decided += not is_open
    ctx.prec = was
    assert decided >= 60
