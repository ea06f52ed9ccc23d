"""Paints of SVG: colours as CSS writes them, and what becomes of gradients and patterns."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

from tinycss2.color4 import parse_color

from .xml_tree import reference_of, tag_of

_SERVER = re.compile(r"url\(\s*['\"]?#?([^'\")]*)['\"]?\s*\)\s*(.*)", re.DOTALL)
_GRADIENTS = ("linearGradient", "radialGradient")
_LONGEST_CHAIN = 20
"""Gradients that take their stops from each other."""


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
    """

    colour: str
    opacity: float = 1.0
    why: str = ""
    instead: str = ""


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
    """The paints of one file; `declared` returns what an element declares."""

    def __init__(
        self, by_id: dict[str, ET.Element], declared: Callable[[ET.Element], dict[str, str]]
    ) -> None:
        self._by_id, self._declared = by_id, declared

    def paint(self, text: str, current: str) -> Paint:
        """Return the paint of a value, where `currentColor` is this."""
        word = text.strip()
        if word.lower() == "currentcolor":
            word = current
        if match := _SERVER.fullmatch(word):
            return self._served(match[1], match[2].strip(), current)
        if word.lower().startswith("context-"):
            return Paint("none", why="it takes its colour from where it is used", instead="has none")
        return NONE if word.lower() == "none" else colour_of(word) or NONE

    def _served(self, name: str, fallback: str, current: str) -> Paint:
        """Return what stands for a gradient or a pattern."""
        server = self._by_id.get(name)
        if server is not None and tag_of(server) in _GRADIENTS:
            return self._mean(server, current)
        kind = "a pattern" if server is not None else f"“{name}”, which is not in the file,"
        plain = self.paint(fallback, current) if fallback and "url(" not in fallback else NONE
        return Paint(plain.colour, plain.opacity, f"{kind} paints it", _instead(plain.colour))

    def _mean(self, gradient: ET.Element, current: str) -> Paint:
        """Return the mean of the colours of a gradient."""
        stops = self._stops(gradient, current)
        if not stops:
            return NONE
        share = 1.0 / len(stops)
        opacity = sum(stop.opacity for stop in stops) * share
        # Colours count as much as is seen of them.
        weights = [stop.opacity / (opacity * len(stops)) if opacity else share for stop in stops]
        levels = [bytes.fromhex(stop.colour[1:]) for stop in stops]
        mean = (
            round(sum(weight * level[channel] for weight, level in zip(weights, levels, strict=True)))
            for channel in range(3)
        )
        colour = "#" + "".join(f"{min(level, 255):02x}" for level in mean)
        same = all(stop == stops[0] for stop in stops)
        return Paint(colour, opacity, *(("", "") if same else ("a gradient paints it", _instead(colour))))

    def _stops(self, gradient: ET.Element, current: str) -> list[Paint]:
        for _ in range(_LONGEST_CHAIN):
            stops = [each for each in gradient if tag_of(each) == "stop"]
            if stops:
                return [self._stop(each, current) for each in stops]
            target = self._by_id.get(reference_of(gradient).removeprefix("#"))
            if target is None or tag_of(target) not in _GRADIENTS:
                break
            gradient = target
        return []

    def _stop(self, stop: ET.Element, current: str) -> Paint:
        declared = self._declared(stop)
        text = declared.get("stop-color", "#000000")
        plain = colour_of(current if text.lower() == "currentcolor" else text) or Paint("#000000")
        return Paint(plain.colour, plain.opacity * share_of(declared.get("stop-opacity", "1")))


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
