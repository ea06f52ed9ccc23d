"""Documents in pixels and as PDF, with Qt. No display is needed.

Both are painted from the drawing that an SVG is written from, moved to the picture's own coordinates in NumPy
first: Qt then never sees the coordinates of the document, however large, small or far away they are.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager

import msgspec
from PySide6.QtCore import QBuffer, QIODevice, QMarginsF, QSizeF
from PySide6.QtGui import QColor, QGuiApplication, QImage, QPageLayout, QPageSize, QPainter, QPdfWriter

from ... import __version__
from ...document.lengths import MILLIMETRES, known_unit
from ...document.model import Document
from ...tasks.progress import part
from ...view_model.palette import contrast
from ..errors import ExchangeError
from ..formats import ExportResult
from ..options import Options
from ..svg.writer import accuracy_of, picture_of, pixels_per_unit, with_size
from ..units import POINTS_PER_MILLIMETRE, size_text
from .drawing import Drawing
from .outlines import Frame
from .painting import Painting
from .styles import PictureStyle

DEFAULT_WIDTH = 1600

LARGEST_SIDE = 16384
"""Longer side of the largest picture, in pixels; Qt's painter ends at 32767."""

PAGE_SIDE = 720.0
"""Longer side, in points of 1/72 inch, of a PDF page whose size nobody asked for."""

LARGEST_PAGE, SMALLEST_PAGE = 14_400, 3
"""Sides of a PDF page in points, as ISO 32000-1, annex C, has them."""

_PDF_RESOLUTION = 1440
"""Dots an inch: a whole number for each point, so that nothing is rounded."""

_DOTS_PER_METRE = 96 / 0.0254
_MOST_DOTS = 2**31 - 1

_DRAWN = 0.6
"""Share of a picture that is its drawing; painting follows."""


class PicturePreview(msgspec.Struct, frozen=True):
    """A picture as the dialog shows it before it is written.

    Attributes
    ----------
    size
        Size of the picture as text.
    colour_remark
        The remark on colours that were hard to see on the paper; empty for none.
    """

    image: QImage
    size: str
    colour_remark: str = ""


def _true_dots_per_metre(drawing: Drawing, options: Options) -> int:
    """Return the pixels per metre at true size; 0 without a unit, or where a file cannot hold them."""
    unit = known_unit(options.unit)
    if not unit:
        return 0
    width, _ = _size(drawing, options)
    dots = round(1000 * width / (drawing.frame.width * MILLIMETRES[unit]))
    return dots if dots <= _MOST_DOTS else 0


def png_preview(document: Document, options: Options, room: tuple[int, int]) -> PicturePreview:
    """Return the preview of a PNG with these options, of at most so many pixels.

    Raises
    ------
    ExchangeError
        As `png_file`.
    """
    drawing = _png_drawing(document, options, options.paper_style)
    width, height = _size(drawing, options)
    dots = _true_dots_per_metre(drawing, options)
    size = f"{width} × {height} pixels"
    if dots:
        unit = known_unit(options.unit)
        true = size_text(drawing.frame.width, drawing.frame.height, unit)
        is_asked = options.dpi is not None and options.width is None
        size += f", {true} at {options.dpi if is_asked else dots * 0.0254:.4g} dpi"
    return _preview(drawing, options, options.paper_style, size, room)


def svg_preview(document: Document, options: Options, room: tuple[int, int]) -> PicturePreview:
    """Return the preview of an SVG; see `png_preview`."""
    options = with_size(options)
    drawing = _drawing(document, options, options.vector_style)
    frame, scale = drawing.frame, pixels_per_unit(drawing.frame, options)
    size = _size_text(frame, options, (frame.width * scale, frame.height * scale), "px")
    return _preview(drawing, options, options.vector_style, size, room)


def pdf_preview(document: Document, options: Options, room: tuple[int, int]) -> PicturePreview:
    """Return the preview of a PDF; see `png_preview`."""
    drawing = _drawing(document, options, options.vector_style)
    wide, high = _page_size(drawing, options)
    page = (wide / POINTS_PER_MILLIMETRE, high / POINTS_PER_MILLIMETRE)
    size = _size_text(drawing.frame, options, page, "mm")
    return _preview(drawing, options, options.vector_style, f"Page of {size}", room)


def _size_text(frame: Frame, options: Options, size: tuple[float, float], unit: str) -> str:
    """Return the size of a file as text: the true one, or this one in the unit of the format."""
    true = known_unit(options.unit)
    if not true or options.width is not None:
        return f"{size_text(*size, unit)}, not to scale"
    return f"{size_text(frame.width, frame.height, true)}, 1 : 1 (1 is 1 {true})"


