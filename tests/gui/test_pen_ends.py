"""The pen at the ends of other open curves: it goes on with any, and what it draws is joined to one."""

from __future__ import annotations

import math

import numpy as np
import pytest
from msgspec.structs import replace
from PySide6.QtCore import Qt

from app.document.constraints import is_straight
from app.document.model import Document, ParametrizationKind, make_curve
from app.document.style import Style
from app.families import FAMILIES, HERMITE, LAGRANGE, QUINTIC_HERMITE
from app.view_model.curve.curve_view import view_of
from app.view_model.curve.handles import handles_of
from tests.gui.editor_facts import at, undo_text

ALT, SHIFT = Qt.KeyboardModifier.AltModifier, Qt.KeyboardModifier.ShiftModifier

WAVE = ((200, 30), (240, 90), (300, 60), (360, 120))
"""Pixels of the points of the curve that is there."""


def there(editor, family=HERMITE, **fields):
    """Begin with a finished curve, “There”, and the pen activated: another one is active, and closed."""
    editor.new()
    points = [at(editor, *place) for place in WAVE]
    ring = [at(editor, *place) for place in ((500, 200), (540, 200), (520, 240))]
    curve = replace(make_curve(points, name="There", family=family), **fields)
    other = replace(make_curve(ring, name="Ring", family=HERMITE), closed=True)
    editor.session.commit(Document((curve, other)), "Begin", active=1)
    editor.session.selected.activate(1)
    editor.trigger("addTool")
    return editor


@pytest.fixture
def beside(editor):
    return there(editor)


def hint(editor):
    return editor.window.status_line.hint


def names(editor):
    return [curve.name for curve in editor.session.document.curves]


def positions(curve):
    return [point.position for point in curve.points]


def sampled(curve):
    """Return points of a curve, evenly in its parameter."""
    core = view_of(curve).curve
    return core.evaluate(np.linspace(*core.domain, 400))


def farthest(curve, whole):
    """Return the largest distance of points of a curve from another curve."""
    core = view_of(whole).curve
    fine = core.evaluate(np.linspace(*core.domain, 40_001))
    return max(np.hypot(*(fine - point).T).min() for point in sampled(curve))


# Going on


@pytest.mark.parametrize("family", FAMILIES, ids=lambda family: family.name)
def test_a_click_on_the_last_point_of_any_curve_goes_on_with_it(editor, family):
    pen = there(editor, family)
    before, end = pen.session.document, at(pen, *WAVE[3])
    pen.hover(end)
    assert hint(pen).startswith("Click to continue “There”")
    assert pen.window.canvas.marks.spot == end
    assert pen.window.canvas.viewport().cursor().shape() is Qt.CursorShape.PointingHandCursor
    steps = pen.session.undo_stack.count()
    pen.click(end)
    assert pen.session.document is before
    assert pen.session.undo_stack.count() == steps
    assert (pen.session.active_index, pen.session.selection) == (0, {3})
    assert pen.status == "Continuing “There”; the next press adds point 4."
    pen.click(at(pen, 420, 60))
    assert names(pen) == ["There", "Ring"]
    assert len(pen.curve.points) == 5
    assert positions(pen.curve)[:4] == positions(before.curves[0])
    # Its other end closes it now.
    pen.hover(pen.point(0))
    assert ("Click to close the curve" in hint(pen)) is family.curve_class.can_close


@pytest.mark.parametrize("kind", [ParametrizationKind.CHORD_LENGTH, ParametrizationKind.MANUAL])
def test_a_click_on_the_first_point_turns_the_curve(editor, kind):
    pen = there(editor)
    curve = pen.session.document.curves[0]
    points = [replace(point, t=t) for point, t in zip(curve.points, (0.0, 0.2, 0.7, 1.0), strict=True)]
    curve = replace(curve, points=tuple(points), parametrization=replace(curve.parametrization, kind=kind))
    pen.session.commit(pen.session.document.with_curve(0, curve), "Begin")
    start = at(pen, *WAVE[0])
    pen.hover(start)
    assert hint(pen) == "Click to continue “There” from its first point · Drag to pull out its handle"
    pen.click(start)
    assert undo_text(pen) == "Continue from point 0"
    assert positions(pen.curve) == positions(curve)[::-1]
    assert sampled(pen.curve) == pytest.approx(sampled(curve)[::-1], abs=1e-9)
    pen.click(at(pen, 120, 60))
    assert pen.point(3) == start
    assert len(pen.curve.points) == 5
    pen.key(Qt.Key.Key_Backspace)
    assert len(pen.curve.points) == 4
    # No point that was there before goes.
    pen.key(Qt.Key.Key_Backspace)
    assert len(pen.curve.points) == 4
    pen.trigger("undo")
    pen.trigger("undo")
    pen.trigger("undo")
    assert pen.session.document.curves[0] == curve


