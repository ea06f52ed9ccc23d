"""Small pictures of unsaved work: what has a width is to scale in them."""

from __future__ import annotations

import numpy as np
import pytest
from msgspec.structs import replace
from pixels import pixels_of

from app.appearance.theme import LIGHT
from app.document.model import Document, make_curve
from app.document.style import Style
from app.families import HERMITE
from app.features.recovery.bar import thumbnail


@pytest.mark.usefixtures("qapp")
def test_a_thumbnail_shows_points():
    line = make_curve([(10.0, 50.0), (90.0, 50.0)], family=HERMITE)
    line = replace(line, style=Style(stroke="#d00000", width=0.5))
    picture = pixels_of(thumbnail(Document((line,)), 100, 100, LIGHT))
    assert np.ptp(np.flatnonzero((picture != picture[2, 50]).any(axis=1))) + 1 >= 4
