"""Frames that the words of texts fill, in a file: rectangles among its definitions."""

from __future__ import annotations

import re

from ....document.content import Lettering
from ...naming import Names
from .. import flowed
from .looks import declare, declares, value_of
from .placing import definitions
from .source import Node, Source

_REFERENCE = re.compile(r"#([^\"')\s]+)")
_FLOWING = ("shape-inside", "inline-size")
_STANDING = ("text-align", "text-anchor")


def new_room(source: Source, text: Lettering) -> str:
    """Put the frame of a text into a file; return its id, empty where it has none."""
    if text.flow is None or text.flow.grows:
        return ""
    name = Names(source.ids, between="_").different("frame")
    (rect,) = source.adopted(flowed.frame_element(text, name))
    rect.put_last(definitions(source))
    return name


def flow_anew(source: Source, node: Node, before: Lettering, after: Lettering) -> None:
    """Have a text wrap in another frame, or in none."""
    if after.flow is None:
        for name in _FLOWING:
            if declares(node, name):
                declare(node, name, "auto")
        return
    if (before.flow, before.box, _anchor(before)) == (after.flow, after.box, _anchor(after)):
        return
    room = "" if after.flow.grows else _room(source, node, after) or new_room(source, after)
    said = flowed.declarations(after, room)
    # What stood otherwise before would do so still.
    at_first = {name: "start" for name in _STANDING if name not in said and declares(node, name)}
    for name, value in (at_first | dict(said)).items():
        is_said = declares(node, name)
        # What came in as nothing else is said by nobody.
        if not (is_said and value_of(node, name) == value):
            declare(node, name, value, has_rules=name in _FLOWING)
    if not after.flow.grows and declares(node, "inline-size"):
        declare(node, "inline-size", "auto")


def _anchor(text: Lettering) -> str:
    return text.lines[0].anchor.value


def _room(source: Source, node: Node, after: Lettering) -> str:
    """Make the frame that a text has another one, if it is no other text's; return its id."""
    found = _REFERENCE.search(value_of(node, "shape-inside"))
    if found is None or source.text.count(f"#{found[1]}") != 1:
        return ""
    rect = next((each for each in source.root.walk() if each.get("id") == found[1]), None)
    if rect is None or rect.tag != "rect":
        return ""
    for name, value in flowed.sizes(after).items():
        rect.set(name, value)
    return found[1]
