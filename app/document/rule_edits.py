"""Edits of the rules of a curve: family, settings, estimated derivatives, parameters and their interval.

Parameters that a rule gives are not in the document: an edit that needs them takes them as `parameters`.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from msgspec.structs import replace

from ..families import Family, SettingValue
from .constraints import rescaled
from .derivatives import DERIVATIVES, EstimateRule
from .limits import EditError, checked, not_after, t_text
from .model import Curve, Document, ParametrizationKind, Point
from .words import number, with_minus

# Family and rules


def set_family(document: Document, curve: int, family: Family) -> Document:
    """Set the family; the points stay, so that setting the former family restores the curve."""
    return document.with_curve(curve, document.curves[curve].with_family(family))


def set_family_setting(document: Document, curve: int, name: str, value: SettingValue) -> Document:
    """Set a setting of the curve's family; settings at their defaults are not stored."""
    old = document.curves[curve]
    setting = old.family.settings.named(name)
    if setting is None:
        raise EditError(f"{old.family.label} has no setting “{name}”.")
    if not setting.allows(value):
        requirement = with_minus(setting.requirement) if setting.limits else setting.requirement
        raise EditError(f"{setting.label} must be {requirement}.")
    new = old.family.settings.without_defaults({**old.settings, name: value})
    return document if new == old.settings else document.with_curve(curve, replace(old, settings=new))


def set_rule(document: Document, curve: int, rule: EstimateRule) -> Document:
    """Set the rule that estimates the derivatives of its order where they are not explicit."""
    (field,) = (row.rule_field for row in DERIVATIVES if isinstance(rule, row.rules))
    return document.with_curve(curve, replace(document.curves[curve], **{field: rule}))


# Parameters


def set_alpha(document: Document, curve: int, alpha: float) -> Document:
    """Set the power rule Δt = |Δp|^alpha."""
    if not 0 <= alpha <= 1:
        raise EditError("α must lie between 0 (uniform) and 1 (chord length).")
    old = document.curves[curve]
    rule = replace(old.parametrization, kind=ParametrizationKind.POWER, alpha=float(alpha))
    return document.with_curve(curve, replace(old, parametrization=rule))


def set_parametrization(
    document: Document, curve: int, kind: ParametrizationKind, parameters: Sequence[float]
) -> Document:
    """Set the rule for the parameters.

    The manual rule restores the manual parameters that the points carry, if every point carries one;
    otherwise it starts with `parameters`, the present ones.
    """
    old = document.curves[curve]
    if kind is ParametrizationKind.MANUAL and any(point.t is None for point in old.points):
        return freeze_parameters(document, curve, parameters)
    new = replace(old, parametrization=replace(old.parametrization, kind=kind))
    return document.with_curve(curve, with_room_to_close(new))


def freeze_parameters(document: Document, curve: int, parameters: Sequence[float]) -> Document:
    """Make `parameters` manual; a closed curve has one more, at which it returns to its first point."""
    old = document.curves[curve]
    times, closing = parameters[: len(old.points)], parameters[len(old.points) :]
    # A point that keeps its t stays the same object, so that values computed from it are reused.
    points = tuple(
        point if point.t == t else replace(point, t=float(t))
        for point, t in zip(old.points, times, strict=True)
    )
    rule = replace(old.parametrization, kind=ParametrizationKind.MANUAL)
    if closing:
        rule = replace(rule, start=min(rule.start, float(parameters[0])), end=float(closing[0]))
    return document.with_curve(curve, with_room_to_close(replace(old, points=points, parametrization=rule)))


def set_parameters(document: Document, curve: int, parameters: Sequence[float]) -> Document:
    """Make increasing `parameters` manual, one for each knot."""
    parameters = [checked(t, f"The t of point {index}") for index, t in enumerate(parameters)]
    for index, (before, after) in enumerate(pairwise(parameters), start=1):
        if not after > before:
            raise not_after(index, parameters)
    return freeze_parameters(document, curve, parameters)


def set_parameter(
    document: Document, curve: int, index: int, t: float, parameters: Sequence[float]
) -> Document:
    """Set the parameter of point `index` and make the other `parameters` manual; the order must stay."""
    t = checked(t, f"The t of point {index}")
    if index > 0 and not t > parameters[index - 1]:
        raise not_after(index, parameters)
    if index < len(parameters) - 1 and not t < (after := parameters[index + 1]):
        neighbour = (
            f"the t of point {index + 1}"
            if index + 1 < len(document.curves[curve].points)
            else "the t at which the curve returns to its first point"
        )
        raise EditError(f"The t of point {index} must be less than {t_text(after, parameters)}, {neighbour}.")
    return freeze_parameters(document, curve, [*parameters[:index], t, *parameters[index + 1 :]])


def set_interval(document: Document, curve: int, start: float, end: float) -> Document:
    """Let the parameters span [start, end]; the shape of the curve stays, its speed changes.

    Manual parameters are mapped to the new interval, and explicit derivatives are rescaled so that handles
    stay.
    """
    start, end = checked(start, "The start of the interval"), checked(end, "The end of the interval")
    if not start < end:
        raise EditError(
            f"The end of the interval must be greater than its start; {number(end, 15)} is not greater than "
            f"{number(start, 15)}."
        )
    old = document.curves[curve]
    old_start, old_end = old.interval
    factor = (end - start) / (old_end - old_start)
    points = tuple(
        rescaled(_shifted(point, (old_start, old_end), (start, end)), factor) for point in old.points
    )
    rule = replace(old.parametrization, start=start, end=end)
    result = with_room_to_close(replace(old, points=points, parametrization=rule))
    refuse_equal_parameters(result, "The interval is too short to keep the parameters apart.")
    return document.with_curve(curve, result)


def _shifted(point: Point, old: tuple[float, float], new: tuple[float, float]) -> Point:
    """Map the manual parameter of a point from interval `old` to `new`, the ends exactly."""
    if point.t is None:
        return point
    s = (point.t - old[0]) / (old[1] - old[0])
    return replace(point, t=new[1] if point.t == old[1] else new[0] + s * (new[1] - new[0]))


def refuse_equal_parameters(curve: Curve, reason: str) -> None:
    """Raise EditError with `reason` unless the parameters that the points carry increase strictly."""
    given = [point.t for point in curve.points if point.t is not None]
    if any(not b > a for a, b in pairwise(given)):
        raise EditError(reason)


def with_room_to_close(curve: Curve) -> Curve:
    """Return a curve whose interval leaves room for the closing segment, if it has manual parameters.

    Curves of families that cannot close are drawn open, but keep `closed` for the next family.
    """
    if not (curve.closed and curve.is_manual and curve.points):
        return curve
    first, last, end = curve.points[0].t, curve.points[-1].t, curve.parametrization.end
    if first is None or last is None or end > last:
        return curve
    # The segment that closes takes as long as the others do on average.
    mean = (last - first) / (len(curve.points) - 1) if len(curve.points) > 1 else 1.0
    return replace(curve, parametrization=replace(curve.parametrization, end=last + mean))
