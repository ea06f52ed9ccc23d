"""Derivatives, integrals and solutions of curves: against exact fractions, closed forms and SciPy."""

import builtins
import copy
import pickle
from fractions import Fraction

import numpy as np
import pytest
from scipy import interpolate
from scipy.integrate import quad_vec

import curvecore
from curvecore import (
    Antiderivative,
    BasisCurve,
    Chain,
    CurveError,
    Derivative,
    HermiteCurve,
    LagrangeCurve,
    ParametricCurve,
    QuinticHermiteCurve,
    Scheme,
    bounding_box,
    chebyshev,
    flatten,
    uniform,
)
from tests.rows import each_row

U = 2.0**-53
PARAMETERS = np.array([-1.0, -0.5, 0.25, 1.0, 3.0])
T = np.linspace(-1.2, 3.3, 41)


def gaussian(t, parameters, order=0):
    width = 1.5 * (parameters[-1] - parameters[0]) / len(parameters)
    inverse = np.linalg.inv(np.exp(-(((parameters[:, None] - parameters) / width) ** 2)))
    u = (np.asarray(t)[:, None] - parameters) / width
    polynomial = np.polynomial.hermite.hermval(u, [0.0] * order + [1.0]) * (-1.0 / width) ** order
    return polynomial * np.exp(-(u**2)) @ inverse


GAUSSIAN = Scheme("gaussian", gaussian, has_orders=True)


def curves():
    rng = np.random.default_rng(7)
    points, velocities, accelerations = (rng.integers(-64, 64, (5, 2)) / 16.0 for _ in range(3))
    cubic = HermiteCurve(points, velocities, PARAMETERS)
    return {
        "lagrange": LagrangeCurve(points, PARAMETERS),
        "hermite": cubic,
        "quintic": QuinticHermiteCurve(points, velocities, accelerations, PARAMETERS),
        "chain": Chain(
            [
                HermiteCurve(points[:3], velocities[:3], PARAMETERS[:3]),
                HermiteCurve(points[2:], velocities[1:4], PARAMETERS[2:]),
            ]
        ),
        "gaussian": BasisCurve(points, PARAMETERS, GAUSSIAN),
    }


CURVES = curves()
every_curve = pytest.mark.parametrize("name", CURVES)
POLYNOMIALS = [name for name in CURVES if name != "gaussian"]
every_polynomial = pytest.mark.parametrize("name", POLYNOMIALS)


@every_curve
def test_a_call_is_an_evaluation(name):
    curve = CURVES[name]
    assert np.array_equal(curve(T), curve.evaluate(T))
    assert np.array_equal(curve(T, 2), curve.evaluate(T, order=2))
    assert np.isnan(curve(9.0, extrapolate=False)).all()
    assert np.array_equal(curve(4.0, 1, "periodic"), curve.evaluate(0.0, 1))


@every_curve
@each_row("order", [1, 2, 3])
def test_a_derivative_is_a_curve_of_the_same_data(name, order):
    curve = CURVES[name]
    derivative = curve.derivative(order)
    assert np.array_equal(derivative(T), curve(T, order))
    assert np.array_equal(derivative(T, 1), curve(T, order + 1))
    assert derivative.domain == curve.domain
    assert np.array_equal(derivative.breaks, curve.breaks)
    summed = np.einsum("mir,ird->md", derivative.basis(T), derivative.jets)
    assert summed == pytest.approx(derivative(T), rel=1e-11, abs=1e-10)
    assert derivative.degree == (None if curve.degree is None else max(curve.degree - order, 0))
    assert np.array_equal(derivative.derivative()(T), curve(T, order + 1))
    assert not derivative.interpolates


@every_curve
@each_row("shape", [(), (0,), (2, 3), (2, 0)])
def test_derivatives_and_antiderivatives_take_t_of_any_shape(name, shape):
    t = np.linspace(-1.0, 3.0, int(np.prod(shape))).reshape(shape)
    for made in (CURVES[name].derivative(), CURVES[name].antiderivative()):
        assert made(t).shape == (*shape, 2)
        assert made.basis(t).shape[: len(shape)] == shape


