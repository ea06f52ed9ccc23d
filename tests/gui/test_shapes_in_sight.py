"""Shapes all of which are seen: one path is filled and stroked, and looks as if it had been cut."""

from __future__ import annotations

import numpy as np
import pytest
from PySide6.QtGui import QColor, QImage, QPainter

from app.document.model import Document, make_curve
from app.document.style import LineCap, LineJoin, Style
from app.families import HERMITE
from app.plotting import printed
from app.plotting.pixel_map import PixelMap
from app.plotting.printed import Ink, Part, paint_printed
from app.storage import files
from tests.effort import calls_of, noted_calls

COUNT = 450
SHOWN = PixelMap(0.0, 100.0, 2.0, 2.0, 200.0, 200.0)


def blob(x: float, y: float, radius: float) -> np.ndarray:
    angles = np.linspace(0.0, 2 * np.pi, 40)
    radii = radius * (1 + 0.3 * np.cos(3 * angles))
    return np.column_stack([x + radii * np.cos(angles), y + radii * np.sin(angles)])


def painted(parts: list[Part], style: Style) -> QImage:
    image = QImage(200, 200, QImage.Format.Format_ARGB32_Premultiplied)
    image.fill(0)
    with QPainter(image) as painter:
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        ink = Ink(QColor("#aa0000"), QColor("#336699"), style.width * SHOWN.sx, QColor("black"))
        paint_printed(painter, parts, style, ink, SHOWN)
    return image


@pytest.mark.parametrize("join", list(LineJoin))
@pytest.mark.parametrize("is_closed", [True, False], ids=["closed", "open"])
def test_a_shape_that_is_whole_looks_as_one_that_is_cut(monkeypatch, join, is_closed):
    style = Style(width=1.5, cap=LineCap.BUTT, join=join, fill="#336699", stroke="#aa0000")
    points = blob(50.0, 60.0, 25.0) if is_closed else blob(50.0, 60.0, 25.0)[:-7]
    parts = [Part(points, is_closed), Part(blob(50.0, 60.0, 9.0)[::-1], True)]
    cuts = noted_calls(monkeypatch, printed, "cut_segments")
    whole = painted(parts, style)
    assert not cuts
    monkeypatch.setattr(printed, "_whole_path", lambda _parts, _shown: None)
    assert whole == painted(parts, style)
    assert cuts


def test_what_leaves_the_area_is_still_cut(monkeypatch):
    """The area is 200 pixels wide, and what is passed to Qt reaches 50 beyond it."""
    style = Style(width=1.5, cap=LineCap.BUTT, join=LineJoin.MITER, fill="#336699", stroke="#aa0000")
    cuts = noted_calls(monkeypatch, printed, "cut_segments")
    painted([Part(blob(95.0, 50.0, 20.0), True)], style)
    assert not cuts
    painted([Part(blob(120.0, 50.0, 20.0), True)], style)
    assert len(cuts) == 1


def test_a_shape_in_sight_takes_few_calls():
    """Of 2,000 shapes each was cut for its fill and again for its line: 194 calls, and a zoom took 0.4 s."""
    style = Style(width=0.3, cap=LineCap.BUTT, join=LineJoin.MITER, fill="#336699", stroke="#aa0000")
    parts = [Part(blob(50.0, 60.0, 25.0), True)]
    painted(parts, style)
    assert calls_of(lambda: painted(parts, style)) < 120


def test_what_was_seen_of_many_curves_is_seen_until_they_are_painted_anew(editor, tmp_path):
    """After every zoom the drawing vanished, and came back 200 shapes at a time."""
    canvas = editor.window.canvas
    layer = canvas.drawing.others

    def picture() -> QImage:
        image = QImage(canvas.size(), QImage.Format.Format_ARGB32_Premultiplied)
        image.fill(0)
        with QPainter(image) as painter:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            layer.paint(painter, canvas.pixel_map)
        return image

    def ink(image: QImage) -> int:
        return int((np.frombuffer(image.constBits(), np.uint32) != 0).sum())

    path = tmp_path / "many.curve.json"
    places = [(k % 40, k // 40) for k in range(COUNT)]
    rows = [[(x, y), (x + 0.4, y + 0.7), (x + 0.8, y)] for x, y in places]
    files.save(path, Document(tuple(make_curve(row, family=HERMITE) for row in rows)))
    editor.session.open(path)
    canvas.camera.show_box((-1, 41), (-1, 26))
    steps = [picture() for _ in range(4)]
    assert layer._painted == COUNT - 1
    assert ink(steps[0]) < 0.6 * ink(steps[3]), "there was nothing before"
    canvas.camera.show_box((-1.2, 41.2), (-1.2, 26.2))
    layer._is_resting = True
    zoomed = [picture() for _ in range(4)]
    # 0.44 of it in the first step.
    assert min(map(ink, zoomed)) > 0.9 * ink(steps[3])
    layer._picture = None
    assert [picture() for _ in range(4)][3] == zoomed[3] != zoomed[0]
