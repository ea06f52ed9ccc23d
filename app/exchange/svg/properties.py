"""The style of SVG elements: the colour that a curve takes from it, and what no curve can take."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET

from ...document.words import enumerated
from ..drawing.styles import DARK, INK

_COLOURS = {
    "black": "#000000", "silver": "#c0c0c0", "gray": "#808080", "grey": "#808080", "white": "#ffffff",
    "maroon": "#800000", "red": "#ff0000", "purple": "#800080", "fuchsia": "#ff00ff", "magenta": "#ff00ff",
    "green": "#008000", "lime": "#00ff00", "olive": "#808000", "yellow": "#ffff00", "navy": "#000080",
    "blue": "#0000ff", "teal": "#008080", "aqua": "#00ffff", "cyan": "#00ffff", "orange": "#ffa500",
}  # fmt: skip
_NO_COLOUR = ("", "none", "transparent", "currentcolor", "context-stroke", "context-fill")
_HEXADECIMAL = re.compile("#[0-9a-f]{6}")
_RGB = re.compile(r"rgb\(\s*([\d.]+%?)[\s,]+([\d.]+%?)[\s,]+([\d.]+%?)\s*\)")

_OPAQUE = ("", "1", "1.0", "100%")
_NOTHING = ("", "none")
# What an element may say, what people call it, and the values that change nothing.
_LOST = {
    "stroke-width": ("line widths", ("", "1", "1px")),
    "stroke-dasharray": ("dashes", _NOTHING),
    "opacity": ("opacity", _OPAQUE),
    "stroke-opacity": ("opacity", _OPAQUE),
    "fill-opacity": ("opacity", _OPAQUE),
    "clip-path": ("clipping", _NOTHING),
    "mask": ("masks", _NOTHING),
    "filter": ("filters", _NOTHING),
    "marker": ("markers", _NOTHING),
    "marker-start": ("markers", _NOTHING),
    "marker-mid": ("markers", _NOTHING),
    "marker-end": ("markers", _NOTHING),
}
RULES = "the rules in <style>"
AREAS = "filled areas"


def property_of(element: ET.Element, name: str) -> str:
    """Return a property from the style attribute, or from its own."""
    return _declared(element).get(name) or element.get(name, "").strip()


def colour_of(paint: str) -> str:
    """Return a colour as the document writes it; empty for none, for our own ink and for what is unknown."""
    colour = _hexadecimal(paint)
    return colour if colour not in (INK.ink, DARK.ink, "#000000") else ""


def lost_from(element: ET.Element) -> set[str]:
    """Return what an element says of its style that no curve takes from it, in words."""
    declared = _declared(element)
    said = ((name, declared.get(name) or element.get(name, "").strip()) for name in _LOST)
    lost = {_LOST[name][0] for name, value in said if value.lower() not in _LOST[name][1]}
    for paint in (property_of(element, "stroke"), property_of(element, "fill")):
        if paint.startswith("url("):
            lost.add("gradients and patterns")
        elif paint.lower() not in (*_NO_COLOUR, "inherit") and not _hexadecimal(paint):
            lost.add(f"the colour “{paint[:20]}”")
    return lost


def remark_on(lost: set[str]) -> str:
    """Return one sentence about all that was lost; empty without."""
    return f"Of the style, this is not taken over: {enumerated(sorted(lost))}." if lost else ""


def _declared(element: ET.Element) -> dict[str, str]:
    """Return the properties in the style attribute."""
    found: dict[str, str] = {}
    for declaration in element.get("style", "").split(";"):
        name, _, value = declaration.partition(":")
        found.setdefault(name.strip(), value.replace("!important", "").strip())
    return found


def _hexadecimal(paint: str) -> str:
    text = paint.strip().lower()
    if match := re.fullmatch("#([0-9a-f])([0-9a-f])([0-9a-f])", text):
        text = "#" + "".join(digit * 2 for digit in match.groups())
    elif match := _RGB.fullmatch(text):
        text = "#" + "".join(f"{_channel(value):02x}" for value in match.groups())
    text = _COLOURS.get(text, text)
    return text if _HEXADECIMAL.fullmatch(text) else ""


def _channel(text: str) -> int:
    """Return one of red, green and blue, 0 to 255; cairo writes them in percent."""
    try:
        value = float(text[:-1]) * 2.55 if text.endswith("%") else float(text)
    except ValueError:
        value = 0.0
    return min(round(value), 255)
