"""CSV and TSV files in: bytes to columns of numbers, strictly."""

from __future__ import annotations

import codecs
import io
import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import islice

import numpy as np

from app.document.model import MAX_MAGNITUDE
from app.exchange.drawing import ExchangeError, Floats
from app.exchange.progress import Report, silent
from app.exchange.table_columns import AFTER, ROLES, WORDS, Mapping, guessed
from app.exchange.table_layout import Layout, RowProblem, cells_of, is_number, sniffed, titles_of

MAX_ROWS = 2_000_000
MAX_COLUMNS = 64
PREVIEW_ROWS = 50

_SNIFFED_LINES = 50
_HEAD_BYTES = 2**16
_BLOCK = 2**19
"""Characters that are read at once: some milliseconds, in which no other thread can do anything."""

_MARKS = ((b"\xef\xbb\xbf", "utf-8"), (b"\xff\xfe", "utf-16-le"), (b"\xfe\xff", "utf-16-be"))
_FORMULA = ("=", "@")


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
        (rows, columns); NaN where a cell is empty or its column was not read as numbers, otherwise finite.
    first_row
        The line of the file, from 1, that holds the first row.
    gaps
        The lines after it that hold none.
    words
        The cells of the columns of text, by column.
    """

    layout: Layout
    titles: tuple[str, ...]
    values: Floats
    first_row: int
    gaps: tuple[int, ...] = ()
    words: dict[int, list[str]] = field(default_factory=dict)

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
    text = _text(_head(data))
    layout = layout or sniffed(_first_lines(text))
    rows = _rows(_first_lines(text), layout)
    titles = titles_of(rows, layout)
    shown = rows[1 if layout.header else 0 :][:PREVIEW_ROWS]
    return Preview(layout, titles, tuple(map(tuple, shown)), guessed(titles))


def read_table(
    data: bytes, layout: Layout | None = None, mapping: Mapping | None = None, *, report: Report = silent
) -> Table:
    """Return the numbers of a CSV or TSV file.

    Empty lines are skipped, and lines that begin with "#"; cells may be empty. Nothing is ever computed: a
    formula is text, and refused as such.

    Parameters
    ----------
    data
        The whole file: UTF-8, or UTF-16 with its mark.
    layout
        How to read it; by default what the file looks like.
    mapping
        The columns that are wanted; what stands in the others is not looked at. By default all of them are,
        and those with the titles `WORDS` are text.
    report
        Hears how far it has come.

    Raises
    ------
    ExchangeError
        With the row, as an editor of text counts, and the column, for the first cell that is no number.
    """
    text = _text(data)
    layout = layout or sniffed(_first_lines(text))
    rows = _rows(_first_lines(text), layout)
    titles = titles_of(rows, layout)
    if len(titles) > MAX_COLUMNS:
        raise ExchangeError(f"The table has {len(titles)} columns; {MAX_COLUMNS} can be read.")
    skipped = _lines_to_skip(text, layout)
    collector = _Collector(layout, _wanted(titles, mapping))
    for first, block, share in _blocks(text, skipped):
        report(share, "Reading")
        collector.add(block, first)
    return Table(layout, titles, collector.values, skipped + 1, tuple(collector.gaps), collector.words)


# From bytes to lines


def _head(data: bytes) -> bytes:
    """Return the beginning of a file, ended where a line ends."""
    if len(data) <= _HEAD_BYTES:
        return data
    step = 2 if data.startswith((b"\xff\xfe", b"\xfe\xff")) else 1
    end = data.rfind(b"\n", 0, _HEAD_BYTES)
    # In UTF-16 a line ends with two bytes, of which either may be the one that was found.
    return data[: (end if end > 0 else _HEAD_BYTES) // step * step]


def _text(data: bytes) -> str:
    if not data or data.isspace():
        raise ExchangeError("The file is empty.")
    encoding, start = "utf-8", 0
    for mark, name in _MARKS:
        if data.startswith(mark):
            encoding, start = name, len(mark)
    try:
        text = _decoded(data, start, encoding)
    except UnicodeDecodeError:
        # Once more, as a whole: in parts, nobody knows where the bad byte was.
        row = data.count(b"\n", 0, _first_bad(data, start, encoding)) + 1
        raise RowProblem(f" is not {encoding.upper()} text.", row) from None
    if "\0" in text:
        row = text.count("\n", 0, text.index("\0")) + 1
        raise RowProblem(" holds a zero byte; this is no text.", row)
    if "\r" in text:
        text = text.replace("\r\n", "\n").replace("\r", "\n")
    if text.count("\n") > MAX_ROWS:
        raise ExchangeError(f"The table has more than {MAX_ROWS} rows.")
    return text


def _decoded(data: bytes, start: int, encoding: str) -> str:
    """Return the text in parts put together, so that other threads have their turn between."""
    decoder = codecs.getincrementaldecoder(encoding)()
    places = range(start, len(data), _BLOCK)
    parts = [decoder.decode(data[place : place + _BLOCK]) for place in places]
    return "".join([*parts, decoder.decode(b"", final=True)])


def _first_bad(data: bytes, start: int, encoding: str) -> int:
    try:
        data[start:].decode(encoding)
    except UnicodeDecodeError as problem:
        return start + problem.start
    return len(data)


def _is_data(line: str) -> bool:
    text = line.lstrip()
    return bool(text) and text[0] != "#"


def _lines_of(text: str) -> Iterator[str]:
    """Yield line by line; all at once they would be as long again as the text."""
    start = 0
    while start < len(text):
        end = text.find("\n", start)
        end = len(text) if end < 0 else end
        yield text[start:end]
        start = end + 1


def _first_lines(text: str) -> list[str]:
    found = list(islice(filter(_is_data, _lines_of(text)), _SNIFFED_LINES))
    if not found:
        raise ExchangeError("The table has no rows of numbers.")
    return found


def _rows(lines: list[str], layout: Layout) -> list[list[str]]:
    first = cells_of(lines[0], layout)
    return [first, *(cells_of(line, layout, len(first)) for line in lines[1:])]


def _lines_to_skip(text: str, layout: Layout) -> int:
    """Return how many lines stand before the first row of numbers.

    Raises
    ------
    ExchangeError
        If there is none.
    """
    headers = 1 if layout.header else 0
    for index, line in enumerate(_lines_of(text)):
        if not _is_data(line):
            continue
        if headers == 0:
            return index
        headers -= 1
    raise ExchangeError("The table has no rows of numbers.")


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


def _wanted(titles: tuple[str, ...], mapping: Mapping | None) -> _Wanted:
    width, chosen = len(titles), mapping or guessed(titles)
    words = tuple(chosen.columns(WORDS).values()) if chosen else ()
    if mapping is None:
        numbers: tuple[int, ...] = tuple(index for index in range(width) if index not in words)
    else:
        numbers = tuple(sorted(set(mapping.columns((*ROLES, *AFTER)).values())))
    for column in (*numbers, *words):
        if not 0 <= column < width:
            raise ExchangeError(f"There is no column {column + 1}.")
    return _Wanted(width, numbers, words)


def _blocks(text: str, skipped: int) -> Iterator[tuple[int, list[str], float]]:
    """Yield the lines after the first `skipped` in parts: the first one's number, the lines, the share read.

    In parts, so that the place of a bad cell is found soon and other threads have their turn. Lines end
    where an editor ends them, not where str.splitlines does.
    """
    start, number = 0, skipped + 1
    for _ in range(skipped):
        start = text.index("\n", start) + 1
    while start < len(text):
        end = text.find("\n", start + _BLOCK)
        end = len(text) if end < 0 else end
        lines = text[start:end].split("\n")
        yield number, lines, start / len(text)
        start, number = end + 1, number + len(lines)


class _Collector:
    """Gathers the numbers and the words of all rows."""

    def __init__(self, layout: Layout, wanted: _Wanted) -> None:
        self._layout, self._wanted = layout, wanted
        self._parts: list[Floats] = []
        self.gaps: list[int] = []
        self.words: dict[int, list[str]] = {column: [] for column in wanted.words}
        self._known: dict[str, str] = {}

    @property
    def values(self) -> Floats:
        """All numbers, (rows, columns)."""
        return np.concatenate(self._parts) if self._parts else np.empty((0, self._wanted.width))

    def add(self, lines: list[str], first: int) -> None:
        """Take in lines, of which the first has the number `first`."""
        if not all(map(_is_data, lines)):
            self.gaps += [number for number, line in enumerate(lines, start=first) if not _is_data(line)]
        if not any(map(_is_data, lines)):
            return
        values = _fast(lines, self._layout, self._wanted)
        if values is None:
            values = _careful(lines, first, self._layout, self._wanted)
        self._parts.append(values)
        if self._wanted.words:
            self._add_words(lines)

    def _add_words(self, lines: list[str]) -> None:
        for line in lines:
            if _is_data(line):
                cells = cells_of(line, self._layout, self._wanted.width)
                for column, words in self.words.items():
                    # A name that a million rows share is kept once.
                    words.append(self._known.setdefault(cells[column], cells[column]))


def _fast(lines: list[str], layout: Layout, wanted: _Wanted) -> Floats | None:
    """Return the numbers by NumPy's reader in C, or None if anything is unusual."""
    text = "\n".join(lines)
    if '"' in text or (layout.decimal_comma and "." in text):
        return None
    if not wanted.is_all and not _is_even(lines, layout, wanted.width):
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
    # Written so that NaN fails.
    usable = values.shape[1] == len(wanted.numbers) and bool((np.abs(values) <= MAX_MAGNITUDE).all())
    if not usable or wanted.is_all:
        return values if usable else None
    return _spread(values, wanted)


