"""Content for the clipboard: our own format, and those of other programs, made when one asks for it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from PySide6.QtCore import QByteArray, QMetaType, QMimeData
from PySide6.QtGui import QImage

from ... import exchange
from ...document.groups import tidy_shapes
from ...document.model import Document
from ...exchange.errors import ExchangeError
from ...qt.overrides import SafeOverrides
from ...storage.format import encode
from ...tasks.progress import silent
from ...workbench.clipboard import SVG

TEXT = "text/plain"
_PNG, _IMAGE = "image/png", "application/x-qt-image"
_WIDTH = 1600


class ClipboardContent(SafeOverrides, QMimeData):
    """Curves, or points of one, for this program and for others.

    Pictures are drawn when another program asks for them: most copies are pasted in this one.

    Parameters
    ----------
    mime_type
        MIME type of the document, for this program.
    document
        The curves.
    text
        Text for other programs; the SVG where empty.
    """

    def __init__(self, mime_type: str, document: Document, text: str = "") -> None:
        super().__init__()
        # A part of a shape is no longer a shape.
        self._mime_type, self._document, self._text = mime_type, tidy_shapes(document), text
        self._cache: dict[str, Any] = {}
        is_drawable = any(len(curve.points) > 1 for curve in document.curves)
        drawn = _MAKERS if is_drawable else [TEXT] * bool(text)
        self._formats = [mime_type, *drawn]

    def document_of(self, mimetype: str) -> Document | None:
        """Return the document itself for its MIME type, so that this program need not decode it."""
        return self._document if mimetype == self._mime_type else None

    def formats(self) -> list[str]:
        """Return the MIME types; called by Qt."""
        return self._formats

    def retrieveData(self, mimetype: str, _type: QMetaType | QMetaType.Type) -> Any:  # noqa: ANN401, N802
        """Return the content for a MIME type; called by Qt."""
        if mimetype not in self._formats:
            return None
        if mimetype not in self._cache:
            content = self._make(mimetype)
            self._cache[mimetype] = QByteArray(content) if isinstance(content, bytes) else content
        return self._cache[mimetype]

    def _make(self, mimetype: str) -> object:
        if mimetype == self._mime_type:
            return encode(self._document)
        if mimetype == TEXT and self._text:
            return self._text
        try:
            return _MAKERS[mimetype](self._document)
        except ExchangeError:
            # The drawing is out of range for pictures, or has no curve that can be drawn.
            return None


def _png(document: Document) -> bytes:
    style = exchange.drawing.styles.ON_PAPER.get(document.paper)
    options = exchange.options.Options(width=_WIDTH, style=style, transparent=style is None)
    return exchange.png_file(document, options).data


_MAKERS: dict[str, Callable[[Document], object]] = {
    SVG: lambda document: exchange.svg_for_clipboard(document).data,
    TEXT: lambda document: exchange.svg_for_clipboard(document, silent, False).text,
    _PNG: _png,
    _IMAGE: lambda document: QImage.fromData(_png(document)),
}