@pytest.mark.parametrize("end", [0, 3])
@pytest.mark.parametrize("family", [HERMITE, QUINTIC_HERMITE], ids=lambda family: family.name)
def test_a_drag_pulls_the_handle_out_of_the_end_and_the_curve_keeps_its_shape(editor, family, end):
    pen = there(editor, family)
    before, steps = pen.session.document, pen.session.undo_stack.count()
    x, y = WAVE[end]
    start, tip = at(pen, x, y), at(pen, x + 20, y + 55)
    pen.press(start)
    assert pen.session.document is before
    pen.move(tip)
    assert pen.status.startswith("Continue There, handle at 70")
    assert pen.session.active_index == 0
    (handle,) = (each for each in pen.window.canvas.drawing.points.handles if each.ahead and each.order == 1)
    assert handle.position == pytest.approx(tip, abs=1e-9)
    pen.escape()
    pen.release(tip)
    assert pen.session.document is before
    assert pen.session.active_index == 1
    pen.drag(start, tip)
    assert pen.session.undo_stack.count() == steps + 1
    assert undo_text(pen) == "Continue There"
    assert sampled(pen.curve) == pytest.approx(sampled(before.curves[0])[:: 1 if end else -1], abs=1e-9)
    pen.click(at(pen, 420, 200), keys=ALT)
    view = pen.session.active_view
    assert len(view.source.points) == 5
    (handle,) = (each for each in handles_of(view, 3) if each.ahead and each.order == 1)
    assert handle.position == pytest.approx(tip, abs=1e-9)
    # The corner leaves what was there as it was.
    assert farthest(before.curves[0], pen.curve) < 1e-3
    pen.trigger("undo")
    pen.trigger("undo")
    assert pen.session.document == before


def test_a_press_that_moves_a_little_is_a_click(beside):
    end = at(beside, *WAVE[3])
    before = beside.session.document
    beside.drag(end, (end[0] + 2 * beside.pixel, end[1]))
    assert beside.session.document is before
    assert beside.status.startswith("Continuing “There”")


def test_without_velocities_a_drag_from_an_end_goes_on(editor):
    pen = there(editor, LAGRANGE)
    pen.drag(at(pen, *WAVE[3]), at(pen, 420, 160))
    assert pen.status.startswith("Continuing “There”")
    assert len(pen.session.document.curves[0].points) == 4
    assert pen.session.active_index == 0


@pytest.mark.parametrize("fields", [{"locked": True}, {"visible": False}, {"closed": True}])
def test_the_ends_of_locked_hidden_and_closed_curves_are_no_ends(editor, fields):
    pen = there(editor, **fields)
    pen.hover(at(pen, *WAVE[3]))
    assert "continue" not in hint(pen)
    pen.click(at(pen, *WAVE[3]))
    assert len(pen.session.document.curves) == 3


def test_a_fill_above_covers_an_end(editor):
    pen = there(editor)
    x, y = at(pen, *WAVE[3])
    r = 40 * pen.pixel
    square = [(x - r, y - r), (x + r, y - r), (x + r, y + r), (x - r, y + r)]
    lid = replace(
        make_curve(square, name="Lid", family=HERMITE),
        closed=True,
        style=Style(fill="#ff0000", fill_opacity=1.0),
    )
    document = pen.session.document
    pen.session.commit(replace(document, curves=(*document.curves, lid)), "Begin", active=1)
    pen.hover(at(pen, *WAVE[3]))
    assert "continue" not in hint(pen)
    pen.hover(at(pen, *WAVE[0]))
    assert hint(pen).startswith("Click to continue “There”")


def test_while_whole_curves_are_selected_an_end_goes_on_as_well(beside):
    beside.trigger("selectTool")
    beside.escape()
    beside.escape()
    assert not beside.session.selected.is_editing
    beside.trigger("addTool")
    beside.click(at(beside, *WAVE[3]))
    assert beside.status.startswith("Continuing “There”")
    assert beside.session.selected.is_editing


def test_shift_puts_a_point_over_an_end(beside):
    beside.click(at(beside, 100, 100))
    beside.click(at(beside, *WAVE[0]), keys=SHIFT)
    assert names(beside) == ["There", "Ring", "Curve 1"]
    assert len(beside.curve.points) == 2


# Joining


def draw(pen, *places):
    for place in places:
        pen.click(at(pen, *place))


