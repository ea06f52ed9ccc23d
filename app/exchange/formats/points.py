"""Curves as tables of their points, with the derivatives in force: read back, they are the same curves."""

from __future__ import annotations

from math import isnan, nan

from ...document.derivatives import DERIVATIVES
from ...document.edits import interval
from ...document.model import Document
from ...tasks.progress import part, told
from ...view_model.curve.curve_view import CurveView, view_of
from ..options import DEFAULT, Options
from ..parts import cell_of_name, cell_of_number, distinct_names, sources_of
from ..table.columns import AFTER, ROLES, WORDS, family_word
from . import Format, Written


def points_table(document: Document, options: Options = DEFAULT) -> Written:
    """Return the points of all visible curves, a row each; read back, they give curves of the same shape.

    Tabs separate the cells of a file whose name ends in .tsv, commas those of any other.

    Derivatives are those in force, estimated ones too. The derivatives after a corner stand in columns of
    their own. The last row of a closed curve is its first point again, with the parameter at which it
    returns there.

    Raises
    ------
    ExchangeError
        If there is no curve.
    """
    separator = "\t" if options.path.lower().endswith(".tsv") else ","
    sources, remarks = sources_of(document, part(options.report, 0.0, 0.5))
    titles = (*ROLES, *AFTER)
    rows = []
    named = list(zip(sources, distinct_names(sources), strict=True))
    for source, name in told(named, part(options.report, 0.5, 1.0), "Writing"):
        curve = source.curve
        words = [cell_of_name(name, separator), family_word(curve)]
        rows += [(words, row) for row in _rows(view_of(curve))]
    used = [place for place in range(len(titles)) if any(not isnan(row[place]) for _, row in rows)]
    lines = [separator.join([*WORDS, *(titles[place] for place in used)])]
    lines += [
        separator.join([*words, *(cell_of_number(row[place]) for place in used)]) for words, row in rows
    ]
    return Written("\n".join(lines) + "\n", 0.0, remarks)


def _rows(view: CurveView) -> list[tuple[float, ...]]:
    curve = view.source
    rows = []
    for index, point in enumerate(curve.points):
        t = float(view.parameters[index])
        is_corner = point.corner and curve.family.derivatives
        after = _derivatives(view, index, ahead=True) if is_corner else [nan] * len(AFTER)
        rows.append((t, point.x, point.y, *_derivatives(view, index, ahead=False), *after))
    if curve.is_closed:
        first = curve.points[0]
        empty = (nan,) * (len(ROLES) + len(AFTER) - 3)
        rows.append((interval(curve)[1], first.x, first.y, *empty))
    return rows


def _derivatives(view: CurveView, index: int, *, ahead: bool) -> list[float]:
    """Return the derivatives on one side of a point, by their orders; NaN where there is none."""
    vectors = (view.derivative_of(index, each.order, ahead=ahead) for each in DERIVATIVES)
    return [number for vector in vectors for number in vector or (nan, nan)]


POINTS_TABLE = Format(
    endings=(".points.csv", ".points.tsv"),
    title="Table of points (CSV)",
    description="The points with their derivatives. Imported again, they give the same curves.",
    rank=70,
    write=points_table,
)
