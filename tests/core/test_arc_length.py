"""Lengths are within their bounds of integrals that flint encloses."""

from itertools import pairwise

import numpy as np
import pytest
from flint import acb, arb, ctx, fmpq, fmpq_poly

from curvecore import (
    ArcLength,
    Chain,
    CurveError,
    HermiteCurve,
    LagrangeCurve,
    QuinticHermiteCurve,
    arc_length,
    bezier_stretch,
    chebyshev,
    equal_arc_length_parameters,
    parameter_at_length,
    uniform,
)
from tests.rows import each_row

CUSP = HermiteCurve([[0, 0], [1, 0]], [[3, 3], [3, -3]], [0, 1])
CUSP_LENGTH = 2.0 * np.sqrt(2.0) - 1.0  # c' = (3 u**2, 3 u) with u = 1 - 2 t
TOLERANCES = [10.0**-k for k in range(1, 13)]


def integral(polynomials, parts):
    """The length of a polynomial curve over [0, 1], enclosed by flint on so many parts."""
    ctx.dps = 30
    try:
        total = arb(0)
        for k in range(parts):
            # On its own [0, 1] a part's coefficients fall off, so that discs stay narrow.
            place = fmpq_poly([fmpq(k, parts), fmpq(1, parts)])
            slopes = [p(place).derivative() for p in polynomials]
            total += part_integral(sum((s * s for s in slopes), fmpq_poly([0])))
        assert float(total.rad()) < 1e-16
        return float(total.mid())
    finally:
        ctx.dps = 15


def part_integral(square):
    coefficients = [acb(arb(c)) for c in square.coeffs()]

    def speed(z, analytic):
        total = acb(0)
        for c in reversed(coefficients):
            total = total * z + c
        return total.sqrt(analytic=analytic)

    return acb.integral(speed, acb(0), acb(1), rel_tol=arb(1e-19), abs_tol=arb(1e-19)).real


def through(exact, points, parameters):
    """The exact interpolating polynomials, one a coordinate."""
    nodes = [exact.rational(x) for x in parameters]
    result = []
    for axis in range(points.shape[1]):
        total = fmpq_poly([0])
        for i, node in enumerate(nodes):
            factor = fmpq_poly([exact.rational(points[i, axis])])
            for j, other in enumerate(nodes):
                if j != i:
                    factor *= fmpq_poly([-other, 1]) / (node - other)
            total += factor
        result.append(total)
    return result


def hermite_truth(exact, curve):
    """The length of a Hermite curve from its segments as interpolating polynomials at 6 or 4 places."""
    total = 0.0
    count = curve.degree + 1
    for i in range(len(curve.parameters) - 1):
        stretch = [
            [exact.rational(x) for x in row] for row in bezier_stretch(curve, *curve.parameters[i : i + 2])
        ]
        s, r = fmpq_poly([0, 1]), fmpq_poly([1, -1])
        polynomials = []
        for axis in range(curve.points.shape[1]):
            polynomial = fmpq_poly([0])
            for k in range(count):
                binomial = fmpq(1)
                for j in range(k):
                    binomial = binomial * (count - 1 - j) / (j + 1)
                polynomial += binomial * stretch[k][axis] * s**k * r ** (count - 1 - k)
            polynomials.append(polynomial)
        total += integral(polynomials, 4)
    return total


def dyadic(array):
    """Few bits, so that the control points are exact."""
    return np.round(array * 256.0) / 256.0


@pytest.mark.parametrize("family", [HermiteCurve, QuinticHermiteCurve])
@pytest.mark.parametrize("dim", [2, 3])
def test_hermite_lengths_decade_by_decade(rng, exact, family, dim):
    t = np.array([0.0, 0.5, 0.75, 2.0])
    count = 2 if family is HermiteCurve else 3
    curve = family(*(dyadic(rng.standard_normal((4, dim))) for _ in range(count)), t)
    truth = hermite_truth(exact, curve)
    for tolerance in TOLERANCES:
        length = arc_length(curve, tolerance)
        assert abs(length.value - truth) <= length.error + 1e-15 * truth
        assert length.error <= max(tolerance, 1e-13 * truth)


