"""Coordinates as they are told: exact decimals, there and back, and nothing of it where there is no page."""

from __future__ import annotations

import re
from pathlib import Path


def test_words_of_places_and_angles_come_from_readings_alone():
    """Who writes two coordinates or an angle of the plane at once asks its readings: see CONTRIBUTING."""
    app = Path(__file__).parents[2] / "app"
    plain = re.compile(r"words\.(pair|angle)\(|from .*words import .*\b(pair|angle)\b")
    found = {
        str(path.relative_to(app)) for path in app.rglob("*.py") if plain.search(path.read_text("utf-8"))
    }
    assert found == {"document/readings.py"}
