"""Another program shows our SVG as we show our PNG."""

import shutil
import subprocess

import numpy as np
import pytest
from msgspec.structs import replace
from PySide6.QtGui import QImage

from app.document.marker import MarkerKind
from app.document.model import Document, make_curve
from app.document.style import Style
from app.exchange.drawing.styles import LIGHT
from app.exchange.options import Options
from app.exchange.writing import export
from app.families import HERMITE

WIDTH = 500

pytestmark = [
    pytest.mark.usefixtures("qapp"),
    pytest.mark.skipif(shutil.which("rsvg-convert") is None, reason="librsvg is not installed"),
]


def ink(path):
    """Where a picture is darker than halfway between its lightest ink and its paper, (height, width)."""
    image = QImage(str(path)).convertToFormat(QImage.Format.Format_Grayscale8)
    rows = np.frombuffer(bytes(image.constBits()), np.uint8).reshape(image.height(), image.bytesPerLine())
    return rows[:, : image.width()] < 175


def widened(mask):
    """The pixels of a mask and all that touch them."""
    padded = np.pad(mask, 1)
    height, width = mask.shape
    return np.any([padded[i : i + height, j : j + width] for i in range(3) for j in range(3)], axis=0)


def test_librsvg_draws_the_same_within_one_pixel(kind, tmp_path):
    assert_drawn_the_same(kind, tmp_path)


@pytest.mark.parametrize("kind", [kind for kind in MarkerKind if kind is not MarkerKind.NONE])
def test_librsvg_draws_the_same_markers(kind, tmp_path):
    """Of a level, a slanted and a curved line; where they are seen through, nothing is seen twice."""
    style = Style(stroke="#000000", width=0.3, start_marker=kind, end_marker=kind)
    lines = ([(0, 0), (6, 0)], [(8, 0), (13, 2)], [(16, 0), (18, 2.5), (21, 0)])
    curves = [replace(make_curve(line, family=HERMITE), style=style) for line in lines]
    pale = replace(style, width=0.6, opacity=0.55)
    curves.append(replace(make_curve([(2, 6), (14, 5)], family=HERMITE), style=pale))
    drawn = assert_drawn_the_same(Document(tuple(curves)), tmp_path)
    plain = assert_drawn_the_same(
        Document(
            tuple(replace(each, style=replace(each.style, start_marker=MarkerKind.NONE)) for each in curves)
        ),
        tmp_path,
    )
    assert drawn.sum() > plain.sum() * 1.02


def assert_drawn_the_same(kind, tmp_path):
    """Check a picture of a document, or of a curve, against that which librsvg makes; return where it is."""
    ours, svg, theirs = (tmp_path / name for name in ("ours.png", "a.svg", "theirs.png"))
    export(kind, ours, Options(width=WIDTH, style=LIGHT, points=True))
    export(kind, svg, Options(width=WIDTH, style=LIGHT, points=True))
    subprocess.run(
        ["rsvg-convert", "--width", str(WIDTH), "-o", str(theirs), str(svg)], check=True, timeout=60
    )
    one, other = ink(ours), ink(theirs)
    height, width = np.minimum(one.shape, other.shape)
    one, other = one[:height, :width], other[:height, :width]
    assert one.sum() > 500
    assert not (one & ~widened(other)).any()
    assert not (other & ~widened(one)).any()
    return one
