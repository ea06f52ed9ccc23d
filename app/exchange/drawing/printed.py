"""Documents on the pages of printers, with Qt: painted as a PDF of them is."""

from __future__ import annotations

from PySide6.QtCore import QRectF
from PySide6.QtGui import QPagedPaintDevice, QPageLayout, QPainter

from ...document.model import Document
from ...tasks.progress import Report, part
from ..errors import ExchangeError
from ..options import Options
from ..svg.writer import picture_of
from ..units import MILLIMETRES, known_unit
from .drawing import Drawing
from .image import paint_drawing

_DRAWN = 0.9
_SLACK = 0.05
"""Millimetres by which a page may exceed its paper: sizes of paper are rounded."""


def to_print(document: Document, report: Report) -> Drawing:
    """Return the drawing of a document: its page, or what its visible curves take.

    Raises
    ------
    ExchangeError
        If nothing can be drawn.
    """
    options = Options(unit=document.unit)
    return picture_of(document, options, options.vector_style(document), part(report, 0.0, _DRAWN))


def true_size(drawing: Drawing, unit: str) -> tuple[float, float] | None:
    """Return width and height in millimetres; None without a unit of length."""
    scale = MILLIMETRES.get(known_unit(unit))
    return (drawing.frame.width * scale, drawing.frame.height * scale) if scale is not None else None


def print_drawing(drawing: Drawing, document: Document, device: QPagedPaintDevice) -> str:
    """Paint the drawing of a document on a page of a device; return what is to be known of its size.

    It has true size, in the middle of the paper: a page on paper of its size fills that. What has no unit of
    length, or no page and is too large, is fitted within the margins.

    Raises
    ------
    ExchangeError
        If the printer does not begin.
    """
    painter, layout = QPainter(), device.pageLayout()
    if not painter.begin(device):
        raise ExchangeError("The printer did not begin. Choose another one, or print to a file.")
    with painter:
        area, remark = _area(drawing, document, layout)
        # A printer begins at its margins unless it was told otherwise.
        dots = painter.device().logicalDpiX() / 25.4
        if layout.mode() is not QPageLayout.Mode.FullPageMode:
            margins = layout.margins(QPageLayout.Unit.Millimeter)
            area.translate(-margins.left(), -margins.top())
        place = QRectF(area.x() * dots, area.y() * dots, area.width() * dots, area.height() * dots)
        painter.translate(place.topLeft())
        if drawing.has_page:
            painter.setClipRect(QRectF(0, 0, place.width(), place.height()))
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        options = Options(unit=document.unit)
        fitted = drawing.fitted(place.width(), place.height())
        paint_drawing(fitted, painter, options.vector_style(document), points=False)
    return remark


def _area(drawing: Drawing, document: Document, layout: QPageLayout) -> tuple[QRectF, str]:
    """Return where on the paper a drawing goes, in millimetres, and what is to be known of that."""
    paper = layout.fullRect(QPageLayout.Unit.Millimeter)
    room = layout.paintRect(QPageLayout.Unit.Millimeter)
    true = true_size(drawing, document.unit)
    width, height = true or (drawing.frame.width, drawing.frame.height)
    area, remark = paper, ""
    if true is None or (not drawing.has_page and _exceeds(width, height, room)):
        scale, area = min(room.width() / width, room.height() / height), room
        width, height = width * scale, height * scale
        remark = "fitted on the paper"
    elif drawing.has_page and _exceeds(width, height, paper):
        remark = "cut at the edges of the paper, for the page is larger"
    x, y = area.center().x() - width / 2, area.center().y() - height / 2
    return QRectF(x, y, width, height), remark


def _exceeds(width: float, height: float, room: QRectF) -> bool:
    return width > room.width() + _SLACK or height > room.height() + _SLACK
