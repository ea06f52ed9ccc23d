"""A letter traced with real events: few points, and everything needed to see them on the ink."""

from __future__ import annotations

import math

import numpy as np
import pytest
from PySide6.QtCore import QPointF, QRect, Qt
from PySide6.QtGui import QColor, QImage, QPainter, QPen

from app.appearance.theme import theme_of
from app.families import QUINTIC_HERMITE
from app.features.reference_image.commands import ImageCommands

ALT = Qt.KeyboardModifier.AltModifier
SIZE, EDGE = 400, 150.0
"""A letter of ink on a white page: an O that is squarer than an ellipse."""


def radius(angle):
    """The outline of the O in pixels of the picture: |x|³ + |y|³ = r³."""
    return EDGE * (abs(math.cos(angle)) ** 3 + abs(math.sin(angle)) ** 3) ** (-1 / 3)


@pytest.fixture
def traced(editor, tmp_path):
    image = QImage(SIZE, SIZE, QImage.Format.Format_RGB32)
    image.fill(QColor("white"))
    painter = QPainter(image)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    painter.setPen(QPen(QColor("black"), 3))
    painter.setBrush(QColor("black"))
    angles = np.linspace(0, 2 * np.pi, 400)
    painter.drawPolygon(
        [QPointF(200 + radius(a) * math.cos(a), 200 - radius(a) * math.sin(a)) for a in angles]
    )
    painter.end()
    image.save(str(tmp_path / "O.png"))
    editor.new()
    editor.window.commands[ImageCommands].trace(tmp_path / "O.png")
    editor.choose_family(QUINTIC_HERMITE)
    return editor


def on_outline(editor, angle):
    """The place in the plane where the ink ends in a direction."""
    image = editor.session.document.image
    unit, r = image.width / SIZE, radius(angle)
    middle = (image.x + image.width / 2, image.y + image.height / 2)
    return (middle[0] + unit * r * math.cos(angle), middle[1] + unit * r * math.sin(angle))


def on_curve(editor, angle):
    image = editor.session.document.image
    line = editor.session.active_view.flattened(0.1 * editor.pixel).points
    away = line - (image.x + image.width / 2, image.y + image.height / 2)
    turned = np.angle(np.exp(1j * (np.arctan2(away[:, 1], away[:, 0]) - angle)))
    return tuple(line[np.argmin(np.abs(turned))].tolist())


def worst(editor):
    """The largest distance between curve and ink, in pixels of the canvas."""
    angles = np.linspace(0, 2 * math.pi, 48, endpoint=False)
    return max(math.dist(on_curve(editor, a), on_outline(editor, a)) for a in angles) / editor.pixel


def test_four_points_and_four_bends_trace_an_o(traced):
    for quarter in range(4):
        traced.add_point(*on_outline(traced, quarter * math.pi / 2))
    traced.trigger("closeCurve")
    traced.select([])
    before = worst(traced)
    assert before > 8
    for quarter in range(4):
        angle = (quarter + 0.5) * math.pi / 2
        traced.drag(on_curve(traced, angle), on_outline(traced, angle), keys=ALT)
    assert worst(traced) < 0.4 * before
    assert traced.session.undo_stack.undoText().startswith("Bend curve at t = 0.")


@pytest.mark.parametrize("theme", ["themeLight", "themeDark"])
def test_handles_and_numbers_have_contrast_on_the_ink(traced, theme):
    traced.trigger(theme)
    middle = (2.0, 2.0)
    traced.add_point(middle[0] - 0.6, middle[1], (middle[0] - 0.3, middle[1]))
    traced.add_point(middle[0] + 0.6, middle[1], (middle[0] + 0.9, middle[1]))
    traced.select([0])
    canvas = traced.window.canvas
    handle = canvas.to_pixel(*traced.handle(1).position)
    traced.settle()
    origin = canvas.viewport().mapTo(traced.window, handle)
    shot = traced.window.grab(QRect(origin.x() + 1, origin.y() + 3, 1, 27)).toImage()
    column = [shot.pixelColor(0, y).lightness() for y in range(27)]
    mark, ink = column[0], column[-1]
    paper = theme_of(traced.window.palette()).paper.lightness()
    assert 100 < ink < 160
    assert abs(mark - ink) > 60
    # Paper lies around the mark, and ink around the paper.
    assert min(abs(each - paper) for each in column[:10]) < 10
