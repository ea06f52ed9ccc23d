"""Texts whose words fill a frame, as Inkscape writes and reads them.

The frame is a rectangle among the definitions, to which `shape-inside` refers, or a width, `inline-size`; old
files have a `flowRoot`. Beside that each line has a place of its own, for whoever wraps no words.

Reference: Scalable Vector Graphics 2, section 11.5.
"""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from itertools import pairwise
from typing import Final, NamedTuple

from msgspec.structs import replace

from ...document.content import Anchor, Inner, Lettering, TextLine, TextRun
from ...document.flow import USUAL_LINE, Flow, rough_frame
from ...document.wrapping import laid_out
from ..errors import ExchangeError
from .lengths import Viewport, length
from .numbers import number
from .properties import Properties
from .xml_tree import tag_of

FLOW_ROOT: Final = "flowRoot"
PARAGRAPHS: Final = ("flowPara", "flowLine", "flowDiv")
SPANS: Final = ("flowSpan",)

_ALIGNED = {
    "start": Anchor.START,
    "left": Anchor.START,
    "center": Anchor.MIDDLE,
    "end": Anchor.END,
    "right": Anchor.END,
    "justify": Anchor.START,
}
_WORDS = {Anchor.START: "start", Anchor.MIDDLE: "center", Anchor.END: "end"}
_REFERENCE = re.compile(r"url\(\s*[\"']?#([^\"')\s]+)")
_LINES = (0.05, 100.0)


# Read


def frame_of(
    element: ET.Element,
    declared: Mapping[str, str],
    viewport: Viewport,
    by_id: Mapping[str, ET.Element],
) -> Inner | None:
    """Return the rectangle that the words of an element fill, y down; None without one."""
    if tag_of(element) == FLOW_ROOT:
        region = next((each for each in element if tag_of(each) == "flowRegion"), None)
        rect = None if region is None else next(iter(region), None)
    else:
        found = _REFERENCE.match(declared.get("shape-inside", ""))
        rect = by_id.get(found[1]) if found is not None else None
    if rect is None or tag_of(rect) != "rect" or (rect.get("transform") or "none") != "none":
        return None
    sides = {"x": viewport.width, "y": viewport.height, "width": viewport.width, "height": viewport.height}
    with suppress(ExchangeError):
        x, y, width, height = (length(rect.get(name, "0"), side) or 0.0 for name, side in sides.items())
        if width > 0 < height:
            return x, y, x + width, y + height
    return None


def width_of(declared: Mapping[str, str], viewport: Viewport) -> float | None:
    """Return the width in which the words of an element wrap that has no frame; None without one."""
    with suppress(ExchangeError):
        width = length(declared.get("inline-size", "auto").replace("auto", "0"), viewport.width) or 0.0
        return width if width > 0 else None
    return None


def anchor_of(align: str, anchor: str) -> Anchor:
    """Return where lines stand, by two properties; the second counts where the first says nothing."""
    found = _ALIGNED.get(align.lower(), Anchor.START)
    if found is not Anchor.START or align.lower() in ("left", "justify"):
        return found
    return next((each for each in Anchor if each.value == anchor.lower()), Anchor.START)


def flow_of(line: str, size: float, *, grows: bool, is_justified: bool = False) -> Flow:
    """Return how words fill their frame, by the height of a line."""
    word, height = line.lower(), USUAL_LINE
    with suppress(ValueError, ExchangeError):
        if word.endswith("%"):
            height = float(word[:-1]) / 100
        elif word != "normal":
            plain = word.removesuffix("em")
            height = float(plain) if plain != word or _is_number(word) else (length(word) or 0.0) / size
    return Flow(height if _LINES[0] <= height <= _LINES[1] else USUAL_LINE, grows, is_justified)


def _is_number(word: str) -> bool:
    with suppress(ValueError):
        float(word)
        return True
    return False


class Room(NamedTuple):
    """What words wrap in: a frame, or without one a width."""

    frame: Inner | None
    width: float

    def filled(self, lines: Sequence[TextLine], first: Properties) -> tuple[Flow, Inner]:
        """Return how paragraphs fill it, whose first letters have some properties, and about their box."""
        line = lines[0]
        size = line.runs[0].size
        is_justified = first.values["text-align"].lower() == "justify"
        grows = self.frame is None
        flow = flow_of(first.values["line-height"], size, grows=grows, is_justified=is_justified)
        left = line.x - self.width * line.anchor.share
        rough = self.frame or (left, 0.0, left + self.width, 1.0)
        return flow, rough_frame(rough, line.y, size, flow, len(lines))


