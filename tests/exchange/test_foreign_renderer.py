"""Another program shows our SVG as we show our PNG."""

import shutil
import subprocess

import numpy as np
import pytest
from msgspec.structs import replace
from PySide6.QtGui import QImage

from app.document.clip import Clip, ring_of
from app.document.clones import add_clones, settled
from app.document.gradient import Gradient, GradientKind, Stop
from app.document.model import Document, make_curve
from app.document.several_curves import mapped, scaled_strokes, whole_curves
from app.document.style import NO_PAINT, Style
from app.document.transforms import rotation, scaling
from app.exchange.drawing.styles import LIGHT
from app.exchange.options import Options
from app.exchange.svg.writer import svg_of
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


def test_librsvg_draws_clones_where_and_as_they_are(tmp_path):
    """With all that is enlarged along: dashes, gradients and clips."""
    place = {"start": (0.0, 0.0), "end": (4.0, 0.0), "side": (0.0, 4.0)}
    stops = (Stop(0.5, "#000000"), Stop(0.5, "#ffffff"))
    corners = [(0.5, -1.0), (3.0, -1.0), (3.0, 3.0), (0.5, 3.0), (0.5, -1.0)]
    ring = ring_of([corners[0], *(place for corner in corners[1:] for place in (corner,) * 3)])
    styles = [
        Style(stroke="#000000", width=0.2, dash=(3.0, 2.0)),
        Style(stroke=NO_PAINT, fill="#000000", fill_gradient=Gradient(stops, GradientKind.LINEAR, **place)),
        Style(stroke="#000000", width=0.3, fill="#888888", opacity=0.7, clips=(Clip((ring,)),)),
    ]
    leaf = make_curve([(0, 0), (3, -1), (4, 2), (1, 3)], family=HERMITE)
    rows = [replace(leaf, style=style, closed=index > 0) for index, style in enumerate(styles)]
    added = add_clones(Document(tuple(rows)), range(3), iter("abc").__next__)
    group = whole_curves(added.document, added.places)
    by = rotation(35.0, (6.0, -3.0))
    turned = mapped(added.document, group, by)
    larger = scaled_strokes(mapped(turned, group, scaling(1.5, 1.5, (9.0, 0.0))), group, 1.5, 1.5)
    document = settled(larger, added.document, added.document)
    assert svg_of(document).text.count("<use ") == 3
    assert_drawn_the_same(document, tmp_path)


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
