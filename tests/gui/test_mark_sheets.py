"""Sheets of marks: a mark that is on a sheet is not drawn again."""

from __future__ import annotations

import numpy as np
import pytest
from PySide6.QtCore import QPointF
from PySide6.QtGui import QImage, QPainter

from app.appearance.theme import DARK, LIGHT
from app.plotting.stamps import Stamps

WITHIN_A_PIXEL = 16


class Marks:
    """Stamps of discs and squares, and how many of them were drawn."""

    def __init__(self):
        self.drawn = 0
        self._stamps = Stamps(self._draw)

    def _draw(self, painter, radius, form):
        self.drawn += 1
        if form:
            painter.drawRect(-radius, -radius, 2 * radius, 2 * radius)
        else:
            painter.drawEllipse(QPointF(0, 0), radius, radius)

    def picture(self, count, *, theme=LIGHT, forms=None):
        """Return marks in a row, each at another place within its pixel."""
        image = QImage(12 * count + 20, 30, QImage.Format.Format_ARGB32_Premultiplied)
        image.fill(theme.paper)
        places = np.column_stack([10 + 12.3 * np.arange(count), 15 + 0.2 * np.arange(count)])
        forms = None if forms is None else np.array(forms)
        with QPainter(image) as painter:
            self._stamps.draw(painter, places, np.arange(count), count, theme, 5.0, 1.0, forms)
        return image


@pytest.fixture(autouse=True)
def pictures(qapp):
    """An application, without which there are no pictures."""


def test_an_added_point_adds_one_mark():
    marks = Marks()
    marks.picture(5)
    assert marks.drawn == 5 * WITHIN_A_PIXEL
    marks.picture(6)
    marks.picture(5)
    assert marks.drawn == 6 * WITHIN_A_PIXEL


def test_another_form_and_another_theme_are_drawn():
    marks = Marks()
    marks.picture(3, forms=[0, 0, 0])
    marks.picture(3, forms=[0, 1, 0])
    assert marks.drawn == 4 * WITHIN_A_PIXEL
    marks.picture(3, theme=DARK, forms=[0, 1, 0])
    assert marks.drawn == 7 * WITHIN_A_PIXEL


@pytest.mark.parametrize("counts", [(5, 6, 5), (3, 12, 7, 40, 3), (60, 61, 70, 9), (300, 20), (2, 300)])
def test_an_enlarged_sheet_shows_the_same_as_a_new_sheet(counts):
    marks = Marks()
    for count in counts:
        forms = np.arange(count) % 2
        assert marks.picture(count, forms=forms) == Marks().picture(count, forms=forms)
