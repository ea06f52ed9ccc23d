"""What colour a curve has on a paper: seen at 3:1, and the same on the screen and in every file."""

from __future__ import annotations

import re

import numpy as np
import pytest
from msgspec.structs import replace
from pixels import is_colour
from PySide6.QtGui import QColor, QImage
from PySide6.QtWidgets import QApplication

from app.appearance.colours import CURVE_COLOURS, curve_colour
from app.appearance.theme import DARK, LIGHT, ThemeMode, apply_theme, mix
from app.document.model import Document, make_curve
from app.document.style import Style
from app.exchange.drawing.film import Film
from app.exchange.drawing.image import png_file
from app.exchange.drawing.motion_frames import FrameMaker
from app.exchange.drawing.styles import DARK as DARK_STYLE
from app.exchange.drawing.styles import INK
from app.exchange.drawing.styles import LIGHT as LIGHT_STYLE
from app.exchange.export_choice import ExportChoice
from app.exchange.options import Options
from app.exchange.svg.writer import svg_of
from app.features.curve_list.commands import CurveListCommands
from app.features.curve_list.rows import Spot, spot_rect
from app.features.import_export.export_dialog import ExportDialog
from app.view_model.palette import adjustment_of, colour_on
from tests.gui.test_theme import contrast, oklab
from tests.waiting import until

PAPERS = [(LIGHT, LIGHT_STYLE), (DARK, DARK_STYLE)]
CUSTOM = ["#1b5e20", "#000000", "#ffffff", "#0000ff", "#ffff00", "#808080"]
CODES = [*filter(None, CURVE_COLOURS.values()), *CUSTOM]
LINE = ((0.0, 1.0), (10.0, 1.0))
OTHER = ((0.0, 5.0), (10.0, 5.0))


def coloured(code, points=LINE):
    return replace(make_curve(points), style=Style(stroke=code))


@pytest.mark.parametrize(("theme", "style"), PAPERS)
@pytest.mark.parametrize("code", ["", *CODES])
def test_every_colour_is_visible_on_its_paper_and_the_same_in_a_file(theme, style, code):
    colour = curve_colour(code, theme)
    assert contrast(colour, theme.paper) >= 3.0  # was 1.56 for #1b5e20 in the dark
    if code and contrast(code, theme.paper) >= 3.0:
        assert colour.name() == code
    text = svg_of(Document((coloured(code),)), Options(style=style, points=True)).text
    assert style.paper == theme.paper.name()
    path, group = (re.search(f'<{tag} [^>]*stroke="([^"]*)"', text) for tag in ("path", "g"))
    drawn = path or group
    assert drawn is not None
    # Was #f0e442 where the screen had #554f00.
    assert drawn[1] == colour.name()


def test_a_colour_keeps_its_hue_and_is_adjusted_no_more_than_necessary():
    random = np.random.default_rng(5)
    for code in (f"#{value:06x}" for value in random.integers(0, 1 << 24, 300)):
        for theme in (LIGHT, DARK):
            drawn = colour_on(theme.paper.name(), code)
            reached = contrast(drawn, theme.paper)
            assert reached >= 3.0
            if drawn == code:
                continue
            # A step of eight bits at this lightness is worth 0.03 of contrast; three channels take it.
            assert reached < 3.12
            (_, a, b), (_, c, d) = oklab([code, drawn])
            if np.hypot(a, b) > 0.05 and np.hypot(c, d) > 0.05:
                turn = np.degrees(np.angle(complex(c, d) / complex(a, b)))
                assert abs(turn) < 3  # rounding to eight bits, at the smallest chroma


def test_without_paper_a_file_has_the_selected_colours():
    assert 'stroke="#f0e442"' in svg_of(Document((coloured("#f0e442"),)), Options(style=INK)).text
    assert adjustment_of(None, "#f0e442") == ""


@pytest.fixture(params=[(ThemeMode.LIGHT, LIGHT, LIGHT_STYLE), (ThemeMode.DARK, DARK, DARK_STYLE)])
def dressed(request, qapp):
    mode, theme, style = request.param
    apply_theme(qapp, mode)
    yield theme, style
    apply_theme(qapp, ThemeMode.LIGHT)


