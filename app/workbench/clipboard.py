"""The clipboard: SVG of other programs, and offers of this one, which end before the interpreter does."""

from __future__ import annotations

import atexit
from functools import cache
from typing import TYPE_CHECKING

from PySide6.QtCore import QMimeData
from PySide6.QtGui import QGuiApplication

from .. import exchange
from ..document.model import Document
from ..storage.format import decode

if TYPE_CHECKING:
    from ..exchange.svg.fragments import Fragment

SVG = "image/svg+xml"
"""MIME type of SVG."""

_PICTURES = ("image/png", "image/jpeg")

CURVES = "application/x-curvebench-curves"
"""MIME type of whole curves: a document of them."""

POINTS = "application/x-curvebench-points"
"""MIME type of points: a document of one curve that has these points only."""


def clipboard_data() -> QMimeData:
    """Return what the clipboard holds; nothing where nothing was ever copied."""
    return QGuiApplication.clipboard().mimeData() or QMimeData()


def own_in(data: QMimeData) -> Document | None:
    """Return the curves that were copied in this program, or the points as one of them; None for neither.

    Raises
    ------
    FormatError
        If they cannot be read.
    """
    kind = next(filter(data.hasFormat, (CURVES, POINTS)), None)
    return None if kind is None else decode(bytes(data.data(kind).data()))


def drawing_in(data: QMimeData) -> Fragment | None:
    """Return the SVG from another program, or in text; that of our own points is for others."""
    if data.hasFormat(POINTS):
        return None
    if data.hasFormat(SVG):
        return exchange.svg.fragments.Fragment(bytes(data.data(SVG).data()))
    return exchange.svg.fragments.fragment_in(data.text()) if data.hasText() else None


def holds_picture(data: QMimeData) -> bool:
    """Whether there is a picture from another program."""
    return data.hasImage() or any(map(data.hasFormat, _PICTURES))


def put_on_clipboard(data: QMimeData) -> None:
    """Let other programs, and this one, paste `data`."""
    QGuiApplication.clipboard().setMimeData(data)
    _take_away_at_exit()


@cache
def _take_away_at_exit() -> None:
    """See that what Qt itself keeps, having no clipboard of a system, goes before the interpreter does.

    Qt would destroy it with the process: with nobody there to hear of it, that ends in a segmentation fault.
    """
    if QGuiApplication.platformName() in ("offscreen", "minimal"):
        atexit.register(_take_away)


def _take_away() -> None:
    if QGuiApplication.instance() is not None:
        QGuiApplication.clipboard().clear()
