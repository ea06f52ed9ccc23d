"""Curves of which nothing is known but a basis: all that follows from it, against what is known otherwise."""

import numpy as np
import pytest

from curvecore import (
    BasisCurve,
    Chain,
    CurveError,
    FrozenFlattening,
    LagrangeCurve,
    Scheme,
    arc_length,
    bezier_stretch,
    bounding_box,
    chebyshev,
    cubic_path,
    curvature,
    ensemble,
    flatten_pieces,
    inflections,
    joint_report,
    lebesgue_constant,
    monomial_condition,
    nearest,
    parameter_sensitivity,
    self_intersections,
    uniform,
    worst_case_band,
)
from tests.core.made_curves import core_families, hats
from tests.own_families import cosine_steps
from tests.rows import each_row


def polynomials(t, parameters):
    """The course's product form, with nothing of the core in it."""
    columns = []
    for i, own in enumerate(parameters):
        others = np.delete(parameters, i)
        columns.append(np.prod((t[:, None] - others) / (own - others), axis=1))
    return np.stack(columns, axis=1)


def gaussians(t, parameters):
    """Cardinal combinations of Gaussian bells: no polynomials on any interval."""

    def bells(places):
        return np.exp(-(((places[:, None] - parameters) * len(parameters)) ** 2) / 4.0)

    return bells(t) @ np.linalg.inv(bells(parameters))


def trigonometric(t, parameters, order=0):
    """For two parameters: cosine and sine of a quarter turn, with their derivatives in closed form."""
    angle = 0.5 * np.pi * (t - parameters[0]) / (parameters[-1] - parameters[0])
    speed = (0.5 * np.pi / (parameters[-1] - parameters[0])) ** order
    turn = 0.5 * np.pi * order
    return speed * np.stack((np.cos(angle + turn), np.sin(angle + turn)), axis=1)


POLYNOMIALS = Scheme("polynomials", polynomials)
HATS = Scheme("hats", hats, breaks=lambda parameters: parameters)
GAUSSIANS = Scheme("gaussians", gaussians)
QUARTER = Scheme("quarter turn", trigonometric, has_orders=True)


@pytest.fixture
def points(rng):
    return rng.standard_normal((6, 2))


@pytest.fixture
def twins(points):
    """One polynomial: by what the core knows of it, and by its basis alone."""
    t = np.array([0.0, 0.15, 0.4, 0.55, 0.8, 1.0])
    return LagrangeCurve(points, t), BasisCurve(points, t, POLYNOMIALS)


WHERE = np.linspace(0.01, 0.97, 37)


@pytest.mark.parametrize(
    "kind", [each for each in core_families() if not each.derivatives], ids=lambda kind: kind.name
)
def test_every_family_rebuilt_from_its_functions_is_the_same_curve(kind, points):
    """What the core knows of it besides makes it faster, not another one."""

    def like(parameters):
        return kind(np.zeros((len(parameters), 1)), parameters)

    t = np.array([0.0, 0.15, 0.4, 0.55, 0.8, 1.0])
    scheme = Scheme(
        kind.name,
        lambda places, parameters: like(parameters).basis(places)[:, :, 0],
        breaks=lambda parameters: like(parameters).breaks,
    )
    known, bare = kind(points, t), BasisCurve(points, t, scheme)
    assert bare.passes_points is kind.interpolates
    assert np.abs(bare.evaluate(WHERE) - known.evaluate(WHERE)).max() < 1e-13
    for order, digits in ((1, 8), (2, 6)):
        exact = known.evaluate(WHERE, order)
        # At places that are no breaks: 0.55 of WHERE is one to the last bit for splines.
        clear = np.abs(WHERE[:, None] - known.breaks).min(axis=1) > 1e-9
        found = bare.evaluate(WHERE, order)
        assert np.abs(found - exact)[clear].max() < 10.0**-digits * np.abs(exact).max()
    assert bounding_box(bare).minimum == pytest.approx(bounding_box(known).minimum, abs=1e-7)
    assert arc_length(bare, 1e-6).value == pytest.approx(arc_length(known, 1e-6).value, abs=3e-6)
    assert lebesgue_constant(bare) == pytest.approx(lebesgue_constant(known), rel=1e-6)
    dense = np.linspace(0.0, 1.0, 201)
    pieces = flatten_pieces(bare, 1e-3)
    assert max(_distance(point, pieces.points) for point in known.evaluate(dense)) <= 1e-3


