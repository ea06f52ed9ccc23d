"""Writing: the name of a file decides what goes into it."""

from __future__ import annotations

import os

from app.document.model import Document
from app.document.storage import write
from app.exchange.drawing import ExchangeError, drawing_of
from app.exchange.formats import ENDINGS, SAMPLES, Exported, Options, Spacing, ending_of
from app.exchange.svg import INK, LIGHT, Style


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
        Of pictures: whether to draw the points.
    samples, spacing
        Of tables: how many samples for each curve, and how they are spread.

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
    if width is not None and width < 1:
        raise ExchangeError("The width must be at least 1.")
    options = Options(width, tolerance, style, points, samples, spacing)
    ending = ending_of(path, ENDINGS)
    if ending not in (".png", ".pdf"):
        # The window starts without the writers.
        from app.exchange.writers import WRITERS  # noqa: PLC0415

        written = WRITERS[ending](document, options)
        write(path, written.text.encode())
        return Exported(written.deviation, written.remarks)
    return _export_image(document, path, ending, options)


def _export_image(
    document: Document, path: str | os.PathLike[str], ending: str, options: Options
) -> Exported:
    # Qt is slow to import, and everything else does without.
    from app.exchange import image  # noqa: PLC0415

    drawing = drawing_of(document, options.tolerance)
    tolerance, points, style = options.tolerance, options.points, options.style
    if ending == ".pdf":
        image.write_pdf(
            document, path, width=options.width, tolerance=tolerance, style=style or INK, points=points
        )
    else:
        pixels = image.DEFAULT_WIDTH if options.width is None else options.width
        image.write_png(
            document, path, width=pixels, tolerance=tolerance, style=style or LIGHT, points=points
        )
    return Exported(drawing.deviation, drawing.remarks)