# Written


def frame_element(text: Lettering, name: str) -> str:
    """Return the rectangle that the words of a text fill."""
    said = "".join(f' {side}="{value}"' for side, value in sizes(text).items())
    return f'<rect id="{name}"{said}/>'


def sizes(text: Lettering) -> dict[str, str]:
    """Return where the rectangle that the words of a text fill lies."""
    left, top, right, bottom = text.box
    values = {"x": left, "y": top, "width": right - left, "height": bottom - top}
    return {name: number(float(f"{value:.12g}")) for name, value in values.items()}


def declarations(text: Lettering, frame: str) -> dict[str, str]:
    """Return the properties of a text that fills the frame of a name."""
    flow = text.flow
    assert flow is not None
    found = {"line-height": number(flow.line), "white-space": "pre"}
    if flow.is_justified:
        found["text-align"] = "justify"
    elif text.lines[0].anchor is not Anchor.START:
        found["text-align"] = _WORDS[text.lines[0].anchor]
    if flow.grows:
        found["inline-size"] = number(text.box[2] - text.box[0])
        found["text-anchor"] = text.lines[0].anchor.value
    else:
        found["shape-inside"] = f"url(#{frame})"
    return found


def place_of(text: Lettering) -> dict[str, str]:
    """Return the place from which a text wraps that has no frame but a width."""
    if text.flow is None or not text.flow.grows:
        return {}
    left, _, right, _ = text.box
    x = left + (right - left) * text.lines[0].anchor.share
    return {"x": number(x), "y": number(text.lines[0].y)}


def with_style(said: str, declared: Mapping[str, str]) -> str:
    """Return attributes with further declarations in their style."""
    words = ";".join(f"{name}:{value}" for name, value in declared.items())
    if ' style="' in said:
        return said.replace(' style="', f' style="{words};', 1)
    return f'{said} style="{words}"'


def flowed_lines(text: Lettering, run_element: Callable[[TextRun, Sequence[float]], str]) -> str:
    """Return the lines of a text that fills a frame, each at its place; a paragraph ends with its line.

    `run_element` writes a run whose letters are moved by ways of their own, if there are any.
    """
    laid, found = laid_out(text), list[str]()
    anchor, (left, _, right, _) = text.lines[0].anchor, text.box
    for at, (line, is_end) in enumerate(zip(laid.lines, laid.ends, strict=True)):
        stretch = laid.stretches[at]
        # Stretched by ways of letters, as Inkscape does: it takes them for none of the text.
        runs = [replace(run, word_spacing=run.word_spacing - stretch) for run in line.runs]
        last, x, blanks = runs[-1], line.x, ""
        end = "\n" if is_end and at + 1 < len(laid.lines) else ""
        if text.flow is not None and text.flow.grows:
            x = left + (right - left) * anchor.share
            if anchor is not Anchor.START and (words := last.words.rstrip(" ")) != last.words:
                # A line is as long as what is seen of it.
                blanks = f'<tspan y="{number(line.y)}">{last.words[len(words) :]}{end}</tspan>'
                end, runs[-1] = "", replace(last, words=words)
        said = "".join(map(run_element, runs, _ways(runs, stretch)))
        # To Inkscape a span is never hidden, and it shows what has room for itself.
        unseen = ' visibility="hidden"' if 0 < laid.seen <= at else ""
        found.append(f'<tspan x="{number(x)}" y="{number(line.y)}"{unseen}>{said}{end}{blanks}</tspan>')
    return "".join(found)


def _ways(runs: Sequence[TextRun], stretch: float) -> Iterator[list[float]]:
    """Yield by how much each letter of a run is moved where words stand further apart; nothing elsewhere."""
    before = ""
    for run in runs:
        ways = [stretch if at == " " != letter else 0.0 for at, letter in pairwise(before + run.words)]
        if not before:
            ways.insert(0, 0.0)
        if ways:
            ways[0] += run.right
        while ways and not ways[-1]:
            ways.pop()
        yield [float(f"{way:.12g}") for way in ways] if stretch else []
        before = run.words[-1:] or before
