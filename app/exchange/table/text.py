"""CSV, TSV and other tables of text in: bytes to columns of numbers, strictly."""

from __future__ import annotations

import io
import math
import re
from dataclasses import dataclass
from itertools import compress

import numpy as np

from curvecore.arrays import FloatArray

from ...document.model import MAX_MAGNITUDE
from ...tasks.progress import Report, silent
from ..errors import ExchangeError
from .columns import AFTER, ROLES, WORDS, ColumnMapping, guess, numbered_titles, role_of
from .layout import (
    MissingNumber,
    RowProblem,
    TextLayout,
    cells_of,
    is_missing,
    is_number,
    sniffed,
    titles_in,
    titles_of,
)
from .lines import first_lines, is_data, parts_of, plain_utf_8
from .table import MAX_COLUMNS, PREVIEW_ROWS, Preview, Table

_FORMULA = ("=", "@")


def preview_table(data: bytes, layout: TextLayout | None = None) -> Preview:
    """Return the first rows of a file, how it seems to be laid out, and what its columns seem to be.

    Raises
    ------
    ExchangeError
        If the bytes are no text.
    """
    head = first_lines(plain_utf_8(data))
    layout = layout or sniffed(head.lines)
    rows = _rows(head.lines, layout)
    comments = head.comments_above(layout.above)
    titles = titles_of(rows[0], layout, comments)
    shown = rows[layout.header + layout.units :]
    found = guess(titles, shown, _are_numbers(shown, len(titles), layout))
    cells = tuple(map(tuple, shown[:PREVIEW_ROWS]))
    numbers = tuple(head.numbers[layout.above :][:PREVIEW_ROWS])
    said = _said(head.lines, layout, comments if titles == numbered_titles(len(titles)) else [])
    later = titles_in([each for each in head.comments.values() if each not in comments], len(titles), layout)
    if {"x", "y"} <= set(map(role_of, later)) and tuple(later) != titles:
        said = f"{said} “{', '.join(later)[:40]}” in a comment below the first row is not used.".strip()
    return Preview(layout, titles, cells, numbers, found, said)


def read_table(
    data: bytes,
    layout: TextLayout,
    mapping: ColumnMapping,
    *,
    allows_missing: bool = False,
    report: Report = silent,
) -> Table:
    """Return the numbers of a table of text.

    Empty lines and comments are skipped; cells may be empty. Nothing is ever computed: a formula is text, and
    refused as such.

    Parameters
    ----------
    data
        The whole file: UTF-8, or UTF-16 with its mark.
    layout
        How to read it.
    mapping
        The columns that are wanted; what stands in the others is not looked at.
    allows_missing
        Whether "nan" and the like may stand in place of a number.
    report
        Hears how far it has come.

    Raises
    ------
    ExchangeError
        With the row, as an editor of text counts, and the column, for the first cell that is no number.
    """
    data = plain_utf_8(data)
    head = first_lines(data)
    titles = titles_of(_rows(head.lines, layout)[0], layout, head.comments_above(layout.above))
    wanted = _wanted(len(titles), mapping)
    rows_at_most = max(data.count(b"\n"), data.count(b"\r")) + 1
    collector = _Collector(layout, wanted, rows_at_most, allows_missing)
    for first, block, place in parts_of(data):
        report(place / len(data), "Reading")
        collector.add(block, first)
    return collector.table(titles)


# The lines above the numbers


def _rows(lines: list[str], layout: TextLayout) -> list[list[str]]:
    """Return the cells of the lines from the titles, or the first row, on."""
    kept = lines[layout.skipped :]
    if not kept:
        raise ExchangeError("The table has no rows of numbers.")
    first = cells_of(kept[0], layout)
    if len(first) > MAX_COLUMNS:
        raise ExchangeError(f"The table has {len(first):,} columns; {MAX_COLUMNS} can be read.")
    return [first, *(cells_of(line, layout, len(first)) for line in kept[1:])]


def _are_numbers(rows: list[list[str]], width: int, layout: TextLayout) -> list[bool]:
    """Return for each column whether it looks like numbers: most of its cells are, or are missing."""
    columns = ([row[place] for row in rows if place < len(row) and row[place]] for place in range(width))
    return [
        2 * sum(is_number(cell, layout) or is_missing(cell) for cell in cells) >= len(cells)
        for cells in columns
    ]


