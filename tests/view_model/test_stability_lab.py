"""The laboratory, the explanation of wiggles and warnings, without a window."""

from __future__ import annotations

from decimal import Decimal
from math import comb, perm

import numpy as np
import pytest
from flint import fmpq
from msgspec.structs import replace

from app.document.model import Document, Parametrization, ParametrizationKind, make_curve
from app.document.words import short
from app.families import FAMILIES, HERMITE, LAGRANGE, QUINTIC_HERMITE
from app.features.lessons.lesson import load_lesson
from app.storage.files import load
from app.tasks.progress import Cancelled
from app.view_model.analysis.laboratory import (
    calculations,
    cost_chart,
    cost_of,
    digits_at,
    trial_words,
    try_methods,
)
from app.view_model.analysis.settings import Calculation, LaboratorySettings
from app.view_model.analysis.warnings import Topic, warnings_of
from app.view_model.analysis.wiggle import CURES, cures_of, explain, overshoot, widest
from app.view_model.curve.curve_view import view_of
from curvecore import monomial_condition
from tests.rows import each_row

ALL = LaboratorySettings(on=True, methods=frozenset(Calculation))
POINTS = [(0.0, 0.0), (1.0, 2.0), (2.5, 1.0), (4.0, 3.0), (5.0, 0.5), (6.0, 2.0)]


def ring(family):
    """A closed curve with a corner."""
    closed = replace(make_curve(POINTS, family=family), closed=True)
    points = [replace(point, corner=index == 2) for index, point in enumerate(closed.points)]
    return view_of(replace(closed, points=tuple(points)))


WITH_METHODS = [family for family in FAMILIES if calculations(view_of(make_curve(POINTS, family=family)))]


@each_row("family", FAMILIES)
def test_a_family_without_methods_is_refused_with_a_sentence(family):
    assert {LAGRANGE, HERMITE, QUINTIC_HERMITE} <= set(WITH_METHODS)
    trial = try_methods(ring(family), ALL)
    assert isinstance(trial, str) is (family not in WITH_METHODS)
    assert family in WITH_METHODS or trial.endswith(f"{family.a_curve} is made of other functions.")


@pytest.mark.parametrize("family", WITH_METHODS)
def test_sixteen_digits_are_as_good_as_the_curve(family):
    view = ring(family)
    trial = try_methods(view, replace(ALL, digits=16))
    truth = view.curve.evaluate(trial.t)
    for outcome in trial.outcomes:
        drawn = np.vstack(outcome.pieces)
        # Condition numbers here are below 4e7: ten digits are left to everybody. The 1.6e11 of septic
        # segments costs one digit more.
        assert np.abs(drawn - truth).max() < 1e-8
        assert outcome.worst[0] == outcome.errors.max()
        assert outcome.lost < (6 if monomial_condition(view.curve) < 4e7 else 7)


@pytest.mark.parametrize("family", WITH_METHODS)
@pytest.mark.parametrize("shift", [100.0, -3.25])
def test_a_shift_changes_nothing_but_the_powers_of_t(family, shift):
    view = ring(family)
    before = try_methods(view, ALL)
    after = try_methods(view, replace(ALL, shift=shift))
    for outcome in after.outcomes:
        if outcome.calculation is not Calculation.MONOMIAL:
            # Differences of shifted parameters are off by at most 1e-14, far below the fourth digit.
            assert outcome.lost == pytest.approx(before.outcome(outcome.calculation).lost, abs=0.3)
    assert after.condition > 10 * before.condition


def test_a_method_without_a_number_draws_nothing():
    # To 2 digits all squares of t are 1e6: the rows of the system are equal, and a pivot vanishes.
    trial = try_methods(view_of(make_curve(POINTS)), replace(ALL, digits=2, shift=1000.0))
    monomial, lagrange = trial.outcome(Calculation.MONOMIAL), trial.outcome(Calculation.LAGRANGE)
    assert monomial.pieces == ()
    assert np.isinf(monomial.errors).all()
    assert monomial.lost == 2
    assert len(lagrange.pieces) == 1
    assert len(lagrange.pieces[0]) == len(trial.t)