def _preview(
    drawing: Drawing, options: Options, style: PictureStyle, size: str, room: tuple[int, int]
) -> PicturePreview:
    frame = drawing.frame
    scale = min(room[0] / frame.width, room[1] / frame.height)
    pixels = (max(round(frame.width * scale), 1), max(round(frame.height * scale), 1))
    return PicturePreview(_painted(drawing, pixels, style, options), size, _colours_remark(drawing, style))


_VANISHING = 1.25
"""Contrast below which a curve is lost on white paper; yellow has 1.3."""


def _colours_remark(drawing: Drawing, style: PictureStyle) -> str:
    """Return the remark on curves whose colours are changed for the paper, or vanish on a white one."""
    lines = [outline for outline in drawing.outlines if not outline.style.has_fill]
    if style.paper is None:
        pale = [line for line in lines if contrast(style.visible_colour(line.colour), "#ffffff") < _VANISHING]
        if not pale:
            return ""
        name = pale[0].shape or pale[0].name
        return f"“{name}” is hardly visible on white paper, and the picture has no paper of its own."
    adjusted = [line for line in lines if style.adjustment_of(line.colour)]
    if not adjusted:
        return ""
    more = f" (and {len(adjusted) - 1} more)" if len(adjusted) > 1 else ""
    return f"“{adjusted[0].shape or adjusted[0].name}” is {style.adjustment_of(adjusted[0].colour)}{more}."


def _size(drawing: Drawing, options: Options) -> tuple[int, int]:
    # Huge factors are refused below, and must not overflow.
    width = round(min(_wanted_width(drawing, options), 1e9))
    height = round(width * drawing.frame.height / drawing.frame.width)
    if not 1 <= min(width, height) <= max(width, height) <= LARGEST_SIDE:
        raise ExchangeError(
            f"A picture of {width} × {height} pixels is not possible; "
            f"its sides can be 1 to {LARGEST_SIDE} pixels."
        )
    return width, height


def _wanted_width(drawing: Drawing, options: Options) -> float:
    """Return the width in pixels that was asked for, by itself or by their number for each inch."""
    if options.dpi is None or options.width is not None:
        return (DEFAULT_WIDTH if options.width is None else options.width) * options.scale
    if not options.is_to_scale:
        raise ExchangeError("A resolution in dpi needs a unit of length, but the document has none.")
    return drawing.frame.width * MILLIMETRES[known_unit(options.unit)] / 25.4 * options.dpi * options.scale


def _painted(drawing: Drawing, size: tuple[int, int], style: PictureStyle, options: Options) -> QImage:
    image = QImage(*size, QImage.Format.Format_ARGB32_Premultiplied)
    image.fill(QColor(0, 0, 0, 0))
    # A painter must not outlive its device.
    with QPainter(image) as painter:
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        _paint(drawing.fitted(*size), painter, style, options)
    return image


def _paint(fitted: Drawing, painter: QPainter, style: PictureStyle, options: Options) -> None:
    report = part(options.report, _DRAWN, 1.0)
    Painting(fitted, painter, style).paint(points=options.points, report=report)


def png_file(document: Document, options: Options) -> ExportResult:
    """Return a PNG file, `options.width` × `options.scale` pixels wide.

    Its pixels are as dense as true size asks for where that can be, else as on a screen.

    Raises
    ------
    ExchangeError
        If nothing can be drawn, or the picture would be too large.
    """
    style = options.paper_style
    drawing = _png_drawing(document, options, style)
    size = _size(drawing, options)
    with application():
        data = _png(_image(drawing, size, options, style))
        pale = (_colours_remark(drawing, style),) if style.paper is None else ()
        remarks = (*drawing.left_out, *filter(None, pale))
        return ExportResult(data, drawing.deviation, remarks, drawing.is_bound, size)


def _image(drawing: Drawing, size: tuple[int, int], options: Options, style: PictureStyle) -> QImage:
    # A function of its own, as `_page` is.
    image = _painted(drawing, size, style, options)
    image.setText("Software", f"Curvebench {__version__}")
    image.setText("Description", accuracy_of(drawing, drawing.deviation))
    dots = _true_dots_per_metre(drawing, options) or round(_DOTS_PER_METRE * options.scale)
    image.setDotsPerMeterX(dots)
    image.setDotsPerMeterY(dots)
    return image


