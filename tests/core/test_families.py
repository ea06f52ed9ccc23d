"""What holds for every family: the contract of `ParametricCurve`."""

import numpy as np
import pytest

from app.families import FAMILIES
from curvecore import CurveError, HermiteCurve, chebyshev, uniform
from tests.rows import each_row

PARAMETERS = np.array([-1.0, -0.5, 0.25, 1.0, 3.0])
T = np.linspace(-1.2, 3.3, 41)
U = 2.0**-53


def build(family, rng, n=5, parameters=PARAMETERS, dim=2):
    data = [rng.standard_normal((n, dim)) for _ in range(CLASSES[family].derivatives + 1)]
    return CLASSES[family](*data, parameters)


CLASSES = {
    family.name: type(family.make(np.zeros((2, family.derivatives + 1, 1)), [0.0, 1.0]))
    for family in FAMILIES
}
"""The classes of all built-in families."""
POLYNOMIALS = [name for name, each in CLASSES.items() if each.is_one_polynomial or each.derivatives]
"""Those whose pieces have the degree that their data determine: they reproduce cubics, and refuse no data."""
every_family = pytest.mark.parametrize("family", CLASSES)
every_interpolant = pytest.mark.parametrize(
    "family", [name for name in CLASSES if CLASSES[name].interpolates]
)
every_polynomial = pytest.mark.parametrize("family", POLYNOMIALS)


def width_of(family):
    return CLASSES[family].derivatives + 1


@every_family
def test_attributes(family, rng):
    curve = build(family, rng)
    width = width_of(family)
    assert curve.points.shape == (5, 2)
    assert curve.jets.shape == (5, width, 2)
    assert (curve.jets[:, 0] == curve.points).all()
    assert curve.domain == (-1.0, 3.0)
    degrees = {"lagrange": 4, "hermite": 3, "quintic_hermite": 5, "septic_hermite": 7, "cubic_spline": 3}
    assert curve.degree == degrees.get(family, curve.degree)
    for array in (curve.points, curve.parameters, curve.jets):
        assert not array.flags.writeable


@every_family
def test_inputs_are_copied(family, rng):
    parameters = PARAMETERS.copy()
    curve = build(family, rng, parameters=parameters)
    before = curve.evaluate(T)
    parameters[0] = -7.0
    assert (curve.evaluate(T) == before).all()


@every_interpolant
def test_a_curve_passes_its_points_exactly(family, rng):
    for parameters in (PARAMETERS, PARAMETERS * 1e150, PARAMETERS * 1e-150, 1e6 + PARAMETERS, PARAMETERS / 3):
        curve = build(family, rng, parameters=parameters)
        assert (curve.evaluate(parameters) == curve.points).all()
        assert (curve.evaluate(np.append(parameters, parameters[-1] + 1.0))[:-1] == curve.points).all()
        assert (curve.evaluate(parameters[2]) == curve.points[2]).all()


@every_polynomial
@each_row("size", [1e-300, 1e300, 1.7e308])
def test_a_curve_passes_extreme_points_exactly(family, size):
    points = size * np.array([[1.0, -1.0], [1.0, 1.0], [1.0, -0.25], [1.0, 0.5], [1.0, 0.0]])
    data = [points, *[np.zeros_like(points)] * (width_of(family) - 1)]
    curve = CLASSES[family](*data, PARAMETERS)
    assert (curve.evaluate(PARAMETERS) == points).all()
    for order in range(4):
        assert np.isfinite(curve.evaluate(T, order)).all()


@every_family
def test_shapes(family, rng):
    curve = build(family, rng)
    width = width_of(family)
    assert curve.evaluate(0.3).shape == (2,)
    assert curve.evaluate([0.3]).shape == (1, 2)
    assert curve.evaluate([]).shape == (0, 2)
    assert curve.evaluate(T).shape == (41, 2)
    assert curve.evaluate(T).flags.c_contiguous
    assert curve.basis(T).shape == (41, 5, width)
    assert curve.basis(0.3).shape == (5, width)
    assert curve.basis([]).shape == (0, 5, width)
    assert build(family, rng, dim=1).evaluate(T).shape == (41, 1)
    assert build(family, rng, dim=4).evaluate(T).shape == (41, 4)


