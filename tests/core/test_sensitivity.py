"""Sensitivities against exact differences, bands against what errors really do."""

import numpy as np
import pytest

from curvecore import (
    Chain,
    CurveError,
    FloaterHormannCurve,
    HermiteCurve,
    LagrangeCurve,
    QuinticHermiteCurve,
    SepticHermiteCurve,
    acceleration_sensitivity,
    chebyshev,
    chord_length,
    ensemble,
    parameter_sensitivity,
    point_sensitivity,
    uniform,
    velocity_sensitivity,
    worst_case_band,
)

FAMILIES = {
    "lagrange": (LagrangeCurve, 1),
    "hermite": (HermiteCurve, 2),
    "quintic_hermite": (QuinticHermiteCurve, 3),
    "septic_hermite": (SepticHermiteCurve, 4),
}
every_family = pytest.mark.parametrize("name", list(FAMILIES))


def build(name, jets, parameters):
    return FAMILIES[name][0](*np.moveaxis(jets, 1, 0), parameters)


def data(name, rng, n, dim=2):
    return rng.standard_normal((n, FAMILIES[name][1], dim))


def exact_curve(exact, jets, nodes, t):
    """c(t) for rational data, shape (dim,), as fractions."""
    if jets.shape[1] == 1:
        weights = exact.lagrange_weights(nodes)
        terms = exact.lagrange_terms(t, nodes, 0)
        pairs = [(w * v, row[0]) for w, v, row in zip(weights, terms, jets, strict=True)]
    else:
        segment, values = exact.hermite_terms(t, nodes, jets.shape[1], 0)
        pairs = [(v, d) for end in (0, 1) for v, d in zip(values[end], jets[segment + end], strict=True)]
    return [sum(b * exact.rational(d[axis]) for b, d in pairs) for axis in range(jets.shape[2])]


@every_family
def test_moving_a_parameter_against_exact_differences(rng, exact, name):
    """In fractions: a step of 2**-60 leaves 2**-120 times the third derivative."""
    n = 5
    t = np.array([0.0, 0.25, 0.375, 0.75, 1.0])
    jets = data(name, rng, n)
    where = np.array([0.01, 0.1, 0.3, 0.5, 0.7, 0.9])
    found = parameter_sensitivity(build(name, jets, t), where)
    assert found.shape == (6, n, 2)
    step = exact.rational(2.0**-60)
    for i in range(n):
        up, down = ([exact.rational(x) for x in t] for _ in range(2))
        up[i] += step
        down[i] -= step
        for k, x in enumerate(where):
            ends = [exact_curve(exact, jets, nodes, exact.rational(x)) for nodes in (up, down)]
            quotient = [(a - b) / (2 * step) for a, b in zip(*ends, strict=True)]
            expected = [int(q.p) / int(q.q) for q in quotient]
            assert found[k, i] == pytest.approx(expected, rel=1e-12, abs=1e-12 * np.abs(found).max())


def test_lagrange_in_closed_form(rng):
    curve = LagrangeCurve(rng.standard_normal((9, 2)), chebyshev(9))
    t = np.linspace(0.0, 1.0, 50)
    expected = -curve.basis(t)[:, :, 0, None] * curve.evaluate(curve.parameters, 1)
    assert parameter_sensitivity(curve, t) == pytest.approx(expected, rel=1e-12)


@every_family
def test_moving_all_parameters_alike_moves_along_the_curve(rng, name):
    """c(t; t_i + d) = c(t - d): the sensitivities add up to -c'."""
    curve = build(name, data(name, rng, 6), uniform(6))
    t = np.linspace(0.01, 0.99, 57)
    total = parameter_sensitivity(curve, t).sum(axis=1)
    assert total == pytest.approx(-curve.evaluate(t, 1), rel=1e-10, abs=1e-11)


@every_family
def test_data_enter_linearly(rng, name):
    jets = data(name, rng, 6)
    curve = build(name, jets, uniform(6))
    t = np.linspace(0.0, 1.0, 23)
    rules = [point_sensitivity, velocity_sensitivity, acceleration_sensitivity][: jets.shape[1]]
    for r, rule in enumerate(rules):
        moved = jets.copy()
        moved[2, r] += [0.5, -0.25]
        change = build(name, moved, uniform(6)).evaluate(t) - curve.evaluate(t)
        assert rule(curve, t)[:, 2, None] * [0.5, -0.25] == pytest.approx(change, abs=1e-13)


