"""XML trees of SVG files, and the names and references of their elements.

No DTD is fetched, no entity declared; there are neither many elements nor deep ones. Names are those of
the dialects of several programs.
"""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from xml.parsers.expat.errors import XML_ERROR_UNDEFINED_ENTITY, codes

from defusedxml.ElementTree import DefusedXMLParser

from ..errors import ExchangeError

MAX_ELEMENTS = 10_000
MAX_DEPTH = 200

_SUBSET = (
    "Its DOCTYPE declares entities, or something else between “[” and “]>”, and that is not read. Save it as "
    "plain SVG; or, where no “&name;” stands in the file, delete all from “<!DOCTYPE” to “]>” in a text "
    "editor."
)

_LONGEST_NAME = 200

INKSCAPE_SPACE = "http://www.inkscape.org/namespaces/inkscape"
SODIPODI_SPACE = "http://sodipodi.sourceforge.net/DTD/sodipodi-0.dtd"
"""Name spaces of what only Inkscape takes note of."""

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


def parsed(data: bytes) -> ET.Element:
    """Return the root of an XML file.

    A plain DOCTYPE, as matplotlib and Illustrator write it, is passed over: what it points to is not read.

    Raises
    ------
    ExchangeError
        With the place, for what is not XML; for entities, a DTD in the file, more than `MAX_ELEMENTS`
        elements, and elements deeper than `MAX_DEPTH`.
    """
    if not data.strip():
        raise ExchangeError("The file is empty.")
    try:
        return _tree(data)
    except _PlainDoctype as found:
        return _tree(_without_doctype(data, found.end), may_have_doctype=False)


def tag_of(element: ET.Element) -> str:
    """Return an element's name without its namespace."""
    return str(element.tag).rpartition("}")[2]


def reference_of(element: ET.Element) -> str:
    """Return what an element refers to: "#" and an id, an address, or nothing."""
    return (element.get("href") or element.get("{http://www.w3.org/1999/xlink}href") or "").strip()


def speaks_to_us(element: ET.Element) -> bool:
    """Whether an element of a `switch` is for everybody, or for those who read English."""
    language = element.get("systemLanguage", "en")
    return not element.get("requiredExtensions") and any(
        each.strip().startswith("en") for each in language.split(",")
    )


def _tree(data: bytes, *, may_have_doctype: bool = True) -> ET.Element:
    parser = _Parser(_CountingBuilder(), may_have_doctype)
    try:
        parser.feed(data)
        root: ET.Element = parser.close()
    except ET.ParseError as problem:
        line, column = problem.position
        undefined = problem.code == codes[XML_ERROR_UNDEFINED_ENTITY]
        said = "An entity “&…;” is declared nowhere in the file" if undefined else "The file is not XML"
        raise ExchangeError(f"{said}: line {line}, column {column + 1}.") from None
    except (ValueError, LookupError) as problem:
        if isinstance(problem, ExchangeError):
            raise
        raise ExchangeError("The file is not XML: its encoding is unknown.") from None
    return root


class _PlainDoctype(Exception):  # noqa: N818 - found, not wrong
    """There is a DOCTYPE with nothing in it; `end` is the place of its “>”."""

    def __init__(self, end: int) -> None:
        super().__init__(end)
        self.end = end


class _Parser(DefusedXMLParser):  # type: ignore[misc]  # that package has no types
    """Stops at a DOCTYPE, and refuses one that declares anything.

    Expat itself would read on after a plain one, but then drop every “&name;” in an attribute without a
    word, for a DTD that it has not read might declare it.
    """

    def __init__(self, target: object, may_have_doctype: bool) -> None:
        super().__init__(target=target, forbid_dtd=True)
        self._may_have_doctype = may_have_doctype

    def defused_start_doctype_decl(
        self, name: str, sysid: str | None, pubid: str | None, has_internal_subset: int
    ) -> None:
        if has_internal_subset:
            raise ExchangeError(_SUBSET)
        if not self._may_have_doctype:
            raise ExchangeError("The file is not XML: it has two DOCTYPEs.")
        raise _PlainDoctype(self.parser.CurrentByteIndex)


def _without_doctype(data: bytes, end: int) -> bytes:
    """Return the file with blanks in place of the DOCTYPE before the “>” at `end`: no other place moves."""
    # In UTF-16 every character takes two bytes, and the zero stands before or after.
    width = 2 if 0 in data[end : end + 2] else 1
    closing = data[end : end + width]
    opening = b"".join(closing.replace(b">", bytes([letter])) for letter in b"<!DOCTYPE")
    start = data.rfind(opening, 0, end)
    space, newline = closing.replace(b">", b" "), closing.replace(b">", b"\n")
    units = (data[place : place + width] for place in range(start, end, width))
    blank = b"".join(newline if unit == newline else space for unit in units)
    return data[:start] + blank + space + data[end + width :]


class _CountingBuilder(ET.TreeBuilder):
    """Builds the tree as long as it is neither large nor deep."""

    def __init__(self) -> None:
        super().__init__()
        self._count = self._depth = 0

    def start(self, tag: str, attributes: dict[str, str], /) -> ET.Element:
        self._count += 1
        self._depth += 1
        if self._count > MAX_ELEMENTS:
            raise ExchangeError(f"The file has more than {MAX_ELEMENTS} elements.")
        if self._depth > MAX_DEPTH:
            raise ExchangeError(f"Element {self._count} is nested deeper than {MAX_DEPTH} levels.")
        return super().start(tag, attributes)

    def end(self, tag: str, /) -> ET.Element:
        self._depth -= 1
        return super().end(tag)


def name_of(element: ET.Element) -> str:
    """Return what an element is called: by its label, its title or its id; empty without."""
    label = next((element.get(each, "") for each in _LABELS if element.get(each)), "")
    title = next((child.text for child in element if tag_of(child) == "title" and child.text), "")
    return _in_line(label or title or _ESCAPED.sub(_unescaped, element.get("id", "")))


def _in_line(name: str) -> str:
    return " ".join(name.split())[:_LONGEST_NAME]


def shown_name(element: ET.Element) -> str:
    """Return a name to find an element by: its own, or the words in it; empty without."""
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
        Those that are named.
    declared
        Returns what an element declares.
    """

    by_id: Mapping[str, ET.Element]
    declared: Callable[[ET.Element], dict[str, str]]

    @classmethod
    def within(cls, root: ET.Element, declared: Callable[[ET.Element], dict[str, str]]) -> Elements:
        """Return those of a tree."""
        return cls({name: element for element in root.iter() if (name := element.get("id"))}, declared)

    def used(self, element: ET.Element) -> ET.Element | None:
        """Return the element of the file whose place in it an element gives; None without one."""
        reference = reference_of(element)
        return self.by_id.get(reference[1:]) if reference.startswith("#") else None

    def referred(self, value: str) -> ET.Element | None:
        """Return the element that a property such as "url(#a)" refers to; None of any other."""
        found = _REFERENCE.fullmatch(value.strip())
        return self.by_id.get(found[1]) if found is not None else None
