"""Paints of SVG: colours as CSS writes them, gradients and patterns."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from dataclasses import dataclass
from functools import lru_cache

from tinycss2.color4 import parse_color

from ...document.gradient import Gradient, Stop
from .elements import Elements
from .gradients import KINDS, Gradients, Ground, UnplacedError
from .patterns import PATTERN, Patterns
from .xml_tree import tag_of

_SERVER = re.compile(r"url\(\s*['\"]?#?([^'\")]*)['\"]?\s*\)\s*(.*)", re.DOTALL)


@dataclass(frozen=True)
class Paint:
    """Paint of an area or a stroke.

    Attributes
    ----------
    colour
        "#rrggbb", or "none".
    opacity
        From 0 to 1.
    why, instead
        What could not be taken as it is, and what was done; empty if nothing.
    gradient
        What paints in place of the colour.
    """

    colour: str
    opacity: float = 1.0
    why: str = ""
    instead: str = ""
    gradient: Gradient | None = None


NONE = Paint("none")


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
        self._gradients, self._patterns = Gradients(elements, self._stop), Patterns(elements)

    def paint(self, text: str, current: str, ground: Ground) -> Paint:
        """Return the paint of a value on a ground, where `currentColor` is this."""
        word = text.strip()
        if word.lower() == "currentcolor":
            word = current
        if match := _SERVER.fullmatch(word):
            return self._served(match[1], match[2].strip(), current, ground)
        if word.lower().startswith("context-"):
            return Paint("none", why="it takes its colour from where it is used", instead="has none")
        return NONE if word.lower() == "none" else colour_of(word) or NONE

    def _served(self, name: str, fallback: str, current: str, ground: Ground) -> Paint:
        """Return a gradient or a pattern, or what stands for it."""
        server = self._elements.by_id.get(name)
        if server is not None and tag_of(server) in KINDS:
            return self._gradient(server, current, ground)
        plain = self.paint(fallback, current, ground) if fallback and "url(" not in fallback else NONE
        if server is not None and tag_of(server) == PATTERN:
            try:
                colour = plain.colour if plain is not NONE else self._first_colour(server)
                found = self._patterns.pattern(server, ground, colour)
                return Paint(found.mean, gradient=found)
            except UnplacedError:
                pass
        kind = "a pattern" if server is not None else f"“{name}”, which is not in the file,"
        return Paint(plain.colour, plain.opacity, f"{kind} paints it", _instead(plain.colour))

    def _first_colour(self, pattern: ET.Element) -> str:
        """Return the first colour that a pattern paints with; black where it says none."""
        declared = (self._elements.declared(each) for each in pattern.iter())
        found = (colour_of(said[name]) for said in declared for name in ("fill", "stroke") if name in said)
        return next((paint.colour for paint in found if paint is not None), "#000000")

    def _gradient(self, element: ET.Element, current: str, ground: Ground) -> Paint:
        stops = self._gradients.stops(element, current)
        if not stops:
            return NONE
        if all((stop.colour, stop.opacity) == (stops[0].colour, stops[0].opacity) for stop in stops):
            return Paint(stops[0].colour, stops[0].opacity)
        try:
            found = self._gradients.gradient(element, stops, ground)
        except UnplacedError:
            mean = Gradient(stops).mean
            opacity = sum(stop.opacity for stop in stops) / len(stops)
            return Paint(mean, opacity, "a gradient paints it that has no place", _instead(mean))
        has_disc = self._gradients.begins_with_a_disc(element)
        said = ("its gradient begins with a disc", "it begins in a point") if has_disc else ("", "")
        return Paint(found.mean, 1.0, *said, gradient=found)

    def _stop(self, stop: ET.Element, current: str) -> Stop:
        declared = self._elements.declared(stop)
        text = declared.get("stop-color", "#000000")
        plain = colour_of(current if text.lower() == "currentcolor" else text) or Paint("#000000")
        opacity = plain.opacity * share_of(declared.get("stop-opacity", "1"))
        return Stop(share_of(stop.get("offset", "0"), 0.0), plain.colour, round(opacity, 6))


def share_of(text: str, default: float = 1.0) -> float:
    """Return an opacity, written as a number or in percent, from 0 to 1."""
    word = text.strip()
    try:
        value = float(word[:-1]) / 100 if word.endswith("%") else float(word)
    except ValueError:
        return default
    return min(max(value, 0.0), 1.0) if value == value else default  # noqa: PLR0124 - not a number


def _instead(colour: str) -> str:
    return f"{colour} does" if colour != "none" else "nothing does"
