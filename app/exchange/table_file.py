"""CSV and TSV files in: bytes to columns of numbers, strictly."""

from __future__ import annotations

import csv
import io
import math
import re
from dataclasses import dataclass, replace
from itertools import islice
from statistics import mode

import numpy as np

from app.document.model import MAX_MAGNITUDE
from app.exchange.drawing import ExchangeError, Floats

MAX_ROWS = 2_000_000
MAX_COLUMNS = 64
PREVIEW_ROWS = 20

SEPARATORS = ("\t", ";", ",", " ")

ROLES = ("t", "x", "y", "vx", "vy", "ax", "ay")
"""What a column can be."""

_SNIFFED_LINES = 50
_LINES_AT_ONCE = 50_000
_MARKS = ((b"\xef\xbb\xbf", "utf-8"), (b"\xff\xfe", "utf-16-le"), (b"\xfe\xff", "utf-16-be"))
_NUMBER = re.compile(r"[-+]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][-+]?[0-9]+)?")
_DECIMAL_COMMA = re.compile(r"[-+]?[0-9]*,[0-9]+(?:[eE][-+]?[0-9]+)?")
_FORMULA = ("=", "@")


@dataclass(frozen=True)
class Layout:
    """How a text is divided into cells.

    Attributes
    ----------
    separator
        One of `SEPARATORS`; a space stands for any run of blanks.
    decimal_comma
        Whether numbers are written 0,5.
    header
        Whether the first row holds titles.
    """

    separator: str
    decimal_comma: bool
    header: bool


@dataclass(frozen=True)
class Mapping:
    """Which column is what, counted from 0; None where there is no such column."""

    x: int
    y: int
    t: int | None = None
    vx: int | None = None
    vy: int | None = None
    ax: int | None = None
    ay: int | None = None


@dataclass(frozen=True)
class Preview:
    """The first rows of a file as a dialog shows them.

    Attributes
    ----------
    layout
        What was found, or what was asked for.
    titles
        Of the columns; "Column 1" and so on without a header.
    cells
        The first rows, as text.
    mapping
        A first guess, by the titles; None with fewer than two columns.
    """

    layout: Layout
    titles: tuple[str, ...]
    cells: tuple[tuple[str, ...], ...]
    mapping: Mapping | None


@dataclass(frozen=True, eq=False)
class Table:
    """Columns of numbers.

    Attributes
    ----------
    layout
        How the text was read.
    titles
        Of the columns.
    values
        (rows, columns); NaN where a cell is empty, otherwise finite.
    first_row
        The line of the file, from 1, that holds the first row.
    gaps
        The lines after it that hold none.
    """

    layout: Layout
    titles: tuple[str, ...]
    values: Floats
    first_row: int
    gaps: tuple[int, ...] = ()

    def line_of(self, row: int) -> int:
        """Return the line of the file, from 1, that holds a row, from 0."""
        line = self.first_row + row
        for gap in self.gaps:
            if gap > line:
                break
            line += 1
        return line


def preview_table(data: bytes, layout: Layout | None = None) -> Preview:
    """Return the first rows of a file, how it seems to be laid out, and what its columns seem to be.

    Raises
    ------
    ExchangeError
        If the bytes are no text.
    """
    text = _text(data)
    layout = layout or _sniffed(text)
    rows = [_cells(line, layout) for line in _first_lines(text)]
    titles = _titles(rows, layout)
    shown = rows[1 if layout.header else 0 :][:PREVIEW_ROWS]
    return Preview(layout, titles, tuple(map(tuple, shown)), guessed(titles))


