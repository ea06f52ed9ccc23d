"""Plain numbers: every number of NumPy becomes a float of Python before it enters a document.

Msgspec does not write a ``numpy.float64``, its `repr` is not a number, and arithmetic with it warns where a
float raises: surprises far from the code that computed the number. Ties that no longer hold are removed here
as well, because every change of a document passes through `with_plain_numbers`.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import cache
from itertools import chain, compress, repeat
from numbers import Real
from operator import attrgetter, is_, is_not
from types import NoneType
from typing import TypeVar

from msgspec.structs import replace

from .constraints import has_parallel_velocities
from .differences import known_curves, moved_points
from .fields import Field, Value, fields_of
from .model import Curve, Document, Point, Vector, derivatives_of

Values = TypeVar("Values", bound=Value)

_x, _y, _t, _corner, _tied, _even = map(attrgetter, ("x", "y", "t", "corner", "tied", "even"))


def with_plain_numbers(document: Document, before: Document | None = None) -> Document:
    """Return the document with plain numbers: the same object if all are plain.

    Objects of `before`, which is plain, are not checked again.
    """
    if before is not None and _has_only_moved_plainly(document, before):
        return document
    known, by_points = known_curves(before)
    old = before.curves if before is not None else ()
    curves = tuple(
        curve
        if id(curve) in known
        else _plain_values(curve, by_points.get(id(curve.points), old[index] if index < len(old) else None))
        for index, curve in enumerate(document.curves)
    )
    document = _plain_values(document, before)
    return replace(document, curves=curves) if any(map(is_not, curves, document.curves)) else document


def _has_only_moved_plainly(document: Document, before: Document) -> bool:
    """Return whether only points moved, to plain positions, as during most drags."""
    moved = moved_points(before, document)
    return moved is not None and {*map(type, map(_x, moved)), *map(type, map(_y, moved))} <= {float}


@cache
def _fields(kind: type[Value]) -> tuple[Field, ...]:
    """Return the fields of a kind of value that hold numbers or other values, curves excepted."""
    fields = (field for field in fields_of(kind) if field.kind is not Curve)
    return tuple(field for field in fields if field.kind in (float, bool) or field.holds_values)


def _plain_values(values: Values, before: object = None) -> Values:
    """Return a value of the document with plain numbers: the same object if all are plain."""
    changed = {}
    for field in _fields(type(values)):
        held, known = getattr(values, field.name), getattr(before, field.name, None)
        if held is known or held is field.default:
            continue
        if (new := _plain_field(field, held, known)) is not held:
            changed[field.name] = new
    return replace(values, **changed) if changed else values


def _plain_field(field: Field, held: object, known: object) -> object:
    if not field.is_many or not isinstance(held, Iterable):
        return _plain_value(field, held, known)
    if field.kind is Point and isinstance(held, tuple):
        return _plain_points(held, known if isinstance(known, tuple) else ())
    new = tuple(_plain_value(field, item) for item in held)
    return held if isinstance(held, tuple) and not any(map(is_not, new, held)) else new


def _plain_value(field: Field, value: object, known: object = None) -> object:
    if isinstance(value, Value):
        return _plain_values(value, known)
    return bool(value) if field.kind is bool else _plain_number(value)


def _plain_points(points: tuple[Point, ...], before: tuple[Point, ...]) -> tuple[Point, ...]:
    """Return points with plain values; fast where they are plain, because every move of a drag asks."""
    changed = list(compress(points, map(is_not, points, before))) if len(points) == len(before) else points
    if _are_plain(changed):
        return points
    return tuple(point if _is_plain(point) else _plain_point(point) for point in points)


def _are_plain(points: Sequence[Point]) -> bool:
    """Return whether points hold plain values, without a call for each."""
    if not all(map(is_, chain(map(_tied, points), map(_even, points)), repeat(False))):
        return all(map(_is_plain, points))
    vectors = [vector for vector in chain.from_iterable(map(derivatives_of, points)) if vector is not None]
    return (
        {*map(type, map(_x, points)), *map(type, map(_y, points))} <= {float}
        and set(map(type, map(_t, points))) <= {float, NoneType}
        and set(map(type, map(_corner, points))) <= {bool}
        and set(map(type, vectors)) <= {tuple}
        and set(map(type, chain.from_iterable(vectors))) <= {float}
    )


def _is_plain(point: Point) -> bool:
    # The declared types do not hold here: they are what this function checks.
    x, y, t = type(point.x), type(point.y), type(point.t)
    return (
        x is float is y
        and (t is float or point.t is None)
        and type(point.corner) is bool
        and (point.tied is False or (point.tied is True and has_parallel_velocities(point)))
        and (point.even is False or point.even is point.tied)
        and all(vector is None or _is_plain_vector(vector) for vector in derivatives_of(point))
    )


def _is_plain_vector(vector: Vector) -> bool:
    return type(vector) is tuple and all(type(value) is float for value in vector)


def _plain_point(point: Point) -> Point:
    changed = _plain_values(point)
    is_tied = changed.tied and has_parallel_velocities(changed)
    return replace(changed, tied=is_tied, even=is_tied and changed.even)


def _plain_number(value: object) -> object:
    """Return a real number as a float; any other value unchanged, for `validate` to refuse."""
    if type(value) is float or isinstance(value, bool) or not isinstance(value, Real):
        return value
    try:
        return float(value)
    except OverflowError:
        return value
