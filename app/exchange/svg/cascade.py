"""The properties that SVG elements declare: attributes, the rules of <style>, and ``style`` attributes.

tinycss2 reads the rules and cssselect2 finds their elements. Nothing is fetched: an @import is passed over.

Reference: Scalable Vector Graphics 2, section 6; CSS Cascading and Inheritance 4, section 6.
"""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from collections.abc import Iterable, Iterator
from typing import Any

import cssselect2
import tinycss2

from ..errors import ExchangeError, Flaw, Missed
from .xml_tree import tag_of

INHERITED = {
    "color": "#000000",
    "fill": "#000000",
    "fill-opacity": "1",
    "fill-rule": "nonzero",
    "paint-order": "normal",
    "stroke": "none",
    "stroke-dasharray": "none",
    "stroke-dashoffset": "0",
    "stroke-linecap": "butt",
    "stroke-linejoin": "miter",
    "stroke-miterlimit": "4",
    "stroke-opacity": "1",
    "stroke-width": "1",
    "visibility": "visible",
    "marker-start": "none",
    "marker-mid": "none",
    "marker-end": "none",
}
"""Properties that pass to what an element holds, with what they are at first."""

OWN = {
    "clip-path": "none",
    "display": "inline",
    "filter": "none",
    "font-size": "",
    "mask": "none",
    "mix-blend-mode": "normal",
    "opacity": "1",
    "overflow": "",
    "stop-color": "#000000",
    "stop-opacity": "1",
    "transform": "",
    "vector-effect": "none",
}
"""Properties that do not, likewise."""

MAX_MATCHES = 5_000_000
"""Elements times selectors: each may have to be held against each."""

_KNOWN = frozenset((*INHERITED, *OWN))
_FONT_SIZE = re.compile(
    r"(?:^|\s)([-+]?[.\d][-+.\de]*(?:[a-z]+|%)|(?:xx?-|xxx-)?(?:small|large)|medium|smaller|larger)[\s/]",
    re.IGNORECASE,
)
"""The size that a `font` says: no other part of it has a unit."""

_MARKERS = ("marker-start", "marker-mid", "marker-end")
_RULE = Flaw("style rule", "not followed")
_HARMLESS = ("font-face", "charset", "namespace", "keyframes")

_Declared = tuple[str, str, bool]
"""A property, its value, and whether it is important."""


class Cascade:
    """The declarations that are in force for each element of a file.

    Parameters
    ----------
    missed
        Takes note of the rules that are not followed.
    """

    def __init__(self, root: ET.Element, missed: Missed) -> None:
        self._missed = missed
        self._matcher = cssselect2.Matcher()
        self._selectors = 0
        for element in root.iter():
            if tag_of(element) == "style" and element.text:
                self._add_sheet(element.text)
        # Only selectors need to know where an element stands.
        self._wrapped: dict[ET.Element, Any] = {}
        if self._selectors:
            if self._selectors * sum(1 for _ in root.iter()) > MAX_MATCHES:
                raise ExchangeError("The rules in its <style> are too many for its elements.")
            wrapped = cssselect2.ElementWrapper.from_xml_root(root).iter_subtree()
            self._wrapped = {each.etree_element: each for each in wrapped}

    def of(self, element: ET.Element) -> dict[str, str]:
        """Return the values of the known properties that an element declares."""
        found = {name: value.strip() for name, value in element.attrib.items() if name in _KNOWN}
        found.pop("transform", None)
        inline = element.get("style", "")
        layers = [self._matched(element), _declarations(inline) if inline else []]
        for is_important in (False, True):
            for layer in layers:
                found.update({name: value for name, value, important in layer if important == is_important})
        return {name: value for name, value in found.items() if value}

    def _matched(self, element: ET.Element) -> list[_Declared]:
        """Return what the rules declare for an element, the weakest first."""
        wrapped = self._wrapped.get(element)
        if wrapped is None:
            return []
        matches = self._matcher.match(wrapped)
        return [each for _, _, pseudo, payload in matches if pseudo is None for each in payload]

    def _add_sheet(self, text: str) -> None:
        for rule in tinycss2.parse_stylesheet(text, skip_comments=True, skip_whitespace=True):
            if rule.type == "at-rule":
                if rule.lower_at_keyword not in _HARMLESS:
                    self._missed.note(_RULE, rule, f"@{rule.at_keyword}")
            elif rule.type == "qualified-rule":
                self._add_rule(rule)

    def _add_rule(self, rule: tinycss2.ast.QualifiedRule) -> None:
        declared = list(_named(tinycss2.parse_blocks_contents(rule.content)))
        if not declared:
            return
        try:
            selectors = cssselect2.compile_selector_list(rule.prelude)
        except cssselect2.SelectorError:
            self._missed.note(_RULE, rule, tinycss2.serialize(rule.prelude).strip()[:60])
            return
        for selector in selectors:
            self._matcher.add_selector(selector, declared)
            self._selectors += 1


def _declarations(text: str) -> list[_Declared]:
    """Return what a ``style`` attribute declares of the known properties."""
    return list(_named(tinycss2.parse_blocks_contents(text)))


def _named(nodes: Iterable[Any]) -> Iterator[_Declared]:
    for node in nodes:
        if node.type != "declaration":
            continue
        name, value = node.lower_name, tinycss2.serialize(node.value).strip()
        if name == "font" and (size := _FONT_SIZE.search(value)):
            name, value = "font-size", size[1]
        for each in _MARKERS if name == "marker" else (name,):
            if each in _KNOWN:
                yield each, value, node.important
