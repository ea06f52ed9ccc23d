"""Patterns of SVG: shown, written and printed as librsvg shows them, and as they are described."""

from __future__ import annotations

import shutil
import subprocess

import numpy as np
import pytest
from msgspec.structs import replace
from PySide6.QtGui import QImage

from app.document.gradient import GradientKind, Tile
from app.document.patterns import PATTERNS, laid_across
from app.document.several_curves import mapped, whole_curves
from app.document.style import Style
from app.document.transforms import scaling
from app.exchange.drawing.image import png_file
from app.exchange.options import Options
from app.exchange.svg.reader import read_svg
from app.exchange.svg.writer import svg_of
from app.storage.format import decode, encode
from app.storage.format_error import FormatError
from app.storage.validation import validate

DRAWING = b"""<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" width="120"
height="80"><style>.k{fill:#aa0033}</style>
<defs><linearGradient id="g1"><stop offset="0" stop-color="#ff8800"/><stop offset="1" stop-color="#0088ff"/>
</linearGradient>
<pattern id="a" width="4" height="4" patternUnits="userSpaceOnUse"><rect width="2" height="2" class="k"/>
</pattern>
<pattern id="b" xlink:href="#a" patternTransform="rotate(30) scale(1.5)"/>
<pattern id="c" width="0.2" height="0.25" viewBox="0 0 10 10"><circle cx="5" cy="5" r="4" fill="url(#g1)"/>
</pattern>
<pattern id="d" width="0.25" height="0.25" patternContentUnits="objectBoundingBox">
<path d="M0 0L.125 .125L0 .25" stroke="#007700" stroke-width=".02" fill="none"/></pattern></defs>
<rect x="5" y="5" width="30" height="30" fill="url(#a)" stroke="#000" stroke-width=".5"/>
<circle cx="60" cy="20" r="15" fill="url(#b)"/>
<rect x="80" y="5" width="35" height="30" rx="4" fill="url(#c)"/>
<ellipse cx="20" cy="60" rx="15" ry="12" fill="url(#d)" stroke="#000" stroke-width=".3"/>
<path d="M45 45C60 75 75 45 90 70" fill="none" stroke="url(#a)" stroke-width="6"/>
<g transform="translate(100 60) rotate(20)"><rect x="-10" y="-10" width="20" height="20" fill="url(#a)"
opacity=".6"/></g></svg>"""

RED, BLUE, WHITE = "#ff0000", "#0000ff", "#ffffff"


def read(inside):
    return read_svg(
        '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" width="100"'
        f' height="100">{inside}</svg>'.encode()
    )


def painted(document, *places):
    """The colours at places, in pixels of CSS, y downwards."""
    image = QImage.fromData(png_file(document, Options(width=400)).content)
    return [image.pixelColor(int(4 * x), int(4 * y)).name() for x, y in places]


def colours(data):
    image = QImage.fromData(data).convertToFormat(QImage.Format.Format_RGB888)
    rows = np.frombuffer(image.constBits(), np.uint8).reshape(image.height(), image.bytesPerLine())
    return rows[:, : 3 * image.width()].reshape(image.height(), image.width(), 3).astype(int)


@pytest.mark.skipif(shutil.which("rsvg-convert") is None, reason="librsvg is not installed")
def test_pictures_and_what_is_written_anew_have_patterns_as_librsvg_has(tmp_path):
    def by_librsvg(data):
        (tmp_path / "a.svg").write_bytes(data)
        command = ["rsvg-convert", "--width=960", "--background-color=white", "-o", str(tmp_path / "a.png")]
        subprocess.run([*command, str(tmp_path / "a.svg")], check=True, timeout=60)
        return colours((tmp_path / "a.png").read_bytes())

    found = read_svg(DRAWING)
    assert found.sentences == ()
    theirs = by_librsvg(DRAWING)
    for ours in (
        colours(png_file(found.document, Options(width=960)).content),
        by_librsvg(svg_of(found.document).data),
    ):
        off = np.abs(ours - theirs).max(axis=2) > 64
        within = off[1:-1, 1:-1] & off[:-2, 1:-1] & off[2:, 1:-1] & off[1:-1, :-2] & off[1:-1, 2:]
        # Tiles have many edges, along which a pixel may differ, and none within.
        assert off.mean() < 0.01
        assert not within.any()


