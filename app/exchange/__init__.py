"""Files in and out.

- ``drawing``: a document as cubic Bézier curves in a frame, the source of every picture.
- ``svg``: that drawing as SVG, exact or within a stated tolerance.
- ``image``: that SVG as PNG and PDF; the only module here that needs Qt.
- ``facts``: what ``curvebench info`` prints.

`export` chooses the writer by the name of the file.
"""

from __future__ import annotations

import os
from pathlib import Path

from app.document.model import Document
from app.document.storage import write
from app.exchange.drawing import ExchangeError
from app.exchange.svg import DARK, INK, LIGHT, Style, svg_of

SUFFIXES = (".png", ".svg", ".pdf")
"""Endings of the files that `export` can write."""

__all__ = ["DARK", "INK", "LIGHT", "SUFFIXES", "ExchangeError", "Style", "export", "svg_of"]


def export(
    document: Document,
    path: str | os.PathLike[str],
    *,
    width: int | None = None,
    tolerance: float | None = None,
    style: Style | None = None,
    points: bool = False,
) -> None:
    """Write a picture of a document in the format that the ending of `path` names.

    Parameters
    ----------
    document
        A document with at least one curve that can be drawn.
    path
        A file with one of the endings `SUFFIXES`, in capitals or not.
    width
        Width in pixels (PNG, SVG) or points of 1/72 inch (PDF); the height follows from the drawing.
    tolerance
        Largest deviation of the outlines from the true curves, in the document's unit; by default a
        hundred-thousandth of the drawing's longer side.
    style
        Colours; by default dark ink, on light paper in a PNG and on none in SVG and PDF.
    points
        Whether to draw the points.

    Raises
    ------
    ExchangeError
        For an unknown ending, or if the document cannot be drawn.
    StorageError
        If the file cannot be written; an old one stays as it was.
    """
    suffix = Path(path).suffix.lower()
    if suffix not in SUFFIXES:
        known = ", ".join(SUFFIXES[:-1])
        raise ExchangeError(
            f"The name “{Path(path).name}” does not end in a known format; use {known} or {SUFFIXES[-1]}."
        )
    if width is not None and width < 1:
        raise ExchangeError("The width must be at least 1.")
    if suffix == ".svg":
        text = svg_of(document, tolerance=tolerance, style=style or INK, points=points, width=width)
        write(path, text.encode())
        return
    # Qt is slow to import, and an SVG does without.
    from app.exchange import image  # noqa: PLC0415

    if suffix == ".pdf":
        image.write_pdf(document, path, width=width, tolerance=tolerance, style=style or INK, points=points)
    else:
        pixels = image.DEFAULT_WIDTH if width is None else width
        image.write_png(
            document, path, width=pixels, tolerance=tolerance, style=style or LIGHT, points=points
        )
