"""Units of length as files write them, and documents in another unit or moved as a whole."""

from __future__ import annotations

from functools import cache, partial
from typing import Final, TypeVar

from msgspec.structs import replace

from ..document.fields import Field, Value, fields_of
from ..document.lengths import MILLIMETRES, known_unit
from ..document.limits import EditError
from ..document.model import Document, Guide, Vector
from ..document.several_curves import step_group, whole_curves
from ..document.words import decimal_sum

POINTS_PER_MILLIMETRE: Final = 72 / 25.4

_IN_DXF: Final = {"in": 1, "ft": 2, "mm": 4, "cm": 5, "m": 6, "km": 7, "µm": 13}


def note_of_unknown(name: str) -> str:
    """Return a remark on a unit that is not a known length; empty for a length, and for no unit."""
    if not name or known_unit(name):
        return ""
    return f"“{name}” is not a known unit of length; pictures and exported files have no true size."


def dxf_code(name: str) -> int:
    """Return the $INSUNITS of a DXF file in a unit; 0 for none."""
    return _IN_DXF.get(known_unit(name), 0)


def unit_of_dxf(code: int) -> str:
    """Return the unit of a DXF file with this $INSUNITS; empty for none, and for those unknown here."""
    return next((unit for unit, known in _IN_DXF.items() if known == code), "")


def size_text(width: float, height: float, unit: str) -> str:
    """Return a size with three digits, and its unit."""
    return f"{width:.4g} × {height:.4g} {unit}"


# Documents in another unit


_Value = TypeVar("_Value", bound=Value)


def factor_between(unit: str, other: str) -> float:
    """Return the length of one unit in another; 1 where either is no length."""
    here, there = known_unit(unit), known_unit(other)
    return MILLIMETRES[here] / MILLIMETRES[there] if here and there and here != there else 1.0


def in_unit(document: Document, unit: str) -> Document:
    """Return the document in a unit; unchanged where either is no length."""
    factor = factor_between(document.unit, unit)
    if factor == 1.0:
        return document
    return replace(enlarged(document, factor), unit=unit)


def enlarged(value: _Value, factor: float) -> _Value:
    """Return a document, or a part of one, with all of its lengths multiplied by a factor."""
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
    return tuple(field for field in fields_of(kind) if field.is_length or field.holds_values)


def shifted(document: Document, by: Vector) -> Document:
    """Return a document with its curves and guides moved, in decimals, even if locked.

    A document that would be out of range stays unchanged.
    """
    # Locks protect against edits only.
    free = replace(document, curves=tuple(replace(curve, locked=False) for curve in document.curves))
    try:
        moved = step_group(free, whole_curves(free, range(len(free.curves))), by)
    except EditError:
        return document
    curves = tuple(
        replace(new, locked=old.locked) for new, old in zip(moved.curves, document.curves, strict=True)
    )
    guides = tuple(_moved(guide, by) for guide in document.guides)
    return replace(document, curves=curves, guides=guides)


def _moved(guide: Guide, by: Vector) -> Guide:
    return replace(guide, position=decimal_sum(guide.position, by[guide.axis.coordinate]))
