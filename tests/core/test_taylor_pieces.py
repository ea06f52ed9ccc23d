"""Expansions of Hermite segments against exact fractions, one datum at a time: no other hides its error."""

from __future__ import annotations

import numpy as np
import pytest
from flint import fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

from curvecore import CurveError, HermiteCurve, QuinticHermiteCurve
from curvecore.bezier.hermite_roots import expansion_points
from curvecore.families.hermite_taylor import PieceIntervals
from tests.rows import each_row

profile = settings(derandomize=True, deadline=None, max_examples=150)
LIMIT = 20.0
"""The one of test_hermite_accuracy; 8.5 is the largest of millions that were compared with 80-bit numbers."""

FAMILIES = {2: HermiteCurve, 3: QuinticHermiteCurve}


def one_datum(width, start, length, which):
    """One segment whose data are 0 but for one."""
    jets = np.zeros((2, width, 1))
    jets[divmod(which, width)] = 1.0
    return FAMILIES[width](*jets.swapaxes(0, 1), [start, start + length])


def assert_relatively_accurate(exact, curve, t, order):
    nodes = [exact.rational(x) for x in curve.parameters]
    for x, (value,) in zip(t, curve.evaluate(t, order), strict=True):
        _, functions = exact.hermite_terms(exact.rational(x), nodes, curve.jets.shape[1], order)
        (end, k, _) = np.argwhere(curve.jets)[0]
        constant = exact.worst_constant(value, [functions[end][k]])
        assert constant is None or constant <= LIMIT


@profile
@given(
    st.sampled_from([2, 3]).flatmap(lambda R: st.tuples(st.just(R), st.integers(0, 2 * R - 1))),
    st.integers(0, 5),
    st.sampled_from([0.0, -1.0, 0.1, 1e6, -1e-7]),
    st.sampled_from([1.0, 3.0, 1 / 19, 1e-3, 1e9]),
    st.lists(st.floats(0.0, 1.0, allow_subnormal=False), min_size=1, max_size=9),
    st.integers(-2, 2),
)
def test_every_function_keeps_its_relative_error_beside_its_zeros(
    exact, kind, which, start, length, positions, away
):
    width, order = kind
    curve = one_datum(width, start, length, which % (2 * width))
    roots = expansion_points(width, order).positions
    # The doubles next to every zero: from there on the function is as small as it gets.
    with np.errstate(under="ignore"):
        t = start + length * np.concatenate([positions, roots])
        t += away * np.spacing(t)
    t = t[(t >= start) & (t <= curve.parameters[1]) & (np.abs(t) > 1e-290) | (t == 0.0)]
    assert_relatively_accurate(exact, curve, t, order)


def test_zeros_that_are_doubles_are_zeros():
    """Of joints 0, 3, 6, … the derivatives vanish at 1/3 or 2/3 of a segment, which are whole numbers."""
    velocities = np.zeros((5, 1))
    velocities[2] = 1.0
    curve = HermiteCurve(np.zeros((5, 1)), velocities, 3.0 * np.arange(5))
    assert (curve.evaluate([5.0, 7.0], 1) == 0.0).all()
    assert (curve.evaluate([4.0, 8.0], 2) == 0.0).all()


@pytest.mark.parametrize("family", FAMILIES.values())
@pytest.mark.parametrize("order", range(4))
def test_order_and_density_of_parameters_change_no_value(rng, family, order):
    """Searched, found by intervals and counted; at once and in pieces."""
    n = 400
    joints = np.cumsum(rng.random(n) + 0.01)
    data = rng.standard_normal((family.derivatives + 1, n, 2))
    t = np.sort(np.concatenate([rng.uniform(joints[0], joints[-1], 40_000), joints[1:-1], joints[1:-1]]))
    t = np.sort(np.concatenate([t, np.nextafter(joints[1:-1], 0.0)]))
    together = family(*data, joints).evaluate(t, order)
    assert (family(*data, joints).evaluate(t[::-1], order)[::-1] == together).all()
    some = slice(1000, 3000)
    assert (family(*data, joints).evaluate(t[some], order) == together[some]).all()
    dense = np.sort(np.concatenate([t, rng.uniform(joints[3], joints[5], 40_000)]))
    found = np.searchsorted(dense, t)
    assert (family(*data, joints).evaluate(dense, order)[found] == together).all()


@each_row("start", [0.0, -3.0, 1e6, 1e15])
@each_row("power", [0.0, 1.0, 2.0, 40.0])
def test_intervals_find_the_piece_that_a_search_finds(rng, power, start):
    """Also where nearly all pieces share one interval, at every end and at the doubles beside it."""
    ends = np.unique(start + rng.random(500) ** (1.0 + power))[1:]
    ends = np.append(ends, ends[-1:] + 1.0)
    ends = np.insert(ends, 7 % ends.size, ends[7 % ends.size])
    t = np.concatenate([ends, np.nextafter(ends, -np.inf), np.nextafter(ends, np.inf), [start]])
    t = rng.permutation(t[(t >= start) & (t < ends[-1])])
    found = PieceIntervals.of(ends, start).find(t)
    assert found.tolist() == np.searchsorted(ends, t, side="right").tolist()


