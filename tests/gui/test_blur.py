"""Blur: set in the Style panel, drawn on the canvas, kept in files."""

from __future__ import annotations

from statistics import NormalDist

import numpy as np
import pytest
from msgspec.structs import replace
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLineEdit, QSlider, QWidget

from app.canvas import blurs as canvas_blurs
from app.document.model import Document
from app.document.style import Style
from app.exchange.drawing.image import png_preview
from app.exchange.options import Options
from app.exchange.svg.reader import read_svg
from app.exchange.svg.writer import svg_of
from app.qt import blurs
from tests.gui.test_style import BLUE, begin, square

SHARP = Style(stroke="none", fill=BLUE)
SOFT = replace(SHARP, blur=0.5)


@pytest.fixture
def two(editor):
    """Two filled squares of 4 by 4, both chosen, with the Style panel in front."""
    begin(editor, *(square(6 * k, 0, 4, name, style=SHARP) for k, name in enumerate(("Leaf", "Stem"))))
    editor.show_dock("styleDock")
    editor.action("selectTool").trigger()
    editor.action("selectAllCurves").trigger()
    return editor


class Calls:
    """How many blurred pictures the canvas has computed."""

    def __init__(self, monkeypatch):
        self.count, work = 0, canvas_blurs.blurred

        def counted(*arguments, **named):
            self.count += 1
            return work(*arguments, **named)

        monkeypatch.setattr(canvas_blurs, "blurred", counted)


def deviations(editor):
    return [curve.style.blur for curve in editor.session.document.curves]


def alpha_beside(editor, x, y):
    """How much of the blue is seen at a place, from 0 to 1."""
    pixel = editor.window.canvas.to_pixel(x, y)
    editor.settle()
    picture = editor.window.canvas.grab().toImage()
    ratio = picture.devicePixelRatio()
    red = picture.pixelColor(round(pixel.x() * ratio), round(pixel.y() * ratio)).red()
    return 1 - red / 255


def test_typed_blur_is_that_of_all_that_is_chosen_in_one_step(two):
    edit = two.window.findChild(QLineEdit, "styleBlur")
    steps = two.session.undo_stack.count()
    edit.setFocus()
    edit.selectAll()
    QTest.keyClicks(edit, "0.25")
    QTest.keyClick(edit, Qt.Key.Key_Return)
    assert deviations(two) == [0.25, 0.25]
    assert two.session.undo_stack.count() == steps + 1
    assert two.session.undo_stack.undoText().startswith("Blur of")
    QTest.keyClicks(edit, "-1")
    QTest.keyClick(edit, Qt.Key.Key_Return)
    assert deviations(two) == [0.25, 0.25]
    two.action("undo").trigger()
    assert deviations(two) == [0.0, 0.0]


def test_blur_and_opacity_are_in_sight_in_a_window_900_pixels_high(editor):
    """They stood below the fold, behind all that is said of fill and stroke."""
    editor.trigger("newDrawing")
    editor.window.resize(1280, 900)
    editor.show_dock("styleDock")
    editor.settle()
    for name in ("styleBlur", "styleBlurSlider", "styleOpacity", "styleOpacitySlider", "strokeWidth"):
        field = editor.window.findChild(QWidget, name)
        assert field.visibleRegion().boundingRect() == field.rect(), name


def drag_from_left(slider, to):
    """Drag the handle of a slider from its left end to a share of its length; return where it is held."""
    y = slider.height() // 2
    QTest.mousePress(slider, Qt.MouseButton.LeftButton, pos=QPoint(6, y))
    for share in (0.1, 0.2, to):
        QTest.mouseMove(slider, QPoint(round(slider.width() * share), y))
    return QPoint(round(slider.width() * to), y)


