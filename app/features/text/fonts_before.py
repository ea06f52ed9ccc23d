"""The fonts that are offered first: those that were chosen last, and those of a document."""

from __future__ import annotations

from typing import Final

from ...document.content import Lettering
from ...document.model import Document
from ...settings.preferences import Preferences

_MOST: Final = 5
"""Fonts that are remembered."""

_BETWEEN: Final = "\n"


def fonts_first(document: Document, preferences: Preferences) -> list[str]:
    """Return families, the one that was chosen last before all others."""
    texts = [curve.form for curve in document.curves if isinstance(curve.form, Lettering)]
    runs = [run for text in texts for line in text.lines for run in line.runs]
    own = dict.fromkeys(run.font[0] for run in runs if run.font)
    return [*filter(None, preferences.text_fonts.split(_BETWEEN)), *own]


def remember_font(preferences: Preferences, family: str) -> None:
    """Have a family offered before all others from now on."""
    others = (each for each in preferences.text_fonts.split(_BETWEEN) if each not in ("", family))
    preferences.text_fonts = _BETWEEN.join([family, *others][:_MOST])