def read_table(data: bytes, layout: Layout | None = None) -> Table:
    """Return the numbers of a CSV or TSV file.

    Empty lines are skipped, and lines that begin with "#"; cells may be empty. Nothing is ever computed: a
    formula is text, and refused as such.

    Parameters
    ----------
    data
        The whole file: UTF-8, or UTF-16 with its mark.
    layout
        How to read it; by default what the file looks like.

    Raises
    ------
    ExchangeError
        With the row, as an editor of text counts, and the column, for the first cell that is no number.
    """
    text = _text(data)
    layout = layout or _sniffed(text)
    rows = [_cells(line, layout) for line in _first_lines(text)]
    titles = _titles(rows, layout)
    if len(titles) > MAX_COLUMNS:
        raise ExchangeError(f"The table has {len(titles)} columns; {MAX_COLUMNS} can be read.")
    skipped = _lines_to_skip(text, layout)
    all_lines = text.split("\n")  # not splitlines, which ends lines where no editor does
    values = _numbers(all_lines, layout, skipped, len(titles))
    gaps = [
        number for number, line in enumerate(all_lines, start=1) if number > skipped and not _is_data(line)
    ]
    return Table(layout, titles, values, skipped + 1, tuple(gaps))


# From bytes to lines


def _text(data: bytes) -> str:
    if not data.strip():
        raise ExchangeError("The file is empty.")
    encoding, start = "utf-8", 0
    for mark, name in _MARKS:
        if data.startswith(mark):
            encoding, start = name, len(mark)
    try:
        text = data[start:].decode(encoding)
    except UnicodeDecodeError as problem:
        row = data.count(b"\n", 0, start + problem.start) + 1
        raise ExchangeError(f"Row {row} is not {encoding.upper()} text.") from None
    if "\0" in text:
        row = text.count("\n", 0, text.index("\0")) + 1
        raise ExchangeError(f"Row {row} holds a zero byte; this is no text.")
    text = text.replace("\r\n", "\n").replace("\r", "\n")
    if text.count("\n") > MAX_ROWS:
        raise ExchangeError(f"The table has more than {MAX_ROWS} rows.")
    return text


def _is_data(line: str) -> bool:
    text = line.lstrip()
    return bool(text) and text[0] != "#"


def _first_lines(text: str) -> list[str]:
    lines = (line.rstrip("\n") for line in io.StringIO(text))
    found = list(islice((line for line in lines if _is_data(line)), _SNIFFED_LINES))
    if not found:
        raise ExchangeError("The table has no rows of numbers.")
    return found


def _lines_to_skip(text: str, layout: Layout) -> int:
    """Return how many lines stand before the first row of numbers.

    Raises
    ------
    ExchangeError
        If there is none.
    """
    headers = 1 if layout.header else 0
    for index, line in enumerate(io.StringIO(text)):
        if not _is_data(line):
            continue
        if headers == 0:
            return index
        headers -= 1
    raise ExchangeError("The table has no rows of numbers.")


# What the text looks like


def _sniffed(text: str) -> Layout:
    """Return the layout of which the first rows make the most sense."""
    lines = _first_lines(text)
    candidates = [
        Layout(separator, comma, header)
        for separator in SEPARATORS
        for comma in (False, True)
        if not (comma and separator == ",")
        for header in (False, True)
    ]
    return max(candidates, key=lambda layout: _sense(lines, layout))


def _sense(lines: list[str], layout: Layout) -> tuple[bool, bool, bool, float, bool, bool]:
    """Return what speaks for a layout, the weightiest first."""
    rows = [_cells(line, layout) for line in lines]
    width = mode(map(len, rows))
    body = rows[1:] if layout.header else rows
    cells = [cell for row in body for cell in row]
    share = sum(_is_number(cell, layout) for cell in cells) / max(len(cells), 1)
    # A header that is a row of numbers is none, and one is assumed only where there is text.
    text_above = not any(_is_number(cell, layout) for cell in rows[0]) and len(rows) > 1
    even = all(len(row) == width for row in rows)
    commas = any("," in cell for cell in cells)
    return (
        layout.header == text_above,
        width > 1,
        even,
        share,
        layout.decimal_comma == commas,
        layout.separator != " ",
    )


def _is_number(cell: str, layout: Layout) -> bool:
    return bool(_NUMBER.fullmatch(cell) or (layout.decimal_comma and _DECIMAL_COMMA.fullmatch(cell)))