def covered(colour, theme):
    """Less than a pixel shows of a line of 1.5 pixels: three quarters of one, wherever it lies."""
    return mix(QColor(colour), theme.paper, 0.7)


def has(image, colour):
    """Whether a line of at least 30 pixels has exactly this colour."""
    return is_colour(image, QColor(colour)).sum() > 30


def test_screen_and_picture_have_the_same_colours(editor, dressed):
    theme, style = dressed
    dim = "#1b5e20" if theme is DARK else "#f0e442"
    document = Document((coloured("#d55e00"), coloured(dim, OTHER)))
    editor.session.commit(document, "Begin")
    editor.fit()
    editor.select([])
    canvas = editor.window.canvas
    drawn = colour_on(theme.paper.name(), dim)
    assert drawn != dim
    picture = QImage.fromData(png_file(document, Options(width=400, style=style)).data)
    shot = canvas.viewport().grab().toImage()
    row = canvas.to_pixel(5.0, 5.0)
    # Not edited: thinner, but not mixed with the paper by 38 %, as it was.
    across = [QColor(shot.pixel(row.x(), row.y() + step)) for step in range(-2, 3)]
    nearest = max(across, key=lambda colour: contrast(colour, theme.paper))
    assert contrast(nearest, theme.paper) > contrast(covered(drawn, theme), theme.paper)
    editor.session.selected.set_curves([1], 1)
    editor.select([])
    assert has(canvas.viewport().grab().toImage().copy(row.x() - 60, row.y() - 3, 120, 6), drawn)
    assert has(picture, drawn)
    assert has(picture, "#d55e00")
    # It is told, in the list and before it is written.
    how = "lighter" if theme is DARK else "darker"
    editor.show_dock("curvesDock")
    view = editor.window.commands[CurveListCommands].panel.view
    tip = view.parts.tip_at(spot_rect(view.parts.row_rect(1), Spot.SWATCH).center())
    assert f"drawn {how} than {dim}" in tip
    assert how not in view.parts.tip_at(spot_rect(view.parts.row_rect(0), Spot.SWATCH).center())


def test_a_faint_curve_is_thin_but_visible(editor, dressed):
    theme, _ = dressed
    editor.session.commit(Document((replace(coloured("#d55e00"), visible=False),)), "Begin")
    editor.fit()
    editor.select([])
    canvas = editor.window.canvas
    pixel, shot = canvas.to_pixel(5.0, 1.0), canvas.viewport().grab().toImage()
    seen = [QColor(shot.pixel(pixel.x(), pixel.y() + step)) for step in range(-2, 3)]
    wanted = contrast(covered(theme.handle, theme), theme.paper)
    assert max(contrast(each, theme.paper) for each in seen) > wanted > 2.5  # was 1.97 in the light
    assert contrast(theme.handle, theme.paper) >= 3.0


def test_the_export_dialog_reports_colours_that_are_adjusted(qtbot):
    dialog = ExportDialog(ExportChoice(ending=".svg"))
    qtbot.addWidget(dialog)
    dialog.show()
    dialog.show_document(
        Document((replace(coloured("#f0e442"), name="<b>Sun"), coloured("#d55e00", OTHER))), 0
    )
    # On no paper every colour is as chosen.
    transparent = dialog.form.fields["transparent"].widget
    assert transparent.isChecked()
    transparent.click()
    until(dialog.colour_note.text)
    assert dialog.colour_note.text() == "“<b>Sun” is drawn darker than #f0e442 for contrast with this paper."
    transparent.click()
    until(lambda: not dialog.colour_note.text())


@pytest.mark.parametrize(("theme", "style"), PAPERS)
def test_a_film_has_the_colours_of_the_screen(theme, style, qapp):
    assert QApplication.instance() is qapp
    maker = FrameMaker(Document((coloured(""),)), Film(width=640, fps=2, seconds=1.0, style=style))
    frame = np.frombuffer(next(iter(maker.frames())), np.uint8).reshape(maker.height, maker.width, 4)
    dot = np.array(theme.accent.getRgb()[:3])
    assert (np.abs(frame[..., :3].astype(int) - dot).sum(axis=2) == 0).sum() > 10  # it was #3584e4
