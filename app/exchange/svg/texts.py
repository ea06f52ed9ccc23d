"""Texts of an SVG file: where each line begins, in which fonts and paints.

Letters are laid out by whoever has the fonts; here they are only put together and anchored.

Reference: Scalable Vector Graphics 2, section 11.
"""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from itertools import islice
from typing import NamedTuple

import msgspec
import numpy as np

from ...document.content import (
    MOST_LETTERS,
    Anchor,
    Inner,
    Lettering,
    RunPaint,
    TextLine,
    TextRun,
    lettering,
    rough_box_along,
)
from ...document.model import MAX_MAGNITUDE
from ..errors import ExchangeError
from .elements import Elements
from .flowed import FLOW_ROOT, PARAGRAPHS, SPANS, Room, anchor_of, frame_of, width_of
from .gradients import Ground
from .lengths import length
from .paint import Paints, share_of
from .properties import Properties
from .state import State
from .text_paths import TextPaths
from .xml_tree import tag_of

_SPACE = "{http://www.w3.org/XML/1998/namespace}space"
_SPANS = ("tspan", "a", *PARAGRAPHS, *SPANS)
_PLACES = ("x", "y", "dx", "dy")
_WEIGHTS = {"normal": 400.0, "bold": 700.0}
_OF_FONTS = {"em": 1.0, "ex": 0.5}
_RAISED = {"super": 0.4, "sub": -0.2}
"""By which part of the size around it a text is raised, as Inkscape has it."""


@dataclass(frozen=True, eq=False)
class _Letter:
    """A letter with the properties in force, the elements around it, and by how much it is raised."""

    letter: str
    properties: Properties
    around: tuple[ET.Element, ...]
    is_spaced: bool
    raised: float


@dataclass(eq=False)
class _Run:
    """Letters in the same properties, moved from where they would follow."""

    properties: Properties
    right: float
    down: float
    raised: float
    letters: list[str] = field(default_factory=list)


@dataclass(eq=False)
class _Line:
    """A line that is being put together: its runs, and by how much the last is below its beginning."""

    x: float
    y: float
    anchor: Anchor
    runs: list[_Run] = field(default_factory=list)
    down: float = 0.0

    @property
    def words(self) -> str:
        return "".join("".join(run.letters) for run in self.runs)


class TextFound(NamedTuple):
    """A text, and the properties of its first letters."""

    form: Lettering
    properties: Properties


