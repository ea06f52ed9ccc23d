"""The page: seen on the canvas, put around the curves, taken away, and what pictures show of it."""

from __future__ import annotations

import pytest
from msgspec.structs import replace

from app.document.model import Document, Page, make_curve
from app.document.style import Style
from app.families import HERMITE
from app.features.import_export.commands import ExchangeCommands

SQUARE = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)]


@pytest.fixture
def drawn(editor):
    line = replace(make_curve([(0.0, 0.0), (8.0, 4.0)], family=HERMITE), style=Style(width=1.0))
    editor.session.change("Draw", lambda _: Document((line,), unit="mm"))
    editor.trigger("fitView")
    return editor


def edge_colour(editor, x, y):
    """The colour of the canvas where the edge of a page may be."""
    image = editor.window.canvas.grab().toImage()
    pixel = editor.window.canvas.to_pixel(x, y)
    ratio = image.devicePixelRatio()
    return {
        image.pixelColor(round(pixel.x() * ratio) + i, round(pixel.y() * ratio) + j).name()
        for i in (-1, 0, 1)
        for j in (-1, 0, 1)
    }


def test_a_page_around_the_curves_holds_their_strokes(drawn):
    drawn.trigger("pageAroundCurves")
    page = drawn.session.document.page
    assert (page.x, page.y) == pytest.approx((-0.5, -0.5))
    assert (page.width, page.height) == pytest.approx((9.0, 5.0))
    assert drawn.status == "The page is 9 × 5 mm; pictures show what lies on it."
    muted = drawn.window.canvas.drawing.page.theme.muted.name()
    assert muted in edge_colour(drawn, page.x + 1.0, page.y + page.height)
    drawn.trigger("undo")
    assert drawn.session.document.page is None
    assert muted not in edge_colour(drawn, page.x + 1.0, page.y + page.height)


def test_pictures_show_the_page_until_it_is_taken_away(drawn, tmp_path):
    drawn.session.change("Page", lambda document: replace(document, page=Page(0.0, 0.0, 4.0, 4.0)))
    export = drawn.window.commands[ExchangeCommands].export
    export(tmp_path / "page.svg")
    drawn.wait_for_work()
    text = (tmp_path / "page.svg").read_text(encoding="utf-8")
    assert 'width="4mm" height="4mm" viewBox="0 -4 4 4"' in text
    assert "reaches beyond the page" in drawn.message
    drawn.trigger("noPage")
    assert drawn.session.document.page is None
    export(tmp_path / "all.svg")
    drawn.wait_for_work()
    assert 'viewBox="0 -4 4 4"' not in (tmp_path / "all.svg").read_text(encoding="utf-8")


def test_the_actions_wait_for_what_they_need(editor):
    editor.session.new()
    editor.settle()
    assert not editor.window.actions_by_name["noPage"].isEnabled()
    assert not editor.window.actions_by_name["pageAroundCurves"].isEnabled()
