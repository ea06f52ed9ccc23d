"""CSV, TSV and other tables of text: bytes to columns of numbers, strictly.

`preview_table` finds the layout of the first rows, `read_table` reads all of them; then come the layouts, and
the bytes as lines, part by part: a large file is never in memory twice.
"""

from __future__ import annotations

import codecs
import csv
import io
import math
import re
from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import compress
from statistics import mode

import numpy as np

from curvecore.arrays import FloatArray

from ...document.limits import MAX_MAGNITUDE
from ...tasks.progress import Report, silent
from ..errors import ExchangeError
from .columns import AFTER, ROLES, UNITS, WORDS, ColumnMapping, guess, numbered_titles, role_of
from .table import (
    MAX_COLUMNS,
    MAX_ROWS,
    PREVIEW_ROWS,
    SEPARATORS,
    MissingNumber,
    Preview,
    RowProblem,
    Table,
    TextLayout,
)

_FORMULA = ("=", "@")


def preview_table(data: bytes, layout: TextLayout | None = None) -> Preview:
    """Return the first rows of a file, its likely layout, and the likely roles of its columns.

    Raises
    ------
    ExchangeError
        If the bytes are no text.
    """
    head = first_lines(plain_utf_8(data))
    layout = layout or detected_layout(head.lines)
    rows = _rows(head.lines, layout)
    comments = head.comments_above(layout.above)
    titles = titles_of(rows[0], layout, comments)
    body = rows[layout.header + layout.units :]
    roles = guess(titles, body, _are_numbers(body, len(titles), layout))
    cells = tuple(map(tuple, body[:PREVIEW_ROWS]))
    numbers = tuple(head.numbers[layout.above :][:PREVIEW_ROWS])
    remark = _remark_on(head.lines, layout, comments if titles == numbered_titles(len(titles)) else [])
    later = titles_in([text for text in head.comments.values() if text not in comments], len(titles), layout)
    if {"x", "y"} <= set(map(role_of, later)) and tuple(later) != titles:
        ignored = f"The titles “{', '.join(later)[:40]}” in a comment below the first row are ignored."
        remark = f"{remark} {ignored}".strip()
    return Preview(layout, titles, cells, numbers, roles, remark)


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
        Layout of the text.
    mapping
        Roles of the columns to read; the others are ignored.
    allows_missing
        Whether "nan" and the like may stand in place of a number.
    report
        Called with the progress.

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
    for first, block, position in parts_of(data):
        report(position / len(data), "Reading")
        collector.add(block, first)
    return collector.table(titles)


# The lines above the numbers


def _rows(lines: list[str], layout: TextLayout) -> list[list[str]]:
    """Return the cells of the lines from the titles, or the first row, on."""
    used = lines[layout.skipped :]
    if not used:
        raise ExchangeError("The table contains no rows of numbers.")
    first = cells_of(used[0], layout)
    if len(first) > MAX_COLUMNS:
        raise ExchangeError(f"The table has {len(first):,} columns; at most {MAX_COLUMNS} can be read.")
    return [first, *(cells_of(line, layout, len(first)) for line in used[1:])]


def _are_numbers(rows: list[list[str]], width: int, layout: TextLayout) -> list[bool]:
    """Return for each column whether it looks like numbers: most of its cells are, or are missing."""
    columns = ([row[column] for row in rows if column < len(row) and row[column]] for column in range(width))
    return [
        2 * sum(is_number(cell, layout) or is_missing(cell) for cell in cells) >= len(cells)
        for cells in columns
    ]


def _remark_on(lines: list[str], layout: TextLayout, comments: list[str]) -> str:
    """Return a remark on the lines above the numbers, and on comments that name a coordinate."""
    above = [f"“{line.strip()[:40]}”" for line in lines[: layout.skipped][:3]]
    titles = f"Not read as numbers: {', '.join(above)}." if above else ""
    units = "The row below the titles contains units." if layout.units else ""
    naming = [text for text in comments if {"x", "y"} & set(map(role_of, re.split(r"[\s,;]+", text)))]
    unused = f"The comment “{naming[-1][:40]}” does not have one title for each column." if naming else ""
    return " ".join(filter(None, (titles, units, unused)))


