"""Deleted points leave the handles beside them unchanged."""

from __future__ import annotations

import pytest
from msgspec.structs import replace

from app.document.model import Document, ParametrizationKind, make_curve
from app.document.rule_edits import set_parametrization
from app.families import FAMILIES
from app.view_model.curve.curve_view import view_of
from app.view_model.curve.handles import handles_at
from app.view_model.delete import without_points_keeping_handles
from tests.rows import each_row

PLACES = ((0.0, 0.0), (1.0, 2.0), (3.0, 2.5), (4.0, 0.5), (6.0, 1.0), (5.0, -2.0))
T = (0.0, 0.1, 0.35, 0.5, 0.8, 0.9, 1.0)
"""Of a closed curve; of an open one without the last."""


def handles(view):
    """The handles of each point, by its place and the side."""
    found = {}
    for index, point in enumerate(view.source.points):
        for handle in handles_at(view, [index]):
            found.setdefault((point.position, handle.ahead), []).append(handle.position)
    return found


@each_row("family", [each for each in FAMILIES if each.derivatives], ids=lambda each: each.name)
@each_row("kind", list(ParametrizationKind), ids=lambda each: each.value)
@each_row(("closed", "gone"), [(False, {2}), (False, {0, 3}), (True, {1, 2}), (True, {0})])
def test_every_remaining_handle_keeps_its_position(family, kind, closed, gone):
    curve = make_curve(PLACES, family=family)
    points = [
        point.with_derivatives(
            [(3.0 + i, 2.0 - i), (5.0, -4.0 + i), (7.0 - i, 9.0)][: family.derivatives], ()
        )
        for i, point in enumerate(curve.points)
    ]
    points[4] = replace(points[4].as_corner(), velocity_after=(-1.0, 3.0))
    curve = replace(curve, points=tuple(points), closed=closed)
    values = T if closed else T[:-1]
    document = set_parametrization(Document((curve,)), 0, kind, values)
    before = view_of(document.curves[0])
    after = view_of(without_points_keeping_handles(before, gone))
    assert after.source.is_closed is closed
    was, now = handles(before), handles(after)
    assert len(now) >= 2 * (len(PLACES) - len(gone) - 1)
    for side, places in now.items():
        for place, old in zip(places, was[side], strict=True):
            assert place == pytest.approx(old, abs=1e-12)
