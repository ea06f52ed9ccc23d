"""Curves as data that other programs take: Desmos, SVG path data, shapes of CSS, coefficients as JSON."""

from __future__ import annotations

import json
from decimal import Decimal
from fractions import Fraction
from math import comb
from typing import Any

import numpy as np

from curvecore import bezier_segments, power_coefficients
from curvecore.arithmetic import LARGEST
from curvecore.arrays import FloatArray

from ... import __version__
from ...document.model import Document
from ...document.style import FillRule
from ...tasks.progress import part, with_progress
from ...view_model.curve.curve_view import ParametricCurve
from ...view_model.extents import extent_of
from ..drawing.drawing import drawing_of, rounded
from ..drawing.outlines import Frame
from ..errors import ExchangeError
from ..exported_curves import (
    Beziers,
    accuracy,
    beziers_of,
    curves_of,
    largest_deviation,
    measured_deviation,
)
from ..options import DEFAULT, SVG_WIDTH, TOLERANCE, Options
from ..svg.writer import number, path_data, pixels_per_unit, with_size
from ..units import enlarged, shifted
from . import ExportResult, Format
from .code import identifiers_of

MOST_COEFFICIENTS = 100
"""Points of the largest Lagrange curve whose coefficients are written: beyond, no float holds them well."""


def desmos_expressions(document: Document, options: Options = DEFAULT) -> ExportResult:
    r"""Return a list of expressions to paste into Desmos, one Bézier piece a line, t from 0 to 1.

    Lagrange curves beyond degree 10 become cubics within the tolerance.

    Raises
    ------
    ExchangeError
        If there is no curve to write.
    """
    curves = curves_of(document, options)
    tolerance, paths, lines = curves.tolerance, list[Beziers](), list[str]()
    for curve in curves:
        pieces = [beziers_of(piece, tolerance) for piece in curve.core.pieces]
        lines += [_desmos_line(controls) for path in pieces for controls in path.control_points]
        paths += pieces
    deviation, is_bound = largest_deviation(paths)
    return ExportResult("\n".join(lines) + "\n", deviation, curves.remarks, is_bound)


def _desmos_line(controls: FloatArray) -> str:
    x, y = (_desmos_polynomial(column.tolist()) for column in controls.T)
    return rf"\left({x},{y}\right)"


def _desmos_polynomial(controls: list[float]) -> str:
    """Return a polynomial in Bernstein's form, with every multiplication written out."""
    degree = len(controls) - 1
    terms = []
    for k, value in enumerate(controls):
        # Not multiplied out: a factor of its own keeps every digit of the control point.
        factors = [_desmos_number(value)]
        factors += [str(comb(degree, k))] if 0 < k < degree else []
        factors += [rf"\left(1-t\right)^{{{degree - k}}}"] if k < degree else []
        factors += [f"t^{{{k}}}"] if k else []
        terms.append(r"\cdot ".join(factors))
    return "+".join(terms)


def _desmos_number(value: float) -> str:
    """Return a number without an exponent's e, which Desmos reads as Euler's; in parentheses if negative."""
    text = format(Decimal(repr(value + 0.0)), "f")
    return rf"\left({text}\right)" if value < 0 else text


def svg_path_data(document: Document, options: Options = DEFAULT) -> ExportResult:
    """Return path data, the ``d`` of an SVG path, one path a paragraph; y points down there.

    Raises
    ------
    ExchangeError
        If nothing can be drawn.
    """
    drawing = drawing_of(document, options.tolerance, part(options.report, 0.0, 0.7))
    shapes = with_progress(drawing.shapes, part(options.report, 0.7, 1.0), "Writing")
    paths = [path_data(shape) for shape in shapes]
    return ExportResult("\n\n".join(paths) + "\n", drawing.deviation, drawing.left_out, drawing.is_bound)


def css_shapes(document: Document, options: Options = DEFAULT) -> ExportResult:
    """Return a rule of CSS for every path: closed a ``clip-path``, open an ``offset-path``.

    The path data are pixels of a box that the curves fill, from its upper left corner. Its width is that of
    the options, or its size the true one or that of an SVG; numbers have three decimals.

    Raises
    ------
    ExchangeError
        If nothing can be drawn.
    """
    options = with_size(options)
    drawn = drawing_of(document, options.tolerance, part(options.report, 0.0, 0.4))
    low, high = extent_of(np.concatenate([outline.control_points for outline in drawn.outlines])).tolist()
    scale = pixels_per_unit(Frame(low[0], low[1], high[0] - low[0], high[1] - low[1]), options)
    in_box = enlarged(shifted(document, (-low[0], -high[1])), scale)
    drawing = rounded(drawing_of(in_box, drawn.tolerance * scale, part(options.report, 0.4, 1.0)), 3)
    width, height = (number(round((high[axis] - low[axis]) * scale, 3)) for axis in (0, 1))
    deviation = drawing.deviation / scale
    rules = [f"/* {accuracy(deviation, drawing.is_bound)} The box is {width} × {height} px. */"]
    shapes = drawing.shapes
    for name, shape in zip(
        identifiers_of(shape[0].shape or shape[0].name for shape in shapes), shapes, strict=True
    ):
        rule = "evenodd, " if shape[0].style.fill_rule is FillRule.EVENODD else ""
        path = f"clip-path: path({rule}" if shape[0].closed else "offset-path: path("
        rules.append(f'.{name} {{ {path}"{" ".join(path_data(shape).split())}"); }}')
    return ExportResult("\n".join(rules) + "\n", deviation, drawing.left_out, drawing.is_bound)