# From lines to numbers


@dataclass(frozen=True)
class _Wanted:
    """The number of columns, and those to read as numbers and as words."""

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
    """Collector of the numbers and the words of all rows."""

    def __init__(self, layout: TextLayout, wanted: _Wanted, rows: int, allows_missing: bool) -> None:
        self._layout, self._wanted, self._allows_missing = layout, wanted, allows_missing
        # Allocated at once: joined from parts, the numbers would be in memory twice.
        self._values = np.empty((rows, wanted.width))
        self._count = self._first_row = 0
        self._above = layout.above
        self._gaps: list[int] = []
        self._breaks: list[int] = []
        self._words: dict[int, list[str]] = {column: [] for column in wanted.words}
        self._known: dict[str, str] = {}

    def table(self, titles: tuple[str, ...]) -> Table:
        """Return the table of all rows.

        Raises
        ------
        ExchangeError
            If there is no row.
        """
        if self._count == 0:
            raise ExchangeError("The table contains no rows of numbers.")
        values = self._values[: self._count]
        gaps = tuple(self._gaps)
        plain = not self._layout.header and not self._wanted.words
        if plain and (upper := _lednicer(values)):
            return Table(titles, values[1:], self._first_row + 1, gaps, blocks=(upper,))
        blocks = _blocks(self._breaks, self._count)
        return Table(titles, values, self._first_row, gaps, self._words, blocks)

    def add(self, lines: list[str], first: int) -> None:
        """Add lines, of which the first has the number `first`."""
        are_data = list(map(is_data, lines))
        if self._above:
            skipped = self._skipped(are_data)
            lines, are_data, first = lines[skipped:], are_data[skipped:], first + skipped
        if not all(are_data):
            self._note_gaps(lines, are_data, first)
        if not any(are_data):
            return
        rows = lines if all(are_data) else list(compress(lines, are_data))
        values = _read_fast(rows, self._layout, self._wanted, self._allows_missing)
        if values is None:
            values = _read_carefully(lines, first, self._layout, self._wanted, self._allows_missing)
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
        """Return the number of lines above the first row of numbers."""
        for index, has_data in enumerate(are_data):
            if has_data and self._above == 0:
                return index
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
                    # A name that a million rows share is stored once.
                    words.append(self._known.setdefault(cells[column], cells[column]))


def _blocks(breaks: list[int], count: int) -> tuple[int, ...]:
    """Return the rows at which blocks begin after empty lines; empty where one would not be a curve."""
    starts = [row for row in breaks if 0 < row < count]
    sizes = np.diff([0, *starts, count])
    return tuple(starts) if (sizes >= 2).all() else ()


def _lednicer(values: FloatArray) -> int:
    """Return the rows of an airfoil's upper side, where the first row counts those of both; else 0."""
    if values.shape[1] != 2 or len(values) < 5:
        return 0
    upper, lower = values[0]
    return int(upper) if min(upper, lower) >= 2 and upper + lower == len(values) - 1 and upper % 1 == 0 else 0


def _read_fast(
    lines: list[str], layout: TextLayout, wanted: _Wanted, allows_missing: bool
) -> FloatArray | None:
    """Return the numbers by NumPy's reader in C, or None if anything is unusual."""
    text = "\n".join(lines)
    if '"' in text or (layout.decimal_comma and "." in text):
        return None
    if not wanted.is_all and not _is_even(lines, text, layout, wanted.width):
        return None  # the reader in C ignores all other columns
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


