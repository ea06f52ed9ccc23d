"""Writing: the name of a file decides what goes into it."""

from __future__ import annotations

import os
import struct
from typing import TYPE_CHECKING

from app.document.model import Document
from app.exchange.drawing import ExchangeError
from app.exchange.formats import ENDINGS, SAMPLES, Exported, Options, Spacing, ending_of
from app.exchange.svg import Style
from app.storage.files import write
from app.storage.format import FormatError, encode
from app.storage.image_path import relative_to
from app.tasks.progress import FINAL, Report, silent

if TYPE_CHECKING:
    from app.exchange.decor import Extras


def export(
    document: Document,
    path: str | os.PathLike[str],
    *,
    width: int | None = None,
    tolerance: float | None = None,
    style: Style | None = None,
    points: bool = False,
    samples: int = SAMPLES,
    spacing: Spacing = Spacing.T,
    scale: float = 1.0,
    transparent: bool = False,
    extras: Extras | None = None,
    columns: tuple[str, ...] | None = None,
    cubic: bool = False,
    unit: str = "",
    report: Report = silent,
) -> Exported:
    """Write a document in the format that the ending of `path` names.

    Parameters
    ----------
    document
        A document with at least one curve that can be drawn.
    path
        A file with one of the endings `ENDINGS`, in capitals or not.
    width
        Of pictures: width in pixels (PNG, SVG) or points of 1/72 inch (PDF); the height follows.
    tolerance
        Largest deviation allowed, in the document's unit, of formats that cannot hold the curve itself;
        by default a hundred-thousandth of the drawing's longer side.
    style
        Of pictures: colours; by default dark ink, on light paper in a PNG and on none in SVG and PDF.
    points
        Of pictures and DXF: whether to draw the points.
    samples, spacing
        Of tables: how many samples for each curve, and how they are spread.
    scale
        Of a PNG: how many pixels stand for each of `width`, and for 1/96 inch.
    transparent
        Of pictures: whether to leave the paper out, whatever the style.
    extras
        Of pictures: what else to draw.
    columns
        Of tables of samples: the columns to write; by default all.
    cubic
        Of DXF: whether to write no spline above degree 3.
    unit
        Of pictures, TikZ and DXF: what a length of one is, such as "mm". Without a `width` an SVG or PDF then
        has true size, as TikZ always has; of a PNG it gives the pixels per inch.
    report
        Hears how far it has come; until the file is put in place it may raise `Cancelled`.

    Returns
    -------
    Exported
        What was reached, and what was left out.

    Raises
    ------
    ExchangeError
        For an unknown ending, or if the document cannot be written in that format.
    StorageError
        If the file cannot be written; an old one stays as it was.
    """
    options = Options(
        width=width,
        tolerance=tolerance,
        style=style,
        points=points,
        samples=samples,
        spacing=spacing,
        scale=scale,
        transparent=transparent,
        extras=extras,
        columns=columns,
        cubic=cubic,
        unit=unit,
        report=report,
    )
    return export_with(document, path, options)


def export_with(document: Document, path: str | os.PathLike[str], options: Options) -> Exported:
    """Write a document as `export` does."""
    if options.width is not None and options.width < 1:
        raise ExchangeError("The width must be at least 1.")
    ending = ending_of(path, ENDINGS)
    options.report(0.0, "Writing")
    if ending == ".curve.json":
        # The picture to trace is found from where the file lies.
        document = relative_to(document, os.path.dirname(os.path.abspath(path)))  # noqa: PTH100, PTH120 - links are kept
        return _put(path, _encoded(document), Exported(0.0), options.report)
    if ending in (".png", ".pdf"):
        data, deviation, remarks = _image(document, ending, options)
    else:
        # The window starts without the writers.
        from app.exchange.writers import WRITERS  # noqa: PLC0415

        written = WRITERS[ending](document, options)
        data, deviation, remarks = written.text.encode(), written.deviation, written.remarks
    pixels = _size_of_png(data) if ending == ".png" else None
    return _put(path, data, Exported(deviation, remarks, pixels), options.report)


def _put(path: str | os.PathLike[str], data: bytes, done: Exported, report: Report) -> Exported:
    """Put the file in place, which cannot be taken back."""
    report(FINAL, "Writing")
    write(path, data)
    return done


def _encoded(document: Document) -> bytes:
    try:
        return encode(document)
    except FormatError as problem:
        raise ExchangeError(f"The document cannot be written: {problem}.") from problem


def _size_of_png(data: bytes) -> tuple[int, int]:
    """Return width and height, which stand at the same place in every PNG."""
    width, height = struct.unpack_from(">II", data, 16)
    return width, height


def _image(document: Document, ending: str, options: Options) -> tuple[bytes, float, tuple[str, ...]]:
    # Qt is slow to import, and everything else does without.
    from app.exchange import image  # noqa: PLC0415

    make = image.pdf_file if ending == ".pdf" else image.png_file
    data, drawing = make(document, options)
    return data, drawing.deviation, drawing.remarks