def test_a_chain_moves_both_pieces_at_a_joint(rng):
    t = np.array([0.0, 0.4, 1.0])
    whole = HermiteCurve(*rng.standard_normal((2, 3, 2)), t)
    parts = [HermiteCurve(*np.moveaxis(whole.jets[i : i + 2], 1, 0), t[i : i + 2]) for i in (0, 1)]
    where = np.linspace(0.0, 1.0, 31)
    assert parameter_sensitivity(Chain(parts), where) == pytest.approx(parameter_sensitivity(whole, where))
    for error in ((0.1, 0.0), (0.0, 0.01), (0.1, 0.01)):
        bands = [worst_case_band(curve, where, *error) for curve in (whole, Chain(parts))]
        assert bands[0].distance == pytest.approx(bands[1].distance)
        assert bands[0].across == pytest.approx(bands[1].across)
    random = ensemble(Chain(parts), 0.1, 0.01, count=5, seed=3).evaluate(where)
    assert random == pytest.approx(ensemble(whole, 0.1, 0.01, count=5, seed=3).evaluate(where))


@every_family
def test_ten_thousand_curves_stay_in_the_band_of_the_points(rng, name):
    curve = build(name, data(name, rng, 8), uniform(8))
    t = np.linspace(0.0, 1.0, 101)
    band = worst_case_band(curve, t, point_error=0.02)
    random = ensemble(curve, 0.02, count=10_000, seed=7)
    away = np.linalg.norm(random.evaluate(t) - curve.evaluate(t), axis=2)
    assert (away <= band.distance * (1.0 + 1e-12)).all()
    # The worst case: every point moved one way, with the sign of its basis function.
    for k in (3, 50, 97):
        jets = curve.jets.copy()
        jets[:, 0] += 0.02 * np.sign(curve.basis(t[k])[:, 0])[:, None] * [0.6, 0.8]
        reached = np.linalg.norm(curve.with_jets(jets).evaluate(t[k]) - curve.evaluate(t[k]))
        assert reached == pytest.approx(band.distance[k], rel=1e-12)


def test_a_rational_curve_that_is_moved_depends_on_its_parameters_as_before():
    """At 2**40 the differences were off by five times the largest one."""
    points = np.array([[0, 0], [1, 2], [3, 2], [4, 0], [6, 1], [7, 3]], float)
    t, where = chord_length(points), np.linspace(0.05, 0.93, 7)
    here, there = (parameter_sensitivity(FloaterHormannCurve(points + d, t), where) for d in (0.0, 2.0**40))
    assert there == pytest.approx(here, abs=1e-9 * np.abs(here).max())


