"""Plots over t, compared with finite differences, closed forms and the core."""

from __future__ import annotations

import math

import numpy as np
import pytest
from msgspec.structs import replace

from app.document.derivatives import VelocityRule
from app.document.model import Curve, Parametrization, ParametrizationKind, Point, make_curve
from app.document.words import with_error
from app.families import FAMILIES, HERMITE, LAGRANGE, QUINTIC_HERMITE
from app.view_model.analysis.hodograph import derivative_at, hodograph_of
from app.view_model.analysis.plot import PLOTS, PlotLine, Scale, extent_of, plot_of
from app.view_model.analysis.plot_samples import is_slow, plots_of, samples_over, uncertain_values_at
from app.view_model.analysis.plots import curvature, lebesgue, lengths
from app.view_model.basis import basis_view, growth_of_points
from app.view_model.curve.curve_view import view_of
from tests.rows import each_row


def wave(count, family, kind=ParametrizationKind.CHORD_LENGTH, **fields):
    s = np.linspace(0, 1, count)
    points = tuple(Point(4 * float(a), 1 + 0.7 * math.sin(14 * a)) for a in s)
    return view_of(Curve("Wave", family, Parametrization(kind), points, **fields))


def plots(view, *kinds, t_range=None, columns=800):
    t_range = t_range or (float(view.parameters[0]), float(view.parameters[-1]))
    return plots_of(view, frozenset(kinds), t_range, columns, view.growth)


@pytest.mark.parametrize("family", FAMILIES)
def test_the_plotted_derivatives_are_those_of_the_curve(family):
    view = wave(9, family)
    for kind, order in ((lengths.SPEED, 1), (lengths.ACCELERATION, 2), (lengths.JERK, 3), (lengths.SNAP, 4)):
        (plot,) = plots(view, kind)
        (line,) = plot.lines
        known = ~np.isnan(line.values)
        exact = np.linalg.norm(view.curve.evaluate(line.t[known], order), axis=1)
        assert line.values[known] == pytest.approx(exact, rel=1e-9, abs=1e-9 * exact.max())
        assert plot.extent == (line.values[known].min(), line.values[known].max())


def test_the_curvature_matches_a_circle_and_its_sign_distinguishes_left_from_right():
    """Of a quintic through 12 points of a circle of radius 2; the error of the spline is far below 1 %."""
    angles = np.linspace(0, 1.5 * np.pi, 12)
    for sign in (1, -1):
        points = tuple(
            Point(
                2 * math.cos(a),
                2 * sign * math.sin(a),
                velocity=(-2 * math.sin(a), 2 * sign * math.cos(a)),
                acceleration=(-2 * math.cos(a), -2 * sign * math.sin(a)),
                t=float(a),
            )
            for a in angles
        )
        rule = Parametrization(ParametrizationKind.MANUAL, start=0.0, end=float(angles[-1]))
        view = view_of(Curve("Circle", QUINTIC_HERMITE, rule, points))
        (plot,) = plots(view, curvature.CURVATURE)
        values = plot.lines[0].values
        assert values[~np.isnan(values)] == pytest.approx(sign * 0.5, rel=1e-4)


def test_a_jump_has_no_line_across_and_a_smooth_joint_has_no_gap():
    view = wave(7, HERMITE, velocity_rule=VelocityRule.BESSEL)
    speed, acceleration = plots(view, lengths.SPEED, lengths.ACCELERATION)
    assert not np.isnan(speed.lines[0].values).any()
    line = acceleration.lines[0]
    gaps = np.flatnonzero(np.isnan(line.values))
    inner = view.parameters[1:-1]
    assert line.t[gaps] == pytest.approx(inner)
    for side, offset in ((-1, -1e-9), (1, 1e-9)):
        exact = np.linalg.norm(view.curve.evaluate(inner + offset, 2), axis=1)
        assert line.values[gaps + side] == pytest.approx(exact, rel=1e-5)


def test_a_corner_breaks_the_speed():
    view = wave(5, HERMITE)
    points = list(view.source.points)
    points[2] = Point(points[2].x, points[2].y, velocity=(1, 0), corner=True, velocity_after=(0, 5))
    view = view_of(Curve("Corner", HERMITE, Parametrization(), tuple(points)))
    line = plots(view, lengths.SPEED)[0].lines[0]
    (gap,) = np.flatnonzero(np.isnan(line.values))
    assert line.t[gap] == view.parameters[2]
    assert line.values[[gap - 1, gap + 1]] == pytest.approx([1, 5])


