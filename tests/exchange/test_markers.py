"""Markers in files: ours come back, others as the nearest or not at all; the file keeps its own."""

import pytest
from msgspec.structs import replace

from app.document.marker import MarkerKind
from app.document.model import Document, Page, make_curve
from app.document.style import Style
from app.exchange.drawing.drawing import drawing_of
from app.exchange.formats.pictures import read
from app.exchange.svg.in_place.rewriting import rewritten
from app.exchange.svg.reader import read_svg
from app.exchange.svg.writer import svg_of
from app.families import HERMITE
from app.storage.format import decode, encode
from app.view_model.curve.curve_view import view_of
from app.view_model.shapes.stroke_shapes import strokes_as_shapes

KINDS = [kind for kind in MarkerKind if kind is not MarkerKind.NONE]
PAGE = Page(0.0, 0.0, 100.0, 50.0)
ARROW = Style(stroke="#d55e00", width=2.0, start_marker=MarkerKind.DOT, end_marker=MarkerKind.ARROW)


def line(style=ARROW, **fields):
    return replace(make_curve([(10, 10), (60, 20)], family=HERMITE), style=style, **fields)


def markers(document):
    return [(curve.style.start_marker, curve.style.end_marker) for curve in document.curves]


@pytest.mark.parametrize("kind", KINDS)
def test_ours_come_back_from_a_drawing_and_from_a_file(kind):
    style = replace(ARROW, end_marker=kind)
    document = Document((line(style), line(style)), page=PAGE)
    written = svg_of(document).data
    assert written.count(f'<marker id="curvebench-{kind.value}"'.encode()) == 1
    found = read_svg(written)
    assert found.sentences == ()
    assert markers(found.document) == [(MarkerKind.DOT, kind)] * 2
    assert decode(encode(document)) == document
    assert b"marker" not in encode(Document((line(Style()),)))


def test_closed_curves_and_those_without_a_line_write_none():
    corners = make_curve([(0, 0), (9, 0), (9, 9)], family=HERMITE)
    closed = replace(corners, closed=True, style=ARROW)
    no_line = replace(corners, style=replace(ARROW, stroke="none", fill="#000000"))
    assert b"marker" not in svg_of(Document((closed, no_line), page=PAGE)).data


INKSCAPE = """<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 50" width="100" height="50"
 xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape">
<defs><marker id="m7" inkscape:stockid="{stock}" orient="{orient}"><path d="M0 0L5 5"/></marker></defs>
<path id="a" d="M 10 10 L 60 20" fill="none" stroke="#ff0000" stroke-width="2" {attribute}="url(#m7)"/>
</svg>"""


@pytest.mark.parametrize(
    ("stock", "orient", "attribute", "kinds"),
    [
        ("Arrow1Lend", "auto", "marker-end", (MarkerKind.NONE, MarkerKind.ARROW)),
        ("Arrow2Mstart", "auto", "marker-start", (MarkerKind.ARROW, MarkerKind.NONE)),
        ("Arrow2Mend", "auto", "marker-start", (MarkerKind.NONE, MarkerKind.NONE)),
        ("TriangleOutL", "auto", "marker-end", (MarkerKind.NONE, MarkerKind.ARROW)),
        ("TriangleInL", "auto", "marker-end", (MarkerKind.NONE, MarkerKind.NONE)),
        ("TriangleStart", "auto-start-reverse", "marker-end", (MarkerKind.NONE, MarkerKind.ARROW)),
        ("Arrow1", "auto-start-reverse", "marker-start", (MarkerKind.OPEN, MarkerKind.NONE)),
        ("DotM", "auto", "marker-start", (MarkerKind.DOT, MarkerKind.NONE)),
        ("Scissors", "auto", "marker-end", (MarkerKind.NONE, MarkerKind.NONE)),
    ],
)
def test_those_of_inkscape_come_in_as_the_nearest_and_stay_in_the_file(stock, orient, attribute, kinds):
    data = INKSCAPE.format(stock=stock, orient=orient, attribute=attribute).encode()
    found = read_svg(data)
    assert markers(found.document) == [kinds]
    lost = kinds == (MarkerKind.NONE, MarkerKind.NONE)
    (sentence,) = found.sentences
    assert ("without them" in sentence) is lost
    assert ("with the nearest" in sentence) is not lost
    document = read(data, None).document
    (curve,) = document.curves
    green = replace(curve, style=replace(curve.style, stroke="#00ff00"))
    changed = rewritten(data, replace(document, curves=(green,)), document)
    assert changed.data == data.replace(b"#ff0000", b"#00ff00")


def test_another_marker_is_written_into_a_file_of_another_program():
    data = INKSCAPE.format(stock="Arrow1Lend", orient="auto", attribute="marker-end").encode()
    found = read(data, None).document
    (curve,) = found.curves
    bar = replace(curve, style=replace(curve.style, end_marker=MarkerKind.BAR))
    written = rewritten(data, replace(found, curves=(bar,)), found).data
    assert b'marker-end="url(#curvebench-bar)"' in written
    assert b"marker-start" not in written
    again = read_svg(written)
    assert markers(again.document) == [(MarkerKind.NONE, MarkerKind.BAR)]
    assert again.sentences == ()


def test_a_stroke_as_a_path_has_its_heads_and_a_drawing_has_room_for_them():
    level = replace(make_curve([(10, 10), (60, 10)], family=HERMITE), style=ARROW)
    document = Document((level,))
    made = strokes_as_shapes(document, [view_of(level)], [0], 1.0).document
    places = [view_of(curve).extent[1] for curve in made.curves]
    # A dot 1.75 widths about the start; a tip 3 widths ahead, and 2 to either side.
    assert min(low[0] for low, _ in places) == pytest.approx(10 - 3.5, abs=0.02)
    assert max(high[0] for _, high in places) == pytest.approx(60 + 6, abs=0.02)
    assert max(high[1] for _, high in places) == pytest.approx(10 + 4, abs=0.02)
    frame = drawing_of(document).frame
    assert frame.left <= 6.5
    assert frame.left + frame.width >= 66