def _read_carefully(
    lines: list[str], first: int, layout: TextLayout, wanted: _Wanted, allows_missing: bool
) -> FloatArray:
    """Return the numbers row by row; refuse the first cell that is not a number."""
    rows = []
    for number, line in enumerate(lines, start=first):
        if not is_data(line):
            continue
        cells = cells_of(line, layout, wanted.width)
        if len(cells) != wanted.width:
            raise RowProblem(f" has {len(cells)} cells; the first row has {wanted.width}.", number)
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
        excerpt = (cell if len(cell) <= 20 else cell[:19] + "…").encode("utf-8", "replace").decode()
        words = cell[0] in "+-" and cell[1:].lower() not in ("inf", "infinity", "nan")
        if cell.startswith(_FORMULA) or (words and any(char.isalpha() for char in cell)):
            raise RowProblem(f": “{excerpt}” is a formula; only numbers are read.", row, column)
        kind = MissingNumber if is_missing(cell) else RowProblem
        raise kind(f": “{excerpt}” is not a number.", row, column)
    value = float(cell.replace(",", "."))
    if not math.isfinite(value) or abs(value) > MAX_MAGNITUDE:
        raise RowProblem(" must lie between −1e12 and 1e12.", row, column)
    return value


# Layouts


_NUMBER = re.compile(r"[-+]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][-+]?[0-9]+)?")
_DECIMAL_COMMA = re.compile(r"[-+]?[0-9]*,[0-9]+(?:[eE][-+]?[0-9]+)?")


_LONGEST_LINE = 10_000
_ANY_WIDTH = 10**9
_MISSING = frozenset(("nan", "na", "n/a", "null", "none", "-", "--"))


def detected_layout(lines: list[str]) -> TextLayout:
    """Return the layout of which the first rows make the most sense."""
    candidates = [
        layout_with_marks(lines, separator, comma)
        for separator in SEPARATORS
        for comma in (False, True)
        if not (comma and separator == ",")
    ]
    return max(candidates, key=lambda layout: _plausibility(lines, layout))


def layout_with_marks(lines: list[str], separator: str, decimal_comma: bool) -> TextLayout:
    """Return the layout with these marks, by the kinds of the rows above the numbers."""
    plain = TextLayout(separator, decimal_comma, header=False)
    rows = [cells_of(line, plain) for line in lines]
    # It is unknown yet whether an empty cell follows a separator at the end of a row.
    wholes = [len(cells_of(line, plain, _ANY_WIDTH)) for line in lines]
    widths = {mode(map(len, rows)), mode(wholes)}
    are_above = (
        _is_above(row, {len(row), whole}.isdisjoint(widths), plain)
        for row, whole in zip(rows, wholes, strict=True)
    )
    above = next((index for index, is_above in enumerate(are_above) if not is_above), 0)
    if above == 0:
        # Without a row of numbers the first row contains titles, if there are others.
        return replace(plain, header=len(rows) > 1 and not any(is_number(cell, plain) for cell in rows[0]))
    titles = above - 1
    units = above > 1 and _is_units(rows[titles]) and _is_titles(rows[titles - 1], widths, plain)
    titles -= units
    if not _is_titles(rows[titles], widths, plain):
        return replace(plain, skipped=above)
    return replace(plain, header=True, skipped=titles, units=units)


def _is_above(row: list[str], has_other_width: bool, layout: TextLayout) -> bool:
    """Whether a row is neither a row of numbers nor a damaged one."""
    numbers = sum(is_number(cell, layout) or is_missing(cell) for cell in row)
    if numbers == len(row):
        return False
    # Between blanks a title such as "NACA 2412" has as many cells as a point.
    return numbers == 0 or has_other_width or layout.separator == " "


def _is_titles(row: list[str], widths: set[int], layout: TextLayout) -> bool:
    """Whether a row above the numbers holds titles; between blanks, words that are known."""
    if len(row) not in widths or any(is_number(cell, layout) for cell in row):
        return False
    return layout.separator != " " or all(map(role_of, row))


def _is_units(row: list[str]) -> bool:
    words = [cell.strip().lower() for cell in row if cell.strip()]
    return bool(words) and all(
        cell in UNITS or (cell[0], cell[-1]) in (("[", "]"), ("(", ")")) for cell in words
    )