def test_the_lebesgue_function_is_one_at_the_parameters_and_reaches_its_constant():
    """n = 11 uniform: the constant 29.900 of Luttmann and Rivlin's table."""
    view = wave(11, LAGRANGE, ParametrizationKind.UNIFORM)
    (plot,) = plots(view, lebesgue.LEBESGUE)
    line = plot.lines[0]
    assert plot.scale is Scale.LOG
    assert line.values.max() == pytest.approx(29.900, rel=2e-3)
    assert plot.levels[0].value == pytest.approx(29.900, abs=5e-4)
    assert "29.9" in plot.levels[0].name
    at_parameters = line.values[np.searchsorted(line.t, view.parameters)]
    assert at_parameters == pytest.approx(np.ones(11), abs=1e-9)


def test_errors_of_points_do_not_grow_without_estimated_derivatives():
    """It was said of curves with estimated velocities, too."""
    view = wave(6, QUINTIC_HERMITE)
    (plot,) = plots(view, lebesgue.LEBESGUE)
    known = plot.lines[0]
    assert known.values == pytest.approx(np.maximum(view.cardinal.sums(known.t), 1.0))
    assert plot.levels[0].name == f"Lebesgue constant Λ = {view.growth:.3g}"
    assert view.growth > 1.2
    still = [replace(point, velocity=(1.0, 0.0), acceleration=(0.0, 0.0)) for point in view.source.points]
    (plot,) = plots(view_of(replace(view.source, points=tuple(still))), lebesgue.LEBESGUE)
    assert plot.lines[0].values == pytest.approx(1.0, abs=1e-12)
    assert "errors of points do not grow" in plot.levels[0].name


def test_only_the_visible_part_is_sampled_and_no_more_often_than_there_are_pixels():
    view = wave(9, QUINTIC_HERMITE)
    samples = samples_over(view, (0.4, 0.5), 400)
    assert samples.t[0] == 0.4
    assert samples.t[-1] <= 0.5
    assert len(samples.t) < 400
    assert not len(samples_over(view, (2.0, 3.0), 400).t)
    many = wave(1000, HERMITE)
    assert len(samples_over(many, (0.0, 1.0), 900).t) <= 3 * 999


def test_samples_ascend_even_where_parameters_are_far_from_zero():
    points = tuple(Point(float(i), i * i / 3, t=1e6 + i * 1e-3) for i in range(6))
    rule = Parametrization(ParametrizationKind.MANUAL, start=1e6, end=1e6 + 5e-3)
    for family in FAMILIES:
        t = samples_over(view_of(Curve("Far", family, rule, points)), (1e6, 1e6 + 1), 500).t
        assert (np.diff(t) >= 0).all()


def test_a_spike_of_the_curvature_does_not_flatten_the_rest():
    points = tuple(Point(x, y) for x, y in ((0, 0), (1, 1), (2, 0), (1.0001, 1), (0, 0.5)))
    view = view_of(Curve("Needle", HERMITE, Parametrization(), points))
    (plot,) = plots(view, curvature.CURVATURE)
    finite = plot.lines[0].values[np.isfinite(plot.lines[0].values)]
    assert np.abs(finite).max() > 2 * max(-plot.extent[0], plot.extent[1])
    assert plot.note.startswith("⚠ reaches")


def test_values_at_the_scrub_line_are_exact():
    view = wave(8, LAGRANGE)
    found = uncertain_values_at(view, frozenset(PLOTS), 0.3)
    values = {plot: value for plot, (value, _) in found.items()}
    c1, c2 = (view.curve.evaluate(0.3, order) for order in (1, 2))
    assert values[lengths.SPEED] == pytest.approx(np.linalg.norm(c1))
    assert values[curvature.CURVATURE] == pytest.approx(
        (c1[0] * c2[1] - c1[1] * c2[0]) / np.linalg.norm(c1) ** 3
    )
    assert set(PLOTS) == set(values)


def test_the_curvature_of_a_straight_line_is_certain():
    view = view_of(make_curve([(0.1, 0.3), (1.2, 1.4), (3.3, 3.5)]))
    (value, error) = uncertain_values_at(view, {curvature.CURVATURE}, 0.37)[curvature.CURVATURE]
    assert with_error(round(value, 12), error) == "0"


def test_the_curvature_of_a_dot_is_no_number_and_warns_of_nothing():
    points = tuple(Point(1.0, 1.0, t, (0.0, 0.0)) for t in (0.0, 1.0))
    view = view_of(Curve("Dot", HERMITE, Parametrization(ParametrizationKind.MANUAL), points))
    (_, error) = uncertain_values_at(view, {curvature.CURVATURE}, 0.37)[curvature.CURVATURE]
    assert error == np.inf


def difference_alone(plot):
    """How far a value of a plot in sight is from the one of that t alone, against the greatest of all."""
    # The snap of cubics is 0, the greatest of all too.
    view = wave(7, HERMITE if max(plot.orders, default=0) < 4 else FAMILIES.named("septic_hermite"))
    (whole,) = plots(view, plot, columns=300)
    (part,) = plots(view, plot, columns=300, t_range=(0.31, 0.47))
    pairs = [(t, value) for each in (whole, part) for t, value in zip(*_of(each), strict=True)]
    alone = [uncertain_values_at(view, {plot}, t)[plot][0] for t, _ in pairs]
    return max(abs(one - value) for one, (_, value) in zip(alone, pairs, strict=True)) / whole.extent[1]