@every_curve
def test_other_data_make_the_derivative_of_another_curve(name):
    curve = CURVES[name]
    for made in (curve.derivative(), curve.antiderivative()):
        other = made.with_jets(2.0 * curve.jets)
        assert other(T) == pytest.approx(2.0 * made(T), rel=1e-12, abs=1e-12)
        moved = made.with_data(curve.jets, curve.parameters + 1.0)
        assert moved(T + 1.0) == pytest.approx(made(T), rel=1e-8, abs=1e-8)


@every_curve
def test_derivative_and_antiderivative_undo_each_other(name):
    curve = CURVES[name]
    assert curve.derivative(0) is curve
    assert curve.antiderivative(0) is curve
    assert curve.antiderivative().derivative() is curve
    assert np.array_equal(curve.antiderivative().derivative(3)(T), curve(T, 2))
    if name == "chain":
        return
    again = curve.derivative().antiderivative()
    assert again(T) == pytest.approx(curve(T) - curve(curve.domain[0]), rel=1e-10, abs=1e-10)


@every_polynomial
def test_pieces_of_derivative_and_antiderivative_match_scipy(name):
    curve = CURVES[name]
    polynomial = curve.to_bpoly()
    for order in (1, 2):
        for mine, theirs in (
            (curve.derivative(order), polynomial.derivative(order)),
            (curve.antiderivative(order), polynomial.antiderivative(order)),
        ):
            expected = theirs(T)
            assert mine(T) == pytest.approx(expected, rel=1e-11, abs=1e-11 * np.abs(expected).max())
            assert mine.to_bpoly()(T) == pytest.approx(
                expected, rel=1e-11, abs=1e-10 * np.abs(expected).max()
            )


def test_the_integral_of_a_polynomial_is_exact_but_for_rounding(exact):
    """The product form and a rule of n / 2 points keep u sum |L_i| |p_i|, for any parameters."""
    rng = np.random.default_rng(5)
    for n in (2, 5, 9, 16):
        for parameters in exact.parameter_sets(n, rng).values():
            if parameters[-1] - parameters[0] > 1e100 or parameters[-1] - parameters[0] < 1e-100:
                continue
            points = rng.integers(-64, 64, (n, 1)) / 16.0
            curve = LagrangeCurve(points, parameters)
            first, last = curve.domain
            true = sum(
                Fraction(float(p)) * each
                for p, each in zip(points[:, 0], exact_integrals(parameters), strict=True)
            )
            t = np.linspace(first, last, 400)
            scale = (np.abs(curve.basis(t)[:, :, 0]) @ np.abs(points)).mean() * (last - first)
            # What t itself is rounded to moves the places of the rule.
            slope = np.abs(curve(t, 1)).mean() * (last - first) * max(abs(first), abs(last))
            bound = 60 * U * (scale + slope)
            assert abs(Fraction(float(curve.integrate(first, last)[0])) - true) <= bound
            assert abs(Fraction(float(curve.antiderivative()(last)[0])) - true) <= bound


def exact_integrals(parameters):
    """The integrals of all L_i over the domain, in fractions."""
    t = [Fraction(float(each)) for each in parameters]
    for i, own in enumerate(t):
        powers, below = [Fraction(1)], Fraction(1)
        for j, other in enumerate(t):
            if j != i:
                # In powers of t - t_0, which is 0 at the beginning.
                place = other - t[0]
                powers = [
                    (powers[k - 1] if k else 0) - place * (powers[k] if k < len(powers) else 0)
                    for k in range(len(powers) + 1)
                ]
                below *= own - other
        end = t[-1] - t[0]
        yield sum(c * end ** (k + 1) / (k + 1) for k, c in enumerate(powers)) / below


