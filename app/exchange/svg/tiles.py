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

    What is referred to is defined in it, and numbered: what is read again has the same names. A reference to
    what it is within is dropped.
    """

    def __init__(self, elements: Elements) -> None:
        self._elements = elements
        self._defined: dict[str, str] = {}
        self._names: dict[str, str] = {}

    def of_pattern(self, pattern: ET.Element, holder: ET.Element) -> str:
        """Return what a pattern shows, the elements in a `holder`, in a group of what it declares.

        What cannot be there by itself, as pictures in other files, is left out.
        """
        within = (pattern.get("id", ""),)
        drawn = "".join(self._copied(child, within) for child in holder)
        said = dict(self._elements.declared(pattern))
        declared = self._attributes(said, within)
        defs = "".join(self._defined.values())
        drawn = f"<g{declared}>{drawn}</g>" if declared else drawn
        return f"<defs>{defs}</defs>{drawn}" if defs else drawn

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
            said["id"] = self._name(name)
        if reference.startswith("data:"):
            said["xlink:href"] = reference
        elif self._has(reference.removeprefix("#"), within):
            said["xlink:href"] = f"#{self._name(reference.removeprefix('#'))}"
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
        kept = dict(said)
        for key, value in said.items():
            if "url(" in value:
                found = _URL.search(value)
                if found is None or not self._has(found[1], within):
                    del kept[key]
                else:
                    kept[key] = f"url(#{self._name(found[1])}){value[found.end() :]}"
        return "".join(f" {key}={quoteattr(value)}" for key, value in kept.items())

    def _name(self, name: str) -> str:
        """Return what something that is defined is called here."""
        return self._names[name]

    def _has(self, name: str, within: tuple[str, ...]) -> bool:
        """Whether something is defined, as soon as it is asked for; not what it would be within."""
        target = self._elements.by_id.get(name)
        if target is None or name in within or len(within) > _DEEPEST:
            return False
        if name not in self._defined:
            self._defined[name], self._names[name] = "", f"d{len(self._names) + 1}"
            self._defined[name] = self._copied(target, (*within, name), name)
        return True
