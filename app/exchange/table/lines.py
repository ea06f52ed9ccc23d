"""The bytes of a table as lines of text, part by part: a large file is never in memory twice."""

from __future__ import annotations

import codecs
import math
import re
from collections.abc import Iterator
from dataclasses import dataclass

from ..errors import ExchangeError
from .layout import RowProblem
from .table import MAX_ROWS

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
        If it is empty, has too many lines, or claims UTF-16 and is none.
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
    """Yield the lines of UTF-8 bytes in parts: the first one's number, the lines, the place after them.

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

    def comments_above(self, place: int) -> list[str]:
        """Return the comments above the line at a place in `lines`."""
        first = self.numbers[place] if place < len(self.numbers) else math.inf
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
        found = [(number, line) for number, line in head if is_data(line)]
        is_enough = len(found) > 1 or size >= len(data) or (found and len(found[0][1]) >= _HEADS[0])
        if found and is_enough:
            numbers, lines = zip(*found[:SNIFFED_LINES], strict=True)
            comments = {number: text for number, line in head if (text := comment_in(line))}
            return FirstLines(list(lines), list(numbers), comments)
    raise ExchangeError("The table has no rows of numbers.")


def is_data(line: str) -> bool:
    """Whether a line is neither empty nor a comment."""
    text = line.lstrip()
    # The marks first: this is asked of every row.
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
        raise RowProblem(" holds a zero byte; this is no text.", row)
    return text.replace("\r\n", "\n").replace("\r", "\n") if "\r" in text else text
