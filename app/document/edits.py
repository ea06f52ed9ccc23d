"""Edits: pure functions ``(Document, …) -> Document``.

An edit knows nothing of gestures, selections or screens. `curve` is the curve's index in the document,
`index` a point's index in the curve. Parameters that a rule gives are not in the document; an edit that needs
them takes them as `parameters`. What cannot be done raises `EditError` with a sentence for the person.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Sequence
from itertools import pairwise

from msgspec.structs import replace

from ..families import FAMILIES, Family, SettingValue, titles
from .derivatives import DERIVATIVES, VECTORS, EstimateRule

# Who edits needs these with the edits.
from .kept_handles import stretched as stretched  # noqa: PLC0414
from .kept_handles import stretched_beside as stretched_beside  # noqa: PLC0414
from .kept_handles import with_handles_kept
from .limits import AlreadySoError as AlreadySoError  # noqa: PLC0414
from .limits import EditError as EditError  # noqa: PLC0414
from .limits import are_within, checked_vector, not_after
from .limits import checked as checked  # noqa: PLC0414
from .model import Curve, Document, ParametrizationKind, Point, Vector
from .ties import with_derivative
from .words import number


def placed(point: Point, position: Vector, what: str = "the point") -> Point:
    """Return a point at another position, if a document may hold that."""
    x, y = checked_vector(position, what)
    return replace(point, x=x, y=y)


def all_placed(points: Sequence[Point], xs: Sequence[float], ys: Sequence[float]) -> list[Point]:
    """Return points at other positions, as `placed` each: thousands at every move of a drag."""
    if not (are_within(xs) and are_within(ys)):
        # One of them is to be refused, or its numbers are not plain yet.
        return [placed(*each) for each in zip(points, zip(xs, ys, strict=True), strict=True)]
    return [replace(point, x=x, y=y) for point, x, y in zip(points, xs, ys, strict=True)]


PointsChange = Callable[[Sequence[Point]], Iterable[Point]]
"""What is made of some points, one of each."""


def _with_points(document: Document, curve: int, points: Iterable[Point]) -> Document:
    return document.with_curve(
        curve, _with_room_to_close(replace(document.curves[curve], points=tuple(points)))
    )


def _with_room_to_close(curve: Curve) -> Curve:
    """Let the interval of a closed curve with manual parameters end after the t of its last point.

    A curve of a family that cannot close stays open, but keeps the wish for the family it may get next.
    """
    if not (curve.closed and curve.is_manual and curve.points):
        return curve
    first, last, end = curve.points[0].t, curve.points[-1].t, curve.parametrization.end
    if first is None or last is None or end > last:
        return curve
    # The segment that closes takes as long as the others do on average.
    mean = (last - first) / (len(curve.points) - 1) if len(curve.points) > 1 else 1.0
    return replace(curve, parametrization=replace(curve.parametrization, end=last + mean))


def _with_point(document: Document, curve: int, index: int, point: Point) -> Document:
    points = document.curves[curve].points
    return _with_points(document, curve, (*points[:index], point, *points[index + 1 :]))


# Points


def insert_points(document: Document, curve: int, index: int, points: Sequence[Point]) -> Document:
    """Insert `points` before point `index`; `index` equal to the number of points appends."""
    for point in points:
        _check_point(point, "the point")
    old = document.curves[curve].points
    return _with_points(document, curve, (*old[:index], *points, *old[index:]))


def append_point(document: Document, curve: int, point: Point, *, parameter_scale: float = 1.0) -> Document:
    """Append `point`; derivatives set before are rescaled so that the shape drawn so far stays.

    Under an automatic rule the parameters of the old points are squeezed into a part of the interval when
    a point is appended. `parameter_scale` is that factor, dt_new / dt_old; a velocity per unit of t grows by
    1/parameter_scale, an acceleration by its square, and the handles stay where the person put them.
    """
    checked_vector(point.position, "the point")
    old = (stretched(each, parameter_scale) for each in document.curves[curve].points)
    return _with_points(document, curve, (*old, point))


def move_points(document: Document, curve: int, indices: Collection[int], by: Vector) -> Document:
    """Move the points at `indices` by the vector `by`; their handles go along, those of others stay."""
    return with_all_shifted(document, curve, indices, moving(by))


def moving(by: Vector) -> PointsChange:
    """Return what puts points elsewhere, by the vector `by`."""
    x, y = float(by[0]), float(by[1])
    return lambda points: all_placed(points, [each.x + x for each in points], [each.y + y for each in points])


def with_all_shifted(
    document: Document, curve: int, indices: Collection[int], shift: PointsChange
) -> Document:
    """Put the points at `indices` elsewhere, all by the same way; of a whole curve nothing else changes."""
    old = document.curves[curve]
    if len(indices) < len(old.points):
        return with_all_changed(document, curve, indices, shift)
    return document.with_curve(curve, replace(old, points=tuple(shift(old.points))))


def with_all_changed(
    document: Document, curve: int, indices: Collection[int], change: PointsChange
) -> Document:
    """Put what `change` makes of them in the place of the points at `indices`, which go together."""
    points = list(document.curves[curve].points)
    for index, point in zip(indices, change([points[index] for index in indices]), strict=True):
        points[index] = point
    return with_points_elsewhere(document, curve, points, indices)


def set_position(document: Document, curve: int, index: int, position: Vector) -> Document:
    """Put point `index` at `position`."""
    points = list(document.curves[curve].points)
    points[index] = placed(points[index], position, f"point {index}")
    return with_points_elsewhere(document, curve, points)


def delete_points(document: Document, curve: int, indices: Collection[int]) -> Document:
    """Remove the points at `indices`; a closed curve that has too few left to close is open from then on."""
    old = document.curves[curve]
    kept = [point for i, point in enumerate(old.points) if i not in indices]
    if len(kept) < old.family.least_to_close and old.closed:
        document = document.with_curve(curve, replace(old, closed=False))
    return with_points_elsewhere(document, curve, kept)


def with_points_elsewhere(
    document: Document, curve: int, points: Iterable[Point], together: Collection[int] = ()
) -> Document:
    """Put `points`, the same at other places or fewer, in the place of all.

    The handles of those that stay stay, and those of points that went `together` keep their shape.
    """
    old = document.curves[curve]
    new = _with_room_to_close(replace(old, points=tuple(points)))
    return document.with_curve(curve, with_handles_kept(old, new, together))


def set_velocity(
    document: Document, curve: int, index: int, velocity: Vector | None, *, ahead: bool = False
) -> Document:
    """Fix the velocity of point `index`, per unit of t, or leave it to the rule (None).

    At a corner the one before the point, or the one `ahead` of it.
    """
    return set_derivative(document, curve, index, 1, velocity, ahead=ahead)


def set_derivative(
    document: Document, curve: int, index: int, order: int, vector: Vector | None, *, ahead: bool = False
) -> Document:
    """Fix the derivative of an order at point `index`, per unit of t, or leave it to the rule (None).

    At a corner the one before the point, or the one `ahead` of it; where the two are tied, the other velocity
    turns along.
    """
    if vector is not None:
        vector = checked_vector(vector, f"the {DERIVATIVES[order - 1].name} of point {index}")
    changed = with_derivative(document.curves[curve], index, order, vector, ahead=ahead)
    return _with_point(document, curve, index, changed)


def make_corner(
    document: Document, curve: int, index: int, before: Vector | None, after: Vector | None
) -> Document:
    """Let the curve have a corner at point `index`, with these velocities (None: estimated)."""
    point = document.curves[curve].points[index]
    corner = replace(point.as_corner(), velocity=before, velocity_after=after, tied=False)
    return _with_point(document, curve, index, corner)


def make_smooth(document: Document, curve: int, index: int, velocity: Vector | None) -> Document:
    """Give point `index` one velocity on both sides (None: estimated)."""
    point = document.curves[curve].points[index]
    smooth = replace(point.without_corner(), velocity=velocity)
    return _with_point(document, curve, index, smooth)


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
    points = tuple(stretched(point, parameter_scale) for point in old.points)
    return document.with_curve(curve, _with_room_to_close(replace(old, points=points, closed=closed)))


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


# Rules


def set_family(document: Document, curve: int, family: Family) -> Document:
    """Draw the same points with another family; going back gives the same curve back."""
    return document.with_curve(curve, document.curves[curve].with_family(family))


def set_family_setting(document: Document, curve: int, name: str, value: SettingValue) -> Document:
    """Choose a setting of the curve's family."""
    old = document.curves[curve]
    setting = old.family.settings.named(name)
    if setting is None:
        raise EditError(f"{old.family.label} has no setting “{name}”.")
    if not setting.allows(value):
        raise EditError(f"{setting.label} must be {setting.requirement}.")
    chosen = old.family.settings.without_defaults({**old.settings, name: value})
    return document if chosen == old.settings else document.with_curve(curve, replace(old, settings=chosen))