def test_values_and_points(twins):
    known, bare = twins
    assert np.abs(bare.evaluate(WHERE) - known.evaluate(WHERE)).max() < 1e-13
    assert (bare.evaluate(bare.parameters) == bare.points).all()
    assert bare.evaluate(0.3).shape == (2,)
    assert [bare.degree, bare.bezier_pieces(), bare.interpolants()] == [None, None, None]
    assert (bare.with_jets(2.0 * bare.jets).evaluate(WHERE) == 2.0 * bare.evaluate(WHERE)).all()


@pytest.mark.parametrize(("order", "digits"), [(1, 11), (2, 9), (3, 7)])
def test_derivatives_by_differences_of_the_basis(twins, order, digits):
    """Degree 5 is within the stencil's 6: what is left is rounding, u (24 / gap)**order times weights."""
    known, bare = twins
    exact = known.evaluate(WHERE, order)
    assert np.abs(bare.evaluate(WHERE, order) - exact).max() < 10.0**-digits * np.abs(exact).max()


def test_derivatives_of_curves_that_are_no_polynomials(rng):
    t = uniform(9)
    curve = BasisCurve(rng.standard_normal((9, 2)), t, GAUSSIANS)
    step = 1e-4
    for order, error in ((1, 1e-7), (2, 1e-5)):
        lower = [curve.evaluate(WHERE + k * step, order - 1) for k in (-2, -1, 1, 2)]
        slope = (8 * (lower[2] - lower[1]) - (lower[3] - lower[0])) / (12 * step)
        assert np.abs(curve.evaluate(WHERE, order) - slope).max() < error * np.abs(slope).max()


@each_row(("order", "error"), [(1, 1e-12), (2, 2e-9), (3, 4e-6)])
def test_differences_keep_their_digits_far_from_zero(order, error):
    """At t = 1e6 the first derivative was off by 7e-8: the places of the stencil were rounded."""
    t = 1e6 + np.arange(4.0) / 4.0
    curve = BasisCurve([[0.0], [1.0], [3.0], [4.0]], t, Scheme("steps", cosine_steps, lambda t: t))
    share, way = np.array([0.25, 0.5, 0.75]), np.array([1.0, 1.0, 2.0])
    # Of way * sin(pi / 2 share)**2.
    exact = -0.5 * way * np.pi**order * np.cos(np.pi * share + 0.5 * np.pi * order)
    found = curve.evaluate(t[0] + 0.25 * (share + np.array([0.0, 0.0, 1.0])), order)[:, 0] * 0.25**order
    assert np.abs(found - exact).max() < error


def test_derivatives_of_a_scheme_are_used():
    curve = BasisCurve([[1.0, 0.0], [0.0, 1.0]], [2.0, 4.0], QUARTER)
    assert curve.evaluate([3.0], 1)[0] == pytest.approx([-np.sqrt(0.5) * np.pi / 4, np.sqrt(0.5) * np.pi / 4])
    assert curvature(curve, [2.3, 3.9]) == pytest.approx([1.0, 1.0])
    length = arc_length(curve, 1e-8)
    assert length.value == pytest.approx(np.pi / 2, abs=2e-8)
    box = bounding_box(curve)
    assert box.maximum == pytest.approx([1.0, 1.0])
    assert box.minimum == pytest.approx([0.0, 0.0], abs=1e-12)


def test_no_difference_reaches_over_a_break(points):
    """Of hats the slope is that of the chords, to the last digits, up to the joints themselves."""
    t = np.array([0.0, 0.1, 0.4, 0.5, 0.9, 1.0])
    curve = BasisCurve(points, t, HATS)
    assert (curve.breaks == t).all()
    slopes = np.diff(points, axis=0) / np.diff(t)[:, None]
    places = np.concatenate([t[:-1], t[:-1] + 1e-9, t[1:] - 1e-9])
    assert np.abs(curve.evaluate(places, 1) - np.concatenate([slopes] * 3)).max() < 1e-10


