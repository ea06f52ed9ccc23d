"""Mirror images, and the pivot that they, rotations and scales are about; real keys and mouse."""

from __future__ import annotations

import math

import numpy as np
import pytest
from extents import CLOSE, box_shown, sampled_bounds
from msgspec.structs import replace
from PySide6.QtCore import QPoint, Qt
from PySide6.QtWidgets import QLineEdit

from app.document.model import Document, make_curve
from app.document.style import Style
from app.families import FAMILIES, HERMITE
from app.tools.snapping import SnapKind, Snapping
from tests.gui.editor_facts import retype, transform, undo_text

Key = Qt.Key
SHIFT, CTRL = Qt.KeyboardModifier.ShiftModifier, Qt.KeyboardModifier.ControlModifier
POINTS = ((0.0, 0.0), (1.0, 2.0), (3.0, 2.0), (4.0, 0.5))


@pytest.fixture
def two(editor):
    """Two curves, "Arch" is edited; "Base" lies below."""
    curves = (
        make_curve(POINTS, name="Arch", family=HERMITE),
        make_curve([(0, -2), (2, -1), (4, -2)], name="Base", family=HERMITE),
    )
    editor.session.commit(Document(curves), "Begin")
    editor.window.canvas.camera.show_box((-5, 9), (-5, 6))
    editor.settle()
    return editor


def points(editor, place=None):
    curves = editor.session.document.curves
    curve = editor.curve if place is None else curves[place]
    return np.array([point.position for point in curve.points])


def pivot(editor):
    return editor.window.canvas.marks.pivot


def choose_both(editor):
    editor.session.selected.set_curves({0, 1})


def angle_shown(editor):
    """The angle in the Transform panel."""
    editor.settle()
    return float(editor.window.findChild(QLineEdit, "transformAngle").text().replace("−", "-"))


# Flip


@pytest.mark.parametrize(("key", "axis", "way"), [("H", 0, "horizontally"), ("V", 1, "vertically")])
def test_a_key_mirrors_all_points_about_the_middle_of_the_curve(two, key, axis, way):
    before, centre = points(two), sampled_bounds(two).mean(axis=0)
    two.key(getattr(Key, f"Key_{key}"), SHIFT if key == "V" else Qt.KeyboardModifier.NoModifier)
    expected = before.copy()
    expected[:, axis] = 2 * centre[axis] - before[:, axis]
    assert points(two) == pytest.approx(expected, abs=CLOSE)
    assert undo_text(two) == f"Flip all 4 points {way}"
    two.trigger("undo")
    assert points(two).tolist() == before.tolist()


def test_a_mirror_image_is_no_rotation(two):
    """The angle was 180 or noise; a mirror image leans as far to the other side, and turns on from there."""
    document = two.session.document
    two.trigger("openTransform")
    angle = two.window.findChild(QLineEdit, "transformAngle")
    for degrees in (0.0, 30.0, 90.0, 120.0, 180.0, -90.0):
        two.session.commit(document, "Again")
        choose_both(two)
        retype(angle, str(degrees))
        before = points(two) - points(two)[0]
        for flip in ("flipHorizontally", "flipVertically"):
            case = degrees, flip
            two.trigger(flip)
            assert math.remainder(angle_shown(two) + degrees, 360.0) == pytest.approx(0.0, abs=1e-6), case
            two.trigger("rotateLeft")
            turned = math.remainder(angle_shown(two) - (90.0 - degrees), 360.0)
            assert turned == pytest.approx(0.0, abs=1e-6), case
            retype(angle, str(-degrees))
            assert math.remainder(angle_shown(two) + degrees, 360.0) == pytest.approx(0.0, abs=1e-6), case
            two.trigger(flip)
            assert angle_shown(two) == pytest.approx(degrees, abs=1e-6), case
            # The quarter turn was about the middle of another box.
            assert points(two) - points(two)[0] == pytest.approx(before, abs=CLOSE), case


