"""Places in a document, as files name them, in the words of people."""

from __future__ import annotations

import re

from .fields import fields_of
from .model import Curve, Document
from .style import Style
from .value import Value

_PLACE = re.compile(r"[a-z_]+(\[\d+\])?(\.[a-z_]+(\[\d+\])?)*")
_STEP = re.compile(r"([a-z_]+)(?:\[(\d+)\])?")


def with_place_in_words(document: Document, sentence: str) -> str:
    """Return a sentence with “the x of point 3 of …” for the place it begins with, ``curves[0].points[3].x``.

    As it is where it begins otherwise.
    """
    found = _PLACE.match(sentence)
    words = _words(document, found[0]) if found is not None else ""
    return f"{words}{sentence[found.end() :]}" if found is not None and words else sentence


def _words(document: Document, place: str) -> str:
    value: object = document
    parts: list[str] = []
    for name, index in _STEP.findall(place):
        fields = fields_of(type(value)) if isinstance(value, Value) else ()
        field = next((each for each in fields if each.name == name), None)
        if field is None:
            return ""
        value = getattr(value, name)
        called = field.words.replace("_", " ")
        called = f"{called[0].lower()}{called[1:]}"
        if field.is_many and index and isinstance(value, tuple):
            value = value[int(index)]
            called = f"{called.removesuffix('s')} {index}"
        parts.append(_name_of(value, called))
    *holders, last = filter(None, parts)
    return " of ".join([f"the {last}", *reversed(holders)])


def _name_of(value: object, called: str) -> str:
    """Return what a step of the way is called; empty of a style, whose fields say it."""
    if isinstance(value, Curve):
        return f"“{value.name}”"
    if isinstance(value, Style):
        return ""
    is_one = isinstance(value, Value) and not called[-1].isdigit()
    return f"the {called}" if is_one else called
