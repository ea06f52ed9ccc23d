"""Hermite curves against exact rational arithmetic.

A term of a cubic or quintic is a product of at most eight factors of one to three roundings each,
so c = 20 is a bound, not an estimate; of septic ones, two factors more and not all at their worst, 9 is the
largest that was seen.
"""

import numpy as np
from flint import fmpq

from curvecore import HermiteCurve, QuinticHermiteCurve, SepticHermiteCurve
from tests.rows import each_row

NAMES = ["uniform", "random", "clustered", "geometric", "shifted", "small", "large", "chebyshev"]
LIMIT = 20.0
CLASSES = {2: HermiteCurve, 3: QuinticHermiteCurve, 4: SepticHermiteCurve}
WITHIN_RANGE = {(4, "small"): 1e50, (4, "large"): 1e-50}
"""No double holds a jerk per cube of 1e150."""
TINY = fmpq(1, 10**280)


def make(width, parameters, rng):
    length = parameters[-1] - parameters[0]
    data = [rng.standard_normal((len(parameters), 2))]
    for _ in range(1, width):
        data.append(data[-1][::-1] / length)
    return CLASSES[width](*data, parameters)


@each_row("order", [0, 1, 2, 3])
@each_row("name", NAMES)
@each_row("width", CLASSES)
def test_bound(exact, rng, width, name, order):
    parameters = exact.parameter_sets(20, rng)[name] * WITHIN_RANGE.get((width, name), 1.0)
    curve = make(width, parameters, rng)
    nodes = [exact.rational(x) for x in parameters]
    inside_and_out = exact.probes(parameters, rng, 8)
    true = {x: exact.hermite_terms(exact.rational(x), nodes, width, order) for x in inside_and_out.tolist()}
    judged = set()

    def judge(place, computed, terms):
        if (place, computed) not in judged:
            judged.add((place, computed))
            constant = exact.worst_constant(computed, terms)
            assert constant is None or constant <= LIMIT

    # What lies inside and nothing else is computed by another way, mostly to the same numbers.
    for t in (
        inside_and_out,
        inside_and_out[(inside_and_out >= parameters[0]) & (inside_and_out <= parameters[-1])],
    ):
        values, local = curve.evaluate(t, order), curve.local_basis(t, order)
        assert np.isfinite(values).all()
        for k, x in enumerate(t.tolist()):
            segment, functions = true[x]
            assert local.segment[k] == segment
            for d in range(2):
                terms = [
                    functions[end][r] * exact.rational(curve.jets[segment + end, r, d])
                    for end in (0, 1)
                    for r in range(width)
                ]
                judge((x, d), values[k, d], terms)
            h = nodes[segment + 1] - nodes[segment]
            for end in (0, 1):
                for r in range(width):
                    if abs(functions[end][r] * h**order / h**r) < TINY:
                        continue  # s**2 of the local s is out of range, not only the result
                    judge((x, end, r), local.values[k, end, r], [functions[end][r]])


def test_second_derivative_at_the_middle_of_a_segment(exact):
    """Without double-double factors the constant was 9370: position functions vanish there."""
    parameters = np.array([0.0, 1e-5, 1.0])
    curve = HermiteCurve([[1.0], [2.0], [0.0]], [[1e-3], [2e-3], [1.0]], parameters)
    t = np.nextafter(5e-6, 1.0)
    segment, functions = exact.hermite_terms(exact.rational(t), [exact.rational(x) for x in parameters], 2, 2)
    terms = [functions[e][r] * exact.rational(curve.jets[segment + e, r, 0]) for e in (0, 1) for r in (0, 1)]
    assert exact.worst_constant(curve.evaluate(t, 2)[0], terms) <= LIMIT