def test_mirror_images_both_ways_turn_nothing(two):
    """Half a turn was told: 180 for what stood at 0, and −165 for what stood at 15."""
    choose_both(two)
    two.trigger("openTransform")
    for name in ("flipHorizontally", "flipVertically"):
        two.trigger(name)
    transform(two, "R", "15")
    for name in ("flipHorizontally", "flipVertically"):
        two.trigger(name)
    for told in (-15.0, 15.0, 0.0, 0.0):
        two.trigger("undo")
        assert angle_shown(two) == told


def test_selected_points_are_mirrored_alone(two):
    two.select([1, 2, 3])
    two.key(Key.Key_H)
    assert points(two).tolist() == [[0, 0], [4, 2], [2, 2], [1, 0.5]]
    assert undo_text(two) == "Flip 3 points horizontally"


def test_selected_curves_are_mirrored_together(two):
    choose_both(two)
    middle = sampled_bounds(two, 0, 1).mean(axis=0)
    before = [points(two, place) for place in (0, 1)]
    two.trigger("flipVertically")
    for place in (0, 1):
        assert points(two, place)[:, 0].tolist() == before[place][:, 0].tolist()
        assert points(two, place)[:, 1] == pytest.approx(2 * middle[1] - before[place][:, 1], abs=CLOSE)
    assert undo_text(two) == "Flip 2 curves vertically"


def test_the_mirror_image_of_a_curve_is_the_curve_of_the_mirrored_points(two):
    begin = two.session.document
    for family in FAMILIES:
        two.session.commit(begin, "Begin again")
        two.choose_family(family)
        two.session.change(
            "Set", lambda document: document.with_curve(0, with_velocity(document.curves[0], 1, (3.0, 1.0)))
        )
        before = two.session.active_view.curve
        x = two.window.canvas.tools.box.centre[0]
        two.key(Key.Key_H)
        t = np.linspace(*before.domain, 41)
        expected = before.evaluate(t) * (-1, 1) + (2 * x, 0)
        # Roundings of coordinates of about 4, which the basis may enlarge.
        now = two.session.active_view.curve.evaluate(t)
        assert now == pytest.approx(expected, abs=1e-12), family


def with_velocity(curve, index, velocity):
    new = list(curve.points)
    new[index] = replace(new[index], velocity=velocity)
    return replace(curve, points=tuple(new))


def test_the_palette_finds_flip_as_mirror(two):
    found = two.find_command("mirror")
    assert found[0] == "Mirror Tool"
    assert {"Flip Horizontally", "Flip Vertically"} <= set(found)


def test_flipping_a_locked_curve_is_refused(two):
    two.trigger("curveLocked")
    document = two.session.document
    two.key(Key.Key_H)
    assert two.session.document is document
    assert "locked" in two.status


# Pivot


def test_the_middle_of_the_box_is_marked(two):
    two.trigger("selectAll")
    assert pivot(two) == pytest.approx(box_shown(two).mean(axis=0))
    two.select([])
    assert pivot(two) is None


def drag_pivot(editor, to, **keys):
    start = pivot(editor)
    editor.hover(start)
    assert "Drag the pivot" in editor.window.status_line.hint
    editor.drag(start, to, **keys)


def test_the_pivot_is_dragged_and_rotations_are_about_the_pivot(two):
    two.trigger("selectAll")
    document = two.session.document
    drag_pivot(two, (-1.0, 1.0))
    assert pivot(two) == pytest.approx((-1.0, 1.0), abs=two.pixel)
    assert two.session.document is document, "no step of the history"
    x, y = pivot(two)
    transform(two, "R", "90")
    assert points(two) == pytest.approx(np.array([(x - (b - y), y + (a - x)) for a, b in POINTS]), abs=1e-12)
    # It stays where it is, so that the next turn is about the same place.
    assert pivot(two) == (x, y)
    two.key(Key.Key_H)
    assert points(two) == pytest.approx(np.array([(x + (b - y), y + (a - x)) for a, b in POINTS]), abs=1e-12)
    assert pivot(two) == (x, y)
    transform(two, "S", "2")
    expected = np.array([(x + 2 * (b - y), y + 2 * (a - x)) for a, b in POINTS])
    assert points(two) == pytest.approx(expected, abs=1e-12)
    two.trigger("undo")
    two.trigger("undo")
    assert pivot(two) == pytest.approx((x, y), abs=1e-12)


