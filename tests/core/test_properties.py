"""Statements that hold for every input, on inputs that hypothesis makes up."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from curvecore import (
    flatten_parameters,
    natural_spline_velocities,
    power,
)
from tests.core.made_curves import curves_of, numbers

profile = settings(derandomize=True, deadline=None, max_examples=40)
curves = curves_of([numbers], most=9, least_gap=1e-9)


def parameters_at(curve, places):
    first, last = curve.domain
    with np.errstate(under="ignore"):
        return first + (last - first) * np.array(places)


@profile
@given(curves, st.lists(st.floats(-0.5, 1.5), min_size=1, max_size=9), st.integers(0, 3))
def test_the_curve_is_the_sum_of_its_functions(curve, places, order):
    t = parameters_at(curve, places)
    basis, values = curve.basis(t, order), curve.evaluate(t, order)
    # Data of 1e-300 times u is less than a double holds: of the test's own sums, not of the core's.
    with np.errstate(under="ignore"):
        scale = np.einsum("mir,ird->md", np.abs(basis), np.abs(curve.jets))
        gap = np.abs(np.einsum("mir,ird->md", basis, curve.jets) - values)
        # c <= 20 on each side for n <= 9, and the sum's own 27 roundings.
        assert (gap <= 70.0 * 2.0**-53 * scale + 1e-290).all()


@profile
@given(curves)
def test_the_curve_passes_its_points_exactly(curve):
    assert (curve.evaluate(curve.parameters) == curve.points).all()


@profile
@given(curves, st.lists(st.floats(-0.2, 1.2), min_size=1, max_size=9))
def test_position_functions_sum_to_one(curve, places):
    basis = curve.basis(parameters_at(curve, places))[:, :, 0]
    assert (np.abs(basis.sum(axis=1) - 1.0) <= 40.0 * 2.0**-53 * np.abs(basis).sum(axis=1)).all()


@pytest.mark.filterwarnings("ignore::curvecore.ToleranceWarning")
@profile
@given(curves, st.floats(1e-6, 1e3))
def test_flattening_is_ordered_and_bounded(curve, tolerance):
    t = flatten_parameters(curve, tolerance)
    assert t.size <= 2**14
    assert (np.diff(t) > 0.0).all()
    assert (t[0], t[-1]) == curve.domain


@profile
@given(st.lists(st.tuples(numbers, numbers), min_size=2, max_size=9, unique=True), st.floats(0.0, 1.0))
def test_power_parameters_increase(points, alpha):
    steps = np.hypot(*np.diff(np.array(points), axis=0).T)
    assume(steps.min() > 1e-9 * steps.max())
    t = power(points, alpha)
    assert (t[0], t[-1]) == (0.0, 1.0)
    assert (np.diff(t) > 0.0).all()
    assert np.isfinite(natural_spline_velocities(points, t)).all()
