"""What is measured of basis functions: against faults that are put in on purpose, whose size is known."""

import numpy as np
import pytest

from curvecore import (
    BasisCurve,
    CardinalDefect,
    Miss,
    Scheme,
    cardinal_defect,
    chebyshev,
    slope_defect,
    sum_defect,
    uniform,
    worst_miss,
)
from tests.core.made_curves import core_families, hats
from tests.rows import each_row

POINTS = np.array([[0.0, 0.0], [1.0, 2.0], [3.0, 1.0], [4.0, 3.0], [5.0, 0.0]])
TIMES = np.array([0.0, 0.25, 0.5, 0.75, 1.0])


def curve_of(basis, times=TIMES, points=POINTS, **more):
    return BasisCurve(points, times, Scheme("own", basis, breaks=lambda parameters: parameters, **more))


PARAMETERS = {
    "two": uniform(2),
    "uniform": uniform(20),
    "many uniform": uniform(60),
    "chebyshev": chebyshev(100),
    "far from 0": 1e6 + np.cumsum([1e-7, 1.0, 1e-3, 0.5, 1e-6, 2.0]),
    "tiny": 1e-150 * uniform(7),
    "huge": 1e150 * uniform(7),
    "geometric": np.geomspace(1e-9, 1.0, 12),
}


@each_row("kind", core_families(), ids=lambda kind: kind.name)
@each_row("times", PARAMETERS.values(), ids=PARAMETERS)
def test_nothing_is_wrong_with_the_families_of_the_core(kind, times, rng):
    jets = rng.standard_normal((len(times), kind.derivatives + 1, 2))
    curve = kind.from_jets(jets, times)
    if kind.interpolates:
        assert cardinal_defect(curve) is None
        assert worst_miss(curve) is None
    assert sum_defect(curve) is None
    assert slope_defect(curve) is None


@pytest.mark.parametrize("off", [0.3, -0.02, 1e-8])
def test_a_sum_other_than_one_is_a_defect(off):
    """A bump at 0.375 of which the size is known, added to the third function."""

    def bumped(t, parameters):
        values = hats(t, parameters)
        values[:, 2] += off * np.maximum(0.0, 1.0 - np.abs(t - 0.375) / 0.125)
        return values

    found = sum_defect(curve_of(bumped))
    assert found.t == 0.375
    assert found.total - 1.0 == pytest.approx(off, rel=1e-6)
    assert cardinal_defect(curve_of(bumped)) is None
    assert worst_miss(curve_of(bumped)) is None
    assert curve_of(bumped).passes_points


def test_a_value_at_a_parameter_and_the_points_that_are_missed():
    """B_2(t_1) = 0.4: the curve is off at point 1 by 0.4 times p_2."""

    def slipped(t, parameters):
        values = hats(t, parameters)
        values[:, 2] += 0.4 * values[:, 1]
        return values

    curve = curve_of(slipped)
    assert cardinal_defect(curve) == CardinalDefect(2, 1, pytest.approx(0.4))
    assert cardinal_defect(curve).wanted == 0
    assert worst_miss(curve) == Miss(1, pytest.approx(0.4 * np.hypot(3.0, 1.0)))
    assert sum_defect(curve) == (0.25, pytest.approx(1.4))
    assert not curve.passes_points
    # It goes where its functions lead it, at the points too.
    assert curve.evaluate(0.25) == pytest.approx(POINTS[1] + 0.4 * POINTS[2])


def test_a_function_below_one_at_its_parameter_is_a_defect():
    curve = curve_of(lambda t, parameters: hats(t, parameters) * np.array([1.0, 1.0, 1.0, 0.25, 1.0]))
    assert cardinal_defect(curve) == CardinalDefect(3, 3, 0.25)
    assert cardinal_defect(curve).wanted == 1


@pytest.mark.parametrize("factor", [0.5, 1.01])
def test_slopes_that_are_others(factor):
    def with_slopes(t, parameters, order=0):
        if order == 0:
            return hats(t, parameters)
        segment = np.clip(np.searchsorted(parameters, t, side="right") - 1, 0, len(parameters) - 2)
        slopes = np.zeros((len(t), len(parameters)))
        rows = np.arange(len(t))
        slopes[rows, segment], slopes[rows, segment + 1] = -4.0, 4.0
        slopes[:, 3] *= factor
        return slopes

    found = slope_defect(curve_of(with_slopes, has_orders=True))
    assert found.function == 3
    assert abs(found.said) == pytest.approx(4.0 * factor)
    assert abs(found.found) == pytest.approx(4.0, rel=1e-9)
    assert 0.5 < found.t < 1.0


def test_of_many_points_a_part_is_looked_at():
    times = uniform(300)
    points = np.column_stack([times, times])

    def doubled(t, parameters):
        values = hats(t, parameters)
        values[:, 150] *= 2.0
        return values

    curve = curve_of(doubled, times, points)
    assert cardinal_defect(curve) == CardinalDefect(150, 150, 2.0)
    assert worst_miss(curve) == Miss(150, pytest.approx(np.hypot(*points[150])))
    assert sum_defect(curve).t == pytest.approx(times[150], abs=1 / 300)
