"""The curves of a document that a file can hold, and their pieces: the source of every writer of data.

A writer loops over `curves_of(document, options)`, which knows what is left out and reports the progress.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from math import isnan
from typing import NamedTuple

import numpy as np

from curvecore import (
    CurveError,
    HermiteCurve,
    Interpolant,
    LagrangeCurve,
    QuinticHermiteCurve,
    SepticHermiteCurve,
    bezier_segments,
    cubic_path,
)
from curvecore.arithmetic import LARGEST
from curvecore.arrays import FloatArray
from curvecore.bezier.control_points import CubicPath

from .. import __version__
from ..document.model import Curve, Document
from ..document.words import rounded_up
from ..tasks.progress import Report, part
from ..view_model.cubics import RELATIVE_TOLERANCE
from ..view_model.curve.core_curve import in_words
from ..view_model.curve.curve_view import ParametricCurve
from .drawing.drawing import drawable_curves
from .errors import ExchangeError
from .options import DEFAULT, Options, automatic_tolerance
from .unique_names import UniqueNames

HIGHEST_DEGREE = 10
"""Highest degree of a Lagrange curve that is written as one Bézier piece; beyond, as cubics."""

_SAMPLES = 33

_SAMPLES_AT_ONCE = 500
"""Samples at which a copy is evaluated at once: one polynomial takes an array of these by all its points."""


class Deviation(NamedTuple):
    """A largest distance, and whether it is a bound: otherwise it was measured at many parameters."""

    deviation: float
    is_bound: bool = True


class Polynomials(NamedTuple):
    """Pieces that are polynomials through known data.

    Attributes
    ----------
    pieces
        Pieces of the curve in a family that all writers know, or cubic Hermite curves that follow
        them.
    deviation, is_bound
        Largest distance of the pieces from the curve, and whether it is a bound.
    """

    pieces: tuple[ParametricCurve, ...]
    deviation: float
    is_bound: bool = True


@dataclass(frozen=True, eq=False)
class ExportedCurve:
    """A curve of the document that can be written.

    Attributes
    ----------
    source
        The document's value, as in `CurveView`.
    core
        The curve of the core, a chain of pieces where the curve has corners.
    line_name
        The name on one line, with a number where another curve has the same.
    """

    source: Curve
    core: ParametricCurve
    line_name: str

    @cached_property
    def polynomials(self) -> Polynomials:
        """The curve as formulas and code write it."""
        tolerance = RELATIVE_TOLERANCE * max(self.size, 1e-300)
        exact = _known_curves(self.core.pieces)
        if exact:
            worst = max(_deviation(*both) for both in zip(exact, self.core.pieces, strict=True))
            if worst <= tolerance:
                return Polynomials(exact, worst, is_bound=not worst)
        paths = [cubics_of(piece, tolerance) for piece in self.core.pieces]
        return Polynomials(tuple(map(_spline_of, paths)), *largest_deviation(paths))

    @cached_property
    def formulas(self) -> Polynomials:
        """The curve as formulas write it: by its own control points, where it has some."""
        pieces = self.core.pieces
        if any(piece.interpolates or _controls_of(piece) is None for piece in pieces):
            return self.polynomials
        return Polynomials(pieces, 0.0)

    @property
    def name(self) -> str:
        """The curve's name."""
        return self.source.name

    @property
    def size(self) -> float:
        """The larger side of the box around the points."""
        return float(np.ptp(self.core.points, axis=0).max())


@dataclass(frozen=True, eq=False)
class Beziers:
    """A curve as Bézier pieces of one degree.

    Attributes
    ----------
    control_points
        (k, degree + 1, 2).
    parameters
        Parameters of the ends of the pieces, (k + 1,).
    deviation, is_bound
        Largest distance from the curve, zero where the pieces are the curve itself but for rounding; and
        whether it is a bound.
    """

    control_points: FloatArray
    parameters: FloatArray
    deviation: float
    is_bound: bool = True

    @property
    def degree(self) -> int:
        """The degree of every piece."""
        return int(self.control_points.shape[1]) - 1


def largest_deviation(parts: Iterable[Beziers | Deviation]) -> Deviation:
    """Return the largest of deviations; it is a bound if all of them are."""
    deviations, bounds = zip(*((part.deviation, part.is_bound) for part in parts), strict=True)
    return Deviation(max(deviations), all(bounds))


