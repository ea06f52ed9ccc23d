"""What the canvas shows, and what a picture of it holds: the same colours at the same places."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from msgspec.structs import replace
from PySide6.QtGui import QImage

from app.appearance.theme import LIGHT
from app.document.model import Document, Parametrization, ParametrizationKind, make_curve
from app.document.style import FillRule, LineCap, LineJoin, Style
from app.exchange import png_file
from app.exchange.drawing.drawing import drawing_of
from app.exchange.drawing.styles import LIGHT as LIGHT_PAPER
from app.exchange.options import Options
from app.families import HERMITE

STYLES = {
    "plain fill": Style(stroke="none", fill="#0072b2"),
    "wide line": Style(stroke="#d55e00", width=0.4),
    "square ends": Style(stroke="#d55e00", width=0.4, cap=LineCap.SQUARE, join=LineJoin.BEVEL),
    "blunt ends": Style(stroke="#d55e00", width=0.4, cap=LineCap.BUTT, join=LineJoin.MITER, miter_limit=20.0),
    "dashes": Style(stroke="#d55e00", width=0.3, cap=LineCap.BUTT, dash=(2.0, 1.0)),
    "dots": Style(stroke="#d55e00", width=0.3, dash=(0.0, 2.0), dash_offset=0.5),
    "both": Style(stroke="#d55e00", width=0.3, fill="#f0e442"),
    "apart": Style(stroke="#d55e00", width=0.5, fill="#0072b2", stroke_opacity=0.5, fill_opacity=0.7),
    "even-odd": Style(stroke="none", fill="#009e73", fill_rule=FillRule.EVENODD),
    "nonzero": Style(stroke="none", fill="#009e73"),
    "ink": Style(fill="", width=0.1),
}

ZIGZAG = [(0, 0), (3, 1), (0.5, 2), (3, 3), (0, 4)]
STAR = [(2 * np.cos(0.8 * np.pi * k) + 6, 2 * np.sin(0.8 * np.pi * k) + 2) for k in range(5)]


def sharp(points, name, style, *, closed):
    """Straight sides with corners."""
    curve = make_curve(points, name=name, family=HERMITE)
    corners = tuple(replace(point, corner=True) for point in curve.points)
    return replace(curve, points=corners, closed=closed, style=style)


def drawing(style):
    """An open line with sharp corners, a star that crosses itself, a round line, and one that is edited."""
    round_line = make_curve([(9, 0), (11, 3), (10, 4), (9.3, 2)], name="Round", family=HERMITE)
    return Document(
        (
            make_curve([(-1.5, -1), (-1.5, 5)], name="Edited", family=HERMITE),
            sharp(ZIGZAG, "Zigzag", style, closed=False),
            sharp(STAR, "Star", style, closed=True),
            replace(round_line, style=style),
        )
    )


@cache
def picture_of(style):
    """The drawing as a picture, whichever curve is edited."""
    return QImage.fromData(png_file(drawing(style), Options(width=1200, style=LIGHT_PAPER)).data)


def uniform(image, places, reach):
    """Return the colours (k, 4) around pixels (k, 2), and whether each is the only one: no edge is near."""
    image = image.convertToFormat(QImage.Format.Format_RGBA8888)
    pixels = np.frombuffer(image.constBits(), np.uint8).reshape(image.height(), image.bytesPerLine())
    pixels = pixels[:, : 4 * image.width()].reshape(image.height(), image.width(), 4)
    near = np.arange(-reach, reach + 1)
    columns, rows = places.T[:, :, np.newaxis, np.newaxis]
    around = pixels[rows + near[:, np.newaxis], columns + near]
    colours = pixels[places[:, 1], places[:, 0]]
    return colours.astype(int), (around == colours[:, np.newaxis, np.newaxis]).all(axis=(1, 2, 3))


@pytest.mark.parametrize("active", [0, 2], ids=["resting", "edited"])
def test_canvas_and_picture_agree(editor, active):
    editor.window.context.store.change(grid=False)
    for name, style in STYLES.items():
        document = drawing(style)
        editor.session.commit(document, "Begin", active=active)
        editor.fit()
        editor.select([])
        editor.wait_for_rest()
        assert_canvas_and_picture_agree(editor, document, picture_of(style), name)


def assert_canvas_and_picture_agree(editor, document, picture, name):
    canvas = editor.window.canvas
    shot = canvas.viewport().grab().toImage()
    frame = drawing_of(document).frame
    points = np.vstack([view.points for view in editor.session.views])
    plane = np.stack(np.meshgrid(np.arange(-1.0, 11.5, 0.17), np.arange(-0.6, 4.6, 0.17)), axis=-1)
    plane = plane.reshape(-1, 2)
    # Points of the edited curve, and their numbers, are no part of the picture.
    plane = plane[np.hypot(*(plane[:, np.newaxis] - points).T).min(axis=0) >= 0.5]
    scales = picture.width() / frame.width, picture.height() / frame.height
    there = np.array([canvas.to_pixel(x, y).toTuple() for x, y in plane])
    in_picture = (plane - (frame.left, frame.top)) * (scales[0], -scales[1])
    ours, are_ours = uniform(shot, there, 2)
    theirs, are_theirs = uniform(picture, np.rint(in_picture).astype(int), 2)
    is_compared = are_ours & are_theirs
    far = is_compared & (abs(ours - theirs).max(axis=1) > 2)
    assert not far.any(), (name, plane[far], ours[far], theirs[far])
    assert is_compared.sum() > 500, name
    assert (ours[is_compared] != LIGHT.paper.getRgb()).any(axis=1).sum() > 10, name


@pytest.mark.parametrize("active", [0, 1], ids=["resting", "edited"])
def test_a_line_of_no_length_is_a_dot_as_large_as_its_caps(editor, active):
    """Qt leaves it out. Alone in a document, it fills the view like another drawing."""
    editor.window.context.store.change(grid=False)
    for cap in LineCap:
        style = Style(stroke="#d55e00", width=3.0, cap=cap)
        dot = make_curve([(6, 2), (6, 2)], name="Dot", family=HERMITE)
        still = tuple(replace(each, t=float(t), velocity=(0.0, 0.0)) for t, each in enumerate(dot.points))
        manual = Parametrization(ParametrizationKind.MANUAL)
        dot = replace(dot, points=still, parametrization=manual, style=style)
        line = make_curve([(0, 0), (0, 4)], name="Line", family=HERMITE)
        editor.session.commit(Document((line, dot)), "Begin", active=active)
        editor.fit()
        editor.select([])
        editor.wait_for_rest()
        image = editor.window.canvas.viewport().grab().toImage()
        grid = np.meshgrid(np.arange(4.2, 6.9, 0.13), np.arange(0.1, 3.9, 0.13))
        plane = np.stack(grid, axis=-1).reshape(-1, 2)
        # The points of the edited curve lie in the middle.
        plane = plane[abs(plane - (6, 2)).max(axis=1) > 0.5]
        away = abs(plane - (6, 2)) / 1.5
        size = {"round": np.hypot(*away.T), "square": away.max(axis=1), "butt": np.full(len(away), np.inf)}
        pixels = [editor.window.canvas.to_pixel(*place) for place in plane.tolist()]
        painted = np.array([image.pixelColor(pixel).name() == "#d55e00" for pixel in pixels])
        is_sure = abs(size[cap.value] - 1) > 0.05
        assert (painted == (size[cap.value] < 1))[is_sure].all(), cap
        editor.session.commit(Document((dot,)), "Alone", active=0)
        editor.fit()
        box = editor.window.canvas.camera.pixel_map.box
        side = max(box[2] - box[0], box[3] - box[1])
        assert side < 10 if cap is LineCap.BUTT else 3 < side < 10
