"""Cardinal functions of a curve, the effects of its points, and the sentences about them."""

from __future__ import annotations

from functools import partial
from itertools import product

import numpy as np
import pytest
from msgspec.structs import replace

from app.document.derivatives import AccelerationRule, VelocityRule
from app.document.model import Curve, Document, Parametrization, ParametrizationKind, Point
from app.exchange.facts import facts_of
from app.families import FAMILIES, HERMITE, LAGRANGE, QUINTIC_HERMITE
from app.view_model.analysis.warnings import Topic, warnings_of
from app.view_model.analysis.wiggle import explain
from app.view_model.basis import (
    basis_view,
    cardinal_view,
    growth_of_data,
    growth_of_points,
    parameter_moves,
    weights_at,
)
from app.view_model.bend import Bend, BendWith
from app.view_model.curve.curve_view import curve_through, view_of
from curvecore import ensemble, lebesgue_constant, worst_case_band
from tests import exact_rules
from tests.rows import each_row

CUBIC_SPLINE = FAMILIES.named("cubic_spline")
UNEVEN = [(0.0, 0.0), (0.5, 0.1), (1.0, 0.0), (5.0, 2.2), (5.4, 2.2), (5.8, 2.0), (6.2, 2.1)]
CHORD, MANUAL = ParametrizationKind.CHORD_LENGTH, ParametrizationKind.MANUAL
LINEAR = [rule for rule in VelocityRule if rule.is_linear]
BENT = [rule for rule in VelocityRule if not rule.is_linear and rule is not VelocityRule.CATMULL_ROM]


@pytest.fixture
def rng():
    return np.random.default_rng(1)


def seven(kind=CHORD, family=HERMITE, **other):
    """The points of the lesson on chord length."""
    points = tuple(Point(x, y) for x, y in UNEVEN)
    return Curve("Uneven", family, Parametrization(kind), points, **other)


def frozen(curve):
    """The same curve, its parameters set by hand: moving a point moves none of them."""
    t = view_of(curve).parameters[: len(curve.points)].tolist()
    rule = replace(curve.parametrization, kind=MANUAL)
    points = tuple(replace(point, t=each) for point, each in zip(curve.points, t, strict=True))
    return replace(curve, points=points, parametrization=rule)


def moved(curve, moves):
    """The curve after its points were really moved."""
    points = [
        replace(n, x=n.x + dx, y=n.y + dy) for n, (dx, dy) in zip(curve.points, moves.tolist(), strict=True)
    ]
    return view_of(replace(curve, points=tuple(points)))


def with_points(curve, **changes):
    points = list(curve.points)
    for name, change in changes.items():
        points[int(name[1:])] = replace(points[int(name[1:])], **change)
    return replace(curve, points=tuple(points))


EXPLICIT = {"p1": {"velocity": (1.0, 2.0)}, "p4": {"acceleration": (30.0, -8.0)}}
CORNERS = {"p2": {"corner": True, "velocity_after": (3.0, 1.0)}, "p4": {"corner": True}}
FIRST = {"p0": {"corner": True, "velocity": (1.0, -9.0)}}


@pytest.mark.parametrize("changes", [{}, EXPLICIT, CORNERS, FIRST], ids=["plain", "set", "corners", "first"])
@pytest.mark.parametrize("closed", [False, True])
@pytest.mark.parametrize("rule", LINEAR)
def test_a_moved_point_changes_the_curve_by_its_function(rule, closed, changes, rng):
    """The parameters stay, everything that is estimated is estimated again."""
    for family, acceleration in product((HERMITE, QUINTIC_HERMITE), AccelerationRule):
        curve = seven(family=family, closed=closed, velocity_rule=rule, acceleration_rule=acceleration)
        curve = with_points(frozen(curve), **changes)
        view = view_of(curve)
        assert view.is_current
        t = np.linspace(*view.curve.domain, 101)
        moves = rng.uniform(-0.05, 0.05, (7, 2))
        away = moved(curve, moves).curve.evaluate(t) - view.curve.evaluate(t)
        assert view.cardinal.basis(t) @ moves == pytest.approx(away, abs=1e-12)
        assert weights_at(view, 0.3) == pytest.approx(view.cardinal.basis(0.3))