def test_joints_of_a_family_with_breaks(points):
    smooth = joint_report(BasisCurve(points, uniform(6), GAUSSIANS))
    assert {joint.label for joint in smooth} == {"C3"}
    hinged = joint_report(BasisCurve(points, uniform(6), HATS))
    assert {joint.label for joint in hinged} == {"C0"}
    slopes = np.diff(points, axis=0) * 5.0
    assert hinged[0].velocity_jump == pytest.approx(slopes[1] - slopes[0], rel=1e-6)


def test_shape(twins):
    known, bare = twins
    assert curvature(bare, WHERE) == pytest.approx(curvature(known, WHERE), rel=1e-5)
    assert bounding_box(bare).minimum == pytest.approx(bounding_box(known).minimum, abs=1e-12)
    assert arc_length(bare, 1e-8).value == pytest.approx(arc_length(known, 1e-8).value, abs=2e-8)
    assert inflections(bare) == pytest.approx(inflections(known), abs=1e-6)
    assert nearest(bare, [0.1, 0.2], 1e-9).distance == pytest.approx(
        nearest(known, [0.1, 0.2], 1e-9).distance, abs=2e-9
    )
    assert self_intersections(bare, 1e-9).parameters == pytest.approx(
        self_intersections(known, 1e-9).parameters, abs=1e-6
    )


def test_growth_of_errors(twins):
    known, bare = twins
    assert lebesgue_constant(bare) == pytest.approx(lebesgue_constant(known), rel=1e-11)
    assert lebesgue_constant(BasisCurve(bare.points, bare.parameters, HATS)) == pytest.approx(1.0)
    exact = parameter_sensitivity(known, WHERE)
    # Differences of order 4 and 3, at steps of 2**-13 of the spacing.
    assert np.abs(parameter_sensitivity(bare, WHERE) - exact).max() < 1e-8 * np.abs(exact).max()
    assert bare.parameter_derivative(2, WHERE) == pytest.approx(exact[:, 2], abs=1e-8 * np.abs(exact).max())
    band = worst_case_band(bare, WHERE, 0.01, 0.002)
    assert band.across == pytest.approx(worst_case_band(known, WHERE, 0.01, 0.002).across, rel=1e-6)
    one, other = (ensemble(each, 0.1, 0.01, count=3, seed=4).evaluate(WHERE) for each in twins)
    assert one == pytest.approx(other, abs=1e-11)


@pytest.mark.parametrize("scheme", [POLYNOMIALS, HATS, GAUSSIANS], ids=lambda scheme: scheme.name)
@pytest.mark.parametrize("tolerance", [1e-2, 1e-4])
def test_polylines_and_cubic_pieces_keep_their_tolerance(points, scheme, tolerance):
    curve = BasisCurve(points, uniform(6), scheme)
    dense = np.linspace(0.0, 1.0, 20_001)
    exact = curve.evaluate(dense)
    pieces = flatten_pieces(curve, tolerance)
    gaps = [_distance(point, pieces.points) for point in exact[::50]]
    assert pieces.reached <= tolerance
    assert max(gaps) <= tolerance
    assert np.isin(curve.breaks, pieces.parameters).all()
    path = cubic_path(curve, tolerance)
    piece = np.clip(np.searchsorted(path.parameters, dense, side="right") - 1, 0, len(path.parameters) - 2)
    s = (dense - path.parameters[piece]) / np.diff(path.parameters)[piece]
    weights = np.stack(((1 - s) ** 3, 3 * s * (1 - s) ** 2, 3 * s**2 * (1 - s), s**3), axis=1)
    followed = np.einsum("mk,mkd->md", weights, path.control_points[piece])
    assert np.hypot(*(followed - exact).T).max() <= tolerance


def _distance(point, polyline):
    start, end = polyline[:-1], polyline[1:]
    chord = end - start
    along = np.clip(((point - start) * chord).sum(axis=1) / np.square(chord).sum(axis=1), 0.0, 1.0)
    return np.hypot(*(start + along[:, None] * chord - point).T).min()


