"""Documents as PNG and PDF; the only module of the exchange that needs Qt. No display is needed.

Both are the SVG of `app.exchange.svg`, moved to the picture's own coordinates in NumPy first: Qt then
never sees the coordinates of the document, however large, small or far away they are.
"""

from __future__ import annotations

import os

from PySide6.QtCore import QBuffer, QByteArray, QIODevice, QMarginsF, QRectF, QSizeF
from PySide6.QtGui import (
    QColor,
    QGuiApplication,
    QImage,
    QImageWriter,
    QPageLayout,
    QPageSize,
    QPainter,
    QPdfWriter,
)
from PySide6.QtSvg import QSvgRenderer, QtSvg

from app import __version__
from app.document.model import Document
from app.document.storage import write
from app.exchange.drawing import Drawing, ExchangeError, drawing_of
from app.exchange.svg import INK, LIGHT, Style, accuracy_of, svg_text

DEFAULT_WIDTH = 1600
LARGEST_SIDE = 16384
"""Longer side of the largest PNG, in pixels; Qt's painter ends at 32767."""

PAGE_SIDE = 720.0
"""Longer side, in points of 1/72 inch, of a PDF page whose size nobody asked for."""

_PDF_RESOLUTION = 1200


def write_png(
    document: Document,
    path: str | os.PathLike[str],
    *,
    width: int = DEFAULT_WIDTH,
    tolerance: float | None = None,
    style: Style = LIGHT,
    points: bool = False,
) -> None:
    """Write a picture of a document, `width` pixels wide; the height follows from the drawing.

    Raises
    ------
    ExchangeError
        If nothing can be drawn, or the picture would be too large.
    StorageError
        If the file cannot be written; an old one stays as it was.
    """
    drawing = drawing_of(document, tolerance)
    height = round(width * drawing.frame.height / drawing.frame.width)
    if not 1 <= min(width, height) <= max(width, height) <= LARGEST_SIDE:
        raise ExchangeError(
            f"A picture of {width} × {height} pixels is not possible; the sides may have 1 to {LARGEST_SIDE}."
        )
    running = application()
    image = QImage(width, height, QImage.Format.Format_ARGB32_Premultiplied)
    image.fill(QColor(0, 0, 0, 0))
    image.setText("Software", f"Curvebench {__version__}")
    image.setText("Description", accuracy_of(drawing))
    painter = QPainter(image)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    paint_drawing(drawing.fitted(width, height), painter, style, points=points)
    painter.end()
    del running
    buffer = QBuffer()
    buffer.open(QIODevice.OpenModeFlag.WriteOnly)
    if not QImageWriter(buffer, QByteArray(b"png")).write(image):
        raise ExchangeError("The picture could not be made; there may be too little memory.")
    write(path, bytes(buffer.data().data()))


def write_pdf(
    document: Document,
    path: str | os.PathLike[str],
    *,
    width: float | None = None,
    tolerance: float | None = None,
    style: Style = INK,
    points: bool = False,
) -> None:
    """Write a document as a PDF of one page, as outlines; `width` in points of 1/72 inch.

    Raises
    ------
    ExchangeError
        If nothing can be drawn.
    StorageError
        If the file cannot be written; an old one stays as it was.
    """
    drawing = drawing_of(document, tolerance)
    frame = drawing.frame
    across = PAGE_SIDE * frame.width / frame.side if width is None else width
    page = QSizeF(across, across * frame.height / frame.width)
    running = application()
    buffer = QBuffer()
    buffer.open(QIODevice.OpenModeFlag.WriteOnly)
    writer = QPdfWriter(buffer)
    writer.setCreator(f"Curvebench {__version__}")
    writer.setTitle(", ".join(outline.name for outline in drawing.outlines))
    writer.setResolution(_PDF_RESOLUTION)
    size = QPageSize(page, QPageSize.Unit.Point, "", QPageSize.SizeMatchPolicy.ExactMatch)
    writer.setPageLayout(QPageLayout(size, QPageLayout.Orientation.Portrait, QMarginsF()))
    painter = QPainter(writer)
    device = painter.viewport()
    paint_drawing(drawing.fitted(device.width(), device.height()), painter, style, points=points)
    painter.end()
    del running
    write(path, bytes(buffer.data().data()))


def paint_drawing(fitted: Drawing, painter: QPainter, style: Style, *, points: bool) -> None:
    """Paint a drawing whose frame is the painter's whole device."""
    frame = fitted.frame
    text = svg_text(fitted, style=style, points=points, width=frame.width)
    renderer = QSvgRenderer()
    # Otherwise Qt silently cuts off paths of more than some ten thousand pieces.
    renderer.setOptions(QtSvg.Option.AssumeTrustedSource)
    renderer.load(QByteArray(text.encode()))
    renderer.render(painter, QRectF(0, 0, frame.width, frame.height))


def application() -> QGuiApplication:
    """Return the running application, or one that needs no display for as long as it is kept."""
    running = QGuiApplication.instance()
    if isinstance(running, QGuiApplication):
        return running
    return QGuiApplication(["curvebench", "-platform", "offscreen"])
