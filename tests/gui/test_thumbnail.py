"""Small pictures of unsaved work: what prints is to scale in them."""

from __future__ import annotations

import numpy as np
import pytest
from msgspec.structs import replace
from pixels import pixels_of

from app.appearance.theme import LIGHT
from app.document.model import Document, Page, make_curve
from app.document.style import Style
from app.families import HERMITE
from app.features.recovery.thumbnail import thumbnail


def ink(width, page):
    """Return how many pixels of ink lie above one another, of a level line in a picture of 100 pixels."""
    line = make_curve([(10.0, 50.0), (90.0, 50.0)], family=HERMITE)
    document = Document((replace(line, style=Style(stroke="#000000", width=width)),), unit="mm", page=page)
    picture = pixels_of(thumbnail(document, 100, 100, LIGHT)) & 0xFF
    paper = float(picture[2, 50])
    return float((1.0 - picture[:, 45:55] / paper).sum(axis=0).mean())


@pytest.mark.usefixtures("qapp")
def test_lines_of_a_page_are_to_scale():
    page = Page(0.0, 0.0, 100.0, 100.0)
    found = [ink(width, page) for width in (0.5, 1.0, 4.0, None, 0.0)]
    assert found == pytest.approx([0.5, 1.0, 4.0, page.usual_width, 0.0], abs=0.08)


@pytest.mark.usefixtures("qapp")
def test_points_are_shown_where_there_is_no_page():
    line = make_curve([(10.0, 50.0), (90.0, 50.0)], family=HERMITE)
    line = replace(line, style=Style(stroke="#d00000", width=0.5))
    heights = []
    for page in (None, Page(0.0, 0.0, 100.0, 100.0)):
        picture = pixels_of(thumbnail(Document((line,), page=page), 100, 100, LIGHT))
        heights.append(np.ptp(np.flatnonzero((picture != picture[2, 50]).any(axis=1))) + 1)
    assert heights[0] >= 4 > heights[1]