@each_row("order", range(4))
@each_row("count", [1, 7, 250, 400, 3000, 20_000])
def test_a_curve_that_was_evaluated_before_is_the_same(rng, order, count):
    """What is there already is used without the usual checks: whatever is asked for, the answer stays."""
    n = 30
    joints = np.cumsum(rng.random(n) + 0.01)
    data = rng.standard_normal((2, n, 3))
    t = np.concatenate([rng.uniform(joints[0], joints[-1], count), joints])
    beyond = np.concatenate([t, [joints[0] - 0.1, joints[-1] + 0.1]])
    wide = np.stack([t, t], axis=1)
    for asked in (
        t,
        np.sort(t),
        t[::-2],
        wide[:, 1],
        beyond,
        t[:0],
        t.astype(np.float32),
        wide,
        list(t[:5]),
        t[0],
    ):
        warm = HermiteCurve(*data, joints)
        warm.evaluate(joints, order)
        before = np.array(asked)
        found = warm.evaluate(asked, order)
        assert (found == HermiteCurve(*data, joints).evaluate(asked, order)).all()
        assert found.shape == (*np.shape(asked), 3)
        assert (np.array(asked) == before).all()
        again = found.copy()
        found[...] = 9.0
        assert (warm.evaluate(asked, order) == again).all()
    assert (warm.evaluate(float(t[0]), order) == warm.evaluate(t, order)[0]).all()


@each_row("count", [1, 7, 400, 3000])
def test_a_curve_that_was_evaluated_before_refuses_the_same(rng, count):
    joints = np.arange(5.0)
    curve = HermiteCurve(*rng.standard_normal((2, 5, 2)), joints)
    t = np.linspace(0.0, 4.0, count)
    for order in range(4):
        curve.evaluate(t, order)
    for wrong in (np.nan, np.inf, -np.inf):
        for position in (0, count // 2, count - 1):
            asked = t.copy()
            asked[position] = wrong
            with pytest.raises(CurveError, match=rf"t\[{position}\] is {wrong}; every value must be finite"):
                curve.evaluate(asked, 1)
        with pytest.raises(CurveError, match="every value must be finite"):
            curve.evaluate(wrong, 1)
    for order in (-1, 1.0, "1", None, np.array([1, 2])):
        with pytest.raises(CurveError, match="order must be"):
            curve.evaluate(t, order)


def test_products_too_small_for_a_double_are_no_errors():
    """They are looked for when NumPy has told of one; everything is an error in these tests."""
    curve = HermiteCurve([[0.0], [1.0]], [[1e-20], [1.0]], [0.0, 1.0])
    t = np.array([0.0, 1e-300, 1e-200, 0.5])
    for asked in (t, np.linspace(0.0, 1e-300, 1000), np.append(np.linspace(0.0, 1e-300, 1000), 0.5)):
        for order in range(4):
            first, second = curve.evaluate(asked, order), curve.evaluate(asked, order)
            assert np.isfinite(first).all()
            assert (first == second).all()


@pytest.mark.parametrize("family", FAMILIES.values())
@pytest.mark.parametrize("order", range(4))
def test_few_parameters_of_many_segments(rng, family, order):
    """They are not worth expansions; both ways keep c <= 20, as test_hermite_accuracy says."""
    n = 400
    joints = np.cumsum(rng.random(n) + 0.01)
    curve = family(*rng.standard_normal((family.derivatives + 1, n, 2)), joints)
    t = np.sort(rng.uniform(joints[0], joints[-1], 4 * n))
    local = curve.local_basis(t, order)
    data = np.stack([curve.jets[local.segment], curve.jets[local.segment + 1]], axis=1)
    bound = 2.0 * LIMIT * 2.0**-53 * np.abs(local.values[..., None] * data).sum(axis=(1, 2))
    together = curve.evaluate(t, order)
    for k in range(0, t.size, 20):
        assert (np.abs(curve.evaluate(t[k], order) - together[k]) <= bound[k]).all()


@each_row("length", [1, 2, 3, 7])
def test_segments_of_a_few_roundings(exact, length):
    start = 1.0
    joints = np.array([0.5, start, start + length * np.spacing(start), 2.0])
    curve = HermiteCurve([[1.0], [2.0], [-1.0], [0.0]], [[1.0], [-2.0], [3.0], [1.0]], joints)
    assert (curve.evaluate(joints) == curve.points).all()
    nodes = [exact.rational(x) for x in joints]
    for x in start + np.arange(length + 1) * np.spacing(start):
        for order in range(4):
            segment, functions = exact.hermite_terms(exact.rational(x), nodes, 2, order)
            terms = [
                functions[end][r] * exact.rational(curve.jets[segment + end, r, 0])
                for end in (0, 1)
                for r in (0, 1)
            ]
            assert exact.worst_constant(curve.evaluate(x, order)[0], terms) <= LIMIT


def test_coefficients_match_the_functions(exact):
    """Summed up at the middle of a segment, all expansions are what the functions are there."""
    for width in (2, 3):
        for order in range(2 * width):
            found = expansion_points(width, order)
            half = fmpq(1, 2)
            _, functions = exact.hermite_terms(half, [fmpq(0), fmpq(1)], width, order)
            wanted = np.array([float(each) for end in functions for each in end])
            pairs = zip(found.positions, found.coefficients.swapaxes(0, 1), strict=True)
            for position, coefficients in pairs:
                powers = (0.5 - position) ** np.arange(len(coefficients))
                assert np.allclose(powers @ coefficients, wanted, rtol=1e-11, atol=1e-11)
