"""Cardinal functions: what a point does where velocities and accelerations are estimated from the points."""

from functools import partial
from itertools import pairwise

import numpy as np
import pytest
from flint import fmpq, fmpq_mat

from curvecore import (
    CardinalBasis,
    Chain,
    CurveError,
    HermiteCurve,
    LagrangeCurve,
    QuinticHermiteCurve,
    bessel_velocities,
    cardinal_basis,
    catmull_rom_velocities,
    centripetal,
    chord_length,
    ensemble,
    estimation_matrix,
    finite_difference_velocities,
    follow_rules,
    lebesgue_constant,
    lebesgue_function,
    natural_spline_accelerations,
    natural_spline_velocities,
    point_sensitivity,
    uniform,
    worst_case_band,
    zero_accelerations,
)
from curvecore.analysis.cardinal import signs_of_errors
from curvecore.analysis.stability import lebesgue_constants
from curvecore.families.chain import joint_of_row
from tests.rows import each_row

# Two groups of near points and a long way between them, those of the lesson on chord length.
UNEVEN = np.array([(0.0, 0.0), (0.5, 0.1), (1.0, 0.0), (5.0, 2.2), (5.4, 2.2), (5.8, 2.0), (6.2, 2.1)])
PARAMETRIZATIONS = {
    "uniform": lambda points: uniform(len(points)),
    "chord": chord_length,
    "middle": centripetal,
}
DYADIC = np.array([0.0, 0.125, 0.25, 1.0, 1.0625, 1.5, 1.75])


def catmull_rom(points, t):
    return catmull_rom_velocities(points, t, 0.5, knots_of=UNEVEN[: len(t)])


def zero(points, _t):
    return zero_accelerations(points)


VELOCITIES = [natural_spline_velocities, bessel_velocities, finite_difference_velocities, catmull_rom]
RULES = [(velocity,) for velocity in VELOCITIES]
RULES += [(natural_spline_velocities, natural_spline_accelerations), (bessel_velocities, zero)]
every_rule = pytest.mark.parametrize("rules", RULES)


def estimated(points, t, rules):
    """The curve through points whose derivatives the rules estimate."""
    derivatives = [rule(points, t) for rule in rules]
    return (HermiteCurve if len(rules) == 1 else QuinticHermiteCurve)(points, *derivatives, t)


def cardinal_of(t, rules, **other):
    return CardinalBasis(estimated(np.zeros((len(t), 2)), t, rules), follow_rules(t, *rules), **other)


def between(t, each=33):
    return np.unique(np.concatenate([np.linspace(*ends, each) for ends in pairwise(t.tolist())]))


def exact_matrix(rule, t):
    """The matrix of a rule in fractions, from the conditions that define it."""
    t = [fmpq(*float(each).as_integer_ratio()) for each in t]
    n = len(t)
    h = [b - a for a, b in pairwise(t)]
    slope = [[fmpq((i == j + 1) - (i == j)) / h[j] for i in range(n)] for j in range(n - 1)]
    if rule is finite_difference_velocities:
        inner = [[(a + b) / 2 for a, b in zip(*pair, strict=True)] for pair in pairwise(slope)]
        return [slope[0], *inner, slope[-1]]
    if rule is bessel_velocities:
        rows = []
        for j in range(n):
            k = min(max(j, 1), n - 2)  # the parabola through k - 1, k, k + 1, differentiated at t_j
            row = [fmpq(0)] * n
            for i in (k - 1, k, k + 1):
                u, v = (t[m] for m in (k - 1, k, k + 1) if m != i)
                row[i] = (2 * t[j] - u - v) / ((t[i] - u) * (t[i] - v))
            rows.append(row)
        return rows
    # Velocities of which the cubics' second derivatives agree at the joints and vanish at both ends.
    matrix, right = fmpq_mat(n, n), fmpq_mat(n, n)
    for j in range(n):
        for k, near in ((j - 1, True), (j, False)):
            if 0 <= k < n - 1:
                other = k if near else k + 1
                matrix[j, j] += 2 / h[k]
                matrix[j, other] += 1 / h[k]
                for i in range(n):
                    right[j, i] += 3 * slope[k][i] / h[k]
    solved = matrix.solve(right)
    return [[solved[j, i] for i in range(n)] for j in range(n)]


@pytest.mark.parametrize("rule", VELOCITIES[:3])
def test_matrices_against_fractions(rule):
    exact = np.array([[float(int(x.p)) / float(int(x.q)) for x in row] for row in exact_matrix(rule, DYADIC)])
    # A few roundings of the largest entries, those of the narrowest gap.
    assert estimation_matrix(rule, DYADIC) == pytest.approx(exact, rel=1e-13, abs=1e-14 * np.abs(exact).max())


