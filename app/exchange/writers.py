"""The writers of all formats but pictures in pixels, by the endings of their files."""

from __future__ import annotations

from collections.abc import Callable

from app.document.format import FormatError, encode
from app.document.model import Document
from app.exchange.code import python_code, scipy_code
from app.exchange.drawing import ExchangeError, drawing_of
from app.exchange.formats import Options
from app.exchange.formulas import coefficients_json, desmos_expressions, svg_path_data
from app.exchange.latex import latex_formula, pgfplots_axis, tikz_picture
from app.exchange.parts import Written
from app.exchange.points_table import points_table
from app.exchange.sampled import sampled_table
from app.exchange.svg import svg_of

Writer = Callable[[Document, Options], Written]


def _document(document: Document, _: Options) -> Written:
    try:
        return Written(encode(document).decode(), 0.0)
    except FormatError as problem:
        raise ExchangeError(f"The document cannot be written: {problem}.") from problem


def _svg(document: Document, options: Options) -> Written:
    text = svg_of(
        document,
        tolerance=options.tolerance,
        style=options.vector_style,
        points=options.points,
        width=options.width,
        extras=options.extras,
        unit=options.unit,
    )
    drawing = drawing_of(document, options.tolerance)
    return Written(text, drawing.deviation, drawing.remarks)


def _dxf(document: Document, options: Options) -> Written:
    from app.exchange.dxf import dxf_text  # noqa: PLC0415

    return dxf_text(
        document, options.tolerance, points=options.points, cubic=options.cubic, unit=options.unit
    )


def _table(separator: str) -> Writer:
    def table(document: Document, options: Options) -> Written:
        return sampled_table(
            document,
            separator=separator,
            samples=options.samples,
            spacing=options.spacing,
            tolerance=options.tolerance,
            columns=options.columns,
            report=options.report,
        )

    return table


WRITERS: dict[str, Writer] = {
    ".curve.json": _document,
    ".coefficients.json": lambda document, _: coefficients_json(document),
    ".scipy.py": lambda document, _: scipy_code(document),
    ".py": lambda document, _: python_code(document),
    ".pgfplots.tex": lambda document, options: pgfplots_axis(document, options.tolerance),
    ".tikz.tex": lambda document, options: tikz_picture(document, options.tolerance, options.unit),
    ".tikz": lambda document, options: tikz_picture(document, options.tolerance, options.unit),
    ".tex": lambda document, _: latex_formula(document),
    ".desmos.txt": lambda document, options: desmos_expressions(document, options.tolerance),
    ".path.txt": lambda document, options: svg_path_data(document, options.tolerance),
    ".points.csv": lambda document, _: points_table(document),
    ".points.tsv": lambda document, _: points_table(document, "\t"),
    ".csv": _table(","),
    ".tsv": _table("\t"),
    ".dxf": _dxf,
    ".svg": _svg,
}
