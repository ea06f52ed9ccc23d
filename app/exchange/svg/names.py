"""Names of SVG elements, in the dialects of the programs that write them."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET

from .xml_tree import tag_of

_LONGEST = 200
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


def name_of(element: ET.Element) -> str:
    """Return what an element is called: by its label, its title or its id; empty without."""
    label = next((element.get(each, "") for each in _LABELS if element.get(each)), "")
    title = next((child.text for child in element if tag_of(child) == "title" and child.text), "")
    return _in_line(label or title or _ESCAPED.sub(_unescaped, element.get("id", "")))


def _in_line(name: str) -> str:
    return " ".join(name.split())[:_LONGEST]


def shown_name(element: ET.Element) -> str:
    """Return a name to find an element by: its own, or the words in it; empty without."""
    return name_of(element) or " ".join("".join(element.itertext()).split())[:40]


def _unescaped(match: re.Match[str]) -> str:
    letter = chr(int(match[1], 16))
    return letter if letter.isprintable() else match[0]