def coefficients_json(document: Document, options: Options = DEFAULT) -> ExportResult:
    """Return the coefficients of every polynomial piece as JSON, lowest power of s first.

    On a segment from start to end, s = (t - start) / (end - start), and x = Σ x_k s^k. The coefficients
    are computed exactly and rounded once; ``deviation`` says how far the polynomial with these
    coefficients, evaluated by Horner's scheme in double precision, is from the curve, about: it is rounding.

    Raises
    ------
    ExchangeError
        If there is no curve, or for a Lagrange curve of more than `MOST_COEFFICIENTS` points.
    """
    curves = curves_of(document, options)
    written, worst = [], 0.0
    for curve in curves:
        segments = []
        for piece in curve.polynomials.pieces:
            coefficients, ends = _coefficients(piece), piece.breaks
            deviation = measured_deviation(piece, lambda t, c=coefficients, e=ends: _horner(c, e, t))  # type: ignore[misc]
            worst = max(worst, deviation + curve.polynomials.deviation)
            segments += [_segment(ends, i, rows) for i, rows in enumerate(coefficients)]
        written.append({"name": curve.name, "family": str(curve.source.family), "segments": segments})
    content: dict[str, Any] = {
        "made_by": f"Curvebench {__version__}",
        "basis": "powers of s = (t - start) / (end - start), lowest first",
        "deviation": worst,
        "deviation_is_bound": False,
        "remarks": curves.remarks,
        "curves": written,
    }
    if not np.isfinite(worst):
        raise ExchangeError("The coefficients are out of range. Export code instead.")
    return ExportResult(
        json.dumps(content, indent=1, ensure_ascii=False) + "\n", worst, curves.remarks, is_bound=False
    )


def _segment(ends: FloatArray, index: int, rows: FloatArray) -> dict[str, Any]:
    x, y = rows.T.tolist()
    return {"start": float(ends[index]), "end": float(ends[index + 1]), "x": x, "y": y}


def _coefficients(piece: ParametricCurve) -> FloatArray:
    """Return the coefficients (segments, degree + 1, 2)."""
    if not piece.is_one_polynomial:
        return _from_bernstein(bezier_segments(piece))
    if len(piece.points) > MOST_COEFFICIENTS:
        raise ExchangeError(
            f"A polynomial through {len(piece.points)} points has no usable coefficients; at most "
            f"{MOST_COEFFICIENTS} points are possible. Export code instead."
        )
    coefficients = power_coefficients(piece, *piece.domain)[None]
    return np.where(np.abs(coefficients) < LARGEST, coefficients, np.inf)


def _from_bernstein(controls: FloatArray) -> FloatArray:
    """Return the coefficients of Bézier pieces: binomials times the forward differences at s = 0."""
    degree, coefficients = controls.shape[1] - 1, []
    exact = np.vectorize(Fraction, otypes=[object])(controls)
    for k in range(degree + 1):
        coefficients.append((comb(degree, k) * exact[:, 0]).astype(float))
        exact = np.diff(exact, axis=1)
    return np.stack(coefficients, axis=1)


def _horner(coefficients: FloatArray, ends: FloatArray, t: FloatArray) -> FloatArray:
    i = np.clip(np.searchsorted(ends, t, side="right") - 1, 0, len(coefficients) - 1)
    s = ((t - ends[i]) / (ends[i + 1] - ends[i]))[:, None]
    result = coefficients[i, -1]
    for k in range(coefficients.shape[1] - 2, -1, -1):
        result = result * s + coefficients[i, k]
    return np.asarray(result)


DESMOS = Format(
    endings=(".desmos.txt",),
    title="Desmos expressions",
    description="Expressions to paste into Desmos, one per line.",
    rank=130,
    options=(TOLERANCE,),
    write=desmos_expressions,
)
PATH_DATA = Format(
    endings=(".path.txt",),
    title="SVG path data",
    description="The d attributes of SVG paths.",
    rank=140,
    options=(TOLERANCE,),
    write=svg_path_data,
)
CSS = Format(
    endings=(".css",),
    title="CSS path",
    description="Clip paths of closed shapes and offset paths of open ones, in pixels of their box.",
    rank=145,
    options=(SVG_WIDTH, TOLERANCE),
    deviation_limit=1.5,  # three decimals
    write=css_shapes,
)
COEFFICIENTS = Format(
    endings=(".coefficients.json",),
    title="Polynomial coefficients",
    description="The coefficients of every polynomial piece, with the error of this form.",
    rank=150,
    write=coefficients_json,
)
