"""Texts of tiles as Qt draws them, which has each of them on one line."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET

_TEXT = re.compile(r"<text\b[^>]*>.*?</text>", re.DOTALL)
_PLACES = {"x", "y"}


def on_lines(body: str) -> str:
    """Return elements of SVG in which each part of a text that says where it is is a text by itself.

    Qt (6.11) draws a `tspan` behind the one before, wherever it is said to be.
    """
    return _TEXT.sub(lambda found: _apart(found[0]), body) if "<tspan" in body else body


def _apart(text: str) -> str:
    try:
        # A tile declares no entities: it is refused before it is drawn.
        whole = ET.fromstring(text)
    except ET.ParseError:
        return text
    lines = [ET.Element("text", whole.attrib)]
    lines[0].text = whole.text
    for part in whole:
        if _PLACES.isdisjoint(part.attrib):
            lines[-1].append(part)
        else:
            line = ET.Element("text", {**whole.attrib, **part.attrib})
            line.text = part.text
            line.extend(part)
            lines.append(line)
    return "".join(ET.tostring(line, "unicode") for line in lines)
