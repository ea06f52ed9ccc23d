"""Polylines of a curve with one moved point, compared with the curve, for every family."""

import numpy as np
import pytest

from app.families import FAMILIES
from curvecore import CurveError, LagrangeCurve, chebyshev, uniform
from curvecore.drag.moved_points import MovedPoints
from tests.polylines import worst_distance
from tests.rows import each_row

BOX = (-0.5, -0.5, 4.5, 3.0)
TOLERANCE = 1e-3
WAYS = ((0.0, 0.0), (0.05, 0.1), (0.1, 0.15), (-0.2, 0.4), (0.0, -1.5), (0.01, 0.02))


def wave(family, n, middle):
    """A wave of n points, and by how much it moves with the one in the middle."""
    s = chebyshev(n) if family.curve_class.is_one_polynomial else uniform(n)
    jets, unit = np.zeros((n, family.derivatives + 1, 2)), np.zeros((n, family.derivatives + 1, 1))
    jets[:, 0] = np.column_stack([4 * s, 1 + 0.7 * np.sin(9 * s)])
    if family.derivatives:
        jets[:, 1] = np.column_stack([np.full(n, 4.0), 6.3 * np.cos(9 * s)])
    unit[middle, 0] = 1.0
    curve = family.curve_class.from_jets(jets, s)
    return curve, unit


@each_row("box", [None, BOX, (-0.5, -0.5, 2.0, 3.0)], ids=["whole", "all seen", "half seen"])
@each_row("n", [3, 7, 20])
@each_row("family", FAMILIES, ids=lambda family: family.name)
def test_a_moved_point_is_followed_within_the_tolerance(family, n, box):
    curve, unit = wave(family, n, n // 2)
    moved = MovedPoints(curve, curve.with_jets(unit), TOLERANCE, box)
    followed = 0
    for way in WAYS:
        pieces = moved.at(*way)
        if pieces is None:
            continue
        followed += 1
        after = curve.with_jets(curve.jets + unit * way)
        assert pieces.reached <= TOLERANCE
        assert worst_distance(after, pieces, box or (-9, -9, 9, 9)) <= TOLERANCE
        assert (np.diff(pieces.parameters) > 0).all()
        # Each is a sum of products: roundings of numbers of this size.
        off = np.abs(pieces.points - after.evaluate(pieces.parameters)).max()
        assert off <= 2e-14 * (1 + np.abs(pieces.points).max())
    assert followed == len(WAYS) or (box is not None and box != BOX and followed)


def test_vertices_stay_within_reach_and_follow_beyond():
    curve, unit = wave(FAMILIES.named("hermite"), 20, 10)
    moved = MovedPoints(curve, curve.with_jets(unit), TOLERANCE, BOX)
    first, near, far = (moved.at(0.0, way) for way in (0.0, 0.1, 0.9))
    assert near.parameters is first.parameters
    assert far.parameters is not first.parameters
    # A hand that comes back slowly finds few of them again.
    assert moved.at(0.0, 0.0).reached <= TOLERANCE


def test_a_curve_of_very_many_segments_is_not_followed():
    curve, unit = wave(FAMILIES.named("hermite"), 1000, 500)
    assert MovedPoints(curve, curve.with_jets(unit), TOLERANCE, BOX).at(0.0, 0.1) is None


@pytest.mark.parametrize("tolerance", [0.0, np.nan])
def test_bad_tolerances(tolerance):
    curve = LagrangeCurve([[0, 0], [1, 1]], [0, 1])
    with pytest.raises(CurveError, match="tolerance"):
        MovedPoints(curve, curve.with_jets([[[1]], [[0]]]), tolerance)
