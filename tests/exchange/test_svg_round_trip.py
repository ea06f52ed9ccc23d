"""Files as other programs write them, taken in and written out unchanged: they look the same.

The judge is librsvg where it is installed, and Qt's own SVG renderer everywhere.
"""

import shutil
import subprocess
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import pytest
from msgspec.structs import replace
from PySide6.QtCore import QRectF
from PySide6.QtGui import QImage, QPainter
from PySide6.QtSvg import QSvgRenderer

from app.exchange.drawing.drawing import drawing_of
from app.exchange.drawing.painting import Painting
from app.exchange.drawing.styles import INK
from app.exchange.options import Options
from app.exchange.svg.coordinates import page_of
from app.exchange.svg.own_files import OwnFile
from app.exchange.svg.reader import read_svg
from app.exchange.svg.writer import svg_of
from app.exchange.svg.xml_tree import parse_xml

FILES = sorted((Path(__file__).parents[1] / "data" / "svg").glob("*.svg"))
WIDTH = 840
"""With it the height of each is a whole number: a picture of another one is scaled a little otherwise."""
LEVELS = 3
"""Of 255: what rounding of colours and opacities may change."""

pytestmark = pytest.mark.usefixtures("qapp")


def pixels(image):
    """The picture on white paper, (height, width, 3)."""
    paper = QImage(image.size(), QImage.Format.Format_RGB32)
    paper.fill(0xFFFFFFFF)
    painter = QPainter(paper)
    painter.drawImage(0, 0, image)
    painter.end()
    data = np.frombuffer(paper.constBits(), np.uint8).reshape(paper.height(), paper.width(), 4)
    return data[..., :3].astype(np.int16)


def by_qt(svg, _folder):
    renderer = QSvgRenderer(svg)
    assert renderer.isValid()
    size = renderer.viewBoxF()
    image = QImage(
        WIDTH, round(WIDTH * size.height() / size.width()), QImage.Format.Format_ARGB32_Premultiplied
    )
    image.fill(0)
    painter = QPainter(image)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    renderer.render(painter, QRectF(image.rect()))
    painter.end()
    return pixels(image)


def by_librsvg(svg, folder):
    (folder / "a.svg").write_bytes(svg)
    command = ["rsvg-convert", "--width", str(WIDTH), "-o", str(folder / "a.png"), str(folder / "a.svg")]
    subprocess.run(command, check=True)
    return pixels(QImage(str(folder / "a.png")))


JUDGES = [
    pytest.param(
        by_librsvg,
        marks=pytest.mark.skipif(shutil.which("rsvg-convert") is None, reason="librsvg is not installed"),
        id="librsvg",
    ),
    pytest.param(by_qt, id="Qt"),
]


def span(picture):
    """The darkest and the lightest of each pixel and those that touch it."""
    padded = np.pad(picture, ((1, 1), (1, 1), (0, 0)), mode="edge")
    return _nearby(padded, np.minimum), _nearby(padded, np.maximum)


def _nearby(padded, extreme):
    """The extreme of each pixel and those that touch it: along columns, and then along rows."""
    columns = extreme.reduce([padded[:-2], padded[1:-1], padded[2:]])
    return extreme.reduce([columns[:, :-2], columns[:, 1:-1], columns[:, 2:]])


def beyond_a_pixel(one, other):
    """By how much any pixel differs from all that lie within one pixel of it in the other picture."""
    assert one.shape == other.shape
    worst = 0
    for seen, wanted in ((one, other), (other, one)):
        low, high = span(wanted)
        worst = max(worst, int(np.maximum(low - seen, seen - high).max()))
    return worst


def known_to(judge, path):
    """Whether a judge draws a file rightly: Qt knows neither rules for classes nor nested view boxes."""
    text = path.read_text(encoding="utf-8")
    return judge is not by_qt or not any(word in text for word in ("<style", "<symbol", "clip-path", "hsl("))


def frame_of(data):
    """What a file shows, in its unit; None where it does not say."""
    root = parse_xml(data)
    return page_of(root, is_nominal=OwnFile(root).has_nominal_size).frame