def set_rule(document: Document, curve: int, rule: EstimateRule) -> Document:
    """Choose how derivatives that nobody set are estimated: those that the rule is for."""
    (field,) = (each.rule_field for each in DERIVATIVES if isinstance(rule, each.rules))
    return document.with_curve(curve, replace(document.curves[curve], **{field: rule}))


def set_alpha(document: Document, curve: int, alpha: float) -> Document:
    """Use the power rule Δt = |Δp|^alpha."""
    if not 0 <= alpha <= 1:
        raise EditError("α must lie between 0 (uniform) and 1 (chord length).")
    old = document.curves[curve]
    rule = replace(old.parametrization, kind=ParametrizationKind.POWER, alpha=float(alpha))
    return document.with_curve(curve, replace(old, parametrization=rule))


def set_parametrization(
    document: Document, curve: int, kind: ParametrizationKind, parameters: Sequence[float]
) -> Document:
    """Choose the rule for the parameters.

    Going to manual brings back the manual parameters the points had, if every point still has one, and
    otherwise starts from `parameters`, those in force now.
    """
    old = document.curves[curve]
    if kind is ParametrizationKind.MANUAL and any(point.t is None for point in old.points):
        return freeze_parameters(document, curve, parameters)
    chosen = replace(old, parametrization=replace(old.parametrization, kind=kind))
    return document.with_curve(curve, _with_room_to_close(chosen))


