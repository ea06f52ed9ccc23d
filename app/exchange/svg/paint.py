"""Paints of SVG: colours as CSS writes them, and those that stand for gradients and patterns.

Reference: Scalable Vector Graphics 2, section 14.2.
"""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike
from tinycss2.color4 import parse_color

from ..errors import LEFT_OUT, Flaw
from .xml_tree import Elements, tag_of

_SERVER = re.compile(r"url\(\s*['\"]?#?([^'\")]*)['\"]?\s*\)\s*(.*)", re.DOTALL)

GRADIENTS = ("linearGradient", "radialGradient")
"""The elements of gradients."""

_LONGEST_CHAIN = 20
"""Gradients that take what they do not say from each other."""


@dataclass(frozen=True)
class Paint:
    """Paint of an area or a stroke.

    Attributes
    ----------
    colour
        "#rrggbb", or "none".
    opacity
        From 0 to 1.
    flaw
        What could not be taken as it is; None if nothing.
    """

    colour: str
    opacity: float = 1.0
    flaw: Flaw | None = None


NONE = Paint("none")
_CONTEXT = Paint("none", flaw=Flaw("context paint"))


@lru_cache(maxsize=4096)
def colour_of(text: str) -> Paint | None:
    """Return a colour as CSS writes it; None for what is none."""
    try:
        parsed = parse_color(text)
        if parsed is None or isinstance(parsed, str):
            return None
        *channels, alpha = parsed.to("srgb")
    except (ValueError, TypeError, NotImplementedError):
        return None
    levels = (round(min(max(channel or 0.0, 0.0), 1.0) * 255) for channel in channels)
    opacity = 1.0 if alpha is None else min(max(float(alpha), 0.0), 1.0)
    return Paint("#" + "".join(f"{level:02x}" for level in levels), opacity)


def is_paint(text: str) -> bool:
    """Whether a value stands for a paint at all; CSS passes over others."""
    word = text.lower()
    return (
        word in ("none", "currentcolor", "inherit", "context-fill", "context-stroke")
        or word.startswith("url(")
        or colour_of(text) is not None
    )


class Paints:
    """The paints of one file."""

    def __init__(self, elements: Elements) -> None:
        self._elements = elements

    def paint(self, text: str, current: str) -> Paint:
        """Return the paint of a value, where `currentColor` is this."""
        word = text.strip()
        if word.lower() == "currentcolor":
            word = current
        if match := _SERVER.fullmatch(word):
            return self._served(match[1], match[2].strip(), current)
        if word.lower().startswith("context-"):
            return _CONTEXT
        return NONE if word.lower() == "none" else colour_of(word) or NONE

    def _served(self, name: str, fallback: str, current: str) -> Paint:
        """Return what stands for a gradient or a pattern."""
        server = self._elements.by_id.get(name)
        if server is not None and tag_of(server) in GRADIENTS:
            return self._gradient(server, current)
        plain = self.paint(fallback, current) if fallback and "url(" not in fallback else NONE
        noun = "pattern" if server is not None else "missing paint"
        if server is not None and (colours := self._colours_of(server)):
            plain = Paint(mixed(colours))
        return _instead(plain, noun)

    def _colours_of(self, pattern: ET.Element) -> list[str]:
        """Return the colours that the elements of a pattern say they are painted with."""
        declared = (self._elements.declared(each) for each in pattern.iter())
        found = (colour_of(said[name]) for said in declared for name in ("fill", "stroke") if name in said)
        return [paint.colour for paint in found if paint is not None]

    def _gradient(self, element: ET.Element, current: str) -> Paint:
        stops = stops_of(element, self._elements, lambda stop: self._stop(stop, current))
        if not stops:
            return NONE
        mean = mean_of(stops)
        if all((stop.colour, stop.opacity) == (stops[0].colour, stops[0].opacity) for stop in stops):
            return Paint(stops[0].colour, stops[0].opacity)
        return _instead(Paint(mean.colour, mean.opacity), "gradient")

    def _stop(self, stop: ET.Element, current: str) -> Stop:
        declared = self._elements.declared(stop)
        text = declared.get("stop-color", "#000000")
        plain = colour_of(current if text.lower() == "currentcolor" else text) or Paint("#000000")
        opacity = plain.opacity * share_of(declared.get("stop-opacity", "1"))
        return Stop(share_of(stop.get("offset", "0"), 0.0), plain.colour, opacity)


def share_of(text: str, default: float = 1.0) -> float:
    """Return an opacity, written as a number or in percent, from 0 to 1."""
    word = text.strip()
    try:
        value = float(word[:-1]) / 100 if word.endswith("%") else float(word)
    except ValueError:
        return default
    return min(max(value, 0.0), 1.0) if value == value else default  # noqa: PLR0124 - not a number


def _instead(paint: Paint, noun: str) -> Paint:
    """Return a paint that stands for one of another kind."""
    outcome = "came as one colour" if paint.colour != "none" else LEFT_OUT
    return replace(paint, flaw=Flaw(noun, outcome))


@dataclass(frozen=True)
class Stop:
    """A colour at a place of a gradient: from 0, its start, to 1; "#rrggbb", and an opacity."""

    offset: float
    colour: str
    opacity: float


def stops_of(element: ET.Element, elements: Elements, read: Callable[[ET.Element], Stop]) -> tuple[Stop, ...]:
    """Return the stops of a gradient: its own, or else those of the one that it refers to."""
    chain = [element]
    while True:
        if found := [child for child in chain[-1] if tag_of(child) == "stop"]:
            return _ascending([read(child) for child in found])
        target = elements.used(chain[-1])
        is_gradient = target is not None and tag_of(target) in GRADIENTS and target not in chain
        if target is None or not is_gradient or len(chain) == _LONGEST_CHAIN:
            return ()
        chain.append(target)


def mean_of(stops: Sequence[Stop]) -> Stop:
    """Return the mean colour from the start of a gradient to its end, as far as it is seen, and opacity."""
    offsets = np.array([0.0, *(stop.offset for stop in stops), 1.0])
    padded = [stops[0], *stops, stops[-1]]
    # Between two stops the mean is that of both.
    spans = np.diff(offsets) / 2
    shares = np.append(spans, 0.0) + np.append(0.0, spans)
    opacities = np.array([stop.opacity for stop in padded])
    opacity = float(shares @ opacities)
    weights = shares * opacities if opacity > 0 else shares
    return Stop(0.0, mixed([stop.colour for stop in padded], weights), opacity)


def mixed(colours: Sequence[str], weights: ArrayLike = 1.0) -> str:
    """Return the mean of colours, "#rrggbb", of these weights."""
    levels = np.array([list(bytes.fromhex(colour[1:])) for colour in colours], dtype=float)
    means = np.average(levels, axis=0, weights=np.broadcast_to(weights, len(colours)))
    return "#" + "".join(f"{level:02x}" for level in np.rint(means).astype(int).tolist())


def _ascending(stops: Sequence[Stop]) -> tuple[Stop, ...]:
    """Return stops none of which lies before another that comes earlier."""
    found, least = list[Stop](), 0.0
    for stop in stops:
        least = max(least, stop.offset)
        found.append(replace(stop, offset=least))
    return tuple(found)
