"""The pen where a click makes a corner: straight lines by clicks, handles by drags."""

from __future__ import annotations

import numpy as np
import pytest
from PySide6.QtCore import Qt

from app.document.lines import is_line
from app.document.model import Page
from app.document.plane_edits import set_page
from app.families import HERMITE, LAGRANGE

ALT = Qt.KeyboardModifier.AltModifier


@pytest.fixture
def paper(editor):
    """An empty document with a page, which was of one polynomial before, and the pen in hand."""
    editor.new()
    editor.choose_family(LAGRANGE)
    editor.session.change("Page", lambda document: set_page(document, Page(0, 0, 210, 148)))
    editor.trigger("fitPage")
    editor.trigger("addTool")
    return editor


def lines(editor):
    """Which segments of the curve are straight."""
    curve = editor.curve
    return [is_line(curve, segment) for segment in range(len(curve.points) - (not curve.is_closed))]


def drawn(editor, segment):
    """Places along a segment."""
    view = editor.session.active_view
    return view.curve.evaluate(np.linspace(*view.parameters[segment : segment + 2], 9))


def cubics(editor):
    """The control points of all segments, (k, 4, 2)."""
    return np.concatenate([piece.bezier_pieces() for piece in editor.session.active_view.pieces])


def test_on_a_page_clicks_make_a_polygon_of_cubics(paper):
    places = [(20, 20), (120, 20), (120, 90), (30, 100)]
    for place in places:
        paper.click(place)
    assert paper.curve.family is HERMITE
    assert lines(paper) == [True] * 3
    paper.hover((60, 120))
    assert "point 4, a corner" in paper.window.status_line.hint
    preview = paper.window.canvas.marks.preview_curve.source
    assert is_line(preview, 3)
    paper.click(places[0])
    assert paper.curve.is_closed
    assert lines(paper) == [True] * 4
    assert all(point.corner for point in paper.curve.points)


def test_what_is_drawn_stays_while_the_pen_goes_on(paper):
    """A click used to bend the segments before it."""
    paper.click((20, 20))
    paper.drag((80, 30), (100, 60))
    first = drawn(paper, 0)
    assert not is_line(paper.curve, 0)
    paper.click((190, 60))
    np.testing.assert_allclose(drawn(paper, 0), first, atol=1e-9)
    second = drawn(paper, 1)
    assert paper.curve.points[1].tied, "smooth where it was dragged"
    paper.click((190, 120))
    paper.drag((60, 120), (20, 100))
    assert lines(paper) == [False, False, True, False]
    assert not paper.curve.points[2].tied
    np.testing.assert_allclose(drawn(paper, 0), first, atol=1e-9)
    np.testing.assert_allclose(drawn(paper, 1), second, atol=1e-9)


def test_a_click_beside_a_smooth_point_is_a_bare_corner(paper):
    """It got a handle half way: none was drawn out. The control point lies on the corner, as in Inkscape."""
    paper.click((20, 20))
    paper.drag((80, 30), (100, 60))
    paper.click((150, 60))
    pieces = cubics(paper)
    assert pieces[0][1] == pytest.approx(pieces[0][0], abs=1e-12)
    assert pieces[1][2] == pytest.approx(pieces[1][3], abs=1e-12)
    # What was drawn out is a mirror image of itself about the smooth point.
    assert pieces[0][3] - pieces[0][2] == pytest.approx(pieces[1][1] - pieces[1][0], abs=1e-9)
    assert pieces[1][1] == pytest.approx((100, 60), abs=2 * paper.pixel)
    paper.click((20, 20))
    (*_, closing) = cubics(paper)
    assert is_line(paper.curve, 2)
    assert closing[0] == pytest.approx((150, 60), abs=2 * paper.pixel)


def test_a_click_that_closes_beside_a_smooth_point_is_bare_too(paper):
    paper.click((20, 20))
    paper.click((80, 20))
    paper.drag((90, 80), (60, 100))
    paper.click((20, 20))
    (*_, closing) = cubics(paper)
    assert paper.curve.is_closed
    assert closing[2] == pytest.approx(closing[3], abs=1e-12)


def test_a_key_and_alt_make_smooth_points(paper):
    paper.click((20, 20))
    paper.click((80, 30), keys=ALT)
    assert lines(paper) == [False]
    paper.key(Qt.Key.Key_P, Qt.KeyboardModifier.ShiftModifier)
    assert "smooth points" in paper.status
    paper.hover((150, 60))
    assert "corner" not in paper.window.status_line.hint
    paper.click((150, 60))
    assert not paper.curve.points[2].corner
    paper.new()
    paper.trigger("addTool")
    paper.key(Qt.Key.Key_P, Qt.KeyboardModifier.ShiftModifier)
    assert paper.action("togglePenCorners").isChecked(), "kept, also where there is no page"


def test_another_curve_on_the_page_has_handles_too(paper):
    document = paper.session.document
    paper.session.commit(document.with_curve(0, document.curves[0].with_family(LAGRANGE)), "Polynomial")
    for place in [(20, 20), (60, 30), (80, 80)]:
        paper.click(place)
    assert paper.curve.family is LAGRANGE, "chosen for the curve that is drawn"
    paper.key(Qt.Key.Key_Return)
    paper.hover((120, 40))
    assert HERMITE.title in paper.window.status_line.hint
    paper.click((120, 40))
    paper.click((160, 40))
    assert paper.curve.family is HERMITE
    assert lines(paper) == [True]
