"""Gradients of SVG taken in and written; formats that have none say so."""

import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtGui import QImage

from app.document.gradient import GradientKind, Spread
from app.exchange.options import Options
from app.exchange.svg.reader import read_svg
from app.exchange.svg.writer import svg_of
from app.exchange.writing import export

FILE = Path(__file__).parents[1] / "data" / "svg" / "inkscape_gradients.svg"
STOPS = '<stop offset="10%" stop-color="red"/><stop offset=".5" stop-color="blue" stop-opacity=".5"/>'

pytestmark = pytest.mark.usefixtures("qapp")


def paints(body, attributes='width="200" height="100" viewBox="0 0 200 100"'):
    """The gradients that fill the shapes of a drawing; what is not taken over."""
    found = read_svg(f'<svg xmlns="http://www.w3.org/2000/svg" {attributes}>{body}</svg>'.encode())
    return [curve.style.fill_gradient for curve in found.document.curves], found.sentences


def near(place):
    return pytest.approx(place, abs=1e-9)


def offset_at(gradient, place):
    """The offset of a place, as far as the focus does not matter."""
    u, v = gradient.coordinates(place)
    return u if gradient.kind is GradientKind.LINEAR else np.hypot(u, v)


def test_a_gradient_takes_what_it_does_not_say_from_another_and_lies_in_the_plane():
    (found,), sentences = paints(
        f'<linearGradient id="a" x1="10" x2="30" y2="5" spreadMethod="reflect">{STOPS}</linearGradient>'
        '<linearGradient id="b" href="#a" gradientUnits="userSpaceOnUse" gradientTransform="translate(1 2)"/>'
        '<g transform="scale(2)"><g transform="translate(5)">'
        '<rect width="9" height="9" fill="url(#b)"/></g></g>'
    )
    assert sentences == ()
    assert (found.kind, found.spread) == (GradientKind.LINEAR, Spread.REFLECT)
    assert [(stop.offset, stop.colour, stop.opacity) for stop in found.stops] == [
        (0.1, "#ff0000", 1.0),
        (0.5, "#0000ff", 0.5),
    ]
    assert (found.start, found.end) == (near((32.0, -4.0)), near((72.0, -14.0)))
    # What lies across stays across.
    assert np.dot(*found.axes) == pytest.approx(0.0, abs=1e-9)


def test_a_gradient_that_refers_to_none_takes_nothing_from_one_without_a_name():
    """The last element without an id was found where nothing is referred to."""
    stopped = '<linearGradient id="a" gradientUnits="userSpaceOnUse" x2="9">' + STOPS + "</linearGradient>"
    rect = '<rect width="9" height="9" fill="url(#a)"/>'
    (alone,), _ = paints(stopped + rect)
    (beside,), _ = paints(stopped + rect + '<linearGradient spreadMethod="reflect" y2="7"/>')
    assert beside == alone


def test_a_box_stretches_a_radial_gradient_and_percentages_are_parts_of_the_drawing():
    boxed, measured = paints(
        f'<radialGradient id="a" cx=".25" fx=".5">{STOPS}</radialGradient>'
        f'<radialGradient id="b" gradientUnits="userSpaceOnUse" r="10">{STOPS}</radialGradient>'
        '<rect x="10" y="20" width="40" height="20" fill="url(#a)"/>'
        '<rect x="10" y="20" width="40" height="20" fill="url(#b)"/>'
    )[0]
    assert (boxed.start, boxed.end, boxed.side) == (near((20, -30)), near((40, -30)), near((20, -40)))
    assert boxed.focus == near((30, -30))
    assert (measured.start, measured.end, measured.focus) == (near((100, -50)), near((110, -50)), None)


@pytest.mark.parametrize(
    ("gradient", "sentence"),
    [
        (
            '<linearGradient id="g" gradientUnits="userSpaceOnUse">',
            "a gradient paints it that has no place; ",
        ),
        ('<radialGradient id="g" fr="0.2">', "its gradient begins with a disc; it begins in a point."),
    ],
)
def test_what_of_a_gradient_cannot_come_is_told(gradient, sentence):
    end = f"</{gradient[1:15]}>"
    _, sentences = paints(f'{gradient}{STOPS}{end}<rect width="2" height="2" fill="url(#g)"/>', "")
    assert len(sentences) == 1
    assert sentence in sentences[0]


def test_what_was_written_is_read_as_the_same_gradients_and_like_ones_are_one():
    found = read_svg(FILE.read_bytes()).document
    written = svg_of(found, Options(unit=found.unit)).data
    again = read_svg(written).document
    for old, new in zip(found.curves, again.curves, strict=True):
        assert new.style.gradients.keys() == old.style.gradients.keys()
        for name, gradient in old.style.gradients.items():
            other = new.style.gradients[name]
            assert (other.kind, other.spread, other.stops) == (gradient.kind, gradient.spread, gradient.stops)
            for place in ((0.0, 0.0), (100.0, -30.0)):
                assert offset_at(other, place) == pytest.approx(offset_at(gradient, place), rel=1e-9)
    curve = found.curves[0]
    twice = type(found)((curve, curve))
    assert svg_of(twice).data.count(b"<linearGradient") == 1
    assert svg_of(twice).data.count(b'fill="url(#gradient)"') == 2


@pytest.mark.parametrize("ending", [".dxf", ".tikz"])
def test_formats_without_gradients_say_so(ending, tmp_path):
    document = read_svg(FILE.read_bytes()).document
    remarks = export(document, tmp_path / f"a{ending}").remarks
    assert any("have gradients; their mean colours stand for them." in remark for remark in remarks)


@pytest.mark.skipif(shutil.which("gs") is None, reason="Ghostscript is not installed")
def test_a_pdf_looks_as_the_png_does(tmp_path):
    """Qt's own gradients in PDF files let nothing through."""
    document = read_svg(FILE.read_bytes()).document
    export(document, tmp_path / "a.pdf", Options(unit="mm", transparent=True))
    command = ["gs", "-q", "-dNOPAUSE", "-dBATCH", "-sDEVICE=png16m", "-r72", "-dGraphicsAlphaBits=4"]
    subprocess.run([*command, f"-sOutputFile={tmp_path / 'a.png'}", str(tmp_path / "a.pdf")], check=True)
    page = QImage(str(tmp_path / "a.png"))
    export(document, tmp_path / "b.png", Options(width=page.width(), transparent=False))
    picture = QImage(str(tmp_path / "b.png"))
    x, y = picture.width() / 140, picture.height() / 100
    # Within each of the fills, where they let half of the paper through.
    for place in ((52, 25), (72, 28), (12, 70), (118, 20), (70, 70)):
        one, other = (each.pixelColor(round(place[0] * x), round(place[1] * y)) for each in (page, picture))
        assert [one.red(), one.green(), one.blue()] == pytest.approx(
            [other.red(), other.green(), other.blue()], abs=12
        )
