"""How a text is divided into cells, and how to tell."""

from __future__ import annotations

import csv
import re
from dataclasses import dataclass
from statistics import mode

from app.exchange.drawing import ExchangeError


class RowProblem(ExchangeError):  # noqa: N818 - the word for people
    """What is wrong with a table, and where.

    Attributes
    ----------
    row, column
        Counted from 1, the row as an editor of text counts lines; None where no one cell is meant.
    """

    def __init__(self, what: str, row: int, column: int | None = None) -> None:
        super().__init__(f"Row {row}{what}" if column is None else f"Row {row}, column {column}{what}")
        self.row, self.column = row, column


SEPARATORS = ("\t", ";", ",", " ")

_NUMBER = re.compile(r"[-+]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][-+]?[0-9]+)?")
_DECIMAL_COMMA = re.compile(r"[-+]?[0-9]*,[0-9]+(?:[eE][-+]?[0-9]+)?")


_LONGEST_SHOWN = 10_000


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


def sniffed(lines: list[str]) -> Layout:
    """Return the layout of which the first rows make the most sense."""
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
    first = cells_of(lines[0], layout)
    rows = [first, *(cells_of(line, layout, len(first)) for line in lines[1:])]
    width = mode(map(len, rows))
    body = rows[1:] if layout.header else rows
    cells = [cell for row in body for cell in row]
    share = sum(is_number(cell, layout) for cell in cells) / max(len(cells), 1)
    # A header that is a row of numbers is none, and one is assumed only where there is text.
    text_above = not any(is_number(cell, layout) for cell in rows[0]) and len(rows) > 1
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


def is_number(cell: str, layout: Layout) -> bool:
    """Whether a cell is one number, written as the layout has it."""
    return bool(_NUMBER.fullmatch(cell) or (layout.decimal_comma and _DECIMAL_COMMA.fullmatch(cell)))


def cells_of(line: str, layout: Layout, width: int = 0) -> list[str]:
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


def titles_of(rows: list[list[str]], layout: Layout) -> tuple[str, ...]:
    """Return the titles of the columns: the first row's cells, or "Column 1" and so on."""
    if layout.header:
        return tuple(cell or f"Column {index + 1}" for index, cell in enumerate(rows[0]))
    return tuple(f"Column {index + 1}" for index in range(len(rows[0])))


def cells_of_row(data: bytes, layout: Layout, row: int) -> tuple[str, ...]:
    """Return the cells of a line of the file, counted from 1, none beyond its end."""
    lines = data.split(b"\n", row)
    if not 1 <= row <= len(lines):
        return ()
    text = lines[row - 1][:_LONGEST_SHOWN].decode("utf-8", "replace")
    return tuple(cells_of(text.strip("\r\0"), layout))
