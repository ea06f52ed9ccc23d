"""The Mirror tool: a line by two clicks or a drag, as a copy or in place; and mirroring about an axis."""

from __future__ import annotations

import math
from fractions import Fraction

import pytest
from PySide6.QtCore import Qt

from app.document.model import Document, ParametrizationKind, make_curve
from app.document.transforms import reflection_about
from app.families import HERMITE
from app.tools.snapping import SnapKind, Snapping
from tests.gui.editor_facts import undo_text

Key = Qt.Key
SHIFT, CTRL = Qt.KeyboardModifier.ShiftModifier, Qt.KeyboardModifier.ControlModifier
POINTS = ((0.0, 0.0), (1.0, 2.0), (3.0, 2.5), (4.0, 0.5))
LINE = (-1.0, -2.0), (3.0, -1.0)
ROUNDING = 1e-12
"""A reflection of numbers below 10 takes ten operations."""


@pytest.fixture
def two(editor):
    """Two curves, "Arch" is edited; "Base" lies below."""
    curves = (
        make_curve(POINTS, name="Arch", family=HERMITE),
        make_curve([(0, -2), (2, -1), (4, -2)], name="Base", family=HERMITE),
    )
    editor.session.commit(Document(curves), "Begin")
    editor.window.canvas.camera.show_box((-6, 9), (-7, 6))
    editor.settle()
    editor.trigger("mirrorTool")
    return editor


def mirrored(point, start, end):
    """The mirror image by exact fractions: p − 2 n (n · (p − a)) / n²."""
    a, b, p = ([Fraction(value) for value in pair] for pair in (start, end, point))
    n = (-(b[1] - a[1]), b[0] - a[0])
    share = 2 * (n[0] * (p[0] - a[0]) + n[1] * (p[1] - a[1])) / (n[0] ** 2 + n[1] ** 2)
    return float(p[0] - share * n[0]), float(p[1] - share * n[1])


def ends(editor, line=LINE):
    """The positions of whole pixels at which the mouse is: where the line really goes through."""
    canvas = editor.window.canvas
    return tuple(canvas.to_plane(canvas.to_pixel(*at)) for at in line)


def positions(curve):
    return [point.position for point in curve.points]


def click_twice(editor, line=LINE, **keys):
    start, end = ends(editor, line)
    editor.click(start)
    editor.hover(end)
    editor.click(end, **keys)
    return start, end


def test_two_clicks_mirror_a_copy_about_their_line(two):
    before, steps = two.session.document, two.session.undo_stack.count()
    assert two.window.status_line.hint.startswith("Click two positions of the mirror line")
    start, end = click_twice(two)
    arch, copy, base = two.session.document.curves
    assert (arch, base) == before.curves
    assert copy.name == "Arch copy"
    for point, image in zip(arch.points, copy.points, strict=True):
        assert image.position == pytest.approx(mirrored(point.position, start, end), abs=ROUNDING)
    assert undo_text(two) == "Mirror a copy of Arch"
    assert two.session.undo_stack.count() == steps + 1
    assert two.session.active_index == 1
    two.trigger("undo")
    assert two.session.document == before


def test_the_mirror_image_is_live_between_the_clicks_and_escape_removes_it(two):
    before, steps = two.session.document, two.session.undo_stack.count()
    start, end = ends(two)
    two.click(start)
    assert two.session.document == before
    assert two.status == "Click another position: the mirror line goes through two."
    two.hover(end)
    canvas = two.window.canvas
    assert len(two.session.document.curves) == 3
    assert canvas.marks.axis[0] == pytest.approx(start)
    assert two.status.startswith("Mirror a copy of Arch about a line at 14.1° · click or release: done")
    first = positions(two.session.document.curves[1])
    two.hover((3.0, 2.0))
    assert positions(two.session.document.curves[1]) != first
    two.escape()
    assert two.session.document == before
    assert two.session.undo_stack.count() == steps
    assert canvas.marks.axis is None
    assert two.session.selected.is_editing
    # The next click begins another line.
    click_twice(two)
    assert len(two.session.document.curves) == 3


