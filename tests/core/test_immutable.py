"""Copies and pickles of curves: read-only, and consistent with what was computed from them."""

import copy
import pickle
import re

import numpy as np
import pytest

from curvecore import (
    ArcLength,
    BasisCurve,
    Chain,
    CurveError,
    FamilySetting,
    HermiteCurve,
    LagrangeCurve,
    QuinticHermiteCurve,
    Scheme,
    arc_length,
    chord_length,
    nearest,
    round_data,
    uniform,
)
from curvecore.analysis.nearest_point import NearestWithin
from tests.rows import each_row

POINTS = np.array([[0.0, 0.0], [1.0, 2.0], [3.0, 1.0], [4.0, 4.0]])
LINE = HermiteCurve(POINTS[:2], POINTS[1:3], [0, 1])
OBJECTS = {
    "lagrange": LagrangeCurve(POINTS, uniform(4)),
    "hermite": HermiteCurve(POINTS, POINTS[::-1], uniform(4)),
    "quintic": QuinticHermiteCurve(POINTS, POINTS[::-1], POINTS, uniform(4)),
    "chain": Chain([LINE, HermiteCurve(POINTS[1:3], POINTS[2:], [1, 2])]),
    "arc length": ArcLength(LINE, 1e-9),
}
HATS = Scheme("hats", lambda t, x: np.stack([np.interp(t, x, e) for e in np.eye(len(x))], axis=1))
WAYS = {
    "copy": copy.copy,
    "deepcopy": copy.deepcopy,
    **{f"pickle {k}": lambda each, k=k: pickle.loads(pickle.dumps(each, k)) for k in range(2, 6)},
}


def arrays_of(thing, seen=None):
    """All arrays that an object holds, and its attributes give."""
    if isinstance(thing, np.ndarray):
        yield thing
    elif isinstance(thing, tuple):
        for each in thing:
            yield from arrays_of(each)
    elif hasattr(type(thing), "__slots__"):
        for name in ("points", "parameters", "jets", "pieces", "_arcs", "_at"):
            # A chain puts its points together anew whenever asked; the only piece of others is itself.
            if name == ("points" if isinstance(thing, Chain) else "pieces"):
                continue
            if hasattr(thing, name):
                yield from arrays_of(getattr(thing, name))


def values_of(thing):
    if isinstance(thing, ArcLength):
        return thing.length_at([0.1, 0.7]), thing.total
    return thing.evaluate([0.1, 0.7]), thing.evaluate([0.1, 0.7], 1)


@each_row("name", OBJECTS)
@each_row("way", WAYS)
@each_row("used", [False, True])
def test_a_copy_is_immutable_and_equal(name, way, used):
    """The points of a curve from a pickle could be written to, and `evaluate` went on with the old ones."""
    original = OBJECTS[name]
    if used:
        values_of(original)
    other = WAYS[way](original)
    assert type(other) is type(original)
    held = list(arrays_of(other))
    assert held
    for array in held:
        if not isinstance(other, ArcLength):
            assert not array.flags.writeable
    np.testing.assert_equal(values_of(other), values_of(original))


@each_row("name", OBJECTS)
@each_row("way", WAYS)
def test_curves_with_the_same_data_are_equal(name, way):
    original = OBJECTS[name]
    values_of(original)
    other = WAYS[way](original)
    assert other == original
    assert hash(other) == hash(original)
    assert len({original, other}) == 1


def test_curves_of_other_data_parameters_classes_or_shapes_differ():
    moved = POINTS + np.eye(4, 2) * 2.0**-50
    different = [
        *OBJECTS.values(),
        LagrangeCurve(moved, uniform(4)),
        LagrangeCurve(POINTS, 2.0 * uniform(4)),
        LagrangeCurve(POINTS[:, :1], uniform(4)),
        HermiteCurve(POINTS, POINTS, uniform(4)),
        LINE,
        LINE.derivative(),
        LINE.derivative(2),
        LINE.antiderivative(),
        BasisCurve(POINTS[:2], [0, 1], HATS),
        BasisCurve(POINTS[:2], [0, 1], HATS._replace(name="others")),
    ]
    for i, one in enumerate(different):
        assert [one == other for other in different] == [i == k for k in range(len(different))]
        assert one != POINTS.tolist()
    assert len(set(different)) == len(different)