@pytest.mark.parametrize("changes", [{}, EXPLICIT, CORNERS, FIRST], ids=["plain", "set", "corners", "first"])
@pytest.mark.parametrize("closed", [False, True])
@pytest.mark.parametrize("rule", BENT)
def test_a_small_move_changes_the_curve_by_its_function_where_a_rule_is_not_linear(
    rule, closed, changes, rng
):
    """The mean of what moves of x do to x, and of y to y: by differences of really moved points."""
    assert {*BENT} == {VelocityRule.MONOTONE, VelocityRule.AKIMA}
    for family in (HERMITE, QUINTIC_HERMITE):
        curve = seven(family=family, closed=closed, velocity_rule=rule)
        # Not the points of the lesson: the rules have kinks where neighbouring slopes are equal.
        places = rng.uniform(0.0, 5.0, (7, 2)).tolist()
        curve = with_points(curve, **{f"p{i}": {"x": x, "y": y} for i, (x, y) in enumerate(places)})
        curve = with_points(frozen(curve), **changes)
        view = view_of(curve)
        assert view.linearised == "of small moves, averaged over x and y"
        t = np.linspace(*view.curve.domain, 101)
        moves = np.repeat(rng.uniform(-1.0, 1.0, (7, 1)), 2, axis=1)
        ahead, back = (moved(curve, step * moves).curve.evaluate(t) for step in (1e-6, -1e-6))
        change = ((ahead - back) / 2e-6).mean(axis=1)
        assert view.cardinal.basis(t) @ moves[:, 0] == pytest.approx(change, abs=1e-7)
        assert view.cardinal.basis(t).sum(axis=1) == pytest.approx(1.0, abs=1e-12)
        assert weights_at(view, 0.3) == pytest.approx(view.cardinal.basis(0.3))
        target = view.curve.evaluate(0.3) + np.array([0.1, 0.4])
        bent = Bend(view, 0.3, BendWith.POINTS).bent(tuple(target.tolist()), 1e-9)
        assert view_of(bent).curve.evaluate(0.3) == pytest.approx(target, abs=1e-8)


def bent(points, t, rule, family=HERMITE):
    """A curve of the points at these parameters, closed where there is one more of these."""
    closed = len(t) > len(points)
    interval = Parametrization(MANUAL, start=float(t[0]), end=float(t[-1]))
    points = tuple(Point(float(x), float(y), t=float(at)) for (x, y), at in zip(points, t, strict=False))
    return Curve("Bent", family, interval, points, closed=closed, velocity_rule=rule)


WORSE = [(1, 6), (0, 0), (3, 0), (1, 3), (2, 6), (4, 6), (2, 6)]
"""Points through which Akima's curve makes errors of y 9.16 times as large; 1.69 was said."""