@every_family
@each_row("shape", [(), (1,), (0,), (2, 3), (3, 1, 2), (2, 0)])
@each_row("order", [0, 2])
def test_parameters_of_any_shape_lead_the_shape_of_the_result(family, rng, shape, order):
    curve = build(family, rng)
    t = rng.uniform(-0.2, 1.2, shape)
    for method in (curve.evaluate, curve.basis):
        result = method(t, order)
        one_by_one = [method(float(each), order) for each in t.ravel()]
        assert result.shape == (*shape, *method(0.5, order).shape)
        # Sums of a matrix product in another order.
        assert np.ravel(result) == pytest.approx(np.ravel(one_by_one), rel=1e-12, abs=1e-11)
        assert result.flags.writeable


@every_family
def test_parameters_in_any_memory_order_keep_their_indices(family, rng):
    curve = build(family, rng)
    t = np.asfortranarray(rng.uniform(0.0, 1.0, (4, 3)))
    assert curve.evaluate(t)[2, 1] == pytest.approx(curve.evaluate(t[2, 1]), rel=1e-12)
    assert curve.evaluate(t.T)[1, 2] == pytest.approx(curve.evaluate(t[2, 1]), rel=1e-12)


@every_family
@each_row("order", [0, 1])
def test_outside_the_domain_a_curve_is_extended_cut_or_periodic(family, rng, order):
    curve = build(family, rng)
    first, last = curve.domain
    t = np.array([[first - 0.5, first, 0.3], [last, last + 0.25, 0.7]])
    assert np.array_equal(curve.evaluate(t, order, True), curve.evaluate(t, order))
    ended = curve.evaluate(t, order, extrapolate=False)
    outside = (t < first) | (t > last)
    assert np.isnan(ended[outside]).all()
    assert ended[~outside] == pytest.approx(curve.evaluate(t, order)[~outside], rel=1e-12)
    repeated = curve.evaluate(t, order, extrapolate="periodic")
    inside = [[last - 0.5, first, 0.3], [first, first + 0.25, 0.7]]
    assert repeated == pytest.approx(curve.evaluate(inside, order), rel=1e-12, abs=1e-12)
    assert np.isnan(curve.evaluate(last + 1.0, extrapolate=False)).all()


@every_interpolant
def test_a_period_that_rounding_fills_up_stays_inside_the_domain(family, rng):
    curve = build(family, rng)
    first, last = curve.domain
    for t in (first - 1e-300, np.nextafter(first, -np.inf), last - 1e-17, first + 7 * (last - first)):
        value = curve.evaluate(t, extrapolate="periodic")
        ends = np.abs(value - curve.points[[0, -1]]).max(axis=1)
        assert ends.min() <= 1e-13


@each_row("wrong", ["Periodic", None, 1, "no"])
def test_unknown_values_of_extrapolate_are_refused(rng, wrong):
    curve = build("lagrange", rng)
    with pytest.raises(CurveError, match=r"extrapolate must be True, False or 'periodic', not"):
        curve.evaluate([0.5], extrapolate=wrong)


@every_family
@each_row("order", range(7))
def test_basis_times_data_is_the_curve(family, rng, order):
    curve = build(family, rng)
    basis = curve.basis(T, order)
    expected = np.einsum("mir,ird->md", basis, curve.jets)
    scale = np.einsum("mir,ird->md", np.abs(basis), np.abs(curve.jets))
    # Both sides obey the accuracy bound with c <= 10 for these five points.
    assert (np.abs(curve.evaluate(T, order) - expected) <= 20.0 * U * scale).all()
    if curve.degree is not None and order > curve.degree:
        assert not basis.any()
        assert not curve.evaluate(T, order).any()


@every_family
@each_row("order", range(4))
def test_partition_of_unity(family, rng, order):
    basis = build(family, rng).basis(T, order)[:, :, 0]
    expected = 1.0 if order == 0 else 0.0
    assert (np.abs(basis.sum(axis=1) - expected) <= 20.0 * U * np.abs(basis).sum(axis=1)).all()


@every_interpolant
def test_end_conditions(family, rng):
    curve = build(family, rng)
    width = width_of(family)
    for order in range(width):
        basis = curve.basis(PARAMETERS, order)
        for r in range(width):
            expected = np.eye(5) if r == order else np.zeros((5, 5))
            # Powers of h are at most 2 here; each function is that accurate relative to 1.
            assert np.abs(basis[:, :, r] - expected).max() <= 20.0 * U