@dataclass(frozen=True, eq=False)
class ExportedCurves:
    """The visible curves of a document that can be written; the loop over them reports the progress.

    Attributes
    ----------
    curves
        At least one.
    remarks
        A sentence for each curve that is left out.
    options
        Options of the export.
    document
        The document that they are of.
    """

    curves: tuple[ExportedCurve, ...]
    remarks: tuple[str, ...]
    options: Options
    document: Document

    def __iter__(self) -> Iterator[ExportedCurve]:
        for curve, report in self.with_reports():
            report(0.0, "Writing")
            yield curve

    def with_reports(self) -> Iterator[tuple[ExportedCurve, Report]]:
        """Yield each curve with a report for its share of the second half of the work."""
        count = len(self.curves)
        half = part(self.options.report, 0.5, 1.0)
        for index, curve in enumerate(self.curves):
            yield curve, part(half, index / count, (index + 1) / count)

    @property
    def tolerance(self) -> float:
        """The largest deviation allowed, by default `automatic_tolerance`.

        Raises
        ------
        ExchangeError
            Unless it is positive and finite.
        """
        tolerance = self.options.tolerance
        if tolerance is None:
            tolerance = automatic_tolerance(self.document)
        if not 0 < tolerance < np.inf:
            raise ExchangeError("The tolerance must be a positive number.")
        return tolerance


def curves_of(document: Document, options: Options = DEFAULT) -> ExportedCurves:
    """Return the visible curves that can be written; to compute them is half of the work.

    Raises
    ------
    ExchangeError
        If there is none.
    """
    hidden = dict.fromkeys(curve.display_name for curve in document.curves if not curve.visible)
    usable, unusable = drawable_curves(document, part(options.report, 0.0, 0.5))
    remarks = (*(f"“{name}” is hidden." for name in hidden), *unusable)
    if not usable:
        raise ExchangeError(f"There is nothing to export. {' '.join(remarks)}")
    names = UniqueNames()
    curves = tuple(
        ExportedCurve(source, core, names.unique(" ".join(source.name.split()) or "Curve"))
        for source, core in usable
    )
    return ExportedCurves(curves, remarks, options, document)


def deviation_text(deviation: float, is_bound: bool) -> str:
    """Return a deviation as it is stated in files: with three digits, and "about" unless it is a bound."""
    return f"{'' if is_bound or not deviation else 'about '}{rounded_up(deviation, 3):g}"


def accuracy(deviation: float, is_bound: bool) -> str:
    """Return the sentence on the deviation of a file from the true curves."""
    text = deviation_text(deviation, is_bound)
    return (
        f"Curvebench {__version__}. Largest deviation from the true curves: {text}, "
        "in the unit of the document."
    )


def one_line(text: str) -> str:
    """Return text for a comment: on one line, with printable characters only."""
    return "".join(char if char.isprintable() else " " for char in text).encode("utf-8", "replace").decode()


def cell_of_name(name: str, separator: str) -> str:
    """Return a name as a cell of a table."""
    # A spreadsheet would run a name that begins like a formula; the sign is removed again when read.
    name = f"'{name}" if name[:1] in ("=", "+", "-", "@", "'") else name
    quoted = name.replace('"', '""')
    return f'"{quoted}"' if separator in name or '"' in name or "#" in name else quoted


def cell_of_number(value: float) -> str:
    """Return a number as a cell of a table; nothing for NaN."""
    return "" if isnan(value) else repr(value + 0.0)


def samples_of(piece: ParametricCurve) -> FloatArray:
    """Return parameters all along a piece, those of the points among them."""
    t = piece.parameters
    steps = np.diff(t)[:, None] * np.linspace(0, 1, _SAMPLES)[1:-1]
    return np.union1d(t, (t[:-1, None] + steps).ravel())


def measured_deviation(piece: ParametricCurve, copy: Callable[[FloatArray], FloatArray]) -> float:
    """Return the largest distance of `copy`, a function of t, from a piece at many parameters: no bound."""
    t = samples_of(piece)
    starts = range(_SAMPLES_AT_ONCE, len(t), _SAMPLES_AT_ONCE)
    with np.errstate(all="ignore"):
        copied = np.concatenate([copy(some) for some in np.split(t, starts)])
        distance = np.hypot(*(copied - piece.evaluate(t)).T)
    return float(np.where(np.isfinite(distance), distance, np.inf).max())


