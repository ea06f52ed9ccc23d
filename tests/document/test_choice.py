"""Where chosen curves and selected nodes are after a change."""

from __future__ import annotations

import pytest

from app.document import edits
from app.document.choice import followed_nodes
from app.document.model import Document, Node, make_curve


def nodes(*points):
    return make_curve(points).nodes


BEFORE = nodes((0, 0), (1, 1), (2, 0), (3, 1))


@pytest.mark.parametrize(
    ("after", "kept"),
    [
        (nodes((0, 0), (0.5, 2), (1, 1), (2, 0), (3, 1)), {2, 4}),  # one came in between
        (nodes((0, 0), (1, 1), (2, 0)), {1}),  # the last one went
        (nodes((5, 5), (6, 6)), set()),
        (nodes((9, 9), (8, 8), (7, 7), (6, 6)), {1, 3}),  # moved, all of them
        ((), set()),
    ],
)
def test_nodes_are_followed_by_their_places(after, kept):
    assert followed_nodes({1, 3}, BEFORE, after) == kept


def test_coincident_nodes_keep_their_order():
    before = nodes((0, 0), (1, 1), (1, 1), (2, 0))
    after = nodes((0, 0), (5, 5), (1, 1), (1, 1), (2, 0))
    assert followed_nodes({2}, before, after) == {3}
    assert followed_nodes({1, 2}, before, before[:2]) == {1}


def test_other_derivatives_do_not_make_another_node():
    document = edits.set_velocity(Document((make_curve([(0, 0), (1, 1), (2, 0)]),)), 0, 1, (1.0, 0.0))
    after = edits.insert_nodes(document, 0, 0, [Node(-1.0, 0.0)])
    stretched = edits.set_interval(after, 0, 0.0, 5.0)
    assert followed_nodes({1}, document.curves[0].nodes, stretched.curves[0].nodes) == {2}
