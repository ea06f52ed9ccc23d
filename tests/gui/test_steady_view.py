"""The drawing stays where it is on the screen while what stands beside the canvas comes, goes and moves."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest

LEFT = Qt.MouseButton.LeftButton


def scale_and_origin(editor):
    """Return pixels per unit, and where the point 0 lies in the window."""
    canvas = editor.window.canvas
    shown = canvas.pixel_map
    place = canvas.viewport().mapTo(editor.window, canvas.to_pixel(*editor.point(0)))
    return shown.sx, shown.sy, place


def drag_border(editor, handle, by):
    middle = handle.rect().center()
    QTest.mousePress(handle, LEFT, pos=middle)
    QTest.mouseMove(handle, middle + by)
    QTest.mouseRelease(handle, LEFT, pos=middle + by)
    editor.settle()


def drag_the_splitter(editor):
    drag_border(editor, editor.window.splitter.handle(1), QPoint(0, -90))


CHANGES = {
    "the basis functions": lambda editor: editor.trigger("toggleBasis"),
    "the side panel": lambda editor: editor.trigger("toggleSidePanel"),
    "the border below": drag_the_splitter,
    "a plot": lambda editor: editor.trigger("plotCurvature"),
    "a panel at the left": lambda editor: editor.show_dock("lessonsDock"),
    "the rulers": lambda editor: editor.trigger("toggleRulers"),
}


@pytest.mark.parametrize("is_fitted", [True, False], ids=["fitted", "zoomed"])
@pytest.mark.parametrize("change", CHANGES.values(), ids=CHANGES)
def test_scale_and_position_stay_when_panels_are_resized(editor, change, is_fitted):
    canvas = editor.window.canvas
    if not is_fitted:
        editor.trigger("zoomIn")
    size, before = canvas.size(), scale_and_origin(editor)
    change(editor)
    editor.settle()
    assert canvas.size() != size or canvas.rulers.thickness == 0
    after = scale_and_origin(editor)
    assert after[:2] == pytest.approx(before[:2], rel=1e-12)
    # Hiding the basis functions enlarged the drawing 1.5 times.
    assert (after[2] - before[2]).manhattanLength() <= 1


def test_hiding_and_reopening_a_panel_does_not_move_the_view(editor):
    editor.trigger("zoomIn")
    before = editor.window.canvas.pixel_map.box
    for name in ("toggleBasis", "toggleSidePanel") * 2:
        editor.trigger(name)
    assert editor.window.canvas.pixel_map.box == pytest.approx(before, rel=1e-12)


@pytest.mark.parametrize(
    "touch",
    [None, lambda editor: editor.trigger("zoomIn"), lambda editor: editor.add_point(1.0, 1.0)],
    ids=["untouched", "zoomed", "drawn"],
)
def test_a_window_of_another_size_is_fitted_again_while_nothing_was_touched(new_editor, touch):
    editor, canvas = new_editor, new_editor.window.canvas
    if touch:
        touch(editor)
    before = scale_and_origin(editor)
    editor.window.resize(editor.window.width() + 150, editor.window.height() + 150)
    editor.settle()
    scale, fitted = canvas.pixel_map.sx, canvas.framing.is_as_fitted
    if touch:
        assert not fitted
        assert scale_and_origin(editor) == (
            pytest.approx(before[0], rel=1e-12),
            pytest.approx(before[1], rel=1e-12),
            before[2],
        )
    else:
        assert fitted
        assert scale > before[0]
        editor.fit()
        assert canvas.pixel_map.sx == pytest.approx(scale, rel=1e-12)


def test_the_canvas_is_dominant_in_the_first_window(new_editor):
    window = new_editor.window
    for size in ((1024, 700), (1280, 800), (1600, 1000)):
        window.resize(*size)
        new_editor.settle()
        assert window.canvas.height() > 0.6 * window.height(), size
        assert window.canvas.height() > 2.2 * window.central["basisPane"].height(), size
        assert 300 <= window.width() - window.canvas.width() <= 360, size


def test_the_values_of_the_basis_functions_end_where_the_rail_begins(new_editor):
    window = new_editor.window
    panel = window.basis_panel
    for height in (540, 700, 1000):
        window.resize(1024, height)
        new_editor.settle()
        places = [place for place, _text in panel.getAxis("left").ticks_in(panel.pixel_map).labels]
        # −0.8 and −1.6 stood beside the rail of a low window.
        assert min(places) >= -0.5, height
        assert 0.0 in places, height
        assert max(places) >= 0.8, height