def within(written, data):
    """What was written, seen as far as the file shows; its coordinates are those of the file in its unit."""
    frame, root = frame_of(data), ET.fromstring(written)
    if frame is not None:
        root.set("viewBox", f"{frame.left} {-frame.top} {frame.width} {frame.height}")
        root.set("width", str(WIDTH))
        root.set("height", str(WIDTH * frame.height / frame.width))
    return ET.tostring(root)


@pytest.mark.parametrize("judge", JUDGES)
@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_a_file_written_out_unchanged_looks_the_same(path, judge, tmp_path):
    if not known_to(judge, path):
        pytest.skip("Qt does not draw this rightly")
    data = path.read_bytes()
    found = read_svg(data)
    written = svg_of(found.document, Options(unit=found.document.unit))
    before, after = (judge(each, tmp_path) for each in (data, within(written.data, data)))
    assert (before != 255).any(axis=-1).sum() > 2000
    assert beyond_a_pixel(before, after) <= LEVELS


@pytest.mark.skipif(shutil.which("rsvg-convert") is None, reason="librsvg is not installed")
@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_imported_files_look_like_the_original(path, tmp_path):
    data = path.read_bytes()
    drawing, frame = drawing_of(read_svg(data).document), frame_of(data)
    if frame is None:
        data, frame = svg_of(read_svg(data).document).data, drawing.frame
    theirs = by_librsvg(data, tmp_path)
    # What is whole but for rounding librsvg rounds up.
    height = round(WIDTH * frame.height / frame.width)
    image = QImage(WIDTH, height, QImage.Format.Format_ARGB32_Premultiplied)
    image.fill(0)
    with QPainter(image) as painter:
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        fitted = replace(drawing, frame=frame).fitted(WIDTH, height)
        Painting(fitted, painter, INK).paint(points=False)
    # Another renderer smooths its edges otherwise, by a level or two of a pixel's coverage.
    assert beyond_a_pixel(pixels(image), theirs[:height]) <= 16


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_written_files_are_read_as_the_same_curves(path):
    found = read_svg(path.read_bytes()).document
    again = read_svg(svg_of(found, Options(unit=found.unit)).data).document
    assert again.unit == found.unit
    assert [curve.visible for curve in again.curves] == [curve.visible for curve in found.curves]
    for old, new in zip(found.curves, again.curves, strict=True):
        assert (new.closed, bool(new.shape), len(new.points)) == (
            old.closed,
            bool(old.shape),
            len(old.points),
        )
        assert new.groups == old.groups
        near = pytest.approx
        assert [point.position for point in new.points] == [near(p.position, rel=1e-12) for p in old.points]
        assert new.style.width == (None if old.style.width is None else near(old.style.width))
        assert new.style.dash == near(old.style.dash)
        for field in ("stroke", "fill", "cap", "fill_rule", "fill_opacity", "stroke_opacity"):
            if old.style.has_stroke or field not in ("cap",):
                assert getattr(new.style, field) == getattr(old.style, field), (old.name, field)


def test_a_circle_of_four_arcs_is_four_points():
    (curve,) = read_svg(
        b'<svg xmlns="http://www.w3.org/2000/svg"><path d="M 55 10 A 12 12 0 0 0 43 22 A 12 12 0 0 0 55 34 '
        b'A 12 12 0 0 0 67 22 A 12 12 0 0 0 55 10 z"/></svg>'
    ).document.curves
    assert [point.position for point in curve.points] == [(55, -10), (43, -22), (55, -34), (67, -22)]
    assert not any(point.corner for point in curve.points)
    assert curve.closed


def test_sides_of_rounded_rectangles_are_read_as_lines():
    """A long side took the direction of the short handle beside it, 3e-14 off, and went out as a cubic."""
    for box in (
        (122.878, 92.171, 6.567, 46.691, 0.77),
        (51.804, 168.507, 134.95, 17.564, 0.92),
        (10, 10, 90, 122, 8),
    ):
        x, y, width, height, radius = box
        text = f'<rect x="{x}" y="{y}" width="{width}" height="{height}" rx="{radius}"/>'
        drawn = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 210 297">{text}</svg>'
        document = read_svg(drawn.encode()).document
        data = svg_of(document).text
        assert (data.count(" L "), data.count(" C ")) == (4, 4)