def _cells(line: str, layout: Layout) -> list[str]:
    if layout.separator == " ":
        return line.split()
    if '"' in line:
        try:
            return [cell.strip() for cell in next(csv.reader([line], delimiter=layout.separator))]
        except csv.Error:
            return [line]
    cells = [cell.strip() for cell in line.split(layout.separator)]
    # "1; 2;" ends its row with a separator.
    return cells[:-1] if layout.separator != "\t" and len(cells) > 1 and not cells[-1] else cells


def _titles(rows: list[list[str]], layout: Layout) -> tuple[str, ...]:
    if layout.header:
        return tuple(cell or f"Column {index + 1}" for index, cell in enumerate(rows[0]))
    return tuple(f"Column {index + 1}" for index in range(len(rows[0])))


def guessed(titles: tuple[str, ...]) -> Mapping | None:
    """Return the columns by their titles; without titles x and y, or t, x and y if there are three."""
    plain = [re.split(r"[\s\[(]", title.strip().lower())[0] for title in titles]
    known = {role: plain.index(role) for role in ROLES if role in plain}
    if "x" in known and "y" in known:
        return replace(Mapping(known["x"], known["y"]), **known)
    if len(titles) < 2:
        return None
    return Mapping(1, 2, t=0) if len(titles) == 3 else Mapping(0, 1)


# From lines to numbers


def _numbers(all_lines: list[str], layout: Layout, skipped: int, width: int) -> Floats:
    """Return the numbers of all rows; in parts, so that the place of a bad cell is found soon."""
    parts = []
    for first in range(skipped, len(all_lines), _LINES_AT_ONCE):
        part = all_lines[first : first + _LINES_AT_ONCE]
        if not any(map(_is_data, part)):
            continue
        values = _fast(part, layout, width)
        parts.append(_careful(part, first + 1, layout, width) if values is None else values)
    return np.concatenate(parts)


def _fast(part: list[str], layout: Layout, width: int) -> Floats | None:
    """Return the numbers by NumPy's reader in C, or None if anything is unusual."""
    text = "\n".join(part)
    if '"' in text or (layout.decimal_comma and "." in text):
        return None
    if layout.decimal_comma:
        text = text.replace(",", ".")
    try:
        values = np.loadtxt(
            io.StringIO(text),
            delimiter=None if layout.separator == " " else layout.separator,
            comments="#",
            ndmin=2,
        )
    except (ValueError, IndexError):
        return None
    # Written so that NaN fails.
    usable = values.shape[1] == width and bool((np.abs(values) <= MAX_MAGNITUDE).all())
    return values if usable else None


def _careful(part: list[str], first: int, layout: Layout, width: int) -> Floats:
    """Return the numbers row by row, or say where the first cell is that is none."""
    rows = []
    for number, line in enumerate(part, start=first):
        if not _is_data(line):
            continue
        cells = _cells(line, layout)
        if len(cells) != width:
            raise ExchangeError(f"Row {number} has {len(cells)} cells; the first has {width}.")
        rows.append([_number(cell, number, column, layout) for column, cell in enumerate(cells, start=1)])
    return np.array(rows, dtype=float).reshape(-1, width)


def _number(cell: str, row: int, column: int, layout: Layout) -> float:
    where = f"Row {row}, column {column}"
    if not cell:
        return math.nan
    if not _is_number(cell, layout):
        shown = (cell if len(cell) <= 20 else cell[:19] + "…").encode("utf-8", "replace").decode()
        words = cell[0] in "+-" and cell[1:].lower() not in ("inf", "infinity", "nan")
        if cell.startswith(_FORMULA) or (words and any(each.isalpha() for each in cell)):
            raise ExchangeError(f"{where}: “{shown}” is a formula; only numbers are read.")
        raise ExchangeError(f"{where}: “{shown}” is not a number.")
    value = float(cell.replace(",", "."))
    if not math.isfinite(value) or abs(value) > MAX_MAGNITUDE:
        raise ExchangeError(f"{where} must lie between −1e12 and 1e12.")
    return value