def test_escape_cancels_a_drag_of_the_pivot(two):
    two.trigger("selectAll")
    middle = pivot(two)
    two.press(middle)
    two.move((2.5, -3.0))
    assert pivot(two) == pytest.approx((2.5, -3.0), abs=two.pixel)
    assert "Pivot" in two.status
    two.escape()
    two.release((2.5, -3.0))
    assert pivot(two) == middle
    assert two.session.box.pivot is None


def test_a_double_click_resets_the_pivot_to_the_centre(two):
    two.trigger("selectAll")
    middle = pivot(two)
    drag_pivot(two, (-1.0, 1.0))
    document = two.session.document
    two.double_click(pivot(two))
    assert pivot(two) == middle
    assert two.session.box.pivot is None
    assert two.session.document is document


@pytest.mark.parametrize(
    ("look", "turns"),
    [
        ({"closed": True, "style": Style(fill="#ffcc00")}, False),
        ({"closed": True, "style": Style(fill="#ffcc00")}, True),
        ({"points": make_curve([(0, 0), (4, 2)]).points}, True),
    ],
)
def test_with_rotating_grips_the_pivot_is_hit_before_fill_and_line(two, look, turns):
    """The curve was dragged instead; before that, who presses in the middle means what lies there."""
    document = two.session.document
    two.session.commit(document.with_curve(0, replace(document.curves[0], **look)), "Look")
    two.session.selected.select_whole({0})
    two.session.box.set_turns(turns)
    before, middle = two.session.document, pivot(two)
    if turns:
        drag_pivot(two, (-1.0, 1.0))
        assert pivot(two) == pytest.approx((-1.0, 1.0), abs=two.pixel)
        assert two.session.document is before
    else:
        two.drag(middle, (middle[0] + 1.0, middle[1]))
        assert pivot(two) == pytest.approx((middle[0] + 1.0, middle[1]), abs=2 * two.pixel)
        assert two.session.undo_stack.undoText().startswith("Move")


@pytest.mark.parametrize("keys", [Qt.KeyboardModifier.NoModifier, SHIFT])
@pytest.mark.parametrize("turns", [False, True])
def test_a_click_on_the_pivot_reaches_the_curve_below(editor, turns, keys):
    """The pivot swallowed it: no ellipse in the middle of a chosen rectangle was chosen by its middle."""
    editor.window.canvas.camera.show_box((-7, 7), (-5, 5))
    editor.settle()
    for tool, reach in (("rectangleTool", 4.0), ("ellipseTool", 2.0)):
        editor.trigger(tool)
        editor.drag((-reach, -reach), (reach, reach))
        editor.session.change(
            "Fill",
            lambda document: document.with_curve(
                len(document.curves) - 1,
                replace(document.curves[-1], style=replace(document.curves[-1].style, fill="#ffcc00")),
            ),
        )
    editor.trigger("selectTool")
    *_, rectangle, ellipse = range(len(editor.session.document.curves))
    selected = editor.session.selected
    selected.select_whole([rectangle])
    editor.session.box.set_turns(turns)
    editor.settle()
    document = editor.session.document
    editor.click((0.0, 0.0), keys=keys)
    assert selected.whole_curves == ({rectangle, ellipse} if keys else {ellipse})
    assert editor.session.document is document
    assert editor.session.box.pivot is None


def shows_cross(editor):
    """Whether the cross is seen at the left of the pivot, where no line of a curve is."""
    canvas = editor.window.canvas
    place = canvas.to_pixel(*pivot(editor)) - QPoint(5, 0)
    return canvas.viewport().grab().toImage().pixelColor(place).saturation() > 60


