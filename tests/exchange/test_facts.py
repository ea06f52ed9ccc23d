"""Facts about curves: arc length against closed forms, boxes, warnings."""

from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from flint import acb, arb, fmpq, fmpq_poly

from app.document.model import (
    Curve,
    Document,
    Parametrization,
    ParametrizationKind,
    Point,
    make_curve,
)
from app.exchange.facts import facts_of
from app.families import FAMILIES, HERMITE, LAGRANGE, QUINTIC_HERMITE
from app.view_model.curve.curve_view import view_of
from curvecore import HermiteCurve, LagrangeCurve, QuinticHermiteCurve
from tests.effort import calls_of


def quadratic(curve_data):
    """The document of one cubic Hermite segment over [0, 1] along (3, 4), for x' = a + b t + c t²."""
    a, b, c = curve_data
    end, last = a + b / 2 + c / 3, a + b + c
    points = (
        Point(0.0, 0.0, velocity=(3.0 * a, 4.0 * a)),
        Point(3.0 * end, 4.0 * end, velocity=(3.0 * last, 4.0 * last)),
    )
    rule = Parametrization(ParametrizationKind.UNIFORM)
    return Document((Curve("", HERMITE, rule, points),))


def way(a, b, c):
    """The exact way of x' = a + b t + c t² over [0, 1], times 5: it turns where x' is zero."""
    turns = [arb(0), arb(1)]
    if c:
        root = (arb(b) ** 2 - 4 * arb(a) * arb(c)).sqrt()
        both = [(-arb(b) + sign * root) / (2 * arb(c)) for sign in (1, -1)] if root.is_finite() else []
        turns += [each for each in both if 0 < each < 1]
    turns.sort(key=float)
    reached = [t * (arb(a) + t * (arb(b) / 2 + t * arb(c) / 3)) for t in turns]
    return 5 * sum((abs(after - before) for before, after in pairwise(reached)), arb(0))


def test_the_length_of_a_line_run_back_and_forth_is_within_its_bound():
    """Random speeds that change their sign, and those of (0, 0) v (6, 0) and (−4, 0) v (7, 0).

    Of these 60, 8 were off by more than was said; the pair was said to be 5.45780234 ± 3e-11 long.
    """
    speeds = 3.0 * np.random.default_rng(10).integers(-64, 65, (60, 3))
    for a, b, c in [*speeds.tolist(), [6.0, -62.0, 63.0]]:
        (facts,) = facts_of(quadratic((a, b, c)))
        truth = way(a, b, c)
        assert abs(truth - facts.length.value) <= facts.length.error, (a, b, c)
        assert facts.length.error <= 2e-9 * truth
    assert facts.length.value / 5 == pytest.approx(5.45780739483, rel=1e-11)


def power_times_line(tau, power, start, slope):
    """A segment over [0, 1] with c' = (t − τ)**power (start + slope t), whose data are exact."""
    basis = fmpq_poly([-tau, 1]) ** power
    slopes = [basis * fmpq_poly([a, b]) for a, b in zip(start, slope, strict=True)]
    places = [each.integral() for each in slopes]

    def at(polynomials, t):
        return tuple(float(Fraction(int(v.p), int(v.q))) for v in (each(t) for each in polynomials))

    bends = [each.derivative() for each in slopes]
    points = tuple(Point(*at(places, t), velocity=at(slopes, t), acceleration=at(bends, t)) for t in (0, 1))
    family = HERMITE if power == 1 else QUINTIC_HERMITE
    rule = Parametrization(ParametrizationKind.UNIFORM)
    return Document((Curve("", family, rule, points),))


def length_with_a_stop(tau, power, start, slope):
    """∫ |t − τ|**power |start + slope t| dt, enclosed on either side of τ."""
    (a, b), (c, d) = start, slope
    square = [arb(a * a + b * b), arb(2 * (a * c + b * d)), arb(c * c + d * d)]

    def speed(sign):
        def of(z, analytic):
            rest = ((square[2] * z + square[1]) * z + square[0]).sqrt(analytic=analytic)
            return (sign * (z - acb(arb(tau)))) ** power * rest

        return of

    stop = acb(arb(tau))
    return acb.integral(speed(-1), acb(0), stop).real + acb.integral(speed(1), stop, acb(1)).real


@pytest.mark.parametrize("power", [1, 2, 3])
def test_the_length_at_cusps_and_rests_is_within_its_bound(power):
    """c' = (t − τ)**k (a + b t): a cusp for odd k, a rest for even k, anywhere inside."""
    rng = np.random.default_rng(power)
    for _ in range(25):
        tau = fmpq(int(rng.integers(1, 64)), 64)
        start, slope = (60 * rng.integers(-8, 9, (2, 2))).tolist()
        if not any(start) or not any(slope):
            continue
        (facts,) = facts_of(power_times_line(tau, power, start, slope))
        truth = length_with_a_stop(tau, power, start, slope)
        # The data are rounded once: a point by u, which moves the speed by a few of it.
        slack = 64 * 2.0**-53 * truth
        assert abs(truth - facts.length.value) <= facts.length.error + slack, (tau, start, slope)
        assert facts.length.error <= 2e-9 * truth


