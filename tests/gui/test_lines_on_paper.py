"""New lines of documents for paper: as wide on the canvas as they print, and as the panels say."""

from __future__ import annotations

import numpy as np
import pytest
from msgspec.structs import replace
from pixels import pixels_of
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLineEdit

from app.document.model import Document, Page, make_curve
from app.document.plane_edits import set_page
from app.document.style import Style
from app.document.style_edits import with_style
from app.families import HERMITE

CTRL, SHIFT = Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier
ALT = Qt.KeyboardModifier.AltModifier


def text_of(editor, name):
    return editor.window.findChild(QLineEdit, name).text()


def draw_rectangle(editor, start=(50, 200), to=(90, 240)):
    editor.trigger("rectangleTool")
    editor.drag(start, to)
    editor.trigger("selectTool")
    editor.escape()
    editor.escape()
    return editor.curve


@pytest.fixture
def page(editor):
    """A new drawing."""
    editor.session.new()
    editor.key(Qt.Key.Key_N, CTRL | ALT | SHIFT)
    yield editor
    editor.session.files.give_up_changes()
    editor.new()


def test_a_new_line_on_a_page_is_drawn_as_wide_as_its_number_says(page):
    curve = draw_rectangle(page)
    assert curve.style.width == 0.3
    (left, low), canvas = curve.points[3].position, page.window.canvas
    canvas.camera.show_box((left - 0.5, left + 0.5), (low + 5, low + 6))
    page.settle()
    assert not page.session.selected.marked
    image = canvas.viewport().grab().toImage()

    def is_ink(x):
        place = canvas.to_pixel(x, low + 5.53)
        return image.pixelColor(round(place.x()), round(place.y())).lightness() < 100

    assert [is_ink(left + off) for off in (-0.2, -0.12, 0, 0.12, 0.2)] == [False, True, True, True, False]
    page.session.selected.choose({page.session.active_index})
    page.show_dock("styleDock")
    assert text_of(page, "strokeWidth") == "0.3 mm"


def test_what_is_chosen_shows_its_own_colour_beside_the_mark(page):
    curve = draw_rectangle(page)
    (left, low), canvas = curve.points[3].position, page.window.canvas
    canvas.camera.show_box((left - 10, left + 30), (low, low + 30))

    def seen_with(width):
        """Return the colours across the left side, and those while the rectangle is not chosen."""
        page.session.change(
            "Style",
            lambda document: with_style(document, {0}, stroke="#d00000", fill="#e0e000", width=width),
        )
        found = []
        for chosen in ({0}, ()):
            page.session.selected.choose(chosen)
            page.settle()
            image, place = canvas.viewport().grab().toImage(), canvas.to_pixel(left, low + 14.3)
            found.append(
                [image.pixelColor(round(place.x()) + off, round(place.y())) for off in range(-12, 13)]
            )
        return found

    def count(colours, *, red):
        return sum((each.red() if red else each.blue()) > 150 > each.green() for each in colours)

    wide, bare = seen_with(0.8)
    assert count(bare, red=True) > 8
    assert count(wide, red=True) >= count(bare, red=True) - 5
    assert count(wide, red=False) in (1, 2)
    fine, bare = seen_with(0.15)
    assert count(fine, red=True) == count(bare, red=True) > 0
    # A box beside it marks it, and the colours on either side stay what they are.
    assert 0 < sum(one != other for one, other in zip(fine, bare, strict=True)) <= 2


def test_a_width_is_a_clean_one_of_each_unit_and_none_without_paper(editor):
    editor.session.new()
    for unit, width in (("px", 1.0), ("cm", 0.03), ("", None), ("mm", 0.3)):
        editor.set_unit(unit)
        assert editor.curve.style.width == width
    draw_rectangle(editor, (0, 0), (1, 1))
    editor.new()
    editor.set_unit("")
    assert editor.curve.style.width is None
    # Neither does a line that was drawn on paper say how wide one is elsewhere.
    draw_rectangle(editor, (0, 0), (1, 1))
    assert draw_rectangle(editor, (2, 0), (3, 1)).style.width is None


# Lines without a width of their own: as wide as one that says how wide they print.


@pytest.fixture
def automatic(editor):
    """Two waves on a page, red and blue, whose lines have no width of their own."""
    waves = (((1, 2), (5, 8), (9, 2)), ((1, 1), (5, 8.1), (9, 1)))
    curves = [
        replace(make_curve(wave, name=colour, family=HERMITE), style=Style(stroke=colour))
        for wave, colour in zip(waves, ("#d00000", "#0000d0"), strict=True)
    ]
    editor.session.new()
    editor.session.commit(Document(tuple(curves), unit="mm", page=Page(0.0, 0.0, 10.0, 10.0)), "Begin")
    editor.fit()
    return editor


def picture_of(editor):
    editor.settle()
    return pixels_of(editor.window.canvas.viewport().grab().toImage())


def differ(one, other):
    """Whether pictures differ by more than edges do whose lines are cut into other pieces."""
    shades = [
        (each[..., None] >> np.array([16, 8, 0])) & 0xFF for each in (one.astype(int), other.astype(int))
    ]
    return abs(shades[0] - shades[1]).max() > 16


@pytest.mark.parametrize("is_near", [False, True])
@pytest.mark.parametrize("chosen", [None, (), (0,), (0, 1)])
def test_an_automatic_line_on_a_page_is_as_wide_as_it_prints(automatic, chosen, is_near):
    session, canvas = automatic.session, automatic.window.canvas

    def picture():
        if chosen is not None:
            session.selected.choose(chosen)
        return picture_of(automatic)

    if is_near:
        canvas.camera.show_box((4.5, 5.5), (7.5, 8.5))
    before, width = picture(), session.document.page.usual_width
    assert width * canvas.pixel_map.sx > (8 if is_near else 1)
    session.change("Width", lambda document: with_style(document, {0, 1}, width=width))
    assert not differ(picture(), before)
    session.change("Width", lambda document: with_style(document, {0, 1}, width=1.2 * width))
    assert differ(picture(), before)


def test_a_page_widens_the_lines_that_are_there_and_undo_takes_it_back(automatic):
    session, canvas = automatic.session, automatic.window.canvas
    session.change("Page", lambda document: set_page(document, Page(0.0, 0.0, 100.0, 100.0)))
    canvas.camera.show_box((3.0, 7.0), (6.0, 10.0))

    def thickness():
        """Return how much blue ink there is above one another where the wave turns, in pixels."""
        session.selected.choose(())
        place = canvas.to_pixel(5.0, 9.5)
        # Below the ruler.
        column = picture_of(automatic)[place.y() :, place.x()].astype(int)
        # Of white, red below it and blue, only blue has more blue than green: 208 of it where it covers all.
        return float(((column & 0xFF) - (column >> 8 & 0xFF)).clip(0).sum()) / 0xD0

    def printed():
        return session.document.page.usual_width * canvas.pixel_map.sy

    wide = thickness()
    assert wide == pytest.approx(printed(), rel=0.03)
    automatic.trigger("undo")
    assert thickness() == pytest.approx(printed(), rel=0.03)
    assert wide == pytest.approx(10 * thickness(), rel=0.05)
