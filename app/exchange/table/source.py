"""The file of a table, whatever its format, and the curves that options make of it.

`TableSource` keeps what was read for the next choice. `import_table` is the import of the command line;
`prepare_table` that of the window, where a problem is part of the result.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from ...document.model import Document
from ...families import HERMITE, Family
from ...tasks.progress import Report, part, silent
from ..cubics_in import ImportResult
from ..errors import ExchangeError
from .columns import ColumnMapping, mapping_of, mapping_summary
from .curves import MissingRows, TableOptions, document_of_table
from .table import MissingNumber, Preview, RowProblem, Table, TextLayout, cells_at, preview_of
from .text import cells_of_row, plain_utf_8, preview_table, read_table
from .thinning import MAX_POINTS, Thinning, TooManyPointsError

if TYPE_CHECKING:
    from ..files import ImportOptions


class TableSource:
    """The content of one file.

    Attributes
    ----------
    data
        The content.
    lines
        Approximate number of rows.
    """

    def __init__(self, data: bytes, read_whole: Callable[[bytes], Table] | None = None) -> None:
        """Keep the content, and the reader of its format; None for a table of text."""
        self.data, self._read_whole = data, read_whole
        self._is_text = read_whole is None
        self._whole: Table | None = None
        self._read: tuple[TextLayout, ColumnMapping, bool, Table] | None = None
        self.lines = data.count(b"\n") if self._is_text else 0

    def preview(self, layout: TextLayout | None = None) -> Preview:
        """Return the first rows, and the likely roles of the columns.

        Raises
        ------
        ExchangeError
            If it is no table.
        """
        if self._is_text:
            return preview_table(self.data, layout)
        whole = self._whole_table()
        self.lines = len(whole.values)
        return preview_of(whole)

    def table(
        self,
        layout: TextLayout,
        mapping: ColumnMapping,
        missing: MissingRows = MissingRows.REFUSE,
        report: Report = silent,
    ) -> Table:
        """Return the numbers in the columns of a mapping.

        Raises
        ------
        ExchangeError
            With the position of a value that is not a number.
        """
        if not self._is_text:
            return self._whole_table()
        allows_missing = missing is not MissingRows.REFUSE
        known = self._read
        if known is not None and known[:3] == (layout, mapping, allows_missing):
            return known[3]
        table = read_table(self.data, layout, mapping, allows_missing=allows_missing, report=report)
        self._read = (layout, mapping, allows_missing, table)
        return table

    def cells(self, layout: TextLayout, number: int) -> tuple[str, ...]:
        """Return the cells of the row with this number in a problem; empty without such a row."""
        if self._is_text:
            return cells_of_row(plain_utf_8(self.data), layout, number)
        whole = self._whole_table()
        row = number - whole.first_row
        return cells_at(whole, row) if 0 <= row < len(whole.values) else ()

    def _whole_table(self) -> Table:
        if self._whole is None:
            assert self._read_whole is not None
            self._whole = self._read_whole(self.data)
        return self._whole


def import_table(name: str, source: TableSource, options: ImportOptions, report: Report) -> ImportResult:
    """Return the curves of a table in a file of that `name`, without ending."""
    preview, missing = source.preview(), MissingRows(options.missing)
    mapping = mapping_of(options.columns, preview.titles) if options.columns else preview.certain_mapping()
    try:
        table = source.table(preview.layout, mapping, missing, part(report, 0.0, 0.5))
        result = document_of_table(
            table,
            mapping,
            TableOptions(
                name=name or TableOptions.name,
                thin=options.thin,
                thinning=Thinning.POLYLINE if options.corners else Thinning.CURVE,
                family=options.family,
                settings=options.settings,
                missing=missing,
            ),
            report=part(report, 0.5, 1.0),
        )
    except MissingNumber as problem:
        raise ExchangeError(
            f"{problem} Use --missing skip to skip such rows, or --missing split to end the curve there."
        ) from None
    remarks = (
        preview.remark,
        mapping_summary(mapping, preview.titles),
        f"The rows are divided into {len(table.blocks) + 1} curves." if table.blocks else "",
        *result.remarks,
    )
    return replace(result, remarks=tuple(filter(None, remarks)))


# Tables for the window


MANY_ROWS = 1_000
"""Rows beyond which thinning them out is suggested."""

MOST_POINTS = MAX_POINTS
"""Points that the window can edit; more of them come in only thinned out."""

MOST_LAGRANGE = 500
"""Points of a Lagrange curve beyond which it swings out of all proportion, and takes long to draw."""

_RELATIVE_TOLERANCE = 1e-3
_MOST_DOUBLINGS = 16
"""Doublings of a thousandth of the size after which two points are enough."""


@dataclass(frozen=True)
class TableChoice:
    """The person's choices for a table.

    Attributes
    ----------
    layout, mapping
        Division into cells, and roles of the columns.
    family
        Family of curves without a column for it.
    thinning
        Kind of thinning; None to keep all rows.
    tolerance
        Largest distance from the rows; None for a thousandth of the table's size.
    name
        Name of a curve without a column for it.
    missing
        Treatment of rows without numbers.
    """

    layout: TextLayout
    mapping: ColumnMapping
    family: Family = HERMITE
    thinning: Thinning | None = None
    tolerance: float | None = None
    name: str = "Table"
    missing: MissingRows = MissingRows.REFUSE


@dataclass(frozen=True)
class PreparedTable:
    """Result of the choices for a table.

    Attributes
    ----------
    rows
        Number of rows of numbers; 0 where they could not be read.
    tolerance
        Tolerance used; 0 where all rows are kept.
    document, deviation
        The curves, and a bound of their distance from the rows; None where there is a problem.
    problem
        Problem that keeps the rows from becoming curves; empty for none.
    wider_than
        The smaller distance that would have left too many points; 0 where the usual one was used.
    bad_row, bad_column, bad_cells
        Cell of the problem, counted from 1, and the cells of its row; 0 and empty without a row.
    lacks_numbers
        Whether the problem is a row without a number, which could be left out.
    remarks
        Remarks on the curves, in sentences.
    """

    rows: int = 0
    tolerance: float = 0.0
    document: Document | None = None
    deviation: float = 0.0
    problem: str = ""
    wider_than: float = 0.0
    bad_row: int = 0
    bad_column: int = 0
    bad_cells: tuple[str, ...] = ()
    lacks_numbers: bool = False
    remarks: tuple[str, ...] = ()

    @property
    def points(self) -> int:
        """Number of points of the curves."""
        return sum(len(curve.points) for curve in self.document.curves) if self.document else 0


def prepare_table(source: TableSource, choice: TableChoice, report: Report = silent) -> PreparedTable:
    """Return the curves of a table, or the problem that keeps it from becoming any."""
    rows = 0
    try:
        table = source.table(choice.layout, choice.mapping, choice.missing, part(report, 0.0, 0.6))
        rows = len(table.values)
        if choice.thinning is None and rows > MOST_POINTS:
            raise ExchangeError(f"{rows:,} rows are more than {MOST_POINTS:,} points. Thin them out.")
        if choice.thinning is None and choice.family.curve_class.is_one_polynomial and rows > MOST_LAGRANGE:
            raise ExchangeError(
                f"{choice.family.subject} can have at most {MOST_LAGRANGE:,} rows, not {rows:,}. Choose "
                f"{HERMITE.title}, or thin them out."
            )
        return _curves_of(table, choice, part(report, 0.6, 1.0))
    except RowProblem as problem:
        return PreparedTable(
            rows,
            problem=str(problem),
            bad_row=problem.row,
            bad_column=problem.column or 0,
            bad_cells=source.cells(choice.layout, problem.row),
            lacks_numbers=isinstance(problem, MissingNumber),
        )
    except ExchangeError as problem:
        return PreparedTable(rows, problem=str(problem))
    except MemoryError:
        return PreparedTable(rows, problem="The table needs more memory than is available.")


def _curves_of(table: Table, choice: TableChoice, report: Report) -> PreparedTable:
    """Return the curves; without a given distance, with one that leaves few enough points."""
    suggested = _suggested(table, choice.mapping) if choice.thinning is not None else 0.0
    tolerance = (choice.tolerance or suggested) if choice.thinning is not None else 0.0
    for _ in range(_MOST_DOUBLINGS):
        try:
            result = document_of_table(
                table,
                choice.mapping,
                TableOptions(
                    family=choice.family,
                    name=choice.name,
                    missing=choice.missing,
                    thin=tolerance or None,
                    thinning=choice.thinning or Thinning.CURVE,
                ),
                report=report,
            )
        except TooManyPointsError:
            if choice.tolerance is not None:
                raise
            tolerance = float(f"{2 * tolerance:.0e}")
        else:
            is_wider = choice.tolerance is None and tolerance > suggested
            return PreparedTable(
                len(table.values),
                tolerance,
                result.document,
                result.deviation,
                wider_than=is_wider * suggested,
                remarks=result.remarks,
            )
    raise ExchangeError("The rows are too far apart to be thinned out. Choose a distance.")


def _suggested(table: Table, mapping: ColumnMapping) -> float:
    """Return a thousandth of the table's size with one digit: a number that a person might type."""
    columns = table.values[:, [mapping.x, mapping.y]]
    with np.errstate(all="ignore"):
        size = float(np.nan_to_num(np.nanmax(columns, axis=0) - np.nanmin(columns, axis=0)).max())
    return float(f"{max(size, 1e-9) * _RELATIVE_TOLERANCE:.0e}")
