"""Forms that show something in a frame: a text, a picture.

What is in the frame has units of its own, y downwards: those of the text, or of a picture its width and its
height. `inner` is the part of that which the frame shows, and the map from there is found from the frame.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from typing import Annotated, ClassVar, Final, Self

from msgspec.structs import replace

from .along_path import Along
from .box_form import InBox
from .fields import SHARE, Requirement, above, at_least, between, few, matching
from .flow import Flow, rough_frame, stretched
from .form import FormField, FormHandle, Piece
from .text import PlaceInLine
from .value import Value, Vector

MOST_LETTERS: Final = 20_000
"""Letters of all texts of a drawing that are read."""

MOST_DATA: Final = 24_000_000
"""Characters that the files of all pictures of a drawing take."""

MOST_PIXELS: Final = 64_000_000
"""Of a picture."""

LONGEST_LINK: Final = 4096
"""Characters of the place of a picture's file."""

_COLOUR = matching("#[0-9a-f]{6}|none|", 'be written as "#rrggbb" in lower case, or "none"')
_WORDS = Requirement(
    lambda words: len(words) <= MOST_LETTERS and not any(each < " " for each in words),
    f"be a line of at most {MOST_LETTERS} letters",
    shown=len,
)
_MANY = few(MOST_LETTERS, f"be at most {MOST_LETTERS}")
_DATA = matching("[A-Za-z0-9+/]*={0,2}", "be the file of a picture in Base64")
_LINK = Requirement(lambda link: len(link) <= LONGEST_LINK, f"be at most {LONGEST_LINK} characters")

Inner = tuple[float, float, float, float]
"""Left and upper, right and lower edge, in the units of what a frame shows."""

_BOX = Requirement(
    lambda box: len(box) == 4 and box[0] < box[2] and box[1] < box[3],
    "hold a left and an upper edge, and a right and a lower one beyond them",
    of_all=True,
)

WHOLE: Final[Inner] = (0.0, 0.0, 1.0, 1.0)
"""All of a picture."""

_NARROW, _WIDE = "iljtfrI.,:;'|!()[] ", "mwMW@%"
_WIDTHS = (0.3, 0.9, 0.68, 0.56)
"""What narrow, wide, large and other letters take of an em, about."""

_ASCENT, _DESCENT = 0.75, 0.22


class Anchor(PlaceInLine):
    """Where the place of a line of text lies along it."""

    START = "start", "Start", 0.0
    MIDDLE = "middle", "Middle", 0.5
    END = "end", "End", 1.0


class RunPaint(Value, frozen=True):
    """Paint of letters that have another one than the text; see `Style`. Its width is in units of that."""

    fill: Annotated[str, _COLOUR] = "#000000"
    fill_opacity: Annotated[float, SHARE] = 1.0
    stroke: Annotated[str, _COLOUR] = "none"
    stroke_opacity: Annotated[float, SHARE] = 1.0
    width: Annotated[float, at_least(0)] = 1.0


class TextRun(Value, frozen=True):
    """A part of a line in one font and one paint; its lengths are in units of the text.

    Attributes
    ----------
    words
        The letters.
    font
        Families of fonts, the first that there is counts.
    size
        What an em is long.
    weight, italic
        The style of the font, 400 being regular.
    spacing, word_spacing
        What lies between letters, and between words, beyond the usual.
    underline, strike
        Whether there is a line under it, and through it.
    right, down
        By how much it is moved from where it would follow, and what follows with it.
    raised
        By how much it alone lies above the line.
    paint
        How it is painted; None for the style of the text.
    """

    words: Annotated[str, _WORDS]
    font: tuple[str, ...] = ()
    size: Annotated[float, above(0)] = 16.0
    weight: Annotated[float, between(1, 1000)] = 400.0
    italic: bool = False
    spacing: float = 0.0
    right: float = 0.0
    down: float = 0.0
    paint: RunPaint | None = None
    word_spacing: float = 0.0
    underline: bool = False
    strike: bool = False
    raised: float = 0.0

    def resized(self, by: float) -> TextRun:
        """Return the run so many times as large, with its ways and spaces; its paint stays."""
        lengths = {name: getattr(self, name) * by for name in _LENGTHS}
        return replace(self, **lengths)