def test_a_visible_pivot_can_be_dragged(two):
    """In a small box it was seen and a drag moved the object; with grips that turn, it is what matters."""
    two.window.canvas.camera.show_box((-60, 60), (-36, 36))
    two.session.selected.select_whole({0})
    assert not shows_cross(two)
    two.session.box.set_turns(True)
    two.settle()
    assert shows_cross(two)
    before = two.session.document
    drag_pivot(two, (-10.0, 10.0))
    assert pivot(two) == pytest.approx((-10.0, 10.0), abs=two.pixel)
    assert two.session.document is before


def test_a_drag_in_the_centre_of_a_small_box_moves_the_selection(two):
    two.window.canvas.camera.show_box((-100, 100), (-60, 60))
    two.session.selected.select_whole({0})
    before, middle = points(two), pivot(two)
    two.drag(middle, (middle[0] + 20, middle[1]))
    assert points(two)[:, 0] == pytest.approx(before[:, 0] + 20, abs=two.pixel)
    assert two.session.box.pivot is None


def test_without_a_selection_there_is_no_pivot(two):
    two.trigger("selectAll")
    drag_pivot(two, (-1.0, 1.0))
    place = pivot(two)
    two.session.selected.select_whole({0})
    assert pivot(two) == place, "the curve as a whole has that of its points"
    two.session.selected.select_whole(())
    assert pivot(two) is None
    document = two.session.document
    two.key(Key.Key_H)
    assert two.session.document is document
    assert "No curve is selected" in two.status


def test_the_pivot_moves_with_its_selection(two):
    two.trigger("selectAll")
    drag_pivot(two, (-1.0, 1.0))
    x, y = pivot(two)
    transform(two, "G", "2")
    assert pivot(two) == pytest.approx((x + 2, y))
    start = two.grip(1, 1)
    box = box_shown(two)
    two.drag(start, (start[0] + 1, start[1] + 1))
    grown = np.ptp(box_shown(two), axis=0) / np.ptp(box, axis=0)
    assert pivot(two) == pytest.approx(box[0] + (np.array([x + 2, y]) - box[0]) * grown, abs=1e-9)


def test_the_pivot_is_reset_with_the_selection_and_restored_with_the_selection(two):
    two.trigger("selectAll")
    drag_pivot(two, (-1.0, 1.0))
    place = pivot(two)
    two.select([1, 2])
    assert pivot(two) == pytest.approx((2.0, 2.0))
    two.trigger("selectAll")
    assert pivot(two) == place
    two.session.new()
    assert two.session.box.pivot is None


def test_a_new_selection_has_no_moved_pivot(two):
    """A width that was typed for another rectangle grew away from somewhere odd."""

    def draw(low, high):
        two.trigger("rectangleTool")
        two.drag(low, high)
        two.trigger("selectTool")
        two.trigger("selectAll")
        return sampled_bounds(two, two.session.active_index).mean(axis=0)

    draw((5.0, 0.0), (8.0, 2.0))
    place, first = two.session.active_index, two.curve.name
    drag_pivot(two, (4.0, -4.0))
    own = pivot(two)
    # Another one comes into its place in the order, while nothing is chosen of either.
    draw((-4.0, 0.0), (-2.0, 4.0))
    two.session.change(
        "Order",
        lambda document: replace(
            document, curves=(*document.curves[:place], *document.curves[: place - 1 : -1])
        ),
    )
    two.session.selected.activate(place)
    two.trigger("selectAll")
    assert two.curve.name != first
    assert pivot(two) == pytest.approx(sampled_bounds(two, place).mean(axis=0), abs=CLOSE)
    two.session.selected.activate(place + 1)
    two.trigger("selectAll")
    assert pivot(two) == own, "it is still that of the first"
    two.session.selected.select_whole([place + 1])
    two.trigger("deleteCurve")
    middle = draw((-3.0, -4.0), (0.0, 3.0))
    assert two.session.active_index == place + 1
    assert pivot(two) == pytest.approx(middle, abs=CLOSE)


