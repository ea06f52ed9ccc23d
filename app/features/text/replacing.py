"""Words of texts replaced by others, which look as the first letters of what they replace."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from itertools import accumulate, pairwise
from typing import NamedTuple

from msgspec.structs import replace

from ...document.content import Lettering, TextLine, TextRun
from ...document.contents import shortened, texts_at
from ...document.limits import EditError
from ...document.model import Document
from .wording import said_by

Span = tuple[int, int]
"""A place in the words of a line, and the one behind it."""


class Found(NamedTuple):
    """How often words are found, and in how many texts."""

    times: int
    texts: int


def found_in(document: Document, places: Iterable[int], sought: str) -> Found:
    """Return how often words are found in texts, in capitals or not; no words are nowhere."""
    counts = [
        sum(len(_spans(line.words, sought)) for line in text.lines)
        for text in texts_at(document, places).values()
    ]
    return Found(sum(counts), sum(map(bool, counts)))


def with_words_replaced(document: Document, places: Iterable[int], sought: str, by: str) -> Document:
    """Return the document with words of texts replaced wherever they are found.

    Raises
    ------
    EditError
        If nothing would be left of a text.
    """
    for place, text in texts_at(document, places).items():
        lines = tuple(_replaced(line, _spans(line.words, sought), by) for line in text.lines)
        if lines != text.lines:
            if not any(line.words.strip() for line in lines):
                raise EditError(f"Nothing would be left of “{shortened(text.words)}”.")
            curve = document.curves[place]
            new: Lettering = replace(text, lines=lines)
            document = document.with_curve(place, said_by(new, curve, text, curve.style))
    return document


def _spans(words: str, sought: str) -> list[Span]:
    found = re.finditer(re.escape(sought), words, re.IGNORECASE) if sought else ()
    return [each.span() for each in found]


def _replaced(line: TextLine, spans: Sequence[Span], by: str) -> TextLine:
    if not spans:
        return line
    ends = [0, *accumulate(len(run.words) for run in line.runs)]
    said = [
        replace(run, words=_words(line.words, part, spans, by))
        for run, part in zip(line.runs, pairwise(ends), strict=True)
    ]
    return replace(line, runs=_with_letters(said))


def _words(words: str, part: Span, spans: Sequence[Span], by: str) -> str:
    """Return what a part of a line says: what replaces stands where the words begin that it replaces."""
    at, end = part
    pieces = list[str]()
    for start, behind in spans:
        pieces.append(words[at : min(max(start, at), end)])
        if part[0] <= start < end:
            pieces.append(by)
        at = max(at, behind)
    return "".join([*pieces, words[at:end]])


def _with_letters(runs: Sequence[TextRun]) -> tuple[TextRun, ...]:
    """Return the runs that have letters, or one; by what others are moved the next ones are."""
    found, right, down = list[TextRun](), 0.0, 0.0
    for run in runs:
        if run.words:
            found.append(replace(run, right=run.right + right, down=run.down + down))
            right = down = 0.0
        else:
            right, down = right + run.right, down + run.down
    return tuple(found) or (replace(runs[0], words=""),)
