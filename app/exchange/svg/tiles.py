"""Elements of a file as the body of a tile: by themselves, with all that they refer to and declare."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from collections.abc import Iterator, Mapping
from xml.sax.saxutils import escape, quoteattr

from .elements import Elements
from .xml_tree import reference_of, speaks_to_us, tag_of

_SERVERS = {"linearGradient", "radialGradient", "pattern", "clipPath", "mask", "filter", "marker", "symbol"}
_TAKEN = {
    *_SERVERS,
    *("g", "a", "svg", "switch", "path", "rect", "circle", "ellipse", "line", "polyline", "polygon"),
    *("text", "tspan", "image", "stop"),
}
_LETTERS = {"text", "tspan"}
_GONE = {"class", "style", "id", "href"}
_URL = re.compile(r"url\(\s*['\"]?#([^'\")]*)['\"]?\s*\)")
_DEEPEST = 32


class TileBody:
    """Copies of elements of a file in one body.

    What is referred to is defined in it; a reference to what it is within is dropped.
    """

    def __init__(self, elements: Elements) -> None:
        self._elements = elements
        self._defined: dict[str, str] = {}

    def of_pattern(self, pattern: ET.Element, holder: ET.Element, around: str) -> str:
        """Return what a pattern shows, the elements in a `holder`, in a group of these attributes.

        What cannot be there by itself, as pictures in other files, is left out.
        """
        within = (pattern.get("id", ""),)
        drawn = "".join(self._copied(child, within) for child in holder)
        declared = self._attributes(self._elements.declared(pattern), within)
        defs = "".join(self._defined.values())
        return f"{f'<defs>{defs}</defs>' if defs else ''}<g{declared}{around}>{drawn}</g>"

    def of_elements(self, holder: ET.Element) -> str:
        """Return all that is drawn of a file."""
        drawn = "".join(self._copied(child, ()) for child in holder if tag_of(child) not in _SERVERS)
        return f"<defs>{''.join(self._defined.values())}</defs>{drawn}" if self._defined else drawn

    def _copied(self, element: ET.Element, within: tuple[str, ...], name: str = "", depth: int = 0) -> str:
        tag, reference = tag_of(element), reference_of(element)
        if depth > _DEEPEST or not speaks_to_us(element):
            return ""
        if tag == "use":
            return self._used(element, within, depth)
        if tag not in _TAKEN or (tag == "image" and not reference.startswith("data:image/")):
            return ""
        attributes = {key: value for key, value in element.attrib.items() if not key.startswith("{")}
        said = {key: value for key, value in attributes.items() if key not in _GONE}
        said |= self._elements.declared(element)
        if name:
            said["id"] = name
        if reference.startswith("data:") or self._has(reference.removeprefix("#"), within):
            said["xlink:href"] = reference
        inside = "".join(self._inside(element, tag, within, depth))
        return f"<{tag}{self._attributes(said, within)}>{inside}</{tag}>"

    def _inside(self, element: ET.Element, tag: str, within: tuple[str, ...], depth: int) -> Iterator[str]:
        if tag in _LETTERS and element.text:
            yield escape(element.text)
        for child in element:
            yield self._copied(child, within, depth=depth + 1)
            if tag in _LETTERS and child.tail:
                yield escape(child.tail)

    def _used(self, element: ET.Element, within: tuple[str, ...], depth: int) -> str:
        """Return in a group what is used."""
        target = self._elements.used(element)
        if target is None:
            return ""
        shift = f"translate({element.get('x', '0')} {element.get('y', '0')})"
        said = {**self._elements.declared(element), "transform": f"{element.get('transform', '')} {shift}"}
        return f"<g{self._attributes(said, within)}>{self._copied(target, within, depth=depth + 1)}</g>"

    def _attributes(self, said: Mapping[str, str], within: tuple[str, ...]) -> str:
        """Return attributes, and define what they refer to."""
        kept = (
            (key, value)
            for key, value in said.items()
            if "url(" not in value or ((found := _URL.search(value)) and self._has(found[1], within))
        )
        return "".join(f" {key}={quoteattr(value)}" for key, value in kept)

    def _has(self, name: str, within: tuple[str, ...]) -> bool:
        """Whether something is defined, as soon as it is asked for; not what it would be within."""
        target = self._elements.by_id.get(name)
        if target is None or name in within or len(within) > _DEEPEST:
            return False
        if name not in self._defined:
            self._defined[name] = ""
            self._defined[name] = self._copied(target, (*within, name), name)
        return True