@pytest.mark.parametrize("rule", BENT)
@pytest.mark.parametrize("closed", [False, True])
def test_the_growth_by_a_rule_that_is_not_linear_is_that_of_exact_arithmetic(rule, closed, rng):
    """The largest of both coordinates and all signs of errors, at kinks, too; of the means it was less."""
    angles = (np.arange(72) + 0.5) * np.pi / 72
    samples = (1.0 + np.cos(angles)) / 2.0  # of a cubic: at most 1 / cos(π / 48) of it is missed
    rows = [
        ([(0, 0), (1, 1), (2, 2), (4, 1), (5, 3)], [0, 1, 2, 3, 4, 5]),  # three on a line
        ([(0, 0), (1, 0), (2, 3), (2, 3), (4, 1)], [0, 1, 3, 4, 6, 7]),  # steps
        ([(0, 0), (1, 1), (4, 4), (9, 9)], [0, 1, 2, 3, 5]),  # both ends without a velocity
        ([(0, 5), (1, 5), (2, 5), (3, 5), (4, 5)], [0, 1, 2, 3, 4, 8]),  # all on a line
        (rng.integers(0, 9, (6, 2)).tolist(), [0, 2, 3, 5, 6, 8, 9]),
    ]
    for points, t in rows:
        curve = bent(points, t[: len(points) + closed], rule)
        view = view_of(curve)
        exact = max(
            exact_rules.growth(
                getattr(exact_rules, rule.value), list(each), list(t[: len(points) + closed]), closed, samples
            )
            for each in zip(*points, strict=True)
        )
        if exact > 1e30:
            assert view.growth == np.inf
        else:
            assert exact * (1 - 1e-12) <= view.growth <= exact / np.cos(np.pi / 48)
        assert (
            growth_of_points(view) == view.growth == facts_of(Document((curve,)))[0].lebesgue_constant.points
        )
        assert view.growth_holds == "at these points"


def test_the_growth_by_akimas_rule_holds_at_the_present_points_only():
    points = tuple(Point(float(x), float(y)) for x, y in WORSE)
    curve = Curve("Worse", HERMITE, Parametrization(CHORD), points, velocity_rule=VelocityRule.AKIMA)
    view = view_of(curve)
    t = view.parameters
    samples = (1.0 + np.cos((np.arange(72) + 0.5) * np.pi / 72)) / 2.0
    exact = exact_rules.growth(exact_rules.akima, [y for _, y in WORSE], t.tolist(), False, samples)
    assert view.growth == pytest.approx(exact, rel=2e-3)
    assert view.growth == pytest.approx(9.162, abs=1e-3)
    assert np.abs(view.cardinal.basis(np.linspace(0, 1, 201))).sum(axis=1).max() < 1.69
    assert facts_of(Document((curve,)))[0].lebesgue_constant == (1.0, view.growth, "at these points")
    explanation = explain(view, 0.745)
    assert not explanation.adds_up
    assert explanation.lebesgue == pytest.approx(view.growth, rel=1e-3)
    assert "at these points" in explanation.sentences[-2]
    # A linear rule holds wherever the points are.
    assert (
        view_of(seven()).growth_holds
        == view_of(seven(velocity_rule=VelocityRule.CATMULL_ROM)).growth_holds
        == ""
    )


@pytest.mark.parametrize("family", [HERMITE, QUINTIC_HERMITE])
@pytest.mark.parametrize("closed", [False, True])
@pytest.mark.parametrize("changes", [{}, EXPLICIT, CORNERS], ids=["plain", "set", "corners"])
def test_small_errors_displace_a_curve_by_their_growth_at_most(family, closed, changes, rng):
    """Also through accelerations, which follow all points, and where errors have sizes of their own."""
    places = rng.uniform(0.0, 5.0, (7, 2)).tolist()
    curve = seven(family=family, closed=closed, velocity_rule=VelocityRule.AKIMA)
    curve = with_points(curve, **{f"p{i}": {"x": x, "y": y} for i, (x, y) in enumerate(places)})
    curve = with_points(frozen(curve), **changes)
    view, t = view_of(curve), np.linspace(0.0, 1.0, 60)
    sizes = np.array([1.0, 0.5, 2.0, 1.0, 0.0, 1.0, 1.0])
    largest = np.zeros(len(t))
    for signs in product((-1.0, 1.0), repeat=7):
        moves = 1e-7 * np.repeat((signs * sizes)[:, None], 2, axis=1)
        away = moved(curve, moves).curve.evaluate(t) - view.curve.evaluate(t)
        largest = np.maximum(largest, np.abs(away).max(axis=1) / 1e-7)
    # Differences leave 1e-7 times the second derivative.
    assert view.cardinal.sums(t, sizes) == pytest.approx(largest, rel=1e-4)


