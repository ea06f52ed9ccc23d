"""Overlays as arrays, compared with closed forms, and on degenerate curves."""

from __future__ import annotations

import re
from functools import partial

import numpy as np
import pytest
from msgspec.structs import replace

from app.document.model import Curve, Document, Parametrization, ParametrizationKind, Point
from app.families import FAMILIES, HERMITE, LAGRANGE, QUINTIC_HERMITE
from app.view_model.analysis.ghost import Ghost, all_ghosts
from app.view_model.analysis.ghost_views import ghost_views, with_ghost_real
from app.view_model.analysis.overlay import OVERLAYS, PARAMETER_ERROR, POINT_ERROR, Shape, number, usual_error
from app.view_model.analysis.overlays import band, bezier, circle, comb, extrema, polygon, ticks, vectors
from app.view_model.analysis.overlays import ensemble as disturbed
from app.view_model.analysis.picture import live_picture, settled_picture, settling
from app.view_model.analysis.settings import AnalysisSettings
from app.view_model.curve.curve_view import curve_through, view_of
from curvecore import ensemble, lebesgue_constant, lebesgue_function

UNIFORM = ParametrizationKind.UNIFORM


def curve_of(points, family=LAGRANGE, kind=UNIFORM, **fields):
    points = tuple(Point(float(x), float(y)) for x, y in points)
    return Curve("Test", family, Parametrization(kind), points, **fields)


def wave(n, family=LAGRANGE, kind=UNIFORM):
    x = np.linspace(0, 4, n)
    return curve_of(np.column_stack([x, np.sin(3 * x)]), family, kind)


def settings_of(*overlays, values=None, **fields):
    values = frozenset((values or {}).items())
    return AnalysisSettings(overlays=frozenset(overlays), values=values, **fields)


def live(curve, *overlays, scrub=None, values=None):
    return live_picture(view_of(curve), settings_of(*overlays, values=values), scrub)


def points_of(picture, style):
    return np.vstack([figure.points for figure in picture.figures if figure.style is style])


S_CURVE = [
    (3.03, 3.34),
    (2.65, 3.81),
    (1.39, 3.83),
    (1.14, 2.38),
    (2.95, 1.62),
    (2.67, 0.17),
    (1.29, 0.19),
    (0.86, 0.66),
]
"""Under uniform parameters it has a cusp, or nearly so, between its first two points."""

PARABOLA = curve_of([(-1, 1), (0, 0), (1, 1)])
"""c(t) = (2t − 1, (2t − 1)²): c' = (2, 4(2t − 1)), c'' = (0, 8), radius 1/2 at the vertex."""


def test_the_circle_at_the_vertex_of_a_parabola():
    picture = live(PARABOLA, circle.CIRCLE, scrub=0.5)
    away = np.linalg.norm(points_of(picture, circle.LINE) - (0, 0.5), axis=1)
    assert away == pytest.approx(np.full(len(away), 0.5))
    assert points_of(picture, circle.CENTRE)[-1] == pytest.approx((0, 0.5))
    assert picture.notes[circle.CIRCLE] == "Radius 0.5, curvature 2."


def near_pair(gap):
    """A cubic Hermite curve two of whose points are so far apart."""
    return curve_of([(0, 0), (1, 1), (1 + gap, 1), (2, 0)], HERMITE, ParametrizationKind.CHORD_LENGTH)


def test_the_circle_reports_the_uncertainty_by_rounding():
    """Between points 1e-9 apart the curvature was told as 1.5, and is −1.5."""
    words = {}
    for gap in (1e-3, 1e-6, 1e-9):
        curve = near_pair(gap)
        before, after = view_of(curve).parameters[1:3].tolist()
        picture = live(curve, circle.CIRCLE, scrub=before + 0.3 * (after - before))
        words[gap] = picture.notes[circle.CIRCLE]
        assert bool(picture.figures) is (gap > 1e-9)
    assert words[1e-3] == "Radius 0.667, curvature −1.5."
    assert re.fullmatch(r"Radius 0.667 ± 0.0\d+, curvature −1.5 ± 0.0\d+.", words[1e-6])
    assert words[1e-9] == circle.UNCERTAIN
    assert live(near_pair(1e-9), circle.CIRCLE, scrub=0.3).notes[circle.CIRCLE].startswith("Radius 1.07,")


