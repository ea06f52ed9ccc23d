"""Plain numbers: what NumPy has computed becomes Python's own float before a document holds it.

A tie that no longer holds goes here, too: whatever has changed a velocity, the door is passed by all.

`repr` of a ``numpy.float64`` is no number, msgspec does not write one, and arithmetic with one warns where a
float raises. Each is a surprise far from where the number came from.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from itertools import compress
from numbers import Real
from operator import is_not
from typing import Any, TypeVar

from msgspec.structs import replace

from .derivatives import VECTORS
from .model import Curve, Document, Point, Vector, vectors_of
from .ties import holds
from .value import Value

Values = TypeVar("Values", bound=Value)

_FLAGS = ("closed", "visible", "locked")
_OF_RULE = ("alpha", "start", "end")
_OF_IMAGE = ("x", "y", "width", "height", "opacity")
_OF_PAGE = ("x", "y", "width", "height")
_OF_STYLE = ("width", "miter_limit", "dash_offset", "stroke_opacity", "fill_opacity", "opacity")


def plain(document: Document, before: Document | None = None) -> Document:
    """Return `document` with plain values alone: itself, unless there is another one in it.

    Only what is not the same object as in `before`, which is plain, is looked at.
    """
    known = {id(curve) for curve in before.curves} if before is not None else set()
    places = before.curves if before is not None else ()
    curves = tuple(
        curve if id(curve) in known else _plain_curve(curve, places[place] if place < len(places) else None)
        for place, curve in enumerate(document.curves)
    )
    image = document.image
    if image is not None and (before is None or image is not before.image):
        image = _with_plain(image, _OF_IMAGE, ("locked",))
    if before is None or document.grid_spacing is not before.grid_spacing:
        document = _with_plain(document, ("grid_spacing",))
    if before is None or document.guides is not before.guides:
        document = _with_each(document, "guides", lambda guide: _with_plain(guide, ("position",)))
    if document.page is not None and (before is None or document.page is not before.page):
        page = _with_plain(document.page, _OF_PAGE)
        document = document if page is document.page else replace(document, page=page)
    if image is document.image and not any(map(is_not, curves, document.curves)):
        return document
    return replace(document, curves=curves, image=image)


def _plain_curve(curve: Curve, before: Curve | None) -> Curve:
    points = _plain_points(curve.points, before.points if before is not None else ())
    if before is not None and _beside_points(curve) == _beside_points(before):
        return curve if points is curve.points else replace(curve, points=points)
    curve = _with_plain(curve, (), _FLAGS)
    rule = _with_plain(curve.parametrization, _OF_RULE)
    style = _with_each(_with_plain(curve.style, _OF_STYLE), "dash", _plain_number)
    if rule is curve.parametrization and style is curve.style and points is curve.points:
        return curve
    return replace(curve, parametrization=rule, style=style, points=points)


def _beside_points(curve: Curve) -> tuple[int, ...]:
    """Return the identities of what else of a curve may not be plain."""
    return (
        id(curve.parametrization), id(curve.style), id(curve.closed), id(curve.visible), id(curve.locked)
    )  # fmt: skip


def _plain_points(points: tuple[Point, ...], before: tuple[Point, ...]) -> tuple[Point, ...]:
    """Return `points` with plain values; asked at every move of a drag, so that the usual costs little."""
    changed = compress(points, map(is_not, points, before)) if len(points) == len(before) else points
    if all(map(_is_plain, changed)):
        return points
    return tuple(point if _is_plain(point) else _plain_point(point) for point in points)


def _is_plain(point: Point) -> bool:
    # mypy takes the types of the fields for granted; here they are what is asked.
    x, y, t = type(point.x), type(point.y), type(point.t)
    return (
        x is float is y
        and (t is float or point.t is None)
        and type(point.corner) is bool
        and (point.tied is False or (point.tied is True and holds(point)))
        and all(vector is None or _is_plain_vector(vector) for vector in vectors_of(point))
    )


def _is_plain_vector(vector: Vector) -> bool:
    return type(vector) is tuple and all(type(value) is float for value in vector)


def _plain_point(point: Point) -> Point:
    vectors = {
        name: tuple(map(_plain_number, vector))
        for _, name in VECTORS
        if (vector := getattr(point, name)) is not None
    }
    changed = replace(_with_plain(point, ("x", "y", "t"), ("corner", "tied")), **vectors)
    return replace(changed, tied=changed.tied and holds(changed))


def _with_plain(values: Values, numbers: Iterable[str], flags: Iterable[str] = ()) -> Values:
    """Return one of the document's values with plain numbers and flags: itself where it has them."""
    wanted = {name: _plain_number(getattr(values, name)) for name in numbers}
    wanted |= {name: bool(getattr(values, name)) for name in flags}
    changed = {name: value for name, value in wanted.items() if value is not getattr(values, name)}
    return replace(values, **changed) if changed else values


def _with_each(values: Values, name: str, plain_of: Callable[[Any], object]) -> Values:
    """Return one of the document's values with everything in one of its tuples made plain."""
    old = getattr(values, name)
    new = tuple(map(plain_of, old))
    return replace(values, **{name: new}) if any(map(is_not, new, old)) else values


def _plain_number(value: object) -> object:
    """Return a real number as a float; what is none is left to `validate`, which says what is wrong."""
    if type(value) is float or isinstance(value, bool) or not isinstance(value, Real):
        return value
    try:
        return float(value)
    except OverflowError:
        return value