@pytest.mark.parametrize("family", FAMILIES)
@pytest.mark.parametrize("closed", [False, True])
@pytest.mark.parametrize("changes", [EXPLICIT, CORNERS], ids=["set", "corners"])
def test_a_moved_parameter_changes_the_estimates(family, closed, changes):
    """They were held: differences of the curve estimated anew were off by up to half."""
    if family is LAGRANGE:
        closed, changes = False, {}
    curve = with_points(frozen(seven(family=family, closed=closed)), **changes)
    view = view_of(curve)
    for index, piece in enumerate(view.pieces):
        t = np.linspace(*piece.domain, 23)[1:-1]
        moves = parameter_moves(view, index, t)
        for knot, at in enumerate(view.parameters[: len(curve.points)].tolist()):
            if closed and knot == 0:
                continue  # the interval would be another one
            sides = [with_points(curve, **{f"p{knot}": {"t": at + by}}) for by in (1e-6, -1e-6)]
            far, near = (view_of(each).pieces[index].evaluate(t) for each in sides)
            # Differences leave 1e-12 times the third derivative, 1e5 or so here.
            assert moves[:, knot] == pytest.approx((far - near) / 2e-6, abs=2e-5 * np.abs(moves).max())


def test_random_errors_stay_in_the_band_and_nearly_fill_the_band():
    """Velocities were as they are without errors, in the band and in the random curves."""
    view = view_of(seven())
    epsilon, delta = 1e-3, 1e-4
    t = np.linspace(0.2, 0.75, 12)
    random = ensemble(view.curve, epsilon, delta, 4000, 3, remake=partial(curve_through, view))
    away = random.evaluate(t) - view.curve.evaluate(t)
    velocity = view.curve.evaluate(t, 1)
    normal = np.column_stack([-velocity[:, 1], velocity[:, 0]]) / np.hypot(*velocity.T)[:, None]
    across = np.abs(np.einsum("cmd,md->cm", away, normal))
    moves = parameter_moves(view, 0, t)
    band = worst_case_band(view.curve, t, epsilon, delta, cardinal=view.cardinal, sensitivity=moves)
    assert (across <= band.across * 1.01).all()
    assert (across.max(axis=0) > 0.5 * band.across).all()
    held = worst_case_band(view.curve, t, epsilon, delta)
    assert (across.max(axis=0) > held.across).any()


def test_points_that_bend_a_curve_share_the_pull_by_their_real_effects():
    """They shared it by B, 0.87 and 0.13, but with their estimates they do 2.22 and 0.77."""
    curve = frozen(seven())
    view = view_of(curve)
    t = 0.3
    target = view.curve.evaluate(t) + np.array([0.1, 0.4])
    bent = Bend(view, t, BendWith.POINTS).bent(tuple(target.tolist()), 1e-9)
    assert view_of(bent).curve.evaluate(t) == pytest.approx(target, abs=1e-12)
    ways = view_of(bent).points - view.points
    weights = view.cardinal.basis(t)
    least = weights[[2, 3], None] * [0.1, 0.4] / (weights[[2, 3]] ** 2).sum()
    assert ways[[2, 3]] == pytest.approx(least, abs=1e-12)
    assert not ways[[0, 1, 4, 5, 6]].any()


def test_catmull_rom_with_uniform_knots(rng):
    curve = frozen(seven(velocity_rule=VelocityRule.CATMULL_ROM))
    curve = replace(curve, parametrization=replace(curve.parametrization, alpha=0.0))
    view, moves, t = view_of(curve), rng.uniform(-1, 1, (7, 2)), np.linspace(0, 1, 50)
    away = moved(curve, moves).curve.evaluate(t) - view.curve.evaluate(t)
    assert view.cardinal.basis(t) @ moves == pytest.approx(away, abs=1e-12)


