"""Position readout of moving points in the status line and beside the pointer."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel

from app.document.transforms import round_step_above

SHIFT = Qt.KeyboardModifier.ShiftModifier
RIGHT, UP = Qt.Key.Key_Right, Qt.Key.Key_Up


def position_text(editor):
    """The numbers at the right of the status line."""
    editor.wait_for_rest(up_to_ms=50)
    return editor.window.statusBar().findChild(QLabel, "pointerPlace").text()


def test_the_status_line_shows_the_position_of_a_dragged_point(arch):
    arch.press(arch.point(1))
    arch.move((1.5, 2.25))
    assert arch.status.startswith("Point 1 at ")
    x, y = arch.point(1)
    assert f"Point 1 at {x:.4g}, {y:.4g} · moved {x - 1:.4g}, {y - 2:.4g}" in arch.status
    arch.release((1.5, 2.25))


def test_the_status_line_shows_the_snapped_position_not_the_pointer(arch):
    near = arch.window.canvas.tools.canvas.grid_spacing() * 3
    arch.trigger("toggleSnap")
    arch.press(arch.point(1))
    arch.move((1 + near + 3 * arch.pixel, 2 + 2 * arch.pixel))
    place = arch.point(1)
    assert place == pytest.approx((1 + near, 2.0), abs=1e-12)
    assert f"Point 1 at {place[0]:.4g}, 2 · moved {near:.4g}, 0" in arch.status
    assert position_text(arch) == f"x {place[0]:.4g}   y 2"
    arch.escape()
    arch.release((1 + near, 2.0))


def test_the_status_line_shows_the_position_along_one_axis(arch):
    arch.press(arch.point(2), keys=SHIFT)
    arch.move((4.0, 2.2), keys=SHIFT)
    assert f"Point 2 at {arch.point(2)[0]:.4g}, 2 · " in arch.status
    assert position_text(arch).endswith("y 2")
    arch.release((4.0, 2.2), keys=SHIFT)


def test_the_status_line_shows_the_offset_of_several_points(arch):
    arch.select([1, 2])
    arch.press(arch.point(1))
    arch.move((1.5, 2.0))
    assert arch.status.startswith(f"Move 2 points by {arch.point(1)[0] - 1:.4g}, 0")
    assert position_text(arch).startswith(f"x {arch.point(1)[0]:.4g}")
    arch.release((1.5, 2.0))


def test_the_position_of_the_pointer_returns_after_the_drag(arch):
    arch.drag_point(1, to=(1.5, 2.25))
    arch.hover((5.0, 1.0))
    assert position_text(arch).startswith("x 5") or position_text(arch).startswith("x 4.99")


def test_a_transform_by_key_shows_the_position_of_its_single_point(arch):
    arch.select([1])
    arch.hover((1.0, 2.0))
    arch.trigger("moveSelection")
    arch.type_amount("2")
    assert arch.status.startswith("Move 2, 0 · Point 1 at 3, 2 · ")
    assert arch.window.canvas.marks.note.text == "Move 2, 0"
    arch.hover((1.5, 2.5))
    assert position_text(arch) == "x 3   y 2"
    arch.key(Qt.Key.Key_S)
    arch.hover((1.6, 2.5))
    assert position_text(arch).startswith("x 1.6") or position_text(arch).startswith("x 1.59")
    arch.escape()


def test_nudges_display_the_position_and_the_step(arch):
    arch.select([1])
    arch.key(RIGHT)
    step = round_step_above(2 * arch.pixel)
    assert arch.status == f"Point 1 at {1 + step:.4g}, 2 · step {step:.4g}, 0"
    arch.select([1, 2])
    arch.key(UP)
    assert arch.status == f"2 points nudged · step 0, {step:.4g}"


def test_nudges_on_the_grid_show_the_step(arch):
    arch.trigger("toggleSnap")
    arch.select([2])
    fine = arch.window.canvas.tools.canvas.grid_spacing()
    arch.key(RIGHT)
    assert arch.status == f"Point 2 at {3 + fine:.4g}, 2 · step {fine:.4g}, 0"


def test_the_position_is_never_cut_off(arch):
    arch.window.resize(1280, 800)
    arch.set_unit("mm")
    label = arch.window.statusBar().findChild(QLabel, "pointerPlace")
    for thousandths in range(10, 10_000, 111):
        # Each from no room at all, so that it gets as much as it needs and no more.
        arch.window.status_line.readouts.show_position(None)
        arch.window.status_line.readouts.render()
        arch.window.status_line.readouts.show_position((-7.265, -thousandths / 1000))
        arch.window.status_line.readouts.render()
        arch.settle()
        room = label.contentsRect().width()
        shown = label.fontMetrics().elidedText(label.text(), Qt.TextElideMode.ElideRight, room)
        assert shown == label.text()
        assert shown.endswith(" mm")