def test_slider_blurs_live_and_escape_takes_it_back(two):
    slider = two.window.findChild(QSlider, "styleBlurSlider")
    steps = two.session.undo_stack.count()
    drag_from_left(slider, 0.4)
    live = deviations(two)
    # A quarter of width and height together is all of the slider, and its square is finer at the sharp end.
    assert live[0] == live[1] == pytest.approx((slider.sliderPosition() / 100) ** 2 * 2.0, rel=1e-2)
    assert live[0] > 0.1
    QTest.keyClick(slider, Qt.Key.Key_Escape)
    assert deviations(two) == [0.0, 0.0]
    QTest.mouseRelease(slider, Qt.MouseButton.LeftButton)
    assert two.session.undo_stack.count() == steps
    release_at = drag_from_left(slider, 0.4)
    QTest.mouseRelease(slider, Qt.MouseButton.LeftButton, pos=release_at)
    assert deviations(two)[0] > 0.1
    assert two.session.undo_stack.count() == steps + 1


def test_canvas_shows_a_gaussian_edge_and_computes_it_once(editor, monkeypatch):
    calls = Calls(monkeypatch)
    begin(editor, square(0, 0, 4, "Leaf", style=SOFT), square(20, 0, 4, "Stem", style=SHARP), active=1)
    editor.action("addTool").trigger()
    seen = [alpha_beside(editor, x, 2) for x in (-1.0, -0.5, 0.0, 0.5, 1.0, 2.0)]
    editor.window.canvas.viewport().update()
    editor.screenshot(editor.window.canvas)
    # The cumulative normal distribution, within a twentieth: pixels are coarse.
    assert seen == pytest.approx([0.023, 0.159, 0.5, 0.841, 0.977, 1.0], abs=0.05)
    assert calls.count == 1


def test_what_is_sharp_computes_nothing(editor, monkeypatch):
    calls = Calls(monkeypatch)
    begin(editor, square(0, 0, 4, "Leaf", style=SHARP))
    editor.drag_point(0, to=(-1, -1))
    editor.screenshot(editor.window.canvas)
    assert calls.count == 0


def test_file_keeps_a_blur_to_the_last_digit_and_pictures_show_it():
    document = Document((square(0, 0, 4, "Leaf", style=replace(SHARP, blur=0.123456789)),))
    text = svg_of(document).text
    assert '<feGaussianBlur stdDeviation="0.123456789"/>' in text
    assert read_svg(text.encode()).document.curves[0].style.blur == 0.123456789
    assert not read_svg(text.encode()).missed
    soft = png_preview(Document((square(0, 0, 4, "Leaf", style=SOFT),)), Options(), (200, 200)).image
    levels = {soft.pixelColor(x, 100).red() for x in range(100)}
    assert len(levels) > 20


@pytest.mark.parametrize("opacity", [1.0, 0.5])
def test_softened_pixels_are_those_of_a_gaussian(opacity):
    edge = np.zeros((9, 200, 4), np.float32)
    edge[:, 100:] = 255 * opacity
    wide = np.pad(edge, ((40, 40), (0, 0), (0, 0)), mode="edge")
    soft = blurs.softened(wide, (4.0, 4.0))[44, 60:140, 0] / (255 * opacity)
    wanted = [NormalDist(0, 4.0).cdf(x - 100 + 0.5) for x in range(60, 140)]
    assert soft == pytest.approx(wanted, abs=4e-3)


def test_other_filters_are_told():
    shape = '<rect id="a" width="9" height="9" filter="url(#f)"/>'
    kinds = {
        '<feGaussianBlur stdDeviation="2"/>': (2.0, ["its blur mixes colours as light"]),
        '<feGaussianBlur stdDeviation="2" style="color-interpolation-filters:sRGB"/>': (2.0, []),
        '<feGaussianBlur stdDeviation="2 1"/>': (0.0, ["a filter changes it"]),
        '<feOffset dx="2"/>': (0.0, ["a filter changes it"]),
        '<feGaussianBlur stdDeviation="2"/><feOffset dx="2"/>': (0.0, ["a filter changes it"]),
    }
    for inside, (blur, why) in kinds.items():
        text = f'<svg xmlns="http://www.w3.org/2000/svg"><filter id="f">{inside}</filter>{shape}</svg>'
        found = read_svg(text.encode())
        assert found.document.curves[0].style.blur == blur, inside
        assert [each.why for each in found.missed] == why, inside