@every_family
def test_two_thousand_curves_stay_in_the_band_of_points_and_parameters(rng, name):
    """To first order in the parameters' errors: 1e-5 of the spacing leaves 1e-4 of the band, or so."""
    n, delta = 6, 2e-6
    curve = build(name, data(name, rng, n), uniform(n))
    t = np.linspace(0.0, 1.0, 41)[1:-1]
    t = t[np.abs(t[:, None] - uniform(n)).min(axis=1) > 1e-3]
    count = 2_000
    for epsilon in (0.0, 1e-6):
        band = worst_case_band(curve, t, epsilon, delta)
        random = ensemble(curve, epsilon, delta, count=count if epsilon else 500, seed=7)
        gap = random.evaluate(t) - curve.evaluate(t)
        velocity = curve.evaluate(t, 1)
        normal = (
            np.stack((-velocity[:, 1], velocity[:, 0]), axis=1) / np.linalg.norm(velocity, axis=1)[:, None]
        )
        across = np.abs(np.einsum("cmd,md->cm", gap, normal))
        assert (np.linalg.norm(gap, axis=2) <= band.distance * (1.0 + 1e-3)).all()
        assert (across <= band.across * (1.0 + 1e-3)).all()
        assert (band.across <= band.distance * (1.0 + 1e-12)).all()
        moves = parameter_sensitivity(curve, t)
        for k in (0, len(t) // 2, len(t) - 1):
            signs = np.sign(moves[k] @ normal[k])
            jets = curve.jets.copy()
            jets[:, 0] += epsilon * np.sign(curve.basis(t[k])[:, 0])[:, None] * normal[k]
            worst = build(name, jets, uniform(n) + delta * signs)
            reached = (worst.evaluate(t[k]) - curve.evaluate(t[k])) @ normal[k]
            assert reached == pytest.approx(band.across[k], rel=1e-2)


def test_the_farthest_sum_of_signed_moves(rng):
    """Against all 2**n choices of signs."""
    curve = LagrangeCurve(rng.standard_normal((7, 2)), uniform(7))
    t = np.linspace(0.0, 1.0, 20)
    band = worst_case_band(curve, t, parameter_error=0.01)
    signs = np.array(np.meshgrid(*[[-1.0, 1.0]] * 7)).reshape(7, -1)
    sums = np.einsum("is,mid->msd", signs, 0.01 * parameter_sensitivity(curve, t))
    assert band.distance == pytest.approx(np.linalg.norm(sums, axis=2).max(axis=1), rel=1e-12, abs=1e-16)


def test_points_and_derivatives_may_have_different_errors(rng):
    jets = rng.standard_normal((4, 3, 3))
    curve = build("quintic_hermite", jets, uniform(4))
    t = np.linspace(0.0, 1.0, 9)
    basis = np.abs(curve.basis(t))
    sizes = np.array([0.1, 0.0, 0.2, 0.05])
    band = worst_case_band(curve, t, sizes, 0.0, 0.3, sizes)
    expected = basis[:, :, 0] @ sizes + 0.3 * basis[:, :, 1].sum(axis=1) + basis[:, :, 2] @ sizes
    assert band.distance == pytest.approx(expected)
    assert (band.across == band.distance).all()
    wider = worst_case_band(curve, t, sizes, 0.01)
    assert (wider.distance >= wider.across).all()


@every_family
def test_errors_of_data_of_every_order_are_reached(rng, name):
    """A septic curve with errors of parameters raised NumPy's broadcast error: jerks had no errors."""
    curve = build(name, data(name, rng, 5), uniform(5))
    t = np.linspace(0.03, 0.97, 33)
    sizes = np.array([0.01, 0.02, 0.03, 0.04])
    with_t = worst_case_band(curve, t, *sizes[:1], 1e-3, *sizes[1:])
    alone = worst_case_band(curve, t, *sizes[:1], 0.0, *sizes[1:])
    for k in range(len(t)):
        signs = np.sign(curve.basis(t[k]))
        jets = curve.jets + (signs * sizes[: curve.jets.shape[1]])[:, :, None] * [0.6, 0.8]
        reached = np.linalg.norm(curve.with_jets(jets).evaluate(t[k]) - curve.evaluate(t[k]))
        assert reached == pytest.approx(alone.distance[k], rel=1e-11)
    of_t = worst_case_band(curve, t, parameter_error=1e-3)
    assert with_t.distance == pytest.approx(alone.distance + of_t.distance, rel=1e-12)
    assert with_t.across == pytest.approx(alone.distance + of_t.across, rel=1e-12)


@every_family
def test_an_ensemble_is_repeatable_and_within_its_errors(rng, name):
    curve = build(name, data(name, rng, 5), uniform(5))
    one, two = (ensemble(curve, 0.1, 0.02, count=40, seed=5) for _ in range(2))
    assert (one.jets == two.jets).all()
    assert (one.parameters == two.parameters).all()
    assert (ensemble(curve, 0.1, 0.02, count=40, seed=6).jets != one.jets).any()
    moved = np.linalg.norm(one.jets[:, :, 0] - curve.points, axis=2)
    assert 0.09 < moved.max() <= 0.1
    assert 0.018 < np.abs(one.parameters - curve.parameters).max() <= 0.02
    assert (one.jets[:, :, 1:] == curve.jets[:, 1:]).all()
    assert len(one.curves) == 40
    t = np.linspace(0.0, 1.0, 7)
    assert one.evaluate(t) == pytest.approx(np.stack([each.evaluate(t) for each in one.curves]))
    same = ensemble(curve, 0.1, count=3)
    assert same.evaluate(t) == pytest.approx(np.stack([each.evaluate(t) for each in same.curves]))


def test_unusable_arguments(rng):
    curve = LagrangeCurve(rng.standard_normal((4, 2)), uniform(4))
    with pytest.raises(CurveError, match="family with velocities"):
        velocity_sensitivity(curve, 0.5)
    with pytest.raises(CurveError, match="family with accelerations"):
        acceleration_sensitivity(curve, 0.5)
    with pytest.raises(CurveError, match="point_error must be at least 0"):
        worst_case_band(curve, 0.5, -1.0)
    with pytest.raises(CurveError, match=r"point_error must be a number or have the shape \(4,\)"):
        worst_case_band(curve, 0.5, [1.0, 2.0])
    with pytest.raises(CurveError, match="less than half the smallest distance"):
        ensemble(curve, 0.1, 0.2)
    with pytest.raises(CurveError, match="count must be at least 1"):
        ensemble(curve, 0.1, count=0)