@pytest.mark.parametrize(("digits", "shift"), [(5, 0.0), (8, 0.0), (12, 0.0), (4, 0.0), (8, 100.0)])
def test_the_condition_number_appears_once_as_a_bound_beside_the_lost_digits(digits, shift):
    """It said "κ ≈ 10⁸: all 8 digits may go" beside 2.5 digits lost and "κ 5.3·10⁷" in the table."""
    view = view_of(load(load_lesson("04_decimal_accuracy").document).curves[0])
    trial = try_methods(view, replace(ALL, digits=digits, shift=shift))
    words, lost = trial_words(trial), trial.outcome(Calculation.MONOMIAL).lost
    kappa = float(np.linalg.cond(np.vander(np.arange(8.0)))) if not shift else trial.condition
    may_go = float(np.log10(kappa))
    assert f"κ = {short(kappa)} bounds" in words
    assert "coefficients" in words
    assert "≈" not in words
    assert (f"all {digits} digits" if may_go >= digits else f"{may_go:.1f} of {digits} digits") in words
    assert lost < may_go
    assert (f"The curve lost {lost:.1f}" in words) is (lost < min(may_go, digits) - 0.5)
    assert ("not enough" in words) is (lost > digits - 0.7)


def exact_point(core, t):
    """The curve at one t, in fractions: by Neville's scheme, or by Bézier control points of a segment."""
    nodes, width = [rational(x) for x in core.parameters], core.jets.shape[1]
    if width == 1:
        levels = [[rational(x) for x in point] for point in core.points]
        for step in range(1, len(nodes)):
            levels = [
                [
                    ((t - a) * after - (t - b) * before) / (b - a)
                    for before, after in zip(*levels[i : i + 2], strict=True)
                ]
                for i, (a, b) in enumerate(zip(nodes, nodes[step:], strict=False))
            ]
        return levels[0]
    i = max(i for i in range(len(nodes) - 1) if nodes[i] <= t)
    h, degree = nodes[i + 1] - nodes[i], 2 * width - 1
    s, result = (t - nodes[i]) / h, []
    for axis in (0, 1):
        ends = [
            [
                sum(
                    comb(k, j) * fmpq(1, perm(degree, j)) * (sign * h) ** j * rational(jet[j, axis])
                    for j in range(k + 1)
                )
                for k in range(width)
            ]
            for sign, jet in ((1, core.jets[i]), (-1, core.jets[i + 1]))
        ]
        controls = [*ends[0], *reversed(ends[1])]
        terms = [comb(degree, k) * s**k * (1 - s) ** (degree - k) * b for k, b in enumerate(controls)]
        result.append(sum(terms))
    return result


def rational(x):
    return fmpq(*float(x).as_integer_ratio())


def is_rounded(text, exact, digits):
    """Whether a decimal number of so many digits at most is the one next to an exact one."""
    sign, shown, exponent = Decimal(text).as_tuple()
    top, bottom = int(abs(exact.p)), int(exact.q)
    size = len(str(top)) - len(str(bottom))
    size -= top * 10 ** max(-size, 0) < bottom * 10 ** max(size, 0)
    value = (-1) ** sign * fmpq(int("".join(map(str, shown)))) * fmpq(10) ** exponent
    return len(shown) <= digits and abs(value - exact) * 2 <= fmpq(10) ** (size - digits + 1)


@each_row("digits", [2, 5, 9, 15, 16])
@each_row("family", WITH_METHODS)
def test_every_digit_of_the_truth_is_correct(family, digits):
    """Of 16 digits the last two were those of a double: 10 of 13 such rows ended wrongly."""
    random = np.random.default_rng(digits)
    for n, shift in ((2, 0.0), (3, 1e6), (5, -1.7), (9, 0.0)):
        points = (random.standard_normal((n, 2)) * 10.0 ** random.integers(-6, 7)).tolist()
        # The t of chord lengths are irrational; as they are stored, they are the data.
        chords = Parametrization(kind=ParametrizationKind.CHORD_LENGTH)
        view = view_of(replace(make_curve(points, family=family), parametrization=chords))
        settings = replace(ALL, digits=digits, shift=shift)
        for t in random.uniform(*view.curve.domain, 3).tolist():
            core = view.curve.with_data(view.curve.jets, view.curve.parameters + shift)
            exact = exact_point(core, rational(t + shift))
            told = digits_at(view, settings, t).truth
            shown = [is_rounded(text, value, digits + 2) for text, value in zip(told, exact, strict=True)]
            assert shown == [True, True], (told, n, t)


