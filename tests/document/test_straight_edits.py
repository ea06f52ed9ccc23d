"""Segments made straight, as pure edits."""

from __future__ import annotations

import pytest
from msgspec.structs import replace

from app.document.limits import EditError
from app.document.model import Document, Point, make_curve
from app.document.straight_edits import corners_of, straighten
from app.families import HERMITE, LAGRANGE, QUINTIC_HERMITE

POINTS = ((0, 0), (1, 2), (3, 2), (4, 0))
TIMES = (0.0, 0.25, 0.75, 1.0)


def document(family=QUINTIC_HERMITE, *, closed=False):
    return Document((replace(make_curve(POINTS, family=family), closed=closed),))


def test_straightening_sets_only_the_sides_within_the_segment():
    points = list(document().curves[0].points)
    points[1] = replace(points[1], velocity=(5.0, 6.0), acceleration=(7.0, 8.0))
    before = document().with_curve(0, replace(document().curves[0], points=tuple(points)))
    after = straighten(before, 0, [1], TIMES).curves[0].points
    assert after[0] is points[0]
    assert after[3] is points[3]
    before_it = {"velocity": (5.0, 6.0), "acceleration": (7.0, 8.0)}
    ahead = {"velocity_after": (4.0, 0.0), "acceleration_after": (0.0, 0.0)}
    assert after[1] == Point(1.0, 2.0, corner=True, **before_it, **ahead)
    assert after[2] == Point(3.0, 2.0, corner=True, velocity=(4.0, 0.0), acceleration=(0.0, 0.0))


def test_an_end_of_an_open_curve_becomes_no_corner():
    after = straighten(document(HERMITE), 0, [0], TIMES).curves[0].points
    assert after[0] == Point(0.0, 0.0, velocity=(4.0, 8.0))
    assert after[1] == Point(1.0, 2.0, corner=True, velocity=(4.0, 8.0))


def test_the_closing_segment_can_be_straightened():
    closed = document(HERMITE, closed=True)
    after = straighten(closed, 0, [3], (0.0, 0.25, 0.5, 0.75, 1.0)).curves[0].points
    assert after[3] == Point(4.0, 0.0, corner=True, velocity_after=(-16.0, 0.0))
    assert after[0] == Point(0.0, 0.0, corner=True, velocity=(-16.0, 0.0))
    assert corners_of(closed.curves[0], [2, 3]) == [0, 2, 3]


@pytest.mark.parametrize("segment", [-1, 3])
def test_a_missing_segment_is_refused(segment):
    with pytest.raises(EditError, match="segment no longer exists"):
        straighten(document(), 0, [segment], TIMES)


def test_straightening_a_polynomial_is_refused_with_a_reason():
    with pytest.raises(EditError, match="one polynomial"):
        straighten(document(LAGRANGE), 0, [1], TIMES)
