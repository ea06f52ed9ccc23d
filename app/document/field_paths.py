"""Paths of fields, ``curves[0].points[3].x``, in words."""

from __future__ import annotations

import re

from .fields import Value, fields_of
from .model import Curve, Document
from .style import Style

_PATH = re.compile(r"[a-z_]+(\[\d+\])?(\.[a-z_]+(\[\d+\])?)*")
_FIELD = re.compile(r"([a-z_]+)(?:\[(\d+)\])?")


def with_path_in_words(document: Document, sentence: str) -> str:
    """Return a sentence that begins with a path of a field with “the x of point 3 of …” in place of the path.

    Other sentences are returned unchanged.
    """
    path = _PATH.match(sentence)
    words = _words(document, path[0]) if path is not None else ""
    return f"{words}{sentence[path.end() :]}" if path is not None and words else sentence


def _words(document: Document, path: str) -> str:
    value: object = document
    parts: list[str] = []
    for name, index in _FIELD.findall(path):
        fields = fields_of(type(value)) if isinstance(value, Value) else ()
        field = next((entry for entry in fields if entry.name == name), None)
        if field is None:
            return ""
        value = getattr(value, name)
        label = field.label.replace("_", " ")
        label = f"{label[0].lower()}{label[1:]}"
        if field.is_many and index and isinstance(value, tuple):
            value = value[int(index)]
            label = f"{label.removesuffix('s')} {index}"
        parts.append(_name_of(value, label))
    *holders, last = filter(None, parts)
    return " of ".join([f"the {last}", *reversed(holders)])


def _name_of(value: object, label: str) -> str:
    """Return the name of one part of the path; empty for a style, whose fields have full names."""
    if isinstance(value, Curve):
        return f"“{value.name}”"
    if isinstance(value, Style):
        return ""
    is_one = isinstance(value, Value) and not label[-1].isdigit()
    return f"the {label}" if is_one else label
