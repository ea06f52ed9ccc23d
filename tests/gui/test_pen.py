"""The pen: handles that stay as short as they were drawn, points at the end, and curves begun anew."""

from __future__ import annotations

import math
from itertools import product

import numpy as np
import pytest
from PySide6.QtCore import Qt

from app.document import curve_edits, point_edits, rule_edits
from app.document.model import ParametrizationKind, Point
from app.families import FAMILIES, QUINTIC_HERMITE
from app.view_model.curve.handles import handles_of
from tests.gui.editor_facts import at

SHIFT, ALT = Qt.KeyboardModifier.ShiftModifier, Qt.KeyboardModifier.AltModifier
WITH_VELOCITIES = [family for family in FAMILIES if family.derivatives]


def begin(editor, document):
    """Go on with a document that is there at once: how it is made is not the question."""
    editor.session.commit(document, "Begin")


def lay(editor, *places):
    """Lay points at the end of the curve, as clicks with the pen do."""
    points = (*editor.curve.points, *(Point(*place) for place in places))
    begin(editor, point_edits.set_points(editor.session.document, 0, points))
    editor.session.selected.set_points([len(points) - 1])


@pytest.fixture
def ring(pen):
    """A closed curve of three points, and the pen in hand."""
    lay(pen, (0, 0), (2, 0), (1, 2))
    begin(pen, curve_edits.set_closed(pen.session.document, 0, True))
    return pen


def lengths(editor, index, kind=1):
    """The lengths of the velocity handles of a point, by whether they are ahead."""
    handles = [each for each in handles_of(editor.session.active_view, index) if each.order == kind]
    return {each.ahead: math.dist(each.position, each.anchor) / editor.pixel for each in handles}


# Handles


def test_no_handle_gets_longer_than_drawn(pen):
    """340 px on, a handle of 45 px used to become one of 510.

    The first family under every rule, the others under half of them each.
    """
    empty, every = pen.session.document, list(ParametrizationKind)
    for place, family in enumerate(WITH_VELOCITIES):
        document = rule_edits.set_family(empty, 0, family)
        document = point_edits.set_points(document, 0, [Point(*at(pen, x, 0)) for x in (0, 30)])
        for kind in every[place % 2 :: 2] if place else every:
            begin(pen, rule_edits.set_parametrization(document, 0, kind, [0.0, 1.0]))
            pen.session.selected.set_points([1])
            pen.press(at(pen, 60, 0))
            pen.move(at(pen, 60, 45))
            assert "both handles stay" in pen.status, (family, kind)
            pen.release(at(pen, 60, 45))
            drawn = lengths(pen, 2)[False]
            assert drawn == pytest.approx(45, abs=1.5), (family, kind)
            pen.click(at(pen, 400, 0))
            after = lengths(pen, 2)
            assert max(after.values()) == pytest.approx(drawn, rel=1e-9), (family, kind)
            pen.trigger("undo")
            assert lengths(pen, 2)[False] == drawn, (family, kind)
            pen.click(at(pen, 75, 0))
            assert max(lengths(pen, 2).values()) == pytest.approx(drawn, rel=1e-9), (family, kind)


def test_the_handle_behind_keeps_its_position_before_a_short_segment(pen):
    pen.click(at(pen, 0, 0))
    pen.drag(at(pen, 200, 0), at(pen, 245, 20))
    (before,) = handles_of(pen.session.active_view, 1)
    pen.click(at(pen, 230, 60))
    behind = next(each for each in handles_of(pen.session.active_view, 1) if not each.ahead)
    assert behind.position == pytest.approx(before.position, rel=1e-12)


