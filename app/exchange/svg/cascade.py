"""The properties that SVG elements declare: attributes, the rules of <style>, and ``style`` attributes.

tinycss2 reads the rules and cssselect2 finds their elements. Nothing is fetched: an @import is passed over.
Values that CSS has for the geometry of elements replace those of their attributes, which all else reads.

Reference: Scalable Vector Graphics 2, sections 6 and 7; CSS Cascading and Inheritance 4, section 6.
"""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

import cssselect2
import tinycss2
from tinycss2.ast import FunctionBlock, IdentToken, StringToken

from ..errors import ExchangeError, Loss, Losses
from .coordinates import NUMBER, with_unit
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
"""Properties that the children of an element inherit, with their initial values."""

NOT_INHERITED = {
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
    "transform-box": "view-box",
    "vector-effect": "none",
}
"""Properties that do not, likewise."""

_SIZES = ("width", "height", "r", "rx", "ry")
_LENGTHS = ("x", "y", "cx", "cy", *_SIZES)
_TRANSFORMS = ("transform", "transform-origin")
_GEOMETRY = (*_LENGTHS, "d", *_TRANSFORMS)
"""Properties that are put in place of attributes."""

_MOVES = ("translate", "rotate", "scale")
"""Properties that are transforms before that of `transform`, in this order."""

_WITH_UNITS = re.compile("translate|rotate(?!3d)|skew")
"""Transforms whose numbers are lengths and angles."""

MAX_MATCHES = 5_000_000
"""Elements times selectors: each may have to be held against each."""

_KNOWN = frozenset((*INHERITED, *NOT_INHERITED))
_READ = frozenset((*_KNOWN, *_GEOMETRY, *_MOVES))
_ATTRIBUTES = _KNOWN - {"transform-box"}
_INITIAL = ("none", "initial", "unset", "revert", "revert-layer")
_FONT_SIZE = re.compile(
    rf"(?:^|\s)({NUMBER}(?:[a-z]+|%)|(?:xx?-|xxx-)?(?:small|large)|medium|smaller|larger)[\s/]",
    re.IGNORECASE,
)
"""The size that a `font` says: no other part of it has a unit."""

_MARKERS = ("marker-start", "marker-mid", "marker-end")
_RULE = Loss("style rule", "ignored")
_HARMLESS = ("font-face", "charset", "namespace", "keyframes")

_Declared = tuple[str, str, bool]
"""A property, its value, and whether it is important."""


