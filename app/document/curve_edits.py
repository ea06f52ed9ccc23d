"""Edits of whole curves: their number, order, direction and looks, and what keeps a curve from changes.

Pure functions ``(Document, …) -> Document`` like those of ``edits``.
"""

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
    """Insert `curve` before curve `index`; `index` equal to the number of curves appends."""
    return replace(document, curves=(*document.curves[:index], curve, *document.curves[index:]))


def without_curve(document: Document, curve: int) -> Document:
    """Return the document without a curve, be it the last one."""
    return replace(document, curves=(*document.curves[:curve], *document.curves[curve + 1 :]))


class NewCurve(NamedTuple):
    """A document, and the place of an empty curve in it that is drawn next."""

    document: Document
    curve_index: int


def with_new_curve(document: Document, active: int, fresh: Curve) -> NewCurve:
    """Return the document with the empty curve that is drawn next.

    That is the active one where it is empty and free, in the style of the `fresh` one; or else that one.
    """
    model = document.curves[active]
    if model.points or model.locked:
        return NewCurve(add_curve(document, len(document.curves), fresh), len(document.curves))
    if model.style != fresh.style:
        document = document.with_curve(active, replace(model, style=fresh.style))
    return NewCurve(document, active)


def replace_curve(document: Document, curve: int, new: Curve) -> Document:
    """Put `new` in the place of a curve; every number is checked."""
    return set_points(document.with_curve(curve, new), curve, new.points)


def replace_by_parts(document: Document, index: int, first: Curve, *others: Curve) -> Document:
    """Put curves in the place of one, one above the other."""
    document = replace_curve(document, index, first)
    for offset, curve in enumerate(others, start=1):
        document = add_curve(document, index + offset, curve)
    return document


def remove_curve(document: Document, curve: int) -> Document:
    """Remove a curve; the last one leaves an empty curve of its family behind."""
    rest = without_curve(document, curve).curves
    if not rest:
        rest = (empty_curve_like(document.curves[curve]),)
    return replace(document, curves=rest)


def delete_last_point(document: Document, curve: int) -> Document:
    """Delete the last point of a curve; a curve that has no other goes with it, unless it is the only one."""
    last = len(document.curves[curve].points) - 1
    if last > 0 or len(document.curves) == 1:
        return delete_points(document, curve, [last])
    return remove_curve(document, curve)


def map_curves(document: Document, curves: Collection[int], edit: Callable[[Curve], Curve]) -> Document:
    """Return the document with some of its curves changed."""
    new = (edit(curve) if place in curves else curve for place, curve in enumerate(document.curves))
    return replace(document, curves=tuple(new))


def rename_curve(document: Document, curve: int, name: str) -> Document:
    """Give the curve a name, without the blanks around it."""
    name = name.strip()
    if not name:
        raise EditError("A curve needs a name.")
    return document.with_curve(curve, replace(document.curves[curve], name=name))


def unused_name(document: Document, word: str = "Curve") -> str:
    """Return a name for a new curve that no curve, shape or group has: they are listed together."""
    taken = {name for curve in document.curves for name in (curve.name, curve.shape, *curve.groups)}
    return next(name for number in count(1) if (name := f"{word} {number}") not in taken)


def has_default_name(name: str) -> bool:
    """Whether a name is one that new curves get, and nobody has given it."""
    return _NUMBERED.fullmatch(name) is not None


def unused_copy_name(name: str, taken: Collection[str]) -> str:
    """Return the name, or that of a copy, which is not `taken`: "Leaf", "Leaf copy", "Leaf copy 2"."""
    stem = _COPY.sub("", name)
    later = (f"{stem} copy {number}" for number in count(2))
    return next(each for each in chain((name, f"{stem} copy"), later) if each not in taken)


def new_curve_like(document: Document, model: Curve, parametrization: Parametrization) -> Curve:
    """Return an empty curve with family, rules and style of `model`, under a name free in `document`."""
    name, settings = unused_name(document), model.settings
    fresh = Curve(name, model.family, parametrization, (), settings=settings, style=model.style)
    return fresh.with_rules_of(model)


def empty_curve_like(curve: Curve) -> Curve:
    """Return an empty curve of the usual style with the family and the rules of another.

    Parameters set by hand say nothing about other points; the interval that they span is that curve's own.
    """
    rule = curve.parametrization
    usual = Parametrization() if curve.is_manual else Parametrization(rule.kind, rule.alpha)
    return replace(new_curve_like(Document(()), curve, usual), style=PLAIN_STYLE)