def test_a_drag_along_the_line_mirrors_as_well(two):
    start, end = ends(two)
    two.drag(start, end)
    arch, copy, _ = two.session.document.curves
    assert positions(copy)[2] == pytest.approx(mirrored(positions(arch)[2], start, end), abs=ROUNDING)


def test_ctrl_or_shift_keeps_the_line_at_steps_of_15_degrees(two):
    start, _ = ends(two)
    for keys, count in ((CTRL, 3), (SHIFT, 4)):
        two.press(start)
        two.move((start[0] + 4.0, start[1] + 0.1), keys=keys)
        two.release((start[0] + 4.0, start[1] + 0.1), keys=keys)
        assert len(two.session.document.curves) == count
        image = positions(two.session.document.curves[1])
        # About a horizontal line, exactly.
        assert [x for x, _ in image] == [x for x, _ in POINTS]
        assert [y for _, y in image] == [2 * start[1] - y for _, y in POINTS]
        two.session.selected.activate(0)


def test_both_positions_snap(two):
    two.window.canvas.tools.snapping.settings = Snapping(on=True, kinds=frozenset({SnapKind.POINTS}))
    near = 5 / two.window.canvas.pixel_map.sx
    click_twice(two, ((0 + near, -2 + near), (4 - near, -2 - near)))
    assert [y for _, y in positions(two.session.document.curves[1])] == [-4 - y for _, y in POINTS]


def test_a_line_through_one_position_is_refused(two):
    before = two.session.document
    start, _ = ends(two)
    two.click(start)
    two.click(start)
    assert two.session.document == before
    assert two.status == "Click another position: the mirror line goes through two."
    assert two.window.canvas.marks.axis is None


# In place


@pytest.fixture
def in_place(two):
    two.trigger("mirrorInPlace")
    return two


def test_in_place_the_curve_itself_is_mirrored(in_place):
    start, end = click_twice(in_place)
    assert len(in_place.session.document.curves) == 2
    expected = [mirrored(point, start, end) for point in POINTS]
    for position, image in zip(positions(in_place.curve), expected, strict=True):
        assert position == pytest.approx(image, abs=ROUNDING)
    assert undo_text(in_place) == "Mirror all 4 points"


def test_selected_points_alone_are_mirrored_in_place_with_handles_corners_and_ties(in_place):
    # Under a rule by distances other velocities would be rescaled.
    in_place.choose_parametrization(ParametrizationKind.UNIFORM)
    in_place.trigger("selectTool")
    in_place.select([1, 2])
    in_place.trigger("tangentCorner")
    in_place.select([1])
    in_place.trigger("tangentSmooth")
    in_place.select([1, 2])
    before = in_place.curve
    in_place.trigger("mirrorTool")
    start, end = click_twice(in_place)
    after, origin = in_place.curve, (0.0, 0.0)
    along = (end[0] - start[0], end[1] - start[1])
    assert undo_text(in_place) == "Mirror 2 points"
    assert (after.points[0], after.points[3]) == (before.points[0], before.points[3])
    for index in (1, 2):
        old, new = before.points[index], after.points[index]
        assert new.position == pytest.approx(mirrored(old.position, start, end), abs=ROUNDING)
        assert new.velocity == pytest.approx(mirrored(old.velocity, origin, along), abs=1e-11)
        assert new.velocity_after == pytest.approx(mirrored(old.velocity_after, origin, along), abs=1e-11)
        assert (new.corner, new.tied) == (old.corner, old.tied)
    assert [point.tied for point in after.points] == [False, True, False, False]


def test_a_locked_curve_is_not_mirrored_but_its_copy_is(in_place):
    in_place.trigger("curveLocked")
    before = in_place.session.document
    in_place.click(LINE[0])
    assert "locked" in in_place.status
    assert in_place.session.document == before
    in_place.trigger("mirrorCopy")
    click_twice(in_place)
    assert [curve.locked for curve in in_place.session.document.curves] == [True, False, False]