@every_curve
@each_row(("a", "b"), [(-1.0, 3.0), (-0.75, 0.3), (0.5, 0.5), (2.0, -0.2), (0.3, 0.3 + 1e-9)])
def test_integrals_between_two_parameters(name, a, b):
    curve = CURVES[name]
    low, high = min(a, b), max(a, b)
    points = [each for each in PARAMETERS if low < each < high]
    expected, _ = quad_vec(curve, low, high, points=points, epsabs=1e-13, epsrel=1e-13)
    assert curve.integrate(low, high) == pytest.approx(expected, rel=1e-11, abs=1e-11 * (high - low))
    assert np.array_equal(curve.integrate(b, a), -curve.integrate(a, b))


@every_polynomial
@each_row(("a", "b"), [(-2.0, 0.0), (2.5, 4.0), (-3.0, 5.0), (3.5, 4.5), (-9.25, 13.5), (3.0, 7.0)])
@each_row("extrapolate", [True, False, "periodic"])
def test_integrals_outside_the_domain_match_scipy(name, a, b, extrapolate):
    curve = CURVES[name]
    expected = curve.to_ppoly().integrate(a, b, extrapolate=extrapolate)
    assert curve.integrate(a, b, extrapolate) == pytest.approx(expected, rel=1e-10, abs=1e-10, nan_ok=True)


def test_a_short_stretch_is_no_difference_of_long_integrals():
    """From the antiderivative, 9 digits of this are lost."""
    curve = LagrangeCurve([[1e6], [1e6], [1.0]], [0, 1, 2])
    a, b = 1.5, 1.5 + 2.0**-30
    assert curve.integrate(a, b)[0] == pytest.approx(float(curve(0.5 * (a + b))[0]) * (b - a), rel=1e-15)


def test_the_integral_of_no_polynomial_keeps_thirteen_digits():
    """Runge's function through its own cardinal function: its integral is an arc tangent."""

    def runge(t, parameters):
        own = 1.0 / (1.0 + 25.0 * t**2)
        other = (t - parameters[0]) / (parameters[1] - parameters[0])
        return np.stack((own * (1 - other), own * other), axis=1)

    class Runge(BasisCurve):
        __slots__ = ()
        interpolates = False
        scheme = Scheme("runge", runge)

    curve = Runge([[1.0], [1.0]], [-1.0, 1.0])
    assert curve.integrate(-1.0, 1.0)[0] == pytest.approx(0.4 * np.arctan(5.0), rel=1e-13)
    t = np.linspace(-1.0, 1.0, 33)
    expected = 0.2 * (np.arctan(5.0 * t) + np.arctan(5.0))
    assert curve.antiderivative()(t)[:, 0] == pytest.approx(expected, rel=1e-13, abs=1e-14)


def test_a_polynomial_of_high_degree_is_integrated_in_parts():
    n = 300
    t = 2.0 * chebyshev(n) - 1.0
    curve = LagrangeCurve(np.cos(40.0 * t)[:, None], t)
    assert curve.integrate(-1.0, 0.5)[0] == pytest.approx((np.sin(20.0) + np.sin(40.0)) / 40.0, abs=1e-13)
    assert curve.antiderivative()(0.5)[0] == pytest.approx((np.sin(20.0) + np.sin(40.0)) / 40.0, abs=1e-13)


# Solutions


@every_polynomial
@pytest.mark.parametrize("axis", [0, 1])
def test_solutions_match_scipy(name, axis):
    curve = CURVES[name]
    polynomial = curve.to_ppoly()
    lowest, highest = (bound[axis] for bound in bounding_box(curve)[:2])
    count = 0
    for value in np.linspace(lowest, highest, 13)[1:-1]:
        expected = np.sort(polynomial.solve(value, extrapolate=False)[axis])
        found = curve.solve(value, axis)
        assert found == pytest.approx(expected, rel=1e-9, abs=1e-9)
        count += len(found)
    assert count >= 11


