"""Curves as code: Python with NumPy, and with SciPy; JavaScript and GDScript, of a template each."""

from __future__ import annotations

import inspect
import keyword
import re
import unicodedata
from collections.abc import Callable, Iterable
from functools import partial
from string import Template
from typing import Any

import numpy as np

from curvecore import bezier_segments
from curvecore.arrays import FloatArray

from ...document.model import Document
from ...storage.resources import resource
from ...view_model.curve.curve_view import ParametricCurve
from .. import code_runtime
from ..exported_curves import (
    Beziers,
    ExportedCurve,
    accuracy,
    bezier_values,
    beziers_of,
    curves_of,
    largest_deviation,
    measured_deviation,
    one_line,
)
from ..options import DEFAULT, TOLERANCE, Options
from ..unique_names import UniqueNames
from . import ExportResult, Format

_RESERVED = (
    "np lagrange hermite evaluate pieces t interpolate case catch const debugger default delete do enum "
    "export extends false func function let match new null preload self signal static super switch this "
    "throw tool true typeof var void"
)
"""Names that mean something in one of the languages."""

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
    identifiers = identifiers_of(curve.name for curve in curves.curves)
    body, deviation = [inspect.getsource(function).rstrip() for function in _RUNTIME], 0.0
    for identifier, curve in zip(identifiers, curves, strict=True):
        rounding = [
            measured_deviation(piece, partial(_evaluate, [(piece.parameters, piece.jets)]))
            for piece in curve.polynomials.pieces
        ]
        deviation = max(deviation, max(rounding) + curve.polynomials.deviation)
        call = f"def {identifier}(t):\n    # {_title(curve)}\n    return evaluate({identifier.upper()}, t)"
        body.append(f"{_listing(identifier.upper(), curve)}\n\n\n{call}")
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
    identifiers = identifiers_of(curve.name for curve in curves.curves)
    body, deviation = list[str](), 0.0
    for identifier, curve in zip(identifiers, curves, strict=True):
        code, rounding = _scipy_object(identifier, curve)
        body.append(f"# {_title(curve)}\n{code}")
        deviation = max(deviation, rounding)
    imports = "import numpy as np\nfrom scipy import interpolate"
    text = "\n\n".join([_head(deviation, curves.remarks, imports), *body]) + "\n"
    return ExportResult(text, deviation, curves.remarks, is_bound=False)


# JavaScript and GDScript


_EACH = "$each\n"
"""Line of a template between the file and what is written for every curve."""


def javascript_code(document: Document, options: Options = DEFAULT) -> ExportResult:
    """Return a module of JavaScript that has a function of t for every curve; it returns [x, y].

    Raises
    ------
    ExchangeError
        If there is no curve to write.
    """
    return _by_template(document, options, "curves.js")


def gdscript_code(document: Document, options: Options = DEFAULT) -> ExportResult:
    """Return a script of Godot that has a function of t for every curve; y points down, as it does there.

    It returns a `Vector2` of single precision: the stated deviation includes that.

    Raises
    ------
    ExchangeError
        If there is no curve to write.
    """
    return _by_template(document, options, "curves.gd", y_sign=-1.0, unit_roundoff=2.0**-24)


def _by_template(
    document: Document, options: Options, name: str, y_sign: float = 1.0, unit_roundoff: float = 0.0
) -> ExportResult:
    """Return code by the template of that name in ``resources/code``.

    It has the Bézier pieces of every curve: its own, or cubics as `beziers_of` makes them.
    """
    curves, template = curves_of(document, options), resource("code", name).read_text(encoding="utf-8")
    head, entry = map(Template, template.split(_EACH))
    margin = template.partition("$pieces")[0].rpartition("\n")[2]
    body, parts = list[str](), list[Beziers]()
    for identifier, curve in zip(identifiers_of(c.name for c in curves.curves), curves, strict=True):
        paths = [beziers_of(piece, curves.tolerance) for piece in curve.core.pieces]
        controls = (part.control_points * (1.0, y_sign) + 0.0 for part in paths)
        pieces = f",\n{margin}".join(str(piece) for part in controls for piece in part.tolist())
        ends = [float(paths[0].parameters[0]), *(t for part in paths for t in part.parameters[1:].tolist())]
        body.append(
            entry.substitute(
                name=identifier, data=identifier.upper(), title=_title(curve), ends=ends, pieces=pieces
            )
        )
        parts += paths
    deviation, is_bound = largest_deviation(parts)
    deviation += 2**0.5 * unit_roundoff * max(float(np.abs(part.control_points).max()) for part in parts)
    note = " ".join([accuracy(deviation, is_bound), *map(one_line, curves.remarks)])
    return ExportResult(
        "\n".join([head.substitute(accuracy=note), *body]), deviation, curves.remarks, is_bound
    )


# Python


def identifiers_of(names: Iterable[str]) -> list[str]:
    """Return a different identifier for every name, like it, in the languages here and in CSS."""
    unique, identifiers = UniqueNames(between="_"), []
    for name in names:
        plain = unicodedata.normalize("NFKD", name).encode("ascii", "ignore").decode().lower()
        base = re.sub("[^a-z0-9]+", "_", plain).strip("_") or "curve"
        if base[0].isdigit() or keyword.iskeyword(base) or base in _RESERVED.split():
            base = f"curve_{base}"
        identifiers.append(unique.unique(base))
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
JAVASCRIPT = Format(
    endings=(".js",),
    title="JavaScript",
    description="A module with a function of t for each curve.",
    rank=92,
    options=(TOLERANCE,),
    write=javascript_code,
)
GDSCRIPT = Format(
    endings=(".gd",),
    title="GDScript",
    description="A script for Godot with a function of t for each curve; y points down.",
    rank=94,
    options=(TOLERANCE,),
    deviation_limit=1.1,  # a Vector2 has single precision
    write=gdscript_code,
)