@pytest.mark.parametrize("end", [0, 3])
@pytest.mark.parametrize("count", [1, 3])
def test_a_click_on_an_end_joins_what_is_drawn_with_that_curve(beside, end, count):
    pen, style = beside, Style(stroke="#0072b2", width=3.0)
    draw(pen, *((30, 60), (80, 160), (140, 60))[:count])
    drawn = replace(pen.curve, style=style)
    pen.session.commit(pen.session.document.with_curve(2, drawn), "Paint")
    before, steps = pen.session.document, pen.session.undo_stack.count()
    place = at(pen, *WAVE[end])
    pen.hover(place)
    assert hint(pen) == "Click to join with “There” · Alt: straight line"
    assert pen.window.canvas.marks.spot == place
    shown = pen.window.canvas.marks.preview_curve.source
    assert pen.session.document is before
    pen.click(place)
    assert names(pen) == ["Ring", "Curve 1"]
    assert pen.session.active_index == 1
    assert pen.curve == shown
    assert pen.curve.style == style
    rest = positions(before.curves[0])
    assert positions(pen.curve) == [*positions(drawn), *(rest if end == 0 else rest[::-1])]
    assert farthest(before.curves[0], pen.curve) < 1e-3
    assert [index for index, point in enumerate(pen.curve.points) if point.velocity] == [count]
    assert undo_text(pen) == "Join Curve 1 and There"
    assert pen.session.undo_stack.count() == steps + 1
    side = "end" if end else "start"
    assert pen.status.startswith(f"Joined with “There” at its {side}: it keeps its shape.")
    # It is finished: the next press begins another curve, an end goes on.
    pen.hover(at(pen, 100, 240))
    assert hint(pen).startswith("Click to begin another curve")
    pen.trigger("undo")
    assert pen.session.document == before
    assert pen.session.active_index == 2
    # In the middle of drawing again.
    pen.hover(at(pen, 100, 240))
    assert hint(pen).startswith(f"Click to add point {count}")
    pen.click(place)
    assert pen.curve == shown
    pen.click(at(pen, 100, 240))
    assert names(pen) == ["Ring", "Curve 1", "Curve 2"]


def test_redo_leaves_a_joined_curve_finished(beside):
    draw(beside, (30, 60), (80, 160), WAVE[0])
    beside.trigger("undo")
    beside.trigger("redo")
    beside.hover(at(beside, 100, 240))
    assert hint(beside).startswith("Click to begin another curve")


def test_a_curve_that_goes_on_from_its_end_is_joined_to_another(beside):
    """From the end of one curve to the end of another: two clicks."""
    pen = beside
    draw(pen, (30, 60), (80, 160), (140, 200))
    pen.key(Qt.Key.Key_Return)
    before = pen.session.document
    pen.click(at(pen, *WAVE[3]))
    pen.click(at(pen, 140, 200))
    assert names(pen) == ["There", "Ring"]
    assert positions(pen.curve) == [*positions(before.curves[0]), *positions(before.curves[2])[::-1]]
    for curve in (before.curves[0], before.curves[2]):
        assert farthest(curve, pen.curve) < 0.5 * pen.pixel or curve is before.curves[0]


def test_a_drag_at_the_end_pulls_the_handle_of_the_joining_segment(beside):
    pen = beside
    draw(pen, (30, 60), (120, 160))
    before, steps = pen.session.document, pen.session.undo_stack.count()
    (x, y), there_ = WAVE[0], before.curves[0]
    pen.press(at(pen, x, y))
    pen.move(at(pen, x + 30, y - 60))
    assert pen.status.startswith("Join Curve 1 and There, handle at ")
    pen.escape()
    pen.release(at(pen, x + 30, y - 60))
    assert pen.session.document is before
    pen.drag(at(pen, x, y), at(pen, x + 30, y - 60))
    assert names(pen) == ["Ring", "Curve 1"]
    assert pen.session.undo_stack.count() == steps + 1
    by_side = {each.ahead: each for each in handles_of(pen.session.active_view, 2)}
    assert by_side[False].position == pytest.approx(at(pen, x - 30, y + 60), abs=1e-9)
    assert pen.curve.points[2].corner
    assert farthest(there_, pen.curve) < 1e-3