def test_the_circle_is_a_line_at_an_inflection_and_missing_at_a_rest():
    cubic = curve_of([(-1, -1), (-1 / 3, -1 / 27), (1 / 3, 1 / 27), (1, 1)])
    picture = live(cubic, circle.CIRCLE, scrub=0.5)
    assert picture.notes[circle.CIRCLE] == circle.NO_BEND
    assert points_of(picture, circle.LINE)[:, 1] == pytest.approx([0, 0], abs=1e-12)
    # (s², s²) turns back where it rests, at s = 0.
    rest = curve_of([(1, 1), (0, 0), (1, 1)])
    assert live(rest, circle.CIRCLE, scrub=0.5).notes[circle.CIRCLE] == circle.AT_REST
    assert live(PARABOLA, circle.CIRCLE).notes[circle.CIRCLE] == circle.NO_SCRUB


def test_arrows_have_the_direction_and_proportion_of_the_derivatives():
    picture = live(PARABOLA, vectors.VELOCITIES, scrub=0.5, values={vectors.VELOCITY_SCALE: 2.0})
    at_points, at_scrub = (figure for figure in picture.figures if figure.shape is Shape.ARROWS)
    arrows = np.diff(at_points.points.reshape(-1, 2, 2), axis=1)[:, 0]
    # A quarter of the size, twice: the longest velocity is √20.
    assert arrows == pytest.approx(np.array([(2, -4), (2, 0), (2, 4)]) / np.sqrt(20))
    assert np.diff(at_scrub.points, axis=0)[0] == pytest.approx(np.array([2, 0]) / np.sqrt(20))
    assert at_scrub.label == "|c′| 2"


def test_accelerations_of_cubics_have_two_sides_at_joints():
    """Two cubics through three points, velocities 0: c'' = ±6 (p₁ − p₀) / h² at their ends."""
    points = tuple(Point(float(x), 0.0, velocity=(0.0, 0.0)) for x in (0, 1, 3))
    curve = Curve("Test", HERMITE, Parametrization(UNIFORM), points)
    picture = live(curve, vectors.ACCELERATIONS)
    ends = points_of(picture, vectors.ACCELERATION).reshape(-1, 2, 2)
    arrows = {tuple(start.tolist()): [] for start in ends[:, 0]}
    for start, end in ends:
        arrows[tuple(start.tolist())].append(float((end - start)[0]))
    # 24, then −24 and 48 in the middle, then −48; the longest is a quarter of the size 3.
    assert arrows[0.0, 0.0] == pytest.approx([0.375])
    assert sorted(arrows[1.0, 0.0]) == pytest.approx([-0.375, 0.75])
    assert arrows[3.0, 0.0] == pytest.approx([-0.75])


def test_the_comb_jumps_where_the_curvature_does():
    """A straight segment, a corner, and a bend: at the corner a tooth of length 0 and a long one."""
    points = (
        Point(0, 0),
        Point(1, 0, velocity=(1.0, 0.0), corner=True, velocity_after=(1.0, 2.0)),
        Point(2, 0),
    )
    picture = live(Curve("Test", HERMITE, Parametrization(UNIFORM), points), comb.COMB)
    teeth = points_of(picture, comb.TEETH).reshape(-1, 2, 2)
    there = teeth[np.linalg.norm(teeth[:, 0] - (1, 0), axis=1) < 1e-9]
    lengths = sorted(np.linalg.norm(there[:, 1] - there[:, 0], axis=1))
    assert len(lengths) == 2
    assert lengths[0] == pytest.approx(0, abs=1e-9)
    assert lengths[1] > 0.05


def test_ticks_are_at_equal_steps_of_t():
    curve = wave(6)
    picture = live(curve, ticks.TICKS, values={ticks.COUNT: 7})
    places = points_of(picture, ticks.TICK)[::2]
    assert places == pytest.approx(view_of(curve).curve.evaluate(np.linspace(0, 1, 8)))


def test_polygons():
    closed = curve_of([(0, 0), (2, 0), (1, 2)], HERMITE, closed=True)
    picture = live(closed, polygon.POLYGON, bezier.BEZIER)
    assert points_of(picture, polygon.SIDES).tolist() == [[0, 0], [2, 0], [1, 2], [0, 0]]
    # Two inner control points a segment, three segments.
    assert points_of(picture, bezier.CONTROL_POINT).shape == (6, 2)


def test_the_bezier_polygon_of_a_parabola_is_drawn_and_a_high_degree_refused():
    picture = settled_picture(view_of(PARABOLA), settings_of(bezier.BEZIER))
    assert points_of(picture, bezier.CONTROL_POINT) == pytest.approx(np.array([(0, -1)]))
    for n in (32, 40):
        refused = settled_picture(view_of(wave(n)), settings_of(bezier.BEZIER))
        assert not refused.figures
        assert refused.notes[bezier.BEZIER].startswith("Not drawn")


