"""Curves as code: Python with NumPy, and with SciPy."""

from __future__ import annotations

import inspect
import keyword
import re
import unicodedata
from collections.abc import Callable, Iterable
from functools import partial
from typing import Any

import numpy as np

from curvecore import bezier_segments
from curvecore.arrays import FloatArray

from ...document.model import Document
from ...view_model.curve.curve_view import ParametricCurve
from .. import code_runtime
from ..exported_curves import ExportedCurve, accuracy, bezier_values, curves_of, measured_deviation, one_line
from ..options import DEFAULT, Options
from ..unique_names import UniqueNames
from . import ExportResult, Format

_RESERVED = {"np", "lagrange", "hermite", "evaluate", "pieces", "t", "interpolate"}

# The runtime has no annotations, so that everybody can read the export.
_RUNTIME: tuple[Callable[..., Any], ...] = (
    code_runtime.lagrange,
    code_runtime.hermite,
    code_runtime.evaluate,
)
_evaluate: Callable[..., FloatArray] = code_runtime.evaluate


def python_code(document: Document, options: Options = DEFAULT) -> ExportResult:
    """Return a module of Python, with NumPy alone, that has a function of t for every curve.

    The functions give the curves but for rounding: about 1e-15 of the size, more where the sum of
    |basis function times datum| is large.

    Raises
    ------
    ExchangeError
        If there is no curve to write.
    """
    curves = curves_of(document, options)
    identifiers = identifiers_of(curves.curves)
    body, deviation = [inspect.getsource(function).rstrip() for function in _RUNTIME], 0.0
    for identifier, curve in zip(identifiers, curves, strict=True):
        rounding = [
            measured_deviation(piece, partial(_evaluate, [(piece.parameters, piece.jets)]))
            for piece in curve.polynomials.pieces
        ]
        deviation = max(deviation, max(rounding) + curve.polynomials.deviation)
        body.append(f"{_listing(identifier.upper(), curve)}\n\n\n{_function(identifier, curve)}")
    text = "\n\n\n".join([_head(deviation, curves.remarks, "import numpy as np"), *body]) + "\n"
    return ExportResult(text, deviation, curves.remarks, is_bound=False)


def scipy_code(document: Document, options: Options = DEFAULT) -> ExportResult:
    """Return a module of Python that makes every curve an interpolator of SciPy, called with t.

    A Lagrange curve becomes a `BarycentricInterpolator`, whose error grows with the Lebesgue constant;
    a smooth cubic Hermite curve a `CubicHermiteSpline`; any other a `BPoly`. The stated deviation is that
    of the same formulas here.

    Raises
    ------
    ExchangeError
        If there is no curve to write.
    """
    curves = curves_of(document, options)
    identifiers = identifiers_of(curves.curves)
    body, deviation = list[str](), 0.0
    for identifier, curve in zip(identifiers, curves, strict=True):
        code, rounding = _scipy_object(identifier, curve)
        body.append(f"# {_title(curve)}\n{code}")
        deviation = max(deviation, rounding)
    imports = "import numpy as np\nfrom scipy import interpolate"
    text = "\n\n".join([_head(deviation, curves.remarks, imports), *body]) + "\n"
    return ExportResult(text, deviation, curves.remarks, is_bound=False)


def identifiers_of(curves: Iterable[ExportedCurve]) -> list[str]:
    """Return a different Python identifier for every curve, like its name."""
    names, identifiers = UniqueNames(between="_"), []
    for curve in curves:
        plain = unicodedata.normalize("NFKD", curve.name).encode("ascii", "ignore").decode().lower()
        base = re.sub("[^a-z0-9]+", "_", plain).strip("_") or "curve"
        if base[0].isdigit() or keyword.iskeyword(base) or base in _RESERVED:
            base = f"curve_{base}"
        identifiers.append(names.unique(base))
    return identifiers


def _head(deviation: float, remarks: tuple[str, ...], imports: str) -> str:
    # The deviation is rounding, which depends on t.
    lines = [accuracy(deviation, is_bound=False), *map(one_line, remarks)]
    return "\n".join([*(f"# {line}" for line in lines), "", imports])