def freeze_parameters(document: Document, curve: int, parameters: Sequence[float]) -> Document:
    """Make `parameters` the manual parameters; a closed curve has one more, where it returns to its start."""
    old = document.curves[curve]
    own, closing = parameters[: len(old.points)], parameters[len(old.points) :]
    # A point that keeps its t stays the same value: what was computed of it is used again.
    points = tuple(
        point if point.t == t else replace(point, t=float(t))
        for point, t in zip(old.points, own, strict=True)
    )
    rule = replace(old.parametrization, kind=ParametrizationKind.MANUAL)
    if closing:
        rule = replace(rule, start=min(rule.start, float(parameters[0])), end=float(closing[0]))
    return document.with_curve(curve, _with_room_to_close(replace(old, points=points, parametrization=rule)))


def set_parameters(document: Document, curve: int, parameters: Sequence[float]) -> Document:
    """Make `parameters`, one for each knot, the manual parameters; their order must be that of the points."""
    parameters = [checked(t, f"The t of point {index}") for index, t in enumerate(parameters)]
    for index, (before, after) in enumerate(pairwise(parameters), start=1):
        if not after > before:
            raise not_after(index, before)
    return freeze_parameters(document, curve, parameters)


def set_parameter(
    document: Document, curve: int, index: int, t: float, parameters: Sequence[float]
) -> Document:
    """Give point `index` the parameter `t` and freeze the others at `parameters`; the order is kept."""
    t = checked(t, f"The t of point {index}")
    if index > 0 and not t > (before := parameters[index - 1]):
        raise not_after(index, before)
    if index < len(parameters) - 1 and not t < (after := parameters[index + 1]):
        whose = (
            f"the t of point {index + 1}"
            if index + 1 < len(document.curves[curve].points)
            else "where the curve returns to its first point"
        )
        raise EditError(f"The t of point {index} must be less than {number(after, 6)}, {whose}.")
    return freeze_parameters(document, curve, [*parameters[:index], t, *parameters[index + 1 :]])


