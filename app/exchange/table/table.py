"""Tables in memory: their layout, their first rows for a dialog, and all of their numbers."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from curvecore.arrays import FloatArray

from ...document.limits import MAX_MAGNITUDE
from ..errors import ExchangeError
from .columns import ColumnMapping, RoleGuess, guess

MAX_COLUMNS = 64
MAX_ROWS = 2_000_000
PREVIEW_ROWS = 50
SEPARATORS = ("\t", ";", ",", " ")


class RowProblem(ExchangeError):  # noqa: N818 - the word for people
    """Problem of a table, with its place.

    Attributes
    ----------
    row, column
        Row, as an editor of text counts lines, and column from 1; None without a single cell.
    """

    def __init__(self, what: str, row: int, column: int | None = None) -> None:
        super().__init__(f"Row {row}{what}" if column is None else f"Row {row}, column {column}{what}")
        self.row, self.column = row, column


class MissingNumber(RowProblem):
    """Cell without a number: its row can be left out, or another curve begin after it."""


@dataclass(frozen=True)
class TextLayout:
    """Division of a text into cells.

    Attributes
    ----------
    separator
        One of `SEPARATORS`; a space stands for any run of blanks.
    decimal_comma
        Whether numbers are written like 0,5.
    header
        Whether the first row holds titles.
    skipped
        Lines above that row that are neither: the name of an airfoil, the settings of an instrument.
    units
        Whether a row of units stands below the titles.
    """

    separator: str
    decimal_comma: bool
    header: bool
    skipped: int = 0
    units: bool = False

    @property
    def above(self) -> int:
        """Number of lines above the first row of numbers."""
        return self.skipped + self.header + self.units


NO_TEXT = TextLayout(",", decimal_comma=False, header=True)
"""The layout of a table that is no text."""


@dataclass(frozen=True)
class Preview:
    """The first rows of a file as a dialog shows them.

    Attributes
    ----------
    layout
        The layout that was detected, or asked for.
    titles
        Titles of the columns; "Column 1" and so on without a header.
    cells
        The first rows, as text.
    numbers
        Numbers of these rows in problems and remarks: of the lines of a text, else of the rows, from 1.
    guess
        Likely roles of the columns.
    remark
        Remark on the lines above the numbers; empty for none.
    is_text
        Whether the layout can be chosen: the file is text with separators.
    """

    layout: TextLayout
    titles: tuple[str, ...]
    cells: tuple[tuple[str, ...], ...]
    numbers: tuple[int, ...]
    guess: RoleGuess
    remark: str = ""
    is_text: bool = True

    @property
    def mapping(self) -> ColumnMapping | None:
        """Roles that the columns seem to have; None with fewer than two of numbers."""
        return self.guess.mapping

    def certain_mapping(self) -> ColumnMapping:
        """Return the roles of the columns, where these are certain.

        Raises
        ------
        ExchangeError
            Where the roles would be a guess, with the columns.
        """
        if self.mapping is None:
            raise ExchangeError("The table has only one column; a curve needs x and y.")
        if self.guess.is_certain:
            return self.mapping
        first = self.cells[0] if self.cells else ()
        columns = [
            " ".join([str(number), *([] if title == f"Column {number}" else [title]), f"({cell[:20]}, …)"])
            for number, (title, cell) in enumerate(zip(self.titles, first, strict=False), start=1)
        ]
        raise ExchangeError(
            f"Which columns are x and y? The table has {'; '.join(columns[:8])}. "
            "Use --columns x=1,y=2 or t=1,x=2,y=3, by title or number."
        )


@dataclass(frozen=True, eq=False)
class Table:
    """Columns of numbers.

    Attributes
    ----------
    titles
        Titles of the columns.
    values
        (rows, columns); NaN where a cell is empty or its column was not read as numbers, otherwise finite.
    first_row
        The line of the file, from 1, that holds the first row.
    gaps
        The lines after it that hold none.
    words
        The cells of the columns of text, by column.
    blocks
        The rows, from 0, at which another curve begins: after an empty line, for one.
    remark
        Remark on content of the file that is in no row; empty for none.
    """

    titles: tuple[str, ...]
    values: FloatArray
    first_row: int
    gaps: tuple[int, ...] = ()
    words: dict[int, list[str]] = field(default_factory=dict)
    blocks: tuple[int, ...] = ()
    remark: str = ""

    def line_of(self, row: int) -> int:
        """Return the line of the file, from 1, that holds a row, from 0."""
        line = self.first_row + row
        for gap in self.gaps:
            if gap > line:
                break
            line += 1
        return line


def table_of(
    values: FloatArray,
    titles: tuple[str, ...],
    *,
    words: dict[int, list[str]] | None = None,
    blocks: tuple[int, ...] = (),
    remark: str = "",
) -> Table:
    """Return a table of numbers that were not text; NaN stands for a missing one.

    Raises
    ------
    ExchangeError
        With the row and column, from 1, of the first number beyond what a document may hold.
    """
    if len(titles) > MAX_COLUMNS:
        raise ExchangeError(f"The table has {len(titles)} columns; at most {MAX_COLUMNS} can be read.")
    if len(values) > MAX_ROWS:
        raise ExchangeError(f"The table has more than {MAX_ROWS} rows.")
    if len(values) == 0:
        raise ExchangeError("The table contains no rows of numbers.")
    beyond = np.abs(values) > MAX_MAGNITUDE
    if beyond.any():
        row, column = np.argwhere(beyond)[0].tolist()
        raise RowProblem(" must lie between −1e12 and 1e12.", row + 1, column + 1)
    return Table(titles, values, 1, words=words or {}, blocks=blocks, remark=remark)


def preview_of(table: Table) -> Preview:
    """Return the first rows of a table that was not text."""
    count = min(PREVIEW_ROWS, len(table.values))
    cells = tuple(cells_at(table, row) for row in range(count))
    numbers = tuple(map(table.line_of, range(count)))
    are_numbers = [column not in table.words for column in range(len(table.titles))]
    roles = guess(table.titles, cells, are_numbers)
    return Preview(NO_TEXT, table.titles, cells, numbers, roles, table.remark, is_text=False)


def cells_at(table: Table, row: int) -> tuple[str, ...]:
    """Return the cells of a row, from 0, of a table that was not text, as text."""
    numbers = table.values[row].tolist()
    return tuple(
        table.words[column][row] if column in table.words else format_number(numbers[column])
        for column in range(len(table.titles))
    )


def format_number(value: float) -> str:
    """Return a number as a cell shows it; empty where there is none."""
    return "" if value != value else f"{value:.15g}"  # noqa: PLR0124 - NaN
