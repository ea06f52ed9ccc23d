"""Division of a text into cells, and how it is found out."""

from __future__ import annotations

import csv
import re
from dataclasses import dataclass, replace
from statistics import mode

from ..errors import ExchangeError
from .columns import UNITS, numbered_titles, role_of


class RowProblem(ExchangeError):  # noqa: N818 - the word for people
    """Problem of a table, with its place.

    Attributes
    ----------
    row, column
        Counted from 1, the row as an editor of text counts lines; None where no one cell is meant.
    """

    def __init__(self, what: str, row: int, column: int | None = None) -> None:
        super().__init__(f"Row {row}{what}" if column is None else f"Row {row}, column {column}{what}")
        self.row, self.column = row, column


class MissingNumber(RowProblem):
    """A cell says that there is no number: its row can be left out, or another curve begin after it."""


SEPARATORS = ("\t", ";", ",", " ")

_NUMBER = re.compile(r"[-+]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][-+]?[0-9]+)?")
_DECIMAL_COMMA = re.compile(r"[-+]?[0-9]*,[0-9]+(?:[eE][-+]?[0-9]+)?")


_LONGEST_SHOWN = 10_000
_ANY_WIDTH = 10**9
_MISSING = frozenset(("nan", "na", "n/a", "null", "none", "-", "--"))


@dataclass(frozen=True)
class TextLayout:
    """Division of a text into cells.

    Attributes
    ----------
    separator
        One of `SEPARATORS`; a space stands for any run of blanks.
    decimal_comma
        Whether numbers are written 0,5.
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


def sniffed(lines: list[str]) -> TextLayout:
    """Return the layout of which the first rows make the most sense."""
    candidates = [
        arranged(lines, separator, comma)
        for separator in SEPARATORS
        for comma in (False, True)
        if not (comma and separator == ",")
    ]
    return max(candidates, key=lambda layout: _sense(lines, layout))


def arranged(lines: list[str], separator: str, decimal_comma: bool) -> TextLayout:
    """Return the layout with these marks: what the rows above the numbers are."""
    plain = TextLayout(separator, decimal_comma, header=False)
    rows = [cells_of(line, plain) for line in lines]
    # Of rows that end with a separator nobody knows yet whether an empty cell follows it.
    wholes = [len(cells_of(line, plain, _ANY_WIDTH)) for line in lines]
    widths = {mode(map(len, rows)), mode(wholes)}
    are_above = (
        _is_above(row, {len(row), whole}.isdisjoint(widths), plain)
        for row, whole in zip(rows, wholes, strict=True)
    )
    above = next((place for place, is_above in enumerate(are_above) if not is_above), 0)
    if above == 0:
        # Without a row of numbers the first one holds titles, if there are others.
        return replace(plain, header=len(rows) > 1 and not any(is_number(cell, plain) for cell in rows[0]))
    titles = above - 1
    units = above > 1 and _is_units(rows[titles]) and _is_titles(rows[titles - 1], widths, plain)
    titles -= units
    if not _is_titles(rows[titles], widths, plain):
        return replace(plain, skipped=above)
    return replace(plain, header=True, skipped=titles, units=units)


def _is_above(row: list[str], has_other_width: bool, layout: TextLayout) -> bool:
    """Whether a row is no row of numbers, nor a broken one."""
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
    said = [cell.strip().lower() for cell in row if cell.strip()]
    return bool(said) and all(
        cell in UNITS or (cell[0], cell[-1]) in (("[", "]"), ("(", ")")) for cell in said
    )


def _sense(lines: list[str], layout: TextLayout) -> tuple[bool, bool, float, bool, bool]:
    """Return what speaks for a layout, the weightiest first."""
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
        for said in (text, text.partition(":")[2]):
            for separator in (layout.separator, *SEPARATORS):
                marks = replace(layout, separator=separator)
                cells = cells_of(said, marks, width)
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
    text = lines[row - 1][:_LONGEST_SHOWN].decode("utf-8", "replace")
    return tuple(cells_of(text.strip("\r\0"), layout))
