"""What has changed from one document to the next, as a drag asks at every move."""

from __future__ import annotations

import numpy as np
import pytest
from msgspec.structs import replace

from app.document.differences import curves_changed_besides_points, moved_points, reshaped_curves
from app.document.model import Axis, Document, Guide, make_curve
from app.document.plain_numbers import with_plain_numbers
from app.document.point_edits import delete_points, move_points, set_velocity
from app.document.style import Style
from app.families import HERMITE
from tests.rows import each_row

WAVE = ((0, 0), (1, 1), (2, 0), (3, 1))


@pytest.fixture
def two():
    return Document(tuple(make_curve(WAVE, name=name, family=HERMITE) for name in "ab"))


def test_moved_points_are_listed_when_nothing_else_changed(two):
    moved = move_points(two, 1, [0, 2], (1.0, 0.0))
    assert reshaped_curves(two, moved) == [1]
    assert reshaped_curves(two, two) == []
    assert moved_points(two, moved) == [moved.curves[1].points[0], moved.curves[1].points[2]]
    assert curves_changed_besides_points(two.curves, moved.curves) == []


def test_changed_derivatives_reshape_a_curve_but_move_no_point(two):
    bent = set_velocity(two, 0, 1, (1.0, 2.0))
    assert reshaped_curves(two, bent) == [0]
    assert moved_points(two, bent) is None
    assert curves_changed_besides_points(two.curves, bent.curves) == []


@each_row(
    "change",
    [
        lambda document: delete_points(document, 0, [1]),
        lambda document: replace(document, curves=document.curves[:1]),
        lambda document: replace(document, guides=(Guide(Axis.X, 1.0),)),
        lambda document: document.with_curve(0, replace(document.curves[0], style=Style(stroke="#ff0000"))),
        lambda document: document.with_curve(0, replace(document.curves[0], name="c")),
    ],
    ids=["a point gone", "a curve gone", "a guide", "a colour", "a name"],
)
def test_other_changes_are_no_change_of_points_alone(two, change):
    assert reshaped_curves(two, change(two)) is None
    assert moved_points(two, change(two)) is None


def test_a_changed_style_is_distinguished_from_changed_points(two):
    moved = move_points(two, 1, [0], (1.0, 0.0))
    named = moved.with_curve(0, replace(moved.curves[0], name="c"))
    assert curves_changed_besides_points(two.curves, named.curves) == [0]


def test_a_number_of_numpy_among_moved_points_becomes_a_float(two):
    moved = move_points(two, 0, [1], (1.0, 0.0))
    points = list(moved.curves[0].points)
    points[1] = replace(points[1], y=np.float64(3))
    odd = moved.with_curve(0, replace(moved.curves[0], points=tuple(points)))
    assert type(with_plain_numbers(odd, two).curves[0].points[1].y) is float
    assert with_plain_numbers(moved, two) is moved