def test_a_zero_is_a_zero():
    one, other = (LagrangeCurve([[zero, 1.0], [1.0, 2.0]], [zero, 1.0]) for zero in (0.0, -0.0))
    assert one == other
    assert hash(one) == hash(other)


@each_row(
    ("curve", "text"),
    [
        (OBJECTS["hermite"], "HermiteCurve(n=4, dim=2, domain=(0, 1))"),
        (OBJECTS["quintic"], "QuinticHermiteCurve(n=4, dim=2, domain=(0, 1))"),
        (LagrangeCurve([[0.0], [1.0]], [-1.5, 1 / 3]), "LagrangeCurve(n=2, dim=1, domain=(-1.5, 0.333333))"),
        (OBJECTS["chain"], "Chain(pieces=2, n=3, dim=2, domain=(0, 2))"),
        (BasisCurve(POINTS[:2], [0, 1], HATS), "BasisCurve(n=2, dim=2, domain=(0, 1), scheme='hats')"),
        (LINE.derivative(2), "Derivative(HermiteCurve(n=2, dim=2, domain=(0, 1)), order=2)"),
        (LINE.antiderivative(), "Antiderivative(HermiteCurve(n=2, dim=2, domain=(0, 1)))"),
    ],
)
def test_the_repr_of_a_curve_is_short(curve, text):
    assert repr(curve) == text


def test_a_curve_is_no_array_of_numbers():
    """NumPy would take whatever can be counted or iterated apart."""
    for curve in OBJECTS.values():
        assert np.asarray(curve).shape == ()
        assert np.asarray(curve).dtype == object


def test_curves_with_other_settings_are_not_equal():
    class Tense(LagrangeCurve):
        __slots__ = ()
        name = title = "tense"
        settings = (FamilySetting("tension", "tension", 1, limits=(0, 9)),)

        def __init__(self, points, parameters, **settings):
            self._keep(np.asarray(points, dtype=float)[:, None], parameters, **settings)

    one, other = (Tense(POINTS, uniform(4), tension=tension) for tension in (1, 2))
    assert one != other
    assert one == Tense(POINTS, uniform(4))
    assert hash(one) == hash(Tense(POINTS, uniform(4)))
    assert repr(other) == "Tense(n=4, dim=2, domain=(0, 1), tension=2)"


MASKED = np.ma.masked_array(POINTS, mask=POINTS == 3.0)


@each_row(
    ("make", "message"),
    [
        (lambda: LagrangeCurve(MASKED, uniform(4)), "points[2, 0] is masked; every value must be given"),
        (lambda: LagrangeCurve(list(MASKED), uniform(4)), "points[2, 0] is masked"),
        (lambda: HermiteCurve(POINTS, MASKED, uniform(4)), "velocities[2, 0] is masked"),
        (lambda: LagrangeCurve(POINTS, np.ma.masked_equal([0, 1, 2, 3], 1)), "parameters[1] is masked"),
        (lambda: OBJECTS["chain"].evaluate(np.ma.masked_equal([0.5, 1.0], 1.0)), "t[1] is masked"),
        (lambda: OBJECTS["chain"].basis(np.ma.masked_equal([0.5, 1.0], 1.0)), "t[1] is masked"),
        (lambda: chord_length(MASKED), "points[2, 0] is masked"),
        (lambda: nearest(LINE, MASKED[2], 1e-3), "point[0] is masked"),
        (lambda: NearestWithin(LINE).to(MASKED[2], 1.0), "point[0] is masked"),
        (lambda: round_data(MASKED, 2), "values[2, 0] is masked"),
        (lambda: arc_length(LINE, np.ma.masked_array(0.1, mask=True)), "tolerance is masked"),
    ],
)
def test_masked_values_are_refused(make, message):
    """What the mask hid counted like any other value."""
    with pytest.raises(CurveError, match=re.escape(message)):
        make()


def test_masked_arrays_without_masked_values_are_arrays():
    curve = LagrangeCurve(np.ma.masked_array(POINTS, mask=False), np.ma.masked_array(uniform(4)))
    assert np.array_equal(curve.points, POINTS)
    assert type(curve.points) is np.ndarray