def set_closed(document: Document, curve: int, closed: bool, *, parameter_scale: float = 1.0) -> Document:
    """Let the curve return to its first point, or not.

    Under an automatic rule the segment that closes needs a part of the interval. `parameter_scale` is what
    that does to the others, dt_new / dt_old, as for `append_point`: handles stay where the person put them.
    """
    old = document.curves[curve]
    if closed and not old.family.curve_class.can_close:
        raise EditError(
            f"Choose {titles(each for each in FAMILIES if each.curve_class.can_close)} to close the curve: "
            f"{_why_open(old.family)}."
        )
    if closed and len(old.points) < old.family.least_to_close:
        raise EditError(_why_too_few(old.family))
    points = tuple(rescaled(point, parameter_scale) for point in old.points)
    return document.with_curve(curve, with_room_to_close(replace(old, points=points, closed=closed)))


def _why_open(family: Family) -> str:
    """Return the reason for its curves not to return to their first point, in few words."""
    reason = "is one polynomial" if family.curve_class.is_one_polynomial else "does not return smoothly"
    return f"{family.a_curve} {reason}"


def _why_too_few(family: Family) -> str:
    """Return the reason for so few points of a family not to make a closed curve."""
    if family.derivatives:
        return "A closed curve needs at least two points."
    return (
        f"A closed curve needs at least three points here: of two, {family.a_curve} goes straight there and "
        "back; points with velocities would bend it."
    )


def reverse_curve(document: Document, curve: int, parameters: Sequence[float]) -> Document:
    """Run through a curve the other way; its shape stays.

    `parameters` are those in force: a manual t becomes start + end − t.
    """
    old = document.curves[curve]
    start, end = _span_carried(old)
    points = [_reversed(point, start, end) for point in reversed(old.points)]
    if old.is_closed:
        # A closed curve goes on beginning where it began.
        points = [points[-1], *points[:-1]]
        if not old.is_manual:
            # Remembered parameters would no longer ascend.
            points = [replace(point, t=None) for point in points]
    result = replace(old, points=tuple(points))
    if old.is_manual:
        turned = [_mirrored(t, start, end) for t in reversed(parameters)]
        document = freeze_parameters(document.with_curve(curve, result), curve, turned)
        result = document.curves[curve]
    refuse_equal_parameters(result, "The parameters lie too close together to be reversed.")
    return document.with_curve(curve, result)


def _span_carried(curve: Curve) -> tuple[float, float]:
    """Return first and last of the manual parameters, in force or only remembered."""
    carried = [point.t for point in curve.points if point.t is not None]
    if curve.is_manual or not carried:
        return curve.interval
    return carried[0], carried[-1]


def _mirrored(t: float, start: float, end: float) -> float:
    """Return start + end − t, the ends exactly."""
    return end if t == start else start + (end - t)


def _reversed(point: Point, start: float, end: float) -> Point:
    sides = [(each.order, point.explicit_sides(each.order)) for each in DERIVATIVES]
    turned = point.with_derivatives(
        [_backwards(after, order) for order, (_, after) in sides],
        [_backwards(before, order) for order, (before, _) in sides],
    )
    return replace(turned, t=None if point.t is None else _mirrored(point.t, start, end))


def _backwards(vector: Vector | None, order: int) -> Vector | None:
    """Return a derivative by a time that runs back: those of odd orders point the other way."""
    return vector if vector is None or order % 2 == 0 else (-vector[0], -vector[1])


# What is safe from changes


def refuse_locked(before: Document, after: Document) -> None:
    """Raise EditError if `after` lacks a curve that is locked in `before`, or has it changed.

    Its name, style, shape, groups, visibility, lock and place in the order are free.
    """
    same_places, names = len(before.curves) == len(after.curves), []
    for place, curve in enumerate(before.curves):
        if not curve.locked or (same_places and after.curves[place] is curve):
            continue
        only_looks = same_places and without_appearance(after.curves[place]) == without_appearance(curve)
        # Edits hand on what they do not change: a curve elsewhere in the order is the same object.
        if not only_looks and not any(other is curve for other in after.curves):
            names.append(curve.display_name)
    if names:
        raise EditError(locked_message(names))


def locked_message(names: Sequence[str]) -> str:
    """Say that the curves with these names are locked, and what to do."""
    locked = [f"“{name}”" for name in dict.fromkeys(names)]
    if len(locked) == 1:
        return f"{locked[0]} is locked; unlock it in the list of curves to change it."
    return f"{enumerated(locked)} are locked; unlock them in the list of curves to change them."


def without_appearance(curve: Curve) -> Curve:
    """Return a curve without what does not shape it."""
    return replace(
        curve,
        name="",
        style=PLAIN_STYLE,
        shape="",
        groups=(),
        visible=True,
        locked=False,
    )