def _said(lines: list[str], layout: TextLayout, comments: list[str]) -> str:
    """Return what stands above the numbers and is none of them, in comments only what names a coordinate."""
    above = [f"“{line.strip()[:40]}”" for line in lines[: layout.skipped][:3]]
    titles = f"Not read as numbers: {', '.join(above)}." if above else ""
    units = "The row below the titles holds units." if layout.units else ""
    naming = [text for text in comments if {"x", "y"} & set(map(role_of, re.split(r"[\s,;]+", text)))]
    unused = f"“{naming[-1][:40]}” in a comment is not one title for each column." if naming else ""
    return " ".join(filter(None, (titles, units, unused)))


# From lines to numbers


@dataclass(frozen=True)
class _Wanted:
    """The number of columns, and which of them are to be read as what."""

    width: int
    numbers: tuple[int, ...]
    words: tuple[int, ...]

    @property
    def is_all(self) -> bool:
        """Whether every column is numbers."""
        return len(self.numbers) == self.width


def _wanted(width: int, mapping: ColumnMapping) -> _Wanted:
    words = tuple(mapping.columns(WORDS).values())
    numbers = tuple(sorted(set(mapping.columns((*ROLES, *AFTER)).values())))
    for column in (*numbers, *words):
        if not 0 <= column < width:
            raise ExchangeError(f"There is no column {column + 1}.")
    return _Wanted(width, numbers, words)


class _Collector:
    """Gathers the numbers and the words of all rows."""

    def __init__(self, layout: TextLayout, wanted: _Wanted, rows: int, allows_missing: bool) -> None:
        self._layout, self._wanted, self._allows_missing = layout, wanted, allows_missing
        # At once: put together from parts, the numbers would be there twice. What is not used takes nothing.
        self._values = np.empty((rows, wanted.width))
        self._count = self._first_row = 0
        self._above = layout.above
        self._gaps: list[int] = []
        self._breaks: list[int] = []
        self._words: dict[int, list[str]] = {column: [] for column in wanted.words}
        self._known: dict[str, str] = {}

    def table(self, titles: tuple[str, ...]) -> Table:
        """Return all that was gathered.

        Raises
        ------
        ExchangeError
            If there is no row.
        """
        if self._count == 0:
            raise ExchangeError("The table has no rows of numbers.")
        values = self._values[: self._count]
        gaps = tuple(self._gaps)
        plain = not self._layout.header and not self._wanted.words
        if plain and (upper := _lednicer(values)):
            return Table(titles, values[1:], self._first_row + 1, gaps, blocks=(upper,))
        blocks = _blocks(self._breaks, self._count)
        return Table(titles, values, self._first_row, gaps, self._words, blocks)

    def add(self, lines: list[str], first: int) -> None:
        """Take in lines, of which the first has the number `first`."""
        are_data = list(map(is_data, lines))
        if self._above:
            skipped = self._skipped(are_data)
            lines, are_data, first = lines[skipped:], are_data[skipped:], first + skipped
        if not all(are_data):
            self._note_gaps(lines, are_data, first)
        if not any(are_data):
            return
        rows = lines if all(are_data) else list(compress(lines, are_data))
        values = _fast(rows, self._layout, self._wanted, self._allows_missing)
        if values is None:
            values = _careful(lines, first, self._layout, self._wanted, self._allows_missing)
        self._first_row = self._first_row or first + are_data.index(True)
        end = self._count + len(values)
        if self._wanted.is_all:
            self._values[self._count : end] = values
        else:
            self._values[self._count : end] = np.nan
            self._values[self._count : end, list(self._wanted.numbers)] = values
        self._count = end
        if self._wanted.words:
            self._add_words(lines)

    def _skipped(self, are_data: list[bool]) -> int:
        """Return how many lines stand above the first row of numbers."""
        for place, has_data in enumerate(are_data):
            if has_data and self._above == 0:
                return place
            self._above -= has_data
        return len(are_data)

    def _note_gaps(self, lines: list[str], are_data: list[bool], first: int) -> None:
        row = self._count
        for number, (line, has_data) in enumerate(zip(lines, are_data, strict=True), start=first):
            row += has_data
            if not has_data and row > 0:
                self._gaps.append(number)
                if not line.strip() and (not self._breaks or self._breaks[-1] != row):
                    self._breaks.append(row)

    def _add_words(self, lines: list[str]) -> None:
        for line in lines:
            if is_data(line):
                cells = cells_of(line, self._layout, self._wanted.width)
                for column, words in self._words.items():
                    # A name that a million rows share is kept once.
                    words.append(self._known.setdefault(cells[column], cells[column]))


