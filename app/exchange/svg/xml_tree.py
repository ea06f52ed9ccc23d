"""XML trees of SVG files, and the names and references of their elements.

Entities and default values that a DOCTYPE declares within the file are followed within bounds; nothing
outside the file is ever read. There are neither many elements nor deep ones. Names are those of the dialects
of several programs.
"""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from collections import Counter
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import NoReturn
from xml.parsers.expat.errors import XML_ERROR_UNDEFINED_ENTITY, codes

from defusedxml.ElementTree import DefusedXMLParser

from ..errors import ExchangeError

MAX_ELEMENTS = 10_000
MAX_DEPTH = 200

MAX_TEXT = 2**16
"""Characters that entities and default values may add to a file."""

MAX_NESTING = 4
"""Entities within each other."""

_NOT_WITHIN = (
    "The DOCTYPE declares or uses {}, which is not supported. Save the file as plain SVG; or, if it contains "
    "no “&name;”, delete everything from “<!DOCTYPE” to “]>” in a text editor."
)
_ENTITY = r"&([^#&;\s][^&;\s]*);"
_PREDEFINED = ("amp", "lt", "gt", "quot", "apos")

_LONGEST_NAME = 200

INKSCAPE_SPACE = "http://www.inkscape.org/namespaces/inkscape"
SODIPODI_SPACE = "http://sodipodi.sourceforge.net/DTD/sodipodi-0.dtd"
"""Namespaces of attributes that only Inkscape reads."""

SODIPODI = f"{{{SODIPODI_SPACE}}}"
INSENSITIVE = f"{SODIPODI}insensitive"
NODE_TYPES = f"{SODIPODI}nodetypes"
_LABELS = (
    f"{{{INKSCAPE_SPACE}}}label",
    "{http://www.serif.com/}id",  # Affinity
    "data-name",  # Illustrator
)

_ESCAPED = re.compile("_x([0-9A-Fa-f]{2,5})_")
"""A character as Illustrator writes it in an id."""

_REFERENCE = re.compile(r"url\(\s*['\"]?#([^'\")]*)['\"]?\s*\)")


def parse_xml(data: bytes, most_elements: int = MAX_ELEMENTS) -> ET.Element:
    """Return the root of an XML file.

    External entities of a DOCTYPE are not read; internal ones, as of Illustrator and Sodipodi, are.

    Raises
    ------
    ExchangeError
        With the position, for invalid XML; for entities that are outside the file, that are parameters, or
        that come to more than `MAX_NESTING` and `MAX_TEXT`; for more than `most_elements`, and elements
        deeper than `MAX_DEPTH`.
    """
    if not data.strip():
        raise ExchangeError("The file is empty.")
    try:
        return _tree(data, most_elements)
    except _ExternalId as found:
        return _tree(_without_external_id(data, *found.args), most_elements, may_point_outside=False)


def tag_of(element: ET.Element) -> str:
    """Return an element's name without its namespace."""
    return str(element.tag).rpartition("}")[2]


def reference_of(element: ET.Element) -> str:
    """Return the reference of an element: "#" and an id, an address, or nothing."""
    return (element.get("href") or element.get("{http://www.w3.org/1999/xlink}href") or "").strip()


def is_for_english_readers(element: ET.Element) -> bool:
    """Whether an element of a `switch` is for all languages, or for English."""
    language = element.get("systemLanguage", "en")
    return not element.get("requiredExtensions") and any(
        tag.strip().startswith("en") for tag in language.split(",")
    )


def _tree(data: bytes, most_elements: int, *, may_point_outside: bool = True) -> ET.Element:
    declared = _Declared(data)
    parser = _Parser(_CountingBuilder(declared, most_elements), declared, may_point_outside)
    try:
        parser.feed(data)
        root: ET.Element = parser.close()
    except ET.ParseError as problem:
        line, column = problem.position
        undefined = problem.code == codes[XML_ERROR_UNDEFINED_ENTITY]
        message = "An entity “&…;” is not declared in the file" if undefined else "The file is not XML"
        raise ExchangeError(f"{message}: line {line}, column {column + 1}.") from None
    except (ValueError, LookupError) as problem:
        if isinstance(problem, ExchangeError):
            raise
        raise ExchangeError("The file is not XML: its encoding is unknown.") from None
    return root


