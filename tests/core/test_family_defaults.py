"""The promise of the base class: a family says its basis functions and breaks, and gets all else."""

import numpy as np
import pytest

from app.families.family_file import families_in
from curvecore import CurveError, FamilySetting, HermiteCurve, ParametricCurve
from curvecore.families.b_spline import BSplineCurve
from tests.own_families import FILES
from tests.rows import each_row

TENSIONS = (-1.0, 0.0, 0.05, 0.7, 1.0)
U = 2.0**-53


def cardinal_spline_class():
    (path,) = (each for each in FILES if each.stem == "cardinal_spline")
    (family,) = families_in(path)
    return family.curve_class


@pytest.fixture(scope="module")
def cardinal_spline():
    return cardinal_spline_class()


def data(seed, n=7):
    rng = np.random.default_rng(seed)
    return rng.normal(size=(n, 2)), np.cumsum(rng.uniform(0.3, 1.7, n))


def hermite_twin(curve):
    """The same curve from velocities that are computed point by point."""
    p, t, tension = curve.points, curve.parameters, curve.chosen["tension"]
    last = len(p) - 1
    velocities = [
        (1.0 - tension) * (p[min(i + 1, last)] - p[max(i - 1, 0)]) / (t[min(i + 1, last)] - t[max(i - 1, 0)])
        for i in range(len(p))
    ]
    return HermiteCurve(p, velocities, t)


@each_row("tension", TENSIONS)
def test_a_cardinal_spline_is_a_hermite_curve_to_the_third_derivative(cardinal_spline, tension):
    for seed in range(5):
        points, parameters = data(seed)
        curve = cardinal_spline(points, parameters, tension=tension)
        twin = hermite_twin(curve)
        # Outside of the domain the first and the last piece go on.
        t = np.linspace(parameters[0] - 0.2, parameters[-1] + 0.2, 301)
        for order in range(4):
            scale = max(1.0, np.abs(twin.evaluate(t, order)).max())
            assert np.abs(curve.evaluate(t, order) - twin.evaluate(t, order)).max() <= 3e-14 * scale


@each_row("tension", TENSIONS)
def test_bezier_pieces_follow_from_degree_and_breaks(cardinal_spline, tension):
    points, parameters = data(3)
    curve = cardinal_spline(points, parameters, tension=tension)
    pieces, expected = curve.bezier_pieces(), hermite_twin(curve).bezier_pieces()
    assert pieces.shape == expected.shape
    # The condition of values at four Chebyshev points, of which Bernstein coefficients are made, is about 20.
    assert np.abs(pieces - expected).max() <= 40 * U * np.abs(expected).max()
    # Neighbours meet in the points themselves, without a gap.
    assert np.array_equal(pieces[:, 0], points[:-1])
    assert np.array_equal(pieces[:, -1], points[1:])


def test_an_interpolating_curve_passes_its_points_exactly(cardinal_spline):
    for seed in range(5):
        points, parameters = data(seed, 12)
        assert np.array_equal(cardinal_spline(points, parameters)(parameters), points)


def test_real_settings_become_floats_and_belong_to_the_functions(cardinal_spline):
    points, parameters = data(0)
    whole, real = (cardinal_spline(points, parameters, tension=each) for each in (1, 1.0))
    assert type(whole.chosen["tension"]) is float
    assert whole.functions_key == real.functions_key
    assert type(cardinal_spline(points, parameters, tension=np.float32(0.5)).chosen["tension"]) is float
    for wrong in (1.5, float("nan"), float("inf"), True, "0.5", None):
        with pytest.raises(CurveError, match="tension must be a number from -1 to 1, not"):
            cardinal_spline(points, parameters, tension=wrong)


class Growing(ParametricCurve):
    """Functions that leave the range of doubles, of the shape (m, n)."""

    name = title = "growing"
    interpolates = False

    def _basis(self, t, order):
        return np.stack([np.exp(1000.0 * t), np.exp(1000.0 * t) - np.exp(1000.0 * t)], axis=1)


def test_basis_functions_of_shape_m_n_are_of_one_kind():
    curve = Growing([[1.0], [2.0]], [0.0, 1.0])
    assert curve.basis([0.0, 0.5]).shape == (2, 2, 1)
    assert curve.basis(0.0).shape == (2, 1)


def test_numbers_beyond_all_doubles_become_the_largest_one_without_a_warning():
    curve = Growing([[1.0], [2.0]], [0.0, 1.0])
    with np.errstate(all="raise"):
        functions, values = curve.basis([-2.0, 1.0]), curve([-2.0, 1.0])
    assert functions[:, 0, 0].tolist() == [0.0, np.finfo(float).max]
    assert np.isfinite(functions).all()
    assert np.isfinite(values).all()


def test_a_family_without_a_degree_has_no_bezier_pieces():
    assert Growing([[1.0], [2.0]], [0.0, 1.0]).bezier_pieces() is None


class ByItsFunctions(ParametricCurve):
    """The B-spline through its functions and breaks alone."""

    name = title = "by_its_functions"
    interpolates = False

    @property
    def degree(self):
        return min(3, len(self.parameters) - 1)

    @property
    def breaks(self):
        return BSplineCurve(self.points, self.parameters).breaks

    def _basis(self, t, order):
        return BSplineCurve(self.points, self.parameters).basis(t, order)


@each_row("n", (5, 6, 9))
def test_curves_over_control_points_have_bezier_pieces_as_well(n):
    points, parameters = data(n, n)
    pieces = ByItsFunctions(points, parameters).bezier_pieces()
    expected = BSplineCurve(points, parameters).bezier_pieces()
    assert np.abs(pieces - expected).max() <= 40 * U * np.abs(points).max()


def test_one_polynomial_through_all_points_is_not_drawn_by_control_points():
    points, parameters = data(4, 4)
    assert ByItsFunctions(points, parameters).bezier_pieces() is None


@each_row(
    ("arguments", "message"),
    [
        ({"limits": (1.0, 1.0)}, "the limits of x must be finite and ascending"),
        ({"limits": (0.0, float("inf"))}, "the limits of x must be finite and ascending"),
        ({"default": 1, "limits": (0.5, 2)}, "the limits of x must be whole, as its default is"),
        ({"limits": (0.0, 1.0), "step": 0.0}, "the step of x must be above 0"),
    ],
)
def test_settings_that_make_no_sense_are_refused(arguments, message):
    with pytest.raises(CurveError, match=message):
        FamilySetting(**{"name": "x", "title": "x", "default": 0.5, **arguments})