def test_an_acceleration_scales_by_the_square(pen):
    begin(pen, rule_edits.set_family(pen.session.document, 0, QUINTIC_HERMITE))
    pen.click(at(pen, 0, 0))
    pen.drag(at(pen, 30, 0), at(pen, 60, 0))
    document = point_edits.set_derivative(pen.session.document, 0, 1, 2, (3.0, -4.0))
    pen.session.commit(document, "Set")
    old = pen.curve.points[1]
    pen.click(at(pen, 330, 0))
    new, (t0, t1, t2) = pen.curve.points[1], pen.parameters
    for factor, name in ((t1 - t0, ""), (t2 - t1, "_after")):
        velocity, acceleration = getattr(new, f"velocity{name}"), getattr(new, f"acceleration{name}")
        assert velocity == pytest.approx([each / factor for each in old.velocity])
        if acceleration is not None:
            assert acceleration == pytest.approx([each / factor**2 for each in old.acceleration])


def test_the_handle_of_the_first_point_stays(pen):
    empty, tip = pen.session.document, at(pen, 45, 30)
    kinds = ParametrizationKind.CHORD_LENGTH, ParametrizationKind.MANUAL
    for kind, span in product(kinds, (1.0, 2.5)):
        for family in WITH_VELOCITIES:
            document = rule_edits.set_parametrization(rule_edits.set_family(empty, 0, family), 0, kind, [])
            begin(pen, rule_edits.set_interval(document, 0, 0.0, span))
            pen.press(at(pen, 0, 0))
            pen.move(tip)
            assert pen.status.partition(" · ")[2].startswith("the handle stays here"), (family, kind, span)
            assert pen.handle().position == pytest.approx(tip, abs=2 * pen.pixel), (family, kind, span)
            pen.release(tip)
            drawn = pen.handle().position
            pen.click(at(pen, 400, 0))
            (handle,) = (each for each in handles_of(pen.session.active_view, 0) if each.order == 1)
            assert handle.ahead, (family, kind, span)
            assert handle.position == pytest.approx(drawn, rel=1e-12), (family, kind, span)


def test_closing_with_the_pen_keeps_the_handles_short_as_well(pen):
    pen.drag(at(pen, 0, 0), at(pen, 10, 20))
    pen.click(at(pen, 30, 0))
    pen.click(at(pen, 330, 0))
    pen.drag(at(pen, 360, 0), at(pen, 380, 15))
    first, last = lengths(pen, 0)[True], lengths(pen, 3)[False]
    pen.click(pen.point(0))
    assert pen.curve.is_closed
    assert max(lengths(pen, 0).values()) == pytest.approx(first, rel=1e-9)
    assert max(lengths(pen, 3).values()) == pytest.approx(last, rel=1e-9)
    pen.trigger("undo")
    assert lengths(pen, 3)[False] == last


def test_escape_removes_the_point_and_its_effect_on_the_one_before(pen):
    pen.click(at(pen, 0, 0))
    pen.drag(at(pen, 30, 0), at(pen, 60, 20))
    document, steps = pen.session.document, pen.session.undo_stack.count()
    pen.press(at(pen, 330, 0))
    pen.move(at(pen, 360, 40))
    assert pen.curve.points[1].velocity != document.curves[0].points[1].velocity
    pen.escape()
    pen.release(at(pen, 360, 40))
    assert pen.session.document is document
    assert pen.session.undo_stack.count() == steps


# At the end, also near the curve


def test_shift_adds_at_the_end_near_the_curve(pen):
    lay(pen, *(at(pen, x, 0) for x in (0, 100, 200)))
    near = at(pen, 50, 4)
    pen.hover(near)
    assert pen.window.status_line.hint == "Click to insert a point here · Shift: add at the end"
    pen.move(near, held=False, keys=SHIFT)
    assert pen.window.status_line.hint.startswith("Click to add point 3")
    pen.click(near, keys=SHIFT)
    assert pen.session.undo_stack.undoText() == "Add point 3"
    assert pen.point(3) == pytest.approx(near, abs=pen.pixel)
    assert pen.session.selection == {3}
    pen.trigger("undo")
    pen.click(near)
    assert pen.session.undo_stack.undoText() == "Insert point 1"