class _ExternalId(Exception):  # noqa: N818 - found, not wrong
    """A DOCTYPE points to a DTD outside the file, after a keyword and before the “[” or “>” at this place."""


class _Parser(DefusedXMLParser):  # type: ignore[misc]  # that package has no types
    """Parser that stops at an external DOCTYPE, and refuses parameter entities and external ones.

    After an external DOCTYPE Expat would silently drop every “&name;” in an attribute, as an unread
    DTD might declare it.
    """

    def __init__(self, builder: _CountingBuilder, declared: _Declared, may_point_outside: bool) -> None:
        super().__init__(target=builder, forbid_dtd=True)
        self._declared, self._may_point_outside = declared, may_point_outside
        self.parser.AttlistDeclHandler = declared.attribute

    def defused_start_doctype_decl(
        self, _name: str, sysid: str | None, pubid: str | None, _has_internal_subset: int
    ) -> None:
        if sysid is not None or pubid is not None:
            if not self._may_point_outside:
                raise ExchangeError("The file is not XML: its DOCTYPE is broken.")
            raise _ExternalId(b"SYSTEM" if pubid is None else b"PUBLIC", self.parser.CurrentByteIndex)
        # From here on this handler is only called for references to parameter entities.
        self.parser.NotStandaloneHandler = _refused_parameter

    def defused_entity_decl(
        self, name: str, is_parameter: bool, value: str | None, *_outside: object
    ) -> None:
        if is_parameter:
            _refused_parameter()
        if value is None:
            raise ExchangeError(_NOT_WITHIN.format("an entity outside the file"))
        self._declared.entity(name, value)

    def defused_unparsed_entity_decl(self, name: str, *_outside: object) -> None:
        self.defused_entity_decl(name, False, None)


def _refused_parameter() -> NoReturn:
    raise ExchangeError(_NOT_WITHIN.format("a parameter entity"))


class _Declared:
    """Entities and default values that a DOCTYPE declares, and how much text they add to a file.

    Counted before the text is made, by the references in the file, in any encoding, those
    in comments and in other entities included.
    """

    def __init__(self, data: bytes) -> None:
        self._data, self._added = data, 0
        self._entities = dict.fromkeys(_PREDEFINED, (1, 0))
        self._defaults: Counter[str] = Counter()

    def entity(self, name: str, value: str) -> None:
        """Record the length of an entity with its nested ones, and their depth."""
        inner = Counter(re.findall(_ENTITY, value))
        if unknown := next((reference for reference in inner if reference not in self._entities), None):
            raise ExchangeError(
                f"The entity “{name[:40]}” uses “&{unknown[:40]};”, which is not declared before it."
            )
        depth = 1 + max((self._entities[reference][1] for reference in inner), default=0)
        if depth > MAX_NESTING:
            raise ExchangeError(f"The entity “{name[:40]}” is nested deeper than {MAX_NESTING} levels.")
        size = len(value) + sum(count * self._entities[reference][0] for reference, count in inner.items())
        self._entities[name] = size, depth
        self._add(size * (self._uses[name.encode()] if name.isascii() else self._uses.total()))

    @cached_property
    def _uses(self) -> Counter[bytes]:
        # All encodings of Expat write letters as ASCII, but for the zeros of UTF-16.
        return Counter(re.findall(_ENTITY.encode(), self._data.replace(b"\0", b"")))

    def attribute(self, element: str, name: str, _kind: str, default: str | None, _required: int) -> None:
        """Record the length of a default value."""
        self._add(len(name))
        if default is not None:
            self._defaults[element.rpartition(":")[2]] += len(name) + len(default)

    def use_defaults(self, element: str) -> None:
        """Count the default values of an element."""
        self._add(self._defaults[element])

    def _add(self, length: int) -> None:
        self._added += length
        if self._added > MAX_TEXT:
            raise ExchangeError(f"Entities and default values of the DOCTYPE exceed {MAX_TEXT // 1024} KB.")


