"""PNG and PDF: the right size, and ink where the curve is."""

import re

import numpy as np
import pytest
from PySide6.QtGui import QColor, QImage

from app.document.model import Document, make_curve
from app.document.style import USUAL_WIDTH
from app.exchange.drawing.drawing import POINT_RADIUS, drawing_of
from app.exchange.drawing.styles import DARK, INK
from app.exchange.errors import ExchangeError
from app.exchange.files import export
from app.exchange.formats import FORMATS, endings_of
from app.exchange.options import Options
from app.families import HERMITE
from app.storage import files
from app.storage.files import StorageError
from app.view_model.curve.curve_view import view_of
from curvecore import arc_length
from tests.rows import each_row

pytestmark = pytest.mark.usefixtures("qapp")


def pixels(path):
    """The colours of a picture, (height, width, 4)."""
    image = QImage(str(path)).convertToFormat(QImage.Format.Format_RGBA8888)
    assert not image.isNull()
    rows = np.frombuffer(image.constBits(), np.uint8).reshape(image.height(), image.bytesPerLine())
    return rows[:, : 4 * image.width()].reshape(image.height(), image.width(), 4).astype(float)


def rgb(colour):
    return np.array(QColor(colour).getRgb()[:3], dtype=float)


def coverage(picture, style):
    """How much of every pixel is ink, between 0 and 1, for a picture on paper."""
    ink, paper = rgb(style.ink), rgb(style.paper)
    return ((picture[:, :, :3] - paper) @ (ink - paper)) / ((ink - paper) @ (ink - paper))


def test_ink_covers_exactly_the_curve(example, tmp_path):
    path = tmp_path / "a.png"
    export(example, path, Options(width=600, style=DARK))
    picture = pixels(path)
    drawing, curve = drawing_of(example), view_of(example.curves[0]).curve
    frame = drawing.frame
    assert picture.shape[:2] == (round(600 * frame.height / frame.width), 600)
    ink = coverage(picture, DARK)
    t = np.linspace(*curve.domain, 3001)
    x, y = curve.evaluate(t).T
    scale = 600 / frame.width
    column, row = ((x - frame.left) * scale).astype(int), ((frame.top - y) * scale).astype(int)
    width = USUAL_WIDTH * frame.side * scale
    # A line narrower than a pixel covers each pixel it crosses in part.
    assert np.quantile(ink[row, column], 0.02) > 0.3 * min(width, 1)
    # All the ink together is the line's length times its width; caps and crossings are within 6 %.
    expected = arc_length(curve, 1e-6).value * scale * width
    assert ink.sum() == pytest.approx(expected, rel=0.06)
    edge = np.concatenate([ink[:3].ravel(), ink[-3:].ravel(), ink[:, :3].ravel(), ink[:, -3:].ravel()])
    assert np.abs(edge).max() == 0


def test_points_are_discs(tmp_path):
    document = Document((make_curve([(0, 0), (1, 1), (2, 0)], family=HERMITE),))
    inks = []
    for points in (False, True):
        export(document, tmp_path / "a.png", Options(width=800, style=DARK, points=points))
        inks.append(coverage(pixels(tmp_path / "a.png"), DARK).sum())
    disc = np.pi * (POINT_RADIUS * 800) ** 2
    # The line that a disc lies on was ink before.
    assert 3 * disc * 0.4 < inks[1] - inks[0] < 3 * disc


def test_without_paper_a_png_is_transparent(sketch, tmp_path):
    export(sketch, tmp_path / "a.png", Options(width=100, style=INK))
    picture = pixels(tmp_path / "a.png")
    assert picture[0, 0, 3] == 0
    assert picture[:, :, 3].max() > 100


@each_row("offset", [0.0, 1e6])
@each_row("scale", [1e-25, 1.0, 1e5])
def test_size_and_position_do_not_matter(offset, scale, tmp_path):
    points = np.array([(0, 0), (1, 2), (3, 1), (4, 4)], dtype=float)
    pictures = []
    for some in (points, (points + offset) * scale):
        export(Document((make_curve(some.tolist()),)), tmp_path / "a.png", Options(width=200))
        pictures.append(pixels(tmp_path / "a.png"))
    # Rounding to a millionth of a millionth may move an edge by one grey level.
    assert np.abs(pictures[0] - pictures[1]).max() <= 2


def test_a_png_states_its_accuracy(sketch, tmp_path):
    export(sketch, tmp_path / "a.png", Options(width=50))
    assert QImage(str(tmp_path / "a.png")).text("Description").startswith("Largest deviation")


def test_a_path_of_very_many_pieces_is_drawn_to_its_end(tmp_path):
    # Qt cuts off what it does not trust: a warning, which fails tests, and half a curve.
    x = np.linspace(0, 1, 20_000)
    points = np.stack([x, 0.3 * np.sin(6 * x)], axis=1).tolist()
    export(
        Document((make_curve(points, family=HERMITE),)),
        tmp_path / "a.png",
        Options(width=200, style=DARK),
    )
    ink = coverage(pixels(tmp_path / "a.png"), DARK)
    assert (ink[:, 20:180].max(axis=0) > 0.1).all()


def test_a_pdf_is_one_page_in_proportion_without_a_raster_picture(example, tmp_path):
    for width in (None, 300):
        path = tmp_path / "a.PDF"
        export(example, path, Options(width=width))
        data = path.read_bytes()
        assert data.startswith(b"%PDF-")
        (box,) = re.findall(rb"/MediaBox \[(.*?)\]", data)
        left, bottom, right, top = map(float, box.split())
        frame = drawing_of(example).frame
        assert (left, bottom) == (0, 0)
        assert right == pytest.approx(width or 720 * frame.width / frame.side, abs=1e-6)
        assert top == pytest.approx(right * frame.height / frame.width, abs=1e-5)
        assert b"/Subtype /Image" not in data


@pytest.mark.parametrize("name", ["a.png", "a.pdf", "a.svg"])
def test_a_failed_export_leaves_the_old_file(name, half_drawn, nothing, tmp_path, monkeypatch):
    """What fails has been drawn: of which family it was plays no part."""
    path = tmp_path / name
    path.write_bytes(b"old")
    with pytest.raises(ExchangeError):
        export(nothing, path)

    def fail(_descriptor):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(files.os, "fsync", fail)
    with pytest.raises(StorageError, match="The disk is full"):
        export(half_drawn, path)
    assert path.read_bytes() == b"old"
    assert list(tmp_path.iterdir()) == [path]


@each_row("width", [0, -3])
def test_a_picture_has_a_width(width, sketch, tmp_path):
    with pytest.raises(ExchangeError, match="The width must be at least 1"):
        export(sketch, tmp_path / "a.svg", Options(width=width))


def test_a_picture_beyond_all_screens_is_refused(sketch, tmp_path):
    with pytest.raises(ExchangeError, match=r"A picture of 100000 × \d+ pixels is not possible"):
        export(sketch, tmp_path / "a.png", Options(width=100_000))
    assert list(tmp_path.iterdir()) == []


@each_row("name", ["a", "a.tiff", "svg", "a.png.txt"])
def test_unknown_formats_are_named_with_the_known_ones(name, sketch, tmp_path):
    with pytest.raises(ExchangeError) as refusal:
        export(sketch, tmp_path / name)
    said = str(refusal.value)
    assert said.startswith(f"The name “{name}” has no known file extension; use .curve.json, ")
    assert said.endswith(" or .coefficients.json.")
    assert all(f" {ending}" in said for ending in endings_of(FORMATS.written))
