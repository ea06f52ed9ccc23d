"""Words laid out in the width of a frame, as Inkscape does: where lines end, and where they lie."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from functools import lru_cache
from itertools import pairwise
from typing import NamedTuple

from msgspec.structs import replace

from .content import Anchor, Inner, Lettering, TextLine, TextRun, rough_length
from .flow import Flow
from .words import count_of

_ROOM = 1e-6
"""Of the width of a frame by which words may be wider: a frame may be as wide as they are."""

_BELOW = 1 / 8
"""Of an em by which a line may end below its frame and is shown: so Inkscape has it."""

_LEAST_BLANK = 0.5
"""Of a blank that is counted: a line of one word has none."""

_WIDE = "\u3041-\u30ff\u3400-\u9fff\uf900-\ufaff"
_BREAK = re.compile(
    rf" +(?! )|\u200b|(?<=[^\W\d])[-\u2010]+(?=\w)|[\u2013\u2014](?=\w)|[{_WIDE}](?=[{_WIDE}])"
)
"""After what a line may end: blanks, hyphens within a word, dashes, letters that are words by themselves."""


_USUAL_SHARE = 0.8
"""Of an em above the baseline, in most fonts about."""


class Measure(NamedTuple):
    """What fonts say of the letters of a run.

    Attributes
    ----------
    has_fonts
        Returns whether there are any now; without, all is a guess.
    advance
        Returns how far its words lead.
    ascent_share
        Returns how much of an em lies above its baseline.
    """

    has_fonts: Callable[[], bool]
    advance: Callable[[TextRun], float]
    ascent_share: Callable[[TextRun], float]


_measure = Measure(lambda: False, rough_length, lambda _: _USUAL_SHARE)


def measure_with(measure: Measure) -> None:
    """Lay out words by what fonts say from now on: whoever has fonts tells so, this package has none."""
    global _measure  # noqa: PLW0603
    _measure = measure


def advance(run: TextRun) -> float:
    """Return how far the words of a run lead, in units of the text."""
    return _measure.advance(run) if _measure.has_fonts() else rough_length(run)


def ascent_share(run: TextRun) -> float:
    """Return how much of an em lies above the baseline: what is above and below is an em, as SVG has it."""
    return _measure.ascent_share(run) if _measure.has_fonts() else _USUAL_SHARE


class Laid(NamedTuple):
    """Words in a frame.

    Attributes
    ----------
    lines
        The lines, each with the blanks at its end; they lie from their left end on. The words of one that is
        stretched stand apart.
    stretches
        By how much they do beyond what they would.
    ends
        Whether a paragraph ends with each of them.
    top, bottom
        Where the first begins, and where the last ends.
    is_overset
        Whether they take more room than the frame has.
    seen
        How many of the lines have room in it; the others are not shown.
    """

    lines: tuple[TextLine, ...]
    stretches: tuple[float, ...]
    ends: tuple[bool, ...]
    top: float
    bottom: float
    is_overset: bool
    seen: int


def lines_of(text: Lettering) -> tuple[TextLine, ...]:
    """Return the lines of a text as they are seen: in a frame those that have room."""
    if text.flow is None:
        return text.lines
    laid = laid_out(text)
    return laid.lines[: laid.seen]


def is_overset(text: Lettering) -> bool:
    """Whether not all words of a text fit into its frame."""
    return text.flow is not None and _measure.has_fonts() and laid_out(text).is_overset


def words_without_room(text: Lettering) -> int:
    """Return how many words of a text do not fit into its frame."""
    if text.flow is None or not _measure.has_fonts():
        return 0
    laid = laid_out(text)
    ends = zip(laid.lines[laid.seen :], laid.ends[laid.seen :], strict=True)
    rest = "".join(line.words + (" " if is_end else "") for line, is_end in ends)
    return len(rest.split())


def words_about_room(text: Lettering) -> str:
    """Return the sentence about words that do not fit into a frame; empty where all do."""
    many = words_without_room(text)
    return f"{count_of(many, 'word')} {'does' if many == 1 else 'do'} not fit into the frame." if many else ""


def laid_out(text: Lettering) -> Laid:
    """Return the lines of a text that fills a frame."""
    assert text.flow is not None
    return _laid(text.lines, text.flow, text.box, _measure.has_fonts())


@lru_cache(maxsize=256)
def _laid(paragraphs: tuple[TextLine, ...], flow: Flow, box: Inner, has_fonts: bool) -> Laid:
    left, top, right, bottom = box
    width, y, widest, seen = right - left, top, 0.0, 0
    if flow.grows:
        first, _ = next(_broken(paragraphs[0], width))
        y = top = paragraphs[0].y - _heights(first, flow)[0]
    lines, stretches, ends = list[TextLine](), list[float](), list[bool]()
    for paragraph in paragraphs:
        for runs, is_end in _broken(paragraph, width):
            above, below = _heights(runs, flow)
            long = _length(runs)
            x = left + (width - long) * paragraph.anchor.share
            stretch = _stretch(runs, width - long) if flow.is_justified and not is_end else 0.0
            lines.append(TextLine(x, y + above, _stretched(runs, stretch), Anchor.START))
            stretches.append(stretch)
            ends.append(is_end)
            y, widest = y + above + below, max(widest, long)
            has_room = y <= bottom + _BELOW * max(run.size for run in runs) + _ROOM * width
            if seen == len(lines) - 1 and (flow.grows or not has_fonts or has_room):
                seen = len(lines)
    is_overset = widest > width * (1 + _ROOM) or any(line.words.strip() for line in lines[seen:])
    return Laid(tuple(lines), tuple(stretches), tuple(ends), top, y, is_overset, seen)


def _heights(runs: Sequence[TextRun], flow: Flow) -> tuple[float, float]:
    """Return how far a line reaches above and below its baseline."""
    lead = (flow.line - 1) / 2
    shares = [(ascent_share(run), run.size) for run in runs]
    return (
        max((share + lead) * size for share, size in shares),
        max((1 - share + lead) * size for share, size in shares),
    )


def _length(runs: Sequence[TextRun]) -> float:
    """Return how long a line is without the blanks at its end, and what follows its last letter."""
    runs = list(runs)
    while len(runs) > 1 and not runs[-1].words.strip(" "):
        runs.pop()
    runs[-1] = replace(runs[-1], words=runs[-1].words.rstrip(" "))
    long = sum(run.right + (advance(run) if run.words else 0.0) for run in runs)
    return long - (runs[-1].spacing if runs[-1].words else 0.0)


def _stretch(runs: Sequence[TextRun], room: float) -> float:
    """Return how much further apart the words of a line are to stand to take some room more."""
    if room <= 0:
        return 0.0
    # What a unit between words takes is what fonts make of it.
    unit = runs[0].size
    gained = (_length(_stretched(runs, unit)) - _length(runs)) / unit
    return room / gained if gained > _LEAST_BLANK else 0.0


def _stretched(runs: Sequence[TextRun], by: float) -> tuple[TextRun, ...]:
    return tuple(replace(run, word_spacing=run.word_spacing + by) for run in runs) if by else tuple(runs)


def _broken(paragraph: TextLine, width: float) -> Iterator[tuple[tuple[TextRun, ...], bool]]:
    """Yield the runs of the lines of a paragraph, each with whether it is the last one."""
    words = paragraph.words
    breaks, start = _breaks(words), 0
    while start < len(words):
        end, further = start, start
        for further in (each for each in breaks if each > start):
            if _length(_part(paragraph, start, further)) > width * (1 + _ROOM):
                break
            end = further
        if end == start:
            end = _forced(paragraph, start, further, width)
        yield _part(paragraph, start, end), end == len(words)
        start = end
    if not words:
        yield paragraph.runs[:1], True


def _forced(paragraph: TextLine, start: int, end: int, width: float) -> int:
    """Return where a word that is wider than the frame is broken: one letter has room in any."""
    fits, beyond = start + 1, end
    while fits < beyond - 1:
        middle = (fits + beyond) // 2
        if _length(_part(paragraph, start, middle)) <= width * (1 + _ROOM):
            fits = middle
        else:
            beyond = middle
    return fits


def _breaks(words: str) -> list[int]:
    """Return where lines may end, the end of all among them."""
    return [*(each.end() for each in _BREAK.finditer(words) if each.end() < len(words)), len(words)]


def _part(paragraph: TextLine, start: int, end: int) -> tuple[TextRun, ...]:
    """Return a part of a paragraph, from a letter up to another; what is raised stays so."""
    ends, down, found = [0], 0.0, list[TextRun]()
    for run in paragraph.runs:
        ends.append(ends[-1] + len(run.words))
    for run, (first, last) in zip(paragraph.runs, pairwise(ends), strict=True):
        down += run.down
        words = run.words[max(start - first, 0) : max(end - first, 0)]
        if not words:
            continue
        right = run.right if start <= first else 0.0
        found.append(replace(run, words=words, right=right, down=run.down if found else down))
        if last >= end:
            break
    return tuple(found)