@pytest.mark.parametrize("pulled", [False, True])
def test_alt_joins_with_a_corner(beside, pulled):
    pen = beside
    pen.click(at(pen, 30, 60))
    if pulled:
        pen.drag(at(pen, 120, 160), at(pen, 150, 190))
    else:
        pen.click(at(pen, 120, 160))
    pen.click(at(pen, *WAVE[0]), keys=ALT)
    point = pen.curve.points[2]
    assert is_straight(pen.curve, 1) is not pulled
    assert point.corner
    assert not point.tied
    if pulled:
        by_side = {each.ahead: each.position for each in handles_of(pen.session.active_view, 1)}
        assert by_side[True] == pytest.approx(at(pen, 150, 190), abs=1e-9)
        assert point.velocity == (0.0, 0.0)


@pytest.mark.parametrize(
    "family", [each for each in FAMILIES if each.interpolates], ids=lambda family: family.name
)
def test_every_family_joins_with_its_own(editor, family):
    """With the shape of the other curve kept; without velocities by its rule, where it has to."""
    pen = there(editor, family)
    pen.session.selected.activate(0)
    pen.key(Qt.Key.Key_Return)
    draw(pen, (30, 60), (80, 160), (140, 60))
    before = pen.session.document
    pen.hover(at(pen, *WAVE[0]))
    shown = pen.window.canvas.marks.preview_curve.source
    pen.click(at(pen, *WAVE[0]))
    assert names(pen) == ["Ring", "Curve 1"]
    assert pen.curve == shown
    assert pen.session.active_view.is_current
    assert positions(pen.curve) == [*positions(before.curves[2]), *positions(before.curves[0])]
    assert pen.curve.family == family
    if family.derivatives:
        assert farthest(before.curves[0], pen.curve) < 1e-3
    if family is LAGRANGE:
        assert "shapes changed" in pen.status
        rule = replace(before.curves[2], points=(*before.curves[2].points, *before.curves[0].points))
        assert sampled(pen.curve) == pytest.approx(sampled(rule), abs=1e-9)
    pen.trigger("undo")
    assert pen.session.document == before


def test_two_families_are_not_joined_and_nothing_is_lost(editor):
    pen = there(editor, QUINTIC_HERMITE)
    pen.session.selected.activate(1)
    draw(pen, (30, 60), (80, 160))
    assert pen.curve.family == HERMITE
    before = pen.session.document
    pen.hover(at(pen, *WAVE[0]))
    refusal = "One curve is cubic, the other quintic; choose one family for both."
    assert hint(pen) == refusal
    pen.click(at(pen, *WAVE[0]))
    assert pen.session.document == before
    assert pen.status == refusal
    pen.click(at(pen, 140, 60))
    assert len(pen.curve.points) == 3


def test_the_curve_drawn_stays_in_its_group_and_the_other_leaves_its_shape(editor):
    pen = there(editor)
    whole = (replace(curve, shape="Leaf", groups=("Plant",)) for curve in pen.session.document.curves)
    pen.session.commit(Document(tuple(whole)), "Begin", active=1)
    pen.session.selected.activate(1)
    draw(pen, (30, 60), (80, 160))
    drawn = pen.curve
    pen.click(at(pen, *WAVE[0]))
    assert names(pen) == ["Ring", "Curve 1"]
    assert (pen.curve.shape, pen.curve.groups) == (drawn.shape, drawn.groups)
    pen.trigger("undo")
    assert names(pen) == ["There", "Ring", "Curve 1"]
    assert pen.session.document.curves[0].shape == "Leaf"


def test_snapping_catches_no_end_that_the_pen_does_not(beside):
    """A press whose point would snap onto an end is within its reach."""
    pen = beside
    pen.trigger("toggleSnap")
    draw(pen, (30, 60), (80, 160))
    x, y = at(pen, *WAVE[0])
    for turn in range(8):
        angle = turn * math.pi / 4
        pen.hover((x + 7.9 * pen.pixel * math.cos(angle), y + 7.9 * pen.pixel * math.sin(angle)))
        assert hint(pen).startswith("Click to join with “There”")
    pen.trigger("toggleSnap")


def test_the_menu_of_the_canvas_knows_the_end_that_the_pen_is_on(beside):
    """A right-click there activates the curve, as one on a point of any curve does."""
    hit = beside.window.canvas.hit_at(
        beside.window.canvas.viewport().mapToGlobal(beside.window.canvas.to_pixel(*at(beside, *WAVE[3])))
    )
    assert (hit.curve, hit.index, hit.on_active_curve.part.name) == (0, 3, "POINT")


def test_the_sheet_lists_ends_of_open_curves(beside):
    from PySide6.QtWidgets import QLabel

    beside.key(Qt.Key.Key_F1)
    sheet = beside.window.findChild(object, "shortcutSheet")
    said = " ".join(label.text() for label in sheet.findChildren(QLabel))
    assert "continue that curve; while drawing, join with it" in said