def _is_even(lines: list[str], layout: Layout, width: int) -> bool:
    if layout.separator == " " or "#" in "".join(lines):
        return False
    return all(line.count(layout.separator) == width - 1 for line in lines if _is_data(line))


def _spread(values: Floats, wanted: _Wanted) -> Floats:
    """Return the numbers in the places of their columns, NaN in the others."""
    result = np.full((len(values), wanted.width), np.nan)
    result[:, list(wanted.numbers)] = values
    return result


def _careful(lines: list[str], first: int, layout: Layout, wanted: _Wanted) -> Floats:
    """Return the numbers row by row, or say where the first cell is that is none."""
    rows = []
    for number, line in enumerate(lines, start=first):
        if not _is_data(line):
            continue
        cells = cells_of(line, layout, wanted.width)
        if len(cells) != wanted.width:
            raise RowProblem(f" has {len(cells)} cells; the first has {wanted.width}.", number)
        rows.append([_number(cells[column], number, column + 1, layout) for column in wanted.numbers])
    return _spread(np.array(rows, dtype=float).reshape(-1, len(wanted.numbers)), wanted)


def _number(cell: str, row: int, column: int, layout: Layout) -> float:
    if not cell:
        return math.nan
    if not is_number(cell, layout):
        shown = (cell if len(cell) <= 20 else cell[:19] + "…").encode("utf-8", "replace").decode()
        words = cell[0] in "+-" and cell[1:].lower() not in ("inf", "infinity", "nan")
        if cell.startswith(_FORMULA) or (words and any(each.isalpha() for each in cell)):
            raise RowProblem(f": “{shown}” is a formula; only numbers are read.", row, column)
        raise RowProblem(f": “{shown}” is not a number.", row, column)
    value = float(cell.replace(",", "."))
    if not math.isfinite(value) or abs(value) > MAX_MAGNITUDE:
        raise RowProblem(" must lie between −1e12 and 1e12.", row, column)
    return value
