"""Handles at the end of a curve do not grow when points are appended, in whatever way."""

from __future__ import annotations

import math

import numpy as np
import pytest

from app.document import point_edits, rule_edits
from app.document.model import Document, ParametrizationKind, Point, make_curve
from app.families import FAMILIES
from app.features.point_table.edits import paste_block
from app.view_model.append import with_point_appended
from app.view_model.curve.curve_view import view_of
from app.view_model.curve.handles import handles_of
from app.view_model.paste import appended
from app.view_model.point_columns import COLUMNS, POSITION
from tests.rows import each_row

FAR = (9.0, 1.0)


def by_pen(document, view):
    return with_point_appended(document, 0, view, FAR)


def by_paste(document, view):
    return document.with_curve(0, appended(view, [Point(*FAR)]))


def by_table(document, view):
    columns = [column for column in COLUMNS if column.order == POSITION]
    return paste_block(document, 0, view, 3, columns, np.array([FAR]))


def longest(document):
    """The longest velocity handle of the point that was the last."""
    handles = handles_of(view_of(document.curves[0]), 2)
    return max(math.dist(each.position, each.anchor) for each in handles if each.order == 1)


@each_row("append", [by_pen, by_paste, by_table])
@each_row("kind", [*ParametrizationKind])
@each_row("family", [family for family in FAMILIES if family.derivatives])
def test_a_far_point_makes_no_handle_longer(family, kind, append):
    document = Document((make_curve([(0, 0), (0.3, 0.1), (0.5, 0)], family=family),))
    document = rule_edits.set_parametrization(document, 0, kind, [0.0, 0.6, 1.0])
    document = point_edits.set_velocity(document, 0, 2, (0.4, 0.9))
    after = append(document, view_of(document.curves[0]))
    assert len(after.curves[0].points) == 4
    assert longest(after) == pytest.approx(longest(document), rel=1e-9)
