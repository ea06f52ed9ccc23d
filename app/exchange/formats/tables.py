"""Tables: text and NumPy arrays are read; points with derivatives, and samples along curves, are written."""

from __future__ import annotations

import io
from collections.abc import Iterator, Mapping
from functools import partial
from math import inf, isnan, nan
from typing import Any

import numpy as np
import numpy.typing as npt

from curvecore import ArcLength, curvature_error, flatten_pieces
from curvecore.arrays import FloatArray
from curvecore.bezier.flatten import segment_distance

from ...document.derivatives import DERIVATIVES
from ...document.model import Document
from ...document.words import NamedEnum, count_of
from ...tasks.progress import Report, part
from ...view_model.arc_lengths import arc_lengths_of
from ...view_model.curve.curve_view import CurveView, ParametricCurve, view_of
from ..errors import ExchangeError
from ..exported_curves import cell_of_name, cell_of_number, curves_of
from ..options import DEFAULT, TOLERANCE, OneOf, Option, Options, SomeOf, Whole
from ..table.columns import AFTER, ROLES, WORDS, family_cell, numbered_titles
from ..table.table import MAX_COLUMNS, MAX_ROWS, Table, table_of
from . import ContentKind, ExportResult, Format

_HEADERS = {(1, 0): np.lib.format.read_array_header_1_0, (2, 0): np.lib.format.read_array_header_2_0}
_SHAPES = (
    "rows of 2 or more numbers (n, 2), a curve for each (k, n, 2), complex numbers (n,), or a structured "
    "array with names"
)


def read_array(data: bytes) -> Table:
    """Return the numbers of an .npy file as a table.

    Raises
    ------
    ExchangeError
        If it is invalid, contains objects (pickles are never loaded), or has no shape of a table.
    """
    array = _array(data)
    titles: tuple[str, ...] = ()
    if array.dtype.names is not None:
        titles = array.dtype.names
        array = _fields(array)
    elif array.dtype.kind == "c" and array.ndim == 1:
        array = np.column_stack([array.real, array.imag])
    if array.dtype.kind not in "fiub":
        raise ExchangeError(f"The array contains {array.dtype}, not real numbers.")
    blocks: tuple[int, ...] = ()
    if array.ndim == 3 and 0 not in array.shape:
        blocks = tuple(range(array.shape[1], array.shape[0] * array.shape[1], array.shape[1]))
        array = array.reshape(-1, array.shape[2])
    if array.ndim != 2 or array.shape[1] < 2:
        raise ExchangeError(f"The array has the shape {array.shape}; it can be {_SHAPES}.")
    remark = ""
    if array.shape[0] in (2, 3) and array.shape[1] > array.shape[0] + 1 and not blocks:
        array, remark = array.T, "The rows of the array were read as columns."
    return table_of(
        array.astype(float), titles or numbered_titles(array.shape[1]), blocks=blocks, remark=remark
    )


def _array(data: bytes) -> npt.NDArray[Any]:
    """Return the array without a copy; NumPy's own reader would allocate whatever the header claims."""
    file = io.BytesIO(data)
    try:
        version = np.lib.format.read_magic(file)
        shape, is_fortran, dtype = _HEADERS[version](file)
    except KeyError:
        raise ExchangeError("The version of the .npy file is not supported. Save the array again.") from None
    except Exception:
        # The header is Python syntax: whatever its parser raises, this is not an array.
        raise ExchangeError("This is not a .npy file, or its header is damaged.") from None
    if dtype.hasobject:
        raise ExchangeError("The array contains Python objects, which are never loaded. Save it as numbers.")
    count = int(np.prod([int(part) for part in shape], dtype=object))
    if count > MAX_ROWS * MAX_COLUMNS:
        raise ExchangeError(f"The array has {count:,} numbers, more than {MAX_ROWS * MAX_COLUMNS:,}.")
    if count * dtype.itemsize != len(data) - file.tell():
        raise ExchangeError("The size of the .npy file does not match its header.")
    flat = np.frombuffer(data, dtype, count, file.tell())
    return flat.reshape(shape, order="F" if is_fortran else "C")


