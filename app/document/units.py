"""Units of length: how large one is on paper, and what people call it."""

from __future__ import annotations

from typing import Final

MILLIMETRES: Final = {
    "µm": 1e-3,
    "mm": 1.0,
    "cm": 10.0,
    "m": 1e3,
    "km": 1e6,
    "in": 25.4,
    "ft": 304.8,
    "pt": 25.4 / 72,
    "pc": 25.4 / 6,
    "px": 25.4 / 96,
}
"""Millimetres of each unit that a picture can be drawn in at true size; px is CSS's."""

_OTHER_NAMES: Final = {"um": "µm", "μm": "µm", "inch": "in", "inches": "in", '"': "in", "″": "in", "′": "ft"}


def known_unit(name: str) -> str:
    """Return the key of `MILLIMETRES` that a name means; empty where it is none, such as "s"."""
    word = name.strip()
    word = _OTHER_NAMES.get(word.lower(), word)
    return next((each for each in (word, word.lower()) if each in MILLIMETRES), "")