@every_curve
@pytest.mark.parametrize("axis", [0, 1])
def test_solutions_solve_and_are_complete(name, axis, rng):
    curve = CURVES[name]
    fine = np.linspace(*curve.domain, 20001)
    values = curve(fine)[:, axis]
    rounding = 60 * U * np.abs(curve(fine)).max() * (1 + np.abs(curve(fine, 1)).max())
    for value in rng.uniform(values.min(), values.max(), 20):
        found = curve.solve(value, axis)
        assert np.abs(curve(found)[:, axis] - value).max() <= rounding
        assert len(found) == np.count_nonzero(np.diff(np.sign(values - value)))
        assert (np.diff(found) > 0.0).all()


def test_roots_at_joints_at_ends_and_where_the_curve_only_touches():
    points = [[0.0], [1.0], [0.0], [1.0], [0.0]]
    slopes = [[1.0], [0.0], [0.0], [0.0], [-1.0]]
    curve = HermiteCurve(points, slopes, [0, 1, 2, 3, 4])
    assert curve.roots().tolist() == [0.0, 2.0, 4.0]
    assert curve.solve(1.0).tolist() == [1.0, 3.0]
    parabola = LagrangeCurve([[0.25], [0.0], [0.25]], [0.0, 0.5, 1.0])
    assert parabola.roots().tolist() == [0.5]
    assert parabola.solve(-1e-15).tolist() == []
    assert parabola.solve(1e-12) == pytest.approx([0.5 - 1e-6, 0.5 + 1e-6], abs=1e-10)


def test_a_triple_root_is_listed_once():
    t = np.array([0.0, 0.3, 0.6, 1.0])
    curve = LagrangeCurve(((t - 0.5) ** 3)[:, None], t)
    assert curve.roots() == pytest.approx([0.5], abs=1e-5)


def test_a_coordinate_that_stays_is_given_by_the_ends_of_the_stretch():
    points = [[0.0], [1.0], [1.0], [1.0], [3.0]]
    curve = HermiteCurve(points, np.zeros((5, 1)), [0, 1, 2, 3, 4])
    assert curve.solve(1.0).tolist() == [1.0, 3.0]
    whole = LagrangeCurve([[2.0, 0.0], [2.0, 1.0]], [0.0, 1.0])
    assert whole.solve(2.0).tolist() == [0.0, 1.0]
    assert whole.solve(2.5).tolist() == []


def test_a_jump_across_the_value_counts_on_request():
    """c'' of a cubic Hermite curve jumps at its joints, as of SciPy's."""
    curve = HermiteCurve([[0.0], [1.0], [0.0]], [[0.0], [0.0], [0.0]], [0, 1, 2]).derivative(2)
    kinked = HermiteCurve([[0.0], [0.0], [0.0]], [[1.0], [0.5], [-1.0]], [0, 1, 2]).derivative(2)
    for each in (curve, kinked):
        theirs = each.to_ppoly()
        for discontinuity in (True, False):
            expected = np.sort(theirs.roots(discontinuity, extrapolate=False)[0])
            assert each.roots(0, discontinuity) == pytest.approx(expected, abs=1e-12)
    step = Chain([LagrangeCurve([[-1.0], [-2.0]], [0, 1]), LagrangeCurve([[2.0], [1.0]], [1, 2])])
    assert step.roots().tolist() == [1.0]
    assert step.roots(discontinuity=False).tolist() == []