def test_catmull_rom_with_the_knots_of_its_parameters_is_the_bessel_rule():
    """Both stay where they are: for power parameters of the same α they are the same."""
    rule = Parametrization(ParametrizationKind.POWER, 0.7)
    views = [
        view_of(replace(seven(velocity_rule=each), parametrization=rule))
        for each in (VelocityRule.CATMULL_ROM, VelocityRule.BESSEL)
    ]
    assert views[0].growth == pytest.approx(views[1].growth, rel=1e-9)


def test_cardinal_functions_are_computed_again_only_after_a_change():
    view = view_of(frozen(seven()))
    known = view.cardinal
    nudged = with_points(view.source, p3={"x": 4.0})
    assert view_of(nudged, view).cardinal is known
    for changes in ({"velocity": (1.0, 1.0)}, {"corner": True}, {"t": 0.5}):
        other = view_of(with_points(view.source, p3=changes), view)
        assert other.cardinal is not known
        fresh = view_of(other.source)
        assert (other.cardinal.basis(0.4) == fresh.cardinal.basis(0.4)).all()
    rule = view_of(replace(view.source, velocity_rule=VelocityRule.BESSEL), view)
    assert rule.growth == pytest.approx(5.66, abs=0.005)


def test_the_constant_of_the_points_and_of_the_data():
    """Λ = 1 was said of every one."""
    view = view_of(seven())
    assert growth_of_points(view) == pytest.approx(8.556, abs=1e-3)
    assert growth_of_data(view) == 1.0
    set_by_hand = with_points(seven(), **{f"p{i}": {"velocity": (1.0, 1.0)} for i in range(7)})
    assert growth_of_points(view_of(set_by_hand)) == 1.0
    lagrange = view_of(seven(family=LAGRANGE))
    assert growth_of_points(lagrange) == growth_of_data(lagrange) == lebesgue_constant(lagrange.curve)


@each_row("count", [3, 20, 60, 120])
@each_row("family", ["lagrange", "cubic_spline", "floater_hormann"])
def test_the_constant_during_a_drag_has_the_displayed_digits(family, count):
    """The largest of 400 samples was shown: 5.954 for 5.957, and 1.82 for 2.04 of a spline of 120 points."""
    x = np.linspace(0.0, 1.0, count) ** 1.1
    points = tuple(Point(a, np.sin(9.0 * a)) for a in x.tolist())
    view = view_of(Curve("Wave", FAMILIES.named(family), Parametrization(CHORD), points))
    exact = lebesgue_constant(view.curve)
    assert growth_of_points(view, basis_view(view)) == pytest.approx(exact, rel=1e-4)


def test_a_closed_spline_grows_errors_as_the_same_curve_of_the_hermite_family():
    """Its first point counted twice: 2.7346."""
    points = tuple(Point(x, y) for x, y in [(2.0, 1.0), (3.0, 1.0), (4.0, 0.0), (0.0, 4.0)])
    for family in (CUBIC_SPLINE, HERMITE):
        closed = view_of(Curve("Closed", family, Parametrization(CHORD), points, closed=True))
        assert growth_of_points(closed) == pytest.approx(2.59131779, abs=1e-8)
    assert growth_of_data(closed) == 1.0
    assert growth_of_data(view_of(replace(closed.source, family=CUBIC_SPLINE))) == pytest.approx(2.59131779)


def test_the_facts_have_both_constants():
    growth = facts_of(Document((seven(),)))[0].lebesgue_constant
    assert growth.data == 1.0
    assert growth.points == pytest.approx(8.56, abs=0.005)


def test_nearly_equal_parameters_give_an_infinite_growth_without_failure():
    """With equal points and t 1e-310 apart the velocities are 0, their derivatives by the points infinite."""
    points = (Point(0.0, 0.0, t=0.0), Point(0.0, 0.0, t=1e-310), Point(1.0, 1.0, t=1.0))
    view = view_of(Curve("Close", HERMITE, Parametrization(MANUAL), points))
    if view.is_current:
        assert growth_of_points(view) > 1e300