class Texts:
    """The texts of one file.

    Parameters
    ----------
    paints
        Those of the file.
    elements
        Those of the file.
    """

    def __init__(self, paints: Paints, elements: Elements) -> None:
        self._paints, self._elements, self._left = paints, elements, MOST_LETTERS
        self._paths = TextPaths(elements)

    @property
    def is_full(self) -> bool:
        """Whether there were more letters than are read."""
        return self._left < 0

    def text(self, element: ET.Element, state: State) -> TextFound | None:
        """Return a text; None where it cannot be shown."""
        if state.properties.values["writing-mode"].lower()[:2] in ("tb", "ve"):
            return None
        on, room = self._paths.found(element, state, _length), self._room(element, state)
        if on is None and room is None and tag_of(element) != "text":
            return None
        if on is None:
            # In a frame what is hidden is what has no room there, to those who wrap no words.
            passed = "visibility" if room is not None and room.frame is not None else ""
            found = self._letters(element, state.properties, (element,), 0.0, passed=passed)
            all_of_it = _collapsed(found, keeps_ends=room is not None)
        else:
            inner = state.properties.entered(self._elements.declared(on.element))
            all_of_it = _collapsed(self._letters(on.element, inner, (element, on.element), 0.0))
        letters = list(islice(all_of_it, max(self._left, 0) + 1))
        self._left -= len(letters)
        if self._left < 0:
            laid = []
        elif room is not None:
            laid = self._paragraphs(letters, state, has_place=room.frame is None)
        else:
            laid = [line for line in self._laid(letters, state) if line.words.strip()]
        if not any(line.words.strip() for line in laid) or not np.linalg.det(state.matrix[:, :2]):
            return None
        first = next(run.properties for line in laid for run in line.runs if "".join(run.letters).strip())
        common = self._paint(first, first, state)
        lines = tuple(
            TextLine(
                float(line.x),
                float(line.y),
                tuple(self._run(run, first, common, state) for run in line.runs),
                line.anchor,
            )
            for line in laid
        )
        along = on and on.along
        if along is not None:
            lines = (_in_a_line(lines, is_placed=element.get("y") is not None),)
        flow, box = (None, rough_box_along(lines, along)) if room is None else room.filled(lines, first)
        form = msgspec.structs.replace(lettering(lines, box), along=along, flow=flow)
        return TextFound(form, first) if _is_within(box) else None

    def _letters(
        self,
        element: ET.Element,
        properties: Properties,
        around: tuple[ET.Element, ...],
        raised: float,
        *,
        passed: str = "",
    ) -> Iterator[_Letter]:
        """Yield the letters within an element, whose spans do not count as declaring what is passed over."""
        white = properties.values["white-space"].lower()
        is_spaced = white.startswith("pre") or around[-1].get(_SPACE, around[0].get(_SPACE)) == "preserve"

        def said(text: str | None) -> Iterator[_Letter]:
            return (_Letter(each, properties, around, is_spaced, raised) for each in text or "")

        yield from said(element.text if tag_of(element) != FLOW_ROOT else None)
        is_first = True
        for child in element:
            if tag_of(child) in PARAGRAPHS and not is_first:
                yield _Letter("\n", properties, around, is_spaced=True, raised=raised)
            if tag_of(child) in _SPANS:
                is_first = is_first and tag_of(child) not in PARAGRAPHS
                said_there = self._elements.declared(child)
                declared = {name: value for name, value in said_there.items() if name != passed}
                inner = properties.entered(declared)
                # Of one that is hidden as a whole all is, and it is a text still.
                if inner.is_displayed or not properties.is_displayed:
                    shift = _raised(declared.get("baseline-shift", "0").lower(), inner, properties)
                    yield from self._letters(child, inner, (*around, child), raised + shift, passed=passed)
            yield from said(child.tail if tag_of(element) != FLOW_ROOT else None)

    # Places

    def _room(self, element: ET.Element, state: State) -> Room | None:
        """Return what the words of an element wrap in; None where they do not."""
        declared = self._elements.declared(element)
        frame = frame_of(element, declared, state.viewport, self._elements.by_id)
        width = width_of(declared, state.viewport) if tag_of(element) == "text" else None
        return None if frame is None and width is None else Room(frame, width or 0.0)

    def _paragraphs(self, letters: Sequence[_Letter], state: State, *, has_place: bool) -> list[_Line]:
        """Return the paragraphs of a text that wraps, with the place of the first, if it has one."""
        if not letters:
            return []
        first, places = letters[0], dict[str, float]()
        for element in first.around if has_place else ():
            for name in ("x", "y"):
                if found := _numbers(element, name, state, first):
                    places[name] = found[0]
        x, y, values = places.get("x", 0.0), places.get("y", 0.0), first.properties.values
        anchor = anchor_of(values["text-align"], values["text-anchor"])
        lines, before, shift = [_Line(x, y, anchor)], None, 0.0
        for each in letters:
            line = lines[-1]
            if before is not each.properties or each.raised != shift or not line.runs:
                line.runs.append(_Run(each.properties, 0.0, 0.0, each.raised))
                before, shift = each.properties, each.raised
            if each.letter == "\n":
                lines.append(_Line(x, y, anchor))
                if line is not lines[0] or line.words:
                    before = None
            else:
                line.runs[-1].letters.append(each.letter)
        if not lines[-1].runs:
            lines.pop()
        return lines

    def _laid(self, letters: Iterable[_Letter], state: State) -> list[_Line]:
        """Return lines: one begins wherever a letter has a place of its own."""
        counted, lists = Counter[ET.Element](), dict[ET.Element, dict[str, list[float]]]()
        lines, before, shift = list[_Line](), None, 0.0
        for each in letters:
            places = dict[str, float]()
            for element in each.around:
                if element not in lists:
                    lists[element] = {name: _numbers(element, name, state, each) for name in _PLACES}
                index, counted[element] = counted[element], counted[element] + 1
                places |= {name: held[index] for name, held in lists[element].items() if index < len(held)}
            right, down = places.get("dx", 0.0), places.get("dy", 0.0)
            if not lines or "x" in places:
                y = places.get("y", lines[-1].y + lines[-1].down if lines else 0.0)
                lines.append(_Line(places.get("x", 0.0) + right, y + down, _anchor(each.properties)))
                before, shift, right, down = None, 0.0, 0.0, 0.0
            elif "y" in places:
                down += places["y"] - lines[-1].y - lines[-1].down
            line = lines[-1]
            line.down += down
            if before is not each.properties or right or down or each.raised != shift:
                line.runs.append(_Run(each.properties, right, down, each.raised))
            line.runs[-1].letters.append(each.letter)
            before, shift = each.properties, each.raised
        return lines

    # Looks

    def _run(self, run: _Run, first: Properties, common: RunPaint, state: State) -> TextRun:
        """Return a run in the font and the paint of its letters, if that is not the common one."""
        paint = common if run.properties is first else self._paint(run.properties, first, state)
        return msgspec.structs.replace(
            font_of(run.properties),
            words="".join(run.letters),
            right=float(run.right),
            down=float(run.down),
            raised=float(run.raised),
            paint=None if paint == common else paint,
        )

    def _paint(self, properties: Properties, first: Properties, state: State) -> RunPaint:
        """Return the paint of letters, seen through as much more than the first ones as they are."""
        values = properties.values
        size = float(values["font-size"])
        outline = np.array([[(0.0, -size), (size, -size), (size, 0.0), (0.0, 0.0)]])
        ground = Ground(state.matrix, state.viewport, [outline])
        fill, stroke = (
            self._paints.paint(values[name], values["color"], ground) for name in ("fill", "stroke")
        )
        # Where the first letters are hidden all of the text is.
        is_seen = properties.is_visible or not first.is_visible
        more = min(properties.opacity / first.opacity, 1.0) if first.opacity else 1.0
        width = max(_length(values["stroke-width"], size), 0.0)
        return RunPaint(
            fill.colour if is_seen else "none",
            _share(fill.opacity, values["fill-opacity"], more),
            stroke.colour if is_seen and width else "none",
            _share(stroke.opacity, values["stroke-opacity"], more),
            width if stroke.colour != "none" else 1.0,
        )


