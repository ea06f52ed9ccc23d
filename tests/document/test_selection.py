"""Where chosen curves and selected points are after a change."""

from __future__ import annotations

from app.document import point_edits, rule_edits
from app.document.model import Document, Point, make_curve
from app.document.selection import followed_points
from tests.rows import each_row


def points(*points):
    return make_curve(points).points


BEFORE = points((0, 0), (1, 1), (2, 0), (3, 1))


@each_row(
    ("after", "kept"),
    [
        (points((0, 0), (0.5, 2), (1, 1), (2, 0), (3, 1)), {2, 4}),  # one came in between
        (points((0, 0), (1, 1), (2, 0)), {1}),  # the last one went
        (points((5, 5), (6, 6)), set()),
        (points((9, 9), (8, 8), (7, 7), (6, 6)), {1, 3}),  # moved, all of them
        ((), set()),
    ],
)
def test_the_selection_follows_points_by_their_positions(after, kept):
    assert followed_points({1, 3}, BEFORE, after) == kept


def test_coincident_points_keep_their_order():
    before = points((0, 0), (1, 1), (1, 1), (2, 0))
    after = points((0, 0), (5, 5), (1, 1), (1, 1), (2, 0))
    assert followed_points({2}, before, after) == {3}
    assert followed_points({1, 2}, before, before[:2]) == {1}


def test_a_point_with_changed_derivatives_is_still_followed():
    document = point_edits.set_velocity(Document((make_curve([(0, 0), (1, 1), (2, 0)]),)), 0, 1, (1.0, 0.0))
    after = point_edits.insert_points(document, 0, 0, [Point(-1.0, 0.0)])
    stretched = rule_edits.set_interval(after, 0, 0.0, 5.0)
    assert followed_points({1}, document.curves[0].points, stretched.curves[0].points) == {2}
