"""Superscripts and subscripts in SVG files: read as Inkscape has them, written so that all agree."""

from __future__ import annotations

import shutil
import subprocess

import numpy as np
import pytest
from PySide6.QtGui import QImage

from app.document.content import TextRun
from app.exchange.drawing.image import png_file
from app.exchange.drawing.styles import LIGHT
from app.exchange.options import Options
from app.exchange.svg.reader import read_svg
from app.exchange.svg.writer import svg_of
from app.features.text.raised import ABOVE, BELOW, raised

pytestmark = pytest.mark.usefixtures("qapp")

HEAD = (
    '<svg xmlns="http://www.w3.org/2000/svg" width="200" height="100" viewBox="0 0 200 100">'
    '<text x="10" y="60" font-family="DejaVu Sans" font-size="40">'
)


def read(said, more=""):
    return read_svg(f'{HEAD}I<tspan style="{said}">I</tspan>{more}</text></svg>'.encode()).document


def runs(document):
    return document.curves[0].form.lines[0].runs


@pytest.mark.parametrize(
    ("said", "up"),
    [
        ("baseline-shift:super;font-size:20px", 16.0),
        ("baseline-shift:sub;font-size:20px", -8.0),
        ("baseline-shift:40%;font-size:20px", 16.0),
        ("baseline-shift:10px;font-size:20px", 10.0),
        ("baseline-shift:super;font-size:65%", 16.0),
        ("baseline-shift:0.5em;font-size:20px", 10.0),
    ],
)
def test_letters_are_raised_by_the_size_around_them(said, up):
    """They were by their own: a superscript was too low. The numbers are measured with Inkscape 1.2.2."""
    document = read(said, "<tspan>I</tspan>")
    assert [run.raised for run in runs(document)] == [0.0, pytest.approx(up), 0.0]
    assert [run.down for run in runs(document)] == [0.0, 0.0, 0.0]
    assert runs(read_svg(svg_of(document).text.encode()).document) == runs(document)


def bottoms(path):
    """Where the ink of each column of a picture ends."""
    image = QImage(str(path)).convertToFormat(QImage.Format.Format_Grayscale8)
    rows = np.frombuffer(bytes(image.constBits()), np.uint8).reshape(image.height(), image.bytesPerLine())
    dark = rows[:, : image.width()] < 128
    return [int(np.nonzero(column)[0].max()) for column in dark.T if column.any()]


def drawn_by(program, path, out):
    to = ["-o", out, "-b", "white"] if program == "rsvg-convert" else ["-o", out, "--export-background=white"]
    subprocess.run([program, path, *to], check=True, capture_output=True, timeout=60)
    return bottoms(out)


@pytest.mark.parametrize("program", ["inkscape", "rsvg-convert"])
@pytest.mark.parametrize("share", [ABOVE, BELOW])
def test_all_programs_show_them_alike(program, share, tmp_path):
    if shutil.which(program) is None:
        pytest.skip(f"{program} is not installed")
    small = raised(TextRun("I", ("DejaVu Sans",), 40.0), share)
    assert (small.size, small.raised) == (26.0, pytest.approx(40 * share))
    document = read(f"baseline-shift:{small.raised}px;font-size:{small.size}px", "<tspan>I</tspan>")
    (tmp_path / "a.svg").write_text(svg_of(document, Options(width=200)).text)
    (tmp_path / "c.png").write_bytes(png_file(document, Options(width=200, style=LIGHT.on_page())).data)
    ours, theirs = bottoms(tmp_path / "c.png"), drawn_by(program, tmp_path / "a.svg", tmp_path / "b.png")
    assert sorted(set(ours)) == pytest.approx(sorted(set(theirs)), abs=1)
    assert max(ours) - min(ours) == pytest.approx(abs(40 * share), abs=1)


def test_once_more_they_are_on_the_line_and_as_large_as_before():
    run = TextRun("2", ("DejaVu Sans",), 40.0, spacing=2.0)
    for share in (ABOVE, BELOW):
        there = raised(run, share)
        assert raised(there, BELOW if share > 0 else ABOVE).size == pytest.approx(26.0)
        back = raised(there, 0.0)
        assert (back.size, back.spacing, back.raised) == (pytest.approx(40.0), pytest.approx(2.0), 0.0)
    # Those of others are as large as they are.
    assert raised(TextRun("2", size=40.0, raised=3.0), 0.0).size == 40.0