class Cascade:
    """The declarations that are in force for each element of a file.

    Parameters
    ----------
    losses
        Record of the rules that are ignored.
    """

    def __init__(self, root: ET.Element, losses: Losses) -> None:
        self._missed = losses
        self._matcher = cssselect2.Matcher()
        self._selectors = 0
        for element in root.iter():
            kind = element.get("type", "").strip().lower()
            if tag_of(element) == "style" and element.text and kind in ("", "text/css"):
                self._add_sheet(element.text)
        # Only selectors need to know where an element stands.
        self._wrapped: dict[ET.Element, Any] = {}
        if self._selectors:
            if self._selectors * sum(1 for _ in root.iter()) > MAX_MATCHES:
                raise ExchangeError("The <style> has too many rules for the number of elements.")
            wrapped = cssselect2.ElementWrapper.from_xml_root(root).iter_subtree()
            self._wrapped = {wrapper.etree_element: wrapper for wrapper in wrapped}
        self._styles = {element: self._style_of(element) for element in root.iter()}
        # A root sized relative to a page keeps the size of its attributes.
        for name in ("width", "height"):
            if not with_unit(self._styles[root].get(name, "1"), 1.0):
                del self._styles[root][name]
        for element, style in self._styles.items():
            _put_geometry(element, style)

    def of(self, element: ET.Element) -> dict[str, str]:
        """Return the values of the known properties that an element declares."""
        values = {name: value.strip() for name, value in element.attrib.items() if name in _ATTRIBUTES}
        values |= self._styles[element]
        return {name: value for name, value in values.items() if value and name in _KNOWN}

    def _style_of(self, element: ET.Element) -> dict[str, str]:
        """Return the values that rules and the `style` of an element declare."""
        values: dict[str, str] = {}
        inline = element.get("style", "")
        layers = [self._matched(element), list(_named(tinycss2.parse_blocks_contents(inline or ())))]
        for is_important in (False, True):
            for layer in layers:
                values.update({name: value for name, value, important in layer if important == is_important})
        return values

    def _matched(self, element: ET.Element) -> list[_Declared]:
        """Return the declarations of the rules for an element, the weakest first."""
        wrapped = self._wrapped.get(element)
        matches = self._matcher.match(wrapped) if wrapped is not None else ()
        return [declared for _, _, pseudo, payload in matches if pseudo is None for declared in payload]

    def _add_sheet(self, text: str) -> None:
        for rule in tinycss2.parse_stylesheet(text, skip_comments=True, skip_whitespace=True):
            if rule.type == "at-rule":
                if rule.lower_at_keyword not in _HARMLESS:
                    self._missed.note(_RULE, rule, f"@{rule.at_keyword}")
            elif rule.type == "qualified-rule":
                self._add_rule(rule)

    def _add_rule(self, rule: tinycss2.ast.QualifiedRule) -> None:
        nodes = tinycss2.parse_blocks_contents(rule.content)
        for nested in (node for node in nodes if node.type in ("qualified-rule", "at-rule")):
            head = tinycss2.serialize([nested]).partition("{")[0].strip()
            self._missed.note(_RULE, nested, f"{head[:60]} within another")
        declared = list(_named(nodes))
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


def _put_geometry(element: ET.Element, style: Mapping[str, str]) -> None:
    """Set the attributes of an element that stand for properties."""
    for name in _GEOMETRY:
        if name in style and style[name].lower() in _INITIAL:
            element.attrib.pop(name, None)
        elif name in style:
            element.set(name, style[name])
    moves = [f"{name}({style[name]})" for name in _MOVES if style.get(name, "none").lower() not in _INITIAL]
    if moves:
        element.set("transform", " ".join((*moves, element.get("transform", ""))))


def _named(nodes: Iterable[Any]) -> Iterator[_Declared]:
    for node in nodes:
        if node.type == "declaration":
            for name, value in _values_of(node.lower_name, node.value):
                yield name, value, node.important


def _values_of(name: str, tokens: Sequence[Any]) -> Iterator[tuple[str, str]]:
    """Yield the properties that a declaration sets, with their values; none where CSS does not take it."""
    value = tinycss2.serialize(tokens).strip()
    words = [token for token in tokens if token.type not in ("whitespace", "comment")]
    if name == "marker":
        yield from ((marker, value) for marker in _MARKERS)
    elif name == "font" and (size := _FONT_SIZE.search(value)):
        yield "font-size", size[1]
    elif name == "d":
        yield from ((name, data) for data in _path_data(words))
    elif name in _LENGTHS:
        is_negative = any(word.value < 0 for word in words if word.type in ("dimension", "percentage"))
        if len(words) == 1 and not _lacks_units(words) and not (is_negative and name in _SIZES):
            yield name, value
    elif name in _READ and not (name in (*_TRANSFORMS, "translate") and _lacks_units(words)):
        yield name, value


def _path_data(words: Sequence[Any]) -> Iterator[str]:
    """Yield the path data of a `d`; empty for none."""
    match words:
        case [IdentToken(lower_value="none")]:
            yield ""
        case [FunctionBlock(lower_name="path", arguments=[StringToken(value=data)])]:
            yield data


def _lacks_units(words: Iterable[Any]) -> bool:
    """Whether a length or an angle lacks its unit: other than in attributes, all but 0 need one."""
    return any(
        _lacks_units(token.arguments)
        if token.type == "function" and _WITH_UNITS.match(token.lower_name)
        else token.type == "number" and token.value != 0
        for token in words
    )