def test_marks_of_a_figure_eight():
    t = 2 * np.pi * np.arange(8) / 8
    eight = curve_of(np.column_stack([np.sin(t), np.sin(2 * t)]), QUINTIC_HERMITE, closed=True)
    picture = settled_picture(view_of(eight), settings_of(extrema.EXTREMA))
    crossing = points_of(picture, extrema.CROSSING)
    assert crossing == pytest.approx(np.zeros((1, 2)), abs=1e-6)
    assert "1 crossing." in picture.notes[extrema.EXTREMA]
    # The sharpest bends are outside; in the centre the curve bends the other way.
    assert (np.linalg.norm(points_of(picture, extrema.SHARPEST), axis=1) > 0.4).all()
    assert np.abs(points_of(picture, extrema.INFLECTION)).min() < 1e-6


def test_the_largest_half_width_of_the_band_is_the_lebesgue_constant():
    curve = wave(12)
    note = live(curve, band.BAND, values={POINT_ERROR: 0.01}).notes[band.BAND]
    constant = lebesgue_constant(view_of(curve).curve)
    assert f"Largest half-width {number(0.01 * constant)} at t = 0.0" in note
    assert f"{number(constant)} times ε" in note
    assert live(curve, band.BAND, values={POINT_ERROR: 0.0}).notes[band.BAND].startswith("Both errors are 0")


def windings(polygons, places):
    """How often the polygons of a figure go round each place."""
    total = np.zeros(len(places))
    for part in np.split(polygons, np.flatnonzero(np.isnan(polygons[:, 0]))):
        corners = part[~np.isnan(part[:, 0])]
        if len(corners):
            away = corners - places[:, None]
            angle = np.arctan2(away[..., 1], away[..., 0])
            turn = np.diff(angle, axis=1, append=angle[:, :1])
            total += ((turn + np.pi) % (2 * np.pi) - np.pi).sum(axis=1) / (2 * np.pi)
    return total.round()


@pytest.mark.parametrize("family", FAMILIES)
@pytest.mark.parametrize("epsilon", [0.02, 0.4])
def test_disturbed_curves_stay_inside_the_area_of_the_band(family, epsilon):
    """Also where the band is wider than the curve bends: 0.4 against a smallest radius of 0.1 or so."""
    view = view_of(wave(7, family))
    picture = live_picture(view, settings_of(band.BAND, values={POINT_ERROR: epsilon}))
    area = points_of(picture, band.AREA)
    random = ensemble(view.curve, epsilon, count=12, seed=1, remake=partial(curve_through, view))
    disturbed = random.evaluate(np.linspace(0, 1, 25))
    assert (windings(area, disturbed.reshape(-1, 2)) > 0).all()
    # And it is no larger than it must be: half a width outside there is nothing.
    widest = view.growth * epsilon
    low = view.curve.evaluate(np.linspace(0, 1, 400))[:, 1].min() - 1.5 * widest
    assert windings(area, np.array([[2.0, low]])) == 0


@pytest.mark.parametrize("kind", [UNIFORM, ParametrizationKind.CHORD_LENGTH])
@pytest.mark.parametrize("epsilon", [0.03, 0.1])
def test_the_area_is_the_union_of_all_discs(kind, epsilon):
    """Points just inside the rims of discs are in it, also around a cusp, where discs grow fast."""
    view = view_of(curve_of(S_CURVE, kind=kind))
    area = points_of(live_picture(view, settings_of(band.BAND, values={POINT_ERROR: epsilon})), band.AREA)
    t = np.linspace(0, 1, 45)
    radii = epsilon * lebesgue_function(view.curve, t)
    angle = np.linspace(0, 2 * np.pi, 9)[:-1]
    rim = np.column_stack([np.cos(angle), np.sin(angle)])
    places = view.curve.evaluate(t)[:, None] + 0.95 * radii[:, None, None] * rim
    assert (windings(area, places.reshape(-1, 2)) > 0).all()
    # And not farther than the samples of the drawing see: outside all discs there is nothing.
    t = np.linspace(0, 1, 3000)
    centres, radii = view.curve.evaluate(t), epsilon * lebesgue_function(view.curve, t)
    places = np.random.default_rng(1).uniform((0, -1), (4, 5), (150, 2))
    gaps = (np.linalg.norm(centres - places[:, None], axis=2) - radii).min(axis=1)
    assert ((gaps < 0.1 * radii.max()) | (windings(area, places) == 0)).all()