def test_cancelled_work_ends():
    def stopped(_share, _word):
        raise Cancelled

    view = view_of(make_curve(POINTS))
    with pytest.raises(Cancelled):
        try_methods(view, ALL, stopped)
    with pytest.raises(Cancelled):
        cost_of(view, stopped)


def test_without_a_curve_the_reason_is_given():
    assert try_methods(view_of(make_curve(POINTS[:1])), ALL) == "A curve needs at least two points."
    assert digits_at(view_of(make_curve(POINTS[:1])), ALL, 0.5) is None
    assert explain(view_of(make_curve(POINTS[:1])), 0.5) is None


def test_the_cost_is_that_of_cubic_and_quadratic_work():
    cost = cost_of(view_of(make_curve(POINTS)))
    assert cost.ratio == cost.solving / cost.basis
    assert min(cost.seconds) > 0
    chart = cost_chart()
    # Where n is large, twice the points cost 8 and 4 times as much.
    ends = np.log(chart.n[-1] / chart.n[-5])
    assert np.log(chart.solving[-1] / chart.solving[-5]) / ends == pytest.approx(3, abs=0.02)
    assert np.log(chart.basis[-1] / chart.basis[-5]) / ends == pytest.approx(2, abs=0.02)


@each_row("family", FAMILIES)
def test_the_pulls_add_up_to_the_point(family):
    view = view_of(make_curve(POINTS, family=family))
    found = explain(view, 0.37)
    weights = np.zeros(len(POINTS))
    for pull in found.pulls:
        if pull.order == 0:
            weights[pull.point] = pull.weight
    assert weights.sum() == pytest.approx(1)
    assert np.abs(weights).sum() == pytest.approx(found.lebesgue)
    sizes = [abs(pull.weight) for pull in found.pulls]
    assert sizes == sorted(sizes, reverse=True)


def test_the_widest_swing_of_runges_function_is_at_its_ends():
    x = np.linspace(-1, 1, 11)
    uniform = Parametrization(ParametrizationKind.UNIFORM)
    view = view_of(
        replace(make_curve(np.column_stack([x, 1 / (1 + 25 * x**2)]).tolist()), parametrization=uniform)
    )
    assert explain(view, widest(view)).segment[0] in (0, 9)
    # The polynomial reaches 1.95 near x = 0.94; the chord lies at 0.05.
    assert overshoot(view, 0)[0] == pytest.approx(1.9, abs=0.05)


def test_cures_have_the_promised_effect():
    document = Document((make_curve(POINTS),))
    view = view_of(document.curves[0])
    found = cures_of(document, 0, view, 2)
    assert [cure.remedy for cure in found.cures] == list(CURES)
    for cure in found.cures:
        if cure.document is None:
            assert cure.is_in_use
            assert cure.remedy.name == "chordLength"
            continue
        cured = view_of(cure.document.curves[0])
        assert cure.overshoot == overshoot(cured, 2)[0]
        assert np.array_equal(cure.points, cured.polyline)


def test_close_parameters_are_warned_about_but_not_chebyshevs():
    def topics(kind, points):
        view = view_of(replace(make_curve(points), parametrization=Parametrization(kind)))
        return [each.topic for each in warnings_of(view, 1.0)]

    many = [(float(i), float(i % 2)) for i in range(500)]
    assert topics(ParametrizationKind.CHEBYSHEV, many) == []
    assert topics(ParametrizationKind.CHORD_LENGTH, [(0, 0), (1, 0), (1.001, 0), (2, 0)]) == [Topic.GAP]
    assert topics(ParametrizationKind.CHORD_LENGTH, [(0, 0), (1, 0), (1.1, 0), (2, 0)]) == []


def test_numbers_are_short():
    thin = "\N{NARROW NO-BREAK SPACE}"
    assert [short(x) for x in (0, -3.14, 0.034, 99.4, 5890, 10987, 1.2e9, 1e-5, np.inf)] == [
        "0", "−3.1", "0.034", "99", "5890", f"10{thin}987", "1.2·10⁹", "1·10⁻⁵", "∞",
    ]  # fmt: skip
