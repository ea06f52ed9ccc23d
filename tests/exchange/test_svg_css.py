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


SQUARE = (5, 7, 15, 17)


@each_row(
    "body",
    [
        # The file of the issue: no shape had a size.
        "<style>rect{width:10px;height:10px;x:5px;y:7px}</style><rect/>",
        "<rect style='x:5px;y:7px;width:10px;height:10px'/>",
        "<style>circle{cx:10px;cy:12px;r:5px}</style><circle/>",
        "<style>ellipse{cx:10px;cy:12px;rx:5px}</style><ellipse/>",
        # 5 % of 200, 12 % of 100, and a part of the diagonal over the root of two.
        "<circle style='cx:5%;cy:12%;r:3.162277660168379%'/>",
        "<rect style='x:.5em;y:7px;width:1rem;height:10px;font-size:10px' width='9'/>".replace("1rem", "2ex"),
        "<path style='d:path(\"M5 7H15V17\")'/>",
        "<style>path{d:path('M5 7\\a H15V17')}</style><path d='M0 0L99 99'/>",
        # Attributes are weaker than any rule, rules than the style, and importance counts before that.
        "<style>*{width:10px}</style><rect x='5' y='7' width='99' height='10'/>",
        "<style>#a{x:5px}rect{x:6px}.b{x:7px}</style><rect id='a' class='b' y='7' width='10' height='10'/>",
        "<style>#a{x:6px}</style><rect id='a' x='9' style='x:5px' y='7' width='10' height='10'/>",
        "<style>rect{x:5px!important}</style><rect x='9' style='x:6px' y='7' width='10' height='10'/>",
        # Values that CSS does not take do not count: without a unit, negative sizes, and other words.
        "<rect x='5' y='7' width='10' height='10' style='x:6;y:8;width:-1px;height:10px 2px'/>",
        "<path d='M5 7H15V17' style='d:M0 0L1 1'/>",
        "<style>rect{x:0;width:10px;x:5px}</style><rect y='7' height='10'/>",
        # As if nothing was declared.
        "<rect x='5' y='7' width='10' height='10' rx='3' style='rx:initial;'/>",
        "<rect x='5' y='7' width='10' height='10' style='rx:auto;ry:auto'/>",
        # On what has no outline of its own.
        "<style>use{x:5px;y:7px}</style><use href='#a' x='1'/><defs><path id='a' d='M0 0H10V10'/></defs>",
        "<svg style='x:5px;y:7px;width:10px;height:10px' viewBox='0 0 1 1'><path d='M0 0H1V1'/></svg>",
        "<style>use{width:10px;height:10px}</style><use x='5' y='7' href='#a'/>"
        "<symbol id='a' viewBox='0 0 1 1'><path d='M0 0H1V1'/></symbol>",
    ],
)
def test_places_and_sizes_by_css(body):
    found = read(body)
    (curve,) = found.document.curves
    assert box(curve) == pytest.approx(SQUARE)
    assert found.remarks == ()


def test_radii_by_css():
    styles = ("", "rx:2px", "rx:2px;ry:0", "rx:auto;ry:5px", "ry:5%;rx:5%")
    body = "".join(f"<rect style='{style}'/>" for style in styles)
    found = read(f"<style>rect{{width:20px;height:10px}}</style>{body}")
    # Of radii of 5 no line is left at the sides, and of those of 5 % of 200 and 100 none at all.
    assert [len(curve.points) for curve in found.document.curves] == [4, 8, 4, 6, 4]
    assert found.remarks == ()


def test_an_outline_that_css_takes_away():
    found = read(
        "<path d='M0 0L1 1' style='d:none'/><rect width='5' height='5' style='width:0'/><path d='M0 0L2 2'/>"
    )
    assert [box(curve) for curve in found.document.curves] == [(0, 0, 2, 2)]


def test_lengths_that_are_not_computed_are_told():
    found = read(
        "<style>rect{width:calc(1px + 2em);height:5px}circle{r:var(--r)}</style>"
        "<rect id='a'/><circle id='b'/><path d='M0 0L2 2'/>"
    )
    assert len(found.document.curves) == 1
    assert found.remarks == ("2 shapes with lengths of unknown size left out: a and b.",)


@each_row(
    ("style", "width"),
    [
        ("width:40px;height:20px", 40),
        ("width:100%;height:auto", 80),
        ("width:50vw;height:calc(1px)", 80),
        ("", 80),
    ],
)
def test_a_size_of_the_file_by_css(style, width):
    """A picture that is stretched to its page keeps the size that its attributes say."""
    found = read("<path d='M0 0L100 0'/>", f"width='80' height='40' viewBox='0 0 100 50' style='{style}'")
    (curve,) = found.document.curves
    assert curve.points[-1].x == pytest.approx(width)


def test_a_clip_by_css_is_the_box_that_it_draws():
    style = "<style>#c rect{{x:0;y:0;width:{0}px;height:{0}px}}</style>"
    clip = style + "<clipPath id='c'><rect width='1'/></clipPath>"
    for size, said in ((9, ()), (8, ("1 clip path not applied: a.",))):
        found = read(clip.format(size) + "<g id='a' clip-path='url(#c)'><path d='M0 0L9 9'/></g>")
        assert found.remarks == said