def test_escape_removes_a_point_added_near_the_curve(pen):
    lay(pen, *(at(pen, x, 0) for x in (0, 100, 200)))
    document = pen.session.document
    pen.press(at(pen, 50, 4), keys=SHIFT)
    pen.move(at(pen, 80, 40), keys=SHIFT)
    assert pen.curve.points[3].velocity is not None
    pen.escape()
    assert pen.session.document is document


# Beside a closed curve


def test_beside_a_closed_curve_the_pen_begins_a_new_curve(ring):
    begin(ring, rule_edits.set_parametrization(ring.session.document, 0, ParametrizationKind.CENTRIPETAL, []))
    old, steps = ring.curve, ring.session.undo_stack.count()
    ring.hover((4, 1))
    assert ring.window.status_line.hint.startswith("Click to begin another curve")
    ring.press((4, 1))
    ring.move((5, 2))
    assert ring.status.startswith("Begin Curve 2 at")
    assert ring.session.active_index == 1
    assert ring.handle().position == pytest.approx((5, 2), abs=2 * ring.pixel)
    ring.release((5, 2))
    fresh = ring.curve
    assert ring.session.document.curves == (old, fresh)
    assert (fresh.name, fresh.style.stroke, fresh.family) == ("Curve 2", "", old.family)
    assert fresh.parametrization == old.parametrization
    assert not fresh.closed
    assert ring.point(0) == pytest.approx((4, 1), abs=ring.pixel)
    assert ring.session.undo_stack.count() == steps + 1
    assert ring.session.undo_stack.undoText() == "Begin Curve 2"
    assert ring.session.selection == {0}
    drawn = ring.handle().position
    ring.click((6, 1))
    assert len(ring.curve.points) == 2
    (handle,) = handles_of(ring.session.active_view, 0)
    assert handle.position == pytest.approx(drawn, rel=1e-12)


def test_the_beginning_is_undone_in_one_step(ring):
    document = ring.session.document
    ring.click((4, 1))
    assert ring.session.active_index == 1
    ring.trigger("undo")
    assert ring.session.document == document
    assert ring.session.active_index == 0
    ring.trigger("redo")
    assert (ring.session.active_index, len(ring.curve.points)) == (1, 1)


def test_escape_cancels_the_first_point(ring):
    document, steps = ring.session.document, ring.session.undo_stack.count()
    ring.press((4, 1))
    ring.move((5, 2))
    ring.escape()
    assert ring.session.document is document
    assert ring.session.active_index == 0
    ring.release((5, 2))
    assert ring.session.undo_stack.count() == steps
    assert ring.curve.is_closed


def test_undo_while_placing_the_first_point_cancels_only_the_first_point(ring):
    document = ring.session.document
    ring.press((4, 1))
    ring.trigger("undo")
    assert ring.session.document == document
    assert ring.session.active_index == 0
    ring.release((4, 1))
    assert ring.session.document == document


def test_on_a_closed_curve_the_pen_inserts_and_with_shift_appends(ring):
    x, y = ring.session.active_view.curve.evaluate(0.2)
    ring.hover((x, y))
    assert ring.window.status_line.hint == "Click to insert a point here · Shift: add at the end"
    ring.click((x, y))
    assert ring.session.undo_stack.undoText() == "Insert point 1"
    ring.trigger("undo")
    ring.click((0, 2), keys=SHIFT)
    assert ring.session.undo_stack.undoText() == "Add point 3"
    assert len(ring.session.document.curves) == 1


def test_a_new_curve_can_be_begun_beside_a_locked_one(ring):
    ring.trigger("curveLocked")
    ring.hover((4, 1))
    assert ring.window.status_line.hint.startswith("Click to begin another curve")
    ring.click((4, 1), keys=SHIFT)
    assert "is locked" in ring.status
    assert len(ring.session.document.curves) == 1
    ring.click((4, 1))
    assert not ring.curve.locked
    assert len(ring.session.document.curves) == 2


