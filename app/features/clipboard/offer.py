"""Offers on the clipboard: our own format, and what other programs take, made when one asks for it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from PySide6.QtCore import QByteArray, QMimeData, QMetaType
from PySide6.QtGui import QImage

from ... import exchange
from ...document.model import Document
from ...exchange.errors import ExchangeError
from ...exchange.options import Options
from ...qt.overrides import Guarded
from ...storage.format import encode

CURVES = "application/x-curvebench-curves"
"""MIME type of whole curves: a document of them."""

POINTS = "application/x-curvebench-points"
"""MIME type of points: a document of one curve that has these points only."""

SVG_TYPES = ("image/x-inkscape-svg", "image/svg+xml")
"""MIME types of SVG, the one that is taken first in front."""

_PNG, _TEXT, _IMAGE = "image/png", "text/plain", "application/x-qt-image"
_WIDTH = 1600


class Offer(Guarded, QMimeData):
    """Curves, or points of one, for this program and for others.

    Drawing them takes a moment, and most of what is copied is pasted here.

    Parameters
    ----------
    own
        The MIME type of what this program takes.
    document
        The curves.
    text
        For programs that take text; by default the SVG.
    """

    def __init__(self, own: str, document: Document, text: str = "") -> None:
        super().__init__()
        self._own, self._document, self._text = own, document, text
        self._made: dict[str, Any] = {}
        self._can_draw = any(len(curve.points) > 1 for curve in document.curves)

    def formats(self) -> list[str]:
        """Return the MIME types; called by Qt."""
        drawn = [*SVG_TYPES, _PNG, _IMAGE] if self._can_draw else []
        return [self._own, *drawn, *([_TEXT] if self._text or self._can_draw else [])]

    def hasFormat(self, mimetype: str) -> bool:
        """Whether something is offered as this; called by Qt."""
        return mimetype in self.formats()

    def retrieveData(self, mimetype: str, _type: QMetaType) -> Any:
        """Return what is offered; called by Qt."""
        if mimetype not in self.formats():
            return None
        if mimetype not in self._made:
            self._made[mimetype] = self._make(mimetype)
        return self._made[mimetype]

    def _make(self, mimetype: str) -> Any:
        ...
