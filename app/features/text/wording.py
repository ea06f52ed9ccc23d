"""Texts of drawings, which stay texts: written, and their words, font and size changed."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from itertools import count
from typing import NamedTuple

from msgspec.structs import replace

from ...document.content import Anchor, Lettering, TextLine, TextRun, lettering, rough_box
from ...document.contents import corners_of, plane_of, refusal_of, shortened
from ...document.form_edits import framed
from ...document.limits import EditError, checked_vector
from ...document.model import Document
from ...document.several_curves import add_imported
from ...document.style import Style
from ...document.text import LONGEST_TEXT, Text, TextAlign
from ...qt.contents import fitted, line_step
from ...qt.glyphs import Face

BOLD, WEIGHTS = 600.0, (400.0, 700.0)
"""Weight from which letters count as bold; those of letters that are not, and that are."""

_LINE = 1.25
"""The way from line to line of a text that has but one, in sizes."""

_ALIGNED = dict(zip(Anchor, TextAlign, strict=True))
_ANCHORS = {align: anchor for anchor, align in _ALIGNED.items()}


class Look(NamedTuple):
    """How letters look, and which run of the text as it was they are of: that begins where it did."""

    run: TextRun
    source: int


class Letters(NamedTuple):
    """Letters that look alike, one after the other."""

    words: str
    look: Look


Typed = tuple[tuple[Letters, ...], ...]
"""Lines of letters."""


class Worded(NamedTuple):
    """A text of a drawing that is edited.

    Attributes
    ----------
    places
        Of its frame.
    text
        Its words, and the font and the size that its first letters have.
    typed
        Its letters.
    scale
        How long a unit of it is.
    """

    places: range
    text: Text
    typed: Typed
    scale: float
    is_changed: bool = False

    @property
    def face(self) -> Face:
        """The font."""
        return Face(self.text.font, self.text.bold, self.text.italic)


def worded_at(document: Document, place: int) -> Worded | None:
    """Return the text that a curve is the frame of; None where it is of none.

    Raises
    ------
    EditError
        If it is longer than what can be typed.
    """
    curve = document.curves[place]
    text = curve.form
    if not isinstance(text, Lettering):
        return None
    words = "\n".join(line.words for line in text.lines)
    if len(words) > LONGEST_TEXT:
        raise EditError(f"It has more than {LONGEST_TEXT} letters. {refusal_of(curve)}")
    run, plane = text.lines[0].runs[0], plane_of(text, corners_of(curve))
    x, y = plane.place(text.lines[0].x, text.lines[0].y)
    return Worded(
        range(place, place + 1),
        Text(
            words,
            run.font[0] if run.font else "",
            x,
            y,
            run.size * plane.scale,
            run.weight >= BOLD,
            run.italic,
            align=_ALIGNED[text.lines[0].anchor],
        ),
        _typed(text.lines),
        plane.scale,
    )


def _typed(lines: Sequence[TextLine]) -> Typed:
    places = count()
    return tuple(
        tuple(Letters(run.words, Look(replace(run, words=""), next(places))) for run in line.runs)
        for line in lines
    )


def with_worded(
    document: Document, style: Style, text: Text, typed: Typed, layer: str = ""
) -> tuple[Document, range]:
    """Return the document with a text in front in a layer, and its place; there must be letters to see.

    Raises
    ------
    EditError
        If the numbers are beyond what a document may hold.
    """
    runs = _runs(typed, text.letter_spacing)
    most = max((run for line in runs for run in line), key=lambda run: len(run.words))
    step = text.line_spacing * line_step(most)
    lines = tuple(
        TextLine(0.0, at * step, line, _ANCHORS[text.align]) for at, line in enumerate(runs) if _is_seen(line)
    )
    form = lettering(lines, rough_box(lines))
    left, top, right, bottom = form.box
    corners = ((left, top), (right, top), (right, bottom), (left, bottom))
    frame = framed(form, [(text.x + x, text.y - y) for x, y in corners], shortened(form.title))
    curve = fitted(replace(frame, style=style))
    for point in curve.points:
        checked_vector(point.position, "a text")
    new, place = add_imported(document, Document((curve,)), layer)
    return new, range(place, place + 1)


def reworded(
    document: Document, edited: Worded, before: Text, now: Text, typed: Typed, style: Style
) -> tuple[Document, range]:
    """Return the document with a text that says something else; what was not changed stays as it was."""
    place = edited.places.start
    curve = document.curves[place]
    text = curve.form
    assert isinstance(text, Lettering)
    runs = _runs(typed, now.letter_spacing - before.letter_spacing)
    anchor = _ANCHORS[now.align] if now.align != before.align else None
    said = [
        replace(line, runs=run, anchor=anchor or line.anchor)
        for line, run in zip(_lines(text.lines, len(runs)), runs, strict=True)
        if _is_seen(run)
    ]
    if not said:
        return document, edited.places
    apart = now.line_spacing / before.line_spacing * _growth(text.lines, typed)
    lines = tuple(replace(each, y=said[0].y + (each.y - said[0].y) * apart) for each in said)
    named = curve.name == shortened(text.title)
    new = replace(text, lines=lines)
    made = fitted(replace(curve, form=new, style=style, name=shortened(new.title) if named else curve.name))
    return document.with_curve(place, made), edited.places


def cut(typed: Typed, most: int) -> Typed:
    """Return the first letters; an end of a line is one, too."""
    found = list[tuple[Letters, ...]]()
    for line in typed:
        if most < 0:
            break
        kept = list[Letters]()
        for letters in line:
            if words := letters.words[:most]:
                kept.append(letters._replace(words=words))
            most -= len(words)
        found.append(tuple(kept))
        most -= 1
    return tuple(found)


def _is_seen(runs: Sequence[TextRun]) -> bool:
    return any(run.words.strip() for run in runs)


def _lines(before: Sequence[TextLine], many: int) -> list[TextLine]:
    """Return so many lines, where those before were; further ones below."""
    step = before[-1].y - before[-2].y if len(before) > 1 else _LINE * before[0].runs[0].size
    found = list(before[:many])
    return found + [
        replace(before[-1], y=before[-1].y + below * step) for below in range(1, many - len(found) + 1)
    ]


def _runs(typed: Typed, spacing: float) -> list[tuple[TextRun, ...]]:
    """Return the runs of lines of letters, further apart by so many sizes."""
    begun, found = set[int](), list[tuple[TextRun, ...]]()
    for line in typed:
        runs = list[TextRun]()
        for words, (look, source) in line:
            apart = look.spacing + spacing * look.size
            run = replace(look, words=words.replace("\t", " "), spacing=apart)
            # What was parted is moved but once.
            runs.append(replace(run, right=0.0, down=0.0) if source in begun else run)
            begun.add(source)
        found.append(tuple(runs))
    return found


def _growth(before: Sequence[TextLine], typed: Typed) -> float:
    """Return how many times as large most letters are."""
    sizes = [run.size for line in before for run in line.runs]
    found = Counter[float]()
    for line in typed:
        for words, (run, source) in line:
            found[run.size / sizes[source]] += len(words)
    return found.most_common(1)[0][0]