def _title(curve: ExportedCurve) -> str:
    start, end = curve.core.domain
    family = curve.source.family.name.replace("_", " ")
    return f"{one_line(curve.name)}: {family}, t from {start!r} to {end!r}"


def _listing(name: str, curve: ExportedCurve) -> str:
    pieces = "".join(
        f"    (\n        {_array(piece.parameters, 8)},\n        {_array(piece.jets, 8)},\n    ),\n"
        for piece in curve.polynomials.pieces
    )
    return f"{name} = [\n{pieces}]"


def _function(name: str, curve: ExportedCurve) -> str:
    return f"def {name}(t):\n    # {_title(curve)}\n    return evaluate({name.upper()}, t)"


def _array(values: FloatArray, indent: int) -> str:
    """Return an array as code, one line for each of its rows; every float reads back as itself."""
    margin = " " * indent
    rows = "".join(f"{margin}    {row!r},\n" for row in values.tolist())
    return f"np.array([\n{rows}{margin}])"


def _scipy_object(name: str, curve: ExportedCurve) -> tuple[str, float]:
    """Return the code of a curve's interpolator, and the deviation of its formulas from the curve."""
    first, *others = pieces = curve.polynomials.pieces
    arrays, note = [first.parameters, first.points], ""
    if first.is_one_polynomial:
        kind = "BarycentricInterpolator"
        deviation = measured_deviation(first, lambda t: _barycentric(t, first.parameters, first.points))
    elif first.derivatives == 1 and not others:
        kind, arrays = "CubicHermiteSpline", [*arrays, first.jets[:, 1]]
        deviation = measured_deviation(first, lambda t: _local_powers(t, first))
    else:
        kind, note = "BPoly", "    # control points of every segment, (degree + 1, segments, 2)\n"
        controls = [bezier_segments(piece) for piece in pieces]
        joints = np.concatenate([first.breaks, *(piece.breaks[1:] for piece in others)])
        arrays = [np.concatenate(controls).swapaxes(0, 1), joints]
        deviation = max(
            measured_deviation(piece, partial(bezier_values, control_points, piece.breaks))
            for piece, control_points in zip(pieces, controls, strict=True)
        )
    listed = "".join(f"    {_array(values, 4)},\n" for values in arrays)
    return f"{name} = interpolate.{kind}(\n{note}{listed})", deviation + curve.polynomials.deviation


def _barycentric(t: FloatArray, parameters: FloatArray, points: FloatArray) -> FloatArray:
    """Return the second barycentric form, which SciPy uses (Berrut and Trefethen 2004, (4.2))."""
    differences = (parameters[:, None] - parameters) * (4.0 / (parameters[-1] - parameters[0]))
    np.fill_diagonal(differences, 1.0)
    weights = 1.0 / np.prod(differences, axis=1)
    distance = t[:, None] - parameters
    at_point = distance == 0
    ratios = weights / np.where(at_point, 1.0, distance)
    # At a point its weight alone counts.
    ratios = np.where(at_point.any(axis=1, keepdims=True), at_point, ratios)
    return np.asarray(ratios @ points / ratios.sum(axis=1, keepdims=True))


def _local_powers(t: FloatArray, piece: ParametricCurve) -> FloatArray:
    """Return the curve by powers of t - t_i, as `CubicHermiteSpline` computes it."""
    x, y, v = piece.parameters, piece.points, piece.jets[:, 1]
    h = np.diff(x)[:, None]
    slope = np.diff(y, axis=0) / h
    bend = (v[:-1] + v[1:] - 2 * slope) / h
    c3, c2 = bend / h, (slope - v[:-1]) / h - bend
    i = np.clip(np.searchsorted(x, t, side="right") - 1, 0, len(x) - 2)
    u = (t - x[i])[:, None]
    return np.asarray(((c3[i] * u + c2[i]) * u + v[:-1][i]) * u + y[:-1][i])


PYTHON = Format(
    endings=(".py",),
    title="Python with NumPy",
    description="A program that computes the curves and needs only NumPy.",
    rank=80,
    write=python_code,
)
SCIPY = Format(
    endings=(".scipy.py",),
    title="Python with SciPy",
    description="The curves as objects of scipy.interpolate.",
    rank=90,
    write=scipy_code,
)
