"""Masks of SVG: read, drawn as librsvg draws them, written again, kept in the opened file, and told."""

from __future__ import annotations

import shutil
import subprocess

import numpy as np
import pytest
from msgspec.structs import replace
from PySide6.QtGui import QImage

from app.document.several_curves import mapped, whole_curves
from app.document.transforms import rotation, scaling
from app.exchange.drawing.image import pdf_file, png_file
from app.exchange.options import Options
from app.exchange.svg.reader import read_svg
from app.exchange.svg.writer import svg_of
from app.storage.format import decode, encode
from app.storage.format_error import FormatError
from app.storage.validation import validate

WIDTH = 960

MASKS = """<style>.k{fill:#ffffff}</style><linearGradient id="g"><stop offset="0" stop-color="#000"/>
<stop offset="1" stop-color="#fff"/></linearGradient>
<mask id="fade"><rect width="120" height="80" fill="url(#g)"/></mask>
<mask id="hole" maskUnits="userSpaceOnUse" x="45" y="5" width="30" height="20"><circle cx="60" cy="20" r="12"
class="k"/></mask>
<mask id="share" maskContentUnits="objectBoundingBox" x="0" y="0" width="1" height="0.7"><circle cx=".5"
cy=".5" r=".4" fill="#00ff00"/></mask>
<mask id="cover" style="mask-type:alpha" maskUnits="userSpaceOnUse" x="0" y="0" width="100%" height="80"><g
transform="rotate(10)"><rect x="10" y="45" width="40" height="20" fill-opacity=".5"/></g></mask>
<mask id="half" maskUnits="userSpaceOnUse" x="-20" y="-20" width="40" height="40"><rect x="-10" y="-10"
width="10" height="30" fill="#ff0000"/><rect y="-4" width="10" height="8" fill="#ffff00"
fill-opacity=".7"/></mask>
<mask id="words" maskUnits="userSpaceOnUse" width="120" height="80"><text font-size="24" font-weight="bold"
font-family="DejaVu Sans" fill="#fff"><tspan x="10" y="30">Mask</tspan><tspan x="20" y="60">two</tspan></text>
</mask>"""

SHAPES = {
    "a box in the units of the page": '<rect x="5" y="5" width="30" height="30" fill="#0000aa" stroke="#000"'
    ' stroke-width="2" mask="url(#fade)"/>',
    "a region": '<circle cx="60" cy="20" r="15" fill="#cc2200" mask="url(#hole)" opacity=".8"/>',
    "shares of a box": '<rect x="80" y="5" width="35" height="30" rx="4" fill="#006600" mask="url(#share)"/>',
    "alpha, of a group": '<g mask="url(#cover)"><rect x="5" y="45" width="15" height="30" fill="#aa0000"/>'
    '<rect x="25" y="45" width="15" height="30" fill="#0000aa"/></g>',
    "turned, and two": '<g transform="translate(90 60) rotate(20) scale(1.5)" mask="url(#half)">'
    '<rect x="-10" y="-10" width="20" height="20" fill="#000" style="mask:url(#half)"/></g>',
    # The words were on one line: QtSvg has all parts of a text one behind the other.
    "two lines of words": '<rect x="5" y="5" width="100" height="70" fill="#0000aa" mask="url(#words)"/>',
    "a shape used": '<defs><rect id="u" width="20" height="20" fill="#770077"/></defs><use xlink:href="#u"'
    ' x="10" y="10" mask="url(#fade)"/>',
    "a picture": '<image x="60" y="10" width="30" height="30" preserveAspectRatio="none" mask="url(#fade)"'
    ' xlink:href="data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9Q'
    'DwADhgGAWjR9awAAAABJRU5ErkJggg=="/>',
}


def svg(body):
    return (
        '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" width="120"'
        f' height="80"><defs>{MASKS}</defs>{body}</svg>'
    ).encode()


def levels(data):
    image = QImage.fromData(data).convertToFormat(QImage.Format.Format_RGB888)
    rows = np.frombuffer(image.constBits(), np.uint8).reshape(image.height(), image.bytesPerLine())
    return rows[:, : 3 * image.width()].reshape(image.height(), image.width(), 3).astype(int)


def ours(document):
    return levels(png_file(document, Options(width=WIDTH)).content)


@pytest.fixture
def by_librsvg(tmp_path):
    if shutil.which("rsvg-convert") is None:
        pytest.skip("librsvg is not installed")

    def drawn(data):
        (tmp_path / "a.svg").write_bytes(data)
        command = ["rsvg-convert", f"--width={WIDTH}", "--background-color=white", "-o", f"{tmp_path}/a.png"]
        subprocess.run([*command, f"{tmp_path}/a.svg"], check=True, timeout=60)
        return levels((tmp_path / "a.png").read_bytes())

    return drawn


def differs(one, other):
    """How many pixels differ by more than 3 of 255 together with all beside them: edges may."""
    off = np.abs(one - other).max(axis=2) > 3
    within = off[1:-1, 1:-1] & off[:-2, 1:-1] & off[2:, 1:-1] & off[1:-1, :-2] & off[1:-1, 2:]
    return int(within.sum())