@every_family
def test_affine_invariance(family, rng):
    """A x + b of the points (A x of the derivatives) moves the curve likewise."""
    curve = build(family, rng)
    matrix, shift = rng.standard_normal((2, 2)), rng.standard_normal(2)
    jets = curve.jets @ matrix.T
    jets[:, 0] += shift
    moved = curve.with_jets(jets)
    size = np.einsum("mir,ird->md", np.abs(curve.basis(T)), np.abs(curve.jets)) @ np.abs(matrix.T)
    size += np.abs(shift) * np.abs(curve.basis(T)[:, :, 0]).sum(axis=1)[:, None]
    expected = curve.evaluate(T) @ matrix.T + shift
    assert (np.abs(moved.evaluate(T) - expected) <= 40.0 * U * size).all()


@every_polynomial
def test_reproduces_polynomials(family):
    """Data of a cubic give that cubic, outside the domain too."""
    cubic = np.polynomial.Polynomial([1.0, -2.0, 0.5, 0.25])
    width = width_of(family)
    data = [(cubic.deriv(r) if r else cubic)(PARAMETERS)[:, None] for r in range(width)]
    curve = CLASSES[family](*data, PARAMETERS)
    for order in range(4):
        scale = np.einsum("mir,ird->md", np.abs(curve.basis(T, order)), np.abs(curve.jets))[:, 0]
        expected = (cubic.deriv(order) if order else cubic)(T)
        assert (np.abs(curve.evaluate(T, order)[:, 0] - expected) <= 40.0 * U * scale + 1e-14).all()


@every_family
def test_derivatives_are_derivatives(family, rng):
    """Central differences converge with order 2: a tenth of the step, a hundredth of the error."""
    curve = build(family, rng)
    t = np.array([-0.8, -0.2, 0.6, 2.2])
    for order in range(3):
        errors = []
        for step in (1e-2, 1e-3):
            slope = (curve.evaluate(t + step, order) - curve.evaluate(t - step, order)) / (2.0 * step)
            errors.append(np.abs(slope - curve.evaluate(t, order + 1)).max())
        assert errors[1] <= 0.011 * errors[0] + 1e-10


@every_family
def test_with_jets(family, rng):
    curve = build(family, rng)
    other = build(family, rng)
    replaced = curve.with_jets(other.jets)
    assert type(replaced) is type(curve)
    assert replaced.parameters is curve.parameters
    assert (replaced.evaluate(T) == other.evaluate(T)).all()
    assert (replaced.evaluate(T, 1) == other.evaluate(T, 1)).all()
    assert not replaced.jets.flags.writeable


@every_family
def test_unordered_and_repeated_parameters(family, rng):
    curve = build(family, rng)
    t = rng.permutation(np.concatenate((T, T)))
    single = np.array([curve.evaluate(x) for x in t])
    scale = np.einsum("mir,ird->md", np.abs(curve.basis(t)), np.abs(curve.jets))
    assert (np.abs(curve.evaluate(t) - single) <= 20.0 * U * scale).all()


def test_many_ascending_parameters_take_the_same_segments(rng):
    parameters = np.sort(rng.random(300))
    curve = build("hermite", rng, 300, parameters)
    ascending = np.sort(np.concatenate((rng.uniform(parameters[0], parameters[-1], 20_000), parameters)))
    shuffled = rng.permutation(ascending.size)
    assert (curve.evaluate(ascending)[shuffled] == curve.evaluate(ascending[shuffled])).all()
    expected = np.clip(np.searchsorted(parameters, ascending, side="right") - 1, 0, 298)
    assert (curve.local_basis(ascending).segment == expected).all()


def test_a_joint_belongs_to_the_segment_on_its_right():
    curve = HermiteCurve([[0.0], [1.0], [0.0]], [[1.0], [1.0], [1.0]], [0.0, 1.0, 3.0])
    # c'' = 6 (p1 - p0) / h**2 - (4 v0 + 2 v1) / h at the left end of a segment
    assert curve.evaluate(1.0, 2)[0] == pytest.approx(-6.0 / 4.0 - 6.0 / 2.0, abs=1e-14)
    # and -6 (p1 - p0) / h**2 + (2 v0 + 4 v1) / h at the right end of the last
    assert curve.evaluate(3.0, 2)[0] == pytest.approx(6.0 / 4.0 + 6.0 / 2.0, abs=1e-14)


