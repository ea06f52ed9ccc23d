"""Writing: the name of a file decides what goes into it."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from app.document.format import FormatError, encode
from app.document.model import Document
from app.document.storage import write
from app.exchange.code import python_code, scipy_code
from app.exchange.drawing import ExchangeError, drawing_of
from app.exchange.formulas import coefficients_json, desmos_expressions, svg_path_data
from app.exchange.latex import latex_formula, pgfplots_axis, tikz_picture
from app.exchange.parts import Written
from app.exchange.sampled import SAMPLES, Spacing, sampled_table
from app.exchange.svg import INK, LIGHT, Style, svg_of

SUFFIXES = (".png", ".svg", ".pdf")
"""Endings of the pictures that `export` can write."""


@dataclass(frozen=True)
class Exported:
    """What was written.

    Attributes
    ----------
    deviation
        Largest distance of what the file holds from the true curves, in the document's unit.
    remarks
        One sentence for every curve that was left out.
    """

    deviation: float
    remarks: tuple[str, ...] = ()


@dataclass(frozen=True)
class Options:
    """How to write; each format takes what concerns it. See `export`."""

    width: int | None = None
    tolerance: float | None = None
    style: Style | None = None
    points: bool = False
    samples: int = SAMPLES
    spacing: Spacing = Spacing.T


Writer = Callable[[Document, Options], Written]


def _document(document: Document, _: Options) -> Written:
    try:
        return Written(encode(document).decode(), 0.0)
    except FormatError as problem:
        raise ExchangeError(f"The document cannot be written: {problem}.") from problem


def _svg(document: Document, options: Options) -> Written:
    style = options.style or INK
    text = svg_of(
        document, tolerance=options.tolerance, style=style, points=options.points, width=options.width
    )
    drawing = drawing_of(document, options.tolerance)
    return Written(text, drawing.deviation, drawing.remarks)


def _dxf(document: Document, options: Options) -> Written:
    from app.exchange.dxf import dxf_text  # noqa: PLC0415

    return dxf_text(document, options.tolerance)


def _table(separator: str) -> Writer:
    def table(document: Document, options: Options) -> Written:
        return sampled_table(
            document,
            separator=separator,
            samples=options.samples,
            spacing=options.spacing,
            tolerance=options.tolerance,
        )

    return table


# The first ending that fits counts.
_WRITERS: dict[str, Writer] = {
    ".curve.json": _document,
    ".coefficients.json": lambda document, _: coefficients_json(document),
    ".scipy.py": lambda document, _: scipy_code(document),
    ".py": lambda document, _: python_code(document),
    ".pgfplots.tex": lambda document, options: pgfplots_axis(document, options.tolerance),
    ".tikz.tex": lambda document, options: tikz_picture(document, options.tolerance),
    ".tikz": lambda document, options: tikz_picture(document, options.tolerance),
    ".tex": lambda document, _: latex_formula(document),
    ".desmos.txt": lambda document, options: desmos_expressions(document, options.tolerance),
    ".path.txt": lambda document, options: svg_path_data(document, options.tolerance),
    ".csv": _table(","),
    ".tsv": _table("\t"),
    ".dxf": _dxf,
    ".svg": _svg,
}

ENDINGS = (*_WRITERS, ".png", ".pdf")
"""Endings of the files that `export` can write."""


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
    if ending in _WRITERS:
        written = _WRITERS[ending](document, options)
        write(path, written.text.encode())
        return Exported(written.deviation, written.remarks)
    return _export_image(document, path, ending, options)


def ending_of(path: str | os.PathLike[str], endings: tuple[str, ...]) -> str:
    """Return the first of the endings that the name of a file has.

    Raises
    ------
    ExchangeError
        If it has none.
    """
    name = Path(path).name
    for ending in endings:
        if name.lower().endswith(ending):
            return ending
    known = ", ".join(endings[:-1])
    raise ExchangeError(f"The name “{name}” does not end in a known format; use {known} or {endings[-1]}.")


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