_LENGTHS: Final = ("size", "spacing", "word_spacing", "right", "down", "raised")
"""The fields of a run that are in units of its text."""


class TextLine(Value, frozen=True):
    """A line of a text.

    Attributes
    ----------
    x, y
        Where it is anchored on its baseline, in units of the text.
    runs
        Its parts, one after the other.
    anchor
        What of it lies there.
    """

    x: float
    y: float
    runs: Annotated[tuple[TextRun, ...], _MANY]
    anchor: Anchor = Anchor.START

    @property
    def words(self) -> str:
        """All of it."""
        return "".join(run.words for run in self.runs)


class _Content(InBox, frozen=True):
    """What is shown in a frame, from its upper left corner on."""

    stretches = True
    is_content = True
    fields: ClassVar[tuple[FormField, ...]] = (
        FormField("width", "W", "Width along its own side"),
        FormField("height", "H", "Height along its own side"),
    )

    @property
    def inner(self) -> Inner:
        """The part of what is in the frame that this shows, in the units of that."""
        raise NotImplementedError

    @property
    def title(self) -> str:
        """What it is called where nobody has named it."""
        return self.noun.capitalize()

    @property
    def pieces(self) -> Sequence[Piece]:
        """Its frame."""
        return self.sides

    @property
    def handles(self) -> Sequence[FormHandle]:
        """None: it is scaled as all is."""
        return ()


class Lettering(_Content, frozen=True):
    """A text.

    Attributes
    ----------
    lines
        Its lines; of words that fill a frame its paragraphs, which lie where they are laid out.
    box
        What the letters take, in units of the text; or the frame that they fill.
    flow
        How they fill that; None for lines that end where they do.
    along
        The course that its only line lies along; None for straight lines.
    """

    lines: Annotated[tuple[TextLine, ...], _MANY]
    box: Annotated[tuple[float, float, float, float], _BOX]
    flow: Flow | None = None
    along: Along | None = None

    noun, icon = "text", "type"
    fields = (
        *_Content.fields,
        FormField("start", "Start", "Where along its path it begins", share="start_share"),
    )

    @property
    def inner(self) -> Inner:
        """The box of its letters."""
        return self.box

    @property
    def words(self) -> str:
        """All of its words, in a line."""
        return " ".join(" ".join(line.words for line in self.lines).split())

    @property
    def title(self) -> str:
        """Its words."""
        return self.words

    @property
    def handles(self) -> Sequence[FormHandle]:
        """The sides of the frame that words fill, and a corner."""
        if self.flow is None:
            return ()
        x, y = self.middle
        return (
            FormHandle("left", (self.x, y), "width"),
            FormHandle("right", (self.right, y), "width"),
            FormHandle("lower", (x, self.y), "height"),
            FormHandle("lower right", (self.right, self.y), "size"),
        )

    def dragged(self, handle: str, to: Vector, *, ctrl: bool, shift: bool) -> Self:
        """Return the text in a frame whose side, or corner, is somewhere else."""
        left, low, right, top = self.x, self.y, self.right, self.top
        left, low = to[0] if handle == "left" else left, to[1] if "lower" in handle else low
        return self._in((left, low, to[0] if "right" in handle else right, top))

    def with_number(self, name: str, value: float) -> Self:
        """Return the text with a number that was typed: words that fill a frame wrap anew."""
        if name == "start" and self.along is not None:
            return replace(self, along=replace(self.along, start=value / self._unit, is_share=False))
        if name == "start_share" and self.along is not None:
            return replace(self, along=replace(self.along, start=value, is_share=True))
        if self.flow is None or value <= 0:
            return super().with_number(name, value)
        if name == "width":
            return self._in((self.x, self.y, self.x + value, self.top))
        return self._in((self.x, self.top - value, self.right, self.top))

    def _in(self, frame: Inner) -> Self:
        """Return the text that fills another frame, y up; itself for one without room."""
        left, low, right, top = frame
        if left >= right or low >= top or self.flow is None:
            return self
        before = (self.x, self.y, self.right, self.top)
        box = stretched(self.box, before, frame)
        flow = replace(self.flow, grows=self.flow.grows and low == self.y)
        return replace(self, x=left, y=low, width=right - left, height=top - low, box=box, flow=flow)

    @property
    def start(self) -> float:
        """Where along its path it begins, or has its middle or end: a length of the plane, or 0."""
        along = self.along
        if along is None:
            return 0.0
        return self._unit * (along.start * along.length if along.is_share else along.start)

    @property
    def start_share(self) -> float:
        """The same as a share of the length of its path."""
        return self.along.start if self.along is not None and self.along.is_share else 0.0

    def has_number(self, name: str) -> bool:
        """Whether it has a number: where it begins only along a path, as a share if that is kept so."""
        if name == "start_share":
            return self.along is not None and self.along.is_share
        return name != "start" or self.along is not None

    @property
    def _unit(self) -> float:
        return self.width / (self.box[2] - self.box[0])