@pytest.mark.parametrize("body", [*SHAPES.values(), "".join(SHAPES.values())], ids=[*SHAPES, "all"])
def test_librsvg_draws_the_file_as_we_draw_it_and_as_we_write_it(body, by_librsvg):
    found, theirs = read_svg(svg(body)), by_librsvg(svg(body))
    assert found.sentences == ()
    assert all(curve.style.masks for curve in found.document.curves)
    assert (theirs < 250).any(axis=2).sum() > 2000
    # Whole, it differs in thousands of pixels: the masks are what is compared.
    whole = [replace(each, style=replace(each.style, masks=())) for each in found.document.curves]
    assert differs(ours(replace(found.document, curves=tuple(whole))), theirs) > 2000
    assert differs(ours(found.document), theirs) == 0
    assert differs(by_librsvg(svg_of(found.document).data), theirs) == 0


def test_a_mask_goes_with_its_shape(by_librsvg):
    body = SHAPES["a region"]
    document = read_svg(svg(body)).document
    by = rotation(30.0, (60.0, -20.0))
    turned = mapped(document, whole_curves(document, [0]), by)
    theirs = by_librsvg(svg(f'<g transform="rotate(-30 60 20)">{body}</g>'))
    assert differs(ours(turned), theirs) == 0
    assert differs(by_librsvg(svg_of(turned).data), theirs) == 0
    grown = mapped(document, whole_curves(document, [0]), scaling(2.0, 3.0, (0.0, 0.0)))
    (mask,), (before,) = grown.curves[0].style.masks, document.curves[0].style.masks
    assert (before.start, before.end, before.side) == ((45, -5), (75, -5), (45, -25))
    assert (mask.start, mask.end, mask.side) == ((90, -15), (150, -15), (90, -75))


def test_letters_are_masked_as_pictures_and_shapes_are():
    body = '<text x="10" y="40" font-size="40" font-family="DejaVu Sans" mask="url(#fade)">MMM</text>'
    document = read_svg(svg(body)).document
    seen, whole = ours(document), ours(read_svg(svg(body.replace("fade", "none"))).document)
    dark = (whole < 5).all(axis=2)
    assert dark.sum() > 5000
    at = np.flatnonzero(dark.any(axis=0))
    # The gradient goes over the box of the rectangle in the mask, from black to white along 960 pixels.
    for x in at[:: len(at) // 7]:
        assert seen[dark[:, x], x].mean() == pytest.approx(255 * (1 - (x + 0.5) / WIDTH), abs=3)


def test_masks_pass_through_files_and_svg_however_often():
    document = read_svg(svg("".join(SHAPES.values()))).document
    assert decode(encode(document)) == document
    upright = [curve for curve in document.curves if len(curve.style.masks) == 1]
    assert len(upright) == 8
    for _ in range(3):
        again = read_svg(svg_of(document).data).document
        for one, other in zip(document.curves, again.curves, strict=True):
            for mine, theirs in zip(one.style.masks, other.style.masks, strict=True):
                assert theirs.is_alpha is mine.is_alpha
                if len(one.style.masks) == 1:
                    assert theirs.tile.body == mine.tile.body
                    assert theirs.tile.view == pytest.approx(mine.tile.view, abs=1e-9)
                    assert theirs.start == pytest.approx(mine.start, abs=1e-9)
        document = again


def test_a_pdf_has_a_picture_of_what_is_masked_and_says_so():
    body = SHAPES["a region"].replace("<circle", '<circle id="Sun"')
    written = pdf_file(read_svg(svg(body)).document, Options())
    assert written.remarks == ("“Sun” is masked, and a picture of at most 300 dpi in a PDF.",)
    assert b"/SMask" in written.content


def test_groups_whose_shapes_lie_one_over_the_other_are_told():
    pair = '<rect width="50" height="50"/><rect x="40" width="50" height="50"/>'
    body = f'<g id="Pair" mask="url(#fade)">{pair}</g>'
    (sentence,) = read_svg(svg(body)).sentences
    assert "it is masked as a whole, each of its shapes is" in sentence.replace(";", ",")


@pytest.mark.parametrize(
    "mask",
    [
        'width="0" height="5"><rect width="1" height="1" fill="#fff"/>',
        'width="5em" height="5"><rect width="1" height="1" fill="#fff"/>',
        'color-interpolation="linearRGB"><rect width="100" height="100" fill="#fff"/>',
    ],
)
def test_a_mask_that_is_not_known_is_told_and_its_shape_whole(mask):
    found = read_svg(svg(f'<mask id="odd" {mask}</mask><rect width="100" height="80" mask="url(#odd)"/>'))
    assert found.document.curves[0].style.masks == ()
    assert "a mask covers some of it" in found.sentences[0]


@pytest.mark.parametrize(
    "body", ['<image href="file:///etc/passwd"/>', '<use xlink:href="other.svg#a"/>', "<!DOCTYPE a>"]
)
def test_a_mask_of_a_file_refers_to_nothing_outside(body):
    document = read_svg(svg(SHAPES["a region"])).document
    style = document.curves[0].style
    mask = replace(style.masks[0], tile=replace(style.masks[0].tile, body=body))
    curve = replace(document.curves[0], style=replace(style, masks=(mask,)))
    with pytest.raises(FormatError, match="refer to nothing but its own parts"):
        validate(replace(document, curves=(curve,)))
