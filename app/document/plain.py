"""Plain numbers: what NumPy has computed becomes Python's own float before a document holds it.

`repr` of a ``numpy.float64`` is no number, msgspec does not write one, and arithmetic with one warns where a
float raises. Each is a surprise far from where the number came from.
"""

from __future__ import annotations

from collections.abc import Iterable
from itertools import compress
from numbers import Real
from operator import is_not
from typing import TypeVar

from msgspec.structs import replace

from app.document.kept_handles import DERIVATIVES
from app.document.model import Curve, Document, Node, Value, Vector

Values = TypeVar("Values", bound=Value)

_OF_RULE = ("alpha", "start", "end")
_OF_IMAGE = ("x", "y", "width", "height", "opacity")


def plain(document: Document, before: Document | None = None) -> Document:
    """Return `document` with plain values alone: itself, unless there is another one in it.

    Only what is not the same object as in `before`, which is plain, is looked at.
    """
    known = {id(curve) for curve in before.curves} if before is not None else set()
    places = before.curves if before is not None else ()
    curves = tuple(
        curve
        if id(curve) in known
        else _plain_curve(curve, places[place].nodes if place < len(places) else ())
        for place, curve in enumerate(document.curves)
    )
    image = document.image
    if image is not None and (before is None or image is not before.image):
        image = _with_plain(image, _OF_IMAGE, ("locked",))
    if image is document.image and not any(map(is_not, curves, document.curves)):
        return document
    return replace(document, curves=curves, image=image)


def _plain_curve(curve: Curve, before: tuple[Node, ...]) -> Curve:
    curve = _with_plain(curve, (), ("closed", "visible", "locked"))
    rule = _with_plain(curve.parametrization, _OF_RULE)
    nodes = _plain_nodes(curve.nodes, before)
    if rule is curve.parametrization and nodes is curve.nodes:
        return curve
    return replace(curve, parametrization=rule, nodes=nodes)


def _plain_nodes(nodes: tuple[Node, ...], before: tuple[Node, ...]) -> tuple[Node, ...]:
    """Return `nodes` with plain values; asked at every move of a drag, so that the usual costs little."""
    changed = compress(nodes, map(is_not, nodes, before)) if len(nodes) == len(before) else nodes
    if all(map(_is_plain, changed)):
        return nodes
    return tuple(node if _is_plain(node) else _plain_node(node) for node in nodes)


def _is_plain(node: Node) -> bool:
    # mypy takes the types of the fields for granted; here they are what is asked.
    x, y, t = type(node.x), type(node.y), type(node.t)
    return (
        x is float is y
        and (t is float or node.t is None)
        and type(node.corner) is bool
        and (node.velocity is None or _is_plain_vector(node.velocity))
        and (node.acceleration is None or _is_plain_vector(node.acceleration))
        and (node.velocity_after is None or _is_plain_vector(node.velocity_after))
        and (node.acceleration_after is None or _is_plain_vector(node.acceleration_after))
    )


def _is_plain_vector(vector: Vector) -> bool:
    return type(vector) is tuple and all(type(value) is float for value in vector)


def _plain_node(node: Node) -> Node:
    vectors = {
        name: tuple(map(_plain_number, vector))
        for _, name in DERIVATIVES
        if (vector := getattr(node, name)) is not None
    }
    return replace(_with_plain(node, ("x", "y", "t"), ("corner",)), **vectors)


def _with_plain(values: Values, numbers: Iterable[str], flags: Iterable[str] = ()) -> Values:
    """Return one of the document's values with plain numbers and flags: itself where it has them."""
    wanted = {name: _plain_number(getattr(values, name)) for name in numbers}
    wanted |= {name: bool(getattr(values, name)) for name in flags}
    changed = {name: value for name, value in wanted.items() if value is not getattr(values, name)}
    return replace(values, **changed) if changed else values


def _plain_number(value: object) -> object:
    """Return a real number as a float; what is none is left to `validate`, which says what is wrong."""
    if type(value) is float or isinstance(value, bool) or not isinstance(value, Real):
        return value
    try:
        return float(value)
    except OverflowError:
        return value