def test_derivatives_of_curves_with_kinks_are_solved_on_both_sides():
    """At a break the piece behind it counts: a polygon's slope was followed by 300 wild pieces."""

    def hats(t, parameters, order):
        piece = np.clip(np.searchsorted(parameters, t, side="right") - 1, 0, len(parameters) - 2)
        rows, h = np.arange(len(t)), np.diff(parameters)[piece]
        s = (t - parameters[piece]) / h
        result = np.zeros((len(t), len(parameters)))
        result[rows, piece] = (1.0 - s, -1.0 / h)[order] if order < 2 else 0.0
        result[rows, piece + 1] = (s, 1.0 / h)[order] if order < 2 else 0.0
        return result

    scheme = Scheme("hats", hats, lambda parameters: parameters, has_orders=True)
    polygon = BasisCurve([[0.0], [4.0], [0.0], [1.0]], [0, 1, 2, 4], scheme)
    slope = polygon.derivative()
    assert slope.roots().tolist() == [1.0, 2.0]
    assert slope.roots(discontinuity=False).tolist() == []
    assert slope.solve(0.5, discontinuity=False).tolist() == [2.0, 4.0]
    assert bounding_box(slope)[:2] == pytest.approx(np.array([[-4.0], [4.0]]), rel=1e-9)
    line = LagrangeCurve([[0.0], [2.0]], [0, 1]).derivative()
    assert line.solve(2.0).tolist() == [0.0, 1.0]


def test_one_coordinate_far_larger_than_another_hides_nothing():
    t = uniform(5)
    curve = LagrangeCurve(np.column_stack([1e12 * t, (t - 0.25) * (t - 0.75) * 1e-9]), t)
    assert curve.roots(1) == pytest.approx([0.25, 0.75], abs=1e-12)


def test_a_wild_polynomial_keeps_the_roots_of_its_quiet_middle():
    """40 uniform points: 1e9 high at the ends, and no extremum in the middle counts as a root for that."""
    n = 40
    t = uniform(n)
    curve = LagrangeCurve(np.where(np.arange(n) % 2, 1.0, 1.000001)[:, None], t)
    middle = curve.solve(1.0)
    middle = middle[(middle > 0.4) & (middle < 0.6)]
    fine = np.linspace(0.4, 0.6, 20001)
    assert len(middle) == np.count_nonzero(np.diff(np.sign(curve(fine)[:, 0] - 1.0)))


@each_row("shift", [0.0, 1e6, -1e150, 1e-300])
def test_values_out_of_reach_have_no_solutions(shift):
    curve = LagrangeCurve([[0.0], [1.0], [0.5]], [0, 1, 2])
    assert curve.solve(3.0 + abs(shift)).tolist() == []
    assert curve.solve(-3.0 - abs(shift)).tolist() == []


@pytest.mark.parametrize("scale", [1e-200, 1e200])
def test_solutions_do_not_depend_on_the_scale(scale):
    curve = LagrangeCurve(scale * np.array([[0.0], [1.0], [0.5]]), [0, 1, 2])
    assert curve.solve(0.25 * scale) == pytest.approx(
        LagrangeCurve([[0.0], [1.0], [0.5]], [0, 1, 2]).solve(0.25)
    )


@each_row(
    ("ask", "message"),
    [
        (lambda c: c.derivative(-1), "order must be at least 0"),
        (lambda c: c.antiderivative(1.5), "order must be an integer"),
        (lambda c: Derivative(c, 0), "order must be at least 1"),
        (lambda c: c.solve(np.nan), "value is nan"),
        (lambda c: c.solve(0.0, 2), "axis must be less than 2"),
        (lambda c: c.roots(-1), "axis must be at least 0"),
        (lambda c: c.integrate(0.0, np.inf), "b is inf"),
        (lambda c: c.integrate(0.0, 1.0, "never"), "extrapolate must be"),
    ],
)
def test_refusals(ask, message):
    with pytest.raises(CurveError, match=message):
        ask(CURVES["hermite"])


# As curves like others