def test_errors_of_parameters_beyond_the_limit_are_explained():
    settings = settings_of(disturbed.ENSEMBLE, values={POINT_ERROR: 0.01, PARAMETER_ERROR: 0.2})
    picture = settled_picture(view_of(wave(6)), settings)
    assert not picture.figures
    assert picture.notes[disturbed.ENSEMBLE].startswith("Not drawn: δ must be less than half")


def test_the_same_seed_draws_the_same_curves():
    def drawn(seed):
        values = {POINT_ERROR: 0.01, disturbed.SEED: seed, disturbed.COUNT: 5}
        settings = settings_of(disturbed.ENSEMBLE, values=values)
        return points_of(settled_picture(view_of(wave(6)), settings), disturbed.LINES)

    assert np.array_equal(drawn(1), drawn(1), equal_nan=True)
    assert not np.array_equal(drawn(1), drawn(2), equal_nan=True)
    assert np.isnan(drawn(1)[:, 0]).sum() == 5


def test_a_ghost_is_the_curve_of_the_changed_document():
    curve = wave(9, HERMITE, ParametrizationKind.CHORD_LENGTH)
    ghosts = ghost_views(view_of(curve), set(all_ghosts()), {})
    assert [ghost for ghost, shown in ghosts.items() if shown.is_real] == [
        Ghost(family=HERMITE),
        Ghost(kind=ParametrizationKind.CHORD_LENGTH),
    ]
    for ghost, shown in ghosts.items():
        real = view_of(with_ghost_real(Document((curve,)), 0, ghost).curves[0])
        t = np.linspace(*real.curve.domain, 20)
        assert np.array_equal(shown.view.curve.evaluate(t), real.curve.evaluate(t))
    # The views of the frame before lend what stays, and change nothing.
    moved = replace(curve, points=(Point(0.1, 0.2), *curve.points[1:]))
    fresh, lent = (ghost_views(view_of(moved), set(all_ghosts()), old) for old in ({}, ghosts))
    for ghost in all_ghosts():
        assert np.array_equal(fresh[ghost].view.curve.jets, lent[ghost].view.curve.jets)


WILD = {
    "two points": curve_of([(0, 0), (1, 1)]),
    "one place": curve_of([(1, 1)] * 4),
    "one place, Hermite": curve_of([(1, 1)] * 4, HERMITE),
    "straight": curve_of([(x, x) for x in range(5)]),
    "back and forth": curve_of([(0, 0), (1, 0), (0, 0), (1, 0)], HERMITE),
    "far away": curve_of([(1e12, 1e12), (1e12 - 1, 0), (-1e12, 1e12)]),
    "tiny": curve_of([(0, 0), (1e-300, 1e-300), (2e-300, 0)]),
    "runaway": curve_of([(x, (-1) ** x) for x in range(48)]),
    "wild": curve_of([(x, (-1) ** x) for x in range(120)]),
    "closed": curve_of([(0, 0), (1, 0), (1, 1)], QUINTIC_HERMITE, closed=True),
    "thousand": wave(1000, HERMITE),
}


@pytest.mark.parametrize("name", list(WILD))
def test_overlays_of_degenerate_curves_raise_nothing(name):
    view = view_of(WILD[name])
    errors = {POINT_ERROR: 0.01, PARAMETER_ERROR: 1e-6}
    everything = settings_of(*OVERLAYS, values=errors, ghosts=frozenset(all_ghosts()))
    live_picture(view, everything, 0.5)
    settled_picture(view, everything, 0.5)
    assert ghost_views(view, everything.ghosts, {})
    assert usual_error(view) > 0


def test_a_curve_that_is_not_current_shows_nothing():
    broken = view_of(curve_of([(0, 0), (0, 0), (1, 1)], kind=ParametrizationKind.CHORD_LENGTH))
    everything = settings_of(*OVERLAYS, values={POINT_ERROR: 0.01})
    assert not broken.is_current
    assert not live_picture(broken, everything).figures
    assert not settling(broken, everything)


def test_slow_overlays_are_drawn_after_the_drag():
    """Derivatives of a polynomial through 100 points take 26 ms."""
    settings = settings_of(comb.COMB)
    assert settling(view_of(wave(20)), settings) == frozenset()
    long = view_of(wave(100, kind=ParametrizationKind.CHEBYSHEV))
    assert settling(long, settings) == {comb.COMB}
    assert not live_picture(long, settings).figures
    assert settled_picture(long, settings).figures