@every_rule
@pytest.mark.parametrize("kind", PARAMETRIZATIONS)
def test_the_functions_make_the_curve_of_the_estimator(rules, kind, rng):
    t = PARAMETRIZATIONS[kind](UNEVEN)
    at = between(t)
    points = rng.standard_normal((7, 3))
    curve = estimated(points, t, rules)
    for order in range(3):
        sums = cardinal_basis(curve, at, order, rules=rules)
        size = np.abs(sums).sum(axis=1).max()
        assert sums @ points == pytest.approx(curve.evaluate(at, order), abs=1e-13 * size)
        assert sums.sum(axis=1) == pytest.approx(0.0 if order else 1.0, abs=1e-14 * size)
    assert cardinal_basis(curve, t, rules=rules) == pytest.approx(np.eye(7), abs=1e-15)


@pytest.mark.parametrize(
    ("rule", "published"),
    [(natural_spline_velocities, (1.50, 3.12, 8.56)), (bessel_velocities, (1.25, 2.21, 5.66))],
)
def test_errors_of_seven_points_grow_although_the_constant_of_the_family_is_one(rule, published):
    """It said 1 for every one of them."""
    for t, expected in zip((uniform(7), centripetal(UNEVEN), chord_length(UNEVEN)), published, strict=True):
        cardinal = cardinal_of(t, (rule,))
        constant = lebesgue_constant(cardinal)
        assert constant == pytest.approx(expected, abs=0.005)
        assert lebesgue_constant(cardinal.curve) == 1.0
        at = between(t, 4001)
        # Between two samples 1/4000 of a segment apart the function rises by little.
        assert lebesgue_function(cardinal, at).max() == pytest.approx(constant, rel=1e-6)


def test_constants_of_many_bases_equal_those_of_each_basis(rng):
    """Cubics and quintics, few points and many, whose tables are filled up to one width."""
    bases = [
        cardinal_of(chord_length(rng.standard_normal((n, 2))), rules)
        for n in (2, 3, 7, 40, 600)
        for rules in (RULES[0], RULES[1], RULES[4])
    ]
    bases = [basis for basis in bases if basis.follows]
    together = lebesgue_constants(bases)
    assert together == pytest.approx([lebesgue_constant(basis) for basis in bases], rel=1e-13)
    for basis, constant in zip(bases, together, strict=True):
        sampled = lebesgue_function(basis, between(basis.parameters, 25)).max()
        assert sampled * (1 - 1e-13) <= constant <= sampled * 1.02


