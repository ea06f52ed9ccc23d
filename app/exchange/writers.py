"""The writers of all formats but pictures in pixels and documents, by the endings of their files."""

from __future__ import annotations

from collections.abc import Callable

from app.document.model import Document
from app.exchange.code import python_code, scipy_code
from app.exchange.formats import Options
from app.exchange.formulas import coefficients_json, desmos_expressions, svg_path_data
from app.exchange.latex import latex_formula, pgfplots_axis, tikz_picture
from app.exchange.parts import Written
from app.exchange.points_table import points_table
from app.exchange.sampled import sampled_table
from app.exchange.svg import picture_of, svg_text
from app.tasks.progress import part

Writer = Callable[[Document, Options], Written]


def _svg(document: Document, options: Options) -> Written:
    report, style = options.report, options.vector_style
    drawing = picture_of(document, options.tolerance, options.extras, style, part(report, 0.0, 0.7))
    text = svg_text(
        drawing,
        style=style,
        points=options.points,
        width=options.width,
        unit=options.unit,
        report=part(report, 0.7, 1.0),
    )
    return Written(text, drawing.deviation, drawing.remarks)


def _dxf(document: Document, options: Options) -> Written:
    from app.exchange.dxf import dxf_text  # noqa: PLC0415

    return dxf_text(
        document,
        options.tolerance,
        points=options.points,
        cubic=options.cubic,
        unit=options.unit,
        report=options.report,
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
    ".coefficients.json": lambda document, options: coefficients_json(document, options.report),
    ".scipy.py": lambda document, options: scipy_code(document, options.report),
    ".py": lambda document, options: python_code(document, options.report),
    ".pgfplots.tex": lambda document, options: pgfplots_axis(document, options.tolerance, options.report),
    ".tikz.tex": lambda document, options: tikz_picture(
        document, options.tolerance, options.unit, options.report
    ),
    ".tikz": lambda document, options: tikz_picture(
        document, options.tolerance, options.unit, options.report
    ),
    ".tex": lambda document, options: latex_formula(document, report=options.report),
    ".desmos.txt": lambda document, options: desmos_expressions(document, options.tolerance, options.report),
    ".path.txt": lambda document, options: svg_path_data(document, options.tolerance, options.report),
    ".points.csv": lambda document, options: points_table(document, report=options.report),
    ".points.tsv": lambda document, options: points_table(document, "\t", options.report),
    ".csv": _table(","),
    ".tsv": _table("\t"),
    ".dxf": _dxf,
    ".svg": _svg,
}