def _plausibility(lines: list[str], layout: TextLayout) -> tuple[bool, bool, float, bool, bool]:
    """Return the arguments for a layout, the weightiest first."""
    first = cells_of(lines[layout.skipped], layout)
    body = [cells_of(line, layout, len(first)) for line in lines[layout.above :]]
    cells = [cell for row in body for cell in row]
    share = sum(is_number(cell, layout) for cell in cells) / max(len(cells), 1)
    even = all(len(row) == len(first) for row in body)
    commas = any("," in cell for cell in cells)
    return (len(first) > 1, even, share, layout.decimal_comma == commas, layout.separator != " ")


def is_missing(cell: str) -> bool:
    """Whether a cell says that there is no number."""
    return cell.lower() in _MISSING


def is_number(cell: str, layout: TextLayout) -> bool:
    """Whether a cell is one number, written as the layout has it."""
    return bool(_NUMBER.fullmatch(cell) or (layout.decimal_comma and _DECIMAL_COMMA.fullmatch(cell)))


def cells_of(line: str, layout: TextLayout, width: int = 0) -> list[str]:
    """Return the cells of a line; an empty one at the end, beyond `width`, counts as none."""
    if layout.separator == " ":
        return line.split()
    if '"' in line:
        try:
            return [cell.strip() for cell in next(csv.reader([line], delimiter=layout.separator))]
        except csv.Error:
            return [line]
    cells = [cell.strip() for cell in line.split(layout.separator)]
    # "1; 2;" ends its row with a separator.
    ends_so = layout.separator != "\t" and len(cells) > max(width, 1) and not cells[-1]
    return cells[:-1] if ends_so else cells


def titles_of(first: list[str], layout: TextLayout, comments: list[str]) -> tuple[str, ...]:
    """Return the titles of the columns: the cells of the first row, of a comment, or "Column 1" and so on."""
    numbered = numbered_titles(len(first))
    given = first if layout.header else titles_in(comments, len(first), layout) or [""] * len(first)
    return tuple(cell or title for cell, title in zip(given, numbered, strict=True))


def titles_in(comments: list[str], width: int, layout: TextLayout) -> list[str]:
    """Return as many titles as there are columns, from the last of some comments that has them; else none.

    NumPy's savetxt writes "# y,x" above numbers between blanks. A sentence may have as many words as there
    are columns, so titles between other marks than those of the rows, and between blanks, must be known ones.
    """
    for text in reversed(comments):
        for candidate in (text, text.partition(":")[2]):
            for separator in (layout.separator, *SEPARATORS):
                marks = replace(layout, separator=separator)
                cells = cells_of(candidate, marks, width)
                if len(cells) != width or any(is_number(cell, marks) for cell in cells):
                    continue
                roles = list(map(role_of, cells))
                is_row = separator == layout.separator != " " and width > 1
                if is_row or all(roles) or {"x", "y"} <= set(roles):
                    return cells
    return []


def cells_of_row(data: bytes, layout: TextLayout, row: int) -> tuple[str, ...]:
    """Return the cells of a line of plain UTF-8, counted from 1, none beyond its end."""
    lines = (data if b"\n" in data else data.replace(b"\r", b"\n")).split(b"\n", row)
    if not 1 <= row <= len(lines):
        return ()
    text = lines[row - 1][:_LONGEST_LINE].decode("utf-8", "replace")
    return tuple(cells_of(text.strip("\r\0"), layout))


# From bytes to lines


_BLOCK = 2**19
"""Bytes that are read at once: some milliseconds, in which no other thread can do anything."""

SNIFFED_LINES = 50
_HEADS = (2**16, 2**22)
_COMMENT = re.compile(r"[#%]+|//+|;+(?=\s*[^\W\d][^;]*[\s,][^\s;][^;]*$)")
"""Marks of comments. A “;” may end an empty cell as well: it does unless words without another “;” follow."""

_UTF_8_MARK = codecs.BOM_UTF8
_UTF_16_MARKS = {codecs.BOM_UTF16_LE: "utf-16-le", codecs.BOM_UTF16_BE: "utf-16-be"}