def test_copies_keep_the_pivot(two):
    two.trigger("selectAll")
    drag_pivot(two, (-1.0, 1.0))
    place = pivot(two)
    two.key(Key.Key_D, CTRL)
    assert len(two.session.document.curves) == 3
    assert pivot(two) == place
    transform(two, "R", "72")
    assert pivot(two) == place
    two.key(Key.Key_D, CTRL)
    assert pivot(two) == place


def test_the_pivot_snaps_to_a_point_and_to_the_box(two):
    two.window.canvas.tools.snapping.settings = Snapping(True, frozenset({SnapKind.POINTS}))
    two.trigger("selectAll")
    box = box_shown(two)
    drag_pivot(two, (4.0 + 3 * two.pixel, 0.5 - 2 * two.pixel))
    assert pivot(two) == (4.0, 0.5)
    two.drag(pivot(two), (box[0][0] + 3 * two.pixel, box[1][1] + 3 * two.pixel))
    assert pivot(two) == (box[0][0], box[1][1])


def test_shift_scales_by_a_grip_about_the_pivot(two):
    two.trigger("selectAll")
    before = box_shown(two)
    drag_pivot(two, (-1.0, -1.0))
    x, y = pivot(two)
    start = two.grip(1, 1)
    two.drag(start, (start[0] + 1, start[1] + 1), keys=SHIFT)
    factors = (box_shown(two)[1] - (x, y)) / (before[1] - (x, y))
    assert factors == pytest.approx(
        [(before[1][0] + 1 - x) / (before[1][0] - x), (before[1][1] + 1 - y) / (before[1][1] - y)],
        abs=2 * two.pixel,
    )
    assert box_shown(two)[0] == pytest.approx((x, y) + factors * (before[0] - (x, y)), abs=2 * two.pixel)
    # A twentieth of a pixel is what a drag leaves of a curve that answers with another shape.
    assert pivot(two) == pytest.approx((x, y), abs=0.05 * two.pixel)


def test_the_round_grip_rotates_about_the_pivot(two):
    two.trigger("selectAll")
    drag_pivot(two, (-1.0, -1.0))
    x, y = pivot(two)
    start = np.array(two.grip())
    way = start - (x, y)
    two.drag(tuple(start), (x - way[1], y + way[0]), keys=CTRL)
    assert points(two) == pytest.approx(np.array([(x - (b - y), y + (a - x)) for a, b in POINTS]), abs=1e-12)


def test_the_box_is_live_while_curves_are_dragged(two):
    choose_both(two)
    before = box_shown(two)
    two.key(Key.Key_R)
    two.move((6, 3), held=False)
    marks = two.window.canvas.marks
    assert marks.box is None
    frame = np.array([marks.frame.low, marks.frame.high])
    assert frame != pytest.approx(before, abs=0.1)
    # The polyline that is drawn, within a thousandth of the size of the curves.
    assert frame == pytest.approx(sampled_bounds(two, 0, 1), abs=0.01)
    two.escape()
    assert two.window.canvas.marks.frame is None
    assert box_shown(two) == pytest.approx(before)


def test_the_pivot_of_a_turn_is_marked_also_without_a_box(two):
    two.key(Key.Key_R)
    assert pivot(two) == pytest.approx(sampled_bounds(two).mean(axis=0), abs=CLOSE)
    two.move((6, 3), held=False)
    assert math.dist(pivot(two), sampled_bounds(two).mean(axis=0)) < 2
    two.escape()
    assert pivot(two) is None


# Larger and smaller


def test_one_of_several_curves_does_not_rotate_about_the_common_pivot(two):
    """Each of them did, and its place was told as that of a corner far away."""
    two.session.selected.select_whole([0, 1])
    two.session.box.set_turns(True)
    drag_pivot(two, (6.0, 4.0))
    chosen = pivot(two)
    two.session.selected.select_whole([0])
    assert pivot(two) == pytest.approx((2, 1), abs=0.3)
    two.session.selected.select_whole([0, 1])
    assert pivot(two) == pytest.approx(chosen)
