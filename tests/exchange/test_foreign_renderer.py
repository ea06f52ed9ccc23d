"""Another program shows our SVG as we show our PNG."""

import shutil
import subprocess

import numpy as np
import pytest
from PySide6.QtGui import QImage

from app.exchange.drawing.styles import LIGHT
from app.exchange.files import export
from app.exchange.options import Options

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


def assert_drawn_the_same(kind, tmp_path):
    """Check a picture of a document, or of a curve, against that which librsvg makes; return where it is."""
    ours, svg, theirs = (tmp_path / name for name in ("ours.png", "a.svg", "theirs.png"))
    export(kind, ours, Options(width=WIDTH, style=LIGHT, points=True))
    export(kind, svg, Options(width=WIDTH, style=LIGHT, points=True))
    subprocess.run(["rsvg-convert", "--width", str(WIDTH), "-o", str(theirs), str(svg)], check=True)
    one, other = ink(ours), ink(theirs)
    height, width = np.minimum(one.shape, other.shape)
    one, other = one[:height, :width], other[:height, :width]
    assert one.sum() > 500
    assert not (one & ~widened(other)).any()
    assert not (other & ~widened(one)).any()
    return one