@pytest.mark.parametrize("n", [3, 6, 12, 16])
def test_lagrange_lengths_decade_by_decade(rng, exact, n):
    points, t = rng.standard_normal((n, 2)), chebyshev(n)
    polynomials = through(exact, points, t)
    truth = integral(polynomials, 4 * n)
    for tolerance in TOLERANCES[:10]:
        length = arc_length(LagrangeCurve(points, t), tolerance)
        assert abs(length.value - truth) <= length.error + 1e-15 * truth
        assert length.error <= max(tolerance, 1e-10 * truth)


@each_row("tolerance", TOLERANCES)
def test_the_length_of_a_cusp_is_within_the_bound(tolerance):
    length = arc_length(CUSP, tolerance)
    assert abs(length.value - CUSP_LENGTH) <= length.error
    assert length.error <= tolerance


def test_a_line_run_back_and_forth():
    """x = 6 t (1 - t) goes from 0 to 1.5 and back: the speed has a kink, and the length is 3."""
    curve = HermiteCurve([[0, 0], [0, 0]], [[6, 0], [-6, 0]], [0, 1])
    for tolerance in TOLERANCES:
        length = arc_length(curve, tolerance)
        assert abs(length.value - 3.0) <= length.error <= tolerance


def test_the_circle_of_quintics_is_almost_a_circle():
    """Birkhoff and Priver (1967): |e'| <= 5**.5 h**5 M / 30000, which bounds the length as well."""
    for segments in (4, 8, 16, 32):
        t = uniform(segments + 1)
        angle = 2.0 * np.pi * t
        point = np.stack((np.cos(angle), np.sin(angle)), axis=1)
        velocity = 2.0 * np.pi * np.stack((-point[:, 1], point[:, 0]), axis=1)
        curve = QuinticHermiteCurve(point, velocity, -((2.0 * np.pi) ** 2) * point, t)
        length = arc_length(curve, 1e-12)
        bound = np.sqrt(5.0) * (1.0 / segments) ** 5 * (2.0 * np.pi) ** 6 / 30000.0
        assert abs(length.value - 2.0 * np.pi) <= bound + length.error
        assert length.error <= 1e-12


def test_parts_add_up(rng):
    curve = HermiteCurve(rng.standard_normal((4, 2)), rng.standard_normal((4, 2)), uniform(4))
    whole = arc_length(curve, 1e-9)
    parts = [arc_length(curve, 1e-9, low, high) for low, high in ((None, 0.2), (0.2, 0.7), (0.7, 9.0))]
    assert abs(sum(part.value for part in parts) - whole.value) <= 1e-9
    assert arc_length(curve, 1e-9, 0.3, 0.3).value == 0.0
    assert arc_length(curve, 1e-9, -5.0, 5.0) == whole


@pytest.mark.parametrize("curve", [CUSP, LagrangeCurve([[0, 0], [1, 3], [2, -1], [5, 0]], [0, 1, 2, 4])])
def test_parameters_at_lengths_and_back(curve):
    table = ArcLength(curve, 1e-11)
    wanted = np.linspace(0.0, table.total.value, 101)
    t = table.parameter_at(wanted)
    assert (np.diff(t) > 0.0).all()
    assert np.abs(table.length_at(t) - wanted).max() <= 2e-11
    assert table.parameter_at(-1.0) == curve.domain[0]
    assert table.parameter_at(1e9) == pytest.approx(curve.domain[1], abs=1e-6)
    assert parameter_at_length(curve, 1.0, 1e-11) == table.parameter_at(1.0)
    first = arc_length(curve, 1e-11, end=float(t[50]))
    assert first.value == pytest.approx(wanted[50], abs=4e-11)


def test_equal_parts(rng):
    curve = QuinticHermiteCurve(*rng.standard_normal((3, 5, 2)), uniform(5))
    t = equal_arc_length_parameters(curve, 9, 1e-10)
    assert (t[0], t[-1], t.size) == (0.0, 1.0, 9)
    parts = [arc_length(curve, 1e-11, *pair).value for pair in pairwise(t)]
    assert np.ptp(parts) <= 4e-10