def _of(plot):
    (line,) = plot.lines
    shown = ~np.isnan(line.values)
    return line.t[shown][::7], line.values[shown][::7]


@each_row("plot", PLOTS, ids=lambda plot: plot.name)
def test_a_value_depends_on_its_t_alone(plot):
    # Rounding of the derivatives, which are computed for many t at once.
    assert difference_alone(plot) < 1e-9


def test_a_plot_that_sums_the_visible_part_fails_the_check():
    added = replace(lengths.SPEED, values=lambda sampled: np.cumsum(sampled.derivatives[1][:, 0]))
    assert difference_alone(added) > 0.1


def test_without_a_curve_the_plots_are_empty():
    view = view_of(Curve("One", LAGRANGE, Parametrization(), (Point(0.0, 0.0),)))
    assert plots_of(view, frozenset(PLOTS), (0.0, 1.0), 100) == []
    assert uncertain_values_at(view, frozenset(PLOTS), 0.5) == {}


def test_huge_numbers_stay_quiet():
    points = tuple(Point(x * 1e12, y * 1e12, t=t * 1e-9) for x, y, t in ((0, 0, 0), (1, 1, 1), (2, -1, 2)))
    rule = Parametrization(ParametrizationKind.MANUAL, start=0.0, end=2e-9)
    for family in FAMILIES:
        view = view_of(Curve("Huge", family, rule, points))
        for plot in plots(view, *PLOTS):
            assert np.isfinite(plot.extent).all()
        assert np.isfinite(hodograph_of(view, 2).reach)


def test_slow_derivatives_are_known_to_be_slow():
    assert not is_slow(wave(20, LAGRANGE))
    assert not is_slow(wave(20, LAGRANGE, ParametrizationKind.UNIFORM))
    assert is_slow(wave(40, LAGRANGE, ParametrizationKind.UNIFORM))
    assert is_slow(wave(65, LAGRANGE, ParametrizationKind.CHEBYSHEV))
    assert not is_slow(wave(1000, HERMITE))


def test_on_a_logarithmic_scale_only_positive_values_count():
    values = np.array([0.0, -1.0, np.nan, np.inf, 1e-12, 1e-3])
    assert extent_of([values], Scale.LOG) == (1e-12, 1e-3)
    assert extent_of([values], Scale.LINEAR) == (-1.0, 1e-3)
    assert extent_of([np.array([np.nan])], Scale.LOG) == (1.0, 1.0)
    assert plot_of("Errors", [], Scale.LOG).extent == (1.0, 1.0)


def test_a_line_has_the_value_of_its_nearest_sample():
    line = PlotLine("", np.array([0.0, 1.0, 1.0, 1.0, 2.0]), np.array([5.0, 6.0, np.nan, 8.0, 9.0]))
    assert line.value_at(0.2) == 5.0
    assert line.value_at(1.9) == 9.0
    assert line.value_at(1.1) == 8.0 or line.value_at(1.1) == 6.0
    assert math.isnan(line.value_at(3.0))


@pytest.mark.parametrize("family", FAMILIES)
def test_the_hodograph_is_the_derivative_as_a_curve(family):
    view = wave(6, family)
    for order in (1, 2):
        hodograph = hodograph_of(view, order)
        known = ~np.isnan(hodograph.points[:, 0])
        exact = view.curve.evaluate(hodograph.t[known], order)
        assert hodograph.points[known] == pytest.approx(exact, rel=1e-9, abs=1e-9 * hodograph.reach)
        at_knots = view.curve.evaluate(view.parameters, order)
        assert hodograph.knots == pytest.approx(at_knots, rel=1e-6, abs=1e-6 * hodograph.reach)
        assert derivative_at(view, 0.3, order) == pytest.approx(tuple(view.curve.evaluate(0.3, order)))


def test_the_hodograph_of_a_cubic_jumps_where_the_acceleration_does():
    view = wave(6, HERMITE, velocity_rule=VelocityRule.BESSEL)
    assert not np.isnan(hodograph_of(view, 1).points).any()
    gaps = np.isnan(hodograph_of(view, 2).points)
    assert (gaps[:, 0] == gaps[:, 1]).all()
    assert gaps[:, 0].sum() == 4


def test_growth_beyond_all_floats_is_infinite_without_a_warning():
    """Λ of 1100 uniform parameters is about 2^1100 / (1100 e ln 1100), beyond 2^1024."""
    view = wave(1100, LAGRANGE, ParametrizationKind.UNIFORM)
    assert growth_of_points(view, basis_view(view)) == math.inf
