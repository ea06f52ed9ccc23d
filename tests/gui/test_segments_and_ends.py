"""Segments deleted, ends merged into one point, handles retracted; real keys and mouse."""

from __future__ import annotations

import numpy as np
import pytest
from msgspec.structs import replace
from PySide6.QtCore import Qt

from app.document.constraints import is_straight
from app.document.model import Document, make_curve
from app.families import HERMITE

Key = Qt.Key
ALT, CTRL, SHIFT = (
    Qt.KeyboardModifier.AltModifier,
    Qt.KeyboardModifier.ControlModifier,
    Qt.KeyboardModifier.ShiftModifier,
)
RING = ((0.0, 0.0), (2.0, -0.5), (3.0, 1.0), (1.5, 2.0), (0.0, 1.5))


@pytest.fixture
def ring(editor):
    """A closed curve of five points."""
    curve = replace(make_curve(RING, name="Ring", family=HERMITE), closed=True)
    editor.session.commit(Document((curve,)), "Begin")
    editor.fit()
    return editor


def segment(view, index):
    return view.curve.evaluate(np.linspace(*view.parameters[index : index + 2], 9))


def positions(curve):
    return [point.position for point in curve.points]


def test_a_closed_curve_opens_where_a_segment_is_deleted_and_then_falls_apart(ring):
    before = ring.session.active_view
    ring.select([1, 2])
    ring.key(Key.Key_K, ALT)
    assert ring.session.undo_stack.undoText() == "Delete segment of Ring"
    assert not ring.curve.is_closed
    assert positions(ring.curve) == [*RING[2:], *RING[:2]]
    after = ring.session.active_view
    for old, new in ((2, 0), (3, 1), (4, 2), (0, 3)):
        np.testing.assert_allclose(segment(after, new), segment(before, old), atol=1e-12)
    x, y = segment(after, 1)[4]
    ring.open_menu((x, y))
    ring.choose("deleteSegmentHere")
    names = [(curve.name, len(curve.points)) for curve in ring.session.document.curves]
    assert names == [("Ring a", 2), ("Ring b", 3)]
    assert ring.status.startswith("Deleted segment: 2 curves remain, shape kept")
    ring.trigger("undo")
    ring.trigger("undo")
    assert ring.curve.is_closed


def test_two_ends_become_one_point_halfway(editor):
    """Joining drew a segment between them."""
    one = make_curve([(0, 0), (1, 1), (2, 0)], name="One", family=HERMITE)
    other = make_curve([(2.5, 0.5), (4, 1), (5, 0)], name="Other", family=HERMITE)
    editor.session.commit(Document((one, other)), "Begin")
    editor.fit()
    editor.session.selected.set_curves({0, 1})
    editor.select([2])
    editor.click((2.5, 0.5), keys=SHIFT)
    editor.key(Key.Key_J, SHIFT)
    assert positions(editor.curve) == [(0, 0), (1, 1), (2.25, 0.25), (4, 1), (5, 0)]
    assert len(editor.session.document.curves) == 1
    assert editor.status == "Merged two ends into one point: each moved by 0.35."
    editor.select([0, 4])
    editor.key(Key.Key_J, SHIFT)
    assert editor.curve.is_closed
    assert positions(editor.curve)[0] == (2.5, 0)
    assert len(editor.curve.points) == 4


def test_a_click_with_ctrl_retracts_a_handle_and_two_make_a_line(ring):
    before = ring.session.active_view
    ring.select([1])
    ring.hover(ring.handle(ahead=True).position)
    assert "Ctrl+click: retract it" in ring.window.status_line.hint
    ring.click(ring.handle(ahead=True).position, keys=CTRL)
    assert ring.session.undo_stack.undoText() == "Retract handle of point 1"
    assert ring.curve.points[1].velocity_after == (0.0, 0.0)
    after = ring.session.active_view
    # Its other side stays; the estimates of the others follow.
    assert after.velocity_of(1, ahead=False) == before.velocity_of(1)
    assert not is_straight(ring.curve, 1)
    ring.select([2])
    ring.click(ring.handle(ahead=False).position, keys=CTRL)
    assert is_straight(ring.curve, 1)
    for index in (2, 3, 4, 0):
        np.testing.assert_allclose(
            segment(ring.session.active_view, index), segment(after, index), atol=1e-12
        )


def on_segment(editor, index, share=0.4):
    """Return a place of the line."""
    start, end = editor.parameters[index : index + 2]
    return tuple(editor.session.active_view.curve.evaluate(start + share * (end - start)).tolist())


def test_a_click_on_a_segment_selects_both_ends_and_keys_act_on_the_ends(ring):
    view = ring.session.active_view
    closing = tuple(view.curve.evaluate(float(view.parameters[4:].mean())).tolist())
    ring.hover(closing)
    assert "Click: select both ends · Double click: insert a point" in ring.window.status_line.hint
    ring.click(closing)
    assert ring.session.selected.points == {0, 4}
    assert ring.status.startswith("2 points selected · t = ")
    ring.click(on_segment(ring, 0), keys=SHIFT)
    assert ring.session.selected.points == {0, 1, 4}
    ring.click(closing, keys=SHIFT)
    assert ring.session.selected.points == {1}
    ring.click(on_segment(ring, 2))
    ring.key(Key.Key_4, ALT)
    assert is_straight(ring.curve, 2)
    ring.key(Key.Key_Up)
    moved = [index for index, at in enumerate(positions(ring.curve)) if at != RING[index]]
    assert moved == [2, 3]
    ring.key(Key.Key_Delete)
    assert positions(ring.curve) == [RING[0], RING[1], RING[4]]


def test_a_drag_bends_a_segment_whose_ends_are_selected(ring):
    ring.click(on_segment(ring, 1))
    before = ring.session.active_view
    x, y = on_segment(ring, 1, 0.5)
    ring.drag((x, y), (x + 0.3, y))
    assert ring.session.undo_stack.undoText().startswith("Bend curve at t")
    assert positions(ring.curve) == list(RING)
    assert ring.session.selected.points == {1, 2}
    assert not np.allclose(segment(ring.session.active_view, 1), segment(before, 1), atol=0.1)


@pytest.mark.parametrize("share", [1 / 3, 1 / 2])
def test_a_double_click_inserts_where_the_first_click_brought_a_handle_or_a_pivot(ring, share):
    """The handles of both ends lie on a straight segment, and the middle of its box halfway."""
    ring.select([1, 2])
    ring.key(Key.Key_4, ALT)
    ring.escape()
    place = on_segment(ring, 1, share)
    ring.double_click(place)
    assert len(ring.curve.points) == 6
    assert ring.curve.points[2].position == pytest.approx(place, abs=0.02)
    assert ring.session.selected.points == {2}