def _without_external_id(data: bytes, keyword: bytes, end: int) -> bytes:
    """Return the file with blanks from a keyword in its DOCTYPE to the mark at `end`, of the same length."""
    # In UTF-16 every character takes two bytes, and the zero stands before or after.
    width = 2 if 0 in data[end : end + 2] else 1
    unit = data[end : end + width]
    mark = unit.strip(b"\0")

    def written(text: bytes) -> bytes:
        return b"".join(unit.replace(mark, bytes([letter])) for letter in text)

    start = data.find(written(keyword), data.rfind(written(b"<!DOCTYPE"), 0, end), end)
    newline, space = written(b"\n"), written(b" ")
    units = (data[position : position + width] for position in range(start, end, width)) if start > 0 else ()
    blank = b"".join(newline if unit_at == newline else space for unit_at in units)
    return data[: end - len(blank)] + blank + data[end:]


class _CountingBuilder(ET.TreeBuilder):
    """Builder of the tree that refuses large and deep ones."""

    def __init__(self, declared: _Declared, most_elements: int) -> None:
        super().__init__()
        self._declared, self._most = declared, most_elements
        self._count = self._depth = 0

    def start(self, tag: str, attributes: dict[str, str], /) -> ET.Element:
        self._count += 1
        self._depth += 1
        if self._count > self._most:
            raise ExchangeError(f"The file has more than {self._most} elements.")
        if self._depth > MAX_DEPTH:
            raise ExchangeError(f"Element {self._count} is nested deeper than {MAX_DEPTH} levels.")
        self._declared.use_defaults(tag.rpartition("}")[2])
        return super().start(tag, attributes)

    def end(self, tag: str, /) -> ET.Element:
        self._depth -= 1
        return super().end(tag)


def name_of(element: ET.Element) -> str:
    """Return the name of an element: its label, its title or its id; empty without."""
    label = next((element.get(attribute, "") for attribute in _LABELS if element.get(attribute)), "")
    title = next((child.text for child in element if tag_of(child) == "title" and child.text), "")
    name = label or title or _ESCAPED.sub(_unescaped, element.get("id", ""))
    return " ".join(name.split())[:_LONGEST_NAME]


def label_of(element: ET.Element) -> str:
    """Return a label for an element: its name, or its text; empty without."""
    return name_of(element) or " ".join("".join(element.itertext()).split())[:40]


def _unescaped(match: re.Match[str]) -> str:
    letter = chr(int(match[1], 16))
    return letter if letter.isprintable() else match[0]


@dataclass(frozen=True)
class Elements:
    """The elements of one file.

    Attributes
    ----------
    by_id
        Elements with an id.
    declared
        Function that returns the declarations of an element.
    """

    by_id: Mapping[str, ET.Element]
    declared: Callable[[ET.Element], dict[str, str]]

    @classmethod
    def within(cls, root: ET.Element, declared: Callable[[ET.Element], dict[str, str]]) -> Elements:
        """Return the elements of a tree."""
        return cls(
            {name: element for element in reversed([*root.iter()]) if (name := element.get("id"))}, declared
        )

    def target_of(self, element: ET.Element) -> ET.Element | None:
        """Return the element of the file that an element refers to; None without one."""
        reference = reference_of(element)
        return self.by_id.get(reference[1:]) if reference.startswith("#") else None

    def target_of_property(self, value: str) -> ET.Element | None:
        """Return the element that a property such as "url(#a)" refers to; None of any other."""
        match = _REFERENCE.fullmatch(value.strip())
        return self.by_id.get(match[1]) if match is not None else None
