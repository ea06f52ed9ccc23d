"""Texts of drawings, which stay texts: written, and their words, font and size changed."""

from __future__ import annotations

from collections.abc import Sequence
from difflib import SequenceMatcher
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

_BOLD, _WEIGHTS = 600.0, (400.0, 700.0)
"""Weight from which letters count as bold; those of letters that are not, and that are."""

_LINE = 1.25
"""The way from line to line of a text that has but one, in sizes."""

_ALIGNED = dict(zip(Anchor, TextAlign, strict=True))
_ANCHORS = {align: anchor for anchor, align in _ALIGNED.items()}


class Worded(NamedTuple):
    """A text of a drawing that is edited.

    Attributes
    ----------
    places
        Of its frame.
    text
        Its words, and the font and the size that its first letters have.
    """

    places: range
    text: Text
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
            run.weight >= _BOLD,
            run.italic,
            align=_ALIGNED[text.lines[0].anchor],
        ),
    )


def with_worded(document: Document, style: Style, text: Text, layer: str = "") -> tuple[Document, range]:
    """Return the document with a text in front in a layer, and its place; there must be letters to see.

    Raises
    ------
    EditError
        If the numbers are beyond what a document may hold.
    """
    run = TextRun(
        "",
        (text.font,),
        text.size,
        _WEIGHTS[text.bold],
        text.italic,
        spacing=text.letter_spacing * text.size,
    )
    step = text.line_spacing * line_step(run)
    lines = tuple(
        TextLine(0.0, at * step, (replace(run, words=words),), _ANCHORS[text.align])
        for at, words in enumerate(" ".join(text.words.split("\t")).split("\n"))
        if words.strip()
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


def reworded(document: Document, edited: Worded, before: Text, now: Text) -> tuple[Document, range]:
    """Return the document with a text that says something else; what was not changed stays as it was."""
    place = edited.places.start
    curve = document.curves[place]
    text = curve.form
    assert isinstance(text, Lettering)
    said = _lines(text.lines, now.words.split("\n"))
    lines = tuple(_in_font(line, before, now) for line in said if line.words.strip())
    apart = now.line_spacing / before.line_spacing * now.size / before.size
    lines = tuple(replace(each, y=lines[0].y + (each.y - lines[0].y) * apart) for each in lines)
    if not lines:
        return document, edited.places
    named = curve.name == shortened(text.title)
    new = replace(text, lines=lines)
    made = fitted(replace(curve, form=new, name=shortened(new.title) if named else curve.name))
    return document.with_curve(place, made), edited.places


def _lines(before: Sequence[TextLine], words: Sequence[str]) -> list[TextLine]:
    """Return lines with these words, where those before were; further ones below."""
    step = before[-1].y - before[-2].y if len(before) > 1 else _LINE * before[0].runs[0].size
    found = list[TextLine]()
    for number, each in enumerate(words):
        line = before[min(number, len(before) - 1)]
        below = step * max(number - len(before) + 1, 0)
        new = line.words != each or below
        found.append(replace(line, y=line.y + below, runs=_runs(line.runs, each)) if new else line)
    return found


def _runs(before: Sequence[TextRun], words: str) -> tuple[TextRun, ...]:
    """Return the runs of a line with other words: each letter as the one that it takes the place of."""
    owners = [at for at, run in enumerate(before) for _ in run.words]
    old, made = "".join(run.words for run in before), list[tuple[int, str]]()
    for kind, start, end, first, last in SequenceMatcher(None, old, words, autojunk=False).get_opcodes():
        for at in range(first, last):
            # What is put between letters is as the one before.
            owner = start + at - first if kind == "equal" else min(start + at - first, end - 1)
            owner = owners[max(owner, 0)] if owners else 0
            if made and made[-1][0] == owner:
                made[-1] = (owner, made[-1][1] + words[at])
            else:
                made.append((owner, words[at]))
    return tuple(replace(before[owner], words=letters) for owner, letters in made)


def _in_font(line: TextLine, before: Text, now: Text) -> TextLine:
    """Return a line in the font, of the size and at the side that were chosen since."""
    changed: dict[str, object] = {}
    if now.font != before.font:
        changed["font"] = (now.font,)
    if now.bold != before.bold:
        changed["weight"] = _WEIGHTS[now.bold]
    if now.italic != before.italic:
        changed["italic"] = now.italic
    grow = now.size / before.size
    runs = tuple(
        replace(
            run,
            **changed,
            size=run.size * grow,
            right=run.right * grow,
            down=run.down * grow,
            spacing=run.spacing * grow + (now.letter_spacing - before.letter_spacing) * run.size * grow,
        )
        for run in line.runs
    )
    anchor = _ANCHORS[now.align] if now.align != before.align else line.anchor
    return replace(line, runs=runs, anchor=anchor)
