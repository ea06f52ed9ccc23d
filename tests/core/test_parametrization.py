import math
from fractions import Fraction
from itertools import accumulate, pairwise

import numpy as np
import pytest
from flint import arb, ctx, fmpq

from curvecore import (
    CurveError,
    LagrangeCurve,
    centripetal,
    chebyshev,
    chebyshev_roots,
    chord_length,
    lebesgue_constant,
    power,
    uniform,
)
from tests.rows import each_row

POINTS = np.array([[0.0, 0.0], [3.0, 4.0], [3.0, 5.0], [12.0, 5.0]])  # distances 5, 1, 9


def check(parameters, n):
    assert parameters.shape == (n,)
    assert parameters[0] == 0.0
    assert parameters[-1] == 1.0
    assert (np.diff(parameters) > 0.0).all()


@each_row("n", [2, 3, 4, 5, 50, 51, 9999, 10_000])
def test_point_free_rules(n):
    check(uniform(n), n)
    check(chebyshev(n), n)
    check(chebyshev_roots(n), n)
    assert (uniform(n) == [float(Fraction(i, n - 1)) for i in range(n)]).all()


@each_row("n", [2, 3, 8, 9, 5000])
def test_chebyshev_is_symmetric_and_accurate_next_to_both_ends(n):
    parameters = chebyshev(n)
    assert np.abs(parameters + parameters[::-1] - 1.0).max() <= 2.0**-53
    expected = [math.sin(math.pi * i / (2 * (n - 1))) ** 2 for i in range(n)]
    assert np.abs(parameters - expected).max() <= 4 * 2.0**-53
    assert parameters[1] == pytest.approx(expected[1], rel=1e-15)


@each_row("n", [2, 3, 8, 9, 5000])
def test_chebyshev_roots_are_symmetric_and_accurate_next_to_both_ends(n):
    parameters = chebyshev_roots(n)
    assert np.abs(parameters + parameters[::-1] - 1.0).max() <= 2.0**-53
    # The roots of T_n, by interval arithmetic, mapped so that the outer two are 0 and 1.
    for i in {1, n // 2, n - 1} - {0}:
        root, outer = (arb(fmpq(2 * k + 1, 2 * n)).cos_pi() for k in (i, 0))
        exact = float((1 - root / outer) / 2)
        assert parameters[i] == pytest.approx(exact, rel=4 * 2.0**-53)
        assert 1.0 - parameters[n - 1 - i] == pytest.approx(exact, abs=4 * 2.0**-53)


@each_row("n", [4, 7, 11, 30])
def test_chebyshev_roots_have_a_smaller_lebesgue_constant(n):
    """The least one tends to 2/pi (log n + gamma + log(4/pi)) from above."""
    first, second = (
        lebesgue_constant(LagrangeCurve(np.zeros((n, 1)), rule(n))) for rule in (chebyshev_roots, chebyshev)
    )
    assert first < second
    least = 2 / math.pi * (math.log(n) + np.euler_gamma + math.log(4 / math.pi))
    assert least < first < least + 0.03


def test_values_of_the_power_family():
    assert chord_length(POINTS) == pytest.approx([0.0, 5 / 15, 6 / 15, 1.0], rel=1e-15)
    root = math.sqrt(5)
    assert centripetal(POINTS) == pytest.approx(
        [0.0, root / (root + 4), (root + 1) / (root + 4), 1.0], rel=1e-15
    )
    assert (power(POINTS, 1.0) == chord_length(POINTS)).all()
    assert (power(POINTS, 0.5) == centripetal(POINTS)).all()
    assert (power(POINTS, 0.0) == uniform(4)).all()


@each_row("scale", [1e-300, 1e-150, 1.0, 1e150, 1e307])
@each_row("alpha", [0.0, 0.25, 0.5, 1.0, 2.0])
def test_scale_does_not_matter(scale, alpha):
    parameters = power(scale * POINTS, alpha)
    check(parameters, 4)
    assert parameters == pytest.approx(power(POINTS, alpha), rel=1e-14)


def exact_shares(points, alpha):
    """The parameters of the power rule with 300 bits."""
    rows = [[arb(x) for x in row] for row in points.tolist()]
    squares = (sum((a - b) ** 2 for a, b in zip(*pair, strict=True)) for pair in pairwise(rows))
    total = list(accumulate(square ** (arb(alpha) / 2) for square in squares))
    return [arb(0), *(each / total[-1] for each in total)]


@each_row("alpha", [0.1, 0.5, 0.7, 1.0, 2.0])
def test_parameters_are_within_0_51_units_in_the_last_place(alpha):
    """Sums of rounded distances were off by up to 18 of them at a thousand points."""
    rng = np.random.default_rng(32)
    with ctx.workprec(300):
        for n, dim, spread in ((3, 2, 0), (9, 3, 2), (40, 2, 1), (1000, 1, 1)):
            # Steps of several sizes, and far from the origin: differences of coordinates are rounded.
            steps = rng.standard_normal((n, dim)) * 10.0 ** rng.uniform(-spread, spread, (n, 1))
            points = 0.1 + np.cumsum(steps, axis=0)
            t = power(points, alpha)
            truth = exact_shares(points, alpha)
            worst = max(
                float(abs(x - y) / np.spacing(x)) for x, y in zip(t[1:].tolist(), truth[1:], strict=True)
            )
            assert worst <= 0.51


def test_differences_beyond_the_range():
    check(chord_length([[-1.7e308, 0.0], [1.7e308, 1e308], [1.0, 1.7e308]]), 3)


def test_coincident_points():
    points = [[0.0, 0.0], [1.0, 1.0], [1.0, 1.0], [2.0, 0.0]]
    assert (power(points, 0.0) == uniform(4)).all()
    message = "points 1 and 2 coincide; chord-length parameters need distinct consecutive points"
    with pytest.raises(CurveError, match=message) as caught:
        chord_length(points)
    assert caught.value.indices == (1, 2)
    with pytest.raises(CurveError, match="points 1 and 2 coincide; centripetal"):
        centripetal(points)


def test_points_too_close_for_doubles_are_refused():
    points = [[0.0], [1.0], [1.0 + 2**-52], [3.0]]
    check(centripetal(points), 4)
    with pytest.raises(CurveError, match="parameters 1 and 2 would be equal in double precision") as caught:
        power([[0.0], [1.0], [1.0 + 2**-52], [3.0]], 2.0)
    assert caught.value.indices == (1, 2)
    with pytest.raises(CurveError, match="parameters 0 and 1 would be equal"):
        power([[0.0], [1e-200], [1e200]], 2.0)


@each_row("rule", [uniform, chebyshev])
@each_row(("n", "message"), [(1, "n must be at least 2, not 1"), (2.5, "n must be an integer")])
def test_invalid_counts_are_refused(rule, n, message):
    with pytest.raises(CurveError, match=message):
        rule(n)


@each_row(
    ("alpha", "message"),
    [
        (-0.5, "alpha must be at least 0, not -0.5"),
        (math.nan, "alpha is nan; every value must be finite"),
        ("x", "alpha must be a regular array of real numbers"),
        ([1.0], "alpha must be a single number"),
    ],
)
def test_bad_alpha(alpha, message):
    with pytest.raises(CurveError, match=message):
        power(POINTS, alpha)