def _in_a_line(lines: tuple[TextLine, ...], *, is_placed: bool) -> TextLine:
    """Return all lines one after the other; along a path none has a height of its own."""
    first = lines[0]
    runs = tuple(run for line in lines for run in line.runs)
    return msgspec.structs.replace(first, runs=runs, y=0.0 if is_placed else first.y)


def font_of(properties: Properties) -> TextRun:
    """Return no letters in the font of an element."""
    values = properties.values
    size = float(values["font-size"])
    return TextRun(
        "",
        _families(values["font-family"]),
        size,
        _weight(values["font-weight"].lower()),
        values["font-style"].lower() in ("italic", "oblique"),
        _length(values["letter-spacing"], size),
        word_spacing=_length(values["word-spacing"], size),
        underline="underline" in properties.decorated,
        strike="line-through" in properties.decorated,
    )


def _is_within(box: Inner) -> bool:
    # Written so that NaN fails.
    return bool((np.abs(box) <= MAX_MAGNITUDE).all()) and box[0] < box[2] and box[1] < box[3]


def _collapsed(letters: Iterable[_Letter], *, keeps_ends: bool = False) -> Iterator[_Letter]:
    """Yield letters with blanks as they are drawn: one where there are several, and none at the ends.

    Ends of lines that are written as they are may be kept.
    """
    waiting: _Letter | None = None
    is_begun = False
    for each in letters:
        if keeps_ends and each.letter == "\n" and each.is_spaced:
            waiting, is_begun = None, False
            yield each
            continue
        letter = " " if each.letter < "!" else each.letter
        if letter == " " and not each.is_spaced:
            waiting = replace(each, letter=letter) if is_begun and waiting is None else waiting
            continue
        if waiting is not None:
            yield waiting
        waiting, is_begun = None, True
        yield replace(each, letter=letter)


def _numbers(element: ET.Element, name: str, state: State, letter: _Letter) -> list[float]:
    """Return the lengths in an attribute that has one for each of the first letters; none if it is broken."""
    size = float(letter.properties.values["font-size"])
    words = [word for word in re.split(r"[\s,]+", element.get(name, "").strip()) if word]
    side = state.viewport.side(name[-1])
    try:
        found = [_in_font(word, size) if word[-2:] in _OF_FONTS else length(word, side) for word in words]
    except ExchangeError:
        return []
    return [each for each in found if each is not None] if None not in found else []


def _in_font(word: str, size: float) -> float:
    try:
        return float(word[:-2]) * size * _OF_FONTS[word[-2:]]
    except ValueError:
        return 0.0


def _length(text: str, size: float) -> float:
    word = text.lower()
    if word[-2:] in _OF_FONTS:
        return _in_font(word, size)
    try:
        found = length(word, size) or 0.0
    except ExchangeError:
        return 0.0
    return found if abs(found) <= MAX_MAGNITUDE else 0.0


def _raised(word: str, properties: Properties, around: Properties) -> float:
    own, outer = (float(each.values["font-size"]) for each in (properties, around))
    if word in _RAISED:
        return _RAISED[word] * outer
    return _length(word, outer if word.endswith("%") else own)


def _anchor(properties: Properties) -> Anchor:
    word = properties.values["text-anchor"].lower()
    return next((each for each in Anchor if each.value == word), Anchor.START)


def _families(text: str) -> tuple[str, ...]:
    words = (each.strip().strip("\"'").strip() for each in text.split(","))
    return tuple(each for each in words if each and each.isprintable())


def _weight(word: str) -> float:
    try:
        weight = _WEIGHTS[word] if word in _WEIGHTS else float(word)
    except ValueError:
        weight = 400.0
    return weight if 1 <= weight <= 1000 else 400.0


def _share(*shares: float | str) -> float:
    product = 1.0
    for each in shares:
        product *= share_of(each) if isinstance(each, str) else each
    return round(product, 6)