def test_facts_of_the_examples(example):
    (facts,) = facts_of(example)
    curve = view_of(example.curves[0]).curve
    samples = curve.evaluate(np.linspace(*curve.domain, 20001))
    size = np.ptp(samples, axis=0).max()
    assert facts.points == len(curve.points)
    assert facts.degree == curve.degree
    assert facts.domain == curve.domain
    assert not facts.warnings
    edges = [*samples.min(axis=0), *samples.max(axis=0)]
    np.testing.assert_allclose(facts.box, edges, rtol=0, atol=2e-5 * size)
    polygon = np.hypot(*np.diff(samples, axis=0).T).sum()
    assert facts.length.value == pytest.approx(polygon, rel=1e-6)
    assert facts.length.value >= polygon * (1 - 1e-12)


def test_an_invalid_curve_gives_the_reason(half_drawn):
    line, begun = facts_of(half_drawn)
    assert line.warnings == ()
    assert begun.points == 1
    assert (begun.degree, begun.domain, begun.length, begun.box) == (None,) * 4
    assert begun.warnings == ("A curve needs at least two points.",)


def many(count):
    """Curves of four points of all families, side by side."""
    rng = np.random.default_rng(count)
    points = rng.normal(size=(count, 4, 2)) + 9.0 * np.arange(count)[:, None, None]
    families = FAMILIES
    return Document(tuple(make_curve(each.tolist(), family=families[k % 3]) for k, each in enumerate(points)))


def test_the_facts_of_twice_as_many_curves_take_twice_the_evaluations(monkeypatch):
    """Each curve was made twice, and sampled at 513 parameters and more besides: 60 s for 20,000."""
    counts = []
    for each in (LagrangeCurve, HermiteCurve, QuinticHermiteCurve):

        def counting(self, t, order=0, plain=each.evaluate):
            counts.append(np.size(t))
            return plain(self, t, order)

        monkeypatch.setattr(each, "evaluate", counting)
    taken = []
    for count in (30, 60):
        counts.clear()
        facts_of(many(count))
        taken.append(sum(counts))
    assert taken[1] < 2.2 * taken[0]
    assert taken[0] < 30 * 120


def test_the_facts_of_many_small_curves_take_few_calls_each():
    """What a small curve costs is calls, not arithmetic: 5,080 for each of these, 55 s for 20,000."""
    curves = many(60)
    assert calls_of(lambda: facts_of(curves)) < 2200 * 60


def test_the_facts_of_many_curves_report_progress():
    told = []
    facts_of(many(5), lambda share, _word: told.append(share))
    assert told == [0.0, 0.2, 0.4, 0.6, 0.8, 1.0]


def uniform(points):
    rule = Parametrization(ParametrizationKind.UNIFORM)
    return Document((Curve("", LAGRANGE, rule, tuple(Point(*point) for point in points)),))


def test_growing_errors_are_mentioned():
    (facts,) = facts_of(uniform([(float(i), 0.0) for i in range(20)]))
    (warning,) = facts.warnings
    # The Lebesgue constant of 20 uniform points is 5889.6 (Trefethen & Weideman, J. Approx. Theory 65
    # (1991) 247-260 give its growth); sampling finds most of it.
    assert warning.startswith("Errors in the points grow up to 5.9e+03-fold")


def test_a_curve_beyond_all_floats_has_no_length_and_no_box():
    # Beyond forty parameters that nearly coincide, the polynomial grows like (1e24)**39.
    points = (*(Point(float(i), (-1.0) ** i, t=i * 1e-12) for i in range(40)), Point(0.0, 0.0, t=1e12))
    rule = Parametrization(ParametrizationKind.MANUAL)
    (facts,) = facts_of(Document((Curve("", LAGRANGE, rule, points),)))
    assert (facts.length, facts.box) == (None, None)
    assert facts.warnings[0].startswith("“” oscillates beyond 1e+30 between points")
    assert "Errors in the points grow without bound" in facts.warnings[1]


def test_a_lagrange_curve_of_very_many_points_is_measured_as_any_other():
    """It was not above 500 points, without a word."""
    rule = Parametrization(ParametrizationKind.MANUAL)  # t is exact: its rounding costs no lengths
    points = tuple(Point(float(i), 0.0, t=float(i)) for i in range(600))
    (facts,) = facts_of(Document((Curve("", LAGRANGE, rule, points),)))
    # Of n uniform points Λ is some 2ⁿ / (e (n - 1) (ln (n - 1) + γ)), within a tenth here.
    expected = 600 * np.log10(2.0) - np.log10(np.e * 599 * (np.log(599) + np.euler_gamma))
    assert np.log10(facts.lebesgue_constant.points) == pytest.approx(expected, abs=0.05)
    # Rounding of the points, grown by that.
    assert facts.length.error > facts.length.value