def test_a_curve_at_rest():
    still = HermiteCurve(np.ones((3, 2)), np.zeros((3, 2)), uniform(3))
    assert arc_length(still, 1e-9).value == 0.0
    assert (equal_arc_length_parameters(still, 4, 1e-9)[[0, -1]] == [0.0, 1.0]).all()
    assert np.isfinite(ArcLength(still, 1e-9).parameter_at([0.0, 1.0])).all()


def test_a_rest_in_the_middle_is_passed_at_its_beginning():
    points = [[0, 0], [1, 0], [1, 0], [2, 0]]
    curve = HermiteCurve(points, np.zeros((4, 2)), [0, 1, 2, 3])
    assert ArcLength(curve, 1e-12).parameter_at(1.0) == pytest.approx(1.0, abs=1e-5)


def test_a_chain_with_a_break_counts_its_pieces():
    pieces = [HermiteCurve([[k, 9 * k], [k + 1, 9 * k]], [[1, 0], [1, 0]], [k, k + 1]) for k in (0, 1)]
    assert arc_length(Chain(pieces), 1e-12).value == pytest.approx(2.0, abs=1e-12)


@each_row("size", [1e-300, 1e-150, 1e150, 1e300])
def test_sizes_do_not_matter(rng, size):
    scale = 2.0 ** round(np.log2(size))
    points, t = rng.standard_normal((5, 2)), uniform(5)
    for family, count in ((LagrangeCurve, 1), (HermiteCurve, 2)):
        data = [points, 3.0 * points][:count]
        small = arc_length(family(*data, t), 1e-9)
        large = arc_length(family(*(scale * each for each in data), t), 1e-9 * scale)
        assert large.value / scale == pytest.approx(small.value, rel=1e-13)


def test_a_wild_polynomial_gets_an_honest_bound(rng):
    """40 uniform parameters: sizes of 1e9, and a tolerance that no arithmetic of 53 bits can meet."""
    curve = LagrangeCurve(rng.standard_normal((40, 2)), uniform(40))
    length = arc_length(curve, 1e-9)
    t = np.linspace(0.0, 1.0, 100001)
    chords = np.linalg.norm(np.diff(curve.evaluate(t), axis=0), axis=1).sum()
    assert length.value >= chords - length.error
    assert length.value <= chords * 1.001
    assert 1e-9 < length.error < 1e-6 * length.value


def circle_of(family, n):
    t = uniform(n) if family is HermiteCurve else chebyshev(n)
    angle = 2.0 * np.pi * t
    points = np.stack((np.cos(angle), np.sin(angle)), axis=1)
    if family is LagrangeCurve:
        return LagrangeCurve(points, t)
    return HermiteCurve(points, 2.0 * np.pi * np.stack((-points[:, 1], points[:, 0]), axis=1), t)


@pytest.mark.parametrize("family", [HermiteCurve, LagrangeCurve])
def test_more_points_on_a_circle_do_not_widen_the_bound(family):
    """Through 100 and 800 points: it was 4e-12 and 2e-10 for one polynomial, 5e-13 and 4e-12 piecewise."""
    few, many = (arc_length(circle_of(family, n), 1e-15) for n in (100, 800))
    assert abs(many.value - 2.0 * np.pi) <= many.error + 1e-10 * (family is HermiteCurve)
    assert many.error <= 2.0 * few.error <= 4e-13


def test_the_bound_grows_as_the_length_does():
    """A zigzag away from the origin: the bound grew like n**2, and at 10,000 points was 5376 of 23066."""
    relative = []
    for n in (100, 1000, 10000):
        k = np.arange(n)
        curve = HermiteCurve(np.stack((k, (-1.0) ** k), axis=1), np.full((n, 2), [1.0, 0.5]), k)
        length = arc_length(curve, 1e-9 * n)
        relative.append(length.error / length.value)
        assert length.error <= 1e-9 * n
    assert max(relative) <= 1e-9


def test_unusable_arguments():
    with pytest.raises(CurveError, match="tolerance must be greater than 0"):
        arc_length(CUSP, 0.0)
    with pytest.raises(CurveError, match="start must not exceed end"):
        arc_length(CUSP, 1e-3, 0.8, 0.2)
    with pytest.raises(CurveError, match="count must be at least 2"):
        equal_arc_length_parameters(CUSP, 1, 1e-3)
