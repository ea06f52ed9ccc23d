"""Texts on circles and rectangles: SVG 1.1 lays them along paths alone, and browsers know no others."""

from __future__ import annotations

import re
import shutil
import subprocess
import xml.etree.ElementTree as ET

import pytest

from app.document.along_edits import along_of
from app.document.forms import Ellipse
from app.document.several_curves import moved, whole_curves
from app.exchange.corner import from_lower_left
from app.exchange.svg.in_place.rewriting import rewritten
from app.exchange.svg.reader import read_svg
from app.exchange.svg.writer import svg_of
from app.features.text.along import put_on_path
from app.qt.contents import measured
from app.session.along_paths import settled

pytestmark = pytest.mark.usefixtures("qapp")

SVG, XLINK = "{http://www.w3.org/2000/svg}", "{http://www.w3.org/1999/xlink}"
HEAD = '<svg xmlns="http://www.w3.org/2000/svg" width="200mm" height="200mm" viewBox="0 0 200 200">'
TEXT = '<text id="t" x="9" y="9" font-family="DejaVu Sans" font-size="12">Around</text>'
SHAPES = {
    "circle": '<circle id="c" cx="100" cy="90" r="60" fill="none" stroke="#888"/>',
    "ellipse": '<ellipse id="c" cx="100" cy="90" rx="60" ry="30" fill="none" stroke="#888"/>',
    "turned": '<ellipse id="c" transform="rotate(30 100 90)" cx="100" cy="90" rx="60" ry="30"/>',
    "rect": '<rect id="c" x="30" y="50" width="90" height="60" fill="none" stroke="#888"/>',
}


def read(text):
    return measured(from_lower_left(read_svg(text.encode()).document))


def around(shape):
    """What a file with a shape and words says, and its document with these on that."""
    text = f"{HEAD}{SHAPES[shape]}{TEXT}</svg>"
    begun = read(text)
    return text, begun, settled(put_on_path(begun, 1, 0, lambda: "known"), begun, begun)


def course_of(text):
    """The element that the words of a file lie along."""
    root = ET.fromstring(text)
    (words,) = root.iter(f"{SVG}textPath")
    (found,) = (each for each in root.iter() if f"#{each.get('id')}" == words.get(f"{XLINK}href"))
    return found


@pytest.mark.parametrize("shape", SHAPES)
def test_words_lie_along_a_path_that_is_a_circle_to_inkscape_still(shape):
    """They referred to an ellipse."""
    document = around(shape)[2]
    text = svg_of(document).text
    assert course_of(text).tag == f"{SVG}path"
    again = read(text)
    assert isinstance(again.curves[0].form, Ellipse) == (shape in ("circle", "ellipse"))
    assert along_of(again.curves[1]).of == again.curves[0].identity != ""
    one, other = (along_of(each.curves[1]).length for each in (document, again))
    assert one == pytest.approx(other, rel=1e-9)


@pytest.mark.parametrize("shape", ["circle", "ellipse"])
def test_a_circle_of_a_file_that_gets_words_becomes_a_path(shape):
    text, begun, document = around(shape)
    written = rewritten(text.encode(), document, begun)
    assert course_of(written.data.decode()).tag == f"{SVG}path"
    again = read(written.data.decode())
    assert again.curves[0].form == document.curves[0].form
    # And stays one when it is moved.
    both = moved(again, whole_curves(again, (0,)), (5.0, 5.0))
    later = rewritten(written.data, settled(both, again, again), again)
    assert course_of(later.data.decode()).tag == f"{SVG}path"
    assert isinstance(read(later.data.decode()).curves[0].form, Ellipse)


@pytest.mark.skipif(shutil.which("inkscape") is None, reason="Inkscape is not installed")
def test_inkscape_shows_the_words_on_the_circle_and_takes_it_for_one(tmp_path):
    path = tmp_path / "a.svg"
    path.write_text(svg_of(around("circle")[2]).text)
    said = subprocess.run(
        ["inkscape", "--query-all", path], check=True, timeout=60, capture_output=True
    ).stdout.decode()
    boxes = {
        name: list(map(float, rest.split(","))) for name, rest in re.findall(r"^(.+?),(.*)$", said, re.M)
    }
    x, y, width, height = next(box for name, box in boxes.items() if "Around" in name)
    # From the right of the circle on downwards, upside down: there it begins, and runs clockwise.
    scale = 96 / 25.4
    assert x > (100 + 40) * scale
    assert (y, y + height) == (
        pytest.approx(90 * scale, abs=12 * scale),
        pytest.approx(135 * scale, abs=12 * scale),
    )
    assert width > 0