def _fields(array: npt.NDArray[Any]) -> npt.NDArray[Any]:
    assert array.dtype.names is not None
    columns = [array[name] for name in array.dtype.names]
    if array.ndim != 1 or any(column.ndim != 1 or column.dtype.kind not in "fiub" for column in columns):
        raise ExchangeError("A structured array must have one number for each name and row.")
    return np.column_stack([column.astype(float) for column in columns])


TEXT_TABLE = Format(
    endings=(".csv", ".tsv", ".txt", ".dat"),
    title="Table",
    rank=60,
    kind=ContentKind.TABLE,
)
NPY = Format(
    endings=(".npy",),
    title="NumPy array",
    rank=61,
    kind=ContentKind.TABLE,
    read=read_array,
)


# Points


def points_table(document: Document, options: Options = DEFAULT) -> ExportResult:
    """Return the points of all visible curves, a row each; read back, they give curves of the same shape.

    Tabs separate the cells of a file whose name ends in .tsv, commas those of any other.

    Derivatives are those in force, including estimated ones. Those after a corner have columns of their
    own. The last row of a closed curve is its first point again, with the parameter at which it
    returns there.

    Raises
    ------
    ExchangeError
        If there is no curve.
    """
    separator = "\t" if options.path.lower().endswith(".tsv") else ","
    curves = curves_of(document, options)
    titles = (*ROLES, *AFTER)
    rows = []
    for curve in curves:
        words = [cell_of_name(curve.line_name, separator), family_cell(curve.source)]
        rows += [(words, row) for row in _rows(view_of(curve.source))]
    used = [k for k in range(len(titles)) if any(not isnan(row[k]) for _, row in rows)]
    lines = [separator.join([*WORDS, *(titles[k] for k in used)])]
    lines += [separator.join([*words, *(cell_of_number(row[k]) for k in used)]) for words, row in rows]
    return ExportResult("\n".join(lines) + "\n", 0.0, curves.remarks)


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
        rows.append((curve.interval[1], first.x, first.y, *empty))
    return rows


def _derivatives(view: CurveView, index: int, *, ahead: bool) -> list[float]:
    """Return the derivatives on one side of a point, by their orders; NaN where there is none."""
    vectors = (view.derivative_of(index, derivative.order, ahead=ahead) for derivative in DERIVATIVES)
    return [number for vector in vectors for number in vector or (nan, nan)]


POINTS_TABLE = Format(
    endings=(".points.csv", ".points.tsv"),
    title="Table of points (CSV)",
    description="The points with their derivatives. Imported again, they give the same curves.",
    rank=70,
    write=points_table,
)


# Samples

MOST_SAMPLES = 1_000_000

_DERIVATIVES = tuple(f"{derivative.letter}{axis}" for derivative in DERIVATIVES for axis in "xy")
TITLES = ("t", "x", "y", "vx", "vy", "ax", "ay", "curvature", "length")
"""The default columns of a table."""

_ALL = ("t", "x", "y", *_DERIVATIVES, "curvature", "length")


class Spacing(NamedEnum):
    """Spacing of samples along a curve."""

    T = "t", "equal steps of t"
    LENGTH = "length", "equal arc lengths"
    TOLERANCE = "tolerance", "as the tolerance requires"


SPACING = OneOf(
    name="spacing",
    label="Samples",
    tip="Spacing of the rows along each curve",
    default=Spacing.T,
    choices={spacing: spacing.label for spacing in Spacing},
    flag="--by",
    help="table of samples: equal steps of t or of the arc length, or as many rows as the tolerance requires",
)
SAMPLES = Whole(
    name="samples",
    label="Rows",
    title="Number of samples",
    tip="Number of rows per curve",
    default=201,
    limits=(2, MOST_SAMPLES),
    help="table of samples: rows per curve (default: %(default)s)",
)
COLUMNS = SomeOf(
    name="columns",
    label="Columns",
    tip="Write the column {}",
    widget="exportColumn_{}",
    default=TITLES,
    choices=_ALL,
    needed="A table needs at least one column.",
)

