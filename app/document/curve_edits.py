"""Edits of whole curves: add, remove, replace, rename, close, reverse; and the lock of curves."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Sequence
from itertools import chain, count
from typing import NamedTuple

from msgspec.structs import replace

from ..families import FAMILIES, Family, titles
from .constraints import rescaled
from .derivatives import DERIVATIVES
from .limits import EditError
from .model import Curve, Document, Parametrization, Point, Vector
from .point_edits import delete_points, set_points
from .rule_edits import freeze_parameters, refuse_equal_parameters, with_room_to_close
from .style import PLAIN_STYLE
from .words import enumerated

_COPY = re.compile(r" copy( \d+)?$")
_NUMBERED = re.compile(r"Curve \d+")


def add_curve(document: Document, index: int, curve: Curve) -> Document:
    """Insert a curve before curve `index`; an `index` equal to the number of curves appends it."""
    return replace(document, curves=(*document.curves[:index], curve, *document.curves[index:]))


def without_curve(document: Document, curve: int) -> Document:
    """Return the document without a curve, which may have no curve left."""
    return replace(document, curves=(*document.curves[:curve], *document.curves[curve + 1 :]))


class NewCurve(NamedTuple):
    """A document with an empty curve that is drawn next, and the index of that curve."""

    document: Document
    curve_index: int


def with_new_curve(document: Document, active: int, fresh: Curve) -> NewCurve:
    """Return the document with an empty curve that is drawn next.

    It is the active curve in the style of `fresh` if that is empty and unlocked, and else `fresh` itself.
    """
    model = document.curves[active]
    if model.points or model.locked:
        return NewCurve(add_curve(document, len(document.curves), fresh), len(document.curves))
    if model.style != fresh.style:
        document = document.with_curve(active, replace(model, style=fresh.style))
    return NewCurve(document, active)


def replace_curve(document: Document, curve: int, new: Curve) -> Document:
    """Replace a curve; every number is checked."""
    return set_points(document.with_curve(curve, new), curve, new.points)


def replace_by_parts(document: Document, index: int, first: Curve, *others: Curve) -> Document:
    """Replace a curve by several, one above the other."""
    document = replace_curve(document, index, first)
    for offset, curve in enumerate(others, start=1):
        document = add_curve(document, index + offset, curve)
    return document


def remove_curve(document: Document, curve: int) -> Document:
    """Remove a curve; in place of the last one there is an empty curve of its family."""
    rest = without_curve(document, curve).curves
    if not rest:
        rest = (empty_curve_like(document.curves[curve]),)
    return replace(document, curves=rest)


def delete_last_point(document: Document, curve: int) -> Document:
    """Delete the last point of a curve, and a curve of one point as a whole, unless it is the only one."""
    last = len(document.curves[curve].points) - 1
    if last > 0 or len(document.curves) == 1:
        return delete_points(document, curve, [last])
    return remove_curve(document, curve)


def map_curves(document: Document, curves: Collection[int], edit: Callable[[Curve], Curve]) -> Document:
    """Return the document with `edit` applied to some of its curves."""
    new = (edit(curve) if index in curves else curve for index, curve in enumerate(document.curves))
    return replace(document, curves=tuple(new))


def rename_curve(document: Document, curve: int, name: str) -> Document:
    """Rename a curve; spaces around the name are removed."""
    name = name.strip()
    if not name:
        raise EditError("A curve needs a name.")
    return document.with_curve(curve, replace(document.curves[curve], name=name))


def unused_name(document: Document, word: str = "Curve") -> str:
    """Return a name for a new curve that no curve, shape or group has: all are in one list."""
    used = {name for curve in document.curves for name in (curve.name, curve.shape, *curve.groups)}
    return next(name for number in count(1) if (name := f"{word} {number}") not in used)


def has_default_name(name: str) -> bool:
    """Return whether a name is a default one, "Curve 3"."""
    return _NUMBERED.fullmatch(name) is not None


def unused_copy_name(name: str, used: Collection[str]) -> str:
    """Return the name, or the first unused one of "Leaf copy", "Leaf copy 2" and so on."""
    stem = _COPY.sub("", name)
    later = (f"{stem} copy {number}" for number in count(2))
    return next(candidate for candidate in chain((name, f"{stem} copy"), later) if candidate not in used)


def new_curve_like(document: Document, model: Curve, parametrization: Parametrization) -> Curve:
    """Return an empty curve with family, rules and style of `model`, under an unused name."""
    name, settings = unused_name(document), model.settings
    fresh = Curve(name, model.family, parametrization, (), settings=settings, style=model.style)
    return fresh.with_rules_of(model)


def empty_curve_like(curve: Curve) -> Curve:
    """Return an empty curve in the default style with the family and the rules of another.

    Manual parameters and the interval are not taken over.
    """
    rule = curve.parametrization
    parametrization = Parametrization() if curve.is_manual else Parametrization(rule.kind, rule.alpha)
    return replace(new_curve_like(Document(()), curve, parametrization), style=PLAIN_STYLE)


def set_closed(document: Document, curve: int, closed: bool, *, parameter_scale: float = 1.0) -> Document:
    """Close or open a curve.

    Where a rule gives the parameters, the closing segment takes a part of the interval. `parameter_scale` is
    the factor dt_new / dt_old of the other segments, as for `append_point`, so that handles stay where they
    are.
    """
    old = document.curves[curve]
    if closed and not old.family.curve_class.can_close:
        closable = titles(family for family in FAMILIES if family.curve_class.can_close)
        raise EditError(f"To close the curve, choose {closable}: {_why_open(old.family)}.")
    if closed and len(old.points) < old.family.least_to_close:
        raise EditError(_why_too_few(old.family))
    points = tuple(rescaled(point, parameter_scale) for point in old.points)
    return document.with_curve(curve, with_room_to_close(replace(old, points=points, closed=closed)))


def _why_open(family: Family) -> str:
    """Return why curves of a family cannot be closed, in few words."""
    reason = "is one polynomial" if family.curve_class.is_one_polynomial else "does not return smoothly"
    return f"{family.a_curve} {reason}"


def _why_too_few(family: Family) -> str:
    """Return the message that a curve of a family has too few points to be closed."""
    if family.derivatives:
        return "A closed curve needs at least two points."
    return (
        "A closed curve needs at least three points here: through two, "
        f"{family.a_curve} runs straight there and back. Add a point, or choose a family with velocities."
    )


def reverse_curve(document: Document, curve: int, parameters: Sequence[float]) -> Document:
    """Reverse the direction of a curve; its shape stays.

    `parameters` are the present ones: a manual t becomes start + end − t.
    """
    old = document.curves[curve]
    start, end = _span_carried(old)
    points = [_reversed(point, start, end) for point in reversed(old.points)]
    if old.is_closed:
        # A closed curve keeps its first point.
        points = [points[-1], *points[:-1]]
        if not old.is_manual:
            # Stored manual parameters would no longer increase.
            points = [replace(point, t=None) for point in points]
    result = replace(old, points=tuple(points))
    if old.is_manual:
        mirrored = [_mirrored(t, start, end) for t in reversed(parameters)]
        document = freeze_parameters(document.with_curve(curve, result), curve, mirrored)
        result = document.curves[curve]
    refuse_equal_parameters(result, "The parameters are too close together to be reversed.")
    return document.with_curve(curve, result)


def _span_carried(curve: Curve) -> tuple[float, float]:
    """Return the first and last manual parameters, in use or only stored."""
    carried = [point.t for point in curve.points if point.t is not None]
    if curve.is_manual or not carried:
        return curve.interval
    return carried[0], carried[-1]


def _mirrored(t: float, start: float, end: float) -> float:
    """Return start + end − t, the ends exactly."""
    return end if t == start else start + (end - t)


def _reversed(point: Point, start: float, end: float) -> Point:
    sides = [(row.order, point.explicit_sides(row.order)) for row in DERIVATIVES]
    turned = point.with_derivatives(
        [_backwards(after, order) for order, (_, after) in sides],
        [_backwards(before, order) for order, (before, _) in sides],
    )
    return replace(turned, t=None if point.t is None else _mirrored(point.t, start, end))


def _backwards(vector: Vector | None, order: int) -> Vector | None:
    """Return a derivative for reversed time: derivatives of odd orders change their signs."""
    return vector if vector is None or order % 2 == 0 else (-vector[0], -vector[1])


# Locked curves


def refuse_locked(before: Document, after: Document) -> None:
    """Raise EditError if a curve that is locked in `before` was removed or changed in `after`.

    Its name, style, shape, groups, visibility, lock and index may change.
    """
    same_count, names = len(before.curves) == len(after.curves), []
    for index, curve in enumerate(before.curves):
        if not curve.locked or (same_count and after.curves[index] is curve):
            continue
        is_restyled = same_count and without_appearance(after.curves[index]) == without_appearance(curve)
        # Edits pass on unchanged curves as the same objects, at whatever index.
        if not is_restyled and not any(other is curve for other in after.curves):
            names.append(curve.display_name)
    if names:
        raise EditError(locked_message(names))


def locked_message(names: Sequence[str]) -> str:
    """Return the message that the curves with these names are locked."""
    locked = [f"“{name}”" for name in dict.fromkeys(names)]
    if len(locked) == 1:
        return f"{locked[0]} is locked. Unlock it in the list of curves to change it."
    return f"{enumerated(locked)} are locked. Unlock them in the list of curves to change them."


def without_appearance(curve: Curve) -> Curve:
    """Return a curve without name, style, shape, groups and flags: the fields that do not shape it."""
    return replace(curve, name="", style=PLAIN_STYLE, shape="", groups=(), visible=True, locked=False)
