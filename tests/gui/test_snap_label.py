"""What a snap shows: a line of the grid or a crossing, and words that cover neither number nor curve."""

from __future__ import annotations

import numpy as np
import pytest
from PySide6.QtCore import QPointF, QRectF, QSizeF, Qt
from PySide6.QtGui import QColor

from app.appearance.theme import LIGHT
from app.document.model import Document, make_curve
from app.families import HERMITE
from app.plotting.pixel_map import PixelMap
from app.plotting.text import NOTHING, Surroundings, covered_lengths, free_corner

SHIFT = Qt.KeyboardModifier.ShiftModifier
POINTS = ((0.0, 0.0), (1.03, 2.04), (3.07, 2.11), (4.0, 0.0))
SHOWN = PixelMap(0.0, 0.0, 1.0, 1.0, 400.0, 300.0)
SIZE = QSizeF(40, 16)


@pytest.fixture
def snapping(editor):
    """A Hermite curve over a grid of 0.5, to which points snap."""
    editor.session.commit(Document((make_curve(POINTS, family=HERMITE),), grid_spacing=0.5), "Begin")
    editor.window.canvas.camera.show_box((-3, 7), (-3, 5))
    editor.trigger("toggleSnap")
    return editor


# The corner


def test_the_length_of_segments_inside_a_box_is_measured():
    boxes = [QRectF(10, 10, 20, 10), QRectF(100, 100, 5, 5)]
    segments = np.array(
        [
            [0.0, 15, 100, 15],  # all the way through
            [20, 0, 20, 15],  # half way down
            [0, 0, 9, 9],  # before it
            [25, 12, 28, 16],  # inside, 5 long
            [10, 0, 10, 5],  # above its edge
        ]
    )
    assert covered_lengths(segments, boxes) == pytest.approx([20 + 5 + 5, 0], abs=1e-6)
    assert covered_lengths(np.empty((0, 4)), boxes).tolist() == [0, 0]


def test_the_label_is_right_and_below_unless_another_side_covers_less():
    place = QPointF(200, 150)

    def centre(*segments, words=()):
        lines = np.array(segments, dtype=float).reshape(-1, 4)
        around = Surroundings(lines, words)
        box = free_corner(place, SIZE, (8, 7), around, SHOWN)
        return (box.center().x() > place.x(), box.center().y() > place.y())

    falling, rising = (100, 50, 300, 250), (100, 250, 300, 50)
    assert centre() == (True, True)
    assert centre(falling) == (False, True)
    assert centre(falling, (200, 150, 100, 250)) == (True, False)
    assert centre(rising, words=[QRectF(205, 160, 10, 10)]) == (False, False)


@pytest.mark.parametrize("place", [(395, 150), (5, 150), (200, 295), (395, 295), (2, 2)])
def test_the_label_stays_inside_the_drawing(place):
    box = free_corner(QPointF(*place), SIZE, (8, 7), NOTHING, SHOWN)
    assert QRectF(0, 0, 400, 300).contains(box)
    assert not box.contains(QPointF(*place))


# On the canvas


DRAGS = [
    (1, (1.5, 3.5)),
    (1, (1.5, 2.75)),
    (1, (1.25, 1.5)),
    (2, (3.5, 3.0)),
    (0, (-1.0, 1.0)),
    (3, (5.0, 1.5)),
]


def test_the_label_covers_neither_the_number_nor_the_curve(snapping):
    for index, to in DRAGS:
        canvas = snapping.window.canvas
        snapping.press(snapping.point(index))
        snapping.move((to[0] + 2 * snapping.pixel, to[1] + 2 * snapping.pixel))
        label = canvas.drawing.marks.snap_label_rect
        shown = canvas.pixel_map
        number = next(
            centre for number, (centre, _) in enumerate(canvas.drawing.points.numbers) if number == index
        )
        assert not label.contains(number), (index, to)
        view = snapping.session.active_view
        t = np.linspace(*view.curve.domain, 4001)
        covered = [label.contains(QPointF(*pixel)) for pixel in shown.points(view.curve.evaluate(t)).tolist()]
        assert not any(covered), (index, to)
        place = shown.point(*canvas.marks.snap.position)
        assert label.adjusted(-12, -12, 12, 12).contains(QPointF(*place)), (index, to)
        snapping.escape()


def column(editor, place, up):
    """The colour of the pixel so far above a place of the canvas."""
    canvas = editor.window.canvas
    editor.settle()
    pixel = canvas.to_pixel(*place)
    image = canvas.grab().toImage()
    return [image.pixel(pixel.x() + x, pixel.y() - up) for x in (-1, 0, 1)]


def has_accent(editor, place, between):
    # A smooth line between two columns of pixels has half of its colour in each.
    wanted = 0.4 * _blueness(LIGHT.accent)
    pixels = (QColor(pixel) for up in range(*between) for pixel in column(editor, place, up))
    return any(_blueness(pixel) > wanted for pixel in pixels)


def _blueness(colour):
    return colour.blue() - colour.red()


def test_snapping_to_one_grid_line_marks_the_line(snapping):
    snapping.trigger("addTool")
    place = (5.5, 1.73)
    snapping.hover(place)
    snap = snapping.window.canvas.marks.snap
    assert (snap.label, snap.grid_line, snap.axes) == ("grid x", 0, (0,))
    assert has_accent(snapping, place, (30, 60))
    snapping.hover((5.5, 1.5))
    snap = snapping.window.canvas.marks.snap
    assert (snap.label, snap.grid_line, snap.axes) == ("grid", None, (0, 1))
    assert has_accent(snapping, (5.5, 1.5), (2, 8))
    assert not has_accent(snapping, (5.5, 1.5), (30, 60))
    snapping.hover((5.73, 1.5))
    snap = snapping.window.canvas.marks.snap
    assert (snap.label, snap.grid_line) == ("grid y", 1)
    snapping.escape()
    assert snapping.window.canvas.marks.snap is None
    assert not has_accent(snapping, place, (30, 60))


def test_a_drag_along_an_axis_is_labelled_with_the_snapped_line(snapping):
    document = snapping.session.document
    snapping.press(snapping.point(1))
    snapping.move((2.5 + 2 * snapping.pixel, 2.1), keys=SHIFT)
    assert snapping.window.canvas.marks.snap.label == "grid x"
    assert snapping.status.endswith("snapped to: grid x")
    snapping.escape()
    assert snapping.window.canvas.marks.snap is None
    snapping.release((2.5, 2.1))
    assert snapping.session.document is document


def test_level_with_a_neighbour_and_on_a_line_of_the_grid(snapping):
    snapping.press(snapping.point(1))
    snapping.move((1.5 + 2 * snapping.pixel, 2.11 + 2 * snapping.pixel))
    snap = snapping.window.canvas.marks.snap
    assert (snap.label, snap.grid_line) == ("grid x · level with point 2", 0)
    assert len(snap.guides) == 1
    snapping.escape()