_ROWS_AT_ONCE = 2_000
_LENGTH, _CURVATURE = _ALL.index("length"), _ALL.index("curvature")
_UNSURE = 1e-3
"""Share of a curvature by which rounding may change it without a word."""
_STRAIGHT = 1e-6
"""Share of 1 / size below which a curvature counts as none."""
_LENGTH_ACCURACY = 1e-9


def sampled_table(document: Document, options: Options = DEFAULT, separator: str = ",") -> ExportResult:
    """Return the curves as a table; with several, the first column is the curve's name.

    There are equal steps of t, of the arc length, or as many samples as a polyline within the tolerance
    needs, as `SPACING` says. Numbers have a decimal point whatever the locale. The deviation is that of the
    polyline through the samples.

    Raises
    ------
    ExchangeError
        If there is no curve, or the number of samples is out of range.
    """
    if not 2 <= options[SAMPLES] <= MOST_SAMPLES:
        raise ExchangeError(f"A table can have 2 to {MOST_SAMPLES} samples.")
    curves = curves_of(document, options)
    remarks, columns, has_names = curves.remarks, _columns(options[COLUMNS]), len(curves.curves) > 1
    titles, tolerance = [_ALL[column] for column in columns], curves.tolerance
    lines, deviation, unsure = [separator.join(["curve", *titles] if has_names else titles)], 0.0, 0
    for curve, report in curves.with_reports():
        lead = cell_of_name(curve.line_name, separator) + separator if has_names else ""
        for rows, missed in _samples_of(curve.core, options, tolerance, _LENGTH in columns, report):
            deviation = max(deviation, missed)
            if _CURVATURE in columns and not curve.core.difference_digits:
                size = np.maximum(np.abs(rows[:, _CURVATURE]), _STRAIGHT / max(curve.size, 1e-300))
                unsure += int(np.count_nonzero(curvature_error(curve.core, rows[:, 0]) > _UNSURE * size))
            lines += [lead + separator.join(map(cell_of_number, row)) for row in rows[:, columns].tolist()]
    if unsure:
        rows_unsure = count_of(unsure, "row")
        remarks = (*remarks, f"In {rows_unsure} rounding may change the curvature by more than a thousandth.")
    return ExportResult("\n".join(lines) + "\n", deviation, remarks, is_bound=False)


def _samples_of(
    core: ParametricCurve, options: Options, allowed: float, with_lengths: bool, report: Report
) -> Iterator[tuple[FloatArray, float]]:
    """Yield the rows of a curve, some at a time, with the deviation of the polyline through them."""
    report(0.0, "Computing samples")
    needed = with_lengths or options[SPACING] is Spacing.LENGTH
    lengths = arc_lengths_of(core, _LENGTH_ACCURACY) if needed else None
    t, bound = _parameters_of(core, options, allowed, lengths, part(report, 0.0, 0.5))
    for first in range(0, len(t) - 1, _ROWS_AT_ONCE):
        report(0.5 + 0.5 * first / len(t), "Computing samples")
        # The last sample of a part is the first of the next.
        some = t[first : first + _ROWS_AT_ONCE + 1]
        missed = polyline_deviation(core, some) if bound is None else bound
        yield _rows_of(core, some, lengths)[1 if first else 0 :], missed


def _columns(titles: tuple[str, ...]) -> list[int]:
    """Return the indices of the selected columns, in their usual order."""
    if not titles or not set(titles) <= set(_ALL):
        raise ExchangeError(f"A table can have the columns {', '.join(_ALL)}; at least one is needed.")
    return [column for column, title in enumerate(_ALL) if title in titles]


def _parameters_of(
    core: ParametricCurve, options: Options, tolerance: float, lengths: ArcLength | None, report: Report
) -> tuple[FloatArray, float | None]:
    """Return the parameters to sample a curve at, both ends of its domain among them.

    The second value is a bound of the deviation of the polyline through the samples, None where that is
    to be measured. A tolerance that needs more vertices than a polyline can have is not reached, as the
    bound tells.
    """
    samples, spacing = options[SAMPLES], options[SPACING]
    if spacing is Spacing.TOLERANCE:
        pieces = flatten_pieces(core, tolerance)
        return pieces.parameters, pieces.reached
    if lengths is not None and spacing is Spacing.LENGTH:
        return _by_length(core, lengths, samples, report), None
    start, end = core.domain
    return np.append(start + (end - start) * (np.arange(samples - 1) / (samples - 1)), end), None