def test_a_tile_repeats_where_it_is_said_and_its_rest_is_clear():
    document = read(
        '<pattern id="p" x="10" y="10" width="20" height="20" patternUnits="userSpaceOnUse">'
        '<rect width="10" height="10" fill="#ff0000"/></pattern>'
        '<rect width="100" height="100" fill="#0000ff"/><rect width="100" height="100" fill="url(#p)"/>'
    ).document
    at = (15, 15), (25, 15), (15, 25), (25, 25), (35, 35), (55, 55), (95, 75), (85, 75)
    assert painted(document, *at) == [RED, BLUE, BLUE, BLUE, RED, RED, RED, BLUE]
    (_, pattern) = (curve.style.fill_gradient for curve in document.curves)
    assert pattern.kind is GradientKind.PATTERN
    assert pattern.mean == RED
    assert (pattern.start, pattern.end, pattern.side) == ((10, -10), (30, -10), (10, -30))


def test_patterns_within_a_pattern_and_one_that_uses_itself_end():
    found = read(
        '<pattern id="q" width="4" height="4" patternUnits="userSpaceOnUse">'
        '<rect width="4" height="4" fill="#ff0000"/></pattern>'
        '<pattern id="p" width="20" height="20" patternUnits="userSpaceOnUse">'
        '<rect width="10" height="20" fill="url(#q)"/>'
        '<rect x="10" width="10" height="9" fill="url(#p)"/></pattern>'
        '<rect width="100" height="100" fill="url(#p)"/>'
    )
    assert painted(found.document, (5, 5), (15, 15), (25, 5)) == [RED, WHITE, RED]


@pytest.mark.parametrize(
    "pattern",
    [
        'width="0" height="5"><rect width="1" height="1"/>',
        'width="5" height="5">',
        'width="5em" height="5"><rect width="1" height="1"/>',
    ],
)
def test_a_pattern_that_paints_nothing_is_told_and_its_fallback_paints(pattern):
    found = read(
        f'<pattern id="p" patternUnits="userSpaceOnUse" {pattern}</pattern>'
        '<rect width="100" height="100" fill="url(#p) #ff0000"/>'
    )
    assert painted(found.document, (50, 50)) == [RED]
    assert "a pattern paints it" in found.sentences[0]


def test_a_pattern_goes_with_its_shape_through_files_and_svg():
    document = read_svg(DRAWING).document
    assert decode(encode(document)) == document
    again = read_svg(svg_of(document).content.encode()).document
    for one, other in zip(document.curves, again.curves, strict=True):
        before, after = ([*each.style.gradients.values()] for each in (one, other))
        for pattern, written in zip(before, after, strict=True):
            for name in ("start", "end", "side"):
                assert getattr(written, name) == pytest.approx(getattr(pattern, name), abs=1e-6)
    (grown,) = mapped(document, whole_curves(document, [0]), scaling(2.0, 3.0, (0.0, 0.0))).curves[:1]
    pattern, larger = (each.style.fill_gradient for each in (document.curves[0], grown))
    assert larger.end == pytest.approx((2.0 * pattern.end[0], 3.0 * pattern.end[1]))


@pytest.mark.parametrize("pattern", PATTERNS, ids=lambda each: each.name)
def test_each_pattern_to_choose_has_the_colour_asked_for_and_a_clear_part(pattern):
    gradient = laid_across(((0.0, -100.0), (100.0, 0.0)), pattern.tile, RED)
    style = Style(stroke="none").with_gradient("fill", gradient)
    before = read('<rect width="100" height="100" fill="#000000"/>').document
    document = replace(before, curves=(replace(before.curves[0], style=style),))
    places = [(x + 0.4, y + 0.4) for x in range(0, 25) for y in range(0, 25)]
    found = painted(document, *places)
    assert {RED, WHITE} <= set(found)
    again = read_svg(svg_of(document).content.encode()).document
    assert painted(again, *places) == found


@pytest.mark.parametrize(
    "body",
    [
        '<image href="file:///etc/passwd" width="1" height="1"/>',
        '<use xlink:href="other.svg#a"/>',
        '<rect fill="url(https://example.org/a.svg#b)"/>',
        '<!DOCTYPE a [<!ENTITY b "c">]>',
    ],
)
def test_a_tile_of_a_file_refers_to_nothing_outside(body):
    document = read_svg(DRAWING).document
    gradient = replace(document.curves[0].style.fill_gradient, tile=Tile(body))
    curve = replace(document.curves[0], style=document.curves[0].style.with_gradient("fill", gradient))
    with pytest.raises(FormatError, match="refer to nothing but its own parts"):
        validate(replace(document, curves=(curve,)))
