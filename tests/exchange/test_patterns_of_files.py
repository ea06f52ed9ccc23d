"""Patterns of SVG files, shape by shape, as librsvg draws them; and kept by the file that was opened."""

import shutil
import subprocess

import numpy as np
import pytest
from PySide6.QtGui import QImage

from app.document.several_curves import mapped, whole_curves
from app.document.transforms import rotation
from app.exchange.options import Options
from app.exchange.svg.reader import read_svg
from app.exchange.svg.writer import svg_of
from app.exchange.writing import export

HEAD = (
    '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" '
    'width="400" height="300" viewBox="0 0 400 300">'
)
DEFS = """<defs><linearGradient id="g"><stop offset="0" stop-color="red"/><stop offset="1"/></linearGradient>
<pattern id="a" patternUnits="userSpaceOnUse" x="3" y="5" width="20" height="14"
 patternTransform="rotate(20) scale(1.5)"><rect width="10" height="7" fill="#034"/>
<circle cx="15" cy="9" r="3" fill="url(#g)" stroke="black"/></pattern>
<pattern id="b" x=".1" width=".25" height=".25" patternContentUnits="objectBoundingBox">
<path d="M0 0L.125 .25L.25 0Z" fill="#800"/></pattern>
<pattern id="c" patternUnits="userSpaceOnUse" width="30" height="30" viewBox="0 0 10 10">
<circle cx="5" cy="5" r="4" fill="none" stroke="#030" stroke-width="1.5"/><path d="M0 0L10 10" stroke="#000"/>
</pattern><pattern id="d" xlink:href="#a" patternTransform="translate(4 4)"/></defs>"""
SHAPES = {
    "transform": '<rect x="10" y="10" width="120" height="100" fill="url(#a)" stroke="black"/>',
    "box": '<circle cx="220" cy="70" r="60" fill="url(#b)"/>',
    "view box": '<ellipse cx="340" cy="70" rx="50" ry="60" fill="url(#c)" stroke="#444"/>',
    "inherited": '<path d="M20 220C100 120 200 320 380 200" fill="none" stroke="url(#d)" stroke-width="40"/>',
}
WIDTH = 800

pytestmark = pytest.mark.usefixtures("qapp")


def svg(body, defs=DEFS):
    return f"{HEAD}{defs}{body}</svg>".encode()


def document_of(body, defs=DEFS):
    found = read_svg(svg(body, defs))
    return found.document, found.sentences


def levels(path):
    """A picture on white paper in grey, (height, width)."""
    picture = QImage(str(path)).convertToFormat(QImage.Format.Format_ARGB32)
    pixels = np.frombuffer(picture.constBits(), np.uint8).reshape(picture.height(), picture.width(), 4)
    alpha = pixels[..., 3:].astype(float) / 255
    return (pixels[..., :3] * alpha + 255 * (1 - alpha)).mean(axis=2)


def differs(one, other):
    """Where dark is more than a pixel away from dark, and light from light: no edge is that far off."""
    found = np.zeros(one.shape, bool)
    for mine, theirs in ((one, other), (other, one)):
        for dark in (True, False):
            there = theirs < 140 if dark else theirs > 170
            padded = np.pad(there, 1)
            height, width = there.shape
            near = np.any([padded[i : i + height, j : j + width] for i in range(3) for j in range(3)], axis=0)
            found |= (mine < 110 if dark else mine > 200) & ~near
    return found


def rendered(data, tmp_path, name):
    (tmp_path / f"{name}.svg").write_bytes(data)
    command = [
        "rsvg-convert",
        "--width",
        str(WIDTH),
        "-o",
        f"{tmp_path}/{name}.png",
        f"{tmp_path}/{name}.svg",
    ]
    subprocess.run(command, check=True, timeout=60)
    return levels(tmp_path / f"{name}.png")


@pytest.mark.skipif(shutil.which("rsvg-convert") is None, reason="librsvg is not installed")
@pytest.mark.parametrize("body", SHAPES.values(), ids=SHAPES)
def test_librsvg_draws_the_file_as_we_draw_it_and_as_we_write_it(body, tmp_path):
    document, sentences = document_of(body)
    assert sentences == ()
    theirs = rendered(svg(body), tmp_path, "theirs")
    export(document, tmp_path / "ours.png", Options(width=WIDTH))
    again = rendered(svg_of(document).data, tmp_path, "again")
    assert (theirs < 128).sum() > 3000
    assert differs(levels(tmp_path / "ours.png"), theirs).sum() == 0
    assert differs(again, theirs).sum() == 0


@pytest.mark.skipif(shutil.which("rsvg-convert") is None, reason="librsvg is not installed")
def test_a_pattern_goes_with_its_shape(tmp_path):
    document, _ = document_of(SHAPES["transform"])
    turned = mapped(document, whole_curves(document, [0]), rotation(30.0, (70.0, -60.0)))
    by = '<g transform="rotate(-30 70 60)">'
    theirs = rendered(svg(f"{by}{SHAPES['transform']}</g>"), tmp_path, "theirs")
    export(turned, tmp_path / "ours.png", Options(width=WIDTH))
    assert differs(levels(tmp_path / "ours.png"), theirs).sum() == 0


def test_a_pattern_that_was_written_is_read_as_the_same_however_often():
    """Its body was 272, 333 and 390 letters long when it was written and read twice."""
    document, _ = document_of("".join(SHAPES.values()))
    for _ in range(3):
        again = read_svg(svg_of(document).data).document
        for one, other in zip(document.curves, again.curves, strict=True):
            for name, mine in one.style.gradients.items():
                theirs = other.style.gradients[name]
                assert theirs.tile.body == mine.tile.body
                assert theirs.tile.view == pytest.approx(mine.tile.view, abs=1e-9)
        document = again


@pytest.mark.skipif(shutil.which("pdftoppm") is None, reason="poppler is not installed")
def test_a_pdf_looks_as_the_png_does(tmp_path):
    document, _ = document_of("".join(SHAPES.values()))
    export(document, tmp_path / "a.png", Options(width=WIDTH))
    written = export(document, tmp_path / "a.pdf")
    assert any("pictures of at most 4000 pixels a side in a PDF" in each for each in written.remarks)
    command = ["pdftoppm", "-png", "-singlefile", "-scale-to-x", str(WIDTH), "-scale-to-y", "-1"]
    subprocess.run([*command, str(tmp_path / "a.pdf"), str(tmp_path / "pdf")], check=True, timeout=60)
    ours, theirs = levels(tmp_path / "a.png"), levels(tmp_path / "pdf.png")
    height, width = np.minimum(ours.shape, theirs.shape)
    # The pixels of a picture are squares to poppler, and its own lie beside these.
    assert differs(ours[:height, :width], theirs[:height, :width]).mean() < 1e-3


@pytest.mark.parametrize("ending", [".dxf", ".tikz"])
def test_formats_without_patterns_say_so(ending, tmp_path):
    document, _ = document_of(SHAPES["box"])
    remarks = export(document, tmp_path / f"a{ending}").remarks
    assert "“Circle 15” has a pattern; its colour stands for it." in " ".join(remarks)
