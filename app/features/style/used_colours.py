"""Colours that a person may want again: those used last, and those of the document."""

from __future__ import annotations

import re

from ...document.model import Curve
from ...document.style_edits import colours_of
from ...session.session import Session
from ...settings.preferences import Preferences

_MOST_REMEMBERED = 12


class UsedColours:
    """Colours that were used."""

    def __init__(self, session: Session, preferences: Preferences) -> None:
        self._session, self._preferences = session, preferences
        self._found: tuple[tuple[Curve, ...], list[str]] = ((), [])

    @property
    def recent(self) -> list[str]:
        """Those that were used last."""
        return re.findall("#[0-9a-f]{6}", self._preferences.recent_colours)

    @property
    def in_document(self) -> list[str]:
        """Those of the document, found anew for another step of its history."""
        curves = self._session.committed.curves
        if self._found[0] is not curves:
            self._found = curves, colours_of(curves)
        return self._found[1]

    def remember(self, *paints: object) -> None:
        """Have the colours among some paints in front of those used last."""
        codes = [code for code in paints if isinstance(code, str) and code.startswith("#")]
        if codes:
            found = list(dict.fromkeys([*codes, *self.recent]))[:_MOST_REMEMBERED]
            self._preferences.recent_colours = " ".join(found)