def test_the_sheet_lists_the_gestures_of_the_pen(ring):
    from PySide6.QtWidgets import QLabel

    ring.key(Qt.Key.Key_F1)
    sheet = ring.window.findChild(object, "shortcutSheet")
    said = " ".join(label.text() for label in sheet.findChildren(QLabel))
    assert "begin another curve" in said
    assert "add a point at the end" in said


@pytest.mark.parametrize("kind", [ParametrizationKind.UNIFORM, ParametrizationKind.CHORD_LENGTH])
def test_a_point_inserted_and_dragged_a_little_changes_the_curve_a_little(pen, kind):
    """Past the threshold all handles used to jump: the parameters move, and nothing was rescaled."""
    begin(pen, rule_edits.set_parametrization(pen.session.document, 0, kind, []))
    points = [Point(x, y, velocity=(12.0, 0.0)) for x, y in ((0.0, 0.0), (4.0, 3.0), (8.0, 0.0), (12.0, 3.0))]
    pen.session.commit(point_edits.set_points(pen.session.document, 0, points), "Begin")
    pen.fit()
    before = [handles_of(pen.session.active_view, index)[0].position for index in (0, 3)]
    place = tuple(pen.session.active_view.curve.evaluate(0.5))
    pen.press(place)
    clicked = np.array(pen.session.active_view.flattened(0.01).points)
    pen.move((place[0] + 4 * pen.pixel, place[1]))
    view = pen.session.active_view
    assert len(view.source.points) == 5
    for index, was in zip((0, 4), before, strict=True):
        assert handles_of(view, index)[0].position == pytest.approx(was, abs=1e-9)
    # The curve itself: vertices lie where they are needed, far apart on what is nearly straight.
    dragged = view.curve.evaluate(np.linspace(*view.curve.domain, 2001))
    apart = np.hypot(*(clicked[:, None] - dragged[None]).transpose(2, 0, 1)).min(axis=1)
    assert apart.max() < 8 * pen.pixel
    pen.escape()
    assert len(pen.curve.points) == 4
    pen.release(place)


def test_the_status_line_displays_position_and_kind_of_an_added_point(pen):
    pen.press((1.0, 2.0))
    x, y = pen.window.canvas.to_plane(pen.window.canvas.to_pixel(1.0, 2.0))
    assert pen.status.startswith(f"Add point 0 at {x:.4g}, {y:.4g}")
    assert "velocity" not in pen.status
    pen.move((1.0, 3.0))
    assert "velocity at 90°" in pen.status
    assert pen.status.endswith("Escape cancels")
    pen.escape()
    pen.release((1.0, 3.0))
    assert not pen.curve.points


def test_the_status_line_names_an_insertion_and_a_velocity_pulled_out(pen):
    for x, y in ((1.0, 1.0), (3.0, 1.0), (3.0, 3.0)):
        pen.add_point(x, y)
    pen.trigger("addTool")
    place = tuple(pen.session.active_view.curve.evaluate(0.2))
    pen.press(place)
    assert pen.status.startswith("Insert point 1 at t = 0.")
    pen.move((2.0, 2.0))
    insertion, _, place = pen.status.partition(" ·")[0].partition(" at ")
    assert insertion == "Insert point 1"
    # As exactly as the pixels lie, which depends on the width of the docks and so on the font.
    assert [float(each) for each in place.split(", ")] == pytest.approx([2.0, 2.0], abs=0.05)
    pen.escape()
    pen.release((2.0, 2.0))
    pen.trigger("selectTool")
    pen.press(pen.point(1), keys=ALT)
    pen.move((3.5, 1.5), keys=ALT)
    assert pen.status.startswith("Velocity of point 1: ")
    pen.escape()
    pen.release((3.5, 1.5))
    assert pen.curve.points[1].velocity is None
