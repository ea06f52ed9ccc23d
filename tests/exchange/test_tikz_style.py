"""Styles in pictures for TeX."""

from msgspec.structs import replace

from app.document.model import Document, make_curve
from app.document.style import FillRule, LineCap, LineJoin, Style
from app.exchange.formats.latex import pgfplots_axis, tikz_picture
from app.exchange.options import Options
from app.families import HERMITE

SQUARE = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)]


def drawn(style, **fields):
    curve = replace(make_curve(SQUARE, name="Square", family=HERMITE), closed=True, style=style, **fields)
    return Document((curve, curve) if fields else (curve,), unit="cm")


def options_of(text):
    (line,) = [each for each in text.splitlines() if each.lstrip().startswith(("\\draw[", "\\fill["))]
    return line.strip().partition("]")[0]


def test_a_plain_line_is_written_as_before():
    assert options_of(tikz_picture(drawn(Style())).text) == "\\draw[line join=round"
    red = drawn(Style(stroke="#ff0000"))
    assert (
        options_of(tikz_picture(red).text) == "\\draw[line join=round, color={rgb,255:red,255;green,0;blue,0}"
    )


def test_all_of_a_style_is_written_at_true_size():
    style = Style(
        stroke="#0000ff", width=0.5, cap=LineCap.SQUARE, join=LineJoin.MITER, dash=(2.0,), dash_offset=1.0,
        stroke_opacity=0.25, fill="#00ff00", fill_rule=FillRule.EVENODD, fill_opacity=0.5,
    )  # fmt: skip
    text = tikz_picture(drawn(style), Options(unit="cm")).text
    assert options_of(text) == (
        "\\draw[line join=miter, draw={rgb,255:red,0;green,0;blue,255}, "
        "fill={rgb,255:red,0;green,255;blue,0}, "
        "even odd rule, line width=0.5cm, line cap=rect, miter limit=4, dash pattern=on 1cm off 1cm, "
        "dash phase=0.5cm, draw opacity=0.25, fill opacity=0.5"
    )
    # In the units of an axis no length is known.
    assert "line width" not in options_of(pgfplots_axis(drawn(style)).text)


def test_an_area_without_a_line_is_filled():
    assert options_of(tikz_picture(drawn(Style(stroke="none", fill=""))).text) == "\\fill[fill=black"


def test_a_shape_is_one_path():
    text = tikz_picture(drawn(Style(fill="#00ff00"), shape="Ring")).text
    assert text.count("cycle") == 2
    assert text.count("\\draw") == text.count("% Ring") == 1