def _blocks(breaks: list[int], count: int) -> tuple[int, ...]:
    """Return the rows at which blocks begin after empty lines; none where one would be no curve."""
    starts = [row for row in breaks if 0 < row < count]
    sizes = np.diff([0, *starts, count])
    return tuple(starts) if (sizes >= 2).all() else ()


def _lednicer(values: FloatArray) -> int:
    """Return the rows of an airfoil's upper side, where the first row counts those of both; else 0."""
    if values.shape[1] != 2 or len(values) < 5:
        return 0
    upper, lower = values[0]
    return int(upper) if min(upper, lower) >= 2 and upper + lower == len(values) - 1 and upper % 1 == 0 else 0


def _fast(lines: list[str], layout: TextLayout, wanted: _Wanted, allows_missing: bool) -> FloatArray | None:
    """Return the numbers by NumPy's reader in C, or None if anything is unusual."""
    text = "\n".join(lines)
    if '"' in text or (layout.decimal_comma and "." in text):
        return None
    if not wanted.is_all and not _is_even(lines, text, layout, wanted.width):
        return None  # the reader in C looks at the columns it is told to read, and at nothing else
    if layout.decimal_comma:
        text = text.replace(",", ".")
    try:
        values = np.loadtxt(
            io.StringIO(text),
            delimiter=None if layout.separator == " " else layout.separator,
            comments="#",
            ndmin=2,
            usecols=None if wanted.is_all else wanted.numbers,
        )
    except (ValueError, IndexError):
        return None
    # Written so that NaN fails, unless it is allowed.
    small = np.abs(values) <= MAX_MAGNITUDE
    usable = small | np.isnan(values) if allows_missing else small
    return values if values.shape[1] == len(wanted.numbers) and usable.all() else None


def _is_even(lines: list[str], text: str, layout: TextLayout, width: int) -> bool:
    if "#" in text:
        return False
    if layout.separator == " ":
        return all(len(line.split()) == width for line in lines)
    return all(line.count(layout.separator) == width - 1 for line in lines)


def _careful(
    lines: list[str], first: int, layout: TextLayout, wanted: _Wanted, allows_missing: bool
) -> FloatArray:
    """Return the numbers row by row, or say where the first cell is that is none."""
    rows = []
    for number, line in enumerate(lines, start=first):
        if not is_data(line):
            continue
        cells = cells_of(line, layout, wanted.width)
        if len(cells) != wanted.width:
            raise RowProblem(f" has {len(cells)} cells; the first has {wanted.width}.", number)
        rows.append(
            [
                math.nan
                if allows_missing and is_missing(cells[column])
                else _number(cells[column], number, column + 1, layout)
                for column in wanted.numbers
            ]
        )
    return np.array(rows, dtype=float).reshape(-1, len(wanted.numbers))


def _number(cell: str, row: int, column: int, layout: TextLayout) -> float:
    if not cell:
        return math.nan
    if not is_number(cell, layout):
        shown = (cell if len(cell) <= 20 else cell[:19] + "…").encode("utf-8", "replace").decode()
        words = cell[0] in "+-" and cell[1:].lower() not in ("inf", "infinity", "nan")
        if cell.startswith(_FORMULA) or (words and any(each.isalpha() for each in cell)):
            raise RowProblem(f": “{shown}” is a formula; only numbers are read.", row, column)
        kind = MissingNumber if is_missing(cell) else RowProblem
        raise kind(f": “{shown}” is not a number.", row, column)
    value = float(cell.replace(",", "."))
    if not math.isfinite(value) or abs(value) > MAX_MAGNITUDE:
        raise RowProblem(" must lie between −1e12 and 1e12.", row, column)
    return value
