"""Lines of no length are dots where they have caps: SVG 2, section 13.5.3 “Zero length”, and 9.4."""

from __future__ import annotations

import io
import math

import numpy as np
import pytest
from msgspec.structs import replace
from PIL import Image

from app.document.model import Document
from app.document.style import LineCap
from app.exchange.drawing.image import png_file
from app.exchange.facts import facts_of
from app.exchange.formats import FORMATS
from app.exchange.formats.dxf import read_dxf
from app.exchange.options import Options
from app.exchange.svg.reader import read_svg
from app.exchange.svg.writer import svg_of
from app.storage.format import decode, encode
from tests.exchange.test_dxf import file_with
from tests.rows import each_row

STROKE = 'stroke="#000000" stroke-width="3" fill="none"'


def read(body):
    return read_svg(f'<svg xmlns="http://www.w3.org/2000/svg" width="24" height="24">{body}</svg>'.encode())


def path(data, cap="round", more=""):
    return f'<path d="{data}" {STROKE} stroke-linecap="{cap}" {more}/>'


def dot_of(document):
    """The place of the only curve, a dot."""
    (curve,) = document.curves
    assert [point.velocity for point in curve.points] == [(0.0, 0.0)] * 2
    assert not curve.closed
    (place,) = {point.position for point in curve.points}
    return place


@each_row(
    "body",
    [
        path("M12 12h0"),
        path("M12 12z"),
        path("M12 12L12 12"),
        path("M12 12l0 0z"),
        path("M12 12c0 0 0 0 0 0"),
        path("M12 12q0 0 0 0v0h0z"),
        path("M12 12a3 3 0 0 1 0 0"),
        path("M12 12h1e-16"),
        path("M6 6z", "square", 'transform="translate(6 6)"'),
        # An M alone is no line.
        path("M1 1M12 12zM20 20"),
        f'<g stroke-linecap="square"><line x1="12" y1="12" x2="12" y2="12" {STROKE}/></g>',
        f'<polyline points="12,12 12,12" {STROKE} stroke-linecap="round"/>',
        f'<polygon points="12,12" {STROKE} stroke-linecap="round"/>',
        "<defs>" + path("M2 2h0", more='id="a"') + '</defs><use href="#a" x="10" y="10"/>',
    ],
)
def test_a_line_without_length_with_caps_is_a_dot(body):
    """They were left out, and a shape of nothing else refused the file."""
    found = read(body)
    assert found.remarks == ()
    assert dot_of(found.document) == (12, -12)
    # Saved and opened, and as SVG of true size, it is the same dot.
    assert decode(encode(found.document)) == found.document
    again = read_svg(svg_of(found.document, Options(unit="px")).data).document
    assert dot_of(again) == (12, -12)
    assert again.curves[0].style == found.document.curves[0].style


@each_row(
    "body",
    [
        path("M12 12h0", "butt"),
        path("M12 12"),
        '<path d="M12 12h0" stroke-linecap="round" fill="#000"/>',
        f'<circle cx="12" cy="12" {STROKE} stroke-linecap="round"/>',
        f'<polyline points="12,12" {STROKE} stroke-linecap="round"/>',
    ],
)
def test_an_unpainted_dot_is_left_out(body):
    found = read(body)
    assert (found.has_curves, found.remarks) == (False, ())


def test_dots_of_one_path_are_curves_of_one_shape():
    found = read(path("M4 4h16M12 12h0M18 18z"))
    assert [len(curve.points) for curve in found.document.curves] == [2, 2, 2]
    assert [curve.points[0].position for curve in found.document.curves] == [(4, -4), (12, -12), (18, -18)]
    assert {curve.shape for curve in found.document.curves} == {"Path 2"}
    data = svg_of(found.document, Options(unit="px")).text
    assert data.count("M ") == 3
    assert not any(facts.warnings for facts in facts_of(found.document))


def ink_in(document, width):
    """The ink of a picture, in pixels, its middle from the upper left corner, and its height and width."""
    options = Options(unit="px", width=width, transparent=True)
    image = Image.open(io.BytesIO(png_file(document, options).data)).convert("RGBA")
    ink = np.asarray(image, dtype=float)[..., 3] / 255
    rows, columns = np.indices(ink.shape) + 0.5
    return ink.sum(), ((ink * columns).sum() / ink.sum(), (ink * rows).sum() / ink.sum()), ink.shape


@each_row(("cap", "area"), [("round", math.pi / 4), ("square", 1.0)])
def test_a_dot_is_painted_as_large_as_its_caps(cap, area):
    """Nothing was painted: Qt leaves out lines of no length, and the picture was cut off at the place."""
    for wide in (0.25, 1.0, 3.0, 40.0):
        document = read(path("M12 12h0", cap)).document
        (curve,) = document.curves
        style = replace(curve.style, width=wide)
        document = replace(document, curves=(replace(curve, style=style),))
        ink, (x, y), (high, broad) = ink_in(document, width=200)
        # The picture shows the dot alone; the circle of Bézier pieces and of pixels is out by 3e-4 and 1e-3.
        assert ink == pytest.approx(area * high * broad, rel=4e-3)
        assert (x, y) == pytest.approx((broad / 2, high / 2), abs=0.1)


def test_dots_beside_a_line_are_painted_at_their_positions():
    document = read(path("M4 4h16M12 12h0M18 18z")).document
    ink, _, (high, broad) = ink_in(document, width=190)
    # The line with its caps reaches from 2.5 to 21.5, and the dots from 2.5 down to 19.5.
    assert (broad, high) == (190, 170)
    assert ink / 100 == pytest.approx(16 * 3 + 3 * math.pi * 1.5**2, rel=4e-3)


@each_row("form", [form for form in FORMATS.offered if form.writes_dots])
def test_every_format_of_curves_writes_a_dot(form, tmp_path):
    written = form.write(read(path("M12 12h0")).document, Options(path=str(tmp_path / "a")))
    assert written.data
    assert not written.remarks


def test_a_dot_without_caps_draws_nothing():
    (curve,) = read(path("M12 12h0")).document.curves
    butt = replace(curve, style=replace(curve.style, cap=LineCap.BUTT))
    (facts,) = facts_of(Document((butt,)))
    assert facts.warnings == ("There is nothing to draw: all points coincide.",)


def test_lines_of_no_length_in_a_dxf_are_left_out():
    def draw(space):
        space.add_line((0, 0), (3, 4))
        space.add_line((5, 5), (5, 5))

    found = read_dxf(file_with(draw))
    assert len(found.document.curves) == 1
    assert found.remarks[0].startswith("1 single point left out")