# Several curves, shapes, groups, styles


def test_whole_curves_of_a_group_are_copied_with_their_styles(two):
    two.trigger("selectTool")
    two.session.selected.set_curves({0, 1})
    two.trigger("groupCurves")
    two.trigger("mirrorTool")
    assert len(two.session.selected.whole_curves) == 2
    start, end = click_twice(two)
    document = two.session.document
    names = [curve.name for curve in document.curves]
    assert names == ["Arch", "Base", "Arch copy", "Base copy"]
    assert document.curves[2].groups == document.curves[3].groups != document.curves[0].groups
    assert [copy.style for copy in document.curves[2:]] == [curve.style for curve in document.curves[:2]]
    assert two.session.selected.whole_curves == {2, 3}
    assert positions(document.curves[3])[1] == pytest.approx(mirrored((2, -1), start, end), abs=ROUNDING)
    two.trigger("undo")
    assert len(two.session.document.curves) == 2


def test_nothing_selected_is_said(two):
    two.trigger("selectTool")
    two.session.selected.select_whole([])
    two.trigger("mirrorTool")
    before = two.session.document
    two.click(LINE[0])
    assert two.session.document == before
    assert two.status.startswith("No curve is selected.")


# About an axis


@pytest.mark.parametrize(("key", "axis"), [("X", 1), ("Y", 0)])
def test_a_key_of_the_tool_mirrors_about_an_axis(two, key, axis):
    two.hover((1, 1))
    two.key(getattr(Key, f"Key_{key}"))
    sign = [-1 if other == axis else 1 for other in (0, 1)]
    expected = [(sign[0] * x, sign[1] * y) for x, y in POINTS]
    assert positions(two.session.document.curves[1]) == expected
    assert undo_text(two) == f"Mirror a copy of Arch about the {key.lower()} axis"
    assert two.status == f"Mirrored a copy of Arch about the {key.lower()} axis."


@pytest.mark.parametrize("by_action", [False, True])
def test_an_image_outside_the_view_is_said(two, by_action):
    two.window.canvas.camera.show_box((-1, 9), (-3, 5))
    two.settle()
    two.hover((1, 1))
    two.trigger("mirrorYAxis") if by_action else two.key(Key.Key_Y)
    assert positions(two.session.document.curves[1]) == [(-x, y) for x, y in POINTS]
    assert two.status == (
        "Mirrored a copy of Arch about the y axis. Part of it is outside the view; “Fit Selection” shows it."
    )
    two.trigger("fitSelection")
    assert two.window.canvas.framing.shows_curves([1])


def test_actions_mirror_about_an_axis_and_say_whether_a_copy(two):
    action = two.action("mirrorXAxis")
    assert action.text().replace("&", "") == "Mirror a Copy about the x Axis"
    two.trigger("mirrorInPlace")
    assert action.text().replace("&", "") == "Mirror about the x Axis"
    two.trigger("selectTool")
    two.trigger("mirrorXAxis")
    assert positions(two.curve) == [(x, -y) for x, y in POINTS]
    assert len(two.session.document.curves) == 2


@pytest.mark.parametrize("scale", [1e-150, 1.0, 1e9])
def test_reflections_are_their_own_inverse_at_any_size(scale):
    by = reflection_about((0.0, 0.0), (3.0 * scale, 4.0 * scale))
    x, y = by.point((5.0, 0.0))
    # The direction (3, 4) / 5 at twice its angle: cos = 2 · 9/25 − 1, sin = 2 · 12/25.
    assert (x, y) == pytest.approx((5 * -7 / 25, 5 * 24 / 25), rel=1e-15)
    assert by.point((x, y)) == pytest.approx((5.0, 0.0), abs=1e-14)
    assert math.hypot(x, y) == pytest.approx(5.0, rel=1e-15)
