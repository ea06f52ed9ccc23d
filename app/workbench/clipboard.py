"""Content of the clipboard: curves and points of this program, SVG and pictures of others."""

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
    """Return the content of the clipboard; empty where nothing was copied."""
    return QGuiApplication.clipboard().mimeData() or QMimeData()


def copied_curves_in(data: QMimeData) -> Document | None:
    """Return the curves that this program copied, or its points as one curve; None for neither.

    Raises
    ------
    FormatError
        If the data cannot be read.
    """
    kind = next(filter(data.hasFormat, (CURVES, POINTS)), None)
    return None if kind is None else decode(bytes(data.data(kind).data()))


def drawing_in(data: QMimeData) -> Fragment | None:
    """Return the SVG from another program or in text; None for points of this program."""
    if data.hasFormat(POINTS):
        return None
    if data.hasFormat(SVG):
        return exchange.svg.fragments.Fragment(bytes(data.data(SVG).data()))
    return exchange.svg.fragments.fragment_in(data.text()) if data.hasText() else None


def holds_picture(data: QMimeData) -> bool:
    """Return whether the data contain a picture."""
    return data.hasImage() or any(map(data.hasFormat, _PICTURES))


def put_on_clipboard(data: QMimeData) -> None:
    """Put data on the clipboard."""
    QGuiApplication.clipboard().setMimeData(data)
    _take_away_at_exit()


@cache
def _take_away_at_exit() -> None:
    """Clear the clipboard at exit on platforms without one, where Qt keeps the data itself.

    Qt would destroy the data after the interpreter has ended, which is a segmentation fault.
    """
    if QGuiApplication.platformName() in ("offscreen", "minimal"):
        atexit.register(_take_away)


def _take_away() -> None:
    if QGuiApplication.instance() is not None:
        QGuiApplication.clipboard().clear()