def plain_utf_8(data: bytes) -> bytes:
    """Return a text without the mark at its beginning, and UTF-16 as UTF-8.

    Raises
    ------
    ExchangeError
        If it is empty, has too many lines, or is damaged UTF-16.
    """
    if not data or data.isspace():
        raise ExchangeError("The file is empty.")
    encoding = _UTF_16_MARKS.get(data[:2])
    if encoding is not None:
        try:
            data = data[2:].decode(encoding).encode()
        except UnicodeError as problem:
            start = problem.start if isinstance(problem, UnicodeDecodeError) else 0
            row = data.count(b"\n", 0, 2 + start) + 1
            raise RowProblem(f" is not {encoding.upper()} text.", row) from None
    if max(data.count(b"\n"), data.count(b"\r")) > MAX_ROWS:
        raise ExchangeError(f"The table has more than {MAX_ROWS} rows.")
    return data.removeprefix(_UTF_8_MARK)


def parts_of(data: bytes) -> Iterator[tuple[int, list[str], int]]:
    """Yield the lines of UTF-8 bytes in parts: number of the first, the lines, position after them.

    Lines end where an editor ends them, not where str.splitlines does.
    """
    start, number = 0, 1
    while start < len(data):
        end = data.find(b"\n", start + _BLOCK)
        end = len(data) if end < 0 else end
        lines = _decoded(data[start:end], number).split("\n")
        yield number, lines, end
        start, number = end + 1, number + len(lines)


@dataclass(frozen=True)
class FirstLines:
    """First lines of a table that hold data.

    Attributes
    ----------
    lines, numbers
        The lines, and their numbers, from 1, in an editor of text.
    comments
        The texts of the comments among and above these lines, by their numbers.
    """

    lines: list[str]
    numbers: list[int]
    comments: dict[int, str]

    def comments_above(self, index: int) -> list[str]:
        """Return the comments above the line with an index in `lines`."""
        first = self.numbers[index] if index < len(self.numbers) else math.inf
        return [text for number, text in self.comments.items() if number < first]


def first_lines(data: bytes) -> FirstLines:
    """Return the first lines of UTF-8 bytes that hold data.

    Raises
    ------
    ExchangeError
        If there is none.
    """
    for size in (*_HEADS, len(data)):
        head = list(enumerate(_head(data, size), start=1))
        rows = [(number, line) for number, line in head if is_data(line)]
        is_enough = len(rows) > 1 or size >= len(data) or (rows and len(rows[0][1]) >= _HEADS[0])
        if rows and is_enough:
            numbers, lines = zip(*rows[:SNIFFED_LINES], strict=True)
            comments = {number: text for number, line in head if (text := comment_in(line))}
            return FirstLines(list(lines), list(numbers), comments)
    raise ExchangeError("The table contains no rows of numbers.")


def is_data(line: str) -> bool:
    """Whether a line is neither empty nor a comment."""
    text = line.lstrip()
    # The marks first, as this is called for every row.
    return bool(text) and not (text[0] in "#%/;" and _COMMENT.match(text))


def comment_in(line: str) -> str:
    """Return the text of a line that is a comment; empty for any other."""
    mark = _COMMENT.match(line.lstrip())
    return line.strip()[mark.end() :].strip() if mark else ""


def _head(data: bytes, size: int) -> list[str]:
    """Return the lines at the beginning, without one that is cut off."""
    if len(data) <= size:
        return _decoded(data, 1).split("\n")
    end = data.rfind(b"\n", 0, size)
    return _decoded(data[: end if end > 0 else size], 1, is_cut=end <= 0).split("\n")


def _decoded(part: bytes, number: int, *, is_cut: bool = False) -> str:
    try:
        text = codecs.getincrementaldecoder("utf-8")().decode(part, final=not is_cut)
    except UnicodeDecodeError as problem:
        row = number + part.count(b"\n", 0, problem.start)
        raise RowProblem(" is not UTF-8 text.", row) from None
    if "\0" in text:
        row = number + text.count("\n", 0, text.index("\0"))
        raise RowProblem(" contains a zero byte; this is not text.", row)
    return text.replace("\r\n", "\n").replace("\r", "\n") if "\r" in text else text
