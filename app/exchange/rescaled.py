"""Documents in another unit of length, of the same size on paper."""

from __future__ import annotations

from functools import cache, partial
from typing import TypeVar

from msgspec.structs import replace

from ..document.fields import Field, fields_of
from ..document.model import Document
from ..document.value import Value
from .units import MILLIMETRES, known_unit

_Value = TypeVar("_Value", bound=Value)


def factor_between(unit: str, other: str) -> float:
    """Return how many of the other unit one of the first is; 1 where either is no length."""
    here, there = known_unit(unit), known_unit(other)
    return MILLIMETRES[here] / MILLIMETRES[there] if here and there and here != there else 1.0


def in_unit(document: Document, unit: str) -> Document:
    """Return the document in a unit; as it is where either is no length."""
    factor = factor_between(document.unit, unit)
    if factor == 1.0:
        return document
    return replace(enlarged(document, factor), unit=unit)


def enlarged(value: _Value, factor: float) -> _Value:
    """Return a document, or a part of one, so many times as large: all that its fields call lengths."""
    changed: dict[str, object] = {}
    for field in _sized_fields(type(value)):
        content = getattr(value, field.name)
        if content is not None:
            one = partial(_times if field.is_length else enlarged, factor=factor)
            changed[field.name] = tuple(map(one, content)) if field.is_many else one(content)
    return replace(value, **changed) if changed else value


def _times(value: float, factor: float) -> float:
    return value * factor


@cache
def _sized_fields(kind: type[Value]) -> tuple[Field, ...]:
    """Return the fields that hold lengths, or values that may."""
    return tuple(each for each in fields_of(kind) if each.is_length or each.holds_values)