def test_the_wiggle_is_explained_by_points_far_away():
    """It said "Only points 2 and 3 and their derivatives count here"."""
    explanation = explain(view_of(seven()), 0.5)
    assert explanation.lebesgue == pytest.approx(8.55, abs=0.02)
    assert {pull.order for pull in explanation.pulls} == {0}
    assert "the estimates follow it" in explanation.sentences[1]
    assert "can grow by a factor of 8.6 here" in explanation.sentences[2]


def test_samples_of_the_panel():
    view = view_of(seven())
    shown = cardinal_view(view)
    assert (shown.kinds, shown.count, shown.point_count, shown.is_coarse) == (1, 7, 7, False)
    t, values = shown.function(2, 0)
    assert values == pytest.approx(view.cardinal.basis(t)[:, 2])
    assert shown.extent([])[1] > 2.5
    assert basis_view(view).extent([0]) == pytest.approx((0.0, 1.0))
    closed = cardinal_view(view_of(seven(closed=True)))
    assert closed.owners == (0, 1, 2, 3, 4, 5, 6, 0)
    assert (closed.function(0, 0)[1] == closed.function(7, 0)[1]).all()


def test_samples_of_many_points():
    s = np.linspace(0, 1, 300)
    points = np.column_stack([4 * s, np.sin(40 * s)])
    points = tuple(Point(float(x), float(y)) for x, y in points)
    view = view_of(Curve("Many", HERMITE, Parametrization(CHORD), points))
    shown = cardinal_view(view)
    t, low, high = shown.envelope(0)
    exact = view.cardinal.basis(t)
    assert low == pytest.approx(exact.min(axis=1), abs=1e-15)
    assert high == pytest.approx(exact.max(axis=1), abs=1e-15)
    t, values = shown.function(150, 0)
    assert values == pytest.approx(view.cardinal.basis(t)[:, 150], abs=1e-15)
    assert np.abs(view.cardinal.basis(np.array([t[0], t[-1]]))[:, 150]).max() < 1e-6


def test_a_function_negative_on_a_short_interval_counts():
    """It was 1.00225: the function of the first point is below 0 for 4 % of the second segment alone."""
    points = (Point(0.0, 0.0, t=0.0, velocity=(1.0, 0.0)), Point(1.0, 2.0, t=0.8))
    times, rule = Parametrization(MANUAL, end=1.8), VelocityRule.FINITE_DIFFERENCE
    view = view_of(Curve("Lens", HERMITE, times, points, velocity_rule=rule, closed=True))
    # The velocity at t = 0.8 is (1 / 0.8 - 1) / 2 of the step: C = 3 u² - 2 u³ - u (1 - u)² / 8.
    u = (3.25 - np.sqrt(3.25**2 - 3 * 0.125 * 2.125)) / (3 * 2.125)
    least = 3 * u**2 - 2 * u**3 - u * (1 - u) ** 2 / 8
    assert growth_of_points(view) == pytest.approx(1 - 2 * least, rel=1e-12)


def test_a_warning_of_a_hermite_curve_gives_advice_for_hermite_curves():
    """Nothing was said of it, Λ being 1."""
    curve = with_points(frozen(seven()), p4={"t": view_of(seven()).parameters[3] + 1e-3})
    view = view_of(curve)
    (found,) = [each for each in warnings_of(view, growth_of_points(view)) if each.topic is Topic.LEBESGUE]
    assert view.growth > 100
    assert "estimated velocities follow the error" in found.sentence
    assert "use a Hermite curve" not in found.sentence


def test_functions_of_another_curve_are_not_used():
    lagrange, hermite = (view_of(seven(family=family)) for family in (LAGRANGE, HERMITE))
    spread = view_of(seven(ParametrizationKind.UNIFORM, LAGRANGE))
    for other in (hermite, spread):
        assert growth_of_points(lagrange, basis_view(other)) == growth_of_points(lagrange)
        assert growth_of_data(lagrange, basis_view(other)) == growth_of_data(lagrange)