def test_a_dragged_curve_is_followed(points):
    curve = BasisCurve(points, uniform(6), GAUSSIANS)
    frozen = FrozenFlattening(curve, 1e-3)
    moved = points.copy()
    moved[2] += 0.01
    other = curve.with_jets(moved[:, None])
    polyline = frozen.follow(other)
    assert polyline is not None
    gaps = [_distance(point, polyline.points) for point in other.evaluate(np.linspace(0.0, 1.0, 401))]
    assert max(gaps) <= 1e-3


def test_samples_of_other_breaks_do_not_serve(points):
    t = uniform(6)
    frozen = FrozenFlattening(BasisCurve(points, t, HATS), 1e-3)
    shifted = t + np.array([0.0, 0.02, 0.0, 0.0, 0.0, 0.0])
    assert frozen.follow(BasisCurve(points, shifted, HATS)) is None


def test_chains(points):
    t = uniform(6)
    first, second = BasisCurve(points, t, GAUSSIANS), BasisCurve(points[::-1] * 2.0, t + 1.0, GAUSSIANS)
    chain = Chain([first, second])
    assert chain.degree is None
    assert not chain.is_local
    places = np.array([0.3, 0.9, 1.4])
    summed = np.einsum("mir,ird->md", chain.basis(places), chain.jets)
    assert summed == pytest.approx(chain.evaluate(places), abs=1e-13)
    assert joint_report(chain)[4].parametric == -1
    moved = chain.with_data(chain.jets, chain.parameters + 3.0)
    assert moved.evaluate(places + 3.0) == pytest.approx(chain.evaluate(places), abs=1e-12)


def test_functions_that_need_polynomials_refuse_other_curves(points):
    curve = BasisCurve(points, chebyshev(6), GAUSSIANS)
    with pytest.raises(CurveError, match="polynomials whose data are known"):
        bezier_stretch(curve, 0.0, 0.5)
    with pytest.raises(CurveError, match="polynomials whose data are known"):
        monomial_condition(curve)


@each_row(
    ("basis", "message"),
    [
        (lambda t, x: np.zeros((len(t), 1)), r"the basis of wrong must have the shape \(m, n\) = \(3, 3\)"),
        (
            lambda t, x: np.full((len(t), len(x)), np.nan),
            "the basis of wrong is nan at t = 0.0, in function 0",
        ),
        (
            # A pole between the parameters.
            lambda t, x: np.where((t == 0.625)[:, None], np.inf, np.ones((len(t), len(x)))),
            "the basis of wrong is inf at t = 0.625, in function 0",
        ),
        (lambda t, x: "no numbers", "the basis of wrong must be a regular array of real numbers"),
    ],
)
def test_functions_that_make_no_curve(basis, message):
    with pytest.raises(CurveError, match=message):
        BasisCurve([[0, 0], [1, 1], [2, 0]], [0, 0.5, 1], Scheme("wrong", basis))


def test_functions_that_are_no_cardinal_basis_make_a_curve_that_misses_its_points(points):
    """They were refused: function 1 must be 0 at parameter 0, not 1."""
    curve = BasisCurve(points, uniform(6), Scheme("sum", lambda t, x: np.ones((len(t), len(x)))))
    assert curve.interpolates
    assert not curve.passes_points
    assert curve.evaluate(curve.parameters) == pytest.approx(np.tile(points.sum(axis=0), (6, 1)))
    box = bounding_box(curve)
    assert np.hstack([box.minimum, box.maximum]) == pytest.approx(np.tile(points.sum(axis=0), 2))


@pytest.mark.parametrize("breaks", [[0.0, 0.6, 0.4], [[0.0, 1.0]], [0.0, np.inf]])
def test_breaks_that_do_not_increase_are_refused(breaks):
    with pytest.raises(CurveError, match="the breaks of hats must be finite and strictly increasing"):
        BasisCurve([[0, 0], [1, 1], [2, 0]], [0, 0.5, 1], Scheme("hats", hats, breaks=lambda _: breaks))
