"""Words that do not fit into a frame: not shown, as in Inkscape, kept and told."""

from __future__ import annotations

import shutil
import subprocess
import xml.etree.ElementTree as ET

import numpy as np
import pytest
from PySide6.QtGui import QImage

from app.document.contents import corners_of
from app.document.wrapping import laid_out, lines_of, words_about_room, words_without_room
from app.exchange.svg.reader import read_svg
from app.exchange.svg.writer import svg_of
from app.qt.contents import clusters_in, letters_of

pytestmark = pytest.mark.usefixtures("qapp")

WORDS = "One two three four five six seven eight nine ten eleven twelve thirteen"


def drawing(height, size=16, line=1.25, words=WORDS):
    return (
        '<svg xmlns="http://www.w3.org/2000/svg" width="400" height="400" viewBox="0 0 400 400"><defs>'
        f'<rect id="r" x="10" y="10" width="100" height="{height}"/></defs><text id="t" xml:space="preserve" '
        f"style=\"font-family:'DejaVu Sans';font-size:{size}px;line-height:{line};shape-inside:url(#r);"
        f'white-space:pre">{words}</text></svg>'
    )


def read(text):
    (curve,) = read_svg(text.encode()).document.curves
    return curve


def shown_by_inkscape(text, folder):
    """The lines that Inkscape gives places of their own; what it does not show it puts into one more."""
    (folder / "a.svg").write_text(text)
    command = ["inkscape", folder / "a.svg", "--export-plain-svg", "-o", folder / "b.svg"]
    subprocess.run(command, check=True, capture_output=True, timeout=60)
    (element,) = (each for each in ET.parse(folder / "b.svg").iter() if each.tag.endswith("text"))
    return ["".join(row.itertext()) for row in element if not any(child.get("dx") for child in row)]


@pytest.mark.skipif(shutil.which("inkscape") is None, reason="Inkscape is not installed")
@pytest.mark.parametrize(
    ("height", "size", "line"),
    [
        (70, 16, 1.25),
        (77.5, 16, 1.25),
        (78.5, 16, 1.25),
        (124, 16, 2),
        (126.5, 16, 2),
        (75, 32, 1.25),
        (28, 8, 1.25),
    ],
)
def test_as_many_lines_are_shown_as_in_inkscape(height, size, line, tmp_path):
    """All were."""
    text = drawing(height, size, line)
    shown = [each.words for each in lines_of(read(text).form)]
    assert shown == shown_by_inkscape(text, tmp_path)
    assert 0 < len(shown) < len(laid_out(read(text).form).lines)


def test_they_are_counted_and_kept_and_outlines_have_none_of_them():
    curve = read(drawing(70))
    assert words_without_room(curve.form) == 7
    assert words_about_room(curve.form) == "7 words do not fit into the frame."
    letters = "".join(glyph.letters for glyph, _ in letters_of(curve.form, corners_of(curve), curve.style))
    assert letters == "Onetwothreefourfivesix"
    assert " ".join(run.words for run, *_ in clusters_in(curve.form)).split() == WORDS.split()[:6]
    document = read_svg(drawing(70).encode()).document
    (again,) = read_svg(svg_of(document).text.encode()).document.curves
    assert again.form.words == WORDS


def test_one_word_is_one_and_blanks_are_none():
    assert words_about_room(read(drawing(70, words="One two three four five six seven")).form).startswith(
        "1 word does"
    )
    assert words_about_room(read(drawing(70, words="One two three four five six \n\n")).form) == ""
    assert not laid_out(read(drawing(70, words="One two three four five six\n\n")).form).is_overset


def last_row(program, text, folder):
    """How far down a picture of a drawing of 400 there is ink."""
    (folder / "a.svg").write_text(text)
    background = ["-b", "white"] if program == "rsvg-convert" else ["--export-background=white"]
    command = [program, folder / "a.svg", "-o", folder / "a.png", *background]
    subprocess.run(command, check=True, capture_output=True, timeout=60)
    image = QImage(str(folder / "a.png")).convertToFormat(QImage.Format.Format_Grayscale8)
    rows = np.frombuffer(bytes(image.constBits()), np.uint8).reshape(image.height(), -1)
    return np.nonzero((rows[:, : image.width()] < 128).any(axis=1))[0].max() * 400 / image.height()


@pytest.mark.parametrize("program", ["inkscape", "rsvg-convert"])
def test_programs_show_of_what_is_written_what_has_room(program, tmp_path):
    """Those who wrap no words, as browsers, showed all, down to 169."""
    if shutil.which(program) is None:
        pytest.skip(f"{program} is not installed")
    document = read_svg(drawing(70).encode()).document
    written = svg_of(document).text
    # The third line, “five six”, has nothing below its baseline.
    assert last_row(program, written, tmp_path) == pytest.approx(64.2, abs=1)
    if program == "inkscape":
        # Given more room it shows all.
        more = written.replace('height="70"', 'height="300"')
        assert last_row(program, more, tmp_path) == pytest.approx(164.2, abs=1)
    again = read_svg(written.encode()).document
    assert again.curves[0].form.lines == document.curves[0].form.lines