def _png(image: QImage) -> bytes:
    buffer = _buffer()
    if not image.save(buffer, "png"):  # type: ignore[call-overload]  # its stub forgets devices
        raise ExchangeError("The picture could not be created. There may not be enough memory.")
    return bytes(buffer.data().data())


def _buffer() -> QBuffer:
    buffer = QBuffer()
    buffer.open(QIODevice.OpenModeFlag.WriteOnly)
    return buffer


def pdf_file(document: Document, options: Options) -> ExportResult:
    """Return a document as a PDF of one page.

    `options.width` is in points of 1/72 inch.

    Without a width, and with a unit, the page has true size.

    Raises
    ------
    ExchangeError
        If nothing can be drawn, or no page is as large or as small.
    """
    style = options.vector_style
    drawing = _drawing(document, options, style)
    with application():
        return ExportResult(
            _page(drawing, options, style), drawing.deviation, drawing.left_out, drawing.is_bound
        )


def _page(drawing: Drawing, options: Options, style: PictureStyle) -> bytes:
    # A function of its own: no painter may outlive the application.
    wide, high = page = _page_size(drawing, options)
    # With slack, so that a rounding error does not add a point.
    whole = (math.ceil(wide - 1e-6), math.ceil(high - 1e-6))
    buffer = _buffer()
    writer = QPdfWriter(buffer)
    writer.setCreator(f"Curvebench {__version__}")
    writer.setTitle(", ".join(outline.name for outline in drawing.outlines))
    writer.setResolution(_PDF_RESOLUTION)
    size = QPageSize(QSizeF(*whole), QPageSize.Unit.Point, "", QPageSize.SizeMatchPolicy.ExactMatch)
    writer.setPageLayout(QPageLayout(size, QPageLayout.Orientation.Portrait, QMarginsF()))
    with QPainter(writer) as painter:
        # From the lower left corner, where the page begins.
        painter.translate(0.0, (whole[1] - high) * _PDF_RESOLUTION / 72)
        side = (length * _PDF_RESOLUTION / 72 for length in page)
        _paint(drawing.fitted(*side), painter, style, options)
    return _cut(bytes(buffer.data().data()), whole, page)


def _cut(pdf: bytes, whole: tuple[int, int], page: tuple[float, float]) -> bytes:
    """Return a PDF with a page cut to its size: Qt makes those of whole points alone (QPageSize::sizePoints).

    The length stays, for the file contains positions within itself.
    """
    before = f"/MediaBox [0 0 {whole[0]:f} {whole[1]:f}]".encode()
    after = f"/MediaBox [0 0 {page[0]:f} {page[1]:f}".encode().ljust(len(before) - 1) + b"]"
    # If Qt writes it differently one day, the page is larger by less than a point.
    return pdf.replace(before, after, 1)


def _page_size(drawing: Drawing, options: Options) -> tuple[float, float]:
    """Return width and height in points of the page that a drawing fills."""
    frame, unit = drawing.frame, known_unit(options.unit)
    if not unit or options.width is not None:
        across = PAGE_SIDE * frame.width / frame.side if options.width is None else options.width
        return across, across * frame.height / frame.width
    scale = MILLIMETRES[unit] * POINTS_PER_MILLIMETRE
    if not SMALLEST_PAGE <= min(frame.width, frame.height) * scale <= frame.side * scale <= LARGEST_PAGE:
        longest = LARGEST_PAGE / POINTS_PER_MILLIMETRE
        raise ExchangeError(
            f"At true size the page would be {size_text(frame.width, frame.height, unit)}; "
            f"a PDF page can be 1 to {longest:.0f} mm."
        )
    return frame.width * scale, frame.height * scale


def _drawing(document: Document, options: Options, style: PictureStyle) -> Drawing:
    return picture_of(document, options, style, part(options.report, 0.0, _DRAWN))


def _png_drawing(document: Document, options: Options, style: PictureStyle) -> Drawing:
    # With a unit a PNG has true size at any width, which sets its resolution.
    return _drawing(document, msgspec.structs.replace(options, width=None), style)


@contextmanager
def application() -> Iterator[None]:
    """Paint with the running application, or with one that needs no display and ends with the painting.

    It is shut down at once: an application that is left to garbage collection would block a later one.
    """
    if isinstance(QGuiApplication.instance(), QGuiApplication):
        yield
        return
    created = QGuiApplication(["curvebench", "-platform", "offscreen"])
    try:
        yield
    finally:
        created.shutdown()
