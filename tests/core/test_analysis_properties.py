"""What holds for every curve, on curves that hypothesis makes up; no warning is allowed."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from curvecore import (
    arc_length,
    bounding_box,
    curvature,
    curvature_extrema,
    equal_arc_length_parameters,
    inflections,
    joint_report,
    lebesgue_constant,
    lebesgue_function,
    monomial_condition,
    nearest,
    parameter_sensitivity,
    self_intersections,
    worst_case_band,
)
from tests.core.made_curves import curves_of, numbers

profile = settings(derandomize=True, deadline=None, max_examples=25)
few = st.sampled_from([-2.0, -1.0, 0.0, 0.5, 1.0])  # coincidences: lines, repeated points, points at rest
curves = curves_of([numbers, few], most=8, least_gap=1e-3)


def samples(curve, count=101):
    t = np.clip(np.linspace(*curve.domain, count), *curve.domain)
    points = curve.evaluate(t)
    # Sizes of what is added up, whose roundings no method avoids.
    with np.errstate(under="ignore"):
        noise = np.abs(curve.basis(t)).reshape(count, -1) @ np.abs(curve.jets).reshape(-1, 2)
    return t, points, 64 * 2.0**-53 * noise.max() + 1e-300


@profile
@given(curves)
def test_boxes_lengths_and_nearest_points(curve):
    _, points, noise = samples(curve)
    box = bounding_box(curve)
    assert (points >= box.minimum - box.error - noise).all()
    assert (points <= box.maximum + box.error + noise).all()
    size = max(float((box.maximum - box.minimum).max()), 1e-6)
    length = arc_length(curve, 1e-6 * size)
    chords = np.linalg.norm(np.diff(points, axis=0), axis=1).sum()
    assert length.value + length.error >= chords - 400 * noise
    equal = equal_arc_length_parameters(curve, 7, 1e-6 * size)
    assert (np.diff(equal) >= 0.0).all()
    target = 0.5 * (box.minimum + box.maximum) + 0.1 * size
    found = nearest(curve, target, 1e-6 * size)
    away = np.linalg.norm(points - target, axis=1).min()
    assert found.distance <= away + 2e-6 * size + noise


@profile
@given(curves)
def test_parameters_of_results_are_in_the_domain_and_ordered(curve):
    first, last = curve.domain
    t, _, _ = samples(curve)
    bends = curvature(curve, t)
    assert not np.isinf(bends).any()
    for places in (inflections(curve), curvature_extrema(curve).parameters):
        assert (np.diff(places) >= 0.0).all()
        assert ((places >= first) & (places <= last)).all()
    box = bounding_box(curve)
    crossings = self_intersections(curve, 1e-5 * max(float((box.maximum - box.minimum).max()), 1e-6))
    assert (crossings.parameters[:, 0] < crossings.parameters[:, 1]).all()
    for joint in joint_report(curve):
        assert joint.parametric >= curve.jets.shape[1] - 1 or joint.parametric == 2


@profile
@given(curves)
def test_stability(curve):
    t, _, _ = samples(curve)
    assert lebesgue_function(curve, t).max() <= lebesgue_constant(curve) * (1.0 + 1e-11)
    assert monomial_condition(curve) >= 1.0
    assert np.isfinite(parameter_sensitivity(curve, t)).all()
    band = worst_case_band(curve, t, 0.1, 1e-6)
    assert (band.distance >= 0.1 * lebesgue_function(curve, t) * (1.0 - 1e-12)).all()
    assert (band.across <= band.distance * (1.0 + 1e-9)).all()
