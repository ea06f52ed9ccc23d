"""Tables in: columns of numbers become curves, all rows of them or as few as a tolerance takes."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from curvecore.arrays import FloatArray, IntArray

from ...document.constraints import tie_if_parallel
from ...document.derivatives import DERIVATIVES, VECTORS
from ...document.model import Curve, Document, Parametrization, ParametrizationKind, Point, Vector
from ...document.words import NamedEnum
from ...families import HERMITE, NO_SETTINGS, Family, FamilySettingValues
from ...storage.format_error import FormatError
from ...storage.validation import validate
from ...tasks.progress import Report, part, silent
from ..cubics_in import ImportResult
from ..errors import ExchangeError
from ..unique_names import numbered
from .columns import AFTER, ROLES, ColumnMapping, FamilyCell, read_family_cell
from .table import MissingNumber, RowProblem, Table
from .thinning import Thinning, thin_out

MOST_CURVES = 1_000

_ROWS_AT_ONCE = 5_000
Group = tuple[str, IntArray]
"""The name of a curve and the places of its rows."""


class MissingRows(NamedEnum):
    """Treatment of rows without a number for t, x or y."""

    REFUSE = "refuse", "Report an error"
    SKIP = "skip", "Skip them"
    SPLIT = "split", "End the curve there"


_PAIRS = {
    name: (f"{derivative.letter}x{after}", f"{derivative.letter}y{after}")
    for derivative in DERIVATIVES
    for name, after in ((derivative.name, ""), (derivative.after, "_after"))
}
"""The columns of the fields of a point."""


@dataclass(frozen=True)
class TableOptions:
    """Options of the curves through the rows of a table.

    Attributes
    ----------
    family
        Family of the curves, unless a column names one. Derivatives that it does not have are
        left out; where a pair of cells is empty, they are estimated.
    settings
        Settings of that family other than its defaults.
    name
        Name of the curve, unless a column has one.
    thin
        None to keep every row; otherwise the rows are thinned out, and the curves are cubic Hermite curves.
    thinning
        The line that stays within that distance of every row.
    missing
        Whether rows without a number are refused, left out, or where a curve ends and the next begins.
    """

    family: Family = HERMITE
    settings: FamilySettingValues = NO_SETTINGS
    name: str = "Table"
    thin: float | None = None
    thinning: Thinning = Thinning.CURVE
    missing: MissingRows = MissingRows.REFUSE


def document_of_table(
    table: Table, mapping: ColumnMapping, options: TableOptions, *, report: Report = silent
) -> ImportResult:
    """Return the curves through the rows of a table, with their deviation and remarks.

    There is one curve, or one for each name in the column of names, and one for each block of rows. Where
    there is no column of parameters, rows that repeat the point before become one point with it.

    Raises
    ------
    ExchangeError
        If the rows cannot be the points of a curve, with the row.
    """
    columns = _columns_of(table, mapping)
    all_groups = _groups(table, mapping, options.name)
    groups = _numbered(_without_missing(table, columns, all_groups, options.missing))
    curves, deviation, repeats, first_repeat = [], 0.0, 0, 0
    for index, (title, rows) in enumerate(groups):
        curve_rows = _Rows(table, columns, rows)
        repeated = curve_rows.repeats
        if len(repeated):
            repeats, first_repeat = (
                repeats + len(repeated),
                first_repeat or curve_rows.line_of(int(repeated[0])),
            )
        if curve_rows.t is None:
            # Without t the parameters follow the distances, which must not be 0.
            curve_rows = curve_rows.without(repeated)
        share = part(report, index / len(groups), (index + 1) / len(groups))
        if options.thin is None:
            word = _word_of(table, mapping, rows, options)
            curves.append(_full_curve(title, curve_rows, word, share))
        else:
            result = thin_out(curve_rows.points, curve_rows.t, options.thin, options.thinning, report=share)
            curves.append(_thinned_curve(title, curve_rows, result.rows, result.parameters))
            deviation = max(deviation, result.deviation)
    remarks = _on_repeats(repeats, first_repeat, stay="t" in columns)
    return ImportResult(_checked(curves), deviation, remarks)


def _columns_of(table: Table, mapping: ColumnMapping) -> dict[str, int]:
    """Return the columns of numbers that a mapping names, by their roles."""
    columns = mapping.columns((*ROLES, *AFTER))
    for role, column in columns.items():
        if not 0 <= column < table.values.shape[1]:
            raise ExchangeError(f"There is no column {column + 1} for {role}.")
    return columns


def _groups(table: Table, mapping: ColumnMapping, name: str) -> list[Group]:
    """Return the name and the rows of each curve, in the order in which they begin."""
    if mapping.curve is None or mapping.curve not in table.words:
        blocks = np.split(np.arange(len(table.values)), table.blocks)
        return [(name, rows) for rows in blocks]
    numbers: dict[str, int] = {}
    group = np.array([numbers.setdefault(word, len(numbers)) for word in table.words[mapping.curve]])
    order = np.argsort(group, kind="stable")
    ends = np.cumsum(np.bincount(group))[:-1]
    return [
        (title.removeprefix("'") or name, rows)
        for title, rows in zip(numbers, np.split(order, ends), strict=True)
    ]


def _without_missing(
    table: Table, columns: dict[str, int], groups: list[Group], missing: MissingRows
) -> list[Group]:
    """Return the groups without rows that lack t, x or y, or split at these rows."""
    if missing is MissingRows.REFUSE:
        return groups
    needed = [column for role, column in columns.items() if role in ("t", "x", "y")]
    is_whole = np.asarray(np.isfinite(table.values[:, needed]).all(axis=1))
    result: list[Group] = []
    for title, rows in groups:
        whole = np.flatnonzero(is_whole[rows])
        ends = np.flatnonzero(np.diff(whole) > 1) + 1 if missing is MissingRows.SPLIT else whole[:0]
        # A single remaining row is not a curve.
        result += [(title, rows[part]) for part in np.split(whole, ends) if len(part) > 1]
    if not result:
        raise ExchangeError("No two consecutive rows contain numbers.")
    return result


def _numbered(groups: list[Group]) -> list[Group]:
    """Return the groups, with numbers for those of one name."""
    if len(groups) > MOST_CURVES:
        raise ExchangeError(f"The table contains {len(groups)} curves; at most {MOST_CURVES} can be read.")
    titles = numbered([title for title, _ in groups])
    return [(title, rows) for title, (_, rows) in zip(titles, groups, strict=True)]


def _word_of(table: Table, mapping: ColumnMapping, rows: IntArray, default: TableOptions) -> FamilyCell:
    """Return the family of the curve through some rows, from its cell or by default."""
    if mapping.family is None or mapping.family not in table.words:
        return FamilyCell(default.family, settings=default.settings)
    first = int(rows[0])
    try:
        return read_family_cell(table.words[mapping.family][first])
    except ValueError as problem:
        raise RowProblem(f" must be {problem}.", table.line_of(first), mapping.family + 1) from None


def _on_repeats(count: int, first: int, *, stay: bool) -> tuple[str, ...]:
    """Return the remark on rows that repeat the point before, the first on line `first`."""
    if count == 0:
        return ()
    why = "because parameters by distance need distinct points"
    if count == 1:
        became = "it is kept, with its own t" if stay else f"they were merged, {why}"
        return (f"Row {first} repeats the point of the previous row; {became}.",)
    became = "they are kept, with their own t" if stay else f"they were merged, {why}"
    return (f"{count:,} rows repeat the point of the previous row, first row {first}; {became}.",)


@dataclass(frozen=True, eq=False)
class _Rows:
    """The rows of one curve.

    Attributes
    ----------
    table, columns
        The table, and its columns of numbers by role.
    rows
        Their indices in the table.
    """

    table: Table
    columns: dict[str, int]
    rows: IntArray

    def __post_init__(self) -> None:
        for role in {"t", "x", "y"} & set(self.columns):
            values = self.column(role)
            if np.isnan(values).any():
                self._refuse_empty(role, int(np.argmax(np.isnan(values))))
        if len(self.rows) < 2:
            raise ExchangeError("The table has only one row of numbers; a curve needs two points.")
        if self.t is not None and not (np.diff(self.t) > 0).all():
            row = int(np.argmin(np.diff(self.t) > 0)) + 1
            raise RowProblem(": t must increase from row to row.", self.line_of(row))

    def _refuse_empty(self, role: str, row: int) -> None:
        raise MissingNumber(f" is empty, but {role} is needed.", self.line_of(row), self.columns[role] + 1)

    def line_of(self, row: int) -> int:
        """Return the line of the file that holds a row."""
        return self.table.line_of(int(self.rows[row]))

    def column(self, role: str) -> FloatArray:
        """Return the numbers of one column."""
        return np.asarray(self.table.values[self.rows, self.columns[role]])

    @property
    def t(self) -> FloatArray | None:
        """The parameters; None where there is no column of them."""
        return self.column("t") if "t" in self.columns else None

    @property
    def points(self) -> FloatArray:
        """The points, (n, 2)."""
        return np.column_stack([self.column("x"), self.column("y")])

    @property
    def repeats(self) -> IntArray:
        """The rows that hold the same point as the row before."""
        return np.flatnonzero((np.diff(self.points, axis=0) == 0).all(axis=1)) + 1

    def without(self, rows: IntArray) -> _Rows:
        """Return all rows but these.

        Raises
        ------
        ExchangeError
            If one is left.
        """
        left = np.delete(self.rows, rows)
        if len(left) < 2:
            raise ExchangeError("All points coincide; no curve can pass through them.")
        return replace(self, rows=left)

    def vectors(self, field: str, some: slice) -> list[Vector | None]:
        """Return one derivative of some rows, None where its cells are empty or there is no such column.

        Raises
        ------
        ExchangeError
            If one of two cells is empty.
        """
        pair = _PAIRS[field]
        rows = self.rows[some]
        if not set(pair) <= set(self.columns):
            return [None] * len(rows)
        values = np.column_stack([self.table.values[rows, self.columns[role]] for role in pair])
        empty = np.isnan(values)
        halves = np.flatnonzero(empty[:, 0] != empty[:, 1])
        if len(halves):
            row = int(halves[0])
            self._refuse_empty(pair[0] if empty[row, 0] else pair[1], (some.start or 0) + row)
        return [None if x != x else (x, y) for x, y in values.tolist()]  # noqa: PLR0124 - NaN


def _full_curve(name: str, rows: _Rows, cell: FamilyCell, report: Report) -> Curve:
    parameters = rows.t
    points = tuple(_points(rows, cell.family, report))
    return Curve(
        name,
        cell.family,
        _rule(parameters),
        points[:-1] if cell.closed else points,
        closed=cell.closed,
        settings=cell.settings,
    )


def _points(rows: _Rows, family: Family, report: Report) -> Iterator[Point]:
    """Yield the points of all rows, made of some rows at a time: lists of all would double the memory."""
    x, y, times = rows.column("x"), rows.column("y"), rows.t
    for first in range(0, len(x), _ROWS_AT_ONCE):
        report(first / len(x), "Creating a curve")
        some = slice(first, first + _ROWS_AT_ONCE)
        nothing: list[Vector | None] = [None] * len(x[some])
        fields = [
            rows.vectors(name, some) if order <= family.derivatives else nothing for order, name in VECTORS
        ]
        t = [None] * len(nothing) if times is None else times[some].tolist()
        values = zip(x[some].tolist(), y[some].tolist(), t, zip(*fields, strict=True), strict=True)
        for at_x, at_y, at, vectors in values:
            before, after = vectors[: len(DERIVATIVES)], vectors[len(DERIVATIVES) :]
            point = Point(at_x, at_y, at, corner=after[0] is not None)
            yield tie_if_parallel(point.with_derivatives(before, after)) if any(vectors) else point


def _thinned_curve(name: str, rows: _Rows, indices: IntArray, parameters: FloatArray) -> Curve:
    positions = zip(rows.points[indices].tolist(), parameters.tolist(), strict=True)
    points = tuple(Point(x, y, t) for (x, y), t in positions)
    return Curve(name, HERMITE, _rule(parameters), points)


def _rule(t: FloatArray | None) -> Parametrization:
    """Return the rule for parameters t, or chord length without."""
    if t is None:
        return Parametrization()
    return Parametrization(ParametrizationKind.MANUAL, start=float(t[0]), end=float(t[-1]))


def _checked(curves: list[Curve]) -> Document:
    document = Document(tuple(curves))
    try:
        validate(document)
    except FormatError as problem:
        raise ExchangeError(f"The table cannot be converted to a curve: {problem}.") from problem
    return document
