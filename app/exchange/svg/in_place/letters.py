"""Texts of a file that say something else: in their elements, between the same tags where that is enough."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from typing import NamedTuple

from msgspec.structs import replace

from ....document.content import Lettering, TextLine, TextRun
from ..content_elements import common_lines, decoration, lines_of
from ..escapes import escaped
from ..flowed import place_of
from ..line_roles import line_height, place_and_height
from ..properties import Properties
from ..texts import font_of
from .found import Found, Wanted, same_content
from .letter_sizes import in_size_of
from .looks import declare, declares
from .on_paths import set_start
from .rooms import flow_anew
from .source import Node, Source, unescaped

_SPANS = ("text", "textPath", "tspan", "a")
_TOLD = ("title", "desc", "metadata")
_PLACED = ("dx", "dy", "rotate", "textLength", "lengthAdjust")
"""Attributes that place the letters of a text one by one."""


class _Words(NamedTuple):
    """Letters between two tags, as the place of a child."""

    around: Node
    place: int

    @property
    def raw(self) -> str:
        """As they are written."""
        child = self.around.children[self.place]
        assert isinstance(child, str)
        return child

    def say(self, words: str) -> None:
        """Put other words there."""
        self.around.children[self.place] = words


def reword_texts(
    source: Source,
    shown: Mapping[Node, Sequence[Found]],
    wanted: Mapping[Node, Sequence[Wanted]],
    anew: Collection[Node],
) -> bool:
    """Make texts say what those of the document do, where they are; return whether any is another one now.

    Parameters
    ----------
    source
        The file.
    shown, wanted
        What elements show, and are to show.
    anew
        Those of which it is known that it takes more than other words between their tags.
    """
    count = 0
    for node, shapes in wanted.items():
        if len(shapes) == 1 and len(shown.get(node, ())) == 1:
            count += _reword(source, node, shown[node][0], shapes[0], as_written=node not in anew)
    return count > 0


def _reword(source: Source, node: Node, found: Found, wanted: Wanted, *, as_written: bool) -> bool:
    before, after = found.content, wanted.content
    is_text = isinstance(before, Lettering) and isinstance(after, Lettering) and node.tag == "text"
    if not is_text or found.is_used or same_content(found, wanted, with_course=False):
        return False
    assert isinstance(before, Lettering)
    assert isinstance(after, Lettering)
    if before.along is not None or after.along is not None:
        can_be_said = as_written and before.along is not None and after.along is not None
        is_said = can_be_said and _say(node, before.lines, in_size_of(after, before))
        return is_said and set_start(node, before, after)
    is_wrapped = before.flow is not None or after.flow is not None
    if is_wrapped or not (as_written and _say(node, before.lines, after.lines)):
        flow_anew(source, node, before, after)
        _say_anew(source, node, found.drawn[0].state.properties, after)
    return True


# Between the tags that there are


def _say(node: Node, before: Sequence[TextLine], after: Sequence[TextLine]) -> bool:
    """Put other words between the same tags; return whether that could be done."""
    if list(map(_wordless, before)) != list(map(_wordless, after)):
        return False
    old, new = ([run for line in lines for run in line.runs] for lines in (before, after))
    there, done = iter(list(_words_in(node))), list[tuple[_Words, str]]()
    for was, now in zip(old, new, strict=True):
        core = " ".join(was.words.split())
        if not core and was.words == now.words:
            continue
        place = next((each for each in there if core == " ".join(unescaped(each.raw).split())), None)
        if place is None or not core:
            return False
        if was.words != now.words:
            done.append((place, _between(place.raw, was.words, now.words)))
    for place, words in done:
        place.say(words)
    return True


def _wordless(line: TextLine) -> TextLine:
    return replace(line, runs=tuple(replace(run, words="") for run in line.runs))


def _words_in(node: Node) -> Iterator[_Words]:
    for place, child in enumerate(node.children):
        if isinstance(child, str):
            if not child.startswith("<"):
                yield _Words(node, place)
        elif child.tag in _SPANS:
            yield from _words_in(child)


def _between(raw: str, was: str, now: str) -> str:
    """Return what stands between two tags with other words, and with the blanks around that there are."""
    core = raw.strip()
    lead, _, trail = raw.partition(core)
    first, _, last = was.partition(was.strip())
    new_first, _, new_last = now.partition(now.strip())
    lead = lead if first == new_first else new_first
    trail = trail if last == new_last else new_last
    return f"{lead}{escaped(now.strip())}{trail}"


# Anew


def _say_anew(source: Source, node: Node, around: Properties, text: Lettering) -> None:
    """Put other lines into a text, in spans of their own; what it says of itself stays."""
    first = text.lines[0]
    if text.flow is not None and text.flow.grows:
        places = [(name, float(place)) for name, place in place_of(text).items()]
    else:
        places = [("x", first.x), ("y", first.y)]
    for name in _PLACED:
        node.drop(name)
    for name, place in places:
        if node.get(name) is not None:
            node.set(name, f"{place:.10g}")
    node.set("xml:space", "preserve")
    told = [each for each in node.elements if each.tag in _TOLD]
    # Where a program of its own knows no lines, they are told by their places alone.
    knows_lines = any(name.endswith(":role") for each in node.walk() for name in each.names)
    height = line_height(text) if knows_lines else None
    if height is not None and len(text.lines) > 1:
        for name, value in place_and_height(text, height)[1].items():
            declare(node, name, value)
    new = source.adopted(lines_of(text, _decorate(node, font_of(around), text), height))
    node.children = [*told, *new]
    for each in new:
        each.parent = node
    node.fill()


def _decorate(node: Node, around: TextRun, text: Lettering) -> TextRun:
    """Take the lines from an element that not all letters of a text have; return its font without these."""
    common = replace(around, **common_lines(text))
    own = replace(
        around, underline=around.underline and common.underline, strike=around.strike and common.strike
    )
    for name in ("text-decoration", "text-decoration-line"):
        if own != around and declares(node, name):
            declare(node, name, decoration(own))
    return own
