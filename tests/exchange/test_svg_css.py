"""SVG in: lengths, places and transforms as CSS has them. Expected numbers follow from the specifications."""

import numpy as np
import pytest

from app.exchange.svg.reader import read_svg
from app.view_model.curve.curve_view import view_of
from app.view_model.geometry.extents import extent_of
from curvecore import bezier_segments
from tests.rows import each_row


def read(body, attributes='width="200" height="100"'):
    text = f'<svg xmlns="http://www.w3.org/2000/svg" {attributes}>{body}</svg>'
    return read_svg(text.encode())


def box(curve):
    """The box around a curve, y down as in the file: left, top, right, bottom."""
    pieces = np.concatenate([bezier_segments(piece) for piece in view_of(curve).pieces])
    (left, bottom), (right, top) = extent_of(pieces)
    return left, -top, right, -bottom


def boxes(body, **more):
    return [pytest.approx(box(curve), abs=1e-9) for curve in read(body, **more).document.curves]


RECT = '<rect width="{0}" height="{0}"/>'


@each_row(
    ("body", "size"),
    [
        (RECT.format("2em"), 32),
        (RECT.format("2ex"), 16),
        (RECT.format("2CH"), 16),
        (RECT.format("2rem"), 32),
        ('<rect width="2em" height="2em" font-size="10"/>', 20),
        ('<rect width="2em" height="2em" style="font-size: 10pt"/>', 80 / 3),
        ('<rect width="2em" height="2em" style="font: italic 700 10px/1.5 \'My Font\', serif"/>', 20),
        ('<rect width="2em" height="2em" style="font: expanded large serif"/>', 36),
        (f'<style>rect {{ font-size: 1.5em }}</style><g font-size="10">{RECT.format("2em")}</g>', 30),
        # Of the parent, one within the other; `rem` is of the root whatever stands between.
        (f'<g font-size="50%"><g font-size="2ex">{RECT.format("2em")}</g></g>', 16),
        (f'<g font-size="3rem">{RECT.format("2em")}</g>', 96),
        (f'<g font-size="64">{RECT.format("2rem")}</g>', 32),
        (f'<g font-size="xx-large">{RECT.format("2em")}</g>', 64),
        (f'<g font-size="12"><g font-size="larger">{RECT.format("1em")}</g></g>', 14.4),
        (f'<g font-size="12"><g font-size="smaller">{RECT.format("1em")}</g></g>', 10),
        (f'<g font-size="12"><g font-size="inherit">{RECT.format("1em")}</g></g>', 12),
        (f'<g font-size="12"><g font-size="initial">{RECT.format("1em")}</g></g>', 16),
        # Invalid ones count as not given.
        (f'<g font-size="12"><g font-size="-3">{RECT.format("1em")}</g></g>', 12),
        (f'<g font-size="12"><g font-size="huge">{RECT.format("1em")}</g></g>', 12),
        # A copy has the font of the place where it is used.
        (f'<defs><g id="a">{RECT.format("1em")}</g></defs><use href="#a" font-size="20"/>', 20),
        (f'<defs><symbol id="a">{RECT.format("1em")}</symbol></defs><use href="#a" font-size="20"/>', 20),
    ],
)
def test_lengths_in_units_of_a_font(body, size):
    """All were left out, or counted as 0, without a word for a stroke."""
    found = read(body)
    (curve,) = found.document.curves
    assert box(curve) == pytest.approx((0, 0, size, size))
    assert found.remarks == ()


def test_a_file_of_a_size_in_units_of_its_font():
    for size, rest in (("10", 'font-size="10"'), ("16", ""), ("24", 'style="font-size:150%"')):
        attributes = f'width="10em" height="5rem" viewBox="0 0 100 50" {rest}'
        found = read('<path d="M0 0L10 10"/><line y2="1rem" x2="50%"/>', attributes)
        first, second = found.document.curves
        assert found.document.unit == "px"
        scale = float(size) / 10
        assert first.points[-1].position == pytest.approx((10 * scale, -10 * scale))
        assert second.points[-1].position == pytest.approx((50 * scale, -float(size) * scale))


def test_strokes_in_units_of_a_font_are_those_of_the_element_that_declares_them():
    body = (
        '<g font-size="20" stroke="red" style="stroke-width:.1em; stroke-dasharray:1em,2ex 4;'
        'stroke-dashoffset:1rem">'
        '<path font-size="50" d="M0 0L9 9"/></g>'
    )
    (curve,) = read(body).document.curves
    style = curve.style
    assert (style.width, style.dash, style.dash_offset) == (2, (10, 10, 2), 8)