@pytest.mark.parametrize("family", ["hermite", "quintic_hermite", "septic_hermite"])
def test_local_basis_is_the_dense_one(family, rng):
    curve = build(family, rng)
    for order in range(4):
        dense = curve.basis(T, order)
        local = curve.local_basis(T, order)
        for k in range(T.size):
            i = local.segment[k]
            assert (dense[k, i : i + 2] == local.values[k]).all()
            assert np.count_nonzero(dense[k]) <= local.values[k].size


def test_scipy_agrees_on_cubics(rng):
    from scipy.interpolate import CubicHermiteSpline

    curve = build("hermite", rng)
    reference = CubicHermiteSpline(PARAMETERS, curve.points, curve.jets[:, 1])
    for order in range(4):
        # SciPy's power form loses digits at the right ends; 1e-12 is far below any wrong factor.
        assert curve.evaluate(T, order) == pytest.approx(reference(T, order), rel=1e-12, abs=1e-12)


@pytest.mark.parametrize("family", ["quintic_hermite", "septic_hermite"])
def test_scipy_agrees_on_higher_degrees(family, rng):
    from scipy.interpolate import BPoly

    curve = build(family, rng)
    reference = BPoly.from_derivatives(PARAMETERS, curve.jets)
    for order in range(4):
        assert curve.evaluate(T, order) == pytest.approx(reference(T, order), rel=1e-11, abs=1e-11)


def test_scipy_agrees_on_chebyshev_lagrange(rng):
    from scipy.interpolate import BarycentricInterpolator

    parameters = chebyshev(30)
    curve = build("lagrange", rng, 30, parameters)
    reference = BarycentricInterpolator(parameters, curve.points)
    t = np.linspace(0.0, 1.0, 101)
    # The second barycentric form is accurate on Chebyshev points.
    assert curve.evaluate(t) == pytest.approx(reference(t), rel=1e-12, abs=1e-12)


def test_rank_one_update_is_a_drag(rng):
    curve = build("lagrange", rng, 8, uniform(8))
    t = np.linspace(0.0, 1.0, 50)
    jets = curve.jets.copy()
    jets[3, 0] += [0.5, -0.25]
    expected = curve.evaluate(t) + curve.basis(t)[:, 3] * [0.5, -0.25]
    scale = np.abs(curve.basis(t)[:, :, 0]) @ np.abs(jets[:, 0]) + 1.0
    assert (np.abs(curve.with_jets(jets).evaluate(t) - expected) <= 40 * U * scale).all()


EXTREME_PARAMETERS = [
    [0.0, 5e-324, 1.0],
    [0.0, 1e-310, 1e-309],
    [-1e308, 0.0, 7e307],
    [1e300, np.nextafter(1e300, 2e300), 1.1e300],
    [0.0, 1e-200, 1e-100, 1.0, 1e100, 1e200],
    [-8e307, -1e-300, 0.0, 1e-300, 8e307],
    list(1e-320 * np.array([1.0, 2.0, 3.0, 7.0])),
]


@every_family
@each_row("size", [1e-300, 1.0, 1e300, 1.7e308])
@each_row("parameters", EXTREME_PARAMETERS)
def test_nothing_is_ever_infinite_or_nan(family, parameters, size, rng):
    t = np.array(
        [0.0, 5e-324, -1e-310, 1e-200, 0.5, -1.0, 1e10, 1e150, -1e200, 1.7e308, -1.7e308, *parameters]
    )
    n = len(parameters)
    with np.errstate(under="ignore"):
        data = [size * rng.choice([-1.0, 1.0, 0.5, 0.0], (n, 2)) for _ in range(width_of(family))]
    try:
        curve = CLASSES[family](*data, parameters)
    except CurveError:
        assert family not in POLYNOMIALS
        return
    if curve.interpolates:
        assert (curve.evaluate(t)[-n:] == curve.points).all()
    for order in range(5):
        assert np.isfinite(curve.evaluate(t, order)).all()
        assert np.isfinite(curve.basis(t, order)).all()
