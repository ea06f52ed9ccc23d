"""Files as other programs write them, taken in and written out unchanged: they look the same.

The judge is librsvg where it is installed, and Qt's own SVG renderer everywhere.
"""

import re
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtCore import QRectF
from PySide6.QtGui import QImage, QPainter
from PySide6.QtSvg import QSvgRenderer

from app.document.model import Page
from app.exchange.corner import from_lower_left
from app.exchange.options import Options
from app.exchange.svg.reader import read_svg
from app.exchange.svg.writer import svg_of
from app.exchange.writing import export

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
    return data[..., :3].astype(int)


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
    subprocess.run(command, check=True, timeout=60)
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
    height, width, _ = picture.shape
    around = [padded[i : i + height, j : j + width] for i in range(3) for j in range(3)]
    return np.min(around, axis=0), np.max(around, axis=0)


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


@pytest.mark.parametrize("judge", JUDGES)
@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_a_file_written_out_unchanged_looks_the_same(path, judge, tmp_path):
    if not known_to(judge, path):
        pytest.skip("Qt does not draw this rightly")
    data = path.read_bytes()
    found = read_svg(data)
    written = svg_of(found.document, Options(unit=found.document.unit))
    before, after = (judge(each, tmp_path) for each in (data, written.data))
    assert (before != 255).any(axis=-1).sum() > 2000
    assert beyond_a_pixel(before, after) <= LEVELS


@pytest.mark.skipif(shutil.which("rsvg-convert") is None, reason="librsvg is not installed")
@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_a_png_looks_as_the_file_does(path, tmp_path):
    found = read_svg(path.read_bytes())
    export(found.document, tmp_path / "ours.png", Options(width=WIDTH, transparent=True))
    ours, theirs = pixels(QImage(str(tmp_path / "ours.png"))), by_librsvg(path.read_bytes(), tmp_path)
    # What is whole but for rounding librsvg rounds up.
    theirs = theirs[: len(ours)]
    # Another renderer smooths its edges otherwise, by a level or two of a pixel's coverage.
    assert beyond_a_pixel(ours, theirs) <= 16


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_what_was_written_is_read_as_the_same_curves(path):
    found = from_lower_left(read_svg(path.read_bytes()).document)
    again = from_lower_left(read_svg(svg_of(found, Options(unit=found.unit)).data).document)
    assert (again.unit, again.page) == (found.unit, found.page)
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


def test_sides_of_rounded_rectangles_come_back_as_lines():
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


def test_coordinates_of_a_drawing_go_out_as_they_came_in():
    """An opened drawing hung below the origin: all numbers of y were negative."""
    places = np.random.default_rng(1).uniform(0, 148, (200, 2)).round(3).tolist()
    data = " ".join(f"{x} {y}" for x, y in places)
    box = 'viewBox="0 0 148 148"'
    drawn = f'<svg xmlns="http://www.w3.org/2000/svg" {box}><path d="M{data}" stroke="red"/></svg>'
    found = from_lower_left(read_svg(drawn.encode()).document)
    assert found.page == Page(0.0, 0.0, 148.0, 148.0)
    assert [point.y for point in found.curves[0].points] == [round(148 - y, 3) for _, y in places]
    text = svg_of(found).text
    assert box in text
    assert re.findall(r"[ML] ([\d.]+ [\d.]+)", text) == [f"{x:g} {y:g}" for x, y in places]
    # A drawing with its origin in the middle has it there on purpose.
    middle = read_svg(drawn.replace("0 0 148", "-74 -74 148").encode()).document
    assert from_lower_left(middle) is middle
