"""Texts of drawings, which stay texts: written, and their words, font and size changed."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from itertools import count
from typing import Final, NamedTuple

from msgspec.structs import replace

from ...document.content import Anchor, Lettering, TextLine, TextRun, lettering, rough_box
from ...document.contents import corners_of, plane_of, refusal_of, shortened
from ...document.flow import Flow
from ...document.form_edits import framed
from ...document.limits import EditError, checked_vector
from ...document.model import Curve, Document, Vector
from ...document.several_curves import add_imported
from ...document.style import Style
from ...document.text import LINE_SPACING, Text, TextAlign
from ...qt.contents import fitted, line_step
from ...qt.glyphs import Face
from . import flowing

BOLD, WEIGHTS = 600.0, (400.0, 700.0)
"""Weight from which letters count as bold; those of letters that are not, and that are."""

LONGEST_WORDS: Final = 3000
"""Letters that can be typed of a text that stays one."""

_ALIGNED = {Anchor.START: TextAlign.LEFT, Anchor.MIDDLE: TextAlign.CENTRE, Anchor.END: TextAlign.RIGHT}
_ANCHORS = {align: anchor for anchor, align in _ALIGNED.items()} | {TextAlign.JUSTIFIED: Anchor.START}


class Look(NamedTuple):
    """How letters look, and which run of the text as it was they are of: that begins where it did.

    The first of them are moved by what their run is, and so are the first of those that were kerned since,
    each time by another number.
    """

    run: TextRun
    source: int
    kerned: int = 0


class Letters(NamedTuple):
    """Letters that look alike, one after the other."""

    words: str
    look: Look


Typed = tuple[tuple[Letters, ...], ...]
"""Lines of letters; one without any tells how those typed there look."""


Restyle = Callable[[TextRun, float], TextRun]
"""Returns how letters shall look that are of a run, a unit of whose text is so long."""


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
    if len(words) > LONGEST_WORDS:
        raise EditError(f"It has more than {LONGEST_WORDS} letters. {refusal_of(curve)}")
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
            line_spacing=_line_spacing(text),
            align=_align_of(text),
        ),
        _typed(text.lines),
        plane.scale,
    )


def _line_spacing(text: Lettering) -> float:
    """Return the way from line to line, in multiples of that of the font of the first letters."""
    run, usual = text.lines[0].runs[0], line_step(text.lines[0].runs[0])
    if text.flow is not None:
        step = text.flow.line * run.size
    else:
        step = text.lines[1].y - text.lines[0].y if len(text.lines) > 1 else usual
    least, most = LINE_SPACING
    # Of what was not set by anyone the last digits are noise.
    share = float(f"{step / usual:.9g}") if usual > 0 else 1.0
    return share if least <= share <= most else 1.0


def _align_of(text: Lettering) -> TextAlign:
    if text.flow is not None and text.flow.is_justified:
        return TextAlign.JUSTIFIED
    return _ALIGNED[text.lines[0].anchor]


def _typed(lines: Sequence[TextLine]) -> Typed:
    places = count()
    return tuple(
        tuple(Letters(run.words, Look(replace(run, words=""), next(places))) for run in line.runs)
        for line in lines
    )


def with_worded(
    document: Document,
    style: Style,
    text: Text,
    typed: Typed,
    layer: str = "",
    room: Vector | None = None,
) -> tuple[Document, range]:
    """Return the document with a text in front in a layer, and its place; there must be letters to see.

    With `room`, a width and a height, it fills a frame that has its upper left corner where the text begins.

    Raises
    ------
    EditError
        If the numbers are beyond what a document may hold.
    """
    runs = _runs(typed)
    most = max((run for line in runs for run in line), key=lambda run: len(run.words))
    step = text.line_spacing * line_step(most)
    if room is not None:
        flow = Flow(step / most.size, is_justified=text.align is TextAlign.JUSTIFIED)
        form = flowing.filling(runs, (0.0, 0.0, *room), _ANCHORS[text.align], flow)
    else:
        lines = tuple(filter(_is_seen, new_lines(text, typed)))
        form = lettering(lines, rough_box(lines))
    left, top, right, bottom = form.box
    corners = ((left, top), (right, top), (right, bottom), (left, bottom))
    frame = framed(form, [(text.x + x, text.y - y) for x, y in corners], shortened(form.title))
    curve = fitted(replace(frame, style=style))
    for point in curve.points:
        checked_vector(point.position, "a text")
    new, place = add_imported(document, Document((curve,)), layer)
    return new, range(place, place + 1)


def new_lines(text: Text, typed: Typed) -> tuple[TextLine, ...]:
    """Return the lines of a new text, also those without letters."""
    runs = _runs(typed)
    most = max((run for line in runs for run in line), key=lambda run: len(run.words))
    step = text.line_spacing * line_step(most)
    return tuple(TextLine(0.0, at * step, line, _ANCHORS[text.align]) for at, line in enumerate(runs))


def reworded(
    document: Document, edited: Worded, before: Text, now: Text, typed: Typed, style: Style
) -> tuple[Document, range]:
    """Return the document with a text that says something else; what was not changed stays as it was."""
    place = edited.places.start
    curve = document.curves[place]
    text = curve.form
    assert isinstance(text, Lettering)
    runs = _runs(typed)
    anchor = _ANCHORS[now.align] if now.align != before.align else None
    if text.flow is not None:
        flow = replace(
            text.flow,
            line=text.flow.line * now.line_spacing / before.line_spacing,
            is_justified=now.align is TextAlign.JUSTIFIED,
        )
        new = flowing.refilled(text, runs, anchor, flow)
        return document.with_curve(place, said_by(new, curve, text, style)), edited.places
    said = list(filter(_is_seen, said_lines(text, before, now, typed)))
    if not said:
        return document, edited.places
    if text.along is None:
        new = replace(text, lines=tuple(said))
    else:
        line, was = in_a_line(said), text.lines[0].anchor
        new = replace(text, lines=(line,), along=text.along.anchored(line.anchor.share, was.share))
    return document.with_curve(place, said_by(new, curve, text, style)), edited.places


def restyled(document: Document, places: Iterable[int], change: Restyle) -> Document:
    """Return the document with texts all letters of which look otherwise, and say the same.

    Raises
    ------
    EditError
        If one is longer than what can be typed.
    """
    for place in places:
        edited = worded_at(document, place)
        if edited is None:
            continue
        typed = tuple(
            tuple(each._replace(look=_changed(each.look, change, edited.scale)) for each in line)
            for line in edited.typed
        )
        style = document.curves[place].style
        document, _ = reworded(document, edited, edited.text, edited.text, typed, style)
    return document


def _changed(look: Look, change: Restyle, scale: float) -> Look:
    return look._replace(run=change(look.run, scale))


def said_lines(text: Lettering, before: Text, now: Text, typed: Typed) -> tuple[TextLine, ...]:
    """Return the lines of a text that says something else, also those without letters."""
    runs = _runs(typed)
    anchor = _ANCHORS[now.align] if now.align != before.align else None
    said = [
        replace(line, runs=run, anchor=anchor or line.anchor)
        for line, run in zip(_lines(text.lines, len(runs)), runs, strict=True)
    ]
    apart = now.line_spacing / before.line_spacing * _growth(text.lines, typed)
    first = next(filter(_is_seen, said), said[0]).y
    return tuple(replace(each, y=first + (each.y - first) * apart) for each in said)


def said_by(new: Lettering, curve: Curve, before: Lettering, style: Style) -> Curve:
    """Return a curve that is another text, called by its words where it was."""
    name = shortened(new.title) if curve.name == shortened(before.title) else curve.name
    return fitted(replace(curve, form=new, style=style, name=name))


def in_a_line(lines: Sequence[TextLine]) -> TextLine:
    """Return all lines of a text one after the other, a blank between them."""
    first, *others = lines
    runs = list(first.runs)
    for line in others:
        head, *tail = line.runs
        between = "" if runs[-1].words[-1:] in ("", " ") else " "
        runs += [replace(head, words=between + head.words), *tail]
    return replace(first, runs=tuple(runs))


def cut(typed: Typed, most: int) -> Typed:
    """Return the first letters; an end of a line is one, too."""
    found = list[tuple[Letters, ...]]()
    for line in typed:
        if most < 0:
            break
        kept = list[Letters]()
        for letters in line:
            words = letters.words[:most]
            if words or not letters.words:
                kept.append(letters._replace(words=words))
            most -= len(words)
        found.append(tuple(kept))
        most -= 1
    return tuple(found)


def _is_seen(line: TextLine) -> bool:
    return bool(line.words.strip())


def _lines(before: Sequence[TextLine], many: int) -> list[TextLine]:
    """Return so many lines, where those before were; further ones below."""
    step = before[-1].y - before[-2].y if len(before) > 1 else line_step(before[0].runs[0])
    found = list(before[:many])
    return found + [
        replace(before[-1], y=before[-1].y + below * step) for below in range(1, many - len(found) + 1)
    ]


def _runs(typed: Typed) -> list[tuple[TextRun, ...]]:
    """Return the runs of lines of letters."""
    begun, found = set[tuple[int, int]](), list[tuple[TextRun, ...]]()
    for line in typed:
        runs = list[TextRun]()
        for words, (look, *key) in line:
            source, kerned = key
            run = replace(look, words=words.replace("\t", " "))
            # What was parted is moved but once.
            is_moved = words and (source, kerned) not in begun
            runs.append(run if is_moved else replace(run, right=0.0, down=0.0))
            begun |= {(source, kerned), (source, 0)} if words else set()
        found.append(tuple(runs))
    return found


def _growth(before: Sequence[TextLine], typed: Typed) -> float:
    """Return how many times as large most letters are."""
    sizes = [run.size for line in before for run in line.runs]
    found = Counter[float]()
    for line in typed:
        for words, (run, source, _) in line:
            found[run.size / sizes[source]] += len(words)
    return found.most_common(1)[0][0] if found else 1.0