@every_rule
def test_the_worst_signs_move_the_estimated_curve_by_the_constant(rules):
    """Errors of 0.05 displaced the curve by 0.428 where Λ = 1 allowed 0.05."""
    t, epsilon = chord_length(UNEVEN), 0.05
    cardinal = cardinal_of(t, rules)
    constant = lebesgue_constant(cardinal)
    at = between(t, 401)
    curve = estimated(UNEVEN, t, rules)
    signs = np.array(np.meshgrid(*[[1.0, -1.0]] * 7)).reshape(7, -1).T
    moved = 0.0
    for sign in signs[: len(signs) // 2]:
        other = estimated(UNEVEN + epsilon * sign[:, None] * [0.6, 0.8], t, rules)
        moved = max(moved, np.linalg.norm(other.evaluate(at) - curve.evaluate(at), axis=1).max())
    assert moved == pytest.approx(epsilon * constant, rel=1e-5)
    if rules == (natural_spline_velocities,):
        assert moved == pytest.approx(0.428, abs=5e-4)
    band = worst_case_band(curve, at, epsilon, cardinal=cardinal)
    assert band.distance.max() == pytest.approx(moved, rel=1e-12)
    assert (worst_case_band(curve, at, [epsilon] * 7, cardinal=cardinal).across == band.across).all()


@pytest.mark.parametrize("n", [131, 1000])
def test_many_points_from_a_few_moves_of_many_at_once(n, rng):
    t = np.cumsum(rng.uniform(0.2, 1.0, n))
    points = rng.standard_normal((n, 2))
    at = np.sort(rng.uniform(t[0], t[-1], 200))
    for rules in RULES[:1] + RULES[4:]:
        curve = estimated(points, t, rules)
        cardinal = cardinal_of(t, rules)
        functions = cardinal.basis(at)
        assert functions @ points == pytest.approx(curve.evaluate(at), abs=1e-12)
        assert cardinal.sums(at) == pytest.approx(np.abs(functions).sum(axis=1), rel=1e-13)
        # What is left of a point after 24 others, were it half at each one, as it never is.
        assert np.abs(cardinal_of(t, rules, reach=24).basis(at) - functions).max() < 2.0**-24
    assert cardinal_of(t, (bessel_velocities,)).local(at).values.shape[1] <= 6


def test_a_closed_curve_is_one_of_its_points(rng):
    """The last joint is the first point again; nothing is lost round the end."""
    for n in (5, 200):
        t = np.cumsum(rng.uniform(0.5, 1.0, n + 1))
        points = rng.standard_normal((n, 2))

        def velocities(moves, t=t, n=n):
            before, after = np.roll(moves, 1, axis=0), np.roll(moves, -1, axis=0)
            h = np.diff(t)[:, None]
            return ((after - before) / (h + np.roll(h, 1, axis=0)))[np.arange(n + 1) % n]

        def follow(moves, velocities=velocities):
            found = velocities(moves)[:, None]
            return found, found

        at_joints = points[np.arange(n + 1) % n]
        curve = HermiteCurve(at_joints, velocities(points), t)
        cardinal = CardinalBasis(curve, follow, closed=True)
        at = between(t, 5)
        assert cardinal.basis(at) @ points == pytest.approx(curve.evaluate(at), abs=1e-13)
        assert CardinalBasis(curve, closed=True).basis(at).sum(axis=1) == pytest.approx(1.0)
        random = ensemble(curve, 0.1, count=3, closed=True)
        assert (random.jets[:, 0, 0] == random.jets[:, -1, 0]).all()


def test_corners_have_two_sides_and_given_velocities_stay(rng):
    t, corner = DYADIC, 3
    parts = (slice(0, corner + 1), slice(corner, 7))
    velocity = np.array([[1.0, 2.0]])

    def follow(moves):
        before, after = np.zeros((7, 1, moves.shape[1])), np.zeros((7, 1, moves.shape[1]))
        first, second = (natural_spline_velocities(moves[part], t[part]) for part in parts)
        before[: corner + 1, 0], after[corner:, 0] = first, second
        after[:corner, 0], before[corner + 1 :, 0] = first[:-1], second[1:]
        before[1], after[1] = 0.0, 0.0
        return before, after

    def made(points):
        pieces = []
        for part in parts:
            velocities = natural_spline_velocities(points[part], t[part])
            if part.start == 0:
                velocities[1] = velocity
            pieces.append(HermiteCurve(points[part], velocities, t[part]))
        return Chain(pieces)

    points, moves = rng.standard_normal((7, 2)), 0.1 * rng.standard_normal((7, 2))
    curve, at = made(points), between(t, 9)
    cardinal = CardinalBasis(curve, follow)
    moved = made(points + moves).evaluate(at) - curve.evaluate(at)
    assert point_sensitivity(cardinal, at) @ moves == pytest.approx(moved, abs=1e-14)
    assert lebesgue_constant(cardinal) > 1.1


def test_without_estimates_cardinal_functions_are_those_of_the_family(rng):
    at = between(DYADIC)
    points = rng.standard_normal((7, 2))
    curves = [LagrangeCurve(points, DYADIC), HermiteCurve(points, points, DYADIC)]
    curves += [
        Chain(
            [
                HermiteCurve(points[:4], points[:4], DYADIC[:4]),
                HermiteCurve(points[3:], points[3:], DYADIC[3:]),
            ]
        )
    ]
    curves += [Chain([LagrangeCurve(points[:4], DYADIC[:4]), LagrangeCurve(points[3:], DYADIC[3:])])]
    for curve in curves:
        cardinal = CardinalBasis(curve)
        values = curve.basis(at)[:, :, 0]
        folded = np.zeros((len(at), 7))
        for row, column in enumerate(joint_of_row(curve)):
            folded[:, column] += values[:, row]
        assert (cardinal.basis(at) == folded).all()
        assert lebesgue_constant(cardinal) == lebesgue_constant(curve)


def test_an_ensemble_of_estimated_curves_stays_in_its_band():
    t = chord_length(UNEVEN)
    rules = (natural_spline_velocities,)
    curve = estimated(UNEVEN, t, rules)
    made = partial(estimated, rules=rules)
    at = between(t, 17)
    random = ensemble(curve, 0.05, count=400, seed=1, remake=made)
    away = np.linalg.norm(random.evaluate(at) - curve.evaluate(at), axis=2)
    band = worst_case_band(curve, at, 0.05, cardinal=cardinal_of(t, rules))
    assert (away <= band.distance * (1 + 1e-12)).all()
    # With velocities that stay no curve leaves a band of 0.05.
    assert away.max() > 3 * 0.05


@each_row("count", range(2, 22))
def test_any_six_neighbours_have_errors_of_all_signs(count):
    """Around the seam of a closed curve, too."""
    width = min(count, 6)
    for closed in (False, True):
        found = signs_of_errors(count, closed=closed)
        assert (np.abs(found) == 1.0).all()
        for first in range(count if closed else count - width + 1):
            window = found[(first + np.arange(width)) % count]
            assert len(np.unique(window, axis=1).T) == 2**width


def test_effects_that_do_not_fit_the_curve_are_refused():
    curve = HermiteCurve(UNEVEN, UNEVEN, chord_length(UNEVEN))
    with pytest.raises(CurveError, match="follow must return"):
        CardinalBasis(curve, lambda moves: (moves, moves))
    with pytest.raises(CurveError, match="local"):
        CardinalBasis(LagrangeCurve(UNEVEN, chord_length(UNEVEN)), lambda moves: (moves, moves))