@every_curve
def test_derivatives_are_drawn_and_measured_like_any_curve(name):
    hodograph = CURVES[name].derivative()
    box = bounding_box(hodograph)
    t = np.linspace(*hodograph.domain, 2000)
    low, high = hodograph(t).min(axis=0), hodograph(t).max(axis=0)
    size = np.ptp(hodograph(t))
    assert [*box.minimum, *box.maximum] == pytest.approx([*low, *high], abs=2e-3 * size)
    polyline = flatten(hodograph, 1e-3 * size)
    nearest = (
        np.abs(polyline[:, None] - hodograph(np.linspace(*hodograph.domain, 4000))).sum(axis=2).min(axis=1)
    )
    assert nearest.max() <= 1e-2 * size


@every_curve
def test_copies_and_pickles_of_derivatives_are_read_only(name):
    for made in (Derivative(CURVES[name]), Antiderivative(CURVES[name])):
        made(T)
        assert copy.deepcopy(made) is made
        other = pickle.loads(pickle.dumps(made)) if name != "gaussian" else made
        assert np.array_equal(other(T), made(T))
        assert not other.jets.flags.writeable


# SciPy's objects


@every_polynomial
def test_scipy_objects_are_the_curve(name):
    curve = CURVES[name]
    for polynomial in (curve.to_bpoly(), curve.to_ppoly()):
        for order in (0, 1, 2):
            expected = curve(T, order)
            assert polynomial(T, order) == pytest.approx(
                expected, rel=1e-10, abs=1e-10 * np.abs(expected).max()
            )
        assert np.array_equal(polynomial.x, curve.breaks)


@each_row("name", ["lagrange", "hermite", "quintic"])
@each_row("form", ["to_bpoly", "to_ppoly"])
def test_there_and_back_is_the_same_curve(name, form):
    curve = CURVES[name]
    again = type(curve).from_bpoly(getattr(curve, form)())
    assert again(T) == pytest.approx(curve(T), rel=1e-12, abs=1e-11)
    if name != "lagrange":
        assert again.jets == pytest.approx(curve.jets, rel=1e-9, abs=1e-11)


def test_splines_of_scipy_are_hermite_curves(rng):
    x, y = PARAMETERS, rng.standard_normal((5, 3))
    for spline in (
        interpolate.CubicSpline(x, y),
        interpolate.PchipInterpolator(x, y),
        interpolate.Akima1DInterpolator(x, y),
        interpolate.CubicHermiteSpline(x, y, y),
    ):
        curve = HermiteCurve.from_bpoly(spline)
        inside = np.linspace(-1.0, 3.0, 41)
        assert curve(inside) == pytest.approx(spline(inside), rel=1e-11, abs=1e-11)
    assert QuinticHermiteCurve.from_bpoly(interpolate.CubicSpline(x, y))(T) == pytest.approx(
        interpolate.CubicSpline(x, y)(T), rel=1e-11, abs=1e-11
    )


@each_row(
    ("family", "polynomial", "message"),
    [
        (HermiteCurve, CURVES["quintic"], "must be a curve of hermite, which through its values differs"),
        (LagrangeCurve, CURVES["hermite"], "must be a curve of lagrange"),
        (QuinticHermiteCurve, CURVES["hermite"], "must be a curve of quintic_hermite"),
        (HermiteCurve, None, "polynomial must be a BPoly or PPoly of SciPy's, not NoneType"),
        (
            HermiteCurve,
            interpolate.BPoly([[1.0], [1.0]], [1.0, 0.0]),
            "parameters must be strictly increasing",
        ),
        (HermiteCurve, interpolate.BPoly(np.ones((2, 1, 2, 2)), [0.0, 1.0]), r"the shape \(\) or \(dim,\)"),
        (
            HermiteCurve,
            interpolate.BPoly([[1.0], [1.0j]], [0.0, 1.0]),
            "must be a regular array of real numbers",
        ),
    ],
)
def test_polynomials_of_another_kind_are_refused(family, polynomial, message):
    given = polynomial.to_bpoly() if hasattr(polynomial, "to_bpoly") else polynomial
    with pytest.raises(CurveError, match=message):
        family.from_bpoly(given)