def beziers_of(piece: ParametricCurve, tolerance: float) -> Beziers:
    """Return the Bézier pieces of a curve: of its own degree, or cubics within a tolerance.

    Polynomials up to degree `HIGHEST_DEGREE` are written exactly but for rounding.

    Raises
    ------
    ExchangeError
        If the control points are out of range.
    """
    if piece.bezier_pieces() is not None:
        result = Beziers(bezier_segments(piece), piece.breaks, 0.0)
    elif (controls := _controls_of(piece)) is not None:
        ends = piece.breaks
        rounding = measured_deviation(piece, lambda t: bezier_values(controls, ends, t))
        result = Beziers(controls, ends, rounding, is_bound=False)
    else:
        result = cubics_of(piece, tolerance)
    if not (np.abs(result.control_points) < LARGEST).all():
        raise ExchangeError("The curve is out of range between its points.")
    return result


def _controls_of(piece: ParametricCurve) -> FloatArray | None:
    """Return the Bézier control points of polynomial pieces up to `HIGHEST_DEGREE`, None of others."""
    is_low = piece.degree is not None and piece.degree <= HIGHEST_DEGREE
    return piece.exact_pieces() if is_low else None


def _known_curves(pieces: tuple[ParametricCurve, ...]) -> tuple[ParametricCurve, ...]:
    """Return curves of one family that all writers know, with the interpolants of the pieces, or none."""
    for kind in (LagrangeCurve, HermiteCurve, QuinticHermiteCurve, SepticHermiteCurve):
        known = (_known_curve(kind, piece.interpolants()) for piece in pieces)
        curves = [curve for curve in known if curve is not None]
        if len(curves) == len(pieces):
            return tuple(curves)
    return ()


def _known_curve(kind: type[ParametricCurve], data: list[Interpolant] | None) -> ParametricCurve | None:
    """Return the curve of a family that has the same interpolants; None where there is none."""
    if not data or any(datum.jets.shape[1] != kind.derivatives + 1 for datum in data):
        return None
    parameters, first = np.unique(np.concatenate([datum.parameters for datum in data]), return_index=True)
    curve = kind.from_jets(np.concatenate([datum.jets for datum in data])[first], parameters)
    actual = curve.interpolants() or []
    pairs = [both for parts in zip(actual, data, strict=False) for both in zip(*parts, strict=True)]
    return curve if len(actual) == len(data) and all(np.array_equal(*both) for both in pairs) else None


def _deviation(curve: ParametricCurve, piece: ParametricCurve) -> float:
    """Return the distance of a curve from the piece that it stands for: 0 where both are the same."""
    is_same = type(curve) is type(piece) and np.array_equal(curve.jets, piece.jets)
    return 0.0 if is_same else measured_deviation(piece, curve.evaluate)


def _spline_of(path: Beziers) -> HermiteCurve:
    """Return cubic Bézier pieces with common tangents as a cubic Hermite curve."""
    controls, h = path.control_points, np.diff(path.parameters)[:, None]
    velocities = 3.0 * np.concatenate([(controls[:, 1] - controls[:, 0]) / h, [[0.0, 0.0]]])
    velocities[-1] = 3.0 * (controls[-1, 3] - controls[-1, 2]) / h[-1]
    return HermiteCurve(np.concatenate([controls[:, 0], controls[-1:, 3]]), velocities, path.parameters)


def cubics_of(
    piece: ParametricCurve,
    tolerance: float,
    follow: Callable[[ParametricCurve, float], CubicPath] = cubic_path,
) -> Beziers:
    """Return cubic Bézier pieces within a tolerance, which keep the speed of the curve or only its shape."""
    try:
        path = follow(piece, tolerance)
    except CurveError as problem:
        raise ExchangeError(f"The curve cannot be written: {in_words(str(problem))}.") from problem
    return Beziers(path.control_points, path.parameters, float(path.deviation), path.is_bound)


def bezier_values(controls: FloatArray, parameters: FloatArray, t: FloatArray) -> FloatArray:
    """Return the points (m, 2) of Bézier pieces at t, by de Casteljau's scheme."""
    index = np.clip(np.searchsorted(parameters, t, side="right") - 1, 0, len(controls) - 1)
    start, end = parameters[index], parameters[index + 1]
    s = ((t - start) / (end - start))[:, None, None]
    level = controls[index]
    while level.shape[1] > 1:
        level = (1 - s) * level[:, :-1] + s * level[:, 1:]
    return np.asarray(level[:, 0])
