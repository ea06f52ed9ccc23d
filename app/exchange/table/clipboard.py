"""Blocks of numbers as text, as spreadsheets exchange them by the clipboard."""

from __future__ import annotations

import math
import re
from collections.abc import Collection, Iterable, Sequence

import msgspec

from ...document.expression import ExpressionError, parse_number
from ...document.words import count_of

MAX_ROWS = 10_000
MAX_COLUMNS = 16
"""Rows and columns of the largest block that is read."""

_GROUPED = re.compile(r"[-+−]?[0-9]{1,3}(,[0-9]{3})+")
_UNIT = re.compile(r"(?<=\w)\s*[\[(][^\])]*[\])]$")
_DECIMAL_COMMA = re.compile(r"[0-9]*,[0-9]+")


class TableTextError(ValueError):
    """A text that is not a block of numbers; the message names the row and the column."""


def write_block(rows: Iterable[Sequence[str]]) -> str:
    """Return cells as tab-separated text, as spreadsheets take it."""
    return "\n".join("\t".join(row) for row in rows)


class Block(msgspec.Struct, frozen=True):
    """Numbers, row by row, and the titles of their columns in lower case; no titles where none were given."""

    titles: tuple[str, ...]
    rows: list[list[float]]


def read_titled_block(
    text: str, mark: str = ".", titles: Collection[str] = "xy", *, may_be_empty: bool = False
) -> Block:
    """Return the numbers of a block of text, row by row.

    Parameters
    ----------
    text
        Rows as lines; cells separated by tabs, semicolons, commas or spaces. A first row may hold titles of
        columns, with a unit ("x [mm]") or after a "#" as for a comment.
    mark
        The decimal mark of the person's locale. A comma between cells that something else separates is read
        as a decimal comma wherever it cannot be a group separator.
    titles
        The titles that there are, in lower case; a first row of anything else is no row of titles.
    may_be_empty
        Whether a cell between separators may have nothing in it; it is read as NaN.

    Raises
    ------
    TableTextError
        If a cell is no number, is missing, or could mean two numbers. Rows and columns count from 1.
    """
    lines = _lines_of(text)
    separator, comma = _separator(lines, mark)
    cells = [_split(line, separator) for line in lines]
    if max(map(len, cells)) > MAX_COLUMNS:
        raise TableTextError(
            f"The clipboard contains {max(map(len, cells))} columns; at most {MAX_COLUMNS} can be pasted."
        )
    first = _titles(cells)
    skipped = 1 if len(cells) > 1 and set(first) <= {"#", *titles} else 0
    numbers = [
        [
            math.nan if may_be_empty and not cell else _number(cell, row, column, "," if comma else mark)
            for column, cell in enumerate(line, start=1)
        ]
        for row, line in enumerate(cells[skipped:], start=1 + skipped)
    ]
    _refuse_ragged(numbers, skipped)
    if not skipped:
        return Block((), numbers)
    if len(first) != len(numbers[0]):
        raise TableTextError(f"There are {len(first)} titles, but {len(numbers[0])} columns.")
    return Block(first, numbers)


def _lines_of(text: str) -> list[str]:
    """Return the lines of a text but empty ones at its end; raise where there are none, or too many."""
    lines = text.replace("\r\n", "\n").replace("\r", "\n").split("\n")
    while lines and not lines[-1].strip():
        lines.pop()
    if len(lines) > MAX_ROWS:
        raise TableTextError(f"The clipboard contains {len(lines)} rows; at most {MAX_ROWS} can be pasted.")
    if not lines:
        raise TableTextError("There are no numbers on the clipboard.")
    return lines


def _titles(cells: list[list[str]]) -> tuple[str, ...]:
    """Return the cells of the first row as titles: in lower case, without units and the sign of a comment."""
    titles = tuple(_UNIT.sub("", cell.lower()) for cell in cells[0])
    is_comment = len(cells) > 1 and len(titles) == len(cells[1]) + 1 and titles[0] == "#"
    return titles[1:] if is_comment else titles


def _separator(lines: list[str], mark: str) -> tuple[str, bool]:
    """Return the separator of the cells, and whether commas are decimal commas."""
    text = "\n".join(lines)
    for separator in ("\t", ";"):
        if separator in text:
            return separator, _has_decimal_commas(text, mark)
    if "," not in text:
        return " ", False
    spaced = all(re.search(r"\S\s+\S", line) for line in lines) and not re.search(r",\s", text)
    if spaced and "." not in text:
        return " ", _has_decimal_commas(text, mark)
    single = mark == "," and all(_DECIMAL_COMMA.fullmatch(line.strip().lstrip("-+−")) for line in lines)
    return (" ", True) if single else (",", False)


def _has_decimal_commas(text: str, mark: str) -> bool:
    """Whether commas within cells are decimal commas: nothing in the text suggests groups of thousands."""
    if mark == ",":
        return True
    cells = [cell for cell in re.split(r"[\t;\s]+", text) if "," in cell]
    return bool(cells) and "." not in text and not all(_GROUPED.fullmatch(cell) for cell in cells)


def _split(line: str, separator: str) -> list[str]:
    if separator == " ":
        return line.split()
    cells = [cell.strip() for cell in line.split(separator)]
    # "1; 2;" ends its row with a separator.
    return cells[:-1] if separator != "\t" and len(cells) > 1 and not cells[-1] else cells


def _number(cell: str, row: int, column: int, mark: str) -> float:
    where = f"Row {row}, column {column}"
    if not cell:
        raise TableTextError(f"{where} is empty.")
    try:
        return parse_number(cell, mark)
    except ExpressionError as reason:
        if not any(character.isdigit() for character in cell):
            excerpt = cell if len(cell) <= 20 else cell[:19] + "…"
            raise TableTextError(f"{where}: “{excerpt}” is not a number.") from None
        raise TableTextError(f"{where}: {reason}") from None


def _refuse_ragged(numbers: list[list[float]], skipped: int) -> None:
    width = len(numbers[0])
    for row, line in enumerate(numbers, start=1 + skipped):
        if len(line) != width:
            raise TableTextError(
                f"Row {row} has {count_of(len(line), 'cell')}, but the first row has {width}."
            )
