"""Lines that Inkscape edits as lines: told so where their height says all, and laid out by it as here."""

from __future__ import annotations

import re
import shutil
import subprocess
import xml.etree.ElementTree as ET

import pytest

from app.exchange.svg.names import SODIPODI_SPACE
from app.exchange.svg.reader import read_svg
from app.exchange.svg.writer import svg_of
from app.qt.contents import measured

SVG = '<svg xmlns="http://www.w3.org/2000/svg" width="800" height="400" viewBox="0 0 800 400">%s</svg>'
FONT = 'font-family="\'DejaVu Sans\'" font-size="20"'
EVEN = (
    f'<text {FONT}><tspan x="100" y="50">one two</tspan><tspan x="100" y="73.28125">three '
    '<tspan font-weight="700">bold</tspan></tspan>'
    '<tspan x="100" y="119.84375">below an empty one</tspan></text>'
)
CENTRED = (
    f'<text {FONT} text-anchor="middle"><tspan x="400" y="200">one two</tspan>'
    '<tspan x="400" y="230">three</tspan></text>'
)
ALONE = f'<text {FONT} x="10" y="300">alone</text>'
UNEVEN = (
    f'<text {FONT}><tspan x="500" y="50">one</tspan><tspan x="500" y="73" font-size="30">large</tspan></text>'
    f'<text {FONT}><tspan x="500" y="150">one</tspan><tspan x="510" y="173">further right</tspan></text>'
    f'<text {FONT}><tspan x="500" y="250">one</tspan><tspan x="500" y="273">two</tspan>'
    '<tspan x="500" y="300">three</tspan></text>'
)
ROLE = f"{{{SODIPODI_SPACE}}}role"


@pytest.fixture(scope="module")
def drawing(qapp):
    return measured(read_svg((SVG % (EVEN + CENTRED + ALONE + UNEVEN)).encode()).document)


def roles_in(text):
    """The places of the spans of each text that are lines of Inkscape's, downwards."""
    found = [each for each in ET.fromstring(text).iter() if each.tag.endswith("}text")]
    return [[float(span.get("y")) for span in each.iter() if span.get(ROLE) == "line"] for each in found]


def heights_in(text):
    return [float(each) for each in re.findall(r"line-height:([\d.]+)", text)]


def test_lines_of_one_height_are_told_as_lines_and_others_by_their_places(drawing):
    text = svg_of(drawing).text
    assert roles_in(text) == [
        pytest.approx([50, 73.28125, 96.5625, 119.84375]), [200, 230], [300], [], [], []
    ]  # fmt: skip
    assert heights_in(text) == pytest.approx([1.1640625, 1.5, 1.25])
    back = read_svg(text.encode()).document
    assert [each.form.lines for each in back.curves] == [each.form.lines for each in drawing.curves]


@pytest.mark.skipif(shutil.which("inkscape") is None, reason="Inkscape is not installed")
def test_inkscape_lays_them_out_where_they_are(drawing, tmp_path):
    """By their heights, once it is to lay them out: the places in the file say something else."""
    path, moved = tmp_path / "ours.svg", tmp_path / "moved.svg"
    text = svg_of(drawing).text
    path.write_text(text, encoding="utf-8")
    moved.write_text(re.sub(r'(role="line" x="[^"]*" y=")[^"]*"', r'\g<1>5"', text), encoding="utf-8")
    first, second = (
        subprocess.run(
            ["inkscape", "--query-all", each], check=True, capture_output=True, timeout=60, text=True
        ).stdout.splitlines()[1:4]
        for each in (path, moved)
    )
    assert first == second
    x, y, _, high = map(float, first[0].split(",")[1:])
    heights = [point.y for point in drawing.curves[0].points]
    assert x == pytest.approx(min(point.x for point in drawing.curves[0].points), abs=0.01)
    assert (y, high) == pytest.approx((-max(heights), max(heights) - min(heights)), abs=0.01)
