"""Results for curves of every family, also of some that define nothing but a basis."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from msgspec.structs import replace

from app.document import curve_edits, point_edits
from app.document.derivatives import VelocityRule
from app.document.limits import EditError
from app.document.model import Document, ParametrizationKind, make_curve
from app.exchange.facts import facts_of
from app.families import FAMILIES, HERMITE, titles
from app.view_model.analysis.ghost import all_ghosts
from app.view_model.analysis.ghost_views import ghost_views
from app.view_model.analysis.goals import MEASURES, parse_goal, result_of
from app.view_model.analysis.hodograph import derivative_at, hodograph_of
from app.view_model.analysis.joints import as_text, certificate_of
from app.view_model.analysis.laboratory import calculations, cost_of, digits_at, try_methods
from app.view_model.analysis.legend import legend_rows
from app.view_model.analysis.overlay import OVERLAYS, PARAMETER_ERROR, POINT_ERROR
from app.view_model.analysis.overlays import extrema
from app.view_model.analysis.overlays.bezier import BEZIER
from app.view_model.analysis.picture import live_picture, settled_picture, settling
from app.view_model.analysis.plot import PLOTS
from app.view_model.analysis.plot_samples import plots_of, uncertain_values_at
from app.view_model.analysis.plots.curvature import CURVATURE
from app.view_model.analysis.plots.lengths import ACCELERATION, SPEED
from app.view_model.analysis.settings import AnalysisSettings, Calculation, LaboratorySettings, RoundedPart
from app.view_model.analysis.warnings import warnings_of
from app.view_model.analysis.wiggle import cures_of, explain
from app.view_model.append import with_closed
from app.view_model.basis import basis_view, cardinal_view, growth_at, growth_of_points, weights_at
from app.view_model.bend import Bend, BendWith
from app.view_model.convert import converted
from app.view_model.curve.curve_view import view_of
from app.view_model.curve.distances import NearestPoint
from app.view_model.join import joined
from app.view_model.motion import STATIONS, Course, Pace, jump_sentences, rivals_of
from app.view_model.motion_settings import timed_families
from app.view_model.reshape import reversed_curve, with_point_inserted
from app.view_model.split import split
from curvecore import ParametricCurve, joint_report, monomial_condition, worst_case_band
from tests.own_families import EVERY, OWN, TRUE_BASIS
from tests.polylines import worst_distance
from tests.rows import each_row

pytestmark = pytest.mark.usefixtures("own_families")

POINTS = ((0.0, 0.0), (1.0, 2.0), (2.5, 1.0), (4.0, 3.0), (5.0, 0.5), (6.0, 2.0))
SIZE = 6.0
JOINTS = {
    "cubic_spline": len(POINTS) - 2,
    "lagrange": 0,
    "hermite": len(POINTS) - 2,
    "quintic_hermite": len(POINTS) - 2,
    "tests_averaging": 0,
    "tests_cosine_steps": len(POINTS) - 2,
    "tests_gaussian": 0,
    "tests_natural_spline": len(POINTS) - 2,
}
"""Inner breaks of the families of which the tests know it."""
LINEAR = [rule for rule in VelocityRule if rule.is_linear]
RULES = [kind for kind in ParametrizationKind if kind is not ParametrizationKind.MANUAL]


def curve_of(name, kind=ParametrizationKind.CHORD_LENGTH, points=POINTS):
    made = make_curve(points, name=f"A {name}", family=FAMILIES.named(name))
    rule = replace(made.parametrization, kind=kind, start=1.0, end=3.5)
    if kind is not ParametrizationKind.MANUAL:
        return replace(made, parametrization=rule)
    times = np.linspace(1.0, 3.5, len(points)) + 0.1 * np.sin(np.arange(len(points)))
    return with_times(replace(made, parametrization=rule), times.tolist())


def with_times(curve, times):
    points = tuple(replace(point, t=t) for point, t in zip(curve.points, times, strict=True))
    rule = replace(curve.parametrization, kind=ParametrizationKind.MANUAL)
    return replace(curve, points=points, parametrization=rule)


def made_or_reason(make):
    """What is made, or the sentence that refuses it."""
    try:
        return make()
    except EditError as refusal:
        return str(refusal)


def shape(view, count=2001):
    """Points all along the curve of a view, at equal shares of its domain."""
    return view.curve.evaluate(np.linspace(*view.curve.domain, count))


@pytest.fixture(params=EVERY)
def name(request):
    return request.param


@pytest.fixture(params=OWN)
def own(request):
    return request.param


# The curve itself


@each_row("kind", RULES)
def test_the_curve_is_the_sum_of_the_functions_of_the_file(own, kind):
    view = view_of(curve_of(own, kind))
    t = np.linspace(*view.curve.domain, 301)
    truth = TRUE_BASIS[own](t, view.parameters) @ view.points
    # The bells' system has a condition number of about 10: some dozen roundings of 2⁻⁵³ times 6.
    assert np.abs(view.curve.evaluate(t) - truth).max() < 1e-13 * SIZE
    assert view.curve.degree is None
    assert FAMILIES.named(own).interpolates == np.array_equal(
        view.curve.evaluate(view.parameters), view.points
    )


@each_row("name", EVERY)
def test_the_polyline_is_within_its_stated_deviation(name):
    view = view_of(curve_of(name))
    everywhere = np.array([-100.0, -100.0, 100.0, 100.0])
    for tolerance in (0.1, 1e-3, 1e-5):
        line = view_of(view.source).flattened(tolerance)
        assert line.reached <= tolerance
        assert worst_distance(view.curve, line, everywhere) <= tolerance


@each_row("kind", [ParametrizationKind.UNIFORM, ParametrizationKind.CHORD_LENGTH])
def test_a_drag_draws_the_same_curve_as_a_new_view(name, kind):
    before = view_of(curve_of(name, kind))
    before.flattened(1e-3)
    for step in range(1, 40, 3):
        points = list(before.source.points)
        points[2] = replace(points[2], x=2.5 + 0.05 * step, y=1.0 - 0.03 * step)
        moved = replace(before.source, points=tuple(points))
        before = view_of(moved, before)
        line = before.flattened(1e-3)
        fresh = view_of(moved)
        assert np.array_equal(before.curve.jets, fresh.curve.jets)
        assert np.abs(line.points - fresh.curve.evaluate(line.parameters)).max() < 1e-11
        assert line.reached <= 1e-3


@each_row("name", EVERY)
def test_the_basis_panel_shows_the_functions_of_the_curve(name):
    view = view_of(curve_of(name))
    shown = basis_view(view)
    t = 1.7
    weights = weights_at(view, t)
    assert weights == pytest.approx(view.cardinal.basis(t), abs=1e-12)
    assert weights @ view.points == pytest.approx(view.curve.evaluate(t), abs=1e-12)
    for index in range(len(POINTS)):
        for order in range(view.source.family.derivatives + 1):
            at, values = shown.function(index, order)
            exact = view.curve.basis(at)[:, index, order] * shown.scales[index, order]
            assert values == pytest.approx(exact, abs=1e-12)


# What the person does


@each_row("kind", [*RULES, ParametrizationKind.MANUAL])
@each_row("using", [BendWith.ALL, BendWith.POINTS])
def test_the_grabbed_point_of_a_bend_follows(name, kind, using):
    view = view_of(curve_of(name, kind))
    for t in (1.35, 2.2, 3.3):
        start, bend = view.curve.evaluate(t), Bend(view, t, using)
        for way in ((0.4, -0.3), (-1.5, 2.0)):
            target = start + way
            bent = view_of(bend.bent(tuple(target.tolist()), 1e-3), view)
            segment = int(np.searchsorted(view.parameters, t)) - 1
            low, high = view.parameters[segment : segment + 2]
            now = bent.parameters[segment : segment + 2]
            at = now[0] + (t - low) / (high - low) * (now[1] - now[0])
            assert bent.curve.evaluate(at) == pytest.approx(target, abs=2e-3)


@each_row("own", OWN)
def test_a_bend_is_the_least_change_of_the_points(own):
    """At fixed parameters: the minimum norm solution, by another method."""
    view = view_of(curve_of(own, ParametrizationKind.UNIFORM))
    t, way = 2.2, np.array([0.4, -0.3])
    row = TRUE_BASIS[own](np.array([t]), view.parameters)
    least = np.linalg.lstsq(row, way[None], rcond=None)[0]
    bent = Bend(view, t, BendWith.ALL).bent(tuple((view.curve.evaluate(t) + way).tolist()), 1e-9)
    moves = np.array([point.position for point in bent.points]) - view.points
    assert moves == pytest.approx(least, abs=1e-12)


@each_row("kind", [ParametrizationKind.MANUAL, ParametrizationKind.CENTRIPETAL])
def test_an_inserted_point_lies_on_the_curve_and_the_change_is_reported(name, kind):
    view = view_of(curve_of(name, kind))
    made = with_point_inserted(view, 2.1)
    index = int(np.searchsorted(view.parameters, 2.1))
    after = view_of(made.curve)
    # Of curves that pass their points by, one more control point is not on the curve, and keeps the shape.
    keeps = view.curve.refined(2.1) is not None
    if keeps:
        assert np.abs(shape(after) - shape(view)).max() < 1e-11
    else:
        assert made.curve.points[index].position == pytest.approx(view.curve.evaluate(2.1), abs=1e-12)
    if keeps or kind is ParametrizationKind.MANUAL:
        moved = np.abs(shape(after) - shape(view)).max()
        # The residual is of samples at other places.
        assert made.residual == pytest.approx(
            np.linalg.norm(shape(after) - shape(view), axis=1).max(), rel=0.05, abs=1e-12
        )
        if FAMILIES.named(name).derivatives or FAMILIES.named(name).curve_class.is_one_polynomial:
            assert moved < 1e-11
        assert made.sentence.startswith("Shape kept" if moved < 1e-11 else "Shape changed")


@each_row("own", OWN)
def test_a_curve_that_cannot_be_split_is_followed_by_cubics_that_can(own):
    """Radial basis functions, for one: no part of such a curve is one of its family."""
    view = view_of(curve_of(own))
    made = converted(view, HERMITE)
    size = np.ptp(view.points, axis=0).max()
    after = view_of(made.curve)
    t = np.linspace(*view.curve.domain, 4001)
    away = np.abs(after.curve.evaluate(t) - view.curve.evaluate(t)).max()
    assert away <= 1.5e-4 * size
    assert made.residual == pytest.approx(away, rel=0.5, abs=1e-9 * size)
    assert len(made.curve.points) < 200
    middle = float(after.parameters[[0, -1]].mean())
    for part in map(view_of, split(after, middle).curves):
        at = np.linspace(*part.curve.domain, 801)
        assert np.abs(part.curve.evaluate(at) - after.curve.evaluate(at)).max() < 1e-10


@each_row("t", [1.9, "a point"])
def test_a_split_keeps_the_shape_or_is_refused(name, t):
    view = view_of(curve_of(name, ParametrizationKind.MANUAL))
    t = float(view.parameters[3]) if t == "a point" else t
    made = made_or_reason(lambda: split(view, t))
    if isinstance(made, str):
        family = FAMILIES.named(name)
        assert not family.derivatives
        assert not family.curve_class.is_one_polynomial
        assert made.startswith(f"{family.subject} cannot be split")
        # The way out keeps the shape of polynomials alone.
        way_out = "keeping the shape" if view.curve.exact_pieces() is not None else "within 0.0"
        assert f"Convert it to Hermite first, {way_out}" in made
        assert name != "tests_cosine_steps" or t == 1.9
        return
    assert name != "tests_gaussian"
    first, second = map(view_of, made.curves)
    assert first.parameters[-1] == second.parameters[0] == t
    for part in (first, second):
        at = np.linspace(*part.curve.domain, 801)
        assert np.abs(part.curve.evaluate(at) - view.curve.evaluate(at)).max() < 1e-10
    assert made.residual < 1e-10


@each_row("name", EVERY)
def test_a_join_keeps_both_shapes_or_is_refused(name):
    first = view_of(curve_of(name, ParametrizationKind.UNIFORM))
    beyond = tuple((x + 6.0, y + 2.0) for x, y in POINTS)
    second = view_of(curve_of(name, ParametrizationKind.UNIFORM, beyond))
    made = made_or_reason(lambda: joined(first, second))
    if isinstance(made, str):
        family = FAMILIES.named(name)
        assert name not in ("hermite", "quintic_hermite", "tests_cosine_steps")
        assert (
            "polynomials cannot be joined" in made
            if family.curve_class.is_one_polynomial
            else f"Two {family.title} curves" in made
        )
        return
    assert name not in ("lagrange", "tests_gaussian")
    whole = view_of(made.curve)
    at = np.linspace(*first.curve.domain, 801)
    assert np.abs(whole.curve.evaluate(at) - first.curve.evaluate(at)).max() < 1e-10
    later = whole.parameters[len(POINTS) - 1] - second.parameters[0]
    assert np.abs(whole.curve.evaluate(at + later) - second.curve.evaluate(at)).max() < 1e-10


@each_row("own", OWN)
def test_two_families_are_not_joined(own):
    with pytest.raises(EditError, match="choose one family for both"):
        joined(view_of(curve_of(own)), view_of(curve_of("hermite")))


@each_row("name", EVERY)
def test_a_curve_is_closed_only_where_its_family_can_close(name):
    document = Document((curve_of(name),))
    family = FAMILIES.named(name)
    if family.curve_class.can_close:
        closed = view_of(with_closed(document, 0, view_of(document.curves[0]), True).curves[0])
        assert closed.curve.evaluate(closed.curve.domain[1]) == pytest.approx(POINTS[0])
        return
    with pytest.raises(EditError, match=family.a_curve) as refusal:
        curve_edits.set_closed(document, 0, True)
    closing = titles(each for each in FAMILIES if each.curve_class.can_close)
    assert closing.startswith("Hermite, quintic Hermite")
    assert closing.endswith(" or cosine steps")
    assert str(refusal.value).startswith(f"To close the curve, choose {closing}")


@each_row("kind", [ParametrizationKind.CHORD_LENGTH, ParametrizationKind.UNIFORM])
def test_a_closed_curve_is_the_sum_of_its_functions_and_as_smooth_at_its_seam(name, kind):
    if not FAMILIES.named(name).curve_class.can_close:
        return
    view = view_of(replace(curve_of(name, kind), closed=True))
    for t in (1.2, 2.3, 3.45):
        weights = weights_at(view, t)
        assert weights.shape == (len(POINTS),)
        assert weights @ view.points == pytest.approx(view.curve.evaluate(t), abs=1e-12)
    joints = joint_report(view.curve, tolerance=1e-6, closed=True)
    assert {joint.label for joint in joints[:-1]} == {joints[-1].label}
    assert joints[-1].joint == 0
    shown = basis_view(view)
    assert [view.owner(knot) for knot in (0, len(POINTS))] == [0, 0]
    assert len(shown.owners) == len(POINTS) + 1


def chebyshev_samples(knots, degree, times):
    """Return so many times degree Chebyshev points in each segment.

    Between them a polynomial is at most 1 / cos(π / 2 times) as large as at them (Ehlich, Zeller 1964), and
    so is a sum of sizes of polynomials: it is the largest of their sums with signs.
    """
    angles = (np.arange(times * degree) + 0.5) * np.pi / (times * degree)
    return (knots[:-1, None] + np.diff(knots)[:, None] * (1 + np.cos(angles)) / 2).ravel()


@each_row("kind", [ParametrizationKind.CHORD_LENGTH, ParametrizationKind.UNIFORM, ParametrizationKind.MANUAL])
def test_the_first_point_of_a_closed_curve_counts_once(name, kind):
    """Λ was 2.7346 for 2.5913, and the panel had two functions of point 0.

    The sums are made by really moving each point; the parameters stay.
    """
    family = FAMILIES.named(name)
    if not family.curve_class.can_close:
        return
    for rule in LINEAR if family.derivatives else LINEAR[:1]:
        closed = replace(curve_of(name, kind), closed=True, velocity_rule=rule)
        view = view_of(closed)
        basis = (cardinal_view if family.derivatives else basis_view)(view)
        # Where it is no polynomial the samples are as dense, and the bound is none.
        t = chebyshev_samples(view.parameters, view.curve.degree or 9, 24)
        effects = effects_of(view, np.concatenate([t, basis.t]))
        effects, drawn = effects[:, : len(t)], effects[:, len(t) :]
        sums = np.abs(effects).sum(axis=0)
        assert growth_at(view, t) == pytest.approx(sums, rel=1e-11)
        found = growth_of_points(view)
        assert sums.max() * (1 - 1e-11) <= found <= sums.max() / np.cos(np.pi / 48)
        assert facts_of(Document((closed,)))[0].lebesgue_constant.points == pytest.approx(found, rel=1e-12)
        assert growth_of_points(view, basis) == found
        assert weights_at(view, float(t[7])) == pytest.approx(effects[:, 7], abs=1e-12)
        assert (basis.owners[0], basis.owners[-1], basis.point_count) == (0, 0, len(POINTS))
        assert basis.value_at(float(t[7]), 0) == pytest.approx(effects[[*basis.owners], 7], abs=1e-12)
        assert list(basis.drawn) == [*range(len(POINTS))]
        for knot, owner in enumerate(basis.owners):
            assert basis.function(knot, 0)[1] == pytest.approx(drawn[owner], abs=1e-12)


def effects_of(view, t):
    """Return how far a move of each point by 1 moves the curve at t, (points, m); the parameters stay."""
    document = Document((with_times(view.source, view.parameters[: len(view.points)].tolist()),))
    moved = [
        point_edits.set_position(document, 0, i, (x + 1.0, y))
        for i, (x, y) in enumerate(view.points.tolist())
    ]
    ways = [view_of(each.curves[0]).curve.evaluate(t) - view.curve.evaluate(t) for each in moved]
    return np.array(ways)[:, :, 0]


@each_row("using", [BendWith.ALL, BendWith.POINTS])
def test_a_closed_curve_is_bent(name, using):
    if not FAMILIES.named(name).curve_class.can_close:
        return
    view = view_of(replace(curve_of(name), closed=True))
    for t in (1.1, 2.2, 3.45):
        target = view.curve.evaluate(t) + np.array([0.4, -0.3])
        bent = view_of(Bend(view, t, using).bent(tuple(target.tolist()), 1e-3), view)
        found = NearestPoint(bent).within(tuple(target.tolist()), 1.0)
        assert found.distance < 2e-3


@each_row("name", EVERY)
def test_the_reversed_curve_is_the_same_or_the_change_is_reported(name):
    view = view_of(curve_of(name, ParametrizationKind.MANUAL))
    made = reversed_curve(view)
    back = shape(view_of(made.curve))[::-1]
    assert np.linalg.norm(back - shape(view), axis=1).max() == pytest.approx(made.residual, abs=1e-11)
    # All of them are the same seen from behind.
    assert made.residual < 1e-11


# What is said and drawn of it


@each_row("name", EVERY)
def test_every_overlay_draws_a_curve_of_any_family(name):
    view = view_of(curve_of(name))
    everything = AnalysisSettings(
        overlays=frozenset(OVERLAYS),
        values=frozenset({POINT_ERROR: 0.01, PARAMETER_ERROR: 1e-4}.items()),
        ghosts=frozenset(all_ghosts()),
    )
    live = live_picture(view, everything, 2.0)
    settled = settled_picture(view, everything, 2.0)
    drawn = shape(view, 20001)
    for figure in (*live.figures, *settled.figures):
        assert np.isfinite(figure.points[~np.isnan(figure.points)]).all()
    assert settling(view, everything) <= frozenset(OVERLAYS)
    assert {ghost for ghost, shown in ghost_views(view, everything.ghosts, {}).items() if shown.is_real} >= {
        ghost for ghost in all_ghosts() if ghost.family is not None and ghost.family.name == name
    }
    for figure in settled.figures:
        if figure.style not in (extrema.SHARPEST, extrema.FLATTEST, extrema.INFLECTION):
            continue
        away = np.abs(figure.points[:, None] - drawn).max(axis=2).min(axis=1)
        assert away.max() < 5e-3


@each_row("name", EVERY)
def test_every_plot_plots_a_curve_of_any_family(name):
    view = view_of(curve_of(name))
    start, end = view.curve.domain
    shown = plots_of(view, frozenset(PLOTS), (start, end), 600, view.growth)
    assert {plot.title for plot in shown} == {plot.title for plot in PLOTS}
    h = 1e-4
    for t in (1.234, 2.345, 3.21):
        before, at, after = view.curve.evaluate(np.array([t - h, t, t + h]))
        found = uncertain_values_at(view, frozenset(PLOTS), t)
        values = {plot: value for plot, (value, _) in found.items()}
        velocity, acceleration = (after - before) / (2 * h), (after - 2 * at + before) / h**2
        assert values[SPEED] == pytest.approx(np.hypot(*velocity), rel=1e-5)
        assert values[ACCELERATION] == pytest.approx(np.hypot(*acceleration), rel=1e-3, abs=1e-3)
        across = velocity[0] * acceleration[1] - velocity[1] * acceleration[0]
        bend = across / np.hypot(*velocity) ** 3
        assert values[CURVATURE] == pytest.approx(bend, rel=1e-3, abs=1e-3)
        assert derivative_at(view, t, 1) == pytest.approx(velocity, rel=1e-5, abs=1e-5)
    assert np.isfinite(hodograph_of(view, 1).points[~np.isnan(hodograph_of(view, 1).points)]).all()


@each_row("name", EVERY)
def test_curves_with_errors_in_all_data_stay_in_the_band(name):
    curve, random = view_of(curve_of(name)).curve, np.random.default_rng(5)
    t = np.linspace(*curve.domain, 41)[1:-1]
    size, delta = 1e-6, 1e-7
    band = worst_case_band(curve, t, size, delta, size, size, size)
    worst = 0.0
    for _ in range(20):
        errors = random.standard_normal(curve.jets.shape)
        errors *= size / np.linalg.norm(errors, axis=2, keepdims=True)
        moved = random.choice([-delta, delta], len(curve.parameters))
        other = curve.with_data(curve.jets + errors, curve.parameters + moved)
        away = np.hypot(*(other.evaluate(t) - curve.evaluate(t)).T)
        worst = max(worst, (away / band.distance).max())
    # What the first order leaves out is some 1e-6 of it; of differences, digits are lost.
    assert 0.5 < worst < 1.0 + 1e-5


@each_row("own", OWN)
def test_the_lebesgue_constant_is_that_of_its_functions(own):
    view = view_of(curve_of(own))
    t = np.concatenate([np.linspace(*pair, 400) for pair in pairwise(view.parameters)])
    truth = np.abs(TRUE_BASIS[own](t, view.parameters)).sum(axis=1).max()
    assert growth_of_points(view) == pytest.approx(truth, rel=1e-4)


@each_row("name", EVERY)
def test_the_nearest_point_and_the_length_are_those_of_the_curve(name):
    view = view_of(curve_of(name))
    drawn = shape(view, 40001)
    for place in ((2.0, 2.0), (5.5, 0.0), (3.3, 2.4)):
        found = NearestPoint(view).within(place, 10.0)
        assert found.distance == pytest.approx(np.hypot(*(drawn - place).T).min(), abs=1e-4)
        assert view.curve.evaluate(found.parameter) == pytest.approx(found.point, abs=1e-9)
    course = Course(view.curve, Pace.LENGTH)
    stations = course.stations(np.arange(STATIONS + 1))
    steps = np.hypot(*np.diff(stations, axis=0).T)
    # Chords of equal arcs; only at sharp bends they are shorter.
    assert np.median(steps) == pytest.approx(steps.max(), rel=2e-2)


@each_row("name", EVERY)
def test_the_legend_mutes_overlays_that_are_not_drawn(name):
    """The Bézier polygon of a family without one used to have a line like any other."""
    view = view_of(curve_of(name))
    settings = AnalysisSettings(overlays=frozenset([BEZIER]))
    pictures = live_picture(view, settings), settled_picture(view, settings)
    (row,) = legend_rows(view, settings, (), [figure for each in pictures for figure in each.figures], ())
    is_drawn = view.curve.bezier_pieces() is not None or FAMILIES.named(name).curve_class.is_one_polynomial
    assert is_drawn or view.curve.degree is None or name.startswith("tests_")
    assert row.is_muted is not is_drawn
    assert any("Not drawn" in each.notes.get(BEZIER, "") for each in pictures) is not is_drawn


@each_row("name", EVERY)
def test_the_certificate_counts_the_joints(name):
    view = view_of(curve_of(name))
    certificate = certificate_of(view)
    assert as_text(certificate)
    inner = len(view.curve.breaks) - 2
    assert len(certificate.rows) == inner
    if name in JOINTS:
        assert inner == JOINTS[name]
    if name == "tests_gaussian":
        assert certificate.summary == "No joints: a Gaussian curve has no inner breaks."
    if name == "tests_cosine_steps":
        # It stands still at every point, and starts in another direction: c'' jumps, c' does not.
        for row in certificate.rows:
            h = np.diff(view.parameters)[row.joint - 1 : row.joint + 1]
            p, q, r = view.points[row.joint - 1 : row.joint + 2]
            jump = 0.5 * np.pi**2 * ((r - q) / h[1] ** 2 - (p - q) / h[0] ** 2)
            # c' and c'' from differences: good to 11 and 9 digits, for functions as smooth as these.
            assert row.jumps[:3] == pytest.approx((0.0, 0.0, np.hypot(*jump)), rel=1e-7, abs=1e-9)
            # c''' is 0 on both sides; differences keep 6 digits of its size in between, pi**3 / 2 of a chord.
            chords = np.hypot(*(r - q)) / h[1] ** 3 + np.hypot(*(q - p)) / h[0] ** 3
            assert row.jumps[3] <= 1e-6 * 0.5 * np.pi**3 * chords


@each_row("name", EVERY)
def test_the_laboratory_computes_a_curve_of_any_family_or_reports_the_reason(name):
    view = view_of(curve_of(name))
    for rounding in RoundedPart:
        settings = LaboratorySettings(
            on=True, rounding=rounding, digits=16, methods=frozenset(Calculation), shift=0.0
        )
        trial = try_methods(view, settings)
        assert isinstance(trial, str) == (not calculations(view))
        if name in OWN:
            assert isinstance(trial, str)
            assert FAMILIES.named(name).title in trial
            assert not calculations(view)
            assert digits_at(view, settings, 2.0) is None
            continue
        if isinstance(trial, str):
            continue
        truth = view.curve.evaluate(trial.t)
        # Digits that powers of t lose: those of the condition number.
        allowed = max(1e-8, 1e-16 * monomial_condition(view.curve))
        for outcome in trial.outcomes:
            assert np.abs(np.vstack(outcome.pieces) - truth).max() < allowed


@each_row("name", EVERY)
def test_remarks_and_facts_hold_for_a_curve_of_any_family(name):
    view = view_of(curve_of(name))
    cost_of(view)
    explanation = explain(view, 2.2)
    assert explanation is not None
    assert explanation.lebesgue == pytest.approx(np.abs(weights_at(view, 2.2)).sum())
    warnings_of(view, growth_of_points(view))
    document = Document((view.source,))
    cures = cures_of(document, 0, view, 2)
    assert all(np.isfinite(cure.overshoot) or cure.problem for cure in cures.cures)
    rivals = rivals_of(view, frozenset(timed_families()))
    assert rivals
    assert (view.source.family in {each for role in rivals for each in role.families}) is (
        view.source.family.interpolates
    )
    assert jump_sentences(rivals)


@each_row("name", EVERY)
def test_every_goal_of_a_lesson_can_be_measured_on_a_curve_of_any_family(name):
    view = view_of(curve_of(name))
    for measure in [measure for measure, record in MEASURES.items() if record.words is None]:
        assert "now" in result_of(parse_goal(f"{measure} < 1"), view).text
    everything = parse_goal("points > 3", kept="points, family, rule")
    assert result_of(everything, view, view.source).is_met
    assert result_of(parse_goal(f"family = {name}"), view).is_met
    assert not result_of(parse_goal("family = quintic_hermite"), view).is_met or name == "quintic_hermite"


@each_row("unchanged", [*OWN, "tests_natural_spline"])
def test_a_curve_of_too_many_points_is_refused_with_a_sentence_and_not_computed(unchanged):
    """A class in the core that overrides nothing had no limit: 5000 points took 23 s and 1 GB."""
    points = np.column_stack([np.arange(2001.0), np.sin(np.arange(2001.0))])
    view = view_of(make_curve(points.tolist(), family=FAMILIES.named(unchanged)))
    assert view.curve is None
    assert view.problem == f"A curve of {unchanged} can have 2000 points, not 2001."


@each_row("name", EVERY)
def test_a_family_declares_its_optional_methods(name):
    """`most_points` is None only where the class has something of its own to draw many points with."""
    kind = type(view_of(curve_of(name)).curve)
    if kind.most_points is None:
        assert kind._evaluate is not ParametricCurve._evaluate
    if name in ("lagrange", "hermite", "quintic_hermite", "cubic_spline"):
        assert kind.most_points is None
