"""Several parameters at once."""

from __future__ import annotations

import math

import pytest

from app.document.limits import EditError
from app.document.model import Document, make_curve
from app.document.rule_edits import set_parameters
from tests.rows import each_row

DOCUMENT = Document((make_curve([(0, 0), (1, 1), (2, 0)]),))


def test_set_parameters_become_manual():
    curve = set_parameters(DOCUMENT, 0, [-1.0, 0.25, 7]).curves[0]
    assert [point.t for point in curve.points] == [-1.0, 0.25, 7.0]
    assert curve.is_manual


@each_row("t", [[0, 0, 1], [0, 2, 1], [0, math.nan, 1], [0, 1, 2e12], [0, 1, math.inf]])
def test_parameters_out_of_order_or_range_are_refused(t):
    with pytest.raises(EditError, match=r"The t of point [12] must"):
        set_parameters(DOCUMENT, 0, t)