def _rows_of(core: ParametricCurve, t: FloatArray, lengths: ArcLength | None) -> FloatArray:
    """Return the columns of `_ALL` at parameters t (m,), one row each.

    Curvature is positive where the curve turns to the left, and NaN at a point at rest; the length counts
    from the beginning of the curve, and is NaN where none are wanted. At a corner the values are those
    after it.
    """
    orders = [core.evaluate(t, order) for order in range(len(DERIVATIVES) + 1)]
    _, velocity, acceleration, *_ = orders
    with np.errstate(all="ignore"):
        cross = velocity[:, 0] * acceleration[:, 1] - velocity[:, 1] * acceleration[:, 0]
        curvature = cross / np.hypot(*velocity.T) ** 3
    length = lengths.length_at(t) if lengths is not None else np.full(len(t), np.nan)
    return np.column_stack([t, *orders, curvature, length])


def polyline_deviation(core: ParametricCurve, t: FloatArray) -> float:
    """Return about the largest distance of a curve from its chords between the parameters t (m,).

    Measured at nine parameters a part, its ends included, and parts end at the curve's own parameters, too.
    For what lies between the nine, an eighth of the largest second difference is added, continued linearly to
    the ends: of cubic pieces that is a bound.
    """
    inner = core.parameters[(core.parameters > t[0]) & (core.parameters < t[-1])]
    cuts = np.unique(np.concatenate([t, inner]))
    # Both ends of a part: the farthest point may lie just before a joint.
    nine = core.evaluate(np.linspace(cuts[:-1], cuts[1:], 9, axis=1).ravel()).reshape(-1, 9, 2)
    ends, chord = core.evaluate(t), np.searchsorted(t, cuts[:-1], side="right") - 1
    with np.errstate(all="ignore"):
        distance = segment_distance(nine, ends[chord, None], ends[chord + 1, None])
        second = np.diff(nine, n=2, axis=1)
        at_ends = 2 * second[:, [0, -1]] - second[:, [1, -2]]
        bend = np.hypot(*np.concatenate([second, at_ends], axis=1).T).max(axis=0) / 8
    return float((distance.max(axis=1) + bend).max())


def _by_length(core: ParametricCurve, lengths: ArcLength, samples: int, report: Report) -> FloatArray:
    """Return parameters at equal arc lengths."""
    if not lengths.total.error < lengths.total.value < np.finfo(float).max:
        raise ExchangeError("The curve has no length.")
    wanted = lengths.total.value * (np.arange(1, samples - 1) / (samples - 1))
    t = [core.parameters[:1]]
    for first in range(0, len(wanted), _ROWS_AT_ONCE):
        report(first / len(wanted), "Dividing the length")
        t.append(lengths.parameter_at(wanted[first : first + _ROWS_AT_ONCE]))
    return np.unique(np.concatenate([*t, core.parameters[-1:]]))


def _hidden(values: Mapping[str, Any]) -> tuple[Option[Any]]:
    """Return the option that does not matter: the count where the tolerance says it, or else that."""
    return (SAMPLES if values[SPACING.name] is Spacing.TOLERANCE else TOLERANCE,)


_samples = partial(
    Format,
    rank=50,
    options=(TOLERANCE, SPACING, SAMPLES, COLUMNS),
    hidden=_hidden,
    deviation_limit=inf,  # as many rows as requested
)
CSV = _samples(
    endings=(".csv",),
    title="Table of samples (CSV)",
    description="Numbers along each curve, with commas between them.",
    write=sampled_table,
)
TSV = _samples(
    endings=(".tsv",),
    title="Table of samples (TSV)",
    description="Numbers along each curve, with tabs between them.",
    write=partial(sampled_table, separator="\t"),
)
