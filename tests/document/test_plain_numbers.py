"""What is not plain becomes plain at the door of the document."""

from __future__ import annotations

from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest
from msgspec.structs import replace

from app.document import point_edits
from app.document.model import Document, Parametrization, Point, ReferenceImage, make_curve
from app.document.plain_numbers import with_plain_numbers
from app.families import HERMITE
from app.storage.format import encode
from app.storage.format_error import FormatError
from app.storage.validation import validate
from tests.rows import each_row

WILD = (
    np.float64(1 / 3),
    np.float32(0.25),
    np.int64(7),
    3,
    Fraction(1, 3),
)
"""Numbers that are no plain floats."""


def document_of(x):
    """Return a document with `x` at every place where a number may be, and NumPy's truth for every flag."""
    pair = (x, x)
    points = (
        Point(0.0, 0.0),
        Point(x, x, x, pair, pair, np.True_, pair, pair, pair, pair),
        Point(1.0, 2.0, velocity=[x, np.float64(2.0)]),
    )
    curve = replace(
        make_curve(()),
        points=points,
        family=HERMITE,
        parametrization=Parametrization(alpha=np.float64(0.5), start=np.float64(0.0), end=10),
        closed=np.False_,
        visible=np.True_,
        locked=np.False_,
    )
    return Document((make_curve([(0, 0), (1, 1)]), curve), ReferenceImage("/a.png", x, x, x, x, 1, np.True_))


@each_row("number", WILD, ids=lambda number: type(number).__name__)
def test_every_number_becomes_a_float_of_the_same_value(number, odd_values):
    given = document_of(number)
    assert odd_values(given)
    document = with_plain_numbers(given)
    assert odd_values(document) == []
    value = float(number)
    point = document.curves[1].points[1]
    assert point == Point(value, value, value, *[(value,) * 2] * 2, True, *[(value,) * 2] * 4)
    assert document.curves[1].points[2].velocity == (value, 2.0)
    assert document.curves[1].parametrization == Parametrization(alpha=0.5, end=10.0)
    assert document.image == ReferenceImage("/a.png", value, value, value, value, 1.0, True)
    assert b"null" not in encode(document)


def test_a_plain_document_stays_the_same_object():
    document = Document((make_curve([(0, 0), (1, 1)]), make_curve([(0, 0)])))
    assert with_plain_numbers(document) is document
    moved = point_edits.move_points(document, 0, [1], (0.5, 0.5))
    assert with_plain_numbers(moved, document) is moved
    with_numpy = point_edits.insert_points(document, 0, 2, [Point(np.float64(3.0), 0.0)])
    mended = with_plain_numbers(with_numpy, document)
    assert mended.curves[1] is document.curves[1]
    assert mended.curves[0].points[:2] == document.curves[0].points
    assert all(a is b for a, b in zip(mended.curves[0].points, document.curves[0].points, strict=False))


def test_unchanged_objects_are_not_checked():
    before = document_of(np.float64(2.0))
    assert with_plain_numbers(before, before) is before
    curve = before.curves[1]
    moved = before.with_curve(1, replace(curve, points=(Point(1.0, 1.0), *curve.points[1:])))
    assert type(with_plain_numbers(moved, before).curves[1].points[1].x) is np.float64


@each_row("odd", [True, None, "1", Decimal(1), 10**400, np.float64("nan"), np.float64("inf")])
def test_values_that_are_no_numbers_are_left_for_validation(odd):
    curve = replace(make_curve([(0, 0)]), points=(Point(odd, 0.0),))
    with pytest.raises(FormatError, match=r"curves\[0\]\.points\[0\]\.x must"):
        validate(with_plain_numbers(Document((curve,))))