def set_interval(document: Document, curve: int, start: float, end: float) -> Document:
    """Let the parameters span [start, end]; the curve keeps its shape and is run through faster or slower.

    Manual parameters are mapped along, and derivatives that the person set are rescaled, so that the
    handles stay.
    """
    start, end = checked(start, "The start of the interval"), checked(end, "The end of the interval")
    if not start < end:
        raise EditError(
            f"The interval must end after it starts; {number(end, 6)} is not greater than {number(start, 6)}."
        )
    old = document.curves[curve]
    old_start, old_end = interval(old)
    factor = (end - start) / (old_end - old_start)
    points = tuple(
        stretched(_shifted(point, (old_start, old_end), (start, end)), factor) for point in old.points
    )
    rule = replace(old.parametrization, start=start, end=end)
    result = _with_room_to_close(replace(old, points=points, parametrization=rule))
    refuse_equal_parameters(result, "The interval is too short to keep the parameters apart.")
    return document.with_curve(curve, result)


def interval(curve: Curve) -> tuple[float, float]:
    """Return the interval that the parameters of `curve` span."""
    rule = curve.parametrization
    if curve.is_manual and len(curve.points) > 1:
        first, last = curve.points[0].t, curve.points[-1].t
        if first is not None and last is not None:
            return (first, rule.end if curve.is_closed else last)
    return (rule.start, rule.end)


def _shifted(point: Point, old: tuple[float, float], new: tuple[float, float]) -> Point:
    """Map a manual parameter from interval `old` to `new`, the ends exactly."""
    if point.t is None:
        return point
    s = (point.t - old[0]) / (old[1] - old[0])
    return replace(point, t=new[1] if point.t == old[1] else new[0] + s * (new[1] - new[0]))


def refuse_equal_parameters(curve: Curve, reason: str) -> None:
    """Raise EditError with `reason` unless the parameters that the points carry increase strictly."""
    given = [point.t for point in curve.points if point.t is not None]
    if any(not b > a for a, b in pairwise(given)):
        raise EditError(reason)


# Numbers typed and pasted


def rename_curve(document: Document, curve: int, name: str) -> Document:
    """Give the curve a name, without the blanks around it."""
    name = name.strip()
    if not name:
        raise EditError("A curve needs a name.")
    return document.with_curve(curve, replace(document.curves[curve], name=name))


def set_points(document: Document, curve: int, points: Iterable[Point]) -> Document:
    """Put `points` in the place of all points; every number is checked."""
    points = tuple(points)
    for index, point in enumerate(points):
        _check_point(point, f"point {index}")
    return _with_points(document, curve, points)


def _check_point(point: Point, what: str) -> None:
    checked_vector(point.position, what)
    if point.t is not None:
        checked(point.t, f"The t of {what}")
    for _, name in VECTORS:
        vector = getattr(point, name)
        if vector is not None:
            checked_vector(vector, f"the {name.partition('_')[0]} of {what}")


ALL_ORDERS = range(1, len(DERIVATIVES) + 1)


def estimate_derivatives(
    document: Document, curve: int, indices: Collection[int], orders: Collection[int] = ALL_ORDERS
) -> Document:
    """Leave the derivatives of these orders of the points at `indices` to the rules."""
    cleared: dict[str, object] = dict.fromkeys(name for order, name in VECTORS if order in orders)
    if 1 in orders:
        cleared["tied"] = False
    points = document.curves[curve].points
    return _with_points(
        document,
        curve,
        (replace(point, **cleared) if index in indices else point for index, point in enumerate(points)),
    )
