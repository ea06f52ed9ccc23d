"""A table under the person's choices: its curves, or the row that keeps it from becoming any."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...document.model import Document
from ...families import HERMITE, Family
from ...tasks.progress import Report, part, silent
from ..errors import ExchangeError
from .columns import ColumnMapping
from .curves import Missing, TableOptions, document_of_table
from .layout import MissingNumber, RowProblem, TextLayout
from .source import TableSource
from .table import Table
from .thinning import MOST_KEPT, Thinning, TooManyLeftError

MANY_ROWS = 1_000
"""Rows beyond which thinning them out is suggested."""

MOST_POINTS = MOST_KEPT
"""Points that the window can edit; more of them come in only thinned out."""

MOST_LAGRANGE = 500
"""Points of a Lagrange curve beyond which it swings out of all proportion, and takes long to draw."""

_RELATIVE_TOLERANCE = 1e-3
_MOST_DOUBLINGS = 16
"""Of a thousandth of the size: by then two points are enough."""


@dataclass(frozen=True)
class TableChoice:
    """The person's choices for a table.

    Attributes
    ----------
    layout, mapping
        How it is divided into cells, and which columns are what.
    family
        Of curves that no column gives another.
    thinning
        How to thin the rows out; None to keep them all.
    tolerance
        How near to stay to the rows; None for a thousandth of the table's size.
    name
        Of a curve that no column gives another.
    missing
        What becomes of rows without numbers.
    """

    layout: TextLayout
    mapping: ColumnMapping
    family: Family = HERMITE
    thinning: Thinning | None = None
    tolerance: float | None = None
    name: str = "Table"
    missing: Missing = Missing.REFUSE


@dataclass(frozen=True)
class PreparedTable:
    """Result of the choices for a table.

    Attributes
    ----------
    rows
        How many rows of numbers there are; 0 where they could not be read.
    tolerance
        The one used; 0 where all rows are kept.
    document, deviation
        The curves, and how far they are from the rows at most; None where there is a problem.
    problem
        What keeps the rows from becoming curves; empty if nothing does.
    wider_than
        The distance that would have been used had it not left too many points; 0 where it was used.
    bad_row, bad_column, bad_cells
        Where that is, counted from 1, and what stands there; 0 and empty where no row is meant.
    lacks_numbers
        Whether it is that a row has no number: it could be left out.
    remarks
        What there is to say of the curves, in sentences.
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
    """Return what becomes of a table; whatever is wrong with it stands in the result."""
    rows = 0
    try:
        table = source.table(choice.layout, choice.mapping, choice.missing, part(report, 0.0, 0.6))
        rows = len(table.values)
        if choice.thinning is None and rows > MOST_POINTS:
            raise ExchangeError(f"{rows:,} rows are more points than {MOST_POINTS:,}; thin them out.")
        if choice.thinning is None and choice.family.curve_class.is_one_polynomial and rows > MOST_LAGRANGE:
            raise ExchangeError(
                f"{choice.family.subject} can take {MOST_LAGRANGE:,} rows, not {rows:,}; choose "
                f"{HERMITE.title}, or thin them out."
            )
        return _made(table, choice, part(report, 0.6, 1.0))
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
        return PreparedTable(rows, problem="The table takes more memory than there is.")


def _made(table: Table, choice: TableChoice, report: Report) -> PreparedTable:
    """Return the curves; where nobody chose a distance, with one that leaves few enough points."""
    suggested = _suggested(table, choice.mapping) if choice.thinning is not None else 0.0
    tolerance = (choice.tolerance or suggested) if choice.thinning is not None else 0.0
    for _ in range(_MOST_DOUBLINGS):
        try:
            made = document_of_table(
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
        except TooManyLeftError:
            if choice.tolerance is not None:
                raise
            tolerance = float(f"{2 * tolerance:.0e}")
        else:
            is_wider = choice.tolerance is None and tolerance > suggested
            return PreparedTable(
                len(table.values),
                tolerance,
                made.document,
                made.deviation,
                wider_than=is_wider * suggested,
                remarks=made.remarks,
            )
    raise ExchangeError("The rows are too far apart to be thinned out; choose a distance.")


def _suggested(table: Table, mapping: ColumnMapping) -> float:
    """Return a thousandth of the table's size with one digit: a number that a person might type."""
    columns = table.values[:, [mapping.x, mapping.y]]
    with np.errstate(all="ignore"):
        size = float(np.nan_to_num(np.nanmax(columns, axis=0) - np.nanmin(columns, axis=0)).max())
    return float(f"{max(size, 1e-9) * _RELATIVE_TOLERANCE:.0e}")