def test_a_curve_that_is_no_polynomial_has_no_bpoly():
    with pytest.raises(CurveError, match="cubic_path approximates others"):
        CURVES["gaussian"].to_bpoly()
    with pytest.raises(CurveError, match="polynomials of a moderate degree"):
        LagrangeCurve(np.zeros((65, 1)), uniform(65)).to_bpoly()


def test_without_scipy_the_error_names_the_missing_package(monkeypatch):
    plain = builtins.__import__

    def without(name, *arguments, **keywords):
        if name.startswith("scipy"):
            raise ModuleNotFoundError(name)
        return plain(name, *arguments, **keywords)

    monkeypatch.setattr(builtins, "__import__", without)
    curve = CURVES["hermite"]
    for ask in (curve.to_bpoly, curve.to_ppoly, lambda: HermiteCurve.from_bpoly(None)):
        with pytest.raises(ImportError, match="SciPy, which is not installed: pip install scipy"):
            ask()
    assert curve.derivative()(0.0).shape == (2,)


# Every family, whichever there are

FAMILIES = [
    each
    for each in (getattr(curvecore, name) for name in curvecore.__all__)
    if isinstance(each, type)
    and issubclass(each, ParametricCurve)
    and isinstance(vars(each).get("name"), str)
]


@pytest.fixture(params=FAMILIES, ids=lambda each: each.name)
def of_any_family(request, rng):
    jets = rng.standard_normal((7, request.param.derivatives + 1, 2))
    return request.param.from_jets(jets, np.cumsum(rng.uniform(0.2, 0.6, 7)))


def test_a_curve_of_any_family_is_integrated(of_any_family):
    curve = of_any_family
    a, b = curve.domain
    expected, _ = quad_vec(curve, a, b, points=curve.parameters[1:-1], epsabs=1e-12, epsrel=1e-12)
    assert curve.integrate(a, b) == pytest.approx(expected, rel=1e-10, abs=1e-10)
    assert curve.antiderivative()(b) == pytest.approx(expected, rel=1e-10, abs=1e-10)


@pytest.mark.parametrize("order", [0, 1])
def test_a_curve_of_any_family_is_solved(of_any_family, order):
    curve = of_any_family.derivative(order)
    fine = np.linspace(*curve.domain, 20001)
    values = curve(fine)
    for axis in (0, 1):
        # Between values of samples, so that no sample is a solution.
        value = 0.3 * values[:, axis].min() + 0.7 * values[:, axis].max() + 1e-9
        found = curve.solve(value, axis)
        assert len(found) == np.count_nonzero(np.diff(np.sign(values[:, axis] - value)))
        # A jump of the derivative at a break crosses the value and does not take it.
        inside = found[~np.isin(found, curve.breaks)]
        assert np.abs(curve(inside)[:, axis] - value).max(initial=0.0) <= 1e-10 * np.abs(values).max()


def test_a_curve_of_any_family_of_polynomials_converts_to_scipy_and_back(of_any_family):
    curve = of_any_family
    t = np.linspace(*curve.domain, 101)
    if curve.degree is None:
        with pytest.raises(CurveError, match="cubic_path approximates others"):
            curve.to_bpoly()
        return
    for polynomial in (curve.to_bpoly(), curve.to_ppoly()):
        assert polynomial(t) == pytest.approx(curve(t), rel=1e-8, abs=1e-8)
        assert type(curve).from_bpoly(polynomial)(t) == pytest.approx(curve(t), rel=1e-8, abs=1e-8)


def test_equal_curves_of_any_family_are_equal(of_any_family):
    curve = of_any_family
    curve(0.5)
    again = type(curve).from_jets(curve.jets, curve.parameters)
    assert again == curve
    assert hash(again) == hash(curve)
    assert pickle.loads(pickle.dumps(curve)) == curve
    assert curve.with_jets(2.0 * curve.jets) != curve
    assert repr(curve).startswith(f"{type(curve).__name__}(n=7, dim=2, domain=(")
