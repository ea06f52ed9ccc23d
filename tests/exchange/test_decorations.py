"""Lines under and through letters: read, drawn where Inkscape has them, written, and taken away in place."""

from __future__ import annotations

import numpy as np
import pytest

from app.document.contents import corners_of
from app.exchange.svg.reader import read_svg
from app.exchange.svg.writer import svg_of
from app.qt.contents import letters_of, measured, painted_letters

SVG = '<svg xmlns="http://www.w3.org/2000/svg" width="1200" height="400" viewBox="0 0 1200 400">%s</svg>'
BOTH = (
    '<text id="both" x="50" y="150" style="font-family:\'DejaVu Sans\';font-size:100px;'
    'text-decoration:underline line-through">AH <tspan style="font-size:50px;text-decoration:none">small'
    "</tspan> e  </text>"
)
ONE = (
    '<text id="one" x="50" y="300" font-size="40">A<tspan text-decoration-line="underline">H</tspan>e</text>'
)

UNDER, THROUGH = (1.953, 6.348), (-33.138, -28.743)
"""Where Inkscape 1.2.2 draws them for DejaVu Sans of size 100, from the baseline down."""


@pytest.fixture
def drawing(qapp):
    return measured(read_svg((SVG % (BOTH + ONE)).encode()).document)


def lines_in(document, place):
    return [
        (run.words.strip(), run.underline, run.strike)
        for line in document.curves[place].form.lines
        for run in line.runs
    ]


def test_they_are_read_and_what_is_within_takes_none_away(drawing):
    assert lines_in(drawing, 0) == [("AH", True, True), ("small", True, True), ("e", True, True)]
    assert lines_in(drawing, 1) == [("A", False, False), ("H", True, False), ("e", False, False)]
    back = read_svg(svg_of(drawing).text.encode()).document
    assert [lines_in(back, at) for at in (0, 1)] == [lines_in(drawing, at) for at in (0, 1)]


def test_they_are_drawn_and_made_outlines_where_inkscape_has_them(drawing):
    curve = drawing.curves[0]
    boxes = [path.boundingRect() for _, path in painted_letters(curve.form.lines)]
    under, through = boxes[:2]
    assert (under.top() - 150, under.bottom() - 150) == pytest.approx(UNDER, abs=0.01)
    assert (through.top() - 150, through.bottom() - 150) == pytest.approx(THROUGH, abs=0.01)
    # In the size of the letters, one after the other, and not under the blanks at the end.
    bars = [each for each in boxes if each.top() == pytest.approx(150 + UNDER[0] * each.height() / 4.395)]
    assert [bar.height() for bar in bars] == pytest.approx([4.395, 2.197, 4.395], abs=0.01)
    assert [bar.left() for bar in bars[1:]] == pytest.approx([bar.right() for bar in bars[:-1]])
    assert bars[-1].right() == pytest.approx(boxes[-1].right(), abs=8)
    outlines = [(glyph, style) for glyph, style in letters_of(curve.form, corners_of(curve), curve.style)]
    assert [glyph.letters for glyph, _ in outlines[:4]] == ["underline", "strike", "A", "H"]
    (contour,) = outlines[0][0].contours
    corners = np.array([under.left(), -under.bottom(), under.right(), -under.top()])
    assert contour.reshape(-1, 2).min(axis=0) == pytest.approx(corners[:2])
    assert contour.reshape(-1, 2).max(axis=0) == pytest.approx(corners[2:])