class Picture(_Content, frozen=True):
    """A picture.

    Attributes
    ----------
    data
        A PNG or JPEG file in Base64; empty for one that is not there, whose frame is shown.
    part
        What of it the frame shows; beyond 0 and 1 there is nothing.
    link
        Where its file lies, as the drawing says that it came with; empty for one that was in it.
    stretched
        Whether what its file holds is to fill the frame; else it keeps its proportions.
    """

    data: Annotated[str, _DATA] = ""
    part: Annotated[tuple[float, float, float, float], _BOX] = WHOLE
    link: Annotated[str, _LINK] = ""
    stretched: bool = False

    noun, icon, has_paints = "picture", "image", False

    @property
    def inner(self) -> Inner:
        """What of it is shown."""
        return self.part


Content = Lettering | Picture
"""What a frame may show."""


def lettering(lines: tuple[TextLine, ...], box: Inner) -> Lettering:
    """Return lines of text in a box that they take, y turned up."""
    left, top, right, bottom = box
    return Lettering(left, -bottom, right - left, bottom - top, lines, box)


def rough_box_of(text: Lettering) -> Inner:
    """Return the frame of a text as whoever has no fonts finds it."""
    if text.flow is None:
        return rough_box_along(text.lines, text.along)
    first = text.lines[0]
    return rough_frame(text.box, first.y, first.runs[0].size, text.flow, len(text.lines))


def rough_box_along(lines: Sequence[TextLine], along: Along | None) -> Inner:
    """Return about what a text takes that may lie along a course."""
    if along is None:
        return rough_box(lines)
    left, top, right, bottom = along.box
    size = max(run.size for line in lines for run in line.runs)
    return (left - size, top - size, right + size, bottom + size)


def rough_box(lines: Iterable[TextLine]) -> Inner:
    """Return about what lines of text take, in their units: it hangs on no font."""
    boxes = list[Inner]()
    for line in lines:
        x, y, low, high = 0.0, line.y, line.y, line.y
        for run in line.runs:
            x, y = x + run.right, y + run.down
            own = y - run.raised
            low, high = min(low, own - _ASCENT * run.size), max(high, own + _DESCENT * run.size)
            x += rough_length(run)
        left = line.x - x * line.anchor.share
        boxes.append((left, low, left + max(x, 1e-6), high))
    lefts, tops, rights, bottoms = zip(*boxes, strict=True)
    return min(lefts), min(tops), max(rights), max(bottoms)


def rough_length(run: TextRun) -> float:
    """Return about how far the words of a run lead: it hangs on no font."""
    between = len(re.findall(" +", run.words)) * run.word_spacing
    return sum(_width(letter) * run.size + run.spacing for letter in run.words) + between


def _width(letter: str) -> float:
    narrow, wide, large, other = _WIDTHS
    if letter in _NARROW:
        return narrow
    return wide if letter in _WIDE else large if letter.isupper() else other
